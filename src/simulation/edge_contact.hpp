#pragma once

#include <optional>

#include "simulation/contact_search.hpp"
#include "simulation/cutting_edges.hpp"

/// When a cutter that stands or turns first touches a solid with one of its edges.
namespace probewright::simulation {

/// How the spindle turns the cutter.
struct Spin {
  double degrees = 0;           ///< at `since`
  double since = 0;             ///< seconds, clock of the machine
  double degreesPerSecond = 0;  ///< about Z of the cutter
  double at(double seconds) const { return degrees + degreesPerSecond * (seconds - since); }
};

struct EdgeContact {
  double fraction = 0;  ///< of the motion
  double degrees = 0;   ///< of the spindle
  std::size_t edge = 0;
  Vector3 place = Vector3::Zero();  ///< frame of the solid
  Vector3 normal = Vector3::UnitZ();
};

/// The first touch of the motion: the axes move as their profile says while the spindle turns, and of all points of all
/// edges the first that enters the solid counts. Found to about 1e-7 mm of the path; a touch that lasts less than 1e-4
/// rad of a turn may be missed. Throws SearchStopped.
std::optional<EdgeContact> firstEdgeContact(const Motion& motion, const CuttingEdges& edges, const Spin& spin,
                                            const DistanceSolid& solid, const Pose& solidFromTable,
                                            const std::stop_token& stop);

}  // namespace probewright::simulation
