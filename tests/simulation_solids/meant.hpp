#pragma once

#include <functional>
#include <string>
#include <vector>

#include "simulation/solid.hpp"
#include "worlds.hpp"

/// What the writer of a file means, as distances in closed form, and whether balls meet just that.
namespace probewright::simulation::testing {

/// Of a point from a surface, never negative.
using Distance = std::function<double(const Vector3&)>;

/// The nearest of several.
Distance nearestOf(std::vector<Distance> all);
/// Of a block about the origin of a pose.
Distance distanceOfBlock(const Vector3& size, const Pose& pose);
/// Of a skin on a cylinder about Z, between two heights and two angles (radians).
Distance distanceOfShell(double radius, double z0, double z1, double u0, double u1, const Pose& pose);

/// Sends balls from outside at a solid of about `size` around `middle`; where each way ends must be as far from what is
/// meant as the ball's radius, and no sooner place on the way nearer.
void expectAsMeant(const std::string& name, const Solid& solid, const Distance& distance, double size,
                   const Vector3& middle, std::mt19937_64& random, int ways);
/// The same of a solid in a STEP file.
void expectStepAsMeant(const std::string& name, const std::string& text, const Distance& distance, double size,
                       const Vector3& middle, std::mt19937_64& random, int ways);

/// What is said of a STEP file; empty if it is read in silence.
std::string saidOf(const std::string& text);

}  // namespace probewright::simulation::testing
