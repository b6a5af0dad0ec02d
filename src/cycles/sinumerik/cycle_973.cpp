#include <fmt/format.h>

#include <cmath>

#include "cycles/sinumerik/cycles.hpp"
#include "cycles/sinumerik/parameters.hpp"
#include "cycles/sinumerik/probe_calibration.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr Parameter parameters973[] = {
    parameters::variant("units: 0 length on a surface, 1 radius on a surface, 2 length in the groove, 3 radius in the "
                        "groove; hundreds 1; thousands: 0 by the cutting edge position, 1 axis and direction, 2 both "
                        "directions of an axis; 10^4: 1 without position deviation; 10^6: 1 with tool length",
                        12103),
    parameters::dataSet(1),
    parameters::code(2, "S_CALNUM", "number of the calibration groove, 1 to 3", 1),
    parameters::length(3, "S_SETV", "set value of the surface"),
    parameters::code(4, "S_MA", "measuring axis: 1, 2, 3", 1),
    parameters::code(5, "S_MD", "measuring direction: 0 plus, 1 minus", 1),
    parameters::measuringPath(6),
    parameters::safeArea(7),
    parameters::feed(8, "S_VMS", "measuring feed; 0: as in the setting data"),
    parameters::repetitions(9),
    parameters::reserved(10),
    parameters::plane(11),
    parameters::alternative(12),
};

/// An axis of the plane and the way along it.
struct Way {
  int axis = 0;
  double sign = 1;
  Vector3 direction() const { return probing::axisDirection(axis, sign); }
};

/// Towards the base of the groove, as the cutting edge position says: 8 looks into minus of the 2nd axis, 7 into minus
/// of the 1st.
Way wayToBase(Context& context) {
  switch (context.control().tool.position) {
    case 7:
      return {.axis = 0, .sign = -1};
    case 8:
      return {.axis = 1, .sign = -1};
    default:
      context.alarm(61315, fmt::format("cutting edge position {}: 7 or 8 is needed", context.control().tool.position));
  }
}

double signOf(Context& context) {
  const int way = context.integer("S_MD");
  if (way != 0 && way != 1) context.alarm(61326, "S_MD is 0 (plus) or 1 (minus)");
  return way == 0 ? 1 : -1;
}

/// Touches a surface with the ball's radius still unknown or not; what it finds goes into `calibration`.
double touchSurface(Context& context, ProbeCalibration& calibration, const Way& way, double surface) {
  Vector3 setpoint = context.prober().position();
  setpoint[way.axis] = surface;
  return calibration.touch(setpoint, way.direction(), context.real("S_FA"), calibration.assumedRadius())[way.axis];
}

/// The trigger point, or the tool length that makes it that of an ideal ball.
void takeLength(Context& context, ProbeCalibration& calibration, const Way& way, double surface, double tcp) {
  if (context.digit("S_MVAR", 7) == 0) {
    calibration.setTrigger(way.axis, way.sign, surface - tcp);
    return;
  }
  const double radius = context.control().tool.radius;
  if (!(radius > 0)) context.alarm(61351, "the radius of the ball must stand in the tool data");
  calibration.correctLength(way.axis, tcp - (surface - way.sign * radius));
  calibration.setTrigger(way.axis, way.sign, way.sign * radius);
}

void calibrateOnSurface(Context& context, ProbeCalibration& calibration, bool length) {
  Way way;
  switch (context.digit("S_MVAR", 4)) {
    case 0:
      way = wayToBase(context);
      break;
    case 1:
      way = {.axis = context.measuringAxis(3), .sign = signOf(context)};
      break;
    default:
      context.alarm(61307, "a surface is touched in one direction");
  }
  const double surface = context.real("S_SETV");
  const double tcp = touchSurface(context, calibration, way, surface);
  if (length) {
    takeLength(context, calibration, way, surface, tcp);
  } else {
    calibration.setTrigger(way.axis, way.sign, surface - tcp);
    calibration.completeAxis(way.axis, false);
  }
}

