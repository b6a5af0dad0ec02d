#pragma once

#include <cmath>
#include <concepts>
#include <limits>

namespace probewright {

/// A number without its decimals: 2 of 2.9, -2 of -2.9. Beyond the range of the integer its nearest end, and 0 of what
/// is not a number: programs and tables can name any.
template <std::integral Integer = int>
Integer truncated(double number) {
  using Limits = std::numeric_limits<Integer>;
  if (std::isnan(number)) return 0;
  // The largest integer itself may not be a double; what is below the next one can be cast.
  if (number >= std::ldexp(1.0, Limits::digits)) return Limits::max();
  if (number <= static_cast<double>(Limits::min())) return Limits::min();
  return static_cast<Integer>(number);
}

}  // namespace probewright
