#include <fmt/format.h>

#include "cycles/sinumerik/call_combinations.hpp"
#include "cycles/sinumerik/context.hpp"
#include "cycles/sinumerik/machine_coordinates.hpp"
#include "cycles/sinumerik/old_call.hpp"
#include "cycles/sinumerik/parameters.hpp"
#include "cycles/sinumerik/probe_calibration.hpp"
#include "cycles/sinumerik/turning.hpp"

namespace probewright::cycles::sinumerik {

namespace {

constexpr Choice tasks973[] = {
    {0, "length on a surface"}, {1, "radius on a surface"}, {2, "length in the groove"}, {3, "radius in the groove"}};
constexpr Choice reserved973[] = {{1, "reserved"}};
constexpr Choice directions973[] = {
    {0, "axis and direction from the cutting edge position"}, {1, "one direction"}, {2, "both directions of one axis"}};
constexpr Choice deviation973[] = {{0, "with positional deviation"}, {1, "without positional deviation"}};
constexpr Choice toolLength973[] = {{0, "trigger points only"}, {1, "corrects the tool length"}};
constexpr CodeDigit variant973[] = {{1, 1, "task", tasks973},
                                    {3, 1, "reserved", reserved973},
                                    {4, 1, "directions", directions973},
                                    {5, 1, "positional deviation", deviation973},
                                    {7, 1, "tool length", toolLength973}};

constexpr Parameter parameters973[] = {
    parameters::variant(variant973, 12103),
    parameters::dataSet(1),
    parameters::count<3>(2, "S_CALNUM", "number of the reference groove, 1 to 3", 1),
    parameters::length(3, "S_SETV", "position of the surface"),
    parameters::count<3>(4, "S_MA", "measuring axis: 1, 2 in the plane, 3 on a surface if the machine has it", 1),
    parameters::count<1>(5, "S_MD", "measuring direction: 0 plus, 1 minus", 1),
    parameters::measuringPath(6),
    parameters::safeArea(7),
    parameters::feed(8, "S_VMS", "measuring feed; 0: that of SD 55630"),
    parameters::repetitions(9),
    parameters::reserved(10),
    parameters::plane(11),
    parameters::alternative(12),
};

struct Variant {
  bool length = false;    ///< length of the probe; radius of its ball otherwise
  bool inGroove = false;  ///< machine coordinates; a surface of the workpiece otherwise
  int directions = 0;     ///< 0 from the cutting edge position, 1, 2
  bool deviation = true;  ///< of the ball, from both directions of an axis
  bool adaptLength = false;
};

/// `digit` gives a digit of S_MVAR, from the right from 1.
template <typename Digit>
Variant readVariant(const Digit& digit) {
  return {.length = digit(1) % 2 == 0,
          .inGroove = digit(1) >= 2,
          .directions = digit(4),
          .deviation = digit(5) == 0,
          .adaptLength = digit(7) == 1};
}

/// What S_MVAR says that does not fit together; null if it does.
const char* contradiction(const Variant& variant) {
  if (!variant.inGroove && variant.directions != 1) return "a surface is touched in one given direction";
  if (variant.inGroove && variant.length && variant.directions != 0) return "the length is found on the groove's base";
  if (variant.inGroove && !variant.length && variant.directions == 0) return "the walls need axis and direction";
  if (variant.adaptLength && !variant.length) return "a radius does not correct the length";
  return nullptr;
}

void combinations(CallCombinations& call) {
  if (const char* why = contradiction(readVariant([&](int place) { return call.digit(place); })))
    call.refuse("S_MVAR", std::string("S_MVAR does not fit together: ") + why);
}

Variant variantOf(Context& context) {
  const auto digit = [&](int place) { return context.digit("S_MVAR", place); };
  const Variant variant = readVariant(digit);
  const int code = context.integer("S_MVAR");
  const auto refuse = [&](const char* why) { context.alarm(61307, fmt::format("S_MVAR = {}: {}", code, why)); };
  if (code < 0 || code >= 10000000 || digit(1) > 3 || digit(2) != 0 || digit(3) != 1 || digit(4) > 2 || digit(5) > 1 ||
      digit(6) != 0 || digit(7) > 1) {
    refuse("no such digit");
  }
  if (const char* why = contradiction(variant)) refuse(why);
  return variant;
}

/// The reference groove as the setting data have it, in machine coordinates.
struct Groove {
  double base = 0;    ///< along the stylus
  double depth = 0;   ///< where the ball goes between the walls, along the stylus
  double plus = 0;    ///< wall touched in plus direction, across the stylus
  double minus = 0;   ///< wall touched in minus direction
  int baseAxis = 0;   ///< of the plane
  int wallsAxis = 0;  ///< of the plane
};

Groove grooveOf(Context& context) {
  const int number = context.integer("S_CALNUM");
  if (number < 1 || number > 3) context.alarm(61333, fmt::format("groove {}: 1 to 3 are possible", number));
  const int position = context.control().tool.position;
  if (position != 7 && position != 8) {
    context.alarm(61315, fmt::format("$TC_DP2 = {}: 7 or 8 reach into a groove", position));
  }
  Groove groove;
  groove.baseAxis = position == 7 ? 0 : 1;
  groove.wallsAxis = 1 - groove.baseAxis;
  const auto datum = [&](const char* what, int axis) {
    return context.control().data.number(fmt::format("$SNS_MEA_CAL_EDGE_{}_AX{}", what, axis + 1), {number - 1});
  };
  groove.base = datum("BASE", groove.baseAxis);
  groove.plus = datum("PLUS_DIR", groove.wallsAxis);
  groove.minus = datum("MINUS_DIR", groove.wallsAxis);
  const double upper = datum("UPPER", groove.baseAxis);
  const double clearOfBase = groove.base + context.control().tool.radius + context.real("S_FA");
  groove.depth = upper != 0 && upper > groove.base ? (groove.base + upper) / 2 : clearOfBase;
  if (groove.plus <= groove.minus) {
    context.alarm(61319, fmt::format("groove {} has no width in the setting data from SD 54615 on", number));
  }
  return groove;
}

/// Touches `surface`: the trigger point, from the TCP at the signal to the surface, with sign.
double triggerAt(Context& context, ProbeCalibration& calibration, int axis, double sign, double surface) {
  const PlaneWay direction = probing::axisDirection(axis, sign);
  const double known = context.prober().trigger(direction);
  PartPoint setpoint = partAt(context.prober().position());
  setpoint[axis] = surface;
  const double assumed = known > 0 ? known : calibration.assumedRadius();
  return surface - calibration.touch(setpoint, direction, context.real("S_FA"), assumed)[axis];
}

/// The trigger point of one direction, and what follows from it.
void calibrateOneWay(Context& context, ProbeCalibration& calibration, const Variant& variant, int axis, double sign,
                     double surface) {
  const double found = triggerAt(context, calibration, axis, sign, surface);
  if (variant.adaptLength) {
    // Then the ball lies where the length says, and its trigger point is its radius.
    const double ideal = sign * context.control().tool.radius;
    calibration.correctLength(axis, ideal - found);
    calibration.setTrigger(axis, sign, ideal);
    return;
  }
  calibration.setTrigger(axis, sign, found);
  if (!variant.length) calibration.completeAxis(axis, ProbeCalibration::Deviation::Kept);
}

/// Both directions of the axis across the groove. The groove's width is exact, its place only if the deviation is asked
/// for: without, the trigger points lie about the deviation that is known.
void calibrateBothWays(Context& context, ProbeCalibration& calibration, const Variant& variant, const Groove& groove) {
  const int axis = groove.wallsAxis;
  const double plus = triggerAt(context, calibration, axis, 1, groove.plus);
  const double minus = triggerAt(context, calibration, axis, -1, groove.minus);
  const double radius = (plus - minus) / 2;
  const double deviation = variant.deviation ? (plus + minus) / 2 : context.prober().probe().positionDeviation[axis];
  calibration.setTrigger(axis, 1, deviation + radius);
  calibration.setTrigger(axis, -1, deviation - radius);
  calibration.setBallDiameter(2 * radius);
  if (variant.deviation) calibration.setDeviation(axis, deviation);
}

double signOf(Context& context) {
  const int way = context.integer("S_MD");
  if (way != 0 && way != 1) context.alarm(61326, "S_MD is 0 (plus) or 1 (minus)");
  return way == 0 ? 1 : -1;
}

void calibrateInGroove(Context& context, ProbeCalibration& calibration, const Variant& variant, const Groove& groove) {
  const MachineCoordinates coordinates(context.control());
  probing::SinumerikProber& prober = context.prober();
  const auto go = [&](int axis, double to) {
    PlanePlace target = prober.position();
    target[axis] = to;
    prober.moveTo(target);
  };
  go(groove.wallsAxis, (groove.plus + groove.minus) / 2);
  if (variant.length) return calibrateOneWay(context, calibration, variant, groove.baseAxis, -1, groove.base);
  go(groove.baseAxis, groove.depth);
  if (variant.directions == 2) return calibrateBothWays(context, calibration, variant, groove);
  const double sign = signOf(context);
  calibrateOneWay(context, calibration, variant, groove.wallsAxis, sign, sign > 0 ? groove.plus : groove.minus);
}

constexpr Requirement requirements[] = {
    {"S_MA", Need::NotZero, variant::units<0, 1, 3>},
    {"S_CALNUM", Need::NotZero, variant::units<2, 3>},
};

/// On a surface, or in the groove of number _CALNUM: its base where that lies across _MA, else one wall or both.
int oldForm(OldCall& call) {
  call.put("S_MD", call.whole("_MD"));
  if (call.variant() == 0) return 1100;
  call.nothingFrom(6);
  const int directions = call.digit(4), deviation = call.digit(5);
  if (call.variant() % 1000 != 13 || directions > 2 || deviation > 1)
    call.refuseVariant("0, calibration on a surface, and 13, in a groove, are");
  call.put("S_CALNUM", call.whole("_CALNUM", 1));
  const int along = call.control().tool.position % 2 == 1 ? 1 : 2;  // the stylus
  if (call.whole("_MA") == along) {
    if (directions == 2) call.refuseVariant("the base of a groove is touched in one direction");
    return 102;
  }
  return 103 + std::max(directions, 1) * 1000 + (deviation == 1 ? 0 : 10000);
}

constexpr AlarmText alarms[] = {
    {61333, "Check the calibration body number", "S_CALNUM is 1 to 3"},
};

constexpr CycleDefinition definition = {
    .number = 973,
    .name = "CYCLE973",
    .title = "Calibrate the workpiece probe of a lathe",
    .family = CycleFamily::Calibration,
    .summary =
        "Finds the trigger points of a probe on a lathe on a surface of known position or in a reference groove "
        "of the machine, in a groove also diameter and deviation of its ball; can correct the probe's length.",
    .parameters = parameters973,
    .results = calibrationResults,
    .controls = control::onSinumerik,
};

void run(Context& context, const Arguments&) {
  requireTurningProbe(context);
  const Variant variant = variantOf(context);
  if (!(context.control().tool.radius > 0)) context.alarm(61351, "radius $TC_DP6 of the probe");
  ProbeCalibration calibration(context);
  calibration.list({0, 1}, ProbeCalibration::Listed::WithDeviations);
  if (variant.inGroove) {
    const Groove groove = grooveOf(context);
    if (!variant.length && turningAxis(context, context.integer("S_MA")) != groove.wallsAxis) {
      context.alarm(61325, fmt::format("the walls of the groove lie across axis {}", groove.wallsAxis + 1));
    }
    probing::SinumerikProber& prober = context.prober();
    const double outside = prober.position()[groove.baseAxis];
    calibrateInGroove(context, calibration, variant, groove);
    context.setWayBack([&prober, &groove, outside] {
      PlanePlace target = prober.position();
      target[groove.baseAxis] = outside;
      prober.moveTo(target);
    });
    return calibration.store();
  }
  const int axis = turningAxis(context, context.integer("S_MA"), ThirdAxis::AsItIs);
  const double surface = context.real("S_SETV") / countOf(context, axis);
  calibrateOneWay(context, calibration, variant, axis, signOf(context), surface);
  calibration.store();
}

}  // namespace

extern const Entry cycle973 = {.definition = definition,
                               .requirements = requirements,
                               .combinations = combinations,
                               .oldForm = oldForm,
                               .alarms = alarms,
                               .run = run};

}  // namespace probewright::cycles::sinumerik
