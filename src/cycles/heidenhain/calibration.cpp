#include "cycles/heidenhain/calibration.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "cycles/fit_records.hpp"
#include "cycles/heidenhain/html_log.hpp"
#include "metrology/fits.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;
using control::heidenhain::MachineParameters;
using probing::HeidenhainProber;

namespace {

/// The circle of ball centres through touches at `count` angles, each from its pre-position.
metrology::Circle2 touchCircle(Context& context, HeidenhainProber& prober, const CalibrationTask& task,
                               const Vector2& centre, int count) {
  const double step = 360.0 / count;
  const PartPoint middle(centre.x(), centre.y(), task.measuringHeight);
  const auto plan = probing::planCircle(middle, 2 * task.standardRadius, task.startAngle, step, count, task.side);
  const bool fromCentre = task.side == Side::Inside &&
                          task.standardRadius <= prober.probe().reach() + prober.probe().setUp + task.extraClearance;
  const bool around = task.side == Side::Outside && task.between == probing::Between::AtMeasuringHeight;
  std::vector<Vector2> centres;
  std::vector<std::size_t> places;
  for (const PlannedTouch& planned : plan) {
    const BallCentre start = fromCentre ? ballAt(middle) : prober.prePosition(planned, task.extraClearance);
    if (around && !centres.empty()) {
      prober.moveOnArc(middle, step);
    } else if (task.side == Side::Outside) {
      prober.moveHeightTo(task.travelHeight);
      prober.moveInPlane(start);
    }
    prober.moveTo(start);
    const EvaluatedTouch touch = prober.touch(planned);
    centres.push_back(touch.ballCentre.inPlane());
    places.push_back(touch.record);
  }
  if (task.side == Side::Outside) prober.moveHeightTo(task.travelHeight);
  prober.moveInPlane(ballAt(middle));
  const auto fit = metrology::fitCircle(centres, withCofactors);
  if (!fit) throw Alarm("Calibration not possible", fit.error().message, fit.error().advice);
  context.channel().journal().fit(recordOf(*fit, std::move(places)));
  return fit->shape;
}

using Rows = std::vector<std::vector<std::string>>;

std::vector<std::string> row(std::string_view name, double before, double after) {
  return {std::string(name), formatFixed(before, 4), formatFixed(after, 4)};
}

/// An offset of the ball in the program's axes as one along the axes of the spindle, where it belongs.
Vector2 inSpindle(Context& context, const Vector2& offset) {
  const auto& plane = context.control().coordinates.plane;
  const ProgramWay xyz = plane.xyzFromPlane(PlaneWay(offset.x(), offset.y(), 0));
  return plane.planeFromXyz(context.channel().spindleFromProgram() * xyz.vector()).head<2>();
}

/// The other way round.
Vector2 inProgram(Context& context, const Vector2& offset) {
  const auto& plane = context.control().coordinates.plane;
  const Vector3 xyz = plane.xyzFromPlane(Vector3(offset.x(), offset.y(), 0));
  return plane.planeFromXyz(ProgramWay(context.channel().spindleFromProgram().inverse() * xyz)).inPlane();
}

/// What two touches find while the ball, which stands aside along `towards`, is moved across it to either side.
struct Across {
  double half = 0;    ///< half the way between them
  double middle = 0;  ///< of the spindle axis, from the centre of the standard
};
Across touchAcross(HeidenhainProber& prober, const CalibrationTask& task, const Vector2& centre,
                   const Vector2& towards) {
  const bool inside = task.side == Side::Inside;
  const double offset = prober.probe().tipOffset.norm(), ball = prober.probe().ballRadius;
  const double locus = task.standardRadius - probing::outwards(task.side) * ball;
  // In a ring the spindle axis is in the middle, where there is room for the stylus; beside a stud the ball does.
  const double along = inside ? offset : 0;
  if (!(locus > along)) {
    throw Alarm("Calibration not possible",
                "The standard is too small for a stylus whose ball is so far from the spindle axis",
                "use a larger standard");
  }
  const Vector2 across(-towards.y(), towards.x());
  std::array<double, 2> found{};
  for (const int side : {0, 1}) {
    const double sign = side == 0 ? 1 : -1;
    const double away = std::sqrt(locus * locus - along * along) + probing::outwards(task.side) * ball;
    const Vector2 place = centre + along * towards + sign * away * across;
    const Vector2 direction = sign * probing::outwards(task.side) * across;
    const PlannedTouch planned{{place.x(), place.y(), task.measuringHeight}, {direction.x(), direction.y(), 0}};
    BallCentre start = prober.prePosition(planned, task.extraClearance);
    // Not beyond the middle of a narrow ring.
    const Vector2 middle = centre + along * towards - prober.tipOffsetNow().inPlane();
    if (inside && (start.inPlane() - middle).dot(sign * across) < 0) start = {middle.x(), middle.y(), start.z()};
    if (!inside) {
      prober.moveHeightTo(task.travelHeight);
      prober.moveInPlane(start);
    }
    prober.moveTo(start);
    found[static_cast<std::size_t>(side)] = (prober.touch(planned).ballCentre.inPlane() - centre).dot(across);
  }
  if (!inside) prober.moveHeightTo(task.travelHeight);
  prober.moveInPlane({centre.x(), centre.y(), task.measuringHeight});
  return {(found[0] - found[1]) / 2, (found[0] + found[1]) / 2};
}

/// A ball that stands aside. Turned to every touch, the spindle axis runs on a circle of radius a about the centre of
/// the standard, the ball on one of radius u, and the ball stands |u - a| aside. Held across two touches half a way h
/// apart, with the spindle axis e from the centre in the direction of the ball, h^2 = u^2 - (e + offset)^2, which
/// gives u.
CalibratedRadius calibrateAside(Context& context, HeidenhainProber& prober, const CalibrationTask& task) {
  const double out = probing::outwards(task.side);
  probing::HeidenhainProbe probe = prober.probe();
  CalibratedRadius calibrated{.standardRadius = task.standardRadius};
  Vector2 centre = task.centre;
  const Vector2 towards = probing::directionAt(task.startAngle).inPlane();
  constexpr int passes = 4;
  for (int pass = 0; pass < passes; ++pass) {
    // The tip stays at its height whatever radius the ball turns out to have.
    CalibrationTask now = task;
    now.measuringHeight += probe.ballRadius - prober.probe().ballRadius;
    now.travelHeight += probe.ballRadius - prober.probe().ballRadius;
    HeidenhainProber tracking(context.channel(), context.control().coordinates.plane, probe);
    const int count = pass == 0 ? 4 : task.count;
    const metrology::Circle2 circle = touchCircle(context, tracking, now, centre, count);
    centre = circle.centre;
    const double offset = probe.tipOffset.norm();
    const double a = task.side == Side::Inside ? circle.radius - offset : circle.radius + offset;
    probing::HeidenhainProbe held = probe;
    held.track = false;
    context.channel().orientSpindle(*tracking.orientationFor({towards.x(), towards.y(), 0}));
    HeidenhainProber holding(context.channel(), context.control().coordinates.plane, held);
    const Across across = touchAcross(holding, now, centre, towards);
    const double m = task.side == Side::Inside ? a : a - offset;
    const double u = (across.half * across.half + m * m) / (2 * m);
    probe.ballRadius = out * (task.standardRadius - u);
    const double along = task.side == Side::Inside ? u - a : a - u;
    if (!(probe.ballRadius > 0 && along > 0)) {
      throw Alarm("Calibration not possible",
                  fmt::format("The measured ball radius {:.4f} mm or its distance {:.4f} mm from the spindle axis is "
                              "not positive",
                              probe.ballRadius, along),
                  "check the radius of the standard (Q407), R of the tool and CAL_OF1, CAL_OF2");
    }
    probe.tipOffset =
        Eigen::Rotation2Dd(std::atan2(probe.tipOffset.y(), probe.tipOffset.x())) * Vector2(along, -across.middle);
    calibrated.passes.push_back(
        {pass == 0 ? "Coarse measurement" : "Measurement with angle tracking", count, centre, probe.ballRadius});
  }
  context.channel().orientSpindle(probe.calibrationAngle);
  calibrated.centre = {centre.x(), centre.y(), task.measuringHeight};
  calibrated.radius = probe.ballRadius;
  calibrated.centreOffset = inProgram(context, probe.tipOffset);
  return calibrated;
}

std::string millimetres(double length) { return formatFixed(length, 4); }

/// What the pass of `count` touches on `circle`, through the ball centres, tells.
void note(CalibratedRadius& calibrated, const CalibrationTask& task, std::string_view name, int count,
          const metrology::Circle2& circle) {
  calibrated.passes.push_back(
      {name, count, circle.centre, probing::outwards(task.side) * (task.standardRadius - circle.radius)});
}

/// The iTNC 530 keeps no log of calibrations.
bool keepsLog(Context& context) { return context.control().isTNC640(); }

void logPasses(Context& context, const CalibratedRadius& calibrated) {
  addToHtmlLog(context, {"", "Nominal"}, {{"Radius of the standard", millimetres(calibrated.standardRadius)}});
  Rows rows;
  for (const CalibrationPass& pass : calibrated.passes) {
    rows.push_back({std::string(pass.name), std::to_string(pass.touches), millimetres(pass.centre.x()),
                    millimetres(pass.centre.y()), millimetres(pass.ballRadius)});
  }
  addToHtmlLog(context, {"", "Number of touches", "Main axis", "Minor axis", "Ball radius"}, rows);
}

void logChanges(Context& context, const Rows& rows) { addToHtmlLog(context, {"", "Before", "After"}, rows); }

}  // namespace

