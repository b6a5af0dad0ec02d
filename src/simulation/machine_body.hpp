#pragma once

#include <memory>
#include <string>

#include "geometry/primitives.hpp"
#include "machine/links.hpp"
#include "simulation/solid.hpp"

namespace probewright::simulation {

/// A body that the machine is built of: a trunnion, a column, the housing of the spindle.
struct MachineBody {
  std::string name;  ///< for messages: "trunnion"; bodies of one link may share it
  machine::Link link;
  std::shared_ptr<const Solid> solid;
  Pose linkFromSolid = Pose::Identity();  ///< a link's frame is the base frame where all axes read 0
};

}  // namespace probewright::simulation
