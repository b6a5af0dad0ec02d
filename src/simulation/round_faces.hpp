#pragma once

#include <vector>

#include "simulation/analytic_surface.hpp"
#include "simulation/solid.hpp"

namespace probewright::simulation {

/// A hole or a stud.
struct RoundFace {
  AnalyticSurface form;              ///< a cylinder, in the solid's frame
  Vector3 middle = Vector3::Zero();  ///< on its axis, half way between its ends
  bool hole = false;                 ///< the material lies outside
};

/// All cylinders of a solid from CAD, each once where CAD has cut them; none of other solids.
std::vector<RoundFace> roundFaces(const Solid& solid);

}  // namespace probewright::simulation
