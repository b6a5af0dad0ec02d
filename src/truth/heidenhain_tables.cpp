#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "control/heidenhain/compensation_grid.hpp"
#include "control/heidenhain/deflection_table.hpp"
#include "control/heidenhain/kinematic_tables.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "session/heidenhain/beliefs.hpp"
#include "simulation/probe_signal.hpp"
#include "simulation/tool_shape.hpp"
#include "simulation/true_kinematics.hpp"
#include "truth/entries.hpp"
#include "truth/family_truth.hpp"

/// Tables of which a cycle writes many rows: the response of a probe by direction, and the compensation of a machine by
/// the positions of its rotary axes.
namespace probewright::truth {

namespace {

namespace hh = control::heidenhain;
using records::EntryKind;
using records::EntryTruth;
using simulation::TrueKinematics;

std::optional<std::size_t> lastCycle(const control::Journal& journal, std::string_view name) {
  for (std::size_t i = journal.cycles.size(); i-- > 0;)
    if (journal.cycles[i].name == name) return i;
  return std::nullopt;
}

std::optional<hh::TypedTable> tableOf(const session::RunOutcome& outcome, const std::string& name,
                                      std::span<const hh::ColumnSpec> columns) {
  const auto file = outcome.files.find(name);
  if (file == outcome.files.end()) return std::nullopt;
  Diagnostics ignored;
  auto table = hh::TypedTable::parse(file->second, name, columns, ignored);
  if (!table) return std::nullopt;
  return std::move(*table);
}

/// What a touch along a direction of the table needs on top of the effective ball radius `radius`, if the length of the
/// probe is the one with which a touch straight down needs nothing.
double trueDeflection(const simulation::TrueTool& tool, const hh::Deflection& row, double radius, double angle,
                      double feed) {
  const double polar = radiansFromDegrees(row.polar), azimuth = radiansFromDegrees(row.azimuth);
  const Vector3 normal(-std::sin(polar) * std::cos(azimuth), -std::sin(polar) * std::sin(azimuth), std::cos(polar));
  const double delayed = tool.probe.signalDelay * feed / 60;
  const auto needed = [&](const Vector3& face) {
    return tool.probe.ballRadius - simulation::pretravelOf(tool, angle, simulation::toolFrame(tool) * face) - delayed -
           radius;
  };
  return needed(normal) - normal.z() * needed(Vector3::UnitZ());
}

/// Where the tip is on the table, by the readings of the axes, as somebody sees it.
using TipOnTable = std::function<Vector3(const machine::AxisPositions&)>;

/// The linear axes so that the tip is at `place`; affine in them, so that one step does it.
machine::AxisPositions readingsAt(const TipOnTable& tip, machine::AxisPositions axes, const Vector3& place,
                                  const machine::MachineDescription& machine) {
  std::vector<std::size_t> linear;
  for (std::size_t i = 0; i < machine.axes.size() && linear.size() < 3; ++i)
    if (machine.axes[i].kind == machine::AxisKind::Linear) linear.push_back(i);
  if (linear.size() < 3) return axes;
  const Vector3 here = tip(axes);
  Matrix3 change;
  for (int i = 0; i < 3; ++i) {
    machine::AxisPositions moved = axes;
    moved[linear[static_cast<std::size_t>(i)]] += 1;
    change.col(i) = tip(moved) - here;
  }
  const Vector3 by = change.fullPivLu().solve(place - here);
  for (int i = 0; i < 3; ++i)
    axes[linear[static_cast<std::size_t>(i)]] += by[i];
  return axes;
}

/// The middle of the sphere that the cycle touched, or of one that stands on the table. Table frame.
std::optional<Vector3> sphereOf(const TouchedCycle* touched, const simulation::Truth& truth) {
  if (touched != nullptr && !touched->points.empty()) {
    const TouchedPoint& point = touched->points.back();
    if (point.face && point.face->kind == simulation::AnalyticSurface::Kind::Sphere)
      return Vector3(point.planeFromTable.inverse() * point.face->origin);
  }
  for (const simulation::PlacedSolid& placed : truth.solids)
    if (placed.role == simulation::SolidRole::Sphere) return Vector3(placed.tableFromSolid.translation());
  return std::nullopt;
}

Vector3 baseOf(const session::RunOutcome& outcome) {
  Vector3 base = Vector3::Zero();
  const auto table = tableOf(outcome, hh::kinematicTableName, hh::kinematicColumns());
  if (!table) return base;
  for (const hh::KinematicEntry& entry : hh::entriesOf(*table))
    if (entry.key == "BASE" && entry.axis.size() == 1 && entry.axis[0] >= 'X' && entry.axis[0] <= 'Z')
      base[entry.axis[0] - 'X'] = entry.value;
  return base;
}

/// The response of a touch probe by direction, *.3DTC, if a calibration wrote it: a table is an entry, its distance
/// that of the direction that is wrong most.
std::vector<EntryTruth> deflectionEntries(const session::RunOutcome& outcome, const control::Beliefs& beliefs,
                                          const simulation::Truth& truth) {
  std::vector<EntryTruth> entries;
  const auto cycle = lastCycle(outcome.journal, "460");
  if (!cycle || outcome.control != control::ControlKind::TNC640) return entries;
  Diagnostics ignored;
  const auto before = session::heidenhain::heidenhainTables(beliefs, outcome.control, ignored);
  const auto tools = tableOf(outcome, "TOOL.T", hh::toolColumns());
  if (!tools) return entries;
  for (const control::BelievedTool& believed : beliefs.tools) {
    const auto real = std::ranges::find(truth.tools, believed.number, &simulation::TrueTool::number);
    const std::string row = std::to_string(believed.number);
    const std::string name = hh::deflectionTableName(tools->text(row, "DR2TABLE"));
    if (believed.kind != "probe" || real == truth.tools.end() || real->probe.starArm > 0 || name.empty()) continue;
    const auto table = tableOf(outcome, name, hh::deflectionColumns());
    const auto old = before.deflections.find(name);
    if (!table || (old != before.deflections.end() && old->second.table().bytes() == table->table().bytes())) continue;
    EntryTruth entry;
    entry.kind = EntryKind::Probe;
    entry.name = name;
    entry.cycle = cycle;
    double largest = 0;
    for (const hh::Deflection& known : hh::deflectionsOf(*table)) {
      const double real3D =
          trueDeflection(*real, known, tools->numberOr(row, "R", 0), believed.calibrationAngle, believed.feed);
      largest = std::max(largest, std::abs(known.deviation - real3D));
      entry.values.push_back(
          {fmt::format("DR {:.1f}/{:.1f}", known.polar, known.azimuth), "mm", known.deviation, real3D});
    }
    entry.distance = largest;
    if (!entry.values.empty()) entries.push_back(std::move(entry));
  }
  return entries;
}

/// The compensation table of cycle 453, if that wrote it, against what would put the tip of the probe to where it truly
/// is, with the axes so that it is at the calibration sphere. What all positions of the grid have in common is left
/// out.
std::vector<EntryTruth> gridEntries(const session::RunOutcome& outcome, const std::vector<TouchedCycle>& touched,
                                    const simulation::Truth& truth, const simulation::PathRecord& path) {
  const auto cycle = lastCycle(outcome.journal, "453");
  if (!cycle || !outcome.believedMachine || *cycle >= touched.size()) return {};
  const auto& writes = outcome.journal.cycles[*cycle].writes;
  const auto write = std::ranges::find_if(
      writes, [](const control::WriteRecord& record) { return record.entry.find("column D") != std::string::npos; });
  const auto sphere = sphereOf(&touched[*cycle], truth);
  if (write == writes.end() || !sphere) return {};
  const auto table = tableOf(outcome, write->table, hh::gridColumns());
  if (!table) return {};
  const machine::MachineDescription& believed = *outcome.believedMachine;
  const auto grid = hh::CompensationGrid::of(*table, believed);
  if (!grid) return {};

  const double seconds = outcome.journal.cycles[*cycle].endSeconds;
  const auto probe = std::ranges::find_if(path.points.rbegin(), path.points.rend(), [&](const auto& point) {
    return point.seconds <= seconds && point.tool >= 0;
  });
  if (probe == path.points.rend()) return {};
  const simulation::TrueTool& tool = truth.tools[static_cast<std::size_t>(probe->tool)];
  const Vector3 ball =
      tool.mount -
      tool.shankDirection * (tool.length - (tool.kind == simulation::ToolKind::Probe ? tool.probe.ballRadius : 0));
  const TrueKinematics kinematics(truth.machine, truth.errors);
  const Vector3 base = baseOf(outcome);
  const TipOnTable seen = [&](const machine::AxisPositions& axes) {
    const Vector3 further = base + grid->at(axes);
    return Vector3(machine::baseFromTable(believed, axes).inverse() *
                   (machine::baseFromSpindle(believed, axes) * ball + further));
  };
  std::vector<Vector3> apart;  // by how much the tip truly is further than the control sees it, table frame
  std::vector<machine::AxisPositions> postures;
  Vector3 common = Vector3::Zero();
  for (std::size_t node = 0; node < grid->size(); ++node) {
    const machine::AxisPositions axes = readingsAt(seen, grid->node(node), *sphere, believed);
    apart.emplace_back(kinematics.tableFromSpindle(axes, seconds) * ball - seen(axes));
    postures.push_back(axes);
    common += apart.back() / static_cast<double>(grid->size());
  }
  EntryTruth entry;
  entry.kind = EntryKind::Kinematics;
  entry.name = write->table;
  entry.cycle = cycle;
  double largest = 0;
  for (std::size_t node = 0; node < grid->size(); ++node) {
    // What all positions have in common is a matter of the preset.
    const Vector3 off = machine::baseFromTable(believed, postures[node]).linear() * (apart[node] - common);
    largest = std::max(largest, off.norm());
    for (int i = 0; i < 3; ++i)
      entry.values.push_back({fmt::format("{} D{}", grid->row(node), "XYZ"[i]), "mm", grid->value(node)[i],
                              grid->value(node)[i] + off[i]});
  }
  entry.distance = largest;
  return {std::move(entry)};
}

}  // namespace

std::vector<EntryTruth> heidenhainTableEntries(const session::RunOutcome& outcome, const control::Beliefs& beliefs,
                                               const std::vector<TouchedCycle>& touched, const simulation::Truth& truth,
                                               const simulation::PathRecord& path) {
  std::vector<EntryTruth> entries = deflectionEntries(outcome, beliefs, truth);
  for (EntryTruth& entry : gridEntries(outcome, touched, truth, path))
    entries.push_back(std::move(entry));
  return entries;
}

}  // namespace probewright::truth
