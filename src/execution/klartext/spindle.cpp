#include "execution/klartext/spindle.hpp"

#include <fmt/format.h>

#include "control/alarm.hpp"

namespace probewright::execution::klartext {

using machine::Rotation;

void Spindle::turn(Rotation rotation) {
  hasRun_ = true;
  clockwise_ = rotation == Rotation::Clockwise;
  control_.channel.turnSpindle(rotation, control_.tool.spindleSpeed);
  control_.q.setQ(110, state());
}

void Spindle::stop() {
  control_.channel.turnSpindle(Rotation::None, 0);
  control_.q.setQ(110, state());
}

void Spindle::setOrientation(double degrees) {
  if (!(degrees >= 0 && degrees <= 360)) {
    throw control::Alarm("Cycle parameter wrong", fmt::format("Cycle 13 orients the spindle to {} degrees", degrees),
                         "program an angle from 0 to 360 degrees");
  }
  orientation_ = degrees;
}

void Spindle::orient() { control_.channel.orientSpindle(orientation_.value_or(0)); }

void Spindle::coolant(int number) {
  control_.q.setQ(111, number == 8 ? 1 : 0);
  control_.channel.function(number);
}

void Spindle::standDown() {
  if (control_.channel.spindleRotation() != Rotation::None) control_.channel.turnSpindle(Rotation::None, 0);
  if (control_.q.q(111) == 1) control_.channel.function(9);
}

double Spindle::state() const {
  if (!hasRun_) return -1;
  return (clockwise_ ? 0 : 1) + (control_.channel.spindleRotation() != Rotation::None ? 0 : 2);
}

}  // namespace probewright::execution::klartext
