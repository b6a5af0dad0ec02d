#include <fmt/format.h>

#include <cmath>

#include "control/alarm.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/parameters.hpp"
#include "probing/tool_prober.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;
using control::Alarm;
using control::heidenhain::NumberColumn;

constexpr Choice modeChoices[] = {{0, "calibrate"}, {1, "measure"}};
constexpr Choice directionChoices[] = {{0, "main axis +"},
                                       {1, "minor axis +"},
                                       {2, "main axis -"},
                                       {3, "minor axis -"},
                                       {4, "main axis +, minor axis +"},
                                       {5, "main axis +, minor axis -"},
                                       {6, "main axis -, minor axis +"},
                                       {7, "main axis -, minor axis -"}};

constexpr Parameter parameters440[] = {
    option(363, "Q363", "what is done", modeChoices),
    option(364, "Q364", "probing directions in the working plane", directionChoices),
    setUpClearance,
    clearanceHeight,
};

constexpr ResultDefinition results440[] = {
    {"Q185", "deviation from the calibrated value in X", result::difference(of::positionX).main()},
    {"Q186", "deviation from the calibrated value in Y", result::difference(of::positionY).main()},
    {"Q187", "deviation from the calibrated value in Z", result::difference(of::positionZ).main()},
};

constexpr NumberColumn axisNames[] = {"X", "Y", "Z"};

/// Senses of probing along the main and the minor axis; 0: not probed.
std::array<int, 2> sensesOf(int directions) {
  static constexpr std::array<std::array<int, 2>, 8> senses = {
      {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
  return senses[static_cast<std::size_t>(directions)];
}

probing::ToolTouchProbe toolTouchProbe(Context& context) {
  const auto& parameters = context.control().parameters;
  const PartInMachine place(parameters.mp6580x, parameters.mp6580y, parameters.mp6580z);
  if (place.vector().isZero(0)) {
    throw Alarm("Tool touch probe not calibrated", "MP6580.0 to MP6580.2 do not say where the tool touch probe is",
                "calibrate the tool touch probe, or enter its position in [parameters]");
  }
  return {.place = place,
          .size = parameters.mp6531,
          .size2 = parameters.mp6531,
          .depth = parameters.mp6530,
          .clearance = parameters.mp6540 + context.q(320),
          .reach = parameters.mp6130,
          .feed = parameters.mp6520,
          .rapid = parameters.mp6550};
}

/// The machine axes of the places that were touched; nothing where no touch was made.
using Places = std::array<std::optional<double>, 3>;

void storeCalibration(Context& context, const Places& places) {
  auto& control = context.control();
  auto& table = *control.tables.axisShifts;
  control.writeText(table, "1", "TOOL", control.tool.row);
  control.writeNumber(table, "1", "DIRECTION", context.option(364));
  for (std::size_t i = 0; i < 3; ++i) {
    if (places[i]) {
      control.writeNumber(table, "1", axisNames[i], *places[i]);
    } else {
      control.writeText(table, "1", axisNames[i], "");
    }
  }
}

/// Beyond LTOL along the spindle or RTOL in the plane the machine must not go on.
void checkLimits(Context& context, const Vector3& deviation) {
  const auto& control = context.control();
  const int toolAxis = control.coordinates.plane.tool;
  for (int axis = 0; axis < 3; ++axis) {
    const NumberColumn column = axis == toolAxis ? NumberColumn("LTOL") : NumberColumn("RTOL");
    const double limit = control.tables.tools.numberOr(control.tool.row, column, 0);
    if (limit > 0 && std::abs(deviation[axis]) > limit) {
      throw Alarm("Axis shift too large",
                  fmt::format("Axis {} has shifted by {:+.4f} mm; {} of tool {} permits {:.4f} mm",
                              axisNames[axis].name(), deviation[axis], column.name(), control.tool.row, limit),
                  "let the machine reach its temperature, or calibrate again");
    }
  }
}

constexpr CycleDefinition definition = {
    .number = 440,
    .name = "440",
    .title = "MEASURE AXIS SHIFT",
    .family = CycleFamily::Special,
    .summary =
        "Finds how far the machine's axes have shifted since the last calibration, with an exact cylindrical tool and "
        "the tool touch probe on the table; for instance by warming up.",
    .parameters = parameters440,
    .results = results440,
    .controls = control::onITNC530,
};

void run(Context& context, const Arguments&) {
  auto& control = context.control();
  for (int i = 0; i < 3; ++i)
    control.q.setQ(185 + i, 0);
  const probing::ToolTouchProbe contact = toolTouchProbe(context);
  auto& shifts = control.tables.axisShifts;
  const bool measuring = context.option(363) == 1;
  const bool calibrated = shifts && shifts->hasRow("1");
  if (measuring && !calibrated) {
    throw Alarm("Axis shift not calibrated", "Cycle 440 has not calibrated yet; there is nothing to compare with",
                "run cycle 440 with Q363 = 0 first");
  }
  const int directions = context.option(364);
  if (measuring && shifts->number("1", "DIRECTION") != directions) {
    throw Alarm(
        "Probing directions differ",
        fmt::format("Q364 = {}, but the calibration was made with {}", directions, shifts->text("1", "DIRECTION")),
        "measure in the directions of the calibration, or calibrate again");
  }
  if (const std::string tool = measuring ? shifts->text("1", "TOOL") : control.tool.row; tool != control.tool.row) {
    context.warn(
        fmt::format("Tool {} measures, but tool {} has calibrated: the deviations contain what differs in "
                    "their true lengths and radii",
                    control.tool.row, tool));
  }

  const auto& plane = control.coordinates.plane;
  auto& channel = context.channel();
  const machine::SpindleState spindle = channel.machine().spindle();
  if (channel.description().spindleOrients) channel.orientSpindle(0);
  ProgramPlace clearance = channel.position();
  clearance[plane.tool] = context.q(260);
  probing::ToolProber prober(channel, plane, contact, channel.machineFromProgram(clearance)[plane.tool]);
  const auto& tools = control.tables.tools;
  const double radius = channel.toolRadius;
  const double aside = tools.number(control.tool.row, "R-OFFS").value_or(radius);
  const double depth = contact.depth + tools.numberOr(control.tool.row, "L-OFFS", 0);

  Places places;
  places[static_cast<std::size_t>(plane.tool)] = prober.touchTop({aside, 0}).tip[plane.tool];
  prober.rise();
  const std::array<int, 2> senses = sensesOf(directions);
  for (int i = 0; i < 2; ++i) {
    const int sense = senses[static_cast<std::size_t>(i)];
    if (sense == 0) continue;
    const int axis = i == 0 ? plane.main : plane.minor;
    places[static_cast<std::size_t>(axis)] = prober.touchSide(i, sense, radius, depth).tip[axis];
  }
  // As before the cycle, M3 or M4.
  if (spindle.rotation != machine::Rotation::None) channel.turnSpindle(spindle.rotation, spindle.speed);
  if (!measuring) {
    storeCalibration(context, places);
    return;
  }
  Vector3 deviation = Vector3::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto before = shifts->number("1", axisNames[i]);
    if (places[i] && before) deviation[static_cast<Eigen::Index>(i)] = *places[i] - *before;
  }
  for (int i = 0; i < 3; ++i)
    context.result(185 + i, deviation[i]);
  checkLimits(context, deviation);
}

}  // namespace

extern const Entry cycle440 = {.definition = definition, .conditions = {.uses = Uses::ToolTouchProbe}, .run = run};

}  // namespace probewright::cycles::heidenhain
