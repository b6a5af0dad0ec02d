#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "control/beliefs.hpp"
#include "language/directory_library.hpp"

namespace probewright::session {

/// The files that a running program may read by name: those of its own folder and below, and those of the setup's
/// tables. Names are taken as on the control: capital and small letters are the same, folders may be left out.
class HostFiles {
public:
  HostFiles(const std::filesystem::path& program, const control::Beliefs& beliefs);

  Result<std::string> read(const std::string& name);
  /// The file at `path`, which must be one of those.
  Result<std::string> readAt(const std::filesystem::path& path);
  /// True if the run itself reads a file of this name: the program or the setup.
  bool isInput(const std::string& name) const;

  /// The folder of the main program, never empty.
  const std::filesystem::path& folder() const { return folders_.front(); }
  /// What was read, and which programs were opened.
  const std::set<std::filesystem::path>& used() const { return used_; }
  void note(const std::filesystem::path& path) { used_.insert(path); }

private:
  std::vector<std::filesystem::path> folders_;
  std::set<std::filesystem::path> used_;
  language::DirectoryLibrary files_;
  std::vector<std::string> inputs_;
};

}  // namespace probewright::session
