#pragma once

#include <string>
#include <string_view>

namespace probewright::language::sinumerik {

/// What is known of the name of a system variable.
enum class SystemName {
  Simulated,  ///< it has its meaning here
  Elsewhere,  ///< the control has it, or may have it; here it is only kept: reads as 0 unless a value was given
  Missing,    ///< the control has no such variable
};

/// `name` in capitals, without indices: "$P_UIFR", "$SNS_MEA_WP_BALL_DIAM".
SystemName systemName(std::string_view name);

/// The name that is most likely meant by one that is missing; empty if none is close.
std::string meantSystemName(std::string_view name);

}  // namespace probewright::language::sinumerik
