#pragma once

#include "control/control_kind.hpp"

namespace probewright::language::klartext {

/// True if FN 18 can read the datum `number` of the group `id` on this control; whether there is an entry under its
/// index is known in the run only.
bool canRead(int id, int number, control::ControlKind kind);
/// The same of FN 17.
bool canWrite(int id, int number, control::ControlKind kind);

}  // namespace probewright::language::klartext
