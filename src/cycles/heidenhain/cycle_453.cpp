#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "control/heidenhain/kinematics.hpp"
#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/kinematics_log.hpp"
#include "cycles/heidenhain/kinematics_measurement.hpp"
#include "cycles/heidenhain/kinematics_plan.hpp"
#include "cycles/heidenhain/parameters.hpp"
#include "cycles/heidenhain/sphere_search.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;
using control::Alarm;
using control::heidenhain::CompensationGrid;
using control::heidenhain::Kinematics;

constexpr Choice modes[] = {{-1, "clear: all values of the compensation table become 0"},
                            {0, "test: measure, and write nothing"},
                            {1, "compensate: write the deviations, which act at once"}};

constexpr Parameter parameters453[] = {
    option(406, "Q406", "mode", modes),
    sphereRadius,
    setUpClearance,
    retractHeight,
    positioningFeed,
    touchReference,
    sphereTouches,
    spherePreset,
};

constexpr CycleDefinition definition = {
    .number = 453,
    .name = "453",
    .title = "KINEMATICS GRID",
    .family = CycleFamily::Kinematics,
    .summary =
        "Measures on a calibration sphere how far the tool tip is off at the positions of a grid of the rotary "
        "axes, and enters it into the compensation table of the machine.",
    .parameters = parameters453,
    .controls = control::onTNC640,
};

struct Deviation {
  std::size_t node = 0;
  Vector3 error = Vector3::Zero();       ///< mm, machine coordinates at the reference posture
  Vector3 correction = Vector3::Zero();  ///< mm, machine axes as they stand: what the table's value is to grow by
};

/// Through the grid in turns: the last axis goes forth and back.
std::vector<std::size_t> route(const CompensationGrid& grid) {
  const std::size_t row = grid.axes().back().nodes.size();
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const std::size_t line = i / row, place = i % row;
    order.push_back(line * row + (line % 2 == 0 ? place : row - 1 - place));
  }
  return order;
}

std::vector<Deviation> measureGrid(Context& context, SphereSearch& search, const CompensationGrid& grid) {
  const machine::MachineDescription& machine = context.channel().description();
  const auto& reference = context.control().coordinates.preset.rotaryOffset;
  std::vector<std::size_t> rotary;
  for (std::size_t i = 0; i < machine.axes.size(); ++i) {
    if (machine.axes[i].kind == machine::AxisKind::Rotary) rotary.push_back(i);
  }
  for (const std::size_t axis : rotary)
    requireRetraction(context, axis);
  std::vector<Deviation> found;
  search.moveOver();
  for (const std::size_t node : route(grid)) {
    // The table counts machine angles.
    machine::AxisPositions angles = grid.node(node);
    for (const std::size_t axis : rotary)
      angles[axis] -= context.channel().rotaryOffset[axis];
    search.turnTo(angles, rotary, found.empty() ? SphereSearch::Order::OneByOne : SphereSearch::Order::Together);
    const FoundSphere sphere = search.measure(RadiusCheck::AtSecond);
    const Vector3 error = (sphere.centre - search.expected()).vector();
    const Matrix3 asItStands = machine::baseFromTable(machine, sphere.sighting.axes).linear() *
                               machine::baseFromTable(machine, reference).linear().transpose();
    found.push_back({node, error, -(asItStands * error)});
  }
  return found;
}

void writeGrid(Context& context, const CompensationGrid& grid) {
  auto& control = context.control();
  Kinematics& kinematics = *control.kinematics;
  for (std::size_t node = 0; node < grid.size(); ++node) {
    for (int i = 0; i < 3; ++i) {
      const std::string before = formatFixed(kinematics.grid->value(node)[i], 7);
      const std::string after = formatFixed(grid.value(node)[i] + 0.0, 7);
      const std::string entry =
          fmt::format("row {}, column {}", grid.row(node), std::array{"DX", "DY", "DZ"}[static_cast<std::size_t>(i)]);
      if (before != after) control.journal.write({kinematics.gridTable->table().name(), entry, before, after});
    }
  }
  if (const Result<void> done = grid.enter(*kinematics.gridTable); !done)
    throw Alarm("Table write error", done.error().message, done.error().advice);
  kinematics.grid = grid;
  control.applyKinematics();
}

std::string positionText(const machine::MachineDescription& machine, const CompensationGrid& grid, std::size_t node) {
  std::string text;
  const machine::AxisPositions position = grid.node(node);
  for (const CompensationGrid::GridAxis& axis : grid.axes())
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", machine.axes[axis.axis].name,
                        formatFixed(position[axis.axis], 4));
  return text;
}

void run(Context& context, const Arguments&) {
  auto& control = context.control();
  requireKinematicsOption(context);
  if (!control.parameters.option52) {
    throw Alarm("Function not enabled", "Cycle 453 needs software option 52, KinematicsComp",
                "enable the option (option52 in [parameters])");
  }
  if (!control.kinematics->grid) {
    throw Alarm("Compensation table missing", "The machine has no compensation table *.kco",
                "put one with the grid positions into the folder of tables; the machine's builder makes it");
  }
  CompensationGrid grid = *control.kinematics->grid;
  const int mode = context.option(406), preset = context.option(431);
  KinematicsLog log(context, "TCHPR453.html");
  log.line("Mode", fmt::format("{}: {}", mode, modes[mode + 1].meaning));
  if (mode == -1) {
    for (std::size_t node = 0; node < grid.size(); ++node)
      grid.setValue(node, Vector3::Zero());
    writeGrid(context, grid);
    log.write();
    return;
  }
  beginKinematicsMeasurement(context);
  if (preset == 1 || preset == 3) presetIntoSphere(context);
  SphereSearch search(context, PartInMachine(control.coordinates.machineFromPreset().translation()));
  const std::vector<Deviation> found = measureGrid(context, search, grid);
  double sum = 0;
  for (const Deviation& deviation : found)
    sum += deviation.error.squaredNorm();
  const auto largest =
      std::ranges::max_element(found, {}, [](const Deviation& deviation) { return deviation.error.norm(); });
  if (mode == 1) {
    for (const Deviation& deviation : found)
      grid.setValue(deviation.node, grid.value(deviation.node) + deviation.correction);
    writeGrid(context, grid);
  }
  if (preset >= 2) setSpherePreset(context, search.measure().centre);
  log.line("Standard deviation", formatFixed(std::sqrt(sum / static_cast<double>(found.size())), 4));
  log.line("Maximum deviation", formatFixed(largest->error.norm(), 4));
  log.line("Position of the maximum deviation", positionText(context.channel().description(), grid, largest->node));
  log.line("Number of measuring positions", std::to_string(found.size()));
  log.write();
  tiltAsTheAxesStand(context, search);
}

}  // namespace

extern const Entry cycle453 = {
    .definition = definition, .conditions = {.tilted = control::onTNC640}, .logTerms = kinematicsLogTerms, .run = run};

}  // namespace probewright::cycles::heidenhain
