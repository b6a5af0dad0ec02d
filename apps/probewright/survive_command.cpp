#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "base/file.hpp"
#include "cache_folder.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "interruption.hpp"
#include "output_folder.hpp"
#include "setup/setup_document.hpp"
#include "study_progress.hpp"
#include "survival/survival_records.hpp"
#include "survival/survive.hpp"
#include "terminal.hpp"

namespace probewright::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t mostTolerances = 12;

/// The tolerances of the command line; nothing, with mistakes, if one of them is none.
std::optional<std::vector<survival::Tolerance>> tolerancesOf(const std::vector<std::string>& texts,
                                                             const toml::table& setup, Diagnostics& mistakes) {
  std::vector<survival::Tolerance> tolerances;
  std::set<std::string> names;
  for (const std::string& text : texts) {
    auto tolerance = survival::parseTolerance(text, setup);
    if (!tolerance) {
      mistakes.push_back(std::move(tolerance.error()));
    } else if (!names.insert(tolerance->name()).second) {
      mistakes.push_back({Severity::Error, {}, "two tolerances of " + tolerance->name(), {}, "Give it once", {}});
    } else {
      tolerances.push_back(*std::move(tolerance));
    }
  }
  if (texts.size() > mostTolerances)
    mistakes.push_back({Severity::Error, {}, "more than 12 tolerances", {}, "Leave out those that matter least", {}});
  if (hasErrors(mistakes)) return std::nullopt;
  return tolerances;
}

}  // namespace

int survive(const SurviveArguments& arguments) {
  Diagnostics mistakes;
  const auto fail = [&](const Diagnostic& why) {
    print({why});
    return 2;
  };
  auto document = setup::SetupDocument::read(arguments.setup, mistakes);
  std::optional<std::vector<survival::Tolerance>> tolerances;
  if (document) tolerances = tolerancesOf(arguments.tolerances, document->table(), mistakes);
  print(mistakes);
  if (!tolerances) return 2;
  auto text = readFile(arguments.program);
  if (!text) return fail(text.error());
  std::vector<fs::path> inputs = {arguments.program};
  inputs.insert(inputs.end(), document->asWritten().inputs.begin(), document->asWritten().inputs.end());

  const Interruption interruption;
  if (const Result<void> ready = prepareOutput(arguments.out, interruption.token()); !ready) return fail(ready.error());
  for (const char* name : {"survive.json", "survive.html"})
    if (const auto why = whyNotWritable(arguments.out, name)) return fail(*why);

  simulation::ImportOptions import;
  import.cache = cacheFolder(arguments.cache);
  import.stop = interruption.token();
  auto worlds = survival::ClampedWorlds::make(std::move(*document), *std::move(tolerances), import);
  if (!worlds) return interruption.token().stop_requested() ? 3 : fail(worlds.error());
  const auto program = survival::ClampedProgram::make({arguments.program.string(), *std::move(text)},
                                                      *std::move(worlds), arguments.control, interruption.token());
  if (!program) return fail(program.error());

  survival::Options options;
  options.samples = arguments.samples;
  options.boxes = arguments.boxes;
  options.checks = arguments.checks;
  options.seed = arguments.seed;
  options.threads = arguments.threads;
  StudyProgress progress(isatty(STDERR_FILENO) != 0);
  if (!arguments.quiet)
    options.report = [&](const std::string& phase, std::uint64_t done, std::uint64_t of) {
      progress.tell(phase, done, of);
    };
  const survival::Survival result = survival::survive(**program, options);
  if (!arguments.quiet) progress.clear();

  const survival::SurvivalInfo info{arguments.program.string(), arguments.setup.string(), PROBEWRIGHT_VERSION,
                                    printable((*program)->script().text)};
  std::set<FileIdentity> identities;
  for (const fs::path& input : inputs)
    if (const auto identity = identityOf(input)) identities.insert(*identity);
  Output output{arguments.out, {}, std::move(identities)};
  output.files.emplace_back("survive.json", [&](const Sink& sink) {
    sink(survival::survivalJson(result, info).dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  });
  output.files.emplace_back("survive.html", [&](const Sink& sink) { sink(survival::survivalPage(result, info)); });
  if (const Result<void> written = writeOutput(output, {}); !written) return fail(written.error());
  if (!arguments.quiet) {
    put(printable(survival::survivalText(result)), stdout);
    put(fmt::format("\nThe map: {}\n", (fs::absolute(arguments.out) / "survive.html").lexically_normal().string()),
        stdout);
  }
  switch (result.end) {
    case survival::SurvivalEnd::Contradiction:
      print({{Severity::Error,
              {},
              "a clamping in the proven part was run and fails: this is a mistake of Probewright",
              {},
              "Please report it with the program, the setup and this command line",
              {}}});
      return 4;
    case survival::SurvivalEnd::Interrupted:
    case survival::SurvivalEnd::FailsAsWritten:
      return 3;
    case survival::SurvivalEnd::Finished:
      break;
  }
  return result.symmetric == 1 ? 0 : 1;
}

}  // namespace probewright::app
