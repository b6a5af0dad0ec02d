#include "machine/linuxcnc_ini.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "base/file.hpp"
#include "base/text.hpp"

namespace probewright::machine {

namespace fs = std::filesystem;

namespace {

constexpr int deepestInclude = 16;

std::string_view bare(std::string_view line) { return trimmed(line, " \t\r"); }

/// ~ is the user's folder; other relative paths begin at `folder`.
fs::path resolved(std::string_view name, const fs::path& folder) {
  if (name.starts_with("~/")) {
    if (const char* home = std::getenv("HOME")) return fs::path(home) / name.substr(2);
  }
  const fs::path path{std::string(name)};
  return path.is_absolute() ? path : folder / path;
}

/// The number that is all of the text but for a comment.
std::optional<double> numberAt(std::string_view text) {
  const std::string copy(bare(text));
  char* end = nullptr;
  const double value = std::strtod(copy.c_str(), &end);
  if (end == copy.c_str() || !std::isfinite(value)) return std::nullopt;
  const std::string_view rest = bare(end);
  if (!rest.empty() && rest.front() != '#' && rest.front() != ';') return std::nullopt;
  return value;
}

}  // namespace

std::optional<LinuxCncIni> LinuxCncIni::read(const fs::path& path, Diagnostics& diagnostics) {
  LinuxCncIni ini;
  ini.path_ = path;
  std::string section;
  if (!ini.readInto(path, 0, section, diagnostics)) return std::nullopt;
  return ini;
}

bool LinuxCncIni::readInto(const fs::path& path, int depth, std::string& section, Diagnostics& diagnostics) {
  const auto text = readFile(path, largestText);
  if (!text) {
    diagnostics.push_back(text.error());
    return false;
  }
  files_.push_back(path);
  bool good = true;
  std::istringstream lines(*text);
  std::uint64_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    SourcePlace place{path.string(), ++number, 0};
    while (line.ends_with('\\')) {
      line.pop_back();
      std::string more;
      if (!std::getline(lines, more)) break;
      ++number;
      line += more;
    }
    const std::string_view words = bare(line);
    constexpr std::string_view include = "#INCLUDE";
    if (words.starts_with(include) && words.size() > include.size() &&
        (words[include.size()] == ' ' || words[include.size()] == '\t')) {
      const fs::path other = resolved(bare(words.substr(include.size())), path.parent_path());
      if (depth == deepestInclude) {
        diagnostics.push_back(fail(place, "the files include each other without end").value());
        return false;
      }
      const std::size_t before = diagnostics.size();
      good = readInto(other, depth + 1, section, diagnostics) && good;
      // A file that cannot be read at all.
      if (diagnostics.size() > before && diagnostics.back().place.line == 0)
        diagnostics.back().advice = fmt::format("{}:{} includes it", place.file, place.line);
      continue;
    }
    if (words.empty() || words.front() == '#' || words.front() == ';') continue;
    if (words.front() == '[') {
      const std::size_t end = words.find(']');
      if (end == std::string_view::npos) {
        diagnostics.push_back(fail(place, "the name of the section has no ]").value());
        good = false;
        continue;
      }
      section = bare(words.substr(1, end - 1));
      continue;
    }
    const std::size_t equals = words.find('=');
    // LinuxCNC passes over what is not KEY = VALUE.
    if (equals == std::string_view::npos) continue;
    entries_.push_back(
        {section, std::string(bare(words.substr(0, equals))), std::string(bare(words.substr(equals + 1))), place});
  }
  return good;
}

bool LinuxCncIni::hasSection(std::string_view section) const {
  return std::ranges::any_of(entries_, [&](const IniEntry& entry) { return entry.section == section; });
}

const IniEntry* LinuxCncIni::find(std::string_view section, std::string_view key) const {
  const auto found = std::ranges::find_if(
      entries_, [&](const IniEntry& entry) { return entry.section == section && entry.key == key; });
  return found == entries_.end() ? nullptr : &*found;
}

std::vector<const IniEntry*> LinuxCncIni::all(std::string_view section, std::string_view key) const {
  std::vector<const IniEntry*> found;
  for (const IniEntry* entry : all(section))
    if (entry->key == key) found.push_back(entry);
  return found;
}

