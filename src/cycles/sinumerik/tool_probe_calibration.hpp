#pragma once

#include "cycles/sinumerik/context.hpp"

namespace probewright::cycles::sinumerik {

/// All of CYCLE971 with 0 in the units of S_MVAR: finds the trigger points of a tool touch probe with a tool of known
/// size, of one axis or of all that may be touched.
void calibrateToolProbe(Context& context);

}  // namespace probewright::cycles::sinumerik
