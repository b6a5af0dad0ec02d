#include "session/run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "base/file.hpp"
#include "control/alarm.hpp"
#include "records/results.hpp"
#include "session/run_parts.hpp"
#include "session/source.hpp"

namespace probewright::session {

namespace fs = std::filesystem;
using control::ControlKind;
using execution::RunEnd;
using records::ExitState;

namespace {

const ControlFamilies& familiesOf(const RunOptions& options) {
  return options.families != nullptr ? *options.families : knownFamilies();
}

/// Notes how the run ended, in the words of an exit code, and puts what stopped it among the events.
void conclude(RunOutcome& outcome) {
  if (hasErrors(outcome.diagnostics)) {
    outcome.info.exit = ExitState::InputMistake;
    outcome.info.exitText = outcome.diagnostics.front().message;
    return;
  }
  if (outcome.result.end != RunEnd::Finished && !outcome.result.diagnostics.empty()) {
    const Diagnostic& why = outcome.result.diagnostics.front();
    outcome.info.exitText = why.code.empty() ? why.message : why.code + ": " + why.message;
    if (outcome.result.end == RunEnd::Alarm) {
      outcome.journal.events.push_back(
          {control::EventKind::Alarm, why.place, why.code, why.message, outcome.info.totalSeconds});
    }
  }
  switch (outcome.result.end) {
    case RunEnd::Finished: {
      const control::Verdict worst = records::worstVerdict(outcome.journal);
      const bool out = worst == control::Verdict::Rework || worst == control::Verdict::Scrap;
      outcome.info.exit = out ? ExitState::OutOfTolerance : ExitState::Good;
      break;
    }
    case RunEnd::BrokenProgram:
      outcome.info.exit = ExitState::InputMistake;
      break;
    case RunEnd::Alarm:
    case RunEnd::Cancelled:
    case RunEnd::StepLimit:
    case RunEnd::RecordLimit:
      outcome.info.exit = ExitState::Stopped;
      break;
  }
}

/// The outcome of a run that is about to begin.
RunOutcome begun(PreparedProgram& prepared) {
  RunOutcome outcome;
  outcome.diagnostics = std::move(prepared.diagnostics);
  if (!prepared.control) return outcome;
  outcome.control = *prepared.control;
  const ControlFamilies& families = familiesOf(*prepared.options);
  outcome.info.language = families.entry(languageFor(outcome.control, prepared.path, {}, families)).name;
  outcome.info.control = families.model(outcome.control).name;
  const auto& skipped = prepared.options->skipLevels;
  for (std::size_t level = 0; level < skipped.size(); ++level)
    if (skipped[level]) outcome.info.skipLevels.push_back(static_cast<int>(level));
  return outcome;
}

RunOutcome ended(RunOutcome outcome, PreparedProgram prepared) {
  conclude(outcome);
  if (prepared.note && hasErrors(outcome.diagnostics)) outcome.diagnostics.push_back(*prepared.note);
  if (prepared.control) outcome.info.programs.push_back({prepared.path.string(), std::move(prepared.text)});
  return outcome;
}

PreparedProgram nothingYet(const fs::path& path, const control::Beliefs& beliefs, const RunOptions& options) {
  PreparedProgram prepared;
  prepared.beliefs = &beliefs;
  prepared.options = &options;
  prepared.path = path;
  return prepared;
}

/// Has the program read through for mistakes by its control.
void prepare(PreparedProgram& prepared, const std::shared_ptr<language::Program>& program) {
  const control::Beliefs& beliefs = *prepared.beliefs;
  const RunOptions& options = *prepared.options;
  const RunRequest request{program, prepared.path, *prepared.control, beliefs, options};
  const ControlFamily& family = familiesOf(options).of(*prepared.control);
  const auto refuse = [&](std::string message, std::string advice) {
    prepared.diagnostics.push_back(
        {Severity::Error, {prepared.path.string(), 0, 0}, std::move(message), {}, std::move(advice), {}});
  };
  const auto having = [&](bool ControlFamily::*ability) {
    std::vector<std::string_view> names;
    for (const ControlFamily& each : familiesOf(options).all())
      if (each.*ability) names.push_back(each.name);
    return fmt::format("{}", fmt::join(names, " and "));
  };
  if (!family.hasProgramModes && options.mode != ProgramMode::Normal) {
    return refuse(fmt::format("dry run and program test are modes of {} controls, this is a {} program",
                              having(&ControlFamily::hasProgramModes), family.name),
                  "leave them out for this program");
  }
  if (!family.startsAtLines && options.searchLine) {
    return refuse(fmt::format("a {} program starts at its beginning: a start at line {}, in its middle, is carried "
                              "out for {} programs only",
                              family.name, *options.searchLine, having(&ControlFamily::startsAtLines)),
                  "start it from its first block, and let it jump over what is done already");
  }
  if (std::ranges::find(family.dialogLanguages, options.language) == family.dialogLanguages.end()) {
    return refuse(fmt::format("{} controls have no dialog language {}", family.name, control::code(options.language)),
                  fmt::format("use --language {}", control::code(family.dialogLanguages.front())));
  }
  prepared.runOn = family.prepare(request, prepared.diagnostics);
}

}  // namespace

PreparedProgram prepareProgram(const fs::path& path, const control::Beliefs& beliefs, const RunOptions& options) {
  const ControlFamilies& families = familiesOf(options);
  PreparedProgram prepared = nothingYet(path, beliefs, options);
  Result<std::string> text = readFile(path);
  if (!text) {
    prepared.diagnostics.push_back(text.error());
    return prepared;
  }
  const Result<ControlKind> kind = controlFor(path, *text, options.control, beliefs.control, families);
  if (!kind) {
    prepared.diagnostics.push_back(kind.error());
    return prepared;
  }
  Result<std::shared_ptr<language::Program>> program =
      openProgram(path, *text, languageFor(*kind, path, *text, families), families);
  if (!program) {
    prepared.diagnostics.push_back(program.error());
    return prepared;
  }
  prepared.control = *kind;
  prepared.note = otherLanguage(path, *text, families);
  prepared.text = std::move(*text);
  prepare(prepared, *program);
  return prepared;
}

PreparedProgram prepareText(const std::string& name, std::string text, const control::Beliefs& beliefs,
                            const RunOptions& options) {
  const ControlFamilies& families = familiesOf(options);
  PreparedProgram prepared = nothingYet(name, beliefs, options);
  const Result<ControlKind> kind = controlFor(name, text, options.control, beliefs.control, families);
  if (!kind) {
    prepared.diagnostics.push_back(kind.error());
    return prepared;
  }
  prepared.control = *kind;
  const std::shared_ptr<language::Program> program =
      programOf(name, text, languageFor(*kind, name, text, families), families);
  prepared.text = std::move(text);
  prepare(prepared, program);
  return prepared;
}

RunOutcome run(PreparedProgram prepared, machine::Machine& machine) {
  RunOutcome outcome = begun(prepared);
  if (!hasErrors(outcome.diagnostics)) {
    machine.stopOn(prepared.options->stop);
    outcome.info.machine = machine.description().name;
    outcome.info.axes = machine.description().axes;
    HostFiles files(prepared.path, *prepared.beliefs);
    try {
      prepared.runOn(machine, files, outcome);
    } catch (const control::Alarm& alarm) {
      // Before the first block: an active preset or a tool in the spindle that the tables do not have.
      outcome.diagnostics.push_back(
          {Severity::Error, {prepared.beliefs->file, 0, 0}, alarm.text(), {}, alarm.advice(), alarm.code()});
    }
    outcome.inputs.insert(outcome.inputs.end(), files.used().begin(), files.used().end());
  }
  return ended(std::move(outcome), std::move(prepared));
}

RunOutcome notRun(PreparedProgram prepared) {
  RunOutcome outcome = begun(prepared);
  return ended(std::move(outcome), std::move(prepared));
}

RunOutcome run(const fs::path& program, const control::Beliefs& beliefs, machine::Machine& machine,
               const RunOptions& options) {
  return run(prepareProgram(program, beliefs, options), machine);
}

RunOutcome runText(const std::string& name, std::string text, const control::Beliefs& beliefs,
                   machine::Machine& machine, const RunOptions& options) {
  return run(prepareText(name, std::move(text), beliefs, options), machine);
}

}  // namespace probewright::session
