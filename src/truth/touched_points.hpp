#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "control/journal.hpp"
#include "control/working_plane.hpp"
#include "geometry/primitives.hpp"
#include "simulation/analytic_surface.hpp"
#include "simulation/path_record.hpp"
#include "simulation/truth.hpp"

/// The touches of a run, as the control believes them and as they were.
namespace probewright::truth {

/// A touch of a ball on a solid. Coordinates count along main, minor and tool axis of the working plane (`ball`,
/// `surface`, `point`...), in the coordinate system in which the control measured.
struct TouchedPoint {
  std::size_t touch = 0;  ///< its place in the cycle's record
  Vector3 direction = Vector3::UnitX();
  Vector3 ball = Vector3::Zero();                   ///< believed centre
  Vector3 surface = Vector3::Zero();                ///< believed point of contact
  Vector3 point = Vector3::Zero();                  ///< true point of contact
  Vector3 normal = Vector3::UnitZ();                ///< true outward normal there
  std::size_t solid = 0;                            ///< its place in Truth::solids
  std::optional<simulation::AnalyticSurface> face;  ///< the exact surface that was touched
  Eigen::Affine3d planeFromTable = Eigen::Affine3d::Identity();
};

/// A cycle's touches, and the plane that they count in.
struct TouchedCycle {
  control::WorkingPlane plane;
  std::vector<TouchedPoint> points;
};

/// One for each cycle of the journal. Touches of tools, and touches that the path does not know, are left out.
std::vector<TouchedCycle> touchedCycles(const control::Journal& journal, const simulation::Truth& truth,
                                        const simulation::PathRecord& path);

/// The same points in the coordinates of the machine, which are those of its table with all rotary axes at 0.
TouchedCycle inMachine(TouchedCycle cycle);

/// True if both touched the same surface: faces that CAD has cut count as one.
bool sameFace(const TouchedPoint& a, const TouchedPoint& b);

/// "plane", "cylinder"...
std::string nameOf(simulation::AnalyticSurface::Kind kind);

}  // namespace probewright::truth
