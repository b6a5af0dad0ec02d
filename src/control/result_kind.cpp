#include "control/result_kind.hpp"

#include <array>

namespace probewright::control {

namespace {

template <std::size_t N, class Enumerator>
std::string_view nameIn(const std::array<std::string_view, N>& names, Enumerator value) {
  return names.at(static_cast<std::size_t>(value));
}

}  // namespace

std::string_view nameOf(Role role) {
  static constexpr std::array<std::string_view, 11> names = {"status", "setting",    "touch",      "actual",
                                                             "set",    "difference", "lowerLimit", "upperLimit",
                                                             "excess", "correction", "statistic"};
  return nameIn(names, role);
}

std::string_view nameOf(Quantity quantity) {
  static constexpr std::array<std::string_view, 14> names = {
      "",       "coordinate", "centre",     "corner",       "diameter", "radius", "width",
      "length", "angle",      "projection", "eccentricity", "distance", "name",   "scatter"};
  return nameIn(names, quantity);
}

std::string_view nameOf(Along along) {
  static constexpr std::array<std::string_view, 12> names = {"",  "first", "second", "third", "measuring", "normal",
                                                             "X", "Y",     "Z",      "A",     "B",         "table"};
  return nameIn(names, along);
}

std::string_view nameOf(System system) { return system == System::Machine ? "machine" : "workpiece"; }

}  // namespace probewright::control
