#include <fmt/format.h>

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
using control::heidenhain::Kinematics;
using kinematics::ChainFit;
using kinematics::ChainFitTask;

constexpr Choice modes[] = {
    {0, "test: measure, and tell what could be optimised"},
    {1, "optimise the positions of the rotary axes"},
    {2, "optimise angles and positions (option 52)"},
    {3, "correct the machine datum, optimise angles and positions (option 52, TNC 640)", control::onTNC640}};

constexpr Parameter parameters451[] = {
    option(406, "Q406", "mode", modes),
    sphereRadius,
    setUpClearance,
    retractHeight,
    positioningFeed,
    touchReference,
    startA,
    endA,
    otherA,
    pointsA,
    startB,
    endB,
    otherB,
    pointsB,
    startC,
    endC,
    otherC,
    pointsC,
    sphereTouches,
    spherePreset,
    overrun,
};

constexpr Example examples[] = {
    {"Q419", -90},
    {"Q420", 90},
    {"Q422", 4},
};

constexpr CycleDefinition definition = {
    .number = 451,
    .name = "451",
    .title = "MEASURE KINEMATICS",
    .family = CycleFamily::Kinematics,
    .summary =
        "Measures rotary axes of table and head on a calibration sphere, tells how accurately they tilt, and "
        "corrects positions and angles of the axes in the active kinematics.",
    .parameters = parameters451,
    .results = results::kinematics,
    .examples = examples,
};

void rules(CallRules& call) {
  const auto mode = call.number(406);
  if (call.kind() == ControlKind::iTNC530 && mode == 3.0)
    call.add(406, "Q406 = 3 is a mode of the TNC 640", "enter 0, 1 or 2");
  adviseOnPositions(call, mode);
}

/// The rotary axes that carry each other on one side, from the bed, if all of them are measured.
std::vector<std::vector<std::size_t>> measuredStacks(const machine::MachineDescription& machine,
                                                     const MeasuringPlan& plan) {
  std::vector<std::vector<std::size_t>> stacks;
  for (const auto* chain : {&machine.tableChain, &machine.spindleChain}) {
    std::vector<std::size_t> stack;
    for (const machine::ChainElement& element : *chain) {
      if (element.axis && machine.axes[*element.axis].kind == machine::AxisKind::Rotary) stack.push_back(*element.axis);
    }
    const bool measured = std::ranges::all_of(stack, [&](std::size_t axis) {
      return std::ranges::find(plan.series, axis, &AxisSeries::axis) != plan.series.end();
    });
    if (stack.size() > 1 && measured) stacks.push_back(std::move(stack));
  }
  return stacks;
}

void requireMode(Context& context, int mode, const MeasuringPlan& plan) {
  if (mode == 3 && !context.control().isTNC640())
    throw Alarm("Cycle parameter wrong", "Q406 = 3 is a mode of the TNC 640", "enter 0, 1 or 2");
  if (mode >= 2 && !context.control().parameters.option52) {
    throw Alarm("Function not enabled", "Angles are compensated with software option 52, KinematicsComp",
                "enter Q406 = 1, or enable the option (option52 in [parameters])");
  }
  if (plan.series.empty()) {
    throw Alarm("No axis to measure", "Q414, Q418 and Q422 ask for no axis that the machine has",
                "enter numbers of measuring points");
  }
  if (mode == 3 && measuredStacks(context.channel().description(), plan).empty()) {
    throw Alarm("Machine datum not correctable",
                "The machine datum is found where all rotary axes of head or table that carry each other are measured",
                "measure these axes, or enter Q406 = 2");
  }
}

/// Directions, and zero positions in mode 3, of axes that have two measuring points or more.
void freeAngles(Context& context, ChainFitTask& task, std::span<const MeasuredSeries> series, int mode,
                const MeasuringPlan& plan) {
  for (std::size_t i = 0; i < series.size(); ++i) {
    task.free[i].tilt = series[i].sightings.size() > 2;
    if (!task.free[i].tilt) {
      context.warn(fmt::format("One measuring point of {} does not tell its direction; it stays as it is",
                               series[i].plan.request.name));
    }
  }
  if (mode < 3) return;
  const auto freedoms = [&](std::size_t axis) {
    return std::ranges::find(task.free, axis, &kinematics::AxisFreedoms::axis);
  };
  for (const std::vector<std::size_t>& stack : measuredStacks(context.channel().description(), plan)) {
    for (std::size_t i = 1; i < stack.size(); ++i) {
      if (!freedoms(stack[i])->tilt) continue;
      freedoms(stack[i - 1])->zero = true;
      freedoms(stack[i])->zeroOf = stack[i - 1];
    }
  }
}

