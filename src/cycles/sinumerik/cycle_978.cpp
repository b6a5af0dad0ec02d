#include "base/truncated.hpp"
#include "cycles/sinumerik/call_combinations.hpp"
#include "cycles/sinumerik/context.hpp"
#include "cycles/sinumerik/corrections.hpp"
#include "cycles/sinumerik/measuring_method.hpp"
#include "cycles/sinumerik/old_call.hpp"
#include "cycles/sinumerik/parameters.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr Choice features978[] = {{0, "surface"}};
constexpr CodeDigit variant978[] = {
    {1, 1, "feature", features978}, {3, 1, "task", parameters::measureOrCorrect}, {5, 1, "method", parameters::method}};

constexpr Parameter parameters978[] = {
    parameters::variant(variant978),
    parameters::zeroOffset(1),
    parameters::toolToCorrect(2),
    parameters::dataSet(3),
    parameters::length(4, "S_SETV", "set value of the surface"),
    parameters::measuringPath(5),
    parameters::safeArea(6),
    parameters::count<3>(7, "S_MA", "measuring axis: 1, 2 in the plane, 3 along the tool"),
    parameters::count<2>(
        8, "S_MD",
        "measuring direction: 1 plus, 2 minus; 0: from the present position of the probe towards the set value"),
    parameters::repetitions(9),
    parameters::toolName(10),
    parameters::dlNumber(11),
    parameters::zeroOffsetRange(12),
    parameters::dimensionalDifference(13),
    parameters::upperTolerance(14),
    parameters::lowerTolerance(15),
    parameters::meanRange(16),
    parameters::weight(17),
    parameters::memories(18),
    parameters::reserved(19),
    parameters::plane(20),
    parameters::tolerance(21),
};

constexpr auto results978 =
    joined(joined(parameters::coordinateResults,
                  std::array{ResultDefinition{"_OVR[21]", "mean value", result::statistic(of::distance)}}),
           parameters::correctionResults);

constexpr Requirement requirements[] = {
    {"S_MA", Need::NotZero},
};

int oldForm(OldCall& call) {
  call.nothingFrom(5);
  if (call.digit(2) != 0 || call.digit(1) != 0 || call.digit(4) > 1) call.refuseVariant();
  return call.task(OldCall::Corrects::AlsoTools) + call.digit(4) * 10000;
}

constexpr Example examples[] = {
    {"S_MA", 1},
};

constexpr CycleDefinition definition = {
    .number = 978,
    .name = "CYCLE978",
    .title = "Edge distance: set edge",
    .family = CycleFamily::Inspection,
    .summary = "Touches a surface parallel to an axis once and corrects the zero offset or the tool that made it.",
    .parameters = parameters978,
    .results = results978,
    .controls = control::onSinumerik,
    .examples = examples,
};

constexpr const char* upright = "along the tool only the standard method measures";

void combinations(CallCombinations& call) {
  const auto axis = call.number("S_MA");
  if (axis && truncated(*axis) == 3 && call.digit(5) != 0)
    call.refuse("S_MVAR", std::string("S_MVAR does not fit S_MA: ") + upright);
}

void run(Context& context, const Arguments&) {
  context.requireProbe({710, 712, 713, 580});
  if (context.digit("S_MVAR", 1) != 0) context.alarm(61307);
  const Task task = taskOf(context);
  const Method method = methodOf(context);
  requireCalibrationFor(context, method);
  const int axis = context.measuringAxis(3);
  if (axis == 2 && method != Method::Standard) context.alarm(61307, upright);
  const auto target = task == Task::ZeroOffset ? frameTarget(context, GlobalBase::Allowed) : std::nullopt;

  const double empirical = task == Task::MeasureOnly ? 0 : empiricalValue(context);
  const double set = setValueOf(context, task, context.real("S_SETV"));
  PartPoint setpoint = partAt(context.prober().position());
  const double sign = measuringDirection(context, set - setpoint[axis]);
  setpoint[axis] = set;
  Toucher toucher(context, method);
  const MeasuredPoint point = toucher.measure(setpoint, probing::axisDirection(axis, sign), context.real("S_FA"));
  toucher.finish();

  const double actual = point.surface[axis];
  const double difference = actual - set - empirical;
  for (const int element : {0, 1 + axis})
    context.result(element, set);
  context.result(4, actual, comparedSurface(context, task, set, actual, sign));
  context.result(5 + axis, actual, {.nominal = set});
  for (const int element : {16, 17 + axis})
    context.result(element, difference);
  context.noteCall();
  context.checkSafeArea(difference);

  if (target) {
    PartPoint feature = point.surface;
    feature[axis] -= empirical;
    const PlaneWay directions[] = {PlaneWay::unit(axis)};
    correctTranslation(context, *target, machinePoint(context, feature), setpoint, directions);
    context.result(28, context.real("S_TSA"));
    context.result(30, empirical);
    context.resultInteger(7, context.integer("S_EVNUM") % 10000);
  }
  if (task == Task::Tool) {
    const Dimension dimensions[] = {{.set = set, .actual = actual}};
    correctTool(context, dimensions, influenceOnSurface(axis, sign));
    context.result(21, context.control().ovr[31] * context.control().unit);
  }
}

}  // namespace

extern const Entry cycle978 = {.definition = definition,
                               .requirements = requirements,
                               .combinations = combinations,
                               .oldForm = oldForm,
                               .run = run};

}  // namespace probewright::cycles::sinumerik
