#include <memory>

#include "commands.hpp"
#include "options.hpp"
#include "subcommands.hpp"

namespace probewright::app {

Subcommand addRun(CLI::App& app) {
  const auto arguments = std::make_shared<RunArguments>();
  CLI::App* run = app.add_subcommand("run", "Run a program on the virtual machine of a setup, or on a real one");
  run->add_option("PROGRAM", arguments->program, "NC program: .H, .I, .MPF, .SPF")->required();
  run->add_option("--setup", arguments->setup, "The world to run in (see docs/setup-format.md)")
      ->required()
      ->type_name("FILE");
  CLI::Option* machine =
      run->add_option("--machine", arguments->machine,
                      "Run on a real machine: linuxcnc, the command of another machine adapter, or the path of its "
                      "socket (see docs/machine-adapters.md); of the setup only what the control believes counts")
          ->type_name("ADAPTER")
          ->check([](const std::string& text) {
            return text.find_first_not_of(' ') == std::string::npos ? "--machine names no adapter" : "";
          });
  const auto host = std::make_shared<std::string>();
  run->add_option("--host", *host, "With --machine linuxcnc: the computer on which LinuxCNC runs, reached by ssh")
      ->needs(machine)
      ->type_name("[USER@]NAME")
      ->check([](const std::string& text) {
        const bool plain = !text.empty() && text.find_first_of(" \t\n\v\f\r") == std::string::npos;
        return plain && !text.starts_with('-')
                   ? ""
                   : "it is the name of a computer, without blanks and without a - before it";
      });
  run->parse_complete_callback([arguments, host] {
    if (host->empty()) return;
    if (arguments->machine != "linuxcnc")
      throw CLI::ValidationError("--host", "it goes with --machine linuxcnc; other adapters are commands");
    arguments->machine = "ssh -T " + *host + " probewright-linuxcnc";
  });
  addMachineFile(*run, arguments->machineFile);
  run->add_option("--out", arguments->out, "Folder for tables, logs, results.json and report.html")
      ->capture_default_str()
      ->type_name("DIR");
  addControl(*run, arguments->control);
  run->add_flag("--strict", arguments->strict,
                "Refuse what is skipped otherwise: machining cycles, M functions, words that are not carried out");
  addChoice(*run, "--on-stop", arguments->onStop,
            {{"continue", control::OnStop::Continue}, {"abort", control::OnStop::Abort}, {"ask", control::OnStop::Ask}},
            "What a programmed stop does")
      .default_str("continue");
  run->add_option(
         "--answers", arguments->answers,
         "Answers to what the program asks, one NAME=VALUE a line; they take precedence over [answers] of the setup")
      ->type_name("FILE");
  run->add_option("--step-limit", arguments->stepLimit, "Blocks after which an endless loop is assumed; 0: never")
      ->check(notNegative)
      ->type_name("COUNT")
      ->capture_default_str();
  addSkip(*run, arguments->skipLevels);
  run->add_option("--record-limit", arguments->recordLimit,
                  "MB of messages, results and files after which an endless loop is assumed; 0: never")
      ->check(notNegative)
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 20U))
      ->type_name("MB")
      ->capture_default_str();
  run->add_option("--seed", arguments->seed, "Seed of the random effects, instead of the setup's")
      ->check(notNegative)
      ->type_name("NUMBER")
      ->excludes(machine);
  CLI::Option* test = run->add_flag("--program-test", arguments->programTest,
                                    "SINUMERIK PRT: the axes do not move, measuring cycles are skipped");
  run->add_flag("--dry-run", arguments->dryRun,
                "SINUMERIK DRY: paths at the dry run feed $SC_DRY_RUN_FEED, measuring cycles are skipped")
      ->excludes(test);
  run->add_option("--search", arguments->searchLine,
                  "Begin at this line of the program as if all before it had run, without motion and measuring "
                  "(SINUMERIK: block search; HEIDENHAIN: mid-program startup)")
      ->check(fromOne)
      ->type_name("LINE");
  addLanguage(*run, arguments->language, "Language of the summary, the report and the control's messages and logs");
  run->add_option("--measuring-log", arguments->measuringLogs,
                  "SINUMERIK: log all measurements in this file of the output folder; .csv: as a table, .txt: as text")
      ->type_name("NAME")
      ->check([](const std::string& name) {
        const std::filesystem::path path(name);
        const bool plain = path.filename() == path && path.has_stem();
        return plain && (path.extension() == ".csv" || path.extension() == ".txt")
                   ? std::string()
                   : name + " is not a file name that ends in .txt or .csv";
      });
  run->add_option(
         "--cache", arguments->cache,
         "Folder that keeps imported STEP and IGES parts for the next run; off: none. Default: $PROBEWRIGHT_CACHE, "
         "else probewright in $XDG_CACHE_HOME or ~/.cache")
      ->type_name("DIR")
      ->excludes(machine);
  addExport(*run, arguments->exports);
  CLI::Option* append =
      run->add_option("--append", arguments->append,
                      "Also add the measured values to this table of many runs, in CSV; made if it is missing")
          ->type_name("FILE");
  run->add_option(
         "--tables", arguments->tables,
         "Begin with the control's tables in this folder, such as that of an earlier run, instead of the setup's")
      ->type_name("DIR");
  addJob(*run, arguments->job);
  CLI::Option* pdf = run->add_flag("--pdf", arguments->pdf, "Also print the report as report.pdf; Chromium does it");
  run->add_flag("--preview", arguments->preview,
                "Leave no files: for a screen that draws what the program does before it runs")
      ->excludes(pdf)
      ->excludes(append)
      ->excludes("--export");
  run->add_flag("--screens", arguments->screens, "Show the result screens of all cycles, also of those that are off");
  CLI::Option* blind =
      run->add_flag("--blind", arguments->blind,
                    "Say nothing of what only the virtual machine knows: true values, errors, what stands in the way");
  run->add_flag("--clearance", arguments->clearance,
                "Tell how near the tool came to part, fixtures and table, block by block; takes some time");
  run->add_flag("--uncertainty", arguments->uncertainty,
                "Give each result the uncertainty that the scatter of the probe makes, to first order (see "
                "docs/uncertainty.md)")
      ->excludes(blind);
  run->add_flag("--quiet", arguments->quiet, "Print nothing but mistakes");
  return {run, [arguments] { return app::run(*arguments); }};
}

Subcommand addProject(CLI::App& app) {
  const auto arguments = std::make_shared<ProjectArguments>();
  CLI::App* project = app.add_subcommand(
      "project", "Run the programs of a job in their order, each with the tables that the one before has left");
  project->add_option("FILE", arguments->file, "The project: programs and setups in TOML (docs/projects.md)")
      ->required();
  project->add_option("--out", arguments->out, "Where to write; each run has a folder there")
      ->type_name("DIR")
      ->capture_default_str();
  project->add_flag("--strict", arguments->run.strict, "As for run");
  project->add_option("--cache", arguments->run.cache, "As for run")->type_name("DIR");
  addExport(*project, arguments->run.exports);
  project->add_flag("--quiet", arguments->run.quiet, "Print nothing but mistakes");
  project->footer("Exit codes: as for run, the worst of all runs. A mistake, an alarm or a stop ends the project.");
  return {project, [arguments] { return app::project(*arguments); }};
}

}  // namespace probewright::app
