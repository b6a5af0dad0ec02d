#include "cycles/sinumerik/tool_probe_calibration.hpp"

#include <fmt/format.h>

#include <vector>

#include "cycles/sinumerik/tool_at_probe.hpp"
#include "cycles/sinumerik/tool_results.hpp"

namespace probewright::cycles::sinumerik {

using control::sinumerik::DataKey;

namespace {

class Calibration {
public:
  Calibration(Context& context, ProbeSystem system, int index, const ToolProbeField& field)
      : context_(context),
        system_(system),
        index_(index),
        feed_(touchingFeed(context, field, Touching::Calibrates)),
        tool_(context, field, feed_),
        reverses_(context.digit("S_MVAR", 7) == 1) {}

  void oneAxis(int axis, std::optional<int> offsetAxis);
  void complete();
  void store();
  void rise() { tool_.rise(); }

private:
  /// The place of the tip, in the axis, when it touches that side; the mean of both positions of a spindle that is
  /// reversed.
  double side(int axis, double sign, double across);
  /// Where the middle of the contact is along an axis, found on its two sides.
  double middle(int axis, double across);
  void calibrateTop(const Vector2& place);
  void calibrateSide(int axis, double sign, double across);
  void found(int axis, double sign, double trigger) { found_.push_back({axis, sign, trigger}); }

