#include "survival/clamped_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace probewright::survival {

SourcePlace placeAt(const records::RunTrace& trace, double seconds) {
  const auto next = std::ranges::upper_bound(trace.blocks, seconds + 1e-9, {}, &records::RunTrace::Block::seconds);
  if (next == trace.blocks.begin()) return {};
  const records::RunTrace::Block& block = *std::prev(next);
  return {trace.files[block.file], block.line, 0};
}

Result<std::unique_ptr<ClampedProgram>> ClampedProgram::make(Script script, std::unique_ptr<ClampedWorlds> worlds,
                                                             std::optional<control::ControlKind> control,
                                                             std::stop_token stop) {
  std::unique_ptr<ClampedProgram> program(
      new ClampedProgram(std::move(script), std::move(worlds), control, std::move(stop)));
  const auto& beliefs = program->worlds().asWritten().beliefs;
  const auto prepared = session::prepareText(program->script_.name, program->script_.text, beliefs, program->options_);
  for (const Diagnostic& mistake : prepared.diagnostics)
    if (mistake.severity == Severity::Error) return tl::unexpected(mistake);
  WatchedRun run = program->watch(program->worlds().written());
  if (run.end.cancelled) return program;
  program->failureAsWritten_ = run.end.failure;
  program->meant_ = touchedFaces(run.path, run.truth);
  if (!run.truth.bodies.empty()) {
    const auto most = program->worlds().truthWithMost(boxOf(program->worlds().tolerances()));
    if (!most) return tl::unexpected(most.error());
    program->bodies_ = std::make_unique<simulation::BodyClearance>(*most);
  }
  program->obstacle_ = program->obstacleOfMachine();
  if (!program->obstacle_) {
    auto obstacle = computesWithResults(program->script_.name, program->script_.text, *prepared.control);
    if (!obstacle) obstacle = cycleNotCovered(run.outcome.journal);
    if (obstacle) program->obstacle_ = Reason{obstacle->why, obstacle->place};
  }
  return program;
}

std::optional<Reason> ClampedProgram::obstacleOfMachine() const {
  const simulation::Truth& truth = worlds_->asWritten().world.truth;
  if (truth.machine.mainSpindle) return Reason{"on lathes nothing is proven", {}};
  for (std::size_t i = 0; i < truth.errors.axes.size() && i < truth.machine.axes.size(); ++i) {
    const simulation::AxisErrors& errors = truth.errors.axes[i];
    if (truth.machine.axes[i].kind == machine::AxisKind::Rotary && (errors.backlash != 0 || !errors.deviations.empty()))
      return Reason{"a rotary axis has backlash or deviations", {}};
  }
  return std::nullopt;
}

ClampedRun ClampedProgram::judged(const session::RunOutcome& outcome) const {
  ClampedRun run;
  if (outcome.result.end == execution::RunEnd::Cancelled || stop_.stop_requested()) {
    run.cancelled = true;
    return run;
  }
  const auto mistake = std::ranges::find(outcome.diagnostics, Severity::Error, &Diagnostic::severity);
  if (mistake != outcome.diagnostics.end()) {
    run.failure = Reason{mistake->message, mistake->place};
  } else if (outcome.result.end != execution::RunEnd::Finished) {
    run.failure = Reason{"stopped", {}};
    if (!outcome.result.diagnostics.empty()) {
      const Diagnostic& why = outcome.result.diagnostics.front();
      run.failure = Reason{fmt::format("{}{}{}", why.code, why.code.empty() ? "" : ": ", why.message), why.place};
    }
  }
  return run;
}

session::PreparedProgram ClampedProgram::prepared(const session::RunOptions& options) const {
  Read& read = read_.local();
  auto& program = &options == &traced_ ? read.traced : read.plain;
  if (!program) program = session::prepareText(script_.name, script_.text, worlds_->asWritten().beliefs, options);
  return *program;
}

ClampedRun ClampedProgram::run(std::span<const double> values, std::uint64_t noise) const {
  auto truth = worlds_->truth(values);
  if (!truth) return {false, Reason{truth.error().message, truth.error().place}};
  truth->seed = noise;
  auto machine = worlds_->machine(*std::move(truth));
  if (!machine) return {false, Reason{machine.error().message, {}}};
  const session::RunOutcome outcome = session::run(prepared(options_), **machine);
  ClampedRun run = judged(outcome);
  if (run.cancelled || run.failure) return run;
  if (auto other = otherThanMeant(meant_, (*machine)->path(), (*machine)->truth(), worlds_->sizeVaries()))
    run.failure = Reason{*std::move(other), {}};
  return run;
}

WatchedRun ClampedProgram::watch(std::span<const double> values) const {
  WatchedRun run;
  auto truth = worlds_->truth(values);
  if (!truth) {
    run.end.failure = Reason{truth.error().message, truth.error().place};
    return run;
  }
  for (simulation::TrueTool& tool : truth->tools)
    tool.probe.repeatability = 0;
  for (simulation::TrueToolProbe& probe : truth->toolProbes)
    probe.repeatability = 0;
  auto machine = worlds_->machine(*std::move(truth));
  if (!machine) {
    run.end.failure = Reason{machine.error().message, {}};
    return run;
  }
  WatchedMachine watched(**machine);
  run.outcome = session::run(prepared(traced_), watched);
  run.end = judged(run.outcome);
  run.steps = watched.steps();
  run.path = (*machine)->path();
  run.truth = (*machine)->truth();
  return run;
}

WatchedRun ClampedProgram::replay(const simulation::Truth& truth, const std::vector<PlannedTouch>& plan) const {
  WatchedRun run;
  simulation::Truth empty = truth;
  empty.solids.clear();
  empty.bodies.clear();
  auto machine = worlds_->machine(std::move(empty));
  if (!machine) {
    run.end.failure = Reason{machine.error().message, {}};
    return run;
  }
  WatchedMachine watched(**machine, &plan);
  run.outcome = session::run(prepared(options_), watched);
  run.end = judged(run.outcome);
  run.steps = watched.steps();
  return run;
}

}  // namespace probewright::survival
