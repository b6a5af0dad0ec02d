#pragma once

#include "control/control_kind.hpp"

namespace probewright::language::klartext {

/// What a run makes of an M function.
enum class FunctionEffect {
  CarriedOut,
  Harmless,       ///< spindle, coolant, feed, monitoring: where the tool is does not depend on it
  NotCarriedOut,  ///< the control has it, Probewright does not: named, refused under --strict
  OfBuilder,      ///< the machine has it, or nobody: then it is named, refused under --strict
  OfOtherOne,     ///< the same; on the other HEIDENHAIN control it is the control's own
};

FunctionEffect effectOf(int mFunction, control::ControlKind kind);

}  // namespace probewright::language::klartext
