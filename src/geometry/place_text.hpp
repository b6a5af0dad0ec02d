#pragma once

#include <fmt/format.h>

#include <string>

#include "base/number_text.hpp"
#include "geometry/primitives.hpp"

namespace probewright {

/// "X+1.000 Y-2.500 Z+0.000": a place in messages, mm.
inline std::string placeText(const Vector3& place) {
  return fmt::format("X{} Y{} Z{}", formatSigned(place.x(), 3), formatSigned(place.y(), 3), formatSigned(place.z(), 3));
}

}  // namespace probewright
