#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <optional>
#include <set>

#include "base/file.hpp"
#include "base/folder_swap.hpp"
#include "base/number_text.hpp"
#include "cache_folder.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "exchange/inspection.hpp"
#include "interruption.hpp"
#include "machine_run.hpp"
#include "operator_terminal.hpp"
#include "output_folder.hpp"
#include "records/results.hpp"
#include "report_pdf.hpp"
#include "reports/report.hpp"
#include "reports/summary.hpp"
#include "run_record.hpp"
#include "session/answers.hpp"
#include "setup/scene.hpp"
#include "setup/setup_on_machine.hpp"
#include "setup/simulated_run.hpp"
#include "study/first_order.hpp"
#include "terminal.hpp"
#include "words/words.hpp"

namespace probewright::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* pdfFile = "report.pdf";

/// What an import does, on standard error: on a terminal in one line, else a line now and then.
class ImportProgress {
public:
  explicit ImportProgress(bool terminal) : terminal_(terminal) {}

  void tell(const std::string& what) {
    using Clock = std::chrono::steady_clock;
    if (terminal_) {
      std::fputs(fmt::format("\r\033[K{} ", printable(what)).c_str(), stderr);
    } else if (const auto now = Clock::now(); now >= next_) {
      std::fputs((printable(what) + "\n").c_str(), stderr);
      next_ = now + std::chrono::seconds(10);
    }
  }

private:
  bool terminal_;
  std::chrono::steady_clock::time_point next_;
};

/// The files that `paths` name, by what makes them the same.
void noteIdentities(const std::vector<fs::path>& paths, std::set<FileIdentity>& identities) {
  for (const fs::path& path : paths) {
    if (const auto identity = identityOf(path)) identities.insert(*identity);
  }
}

/// The same folder by two names, also if it is not there.
bool areOne(const fs::path& a, const fs::path& b) {
  std::error_code unknown;
  return fs::weakly_canonical(fs::absolute(a, unknown), unknown) ==
         fs::weakly_canonical(fs::absolute(b, unknown), unknown);
}

Content contentOf(const std::string& text) {
  return [&text](const Sink& sink) { sink(text); };
}

/// A table or definition file that lies there already, as it is, and is somebody else's: it stays theirs.
bool standsThere(const fs::path& folder, const std::string& name, const std::string& text) {
  return whyNotWritable(folder, name) && readFile(folder / name).value_or("") == text;
}

/// Why a program cannot write a file of this name, if it is one of those that --export leaves.
std::optional<Diagnostic> whyExported(const std::vector<const exchange::Format*>& formats, const std::string& name) {
  const auto found = std::ranges::find(formats, name, &exchange::Format::file);
  if (found == formats.end()) return std::nullopt;
  return fail(fmt::format("--export {} leaves a file of this name", (*found)->name),
              "choose another name in the program, or export another format")
      .value();
}

/// The setup's, with what the command line says instead.
records::Job jobOf(records::Job job, const records::Job& instead) {
  for (const records::JobField& field : records::jobFields) {
    if (!(instead.*field.value).empty()) job.*field.value = instead.*field.value;
  }
  return job;
}

control::DialogLanguage dialogLanguage(const std::string& code) {
  return control::dialogLanguageOf(code).value_or(control::DialogLanguage::English);
}

/// The control's messages as the operator reads them; `error`, file and line stay, because editors look for them.
Diagnostics inLanguage(Diagnostics diagnostics, control::DialogLanguage language) {
  for (Diagnostic& each : diagnostics) {
    each.code = words::phrase(language, each.code);
    each.message = words::translated(language, each.message);
    each.advice = words::translated(language, each.advice);
  }
  return diagnostics;
}

/// What other programs read goes into the same set of files.
Result<void> addExports(Output& output, const std::vector<const exchange::Format*>& formats,
                        const control::Journal& journal, const records::RunInfo& info) {
  if (formats.empty()) return {};
  const exchange::Inspection inspection = exchange::inspectionOf(journal, info);
  for (const exchange::Format* format : formats) {
    Result<std::string> text = format->write(inspection);
    if (!text) return tl::unexpected(text.error());
    output.files.emplace_back(format->file, [text = std::move(*text)](const Sink& sink) { sink(text); });
  }
  return {};
}

