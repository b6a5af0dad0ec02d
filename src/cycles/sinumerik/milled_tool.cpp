#include "cycles/sinumerik/milled_tool.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "control/alarm.hpp"
#include "control/sinumerik/measuring_data.hpp"
#include "cycles/sinumerik/corrections.hpp"
#include "cycles/sinumerik/rotation_offset.hpp"
#include "cycles/sinumerik/tool_at_probe.hpp"
#include "cycles/sinumerik/tool_results.hpp"
#include "cycles/sinumerik/turning_touches.hpp"

namespace probewright::cycles::sinumerik {

using machine::Rotation;

namespace {

constexpr int mostEdges = 100;

enum class Dimension { Length, Radius };

/// Lets the spindle turn and stand during the cycle, and afterwards as before.
class SpindleForTool {
public:
  explicit SpindleForTool(Context& context)
      : channel_(context.channel()), before_(channel_.machine().spindle()), direction_(before_.rotation) {
    if (direction_ != Rotation::None) return;
    const double wanted = context.control().data.number("$SNS_MEA_CM_SPIND_ROT_DIR", {0});
    direction_ = wanted == 3 ? Rotation::Clockwise : Rotation::CounterClockwise;
  }
  void turn(double speed) { channel_.turnSpindle(direction_, speed); }
  void stand() {
    if (channel_.spindleRotation() != Rotation::None) channel_.turnSpindle(Rotation::None, 0);
  }
  void asBefore() {
    before_.rotation == Rotation::None ? stand() : channel_.turnSpindle(before_.rotation, before_.speed);
  }

private:
  control::Channel& channel_;
  machine::SpindleState before_;
  Rotation direction_;
};

/// What the call asks for, all of it looked at before anything moves.
struct Request {
  Dimension dimension = Dimension::Length;
  int axis = 0;                       ///< of a radius
  int offsetAxis = 0;                 ///< of a length
  double sign = 1;                    ///< of a touch of the side that the tool is on
  int edges = 0;                      ///< to be measured one by one; 0: the whole tool
  std::vector<TurningTouch> touches;  ///< empty: the tool stands
};

class Measurement {
public:
  Measurement(Context& context, const ToolProbeField& field, Request request)
      : context_(context),
        request_(std::move(request)),
        tool_(context, field, touchingFeed(context, field, Touching::Measures), belowOf(context, request_)),
        spindle_(context),
        centre_(field.centre(0), field.centre(1)) {}

  void run();

private:
  static double belowOf(const Context& context, const Request& request) {
    return request.dimension == Dimension::Radius ? context.real("S_ID") : 0;
  }
  bool isLength() const { return request_.dimension == Dimension::Length; }
  int component() const { return isLength() ? 0 : 3; }

  Vector2 placeOfLength() const;
  double measureWhole();
  std::vector<double> measureEdges();
  probing::ToolStrokeTouch touchTurning(const PlaneWay& direction);
  double findHighest(double angle);
  /// What turning as in the last touch adds to what is measured.
  double offsetOfTurning();
  /// What the tip says of the tool: actual less believed value.
  double difference(const PlanePlace& tip) const;
  void orientTo(double angle);
  void nameEdge(std::size_t number);
  void conclude(const std::vector<double>& edges, double longest);

