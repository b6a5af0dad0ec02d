#include "session/host_files.hpp"

#include <algorithm>

#include "base/file.hpp"
#include "base/text.hpp"

namespace probewright::session {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> foldersOf(const fs::path& program, const control::Beliefs& beliefs) {
  std::vector<fs::path> folders{program.has_parent_path() ? program.parent_path() : fs::path(".")};
  if (!beliefs.tables.empty()) folders.push_back(beliefs.tables);
  return folders;
}

bool sameName(const std::string& a, const std::string& b) { return std::ranges::equal(a, b, {}, upper, upper); }

}  // namespace

HostFiles::HostFiles(const fs::path& program, const control::Beliefs& beliefs)
    : folders_(foldersOf(program, beliefs)),
      files_(
          {""}, [](const fs::path&) { return fail("no program"); }, folders_),
      inputs_{program.filename().string(), fs::path(beliefs.file).filename().string()} {}

Result<std::string> HostFiles::read(const std::string& name) {
  const auto path = name.find("..") == std::string::npos ? files_.find(name, nullptr) : std::nullopt;
  if (!path) {
    return fail("there is no such file in the folder of the program or among the tables of the setup",
                "programs read files of their own folder, of the folders in it, and of the setup's tables");
  }
  return readAt(*path);
}

Result<std::string> HostFiles::readAt(const fs::path& path) {
  std::error_code error;
  const auto isAbove = [&](const fs::path& folder) { return language::liesWithin(path, folder); };
  if (!fs::is_regular_file(path, error) || std::ranges::none_of(folders_, isAbove))
    return fail("there is no such file in the folder of the program or among the tables of the setup");
  used_.insert(path);
  return readFile(path, largestText);
}

bool HostFiles::isInput(const std::string& name) const {
  return std::ranges::any_of(inputs_, [&](const std::string& each) { return !each.empty() && sameName(each, name); });
}

}  // namespace probewright::session
