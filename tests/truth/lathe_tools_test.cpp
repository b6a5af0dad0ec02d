#include <cmath>

#include "truth/told.hpp"

/// Tools of lathes and what the truth line says of them: tools that a true world has, lengths that the control has
/// otherwise.
namespace probewright::truth::testing {
namespace {

/// A bar in the chuck, a tool touch probe beside it, a probe along Z, and tools.
struct Lathe {
  double bar = 40;  ///< diameter, mm
  std::string tools = {};
  std::string parameters = {};
  std::string text() const {
    return fmt::format(R"(seed = 20360
[machine]
name = "lathe2c"
[control]
type = "840Dsl"
[part]
name = "bar"
[[part.feature]]
shape = "cylinder"
diameter = {}
height = 120
[tool_probe]
size = [20, 20]
thickness = 20
stem_diameter = 6
pose = {{ x = 150, y = 10, z = 500, a = -90 }}
[[tool]]
number = 1
name = "PROBE"
kind = "probe"
length = 120
ball_radius = 3
stylus_length = 60
body_radius = 20
shank_direction = [0, 0, 1]
{}
[[zero_offset]]
name = "G54"
origin = [0, 0, 120]
[parameters]
{})",
                       bar, tools, parameters);
  }
};

Told run(const Lathe& lathe, const std::string& program) {
  Diagnostics diagnostics;
  const auto setup = setup::parseSetup(lathe.text(), "lathe.toml", diagnostics);
  if (!setup) {
    ADD_FAILURE() << format(diagnostics.front());
    return {};
  }
  return {setup::runText("T.MPF", program + "\nM30\n", *setup, session::RunOptions(), {}).outcome};
}

/// A turning tool whose tip is 80 mm in X and 40 mm in Z from the turret.
std::string finish(double believedLength) {
  return fmt::format(R"([[tool]]
number = 3
name = "FINISH"
kind = "turn"
length = 60
radius = 0.4
shank_direction = [1, 0, 0]
mount = [-20, 0, -40]
believed_length = {}
[tool.cutter.insert]
nose_radius = 0.4
edge_normals = [-85, -185]
orientation = 90
edge_length = 8
)",
                     believedLength);
}

std::string diameters(int mask) { return fmt::format("\"$MC_TOOL_PARAMETER_DEF_MASK\" = {}\n", mask); }

/// CYCLE982 measures both lengths of the tool, into the geometry (0) or the wear (1).
std::string measured(int target) {
  return fmt::format("G18 G90 G94 DIAMOF G500\nT=\"FINISH\" D1\nG0 Z540\nG0 X185\nCYCLE982(2,{},1,,,,5,1,,,,0,0.5)",
                     target);
}

/// CYCLE974 and CYCLE994 correct the tool by the bar, which is to have 40 mm.
std::string correctedByOnePoint(int code, int dl = 0) {
  return fmt::format(
      "G18 G90 G95 DIAMON G54\nT=\"PROBE\" D1\nG0 Z50\nG0 X56\nG0 Z-30\n"
      "CYCLE974(202,,{},1,40,2,8,1,,1,\"FINISH\",{},0,0.5,0,0,0,1)",
      code, dl == 0 ? "" : std::to_string(dl));
}
std::string correctedByTwoPoints(int code) {
  return fmt::format(
      "G18 G90 G95 DIAMON G54\nT=\"PROBE\" D1\nG0 Z50\nG0 X56\nG0 Z-12\n"
      "CYCLE994(202,,{},1,40,102,,20,8,1,1,\"FINISH\",,0,0.5,0,0,0,1)",
      code);
}

const records::EntryTruth& entry(const Told& told, const std::string& name) {
  static const records::EntryTruth none;
  const auto& entries = told.truth().entries;
  const auto found = std::ranges::find(entries, name, &records::EntryTruth::name);
  EXPECT_NE(found, entries.end()) << "no entry " << name;
  return found == entries.end() ? none : *found;
}

records::EntryValue number(const records::EntryTruth& entry, const std::string& name) {
  const auto found = std::ranges::find(entry.values, name, &records::EntryValue::name);
  if (found != entry.values.end()) return *found;
  ADD_FAILURE() << "no value " << name;
  return {};
}

