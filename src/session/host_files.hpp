#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "language/directory_library.hpp"
#include "simulation/setup.hpp"

namespace probewright::session {

/// The files that a running program may read by name: those of its own folder and below, and those of the setup's
/// tables. Names are taken as on the control: capital and small letters are the same, folders may be left out.
class HostFiles {
public:
  HostFiles(const std::filesystem::path& program, const simulation::Setup& setup);

  Result<std::string> read(const std::string& name) const;
  /// True if the run itself reads a file of this name: the program or the setup.
  bool isInput(const std::string& name) const;

private:
  language::DirectoryLibrary files_;
  std::vector<std::string> inputs_;
};

}  // namespace probewright::session
