#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

namespace probewright::records {

/// A number as JSON has it: null for what is none (infinite, not a number), 0 for both zeros.
inline nlohmann::json jsonNumber(double value) {
  if (!std::isfinite(value)) return nullptr;
  return value == 0 ? 0.0 : value;
}

/// The same for every number in `value`, whatever order its objects keep.
template <class Json>
void clearNegativeZeros(Json& value) {
  if (value.is_structured()) {
    for (Json& each : value)
      clearNegativeZeros(each);
  } else if (value.is_number_float() && value == 0.0) {
    value = 0.0;
  }
}

}  // namespace probewright::records