/// What stands in a table at the end, as the run wrote it last.
double left(const Told& told, const std::string& table, const std::string& place) {
  double value = std::nan("");
  for (const auto& cycle : told.outcome.journal.cycles)
    for (const auto& write : cycle.writes)
      if (write.table == table && write.entry == place) value = std::stod(write.after);
  return value;
}

/// MD 20360: with bit 0 the wear, with bit 1 the geometry of length 1 counts as a diameter.
TEST(LatheTools, OfASetupThatIsRightAreMeasuredWithoutADifference) {
  for (const int mask : {0, 1, 2, 3}) {
    const Told told = run({.tools = finish(60), .parameters = diameters(mask)}, measured(0));
    ASSERT_TRUE(told.finished()) << "MD 20360 = " << mask << ": " << told.why();
    EXPECT_NEAR(told.measured("_OVR[8]"), 80, 1e-6) << mask;
    EXPECT_NEAR(told.measured("_OVR[9]"), 0, 1e-6) << mask;
  }
}

TEST(LatheTools, AreAsWrongAsTheTriggerPointsTheyWereMeasuredWith) {
  // The face of the contact in X is believed 0.04 mm nearer to the spindle's axis than it is: the tool comes out
  // longer.
  for (const int mask : {0, 1, 2, 3}) {
    for (const int target : {0, 1}) {
      const Told told = run({.tools = finish(60.3),
                             .parameters = diameters(mask) + "\"$SNS_MEA_TP_TRIG_MINUS_DIR_AX1[0]\" = 510.03\n"
                                                             "\"$SNS_MEA_TP_TRIG_MINUS_DIR_AX2[0]\" = 159.96\n"},
                            measured(target));
      ASSERT_TRUE(told.finished()) << told.why();
      SCOPED_TRACE(fmt::format("MD 20360 = {}, target {}", mask, target));
      const records::EntryTruth& tool = entry(told, "tool 3");
      EXPECT_NEAR(number(tool, "length 1").truth, 80, 1e-6);
      EXPECT_NEAR(number(tool, "length 1").value, 80.04, 1e-6);
      EXPECT_NEAR(number(tool, "length 2").truth, 40, 1e-6);
      EXPECT_NEAR(number(tool, "length 2").value, 39.97, 1e-6);
      EXPECT_NEAR(*tool.distance, 0.04, 1e-6);
      // What the control has in its table.
      if (target == 0)
        EXPECT_NEAR(left(told, "$TC_DP3", "[3,1]"), (mask & 2) != 0 ? 160.08 : 80.04, 1e-5);
      else
        EXPECT_NEAR(left(told, "$TC_DP12", "[3,1]"), (mask & 1) != 0 ? -0.52 : -0.26, 1e-5);
    }
  }
}

TEST(LatheTools, CountWearOfTheTableAsTheControlDoes) {
  // A wear that somebody entered; measuring takes it into the geometry.
  for (const int mask : {0, 1, 2, 3}) {
    const Told told =
        run({.tools = finish(60.3), .parameters = diameters(mask) + "\"$TC_DP12[3,1]\" = -0.1\n"}, measured(0));
    ASSERT_TRUE(told.finished()) << told.why();
    const double before = 80.3 - ((mask & 1) != 0 ? 0.05 : 0.1);
    EXPECT_NEAR(told.measured("_OVR[9]"), 80 - before, 1e-6) << mask;
    EXPECT_NEAR(number(entry(told, "tool 3"), "length 1").truth, 80, 1e-6) << mask;
    EXPECT_NEAR(number(entry(told, "tool 3"), "length 1").value, 80, 1e-6) << mask;
  }
}

TEST(LatheTools, OfParametersAndTablesAreAsTheyAreToldThere) {
  // What the parameters say of $TC_DP3 is a diameter where the control takes it for one; the adapter never is.
  for (const int mask : {0, 1, 2, 3}) {
    const Told told =
        run({.tools = finish(60),
             .parameters = diameters(mask) + fmt::format("\"$TC_DP3[3,1]\" = {}\n\"$TC_DP21[3,1]\" = 20\n",
                                                         (mask & 2) != 0 ? 120.4 : 60.2)},
            measured(1));
    ASSERT_TRUE(told.finished()) << told.why();
    EXPECT_NEAR(told.measured("_OVR[9]"), -0.2, 1e-6) << mask;
    EXPECT_NEAR(number(entry(told, "tool 3"), "length 1").truth, 80, 1e-6) << mask;
    EXPECT_NEAR(number(entry(told, "tool 3"), "length 1").value, 80, 1e-6) << mask;
  }
}