HeidenhainProber calibrationProber(Context& context) {
  const Matrix3 axes = context.channel().spindleFromProgram();
  if (!axes.colwise().norm().isOnes(1e-9)) {
    throw Alarm("Coordinate transformation not permitted",
                "A scaling is active (cycle 11 or 26); standards have their true size only without it",
                "end the scaling before the calibration");
  }
  probing::HeidenhainProbe probe = activeProbe(context.control(), Calibrated::NotYet);
  if (!probe.aside) probe.tipOffset.setZero();
  probe.track = probe.aside;
  probe.directions = {};
  if (context.channel().description().spindleOrients) context.channel().orientSpindle(probe.calibrationAngle);
  return {context.channel(), context.control().coordinates.plane, probe};
}

CalibratedRadius calibrateRadius(Context& context, HeidenhainProber& prober, CalibrationTask task) {
  if (prober.probe().aside) return calibrateAside(context, prober, task);
  const metrology::Circle2 coarse = touchCircle(context, prober, task, task.centre, 4);
  const metrology::Circle2 fine = touchCircle(context, prober, task, coarse.centre, task.count);
  CalibratedRadius calibrated{.standardRadius = task.standardRadius};
  note(calibrated, task, "Coarse measurement", 4, coarse);
  note(calibrated, task, "Fine measurement", task.count, fine);
  calibrated.centre = {fine.centre.x(), fine.centre.y(), task.measuringHeight};
  calibrated.radius = probing::outwards(task.side) * (task.standardRadius - fine.radius);
  if (!(calibrated.radius > 0)) {
    throw Alarm("Calibration not possible",
                fmt::format("The measured ball radius {:.4f} mm is not positive", calibrated.radius),
                "check the radius of the standard (Q407)");
  }
  const auto& control = context.control();
  const bool reverses = task.centreOffset && context.channel().description().spindleOrients &&
                        (control.isTNC640() || control.parameters.mp6160 != 0);
  if (reverses) {
    context.channel().orientSpindle(prober.probe().calibrationAngle + 180);
    const metrology::Circle2 reversed = touchCircle(context, prober, task, fine.centre, task.count);
    context.channel().orientSpindle(prober.probe().calibrationAngle);
    note(calibrated, task, "Reversal measurement", task.count, reversed);
    calibrated.centreOffset = (reversed.centre - fine.centre) / 2;
    const Vector2 middle = (reversed.centre + fine.centre) / 2;
    calibrated.centre = {middle.x(), middle.y(), task.measuringHeight};
    // A probe that the spindle turns to every touch always signals with the same side: that side is calibrated.
    if (probing::HeidenhainProbe turned = activeProbe(control, Calibrated::NotYet); turned.track) {
      turned.directions = {};
      turned.tipOffset = inSpindle(context, *calibrated.centreOffset);
      HeidenhainProber turning(context.channel(), control.coordinates.plane, turned);
      const metrology::Circle2 circle = touchCircle(context, turning, task, middle, task.count);
      calibrated.radius = probing::outwards(task.side) * (task.standardRadius - circle.radius);
      note(calibrated, task, "Measurement with angle tracking", task.count, circle);
      context.channel().orientSpindle(prober.probe().calibrationAngle);
    }
  }
  return calibrated;
}

