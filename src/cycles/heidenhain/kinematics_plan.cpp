#include "cycles/heidenhain/kinematics_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "control/heidenhain/kinematics.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;

std::array<AxisRequest, 3> axisRequests(const std::function<double(std::uint32_t)>& value) {
  std::array<AxisRequest, 3> requests;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t first = 411 + 4 * i;
    requests[i] = {static_cast<char>('A' + i), value(first), value(first + 1), value(first + 2),
                   static_cast<int>(std::lround(value(first + 3)))};
  }
  return requests;
}

std::vector<double> measuringAngles(const AxisRequest& request, double hirthGrid) {
  std::vector<double> angles;
  const double step = request.points > 1 ? (request.end - request.start) / (request.points - 1) : 0;
  for (int i = 0; i < request.points; ++i) {
    const double angle = request.start + i * step;
    angles.push_back(hirthGrid > 0 ? hirthGrid * std::round(angle / hirthGrid) : angle);
  }
  return angles;
}

bool atReference(double degrees) { return std::abs(std::remainder(degrees, 360.0)) < 1e-6; }

void requireKinematicsOption(Context& context) {
  if (context.control().parameters.option48) return;
  throw Alarm("Function not enabled", "Cycles 450 to 453 belong to software option 48, KinematicsOpt",
              "enable the option (option48 in [parameters])");
}

void requireRetraction(Context& context, std::size_t axis) {
  if (context.control().kinematics->hirthGrid[axis] == 0 || context.q(408) > 0) return;
  throw Alarm("Cycle parameter wrong",
              fmt::format("Axis {} has a Hirth coupling: it leaves its grid to move, and the probe must be away (Q408)",
                          context.channel().description().axes[axis].name),
              "enter a retraction height Q408 above 0");
}

namespace {

/// The TNC 640 refuses to measure with M128 or FUNCTION TCPM; the iTNC 530 ends them, also for what comes after the
/// cycle.
void endToolGuidance(Context& context) {
  control::Channel& channel = context.channel();
  if (channel.holdTip && context.control().isTNC640())
    throw Alarm("TCPM not permitted", "M128 or FUNCTION TCPM is active", "end it with M129 or FUNCTION RESET TCPM");
  channel.holdTip = false;
}

}  // namespace

void beginKinematicsMeasurement(Context& context) {
  requireKinematicsOption(context);
  auto& control = context.control();
  control::Channel& channel = control.channel;
  if (control.tool.axis != 'Z') {
    throw Alarm("Tool axis not permitted", "Kinematics are measured with the tool axis Z only",
                "call the touch probe with TOOL CALL ... Z");
  }
  endToolGuidance(context);
  if (context.q(408) == 0 && !control.parameters.toolCentreOption) {
    throw Alarm("Cycle parameter wrong", "Without TCPM the probe cannot stay at the sphere while rotary axes move",
                "enter a retraction height Q408 above 0");
  }
  if (control.parameters.strobeRotaryAxes < 0) return;
  const machine::MachineDescription& machine = channel.description();
  const machine::AxisPositions now = channel.axes();
  for (std::size_t i = 0; i < machine.axes.size(); ++i) {
    if (machine.axes[i].kind != machine::AxisKind::Rotary || atReference(now[i])) continue;
    throw Alarm(
        "Rotary axes not at 0",
        fmt::format("Axis {} stands at {} degrees; with an M function that positions the rotary axes ({}) "
                    "they begin at 0",
                    machine.axes[i].name, formatShortest(now[i]), control.isTNC640() ? "mStrobeRotAxPos" : "MP6602"),
        "move the rotary axes to 0 before the cycle");
  }
}

