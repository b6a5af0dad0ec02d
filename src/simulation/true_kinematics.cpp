#include "simulation/true_kinematics.hpp"

#include <algorithm>
#include <cmath>

#include "machine/rotary_correction.hpp"

namespace probewright::simulation {

using machine::AxisKind;
using machine::AxisPositions;
using machine::ChainElement;
using machine::MachineDescription;

namespace {

double deviationAt(const Deviation& deviation, double position) {
  double value = 0;
  double power = 1;
  for (const double coefficient : deviation.polynomial) {
    value += coefficient * power;
    power *= position / 1000;
  }
  if (deviation.amplitude != 0) {
    value +=
        deviation.amplitude * std::sin(radiansFromDegrees(360 * position / deviation.wavelength + deviation.phase));
  }
  return value;
}

bool isShift(const Pose& pose) { return pose.linear() == Matrix3::Identity(); }

/// The direction in which the tool moves relative to the workpiece when the axis moves in +; null for fixed axes.
Vector3 relativeDirection(const MachineDescription& machine, std::size_t axis) {
  for (const ChainElement& element : machine.spindleChain) {
    if (element.axis == axis) return element.direction;
  }
  for (const ChainElement& element : machine.tableChain) {
    if (element.axis == axis) return -element.direction;
  }
  return Vector3::Zero();
}

template <class Change>
void changeElements(MachineDescription& machine, std::size_t axis, Change change) {
  for (ChainElement& element : machine.spindleChain) {
    if (element.axis == axis) change(element, 1.0);
  }
  for (ChainElement& element : machine.tableChain) {
    if (element.axis == axis) change(element, -1.0);
  }
}

}  // namespace

MachineDescription trueDescription(const MachineDescription& machine, const MachineErrors& errors) {
  MachineDescription truth = machine;
  for (const Squareness& error : errors.squareness) {
    const Vector3 drift = relativeDirection(machine, error.towards) * std::tan(radiansFromDegrees(error.degrees));
    changeElements(truth, error.axis, [&](ChainElement& element, double sign) {
      element.direction = (element.direction + sign * drift).normalized();
    });
  }
  for (const RotaryAxisError& error : errors.rotaryAxes)
    machine::correct(truth, {error.axis, error.position, error.orientation});
  return truth;
}

TrueKinematics::TrueKinematics(const MachineDescription& nominal, const MachineErrors& errors)
    : machine_(trueDescription(nominal, errors)),
      errors_(errors),
      spindleTilt_(machine::rotationVector(errors.spindleTilt)) {
  errors_.axes.resize(std::max(errors_.axes.size(), machine_.axes.size()));
}

Pose TrueKinematics::chainPose(const std::vector<ChainElement>& chain, double sign, const AxisPositions& slides) const {
  Pose pose = Pose::Identity();
  bool turned = false;  // as long as nothing has turned, a shift is a shift
  for (const ChainElement& element : chain) {
    if (!element.axis) continue;
    const std::size_t axis = *element.axis;
    const AxisErrors& errors = errors_.axes[axis];
    double position = slides[axis] * (1 + errors.scale) + errors.offset;
    if (machine_.axes[axis].kind == AxisKind::Linear) {
      Vector3 shift = element.direction * position;
      for (const Deviation& deviation : errors.deviations) {
        shift += sign * deviationAt(deviation, slides[axis]) * deviation.direction;
      }
      if (turned)
        pose.translation() += pose.linear() * shift;
      else
        pose.translation() += shift;
    } else {
      for (const Deviation& deviation : errors.deviations)
        position += deviationAt(deviation, slides[axis]);
      if (position == 0) continue;
      turned = true;
      const Pose turn = rotation(element.direction, position);
      pose = pose * translation(element.point) * turn * translation(-element.point);
    }
  }
  return pose;
}

Pose TrueKinematics::tableFromSpindle(const AxisPositions& slides, double seconds) const {
  Pose baseFromSpindle = chainPose(machine_.spindleChain, 1, slides);
  for (const ThermalDrift& drift : errors_.thermal) {
    baseFromSpindle.pretranslate(Vector3(drift.amount * -std::expm1(-seconds / drift.timeConstant)));
  }
  const Pose baseFromTable = chainPose(machine_.tableChain, -1, slides);
  // Most machines only shift most of the time.
  if (isShift(baseFromTable) && isShift(baseFromSpindle) && errors_.spindleTilt.isZero(0)) {
    baseFromSpindle.translation() -= baseFromTable.translation();
    return baseFromSpindle;
  }
  return baseFromTable.inverse() * baseFromSpindle * spindleTilt_;
}

double TrueKinematics::follow(std::size_t axis, double slide, double reading) const {
  return std::clamp(slide, reading, reading + errors_.axes[axis].backlash);
}

bool TrueKinematics::isStraight(const AxisPositions& from, const AxisPositions& to) const {
  if (!errors_.thermal.empty()) return false;
  for (std::size_t i = 0; i < machine_.axes.size(); ++i) {
    if (from[i] == to[i]) continue;
    if (machine_.axes[i].kind == AxisKind::Rotary || !errors_.axes[i].deviations.empty()) return false;
  }
  return true;
}

bool TrueKinematics::isStraightWithoutPlay(const AxisPositions& from, const AxisPositions& to) const {
  for (std::size_t i = 0; i < machine_.axes.size(); ++i)
    if (from[i] != to[i] && backlash(i) != 0) return false;
  return isStraight(from, to);
}

int TrueKinematics::piecesFor(const AxisPositions& from, const AxisPositions& to) const {
  constexpr double longestTurn = 15;  // degrees
  constexpr double piecesPerWave = 8;
  constexpr double mostPieces = 100000;
  double pieces = 1;
  for (std::size_t i = 0; i < machine_.axes.size(); ++i) {
    const double travel = std::abs(to[i] - from[i]);
    if (machine_.axes[i].kind == AxisKind::Rotary) pieces = std::max(pieces, travel / longestTurn);
    for (const Deviation& deviation : errors_.axes[i].deviations) {
      if (deviation.amplitude != 0) pieces = std::max(pieces, travel * piecesPerWave / deviation.wavelength);
    }
  }
  return static_cast<int>(std::ceil(std::min(pieces, mostPieces)));
}

}  // namespace probewright::simulation
