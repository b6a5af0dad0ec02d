#include <algorithm>

#include "control/alarm.hpp"
#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/kinematics_log.hpp"
#include "cycles/heidenhain/kinematics_measurement.hpp"
#include "cycles/heidenhain/kinematics_plan.hpp"
#include "cycles/heidenhain/parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;
using control::Alarm;
using control::heidenhain::KinematicData;
using kinematics::ChainFit;
using kinematics::ChainFitTask;

constexpr Parameter parameters452[] = {
    sphereRadius, setUpClearance, retractHeight, positioningFeed, touchReference, startA, endA, otherA,
    pointsA,      startB,         endB,          otherB,          pointsB,        startC, endC, otherC,
    pointsC,      sphereTouches,  overrun,
};

constexpr CycleDefinition definition = {
    .number = 452,
    .name = "452",
    .title = "PRESET COMPENSATION",
    .family = CycleFamily::Kinematics,
    .summary =
        "Measures rotary axes on a calibration sphere in whose middle the active preset lies, and corrects the "
        "kinematics so that it lies there again: after a change of heads, or a drift.",
    .parameters = parameters452,
    .results = results::kinematics,
};

void rules(CallRules& call) {
  double points = 0;
  for (const std::uint32_t count : {414U, 418U, 422U})
    points += call.number(count).value_or(1);
  // Without axes it finds the drift alone.
  adviseOnPositions(call, points > 0 ? std::optional(1.0) : std::nullopt);
}

/// Where only axes of the head were measured, the head was changed: what shifts hangs on the axes that carry it and
/// turns with them.
std::vector<std::size_t> axesBeforeTheChange(const machine::MachineDescription& machine, const MeasuringPlan& plan) {
  const auto measured = [&](std::size_t axis) {
    return std::ranges::find(plan.series, axis, &AxisSeries::axis) != plan.series.end();
  };
  std::vector<std::size_t> before;
  std::size_t found = 0;
  for (const machine::ChainElement& element : machine.spindleChain) {
    if (!element.axis || machine.axes[*element.axis].kind != machine::AxisKind::Rotary) continue;
    if (measured(*element.axis)) {
      ++found;
    } else if (found == 0) {
      before.push_back(*element.axis);
    } else {
      return {};
    }
  }
  return found == plan.series.size() && found > 0 ? before : std::vector<std::size_t>{};
}

void run(Context& context, const Arguments&) {
  auto& control = context.control();
  const MeasuringPlan plan = measuringPlan(context);
  const Vector3 centre = control.coordinates.machineFromPreset().translation();
  SphereSearch search(context, PartInMachine(centre));
  std::vector<MeasuredSeries> series;
  std::vector<kinematics::SphereSighting> sightings;
  if (plan.series.empty()) {
    search.moveOver();
    sightings = {search.measure().sighting};
  } else {
    series = measureSeries(context, search, plan);
    sightings = allSightings(series);
  }
  ChainFitTask task = fitTaskOf(context, series);
  task.sphere = centre;
  task.shift = true;
  task.beforeShift = axesBeforeTheChange(context.channel().description(), plan);
  auto fit = fitChain(task, sightings);
  if (!fit) throw Alarm("Kinematics not determined", fit.error().message, fit.error().advice);

  const std::vector<AxisFindings> findings = findingsOf(task, *fit, series);
  const KinematicData before = control.kinematics->data(), after = fitted(before, *fit);
  confirmChange(context, before, after, *fit);
  changeKinematics(control, after);
  const Vector3 offset = control.coordinates.machineFromPreset().linear().transpose() * fit->shift;
  reportResults(context, series, findings, Optimised::Yes, offset);
  logMeasurement(context, {}, series, findings, before, after, offset, fit->undetermined);
  tiltAsTheAxesStand(context, search);
}

}  // namespace

extern const Entry cycle452 = {.definition = definition,
                               .conditions = {.tilted = {}, .featureLevel = 3},
                               .logTerms = kinematicsLogTerms,
                               .rules = rules,
                               .run = run};

}  // namespace probewright::cycles::heidenhain
