#pragma once

#include "control/sinumerik/control.hpp"
#include "control/sinumerik/tool_data.hpp"

namespace probewright::control::sinumerik {

/// SD 42950 $SC_TOOL_LENGTH_TYPE.
inline LengthType lengthType(const Control& control) {
  return control.machineData("$SC_TOOL_LENGTH_TYPE") == 2 ? LengthType::AsTurning : LengthType::ByToolType;
}

}  // namespace probewright::control::sinumerik
