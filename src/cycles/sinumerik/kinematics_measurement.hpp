#pragma once

#include "cycles/sinumerik/context.hpp"

/// The two halves of CYCLE996: a ball measured with a rotary axis turned to a position, and what all balls together say
/// of the rotary axes.
namespace probewright::cycles::sinumerik {

/// The call measures the ball that the probe stands above, in the directions of the tool as it stands, whatever frame
/// or transformation is active. It leaves the ball's centre in machine coordinates and the positions of the rotary axes
/// in _OVR[41] to _OVR[71], counts the measurement in _OVR[40], and ends the measuring path above the ball. After the
/// third measurement of an axis the vector to it is there. Alarm 61430 if the measurement before this one is missing.
void measureKinematics(Context& context);

/// Calculates the data set of what was measured, and shows, logs and enters it as the call asks. Alarm 61430 if a
/// measurement is missing, the balls lie badly or a tolerance is exceeded: then nothing is entered.
void calculateKinematics(Context& context);

}  // namespace probewright::cycles::sinumerik
