#include <fmt/format.h>

#include "control/alarm.hpp"
#include "cycles/heidenhain/calibration.hpp"
#include "cycles/heidenhain/context.hpp"
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

constexpr CycleDefinition definition = {
    .number = 2,
    .name = "2",
    .title = "CALIBRATE TS",
    .family = CycleFamily::Calibration,
    .summary =
        "Calibrates the ball radius of the touch probe in a ring or on a pin whose position is in MP6180.0 to "
        "MP6180.2 and MP6185.0; in the second and third traverse range in MP6181, MP6185.1 and MP6182, MP6185.2.",
    .parameters = parameters2,
    .results = {},
    .controls = control::onITNC530,
};

/// Where the ring or pin of the traverse range in force stands, machine coordinates.
struct Standard {
  Vector3 centre;
  double depth = 0;  ///< of the touches below its upper edge
};
Standard standardOf(const control::heidenhain::MachineParameters& mp) {
  switch (mp.traverseRange) {
    case 2:
      return {{mp.mp6181x, mp.mp6181y, mp.mp6181z}, mp.mp6185second};
    case 3:
      return {{mp.mp6182x, mp.mp6182y, mp.mp6182z}, mp.mp6185third};
    default:
      return {{mp.mp6180x, mp.mp6180y, mp.mp6180z}, mp.mp6185};
  }
}

void run(Context& context, const Arguments&) {
  const auto& parameters = context.control().parameters;
  const auto [centre, depth] = standardOf(parameters);
  if (centre.isZero(0)) {
    const std::string name = fmt::format("MP618{}", parameters.traverseRange - 1);
    throw control::Alarm("Calibration workpiece not defined",
                         fmt::format("{}.0 to {}.2 hold no position of the ring or pin", name, name),
                         "enter its centre and upper edge in machine coordinates");
  }
  auto prober = calibrationProber(context);
  const auto& plane = context.control().coordinates.plane;
  const PartPoint place = plane.planeFromXyz(PartInProgram(context.machineFromProgram().inverse() * centre));
  const double clearance = context.q(probe_word::height);
  CalibrationTask task{.centre = place.inPlane(),
                       .standardRadius = context.q(probe_word::radius),
                       .side = context.option(probe_word::outside) == 1 ? Side::Outside : Side::Inside,
                       .count = 4,
                       .startAngle = 0,
                       .measuringHeight = place.z() - depth,
                       .travelHeight = clearance + prober.probe().ballRadius,
                       .extraClearance = 0,
                       .centreOffset = false};
  const BallCentre middle(place.x(), place.y(), task.measuringHeight);
  if (prober.position()[2] - prober.probe().ballRadius < clearance) prober.moveSouthPoleTo(clearance);
  if (task.side == Side::Inside) {
    prober.moveInPlane(middle);
    prober.moveTo(middle);
  }
  const CalibratedRadius calibrated = calibrateRadius(context, prober, task);
  prober.moveSouthPoleTo(clearance);
  context.control().calibrationRingRadius = task.standardRadius;
  storeRadius(context, calibrated);
}

}  // namespace

extern const Entry cycle2 = {
    .definition = definition, .conditions = {.under = Transformed::Any, .tilted = {}}, .run = run};

}  // namespace probewright::cycles::heidenhain
