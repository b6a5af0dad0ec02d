#include "cycles/heidenhain/tool_probe_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "cycles/heidenhain/tool_measurement.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;
using control::heidenhain::MachineParameters;

void requireCalibratingTool(Context& context) {
  requireMeasurable(context);
  const Control& control = context.control();
  if (control.tool.radius > 0 && control.tool.length > 0) return;
  throw Alarm(
      "Calibrating tool not defined",
      fmt::format("Tool {} has no length and radius in TOOL.T, which must be exact for calibrating", control.tool.row),
      "enter the exact length and radius of the calibrating tool");
}

namespace {

/// Where the middle and the sides of the contact are, along main (0) and minor axis (1).
struct Found {
  Vector2 middle = Vector2::Zero();  ///< where the spindle's axis is when the tool is in the middle
  Vector2 half = Vector2::Zero();    ///< half of the effective width
};

class Calibration {
public:
  Calibration(Context& context, const PartInMachine& middle, double clearanceHeight)
      : context_(context),
        control_(context.control()),
        plane_(control_.coordinates.plane),
        settings_(toolMeasuringSettings(control_)),
        radius_(context.channel().toolRadius),
        probe_(placed(toolTouchProbe(control_, Contact::AsFitted), middle)),
        prober_(context.channel(), plane_, probe_, clearanceHeight),
        place_(middle) {}

  void run();

private:
  static probing::ToolTouchProbe placed(probing::ToolTouchProbe probe, const PartInMachine& middle) {
    probe.place = middle;
    return probe;
  }
  int index(int axis) const { return axis == 0 ? plane_.main : plane_.minor; }
  double size(int axis) const { return axis == 0 ? probe_.size : probe_.size2; }
  /// The tip along an axis when it touches the contact in the direction `sense`, `aside` from the middle.
  double side(int axis, int sense, double aside = 0) {
    return prober_.touchSide(axis, sense, radius_, probe_.depth, aside).tip[index(axis)];
  }
  void moveTo(int axis, double value) {
    place_[index(axis)] = value;
    prober_.setPlace(place_);
  }
  void findTop();
  void findRotation();
  void findTipping();
  Found touchSquare();
  Found touchOneSide();
  void touchPlane();
  void keep();

