#pragma once

#include <optional>

#include "control/sinumerik/control.hpp"
#include "machine/machine.hpp"

/// Which probe MEAS=1, MEAS=2 and $A_PROBE[1] mean.
namespace probewright::execution::sinumerik {

/// The probe that is connected to measuring input 1 or 2; nothing where none is. Bits 0 and 16 of MD 52740 say it: as
/// delivered the workpiece probe is at input 1, the tool probe at input 2. Where both share an input it is the
/// workpiece probe while one is in the spindle.
std::optional<machine::Sensor> sensorAt(int input, const control::sinumerik::Control& control);

}  // namespace probewright::execution::sinumerik
