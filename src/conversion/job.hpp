#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "language/program.hpp"

namespace probewright::conversion {

/// What the programs that call each other leave to each other, as far as they were found.
struct Job {
  bool shares = false;             ///< the program calls others, or is called by one
  bool called = false;             ///< by another program
  std::set<std::string> programs;  ///< names in capitals of those that were found, but for the program's own
  std::set<int> parameters;        ///< n of the Qn that any of them names
  std::set<int> texts;             ///< n of the QSn that another one names
  std::set<int> results;           ///< n of the _OVR[n] that any of them reads
  std::vector<std::shared_ptr<language::Program>> others;  ///< those of `programs`
};

}  // namespace probewright::conversion