  Context& context_;
  Control& control_;
  control::WorkingPlane plane_;
  ToolMeasuringSettings settings_;
  double radius_;
  probing::ToolTouchProbe probe_;
  probing::ToolProber prober_;
  PartInMachine place_;
  double rotation_ = 0;            ///< radians about the tool axis
  std::optional<double> tipping_;  ///< degrees
  Found first_, turned_;           ///< with the spindle as it was, and turned by 180 degrees
};

void Calibration::findTop() {
  place_[plane_.tool] = prober_.touchTop({0, 0}).tip[plane_.tool];
  prober_.setPlace(place_);
  prober_.rise();
}

/// Main axis, then the minor axis through the middle found in the main axis.
Found Calibration::touchSquare() {
  Found found;
  for (const int axis : {0, 1}) {
    const double below = side(axis, 1), above = side(axis, -1);
    found.middle[axis] = (below + above) / 2;
    found.half[axis] = (above - below) / 2 * std::cos(rotation_) - radius_;
    moveTo(axis, found.middle[axis]);
  }
  return found;
}

/// The side that tools are measured at, from the middle that the parameters name.
Found Calibration::touchOneSide() {
  const auto [axis, sense] = probingSide(control_.parameters);
  Found found{{place_[plane_.main], place_[plane_.minor]}, {size(0) / 2, size(1) / 2}};
  const double tip = side(axis, sense);
  found.half[axis] = sense * (place_[index(axis)] - tip) * std::cos(rotation_) - radius_;
  return found;
}

/// By two touches of the side that tools are measured at.
void Calibration::findRotation() {
  const auto [axis, sense] = probingSide(control_.parameters);
  const double apart = 0.3 * size(1 - axis);
  const double slope = (side(axis, sense, apart) - side(axis, sense, -apart)) / (2 * apart);
  rotation_ = std::atan(axis == 0 ? -slope : slope);
}

/// By touches of the top beside the middle, where all of the tool's end is above the contact.
void Calibration::findTipping() {
  const double apart = 0.8 * (first_.half.minCoeff() - radius_);
  constexpr double least = 0.5;  // mm
  if (apart < least) {
    context_.warn("The calibrating tool is too wide to determine how the contact is tipped");
    return;
  }
  Vector2 slope;
  for (const int axis : {0, 1}) {
    Vector2 offset = Vector2::Zero();
    offset[axis] = apart;
    const double there = prober_.touchTop(offset).tip[plane_.tool];
    slope[axis] = (there - prober_.touchTop(-offset).tip[plane_.tool]) / (2 * apart);
  }
  prober_.rise();
  tipping_ = degreesFromRadians(std::atan(slope.norm()));
  if (*tipping_ > settings_.tippingTolerance) {
    context_.warn(fmt::format("The contact is tipped by {:.4f} degrees; tippingTolerance permits {:.4f}", *tipping_,
                              settings_.tippingTolerance));
  }
}

/// The first square finds the middle, the second the widths through the middle, the third, with the spindle turned by
/// 180 degrees, how far the tool runs out. Without orientation its run-out stays in the result.
void Calibration::touchPlane() {
  control::Channel& channel = context_.channel();
  const bool orients = channel.description().spindleOrients;
  if (settings_.oneDirection) {
    if (settings_.findsRotation) findRotation();
    first_ = turned_ = touchOneSide();
    if (orients) {
      channel.orientSpindle(180);
      turned_ = touchOneSide();
    }
    return;
  }
  touchSquare();
  if (settings_.findsRotation) findRotation();
  first_ = turned_ = touchSquare();
  if (orients) {
    channel.orientSpindle(180);
    turned_ = touchSquare();
  }
}

void Calibration::keep() {
  // On one side the run-out of the tool shows as a width that differs, not as a middle that does.
  const Vector2 half = settings_.oneDirection ? Vector2((first_.half + turned_.half) / 2) : first_.half;
  const auto [axis, sense] = probingSide(control_.parameters);
  Vector2 runOut = (turned_.middle - first_.middle) / 2;
  if (settings_.oneDirection) runOut[axis] = sense * (first_.half - turned_.half)[axis] / 2;
  place_[plane_.main] = (first_.middle.x() + turned_.middle.x()) / 2;
  place_[plane_.minor] = (first_.middle.y() + turned_.middle.y()) / 2;
  prober_.setPlace(place_);
  prober_.centre();

  constexpr std::array<double MachineParameters::*, 3> members = {
      &MachineParameters::contactX, &MachineParameters::contactY, &MachineParameters::contactZ};
  constexpr std::array<const char*, 3> names = {"TT centre, X", "TT centre, Y", "TT centre, Z"};
  for (std::size_t i = 0; i < 3; ++i)
    control_.writeCalibration(members[i], names[i], place_[static_cast<Eigen::Index>(i)]);
  control_.writeCalibration(&MachineParameters::contactRadius1, "TT radius, main axis", half.x());
  control_.writeCalibration(&MachineParameters::contactRadius2, "TT radius, minor axis", half.y());
  control_.writeCalibration(&MachineParameters::contactAngle, "TT rotation", degreesFromRadians(rotation_));
  std::string screen = fmt::format(
      "TT CALIBRATED WITH TOOL {}\n  X {}\n  Y {}\n  Z {}\n  RADIUS {:.4f} {:.4f}\n  RUN-OUT OF THE TOOL {} {}\n",
      control_.tool.row, formatSigned(place_.x(), 4), formatSigned(place_.y(), 4), formatSigned(place_.z(), 4),
      half.x(), half.y(), formatSigned(runOut.x(), 4), formatSigned(runOut.y(), 4));
  if (settings_.findsRotation) screen += fmt::format("  ROTATION {}\n", formatSigned(degreesFromRadians(rotation_), 4));
  if (tipping_) screen += fmt::format("  TIPPING {:.4f}\n", *tipping_);
  context_.record().screens.push_back(screen);
}

void Calibration::run() {
  if (context_.channel().description().spindleOrients) context_.channel().orientSpindle(0);
  findTop();
  touchPlane();
  if (settings_.tippingTolerance > 0) findTipping();
  keep();
}

}  // namespace

void calibrateToolProbe(Context& context, const PartInMachine& middle, double clearanceHeight) {
  Calibration(context, middle, clearanceHeight).run();
}

void calibrateFittedToolProbe(Context& context, double clearanceHeight) {
  requireCalibratingTool(context);
  const control::Channel& channel = context.channel();
  const auto& plane = context.control().coordinates.plane;
  ProgramPlace clearance = channel.position();
  clearance[plane.tool] = clearanceHeight;
  calibrateToolProbe(context, toolTouchProbe(context.control(), Contact::AsFitted).place,
                     channel.machineFromProgram(clearance)[plane.tool]);
}

}  // namespace probewright::cycles::heidenhain
