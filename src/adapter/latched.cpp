#include "adapter/latched.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace probewright::adapter {
namespace {

using machine::AxisPositions;

/// How far a place lies from a straight line in axis space, mm and degrees alike; not a number where numbers are too
/// large to tell.
double distanceFromLine(const machine::MachineDescription& machine, const AxisPositions& from, const AxisPositions& to,
                        const AxisPositions& place) {
  std::array<double, machine::maximumAxes> way{}, off{};
  double along = 0, square = 0;
  for (std::size_t i = 0; i < machine.axes.size(); ++i) {
    way[i] = to[i] - from[i];
    off[i] = place[i] - from[i];
    if (machine.axes[i].modulo) off[i] = way[i] / 2 + std::remainder(off[i] - way[i] / 2, 360);
    along += way[i] * off[i];
    square += way[i] * way[i];
  }
  const double fraction = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
  double distance = 0;
  for (std::size_t i = 0; i < machine.axes.size(); ++i)
    distance = std::hypot(distance, off[i] - fraction * way[i]);
  return distance;
}

/// "X1.000 Y-2.500"
std::string named(const machine::MachineDescription& machine, const AxisPositions& place) {
  std::string text;
  for (std::size_t i = 0; i < machine.axes.size(); ++i)
    text += fmt::format("{}{}{:.3f}", i == 0 ? "" : " ", machine.axes[i].name, place[i]);
  return text;
}

}  // namespace

std::optional<std::string> offTheMeasuringMove(const machine::MachineDescription& machine, const AxisPositions& start,
                                               const AxisPositions& target, const AxisPositions& latched) {
  const double distance = distanceFromLine(machine, start, target, latched);
  if (distance <= latchedWithin) return std::nullopt;
  return fmt::format(
      "it tells a touch at {}, which lies {:.3f} mm (of rotary axes degrees) off the measuring move from {} to {}, "
      "where "
      "{} is allowed; see \"latched\" in docs/machine-adapters.md",
      named(machine, latched), distance, named(machine, start), named(machine, target), latchedWithin);
}

}  // namespace probewright::adapter