void storeRadius(Context& context, const CalibratedRadius& calibrated) {
  auto& control = context.control();
  if (!control.keepsCalibrationInTable()) {
    control.writeCalibration(&MachineParameters::calibratedRadius, "effective radius", calibrated.radius);
    if (calibrated.centreOffset) {
      const Vector2 offset = inSpindle(context, *calibrated.centreOffset);
      control.writeCalibration(&MachineParameters::calibratedOffset1, "centre offset, main axis", offset.x());
      control.writeCalibration(&MachineParameters::calibratedOffset2, "centre offset, minor axis", offset.y());
    }
    control.refreshTool();
    return;
  }
  auto& tools = control.tables.tools;
  const std::string& tool = control.tool.row;
  Rows rows = {row("R", tools.numberOr(tool, "R", 0), calibrated.radius)};
  std::vector<Control::NumberCell> cells = {{tools, tool, "R", calibrated.radius}};
  if (calibrated.centreOffset) {
    const Vector2 offset = inSpindle(context, *calibrated.centreOffset);
    const bool inProbeTable = control.isTNC640();
    auto& table = inProbeTable ? control.tables.probes : tools;
    const std::string& key = inProbeTable ? control.tool.probeRow : tool;
    using Names = std::array<control::heidenhain::NumberColumn, 2>;
    const Names names = inProbeTable ? Names{"CAL_OF1", "CAL_OF2"} : Names{"CAL-OF1", "CAL-OF2"};
    for (std::size_t i = 0; i < 2; ++i) {
      const double value = offset[static_cast<Eigen::Index>(i)];
      rows.push_back(row(names[i].name(), table.numberOr(key, names[i], 0), value));
      cells.push_back({table, key, names[i], value});
    }
  }
  control.writeNumbers(cells);
  control.refreshTool();
  if (!keepsLog(context)) return;
  logPasses(context, calibrated);
  logChanges(context, rows);
}

double activeLength(Context& context) { return context.channel().toolVector[context.control().coordinates.plane.tool]; }

void storeLength(Context& context, double length) {
  auto& control = context.control();
  if (!control.keepsCalibrationInTable()) {
    control.writeCalibration(&MachineParameters::calibratedLength, "effective length", length);
    control.refreshTool();
    return;
  }
  auto& tools = control.tables.tools;
  const std::string& tool = control.tool.row;
  Rows rows = {row("L", tools.numberOr(tool, "L", 0), length)};
  if (const double before = tools.numberOr(tool, "DL", 0); before != 0) rows.push_back(row("DL", before, 0));
  control.writeNumbers({{tools, tool, "L", length}, {tools, tool, "DL", 0}});
  control.refreshTool();
  if (!keepsLog(context)) return;
  addToHtmlLog(context, {"", "Nominal"}, {{"Reference point for length", millimetres(context.q(434))}});
  logChanges(context, rows);
}

}  // namespace probewright::cycles::heidenhain
