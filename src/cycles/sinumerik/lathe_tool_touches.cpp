#include "cycles/sinumerik/lathe_tool_touches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "control/sinumerik/master_spindle.hpp"
#include "control/tool_spindle.hpp"

namespace probewright::cycles::sinumerik {

namespace {

/// The spindle that turns the tool, as far as M3 and SPOS reach it now.
struct ToolTurning {
  bool reached = false;
  machine::ToolSpindle* driven = nullptr;  ///< null: the main spindle carries the tool
};

ToolTurning turningOf(Control& control) {
  if (!control.channel.description().mainSpindle) return {control.channel.description().spindleOrients, nullptr};
  machine::ToolSpindle* driven = control::toolSpindleOf(control.channel);
  const bool master = masterSpindle(control) == control::sinumerik::drivenTools;
  return {driven != nullptr && master, driven};
}

}  // namespace

LatheToolTouches::LatheToolTouches(Context& context, const LatheTool& tool, const ToolProbeField& field, double feed,
                                   SpindleAngles angles)
    : context_(context),
      field_(field),
      prober_(context.channel(), tool.plane(), habitsOf(context.control(), context.measures())),
      feed_(feed),
      path_(context.real("S_FA")),
      angles_(angles) {
  if ((angles_.positions || angles_.reverses) && !turningOf(context.control()).reached)
    context.alarm(61372,
                  "the spindle of the tool is not the master spindle, "
                  "or cannot be positioned");
  trail_.push_back(at());
  if (angles_.positions && !angles_.reverses) positionSpindle(angles_.first);
}

void LatheToolTouches::positionSpindle(double degrees) {
  const ToolTurning turning = turningOf(context_.control());
  if (turning.driven == nullptr) return context_.positionSpindle(degrees);
  control::orientTool(context_.channel(), *turning.driven, degrees);
}

double LatheToolTouches::towardsMiddle(int axis) const {
  const double way = middle(axis) - at()[axis];
  if (std::abs(way) < 1e-6)
    context_.alarm(61326,
                   "the tool stands at the middle of the contact; S_MD "
                   "= 1 or 2 tells the direction");
  return way > 0 ? 1 : -1;
}

void LatheToolTouches::go(int axis, double place) {
  PlanePlace target = prober_.position();
  if (std::abs(target[axis] - place) < 1e-9) return;
  target[axis] = place;
  prober_.moveTo(target);
  trail_.push_back(at());
}

void LatheToolTouches::requireWay(int axis, const Vector2& from, double place, double radius) {
  const int other = 1 - axis;
  const double reach = radius - 1e-6;
  const bool beside = from[other] >= trigger(other, -1) + reach || from[other] <= trigger(other, 1) - reach;
  const bool clear = std::min(from[axis], place) >= trigger(axis, -1) + reach ||
                     std::max(from[axis], place) <= trigger(axis, 1) - reach;
  if (beside || clear) return;
  context_.alarm(61332, "the contact lies between the tool and the face that it is to touch");
}

double LatheToolTouches::touchOnce(int axis, double direction) {
  double sum = 0;
  for (int i = 0; i < context_.repetitions(); ++i) {
    const probing::ToolStroke stroke = {.start = prober_.position(),
                                        .direction = probing::axisDirection(axis, direction),
                                        .path = path_,
                                        .feed = feed_};
    sum += prober_.touch(stroke).tip[axis];
  }
  return sum / context_.repetitions();
}

double LatheToolTouches::touch(int axis, double direction) {
  if (!angles_.reverses) return touchOnce(axis, direction);
  positionSpindle(angles_.first);
  const double first = touchOnce(axis, direction);
  positionSpindle(angles_.second);
  return (first + touchOnce(axis, direction)) / 2;
}

void LatheToolTouches::back() {
  while (trail_.size() > 1) {
    trail_.pop_back();
    PlanePlace target = prober_.position();
    target = {trail_.back().x(), trail_.back().y(), target.z()};
    prober_.moveTo(target);
  }
}

}  // namespace probewright::cycles::sinumerik
