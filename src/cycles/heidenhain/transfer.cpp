#include "cycles/heidenhain/transfer.hpp"

#include <fmt/format.h>

#include <cmath>

#include "control/alarm.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;
using control::heidenhain::ActivePreset;
using control::heidenhain::Coordinates;
using control::heidenhain::NumberColumn;
using control::heidenhain::rotationFromSpaceAngles;
using control::heidenhain::spaceAnglesFromRotation;

namespace {

enum class Transformation { Remains, Ends };

/// What lies between a preset and the coordinates of the program. Only the tilt goes on where transformations end.
Eigen::Affine3d presetFromProgram(const Coordinates& coordinates, Transformation transformed) {
  const bool remains = transformed == Transformation::Remains;
  Eigen::Affine3d matrix = Eigen::Affine3d::Identity();
  if (remains) matrix = coordinates.workpiece.matrix(coordinates.plane);
  if (coordinates.tilt) matrix = matrix * Eigen::Affine3d(*coordinates.tilt);
  if (coordinates.tilt && remains) matrix = matrix * coordinates.workingPlane.matrix(coordinates.plane);
  return matrix;
}

/// The axes in which a line along `along` is to lie along the main axis, as columns; along and square to `normal`.
Matrix3 axesAlong(const Vector3& along, const Vector3& normal) {
  Matrix3 axes;
  axes.col(2) = normal.normalized();
  axes.col(0) = (along - axes.col(2) * axes.col(2).dot(along)).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

/// The axes of the preset in which a line that lies at `degrees` in the active coordinates lies along their main axis.
/// Transformations that end when the preset becomes active are part of the rotation. The one angle of the iTNC 530
/// turns a tilted plane about the axis of the untilted one.
Matrix3 turnedAxes(Context& context, double degrees, Transformation transformed) {
  const Coordinates& coordinates = context.control().coordinates;
  const auto& plane = coordinates.plane;
  const Vector3 toolAxis = Vector3::Unit(plane.tool);
  const Matrix3 present = rotationFromSpaceAngles(coordinates.preset.spaceAngles);
  if (coordinates.tilt && !context.control().isTNC640()) return present * rotation(toolAxis, degrees).linear();
  const auto lineAxes = [&](Transformation how, double angle) {
    Vector3 normal = coordinates.tilt ? Vector3(*coordinates.tilt * toolAxis) : toolAxis;
    if (how == Transformation::Remains) normal = rotation(toolAxis, coordinates.workpiece.rotation).linear() * normal;
    const Vector3 line =
        presetFromProgram(coordinates, how).linear() * plane.xyzFromPlane(probing::directionAt(angle)).vector();
    return axesAlong(line, normal);
  };
  return present * lineAxes(Transformation::Remains, degrees) * lineAxes(transformed, 0).transpose();
}

/// Enters the axes of a preset. The iTNC 530 knows one angle, about the tool axis.
void setAngles(Context& context, const Matrix3& axes, Control::PresetChange& change) {
  const auto& plane = context.control().coordinates.plane;
  if (context.control().isTNC640()) {
    const Vector3 spaceAngles = spaceAnglesFromRotation(axes);
    for (std::size_t i = 0; i < 3; ++i)
      change.spaceAngles[i] = spaceAngles[static_cast<Eigen::Index>(i)];
    return;
  }
  change.spaceAngles[static_cast<std::size_t>(plane.tool)] =
      degreesFromRadians(std::atan2(axes(plane.minor, plane.main), axes(plane.main, plane.main)));
}

/// What changes in `target` so that `preset.measured` has the wished coordinates once `target` is active. They count in
/// the coordinates of the program: tilted as the working plane is, and shifted, mirrored, rotated and scaled as far as
/// that remains. Only those with a wish move.
Control::PresetChange presetChange(Context& context, const NewPreset& preset, const ActivePreset& target,
                                   Transformation transformed) {
  const Coordinates& coordinates = context.control().coordinates;
  const auto& plane = coordinates.plane;
  // The feature in machine coordinates does not depend on the preset that it was measured with.
  const PartInMachine feature = context.channel().machineFromProgram(plane.xyzFromPlane(preset.measured));
  Control::PresetChange change;
  Matrix3 axes = rotationFromSpaceAngles(target.spaceAngles);
  if (preset.rotation) {
    axes = turnedAxes(context, *preset.rotation, transformed);
    setAngles(context, axes, change);
    if (!context.control().isTNC640())
      axes = rotation(Vector3::Unit(plane.tool), *change.spaceAngles[static_cast<std::size_t>(plane.tool)]).linear();
  }
  Eigen::Affine3d program(presetFromProgram(coordinates, transformed));
  program = Eigen::Translation3d(target.origin) * axes * program;
  const Vector3 local = program.inverse() * feature.vector();
  Vector3 wish = local;
  for (std::size_t i = 0; i < 3; ++i) {
    const int axis = i == 0 ? plane.main : i == 1 ? plane.minor : plane.tool;
    if (preset.wish[i]) wish[axis] = *preset.wish[i];
  }
  const Vector3 shift = program.linear() * (local - wish);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    if (shift[index] != 0 || wish[index] != local[index]) change.origin[i] = target.origin[index] + shift[index];
  }
  return change;
}

/// Adds what `change` of `row` leaves open from the active preset.
void takeOverActive(Context& context, int row, Control::PresetChange& change) {
  const Control& control = context.control();
  const ActivePreset there = control.presetRow(row).value_or(ActivePreset{});
  const ActivePreset& active = control.coordinates.preset;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    if (!change.origin[i]) change.origin[i] = active.origin[index];
    const bool known = control.isTNC640() || i == static_cast<std::size_t>(control.coordinates.plane.tool);
    if (!change.spaceAngles[i] && known) change.spaceAngles[i] = active.spaceAngles[index];
  }
  for (std::size_t i = 0; i < context.channel().description().axes.size(); ++i) {
    const bool differs = active.rotaryOffset[i] != there.rotaryOffset[i];
    if (!change.rotaryOffset[i] && differs) change.rotaryOffset[i] = active.rotaryOffset[i];
  }
}

