#pragma once

#include <string>

#include "geometry/primitives.hpp"

/// What the call of a cycle says of the feature that it is to find.
namespace probewright::truth {

/// A hole or a stud, in workpiece coordinates.
struct ExpectedRound {
  Vector3 centre = Vector3::Zero();  ///< at the measuring height, as far as the call tells it
  double diameter = 0;
  std::string from;  ///< the parameters that say where: "Q321/Q322"; or what else does: "the start position"
};

/// How to let a measuring move go further: "DIST", "S_FA".
struct Reach {
  std::string name;
  double now = 0;          ///< its value, mm
  bool ofProgram = false;  ///< it counts in the unit of the program, not in mm as the tables of the control do
};

}  // namespace probewright::truth
