#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "geometry/primitives.hpp"

/// The points of PATTERN DEF: one by one (POS), in a row (ROW), in a grid (PAT), on its edge (FRAME), on a circle
/// (CIRC) or a part of one (PITCHCIRC). Touch probe axis Z.
namespace probewright::language::klartext {

/// The value of a Q parameter named "Q5", "QL3" or "QR2".
using ParameterValue = std::function<double(std::string_view name)>;

/// The points in the order in which they are visited, in the unit of the program: what stands after PATTERN DEF, such
/// as `POS1 (X+25 Y+33.5 Z+0) POS2 (IX+10 Y+6.5 Z+0)` or `CIRC1 (X+25 Y+33 D80 START+45 NUM8 Z+0)`. A grid is visited
/// to and fro, the edge of a grid all around. Fails with the reason where an element is none.
Result<std::vector<Vector3>> patternPoints(std::string_view text, const ParameterValue& parameter);

/// The points of a point table (.PNT), columns X, Y, Z; rows with FADE = Y are left out.
Result<std::vector<Vector3>> pointTable(std::string_view bytes, const std::string& file);

}  // namespace probewright::language::klartext
