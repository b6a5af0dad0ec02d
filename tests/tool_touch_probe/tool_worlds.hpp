#pragma once

#include <array>
#include <cmath>
#include <sstream>

#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"
#include "setup/calibrated_beliefs.hpp"

/// Worlds with a tool touch probe: a mill (tool 12) and an exact pin (tool 9).
namespace probewright::testing_support {

struct ToolWorld {
  explicit ToolWorld(ControlKind kind = ControlKind::TNC640) : bench(kind) { bench.preset(1, {0, 0, -420}); }

  /// Adds a tool that the control believes to be `length` long, with `radius`.
  simulation::TrueTool& add(simulation::TrueTool tool, int number, double length, double radius) {
    tool.number = number;
    tool.name = number == 9 ? "PIN" : "MILL";
    tool.kind = simulation::ToolKind::Cutter;
    bench.knows(number, tool.name, length, radius);
    bench.setup.world.truth.tools.push_back(std::move(tool));
    return bench.setup.world.truth.tools.back();
  }

  void disc(double diameter) {
    half1 = half2 = diameter / 2;
    placeToolProbe(bench.setup.world.truth, simulation::RoundBar(diameter / 2, -10, 0), pose(contact));
  }
  void cuboid(double length, double width) {
    half1 = length / 2;
    half2 = width / 2;
    placeToolProbe(bench.setup.world.truth, simulation::Box({-half1, -half2, -12}, {half1, half2, 0}), pose(contact));
  }
  simulation::TrueToolProbe& toolProbe() { return bench.setup.world.truth.toolProbes.front(); }

  void parameter(const std::string& tnc640, const std::string& iTNC530, double value) {
    const std::string& name = bench.control == ControlKind::TNC640 ? tnc640 : iTNC530;
    if (!name.empty()) bench.setup.beliefs.parameters[name] = {value, {}};
  }

  Ran run(const std::string& blocks, int tool = 12) const {
    return bare(fmt::format("TOOL CALL {} Z\n", tool) + blocks);
  }
  Ran bare(const std::string& blocks) const {
    Bench run = bench;
    run.setup.beliefs.toolProbes = setup::believedToolProbes(bench.setup.world);
    return run.runBare(blocks);
  }

  Bench bench;
  Vector3 contact = {120, -60, -470};  ///< middle of its upper edge, machine coordinates
  double half1 = 0, half2 = 0;
};

/// TOOL.T with entries of tool 12 that setups have no keys for.
inline void enter(const TableFolder& folder, const ToolWorld& world,
                  const std::vector<std::pair<std::string, std::string>>& entries) {
  auto table = control::heidenhain::defaultToolTable(world.bench.control);
  for (const auto& tool : world.bench.setup.beliefs.tools) {
    if (tool.number != 12) continue;
    EXPECT_TRUE(table.ensureRow("12"));
    EXPECT_TRUE(table.setNumber("12", "L", tool.length));
    EXPECT_TRUE(table.setNumber("12", "R", tool.radius));
    for (const auto& [column, text] : entries)
      EXPECT_TRUE(table.setText("12", control::heidenhain::Column::named(column), text)) << column;
  }
  folder.put("TOOL.T", table);
}

/// Cycles 481 to 483, or 31 to 33 where `oldForm` is set.
inline std::string toolCycle(int number, int mode, bool teeth, bool oldForm) {
  if (!oldForm) return probe(number, {{340, mode}, {260, 60}, {341, teeth ? 1 : 0}});
  const int old = number - 450;
  return fmt::format(
      "TCH PROBE {0}.0 TOOL\nTCH PROBE {0}.1 CHECK: {1} Q5\nTCH PROBE {0}.2 HEIGHT: +60\nTCH PROBE {0}.3 PROBING THE "
      "TEETH: {2}\n",
      old, mode, teeth ? 1 : 0);
}

/// A mill with teeth that run out.
inline simulation::TrueTool plantedMill(Dice& dice, double radius, int teeth, bool even) {
  simulation::TrueTool mill;
  mill.length = dice.between(60, 110);
  mill.radius = radius;
  mill.cutter.cutLength = 25;
  mill.cutter.helix = dice.coin() ? 0 : dice.between(-30, 30);
  const double first = dice.between(-180, 180);
  for (int i = 0; i < teeth; ++i) {
    simulation::TrueTooth tooth;
    tooth.angle = first + 360.0 * i / teeth + (even ? 0 : dice.between(-4, 4));
    tooth.radial = dice.between(-0.03, 0.03);
    tooth.axial = dice.between(-0.03, 0.03);
    mill.cutter.teeth.push_back(tooth);
  }
  return mill;
}

inline double largest(const simulation::TrueTool& tool, double simulation::TrueTooth::*what) {
  double most = -1e9;
  for (const auto& tooth : tool.cutter.teeth)
    most = std::max(most, tooth.*what);
  return most;
}

/// The values of single teeth that the display of a cycle shows under a heading, in its order.
inline std::vector<double> shownTeeth(const control::CycleRecord& cycle, const std::string& heading) {
  std::vector<double> teeth;
  std::istringstream screen(cycle.screens.empty() ? std::string() : cycle.screens.back());
  bool within = false;
  for (std::string line; std::getline(screen, line);) {
    if (!line.starts_with(" ")) within = line == heading;
    // "   3 +8.0123": the value of the whole tool has no number before it.
    std::istringstream words(line);
    std::string number, value;
    if (within && words >> number >> value && number.find_first_not_of("0123456789") == std::string::npos)
      teeth.push_back(std::stod(value));
  }
  return teeth;
}

/// What a run has found: middle of the upper edge, half widths.
inline std::array<double, 5> found(const Ran& ran) {
  coverage::writesRead(ran.outcome.control, ran.outcome.journal,
                       [](const control::WriteRecord& write) { return write.entry.starts_with("TT "); });
  std::array<double, 5> values;
  values.fill(std::nan(""));
  constexpr const char* names[] = {"TT centre, X", "TT centre, Y", "TT centre, Z", "TT radius, main axis",
                                   "TT radius, minor axis"};
  for (const auto& cycle : ran.outcome.journal.cycles)
    for (const auto& write : cycle.writes)
      for (std::size_t i = 0; i < 5; ++i)
        if (write.entry == names[i]) values[i] = std::stod(write.after);
  return values;
}

}  // namespace probewright::testing_support