  Context& context_;
  Request request_;
  ToolAtProbe tool_;
  SpindleForTool spindle_;
  Vector2 centre_;
};

Vector2 Measurement::placeOfLength() const {
  const ToolProbeField& field = tool_.field();
  Vector2 place = centre_;
  // Edges one by one are always measured beside the middle.
  if (request_.edges == 0 && 2 * tool_.radius() < field.size) return place;
  const double aside = tool_.radius() - context_.real("S_ID");
  const int axis = request_.offsetAxis;
  place[axis] += -request_.sign * aside;
  return place;
}

double Measurement::difference(const PlanePlace& tip) const {
  const ToolProbeField& field = tool_.field();
  if (isLength()) return tip.z() - tool_.top();
  const double trigger = field.trigger(request_.axis, request_.sign);
  return request_.sign * (trigger - tip[request_.axis]) - tool_.radius();
}

/// The touches with the turning tool, from where it is.
probing::ToolStrokeTouch Measurement::touchTurning(const PlaneWay& direction) {
  probing::ToolStrokeTouch touched;
  for (const TurningTouch& each : request_.touches) {
    const bool last = &each == &request_.touches.back();
    spindle_.turn(each.speed);
    Vector3 sum = Vector3::Zero();
    const int count = last ? context_.repetitions() : 1;
    for (int i = 0; i < count; ++i) {
      touched = tool_.touchTurning(direction, each.feed);
      sum += touched.tip.vector();
    }
    touched.tip = PlanePlace(sum / count);
  }
  return touched;
}

double Measurement::offsetOfTurning() {
  const auto& data = context_.control().data;
  if (rotationOffsetOf(data) == RotationOffset::OfTheUser)
    return rotationOffset(data, isLength() ? TurningDimension::Length : TurningDimension::Radius, tool_.radius(),
                          request_.touches.back().speed);
  const std::string complaint = rotationOffsetComplaint(data.number("$SNS_MEA_T_PROBE_OFFSET", {}));
  if (!complaint.empty())
    context_.control().panel.message(control::EventKind::Warning,
                                     fmt::format("CYCLE971: {}. {}", complaint, rotationOffsetAdvice),
                                     context_.channel().seconds());
  return 0;
}

double Measurement::measureWhole() {
  if (request_.touches.empty()) spindle_.stand();
  const PlaneWay direction = isLength() ? ToolAtProbe::down() : ToolAtProbe::along(request_.axis, request_.sign);
  isLength() ? tool_.goAbove(placeOfLength())
             : tool_.goBeside(request_.axis, request_.sign, centre_[1 - request_.axis]);
  if (request_.touches.empty()) return difference(tool_.touch(direction));
  return difference(touchTurning(direction).tip) + offsetOfTurning();
}

void Measurement::orientTo(double angle) { context_.positionSpindle(std::remainder(angle, 360)); }

/// The angle of the spindle, near `angle`, at which the edge stands out furthest towards the contact: where the
/// parabola through three touches has its highest point.
double Measurement::findHighest(double angle) {
  const double given = context_.control().machineData("$SCS_MEA_EDGE_SAVE_ANG");
  const double step = given > 0 ? given : 2;
  const PlaneWay direction = ToolAtProbe::along(request_.axis, request_.sign);
  const auto touchedAt = [&](double degrees) {
    orientTo(degrees);
    return difference(tool_.touch(direction));
  };
  // An edge that touches at once has been a little beside; with a helix a touch at another height is as high.
  for (int attempt = 0; attempt < 3; ++attempt) {
    const double before = touchedAt(angle - step), at = touchedAt(angle), after = touchedAt(angle + step);
    const double bend = before + after - 2 * at;
    const double flat = 1e-7;
    if (bend > -flat) return before > at + flat ? angle - step : after > at + flat ? angle + step : angle;
    const double shift = step * (before - after) / (2 * bend);
    if (std::abs(shift) <= step) return angle + shift;
    angle += std::copysign(step, shift);
  }
  return angle;
}

std::vector<double> Measurement::measureEdges() {
  // The side of the contact that the tool stands beside tells where an edge is.
  const int axis = isLength() ? request_.offsetAxis : request_.axis;
  tool_.goBeside(axis, request_.sign, centre_[1 - axis]);
  const auto touched = touchTurning(ToolAtProbe::along(axis, request_.sign));
  if (!touched.spindleAngle) context_.alarm(61372, "the machine does not say how its spindle stands at the touch");
  spindle_.stand();
  double first = *touched.spindleAngle;
  if (isLength()) {
    tool_.rise();
  } else {
    first = findHighest(first);
  }
  std::vector<double> edges;
  for (int edge = 0; edge < request_.edges; ++edge) {
    orientTo(first + 360.0 * edge / request_.edges);
    if (isLength() && edge == 0) tool_.goAbove(placeOfLength());
    const PlaneWay direction = isLength() ? ToolAtProbe::down() : ToolAtProbe::along(axis, request_.sign);
    edges.push_back(difference(tool_.touch(direction)));
  }
  return edges;
}

/// The result set last is that of one edge.
void Measurement::nameEdge(std::size_t number) {
  control::ResultRecord& result = context_.record().results.back();
  result.meaning += fmt::format(", edge {}", number);
  result.label += fmt::format(", edge {}", number);
  result.kind.of.item = static_cast<std::uint8_t>(number);
}

void Measurement::conclude(const std::vector<double>& edges, double longest) {
  const double believed = believedComponent(context_, component()), empirical = empiricalValue(context_);
  const auto both = [&](int actual, int difference, double value) {
    context_.result(actual, believed + value, {.nominal = believed});
    context_.result(difference, value - empirical);
  };
  both(isLength() ? 8 : 10, isLength() ? 9 : 11, longest);
  if (!edges.empty()) both(isLength() ? 12 : 14, isLength() ? 13 : 15, *std::ranges::min_element(edges));
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const int place = static_cast<int>(i) + (isLength() ? 300 : 100);
    context_.result(place, believed + edges[i], {.nominal = believed});
    nameEdge(i + 1);
    context_.result(place + 100, edges[i] - empirical);
    nameEdge(i + 1);
  }
  noteTool(context_);
  context_.setWayBack([this] { tool_.rise(); });