std::vector<const IniEntry*> LinuxCncIni::all(std::string_view section) const {
  std::vector<const IniEntry*> found;
  for (const IniEntry& entry : entries_)
    if (entry.section == section) found.push_back(&entry);
  return found;
}

std::optional<std::string> LinuxCncIni::text(std::string_view section, std::string_view key) const {
  const IniEntry* entry = find(section, key);
  if (entry == nullptr) return std::nullopt;
  return entry->value;
}

std::optional<double> LinuxCncIni::number(std::string_view section, std::string_view key,
                                          Diagnostics& diagnostics) const {
  const IniEntry* entry = find(section, key);
  if (entry == nullptr) return std::nullopt;
  const auto value = numberAt(entry->value);
  if (!value) {
    diagnostics.push_back(
        fail(entry->place, fmt::format("[{}]{} = {} is not a number", section, key, entry->value)).value());
  }
  return value;
}

namespace {

/// HAL commands of a configuration, one line after another.
class HalReader {
public:
  explicit HalReader(const LinuxCncIni& ini) : ini_(ini) {}

  void command(std::string_view line) {
    std::vector<std::string> words;
    std::istringstream stream{std::string(line)};
    for (std::string word; stream >> word;) {
      if (word.front() == '#') break;
      if (word != "=>" && word != "<=" && word != "<=>") words.push_back(word);
    }
    if (words.size() < 3) return;
    if (words[0] == "setp") {
      if (const auto value = valueOf(words[2])) values_.pins[words[1]] = *value;
    } else if (words[0] == "sets") {
      if (const auto value = valueOf(words[2])) signals_[words[1]] = *value;
    } else if (words[0] == "net" || words[0] == "newsig" || words[0] == "linksp") {
      for (std::size_t i = 2; i < words.size(); ++i)
        net(words[1], words[i]);
    } else if (words[0] == "linkps") {
      net(words[2], words[1]);
    }
  }

  void file(std::string_view name) {
    name = name.substr(0, name.find_first_of(" \t"));  // a .tcl file may have arguments
    if (name.starts_with("LIB:")) {
      values_.complete = false;
      return;
    }
    const fs::path path = resolved(name, ini_.folder());
    const auto text = readFile(path, largestText);
    if (!text) {
      values_.complete = false;
      return;
    }
    values_.files.push_back(path);
    std::istringstream lines(*text);
    for (std::string line; std::getline(lines, line);)
      command(line);
  }

  HalValues result() {
    for (const auto& [pin, signal] : nets_)
      if (const auto found = signals_.find(signal); found != signals_.end()) values_.pins[pin] = found->second;
    return std::move(values_);
  }

private:
  void net(const std::string& signal, const std::string& pin) {
    nets_.emplace_back(pin, signal);
    values_.netted.push_back(pin);
  }

  /// A number, or [SECTION]KEY of the .ini.
  std::optional<double> valueOf(const std::string& word) const {
    if (!word.starts_with('[')) return numberAt(word);
    const std::size_t end = word.find(']');
    if (end == std::string::npos) return std::nullopt;
    std::string key = word.substr(end + 1);
    if (key.size() > 2 && key.front() == '(' && key.back() == ')') key = key.substr(1, key.size() - 2);
    const auto value = ini_.text(word.substr(1, end - 1), key);
    return value ? numberAt(*value) : std::nullopt;
  }

  const LinuxCncIni& ini_;
  HalValues values_;
  std::map<std::string, double> signals_;
  std::vector<std::pair<std::string, std::string>> nets_;
};

}  // namespace

HalValues halValues(const LinuxCncIni& ini) {
  HalReader reader(ini);
  for (const char* key : {"HALFILE", "POSTGUI_HALFILE"})
    for (const IniEntry* entry : ini.all("HAL", key))
      reader.file(entry->value);
  for (const IniEntry* entry : ini.all("HAL", "HALCMD"))
    reader.command(entry->value);
  return reader.result();
}

}  // namespace probewright::machine
