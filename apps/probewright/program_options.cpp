#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "commands.hpp"
#include "options.hpp"
#include "session/source.hpp"
#include "subcommands.hpp"

namespace probewright::app {

Subcommand addCheck(CLI::App& app) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App* check = app.add_subcommand("check", "Read programs without moving anything and name every mistake");
  check->add_option("PROGRAM", arguments->programs, "NC programs; - is standard input")->required();
  addChoice(*check, "--format", arguments->format,
            {{"text", CheckFormat::Text}, {"json", CheckFormat::Json}, {"sarif", CheckFormat::Sarif}},
            "How mistakes are told: for people, or as one document on standard output for other programs")
      .default_str("text");
  check
      ->add_option("--setup", arguments->setup,
                   "Also name tools and presets that the control of this setup does not have")
      ->type_name("FILE");
  check
      ->add_flag("--watch", arguments->watch,
                 "Check once more whenever a program, the setup or a file beside the programs changes, until Ctrl-C")
      ->excludes("--format");
  addControl(*check, arguments->control);
  addSkip(*check, arguments->skipLevels);
  return {check, [arguments] { return app::check(*arguments); }};
}

Subcommand addCycles(CLI::App& app) {
  const auto arguments = std::make_shared<CyclesArguments>();
  CLI::App* cycles = app.add_subcommand("cycles", "The catalogue of measuring cycles, or one of them in full");
  const auto words = std::make_shared<std::vector<std::string>>();
  cycles->add_option("NAME", *words, "411, CYCLE977, or words to look for: bore, Bohrung, calibrate ring");
  addControl(*cycles, arguments->control);
  CLI::Option* block =
      cycles->add_flag("--template", arguments->asTemplate, "A call of the cycle to paste into a program");
  addLanguage(*cycles, arguments->language, "Language of titles and of the texts after the parameters");
  cycles->add_flag("--json", arguments->asJson, "Everything that the catalogue knows, as JSON for other programs")
      ->excludes(block);
  return {cycles, [arguments, words] {
            arguments->name = fmt::format("{}", fmt::join(*words, " "));
            return app::cycles(*arguments);
          }};
}

Subcommand addConvert(CLI::App& app) {
  const auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* convert = app.add_subcommand(
      "convert", fmt::format("Write a program in another language: {}", session::endingsWithLanguages()));
  convert->add_option("IN", arguments->input, "The program")->required();
  convert->add_option("OUT", arguments->output, "The file to write; its extension names the language")->required();
  addControl(*convert, arguments->control);
  convert->get_option("--control")
      ->description(
          fmt::format("The control to write for: {}; without it the first of them that reads the language of OUT",
                      fmt::join(session::knownFamilies().controlNames(), ", ")));
  convert
      ->add_option("--setup", arguments->setup,
                   "The setup of the control that a SINUMERIK program is for: its folder of tables has the definition "
                   "files (UGUD.DEF...) and values (*.INI, *.GUD) of global user data; without it, definition files "
                   "beside IN count")
      ->type_name("FILE");
  convert
      ->add_option("--set-up", arguments->setUp,
                   "SET_UP of the HEIDENHAIN touch probe table (MP6140), mm: no program tells it")
      ->check(finite)
      ->check(CLI::Range(0.0, 1000.0))
      ->type_name("MM")
      ->capture_default_str();
  convert
      ->add_option("--dist", arguments->dist, "DIST of that table (MP6130), mm: how far a touch looks for the surface")
      ->check(finite)
      ->check(CLI::Range(0.001, 10000.0))
      ->type_name("MM")
      ->capture_default_str();
  convert
      ->add_option("--tool-cycles", arguments->toolCycles,
                   "The form of the tool measuring cycles in Klartext: old (30 to 33) or new (480 to 483); without it "
                   "as the program has them")
      ->check(CLI::IsMember({"old", "new"}))
      ->type_name("FORM");
  convert->add_flag("--force", arguments->force, "Overwrite OUT if it exists");
  convert->footer(
      "Exit codes: 0 everything carried over, 1 something was not or is doubtful: it is named, and what the other "
      "language cannot say is kept as a comment in OUT; 2 a mistake in the input, or OUT exists: nothing written. "
      "docs/conversion.md says which measuring cycle becomes which.");
  return {convert, [arguments] { return app::convert(*arguments); }};
}

}  // namespace probewright::app
