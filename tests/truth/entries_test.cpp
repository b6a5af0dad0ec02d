#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "control/heidenhain/preset_table.hpp"
#include "control/heidenhain/turning_tool_table.hpp"
#include "reports/summary.hpp"
#include "truth/told.hpp"

/// What was written into tables, against what was planted.
namespace probewright::truth::testing {
namespace {

using ::testing::HasSubstr;

constexpr double cell = 1e-4;  // mm: what a table can show

TEST(Entries, OfAPresetAreAsWrongAsTheFeatureThatWasMeasured) {
  World world;
  world.origin = {0, 0, -480};
  // A probe whose ball is believed to stand beside the spindle axis: every hole is measured there.
  world.probe = "believed_tip_offset = [0.02, -0.01]\n";
  world.part = plate("{ x = 0.6, y = -0.4, z = -480 }");
  const Told told = run(world,
                        "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 412 PRESET ~\nQ321=+0 ~\nQ322=+0 ~\nQ262=+30 ~\n"
                        "Q325=+0 ~\nQ247=+90 ~\nQ261=-5 ~\nQ320=+2 ~\nQ260=+20 ~\nQ301=+0 ~\nQ305=+1 ~\nQ331=+10 ~\n"
                        "Q332=+20 ~\nQ303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\nQ383=+0 ~\nQ384=+0 ~\nQ333=+0\n");
  ASSERT_TRUE(told.finished()) << told.why();
  const records::EntryTruth& preset = entry(told, "preset 1");
  EXPECT_EQ(preset.kind, records::EntryKind::Preset);
  // The hole gets X10 Y20: its preset is that much before it.
  EXPECT_NEAR(value(preset, "X").truth, 0.6 - 10, cell);
  EXPECT_NEAR(value(preset, "Y").truth, -0.4 - 20, cell);
  EXPECT_NEAR(value(preset, "X").value, 0.6 - 10 + 0.02, cell);
  ASSERT_TRUE(preset.distance);
  EXPECT_NEAR(*preset.distance, std::hypot(0.02, 0.01), 2 * cell);
  EXPECT_FALSE(preset.angle);
  EXPECT_EQ(preset.values.size(), 2U) << "Z was not measured";
  EXPECT_THAT(reports::summaryText(told.outcome.journal, told.outcome.info),
              HasSubstr("  preset 1: 0.022 mm from the truth (X "));
}

/// The program counts from a preset that is turned already, or from one that is not.
TEST(Entries, OfARotationTellItsAngle) {
  for (const double before : {0.0, -5.0}) {
    World world;
    world.origin = {0, 0, -480};
    world.rotation = before;
    world.part = plate(fmt::format("{{ z = -480, c = {} }}", before + 0.8));
    // The machine's X and Y are not square: what lies along X is right, what lies along Y is not.
    world.more = "[[errors.squareness]]\naxis = \"X\"\ntowards = \"Y\"\ndegrees = 0.01\n";
    const Told told =
        run(world,
            "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 400 ROTATION ~\nQ263=-30 ~\nQ264=-30 ~\nQ265=+30 ~\n"
            "Q266=-30 ~\nQ272=+2 ~\nQ267=+1 ~\nQ261=-8 ~\nQ320=+2 ~\nQ260=+20 ~\nQ301=+1 ~\nQ307=+0 ~\n"
            "Q305=+1\n");
    ASSERT_TRUE(told.finished()) << told.why();
    const records::EntryTruth& preset = entry(told, "preset 1");
    EXPECT_NEAR(value(preset, "SPC").truth, before + 0.8, cell);
    ASSERT_TRUE(preset.angle);
    EXPECT_NEAR(*preset.angle, 0.01, 2 * cell);
    EXPECT_FALSE(preset.distance);
  }
}

TEST(Entries, OfAZeroOffsetAreComparedOnASinumerik) {
  World world;
  world.control = "840Dsl";
  world.origin = {0, 0, -480};
  world.believedRadius = 3.005;
  world.part = plate("{ z = -479.7 }");
  const Told told =
      run(world, "T1 D1\nM6\nG54 G17 G0 X10 Y20 Z6\nCYCLE978(100,10001,,1,0,6,3,3,2,1,\"\",,0,,0,0,,,,,1,)\n");
  ASSERT_TRUE(told.finished()) << told.why();
  const records::EntryTruth& offset = entry(told, "G54");
  EXPECT_EQ(offset.kind, records::EntryKind::ZeroOffset);
  EXPECT_NEAR(value(offset, "Z").truth, -479.7, 1e-5);
}

TEST(Entries, OfAnAxisOfRotationAreItsDistanceFromTheTrueOne) {
  World world;
  Diagnostics diagnostics;
  const std::string examples = PROBEWRIGHT_EXAMPLES;
  const auto setup = setup::readSetup(examples + "/setups/kinematics-tnc640.toml", diagnostics);
  ASSERT_TRUE(setup);
  auto simulated = setup::runProgram(examples + "/programs/kinematics.h", *setup, session::RunOptions());
  const Told told{std::move(simulated.outcome)};
  ASSERT_TRUE(told.finished()) << told.why();
  for (const char* name : {"axis A", "axis C"}) {
    const records::EntryTruth& axis = entry(told, name);
    EXPECT_EQ(axis.kind, records::EntryKind::Kinematics);
    ASSERT_TRUE(axis.distance && axis.angle);
    // Planted by hundredths of a millimetre, found to about a micrometre.
    EXPECT_LT(*axis.distance, 0.003) << name;
    EXPECT_GT(*axis.distance, 0) << name;
  }
}

TEST(Entries, OfTheFirstDataSetOfAProbeAreCompared) {
  World world;
  world.control = "840Dsl";
  world.origin = {0, 0, -480};
  world.believedRadius = 3.005;
  world.part = plate("{ z = -480 }");
  // The ring is said to be 30 mm wide and is 30.01: the ball comes out too small by the difference.
  const Told told =
      run(world, "T1 D1\nM6\nG54 G17 G0 X0 Y0 Z20\nG1 Z-5 F1000\nCYCLE976(1,1,30,,1,0,4,2,0,0,1,0,1,0)\nG0 Z50\n");
  ASSERT_TRUE(told.finished()) << told.why();
  const records::EntryTruth& data = entry(told, "probe data 1");
  EXPECT_EQ(data.kind, records::EntryKind::Probe);
  EXPECT_NEAR(value(data, "BALL_DIAM").value, 5.99, cell);
  EXPECT_NEAR(value(data, "BALL_DIAM").truth, 6, cell);
}

TEST(Entries, OfAToolCountItsWear) {
  Diagnostics diagnostics;
  const std::string examples = PROBEWRIGHT_EXAMPLES;
  for (const char* control : {"tnc640", "840dsl"}) {
    const auto setup = setup::readSetup(examples + "/setups/tool-" + control + ".toml", diagnostics);
    ASSERT_TRUE(setup);
    const bool heidenhain = std::string(control) == "tnc640";
    auto simulated = setup::runProgram(examples + (heidenhain ? "/programs/tool.h" : "/programs/tool.mpf"), *setup,
                                       session::RunOptions());
    const Told told{std::move(simulated.outcome)};
    ASSERT_TRUE(told.finished()) << told.why();
    const records::EntryTruth& tool = entry(told, "tool 12");
    // The setup plants 92.417 and 7.994; the longest tooth stands out by 0.002, the widest by 0.006.
    EXPECT_NEAR(value(tool, heidenhain ? "L" : "length 1").truth, 92.419, 1e-9);
    EXPECT_NEAR(value(tool, heidenhain ? "R" : "radius").truth, 8.000, 1e-9);
    EXPECT_LT(*tool.distance, 0.01) << control;
  }
}

/// A lathe whose control learns the lengths of a worn insert.
TEST(Entries, OfATurningToolCountTheWearOfItsInsert) {
  const std::string examples = PROBEWRIGHT_EXAMPLES;
  std::ifstream file(examples + "/setups/tools-lathe.toml");
  std::string text(std::istreambuf_iterator<char>(file), {});
  const std::string key = "nose_radius = 0.4\n";
  text.insert(text.find(key) + key.size(), "wear = 0.03\n");
  Diagnostics diagnostics;
  const auto setup = setup::parseSetup(text, "lathe.toml", diagnostics);
  ASSERT_TRUE(setup);
  const Told told{setup::runProgram(examples + "/programs/tools-lathe.mpf", *setup, session::RunOptions()).outcome};
  ASSERT_TRUE(told.finished()) << told.why();
  // The nose points to -X and -Z: both lengths, 20 + 60.043 and 39.985, are shorter by what it has lost.
  const records::EntryTruth& tool = entry(told, "tool 3");
  EXPECT_NEAR(value(tool, "length 1").truth, 80.043 - 0.03, 1e-9);
  EXPECT_NEAR(value(tool, "length 2").truth, 39.985 - 0.03, 1e-9);
  EXPECT_LT(*tool.distance, 0.002);
}

/// Cycle 485 in a mill that turns: ZL and XL of TOOLTURN.TRN.
void findTheLengthsOfATurningTool(control::heidenhain::TableUnit unit) {
  const TableFolder folder;
  folder.put("TOOLTURN.TRN", [&] {
    auto table = control::heidenhain::defaultTurningToolTable(unit);
    EXPECT_TRUE(table.ensureRow("12"));
    EXPECT_TRUE(table.setNumber("12", "ZL", 90.2) && table.setNumber("12", "XL", 9.7) &&
                table.setNumber("12", "TO", 1));
    return std::string(table.table().bytes());
  }());
  const std::string text = R"(seed = 1
[control]
type = "TNC640"
tables = "."
[tool_probe]
size = [20, 20]
thickness = 12
pose = { x = 100, y = -50, z = -470 }
pretravel = 0.01
[[preset]]
row = 1
origin = [0, 0, -420]
active = true
[[tool]]
number = 12
name = "FINISH"
kind = "turn"
length = 90
radius = 2
[tool.cutter]
shank_radius = 2
eccentricity = [10, 0]
[tool.cutter.insert]
nose_radius = 0.8
edge_normals = [-185, -85]
wear = 0.02
)";
  folder.put("mill.toml", text);
  Diagnostics diagnostics;
  const auto setup = setup::readSetup((folder.path() / "mill.toml").string(), diagnostics);
  ASSERT_TRUE(setup) << format(diagnostics.front());
  const Told told{setup::runText("T.H",
                                 "BEGIN PGM T MM\nTOOL CALL 12 Z\nTCH PROBE 485 MEASURE TURNING TOOL ~\nQ340=+0 ~\n"
                                 "Q260=+60\nEND PGM T MM\n",
                                 *setup, session::RunOptions())
                      .outcome};
  ASSERT_TRUE(told.finished()) << told.why();
  const records::EntryTruth& tool = entry(told, "tool 12");
  EXPECT_EQ(tool.kind, records::EntryKind::Tool);
  // The nose points to -X and down: its tangents have moved towards +X and up.
  EXPECT_NEAR(value(tool, "ZL").truth, 90 - 0.02, 1e-9);
  EXPECT_NEAR(value(tool, "XL").truth, 10 + 0.02, 1e-9);
  // What it found: the pretravel of the contact is not calibrated away where only its size is known.
  EXPECT_NEAR(value(tool, "ZL").value, 90 - 0.02, 0.0101);
  EXPECT_NEAR(*tool.distance,
              std::max(std::abs(value(tool, "ZL").value - 89.98), std::abs(value(tool, "XL").value - 10.02)), 1e-9);
}

TEST(Entries, OfTheTableOfTurningToolsAreItsLengths) {
  findTheLengthsOfATurningTool(control::heidenhain::TableUnit::Millimetre);
}

TEST(Entries, OfATableOfTurningToolsInInchesAreItsLengthsInMillimetres) {
  findTheLengthsOfATurningTool(control::heidenhain::TableUnit::Inch);
}

/// A probe that signals late in three directions, calibrated on a sphere in all directions.
TEST(Entries, OfADirectionalCalibrationAreItsDirections) {
  World world;
  world.origin = {0, 0, -480};
  world.probe = "pretravel = 0.012\nlobing = 0.006\nlobing_phase = 25\naxial_pretravel = 0.004\n";
  world.part =
      "[part]\nname = \"none\"\n[[part.feature]]\nshape = \"box\"\ncentre = [200, 0, -500]\nsize = [20, 20, 20]\n";
  world.more = "[sphere]\ndiameter = 25\npose = { z = -480 }\nstem_diameter = 8\n";
  const auto calibrate = [&](double repeatability) {
    World planted = world;
    planted.probe += fmt::format("repeatability = {}\n", repeatability);
    return run(planted,
               "TOOL CALL 1 Z\nL Z+80 R0 FMAX\nL X+0 Y+0 R0 FMAX\nL Z+17 R0 FMAX\nTCH PROBE 460 CALIBRATE "
               "~\nQ407=+12.5 ~\nQ320=+1 ~\n"
               "Q301=+1 ~\nQ423=+7 ~\nQ380=+0 ~\nQ433=+1 ~\nQ434=+0 ~\nQ455=+9\n");
  };
  const Told exact = calibrate(0);
  ASSERT_TRUE(exact.finished()) << exact.why();
  const records::EntryTruth& table = entry(exact, "T1.3DTC");
  EXPECT_EQ(table.kind, records::EntryKind::Probe);
  EXPECT_EQ(table.values.size(), 1U + 9 * 7);
  EXPECT_LT(*table.distance, 2e-5) << "a touch beside the nominal point, and the last decimals of the tables";
  // Far from nothing: the probe needs up to (0.006 + what lies between pretravel and mean) in some direction.
  const auto least = std::ranges::minmax(table.values, {}, &records::EntryValue::truth);
  EXPECT_GT(least.max.truth - least.min.truth, 0.011);

  const Told rough = calibrate(0.002);
  ASSERT_TRUE(rough.finished()) << rough.why();
  EXPECT_GT(*entry(rough, "T1.3DTC").distance, 0.002);
  EXPECT_THAT(reports::summaryText(rough.outcome.journal, rough.outcome.info), HasSubstr("T1.3DTC: "));
}

/// A setup with a mill of 16 and a round contact.
std::string millOn(const std::string& tables, const std::string& cutter, const std::string& type = "TNC640") {
  return fmt::format(R"(seed = 3
[control]
type = "{}"
{}
[[tool]]
number = 1
name = "MILL 16"
kind = "mill"
length = 100.05
radius = 7.97
believed_length = 100
believed_radius = 8
[tool.cutter]
shank_radius = 7
cutting_length = 30
{}
[tool_probe]
diameter = 40
thickness = 8
stem_diameter = 6
pose = {{ x = 250, y = 120, z = -560 }}
[[preset]]
row = 1
origin = [0, 0, -480]
active = true
)",
                     type, tables, cutter);
}