control::heidenhain::TypedTable& activeDatumTable(Context& context) {
  Control& control = context.control();
  const auto found = control.tables.datums.find(control.activeDatumTable);
  if (found == control.tables.datums.end()) {
    throw Alarm("Datum table not selected", "No datum table is active for the transfer with Q303 = 0",
                "select one with SEL TABLE, or transfer to the preset table with Q303 = 1");
  }
  return found->second;
}

/// Row 0 stands for the preset that is set at once, whatever Q303 says: so the examples of both controls.
bool setsPresetAtOnce(Context& context) { return context.option(305) == 0; }

void writeDatumRow(Context& context, int row, const NewPreset& preset) {
  Control& control = context.control();
  const auto& plane = control.coordinates.plane;
  const PartInMachine inMachine = context.channel().machineFromProgram(plane.xyzFromPlane(preset.measured));
  Coordinates coordinates = control.coordinates;
  // No column of a datum table takes a basic rotation: the active preset does.
  Control::PresetChange turned;
  if (preset.rotation) {
    setAngles(context, turnedAxes(context, *preset.rotation, Transformation::Remains), turned);
    for (std::size_t i = 0; i < 3; ++i) {
      if (turned.spaceAngles[i]) coordinates.preset.spaceAngles[static_cast<Eigen::Index>(i)] = *turned.spaceAngles[i];
    }
  }
  // Datum shifts count from the preset along its axes, or in the tilted plane.
  Eigen::Affine3d shifted(coordinates.machineFromPreset().matrix());
  if (coordinates.tilt) shifted = shifted * coordinates.workpiece.matrix(plane) * Eigen::Affine3d(*coordinates.tilt);
  const Vector3 feature = shifted.inverse() * inMachine.vector();
  constexpr std::array<NumberColumn, 3> names = {"X", "Y", "Z"};
  std::vector<Control::NumberCell> cells;
  for (std::size_t i = 0; i < 3; ++i) {
    const int axis = i == 0 ? plane.main : i == 1 ? plane.minor : plane.tool;
    if (!preset.wish[i]) continue;
    cells.push_back({activeDatumTable(context), std::to_string(row), names[static_cast<std::size_t>(axis)],
                     feature[axis] - *preset.wish[i]});
  }
  // What one of the tables refuses leaves both as they were.
  control.requireRoomFor(cells);
  if (preset.rotation) writePresetRow(context, control.coordinates.preset.row, turned);
  control.writeNumbers(cells);
}

}  // namespace

void requireTransferTarget(Context& context) {
  if (setsPresetAtOnce(context)) {
    context.control().requireWritablePreset(0);
    return;
  }
  if (context.option(303) == -1) {
    throw Alarm("Measured value transfer not defined",
                "Q303 = -1 comes from a program of an older control, which knew no choice of table",
                "set Q303 to 0 (datum table) or 1 (preset table)");
  }
  if (context.option(303) == 0) {
    activeDatumTable(context);
    const bool rotates = context.arguments().definition().parameter(304) != nullptr && context.option(304) == 1;
    if (rotates) context.control().requireWritablePreset(context.control().coordinates.preset.row);
  } else {
    context.control().requireWritablePreset(context.option(305));
  }
}

