#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cycles/catalogue.hpp"

/// What does not go together in one call, as far as its values are known before the program runs.
namespace probewright::cycles::heidenhain {

/// The value of a parameter, its default where it is left out; nothing if the program computes it.
using KnownValue = std::function<std::optional<Argument>(std::uint32_t address)>;

struct CallMistake {
  std::uint32_t parameter = 0;  ///< the one to look at
  Severity severity = Severity::Error;
  std::string message, advice;
};

/// Errors are what a run refuses before it touches anything; limits that nothing can keep are warnings.
std::vector<CallMistake> callMistakes(const CycleDefinition& cycle, ControlKind kind, const KnownValue& known);

/// Coordinate transformations that a cycle of the TNC 640 does not run under.
struct ForbiddenTransformations {
  bool shift = false;     ///< cycle 7, TRANS DATUM
  bool rotation = false;  ///< cycle 10
  bool other = false;     ///< cycles 8, 11 and 26
};
ForbiddenTransformations forbiddenTransformations(int cycle);

/// "datum shift, mirror image or scaling is active (cycle 7, 8, 11 or 26)".
std::string transformationsText(const ForbiddenTransformations& forbidden);

}  // namespace probewright::cycles::heidenhain
