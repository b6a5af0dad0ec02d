#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "console.hpp"
#include "guard.hpp"
#include "subcommands.hpp"
#include "terminal.hpp"

namespace {

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
        !probewright::isDigit(word[1]))
      return fmt::format("{} has no option {}; if it is the name of a file, write ./{}", first, word, word);
    if (!word.starts_with("--")) continue;
    const std::string name = word.substr(0, word.find('='));
    if (command->get_option_no_throw(name) == nullptr) {
      return fmt::format("{} has no option {}; `probewright {} --help` lists them", first, name, first);
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

  using namespace probewright::app;
  // In the order of the help.
  std::vector<Subcommand> subcommands;
  for (const auto add : {addRun, addCheck, addCycles, addCompare, addProject, addCamera, addConvert, addMachine,
                         addStudy, addSurvive, addFeel})
    subcommands.push_back(add(app));

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (const std::string word = error.get_exit_code() == 0 ? "" : unknownWord(app, argc, argv); !word.empty()) {
      std::fputs(("probewright: " + printable(word) + "\n").c_str(), stderr);
      return 2;
    }
    std::ostringstream help, mistake;
    const bool fine = app.exit(error, help, mistake) == 0;
    put(help.str(), stdout);
    put(mistake.str(), stderr);
    return outputArrived() && fine ? 0 : 2;
  }
  const auto asked = std::ranges::find_if(subcommands, [](const Subcommand& each) { return each.command->parsed(); });
  const int exit = guarded(asked->carryOut);
  // Whoever asked for an answer must learn that it did not come; an alarm or an error says more.
  return outputArrived() || exit > 2 ? exit : 2;
}
