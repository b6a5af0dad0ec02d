#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"

/// The text of a LinuxCNC configuration: its .ini, what that includes, and which values its HAL files give to pins.
namespace probewright::machine {

/// KEY = VALUE of a section, as it is written, with its place.
struct IniEntry {
  std::string section, key, value;
  SourcePlace place;
};

/// An .ini file as LinuxCNC reads it: case counts, keys may be there several times, lines of `#INCLUDE FILE` are
/// replaced by that file, a `\` at the end of a line continues it.
class LinuxCncIni {
public:
  /// Mistakes go to `diagnostics`: a file that cannot be read, a line that is nothing.
  static std::optional<LinuxCncIni> read(const std::filesystem::path& path, Diagnostics& diagnostics);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path folder() const { return path_.parent_path(); }
  const std::vector<std::filesystem::path>& files() const { return files_; }  ///< all that were read
  bool hasSection(std::string_view section) const;

  /// The first entry of that name, which is the one that LinuxCNC takes; null if there is none.
  const IniEntry* find(std::string_view section, std::string_view key) const;
  std::vector<const IniEntry*> all(std::string_view section, std::string_view key) const;
  std::vector<const IniEntry*> all(std::string_view section) const;
  /// Its value; nothing if there is none.
  std::optional<std::string> text(std::string_view section, std::string_view key) const;
  /// The number at the beginning of the value; nothing if there is none. A value that is not a number is reported.
  std::optional<double> number(std::string_view section, std::string_view key, Diagnostics& diagnostics) const;

private:
  bool readInto(const std::filesystem::path& path, int depth, std::string& section, Diagnostics& diagnostics);

  std::filesystem::path path_;
  std::vector<std::filesystem::path> files_;
  std::vector<IniEntry> entries_;
};

/// What the HAL files and commands of a configuration say, as far as it can be known without running them.
struct HalValues {
  std::map<std::string, double> pins;  ///< by setp, and by sets of the signal that a pin is netted to
  std::vector<std::string> netted;     ///< all pins that are named in net, linkps and the like
  bool complete = true;                ///< false: a file of LinuxCNC's own library or one that is missing was not read
  std::vector<std::filesystem::path> files;
};
HalValues halValues(const LinuxCncIni& ini);

}  // namespace probewright::machine
