#pragma once

#include "control/control_kind.hpp"

namespace probewright::language::klartext {

/// What a run makes of an M function.
enum class FunctionEffect {
  CarriedOut,
  Harmless,       ///< spindle, coolant, feed, monitoring: where the tool is does not depend on it
  NotCarriedOut,  ///< the control has it, Probewright does not: named, refused under --strict
  OfBuilder,      ///< the machine tool builder gives it its meaning: named, refused under --strict
  OfOtherOne,     ///< only the other HEIDENHAIN control has it: named, refused under --strict
};

FunctionEffect effectOf(int mFunction, control::ControlKind kind);

}  // namespace probewright::language::klartext