Told toldOf(const std::string& setupText, const std::filesystem::path& file, const std::string& program) {
  std::ofstream(file) << setupText;
  Diagnostics diagnostics;
  const auto setup = setup::readSetup(file.string(), diagnostics);
  if (!setup) {
    ADD_FAILURE() << format(diagnostics.front());
    return {};
  }
  return {setup::runText("T.H", "BEGIN PGM T MM\n" + program + "END PGM T MM\n", *setup, session::RunOptions(), {})
              .outcome};
}

/// What is written into a tool table in inches stands in inches; what is told of it is in mm.
TEST(Entries, OfAToolInATableInInchesAreToldInMillimetres) {
  for (const std::string type : {"TNC640", "iTNC530"}) {
    const TableFolder folder;
    folder.put(
        "TOOL.T",
        "BEGIN TOOL.T INCH\n"
        "T       NAME                L            R            R2           DL        DR        TL RT      TYP   "
        "CUT  LTOL    RTOL    LBREAK  RBREAK  DIRECT R-OFFS      L-OFFS      \n"
        "1       MILL 16             +3.9370079   +0.3149606                                                     "
        "4                                    -                  \n[END]\n");
    const std::string text = millOn("tables = \".\"", "teeth = 4", type);
    for (const int mode : {0, 1}) {
      const Told told =
          toldOf(text, folder.path() / "mill.toml",
                 fmt::format("TOOL CALL 1 Z\nTCH PROBE 483 BOTH ~\nQ340=+{} ~\nQ260=+100 ~\nQ341=+0\n", mode));
      ASSERT_TRUE(told.finished()) << told.why();
      const records::EntryTruth& tool = entry(told, "tool 1");
      EXPECT_NEAR(value(tool, "L").truth, 100.05, 1e-9) << type << mode;
      EXPECT_NEAR(value(tool, "L").value, 100.05, 1e-3) << type << mode;
      EXPECT_NEAR(value(tool, "R").truth, 7.97, 1e-9) << type << mode;
      EXPECT_NEAR(value(tool, "R").value, 7.97, 1e-3) << type << mode;
    }
  }
}

