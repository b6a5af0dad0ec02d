#include <fmt/format.h>
#include <openssl/sha.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "base/file.hpp"
#include "cache_folder.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "interruption.hpp"
#include "mpi_start.hpp"
#include "output_folder.hpp"
#include "setup/setup_document.hpp"
#include "study/program_model.hpp"
#include "study/run_study.hpp"
#include "study/study_json.hpp"
#include "study/study_text.hpp"
#include "study/trial_file.hpp"
#include "study_progress.hpp"
#include "terminal.hpp"

namespace probewright::app {
namespace {

namespace fs = std::filesystem;

/// What tells trials apart: everything that is read for them.
std::string markOf(const std::vector<fs::path>& inputs) {
  std::string all = PROBEWRIGHT_VERSION;
  for (const fs::path& input : inputs) {
    const auto text = readFile(input);  // a ready-made machine is not a file
    all += fmt::format("\n{} ", text ? text->size() : 0);
    if (text) all += *text;
  }
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  SHA256(reinterpret_cast<const unsigned char*>(all.data()), all.size(), digest.data());
  std::string mark;
  for (const unsigned char byte : digest)
    mark += fmt::format("{:02x}", byte);
  return mark;
}

/// What lies in the folder and is nobody's but the user's.
std::optional<Diagnostic> whyNotInto(const fs::path& folder) {
  for (const char* name : {"study.json", "study.csv"}) {
    if (auto why = whyNotWritable(folder, name)) return why;
  }
  return study::whyNotTrials(folder / "trials.csv");
}

}  // namespace

int study(const StudyArguments& given) {
  const Result<std::optional<JoinedRanks>> joined = joinRanks();
  if (!joined) {
    print({joined.error()});
    return 2;
  }
  // All ranks do the same; the first one alone speaks and writes.
  const bool first = !*joined || (*joined)->ranks.rank == 0;
  StudyArguments arguments = given;
  arguments.quiet = arguments.quiet || !first;
  const auto print = [&](const Diagnostics& diagnostics) {
    if (first) app::print(diagnostics);
  };
  Diagnostics mistakes;
  auto document = setup::SetupDocument::read(arguments.setup, mistakes);
  std::optional<study::Study> plan;
  if (document) plan = study::readStudy(arguments.study, document->table(), mistakes);
  if (!plan) {
    print(mistakes);
    return 2;
  }
  if (arguments.trials) plan->trials = *arguments.trials;
  std::vector<fs::path> inputs = {arguments.program};
  inputs.insert(inputs.end(), document->asWritten().inputs.begin(), document->asWritten().inputs.end());
  inputs.insert(inputs.end(), plan->inputs.begin(), plan->inputs.end());

  const Interruption interruption;
  if (const Result<void> tidied = !first ? Result<void>() : tidyOutput(arguments.out, interruption.token()); !tidied) {
    print({tidied.error()});
    return 2;
  }
  if (const auto why = whyNotInto(arguments.out)) {
    print({*why});
    return 2;
  }
  const fs::path trialFile = arguments.out / "trials.csv";
  const std::string mark = markOf(inputs);
  study::StudyRun run;
  if (arguments.resume) {
    auto done = study::readTrials(trialFile, mark);
    if (!done) {
      print({done.error()});
      return 2;
    }
    run.done = std::move(*done);
  }
  // Nobody writes before everybody has read.
  if (*joined) (*joined)->ranks.exchange({});

  const toml::table setupTable = document->table();
  study::ProgramModel::Options options;
  options.control = arguments.control;
  options.import.cache = cacheFolder(arguments.cache);
  options.import.stop = interruption.token();
  const auto model = study::ProgramModel::make(arguments.program, std::move(*document), *plan, options, mistakes);
  print(mistakes);
  if (!model) return interruption.token().stop_requested() ? 3 : 2;
  for (const std::string& name : model->rebuilt()) {
    if (!arguments.quiet)
      fmt::print(stderr, "the size of \"{}\" varies: it is built anew in each trial, which takes longer\n",
                 printable(name));
  }

  std::error_code error;
  fs::create_directories(arguments.out, error);
  std::vector<std::string> names;
  for (const study::Source& source : plan->sources)
    names.push_back(source.name);
  study::TrialWriter writer(trialFile, mark, names);
  std::optional<Diagnostic> notKept;
  std::stop_source diskFull;
  const std::stop_callback forward(interruption.token(), [&] { diskFull.request_stop(); });
  StudyProgress progress(isatty(STDERR_FILENO) != 0);
  std::stop_source all;
  run.crew = *joined ? study::rankCrew((*joined)->ranks, arguments.threads, diskFull.get_token(), all)
                     : study::threadCrew(arguments.threads, diskFull.get_token());
  run.stop = *joined ? all.get_token() : diskFull.get_token();
  run.repeat = arguments.repeat;
  if (!arguments.quiet)
    run.report = [&](const std::string& phase, std::uint64_t done, std::uint64_t of) {
      progress.tell(phase, done, of);
    };
  run.keep = [&](const study::TrialTable& table) {
    if (!first) return;
    if (Result<void> kept = writer.write(table); !kept && !notKept) {
      notKept = kept.error();
      diskFull.request_stop();
    }
  };
  const study::StudyResult result = study::runStudy(
      *plan, setupTable, [&](const study::Draw& draw) { return model->run(draw); }, run);
  if (!arguments.quiet) progress.clear();
  print(result.diagnostics);
  if (notKept) {
    print({*notKept});
    return 2;
  }
  const int exit = result.end == study::StudyEnd::Interrupted || result.finished == 0 ? 3 : 0;
  if (!first) return exit;

  const study::StudyInfo info{arguments.program.string(), arguments.setup.string(), PROBEWRIGHT_VERSION};
  std::set<FileIdentity> identities;
  for (const fs::path& input : inputs)
    if (const auto identity = identityOf(input)) identities.insert(*identity);
  Output output{arguments.out, {}, std::move(identities)};
  output.files.emplace_back("study.json",
                            [&](const Sink& sink) { sink(study::studyJson(result, info).dump(1) + "\n"); });
  output.files.emplace_back("study.csv", [&](const Sink& sink) { sink(study::studyCsv(result)); });
  if (const Result<void> written = writeOutput(output, {}); !written) {
    print({written.error()});
    return 2;
  }
  if (!arguments.quiet) {
    put(printable(study::studyText(result)), stdout);
    put(fmt::format("\nAll results: {}\n", (fs::absolute(arguments.out) / "study.json").lexically_normal().string()),
        stdout);
  }
  return exit;
}

}  // namespace probewright::app
