#pragma once

#include <cstdint>
#include <ctime>

namespace probewright {

/// Date and time of day, UTC, `seconds` after `start` (seconds since 1970). What lies outside of the years 1970 to
/// 9999 becomes the nearest moment that does not.
std::tm utcTime(std::int64_t start, double seconds);

}  // namespace probewright
