#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "cycles/catalogue.hpp"
#include "setup/calibrated_beliefs.hpp"
#include "setup/simulated_run.hpp"
#include "support/coverage.hpp"
#include "support/sinumerik_bench.hpp"
#include "support/virtual_world.hpp"

/// A mill with a tool touch probe on its table and a SINUMERIK control: tool 2 "MILL" is measured, tool 9 "PIN" has a
/// known size. Programs go through the front door.
namespace probewright::testing_support {

inline int whole(Planter& plant, int least, int greatest) {
  return std::min(greatest, least + static_cast<int>(plant.number(0, greatest - least + 1)));
}
inline bool coin(Planter& plant) { return plant.number(0, 1) < 0.5; }

/// What a run has left.
struct ToolRun {
  setup::SimulatedRun run;

  const control::Journal& journal() const { return run.outcome.journal; }
  const control::CycleRecord& cycle() const { return journal().cycles.back(); }
  /// _OVR, _OVI of the last cycle; NaN where it left none.
  double result(const std::string& name) const {
    coverage::resultRead(control::ControlKind::Sinumerik840Dsl, journal(), name);
    double value = std::nan("");
    for (const auto& each : cycle().results) {
      if (each.name == name) value = each.value;
    }
    return value;
  }
  double ovr(int index) const { return result(fmt::format("_OVR[{}]", index)); }
  double ovi(int index) const { return result(fmt::format("_OVI[{}]", index)); }
  /// What the program has copied into an R parameter.
  double r(int number) const { return run.outcome.variable(fmt::format("R{}", number)); }
  /// What a cycle has written last into a datum; NaN if none has.
  double written(const std::string& entry) const {
    coverage::writesRead(control::ControlKind::Sinumerik840Dsl, journal(),
                         [&](const control::WriteRecord& write) { return write.table + write.entry == entry; });
    double value = std::nan("");
    for (const auto& record : journal().cycles) {
      for (const auto& write : record.writes) {
        if (write.table + write.entry == entry) value = std::stod(write.after);
      }
    }
    return value;
  }
  std::string code() const {
    for (const Diagnostics* all : {&run.outcome.diagnostics, &run.outcome.result.diagnostics}) {
      for (const Diagnostic& each : *all) {
        if (each.severity == Severity::Error) return each.code.empty() ? each.message : each.code;
      }
    }
    return {};
  }
  std::string messages() const {
    std::string codes;
    for (const auto& event : journal().events) {
      if (!event.code.empty()) codes += event.code + ' ';
    }
    return codes;
  }
  bool told(std::string_view text) const {
    return std::ranges::any_of(journal().events,
                               [&](const auto& event) { return event.text.find(text) != std::string::npos; });
  }
};

struct ToolBench {
  explicit ToolBench(const std::string& machine = "mill3") {
    setup.world.truth = perfectWorld(machine);
    setup.world.truth.tools.clear();
    setup.beliefs.control = control::ControlKind::Sinumerik840Dsl;
  }

  void disc(double diameter, double thickness = 12) {
    half1 = half2 = diameter / 2;
    placeToolProbe(setup.world.truth, simulation::RoundBar(diameter / 2, -thickness, 0), translation(contact));
    setup.beliefs.toolProbes = setup::believedToolProbes(setup.world);
  }
  void cuboid(double length, double width) {
    half1 = length / 2;
    half2 = width / 2;
    placeToolProbe(setup.world.truth, simulation::Box({-half1, -half2, -12}, {half1, half2, 0}), translation(contact));
    setup.beliefs.toolProbes = setup::believedToolProbes(setup.world);
  }
  simulation::TrueToolProbe& probe() { return setup.world.truth.toolProbes.front(); }

