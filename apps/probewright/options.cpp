#include "options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "session/control_family.hpp"

namespace probewright::app {

void addControl(CLI::App& command, std::optional<control::ControlKind>& control) {
  const auto& families = session::knownFamilies();
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

void addExport(CLI::App& command, std::vector<const exchange::Format*>& exports) {
  std::vector<std::string_view> names;
  std::string files;
  for (const auto& format : exchange::formats()) {
    names.push_back(format.name);
    files += fmt::format("{}{}: {}", files.empty() ? "" : "; ", format.name, format.about);
  }
  const std::string known = fmt::format("{}", fmt::join(names, ", "));
  command
      .add_option_function<std::vector<std::string>>(
          "--export",
          [&exports, known](const std::vector<std::string>& words) {
            for (const std::string& word : words) {
              const auto* format = exchange::formatNamed(word);
              if (format == nullptr) throw CLI::ValidationError("--export", word + " is not one of " + known);
              if (std::find(exports.begin(), exports.end(), format) == exports.end()) exports.push_back(format);
            }
          },
          "Files for other programs, into the folder of --out; several with commas. " + files)
      ->type_name("FORMATS")
      ->delimiter(',');
}

void addJob(CLI::App& command, records::Job& job) {
  std::string known;
  for (const auto& field : records::jobFields)
    known += (known.empty() ? "" : ", ") + std::string(field.name);
  command
      .add_option_function<std::vector<std::string>>(
          "--job",
          [&job, known](const std::vector<std::string>& words) {
            for (const std::string& word : words) {
              const std::size_t sign = std::min(word.find('='), word.size());
              const auto& fields = records::jobFields;
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

void addMachineFile(CLI::App& command, std::filesystem::path& file) {
  command
      .add_option(
          "--machine-ini", file,
          "Simulate this machine instead of the setup's: the .ini file of a LinuxCNC configuration, or a machine "
          "file (see docs/linuxcnc.md)")
      ->type_name("FILE");
}

std::string notNegative(const std::string& text) {
  const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  return digits && text.size() <= 19 ? std::string() : text + " is not a whole number of 0 or more";
}

std::string fromOne(const std::string& text) {
  const bool isZero = text.find_first_not_of('0') == std::string::npos;
  return isZero || !notNegative(text).empty() ? text + " is not a whole number of 1 or more" : std::string();
}

std::string finite(const std::string& text) {
  double value = 0;
  const bool read = CLI::detail::lexical_cast(text, value);
  return read && std::isfinite(value) ? std::string() : text + " is not a number";
}

void addLanguage(CLI::App& command, std::string& language, const std::string& about) {
  std::vector<std::pair<std::string, std::string>> codes;
  for (const char* code : {"en", "de", "ru", "sv", "zh", "pl"})
    codes.emplace_back(code, code);
  addChoice(command, "--language", language, codes, about).default_str("en");
}

}  // namespace probewright::app
