#include "cycles/heidenhain/kinematics_measurement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "control/alarm.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;
using control::heidenhain::KinematicData;
using kinematics::ChainFit;
using kinematics::ChainFitTask;
using kinematics::SphereSighting;
using machine::RotaryCorrection;

namespace {

/// No backlash is measured on a smaller circle.
constexpr double smallestCircle = 1;

/// The sphere where the axis stands at `angle`; with an overrun reached from both sides. What is fitted was reached in
/// +: of all axes alike, so that play between encoder and table shifts no sphere against another.
void measureAt(SphereSearch& search, MeasuredSeries& series, machine::AxisPositions posture, double angle,
               double overrun) {
  const std::vector<std::size_t> axis = {series.plan.axis};
  const auto reach = [&](double degrees) {
    posture[series.plan.axis] = degrees;
    search.turnTo(posture, axis);
  };
  if (overrun == 0) {
    reach(angle);
    series.sightings.push_back(search.measure().sighting);
    return;
  }
  std::pair<SphereSighting, SphereSighting> both;
  for (const double side : {overrun, -overrun}) {
    reach(angle - side);
    reach(angle);
    (side > 0 ? both.first : both.second) = search.measure().sighting;
  }
  series.sightings.push_back(both.first);
  series.approaches.push_back(both);
}

/// By how much the axis overruns its positions; 0 where its backlash is not measured.
double overrunOf(Context& context, std::size_t axis) {
  const auto& control = context.control();
  const bool measured = control.parameters.strobeRotaryAxes < 0 && control.kinematics->hirthGrid[axis] == 0;
  return measured ? context.q(432) : 0;
}

/// The axes that stand while another one is measured reach their places in + where their own backlash is measured.
void approachInPlus(Context& context, SphereSearch& search, const MeasuringPlan& plan, std::size_t measured,
                    const machine::AxisPositions& posture) {
  std::vector<std::size_t> standing;
  machine::AxisPositions below = posture;
  for (const AxisSeries& other : plan.series) {
    const double overrun = std::abs(overrunOf(context, other.axis));
    if (other.axis == measured || overrun == 0) continue;
    standing.push_back(other.axis);
    below[other.axis] -= overrun;
  }
  search.turnTo(below, standing);
  search.turnTo(posture, standing);
}

const RotaryCorrection& correctionOf(const std::vector<RotaryCorrection>& corrections, std::size_t axis) {
  return *std::ranges::find(corrections, axis, &RotaryCorrection::axis);
}

/// How the seen sphere moves while the axis turns, mm per radian: the lever about the axis.
Vector3 tangent(const ChainFitTask& task, const machine::MachineDescription& machine, const SphereSighting& sighting,
                std::size_t axis) {
  constexpr double turn = 1;  // degrees; the difference is exact for any
  SphereSighting after = sighting, before = sighting;
  after.axes[axis] += turn;
  before.axes[axis] -= turn;
  return (seen(task, machine, after) - seen(task, machine, before)) / (2 * std::sin(radiansFromDegrees(turn)));
}

std::string degrees(const std::optional<double>& value) { return value ? formatFixed(*value, 6) : "-"; }
std::string length(double value) { return formatFixed(value, 4); }

}  // namespace

std::vector<MeasuredSeries> measureSeries(Context& context, SphereSearch& search, const MeasuringPlan& plan) {
  std::vector<std::size_t> axes;
  for (const char name : {'A', 'B', 'C'}) {
    const auto axis = context.channel().description().axisIndex(std::string(1, name));
    if (axis && context.channel().description().axes[*axis].kind == machine::AxisKind::Rotary) axes.push_back(*axis);
  }
  for (const std::size_t axis : axes)
    requireRetraction(context, axis);
  std::vector<MeasuredSeries> all;
  search.moveOver();
  for (const AxisSeries& planned : plan.series) {
    MeasuredSeries series{planned, {}, {}};
    machine::AxisPositions posture = plan.incidence;
    posture[planned.axis] = 0;
    search.turnTo(posture, axes, all.empty() ? SphereSearch::Order::OneByOne : SphereSearch::Order::Together);
    approachInPlus(context, search, plan, planned.axis, posture);
    const double overrun = overrunOf(context, planned.axis);
    measureAt(search, series, posture, 0, overrun);
    for (const double angle : planned.angles)
      measureAt(search, series, posture, angle, overrun);
    all.push_back(std::move(series));
  }
  return all;
}

ChainFitTask fitTaskOf(Context& context, std::span<const MeasuredSeries> series) {
  const auto& kinematics = *context.control().kinematics;
  ChainFitTask task{.built = kinematics.built(),
                    .believed = kinematics.data().axes,
                    .reference = context.control().coordinates.preset.rotaryOffset,
                    .free = {},
                    .tipDeviation = context.channel().tipDeviation,
                    .sphere = {},
                    .shift = false,
                    .beforeShift = {}};
  for (const MeasuredSeries& each : series)
    task.free.push_back({.axis = each.plan.axis});
  return task;
}

