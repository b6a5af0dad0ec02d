#include "cycles/sinumerik/lathe_tool.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "control/sinumerik/length_type.hpp"
#include "control/sinumerik/measuring_data.hpp"
#include "control/sinumerik/tool_data.hpp"
#include "control/tool_spindle.hpp"
#include "cycles/sinumerik/turning.hpp"

namespace probewright::cycles::sinumerik {

namespace {

/// Where the tip points by its cutting edge position: along the 1st and 2nd
/// axis of the plane.
constexpr std::array<std::array<int, 2>, 9> pointingOf = {
    {{0, 0}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// Less of a direction than this counts as none.
constexpr double along = 1e-6;

}  // namespace

LatheTool::LatheTool(Context& context, ProbeSystem system)
    : context_(context),
      again_(context.control()),
      suppressed_(context.control().frames.suppressed,
                  context.control().frames.suppressed || system == ProbeSystem::Machine) {
  Control& control = context.control();
  const control::sinumerik::DataStore& data = control.data;
  const auto edge = toolEdge(data, control.tool.number, control.tool.edge).value_or(control::sinumerik::ToolEdge{});
  type_ = edge.type;
  position_ = edge.position;
  radius_ = control.tool.radius;
  cornerRadius_ = std::min(edge.cornerRadius, radius_);
  plane_ = control.workingPlane();
  const auto type = lengthType(control);
  lengthAxes_ = control::sinumerik::lengthAxes(planeOfLengths(data, control.plane), edge, type);
  if (edge.isTurning()) {
    kind_ = LatheToolKind::Turning;
    if (position_ < 1 || position_ > 8)
      context.alarm(61315, fmt::format("$TC_DP2 = {}, turning tools are measured with 1 to 8", position_));
  } else if (type_ >= 100 && type_ < 300) {
    kind_ = type_ < 200 ? LatheToolKind::Mill : LatheToolKind::Drill;
    if (type != control::sinumerik::LengthType::AsTurning) {
      // Length 1 lies in the 3rd axis of the plane then: a drill in G17 along
      // Z, in G19 along X.
      if (kind_ == LatheToolKind::Mill || control.plane == 18) {
        context.alarm(61314, kind_ == LatheToolKind::Mill
                                 ? "mills are measured with SD 42950 $SC_TOOL_LENGTH_TYPE = 2"
                                 : "with SD 42950 $SC_TOOL_LENGTH_TYPE = 0 a drill is measured "
                                   "in G17 or G19");
      }
      plane_ = control::WorkingPlane::ofG(18);
      axis_ = control.plane == 17 ? 0 : 1;
    }
  } else {
    context.alarm(61314, fmt::format("$TC_DP1 = {}: turning tools (5xy), mills "
                                     "(1xy) and drills (2xy) are measured",
                                     type_));
  }
  if (system == ProbeSystem::Workpiece) requireUnturned(context);
  control.handOverFrames();
  control.channel.setFollowing(control::Following::LinearAxes, control.channel.rotaryOffset);
  turnWithCarrier();
  programFromTool_ = control.channel.frame().linear().inverse() * programFromTool_;
}

void LatheTool::requireMultiples(double angle, double step, const char* what) const {
  const double tolerance = std::max(0.01, context_.control().data.number("$MNS_MEA_CM_ROT_AX_POS_TOL", {0}));
  if (std::abs(std::remainder(angle, step)) <= tolerance) return;
  context_.alarm(61329,
                 fmt::format("{} stands at {:.3f} degrees; multiples of {:.0f} are possible", what, angle, step));
}

/// The head as it stands now, if tool carriers count.
void LatheTool::turnWithCarrier() {
  Control& control = context_.control();
  if (!maskBit(control.data, "$MNS_MEA_FUNCTION_MASK", 16)) return;
  control::Channel& channel = control.channel;
  const machine::AxisPositions here = channel.axes();
  const Pose head = machine::baseFromSpindle(channel.description(), here);
  Matrix3 spindle = Matrix3::Identity();
  if (const auto* driven = control::toolSpindleOf(channel); driven != nullptr && kind_ == LatheToolKind::Turning) {
    const double angle = driven->toolSpindle().angle;
    requireMultiples(angle, 180, "the tool spindle");
    spindle = rotation(Vector3::UnitZ(), 180 * std::round(angle / 180)).linear();
  }
  const Matrix3 turned = head.linear() * spindle;
  carrier_ = !turned.isIdentity(1e-9);
  if (!carrier_) return;
  if (control.plane != 18) context_.alarm(61319, "tools on an orientable tool carrier are measured in G18");
  const Vector3 across = plane_.xyzFromPlane(Vector3::UnitZ());
  const Vector3 seen = head.linear() * across;
  if (!seen.isApprox(across, 1e-6))
    context_.alarm(61329,
                   "the tool carrier has turned the tool out of the "
                   "plane; only turns about Y are possible");
  if (kind_ != LatheToolKind::Turning) {
    const Vector3 first = plane_.planeFromXyz(head.linear() * plane_.xyzFromPlane(Vector3::UnitX()));
    requireMultiples(degreesFromRadians(std::atan2(first.y(), first.x())), 90, "the tool carrier");
  }
  // The tip where the head holds it: the linear axes are read as if they led it
  // there.
  const Vector3 reading = channel.machineFromAxes(here).vector() + channel.toolVector;
  channel.toolVector = reading - head * Vector3(spindle * -channel.toolVector);
  programFromTool_ = turned;
}

Vector2 LatheTool::inPlane(const Vector3& ofTool) const {
  return plane_.planeFromXyz(programFromTool_ * ofTool).head<2>();
}

Vector3 LatheTool::ofEdgePosition() const {
  const auto& pointing = pointingOf[static_cast<std::size_t>(std::clamp(position_, 0, 8))];
  return plane_.xyzFromPlane(Vector3(pointing[0], pointing[1], 0));
}

Vector2 LatheTool::nose() const {
  return kind_ == LatheToolKind::Turning ? inPlane(-radius_ * ofEdgePosition()) : Vector2::Zero();
}

Vector2 LatheTool::pointing() const { return inPlane(ofEdgePosition()); }

double LatheTool::holder(int axis) const {
  // The tool vector leads from the tip to the reference point, in machine
  // coordinates.
  const Matrix3 programFromMachine = context_.control().channel.frame().linear().inverse();
  const double way = plane_.planeFromXyz(programFromMachine * context_.control().channel.toolVector)[axis];
  return way > along ? 1 : way < -along ? -1 : 0;
}

std::array<std::optional<double>, 3> LatheTool::lengths(const std::array<std::optional<double>, 2>& deviation) const {
  std::array<std::optional<double>, 3> lengths;
  for (int axis = 0; axis < 2; ++axis) {
    if (!deviation[static_cast<std::size_t>(axis)]) continue;
    const Vector3 ofTool = programFromTool_.transpose() * plane_.xyzFromPlane(Vector3::Unit(axis));
    for (std::size_t i = 0; i < 3; ++i) {
      const double share = ofTool[lengthAxes_[i]];
      if (std::abs(share) < along) continue;
      lengths[i] = lengths[i].value_or(0) + share * *deviation[static_cast<std::size_t>(axis)];
    }
  }
  return lengths;
}

}  // namespace probewright::cycles::sinumerik
