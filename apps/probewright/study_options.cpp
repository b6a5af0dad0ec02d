#include <memory>

#include "commands.hpp"
#include "options.hpp"
#include "subcommands.hpp"

namespace probewright::app {

Subcommand addStudy(CLI::App& app) {
  const auto arguments = std::make_shared<StudyArguments>();
  CLI::App* study = app.add_subcommand(
      "study", "Run a program in many worlds and say what its results are worth (docs/uncertainty.md)");
  study->add_option("PROGRAM", arguments->program, "NC program: .H, .I, .MPF, .SPF")->required();
  study->add_option("--setup", arguments->setup, "The world to run in (see docs/setup-format.md)")
      ->required()
      ->type_name("FILE");
  study->add_option("--study", arguments->study, "What of the setup is not known exactly (see docs/uncertainty.md)")
      ->required()
      ->type_name("FILE");
  study->add_option("--out", arguments->out, "Folder for study.json, study.csv and trials.csv")
      ->capture_default_str()
      ->type_name("DIR");
  addControl(*study, arguments->control);
  study->add_option("--trials", arguments->trials, "Run this many trials, instead of what the study says")
      ->check(notNegative)
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{100'000'000}))
      ->type_name("COUNT");
  study
      ->add_option("--repeat", arguments->repeat,
                   "Also a type-1 study: measure this many times with every source at its estimate; Cg and Cgk")
      ->check(notNegative)
      ->check(CLI::Range(std::uint64_t{2}, std::uint64_t{1'000'000}))
      ->type_name("COUNT");
  study->add_option("--threads", arguments->threads, "Threads to run on; 0: one a core")
      ->check(CLI::Range(0, 1024))
      ->type_name("COUNT")
      ->capture_default_str();
  study->add_option("--keep", arguments->keep, "Also keep all values of all trials in this file of HDF5")
      ->type_name("FILE");
  study->add_flag("--resume", arguments->resume, "Go on where an earlier study in this folder was interrupted");
  study->add_option("--cache", arguments->cache, "As of run")->type_name("DIR");
  study->add_flag("--quiet", arguments->quiet, "Print nothing but mistakes");
  return {study, [arguments] { return app::study(*arguments); }};
}

Subcommand addSurvive(CLI::App& app) {
  const auto arguments = std::make_shared<SurviveArguments>();
  CLI::App* survive = app.add_subcommand(
      "survive", "Prove which clampings a program survives, and find those that it does not (docs/survive.md)");
  survive->add_option("PROGRAM", arguments->program, "NC program: .H, .I, .MPF, .SPF")->required();
  survive->add_option("--setup", arguments->setup, "The world to run in (see docs/setup-format.md)")
      ->required()
      ->type_name("FILE");
  survive
      ->add_option(
          "--tolerance", arguments->tolerances,
          "What may be otherwise, as part.pose.x=0.5 (to either side) or part.pose.c=-1..1 (from, to); once for "
          "each number")
      ->required()
      ->type_name("NUMBER=RANGE")
      ->expected(1, 1)
      ->take_all()
      ->allow_extra_args(false);
  survive->add_option("--out", arguments->out, "Folder for survive.json and survive.html")
      ->capture_default_str()
      ->type_name("DIR");
  addControl(*survive, arguments->control);
  const auto count = [&](const char* name, std::uint64_t& value, const char* help, std::uint64_t most) {
    survive->add_option(name, value, help)
        ->check(notNegative)
        ->check(CLI::Range(std::uint64_t{0}, most))
        ->type_name("COUNT")
        ->capture_default_str();
  };
  count("--samples", arguments->samples, "Clampings to run, and as many again where nothing is proven", 1'000'000);
  count("--boxes", arguments->boxes, "Boxes of clampings to try to prove, at most", 10'000'000);
  count("--check", arguments->checks, "Clampings to run in what is proven, half of them on its borders", 100'000'000);
  count("--seed", arguments->seed, "Of the samples and of the machine's random effects", 9'999'999'999'999'999U);
  survive->add_option("--threads", arguments->threads, "Threads to run on; 0: one a core")
      ->check(CLI::Range(0, 1024))
      ->type_name("COUNT")
      ->capture_default_str();
  survive->add_option("--cache", arguments->cache, "As of run")->type_name("DIR");
  survive->add_flag("--quiet", arguments->quiet, "Print nothing but mistakes");
  return {survive, [arguments] { return app::survive(*arguments); }};
}

}  // namespace probewright::app
