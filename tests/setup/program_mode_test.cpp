#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "setup/simulated_run.hpp"
#include "support/virtual_world.hpp"

/// Dry run, program test and block search of SINUMERIK programs, starts of HEIDENHAIN programs in their middle; inch
/// programs; the lathe as it begins.
namespace probewright::setup {
namespace {

using namespace session;

using testing_support::perfectWorld;
using testing_support::place;

/// A calibrated probe T1, and a block of 60 x 40 mm whose top lies at Z0 of G54, off by `shift` from where G54 has it.
setup::Setup blockSetup(const Vector3& shift = Vector3::Zero(), const std::string& machine = "mill3") {
  setup::Setup setup;
  setup.beliefs.control = control::ControlKind::Sinumerik840Dsl;
  setup.world.truth = perfectWorld(machine);
  Pose pose = Pose::Identity();
  pose.translation() = Vector3(0, 0, -400) + shift;
  place(setup.world.truth, simulation::Box({-30, -20, -40}, {30, 20, 0}), pose);
  control::BelievedTool probe;
  probe.number = 1;
  probe.name = "PROBE";
  probe.kind = "probe";
  probe.length = 100;
  probe.radius = probe.axialRadius = 2;
  setup.beliefs.tools.push_back(probe);
  control::BelievedFrame g54;
  g54.index = 1;
  g54.name = "G54";
  g54.origin = {0, 0, -400};
  g54.active = true;
  setup.beliefs.zeroOffsets.push_back(g54);
  return setup;
}

constexpr const char* measureEdge =
    "G90 G17 G54\n"
    "T=\"PROBE\" D1 M6\n"
    "G0 X-40 Y0 Z20\n"
    "Z-10\n"
    "CYCLE978(100,10001,,1,-30,8,5,1,1,1,\"\",,0)\n"
    "G0 Z50\n"
    "G1 X-60 F1000\n"
    "M30\n";

bool isSkipped(const RunOutcome& outcome, std::string_view why) {
  return std::ranges::any_of(outcome.journal.events, [&](const control::EventRecord& event) {
    return event.kind == control::EventKind::Skipped && event.text.find(why) != std::string::npos;
  });
}

double seconds(const RunOutcome& outcome) { return outcome.info.totalSeconds; }

TEST(ProgramMode, NormallyTheEdgeIsMeasured) {
  const RunOutcome outcome = runText("EDGE.MPF", measureEdge, blockSetup({0.5, 0, 0}), {}).outcome;
  EXPECT_EQ(outcome.info.exit, records::ExitState::Good) << outcome.info.exitText;
  ASSERT_EQ(outcome.journal.cycles.size(), 1u);
  ASSERT_FALSE(outcome.journal.cycles[0].writes.empty());
  EXPECT_NE(outcome.files.at("FRAMES.UFR").find("$P_UIFR[1,X,TR]=0.5"), std::string::npos);
}

TEST(ProgramMode, DryRunSkipsMeasuringAndTravelsAtTheDryRunFeed) {
  RunOptions options;
  const RunOutcome normal = runText("EDGE.MPF", "G90 G54\nG1 X100 F100\nM30\n", blockSetup(), options).outcome;
  options.mode = ProgramMode::DryRun;
  const RunOutcome fast = runText("EDGE.MPF", "G90 G54\nG1 X100 F100\nM30\n", blockSetup(), options).outcome;
  EXPECT_GT(seconds(normal), 10 * seconds(fast));
  const RunOutcome outcome = runText("EDGE.MPF", measureEdge, blockSetup({0.5, 0, 0}), options).outcome;
  EXPECT_EQ(outcome.info.exit, records::ExitState::Good) << outcome.info.exitText;
  EXPECT_TRUE(outcome.journal.cycles.empty());
  EXPECT_TRUE(isSkipped(outcome, "CYCLE978 is skipped in dry run"));
  EXPECT_EQ(outcome.files.at("FRAMES.UFR").find("0.5"), std::string::npos);
}

TEST(ProgramMode, InProgramTestTheAxesStand) {
  RunOptions options;
  options.mode = ProgramMode::ProgramTest;
  const std::string program = std::string("R1=$P_ISTEST\nMSG(\"test \"<<R1)\n") + measureEdge;
  const SimulatedRun run = runText("EDGE.MPF", program, blockSetup({0.5, 0, 0}), options);
  const RunOutcome& outcome = run.outcome;
  EXPECT_EQ(outcome.info.exit, records::ExitState::Good) << outcome.info.exitText;
  EXPECT_TRUE(isSkipped(outcome, "CYCLE978 is skipped in program test"));
  EXPECT_EQ(outcome.journal.events.front().text, "test 1");
  EXPECT_EQ(run.machine->position(), blockSetup().world.truth.start);
  EXPECT_EQ(seconds(outcome), 0);
  EXPECT_EQ(outcome.info.totalPathLength, 0);
  // A way through the part is not noticed, a travel that does not reach is.
  EXPECT_EQ(runText("A.MPF", "T1 D1 M6\nG54 G0 X0 Y0 Z-20\nM30\n", blockSetup(), options).outcome.info.exit,
            records::ExitState::Good);
  const RunOutcome far = runText("A.MPF", "G54 G0 X5000\nM30\n", blockSetup(), options).outcome;
  EXPECT_EQ(far.info.exit, records::ExitState::Stopped);
  EXPECT_EQ(far.result.diagnostics.front().code, "10720");
}

TEST(ProgramMode, ABlockSearchBringsTheMachineToWhereTheProgramStands) {
  RunOptions options;
  options.searchLine = 6;
  // The edge in line 5 is not measured; line 6 begins where line 4 ended, with the probe in the spindle.
  const std::string program =
      "G90 G17 G54\nT=\"PROBE\" D1 M6\nG0 X-40 Y0 Z20\nR1=5\n"
      "CYCLE978(100,10001,,1,-30,8,5,1,1,1,\"\",,0)\n"
      "R2=$AA_IW[X] R3=$AA_IW[Z] R4=$P_TOOLNO\nMSG(R1<<\" \"<<R2<<\" \"<<R3<<\" \"<<R4)\nG0 Z-10\n"
      "CYCLE978(0,,,1,-30,8,5,1,1,1,\"\",,0)\nM30\n";
  const RunOutcome outcome = runText("EDGE.MPF", program, blockSetup({0.5, 0, 0}), options).outcome;
  EXPECT_EQ(outcome.info.exit, records::ExitState::Good) << outcome.info.exitText;
  EXPECT_TRUE(isSkipped(outcome, "CYCLE978 is skipped in block search"));
  const bool told = std::ranges::any_of(outcome.journal.events,
                                        [](const control::EventRecord& event) { return event.text == "5 -40 20 1"; });
  EXPECT_TRUE(told);
  ASSERT_EQ(outcome.journal.cycles.size(), 1u);
  EXPECT_EQ(outcome.journal.cycles[0].place.line, 9u);
}

TEST(ProgramMode, ASearchTargetThatIsNotReachedIsAnAlarm) {
  RunOptions options;
  options.searchLine = 400;
  const RunOutcome outcome = runText("EDGE.MPF", measureEdge, blockSetup(), options).outcome;
  EXPECT_EQ(outcome.info.exit, records::ExitState::Stopped);
  ASSERT_FALSE(outcome.result.diagnostics.empty());
  EXPECT_EQ(outcome.result.diagnostics.front().code, "15370");
}

setup::Setup heidenhainSetup(const Vector3& shift) {
  setup::Setup setup = blockSetup(shift);
  setup.beliefs.control = control::ControlKind::TNC640;
  setup.beliefs.presets.swap(setup.beliefs.zeroOffsets);
  setup.beliefs.presets.front().name.clear();
  return setup;
}

/// Measures the left side (line 6) and the front side (line 12) of the block, with a subprogram between.
constexpr const char* measureSides =
    "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z\n2 L Z+50 R0 FMAX\n3 Q50 = 7\n4 STOP\n"
    "5 TCH PROBE 427 LEFT ~\nQ263=-30 ~\nQ264=+0 ~\nQ261=-10 ~\nQ320=+2 ~\nQ272=+1 ~\nQ267=+1 ~\nQ260=+20 ~\nQ281=+0 "
    "~\n"
    "Q288=-29 ~\nQ289=-31 ~\nQ309=+0 ~\nQ330=+0\n"
    "6 Q50 = Q50 + Q50\n7 L X-45 Y+15 R0 FMAX\n8 L Z+30 R0 FMAX\n9 CALL LBL 1\n"
    "10 TCH PROBE 427 FRONT ~\nQ263=+0 ~\nQ264=-20 ~\nQ261=-10 ~\nQ320=+2 ~\nQ272=+2 ~\nQ267=+1 ~\nQ260=+20 ~\nQ281=+0 "
    "~\n"
    "Q288=-19 ~\nQ289=-21 ~\nQ309=+0 ~\nQ330=+0\n11 STOP M2\n12 LBL 1\n13 Q51 = Q51 + 1\n14 LBL 0\n15 END PGM A MM\n";
constexpr std::size_t left = 6, front = 23;  // lines

TEST(ProgramMode, AHeidenhainProgramStartsInItsMiddle) {
  // At the block, within it, and in a subprogram that stands behind it.
  for (const std::uint64_t line : {front, front + 5}) {
    RunOptions options;
    options.searchLine = line;
    MachineOptions machine;
    machine.recordPath = true;
    const SimulatedRun run = runText("A.H", measureSides, heidenhainSetup({0, 0.25, 0}), options, machine);
    const RunOutcome& outcome = run.outcome;
    EXPECT_EQ(outcome.info.exit, records::ExitState::Good) << outcome.info.exitText;
    ASSERT_EQ(outcome.journal.cycles.size(), 1U);
    EXPECT_EQ(outcome.journal.cycles[0].place.line, front);
    EXPECT_NEAR(outcome.journal.cycles[0].results[0].value, -19.75, 1e-6);
    EXPECT_EQ(outcome.variable("Q50"), 14);
    EXPECT_EQ(outcome.variable("Q51"), 1);
    const auto told = [&](const char* text) {
      return std::ranges::count_if(outcome.journal.events, [&](const control::EventRecord& event) {
        return event.text.find(text) != std::string::npos;
      });
    };
    EXPECT_EQ(told("Touch probe cycles before the start block are skipped"), 1);
    EXPECT_EQ(told("Program stop"), 1) << "the one after the start only";
    // Above the block across, and then down to where the program stands.
    const auto& points = run.machine->path().points;
    // To the tip of the ball or to its centre.
    const auto down = std::ranges::find_if(
        points, [](const simulation::PathPoint& point) { return (point.tip - Vector3(-45, 15, -370)).norm() < 2.001; });
    ASSERT_NE(down, points.end());
    ASSERT_NE(down, points.begin());
    EXPECT_LT((std::prev(down)->tip - down->tip).head<2>().norm(), 1e-6);
    EXPECT_GT(std::prev(down)->tip.z(), down->tip.z() + 1);
  }
  // The subprogram is called before the front is measured.
  RunOptions options;
  options.searchLine = front + 15;
  const RunOutcome inside = runText("A.H", measureSides, heidenhainSetup({0, 0.25, 0}), options).outcome;
  EXPECT_EQ(inside.info.exit, records::ExitState::Good) << inside.info.exitText;
  ASSERT_EQ(inside.journal.cycles.size(), 1U);
  EXPECT_EQ(inside.variable("Q51"), 1);
  // From the first line on it is the whole program.
  options.searchLine = 1;
  const RunOutcome whole = runText("A.H", measureSides, heidenhainSetup({0, 0.25, 0}), options).outcome;
  ASSERT_EQ(whole.journal.cycles.size(), 2U) << whole.info.exitText;
  EXPECT_EQ(whole.journal.cycles[0].place.line, left);
}

/// Where a block of a contour begins depends on the blocks around it: with radius compensation, at roundings and
/// chamfers.
TEST(ProgramMode, AStartWithinAContourIsRefusedBeforeAnythingMoves) {
  const std::string program =
      "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z\n2 L Z+50 R0 FMAX\n3 L X-60 Y-60 R0 FMAX\n4 L X-50 Y-40 RL F1000\n5 L Y+40\n"
      "6 RND R5\n7 L X+50\n8 L Y-40 R0\n9 L X+60\n10 CHF 3\n11 L Y-60\n12 L X+0\n13 END PGM A MM\n";
  const auto started = [&](std::uint64_t line) {
    RunOptions options;
    options.searchLine = line;
    return runText("A.H", program, heidenhainSetup(Vector3::Zero()), options);
  };
  for (const std::uint64_t line : {6, 7, 8, 9, 11, 12}) {
    const SimulatedRun run = started(line);
    ASSERT_FALSE(run.outcome.result.diagnostics.empty()) << line;
    EXPECT_EQ(run.outcome.result.diagnostics.front().code, "Start block not permitted") << line;
    EXPECT_EQ(run.machine->position(), heidenhainSetup(Vector3::Zero()).world.truth.start);
  }
  const auto end = started(1).machine->position();
  for (const std::uint64_t line : {4, 5, 10, 13}) {
    const SimulatedRun run = started(line);
    EXPECT_EQ(run.outcome.info.exit, records::ExitState::Good) << line << run.outcome.info.exitText;
    EXPECT_EQ(run.machine->position(), end) << line;
  }
}

TEST(ProgramMode, AStartInTheMiddleMeetsTheProbeThatItPutsIn) {
  setup::Setup setup = heidenhainSetup(Vector3::Zero());
  for (simulation::TrueTool& tool : setup.world.truth.tools)
    tool.probe.serial = "4711-08";
  for (const std::uint64_t line : {1, 4}) {
    RunOptions options;
    options.searchLine = line;
    const RunOutcome outcome =
        runText("A.H", "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z\n2 L X+10 R0 FMAX\n3 L X+20 FMAX\n4 END PGM A MM\n", setup,
                options)
            .outcome;
    EXPECT_EQ(outcome.info.exit, records::ExitState::Good) << outcome.info.exitText;
    EXPECT_NE(outcome.files.at("TCHPROBE.TP").find("4711-08"), std::string::npos) << line;
  }
}

TEST(ProgramMode, AStartInTheMiddleEndsWhereTheSpindleCannotBeOriented) {
  setup::Setup setup = heidenhainSetup(Vector3::Zero());
  setup.world.truth.machine.spindleOrients = false;
  RunOptions options;
  options.searchLine = 6;
  const SimulatedRun run = runText("A.H",
                                   "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z\n2 CYCL DEF 13.0 ORIENTATION\n3 CYCL DEF 13.1 "
                                   "ANGLE 45\n4 M19\n5 L X+10 R0 FMAX\n"
                                   "6 L X+20\n7 END PGM A MM\n",
                                   setup, options);
  ASSERT_FALSE(run.outcome.result.diagnostics.empty());
  EXPECT_EQ(run.outcome.result.diagnostics.front().code, "Spindle orientation not possible");
  EXPECT_EQ(run.machine->position()[0], setup.world.truth.start[0]) << "it has not moved";
}

TEST(ProgramMode, AStartBlockThatIsNotReachedIsAnAlarm) {
  RunOptions options;
  options.searchLine = 400;
  const RunOutcome outcome = runText("A.H", measureSides, heidenhainSetup(Vector3::Zero()), options).outcome;
  EXPECT_EQ(outcome.info.exit, records::ExitState::Stopped);
  ASSERT_FALSE(outcome.result.diagnostics.empty());
  EXPECT_EQ(outcome.result.diagnostics.front().code, "Start block not found");
  EXPECT_EQ(outcome.info.totalPathLength, 0) << "nothing has moved";
  EXPECT_TRUE(outcome.journal.cycles.empty());
}

TEST(ProgramMode, HeidenhainControlsHaveOtherModes) {
  RunOptions options;
  options.mode = ProgramMode::ProgramTest;
  setup::Setup setup = blockSetup();
  setup.beliefs.control = control::ControlKind::TNC640;
  const RunOutcome outcome = runText("A.H", "0 BEGIN PGM A MM\n1 END PGM A MM\n", setup, options).outcome;
  EXPECT_EQ(outcome.info.exit, records::ExitState::InputMistake);
}

TEST(SinumerikMeasuringBlock, IsFollowedByTheWayBackThatTheProgramWrites) {
  const auto run = [](const std::string& behind) {
    return runText("EDGE.MPF",
                   "G90 G17 G54\nT=\"PROBE\" D1 M6\nG0 X-40 Y0 Z20\nZ-10\nMEAS=1 G1 X-20 F200\nSTOPRE\n"
                   "IF $AC_MEA[1]==0\nSETAL(65000,\"no touch\")\nENDIF\nR1=$AA_MW[X]\n" +
                       behind + "M30\n",
                   blockSetup({0.5, 0, 0}), {})
        .outcome;
  };
  for (const char* back :
       {"G0 X-40\nZ20\n", "G1 X=IC(-5) F2000\nG0 Z20\n", "SUPA G0 X-60\n", "POS[X]=-60\n", "G2 X-40 Y0 CR=40 F500\n"}) {
    const RunOutcome outcome = run(back);
    EXPECT_EQ(outcome.info.exit, records::ExitState::Good) << back << outcome.info.exitText;
    // The ball's centre stands its radius in front of the wall; the probe tells where the tip of the tool is.
    EXPECT_NE(outcome.files.at("DATA.INI").find("R1=-31.5\n"), std::string::npos) << outcome.files.at("DATA.INI");
  }
  EXPECT_EQ(run("G0 X30\n").info.exit, records::ExitState::Stopped) << "into the part";
}

TEST(SinumerikUnits, InchProgramsMeasureWhatMetricOnesMeasure) {
  struct Units {
    const char* code;
    double scale;
    double feedScale;
  };
  const Units all[] = {{"G71", 1, 1}, {"G710", 1, 1}, {"G70", 25.4, 1}, {"G700", 25.4, 25.4}};
  for (const Units& units : all) {
    const auto l = [&](double millimetres) { return fmt::format("{:.12f}", millimetres / units.scale); };
    const std::string program = fmt::format(
        "{} G90 G17 G54\nT=\"PROBE\" D1 M6\nG0 X{} Y0 Z{}\nG1 Z{} F{}\n"
        "CYCLE978(100,10001,,1,{},{},{},1,1,1,\"\",,0)\nR1=_OVR[4] R2=_OVR[16] R4=$P_UIFR[1,X,TR]\nM30\n",
        units.code, l(-40), l(20), l(-10), 1000 / units.feedScale, l(-30), l(8), l(5));
    const RunOutcome outcome = runText("INCH.MPF", program, blockSetup({0.5, 0, 0}), {}).outcome;
    EXPECT_EQ(outcome.info.exit, records::ExitState::Good) << units.code << " " << outcome.info.exitText;
    ASSERT_EQ(outcome.journal.cycles.size(), 1u);
    EXPECT_NE(outcome.files.at("FRAMES.UFR").find("$P_UIFR[1,X,TR]=0.5"), std::string::npos)
        << outcome.files.at("FRAMES.UFR");
    const std::string& parameters = outcome.files.at("DATA.INI");
    const auto r = [&](const std::string& name) {
      const std::size_t at = parameters.find("\n" + name + "=");
      return at == std::string::npos ? -1e9 : std::stod(parameters.substr(at + name.size() + 2)) * units.scale;
    };
    EXPECT_NEAR(r("R1"), -29.5, 1e-6) << units.code;
    EXPECT_NEAR(r("R2"), 0.5, 1e-6) << units.code;
    EXPECT_NEAR(r("R4") / units.scale * units.feedScale, 0.5, 1e-6) << units.code << ": G70 reads system data in mm";
  }
}

TEST(Lathe, BeginsWithG18AndDiameters) {
  setup::Setup setup;
  setup.beliefs.control = control::ControlKind::Sinumerik840Dsl;
  setup.world.truth = perfectWorld("lathe2c");
  setup.beliefs.technology = control::Technology::Turning;
  const char* program = "G0 X100 Z300\nR1=$AA_IM[X] R2=$P_GG[6] R3=$P_GG[29]\nM30\n";
  const std::string radii = runText("A.MPF", program, setup, {}).outcome.files.at("DATA.INI");
  EXPECT_NE(radii.find("R1=50\n"), std::string::npos) << radii;
  EXPECT_NE(radii.find("R2=2\n"), std::string::npos);
  EXPECT_NE(radii.find("R3=2\n"), std::string::npos);
  setup.beliefs.parameters["$MC_GCODE_RESET_VALUES[28]"] = {1.0, {}};
  EXPECT_NE(runText("A.MPF", program, setup, {}).outcome.files.at("DATA.INI").find("R1=100\n"), std::string::npos);
}

}  // namespace
}  // namespace probewright::setup
