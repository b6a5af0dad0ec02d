#pragma once

#include "cycles/heidenhain/parameters.hpp"
#include "cycles/heidenhain/probe_words.hpp"

/// Parameters of the cycles in the old block form, which have no Q numbers.
namespace probewright::cycles::heidenhain::parameters {

inline constexpr Choice axisChoices[] = {{0, "X"}, {1, "Y"}, {2, "Z"}};

constexpr Parameter resultParameter(std::string_view name) {
  return {.name = name,
          .address = probe_word::result,
          .meaning = "number of the Q parameter for the result",
          .kind = ValueKind::Integer,
          .minimum = 0,
          .maximum = 1999};
}

constexpr Parameter probingAxis(std::string_view name) {
  return option(probe_word::axis, name, "probing axis", axisChoices);
}

constexpr Parameter probingAngle(std::string_view name) {
  return angle(probe_word::angle, name, "probing angle from the probing axis", -180, 180);
}

/// Coordinate of the pre-position; what is left out stays where it is.
constexpr Parameter prePosition(std::string_view name, std::uint32_t axis) {
  return {.name = name,
          .address = probe_word::coordinate + axis,
          .meaning = "pre-position",
          .kind = axis < 3 ? ValueKind::Length : ValueKind::Angle,
          .standard = 0};
}

}  // namespace probewright::cycles::heidenhain::parameters