TEST(LatheTools, CorrectedByTheirPartAreAsWrongAsThePart) {
  // The tool is 0.03 mm shorter than believed: the bar would be 0.06 mm too thick. It is 0.1 mm too thick.
  for (const int mask : {0, 1, 2, 3}) {
    for (const int memory : {0, 4}) {
      for (const bool twoPoints : {false, true}) {
        const int code = 1000000 * memory + 1;
        const Told told = run({.bar = 40.1, .tools = finish(60.03), .parameters = diameters(mask)},
                              twoPoints ? correctedByTwoPoints(code) : correctedByOnePoint(code));
        ASSERT_TRUE(told.finished()) << told.why();
        SCOPED_TRACE(fmt::format("MD 20360 = {}, memory {}, two points {}", mask, memory, twoPoints));
        EXPECT_NEAR(told.measured("_OVR[16]"), 0.1, 1e-6);
        const records::EntryValue length = number(entry(told, "tool 3"), "length 1");
        EXPECT_NEAR(length.truth, 80, 1e-6);
        EXPECT_NEAR(length.value, 79.98, 1e-6);
      }
    }
  }
}

TEST(LatheTools, CountTheOffsetsOfADlNumberWithIt) {
  for (const int mask : {0, 3}) {
    const Told told = run({.bar = 40.1,
                           .tools = finish(60.03),
                           .parameters = diameters(mask) + "\"$MN_MM_NUM_SUMCORR\" = 6\n\"$TC_SCP23[3,1]\" = 0.02\n"},
                          correctedByOnePoint(1000001, 2));
    ASSERT_TRUE(told.finished()) << told.why();
    const records::EntryValue length = number(entry(told, "tool 3 DL2"), "length 1");
    EXPECT_NEAR(length.truth, 80, 1e-6);
    EXPECT_NEAR(length.value, 80.03 + 0.02 - 0.05, 1e-6);
  }
}

/// A disc along Z or X; its end is 60 mm in X and 90 mm in Z from the turret.
std::string mill(bool radial, double believedLength, const std::string& cutter) {
  return fmt::format(R"([[tool]]
number = 5
name = "DISC"
kind = "mill"
length = 50
radius = 20
shank_direction = {}
mount = {}
believed_length = {}
believed_radius = 20.2
[tool.cutter]
shank_radius = 4
{}
)",
                     radial ? "[1, 0, 0]" : "[0, 0, 1]", radial ? "[-10, 0, -90]" : "[-60, 0, -40]", believedLength,
                     cutter);
}

/// CYCLE982 measures the mill completely: its end (2002) or its rear side (3002).
std::string millMeasured(bool radial, int variant, int edge = 1, const std::string& spindle = "") {
  return fmt::format("G18 G90 G94 DIAMOF G500\nT=\"DISC\" D{}\nG0 {}\n{}CYCLE982({},0,1,,,,5,1,,,,0,0.9,1,,,102)", edge,
                     radial ? "Z560 X205" : "Z555 X210", spindle, variant + (radial ? 10000 : 0));
}

