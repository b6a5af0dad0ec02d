#pragma once

#include <memory>

#include "simulation/analytic_surface.hpp"
#include "simulation/solid.hpp"

namespace probewright::simulation {

/// True if both are the same surface without borders, to 1e-6 mm and 1e-9 in direction.
bool sameSurface(const AnalyticSurface& a, const AnalyticSurface& b);

/// A skin of all faces of a solid from CAD but those that lie on `face` (in the solid's frame). Null if nothing is
/// left, and for other solids.
std::shared_ptr<const Solid> otherFaces(const Solid& solid, const AnalyticSurface& face);

}  // namespace probewright::simulation