void requireDatumTable(Context& context, std::string_view because, std::string_view wayOut) {
  const Control& control = context.control();
  if (control.tables.datums.contains(control.activeDatumTable)) return;
  throw Alarm("Datum table not selected", fmt::format("No datum table is active for the angle that {}", because),
              fmt::format("select one with SEL TABLE, or {}", wayOut));
}

void transferPreset(Context& context, const NewPreset& preset) {
  Control& control = context.control();
  const int target = context.option(303);
  const int row = context.option(305);
  if (setsPresetAtOnce(context)) {
    copyActivePresetTo0(context, presetChange(context, preset, control.coordinates.preset, Transformation::Ends));
    return;
  }
  if (target == 0) {
    writeDatumRow(context, row, preset);
    return;
  }
  const bool isActive = row == control.coordinates.preset.row;
  const auto present = isActive ? control.coordinates.preset : control.presetRow(row);
  Control::PresetChange change = presetChange(context, preset, present.value_or(control.coordinates.preset),
                                              isActive ? Transformation::Remains : Transformation::Ends);
  writePresetRow(context, row, change);
}

void writePresetRow(Context& context, int row, Control::PresetChange change) {
  Control& control = context.control();
  if (!control.presetRow(row)) takeOverActive(context, row, change);
  control.writePreset(row, change);
}

void copyActivePresetTo0(Context& context, Control::PresetChange change) {
  Control& control = context.control();
  takeOverActive(context, 0, change);
  control.coordinates.workpiece = {};
  control.coordinates.workingPlane = {};
  control.writePreset(0, change);
  control.activatePreset(0);
}

void writeDatumAngle(Context& context, std::size_t axis, double degrees) {
  const int row = context.option(305);
  const auto column = NumberColumn::named(context.channel().description().axes[axis].name);
  context.control().writeNumber(activeDatumTable(context), std::to_string(row), column, degrees);
}

void addDatumAngle(Context& context, std::size_t axis, int row, double degrees) {
  auto& table = activeDatumTable(context);
  const std::string key = std::to_string(row);
  const auto column = NumberColumn::named(context.channel().description().axes[axis].name);
  context.control().writeNumber(table, key, column, table.numberOr(key, column, 0) + degrees);
}

void resetBasicRotation(Context& context) {
  context.control().coordinates.preset.spaceAngles.setZero();
  context.control().applyCoordinates();
}

Control::PresetChange rotationChange(Context& context, double degrees) {
  Vector3 toolAxis = Vector3::Zero();
  toolAxis[context.control().coordinates.plane.tool] = 1;
  Control::PresetChange change;
  setAngles(context, Eigen::AngleAxisd(radiansFromDegrees(degrees), toolAxis).toRotationMatrix(), change);
  return change;
}

void setBasicRotation(Context& context, double degrees, int row) {
  const int active = context.control().coordinates.preset.row;
  writePresetRow(context, row == 0 ? active : row, rotationChange(context, degrees));
}

void finishPreset(Context& context, const NewPreset& preset) {
  const Eigen::Affine3d frameBefore = context.channel().frame();
  transferPreset(context, preset);
  if (context.option(381) != 1) return;

  const auto& plane = context.control().coordinates.plane;
  const auto now = [&](const PartPoint& before) -> PartPoint {
    const PartInMachine place(frameBefore * plane.xyzFromPlane(before).vector());
    return plane.planeFromXyz(context.channel().programFromMachine(place));
  };
  auto& prober = context.prober();
  const PlannedTouch planned{now({context.q(382), context.q(383), context.q(384)}), probing::axisDirection(2, -1)};
  const double clearance = now({context.q(382), context.q(383), context.q(260)})[2];
  const bool hasClearance = context.arguments().definition().parameter(320) != nullptr;
  prober.approach(prober.prePosition(planned, hasClearance ? context.q(320) : 0), clearance);
  const EvaluatedTouch touch = prober.touch(planned);
  prober.moveSouthPoleTo(clearance);
  NewPreset height;
  height.measured = touch.surface;
  height.wish[2] = context.q(333);
  transferPreset(context, height);
}

}  // namespace probewright::cycles::heidenhain