/// Before anything moves: whether everything that the run is to leave can be written. Gives the Chromium that prints
/// the report, if one is needed.
Result<fs::path> prepareFiles(const RunArguments& arguments, const std::stop_token& stop) {
  fs::path chromium;
  if (arguments.preview) return chromium;
  if (const Result<void> ready = prepareOutput(arguments.out, stop); !ready) return tl::unexpected(ready.error());
  if (!arguments.append.empty()) {
    if (const Result<void> ready = checkRecord(arguments.append); !ready) return tl::unexpected(ready.error());
  }
  std::vector<std::string> left = {"results.json", "report.html"};
  if (arguments.pdf) {
    const Result<fs::path> found = findChromium();
    if (!found) return found;
    chromium = *found;
    left.emplace_back(pdfFile);
  }
  for (const exchange::Format* format : arguments.exports)
    left.emplace_back(format->file);
  for (const std::string& name : left) {
    if (const auto why = whyNotWritable(arguments.out, name)) return tl::unexpected(*why);
  }
  return chromium;
}

}  // namespace

int run(const RunArguments& arguments) {
  std::set<FileIdentity> inputs;
  noteIdentities({arguments.program, arguments.setup, arguments.machineFile, arguments.answers}, inputs);
  Diagnostics mistakes;
  std::optional<setup::Setup> setup =
      setup::readSetupOn(arguments.machineFile, arguments.setup, mistakes, [&](const fs::path& folder) {
        return areOne(folder, arguments.out) || std::ranges::any_of(arguments.otherOutputs, [&](const fs::path& other) {
                 return areOne(folder, other);
               });
      });
  if (arguments.quiet) std::erase_if(mistakes, [](const Diagnostic& each) { return each.severity == Severity::Note; });
  print(mistakes);
  const auto cameToNothing = [&](const std::function<Result<void>()>& remove) {
    if (arguments.preview) return 2;
    if (const Result<void> removed = remove(); !removed) print({removed.error()});
    return 2;
  };
  // Which tables the run would have begun from is unknown: those of an earlier run stay.
  if (!setup) return cameToNothing([&] { return removeEarlierVerdict(arguments.out, inputs); });
  noteIdentities(setup->inputs, inputs);
  if (!arguments.tables.empty()) {
    if (!fs::is_directory(arguments.tables)) {
      print({fail({arguments.tables.string()}, "there is no such folder of tables",
                  "give --tables the folder of an earlier run, or one with the tables of a control")
                 .value()});
      return 2;
    }
    setup->beliefs.tables = arguments.tables;
  }
  const auto giveUp = [&] {
    // What a real machine was not ready for has changed nothing: the tables that it was measured into stay.
    return cameToNothing([&] {
      return arguments.machine.empty() ? removeEarlierRun(arguments.out, setup->beliefs.tables, inputs)
                                       : removeEarlierVerdict(arguments.out, inputs);
    });
  };
  if (arguments.seed) setup->world.truth.seed = *arguments.seed;

  session::RunOptions options;
  options.control = arguments.control;
  options.strict = arguments.strict;
  options.onStop = arguments.onStop;
  options.stepLimit = arguments.stepLimit;
  options.skipLevels = arguments.skipLevels;
  options.recordLimit = arguments.recordLimit << 20U;
  options.whyNoFile = [&](const std::string& name) {
    if (arguments.pdf && name == pdfFile)
      return std::optional(fail("--pdf leaves a file of this name", "choose another name").value());
    const auto exported = whyExported(arguments.exports, name);
    return exported ? exported : whyNotWritable(arguments.out, name);
  };
  options.mode = arguments.dryRun        ? session::ProgramMode::DryRun
                 : arguments.programTest ? session::ProgramMode::ProgramTest
                                         : session::ProgramMode::Normal;
  options.searchLine = arguments.searchLine;
  options.language = dialogLanguage(arguments.language);
  options.showAllResults = arguments.screens;
  options.measuringLogs = arguments.measuringLogs;
  options.wallClock = std::time(nullptr);
  options.trace = !arguments.preview;
  const Interruption interruption;
  options.stop = interruption.token();
  OperatorTerminal operatorTerminal(options.stop);
  options.ask = [&](const std::string& text) { return operatorTerminal.goesOn(words::phrase(options.language, text)); };
  options.answer = [&](const control::Question& question) { return operatorTerminal.answer(question); };
  // The run itself waits without a word.
  const fs::path& tables = setup->beliefs.tables;
  FolderReading::of(tables, options.stop, [&] {
    fmt::print(stderr, "another run is replacing the tables in {}: waiting for it\n", tables.string());
  });
  setup::MachineOptions machine;
  machine.blind = arguments.blind;
  machine.clearance = arguments.clearance;
  machine.import.cache = cacheFolder(arguments.cache);
  machine.import.stop = options.stop;
  const Result<fs::path> chromium = prepareFiles(arguments, options.stop);
  if (!chromium) {
    print({chromium.error()});
    return 2;
  }
  if (!arguments.answers.empty()) {
    auto read = readFile(arguments.answers, largestText).and_then([&](const std::string& text) {
      return session::parseAnswers(text, arguments.answers.string());
    });
    if (!read) {
      print({read.error()});
      return giveUp();
    }
    options.answers = std::move(*read);
  }
  const bool progress = !arguments.quiet && isatty(STDERR_FILENO) != 0;
  if (progress) {
    options.progress = [](std::uint64_t blocks) { std::fputs(fmt::format("\r{} blocks ", blocks).c_str(), stderr); };
  }
  ImportProgress importProgress(isatty(STDERR_FILENO) != 0);
  if (!arguments.quiet) machine.import.progress = [&](const std::string& what) { importProgress.tell(what); };

  std::optional<MachineRun> ran;
  if (arguments.machine.empty()) {
    setup::SimulatedRun simulated = setup::runProgram(arguments.program, *setup, options, machine);
    reports::Scene scene = arguments.blind ? setup::believedSceneOf(simulated) : setup::sceneOf(simulated);
    ran = MachineRun{std::move(simulated.outcome), std::move(scene)};
  } else {
    Result<MachineRun> real = runOnMachine(arguments.machine, arguments.program, *setup, options, machine.import);
    if (!real) {
      print({real.error()});
      const int exit = giveUp();
      return options.stop.stop_requested() ? 3 : exit;
    }
    ran = std::move(*real);
  }
  study::FirstOrder uncertainties;
  if (arguments.uncertainty) uncertainties = study::addUncertainties(ran->outcome.journal, setup->world.truth);
  const session::RunOutcome& outcome = ran->outcome;
  if (progress) std::fputs("\r\033[K", stderr);
  const language::Encoding encoding = outcome.info.programs.empty()
                                          ? language::Encoding::Windows1252
                                          : language::detectEncoding(outcome.info.programs.front().text);
  print(outcome.diagnostics, encoding);
  if (hasErrors(outcome.diagnostics)) {
    const int exit = giveUp();
    return options.stop.stop_requested() ? 3 : exit;
  }
  print(inLanguage(outcome.result.diagnostics, options.language), encoding);

  if (arguments.preview) return static_cast<int>(outcome.info.exit);
  records::RunInfo info = outcome.info;
  info.version = PROBEWRIGHT_VERSION;
  info.doubtfulUncertainties = uncertainties.doubtful;
  info.job = jobOf(setup->job, arguments.job);
  info.startedAt = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(static_cast<std::time_t>(options.wallClock)));
  noteIdentities(outcome.inputs, inputs);
  Output output{arguments.out, {}, std::move(inputs)};
  for (const auto& [name, text] : outcome.files) {
    info.outputFiles.push_back(name);
    if (!standsThere(arguments.out, name, text)) output.files.emplace_back(name, contentOf(text));
  }
  reports::PageOptions page;
  page.trace = &outcome.trace;
  page.language = arguments.language;
  const Content report = [&](const Sink& sink) { reports::writeReport(sink, outcome.journal, info, ran->scene, page); };
  output.files.emplace_back("report.html", report);
  if (arguments.pdf) {
    Result<std::string> pdf = reportPdf(*chromium, report);
    if (pdf) {
      output.files.emplace_back(pdfFile, [bytes = std::move(*pdf)](const Sink& sink) { sink(bytes); });
    } else {
      print({pdf.error()});
    }
  }
  output.files.emplace_back("results.json", [&](const Sink& sink) {
    records::writeResults(sink, outcome.journal, info, records::Layout::Indented);
    sink("\n");
  });
  if (const Result<void> exported = addExports(output, arguments.exports, outcome.journal, info); !exported) {
    print({exported.error()});
    return 2;
  }
  // Whoever interrupts the program wants what it has measured; whoever interrupts the writing wants no more of it.
  const std::stop_token stop = options.stop.stop_requested() ? std::stop_token() : options.stop;
  if (const Result<void> written = writeOutput(output, stop); !written) {
    print({written.error()});
    return stop.stop_requested() ? 3 : 2;
  }
  if (!arguments.append.empty()) {
    const auto added = appendToRecord(arguments.append, exchange::inspectionOf(outcome.journal, info));
    if (!added) {
      print({added.error()});
      return 2;
    }
  }
  if (!arguments.quiet) {
    const auto colour = isatty(STDOUT_FILENO) != 0 ? reports::Colour::On : reports::Colour::Off;
    put(reports::summaryText(outcome.journal, info, colour, reports::Cause::Told, options.language), stdout);
    if (arguments.uncertainty) put(printable(study::firstOrderText(outcome.journal, uncertainties)), stdout);
    const std::string path = (fs::absolute(arguments.out) / "report.html").lexically_normal().string();
    std::fputs(("\n" + words::text(options.language, "sumReport", {{"path", path}}) + "\n").c_str(), stdout);
  }
  return static_cast<int>(info.exit);
}

}  // namespace probewright::app
