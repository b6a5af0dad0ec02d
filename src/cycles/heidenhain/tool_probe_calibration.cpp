#include "cycles/heidenhain/tool_probe_calibration.hpp"

#include <fmt/format.h>

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

/// Touches of the four sides of the contact.
class Square {
public:
  Square(Context& context, probing::ToolProber& prober, const probing::ToolTouchProbe& probe)
      : plane_(context.control().coordinates.plane),
        prober_(prober),
        place_(probe.place),
        depth_(probe.depth),
        radius_(context.channel().toolRadius) {}

  /// Main axis, then the minor axis through the middle found in the main axis.
  void touch() {
    pair(0);
    pair(1);
  }
  /// Where the spindle's axis is when the tool is in the middle, along main (0) or minor axis (1).
  double middle(int axis) const { return place_[index(axis)]; }
  /// Half of the effective width of the contact.
  double half(int axis) const { return half_[static_cast<std::size_t>(axis)]; }

private:
  int index(int axis) const { return axis == 0 ? plane_.main : plane_.minor; }
  void pair(int axis) {
    const int i = index(axis);
    const double below = prober_.touchSide(axis, 1, radius_, depth_).tip[i];
    const double above = prober_.touchSide(axis, -1, radius_, depth_).tip[i];
    place_[i] = (below + above) / 2;
    half_[static_cast<std::size_t>(axis)] = (above - below) / 2 - radius_;
    prober_.setPlace(place_);
  }

  control::WorkingPlane plane_;
  probing::ToolProber& prober_;
  Vector3 place_;
  double depth_;
  double radius_;
  std::array<double, 2> half_ = {};
};

}  // namespace

void calibrateToolProbe(Context& context, const Vector3& middle, double clearanceHeight) {
  Control& control = context.control();
  control::Channel& channel = context.channel();
  const auto& plane = control.coordinates.plane;
  probing::ToolTouchProbe probe = toolTouchProbe(control, Contact::AsFitted);
  probe.place = middle;
  const bool orients = channel.description().spindleOrients;
  if (orients) channel.orientSpindle(0);
  probing::ToolProber prober(channel, plane, probe, clearanceHeight);
  probe.place[plane.tool] = prober.touchTop({0, 0}).tip[plane.tool];
  prober.setPlace(probe.place);
  prober.rise();
  // The first square finds the middle, the second the widths through the middle, the third, with the spindle turned by
  // 180 degrees, how far the tool runs out. Without orientation its run-out stays in the result.
  Square square(context, prober, probe);
  square.touch();
  square.touch();
  const Vector2 first(square.middle(0), square.middle(1)), half(square.half(0), square.half(1));
  if (orients) {
    channel.orientSpindle(180);
    square.touch();
  }
  const Vector2 turned(square.middle(0), square.middle(1));
  Vector3 place = probe.place;
  place[plane.main] = (first.x() + turned.x()) / 2;
  place[plane.minor] = (first.y() + turned.y()) / 2;
  const Vector2 runOut = (turned - first) / 2;
  prober.setPlace(place);
  prober.centre();

  constexpr std::array<double MachineParameters::*, 3> members = {
      &MachineParameters::contactX, &MachineParameters::contactY, &MachineParameters::contactZ};
  constexpr std::array<const char*, 3> names = {"TT centre, X", "TT centre, Y", "TT centre, Z"};
  for (std::size_t i = 0; i < 3; ++i)
    control.writeCalibration(members[i], names[i], place[static_cast<Eigen::Index>(i)]);
  control.writeCalibration(&MachineParameters::contactRadius1, "TT radius, main axis", half.x());
  control.writeCalibration(&MachineParameters::contactRadius2, "TT radius, minor axis", half.y());
  context.record().screens.push_back(
      fmt::format("TT CALIBRATED WITH TOOL {}\n  X {:+.4f}\n  Y {:+.4f}\n  Z {:+.4f}\n  RADIUS {:.4f} {:.4f}\n  "
                  "RUN-OUT OF THE TOOL "
                  "{:+.4f} {:+.4f}\n",
                  control.tool.row, place.x(), place.y(), place.z(), half.x(), half.y(), runOut.x(), runOut.y()));
}

void calibrateFittedToolProbe(Context& context, double clearanceHeight) {
  requireCalibratingTool(context);
  const control::Channel& channel = context.channel();
  const auto& plane = context.control().coordinates.plane;
  Vector3 clearance = channel.position();
  clearance[plane.tool] = clearanceHeight;
  calibrateToolProbe(context, toolTouchProbe(context.control(), Contact::AsFitted).place,
                     (channel.frame() * clearance)[plane.tool]);
}

}  // namespace probewright::cycles::heidenhain
