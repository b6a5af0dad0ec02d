#pragma once

#include <optional>

#include "control/control_kind.hpp"

namespace probewright::language::klartext {

/// True if FN 18 can read the datum `number` of the group `id` on this control. `index`: 0 if the block has none,
/// nothing if it is computed. Whether a table has the row and the machine the axis is known in the run only.
bool canRead(int id, int number, std::optional<int> index, control::ControlKind kind);
/// The same of FN 17.
bool canWrite(int id, int number, std::optional<int> index, control::ControlKind kind);

/// True if FN 17 can write this value as the type of a tool (ID50 NR36).
constexpr bool isToolType(double value) { return value == 0 || value == 21; }

}  // namespace probewright::language::klartext
