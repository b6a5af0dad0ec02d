#pragma once

#include "cycles/sinumerik/context.hpp"

namespace probewright::cycles::sinumerik {

/// All of CYCLE971 with 1 or 2 in the units of S_MVAR: measures length or radius of a mill or drill that stands or
/// turns, of the whole tool or edge by edge, and corrects it.
void measureMilledTool(Context& context);

}  // namespace probewright::cycles::sinumerik
