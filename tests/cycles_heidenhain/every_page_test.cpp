#include <set>

#include "cycles/heidenhain/registry.hpp"
#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"
#include "language/klartext/check.hpp"
#include "language/klartext/program.hpp"

/// What the page of every cycle refuses, cycle by cycle through the whole catalogue.
namespace probewright::testing_support {
namespace {

using cycles::CycleDefinition;
using cycles::Parameter;

/// A value that makes sense in whatever cycle has the parameter.
double sensible(const Parameter& parameter) {
  static const std::map<std::uint32_t, double> values = {
      {261, -8}, {260, 40},  {262, 30},   {247, 90},   {267, 1},    {272, 1},   {423, 4},    {365, 1},    {303, 1},
      {305, 1},  {407, 12},  {583, 1},    {1100, -30}, {1101, -30}, {1102, -5}, {1103, 30},  {1104, -30}, {1105, -5},
      {1106, 0}, {1107, 30}, {1108, -5},  {372, 1},    {1116, 20},  {1117, 20}, {1119, 360}, {1125, 1},   {266, 40},
      {297, 40}, {296, 30},  {265, 20},   {312, 6},    {271, 30},   {292, 90},  {293, 180},  {291, 0},    {316, 40},
      {326, 10}, {327, 10},  {253, 2000}, {411, -90},  {412, 90},   {414, 4}};
  const auto found = values.find(parameter.address);
  if (found != values.end()) return found->second;
  if (!parameter.choices.empty()) return parameter.choices.front().value;
  return std::clamp(parameter.standard.value_or(0), parameter.minimum, parameter.maximum);
}

/// The parameters of the cycle that are texts.
std::string textsOf(const CycleDefinition& cycle) {
  std::string texts;
  for (const Parameter& parameter : cycle.parameters) {
    if (parameter.kind == cycles::ValueKind::Text)
      texts += fmt::format(" ~\n  {}=\"{}\" ;T", parameter.name, parameter.address == 600 ? "OS" : " ");
  }
  return texts;
}

/// The cycle's block with sensible values.
std::string block(const CycleDefinition& cycle, ControlKind kind) {
  switch (cycle.number) {
    case 0:
      return "TCH PROBE 0.0 REF. PLANE Q5 X-\nTCH PROBE 0.1 X+5 Y+0 Z-5\n";
    case 1:
      return "TCH PROBE 1.0 POLAR\nTCH PROBE 1.1 X ANGLE: +30\nTCH PROBE 1.2 X+5 Y+10 Z-5\n";
    case 2:
      return "TCH PROBE 2.0 CALIBRATE TS\nTCH PROBE 2.1 HEIGHT: +30 R +20 DIRECTION: 0\n";
    case 3:
      return "TCH PROBE 3.0 MEASURING\nTCH PROBE 3.1 Q10\nTCH PROBE 3.2 Z ANGLE: +180\n"
             "TCH PROBE 3.3 DIST +10 F100 MB1 REFERENCE SYSTEM: 0\n";
    case 4:
      return "TCH PROBE 4.0 M\nTCH PROBE 4.1 Q10\nTCH PROBE 4.2 IZ-1\n"
             "TCH PROBE 4.3 ABST+5 F100 MB1 REFERENCE SYSTEM:0\n";
    case 9:
      return "TCH PROBE 9.0 CALIBRATE TS LENGTH\nTCH PROBE 9.1 DATUM +0 REFERENCE SYSTEM 0\n";
    case 30:
      return "TCH PROBE 30.0 CALIBRATE TT\nTCH PROBE 30.1 HEIGHT: +40\n";
    case 31:
    case 32:
    case 33:
      return fmt::format(
          "TCH PROBE {0}.0 TOOL\nTCH PROBE {0}.1 CHECK: 0\nTCH PROBE {0}.2 HEIGHT: +40\nTCH PROBE {0}.3 TEETH: 0\n",
          cycle.number);
    default:
      break;
  }
  Words words;
  for (const Parameter& parameter : cycle.parameters) {
    if (!parameter.controls.contains(kind) || parameter.kind == cycles::ValueKind::Text) continue;
    words.emplace_back(parameter.address, sensible(parameter));
  }
  // Its points span a plane square to the tool axis.
  if (cycle.number == 1420) words = with(words, {{372, -3}});
  // Its points lie beside each other along the main axis.
  if (cycle.number == 1410) words = with(words, {{372, 2}});
  return probe(cycle.number, words, textsOf(cycle));
}

/// A 5-axis machine with nothing on it.
Bench emptyBench(ControlKind kind) {
  Bench bench(kind, "mill5-table-table");
  bench.preset(1, {0, 0, -450});
  bench.setup.beliefs.parameters.clear();
  if (kind == ControlKind::iTNC530) {
    for (const char* name : {"MP6180.0", "MP6180.1", "MP6180.2"})
      bench.setup.beliefs.parameters[name] = {-300.0, {}};
    bench.setup.beliefs.parameters["MP6580.2"] = {-450.0, {}};
  }
  return bench;
}

/// Runs `check` for each cycle of the control.
template <class Check>
void forEveryCycle(ControlKind kind, const Check& check) {
  for (const auto* entry : cycles::heidenhain::entries()) {
    if (!entry->definition.controls.contains(kind)) continue;
    SCOPED_TRACE(fmt::format("cycle {} on the {}", entry->definition.name, control::name(kind)));
    check(entry->definition, block(entry->definition, kind));
  }
}

/// Cycles that refuse the touch probe as a tool.
bool measuresTools(const CycleDefinition& cycle) { return cycle.family == cycles::CycleFamily::Tool; }

/// Cycles that look instead of touching; this machine has no camera.
bool takesImages(const CycleDefinition& cycle) { return cycle.number == 600 || cycle.number == 601; }

constexpr ControlKind newer = ControlKind::TNC640, older = ControlKind::iTNC530;

TEST(EveryPage, SaysWhetherTheCycleRunsInTurningMode) {
  const std::set<int> allowed = {3, 4, 450, 460, 461, 462, 463, 600, 601};
  forEveryCycle(newer, [&](const CycleDefinition& cycle, const std::string& blocks) {
    const Ran ran = emptyBench(newer).run("FUNCTION MODE TURN\n" + blocks);
    if (allowed.contains(cycle.number)) {
      EXPECT_NE(ran.alarm(), "Function not permitted");
      return;
    }
    EXPECT_EQ(ran.alarm(), "Function not permitted") << ran.why();
    EXPECT_NE(ran.why().find("milling mode"), std::string::npos) << ran.why();
  });
}

TEST(EveryPage, NeedsAToolCallThatDefinesTheTouchProbeAxis) {
  const std::set<int> still = {404, 441, 450};
  for (const ControlKind kind : {newer, older}) {
    forEveryCycle(kind, [&](const CycleDefinition& cycle, const std::string& blocks) {
      const Ran ran = emptyBench(kind).runBare(blocks);
      if (takesImages(cycle)) {
        EXPECT_EQ(ran.alarm(), "Function not enabled") << ran.why();
        return;
      }
      if (still.contains(cycle.number)) {
        EXPECT_TRUE(ran.finished()) << ran.why();
        return;
      }
      EXPECT_EQ(ran.alarm(), "Touch probe axis not defined") << ran.why();
      EXPECT_NE(ran.why().find("TOOL CALL"), std::string::npos) << ran.why();
    });
  }
}

TEST(EveryPage, RefusesCoordinateTransformations) {
  const std::string shift = "CYCL DEF 7.0 SHIFT\nCYCL DEF 7.1 X+5\n", mirror = "CYCL DEF 8.0 MIRROR\nCYCL DEF 8.1 X\n",
                    turn = "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+15\n",
                    scale = "CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 1.1\n",
                    axes = "CYCL DEF 26.0 AXIS-SPEC. SCALING\nCYCL DEF 26.1 X1.1 CCX+0 CCY+0\n";
  forEveryCycle(newer, [&](const CycleDefinition& cycle, const std::string& blocks) {
    // 0, 1, 3 and 4 are not of the family 400 to 499; 441 and 450 only set values.
    const bool tools = measuresTools(cycle);
    const bool free =
        !tools && (cycle.number < 400 || cycle.number == 441 || cycle.number == 450 || takesImages(cycle));
    const bool presets = cycle.number >= 408 && cycle.number <= 419;
    const bool family14 = cycle.number >= 1400 || cycle.number == 444 || tools;
    for (const std::string& before : {shift, mirror, turn, scale, axes}) {
      SCOPED_TRACE(before);
      const bool may = free || (family14 && (before == shift || before == turn)) || (presets && before == turn);
      const Ran ran = emptyBench(newer).run(before + blocks);
      if (may) {
        EXPECT_NE(ran.alarm(), "Coordinate transformation not permitted") << ran.why();
      } else {
        EXPECT_EQ(ran.alarm(), "Coordinate transformation not permitted") << ran.why();
      }
    }
  });
}

TEST(EveryPage, ReportsThatTheStylusWasNotDeflected) {
  const std::set<int> still = {404, 441, 450}, silent = {3, 4};
  for (const ControlKind kind : {newer, older}) {
    forEveryCycle(kind, [&](const CycleDefinition& cycle, const std::string& blocks) {
      // 453 needs the compensation table of a machine's builder.
      if (measuresTools(cycle) || takesImages(cycle) || cycle.number == 453) return;
      const std::string above = cycle.number == 2 || cycle.number == 440 ? "" : "L Z+60 R0 FMAX\nL X+0 Y+0 R0 FMAX\n";
      const Ran ran = emptyBench(kind).run(above + blocks);
      if (still.contains(cycle.number)) {
        EXPECT_TRUE(ran.finished()) << ran.why();
        return;
      }
      if (silent.contains(cycle.number)) {
        EXPECT_TRUE(ran.finished()) << ran.why();
        EXPECT_EQ(ran.q(13), -1);
        return;
      }
      // 440 measures with the tool touch probe, which this machine does not have.
      const bool ready = cycle.number != 440;
      EXPECT_EQ(ran.alarm(), ready ? "Touch point inaccessible" : "Touch probe not ready") << ran.why();
      EXPECT_NE(ran.why().find(ready ? "not deflected within" : "no tool touch probe"), std::string::npos) << ran.why();
      ASSERT_FALSE(ran.outcome.journal.cycles.empty());
      EXPECT_EQ(ran.cycle().touches.size(), 1U);
      EXPECT_TRUE(ran.cycle().writes.empty());
    });
  }
}

TEST(EveryPage, ChecksThatRotaryAxesAgreeWithTheTilt) {
  const std::set<int> still = {404, 441, 450};
  Bench bench = emptyBench(newer);
  bench.setup.beliefs.parameters["chkTiltingAxes"] = {1.0, {}};
  forEveryCycle(newer, [&](const CycleDefinition& cycle, const std::string& blocks) {
    if (still.contains(cycle.number) || takesImages(cycle)) return;
    const Ran ran = bench.run("PLANE SPATIAL SPA+0 SPB+10 SPC+0 STAY\n" + blocks);
    EXPECT_EQ(ran.alarm(), "Rotary axes and tilt do not match") << ran.why();
    EXPECT_NE(ran.why().find("chkTiltingAxes"), std::string::npos) << ran.why();
  });
}

TEST(EveryPage, KeepsTheOldMisalignmentCyclesOutOfTiltedPlanes) {
  for (const int number : {400, 401, 402, 403, 405}) {
    const CycleDefinition& cycle = cycles::heidenhain::findEntry(number)->definition;
    SCOPED_TRACE(number);
    const Ran ran = emptyBench(newer).run("PLANE SPATIAL SPA+0 SPB+10 SPC+0 STAY\n" + block(cycle, newer));
    EXPECT_EQ(ran.alarm(), "Tilted working plane not permitted") << ran.why();
  }
  // The iTNC 530 forbids it for 403 alone.
  for (const int number : {400, 401, 402, 405}) {
    SCOPED_TRACE(number);
    const Ran ran = emptyBench(older).run("PLANE SPATIAL SPA+0 SPB+10 SPC+0 STAY\n" +
                                          block(cycles::heidenhain::findEntry(number)->definition, older));
    EXPECT_EQ(ran.alarm(), "Touch point inaccessible") << ran.why();
  }
  const Ran old = emptyBench(older).run("PLANE SPATIAL SPA+0 SPB+10 SPC+0 STAY\n" +
                                        block(cycles::heidenhain::findEntry(403)->definition, older));
  EXPECT_EQ(old.alarm(), "Tilted working plane not permitted") << old.why();
}

/// Values that cannot go together: the check names them as numbers, and the run refuses them before the first touch.
TEST(EveryPage, NamesGeometriesThatDetermineNothingBeforeTheyAreTouched) {
  struct Case {
    int cycle;
    Words words;
    std::string alarm, part;
    bool isBlank = false;  ///< as manuals print a block that is not filled in yet: a reader need not be told
  };
  const std::vector<Case> cases = {
      {400, {{263, 1}, {265, 1}, {264, 5}, {266, 9}, {272, 2}}, "Edge not determined", "coincide"},
      {400, {{263, 1}, {265, 7}, {264, 5}, {266, 5}, {272, 1}}, "Edge not determined", "coincide"},
      {403, {{263, 1}, {265, 1}, {264, 5}, {266, 5}, {272, 3}}, "Edge not determined", "coincide"},
      {420, {{263, 1}, {265, 7}, {264, 5}, {266, 9}, {272, 3}}, "Angle not determined", "Q272 = 3"},
      {401, {{268, 1}, {269, 2}, {270, 1}, {271, 2}}, "Angle not determined", "centres coincide"},
      {402, {{268, 1}, {269, 2}, {270, 1}, {271, 2}}, "Angle not determined", "centres coincide"},
      {414, {{263, 1}, {296, 1}}, "Corner not determined", "share a coordinate"},
      {414, {{264, 3}, {297, 3}}, "Corner not determined", "share a coordinate"},
      {414, {{326, 0}}, "Corner not determined", "Q326"},
      {414, {{327, 0}}, "Corner not determined", "Q327"},
      {418, {{268, 1}, {269, 2}, {316, 1}, {317, 2}}, "Intersection not determined", "1 and 3"},
      {418, {{270, 1}, {271, 2}, {318, 1}, {319, 2}}, "Intersection not determined", "2 and 4"},
      {418,
       {{268, 0}, {269, 0}, {270, 0}, {271, 9}, {316, 20}, {317, 0}, {318, 20}, {319, 9}},
       "Intersection not determined",
       "parallel"},
      {444, {{581, 0}, {582, 0}, {583, 0}}, "Surface normal wrong", "no length"},
      {1410, {{372, 1}, {1101, 4}, {1104, 4}}, "Angle not determined", "coincide"},
      {1410, {{372, -2}, {1100, 4}, {1103, 4}}, "Angle not determined", "coincide"},
      {1410, {{372, 3}, {1121, 1}}, "Probing direction not permitted", "tool axis"},
      {1411, {{1119, 0}}, "Angular length wrong", "Q1119"},
      {1411, {{1116, 0}}, "Diameter wrong", "larger than 0", true},
      {1411, {{1117, 0}}, "Diameter wrong", "larger than 0", true},
      {1411, {{1100, 0}, {1101, 0}, {1103, 0}, {1104, 0}}, "Angle not determined", "coincide", true},
      {1411, {{1100, 3}, {1101, 4}, {1103, 3}, {1104, 4}}, "Angle not determined", "coincide"},
      {1420,
       {{372, -3}, {1100, 0}, {1101, 0}, {1103, 9}, {1104, 9}, {1106, 18}, {1107, 18}},
       "Plane wrongly defined",
       "straight line"},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(fmt::format("cycle {}: {}", one.cycle, one.part));
    const CycleDefinition& cycle = cycles::heidenhain::findEntry(one.cycle)->definition;
    Words words;
    for (const Parameter& parameter : cycle.parameters) {
      if (parameter.controls.contains(newer) && parameter.kind != cycles::ValueKind::Text)
        words.emplace_back(parameter.address, sensible(parameter));
    }
    std::string program = probe(one.cycle, with(words, one.words), textsOf(cycle));
    language::klartext::KlartextProgram read("a.h", "BEGIN PGM A MM\nTOOL CALL 1 Z\n" + program + "END PGM A MM\n");
    const Diagnostics mistakes = language::klartext::checkProgram(read, newer);
    const bool isNamed = std::ranges::any_of(mistakes, [&](const Diagnostic& mistake) {
      return mistake.severity == Severity::Error && mistake.message.find(one.part) != std::string::npos;
    });
    EXPECT_EQ(isNamed, !one.isBlank);
    const auto [address, value] = one.words.front();
    const std::string written = fmt::format("Q{}={:+.6f}", address, value);
    ASSERT_NE(program.find(written), std::string::npos) << program;
    program.replace(program.find(written), written.size(), fmt::format("Q{}=+Q1", address));
    const Ran computed = emptyBench(newer).run(fmt::format("Q1 = {}\n", value) + program);
    EXPECT_EQ(computed.alarm(), one.alarm) << computed.why();
    EXPECT_NE(computed.why().find(one.part), std::string::npos) << computed.why();
    ASSERT_FALSE(computed.outcome.journal.cycles.empty());
    EXPECT_TRUE(computed.cycle().touches.empty());
    EXPECT_TRUE(computed.cycle().writes.empty());
  }
}

TEST(EveryPage, RefusesGeometriesThatDetermineNothing) {
  const auto changed = [](int number, const Words& changes) {
    const CycleDefinition& cycle = cycles::heidenhain::findEntry(number)->definition;
    Words words;
    for (const Parameter& parameter : cycle.parameters) {
      if (parameter.controls.contains(newer)) words.emplace_back(parameter.address, sensible(parameter));
    }
    return probe(number, with(words, changes));
  };
  for (const int number : {405, 421, 422, 412, 413}) {
    SCOPED_TRACE(number);
    // A computed angle, which only the run can judge.
    std::string program = changed(number, {{247, 4}});
    const std::string written = "Q247=+4.000000";
    program.replace(program.find(written), written.size(), "Q247=+Q1");
    const Ran ran = emptyBench(newer).run("Q1 = 4\n" + program);
    EXPECT_EQ(ran.alarm(), "Stepping angle too small") << ran.why();
    EXPECT_NE(ran.why().find("5 degrees"), std::string::npos) << ran.why();
  }
  const Ran aside = emptyBench(newer).run(changed(420, {{272, 3}, {263, 0}, {264, 0}, {265, 20}, {266, 10}}));
  EXPECT_EQ(aside.alarm(), "Angle not determined") << aside.why();
  EXPECT_NE(aside.why().find("Q272"), std::string::npos) << aside.why();
  for (const int wrong : {-1, 2}) {
    const Ran ran = emptyBench(newer).run(changed(420, {{301, wrong}}));
    EXPECT_EQ(ran.outcome.info.exit, records::ExitState::InputMistake);
    EXPECT_NE(ran.why().find("Q301"), std::string::npos) << ran.why();
  }
  // Three holes of a bolt circle in one line.
  Bench holes = emptyBench(newer);
  for (const double x : {-40.0, 0.0, 40.0})
    holes.part(simulation::Ring(8, 14, -20), pose({x, 0, -450}));
  // The angles that lead from the centre (0, 0) at radius 40 to holes in one line do not exist; two of them coincide.
  const Ran twice = holes.run(changed(430, {{273, 0}, {274, 0}, {262, 80}, {291, 0}, {292, 0}, {293, 180}, {261, -8}}));
  EXPECT_EQ(twice.alarm(), "Circle not determined") << twice.why();
}

/// Each parameter that a block names by its Q number: beyond its range, no choice, half a whole number, left out.
TEST(EveryPage, RefusesEveryParameterOutsideItsRange) {
  std::size_t refused = 0;
  for (const ControlKind kind : {newer, older}) {
    const Bench bench = emptyBench(kind);
    for (const auto* entry : cycles::heidenhain::entries()) {
      const CycleDefinition& cycle = entry->definition;
      if (cycle.number < 400 || !cycle.controls.contains(kind)) continue;
      Words words;
      for (const Parameter& parameter : cycle.parameters) {
        if (parameter.controls.contains(kind) && parameter.kind != cycles::ValueKind::Text) {
          words.emplace_back(parameter.address, sensible(parameter));
        }
      }
      const std::string text = textsOf(cycle);
      for (const Parameter& parameter : cycle.parameters) {
        if (parameter.kind == cycles::ValueKind::Text) continue;
        SCOPED_TRACE(fmt::format("cycle {} on the {}, {}", cycle.name, control::name(kind), parameter.name));
        const auto expectNamed = [&](const Words& wrong) {
          const Ran ran = bench.run(probe(cycle.number, wrong, text));
          EXPECT_EQ(ran.outcome.info.exit, records::ExitState::InputMistake);
          EXPECT_NE(ran.why().find(parameter.name), std::string::npos) << ran.why();
          EXPECT_TRUE(ran.outcome.journal.cycles.empty());
          ++refused;
        };
        if (!parameter.controls.contains(kind)) {
          expectNamed(with(words, {{parameter.address, sensible(parameter)}}));
          continue;
        }
        if (parameter.required()) {
          Words without = words;
          std::erase_if(without, [&](const auto& word) { return word.first == static_cast<int>(parameter.address); });
          expectNamed(without);
        }
        if (parameter.choices.empty()) {
          expectNamed(with(words, {{parameter.address, parameter.minimum - 0.001}}));
          expectNamed(with(words, {{parameter.address, parameter.maximum + 0.001}}));
        } else {
          const auto& choices = parameter.choices;
          for (int value = -3; value <= 8; ++value) {
            if (std::ranges::find(choices, value, &cycles::Choice::value) != choices.end()) continue;
            expectNamed(with(words, {{parameter.address, value}}));
          }
        }
        if (parameter.kind == cycles::ValueKind::Integer) {
          expectNamed(with(words, {{parameter.address, parameter.minimum + 0.5}}));
        }
      }
    }
  }
  EXPECT_GT(refused, 1000U);
}

/// The pages print 0 as the default of the coordinate that the feature gets; those of 408 and 409 know no Q303 = -1.
TEST(EveryPage, GivesTheFeatureTheCoordinateZeroWhereNoneIsCalledFor) {
  for (int number = 408; number <= 419; ++number) {
    const cycles::CycleDefinition* cycle = cycles::heidenhainCycle(number);
    ASSERT_NE(cycle, nullptr) << number;
    int coordinates = 0;
    for (const std::uint32_t address : {331U, 332U, 333U, 405U}) {
      const cycles::Parameter* parameter = cycle->parameter(address);
      if (parameter == nullptr) continue;
      ++coordinates;
      EXPECT_EQ(parameter->standard, 0) << number << " Q" << address;
    }
    EXPECT_GT(coordinates, 0) << number;
    const std::optional<double> transfer = cycle->parameter(303)->standard;
    EXPECT_EQ(transfer, number > 409 ? std::optional<double>(-1) : std::nullopt) << number;
  }
}

/// Q305 and Q303 of the iTNC 530: row 0 sets the datum at once whatever Q303 says.
TEST(PresetTransfer, FollowsTheITNC530InEveryCombination) {
  Bench bench(older);
  bench.preset(1, {10, 20, -400});
  bench.part(simulation::Ring(15, 40, -30), pose({60, 60, -400}));
  const Words words = {{321, 50}, {322, 40}, {262, 30}, {325, 0}, {247, 90}, {261, -8},
                       {320, 0},  {260, 20}, {301, 0},  {331, 7}, {332, -2}, {381, 0}};
  const TableFolder folder(bench);
  control::heidenhain::TypedTable datums = control::heidenhain::defaultDatumTable(older);
  folder.put("ZERO.D", datums);
  for (const int transfer : {-1, 0, 1}) {
    for (const bool selected : {false, true}) {
      SCOPED_TRACE(fmt::format("Q303 = {}, table selected {}", transfer, selected));
      const std::string select = selected ? "SEL TABLE \"ZERO.D\"\n" : "";
      const Ran atOnce = bench.run(select + probe(412, with(words, {{305, 0}, {303, transfer}})));
      ASSERT_TRUE(atOnce.finished()) << atOnce.why();
      EXPECT_LT((atOnce.seen({60, 60, -400}) - Vector3(7, -2, 0)).norm(), 1e-6);
      const Ran row = bench.run(select + probe(412, with(words, {{305, 3}, {303, transfer}})));
      if (transfer == -1) {
        EXPECT_EQ(row.alarm(), "Measured value transfer not defined") << row.why();
      } else if (transfer == 0 && !selected) {
        EXPECT_EQ(row.alarm(), "Datum table not selected") << row.why();
      } else {
        ASSERT_TRUE(row.finished()) << row.why();
        // Nothing acts before cycle 7 or 247.
        EXPECT_TRUE(row.preset().isApprox(pose({10, 20, -400}), 1e-12));
        const std::string table = transfer == 0 ? "ZERO.D" : "PRESET.PR";
        const Vector2 expected = transfer == 0 ? Vector2(43, 42) : Vector2(53, 62);
        EXPECT_NEAR(row.cell(table, "3", "X"), expected.x(), 1e-4);
        EXPECT_NEAR(row.cell(table, "3", "Y"), expected.y(), 1e-4);
        const std::string after =
            transfer == 0 ? "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 #3\n" : "CYCL DEF 247 PRESET ~\n  Q339=3 ;NUMBER\n";
        const Ran active = bench.run(select + probe(412, with(words, {{305, 3}, {303, transfer}})) + after +
                                     probe(421, {{273, 7},
                                                 {274, -2},
                                                 {262, 30},
                                                 {325, 0},
                                                 {247, 90},
                                                 {261, -8},
                                                 {320, 0},
                                                 {260, 20},
                                                 {301, 0},
                                                 {275, 0},
                                                 {276, 0},
                                                 {279, 0},
                                                 {280, 0},
                                                 {281, 0},
                                                 {309, 0},
                                                 {330, 0}}));
        ASSERT_TRUE(active.finished()) << active.why();
        EXPECT_NEAR(active.q(151), 7, 1e-4);
        EXPECT_NEAR(active.q(152), -2, 1e-4);
      }
    }
  }
}

TEST(EveryPage, RefusesATransferToNowhereBeforeAnythingIsTouched) {
  for (const ControlKind kind : {newer, older}) {
    forEveryCycle(kind, [&](const CycleDefinition& cycle, std::string blocks) {
      if (cycle.family != cycles::CycleFamily::Preset) return;
      const auto set = [&](const std::string& from, const std::string& to) {
        const std::size_t at = blocks.find(from);
        ASSERT_NE(at, std::string::npos) << blocks;
        blocks.replace(at, from.size(), to);
      };
      set("Q305=+1.000000", "Q305=+5.000000");
      set("Q303=+1.000000", "Q303=-1.000000");
      const Ran undefined = emptyBench(kind).run(blocks);
      if (cycle.number == 408 || cycle.number == 409) {
        // Younger than the choice: their pages do not print -1.
        EXPECT_NE(undefined.why().find("Q303 (where the measured values go) cannot be -1"), std::string::npos)
            << undefined.why();
      } else {
        EXPECT_EQ(undefined.alarm(), "Measured value transfer not defined") << undefined.why();
        EXPECT_EQ(undefined.touches(), 0U);
      }
      set("Q303=-1.000000", "Q303=+0.000000");
      const Ran unselected = emptyBench(kind).run(blocks);
      EXPECT_EQ(unselected.alarm(), "Datum table not selected") << unselected.why();
      EXPECT_EQ(unselected.touches(), 0U);
      EXPECT_EQ(unselected.cycle().pathLength, 0);
    });
  }
}

}  // namespace
}  // namespace probewright::testing_support
