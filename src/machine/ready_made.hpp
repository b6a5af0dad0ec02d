#pragma once

#include <string_view>
#include <vector>

namespace probewright::machine {

/// A file of the folder machines/, built into the program.
struct ReadyMade {
  std::string_view name;  ///< the file's name without its ending
  std::string_view toml;
};

/// All of them, in alphabetical order of their names.
const std::vector<ReadyMade>& readyMade();

}  // namespace probewright::machine
