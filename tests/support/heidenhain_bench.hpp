#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "control/heidenhain/datum_table.hpp"
#include "control/heidenhain/preset_table.hpp"
#include "control/heidenhain/probe_table.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "setup/simulated_run.hpp"
#include "support/coverage.hpp"
#include "support/virtual_world.hpp"

/// HEIDENHAIN programs in worlds whose truth is planted: one line a world, one line a run.
namespace probewright::testing_support {

using control::ControlKind;

/// Value, rounded to `decimals`, as a programmer would write it down.
inline double written(double value, int decimals = 3) {
  const double unit = std::pow(10.0, decimals);
  return std::round(value * unit) / unit;
}

inline double radians(double degrees) { return degrees * std::numbers::pi / 180; }
inline double degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// Shifted to `origin` and turned about X, then Y, then Z by `angles` (degrees).
inline Pose pose(const Vector3& origin, const Vector3& angles = Vector3::Zero()) {
  Pose result = Pose::Identity();
  result.translation() = origin;
  result.linear() = (Eigen::AngleAxisd(radians(angles.z()), Vector3::UnitZ()) *
                     Eigen::AngleAxisd(radians(angles.y()), Vector3::UnitY()) *
                     Eigen::AngleAxisd(radians(angles.x()), Vector3::UnitX()))
                        .toRotationMatrix();
  return result;
}

/// Random values of a seeded stream.
class Dice {
public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  bool coin() { return whole(0, 1) == 1; }
  Vector3 within(double reach) { return {between(-reach, reach), between(-reach, reach), between(-reach, reach)}; }

private:
  std::mt19937_64 engine_;
};

/// The parameters of a cycle by Q number.
using Words = std::vector<std::pair<int, double>>;

/// `words` with the values of `changes` in place of theirs, or added behind them.
inline Words with(Words words, const Words& changes) {
  for (const auto& [number, value] : changes) {
    auto found = std::find_if(words.begin(), words.end(), [&](const auto& word) { return word.first == number; });
    if (found == words.end()) {
      words.emplace_back(number, value);
    } else {
      found->second = value;
    }
  }
  return words;
}

/// The block of a touch probe cycle.
inline std::string probe(int number, const Words& words, const std::string& more = {}) {
  std::string text = fmt::format("TCH PROBE {} MEASURE", number);
  for (const auto& [parameter, value] : words)
    text += fmt::format(" ~\n  Q{}={:+.6f} ;VALUE", parameter, value);
  return text + more + "\n";
}

/// How a run went, with what tests ask of it.
class Ran {
public:
  Ran(setup::SimulatedRun run) : outcome(std::move(run.outcome)), machine(std::move(run.machine)) {
    coverage::noteRun(outcome.control, outcome.journal);
  }

  session::RunOutcome outcome;
  std::unique_ptr<simulation::VirtualMachine> machine;  ///< as it is at the end

  bool finished() const { return outcome.diagnostics.empty() && outcome.result.end == execution::RunEnd::Finished; }
  /// What stopped the run; empty if nothing did.
  std::string why() const {
    const Diagnostics& diagnostics = outcome.diagnostics.empty() ? outcome.result.diagnostics : outcome.diagnostics;
    if (diagnostics.empty()) return {};
    noteRefusal(diagnostics.front().place);
    return format(diagnostics.front());
  }
  /// The short text of the alarm that stopped the run.
  std::string alarm() const {
    if (outcome.result.end == execution::RunEnd::Alarm) noteRefusal(outcome.result.diagnostics.front().place);
    return outcome.result.end == execution::RunEnd::Alarm ? outcome.result.diagnostics.front().code : std::string();
  }
  const control::CycleRecord& cycle() const { return outcome.journal.cycles.back(); }
  /// Parameter Qn as it stands at the end, in the unit of the program.
  double q(int number) const {
    coverage::resultRead(outcome.control, outcome.journal, fmt::format("Q{}", number));
    return outcome.variable ? outcome.variable(fmt::format("Q{}", number)) : std::nan("");
  }
  /// Machine coordinates from the workpiece system at the end.
  Pose preset() const {
    noteRead("PRESET.PR");
    return outcome.machineFromWorkpiece.value_or(Pose(Eigen::Translation3d(1e9, 1e9, 1e9)));
  }
  /// Where a place of the machine lies in the workpiece system at the end.
  Vector3 seen(const Vector3& machinePoint) const { return preset().inverse() * machinePoint; }

