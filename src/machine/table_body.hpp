#pragma once

#include <optional>
#include <string>

#include "base/diagnostic.hpp"
#include "geometry/primitives.hpp"

namespace probewright::machine {

/// What carries the workpiece, as something that can be run into: the table of a mill, the chuck of a lathe. Table
/// frame.
struct TableBody {
  std::string name = "table";         ///< for messages
  Vector3 centre = Vector3::Zero();   ///< of its surface, mm
  Vector3 normal = Vector3::UnitZ();  ///< unit, from the surface to where the workpiece lies
  Vector2 size = Vector2::Zero();     ///< of a rectangle: along X and, with an upright normal, Y of the table, mm
  double diameter = 0;                ///< above 0 it is round
  double thickness = 100;             ///< below the surface, mm
};

/// [table] of the machine that readMachine() reads, or nothing if it has none. Fails where readMachine() does.
Result<std::optional<TableBody>> readTableBody(const std::string& nameOrPath);

}  // namespace probewright::machine
