#include "cycles/sinumerik/turning_touches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "control/sinumerik/measuring_data.hpp"

namespace probewright::cycles::sinumerik {

std::vector<TurningTouch> turningTouches(const control::sinumerik::DataStore& data, double radius) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto datum = [&](const char* name) { return data.number(name, {0}); };
  const auto limit = [&](const char* name) { return datum(name) > 0 ? datum(name) : infinity; };
  const double peripheral = limit("$SNS_MEA_CM_MAX_PERI_SPEED");
  const double speed =
      std::min(peripheral / (2 * std::numbers::pi * radius * 0.001), limit("$SNS_MEA_CM_MAX_REVOLUTIONS"));
  const double accuracy = datum("$SNS_MEA_CM_MEASURING_ACCURACY");
  const double most = limit("$SNS_MEA_CM_MAX_FEEDRATE"), least = std::min(datum("$SNS_MEA_CM_MIN_FEEDRATE"), most);
  const auto limited = [&](double feed) { return std::clamp(feed, least, most); };
  if (!std::isfinite(speed) || !(speed > 0) || !(limited(speed * accuracy) > 0)) return {};

  std::vector<TurningTouch> touches;
  const double first = datum("$SNS_MEA_CM_FEEDFACTOR_1"), second = datum("$SNS_MEA_CM_FEEDFACTOR_2");
  const double feed = limited(speed * accuracy);
  if (first > 0) touches.push_back({speed, limited(feed * first)});
  if (first > 0 && second > 0) touches.push_back({speed, limited(feed * second)});
  TurningTouch last = {speed, feed};
  if (!touches.empty() && !maskBit(data, "$SNS_MEA_FUNCTION_MASK", 19)) {
    // Not so slow that the smallest feed would follow the edge by more than the accuracy.
    const double needed = accuracy > 0 ? least / accuracy : 0;
    last.speed = std::max(speed / 2, std::min(speed, needed));
    last.feed = limited(last.speed * accuracy);
  }
  touches.push_back(last);
  return touches;
}

}  // namespace probewright::cycles::sinumerik
