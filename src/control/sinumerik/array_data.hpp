#pragma once

#include <string_view>

/// Machine and setting data that are arrays. Without an index the control reads and writes their element 0.
namespace probewright::control::sinumerik {

/// True for the name of such a datum, in capitals: $SNS_MEA_WP_BALL_DIAM, $MC_GCODE_RESET_VALUES.
bool isArrayDatum(std::string_view name);

}  // namespace probewright::control::sinumerik
