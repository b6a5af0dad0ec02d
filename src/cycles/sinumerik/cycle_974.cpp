#include "cycles/sinumerik/cycles.hpp"
#include "cycles/sinumerik/parameters.hpp"
#include "cycles/sinumerik/turning.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr Parameter parameters974[] = {
    parameters::variant("units: 0 face, 1 inside, 2 outside; hundreds: 0 measure only, 1 zero offset, 2 tool; 10^4: 1 "
                        "with reversal of the workpiece"),
    parameters::zeroOffset(1),
    parameters::toolToCorrect(2),
    parameters::dataSet(3),
    parameters::length(4, "S_SETV", "set value: position of the face, or diameter as programmed"),
    parameters::code(5, "S_MA", "measuring axis: 1, 2, 3", 1),
    parameters::measuringPath(6),
    parameters::safeArea(7),
    parameters::angle(8, "S_STA1", "angle of the workpiece at the first measurement (reversal)"),
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

constexpr auto results974 = parameters::joined(turnedResults, parameters::correctionResults);

}  // namespace

const CycleDefinition cycle974Definition = {
    .number = 974,
    .name = "CYCLE974",
    .title = "Turned part: front edge, inside and outside diameter, 1 point",
    .family = CycleFamily::Inspection,
    .summary =
        "Touches a face or a diameter of a turned part at one point, diameters also again with the workpiece turned "
        "by 180 degrees, and corrects the zero offset or the tool.",
    .parameters = parameters974,
    .results = results974,
    .controls = control::onSinumerik,
};

void cycle974(Context& context, const Arguments&) {
  context.requireProbe({580});
  context.requireCalibration();
  const int units = context.digit("S_MVAR", 1);
  const bool face = units == 0, reversal = context.digit("S_MVAR", 5) == 1;
  if (units > 2 || context.digit("S_MVAR", 5) > 1 || (face && reversal)) context.alarm(61307);
  const Task task = taskOf(context);
  if (reversal && task == Task::ZeroOffset) context.alarm(61307, "with reversal there is no zero offset correction");
  const auto target = task == Task::ZeroOffset ? frameTarget(context, GlobalBase::Allowed) : std::nullopt;
  const int axis = context.measuringAxis(3);

  const double measure = face ? 1 : measureOf(context);
  const double set = setValueOf(context, task, context.real("S_SETV"));
  Vector3 setpoint = context.prober().position();
  const double way = units == 1 ? 1 : units == 2 ? -1 : setpoint[axis] < set ? 1 : -1;
  setpoint[axis] = set / measure;
  const auto touch = [&] {
    return context.prober()
        .measure(setpoint, probing::axisDirection(axis, way), context.real("S_FA"), context.repetitions())
        .surface[axis];
  };
  double position = 0;
  if (reversal) {
    turnWorkpiece(context, context.real("S_STA1"));
    position = touch();
    turnWorkpiece(context, context.real("S_STA1") + 180);
    position = (position + touch()) / 2;
  } else {
    position = touch();
  }

  const double actual = position * measure;
  const double difference = actual - set - (task == Task::Tool ? empiricalValue(context) : 0);
  const Side side = units == 1 ? Side::Inside : Side::Outside;
  reportTurned(context, axis, set, actual, difference,
               face ? Compared{.nominal = set} : comparedSize(context, task, set, actual, side));
  context.checkSafeArea(difference);
  if (target) {
    Vector3 feature = setpoint;
    feature[axis] = position;
    const Vector3 directions[] = {Vector3::Unit(axis)};
    correctTranslation(context, *target, machinePoint(context, feature), setpoint, directions);
    context.result(28, context.real("S_TSA"));
  }
  if (task == Task::Tool) {
    const Dimension dimensions[] = {{.set = set, .actual = actual}};
    correctTool(context, dimensions, influenceOnTurning(context, axis, way, measure));
  }
}

}  // namespace probewright::cycles::sinumerik
