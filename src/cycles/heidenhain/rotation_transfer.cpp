#include "cycles/heidenhain/rotation_transfer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "control/alarm.hpp"
#include "control/scoped.hpp"
#include "machine/rotary_solver.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;
using control::Following;
using control::heidenhain::spaceAnglesFromRotation;
using machine::AxisPositions;
using machine::MachineDescription;

namespace {

Vector3 toolDirection(Context& context) {
  Vector3 direction = Vector3::Zero();
  direction[context.control().coordinates.plane.tool] = 1;
  return direction;
}

/// Axes of a matrix given in (main, minor, tool) as one in X, Y, Z.
Matrix3 xyzFromPlane(Context& context, const Matrix3& matrix) {
  const auto& plane = context.control().coordinates.plane;
  Matrix3 order = Matrix3::Zero();
  order(plane.main, 0) = order(plane.minor, 1) = order(plane.tool, 2) = 1;
  return order * matrix * order.transpose();
}

AxisPositions referencePosture(Context& context) {
  const MachineDescription& machine = context.channel().description();
  AxisPositions reference = context.control().coordinates.preset.rotaryOffset;
  for (std::size_t i = 0; i < machine.axes.size(); ++i) {
    if (machine.axes[i].kind != machine::AxisKind::Rotary) reference[i] = 0;
  }
  return reference;
}

/// What the linear axes do meanwhile.
enum class LinearAxes { Stand, HoldTip };

/// Positions rotary axes; the linear axes may hold the tip where it is on the workpiece.
void positionRotaryAxes(Context& context, const AxisPositions& target, LinearAxes linear) {
  auto& control = context.control();
  auto& channel = control.channel;
  const MachineDescription& machine = channel.description();
  control::Target turned;
  for (std::size_t i = 0; i < machine.axes.size(); ++i) {
    if (machine.axes[i].kind == machine::AxisKind::Rotary) turned.rotary[i] = target[i] - channel.rotaryOffset[i];
  }
  const bool holds = linear == LinearAxes::HoldTip;
  const control::AtEnd again([&] { control.applyCoordinates(); });
  if (holds) channel.setFollowing(Following::Kinematics, channel.rotaryOffset);
  const control::Scoped mode(channel.holdTip, holds);
  channel.moveTo(turned, machine::Feed::at(activeProbe(control).positioningFeed));
}

/// The mean of the positions that Q1120 chooses; nothing if none is to be transferred.
std::optional<MeasuredPosition> chosen(Context& context, std::span<const MeasuredPosition> positions) {
  const auto choice = static_cast<std::size_t>(context.option(1120));
  if (choice == 0) return std::nullopt;
  if (choice <= positions.size()) return positions[choice - 1];
  MeasuredPosition mean;
  for (const MeasuredPosition& position : positions) {
    const auto count = static_cast<double>(positions.size());
    mean.actual += PlaneWay(position.actual.vector() / count);
    mean.nominal += PlaneWay(position.nominal.vector() / count);
    mean.wanted += PlaneWay(position.wanted.vector() / count);
  }
  return mean;
}

/// Moves the origin of `axes` so that the place reads the wanted coordinates; `moved` maps machine coordinates as they
/// were measured to those for which the preset is to count.
void moveOrigin(Context& context, const MeasuredPosition& position, const Matrix3& axes, const Pose& moved,
                Control::PresetChange& change) {
  auto& coordinates = context.control().coordinates;
  const auto inMachine = [&](const PartPoint& place) -> PartInMachine {
    return context.channel().machineFromProgram(coordinates.plane.xyzFromPlane(place));
  };
  const Vector3 actual = moved * inMachine(position.actual).vector();
  const Vector3 wanted = coordinates.machineFromPreset().inverse() * inMachine(position.wanted).vector();
  const Vector3 origin = actual - axes * wanted;
  for (std::size_t i = 0; i < 3; ++i)
    change.origin[i] = origin[static_cast<Eigen::Index>(i)];
}

void setAngles(Control::PresetChange& change, const Matrix3& axes) {
  const Vector3 angles = spaceAnglesFromRotation(axes);
  for (std::size_t i = 0; i < 3; ++i)
    change.spaceAngles[i] = angles[static_cast<Eigen::Index>(i)];
}

/// The axes of the preset with the basic rotation that turns the I-CS by `rotation` (main, minor, tool axis).
Matrix3 turnedAxes(Context& context, const Matrix3& rotation) {
  const Matrix3 input = context.channel().frame().linear();
  return input * xyzFromPlane(context, rotation) * input.transpose() *
         context.control().coordinates.machineFromPreset().linear();
}

/// From here on the coordinates follow the rotary axes, as after PLANE SPATIAL with angles of 0. The preset, which may
/// have been measured with turned axes, is expressed for the posture at which it counts.
void followRotaryAxes(Context& context) {
  auto& control = context.control();
  auto& channel = control.channel;
  if (channel.following() == Following::Kinematics) return;
  std::array<AxisPositions, 4> axes;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3 place = i == 0 ? Vector3(Vector3::Zero()) : Vector3(Vector3::Unit(static_cast<Eigen::Index>(i) - 1));
    axes[i] = channel.axesFromMachine(MachinePlace(place), channel.axes());
  }
  channel.setFollowing(Following::Kinematics, channel.rotaryOffset);
  Pose moved = Pose::Identity();
  const MachinePlace origin = channel.machineFromAxes(axes[0]);
  moved.translation() = origin.vector();
  for (std::size_t i = 1; i < 4; ++i) {
    moved.linear().col(static_cast<Eigen::Index>(i) - 1) = (channel.machineFromAxes(axes[i]) - origin).vector();
  }
  if (!moved.isApprox(Pose::Identity(), 1e-12)) {
    const Pose preset = moved * control.coordinates.machineFromPreset();
    Control::PresetChange change;
    for (std::size_t i = 0; i < 3; ++i)
      change.origin[i] = preset.translation()[static_cast<Eigen::Index>(i)];
    setAngles(change, preset.linear());
    control.writePreset(control.coordinates.preset.row, change);
  }
  control.coordinates.tilt = Matrix3::Identity();
  control.applyCoordinates();
}

