#include "cycles/heidenhain/calibration.hpp"

#include <fmt/format.h>

#include "control/alarm.hpp"
#include "cycles/heidenhain/html_log.hpp"
#include "metrology/fits.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;
using probing::HeidenhainProber;

namespace {

/// The circle of ball centres through touches at `count` angles, each from its pre-position.
metrology::Circle2 touchCircle(HeidenhainProber& prober, const CalibrationTask& task, const Vector2& centre,
                               int count) {
  const double step = 360.0 / count;
  const Vector3 middle(centre.x(), centre.y(), task.measuringHeight);
  const auto plan = probing::planCircle(middle, 2 * task.standardRadius, task.startAngle, step, count, task.side);
  const bool fromCentre = task.side == Side::Inside &&
                          task.standardRadius <= prober.probe().ballRadius + prober.probe().setUp + task.extraClearance;
  std::vector<Vector2> centres;
  for (const PlannedTouch& planned : plan) {
    const Vector3 start = fromCentre ? middle : prober.prePosition(planned, task.extraClearance);
    if (task.side == Side::Outside) {
      prober.moveHeightTo(task.travelHeight);
      prober.moveInPlane(start);
    }
    prober.moveTo(start);
    centres.push_back(prober.touch(planned).ballCentre.head<2>());
  }
  if (task.side == Side::Outside) prober.moveHeightTo(task.travelHeight);
  prober.moveInPlane(middle);
  const auto fit = metrology::fitCircle(centres);
  if (!fit) throw Alarm("Calibration not possible", fit.error().message, fit.error().advice);
  return fit->shape;
}

using Rows = std::vector<std::vector<std::string>>;

std::vector<std::string> row(const char* name, double before, double after) {
  return {name, fmt::format("{:.4f}", before), fmt::format("{:.4f}", after)};
}

/// An offset of the ball in the program's axes as one along the axes of the spindle, where it belongs.
Vector2 inSpindle(Context& context, const Vector2& offset) {
  const auto& plane = context.control().coordinates.plane;
  return plane.planeFromXyz(context.channel().spindleFromProgram() * plane.xyzFromPlane({offset.x(), offset.y(), 0}))
      .head<2>();
}

void log(Context& context, const Rows& rows) { addToHtmlLog(context, {"", "Before", "After"}, rows); }

}  // namespace

HeidenhainProber calibrationProber(Context& context) {
  probing::HeidenhainProbe probe = activeProbe(context.control(), Calibrated::NotYet);
  probe.tipOffset.setZero();
  probe.track = probe.aside;
  probe.directions = {};
  if (context.channel().description().spindleOrients) context.channel().orientSpindle(probe.calibrationAngle);
  return {context.channel(), context.control().coordinates.plane, probe};
}

CalibratedRadius calibrateRadius(Context& context, HeidenhainProber& prober, CalibrationTask task) {
  const metrology::Circle2 coarse = touchCircle(prober, task, task.centre, 4);
  const metrology::Circle2 fine = touchCircle(prober, task, coarse.centre, task.count);
  CalibratedRadius calibrated;
  calibrated.centre = {fine.centre.x(), fine.centre.y(), task.measuringHeight};
  calibrated.radius = probing::outwards(task.side) * (task.standardRadius - fine.radius);
  if (!(calibrated.radius > 0)) {
    throw Alarm("Calibration not possible",
                fmt::format("The measured ball radius {:.4f} mm is not positive", calibrated.radius),
                "check the radius of the standard (Q407)");
  }
  if (prober.probe().aside) {
    calibrated.centreOffset = Vector2::Zero();
    context.channel().orientSpindle(prober.probe().calibrationAngle);
    return calibrated;
  }
  const auto& control = context.control();
  const bool reverses =
      context.channel().description().spindleOrients && (control.isTNC640() || control.parameters.mp6160 != 0);
  if (reverses) {
    context.channel().orientSpindle(prober.probe().calibrationAngle + 180);
    const metrology::Circle2 reversed = touchCircle(prober, task, fine.centre, task.count);
    context.channel().orientSpindle(prober.probe().calibrationAngle);
    calibrated.centreOffset = (reversed.centre - fine.centre) / 2;
    calibrated.centre.head<2>() = (reversed.centre + fine.centre) / 2;
    // A probe that the spindle turns to every touch always signals with the same side: that side is calibrated.
    if (probing::HeidenhainProbe turned = activeProbe(control, Calibrated::NotYet); turned.track) {
      turned.directions = {};
      turned.tipOffset = inSpindle(context, *calibrated.centreOffset);
      HeidenhainProber turning(context.channel(), control.coordinates.plane, turned);
      const metrology::Circle2 circle = touchCircle(turning, task, calibrated.centre.head<2>(), task.count);
      calibrated.radius = probing::outwards(task.side) * (task.standardRadius - circle.radius);
      context.channel().orientSpindle(prober.probe().calibrationAngle);
    }
  }
  return calibrated;
}

void storeRadius(Context& context, const CalibratedRadius& calibrated) {
  auto& control = context.control();
  auto& tools = control.tables.tools;
  const std::string& tool = control.tool.row;
  Rows rows = {row("R", tools.numberOr(tool, "R", 0), calibrated.radius)};
  control.writeNumber(tools, tool, "R", calibrated.radius);
  if (calibrated.centreOffset) {
    const Vector2 offset = inSpindle(context, *calibrated.centreOffset);
    const bool inProbeTable = control.isTNC640();
    auto& table = inProbeTable ? control.tables.probes : tools;
    const std::string& key = inProbeTable ? control.tool.probeRow : tool;
    const char* names[] = {inProbeTable ? "CAL_OF1" : "CAL-OF1", inProbeTable ? "CAL_OF2" : "CAL-OF2"};
    for (int i = 0; i < 2; ++i) {
      rows.push_back(row(names[i], table.numberOr(key, names[i], 0), offset[i]));
      control.writeNumber(table, key, names[i], offset[i]);
    }
  }
  control.refreshTool();
  log(context, rows);
}

void storeLength(Context& context, double length) {
  auto& control = context.control();
  auto& tools = control.tables.tools;
  const std::string& tool = control.tool.row;
  const Rows rows = {row("L", tools.numberOr(tool, "L", 0), length)};
  control.writeNumber(tools, tool, "L", length);
  control.writeNumber(tools, tool, "DL", 0);
  control.refreshTool();
  log(context, rows);
}

}  // namespace probewright::cycles::heidenhain