  const std::string what = isLength() ? "length 1" : "radius";
  const auto edgeName = [&](std::size_t i) { return fmt::format("{} of edge {}", what, i + 1); };
  std::vector<double> all = edges;
  all.push_back(longest);
  repeatIfBeyond(context_, all);
  // The longest edge first: it corrects the tool also where another one is broken.
  if (judgeTool(context_, longest, what) == Judgement::Corrects) correctEdge(context_, component(), longest);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (edges[i] != longest) judgeTool(context_, edges[i], edgeName(i));
  }
}

void Measurement::run() {
  if (request_.edges == 0) {
    const double whole = measureWhole();
    spindle_.asBefore();
    return conclude({}, whole);
  }
  const std::vector<double> edges = measureEdges();
  spindle_.asBefore();
  conclude(edges, *std::ranges::max_element(edges));
}

int edgesOf(Context& context) {
  const Control& control = context.control();
  const double teeth = control.data.number("$TC_DPNT", {control.tool.number, control.tool.edge});
  if (teeth < 1 || teeth > mostEdges || teeth != std::round(teeth))
    context.alarm(61319, fmt::format("single cutting edges: $TC_DPNT[{},{}] = {}, 1 to {} edges are measured",
                                     control.tool.number, control.tool.edge, teeth, mostEdges));
  return static_cast<int>(teeth);
}

/// The speeds and feeds of the call, or of the setting data.
std::vector<TurningTouch> touchesOf(Context& context, double radius) {
  const Control& control = context.control();
  if (!maskBit(control.data, "$SNS_MEA_FUNCTION_MASK_TOOL", 5)) {
    if (context.real("S_F1") > 0 || context.real("S_S1") > 0) {
      context.control().panel.message(control::EventKind::Warning,
                                      "CYCLE971: S_F1, S_S1 and so on do nothing while bit 5 of SD 54762 is not set",
                                      context.channel().seconds());
    }
    auto touches = turningTouches(control.data, radius);
    if (touches.empty()) context.alarm(61350, "SD 54670 to SD 54677 leave no speed or no feed");
    return touches;
  }
  std::vector<TurningTouch> touches = {{context.real("S_S1"), context.real("S_F1")}};
  if (context.real("S_S2") > 0) touches.push_back({context.real("S_S2"), context.real("S_F2")});
  if (context.real("S_S2") > 0 && context.real("S_S3") > 0)
    touches.push_back({context.real("S_S3"), context.real("S_F3")});
  int number = 1;
  for (const TurningTouch& each : touches) {
    if (!(each.speed > 0) || !(each.feed > 0))
      context.alarm(61350, fmt::format("S_S{} = {}, S_F{} = {}", number, each.speed, number, each.feed));
    ++number;
  }
  return touches;
}

