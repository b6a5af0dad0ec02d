#include <cmath>

#include "cycles/sinumerik/call_combinations.hpp"
#include "cycles/sinumerik/context.hpp"
#include "cycles/sinumerik/old_call.hpp"
#include "cycles/sinumerik/parameters.hpp"
#include "cycles/sinumerik/turning.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr Choice features974[] = {{0, "front edge"}, {1, "inside diameter"}, {2, "outside diameter"}};
constexpr Choice reversal974[] = {{0, "without reversal"}, {1, "with reversal of the turning spindle"}};
constexpr CodeDigit variant974[] = {
    {1, 1, "feature", features974}, {3, 1, "task", parameters::measureOrCorrect}, {5, 1, "reversal", reversal974}};

constexpr Parameter parameters974[] = {
    parameters::variant(variant974),
    parameters::zeroOffset(1),
    parameters::turnedToolToCorrect(2),
    parameters::dataSet(3),
    parameters::length(4, "S_SETV", "set value of the face, or of the diameter"),
    parameters::count<3>(5, "S_MA", "measuring axis: 1, 2 in the plane, 3 if the machine has it", 1),
    parameters::measuringPath(6),
    parameters::safeArea(7),
    parameters::angle(8, "S_STA1", "angle of the turning spindle at the first touch with reversal"),
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

constexpr auto results974 = joined(parameters::coordinateResults, parameters::correctionResults);

/// The sign of the touch. No parameter gives it: the probe is in front of the surface when the cycle starts.
double touchSign(Context& context, TurnedFeature feature, double start, double set) {
  const double towards = set > start ? 1 : -1;
  const double expected = feature == TurnedFeature::Inside ? 1 : feature == TurnedFeature::Outside ? -1 : towards;
  if (start == set || towards != expected) {
    context.alarm(61332, "the probe is not in front of the surface, above the turning centre");
  }
  return towards;
}

constexpr Requirement requirements[] = {
    {"S_MA", Need::NotZero},
};

/// A face, or a diameter inside or outside, as the probe stands.
int oldForm(OldCall& call) {
  call.nothingFrom(5);
  if (call.digit(2) != 0 || call.digit(1) != 0 || call.digit(4) > 1) call.refuseVariant();
  int feature = 0;
  const control::WorkingPlane plane = call.control().workingPlane();
  const int axis = call.whole("_MA");
  if (axis >= 1 && axis <= 3 && plane.xyzFromPlane(PlaneWay::unit(axis - 1)).x() != 0)
    feature = (call.control().diameter ? 2 : 1) * std::abs(call.control().channel.position().x()) >=
                      std::abs(call.number("_SETVAL")) * call.control().unit
                  ? 2
                  : 1;
  return feature + call.task(OldCall::Corrects::AlsoTools) + call.digit(4) * 10000;
}

constexpr TitleSize titleSizes[] = {{"S_SETV", 0b110}};

constexpr CycleDefinition definition = {
    .number = 974,
    .name = "CYCLE974",
    .title = "Turned part: front edge, inside diameter, outside diameter",
    .family = CycleFamily::Inspection,
    .summary =
        "Touches a face or a diameter of a turned part at one point, a diameter also again after half a turn of "
        "the workpiece, and corrects the zero offset or the tool that made it.",
    .parameters = parameters974,
    .results = results974,
    .controls = control::onSinumerik,
};

/// What does not fit together of a measurement with reversal; null if it does.
const char* contradiction(bool face, bool zeroOffset) {
  if (face) return "a front edge is not measured with reversal";
  if (zeroOffset) return "with reversal no zero offset is corrected";
  return nullptr;
}

void combinations(CallCombinations& call) {
  if (call.digit(5) != 1) return;
  if (const char* why = contradiction(call.digit(1) == 0, call.digit(3) == 1))
    call.refuse("S_MVAR", std::string("S_MVAR does not fit together: ") + why);
}

void run(Context& context, const Arguments&) {
  requireTurningProbe(context);
  requireUnturned(context);
  const int units = context.digit("S_MVAR", 1);
  const int reversal = context.digit("S_MVAR", 5);
  if (units > 2 || reversal > 1) context.alarm(61307);
  const auto feature = static_cast<TurnedFeature>(units);
  const Task task = taskOf(context);
  if (reversal == 1) {
    if (const char* why = contradiction(feature == TurnedFeature::Face, task == Task::ZeroOffset))
      context.alarm(61307, why);
    requireWorkpieceSpindle(context);
  }
  const int axis = turningAxis(context, context.integer("S_MA"));
  const auto target = task == Task::ZeroOffset ? frameTarget(context, GlobalBase::Allowed) : std::nullopt;

  const double count = feature == TurnedFeature::Face || axis != 0 ? countOf(context, axis) : countOf(context, 1);
  const double set = setValueOf(context, task, context.real("S_SETV"));
  PartPoint setpoint = partAt(context.prober().position());
  const double sign = touchSign(context, feature, setpoint[axis], set / count);
  setpoint[axis] = set / count;
  requireTrigger(context, axis, sign);
  const auto touch = [&] {
    return context.prober().measure(setpoint, probing::axisDirection(axis, sign), context.real("S_FA"),
                                    context.repetitions());
  };

  double actual = 0;
  if (reversal == 1) {
    const double start = context.real("S_STA1");
    turnWorkpiece(context, start);
    actual = touch().surface[axis];
    turnWorkpiece(context, start + 180);
    actual = (actual + touch().surface[axis]) / 2;
  } else {
    actual = touch().surface[axis];
  }
  concludeTurned(context, task, feature, {.axis = axis, .count = count, .set = set, .actual = actual * count}, sign);

  if (target) {
    // What was measured along the 3rd axis is corrected in X.
    const int corrected = axis == 2 ? 1 : axis;
    PartPoint surface = setpoint;
    surface[corrected] += actual - setpoint[axis];
    const PlaneWay directions[] = {PlaneWay::unit(corrected)};
    correctTranslation(context, *target, machinePoint(context, surface), setpoint, directions);
    context.result(28, context.real("S_TSA"));
  }
}

}  // namespace

extern const Entry cycle974 = {.definition = definition,
                               .title = {.byFeature = true, .sizes = titleSizes},
                               .requirements = requirements,
                               .combinations = combinations,
                               .oldForm = oldForm,
                               .run = run};

}  // namespace probewright::cycles::sinumerik
