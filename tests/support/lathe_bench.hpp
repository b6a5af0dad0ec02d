#pragma once

#include <string>

#include "session/sinumerik/beliefs.hpp"
#include "setup/calibrated_beliefs.hpp"
#include "setup/setup.hpp"
#include "support/sinumerik_bench.hpp"

/// A SINUMERIK lathe with a probe in its turret, and programs that measure on it.
namespace probewright::testing_support {

/// The probe T1 "PROBE". Cutting edge position 8: the stylus points to -X; 7: to -Z; 6: to +X; 5: to +Z.
struct LatheProbe {
  int position = 8;
  double length = 100;  ///< from the mount to the end of the ball
  double ballRadius = 2;
  Vector3 mount = {0, 0, -30};
  double pretravel = 0;       ///< across the stylus
  double axialPretravel = 0;  ///< along it
};

inline setup::Setup latheSetup(const LatheProbe& probe, const std::string& machine = "lathe2c") {
  setup::Setup setup;
  setup.world.truth = perfectWorld(machine);
  setup.beliefs.technology = setup::believedTechnology(setup.world.truth.machine);
  simulation::TrueTool& tool = setup.world.truth.tools.front();
  tool = idealProbe(probe.length, probe.ballRadius);
  tool.shankDirection = probe.position % 2 == 0 ? Vector3::UnitX() : Vector3::UnitZ();
  if (probe.position < 7) tool.shankDirection = -tool.shankDirection;
  tool.mount = probe.mount;
  tool.probe.pretravel = probe.pretravel;
  tool.probe.axialPretravel = probe.axialPretravel;
  control::BelievedTool believed;
  believed.number = 1;
  believed.name = tool.name;
  believed.kind = "probe";
  believed.length = probe.length - probe.axialPretravel;
  believed.radius = probe.ballRadius - probe.pretravel;
  believed.axialRadius = probe.ballRadius - probe.axialPretravel;
  believed.mount = probe.mount;
  believed.shankDirection = tool.shankDirection;
  setup.beliefs.tools.push_back(believed);
  return setup;
}

class LatheBench {
public:
  explicit LatheBench(const setup::Setup& setup) : machine(setup.world.truth), control(machine, beliefs(setup)) {
    set("$TC_TP2", {2}, 0);
    control.data.set("$TC_TP2", {2}, std::string("FINISH"));
    set("$TC_DP1", {2, 1}, 500);
    set("$TC_DP2", {2, 1}, 3);
    set("$TC_DP3", {2, 1}, 80);
    set("$TC_DP4", {2, 1}, 40);
    set("$TC_DP6", {2, 1}, 0.8);
  }

  /// Runs "G18 G90 G71 G54, T1 D1, `program`".
  execution::RunResult tryRun(const std::string& program) {
    const std::string text = "G18 G90 G71 G54\nT1 D1 M6\n" + program + "\n";
    execution::InterpreterOptions options;
    options.programDepth = execution::sinumerik::SinumerikHost::programDepth;
    NoPrograms library;
    execution::sinumerik::SinumerikHost host(control);
    const std::size_t firstRecord = control.journal.cycles.size();
    execution::RunResult result = execution::Interpreter(library, host, options)
                                      .run(language::sinumerik::SinumerikProgram::fromText("TURN.MPF", text));
    coverage::noteRun(controlKind, control.journal, firstRecord);
    return result;
  }

  void run(const std::string& program) {
    for (const Diagnostic& diagnostic : tryRun(program).diagnostics)
      ADD_FAILURE() << format(diagnostic) << "\n" << program;
  }

  /// The code of the alarm that the program ends with; empty if it ends well. An alarm must say what to do.
  std::string alarmOf(const std::string& program) {
    const execution::RunResult result = tryRun(program);
    if (result.diagnostics.empty()) return {};
    coverage::refusalRead(controlKind, control.journal, {"TURN.MPF", ~std::uint64_t{0}, 1}, program, "CYCLE");
    EXPECT_FALSE(result.diagnostics.front().advice.empty()) << format(result.diagnostics.front());
    return result.diagnostics.front().code;
  }

  double ovr(int index) const {
    coverage::resultRead(controlKind, control.journal, fmt::format("_OVR[{}]", index));
    return control.ovr[static_cast<std::size_t>(index)];
  }
  int ovi(int index) const {
    coverage::resultRead(controlKind, control.journal, fmt::format("_OVI[{}]", index));
    return control.ovi[static_cast<std::size_t>(index)];
  }
  double data(std::string_view name, std::initializer_list<control::sinumerik::DataIndex> indices) const {
    coverage::writesRead(controlKind, control.journal,
                         [&](const control::WriteRecord& write) { return write.table == name; });
    return control.data.number(name, indices);
  }
  void set(std::string_view name, std::initializer_list<control::sinumerik::DataIndex> indices, double value) {
    control.data.set(name, indices, value);
  }
  std::string messages() const {
    std::string codes;
    for (const auto& event : control.journal.events) {
      if (!event.code.empty()) codes += event.code + ' ';
    }
    return codes;
  }

  static constexpr control::ControlKind controlKind = control::ControlKind::Sinumerik840Dsl;
  simulation::VirtualMachine machine;
  control::sinumerik::Control control;

private:
  class NoPrograms : public language::ProgramLibrary {
  public:
    Result<std::shared_ptr<language::Program>> open(std::string_view name, const language::Program*) override {
      return fail("there is no program " + std::string(name));
    }
    bool exists(std::string_view, const language::Program*) override { return false; }
  };

  static control::sinumerik::DataStore beliefs(const setup::Setup& setup) {
    Diagnostics diagnostics;
    session::sinumerik::SinumerikData data = session::sinumerik::sinumerikData(setup.beliefs, diagnostics);
    EXPECT_TRUE(diagnostics.empty());
    return data.store;
  }
};

/// Writes X and Z translation into frame `name`[number] of the store.
inline void plantFrame(LatheBench& bench, const char* name, int number, double x, double z) {
  bench.set(name, {number, "X", "TR"}, x);
  bench.set(name, {number, "Z", "TR"}, z);
}

}  // namespace probewright::testing_support
