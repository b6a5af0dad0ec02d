#include "control/alarm.hpp"
#include "cycles/heidenhain/calibration.hpp"
#include "cycles/heidenhain/cycles.hpp"
#include "cycles/heidenhain/parameters.hpp"
#include "cycles/heidenhain/probe_words.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Choice sideChoices[] = {{0, "inside a ring"}, {1, "outside on a pin"}};

constexpr Parameter parameters2[] = {
    coordinate(probe_word::height, "HEIGHT", "clearance height in the touch probe axis"),
    {.name = "R",
     .address = probe_word::radius,
     .meaning = "radius of the ring or pin",
     .kind = ValueKind::Length,
     .minimum = 0.0001},
    option(probe_word::outside, "DIRECTION", "side of the touches", sideChoices),
};

}  // namespace

const CycleDefinition cycle2Definition = {
    .number = 2,
    .name = "2",
    .title = "CALIBRATE TS",
    .family = CycleFamily::Calibration,
    .summary =
        "Calibrates the ball radius of the touch probe in a ring or on a pin whose place stands in MP6180.0 to "
        "MP6180.2 "
        "and MP6185.0.",
    .parameters = parameters2,
    .results = {},
    .controls = control::onITNC530,
};

void cycle2(Context& context, const Arguments&) {
  context.require({.transformationsAllowed = true, .tiltAllowed = false});
  const auto& parameters = context.control().parameters;
  const Vector3 centre(parameters.mp6180x, parameters.mp6180y, parameters.mp6180z);
  if (centre.isZero(0)) {
    throw control::Alarm("Calibration workpiece not defined",
                         "MP6180.0 to MP6180.2 hold no position of the ring or pin",
                         "enter its centre and upper edge in machine coordinates");
  }
  auto prober = calibrationProber(context);
  const auto& plane = context.control().coordinates.plane;
  const Vector3 place = plane.planeFromXyz(context.machineFromProgram().inverse() * centre);
  const double clearance = context.q(probe_word::height);
  CalibrationTask task{.centre = place.head<2>(),
                       .standardRadius = context.q(probe_word::radius),
                       .side = context.option(probe_word::outside) == 1 ? Side::Outside : Side::Inside,
                       .count = 4,
                       .startAngle = 0,
                       .measuringHeight = place.z() - parameters.mp6185,
                       .travelHeight = clearance + prober.probe().ballRadius,
                       .extraClearance = 0};
  const Vector3 middle(place.x(), place.y(), task.measuringHeight);
  if (prober.position()[2] - prober.probe().ballRadius < clearance) prober.moveSouthPoleTo(clearance);
  if (task.side == Side::Inside) {
    prober.moveInPlane(middle);
    prober.moveTo(middle);
  }
  CalibratedRadius calibrated = calibrateRadius(context, prober, task);
  // The cycle finds the radius only; the centre offset stays as it is.
  calibrated.centreOffset.reset();
  prober.moveSouthPoleTo(clearance);
  storeRadius(context, calibrated);
}

}  // namespace probewright::cycles::heidenhain
