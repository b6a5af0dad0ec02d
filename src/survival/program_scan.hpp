#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "control/control_kind.hpp"
#include "control/journal.hpp"

/// Programs whose motion can be bounded: what they do with what they measure is done by their cycles alone.
namespace probewright::survival {

/// Why the motion of a program cannot be bounded, and where.
struct Obstacle {
  std::string why;
  SourcePlace place;
};

/// Reads the program, whatever it would do: it may compute, branch and loop with numbers that it sets itself, but with
/// nothing else, for that may be a measured value. Nothing if that is so.
std::optional<Obstacle> computesWithResults(const std::string& name, const std::string& text,
                                            control::ControlKind control);

/// The first cycle that has touched something and is not among those whose motion and results are smooth functions of
/// where they touch; nothing if there is none.
std::optional<Obstacle> cycleNotCovered(const control::Journal& journal);

}  // namespace probewright::survival