/// How the workpiece moves, in the machine coordinates of presets, when the table's axis turns by `degrees`.
Pose workpieceTurn(Context& context, std::size_t axis, double degrees) {
  auto& channel = context.channel();
  const MachineDescription& machine = channel.description();
  AxisPositions from =
      channel.following() == Following::Kinematics ? context.control().coordinates.preset.rotaryOffset : channel.axes();
  for (std::size_t i = 0; i < machine.axes.size(); ++i) {
    if (machine.axes[i].kind != machine::AxisKind::Rotary) from[i] = 0;
  }
  AxisPositions to = from;
  to[axis] += degrees;
  return machine::baseFromTable(machine, to) * machine::baseFromTable(machine, from).inverse();
}

}  // namespace

void planeRotationRules(CallRules& call, std::initializer_list<std::uint32_t> axes) {
  for (const std::uint32_t axis : axes) {
    const auto along = call.numbers({1100 + axis, 1103 + axis});
    if (!along || (*along)[0] != (*along)[1]) return;
  }
  call.refuseUnlessBlank("Angle not determined", {1100, 1101, 1103, 1104},
                         "The two positions coincide in the working plane", "move them apart");
}

void requireRotationCycle(Context& context) {
  const int aligns = context.option(1126);
  const int transfers = context.option(1121);
  if (aligns != 0 && transfers == 0) {
    throw Alarm("Rotary axes cannot be aligned", "Q1126 aligns rotary axes, but Q1121 takes over no rotation",
                "set Q1121, or Q1126 = 0");
  }
  if (transfers != 0 || context.option(1120) != 0) {
    context.control().requireWritablePreset(context.control().coordinates.preset.row);
  }
}

void requireAlignmentAxis(Context& context) {
  if (context.option(1126) == 0 && context.option(1121) != 2) return;
  if (alignmentAxis(context)) return;
  throw Alarm("Rotary axes cannot be aligned",
              "The rotary axis of the table that is nearest to the workpiece does not turn about the tool axis",
              "use a basic rotation (Q1121 = 1) and Q1126 = 0");
}

std::optional<TableAxis> alignmentAxis(Context& context) {
  auto& channel = context.channel();
  const MachineDescription& machine = channel.description();
  for (auto element = machine.tableChain.rbegin(); element != machine.tableChain.rend(); ++element) {
    if (!element->axis || machine.axes[*element->axis].kind != machine::AxisKind::Rotary) continue;
    // How the workpiece turns, in coordinates that stay with the spindle.
    AxisPositions now = channel.axes();
    AxisPositions next = now;
    next[*element->axis] += 1;
    const Matrix3 spindle = machine::baseFromSpindle(machine, now).linear();
    const Matrix3 turn = spindle.transpose() * machine::baseFromTable(machine, next).linear() *
                         machine::baseFromTable(machine, now).linear().transpose() * spindle;
    const Eigen::AngleAxisd rotation(turn);
    const double about = rotation.axis().dot(toolDirection(context)) * degreesFromRadians(rotation.angle());
    if (std::abs(about) < 0.999) return std::nullopt;
    return TableAxis{*element->axis, about};
  }
  return std::nullopt;
}

