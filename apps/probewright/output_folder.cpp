#include "output_folder.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/file.hpp"

namespace probewright::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* resultsName = "results.json";
constexpr const char* reportName = "report.html";

/// A list in a file may hold anything: only plain names of files in the folder itself count.
bool isPlainName(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find_first_of("/\\") == std::string::npos &&
         name.find('\0') == std::string::npos;
}

}  // namespace

std::vector<fs::path> leftByEarlierRun(const fs::path& folder) {
  std::vector<fs::path> left;
  const Result<std::string> text = readFile(folder / resultsName);
  if (!text) return left;
  const auto results = nlohmann::json::parse(*text, nullptr, false);
  if (!results.is_object() || results.value("schema", nlohmann::json()) != "probewright results") return left;
  const auto files = results.find("files");
  if (files == results.end() || !files->is_array()) return left;
  for (const auto& file : *files) {
    if (!file.is_string() || !isPlainName(file.get<std::string>())) continue;
    std::error_code error;
    const fs::path path = folder / file.get<std::string>();
    if (fs::is_regular_file(fs::symlink_status(path, error))) left.push_back(path);
  }
  return left;
}

Result<void> writeOutput(const fs::path& folder, const std::map<std::string, std::string>& files) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    return fail({folder.string(), 0, 0}, "the output folder cannot be made: " + error.message(),
                "name another folder with --out");
  }
  const std::vector<fs::path> left = leftByEarlierRun(folder);
  std::vector<std::pair<fs::path, std::string_view>> all;
  for (const auto& [name, text] : files)
    all.emplace_back(folder / name, text);
  if (Result<void> written = writeFilesTogether(all); !written) return written;
  for (const fs::path& path : left) {
    if (!files.contains(path.filename().string())) fs::remove(path, error);
  }
  return {};
}

void removeEarlierVerdict(const fs::path& folder) {
  std::error_code error;
  const Result<std::string> results = readFile(folder / resultsName);
  if (!results || results->find("\"probewright results\"") == std::string::npos) return;
  for (const char* name : {resultsName, reportName})
    fs::remove(folder / name, error);
}

void removeEarlierRun(const fs::path& folder, const fs::path& tables) {
  std::error_code error;
  const bool begins = !tables.empty() && fs::equivalent(folder, tables, error);
  if (!begins) {
    for (const fs::path& path : leftByEarlierRun(folder))
      fs::remove(path, error);
  }
  removeEarlierVerdict(folder);
}

}  // namespace probewright::app
