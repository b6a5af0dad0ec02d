#include "execution/sinumerik/measuring_inputs.hpp"

#include "control/sinumerik/measuring_data.hpp"

namespace probewright::execution::sinumerik {

std::optional<machine::Sensor> sensorAt(int input, const control::sinumerik::Control& control) {
  const auto inputOf = [&](int bit) {
    return control::sinumerik::maskBit(control.data, "$MCS_MEA_FUNCTION_MASK", bit) ? 2 : 1;
  };
  const bool workpieceProbe = inputOf(0) == input, toolProbe = inputOf(16) == input;
  if (workpieceProbe && toolProbe)
    return control.tool.isProbe() ? machine::Sensor::TouchProbe : machine::Sensor::ToolTouchProbe;
  if (workpieceProbe) return machine::Sensor::TouchProbe;
  if (toolProbe) return machine::Sensor::ToolTouchProbe;
  return std::nullopt;
}

}  // namespace probewright::execution::sinumerik
