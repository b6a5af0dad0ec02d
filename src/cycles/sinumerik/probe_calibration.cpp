#include "cycles/sinumerik/probe_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "control/sinumerik/length_type.hpp"
#include "control/sinumerik/measuring_data.hpp"
#include "control/sinumerik/tool_data.hpp"

namespace probewright::cycles::sinumerik {

using control::sinumerik::DataKey;

namespace {

constexpr const char* ballDiameterName = "$SNS_MEA_WP_BALL_DIAM";

std::string triggerName(int axis, double sign) {
  return fmt::format("$SNS_MEA_WP_TRIG_{}_DIR_AX{}", sign < 0 ? "MINUS" : "PLUS", axis + 1);
}

}  // namespace

ProbeCalibration::ProbeCalibration(Context& context) : context_(context), dataSet_(context.dataSet()) {
  const double asked = context.real("S_VMS");
  feed_ = asked > 0 ? asked : context.control().machineData("$SCS_MEA_FEED_MEASURE", 300);
}

double ProbeCalibration::assumedRadius() const {
  const double calibrated = context_.prober().ballRadius();
  if (bent()) {
    const double reach = context_.prober().probe().triggerPlus[0];
    return reach > 0 ? reach : context_.control().tool.radius + calibrated;
  }
  return calibrated > 0 ? calibrated : context_.control().tool.radius;
}

PlanePlace ProbeCalibration::touch(const PartPoint& setpoint, const PlaneWay& direction, double path, double assumed) {
  return context_.prober().measureUncompensated(setpoint, direction, path, context_.repetitions(), assumed, feed_).tcp;
}

ProbeCalibration::Change ProbeCalibration::triggerChange(int axis, double sign, double value) {
  return {
      .name = triggerName(axis, sign), .result = 8 + 4 * axis + (sign < 0 ? 0 : 2), .value = value, .compared = true};
}

ProbeCalibration::Change ProbeCalibration::ballDiameterChange(double value) {
  return {.name = ballDiameterName, .result = 4, .value = value, .compared = true};
}

ProbeCalibration::Change ProbeCalibration::deviationChange(int axis, double value) {
  return {.name = fmt::format("$SNS_MEA_WP_POS_DEV_AX{}", axis + 1),
          .result = 20 + axis,
          .value = value,
          .compared = false};
}

void ProbeCalibration::setTrigger(int axis, double sign, double value) {
  // Data sets count in the directions of the machine.
  if (context_.prober().mirrored(axis)) {
    sign = -sign;
    value = -value;
  }
  changes_.push_back(triggerChange(axis, sign, value));
}

void ProbeCalibration::setBallDiameter(double value) { changes_.push_back(ballDiameterChange(value)); }

void ProbeCalibration::setDeviation(int axis, double value) {
  if (context_.prober().mirrored(axis)) value = -value;
  changes_.push_back(deviationChange(axis, value));
}

bool ProbeCalibration::bent() const { return context_.control().tool.type == 713; }

double ProbeCalibration::trigger(int axis, double sign) const {
  const std::string name = triggerName(axis, sign);
  const auto found = std::ranges::find(changes_, name, &Change::name);
  return found != changes_.end() ? found->value : context_.control().data.number(name, {dataSet_});
}

void ProbeCalibration::completeAxis(int axis, Deviation deviation) {
  const double plus = trigger(axis, 1), minus = trigger(axis, -1);
  if (bent()) {
    // The ball sits at the end of the arm, whose length the tool data have.
    const double radius = plus - context_.control().tool.radius;
    if (radius > 0) setBallDiameter(2 * radius);
  } else if (plus != 0 && minus != 0) {
    setBallDiameter(plus - minus);
    if (deviation == Deviation::Measured) changes_.push_back(deviationChange(axis, (plus + minus) / 2));
  } else {
    setBallDiameter(2 * std::abs(plus + minus));
  }
}

void ProbeCalibration::correctLength(int axis, double amount) {
  lengths_.emplace_back(axis, context_.prober().mirrored(axis) ? -amount : amount);
}

void ProbeCalibration::list(std::vector<int> axes, Listed listed) {
  listed_.push_back(ballDiameterChange(0));
  for (const int axis : axes) {
    for (const double sign : {-1.0, 1.0})
      listed_.push_back(triggerChange(axis, sign, 0));
  }
  if (listed == Listed::WithDeviations || listed == Listed::WithDeviationsAndLength) {
    for (const int axis : {0, 1})
      listed_.push_back(deviationChange(axis, 0));
  }
  listsLength_ = listed == Listed::WithLength || listed == Listed::WithDeviationsAndLength;
}

void ProbeCalibration::showUnchanged() {
  for (const Change& each : listed_) {
    if (std::ranges::find(changes_, each.name, &Change::name) != changes_.end()) continue;
    context_.result(each.result, context_.control().data.number(each.name, {dataSet_}));
    if (each.compared) context_.result(each.result + 1, 0);
  }
}

std::string ProbeCalibration::lengthName(int axis) const {
  const Control& control = context_.control();
  const auto edge = toolEdge(control.data, control.tool.number, control.tool.edge);
  const auto axes = lengthAxes(planeOfLengths(control.data, control.plane),
                               edge.value_or(control::sinumerik::ToolEdge{}), lengthType(control));
  const int geometryAxis = control.workingPlane().axis(axis);
  return fmt::format("$TC_DP{}", 3 + (std::ranges::find(axes, geometryAxis) - axes.begin()));
}

void ProbeCalibration::store() {
  Control& control = context_.control();
  for (const Change& change : changes_) {
    const double old = control.data.number(change.name, {dataSet_});
    context_.result(change.result, change.value);
    if (change.compared) context_.result(change.result + 1, change.value - old);
  }
  showUnchanged();
  context_.result(27, 0);  // the call of a calibration has no zero offset range
  context_.result(28, context_.real("S_TSA"));
  context_.noteCall();
  for (const Change& change : changes_) {
    // A first calibration starts from zeros: the safe area must hold a radius then, not a diameter.
    if (change.compared && change.name != ballDiameterName)
      context_.checkSafeArea(change.value - control.data.number(change.name, {dataSet_}));
  }
  for (const auto& [axis, amount] : lengths_)
    context_.checkSafeArea(amount);

  for (const Change& change : changes_) {
    control.write(DataKey(change.name, {dataSet_}), change.value);
    // $TC_DP6 of an L is the length of its arm.
    if (change.name == ballDiameterName && !bent() && maskBit(control.data, "$SNS_MEA_FUNCTION_MASK", 3)) {
      control.write(DataKey("$TC_DP6", {control.tool.number, control.tool.edge}), change.value / 2);
    }
  }
  control.write(DataKey("$SNS_MEA_WP_FEED", {dataSet_}), feed_);
  noteStatus();
  for (const auto& [axis, amount] : lengths_) {
    const DataKey key(lengthName(axis), {control.tool.number, control.tool.edge});
    control.write(key, control.data.number(key) + amount);
    context_.result(22, control.data.number(key));
  }
  if (listsLength_ && lengths_.empty()) {
    context_.result(22, control.data.number(lengthName(2), {control.tool.number, control.tool.edge}));
  }
  control.refreshTool();
}

void ProbeCalibration::noteStatus() {
  Control& control = context_.control();
  int axes = 0;
  for (int axis = 2; axis >= 0; --axis)
    axes = 10 * axes + (trigger(axis, -1) != 0 ? 1 : 0) + (trigger(axis, 1) != 0 ? 2 : 0);
  const bool deviation = std::ranges::any_of(
      changes_, [](const Change& change) { return change.name.starts_with("$SNS_MEA_WP_POS_DEV"); });
  const int general = (control.plane - 16) + (deviation ? 10 : 0) + (lengths_.empty() ? 0 : 100);
  control.write(DataKey("$SNS_MEA_WP_STATUS_RT", {dataSet_}), axes);
  control.write(DataKey("$SNS_MEA_WP_STATUS_GEN", {dataSet_}), general);
}

}  // namespace probewright::cycles::sinumerik
