#pragma once

#include "simulation/touch_proof.hpp"

/// Newton's method on free-form surfaces. No step is longer than `extent`, in each parameter.
namespace probewright::simulation {

/// Moves `at` to the parameters of the surface's point nearest to p, starting nearby. False if that does not settle.
bool projectOntoSurface(const FreeformSurface& surface, const Vector3& p, const Vector2& extent, Vector2& at);

/// Moves `at` and `when` to a place where a ball on its way touches the surface. False if that does not settle, or
/// leaves a box, if there is one.
bool solveSurfaceTouch(const FreeformSurface& surface, const Way& way, double radius, const Vector2& extent,
                       const ParameterBox* within, Vector2& at, double& when);

}  // namespace probewright::simulation