void requireMilledTool(const Context& context, Dimension dimension) {
  const Control& control = context.control();
  const int type = control.tool.type;
  const bool mills = (type >= 100 && type < 300) || type == 700;
  auto refuse = [](int number, const std::string& detail) {
    throw control::Alarm(std::to_string(number), fmt::format("{}: {}", alarmText(number), detail),
                         std::string(alarmAdvice(number)));
  };
  if (!mills) refuse(61314, fmt::format("$TC_DP1 = {}: the cycle measures mills and drills, types 1xx and 2xx", type));
  if (dimension == Dimension::Radius && !(control.tool.radius > 0)) refuse(61351, "radius $TC_DP6");
}

Request requestOf(Context& context, const ToolProbeField& field) {
  Request request;
  const int code = context.integer("S_MA"), axis = code % 10, offset = code / 100;
  const bool length = axis == 3;
  if (axis < 1 || axis > 3 || context.digit("S_MA", 2) != 0 || offset < 0 || offset > 2 || offset == axis)
    context.alarm(61325, fmt::format("S_MA = {}", code));
  request.dimension = length ? Dimension::Length : Dimension::Radius;
  request.axis = axis - 1;
  request.offsetAxis = offset == 2 ? 1 : 0;
  requireMilledTool(context, request.dimension);
  requireUprightTool(context);
  if (length && context.integer("S_MD") == 1) context.alarm(61326, "the length is measured from above");
  request.sign = length ? sideOfTool(context, request.offsetAxis, field) : signOfTouch(context, request.axis, field);
  const bool turns = context.digit("S_MVAR", 1) == 2, edges = context.digit("S_MVAR", 3) == 1;
  if ((turns || edges) && !(context.control().tool.radius > 0)) context.alarm(61351, "radius $TC_DP6");
  if (edges) request.edges = edgesOf(context);
  if (edges && !context.channel().description().spindleOrients) context.alarm(61372);
  if (turns) request.touches = touchesOf(context, context.control().tool.radius);
  return request;
}

/// The trigger points that the measurement counts from.
void requireCalibrated(Context& context, ProbeSystem system, const ToolProbeField& field, const Request& request) {
  const auto refuse = [&](int axis, double sign) {
    context.alarm(61341, fmt::format("{} is 0", toolProbeTrigger(system, axis, sign)));
  };
  if (field.isEmpty()) refuse(2, -1);
  const bool side = request.dimension == Dimension::Radius || request.edges > 0;
  const int axis = request.dimension == Dimension::Radius ? request.axis : request.offsetAxis;
  if (!side || field.trigger(axis, request.sign) != 0) return;
  // In workpiece coordinates a side may lie at 0.
  if (field.trigger(axis, -request.sign) == 0 || !field.approaches(axis, request.sign)) refuse(axis, request.sign);
}

/// Neighbours of the measured edge that are above the contact as well may be longer than it.
void warnOfNeighbours(Context& context, const ToolProbeField& field, const Request& request) {
  if (request.edges < 2 || request.dimension == Dimension::Radius) return;
  const double apart = 2 * context.control().tool.radius * std::sin(std::numbers::pi / request.edges);
  if (apart > field.size / 2) return;
  context.control().panel.message(
      control::EventKind::Warning,
      fmt::format(
          "CYCLE971: the edges are {:.3f} mm apart, and the contact reaches {:.3f} mm from its middle: it feels the "
          "longest of those that are above it",
          apart, field.size / 2),
      context.channel().seconds());
}

}  // namespace

void measureMilledTool(Context& context) {
  const ProbeSystem system = systemOf(context);
  const ToolProbeField field = toolProbeField(context.control().data, system, toolProbeIndex(context));
  const Request request = requestOf(context, field);
  requireCalibrated(context, system, field, request);
  empiricalValue(context);
  warnOfNeighbours(context, field, request);
  Measurement(context, field, request).run();
}

}  // namespace probewright::cycles::sinumerik
