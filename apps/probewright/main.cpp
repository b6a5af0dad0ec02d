#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <bitset>
#include <cctype>
#include <cstdio>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "console.hpp"
#include "guard.hpp"
#include "session/control_family.hpp"
#include "terminal.hpp"

namespace {

using probewright::app::CheckFormat;
using probewright::control::ControlKind;
using probewright::control::OnStop;

/// The option --control of all subcommands.
void addControl(CLI::App& command, std::optional<ControlKind>& control) {
  const auto& families = probewright::session::knownFamilies();
  const std::string names = fmt::format("{}", fmt::join(families.controlNames(), ", "));
  command
      .add_option_function<std::string>(
          "--control",
          [&control, &families, names](const std::string& text) {
            control = families.controlNamed(text);
            if (!control) throw CLI::ValidationError("--control", text + " is not one of " + names);
          },
          "The control that the program is for, if file extension and text do not show it: " + names)
      ->type_name("NAME");
}

/// The option --skip of run and check: "0,3".
void addSkip(CLI::App& command, std::bitset<10>& levels) {
  command
      .add_option_function<std::string>(
          "--skip",
          [&levels](const std::string& text) {
            const auto wrong = [&] {
              return CLI::ValidationError("--skip", text + " is not a list of levels from 0 to 9 such as 0,3");
            };
            levels.reset();
            for (std::size_t i = 0; i < text.size(); i += 2) {
              const bool digit = text[i] >= '0' && text[i] <= '9';
              const bool separated = i + 1 == text.size() || (text[i + 1] == ',' && i + 2 < text.size());
              if (!digit || !separated) throw wrong();
              levels.set(static_cast<std::size_t>(text[i] - '0'));
            }
            if (levels.none()) throw wrong();
          },
          "Block skip: leave out blocks that begin with / and one of these levels; a / alone has level 0")
      ->type_name("LEVELS");
}

/// The option --export of run: "csv,qif".
void addExport(CLI::App& command, std::vector<const probewright::exchange::Format*>& exports) {
  std::vector<std::string_view> names;
  std::string files;
  for (const auto& format : probewright::exchange::formats()) {
    names.push_back(format.name);
    files += fmt::format("{}{}: {}", files.empty() ? "" : "; ", format.name, format.about);
  }
  const std::string known = fmt::format("{}", fmt::join(names, ", "));
  command
      .add_option_function<std::vector<std::string>>(
          "--export",
          [&exports, known](const std::vector<std::string>& words) {
            for (const std::string& word : words) {
              const auto* format = probewright::exchange::formatNamed(word);
              if (format == nullptr) throw CLI::ValidationError("--export", word + " is not one of " + known);
              if (std::find(exports.begin(), exports.end(), format) == exports.end()) exports.push_back(format);
            }
          },
          "Files for other programs, into the folder of --out; several with commas. " + files)
      ->type_name("FORMATS")
      ->delimiter(',');
}

/// The option --job of run: "serial=0017".
void addJob(CLI::App& command, probewright::records::Job& job) {
  std::string known;
  for (const auto& field : probewright::records::jobFields)
    known += (known.empty() ? "" : ", ") + std::string(field.name);
  command
      .add_option_function<std::vector<std::string>>(
          "--job",
          [&job, known](const std::vector<std::string>& words) {
            for (const std::string& word : words) {
              const std::size_t sign = std::min(word.find('='), word.size());
              const auto& fields = probewright::records::jobFields;
              const auto field =
                  std::ranges::find_if(fields, [&](const auto& each) { return word.substr(0, sign) == each.name; });
              if (field == fields.end() || sign == word.size())
                throw CLI::ValidationError("--job", word + " is not NAME=TEXT with one of " + known);
              job.*(field->value) = word.substr(sign + 1);
            }
          },
          "For the head of the report, instead of [job] of the setup, as --job serial=0017; several times: " + known)
      ->type_name("ENTRY")
      ->expected(1, 1)
      ->take_all()
      ->allow_extra_args(false);
}

/// The option --machine-ini.
void addMachineFile(CLI::App& command, std::filesystem::path& file) {
  command
      .add_option(
          "--machine-ini", file,
          "Simulate this machine instead of the setup's: the .ini file of a LinuxCNC configuration, or a machine "
          "file (see docs/linuxcnc.md)")
      ->type_name("FILE");
}

/// Reading "-1" into an unsigned number would wrap it around.
std::string notNegative(const std::string& text) {
  const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  return digits && text.size() <= 19 ? std::string() : text + " is not a whole number of 0 or more";
}

CLI::App* addStudy(CLI::App& app, probewright::app::StudyArguments& arguments) {
  CLI::App* study = app.add_subcommand(
      "study", "Run a program in many worlds and say what its results are worth (docs/uncertainty.md)");
  study->add_option("PROGRAM", arguments.program, "NC program: .H, .I, .MPF, .SPF")->required();
  study->add_option("--setup", arguments.setup, "The world to run in (see docs/setup-format.md)")
      ->required()
      ->type_name("FILE");
  study->add_option("--study", arguments.study, "What of the setup is not known exactly (see docs/uncertainty.md)")
      ->required()
      ->type_name("FILE");
  study->add_option("--out", arguments.out, "Folder for study.json, study.csv and trials.csv")
      ->capture_default_str()
      ->type_name("DIR");
  addControl(*study, arguments.control);
  study->add_option("--trials", arguments.trials, "Run this many trials, instead of what the study says")
      ->check(notNegative)
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{100'000'000}))
      ->type_name("COUNT");
  study
      ->add_option("--repeat", arguments.repeat,
                   "Also a type-1 study: measure this many times with every source at its estimate; Cg and Cgk")
      ->check(notNegative)
      ->check(CLI::Range(std::uint64_t{2}, std::uint64_t{1'000'000}))
      ->type_name("COUNT");
  study->add_option("--threads", arguments.threads, "Threads to run on; 0: one a core")
      ->check(CLI::Range(0, 1024))
      ->type_name("COUNT")
      ->capture_default_str();
  study->add_option("--keep", arguments.keep, "Also keep all values of all trials in this file of HDF5")
      ->type_name("FILE");
  study->add_flag("--resume", arguments.resume, "Go on where an earlier study in this folder was broken off");
  study->add_option("--cache", arguments.cache, "As of run")->type_name("DIR");
  study->add_flag("--quiet", arguments.quiet, "Print nothing but mistakes");
  return study;
}

