#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/truncated.hpp"
#include "control/sinumerik/measuring_data.hpp"
#include "cycles/sinumerik/call_combinations.hpp"
#include "cycles/sinumerik/context.hpp"
#include "cycles/sinumerik/old_call.hpp"
#include "cycles/sinumerik/parameters.hpp"
#include "cycles/sinumerik/turning.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr Choice features994[] = {{1, "inside diameter"}, {2, "outside diameter"}};
constexpr Choice tasks994[] = {{0, "measure only"}, {2, "correct the tool"}};
constexpr Choice zones994[] = {{0, "without protection zone"},
                               {1, "protection zone, passed by in the 1st axis"},
                               {2, "protection zone, passed by in the 2nd axis"},
                               {3, "protection zone, passed by in the 3rd axis"}};
constexpr CodeDigit variant994[] = {
    {1, 1, "feature", features994}, {3, 1, "task", tasks994}, {4, 1, "protection zone", zones994}};

constexpr Parameter parameters994[] = {
    parameters::variant(variant994, 1),
    parameters::zeroOffset(1),
    parameters::turnedToolToCorrect(2),
    parameters::dataSet(3),
    parameters::length(4, "S_SETV", "set value of the diameter"),
    parameters::code(5, "S_MA", "measuring axis 1, 2, 3; hundreds: the axis in which the probe passes by", 1),
    parameters::length(6, "S_SZA", "protection zone in the measuring axis"),
    parameters::length(7, "S_SZO", "distance in the axis in which the probe passes by"),
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

constexpr auto results994 = joined(parameters::coordinateResults, parameters::correctionResults);

/// The index of the axis in which the probe passes by the workpiece or the zone: the hundreds of S_MA, else the
/// thousands of S_MVAR, else the 1st axis.
int bypassAxis(Context& context, int measuringAxis) {
  int code = context.digit("S_MA", 3);
  if (code == 0) code = context.digit("S_MVAR", 4);
  const int axis = turningAxis(context, code == 0 ? 1 : code);
  if (axis == measuringAxis)
    context.alarm(61325, "the measuring axis and the axis in which the probe passes by are the same");
  return axis;
}

/// Two opposite points through the turning centre, the zero of the measuring axis.
class OppositePoints {
public:
  OppositePoints(Context& context, TurnedFeature feature, int axis, double setRadius, double count)
      : context_(context),
        inside_(feature == TurnedFeature::Inside),
        axis_(axis),
        setRadius_(setRadius),
        zone_(context.digit("S_MVAR", 4) != 0 ? context.real("S_SZA") / count : 0),
        zoneUsed_(context.digit("S_MVAR", 4) != 0),
        way_(context.real("S_SZO")),
        // Outside, a probe whose ball alone is known may do.
        calibrated_(inside_ || !maskBit(context.control().data, "$MCS_MEA_FUNCTION_MASK", 2)) {
    if (zone_ < 0 || way_ < 0) context.alarm(61334, "S_SZA and S_SZO must not be negative");
    if (passesBy()) {
      bypass_ = bypassAxis(context, axis);
      if (way_ == 0) context.alarm(61334, "S_SZO must be greater than 0: the probe has to pass by");
    }
    if (calibrated_) {
      requireTrigger(context, axis, 1);
      requireTrigger(context, axis, -1);
    } else if (!(context.control().tool.radius > 0)) {
      context.alarm(61351);
    }
    path_ = context.real("S_FA");
    if (inside_ && zoneUsed_) shortenPath();
  }

  /// The position of the surface along the axis on the side of `side` (+1 above the centre, -1 below).
  double touch(double side) {
    const PartPoint setpoint = along(side * setRadius_);
    const PlaneWay direction = probing::axisDirection(axis_, signAt(side));
    if (calibrated_) {
      return context_.prober().measure(setpoint, direction, path_, context_.repetitions()).surface[axis_];
    }
    return context_.prober()
        .measureUncompensated(setpoint, direction, path_, context_.repetitions(), triggerAt(side),
                              context_.prober().probe().feed)
        .surface[axis_];
  }

  /// From above the centre to below it, or with `side` -1 back again.
  void cross(double side = 1) {
    if (!passesBy()) return;
    const double here = std::abs(startAt(side)), there = std::abs(startAt(-side));
    probing::SinumerikProber& prober = context_.prober();
    const auto go = [&](int axis, double to) {
      PlanePlace target = prober.position();
      target[axis] = to;
      prober.moveTo(target);
    };
    const double height = prober.position()[bypass_];
    go(axis_, side * std::max(here, zone_));
    go(bypass_, height + way_);
    go(axis_, -side * std::max(there, zone_));
    go(bypass_, height);
  }

private:
  bool passesBy() const { return !inside_ || zoneUsed_; }
  double signAt(double side) const { return inside_ ? side : -side; }

  PartPoint along(double value) {
    PartPoint point = partAt(context_.prober().position());
    point[axis_] = value;
    return point;
  }

  double triggerAt(double side) {
    if (!calibrated_) return context_.control().tool.radius;
    return context_.prober().trigger(probing::axisDirection(axis_, signAt(side)));
  }

  double startAt(double side) { return side * setRadius_ - signAt(side) * (path_ + triggerAt(side)); }

  /// Between zone and wall.
  void shortenPath() {
    const double room = setRadius_ - zone_ - std::max(triggerAt(1), triggerAt(-1));
    if (room <= 0) context_.alarm(61334, fmt::format("the zone leaves {:.3f} mm between ball and wall", room));
    path_ = std::min(path_, room);
  }

  Context& context_;
  bool inside_;
  int axis_;
  double setRadius_;
  double zone_;  ///< its half, from the centre
  bool zoneUsed_;
  double way_;
  bool calibrated_;
  int bypass_ = 0;
  double path_ = 0;
};

constexpr Requirement requirements[] = {
    {"S_SETV", Need::Positive},
    {"S_MA", Need::NotZero},
    {"S_SZO", Need::Positive, variant::units<2>},
};

void combinations(CallCombinations& call) {
  const auto axes = call.number("S_MA");
  if (!axes) return;
  const int code = truncated(*axes), measuring = code % 10, passing = code / 100;
  if (code < 0 || (code != 0 && measuring == 0) || measuring > 3 || code / 10 % 10 != 0 || passing > 3)
    return call.refuse("S_MA",
                       "S_MA has the measuring axis in its units, the axis in which the probe passes by in its "
                       "hundreds, 1 to 3 each, and 0 in its tens");
  const bool passes = call.digit(1) == static_cast<int>(TurnedFeature::Outside) || call.digit(4) != 0;
  const int in = passing != 0 ? passing : call.digit(4) != 0 ? call.digit(4) : 1;
  if (passes && measuring == in) call.refuse("S_MA", "S_MA measures in the axis in which the probe passes by");
}

/// Inside or outside, as the probe stands; what _SZA and _SZO say of the two axes of the plane, said of the measuring
/// axis and of the one in which the probe passes by. 2 inside is without the zone.
int oldForm(OldCall& call) {
  if (call.variant() != 1 && call.variant() != 2) call.refuseVariant("1 and 2 are");
  const int axis = call.whole("_MA");
  if (axis != 1 && axis != 2)
    call.refuse("61325", fmt::format("_MA = {}: in which axis the probe passes by is known for 1 and 2 only", axis));
  const control::WorkingPlane plane = call.control().workingPlane();
  const bool transverse = (axis == 1 ? plane.main : plane.minor) == 0;
  const double here = plane.planeFromXyz(call.control().channel.position())[axis - 1];
  const bool outside = (call.control().diameter && transverse ? 2 : 1) * here >= call.length("_SETVAL");
  const int passing = 3 - axis;
  const double across = call.number(axis == 1 ? "_SZA" : "_SZO"), along = call.number(axis == 1 ? "_SZO" : "_SZA");
  const bool zone = (outside || call.variant() == 1) && (across != 0 || along != 0);
  call.put("S_MA", axis + 100 * passing);
  call.put("S_SZA", across);
  call.put("S_SZO", along);
  return (outside ? 2 : 1) + call.task(OldCall::Corrects::AlsoTools) + (zone ? passing * 1000 : 0);
}

constexpr TitleSize titleSizes[] = {{"S_SETV"}};

constexpr Example examples[] = {
    {"S_SETV", 30},
};

constexpr CycleDefinition definition = {
    .number = 994,
    .name = "CYCLE994",
    .title = "Turned part: diameter by two points",
    .family = CycleFamily::Inspection,
    .summary =
        "Measures a diameter of a turned part by two opposite points, passing by under the turning centre with "
        "a protection zone if asked for, and corrects the tool that made it.",
    .parameters = parameters994,
    .results = results994,
    .controls = control::onSinumerik,
    .examples = examples,
};

void run(Context& context, const Arguments&) {
  requireTurningProbe(context);
  requireUnturned(context);
  const int units = context.digit("S_MVAR", 1);
  if (units < 1 || units > 2 || context.digit("S_MVAR", 4) > 3) context.alarm(61307);
  const auto feature = static_cast<TurnedFeature>(units);
  const Task task = taskOf(context);
  if (task == Task::ZeroOffset) context.alarm(61307, "two points correct no zero offset");
  const int code = context.integer("S_MA");
  if (code < 0 || code > 303 || context.digit("S_MA", 2) != 0) context.alarm(61325, fmt::format("S_MA = {}", code));
  const int axis = turningAxis(context, context.digit("S_MA", 1));

  // Along the 1st axis a diameter counts as those across.
  const double count = countOf(context, axis == 0 ? 1 : axis);
  const double set = setValueOf(context, task, context.real("S_SETV"));
  if (!(set > 0)) context.alarm(61319, "S_SETV, the set diameter, must be greater than 0");
  const double setRadius = set / count;
  const bool inside = feature == TurnedFeature::Inside;
  // The call is looked at before the place of the probe.
  OppositePoints points(context, feature, axis, setRadius, count);
  const double start = context.prober().position()[axis];
  if (inside ? start >= setRadius : start <= setRadius) {
    context.alarm(61332, "the probe is not in front of the surface, above the turning centre");
  }

  const double above = points.touch(1);
  points.cross();
  const double below = points.touch(-1);
  const double actual = (above - below) / 2 * count;
  context.setWayBack([&] { points.cross(-1); });
  concludeTurned(context, task, feature, {.axis = axis, .count = count, .set = set, .actual = actual}, inside ? 1 : -1);
}

}  // namespace

extern const Entry cycle994 = {.definition = definition,
                               .title = {.byFeature = true, .sizes = titleSizes},
                               .requirements = requirements,
                               .combinations = combinations,
                               .oldForm = oldForm,
                               .run = run};

}  // namespace probewright::cycles::sinumerik