/// The same of presets and their errors.
TEST(Entries, OfAPresetTableInInchesAreToldInMillimetres) {
  const TableFolder folder;
  World world;
  world.origin = {0, 0, -480};
  world.probe = "believed_tip_offset = [0.02, -0.01]\n";
  world.part = "tables = \".\"\n" + plate("{ x = 0.6, y = -0.4, z = -480 }");  // of [control]
  folder.put("PRESET.PR", [] {
    auto table =
        control::heidenhain::defaultPresetTable(control::ControlKind::TNC640, control::heidenhain::TableUnit::Inch);
    EXPECT_TRUE(table.setNumber("1", "X", 0) && table.setNumber("1", "Y", 0) && table.setNumber("1", "Z", -480));
    return std::string(table.table().bytes());
  }());
  const Told told = toldOf(world.text(), folder.path() / "plate.toml",
                           "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 412 PRESET ~\nQ321=+0 ~\nQ322=+0 ~\nQ262=+30 ~\n"
                           "Q325=+0 ~\nQ247=+90 ~\nQ261=-5 ~\nQ320=+2 ~\nQ260=+20 ~\nQ301=+0 ~\nQ305=+1 ~\nQ331=+10 ~\n"
                           "Q332=+20 ~\nQ303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\nQ383=+0 ~\nQ384=+0 ~\nQ333=+0\n");
  ASSERT_TRUE(told.finished()) << told.why();
  const records::EntryTruth& preset = entry(told, "preset 1");
  EXPECT_NEAR(value(preset, "X").truth, 0.6 - 10, 1e-3);
  EXPECT_NEAR(value(preset, "Y").truth, -0.4 - 20, 1e-3);
  EXPECT_NEAR(value(preset, "X").value, 0.6 - 10 + 0.02, 1e-3);
}