/// The kinematics as it was before comes back when this ends.
class Meanwhile {
public:
  Meanwhile(Context& context, KinematicData data) : context_(context), before_(context.control().kinematics->data()) {
    use(std::move(data));
  }
  ~Meanwhile() { use(before_); }
  Meanwhile(const Meanwhile&) = delete;
  Meanwhile& operator=(const Meanwhile&) = delete;

private:
  void use(KinematicData data) {
    context_.control().kinematics->set(std::move(data));
    context_.control().applyKinematics();
  }
  Context& context_;
  KinematicData before_;
};

struct Outcome {
  ChainFitTask task;
  ChainFit fit;
  std::vector<MeasuredSeries> series;
};

/// The iTNC 530 measures once more with the angles in effect, and optimises the positions then.
void measurePositionsAgain(Context& context, SphereSearch& search, const MeasuringPlan& plan, Outcome& outcome) {
  KinematicData turned = context.control().kinematics->data();
  for (std::size_t i = 0; i < turned.axes.size(); ++i)
    turned.axes[i].orientation = outcome.fit.corrections[i].orientation;
  const Meanwhile angles(context, turned);
  const std::vector<MeasuredSeries> again = measureSeries(context, search, plan);
  const ChainFit positions = fitOrAlarm(context, fitTaskOf(context, again), again);
  for (std::size_t i = 0; i < positions.corrections.size(); ++i)
    outcome.fit.corrections[i].position = positions.corrections[i].position;
  outcome.fit.machine = positions.machine;
  outcome.fit.sphere = positions.sphere;
}

void run(Context& context, const Arguments&) {
  auto& control = context.control();
  const int mode = context.option(406), preset = context.option(431);
  const MeasuringPlan plan = measuringPlan(context);
  requireMode(context, mode, plan);
  if (preset == 1 || preset == 3) presetIntoSphere(context);

  SphereSearch search(context, PartInMachine(control.coordinates.machineFromPreset().translation()));
  Outcome outcome;
  outcome.series = measureSeries(context, search, plan);
  outcome.task = fitTaskOf(context, outcome.series);
  if (mode >= 2) freeAngles(context, outcome.task, outcome.series, mode, plan);
  outcome.fit = fitOrAlarm(context, outcome.task, outcome.series);
  const bool turned = std::ranges::any_of(outcome.fit.axes, &kinematics::FoundAxis::tilted);
  if (mode == 2 && turned && !control.isTNC640()) measurePositionsAgain(context, search, plan, outcome);

  const std::vector<AxisFindings> findings = findingsOf(outcome.task, outcome.fit, outcome.series);
  const KinematicData before = control.kinematics->data(), after = fitted(before, outcome.fit);
  const Vector3 offset = control.coordinates.machineFromPreset().inverse() * outcome.fit.sphere;
  if (mode > 0) {
    confirmChange(context, before, after, outcome.fit);
    changeKinematics(control, after);
  }
  if (preset >= 2)
    setSpherePreset(
        context, mode > 0 ? PartInMachine(outcome.fit.sphere) : search.seen(outcome.series.front().sightings.front()));
  reportResults(context, outcome.series, findings, mode > 0 ? Optimised::Yes : Optimised::No, offset);
  logMeasurement(context, fmt::format("{}: {}", mode, modes[mode].meaning), outcome.series, findings, before, after,
                 offset, outcome.fit.undetermined);
  tiltAsTheAxesStand(context, search);
}

}  // namespace

extern const Entry cycle451 = {.definition = definition,
                               .conditions = {.tilted = control::onTNC640, .featureLevel = 3},
                               .logTerms = kinematicsLogTerms,
                               .rules = rules,
                               .run = run};

}  // namespace probewright::cycles::heidenhain
