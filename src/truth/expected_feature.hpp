#pragma once

#include <optional>
#include <string>

#include "control/control_kind.hpp"
#include "control/journal.hpp"
#include "geometry/primitives.hpp"

/// What the call of a cycle says of the feature that it is to find.
namespace probewright::truth {

/// A hole or a stud, in workpiece coordinates.
struct ExpectedRound {
  Vector3 centre = Vector3::Zero();  ///< at the measuring height, as far as the call tells it
  double diameter = 0;
  std::string from;  ///< the parameters that say where: "Q321/Q322"; or what else does: "the start position"
};

/// Nothing for cycles that look for something else. `tool`: the axis of the workpiece system that the tool lies along,
/// 0 to 2. SINUMERIK cycles begin in the middle of the feature: `start` is where.
std::optional<ExpectedRound> expectedRound(const control::CycleRecord& cycle, int tool, const Vector3& start);

/// How to let a measuring move go further: "DIST", "S_FA".
struct Reach {
  std::string name;
  double now = 0;  ///< its value
};

/// `way`: of the measuring move.
Reach reachOf(const control::CycleRecord* cycle, double way, control::ControlKind control);

}  // namespace probewright::truth