TEST(LatheTools, ThatMillEndAtTheToothThatStandsOut) {
  const std::string teeth =
      "cutting_length = 20\nteeth = 2\n[[tool.cutter.tooth]]\nnumber = 2\naxial = 0.05\nradial = 0.01";
  for (const bool radial : {false, true}) {
    const char* along = radial ? "length 1" : "length 2";
    const Told pin = run({.tools = mill(radial, 50.3, "cutting_length = 20")}, millMeasured(radial, 2002));
    ASSERT_TRUE(pin.finished()) << pin.why();
    EXPECT_NEAR(number(entry(pin, "tool 5"), along).truth, radial ? 60 : 90, 1e-6);
    EXPECT_NEAR(number(entry(pin, "tool 5"), along).value, radial ? 60 : 90, 1e-6);
    EXPECT_NEAR(number(entry(pin, "tool 5"), "radius").value, 20, 1e-6);
    const Told mills = run({.tools = mill(radial, 50.3, teeth)}, millMeasured(radial, 2002, 1, "SETMS(2)\nS2000 M4\n"));
    ASSERT_TRUE(mills.finished()) << mills.why();
    EXPECT_NEAR(number(entry(mills, "tool 5"), along).truth, radial ? 60.05 : 90.05, 1e-6);
    EXPECT_NEAR(number(entry(mills, "tool 5"), along).value, radial ? 60.05 : 90.05, 0.2) << "it turns";
    EXPECT_NEAR(number(entry(mills, "tool 5"), "radius").truth, 20.01, 1e-6);
  }
}

TEST(LatheTools, WithARearSideEndThereOnceItIsMeasured) {
  for (const bool radial : {false, true}) {
    const Told told = run({.tools = mill(radial, 46.3, "cutting_length = 4")}, millMeasured(radial, 3002));
    ASSERT_TRUE(told.finished()) << told.why();
    const records::EntryTruth& tool = entry(told, "tool 5");
    const records::EntryValue along = number(tool, radial ? "length 1" : "length 2");
    EXPECT_NEAR(along.value, radial ? 56 : 86, 1e-6) << radial;
    EXPECT_NEAR(along.truth, radial ? 56 : 86, 1e-6) << radial;
    EXPECT_NEAR(number(tool, "radius").value, 20, 1e-6);
    EXPECT_NEAR(*tool.distance, 0, 1e-6);
  }
}

TEST(LatheTools, WithAnEdgeForTheRearSideHaveALineOfItsOwn) {
  const Told told = run({.tools = mill(false, 50.3, "cutting_length = 4"),
                         .parameters = "\"$TC_DP1[5,2]\" = 150\n\"$TC_DP3[5,2]\" = 60\n\"$TC_DP4[5,2]\" = 86.2\n"
                                       "\"$TC_DP6[5,2]\" = 20.1\n"},
                        millMeasured(false, 2002) + "\nG0 Z555\nG0 X210\n" + millMeasured(false, 3002, 2));
  ASSERT_TRUE(told.finished()) << told.why();
  EXPECT_NEAR(number(entry(told, "tool 5"), "length 2").truth, 90, 1e-6);
  EXPECT_NEAR(number(entry(told, "tool 5 D2"), "length 2").truth, 86, 1e-6);
  EXPECT_NEAR(number(entry(told, "tool 5 D2"), "length 2").value, 86, 1e-6);
  EXPECT_NEAR(*entry(told, "tool 5").distance, 0, 1e-6);
  EXPECT_NEAR(*entry(told, "tool 5 D2").distance, 0, 1e-6);
}

/// With SD 42950 = 0 length 1 lies along Z in G17: the setup's numbers, which are those of the lathe, say nothing of
/// it.
TEST(LatheTools, ThatAreDrillsWithLengthsAsOnMillsAreNotCompared) {
  const std::string drill =
      "[[tool]]\nnumber = 5\nname = \"DISC\"\nkind = \"drill\"\nlength = 50.03\nradius = 4\nshank_direction = [0, 0, "
      "1]\n"
      "mount = [-60, 0, -40]\nbelieved_length = 50\n[tool.cutter]\npoint_angle = 118\nteeth = 2\n";
  const auto names = [&](const char* type) {
    const Told told =
        run({.tools = drill}, fmt::format("$SC_TOOL_LENGTH_TYPE={}\n$TC_DP3[5,1]=90.03\n$TC_DP6[5,1]=4.01", type));
    EXPECT_TRUE(told.finished()) << told.why();
    std::vector<std::string> all;
    for (const records::EntryValue& each : entry(told, "tool 5").values)
      all.push_back(each.name);
    return all;
  };
  EXPECT_THAT(names("0"), ::testing::ElementsAre("radius"));
  EXPECT_THAT(names("2"), ::testing::UnorderedElementsAre("length 1", "radius"));
}

}  // namespace
}  // namespace probewright::truth::testing
