#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "control/sinumerik/control.hpp"
#include "control/sinumerik/measuring_data.hpp"
#include "cycles/sinumerik/context.hpp"
#include "execution/interpreter.hpp"
#include "execution/sinumerik/host.hpp"
#include "language/sinumerik/program.hpp"
#include "support/coverage.hpp"
#include "support/virtual_world.hpp"

/// A SINUMERIK control on a virtual machine, with a calibrated probe in its magazine, and programs that call one cycle.
namespace probewright::testing_support {

using NamedNumbers = std::vector<std::pair<std::string, double>>;
using NamedTexts = std::vector<std::pair<std::string, std::string>>;

/// `first` with the values of `second` put over them.
inline NamedNumbers with(NamedNumbers first, const NamedNumbers& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

class SinumerikBench {
public:
  explicit SinumerikBench(const simulation::Truth& truth)
      : machine(truth), control(machine, calibrated(truth.tools.empty() ? 2 : truth.tools[0].probe.ballRadius)) {}

  /// The next run begins with the probe in the spindle, a settable frame in effect (1: G54) and the tip at a point of
  /// the workpiece, reached from above.
  void start(const Vector3& point, int settable = 1) {
    settable_ = settable;
    approach_ = point;
  }

  /// Runs a program with one call of a cycle; arguments by name, texts as given. `before` is program text in front of
  /// the call.
  execution::RunResult tryRun(const char* name, const NamedNumbers& numbers, const NamedTexts& texts = {},
                              const std::string& before = {}) {
    std::string text = fmt::format("{} G90 G71 DIAMOF {}\nT1 D1 M6\n", plane, gCodeOf(settable_));
    if (approach_) {
      const Vector3 above = *approach_ + Vector3(0, 0, clearance);
      // Up in machine coordinates first: the last run may have ended inside the workpiece.
      text += "SUPA G0 Z0 D0\nD1\n";
      for (const Vector3& point : {above, *approach_}) {
        text += fmt::format("G0 X{:.12f} Y{:.12f} Z{:.12f}\n", point.x(), point.y(), point.z());
      }
    }
    approach_.reset();
    opensLogs_ = opensLogs_ || std::string_view(name) == "CYCLE150";
    text += before + callOf(name, numbers, texts) + "\n";
    execution::InterpreterOptions options;
    options.programDepth = execution::sinumerik::SinumerikHost::programDepth;
    NoPrograms library;
    execution::sinumerik::SinumerikHost host(control, hostOptions);
    const std::size_t firstRecord = control.journal.cycles.size();
    execution::RunResult result = execution::Interpreter(library, host, options)
                                      .run(language::sinumerik::SinumerikProgram::fromText("TEST.MPF", text));
    coverage::noteRun(controlKind, control.journal, firstRecord);
    if (result.diagnostics.empty()) {
      coverage::note(controlKind, name, "parsed");
      coverage::note(controlKind, name, "runs");
    }
    return result;
  }

  void run(const char* name, const NamedNumbers& numbers, const NamedTexts& texts = {},
           const std::string& before = {}) {
    const execution::RunResult result = tryRun(name, numbers, texts, before);
    for (const Diagnostic& diagnostic : result.diagnostics)
      ADD_FAILURE() << format(diagnostic);
  }

  /// The code of the alarm that the call ends with; empty if it ends well. An alarm must say what to do.
  std::string alarmOf(const char* name, const NamedNumbers& numbers, const NamedTexts& texts = {}) {
    const execution::RunResult result = tryRun(name, numbers, texts);
    if (result.diagnostics.empty()) return {};
    const Diagnostic& first = result.diagnostics.front();
    coverage::note(controlKind, name, "refusals");
    EXPECT_FALSE(first.message.empty());
    EXPECT_FALSE(first.advice.empty()) << format(first);
    return first.code;
  }

  double ovr(int index) const {
    coverage::resultRead(controlKind, control.journal, fmt::format("_OVR[{}]", index));
    return control.ovr[static_cast<std::size_t>(index)];
  }
  int ovi(int index) const {
    coverage::resultRead(controlKind, control.journal, fmt::format("_OVI[{}]", index));
    return control.ovi[static_cast<std::size_t>(index)];
  }
  double data(const char* name, std::initializer_list<control::sinumerik::DataIndex> indices) const {
    coverage::writesRead(controlKind, control.journal,
                         [&](const control::WriteRecord& write) { return write.table == name; });
    return control.data.number(name, indices);
  }
  void set(const char* name, std::initializer_list<control::sinumerik::DataIndex> indices, double value) {
    control.data.set(name, indices, value);
  }
  /// The codes of the messages so far, each followed by a blank.
  std::string messages() const {
    std::string codes;
    for (const auto& event : control.journal.events) {
      if (!event.code.empty()) codes += event.code + ' ';
    }
    return codes;
  }

  /// A log that cycles have written; empty if there is none.
  std::string log(const std::string& name) const {
    coverage::logRead(controlKind, control.journal, name);
    if (opensLogs_) coverage::note(controlKind, "CYCLE150", "log");
    const auto found = control.panel.files().find(name);
    return found == control.panel.files().end() ? std::string() : found->second;
  }
  /// What the last cycle showed on the screen; empty if nothing.
  std::string screen() const {
    coverage::logRead(controlKind, control.journal, {});
    const auto& screens = control.journal.cycles.back().screens;
    return screens.empty() ? std::string() : screens.back();
  }

  static constexpr control::ControlKind controlKind = control::ControlKind::Sinumerik840Dsl;
  simulation::VirtualMachine machine;
  control::sinumerik::Control control;
  std::string plane = "G17";  ///< in effect when the cycle is called
  execution::sinumerik::HostOptions hostOptions;

private:
  static constexpr double clearance = 60;

  class NoPrograms : public language::ProgramLibrary {
  public:
    Result<std::shared_ptr<language::Program>> open(std::string_view name, const language::Program*) override {
      return fail("there is no program " + std::string(name));
    }
    bool exists(std::string_view, const language::Program*) override { return false; }
  };

  static std::string gCodeOf(int settable) {
    if (settable == 0) return "G500";
    return settable < 5 ? fmt::format("G{}", 53 + settable) : fmt::format("G{}", 500 + settable);
  }

  static std::string callOf(const char* name, const NamedNumbers& numbers, const NamedTexts& texts) {
    const cycles::CycleDefinition* definition = cycles::sinumerikCycle(name);
    if (definition == nullptr) {
      ADD_FAILURE() << "there is no cycle " << name;
      return {};
    }
    std::vector<std::string> places(definition->parameters.size());
    const auto put = [&](std::string_view parameter, std::string value) {
      for (const cycles::Parameter& each : definition->parameters) {
        if (each.name == parameter) places[each.address] = std::move(value);
      }
    };
    for (const auto& [parameter, value] : numbers)
      put(parameter, value == std::round(value) ? fmt::format("{:.0f}", value) : fmt::format("{:.12f}", value));
    for (const auto& [parameter, value] : texts)
      put(parameter, fmt::format("\"{}\"", value));
    while (!places.empty() && places.back().empty())
      places.pop_back();
    return fmt::format("{}({})", name, fmt::join(places, ","));
  }

  int settable_ = 1;
  bool opensLogs_ = false;  ///< a program has called CYCLE150
  std::optional<Vector3> approach_;

  /// The data of a control whose probe T1 (length 100, to the south pole) is calibrated for an ideal ball.
  static control::sinumerik::DataStore calibrated(double radius) {
    control::sinumerik::DataStore store;
    setMeasuringDefaults(store);
    store.set("$TC_TP2", {1}, std::string("PROBE"));
    store.set("$TC_DP1", {1, 1}, 710.0);
    store.set("$TC_DP3", {1, 1}, 100.0);
    store.set("$TC_DP6", {1, 1}, radius);
    store.set("$SNS_MEA_WP_BALL_DIAM", {0}, 2 * radius);
    for (const char* axis : {"1", "2"}) {
      store.set(std::string("$SNS_MEA_WP_TRIG_MINUS_DIR_AX") + axis, {0}, -radius);
      store.set(std::string("$SNS_MEA_WP_TRIG_PLUS_DIR_AX") + axis, {0}, radius);
    }
    return store;
  }
};

/// A seeded stream of numbers for planting truths.
class Planter {
public:
  explicit Planter(std::uint64_t seed) : stream_(seed) {}
  double number(double least, double greatest) {
    return std::uniform_real_distribution<double>(least, greatest)(stream_);
  }
  Vector3 within(double extent) { return {number(-extent, extent), number(-extent, extent), number(-extent, extent)}; }

private:
  std::mt19937_64 stream_;
};

/// Writes a translation and rotation (RPY, degrees) into frame `name`[number] of the store.
inline void plantFrame(SinumerikBench& bench, const char* name, int number, const Vector3& translation,
                       const Vector3& rotation = Vector3::Zero()) {
  const char* axes[] = {"X", "Y", "Z"};
  for (int i = 0; i < 3; ++i) {
    bench.set(name, {number, axes[i], "TR"}, translation[i]);
    if (rotation[i] != 0) bench.set(name, {number, axes[i], "RT"}, rotation[i]);
  }
}

/// Where a point of the table lies in the workpiece coordinate system now.
inline Vector3 inWorkpiece(SinumerikBench& bench, const Vector3& onTable) {
  coverage::writesRead(SinumerikBench::controlKind, bench.control.journal,
                       [](const control::WriteRecord& write) { return control::sinumerik::isFrameName(write.table); });
  return bench.control.machineFromWorkpiece().inverse() * onTable;
}

}  // namespace probewright::testing_support