std::vector<SphereSighting> allSightings(std::span<const MeasuredSeries> series) {
  std::vector<SphereSighting> all;
  for (const MeasuredSeries& each : series)
    all.insert(all.end(), each.sightings.begin(), each.sightings.end());
  return all;
}

ChainFit fitOrAlarm(Context& context, const ChainFitTask& task, std::span<const MeasuredSeries> series) {
  auto fit = fitChain(task, allSightings(series));
  if (!fit) throw Alarm("Kinematics not determined", fit.error().message, fit.error().advice);
  for (const std::string& open : fit->undetermined)
    context.warn(open + "; it stays as it is");
  return std::move(*fit);
}

std::vector<AxisFindings> findingsOf(const ChainFitTask& task, const ChainFit& fit,
                                     std::span<const MeasuredSeries> series) {
  const machine::MachineDescription believed = machine::corrected(task.built, task.believed);
  ChainFitTask after = task;
  after.tipDeviation = [&](const machine::AxisPositions& axes) {
    return Vector3(fit.shift + (task.tipDeviation ? task.tipDeviation(axes) : Vector3(Vector3::Zero())));
  };
  std::vector<std::vector<SphereSighting>> sightings;
  for (const MeasuredSeries& each : series)
    sightings.push_back(each.sightings);
  const std::vector<double> quality = valuations(task, sightings);
  std::vector<AxisFindings> all;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const MeasuredSeries& each = series[i];
    const std::size_t axis = each.plan.axis;
    AxisFindings found;
    found.valuation = quality[i];
    const double count = static_cast<double>(each.sightings.size() - 1);
    const auto error = [&](const ChainFitTask& with, const machine::MachineDescription& machine, std::size_t at) {
      return Vector3(seen(with, machine, each.sightings[at]) - seen(with, machine, each.sightings.front()));
    };
    double positioning = 0;
    for (std::size_t at = 0; at < each.sightings.size(); ++at) {
      const Vector3 lever = tangent(after, fit.machine, each.sightings[at], axis);
      found.radius += lever.norm() / static_cast<double>(each.sightings.size());
      if (at == 0) continue;
      const double measured = error(task, believed, at).norm();
      const Vector3 left = error(after, fit.machine, at);
      found.scatter += measured * measured / count;
      found.attainable += left.squaredNorm() / count;
      found.maximum = std::max(found.maximum, measured);
      found.attainableMaximum = std::max(found.attainableMaximum, left.norm());
      if (lever.norm() > smallestCircle) positioning -= left.dot(lever) / lever.squaredNorm() / count;
    }
    found.scatter = std::sqrt(found.scatter);
    found.attainable = std::sqrt(found.attainable);
    if (found.radius > 0) found.uncertainty = degreesFromRadians(0.001 / found.radius);
    if (found.radius >= smallestCircle) found.positioning = degreesFromRadians(positioning);
    if (found.radius >= smallestCircle && !each.approaches.empty()) {
      double sum = 0;
      for (const auto& [plus, minus] : each.approaches) {
        const Vector3 lever = tangent(after, fit.machine, plus, axis);
        const Vector3 apart = seen(after, fit.machine, minus) - seen(after, fit.machine, plus);
        sum -= apart.dot(lever) / lever.squaredNorm();
      }
      found.backlash = degreesFromRadians(sum / static_cast<double>(each.approaches.size()));
    }
    const auto fittedAxis = std::ranges::find(fit.axes, axis, &kinematics::FoundAxis::axis);
    if (fittedAxis != fit.axes.end() && fittedAxis->tilted) {
      const Vector3 turned =
          correctionOf(fit.corrections, axis).orientation - correctionOf(task.believed, axis).orientation;
      found.angularError = turned.norm();
    }
    all.push_back(found);
  }
  return all;
}

KinematicData fitted(const KinematicData& before, const ChainFit& fit) {
  return {fit.corrections, before.base + fit.shift};
}

void confirmChange(Context& context, const KinematicData& before, const KinematicData& after, const ChainFit& fit) {
  double largest = (after.base - before.base).cwiseAbs().maxCoeff();
  for (const RotaryCorrection& now : after.axes) {
    const RotaryCorrection& old = correctionOf(before.axes, now.axis);
    largest = std::max(largest, (now.position - old.position).cwiseAbs().maxCoeff());
    const auto found = std::ranges::find(fit.axes, now.axis, &kinematics::FoundAxis::axis);
    if (found == fit.axes.end()) continue;
    const double turn = (now.orientation - old.orientation).norm() + std::abs(now.zero - old.zero);
    largest = std::max(largest, radiansFromDegrees(turn) * found->radius);
  }
  const double permitted = context.control().parameters.maxModification;
  if (largest <= permitted) return;
  context.stop(fmt::format("The kinematics changes by up to {:.4f} mm; {} is {} mm. NC start takes it over", largest,
                           context.control().isTNC640() ? "maxModification" : "MP6600", formatShortest(permitted)));
}