CLI::App* addSurvive(CLI::App& app, probewright::app::SurviveArguments& arguments) {
  CLI::App* survive = app.add_subcommand(
      "survive", "Prove which clampings a program survives, and find those that it does not (docs/survive.md)");
  survive->add_option("PROGRAM", arguments.program, "NC program: .H, .I, .MPF, .SPF")->required();
  survive->add_option("--setup", arguments.setup, "The world to run in (see docs/setup-format.md)")
      ->required()
      ->type_name("FILE");
  survive
      ->add_option(
          "--tolerance", arguments.tolerances,
          "What may be otherwise, as part.pose.x=0.5 (to either side) or part.pose.c=-1..1 (from, to); once for "
          "each number")
      ->required()
      ->type_name("NUMBER=RANGE")
      ->expected(1, 1)
      ->take_all()
      ->allow_extra_args(false);
  survive->add_option("--out", arguments.out, "Folder for survive.json and survive.html")
      ->capture_default_str()
      ->type_name("DIR");
  addControl(*survive, arguments.control);
  const auto count = [&](const char* name, std::uint64_t& value, const char* help, std::uint64_t most) {
    survive->add_option(name, value, help)
        ->check(notNegative)
        ->check(CLI::Range(std::uint64_t{0}, most))
        ->type_name("COUNT")
        ->capture_default_str();
  };
  count("--samples", arguments.samples, "Clampings to run, and as many again where nothing is proven", 1'000'000);
  count("--boxes", arguments.boxes, "Boxes of clampings to try to prove, at most", 10'000'000);
  count("--check", arguments.checks, "Clampings to run in what is proven, half of them on its borders", 100'000'000);
  count("--seed", arguments.seed, "Of the samples and of the machine's random effects", 9'999'999'999'999'999U);
  survive->add_option("--threads", arguments.threads, "Threads to run on; 0: one a core")
      ->check(CLI::Range(0, 1024))
      ->type_name("COUNT")
      ->capture_default_str();
  survive->add_option("--cache", arguments.cache, "As of run")->type_name("DIR");
  survive->add_flag("--quiet", arguments.quiet, "Print nothing but mistakes");
  return survive;
}

/// An option that takes one of a few words, in any case.
template <class Value>
CLI::Option& addChoice(CLI::App& command, const std::string& name, Value& value,
                       std::vector<std::pair<std::string, Value>> choices, const std::string& meaning) {
  std::string words;
  for (const auto& [word, choice] : choices)
    words += (words.empty() ? "" : ", ") + word;
  return *command
              .add_option_function<std::string>(
                  name,
                  [&value, name, words, choices = std::move(choices)](const std::string& text) {
                    for (const auto& [word, choice] : choices) {
                      if (CLI::detail::to_lower(text) != word) continue;
                      value = choice;
                      return;
                    }
                    throw CLI::ValidationError(name, text + " is not one of " + words);
                  },
                  meaning + ": " + words)
              ->type_name("WORD");
}

void addLanguage(CLI::App& command, std::string& language, const std::string& about) {
  std::vector<std::pair<std::string, std::string>> codes;
  for (const char* code : {"en", "de", "ru", "sv", "zh", "pl"})
    codes.emplace_back(code, code);
  addChoice(command, "--language", language, codes, about).default_str("en");
}

/// The unknown word of a command line: an option that the subcommand does not have, or no subcommand at all; empty if
/// all are known. A list of what else is missing would not help with a mistyped word.
std::string unknownWord(const CLI::App& app, int argc, char** argv) {
  if (argc < 2) return {};
  const std::string first = argv[1];
  const CLI::App* command = nullptr;
  for (const CLI::App* each : app.get_subcommands(nullptr)) {
    if (each->get_name() == first) command = each;
  }
  if (command == nullptr) {
    if (first.starts_with('-')) {
      return app.get_option_no_throw(first.substr(0, first.find('='))) == nullptr ? "there is no option " + first : "";
    }
    std::string words;
    for (const CLI::App* each : app.get_subcommands(nullptr))
      words += (words.empty() ? "" : ", ") + each->get_name();
    return "there is no subcommand " + first + "; the subcommands are " + words;
  }
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--") break;
    if (word.size() > 1 && word.starts_with('-') && !word.starts_with("--") && word != "-h" &&
        std::isdigit(static_cast<unsigned char>(word[1])) == 0)
      return first + " has no option " + word + "; if it is the name of a file, write ./" + word;
    if (!word.starts_with("--")) continue;
    const std::string name = word.substr(0, word.find('='));
    if (command->get_option_no_throw(name) == nullptr) {
      return first + " has no option " + name + "; `probewright " + first + " --help` lists them";
    }
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Probewright runs the touch-probe measuring programs of HEIDENHAIN and SINUMERIK controls."};
  app.set_version_flag("--version", PROBEWRIGHT_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 fine, 1 measured and out of tolerance, 2 a mistake in the input, 3 an alarm or a stop while "
      "running, "
      "4 an error inside Probewright.");

  probewright::app::RunArguments runArguments;
  CLI::App* run = app.add_subcommand("run", "Run a program on the virtual machine of a setup, or on a real one");
  run->add_option("PROGRAM", runArguments.program, "NC program: .H, .I, .MPF, .SPF")->required();
  run->add_option("--setup", runArguments.setup, "The world to run in (see docs/setup-format.md)")
      ->required()
      ->type_name("FILE");
  CLI::Option* machine =
      run->add_option("--machine", runArguments.machine,
                      "Run on a real machine: linuxcnc, the command of another machine adapter, or the path of its "
                      "socket (see docs/machine-adapters.md); of the setup only what the control believes counts")
          ->type_name("ADAPTER")
          ->check([](const std::string& text) {
            return text.find_first_not_of(' ') == std::string::npos ? "--machine names no adapter" : "";
          });
  std::string host;
  run->add_option("--host", host, "With --machine linuxcnc: the computer on which LinuxCNC runs, reached by ssh")
      ->needs(machine)
      ->type_name("[USER@]NAME")
      ->check([](const std::string& text) {
        const bool plain = !text.empty() && text.find_first_of(" \t\n\v\f\r") == std::string::npos;
        return plain && !text.starts_with('-')
                   ? ""
                   : "it is the name of a computer, without blanks and without a - before it";
      });
  run->parse_complete_callback([&] {
    if (host.empty()) return;
    if (runArguments.machine != "linuxcnc")
      throw CLI::ValidationError("--host", "it goes with --machine linuxcnc; other adapters are commands");
    runArguments.machine = "ssh -T " + host + " probewright-linuxcnc";
  });
  addMachineFile(*run, runArguments.machineFile);
  run->add_option("--out", runArguments.out, "Folder for tables, logs, results.json and report.html")
      ->capture_default_str()
      ->type_name("DIR");
  addControl(*run, runArguments.control);
  run->add_flag("--strict", runArguments.strict,
                "Refuse what is skipped otherwise: machining cycles, M functions, words that are not carried out");
  addChoice(*run, "--on-stop", runArguments.onStop,
            {{"continue", OnStop::Continue}, {"abort", OnStop::Abort}, {"ask", OnStop::Ask}},
            "What a programmed stop does")
      .default_str("continue");
  run->add_option(
         "--answers", runArguments.answers,
         "Answers to what the program asks, one NAME=VALUE a line; they take precedence over [answers] of the setup")
      ->type_name("FILE");
  run->add_option("--step-limit", runArguments.stepLimit, "Blocks after which an endless loop is assumed; 0: never")
      ->check(notNegative)
      ->type_name("COUNT")
      ->capture_default_str();
  addSkip(*run, runArguments.skipLevels);
  run->add_option("--record-limit", runArguments.recordLimit,
                  "MB of messages, results and files after which an endless loop is assumed; 0: never")
      ->check(notNegative)
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 20U))
      ->type_name("MB")
      ->capture_default_str();
  run->add_option("--seed", runArguments.seed, "Seed of the random effects, instead of the setup's")
      ->check(notNegative)
      ->type_name("NUMBER")
      ->excludes(machine);
  CLI::Option* test = run->add_flag("--program-test", runArguments.programTest,
                                    "SINUMERIK PRT: the axes do not move, measuring cycles are skipped");
  run->add_flag("--dry-run", runArguments.dryRun,
                "SINUMERIK DRY: paths at the dry run feed $SC_DRY_RUN_FEED, measuring cycles are skipped")
      ->excludes(test);
  run->add_option(
         "--search", runArguments.searchLine,
         "SINUMERIK block search: begin at this line of the program as if all before it had run, without motion "
         "and measuring")
      ->check(notNegative)
      ->type_name("LINE");
  addLanguage(*run, runArguments.language, "Language of the summary, the report and the control's messages and logs");
  run->add_option("--measuring-log", runArguments.measuringLogs,
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
         "--cache", runArguments.cache,
         "Folder that keeps imported STEP and IGES parts for the next run; off: none. Default: $PROBEWRIGHT_CACHE, "
         "else probewright in $XDG_CACHE_HOME or ~/.cache")
      ->type_name("DIR")
      ->excludes(machine);
  addExport(*run, runArguments.exports);
  run->add_option("--append", runArguments.append,
                  "Also add the measured values to this table of many runs, in CSV; made if it is missing")
      ->type_name("FILE");
  run->add_option(
         "--tables", runArguments.tables,
         "Begin with the control's tables in this folder, such as that of an earlier run, instead of the setup's")
      ->type_name("DIR");
  addJob(*run, runArguments.job);
  run->add_flag("--pdf", runArguments.pdf, "Also print the report as report.pdf; Chromium does it");
  run->add_flag("--screens", runArguments.screens, "Show the result screens of all cycles, also of those that are off");
  run->add_flag("--blind", runArguments.blind,
                "Say nothing of what only the virtual machine knows: true values, errors, what stands in the way");
  run->add_flag("--clearance", runArguments.clearance,
                "Tell how near the tool came to part, fixtures and table, block by block; takes some time");
  run->add_flag("--uncertainty", runArguments.uncertainty,
                "Give each result the uncertainty that the scatter of the probe makes, to first order (see "
                "docs/uncertainty.md)");
  run->add_flag("--quiet", runArguments.quiet, "Print nothing but mistakes");

  probewright::app::CheckArguments checkArguments;
  CLI::App* check = app.add_subcommand("check", "Read programs without moving anything and name every mistake");
  check->add_option("PROGRAM", checkArguments.programs, "NC programs; - is standard input")->required();
  addChoice(*check, "--format", checkArguments.format,
            {{"text", CheckFormat::Text}, {"json", CheckFormat::Json}, {"sarif", CheckFormat::Sarif}},
            "How mistakes are told: for people, or as one document on standard output for other programs")
      .default_str("text");
  check
      ->add_option("--setup", checkArguments.setup,
                   "Also name tools and presets that the control of this setup does not have")
      ->type_name("FILE");
  check
      ->add_flag("--watch", checkArguments.watch,
                 "Check once more whenever a program, the setup or a file beside the programs changes, until Ctrl-C")
      ->excludes("--format");
  addControl(*check, checkArguments.control);
  addSkip(*check, checkArguments.skipLevels);

  probewright::app::CyclesArguments cyclesArguments;
  CLI::App* cycles = app.add_subcommand("cycles", "The catalogue of measuring cycles, or one of them in full");
  std::vector<std::string> cycleWords;
  cycles->add_option("NAME", cycleWords, "411, CYCLE977, or words to look for: bore, Bohrung, calibrate ring");
  addControl(*cycles, cyclesArguments.control);
  CLI::Option* block =
      cycles->add_flag("--template", cyclesArguments.asTemplate, "A call of the cycle to paste into a program");
  addLanguage(*cycles, cyclesArguments.language, "Language of titles and of the texts after the parameters");
  cycles->add_flag("--json", cyclesArguments.asJson, "Everything that the catalogue knows, as JSON for other programs")
      ->excludes(block);

  probewright::app::CompareArguments compareArguments;
  CLI::App* compare = app.add_subcommand("compare", "What two runs measured and wrote, side by side");
  compare->add_option("FIRST", compareArguments.first, "The folder of a run, or its results.json")->required();
  compare->add_option("SECOND", compareArguments.second, "Another one")->required();
  compare->add_option("--tolerance", compareArguments.tolerance, "Differences up to this do not count, mm and degrees")
      ->check(CLI::Range(0.0, 1000.0))
      ->type_name("MM")
      ->capture_default_str();
  compare->add_flag("--all", compareArguments.all, "Also values and entries that are alike");
  compare->add_flag("--json", compareArguments.asJson, "Everything, as JSON for other programs");
  compare->footer("Exit codes: 0 alike, 1 they differ, 2 a mistake in the input.");

  probewright::app::ProjectArguments projectArguments;
  CLI::App* project = app.add_subcommand(
      "project", "Run the programs of a job in their order, each with the tables that the one before has left");
  project->add_option("FILE", projectArguments.file, "The project: programs and setups in TOML (docs/projects.md)")
      ->required();
  project->add_option("--out", projectArguments.out, "Where to write; each run has a folder there")
      ->type_name("DIR")
      ->capture_default_str();
  project->add_flag("--strict", projectArguments.run.strict, "As for run");
  project->add_option("--cache", projectArguments.run.cache, "As for run")->type_name("DIR");
  addExport(*project, projectArguments.run.exports);
  project->add_flag("--quiet", projectArguments.run.quiet, "Print nothing but mistakes");
  project->footer("Exit codes: as for run, the worst of all runs. A mistake, an alarm or a stop ends the project.");

  probewright::app::CameraArguments cameraArguments;
  CLI::App* camera = app.add_subcommand("camera", "List and manage the images that cycles 600 and 601 have stored");
  camera->add_option("FOLDER", cameraArguments.folder, "The folder of tables that a run has left")->required();
  camera->add_option("POINT", cameraArguments.point, "A monitoring point, as PLATE.OS; without it all are listed");
  camera
      ->add_option("--keys", cameraArguments.keys,
                   "Soft keys to press, as \"SELECT IMAGE 3; REFERENCE IMAGE; EVALUATE\" (docs/heidenhain-cycles.md)")
      ->type_name("KEYS");

  probewright::app::ConvertArguments convertArguments;
  CLI::App* convert = app.add_subcommand(
      "convert", "Write a program in another language: Klartext (.H), DIN/ISO (.I), SINUMERIK (.MPF)");
  convert->add_option("IN", convertArguments.input, "The program")->required();
  convert->add_option("OUT", convertArguments.output, "The file to write; its extension names the language")
      ->required();
  addControl(*convert, convertArguments.control);
  convert->get_option("--control")->description("The control to write for: TNC640 (default), iTNC530, 840Dsl, 828D");
  convert
      ->add_option("--setup", convertArguments.setup,
                   "The setup of the control that a SINUMERIK program is for: its folder of tables has the definition "
                   "files (UGUD.DEF...) and values (*.INI, *.GUD) of global user data; without it, definition files "
                   "beside IN count")
      ->type_name("FILE");
  convert
      ->add_option("--set-up", convertArguments.setUp,
                   "SET_UP of the HEIDENHAIN touch probe table (MP6140), mm: no program tells it")
      ->check(CLI::Range(0.0, 1000.0))
      ->type_name("MM")
      ->capture_default_str();
  convert
      ->add_option("--dist", convertArguments.dist,
                   "DIST of that table (MP6130), mm: how far a touch looks for the surface")
      ->check(CLI::Range(0.001, 10000.0))
      ->type_name("MM")
      ->capture_default_str();
  convert
      ->add_option("--tool-cycles", convertArguments.toolCycles,
                   "The form of the tool measuring cycles in Klartext: old (30 to 33) or new (480 to 483); without it "
                   "as the program has them")
      ->check(CLI::IsMember({"old", "new"}))
      ->type_name("FORM");
  convert->add_flag("--force", convertArguments.force, "Overwrite OUT if it exists");
  convert->footer(
      "Exit codes: 0 everything carried over, 1 something was not or is doubtful: it is named, and what the other "
      "language cannot say is kept as a comment in OUT; 2 a mistake in the input, or OUT exists: nothing written. "
      "docs/conversion.md says which measuring cycle becomes which.");

  probewright::app::MachineArguments machineArguments;
  CLI::App* machinePage =
      app.add_subcommand("machine", "Check a machine file, and write a page that moves each of its axes");
  machinePage
      ->add_option("MACHINE", machineArguments.machine,
                   "A machine file, the .ini of a LinuxCNC configuration, a setup, or the name of a ready-made machine")
      ->required();
  machinePage->add_option("--out", machineArguments.out, "The page to write")->capture_default_str()->type_name("FILE");
  machinePage->add_flag("--force", machineArguments.force,
                        "Overwrite the file also if it is not the page of a machine");

  probewright::app::StudyArguments studyArguments;
  CLI::App* study = addStudy(app, studyArguments);

  probewright::app::SurviveArguments surviveArguments;
  CLI::App* survive = addSurvive(app, surviveArguments);

  probewright::app::FeelArguments feelArguments;
  CLI::App* feel = app.add_subcommand(
      "feel", "Give a simulated LinuxCNC machine a probe that feels the part of a setup (see docs/linuxcnc.md)");
  feel->add_option("SETUP", feelArguments.setup, "The world to feel; only its truth counts")->required();
  addMachineFile(*feel, feelArguments.machineFile);
  feel->add_option("--segment", feelArguments.segment, "Shared memory that the HAL component has made")
      ->type_name("NAME")
      ->capture_default_str();
  feel->add_option("--cache", feelArguments.cache, "As for run")->type_name("DIR");
  feel->add_flag("--quiet", feelArguments.quiet, "Print nothing but mistakes");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (const std::string word = error.get_exit_code() == 0 ? "" : unknownWord(app, argc, argv); !word.empty()) {
      std::fputs(("probewright: " + probewright::app::printable(word) + "\n").c_str(), stderr);
      return 2;
    }
    std::ostringstream help, mistake;
    const bool fine = app.exit(error, help, mistake) == 0;
    probewright::app::put(help.str(), stdout);
    probewright::app::put(mistake.str(), stderr);
    return probewright::app::outputArrived() && fine ? 0 : 2;
  }
  const int exit = probewright::app::guarded([&] {
    if (run->parsed()) return probewright::app::run(runArguments);
    if (check->parsed()) return probewright::app::check(checkArguments);
    if (project->parsed()) return probewright::app::project(projectArguments);
    if (compare->parsed()) return probewright::app::compare(compareArguments);
    if (camera->parsed()) return probewright::app::camera(cameraArguments);
    if (convert->parsed()) return probewright::app::convert(convertArguments);
    if (study->parsed()) return probewright::app::study(studyArguments);
    if (survive->parsed()) return probewright::app::survive(surviveArguments);
    if (feel->parsed()) return probewright::app::feel(feelArguments);
    if (machinePage->parsed()) return probewright::app::machine(machineArguments);
    cyclesArguments.name = fmt::format("{}", fmt::join(cycleWords, " "));
    return probewright::app::cycles(cyclesArguments);
  });
  // Whoever asked for an answer must learn that it did not come; an alarm or an error says more.
  return probewright::app::outputArrived() || exit > 2 ? exit : 2;
}