/// A mill whose axis stands beside that of the spindle cuts as wide as the tooth that is furthest out.
TEST(Entries, OfAMillBesideTheSpindleAxisAreItsSweptRadius) {
  const TableFolder folder;
  const auto trueRadius = [&](const std::string& cutter) {
    const Told told = toldOf(millOn("", cutter), folder.path() / "mill.toml",
                             "TOOL CALL 1 Z\nTCH PROBE 483 BOTH ~\nQ340=+0 ~\nQ260=+100 ~\nQ341=+0\n");
    EXPECT_TRUE(told.finished()) << told.why();
    const records::EntryValue& radius = value(entry(told, "tool 1"), "R");
    EXPECT_NEAR(radius.value, radius.truth, 5e-3) << cutter;
    return radius.truth;
  };
  EXPECT_NEAR(trueRadius("teeth = 2\neccentricity = [0.5, 0]"), 8.47, 1e-9);
  EXPECT_NEAR(trueRadius("teeth = 2\neccentricity = [0, 0.5]"), std::hypot(7.97, 0.5), 1e-9);
  EXPECT_NEAR(trueRadius("teeth = 2\neccentricity = [0.5, 0]\n[[tool.cutter.tooth]]\nnumber = 2\nradial = 1.2"),
              7.97 + 1.2 - 0.5, 1e-9);
}

}  // namespace
}  // namespace probewright::truth::testing