PlaneRotation planeRotation(Context& context, const MeasuredPosition& first, const MeasuredPosition& second) {
  const auto angle = [](const Vector3& along) {
    if (along.head<2>().norm() < 1e-6) {
      throw Alarm("Angle not determined", "The two positions coincide in the working plane", "move them apart");
    }
    return degreesFromRadians(std::atan2(along.y(), along.x()));
  };
  PlaneRotation rotation;
  const Control& control = context.control();
  rotation.inWorkpiece = control.parameters.checkTiltingAxes && !rotaryAxesMatchTilt(control);
  const auto& plane = control.coordinates.plane;
  const Matrix3 workpieceFromInput =
      control.coordinates.machineFromPreset().linear().transpose() * context.channel().frame().linear();
  const auto along = [&](const PlaneWay& line) -> Vector3 {
    if (!rotation.inWorkpiece) return line.vector();
    return plane.planeFromXyz(workpieceFromInput * plane.xyzFromPlane(line).vector());
  };
  rotation.nominal = angle(along(second.nominal - first.nominal));
  rotation.actual = angle(along(second.actual - first.actual));
  rotation.deviation = normalizedDegrees(rotation.actual - rotation.nominal);
  rotation.axis = alignmentAxis(context);
  const double sign = rotation.axis ? rotation.axis->workpieceTurn : 1;
  rotation.tableActual = normalizedDegrees(rotation.actual / sign);
  rotation.tableDeviation = rotation.deviation / sign;
  return rotation;
}

void addAngles(RotationFindings& findings, const PlaneRotation& rotation) {
  findings.addAngle(964, "Measured angle", rotation.actual);
  findings.addAngle(965, "Measured angle of the rotary table", rotation.tableActual);
  findings.addAngle(994, "Deviation of the angle", rotation.deviation);
  findings.addAngle(995, "Deviation of the angle of the rotary table", rotation.tableDeviation);
}

void transferPlaneRotation(Context& context, const PlaneRotation& rotation, const MeasuredPosition& first,
                           const MeasuredPosition& second) {
  Control& control = context.control();
  const std::array positions = {first, second};
  const auto position = chosen(context, positions);
  const int transfer = context.option(1121);
  const int aligns = context.option(1126);

  Control::PresetChange change;
  Matrix3 axes = control.coordinates.machineFromPreset().linear();
  Pose moved = Pose::Identity();
  AxisPositions target = context.channel().axes();
  if (transfer == 1) {
    const Matrix3 turn = Eigen::AngleAxisd(radiansFromDegrees(rotation.deviation), Vector3::UnitZ()).toRotationMatrix();
    axes = rotation.inWorkpiece ? Matrix3(axes * xyzFromPlane(context, turn)) : turnedAxes(context, turn);
    setAngles(change, axes);
  }
  if (rotation.axis) target[rotation.axis->index] -= rotation.tableDeviation;
  if (transfer == 2) {
    const std::size_t axis = rotation.axis->index;
    moved = workpieceTurn(context, axis, -rotation.tableDeviation);
    change.rotaryOffset[axis] = control.coordinates.preset.rotaryOffset[axis] - rotation.tableDeviation;
  }
  if (position) moveOrigin(context, *position, axes, moved, change);
  if (!position && transfer == 0) return;
  control.writePreset(control.coordinates.preset.row, change);
  if (aligns == 0) return;
  if (transfer == 1) followRotaryAxes(context);
  positionRotaryAxes(context, target, aligns == 1 ? LinearAxes::HoldTip : LinearAxes::Stand);
}

void transferSpaceRotation(Context& context, const Matrix3& rotation, std::span<const MeasuredPosition, 3> points) {
  Control& control = context.control();
  const auto position = chosen(context, points);
  Control::PresetChange change;
  Matrix3 axes = control.coordinates.machineFromPreset().linear();
  const bool turns = context.option(1121) == 1;
  if (turns) {
    axes = turnedAxes(context, rotation);
    setAngles(change, axes);
  }
  if (position) moveOrigin(context, *position, axes, Pose::Identity(), change);
  if (!position && !turns) return;
  control.writePreset(control.coordinates.preset.row, change);
  if (context.option(1126) == 0) return;

  followRotaryAxes(context);
  auto& channel = context.channel();
  const Vector3 tool = toolDirection(context);
  const Vector3 direction = (channel.frame().linear() * tool).normalized();
  const AxisPositions now = channel.axes();
  const auto solutions =
      machine::solveRotaryAxes(channel.description(), direction, tool, referencePosture(context), now);
  if (solutions.empty()) {
    throw Alarm("Rotary axes cannot be aligned",
                "The rotary axes of the machine cannot set the tool square to this plane", "set Q1126 = 0");
  }
  const auto distance = [&](const AxisPositions& solution) {
    double sum = 0;
    for (std::size_t i = 0; i < channel.description().axes.size(); ++i)
      sum += std::abs(solution[i] - now[i]);
    return sum;
  };
  positionRotaryAxes(context, *std::ranges::min_element(solutions, {}, distance),
                     context.option(1126) == 1 ? LinearAxes::HoldTip : LinearAxes::Stand);
}

}  // namespace probewright::cycles::heidenhain
