#include "cycles/heidenhain/directional_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "control/alarm.hpp"
#include "control/heidenhain/deflection_table.hpp"
#include "cycles/heidenhain/html_log.hpp"
#include "metrology/fits.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;
using control::heidenhain::Deflection;
using probing::HeidenhainProber;

namespace {

/// From the main towards the minor axis and downwards: the direction of a touch on the sphere.
PlaneWay touchDirection(double polar, double azimuth) {
  const double p = radiansFromDegrees(polar), a = radiansFromDegrees(azimuth);
  return {-std::sin(p) * std::cos(a), -std::sin(p) * std::sin(a), -std::cos(p)};
}

/// Azimuths of program coordinates become those of the probe at its calibration angle.
double azimuthInSpindle(Context& context, const PlaneWay& direction) {
  const auto& plane = context.control().coordinates.plane;
  const Vector3 inSpindle =
      plane.planeFromXyz(context.channel().spindleFromProgram() * plane.xyzFromPlane(direction).vector());
  return degreesFromRadians(std::atan2(inSpindle.y(), inSpindle.x()));
}

/// Enters the table under the name in DR2TABLE, or under one made from the tool's number.
void storeDeflections(Context& context, const std::vector<Deflection>& rows) {
  auto& control = context.control();
  auto& tools = control.tables.tools;
  const std::string& tool = control.tool.row;
  std::string name = control::heidenhain::deflectionTableName(tools.text(tool, "DR2TABLE"));
  if (name.empty()) {
    std::string number = tool;
    std::ranges::replace(number, '.', '_');
    name = fmt::format("T{}.3DTC", number);
    control.writeText(tools, tool, "DR2TABLE", name);
  }
  auto table = control::heidenhain::deflectionTable(name, rows);
  if (!table) throw Alarm("Table write error", table.error().message, table.error().advice);
  control.tables.deflections.insert_or_assign(name, std::move(*table));
  double largest = 0;
  for (const Deflection& row : rows)
    largest = std::max(largest, std::abs(row.deviation));
  addToHtmlLog(context, {"3-D calibration", "Number of touches", "Largest deviation"},
               {{name, std::to_string(rows.size()), fmt::format("{:.4f}", largest)}});
}

}  // namespace

void requireDirectionalCalibration(Context& context) {
  auto& control = context.control();
  if (!control.parameters.option92) {
    throw Alarm("Option 92 not enabled", "3-D calibration data need the software option 3D-ToolComp", "set Q455 = 0");
  }
  if (!control.tables.tools.hasColumn("DR2TABLE")) {
    throw Alarm("Table write error", "The tool table has no column DR2TABLE for 3-D calibration data",
                "add the column or set Q455 = 0");
  }
}

void calibrateDirections(Context& context, const DirectionalTask& task) {
  requireDirectionalCalibration(context);
  auto& control = context.control();
  probing::HeidenhainProbe probe = activeProbe(control);
  probe.track = false;
  probe.directions = {};
  HeidenhainProber prober(context.channel(), control.coordinates.plane, probe);
  const double reach = task.standardRadius + probe.ballRadius;
  const double standOff = probe.setUp + task.extraClearance;
  const auto touchPole = [&](const Vector2& above) {
    prober.moveHeightTo(task.travelHeight);
    prober.moveInPlane({above.x(), above.y(), 0});
    return prober.stroke(probing::axisDirection(2, -1), standOff + 2 * task.standardRadius).ballCentre;
  };
  // Positions are those of the spindle axis; the ball, which stands beside it by the tip offset, must meet the pole.
  const BallCentre beside = touchPole(task.centre);
  const Vector2 offset = (beside - prober.position()).inPlane();
  Vector2 centre = task.centreKnown ? task.centre : Vector2(task.centre + offset);
  const BallCentre pole = touchPole(centre - offset);
  const PartPoint sphere(centre.x(), centre.y(), pole.z() - reach);

  std::vector<Deflection> rows = {{0, 0, 0}};
  for (int ring = 1; ring <= task.rings; ++ring) {
    const double polar = 90.0 * ring / task.rings;
    for (int i = 0; i < task.count; ++i) {
      const double azimuth = task.startAngle + 360.0 * i / task.count;
      const PlaneWay direction = touchDirection(polar, azimuth);
      const PlaneWay aside(offset.x(), offset.y(), 0);
      const PlannedTouch planned{sphere - direction * task.standardRadius - aside, direction};
      const BallCentre start = prober.prePosition(planned, task.extraClearance);
      if (i == 0 || task.between == probing::Between::AtClearanceHeight) {
        prober.moveHeightTo(task.travelHeight);
        prober.moveInPlane(start);
      } else {
        prober.moveOnArc(sphere - aside, 360.0 / task.count);
      }
      prober.moveTo(start);
      const BallCentre ball = prober.touch(planned).ballCentre;
      rows.push_back(
          {polar, normalizedDegrees(azimuthInSpindle(context, direction)), (partAt(ball) - sphere).norm() - reach});
    }
  }
  prober.moveHeightTo(task.travelHeight);
  storeDeflections(context, rows);
}

}  // namespace probewright::cycles::heidenhain
