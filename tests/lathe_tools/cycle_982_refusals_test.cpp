#include "language/sinumerik/check.hpp"
#include "lathe_tools/tool_bench.hpp"
#include "setup/simulated_run.hpp"
#include "support/computed_call.hpp"

/// CYCLE982 refuses what it cannot measure, before anything moves or is
/// written.
namespace probewright {
namespace {

using namespace testing_support;

struct Wrong {
  const char* what;
  const char* alarm;
  std::string call;
  int tool = 5;  ///< 5 a turning tool with cutting edge position 3, 6 an axial
                 ///< mill, 7 a drill, 8 a turning tool with 8
  std::string before = {};
  std::function<void(LatheBench&)> data = {};
};

setup::Setup worldWithTools() {
  setup::Setup setup = toolSetup();
  add(setup, turningTool(5, 3, {80, 40}, 0.8), "turn");
  add(setup, rotatedTool(6, false, {60, 90}, 8), "mill");
  add(setup, rotatedTool(7, false, {60, 90}, 5), "drill");
  add(setup, turningTool(8, 8, {80, 40}, 0.8), "turn");
  return setup;
}
LatheBench benchWithTools() { return LatheBench(worldWithTools()); }

TEST(Cycle982Refuses, WhatItCannotMeasure) {
  const auto datum = [](const char* name, std::vector<control::sinumerik::DataIndex> indices, double value) {
    return [=](LatheBench& bench) {
      bench.control.data.set(control::sinumerik::DataKey(name, std::span(indices)), value);
    };
  };
  const Wrong wrongs[] = {
      {"radius compensation", "61300", "CYCLE982(2,0,1,,,,5,1)", 5, "G41\n"},
      {"a safe area that is too small", "61303", "CYCLE982(2,0,1,,,,5,0.1)", 5, {}, datum("$TC_DP3", {5, 1}, 80.2)},
      {"task 3", "61307", "CYCLE982(R1,0,1,1,,,5,1)", 5, "R1=3\n"},
      {"reversal of a turning tool", "61307", "CYCLE982(101,0,1,1,,,5,1)"},
      {"the radius of a turning tool", "61307", "CYCLE982(1001,0,1,1,,,5,1)"},
      {"a start angle for a turning tool", "61307", "CYCLE982(1000001,0,1,1,,,5,1)"},
      {"a radial turning tool", "61307", "CYCLE982(10001,0,1,1,,,5,1)"},
      {"a complete drill", "61307", "CYCLE982(2,0,1,,,,5,1)", 7},
      {"the radius of a drill", "61307", "CYCLE982(1001,0,1,2,,,5,1)", 7},
      {"the radius alone, completely", "61307", "CYCLE982(1002,0,1,,,,5,1)", 6},
      {"the rear side along an axis", "61307", "CYCLE982(3001,0,1,1,,,5,1)", 6},
      {"a complete incremental measurement", "61307", "CYCLE982(100002,0,1,,,,5,1)"},
      {"an incremental radius", "61307", "CYCLE982(101001,0,1,2,2,,5,1)", 6},
      {"reversal when calibrating", "61307", "CYCLE982(100,,1,1,,,5,1)"},
      {"no measuring path", "61308", "CYCLE982(2,0,1,,,,0,1)"},
      {"a scale factor", "61310", "CYCLE982(2,0,1,,,,5,1)", 5, "SCALE Z2\n"},
      {"no offset", "61311", "CYCLE982(2,0,1,,,,5,1)", 5, "D0\n"},
      {"data field 7", "61313", "CYCLE982(2,0,7,,,,5,1)"},
      {"a grinding tool", "61314", "CYCLE982(2,0,1,,,,5,1)", 5, {}, datum("$TC_DP1", {5, 1}, 400)},
      {"calibrating with a mill", "61314", "CYCLE982(0,,1,1,,,5,1)", 6},
      {"a mill with its lengths as on mills",
       "61314",
       "CYCLE982(2,0,1,,,,5,1)",
       6,
       {},
       datum("$SC_TOOL_LENGTH_TYPE", {}, 0)},
      {"cutting edge position 9", "61315", "CYCLE982(2,0,1,,,,5,1)", 5, {}, datum("$TC_DP2", {5, 1}, 9)},
      {"calibrating with position 8", "61315", "CYCLE982(0,,1,2,,,5,1)", 8},
      {"empirical value 21", "61319", "CYCLE982(2,0,1,,,,5,1,,,,,,1,21)"},
      {"ten measurements", "61319", "CYCLE982(2,0,1,,,,5,1,,,,,,10)"},
      {"plane 4", "61319", "CYCLE982(2,0,1,,,,5,1,,,,,,,,,R1)", 5, "R1=4\n"},
      {"no measuring axis", "61325", "CYCLE982(1,0,1,,,,5,1)"},
      {"axis 3", "61325", "CYCLE982(1,0,1,3,,,5,1)"},
      {"the radius along the tool", "61325", "CYCLE982(1001,0,1,1,,,5,1)", 6},
      {"direction 3", "61326", "CYCLE982(1,0,1,1,3,,5,1)"},
      {"the tip points the other way", "61326", "CYCLE982(1,0,1,1,1,,5,1)", 6},
      {"a turned workpiece system", "61330", "CYCLE982(12,0,1,,,,5,1)", 5, "ROT RPL=3\n"},
      {"against where the tip points", "61332", "CYCLE982(1,0,1,1,1,,5,1)"},
      {"an axis along which the tip does not point", "61332", "CYCLE982(1,0,1,1,,,5,1)", 8},
      {"no positioning feed", "61338", "CYCLE982(2,0,1,,,,5,1)", 5, {}, datum("$SCS_MEA_FEED_PLANE_VALUE", {}, 0)},
      {"an empty data field", "61341", "CYCLE982(2,0,3,,,,5,1)"},
      {"no radius for the side", "61351", "CYCLE982(1,0,1,2,,,5,1)", 7, {}, datum("$TC_DP6", {7, 1}, 0)},
      {"a spindle that does not turn the tool", "61372", "CYCLE982(1000002,0,1,,,,5,1)", 6},
  };
  for (const Wrong& wrong : wrongs) {
    SCOPED_TRACE(wrong.what);
    LatheBench bench = benchWithTools();
    if (wrong.data) wrong.data(bench);
    const Vector2 start = wrong.tool == 8 ? Vector2(404, 190) : Vector2(445, 190);
    EXPECT_EQ(bench.alarmOf(measuring(wrong.tool, start, wrong.before + wrong.call)), wrong.alarm);
    EXPECT_TRUE(bench.control.journal.cycles.back().writes.empty());
    EXPECT_EQ(bench.ovi(9), std::stoi(wrong.alarm));
    if (std::string_view(wrong.alarm) != "61303") {
      EXPECT_TRUE(bench.control.journal.cycles.back().touches.empty());
    }
    if (wrong.data) continue;
    // Through the front door, with numbers that only the run knows.
    const setup::SimulatedRun run = setup::runText(
        "WRONG.MPF",
        "G18 G90 G71 G500\n" + measuring(wrong.tool, start, wrong.before + computedCall(wrong.call)) + "\nM30\n",
        worldWithTools(), {}, {.recordPath = false});
    ASSERT_TRUE(run.outcome.diagnostics.empty()) << format(run.outcome.diagnostics.front());
    ASSERT_FALSE(run.outcome.result.diagnostics.empty());
    EXPECT_EQ(run.outcome.result.diagnostics.front().code, wrong.alarm);
  }
}

/// An alarm that several things can raise says which of them it was.
TEST(Cycle982Refuses, WithTheReason) {
  struct Reason {
    std::string call;
    int tool;
    std::vector<std::pair<const char*, double>> data;
    std::string before, words;
  };
  const std::vector<Reason> reasons = {
      {"CYCLE982(2,0,1,,,,5,1)", 6, {{"$SC_TOOL_LENGTH_TYPE", 0}}, "", "mills are measured with SD 42950"},
      {"CYCLE982(1,0,1,1,,,5,1)", 6, {{"$SC_TOOL_LENGTH_TYPE", 0}}, "", "mills are measured with SD 42950"},
      {"CYCLE982(1,0,1,1,,,5,1)", 7, {{"$SC_TOOL_LENGTH_TYPE", 0}}, "", "= 0 a drill is measured in G17 or G19"},
      {"CYCLE982(2,0,1,,,,5,1)",
       5,
       {{"$TC_DP1", 400}},
       "",
       "$TC_DP1 = 400: turning tools (5xy), mills (1xy) and drills"},
      {"CYCLE982(2,0,1,,,,5,1)", 5, {{"$TC_DP1", 99}}, "", "$TC_DP1 = 99: turning tools"},
      {"CYCLE982(2,0,1,,,,5,1)", 5, {{"$TC_DP1", 300}}, "", "$TC_DP1 = 300: turning tools"},
      {"CYCLE982(2,0,1,,,,5,1)", 5, {{"$TC_DP2", 9}}, "", "$TC_DP2 = 9, turning tools are measured with 1 to 8"},
      {"CYCLE982(2,0,1,,,,5,1)", 5, {{"$TC_DP2", 0}}, "", "$TC_DP2 = 0, turning tools are measured with 1 to 8"},
      {"CYCLE982(0,,1,2,,,5,1)", 8, {}, "", "$TC_DP2 = 8, the probe is calibrated with 1 to 4"},
      {"CYCLE982(0,,1,1,,,5,1)", 6, {}, "", "the probe is calibrated with a tool of type 580 or 5xy"},
      {"CYCLE982(R1,0,1,1,,,5,1)", 5, {}, "R1=3\n", "S_MVAR (measuring variant) cannot be 3"},
      {"CYCLE982(1,0,1,1,1,,5,1)", 5, {}, "", "position 3 does not touch in the plus direction of axis 1"},
      {"CYCLE982(1,0,1,2,1,,5,1)", 5, {}, "", "position 3 does not touch in the plus direction of axis 2"},
      {"CYCLE982(1,0,1,1,1,,5,1)", 6, {}, "", "the tip of the tool does not point that way"},
      {"CYCLE982(1001,0,1,1,,,5,1)", 6, {}, "", "the radius is measured along the other axis of the plane"},
  };
  for (const Reason& reason : reasons) {
    SCOPED_TRACE(fmt::format("tool {} {}", reason.tool, reason.call));
    LatheBench bench = benchWithTools();
    for (const auto& [name, value] : reason.data) {
      if (std::string_view(name).starts_with("$TC_"))
        bench.set(name, {reason.tool, 1}, value);
      else
        bench.set(name, {}, value);
    }
    const Vector2 start = reason.tool == 8 ? Vector2(404, 190) : Vector2(445, 190);
    const execution::RunResult result = bench.tryRun(measuring(reason.tool, start, reason.before + reason.call));
    ASSERT_FALSE(result.diagnostics.empty());
    EXPECT_NE(result.diagnostics.front().message.find(reason.words), std::string::npos)
        << format(result.diagnostics.front());
  }
}

/// What fits to no tool is known before the run; what does nothing is named.
TEST(Cycle982Refuses, CallsThatCannotBeMeantBeforeTheRun) {
  const auto said = [](const std::string& call, Severity severity) {
    const auto program = language::sinumerik::SinumerikProgram::fromText("C.MPF", call + "\nM30\n");
    const Diagnostics found = language::sinumerik::check(*program);
    if (found.empty()) return std::string();
    EXPECT_EQ(found.front().severity, severity) << call;
    return found.front().message;
  };
  const auto refuses = [&](const std::string& call, const char* what) {
    EXPECT_NE(said(call, Severity::Error).find(what), std::string::npos) << call;
  };
  refuses("CYCLE982(100,,1,1,,,5,1)", "belong to a calibration");
  refuses("CYCLE982(10000,,1,1,,,5,1)", "belong to a calibration");
  refuses("CYCLE982(1002,0,1,,,,5,1)", "along one axis");
  refuses("CYCLE982(3001,0,1,1,,,5,1)", "complete measurement");
  refuses("CYCLE982(100002,0,1,,,,5,1)", "one face");
  refuses("CYCLE982(102001,0,1,2,2,,5,1)", "one face");
  const auto warns = [&](const std::string& call, const char* what) {
    EXPECT_NE(said(call, Severity::Warning).find(what), std::string::npos) << call;
  };
  warns("CYCLE982(0,1,1,1,,,5,1)", "S_KNUM does nothing");
  warns("CYCLE982(2,0,1,1,,,5,1)", "S_MA does nothing");
  warns("CYCLE982(1001,0,1,2,,,5,1,,90)", "S_STA1 acts");
  warns("CYCLE982(1000001,0,1,2,,,5,1,,90,5)", "S_CORA is");
  for (const char* right : {"CYCLE982(0,,1,1,,,5,1)", "CYCLE982(2,0,1,,,,5,1)", "CYCLE982(3002,0,1,,,,5,1)",
                            "CYCLE982(101,0,1,2,2,,5,1,,160,-10)", "CYCLE982(100001,0,1,2,2,,6,1)"})
    EXPECT_EQ(said(right, Severity::Note), "") << right;
}

TEST(Cycle982Refuses, ADirectionThatNobodyTells) {
  LatheBench bench = benchWithTools();
  // The tip is where the middle of the contact is believed, along X.
  for (const double direction : {-1.0, 1.0})
    bench.set(triggerName(2, direction), {0}, 190 - 10 * direction);
  EXPECT_EQ(bench.alarmOf(measuring(8, {404, 190}, "CYCLE982(1,0,1,2,,,5,1)")), "61326");
}

TEST(Cycle982Refuses, AWayThroughTheContact) {
  LatheBench bench = benchWithTools();
  // The tool touches from above, and stands below where the control believes the contact.
  bench.set(triggerName(2, -1), {0}, 230);
  bench.set(triggerName(2, 1), {0}, 210);
  EXPECT_EQ(bench.alarmOf(measuring(8, {404, 190}, "CYCLE982(1,0,1,2,2,,5,1)")), "61332");
}

TEST(Cycle982Refuses, WhenNothingIsTouched) {
  setup::Setup setup = toolSetup();
  add(setup, turningTool(5, 3, {80, 40}, 0.8), "turn");
  LatheBench bench(setup);
  bench.set(triggerName(1, -1), {0}, 425);
  EXPECT_EQ(bench.alarmOf(measuring(5, startOf(3), "CYCLE982(1,0,1,1,,,5,20)")), "61301");
  EXPECT_EQ(bench.control.journal.cycles.back().touches.size(), 5u) << "attempts";
  bench.set("$SCS_MEA_FUNCTION_MASK", {}, (1 << 17) + (1 << 16) + 1);
  EXPECT_EQ(bench.alarmOf(measuring(5, startOf(3), "CYCLE982(1,0,1,1,,,5,20)")), "61301");
  EXPECT_EQ(bench.control.journal.cycles.back().touches.size(), 1u) << "one attempt";
}

TEST(Cycle982Refuses, WithoutAToolTouchProbe) {
  setup::Setup setup = latheSetup({});
  add(setup, turningTool(5, 3, {80, 40}, 0.8), "turn");
  LatheBench bench(setup);
  for (int axis = 1; axis <= 2; ++axis)
    for (const double direction : {-1.0, 1.0})
      bench.set(triggerName(axis, direction), {0}, (axis == 1 ? 400 : 150) - 10 * direction);
  EXPECT_EQ(bench.alarmOf(measuring(5, startOf(3), "CYCLE982(2,0,1,,,,5,1)")), "61309");
}

TEST(Cycle982Refuses, ACollisionOnTheWay) {
  LatheBench bench = benchWithTools();
  // The control believes the probe 30 mm nearer to the chuck.
  for (const double direction : {-1.0, 1.0})
    bench.set(triggerName(1, direction), {0}, 370 - 10 * direction);
  EXPECT_EQ(bench.alarmOf(measuring(5, {445, 155}, "CYCLE982(2,0,1,,,,5,40)")), "61302");
}

}  // namespace
}  // namespace probewright
