#pragma once

#include "execution/sinumerik/motion.hpp"
#include "geometry/primitives.hpp"

namespace probewright::execution::sinumerik {

/// The speed of the main spindle in revolutions a minute while the tool is at `tip` (program coordinates). With
/// constant cutting speed (G96, G961, G962) it follows from S in m/min and the diameter in X, up to LIMS.
double spindleSpeedAt(const MotionState& state, const ProgramPlace& tip);

/// G93 to G97, G961 to G973: kind of feed and of spindle speed. Leaving constant cutting speed freezes the speed at
/// `tip`, except G973, which goes back to what S said before, and blocks that have an S of their own.
void setFeedType(MotionState& state, int function, const ProgramPlace& tip, bool blockHasSpeed);

}  // namespace probewright::execution::sinumerik
