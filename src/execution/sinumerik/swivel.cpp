#include "execution/sinumerik/swivel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "control/alarm.hpp"
#include "control/sinumerik/tool_carrier.hpp"
#include "execution/motion/tilted_plane.hpp"
#include "execution/sinumerik/swivel_travel.hpp"
#include "machine/rotary_solver.hpp"

namespace probewright::execution::sinumerik {

using control::Alarm;
using control::AxisPositions;
using control::sinumerik::Control;
using control::sinumerik::Frame;

namespace {

Vector3 unitAxis(int code) { return code >= 1 && code <= 3 ? Vector3(Vector3::Unit(code - 1)) : Vector3::Zero(); }

std::vector<std::size_t> rotaryAxes(const machine::MachineDescription& machine) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < machine.axes.size(); ++i)
    if (machine.axes[i].kind == machine::AxisKind::Rotary) found.push_back(i);
  return found;
}

/// The angle between -180 and 180 degrees, or a whole turn off where the travel of the axis asks for that; nothing if
/// it cannot be reached. What rounding left of a round number goes.
std::optional<double> intoTravel(const machine::Axis& axis, double degrees) {
  double angle = normalizedDegrees(degrees);
  const double rounded = std::round(angle * 1e6) / 1e6;
  if (std::abs(angle - rounded) < 1e-11) angle = rounded == 0 ? 0 : rounded;
  if (axis.modulo) return angle;
  if (angle > axis.maximum + 1e-9) angle -= 360;
  if (angle < axis.minimum - 1e-9) angle += 360;
  if (angle > axis.maximum + 1e-9 || angle < axis.minimum - 1e-9) return std::nullopt;
  return angle;
}

/// The data set that the call names, or else the one that was used last, or the first; 0: there is none. Where the
/// machine builder has given it another name than the program, that is the only one.
int dataSetOf(const Control& control, const std::string& name) {
  const auto named = name.empty() ? std::nullopt : control::sinumerik::carrierNamed(control.data, name);
  if (named) return *named;
  return control.carrier == 0 && control::sinumerik::toolCarrier(control.data, 1) ? 1 : control.carrier;
}

/// A name that no data set has, where the setup names its own: another one counts. A data set that comes of the machine
/// alone has no name of its own, and stands for any.
void warnOfOtherDataSet(Control& control, const std::string& name, int dataSet) {
  if (name.empty() || control::sinumerik::carrierNamed(control.data, name)) return;
  const std::string taken = control.data.text("$TC_CARR34", {dataSet});
  const auto ofMachine = control::sinumerik::carrierOf(control.channel.description());
  if (taken.empty() || (ofMachine && ofMachine->name == taken)) return;
  control.panel.message(control::EventKind::Warning,
                        fmt::format("CYCLE800: there is no swivel data set \"{}\"; \"{}\" counts instead", name, taken),
                        control.channel.seconds());
}

/// It counts from here on.
void useDataSet(Control& control, int dataSet) {
  control.carrier = dataSet;
  control.swivelled = true;
  control.useKinematics();
}

/// Where an axis retracts to: $TC_CARR38 (X), 39 (Y), 40 (Z) of the data set where they are entered, machine
/// coordinates.
double retractionOf(const Control& control, int dataSet, int datum, double otherwise) {
  return control.data.number(control::sinumerik::carrierDatum(datum, dataSet), otherwise);
}

/// Where the axes are at after going this far (mm) along the tool as it stands, away from its tip; without a distance
/// as far as the first linear axis permits.
AxisPositions alongTool(const control::Channel& channel, std::optional<double> distance) {
  const machine::MachineDescription& machine = channel.description();
  AxisPositions target = channel.axes();
  const Vector3 inSpindle = channel.toolVector.norm() > 1e-9 ? channel.toolVector.normalized() : Vector3::UnitZ();
  const Vector3 direction = machine::baseFromSpindle(machine, target).linear() * inSpindle;
  double way = distance.value_or(std::numeric_limits<double>::infinity());
  std::array<std::optional<std::size_t>, 3> axes;
  for (std::size_t i = 0; i < 3; ++i) {
    axes[i] = machine.axisIndex(std::string("XYZ").substr(i, 1));
    const double slope = direction[static_cast<Eigen::Index>(i)];
    if (distance || !axes[i] || std::abs(slope) < 1e-9) continue;
    const machine::Axis& axis = machine.axes[*axes[i]];
    way = std::min(way, std::max(0.0, ((slope > 0 ? axis.maximum : axis.minimum) - target[*axes[i]]) / slope));
  }
  if (!std::isfinite(way)) return target;
  for (std::size_t i = 0; i < 3; ++i)
    if (axes[i]) target[*axes[i]] += way * direction[static_cast<Eigen::Index>(i)];
  return target;
}