void reportResults(Context& context, std::span<const MeasuredSeries> series, std::span<const AxisFindings> findings,
                   Optimised optimised, const Vector3& offset) {
  // Also in inch programs these are mm.
  const auto report = [&](int number, double value) {
    context.result(number, value);
    context.set(number, value);
  };
  // A number that is no length: it has no unit, and no program's unit changes it.
  const auto reportMissing = [&](int number) {
    constexpr double missing = -1;
    control::ResultRecord record;
    record.name = fmt::format("Q{}", number);
    describe(record, *context.entry().definition.result(record.name));
    record.kind = result::status;
    record.value = missing;
    context.record().results.push_back(std::move(record));
    context.set(number, missing);
  };
  const auto reportIf = [&](bool known, int number, double value) {
    if (known)
      report(number, value);
    else
      reportMissing(number);
  };
  for (int i = 0; i < 3; ++i) {
    const auto found = std::ranges::find(series, static_cast<char>('A' + i),
                                         [](const MeasuredSeries& each) { return each.plan.request.name; });
    const bool measured = found != series.end();
    const AxisFindings axis = measured ? findings[static_cast<std::size_t>(found - series.begin())] : AxisFindings{};
    reportIf(measured, 141 + i, axis.scatter);
    reportIf(measured && optimised == Optimised::Yes, 144 + i, axis.attainable);
  }
  for (int i = 0; i < 3; ++i)
    report(147 + i, offset[i]);
}

void logMeasurement(Context& context, const std::string& mode, std::span<const MeasuredSeries> series,
                    std::span<const AxisFindings> findings, const KinematicData& before, const KinematicData& after,
                    const Vector3& offset, std::span<const std::string> remarks) {
  const auto& control = context.control();
  const auto& kinematics = *control.kinematics;
  const bool html = control.isTNC640(), withUncertainty = !html || context.entry().definition.number == 452;
  KinematicsLog log(context, fmt::format("TCHPR{}.{}", context.entry().definition.name, html ? "html" : "TXT"));
  if (!mode.empty()) log.line("Mode", mode);
  log.line("Kinematics", kinematics.identifier());
  log.line("Sphere radius", length(context.q(407)));
  for (std::size_t i = 0; i < series.size(); ++i) {
    const AxisSeries& plan = series[i].plan;
    const AxisFindings& found = findings[i];
    const std::string& name = context.channel().description().axes[plan.axis].name;
    log.table({"Axis", name}, {});
    log.line("Start angle", formatFixed(plan.request.start, 4));
    log.line("End angle", formatFixed(plan.request.end, 4));
    log.line("Angle of incidence", formatFixed(plan.request.incidence, 4));
    log.line("Number of measuring points", std::to_string(series[i].sightings.size() - 1));
    log.table({"", "Measured", "Optimised"},
              {{"Scatter (standard deviation)", length(found.scatter), length(found.attainable)},
               {"Maximum error", length(found.maximum), length(found.attainableMaximum)}});
    log.line("Angular error", degrees(found.angularError));
    log.line("Averaged backlash", degrees(found.backlash));
    log.line("Averaged positioning error", degrees(found.positioning));
    log.line("Measuring circle radius", length(found.radius));
    if (!html) log.line("Valuation of the measuring points", formatFixed(found.valuation, 2));
    if (withUncertainty) log.line("Measurement uncertainty, degrees per 0.001 mm", formatFixed(found.uncertainty, 6));
  }
  log.table({"Preset shift", "X", "Y", "Z"}, {{"", length(offset.x()), length(offset.y()), length(offset.z())}});
  if (html) {
    KinematicsLog::Rows rows;
    for (const MeasuredSeries& each : series) {
      const Vector3 old = kinematics.pointOf(before, each.plan.axis), now = kinematics.pointOf(after, each.plan.axis);
      const std::string& name = context.channel().description().axes[each.plan.axis].name;
      rows.push_back({name, "Before", length(old.x()), length(old.y()), length(old.z())});
      rows.push_back({name, "After", length(now.x()), length(now.y()), length(now.z())});
    }
    log.table({"Axis", "Position from the spindle nose", "X", "Y", "Z"}, rows);
  }
  for (const std::string& remark : remarks)
    log.line("Not determined", remark);
  log.write();
}

void tiltAsTheAxesStand(Context& context, const SphereSearch& search) {
  auto& control = context.control();
  if (!control.isTNC640()) return;
  const Matrix3 tilt = search.tilt();
  control.coordinates.workingPlane = {};
  control.coordinates.tiltIsAxial = false;
  if (tilt.isIdentity(1e-9)) {
    control.coordinates.tilt.reset();
  } else {
    control.coordinates.tilt = tilt;
  }
}

}  // namespace probewright::cycles::heidenhain