/// Machine coordinates while it lives: the groove is fixed to the machine.
class WithoutFrames {
public:
  explicit WithoutFrames(Control& control) : control_(control), before_(control.frames.suppressed) { set(true); }
  ~WithoutFrames() { set(before_); }
  WithoutFrames(const WithoutFrames&) = delete;
  WithoutFrames& operator=(const WithoutFrames&) = delete;

private:
  void set(bool suppressed) {
    control_.frames.suppressed = suppressed;
    control_.applyFrames();
  }
  Control& control_;
  bool before_;
};

void calibrateInGroove(Context& context, ProbeCalibration& calibration, bool length) {
  const int groove = context.integer("S_CALNUM");
  if (groove < 1 || groove > 3) context.alarm(61333, fmt::format("S_CALNUM = {}", groove));
  const auto datum = [&](const char* what, int axis) {
    return context.control().data.number(fmt::format("$SNS_MEA_CAL_EDGE_{}_AX{}", what, axis + 1), {groove - 1});
  };
  const Way toBase = wayToBase(context);
  const int across = 1 - toBase.axis;
  const double plus = datum("PLUS_DIR", across), minus = datum("MINUS_DIR", across), base = datum("BASE", toBase.axis);
  if (!(plus > minus)) context.alarm(61333, fmt::format("the walls of groove {} are not in the setting data", groove));

  const WithoutFrames machineCoordinates(context.control());
  probing::SinumerikProber& prober = context.prober();
  const double ahead = base + context.real("S_FA") + calibration.assumedRadius();
  Vector3 place = prober.position();
  place[across] = (plus + minus) / 2;
  prober.moveTo(place);
  // Where the upper edge is known, walls are touched half way down.
  place[toBase.axis] = !length && toBase.axis == 1 ? (datum("UPPER", toBase.axis) + base) / 2 : ahead;
  prober.moveTo(place);
  if (length) {
    takeLength(context, calibration, toBase, base, touchSurface(context, calibration, toBase, base));
    return;
  }
  const auto touchWall = [&](double sign) {
    const double wall = sign > 0 ? plus : minus;
    const double tcp = touchSurface(context, calibration, {.axis = across, .sign = sign}, wall);
    calibration.setTrigger(across, sign, wall - tcp);
  };
  const int directions = context.digit("S_MVAR", 4);
  if (directions == 0) context.alarm(61307, "thousands of S_MVAR: 1 one wall, 2 both walls");
  if (context.measuringAxis(2) != across) {
    context.alarm(61325, fmt::format("the walls of the groove lie across axis {}", across + 1));
  }
  if (directions == 1) {
    touchWall(signOf(context));
  } else {
    touchWall(1);
    touchWall(-1);
  }
  calibration.completeAxis(across, context.digit("S_MVAR", 5) == 0);
}

}  // namespace

const CycleDefinition cycle973Definition = {
    .number = 973,
    .name = "CYCLE973",
    .title = "Calibrate workpiece probe on a lathe: surface, groove",
    .family = CycleFamily::Calibration,
    .summary =
        "Calibrates a probe for turned parts on a known surface of the workpiece or in a groove fixed to the "
        "machine: trigger points, ball diameter, position deviation, tool length.",
    .parameters = parameters973,
    .results = calibrationResults,
    .controls = control::onSinumerik,
};

void cycle973(Context& context, const Arguments&) {
  context.requireProbe({580});
  const int units = context.digit("S_MVAR", 1);
  if (units > 3 || context.digit("S_MVAR", 3) != 1 || context.digit("S_MVAR", 4) > 2 ||
      context.digit("S_MVAR", 5) > 1 || context.digit("S_MVAR", 7) > 1) {
    context.alarm(61307);
  }
  ProbeCalibration calibration(context);
  const bool length = units == 0 || units == 2;
  if (units <= 1) {
    calibrateOnSurface(context, calibration, length);
  } else {
    calibrateInGroove(context, calibration, length);
  }
  calibration.store();
}

}  // namespace probewright::cycles::sinumerik
