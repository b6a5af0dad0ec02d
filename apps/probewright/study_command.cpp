#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "base/file.hpp"
#include "cache_folder.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "interruption.hpp"
#include "kept_trials.hpp"
#include "mpi_start.hpp"
#include "output_folder.hpp"
#include "setup/setup_document.hpp"
#include "study/program_model.hpp"
#include "study/run_study.hpp"
#include "study/study_json.hpp"
#include "study/study_text.hpp"
#include "study/trial_file.hpp"
#include "study_progress.hpp"
#include "study_state.hpp"
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
  return digestOf(all);
}

/// What lies in the folder and is nobody's but the user's.
std::optional<Diagnostic> whyNotInto(const fs::path& folder) {
  for (const char* name : {"study.json", "study.csv"}) {
    if (auto why = whyNotWritable(folder, name)) return why;
  }
  if (auto why = whyNotStudyState(folder)) return why;
  return study::whyNotTrials(folder / "trials.csv");
}

/// All that a study needs, before anything is built.
struct Prepared {
  setup::SetupDocument document;
  study::Study plan;
  std::vector<fs::path> inputs;
  std::optional<KeptTrials> keptTrials;
  std::string mark;
  // Where an earlier run had come to: its trials, or their sums.
  std::optional<study::TrialReader> done;
  std::string state;
};

/// Takes up an earlier run. Fails if there is none.
Result<void> resume(const StudyArguments& arguments, Prepared& prepared) {
  auto state = readStudyState(arguments.out, prepared.mark);
  if (!state) return tl::unexpected(state.error());
  if (*state && prepared.keptTrials)
    return fail({(arguments.out / "study.state").string(), 0, 0},
                "the values of the trials before the interruption were not kept", "leave out --keep, or begin anew");
  if (*state) {
    prepared.state = **state;
    return {};
  }
  auto done = study::TrialReader::open(arguments.out / "trials.csv", prepared.mark);
  if (!done) return tl::unexpected(done.error());
  prepared.done = *std::move(done);
  return {};
}

/// Nothing, with errors among the mistakes, if the study cannot begin. Only one of several ranks tidies the folder.
std::optional<Prepared> prepare(const StudyArguments& arguments, bool tidies, const Interruption& interruption,
                                Diagnostics& mistakes) {
  auto document = setup::SetupDocument::read(arguments.setup, mistakes);
  if (!document) return std::nullopt;
  auto plan = study::readStudy(arguments.study, document->table(), mistakes);
  if (!plan) return std::nullopt;
  if (arguments.trials) plan->trials = *arguments.trials;
  Prepared prepared{std::move(*document), std::move(*plan), {arguments.program}, {}, {}, {}, {}};
  for (const auto& more : {prepared.document.asWritten().inputs, prepared.plan.inputs})
    prepared.inputs.insert(prepared.inputs.end(), more.begin(), more.end());
  prepared.mark = markOf(prepared.inputs);
  if (tidies) {
    if (const Result<void> ready = prepareOutput(arguments.out, interruption.token()); !ready) {
      mistakes.push_back(ready.error());
      return std::nullopt;
    }
  }
  if (const auto why = whyNotInto(arguments.out)) {
    mistakes.push_back(*why);
    return std::nullopt;
  }
  if (!arguments.keep.empty()) {
    auto kept = KeptTrials::at(arguments.keep);
    if (!kept) {
      mistakes.push_back(kept.error());
      return std::nullopt;
    }
    prepared.keptTrials = std::move(*kept);
  }
  if (arguments.resume) {
    if (const Result<void> taken = resume(arguments, prepared); !taken) {
      mistakes.push_back(taken.error());
      return std::nullopt;
    }
  }
  return prepared;
}

/// Waits until all ranks have come here. True if none of them has mistakes, and `sees` is the same for all; the first
/// one says what is wrong with the others.
bool allReady(const std::optional<JoinedRanks>& joined, const Diagnostics& mistakes, const std::string& sees) {
  const bool ready = !hasErrors(mistakes);
  if (!joined) return ready;
  std::string mine = ready ? "=" + sees : "!";
  if (!ready) {
    for (const Diagnostic& mistake : mistakes)
      mine += format(mistake) + "\n";
  }
  const std::vector<std::string> all = joined->ranks.exchange(mine);
  bool allSame = ready;
  for (std::size_t rank = 1; rank < all.size(); ++rank) {
    if (all[rank] == all[0] && ready) continue;
    allSame = false;
    if (joined->ranks.rank != 0 || (all[rank] == all[0])) continue;
    const std::string why = all[rank].starts_with('!') ? all[rank].substr(1)
                                                       : "error: it reads other files than the first rank\n"
                                                         "  give all ranks the same program, setup, study and output\n";
    if (ready) fmt::print(stderr, "rank {}: {}", rank, printable(why));
  }
  return allSame;
}

/// What all ranks must see alike.
std::string seen(const Prepared& prepared) {
  return fmt::format("{} {} {}", prepared.mark, prepared.done.has_value(), prepared.state.size());
}

