#pragma once

#include <optional>

#include "simulation/analytic_surface.hpp"
#include "simulation/solid.hpp"

namespace probewright::simulation {

/// The closed form of the face of a solid from CAD that passes through `point` (to 1e-5 mm) with the outward normal
/// `normal` (to 0.1 degrees), in the solid's frame. Nothing where the point lies on an edge or on a free form, and of
/// other solids.
std::optional<AnalyticSurface> faceAt(const Solid& solid, const Vector3& point, const Vector3& normal);

}  // namespace probewright::simulation
