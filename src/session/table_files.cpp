#include "session/table_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "base/file.hpp"
#include "base/text.hpp"

namespace probewright::session {

namespace fs = std::filesystem;

std::vector<fs::path> tableFiles(const fs::path& folder, Diagnostics& diagnostics) {
  std::vector<fs::path> files;
  if (folder.empty()) return files;
  std::error_code error;
  std::map<std::string, fs::path> tables;  // by their names in capitals, which the control knows them by
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    static constexpr std::array<std::string_view, 15> endings = {".T",   ".TP",   ".PR",  ".TRN", ".TAB",
                                                                 ".D",   ".3DTC", ".KD",  ".KCO", ".VSC",
                                                                 ".INI", ".TOA",  ".UFR", ".GUD", ".DEF"};
    const fs::path& path = entry.path();
    const bool isTable = std::ranges::find(endings, upperCase(path.extension().string())) != endings.end();
    if (entry.is_regular_file(error)) {
      files.push_back(path);
      if (!isTable) continue;
      const auto [other, isNew] = tables.emplace(upperCase(path.filename().string()), path);
      if (isNew) continue;
      diagnostics.push_back({Severity::Error,
                             {path.string(), 0, 0},
                             fmt::format("the control knows this table and {} by one name", other->second.string()),
                             {},
                             "remove one of the two",
                             {}});
    } else if (isTable) {
      const char* what = fs::is_directory(path, error) ? "a folder"
                         : fs::exists(path, error)     ? "not a file"
                                                       : "a symbolic link that leads nowhere";
      diagnostics.push_back({Severity::Error,
                             {path.string(), 0, 0},
                             fmt::format("this has the name of a table, but it is {}", what),
                             {},
                             "put the table there, or rename it",
                             {}});
    }
  }
  std::ranges::sort(files);
  return files;
}

std::optional<std::string> contents(const fs::path& path, Diagnostics& diagnostics) {
  Result<std::string> text = readFile(path);
  if (!text) {
    diagnostics.push_back(text.error());
    return std::nullopt;
  }
  return std::move(*text);
}

}  // namespace probewright::session