  control::heidenhain::TypedTable table(const std::string& name) const {
    noteRead(name);
    return parsed(name);
  }
  /// A number of a table, as the file has it.
  double cell(const std::string& tableName, const std::string& row, const std::string& column) const {
    const std::string entry = fmt::format("row {}, column {}", row, column);
    coverage::writesRead(outcome.control, outcome.journal, [&](const control::WriteRecord& write) {
      return write.table == tableName && write.entry == entry;
    });
    return parsed(tableName).number(row, control::heidenhain::NumberColumn::named(column)).value_or(std::nan(""));
  }
  /// A log file beside the program; empty if there is none.
  std::string log(const std::string& name) const {
    coverage::logRead(outcome.control, outcome.journal, name);
    const auto found = outcome.files.find(name);
    return found == outcome.files.end() ? std::string() : found->second;
  }
  /// What the cycles showed on the screen, in the order they ran.
  std::vector<std::string> screens() const {
    coverage::logRead(outcome.control, outcome.journal, {});
    std::vector<std::string> shown;
    for (const auto& each : outcome.journal.cycles)
      shown.insert(shown.end(), each.screens.begin(), each.screens.end());
    return shown;
  }
  /// Touches of the last cycle.
  std::size_t touches() const { return cycle().touches.size(); }

private:
  void noteRefusal(const SourcePlace& place) const {
    const auto& programs = outcome.info.programs;
    coverage::refusalRead(outcome.control, outcome.journal, place, programs.empty() ? "" : programs.front().text,
                          "TCH PROBE");
  }
  void noteRead(const std::string& table) const {
    coverage::writesRead(outcome.control, outcome.journal,
                         [&](const control::WriteRecord& write) { return write.table == table; });
  }
  control::heidenhain::TypedTable parsed(const std::string& name) const {
    Diagnostics diagnostics;
    const auto columns = name == "PRESET.PR"     ? control::heidenhain::presetColumns()
                         : name == "TOOL.T"      ? control::heidenhain::toolColumns()
                         : name == "TCHPROBE.TP" ? control::heidenhain::probeColumns()
                                                 : control::heidenhain::datumColumns();
    const auto found = outcome.files.find(name);
    EXPECT_NE(found, outcome.files.end()) << "no file " << name;
    auto table = control::heidenhain::TypedTable::parse(found->second, name, columns, diagnostics);
    EXPECT_TRUE(table);
    return *table;
  }
};

/// A perfect machine of the given kind with a perfect probe, known to the control as it is. Nothing on the table.
struct Bench {
  explicit Bench(ControlKind kind = ControlKind::TNC640, const std::string& machine = "mill3") : control(kind) {
    setup.world.file = setup.beliefs.file = "bench.toml";
    setup.world.truth = perfectWorld(machine);
    control::BelievedTool tool;
    tool.number = 1;
    tool.name = "PROBE";
    tool.kind = "probe";
    tool.length = setup.world.truth.tools.front().length;
    tool.radius = setup.world.truth.tools.front().probe.ballRadius;
    tool.maximumTravel = 20;
    setup.beliefs.tools.push_back(tool);
  }

  control::BelievedTool& believedProbe() { return setup.beliefs.tools.front(); }
  simulation::TrueProbe& trueProbe() { return setup.world.truth.tools.front().probe; }

  /// Ball radius and length of the probe, true and believed.
  void probeOf(double length, double ballRadius) {
    setup.world.truth.tools.front() = idealProbe(length, ballRadius);
    believedProbe().length = length;
    believedProbe().radius = ballRadius;
  }

  /// A row of the preset table: origin in machine coordinates, basic rotation about the tool axis.
  void preset(int row, const Vector3& origin, double rotation = 0, bool active = true) {
    control::BelievedFrame frame;
    frame.index = row;
    frame.origin = origin;
    frame.rotation = {0, 0, rotation};
    frame.active = active;
    setup.beliefs.presets.push_back(frame);
  }

  template <class SolidType>
  void part(SolidType solid, const Pose& tableFromSolid = Pose::Identity()) {
    place(setup.world.truth, std::move(solid), tableFromSolid);
  }

  /// Another tool that the control knows.
  void knows(int number, const std::string& name, double length, double radius) {
    control::BelievedTool tool;
    tool.number = number;
    tool.name = name;
    tool.kind = "mill";
    tool.length = length;
    tool.radius = radius;
    setup.beliefs.tools.push_back(tool);
  }

  /// Runs the blocks as they are; `unit` MM or INCH.
  Ran runBare(const std::string& blocks, const std::string& unit = "MM") const {
    session::RunOptions options;
    options.control = control;
    options.wallClock = wallClock;
    options.onStop = onStop;
    if (answer) options.answer = [this](const control::Question& question) { return answer(question.name); };
    options.language = language;
    options.showAllResults = showAllResults;
    std::string text = "BEGIN PGM BENCH " + unit + "\n" + blocks + "END PGM BENCH " + unit + "\n";
    return {setup::runText(program, std::move(text), setup, options, {.recordPath = false})};
  }
  /// Runs the blocks behind TOOL CALL of the probe.
  Ran run(const std::string& blocks, const std::string& unit = "MM") const {
    return runBare("TOOL CALL 1 Z\n" + blocks, unit);
  }

  setup::Setup setup;
  ControlKind control;
  std::int64_t wallClock = 0;
  std::string program = "BENCH.H";
  control::DialogLanguage language = control::DialogLanguage::English;
  bool showAllResults = false;
  control::OnStop onStop = control::OnStop::Continue;
  std::function<std::optional<std::string>(const std::string& question)> answer;
};

/// Both controls in turn, for loops over random worlds.
inline ControlKind controlOf(int world) { return world % 2 == 0 ? ControlKind::TNC640 : ControlKind::iTNC530; }

}  // namespace probewright::testing_support