void retract(Control& control, const SwivelCall& call, int dataSet) {
  control::Channel& channel = control.channel;
  const machine::MachineDescription& machine = channel.description();
  AxisPositions target = channel.axes();
  const auto z = machine.axisIndex("Z");
  switch (call.retract) {
    case 1:
    case 2:
      if (z) {
        target[*z] = retractionOf(control, dataSet, 40, machine.axes[*z].maximum);
        channel.moveAxes(target, control::Feed::rapidTraverse());
      }
      if (call.retract == 2) {
        int datum = 38;
        for (const char* name : {"X", "Y"}) {
          if (const auto axis = machine.axisIndex(name))
            target[*axis] = retractionOf(control, dataSet, datum, machine.toolChange[*axis]);
          ++datum;
        }
        channel.moveAxes(target, control::Feed::rapidTraverse());
      }
      return;
    case 4:
      return channel.moveAxes(alongTool(channel, std::nullopt), control::Feed::rapidTraverse());
    case 5:
      if (call.retraction > 0) channel.moveAxes(alongTool(channel, call.retraction), control::Feed::rapidTraverse());
      return;
    default:
      return;
  }
}

/// A Hirth coupling may leave the tool beside the normal of the plane.
void warnOfLean(Control& control, const Vector3& normal, const AxisPositions& posture) {
  const control::Channel& channel = control.channel;
  const Vector3 tool = machine::toolOrientation(channel.description(), channel.rotaryOffset, posture).col(2);
  const double lean = degreesFromRadians(std::atan2(tool.cross(normal).norm(), tool.dot(normal)));
  constexpr double noticed = 1e-6;  // degrees
  if (lean <= noticed) return;
  control.panel.message(control::EventKind::Warning,
                        fmt::format("CYCLE800: the tool leans {:.4f} degrees beside the normal of the plane, at the "
                                    "nearest positions of the Hirth coupling",
                                    lean),
                        channel.seconds());
}

}  // namespace

std::optional<Matrix3> swivelRotation(int mode, const Vector3& angles) {
  const int kind = mode >> 6 & 3;
  if (kind == 3) return std::nullopt;
  if (kind == 1)  // solid angle: turned about Z by _A, then tilted about the new Y by _B
    return (rotation(Vector3::UnitZ(), angles[0]) * rotation(Vector3::UnitY(), angles[1])).linear();
  if (kind == 2)  // projection angles: _A and _B are the slopes of the new plane's traces in the planes YZ and ZX
    return Matrix3(motion::planeOfProjections(angles[1], angles[0]) * rotation(Vector3::UnitZ(), angles[2]).linear());
  Matrix3 result = Matrix3::Identity();
  for (int i = 0; i < 3; ++i) {
    const Vector3 axis = unitAxis(mode >> (2 * i) & 3);
    if (!axis.isZero()) result = result * rotation(axis, angles[i]).linear();
  }
  return result;
}

std::vector<AxisPositions> toolPostures(const machine::MachineDescription& machine, const AxisPositions& reference,
                                        const AxisPositions& now, const Vector3& direction) {
  const std::vector<std::size_t> axes = rotaryAxes(machine);
  const auto free = machine::freeRotaryAxis(machine, direction, reference);
  std::vector<AxisPositions> postures;
  for (AxisPositions posture : machine::solveRotaryAxes(machine, direction, Vector3::UnitZ(), reference, now)) {
    if (free) posture[*free] = now[*free];
    const bool reachable = std::ranges::all_of(axes, [&](std::size_t axis) {
      const auto angle = intoTravel(machine.axes[axis], posture[axis]);
      if (angle) posture[axis] = *angle;
      return angle.has_value();
    });
    const bool known = std::ranges::any_of(postures, [&](const AxisPositions& other) {
      return std::ranges::all_of(
          axes, [&](std::size_t axis) { return std::abs(normalizedDegrees(posture[axis] - other[axis])) < 1e-7; });
    });
    if (reachable && !known) postures.push_back(posture);
  }
  const auto turn = [&](const AxisPositions& posture) {
    double sum = 0;
    for (const std::size_t axis : axes)
      sum += std::abs(normalizedDegrees(posture[axis] - now[axis]));
    return sum;
  };
  std::ranges::stable_sort(postures,
                           [&](const AxisPositions& a, const AxisPositions& b) { return turn(a) < turn(b) - 1e-6; });
  return postures;
}

