#pragma once

#include <CLI/CLI.hpp>
#include <bitset>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "control/control_kind.hpp"
#include "exchange/formats.hpp"
#include "records/job.hpp"

/// Options that several subcommands have.
namespace probewright::app {

/// A subcommand with its options, and what carries it out once they have been read.
struct Subcommand {
  CLI::App* command = nullptr;
  std::function<int()> carryOut;  ///< returns the exit code
};

/// --control of all subcommands.
void addControl(CLI::App& command, std::optional<control::ControlKind>& control);

/// --skip of run and check: "0,3".
void addSkip(CLI::App& command, std::bitset<10>& levels);

/// --export of run: "csv,qif".
void addExport(CLI::App& command, std::vector<const exchange::Format*>& exports);

/// --job of run: "serial=0017".
void addJob(CLI::App& command, records::Job& job);

/// --machine-ini.
void addMachineFile(CLI::App& command, std::filesystem::path& file);

/// --language.
void addLanguage(CLI::App& command, std::string& language, const std::string& about);

/// What is wrong with a number that may not be negative; empty if nothing is. Reading "-1" into an unsigned number
/// would wrap it around.
std::string notNegative(const std::string& text);

/// The same of a number that counts from 1.
std::string fromOne(const std::string& text);

/// What is wrong with a number that must be finite; empty if nothing is. CLI::Range lets NaN through.
std::string finite(const std::string& text);

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

}  // namespace probewright::app
