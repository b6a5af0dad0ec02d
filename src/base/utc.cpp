#include "base/utc.hpp"

#include <algorithm>
#include <cmath>

namespace probewright {

std::tm utcTime(std::int64_t start, double seconds) {
  constexpr double last = 253402300799;  // 9999-12-31 23:59:59
  const double moment = static_cast<double>(start) + std::round(seconds);
  const auto time = static_cast<std::time_t>(std::isnan(moment) ? 0 : std::clamp(moment, 0.0, last));
  std::tm parts{};
  ::gmtime_r(&time, &parts);
  return parts;
}

}  // namespace probewright