void deselectSwivel(Control& control) {
  control.frames.toolOriented = {};
  control.swivelled = false;
  control.useKinematics();
  control.handOverFrames();
}

void swivel(Control& control, const SwivelCall& call) {
  control::Channel& channel = control.channel;
  const machine::MachineDescription& machine = channel.description();
  const int dataSet = dataSetOf(control, call.dataSet);
  if (call.dataSet == "0") {
    retract(control, call, dataSet);
    return deselectSwivel(control);
  }
  warnOfOtherDataSet(control, call.dataSet, dataSet);
  const std::vector<std::size_t> axes = rotaryAxes(machine);
  const auto rotation = swivelRotation(call.mode, call.angles);
  if (axes.empty() && (!rotation || !rotation->isIdentity(1e-12)))
    throw Alarm("62181", "the machine has no rotary axis to swivel with", "choose a machine with rotary axes");
  retract(control, call, dataSet);

  const bool additive = call.state % 10 == 1;
  useDataSet(control, dataSet);
  const SwivelTravel travel(control);
  const char* unreachable = "the rotary axes cannot take this plane within their travels";
  const char* travelAdvice =
      "check the angles of CYCLE800, the travels of the rotary axes, and the limits $TC_CARR30 to 33 of the data set";
  const Frame before = additive ? control.frames.toolOriented : Frame{};
  AxisPositions target = channel.axes();
  Matrix3 turn = Matrix3::Identity();
  if (rotation) {
    turn = *rotation;
  } else {
    // The angles are those of the first and second rotary axis; the plane follows from them.
    for (std::size_t i = 0; i < axes.size() && i < 3; ++i)
      target[axes[i]] = call.angles[static_cast<Eigen::Index>(i)] + channel.rotaryOffset[axes[i]];
    const auto stands = travel.reached(target);
    if (!stands) throw Alarm("62201", unreachable, travelAdvice);
    target = *stands;
    const Pose referenceFromTable = machine::baseFromTable(machine, channel.rotaryOffset);
    const Eigen::Affine3d outer =
        control.machineFromBase() * control::sinumerik::transform(control.frames.settableFrame);
    turn = outer.linear().inverse() * referenceFromTable.linear() *
           machine::baseFromTable(machine, target).linear().transpose() *
           machine::baseFromSpindle(machine, target).linear();
  }
  Eigen::Affine3d plane = control::sinumerik::transform(before);
  plane = plane * Eigen::Translation3d(call.reference) * Eigen::Affine3d(turn) * Eigen::Translation3d(call.shift);
  const auto frame = control::sinumerik::frameFromTransform(plane);
  if (!frame) throw Alarm("62201", frame.error().message, frame.error().advice);
  control.frames.toolOriented = *frame;
  control.frames.programmed = {};
  control.handOverFrames();

  if (rotation) {
    const Vector3 normal = (control.machineFromWorkpiece().linear() * Vector3::UnitZ()).normalized();
    std::vector<AxisPositions> solutions;
    for (const AxisPositions& exact : toolPostures(machine, channel.rotaryOffset, channel.axes(), normal))
      if (const auto stands = travel.reached(exact)) solutions.push_back(*stands);
    if (solutions.empty() && !axes.empty()) throw Alarm("62201", unreachable, travelAdvice);
    // _DIR picks between the two postures by the axis that tilts.
    const auto tilting = machine::tiltingAxis(machine, Vector3::UnitZ());
    if (solutions.size() > 1 && tilting && call.direction != 0) {
      const bool rises = solutions[1][tilting->axis] > solutions[0][tilting->axis];
      if (rises == (call.direction > 0)) std::swap(solutions[0], solutions[1]);
    }
    if (!solutions.empty()) {
      target = solutions.front();
      warnOfLean(control, normal, target);
    }
  }
  if (call.direction == 0 || axes.empty()) return;
  AxisPositions end = channel.axes();
  for (const std::size_t axis : axes)
    end[axis] = target[axis];
  channel.moveAxes(end, control::Feed::rapidTraverse());
}

}  // namespace probewright::execution::sinumerik
