#include "execution/sinumerik/swivel_travel.hpp"

#include <algorithm>
#include <cmath>

#include "control/sinumerik/tool_carrier.hpp"

namespace probewright::execution::sinumerik {

using control::AxisPositions;
using control::sinumerik::carrierDatum;

namespace {

constexpr double rounding = 1e-9;  // degrees

}  // namespace

SwivelTravel::SwivelTravel(const control::sinumerik::Control& control) {
  const auto carrier = control::sinumerik::toolCarrier(control.data, control.carrier);
  if (!carrier) return;
  const machine::MachineDescription& machine = control.channel.description();
  for (int which = 0; which < carrier->axes(); ++which) {
    const auto index = machine.axisIndex(carrier->axisName[static_cast<std::size_t>(which)]);
    if (!index) continue;
    const auto datum = [&](int first) { return control.data.number(carrierDatum(first + which, control.carrier)); };
    Axis axis{.axis = *index, .gridStart = datum(26), .gridWidth = std::max(datum(28), 0.0)};
    axis.lowest = datum(30);
    axis.highest = datum(32);
    axis.limited = axis.lowest < axis.highest;
    axis.modulo = machine.axes[*index].modulo;
    axis.travelFrom = machine.axes[*index].minimum;
    axis.travelTo = machine.axes[*index].maximum;
    axes_.push_back(axis);
  }
}

bool SwivelTravel::Axis::allows(double degrees) const {
  if (!modulo && (degrees < travelFrom - rounding || degrees > travelTo + rounding)) return false;
  return !limited || (degrees >= lowest - rounding && degrees <= highest + rounding);
}

std::optional<double> SwivelTravel::Axis::reached(double degrees) const {
  std::optional<double> nearest;
  const auto consider = [&](double candidate) {
    if (allows(candidate) && (!nearest || std::abs(candidate - degrees) < std::abs(*nearest - degrees) - rounding))
      nearest = candidate;
  };
  constexpr double turn = 360;
  if (gridWidth <= 0) {
    for (const double turns : {0.0, -turn, turn})
      consider(degrees + turns);
    return nearest;
  }
  for (const double turns : {0.0, -turn, turn}) {
    const double place = std::round((degrees + turns - gridStart) / gridWidth);
    for (const double step : {0.0, -1.0, 1.0})
      consider(gridStart + (place + step) * gridWidth);
    if (nearest) return nearest;
  }
  return nearest;
}

std::optional<AxisPositions> SwivelTravel::reached(AxisPositions posture) const {
  for (const Axis& axis : axes_) {
    const auto degrees = axis.reached(posture[axis.axis]);
    if (!degrees) return std::nullopt;
    posture[axis.axis] = *degrees;
  }
  return posture;
}

}  // namespace probewright::execution::sinumerik