  struct Found {
    int axis;
    double sign, trigger;
  };
  Context& context_;
  ProbeSystem system_;
  int index_;
  double feed_;
  ToolAtProbe tool_;
  bool reverses_;
  std::vector<Found> found_;
};

double Calibration::side(int axis, double sign, double across) {
  tool_.goBeside(axis, sign, across);
  const PlaneWay direction = ToolAtProbe::along(axis, sign);
  const double standing = tool_.touch(direction)[axis];
  if (!reverses_) return standing;
  const double before = context_.channel().spindleAngle();
  context_.positionSpindle(before + 180);
  const double reversed = tool_.touch(direction)[axis];
  context_.positionSpindle(before);
  return (standing + reversed) / 2;
}

double Calibration::middle(int axis, double across) {
  double sum = 0;
  for (const double sign : {1.0, -1.0}) {
    sum += side(axis, sign, across);
    tool_.rise();
  }
  return sum / 2;
}

void Calibration::calibrateTop(const Vector2& place) {
  tool_.goAbove(place);
  const double trigger = tool_.touch(ToolAtProbe::down()).z();
  found(2, -1, trigger);
  tool_.setTop(trigger);
}

void Calibration::calibrateSide(int axis, double sign, double across) {
  found(axis, sign, side(axis, sign, across) + sign * tool_.radius());
}

void Calibration::oneAxis(int axis, std::optional<int> offsetAxis) {
  const ToolProbeField& field = tool_.field();
  Vector2 centre(field.centre(0), field.centre(1));
  if (axis == 2) {
    const double aside = tool_.radius() - context_.real("S_ID");
    if (offsetAxis && 2 * tool_.radius() >= field.size)
      centre[*offsetAxis] += tool_.prober().position()[*offsetAxis] < centre[*offsetAxis] ? -aside : aside;
    return calibrateTop(centre);
  }
  const double sign = signOfTouch(context_, axis, field);
  if (offsetAxis) centre[*offsetAxis] = middle(*offsetAxis, centre[axis]);
  calibrateSide(axis, sign, centre[1 - axis]);
}

void Calibration::complete() {
  const ToolProbeField& field = tool_.field();
  Vector2 centre(field.centre(0), field.centre(1));
  // The tool axis moves first, then those of the plane.
  tool_.prober().moveHeightTo(tool_.top() + tool_.path());
  calibrateTop(centre);
  const auto bothSides = [&](int axis) { return field.approaches(axis, 1) && field.approaches(axis, -1); };
  bool exact = false;
  for (const int axis : {0, 1}) {
    const int other = 1 - axis;
    if (!field.approaches(axis, 1) && !field.approaches(axis, -1)) continue;
    if (!exact && bothSides(other)) centre[other] = middle(other, centre[axis]);
    exact = true;
    double sum = 0;
    for (const double sign : {1.0, -1.0}) {
      if (!field.approaches(axis, sign)) continue;
      calibrateSide(axis, sign, centre[other]);
      sum += found_.back().trigger;
      tool_.rise();
    }
    if (bothSides(axis)) centre[axis] = sum / 2;
  }
  tool_.goAbove(centre);
}

void Calibration::store() {
  Control& control = context_.control();
  const auto nameOf = [&](const Found& each) { return toolProbeTrigger(system_, each.axis, each.sign); };
  for (const Found& each : found_) {
    const int place = 8 + 4 * each.axis + (each.sign > 0 ? 2 : 0);
    const double before = control.data.number(nameOf(each), {index_});
    context_.result(place, each.trigger, {.nominal = before});
    context_.result(place + 1, each.trigger - before);
  }
  context_.result(27, 0);  // a calibration has no zero offset range
  context_.result(28, context_.real("S_TSA"));
  for (const Found& each : found_)
    context_.checkSafeArea(each.trigger - control.data.number(nameOf(each), {index_}));
  for (const Found& each : found_)
    control.write(DataKey(nameOf(each), {index_}), each.trigger);
  control.write(DataKey(toolProbeDatum(system_, "FEED"), {index_}), feed_);
}

void requireCalibratingTool(Context& context) {
  const Control& control = context.control();
  if (control.tool.type != 725 && control.tool.type != 120)
    context.alarm(61314, fmt::format("$TC_DP1 = {}: calibrate with a calibrating tool, type 725, or a mill, type 120",
                                     control.tool.type));
}

}  // namespace

void calibrateToolProbe(Context& context) {
  requireCalibratingTool(context);
  requireUprightTool(context);
  const ProbeSystem system = systemOf(context);
  const int index = toolProbeIndex(context);
  const ToolProbeField field = toolProbeField(context.control().data, system, index);
  const bool complete = context.digit("S_MVAR", 6) == 1, reverses = context.digit("S_MVAR", 7) == 1;
  if (field.isEmpty())
    context.alarm(61341, fmt::format("{} has no approximate position", toolProbeDatum(system, "TRIG_...")));
  if (complete && !field.approaches(2, -1))
    context.alarm(61319, fmt::format("{}[{}] = {} does not let the tool come from above, which a complete calibration "
                                     "begins with",
                                     toolProbeDatum(system, "AX_DIR_AUTO_CAL"), index, field.directions));
  const int axis = complete ? 0 : context.integer("S_MA") % 10 - 1, offset = context.integer("S_MA") / 100;
  if (!complete && (axis < 0 || axis > 2 || offset > 2 || context.digit("S_MA", 2) != 0 || offset - 1 == axis))
    context.alarm(61325, fmt::format("S_MA = {}", context.integer("S_MA")));
  if (axis == 2 && context.integer("S_MD") == 1) context.alarm(61326, "the 3rd axis is calibrated from above");
  if (axis < 2 && !(context.control().tool.radius > 0)) context.alarm(61351, "radius $TC_DP6 of the calibrating tool");
  if (reverses && axis == 2) context.alarm(61307, "the spindle is reversed for the axes of the plane only");
  if (reverses && !context.channel().description().spindleOrients) context.alarm(61372);

  if (context.channel().spindleRotation() != machine::Rotation::None)
    context.channel().turnSpindle(machine::Rotation::None, 0);
  Calibration calibration(context, system, index, field);
  complete ? calibration.complete() : calibration.oneAxis(axis, offset == 0 ? std::nullopt : std::optional(offset - 1));
  context.setWayBack([&calibration] { calibration.rise(); });
  calibration.store();
}

}  // namespace probewright::cycles::sinumerik