MeasuringPlan measuringPlan(Context& context) {
  beginKinematicsMeasurement(context);
  const auto& control = context.control();
  const machine::MachineDescription& machine = control.channel.description();
  MeasuringPlan plan;
  for (const AxisRequest& request : axisRequests([&](std::uint32_t q) { return context.q(static_cast<int>(q)); })) {
    const auto axis = machine.axisIndex(std::string(1, request.name));
    if (!axis || machine.axes[*axis].kind != machine::AxisKind::Rotary) continue;
    const double grid = control.kinematics->hirthGrid[*axis];
    plan.incidence[*axis] = grid > 0 ? grid * std::round(request.incidence / grid) : request.incidence;
    if (request.points == 0) continue;
    requireRetraction(context, *axis);
    AxisSeries series{*axis, request, measuringAngles(request, grid)};
    if (!control.isTNC640() && std::ranges::any_of(series.angles, atReference)) {
      throw Alarm("Measuring position not permitted",
                  fmt::format("A measuring point of axis {} lies at 0 or 360 degrees", request.name),
                  "choose other start and end angles, or another number of points");
    }
    std::erase_if(series.angles, atReference);
    if (series.angles.empty()) {
      throw Alarm("Measuring position not permitted",
                  fmt::format("Axis {} has no measuring point beside the one at 0", request.name),
                  "choose other start and end angles");
    }
    plan.series.push_back(std::move(series));
  }
  return plan;
}

void adviseOnPositions(CallRules& call, std::optional<double> mode) {
  const auto known = [&](std::uint32_t address) { return call.number(address); };
  bool measures = false, complete = true;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t first = 411 + 4 * i, count = first + 3;
    const auto start = known(first), end = known(first + 1), points = known(count);
    if (!points) complete = false;
    // What is out of its range is told elsewhere.
    constexpr int mostPoints = 12;
    if (!points || !(*points >= 1 && *points <= mostPoints)) continue;
    measures = true;
    const char name = static_cast<char>('A' + i);
    const bool backlash = known(432).value_or(0) != 0;
    const auto warn = [&](std::uint32_t address, std::string message, std::string advice) {
      call.add(address, std::move(message), std::move(advice), Severity::Warning);
    };
    if (backlash && *points < 8) {
      warn(count, fmt::format("{} measuring points of {} tell little of its backlash", *points, name),
           "measure 8 to 12 points, or set Q432 = 0");
    } else if (mode == 0.0 && !backlash && (*points < 4 || *points > 8)) {
      warn(count,
           fmt::format("{} measuring points of {}: the accuracy of a machine is checked with 4 to 8", *points, name),
           "measure 4 to 8 points over as much of the range as possible");
    } else if (mode.value_or(0) > 0 && !backlash && *points > 6) {
      warn(count, fmt::format("{} measuring points of {} bring hardly more than 6", *points, name),
           "optimise with 3 to 6 points");
    }
    if (mode.value_or(0) >= 2 && *points < 2)
      warn(count, fmt::format("one measuring point of {} does not tell its direction", name), "measure 2 or more");
    if (!start || !end) continue;
    const AxisRequest request{name, *start, *end, 0, static_cast<int>(*points)};
    const std::vector<double> angles = measuringAngles(request);
    double valuation = 0;
    for (std::size_t at = 0; at < angles.size(); ++at) {
      valuation += 2 - 2 * std::cos(radiansFromDegrees(angles[at]));
      if (atReference(angles[at])) {
        const std::string message =
            fmt::format("measuring point {} of {} lies at 0, where the reference is measured", at + 1, name);
        if (call.kind() == ControlKind::iTNC530) {
          call.add(first, message, "choose other angles, or another number of points");
        } else {
          warn(first, message + "; it is left out", "choose other angles, or another number of points");
        }
      }
      const bool twice = std::any_of(angles.begin(), angles.begin() + static_cast<std::ptrdiff_t>(at),
                                     [&](double other) { return atReference(angles[at] - other); });
      if (twice)
        warn(first, fmt::format("{} is measured twice at {} degrees", name, formatShortest(angles[at])),
             "choose angles that do not differ by a full turn");
    }
    if (valuation < 2 - 1e-9)
      warn(
          first,
          fmt::format("the measuring points of {} tell its place badly: the sum of 2 - 2 cos of their angles is {:.2f}",
                      name, valuation),
          "spread them until it is 2, or better 4: one at 90 degrees, two at 90 and -90");
  }
  if (mode && complete && !measures)
    call.add(414, "no axis is measured: Q414, Q418 and Q422 are 0", "enter numbers of measuring points",
             Severity::Warning);
}

}  // namespace probewright::cycles::heidenhain
