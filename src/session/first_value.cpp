#include "session/first_value.hpp"

#include <algorithm>

namespace probewright::session {

double firstValue(const cycles::Parameter& parameter) {
  if (parameter.standard) return *parameter.standard;
  if (!parameter.choices.empty()) return parameter.choices.front().value;
  return std::clamp(0.0, parameter.minimum, parameter.maximum);
}

}  // namespace probewright::session
