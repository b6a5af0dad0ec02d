#include <fmt/format.h>

#include <cmath>

#include "control/sinumerik/measuring_data.hpp"
#include "cycles/sinumerik/cycles.hpp"
#include "cycles/sinumerik/parameters.hpp"
#include "cycles/sinumerik/turning.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr Parameter parameters994[] = {
    parameters::variant("units: 1 inside, 2 outside; hundreds: 0 measure only, 2 tool; thousands: protection zone, "
                        "passed in the axis 1, 2, 3",
                        1),
    parameters::zeroOffset(1),
    parameters::toolToCorrect(2),
    parameters::dataSet(3),
    parameters::length(4, "S_SETV", "set value of the diameter as programmed"),
    parameters::code(5, "S_MA", "measuring axis: 1, 2, 3; hundreds: axis in which the part is passed", 1),
    parameters::length(6, "S_SZA", "protection zone in the measuring axis, as programmed, ball radius included"),
    parameters::length(7, "S_SZO", "way past the part in the other axis"),
    parameters::measuringPath(8),
    parameters::safeArea(9),
    parameters::repetitions(10),
    parameters::toolName(11),
    parameters::dlNumber(12),
    parameters::zeroOffsetRange(13),
    parameters::dimensionalDifference(14),
    parameters::upperTolerance(15),
    parameters::lowerTolerance(16),
    parameters::meanRange(17),
    parameters::weight(18),
    parameters::memories(19),
    parameters::reserved(20),
    parameters::plane(21),
    parameters::tolerance(22),
};

constexpr auto results994 = parameters::joined(turnedResults, parameters::correctionResults);

/// Touches above and below the turning centre, with the trigger points or, where the machine allows it, with the ball
/// radius of the tool data.
MeasuredPoint touch(Context& context, const Vector3& setpoint, const Vector3& direction) {
  probing::SinumerikProber& prober = context.prober();
  const double path = context.real("S_FA");
  if (prober.ballRadius() > 0) return prober.measure(setpoint, direction, path, context.repetitions());
  return prober.measureUncompensated(setpoint, direction, path, context.repetitions(), context.control().tool.radius,
                                     prober.probe().feed);
}

}  // namespace

const CycleDefinition cycle994Definition = {
    .number = 994,
    .name = "CYCLE994",
    .title = "Turned part: inside and outside diameter, 2 points",
    .family = CycleFamily::Inspection,
    .summary =
        "Measures a diameter of a turned part by two points above and below the turning centre and corrects the "
        "tool.",
    .parameters = parameters994,
    .results = results994,
    .controls = control::onSinumerik,
};

void cycle994(Context& context, const Arguments&) {
  context.requireProbe({580});
  if (!maskBit(context.control().data, "$MCS_MEA_FUNCTION_MASK", 2)) context.requireCalibration();
  const int units = context.digit("S_MVAR", 1), zone = context.digit("S_MVAR", 4);
  if (units < 1 || units > 2 || zone > 3) context.alarm(61307);
  const Task task = taskOf(context);
  if (task == Task::ZeroOffset) context.alarm(61307, "two points correct no zero offset");
  const bool inside = units == 1;
  const int axis = context.digit("S_MA", 1) - 1;
  const int coded = context.digit("S_MA", 3);
  const int bypass = (coded != 0 ? coded : zone != 0 ? zone : 1) - 1;
  if (axis < 0 || axis > 2 || bypass > 2 || bypass == axis) {
    context.alarm(61325, fmt::format("S_MA = {}: measuring axis and the axis past the part", context.integer("S_MA")));
  }

  const double measure = measureOf(context);
  const double set = setValueOf(context, task, context.real("S_SETV"));
  probing::SinumerikProber& prober = context.prober();
  const Vector3 start = prober.position();
  const double way = inside ? 1 : -1;
  Vector3 upper = start, lower = start;
  upper[axis] = set / measure;
  lower[axis] = -set / measure;
  const double first = touch(context, upper, probing::axisDirection(axis, way)).surface[axis];

  // To the other side: past the end of the part, or straight across a bore.
  const Vector3 clear = Vector3::Unit(bypass) * context.real("S_SZO");
  Vector3 here = prober.position();
  if (zone != 0) {
    here[axis] = context.real("S_SZA") / measure;
    prober.moveTo(here);
  }
  if (!inside || zone != 0) {
    prober.moveTo(here + clear);
    here[axis] = -here[axis];
    prober.moveTo(here + clear);
    prober.moveTo(here);
  }
  const double second = touch(context, lower, probing::axisDirection(axis, -way)).surface[axis];

  const double actual = std::abs(first - second) * measure / 2;
  const double difference = actual - set - (task == Task::Tool ? empiricalValue(context) : 0);
  reportTurned(context, axis, set, actual, difference,
               comparedSize(context, task, set, actual, inside ? Side::Inside : Side::Outside));
  context.checkSafeArea(difference);
  if (task == Task::Tool) {
    const Dimension dimensions[] = {{.set = set, .actual = actual}};
    correctTool(context, dimensions, influenceOnTurning(context, axis, way, measure));
  }
}

}  // namespace probewright::cycles::sinumerik
