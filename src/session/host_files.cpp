#include "session/host_files.hpp"

#include <algorithm>
#include <cctype>

#include "base/file.hpp"

namespace probewright::session {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> foldersOf(const fs::path& program, const simulation::Setup& setup) {
  std::vector<fs::path> folders{program.has_parent_path() ? program.parent_path() : fs::path(".")};
  if (!setup.tables.empty()) folders.push_back(setup.tables);
  return folders;
}

bool sameName(const std::string& a, const std::string& b) {
  return std::ranges::equal(a, b, [](unsigned char x, unsigned char y) { return std::toupper(x) == std::toupper(y); });
}

}  // namespace

HostFiles::HostFiles(const fs::path& program, const simulation::Setup& setup)
    : files_(
          {""}, [](const fs::path&) { return fail("no program"); }, foldersOf(program, setup)),
      inputs_{program.filename().string(), fs::path(setup.file).filename().string()} {}

Result<std::string> HostFiles::read(const std::string& name) const {
  constexpr std::uintmax_t largest = 64U << 20U;
  const auto path = name.find("..") == std::string::npos ? files_.find(name, nullptr) : std::nullopt;
  if (!path) {
    return fail("there is no such file in the folder of the program or among the tables of the setup",
                "programs read files of their own folder, of the folders in it, and of the setup's tables");
  }
  std::error_code error;
  if (fs::file_size(*path, error) > largest || error) return fail("the file is too large");
  return readFile(*path);
}

bool HostFiles::isInput(const std::string& name) const {
  return std::ranges::any_of(inputs_, [&](const std::string& each) { return !each.empty() && sameName(each, name); });
}

}  // namespace probewright::session
