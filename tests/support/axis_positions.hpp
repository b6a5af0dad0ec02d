#pragma once

#include <algorithm>
#include <initializer_list>

#include "machine/description.hpp"

namespace probewright::testing_support {

/// Axis positions in the order of the machine's axes.
inline machine::AxisPositions positions(std::initializer_list<double> values) {
  machine::AxisPositions result;
  std::copy(values.begin(), values.end(), result.values.begin());
  return result;
}

}  // namespace probewright::testing_support
