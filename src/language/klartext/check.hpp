#pragma once

#include "control/control_kind.hpp"
#include "language/klartext/heidenhain_program.hpp"

namespace probewright::language::klartext {

/// All mistakes of a program, in the order of their lines, without running it: blocks that cannot be read or that the
/// control marked with ERROR =, labels that are missing or defined twice, a missing beginning or end of the program,
/// and in measuring cycles parameters that the cycle of this control does not have, lacks, or cannot take. Warnings for
/// what can be run but not simulated, and for programs that are called or selected by name and that `library` does not
/// have; null: they are not looked for.
/// Blocks that begin with "/" are left out if `skips`. `foresees`: also what a run refuses when it gets to a cycle,
/// such as values that do not go together; a run says so itself, and may never get there.
Diagnostics checkProgram(HeidenhainProgram& program, control::ControlKind kind, ProgramLibrary* library = nullptr,
                         bool skips = false, bool foresees = true);

}  // namespace probewright::language::klartext