/// One process as a rank of its own.
study::Ranks alone() {
  return {0, 1, [](const std::string& mine) { return std::vector<std::string>{mine}; }};
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
  const Interruption interruption;
  Diagnostics mistakes;
  auto prepared = prepare(arguments, first, interruption, mistakes);
  if (!prepared) print(mistakes);
  // Nobody writes before everybody has read.
  if (!allReady(*joined, mistakes, prepared ? seen(*prepared) : "") || !prepared) return 2;
  const study::Study* const plan = &prepared->plan;
  const std::vector<fs::path>& inputs = prepared->inputs;
  const std::optional<KeptTrials>& keptTrials = prepared->keptTrials;
  const std::string& mark = prepared->mark;
  const fs::path trialFile = arguments.out / "trials.csv";
  study::StudyRun run;
  std::optional<study::TrialReader>& earlier = prepared->done;
  if (earlier)
    run.done = [&]() -> std::optional<study::Outcome> {
      auto trial = earlier->next();
      if (!trial) return std::nullopt;
      return std::move(trial->outcome);
    };
  run.state = std::move(prepared->state);
  // The values of all trials come together where they are to be kept; else ranks hand in sums.
  const bool sums = !run.state.empty() || (*joined && (*joined)->ranks.size > 1 && !keptTrials && !earlier);

  const toml::table setupTable = prepared->document.table();
  study::ProgramModel::Options options;
  options.control = arguments.control;
  options.import.cache = cacheFolder(arguments.cache);
  options.import.stop = interruption.token();
  const auto model =
      study::ProgramModel::make(arguments.program, std::move(prepared->document), *plan, options, mistakes);
  print(mistakes);
  if (!allReady(*joined, mistakes, {}) || !model) return interruption.token().stop_requested() ? 3 : 2;
  for (const std::string& name : model->rebuilt()) {
    if (!arguments.quiet)
      fmt::print(stderr, "the size of \"{}\" varies: it is built anew in each trial, which takes longer\n",
                 printable(name));
  }

  std::error_code error;
  fs::create_directories(arguments.out, error);
  std::set<FileIdentity> identities;
  for (const fs::path& input : inputs)
    if (const auto identity = identityOf(input)) identities.insert(*identity);
  // Results belong to the trials beside them: those of an earlier study go when the first trials of this one come.
  bool dropped = false;
  const auto dropEarlier = [&]() -> Result<void> {
    if (dropped) return {};
    if (Result<void> removed = removeEarlierRun(arguments.out, {}, identities); !removed) return removed;
    dropped = true;
    if (arguments.resume) return {};
    if (!sums) removeStudyState(arguments.out);
    std::error_code ignored;
    if (sums) fs::remove(trialFile, ignored);  // else the first trials replace those of an earlier study
    return {};
  };
  std::vector<std::string> names;
  for (const study::Source& source : plan->sources)
    names.push_back(source.name);
  study::TrialWriter writer(trialFile, mark, names, dropEarlier);
  std::optional<Diagnostic> notKept;
  std::stop_source diskFull;
  const std::stop_callback forward(interruption.token(), [&] { diskFull.request_stop(); });
  StudyProgress progress(isatty(STDERR_FILENO) != 0);
  std::stop_source all;
  run.crew = *joined ? study::rankCrew((*joined)->ranks, arguments.threads, diskFull.get_token(), all)
                     : study::threadCrew(arguments.threads, diskFull.get_token());
  run.stop = *joined ? all.get_token() : diskFull.get_token();
  run.repeat = arguments.repeat;
  // Each rank has enough to do before all wait for each other.
  constexpr std::uint64_t trialsOfARank = 25;
  if (*joined) run.stretch = std::max(run.stretch, trialsOfARank * static_cast<std::uint64_t>((*joined)->ranks.size));
  if (!arguments.quiet)
    run.report = [&](const std::string& phase, std::uint64_t done, std::uint64_t of) {
      progress.tell(phase, done, of);
    };
  const auto keptOrStop = [&](const Result<void>& kept) {
    if (kept || notKept) return;
    notKept = kept.error();
    diskFull.request_stop();
  };
  bool goesOn = earlier.has_value(), trialsBegun = false;
  if (!sums)
    run.keep = [&](std::span<const study::Draw> draws, std::span<const study::Outcome> outcomes) {
      if (!first || notKept) return;
      if (goesOn) keptOrStop(writer.goOn(*earlier));
      goesOn = false;
      if (!notKept) keptOrStop(writer.write(draws, outcomes));
      trialsBegun = true;
    };
  if (sums) {
    const study::Ranks ranks = *joined ? (*joined)->ranks : alone();
    run.summing = study::Summing{ranks, study::threadCrew(arguments.threads, diskFull.get_token()), all};
    if (!*joined) run.stop = all.get_token();
    constexpr std::uint64_t sumsOfARank = 250;
    run.summing->stretch = std::max(run.summing->stretch, sumsOfARank * static_cast<std::uint64_t>(ranks.size));
    run.keepState = [&](const std::string& state) {
      if (first && !notKept) keptOrStop(writeStudyState(arguments.out, mark, state, dropEarlier));
    };
  }
  const study::StudyResult result = study::runStudy(
      *plan, setupTable, [&](const study::Draw& draw) { return model->run(draw); }, run);
  if (!arguments.quiet) progress.clear();
  print(result.diagnostics);
  const bool stale = !trialsBegun && !earlier;  // interrupted before the first trial: the file is of another study
  if (first && keptTrials && !notKept && !stale) {
    auto trials = study::TrialReader::open(trialFile, mark);
    keptOrStop(trials ? keptTrials->write(*std::move(trials), mark) : tl::unexpected(trials.error()));
  }
  if (notKept) {
    print({*notKept});
    return 2;
  }
  const int exit = result.end == study::StudyEnd::Interrupted || result.finished == 0 ? 3 : 0;
  if (!first) return exit;
  if (result.end == study::StudyEnd::Interrupted && !dropped && !arguments.resume) {
    if (!arguments.quiet) fmt::print(stderr, "interrupted before the first trial: nothing is written\n");
    return exit;
  }

  const study::StudyInfo info{arguments.program.string(), arguments.setup.string(), PROBEWRIGHT_VERSION};
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
