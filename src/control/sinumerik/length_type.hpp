#pragma once

#include "control/sinumerik/control.hpp"

namespace probewright::control::sinumerik {

/// SD 42950 $SC_TOOL_LENGTH_TYPE = 2: the lengths of all tools act in the axes in which those of turning tools do.
inline bool lengthsAsTurning(const Control& control) { return control.machineData("$SC_TOOL_LENGTH_TYPE") == 2; }

}  // namespace probewright::control::sinumerik
