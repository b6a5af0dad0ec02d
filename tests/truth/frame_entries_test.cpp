#include <gmock/gmock.h>

#include <cmath>
#include <iterator>

#include "control/heidenhain/preset_table.hpp"
#include "machine/machine_file.hpp"
#include "truth/told.hpp"

/// Which number of a table is how wrong, where a cycle writes several, or measures what no result shows.
namespace probewright::truth::testing {
namespace {

using ::testing::IsEmpty;

constexpr double cell = 1e-4;  // what a table can show

bool has(const Told& told, const std::string& name) {
  return std::ranges::find(told.truth().entries, name, &records::EntryTruth::name) != told.truth().entries.end();
}

/// A ball that is believed 0.005 mm too large sees an edge as much within the part: at two points, none of which alone
/// decides.
TEST(FrameEntries, OfAnEdgeAtTwoPointsAreThoseOfItsFace) {
  World world = worldWith(plate("{ y = 0.4, z = -480 }"));
  world.believedRadius = 3.005;
  const Told told = run(
      world, probeAbove +
                 "TCH PROBE 1410 EDGE ~\nQ1100=-20 ~\nQ1101=-30 ~\nQ1102=-8 ~\nQ1103=+20 ~\nQ1104=-30 ~\nQ1105=-8 ~\n"
                 "Q372=+2 ~\nQ320=+2 ~\nQ260=+20 ~\nQ1125=+1 ~\nQ309=+0 ~\nQ1126=+0 ~\nQ1120=+3 ~\nQ1121=+0\n");
  ASSERT_TRUE(told.finished()) << told.why();
  const records::EntryTruth& preset = entry(told, "preset 1");
  EXPECT_NEAR(value(preset, "Y").truth, 0.4, cell);
  EXPECT_NEAR(value(preset, "Y").value, 0.405, cell);
  EXPECT_EQ(preset.values.size(), 1U);
}

/// Two points of a round face do not tell where an edge is.
TEST(FrameEntries, OfAnEdgeThatIsNoneAreNotTold) {
  const Told told = run(
      worldWith("[part]\npose = { z = -500 }\n[[part.feature]]\nshape = \"cylinder\"\ndiameter = 200\nheight = 20\n"),
      probeAbove +
          "TCH PROBE 1410 EDGE ~\nQ1100=-20 ~\nQ1101=-98 ~\nQ1102=-8 ~\nQ1103=+20 ~\nQ1104=-98 ~\nQ1105=-8 ~\n"
          "Q372=+2 ~\nQ320=+2 ~\nQ260=+20 ~\nQ1125=+1 ~\nQ309=+0 ~\nQ1126=+0 ~\nQ1120=+3 ~\nQ1121=+0\n");
  ASSERT_TRUE(told.finished()) << told.why();
  EXPECT_THAT(told.truth().entries, IsEmpty());
}

/// A sphere, the only one of several that CYCLE997 could measure.
TEST(FrameEntries, OfASphereAreItsCentre) {
  World world = worldWith(
      "[part]\npose = { z = -500 }\n[[part.feature]]\nshape = \"sphere\"\ndiameter = 25.02\ncentre = [0.3, -0.2, 40]\n",
      "840Dsl");
  world.probe = "believed_tip_offset = [0.03, 0]\n";
  const Told told = run(world, "T1 D1\nM6\nG54 G17 G0 X0 Y0 Z37.5\nCYCLE997(109,10001,1,25,5,4,,,0,0,20)\n");
  ASSERT_TRUE(told.finished()) << told.why();
  const records::EntryTruth& offset = entry(told, "G54");
  EXPECT_NEAR(value(offset, "X").truth, 0.3, 1e-5);
  EXPECT_NEAR(value(offset, "Y").truth, -0.2, 1e-5);
  EXPECT_NEAR(value(offset, "Z").truth, -480, 1e-5);
  EXPECT_NEAR(value(offset, "X").value, 0.33, 1e-3);
}

/// A plane that is measured with scatter: each of its angles has an error of its own, its height another one.
TEST(FrameEntries, OfAPlaneAreItsAnglesAndItsHeight) {
  for (const int tilt : {0, 1}) {
    World world = worldWith(plate(tilt == 0 ? "{ z = -480, a = 1.2 }" : "{ z = -480, b = 1.2 }"));
    world.probe = "repeatability = 0.01\n";
    const Told told =
        run(world,
            probeAbove +
                "TCH PROBE 1420 PLANE ~\nQ1100=+30 ~\nQ1101=-25 ~\nQ1102=+0 ~\nQ1103=-30 ~\nQ1104=-25 ~\nQ1105=+0 ~\n"
                "Q1106=+30 ~\nQ1107=+25 ~\nQ1108=+0 ~\nQ372=-3 ~\nQ320=+2 ~\nQ260=+20 ~\nQ1125=+2 ~\nQ309=+0 ~\n"
                "Q1126=+0 ~\nQ1120=+0 ~\nQ1121=+1\n");
    ASSERT_TRUE(told.finished()) << told.why();
    const records::EntryTruth& preset = entry(told, "preset 1");
    // About an axis of the machine only: the space angles are the pose.
    EXPECT_NEAR(value(preset, "SPA").truth, tilt == 0 ? 1.2 : 0, 3e-4);
    EXPECT_NEAR(value(preset, "SPB").truth, tilt == 0 ? 0 : 1.2, 3e-4);
    // The scatter is seen in both, in each another one.
    const double a = value(preset, "SPA").value - value(preset, "SPA").truth,
                 b = value(preset, "SPB").value - value(preset, "SPB").truth;
    EXPECT_GT(std::abs(a - b), 1e-3);
    EXPECT_NEAR(*preset.angle, std::hypot(a, b), 1e-9);
  }
}

/// A probe that is believed 0.02 mm too long: the hole is measured rightly, the face below it is not.
TEST(FrameEntries, OfAHoleAndTheFaceBesideItAreThoseOfBoth) {
  World world = worldWith(plate("{ x = 0.6, y = -0.4, z = -479.7 }"));
  world.probe = "believed_length = 150.02\nbelieved_tip_offset = [0.03, 0.01]\n";
  const auto preset = [](int row) {
    return fmt::format(
        "TCH PROBE 412 PRESET ~\nQ321=+0 ~\nQ322=+0 ~\nQ262=+30 ~\nQ325=+0 ~\nQ247=+90 ~\nQ261=-5 ~\nQ320=+2 ~\n"
        "Q260=+20 ~\nQ301=+0 ~\nQ305=+{} ~\nQ331=+0 ~\nQ332=+{} ~\nQ303=+1 ~\nQ381=+1 ~\nQ382=+30 ~\nQ383=+20 ~\n"
        "Q384=+0 ~\nQ333=+0\n",
        row, row);
  };
  const Told told = run(world, probeAbove + preset(2) + preset(3));
  ASSERT_TRUE(told.finished()) << told.why();
  for (const int row : {2, 3}) {
    const records::EntryTruth& each = entry(told, fmt::format("preset {}", row));
    ASSERT_EQ(each.values.size(), 3U) << row;
    EXPECT_NEAR(value(each, "X").truth, 0.6, cell);
    EXPECT_NEAR(value(each, "Y").truth, -0.4 - row, cell);
    EXPECT_NEAR(value(each, "Z").truth, -479.7, cell);
    EXPECT_NEAR(value(each, "X").value, 0.63, cell);
    EXPECT_NEAR(value(each, "Z").value, -479.72, cell);
    EXPECT_EQ(each.cycle, static_cast<std::size_t>(row - 2));
  }
}

/// The same of a slot, whose middle is a coordinate in the direction of probing.
TEST(FrameEntries, OfASlotAndTheFaceBesideItAreThoseOfBoth) {
  World world = worldWith(
      "[part]\npose = { y = 0.4, z = -479.7 }\n[[part.feature]]\nshape = \"box\"\ncentre = [0, 0, -40]\nsize = [160, "
      "140, "
      "40]\n[[part.feature]]\nshape = \"pocket\"\nsize = [100, 14.02]\ndepth = 20\ncorner_radius = 2\n");
  world.probe = "believed_length = 150.02\nbelieved_tip_offset = [0.03, 0.01]\n";
  const Told told = run(
      world, probeAbove +
                 "TCH PROBE 408 SLOT ~\nQ321=+0 ~\nQ322=+0 ~\nQ311=+14 ~\nQ272=+2 ~\nQ261=-8 ~\nQ320=+0 ~\nQ260=+40 ~\n"
                 "Q301=+0 ~\nQ305=+1 ~\nQ405=+0 ~\nQ303=+1 ~\nQ381=+1 ~\nQ382=+30 ~\nQ383=+40 ~\nQ384=+0 ~\nQ333=+0\n");
  ASSERT_TRUE(told.finished()) << told.why();
  const records::EntryTruth& preset = entry(told, "preset 1");
  EXPECT_NEAR(value(preset, "Y").truth, 0.4, cell);
  EXPECT_NEAR(value(preset, "Y").value, 0.41, cell);
  EXPECT_NEAR(value(preset, "Z").truth, -479.7, cell);
  EXPECT_NEAR(value(preset, "Z").value, -479.72, cell);
}

/// The offset of C by which the edge lies along X, whatever it was before. Axes that are not square show an edge along
/// Y askew.
TEST(FrameEntries, OfARotaryAxisAreTheAngleAtWhichTheEdgeIsStraight) {
  for (const double c : {2.0, -2.0}) {
    World world = worldWith(plate(fmt::format("{{ z = -480, c = {} }}", c)));
    world.more =
        "[machine]\nname = \"mill5-table-table\"\n[[errors.squareness]]\naxis = \"X\"\ntowards = \"Y\"\ndegrees = "
        "0.01\n";
    const std::string edge =
        "TCH PROBE 403 ROTATION ~\nQ263=-30 ~\nQ264=-30 ~\nQ265=+30 ~\nQ266=-30 ~\nQ272=+2 ~\nQ267=+1 ~\nQ261=-8 ~\n"
        "Q320=+4 ~\nQ260=+40 ~\nQ301=+1 ~\nQ312=+6 ~\nQ337=+1 ~\nQ305=+1 ~\nQ303=+1 ~\nQ380=+0\n";
    const Told told = run(world, probeAbove + edge);
    ASSERT_TRUE(told.finished()) << told.why();
    const records::EntryTruth& preset = entry(told, "preset 1");
    EXPECT_NEAR(value(preset, "C_OFFS").truth, c, 2e-3);
    EXPECT_NEAR(*preset.angle, 0.01, 2e-3);
  }
}

/// The same on a table that turns the other way round, and one whose offset stood at 10 degrees before.
TEST(FrameEntries, OfARotaryAxisCountInItsSense) {
  std::ifstream file(PROBEWRIGHT_EXAMPLES "/../machines/mill5-table-table.toml");
  std::string machine(std::istreambuf_iterator<char>(file), {});
  const std::string direction = "direction = [0, 0, -1]";
  ASSERT_NE(machine.find(direction), std::string::npos);
  machine.replace(machine.find(direction), direction.size(), "direction = [0, 0, 1]");
  for (const double before : {0.0, 10.0}) {
    const TableFolder folder;
    folder.put("mill.toml", machine);
    auto presets = control::heidenhain::defaultPresetTable(control::ControlKind::TNC640,
                                                           control::heidenhain::TableUnit::Millimetre);
    EXPECT_TRUE(presets.setNumber("1", "Z", -480) && presets.setNumber("1", "C_OFFS", before));
    folder.put("PRESET.PR", std::string(presets.table().bytes()));
    World world = worldWith("tables = \".\"\n" + plate("{ z = -480, c = 2 }"));
    world.more =
        "[machine]\nfile = \"mill.toml\"\n[[errors.squareness]]\naxis = \"X\"\ntowards = \"Y\"\ndegrees = 0.01\n";
    folder.put("setup.toml", world.text());
    Diagnostics diagnostics;
    const auto setup = setup::readSetup((folder.path() / "setup.toml").string(), diagnostics);
    ASSERT_TRUE(setup) << format(diagnostics.front());
    const Told told{
        setup::runText("T.H",
                       "BEGIN PGM T MM\n" + probeAbove +
                           "TCH PROBE 403 ROTATION ~\nQ263=-30 ~\nQ264=-30 ~\nQ265=+30 ~\nQ266=-30 ~\nQ272=+2 ~\n"
                           "Q267=+1 ~\nQ261=-8 ~\nQ320=+4 ~\nQ260=+40 ~\nQ301=+1 ~\nQ312=+6 ~\nQ337=+1 ~\nQ305=+1 ~\n"
                           "Q303=+1 ~\nQ380=+0\nEND PGM T MM\n",
                       *setup, session::RunOptions())
            .outcome};
    ASSERT_TRUE(told.finished()) << told.why();
    const records::EntryTruth& preset = entry(told, "preset 1");
    EXPECT_NEAR(value(preset, "C_OFFS").truth, -2, 2e-3) << before;
    EXPECT_NEAR(std::abs(value(preset, "C_OFFS").value + 2), 0.01, 2e-3) << before;
  }
}

/// A rotary axis that CYCLE998 corrects is not one of the axes whose offsets are told.
TEST(FrameEntries, OfAnOffsetOfARotaryAxisAreNotToldOnASinumerik) {
  World world = worldWith(plate("{ z = -480, c = 2 }"), "840Dsl");
  world.more = "[machine]\nname = \"mill5-table-table\"\n";
  const Told told =
      run(world,
          "T1 D1\nM6\nG54 G17 G0 X-20 Y-45 Z20\nG1 Z-8 F2000\nCYCLE998(105,10001,5,1,0,0,,15,10,102,1,40,,,,,1,,1,)\n");
  ASSERT_TRUE(told.finished()) << told.why();
  EXPECT_THAT(told.truth().entries, IsEmpty());
}

TEST(FrameEntries, OfAZeroOffsetAreToldInEachAxisThatACycleCorrected) {
  World world = worldWith(plate("{ x = 0.6, y = -0.4, z = -480 }"), "840Dsl");
  world.probe = "believed_tip_offset = [0.03, 0.01]\n";
  const std::string begin = "T1 D1\nM6\nG54 G17 G0 X0 Y0 Z-5\n";
  const Told told = run(world, begin + "CYCLE977(101,10001,,1,30,,,5,1,0,,,,1,1,\"\",,0,,0,0,,,,,1,)\n");
  ASSERT_TRUE(told.finished()) << told.why();
  const records::EntryTruth& offset = entry(told, "G54");
  EXPECT_NEAR(value(offset, "X").truth, 0.6, 1e-5);
  EXPECT_NEAR(value(offset, "Y").truth, -0.4, 1e-5);
  EXPECT_NEAR(value(offset, "X").value, 0.63, 1e-5);
  // What the program itself writes was not measured.
  const Told own = run(world, begin + "CYCLE977(1,,,1,30,,,5,1,,,,,,1)\n$P_UIFR[2,X,TR]=5\n");
  ASSERT_TRUE(own.finished()) << own.why();
  EXPECT_THAT(own.truth().entries, IsEmpty());
}

/// Tables of kinematics that nobody has written are not told.
TEST(KinematicEntries, AreToldWhereSomethingWasWritten) {
  World world = worldWith(plate("{ z = -480 }"));
  world.more = "[machine]\nname = \"mill5-table-table\"\n";
  const Told told = run(world, probeAbove);
  ASSERT_TRUE(told.finished()) << told.why();
  EXPECT_THAT(told.truth().entries, IsEmpty());
}

/// Each axis by its own element of the chain; a point further along an axis is on the same axis.
TEST(KinematicEntries, OfAnAxisAreThoseOfItsElement) {
  const std::string examples = PROBEWRIGHT_EXAMPLES;
  std::ifstream file(examples + "/setups/kinematics-tnc640.toml");
  std::string text(std::istreambuf_iterator<char>(file), {});
  text += "\n[control.kinematics.A]\nposition = [5, 0, 0]\n";
  Diagnostics diagnostics;
  const auto setup = setup::parseSetup(text, "kinematics.toml", diagnostics);
  ASSERT_TRUE(setup) << format(diagnostics.front());
  const Told told{setup::runProgram(examples + "/programs/kinematics.h", *setup, session::RunOptions()).outcome};
  ASSERT_TRUE(told.finished()) << told.why();
  const auto machine = machine::readMachine("mill5-table-table");
  ASSERT_TRUE(machine);
  const auto pointOf = [&](const std::string& name) {
    for (const auto* chain : {&machine->tableChain, &machine->spindleChain})
      for (const machine::ChainElement& element : *chain)
        if (element.axis && machine->axes[*element.axis].name == name) return element.point;
    ADD_FAILURE() << name;
    return Vector3(Vector3::Zero());
  };
  const records::EntryTruth &a = entry(told, "axis A"), &c = entry(told, "axis C");
  // A lies 0.01 mm towards Y and 0.03 lower than drawn.
  EXPECT_NEAR(value(a, "Y").truth, pointOf("A").y() + 0.01, 1e-3);
  EXPECT_NEAR(value(a, "Z").truth, pointOf("A").z() - 0.03, 1e-3);
  EXPECT_EQ(a.values.size(), 2U) << "not along X, the axis itself";
  EXPECT_NEAR(value(c, "X").truth, pointOf("C").x(), 1e-2);
  EXPECT_EQ(c.values.size(), 2U) << "not along Z, the axis itself";
  EXPECT_LT(*a.distance, 0.003);
  EXPECT_LT(*c.distance, 0.003);
}

/// Indices of tool data are read to their last digit.
TEST(ToolEntries, OfToolNineAreItsOwn) {
  const std::string examples = PROBEWRIGHT_EXAMPLES;
  const auto read = [](const std::string& path) {
    std::ifstream file(path);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const auto renumbered = [](std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
    return text;
  };
  Diagnostics diagnostics;
  const auto setup = setup::parseSetup(
      renumbered(read(examples + "/setups/tool-840dsl.toml"), "number = 12", "number = 19"), "tool.toml", diagnostics);
  ASSERT_TRUE(setup);
  const Told told{setup::runText("T.MPF", renumbered(read(examples + "/programs/tool.mpf"), "T12", "T19"), *setup,
                                 session::RunOptions())
                      .outcome};
  ASSERT_TRUE(told.finished()) << told.why();
  EXPECT_NEAR(value(entry(told, "tool 19"), "length 1").truth, 92.419, 1e-9);
  EXPECT_FALSE(has(told, "tool 1"));
}

/// The response of a probe that was there before is told where a calibration wrote it anew.
TEST(CalibrationEntries, AreToldWhereTheTableChanged) {
  World world = worldWith(
      "[part]\nname = \"none\"\n[[part.feature]]\nshape = \"box\"\ncentre = [200, 0, -500]\nsize = [20, 20, 20]\n");
  world.probe = "pretravel = 0.012\nlobing = 0.006\naxial_pretravel = 0.004\ntip_offset = [0.3, -0.2]\n";
  world.more = "[sphere]\ndiameter = 25\npose = { z = -480 }\nstem_diameter = 8\n";
  const auto program = [](int points) {
    return fmt::format(
        "BEGIN PGM T MM\nTOOL CALL 1 Z\nL Z+80 R0 FMAX\nL X+0 Y+0 R0 FMAX\nL Z+17 R0 FMAX\nTCH PROBE 460 CALIBRATE ~\n"
        "Q407=+12.5 ~\nQ320=+1 ~\nQ301=+1 ~\nQ423=+7 ~\nQ380=+0 ~\nQ433=+1 ~\nQ434=+0 ~\nQ455=+{}\nEND PGM T MM\n",
        points);
  };
  const TableFolder folder;
  const auto calibrated = [&](int points) {
    folder.put("mill.toml", world.text());
    Diagnostics diagnostics;
    const auto setup = setup::readSetup((folder.path() / "mill.toml").string(), diagnostics);
    EXPECT_TRUE(setup) << format(diagnostics.front());
    return Told{setup::runText("T.H", program(points), *setup, session::RunOptions()).outcome};
  };
  const Told first = calibrated(5);
  ASSERT_TRUE(first.finished()) << first.why();
  // A touch beside the nominal point, and the last decimals of the tables.
  EXPECT_LT(*entry(first, "T1.3DTC").distance, 3e-5);
  for (const char* name : {"TOOL.T", "TCHPROBE.TP", "T1.3DTC"})
    folder.put(name, first.outcome.files.at(name));
  world.part = "tables = \".\"\n" + world.part;
  const Told without = calibrated(0);
  ASSERT_TRUE(without.finished()) << without.why();
  EXPECT_FALSE(has(without, "T1.3DTC"));
  const Told again = calibrated(7);
  ASSERT_TRUE(again.finished()) << again.why();
  EXPECT_GT(entry(again, "T1.3DTC").values.size(), entry(first, "T1.3DTC").values.size());
  EXPECT_LT(*entry(again, "T1.3DTC").distance, 3e-5);
}

}  // namespace
}  // namespace probewright::truth::testing