  /// A tool that the control believes to be as it is; a pin without teeth.
  simulation::TrueTool& add(int number, double length, double radius, int teeth = 0) {
    simulation::TrueTool tool;
    tool.number = number;
    tool.name = number == 9 ? "PIN" : fmt::format("MILL{}", number);
    tool.kind = simulation::ToolKind::Cutter;
    tool.length = length;
    tool.radius = radius;
    tool.cutter.cutLength = 30;
    for (int i = 0; i < teeth; ++i)
      tool.cutter.teeth.push_back({.angle = 360.0 * i / teeth});
    if (teeth == 0) tool.cutter.cutting = machine::Rotation::None;
    control::BelievedTool believed;
    believed.number = number;
    believed.name = tool.name;
    believed.kind = "mill";
    setup::believeAsCalibrated(believed, tool);
    setup.beliefs.tools.push_back(believed);
    setup.world.truth.tools.push_back(std::move(tool));
    return setup.world.truth.tools.back();
  }
  control::BelievedTool& believed(int number) {
    return *std::ranges::find(setup.beliefs.tools, number, &control::BelievedTool::number);
  }
  void datum(const std::string& name, double value) { setup.beliefs.parameters[name] = {value, {}}; }
  /// The believed place of the probe differs by this from the true one.
  void misplace(const Vector3& by) {
    for (auto& each : setup.beliefs.toolProbes) {
      each.centre += by;
      each.least += by;
      each.most += by;
    }
  }
  void zeroOffset(const Vector3& origin) {
    setup.beliefs.zeroOffsets.push_back(
        {.index = 1, .name = "G54", .origin = origin, .rotation = Vector3::Zero(), .rotary = {}, .active = true});
  }

  static std::string call(const NamedNumbers& numbers) {
    const cycles::CycleDefinition& cycle = *cycles::sinumerikCycle("CYCLE971");
    std::vector<std::string> places(cycle.parameters.size());
    for (const auto& [name, value] : numbers) {
      const auto found = std::ranges::find(cycle.parameters, name, &cycles::Parameter::name);
      if (found == cycle.parameters.end()) {
        ADD_FAILURE() << "CYCLE971 has no " << name;
        continue;
      }
      places[found->address] =
          value == std::round(value) ? fmt::format("{:.0f}", value) : fmt::format("{:.12f}", value);
    }
    return fmt::format("CYCLE971({})\n", fmt::join(places, ","));
  }

  /// `tool` is led to `from`, which counts from the middle of the contact's upper face, machine coordinates; then come
  /// the blocks.
  ToolRun run(int tool, const Vector3& from, const std::string& blocks) const {
    const Vector3 start = contact + from;
    const std::string text = fmt::format("G17 G90 G71 G500\nT{} D1 M6\nG0 X{:.9f} Y{:.9f}\nG0 Z{:.9f}\n{}M30\n", tool,
                                         start.x(), start.y(), start.z(), blocks);
    return program(text);
  }
  ToolRun program(const std::string& text) const {
    ToolRun left{setup::runText("TOOLS.MPF", text, setup, {}, {.recordPath = false})};
    coverage::noteRun(control::ControlKind::Sinumerik840Dsl, left.journal());
    return left;
  }
  ToolRun measure(const Vector3& from, const NamedNumbers& numbers, int tool = 2) const {
    ToolRun left = run(tool, from, call(numbers));
    EXPECT_EQ(left.code(), "") << left.run.outcome.result.diagnostics.size();
    return left;
  }
  /// The code of the alarm that the call ends with; a message says what to do.
  std::string alarmOf(const Vector3& from, const NamedNumbers& numbers, int tool = 2,
                      const std::string& before = {}) const {
    const ToolRun left = run(tool, from, before + call(numbers));
    for (const Diagnostic& each : left.run.outcome.result.diagnostics)
      EXPECT_FALSE(each.advice.empty()) << format(each);
    if (!left.code().empty()) coverage::note(control::ControlKind::Sinumerik840Dsl, "CYCLE971", "refusals");
    return left.code();
  }

  setup::Setup setup;
  Vector3 contact = {120, -60, -470};  ///< true middle of the contact's upper face, machine coordinates
  double half1 = 0, half2 = 0;
};

/// Above the contact, out of its way.
inline const Vector3 above = {0, 0, 25};
/// Beside and above it, on the minus side of X.
inline const Vector3 beside = {-45, 3, 25};

}  // namespace probewright::testing_support
