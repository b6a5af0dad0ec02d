#pragma once

#include <optional>
#include <span>
#include <string>

#include "language/block.hpp"

namespace probewright::language::klartext {

struct GlobalMistake {
  std::string message, advice;
};

/// What is wrong with GLOBAL DEF `group` that holds `parameters`: a group that does not exist, or a parameter that 100
/// GENERAL or 120 PROBING do not have. The groups of machining cycles may hold what they like.
std::optional<GlobalMistake> mistakeInGlobalDefinition(int group, std::span<const Word> parameters);

}  // namespace probewright::language::klartext
