#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "machine/linuxcnc_machine.hpp"
#include "machine/machine_file.hpp"
#include "machine/table_body.hpp"
#include "support/test_names.hpp"

/// Machines as LinuxCNC configurations describe them.
namespace probewright::machine {
namespace {

using ::testing::HasSubstr;

class Configuration : public ::testing::Test {
protected:
  Configuration() {
    std::string name = (std::filesystem::temp_directory_path() / "probewright-ini-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    folder_ = name;
  }
  ~Configuration() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  /// The machine of this .ini.
  std::optional<MachineDescription> read(const std::string& ini) {
    diagnostics_.clear();
    auto machine = readLinuxCncMachine(write("shop.ini", ini), diagnostics_);
    if (!machine) return std::nullopt;
    return machine->description;
  }
  std::string said() const {
    std::string text;
    for (const Diagnostic& each : diagnostics_)
      text += format(each) + "\n";
    return text;
  }

  std::filesystem::path folder_;
  Diagnostics diagnostics_;
};

/// [JOINT_n] of a joint of 1 m travel.
std::string joint(int number, const std::string& more = "") {
  return "[JOINT_" + std::to_string(number) +
         "]\nMIN_LIMIT = -500\nMAX_LIMIT = 500\nMAX_VELOCITY = 100\nMAX_ACCELERATION = 800\n" + more;
}
std::string joints(int count) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += joint(i);
  return text;
}

TEST_F(Configuration, TellsTravelSpeedAndAccelerationOfAMill) {
  const auto machine = read(R"([EMC]
MACHINE = shop mill
[KINS]
KINEMATICS = trivkins coordinates=XYZ
JOINTS = 3
[TRAJ]
COORDINATES = X Y Z
LINEAR_UNITS = mm
MAX_LINEAR_VELOCITY = 90
[EMCIO]
TOOL_CHANGE_POSITION = 10 20 -5
# the axis allows less than its joint here, and more there
[AXIS_X]
MIN_LIMIT = -200
MAX_LIMIT = 400
MAX_VELOCITY = 80
MAX_ACCELERATION = 900
[JOINT_0]
MIN_LIMIT = -250
MAX_LIMIT = 300
MAX_VELOCITY = 120
MAX_ACCELERATION = 700
)" + joint(1) + "[JOINT_2]\nMIN_LIMIT = -300\nMAX_LIMIT = 0.001\nMAX_VELOCITY = 50\nMAX_ACCELERATION = 500\n");
  ASSERT_TRUE(machine) << said();
  EXPECT_EQ(said(), "");
  EXPECT_EQ(machine->name, "shop mill");
  ASSERT_EQ(machine->axes.size(), 3U);
  EXPECT_EQ(machine->axes[0].name, "X");
  EXPECT_EQ(machine->axes[0].minimum, -200);
  EXPECT_EQ(machine->axes[0].maximum, 300);
  EXPECT_EQ(machine->axes[0].rapid, 80 * 60);
  EXPECT_EQ(machine->axes[0].acceleration, 700);
  EXPECT_EQ(machine->axes[1].rapid, 90 * 60) << "the path is not faster than MAX_LINEAR_VELOCITY";
  EXPECT_EQ(machine->axes[2].minimum, -300);
  EXPECT_EQ(machine->axes[2].maximum, 0.001);
  EXPECT_EQ(machine->toolChange[1], 20);
  EXPECT_EQ(machine->toolChange[2], -5);
  EXPECT_FALSE(machine->spindleOrients);
  // The spindle nose goes where the axes do.
  const Vector3 nose = baseFromSpindle(*machine, {{10, 20, -30}}).translation();
  EXPECT_LT((nose - Vector3(10, 20, -30)).norm(), 1e-12);
}

/// A file may hold the key with nothing set; a machine that cannot move is none.
TEST_F(Configuration, ASpeedOfThePathThatIsZeroLimitsNoAxis) {
  const auto machine = read(
      "[KINS]\nKINEMATICS = trivkins coordinates=XYZ\nJOINTS = 3\n[TRAJ]\nCOORDINATES = X Y Z\n"
      "LINEAR_UNITS = mm\nMAX_LINEAR_VELOCITY = 0\n" +
      joints(3));
  ASSERT_TRUE(machine) << said();
  for (const Axis& axis : machine->axes)
    EXPECT_EQ(axis.rapid, 100 * 60) << axis.name << ": the speed of its joint";
}

TEST_F(Configuration, CountsInItsOwnUnits) {
  const auto machine = read(
      "[KINS]\nKINEMATICS = trivkins coordinates=XYZ\n[TRAJ]\nLINEAR_UNITS = inch\nCOORDINATES = XYZ\n" + joints(3));
  ASSERT_TRUE(machine) << said();
  EXPECT_DOUBLE_EQ(machine->axes[1].maximum, 500 * 25.4);
  EXPECT_DOUBLE_EQ(machine->axes[1].rapid, 100 * 25.4 * 60);
  EXPECT_DOUBLE_EQ(machine->axes[1].acceleration, 800 * 25.4);
}

TEST_F(Configuration, TakesTheJointsOfAGantryForOneAxis) {
  const auto machine =
      read("[KINS]\nKINEMATICS = trivkins coordinates=XYYZ kinstype=BOTH\n[TRAJ]\nCOORDINATES = XYYZ\n" + joints(2) +
           joint(2, "") +
           "[JOINT_3]\nMIN_LIMIT = -100\nMAX_LIMIT = 0\nMAX_VELOCITY = 20\n"
           "MAX_ACCELERATION = 300\n");
  ASSERT_TRUE(machine) << said();
  ASSERT_EQ(machine->axes.size(), 3U);
  EXPECT_EQ(machine->axes[2].name, "Z");
  EXPECT_EQ(machine->axes[2].minimum, -100);
}

TEST_F(Configuration, FollowsIncludesCommentsAndContinuedLines) {
  write("axes.inc", joints(2) +
                        "[JOINT_2]\nMIN_LIMIT = -77 ; upper end is 0\nMAX_LIMIT = 0\nMAX_VELOCITY = 9\n"
                        "MAX_ACCELERATION = 99\n");
  const auto machine = read("; mill\n[KINS]\nKINEMATICS = trivkins \\\n coordinates=XYZ\n#INCLUDE axes.inc\n");
  ASSERT_TRUE(machine) << said();
  EXPECT_EQ(machine->axes[2].minimum, -77);
}

TEST_F(Configuration, JoinsAsManyLinesAsAreContinuedAndCountsEach) {
  const auto machine = read("[KINS]\nKINEMATICS = \\\ntrivkins \\\ncoordinates=XYZ\n" + joints(3) + "# the end \\");
  ASSERT_TRUE(machine) << said();
  EXPECT_EQ(machine->axes.size(), 3U);
  EXPECT_FALSE(
      read("[TRAJ]\nCOORDINATES = \\\nXY\\\nZA\n[KINS]\nKINEMATICS = trivkins coordinates=XYZA\n" + joints(4)));
  EXPECT_THAT(said(), HasSubstr("shop.ini:6"));
  EXPECT_THAT(said(), HasSubstr("does not say where the axis of A lies"));
}

TEST_F(Configuration, TakesNumbersOnly) {
  for (const char* value : {"", "inf", "1e999", "nan", "fast", "9 mm/s", "; none"}) {
    EXPECT_FALSE(read("[KINS]\nKINEMATICS = trivkins coordinates=XYZ\n" + joints(2) +
                      "[JOINT_2]\nMIN_LIMIT = " + value + "\nMAX_LIMIT = 0\nMAX_VELOCITY = 9\nMAX_ACCELERATION = 99\n"))
        << value;
    EXPECT_THAT(said(), HasSubstr("MIN_LIMIT")) << value;
  }
}

TEST_F(Configuration, AsksWhereARotaryAxisLies) {
  const std::string ini = "[KINS]\nKINEMATICS = trivkins coordinates=XYZA\n[TRAJ]\nCOORDINATES = XYZA\n" + joints(4);
  EXPECT_FALSE(read(ini));
  EXPECT_THAT(said(), HasSubstr("shop.ini:2"));
  EXPECT_THAT(said(), HasSubstr("does not say where the axis of A lies"));
  EXPECT_THAT(said(), HasSubstr("[PROBEWRIGHT] ROTARY_A = TABLE"));
  const auto machine = read(ini + "[PROBEWRIGHT]\nROTARY_A = TABLE 1 0 0  0 25 -300\n");
  ASSERT_TRUE(machine) << said();
  // Half a turn about X through Y25 Z-300 brings what lies at Y25 Z-250 to Y25 Z-350.
  const Vector3 moved = baseFromTable(*machine, {{0, 0, 0, 180}}) * Vector3(7, 25, -250);
  EXPECT_LT((moved - Vector3(7, 25, -350)).norm(), 1e-9);
  EXPECT_FALSE(read(ini + "[PROBEWRIGHT]\nROTARY_A = SOMEWHERE 1 0 0  0 25 -300\n"));
  EXPECT_THAT(said(), HasSubstr("TABLE or HEAD"));
  EXPECT_FALSE(read(ini + "[PROBEWRIGHT]\nROTARY_B = TABLE 1 0 0  0 25 -300\n"));
  EXPECT_THAT(said(), HasSubstr("no rotary axis for ROTARY_B"));
}

TEST_F(Configuration, FindsOffsetsOfATrunnionInTheHalFiles) {
  write("trunnion.hal",
        "setp xyzac-trt-kins.z-rot-point [TRUNNION]Z\nsetp xyzac-trt-kins.y-rot-point 3\n"
        "net yoff xyzac-trt-kins.y-offset => gui.y\nsets yoff 20\n");
  const auto machine = read(
      "[KINS]\nKINEMATICS = xyzac-trt-kins sparm=identityfirst\nJOINTS = 5\n[TRAJ]\n"
      "COORDINATES = XYZAC\n[TRUNNION]\nZ = -400\n[HAL]\nHALFILE = trunnion.hal\n"
      "HALCMD = setp xyzac-trt-kins.x-rot-point 2\n" +
      joints(5));
  ASSERT_TRUE(machine) << said();
  ASSERT_EQ(machine->tableChain.size(), 2U);
  EXPECT_LT((machine->tableChain[0].point - Vector3(2, 23, -400)).norm(), 1e-12);
  EXPECT_LT((machine->tableChain[1].point - Vector3(2, 3, -400)).norm(), 1e-12);
}

/// Numbers, keys of the .ini in both ways of writing, and signals; what is none of them is not there.
TEST_F(Configuration, ReadsValuesOfHalFilesInAllTheirForms) {
  const auto pointWith = [&](const std::string& value, const std::string& before = "") {
    write("point.hal", before + "setp xyzac-trt-kins.z-rot-point " + value +
                           "\nsetp xyzac-trt-kins.y-rot-point 3\nsetp xyzac-trt-kins.x-rot-point 2\n");
    const auto machine = read(
        "[KINS]\nKINEMATICS = xyzac-trt-kins sparm=identityfirst\nJOINTS = 5\n[TRAJ]\nCOORDINATES = XYZAC\n"
        "[TRUNNION]\nZ = -400\nLOW(Z) = 1\n(Z) = -7\n[HAL]\nHALFILE = point.hal\n" +
        joints(5));
    return machine && machine->tableChain.size() == 2 ? machine->tableChain[1].point : Vector3(0, 0, 1e9);
  };
  for (const std::string value : {"-400", "-400.0", "[TRUNNION]Z", "[TRUNNION](Z)", "-4e2"})
    EXPECT_LT((pointWith(value) - Vector3(2, 3, -400)).norm(), 1e-12) << value;
  for (const std::string value : {"[TRUNNION]Q", "[TRUNNION](Q)", "[TRUNNION", "[OTHER]Z", "[TRUNNION]()", "low"})
    EXPECT_GT((pointWith(value) - Vector3(2, 3, -400)).norm(), 1) << value;
}

TEST_F(Configuration, AsksForAPivotThatNoFileTells) {
  const std::string ini =
      "[KINS]\nKINEMATICS = 5axiskins\n[TRAJ]\nCOORDINATES = XYZBCW\n[HAL]\nHALCMD = net p sum.out "
      "5axiskins.pivot-length\n" +
      joints(6);
  EXPECT_FALSE(read(ini));
  EXPECT_THAT(said(), HasSubstr("[PROBEWRIGHT] PIVOT_LENGTH"));
  const auto machine = read(ini + "[PROBEWRIGHT]\nPIVOT_LENGTH = 250\n");
  ASSERT_TRUE(machine) << said();
  const auto b = *machine->axisIndex("B");
  AxisPositions swung;
  swung[b] = 90;
  // The nose swings about a point 250 mm above it; LinuxCNC's B swings it towards +X.
  const Vector3 nose = baseFromSpindle(*machine, swung).translation();
  EXPECT_LT((nose - Vector3(250, 0, 250)).norm(), 1e-9);
}

struct Refusal {
  const char* ini;
  const char* said;
};
void PrintTo(const Refusal& refusal, std::ostream* out) { *out << testing_support::plainWords(refusal.said); }
class Refused : public Configuration, public ::testing::WithParamInterface<Refusal> {};

TEST_P(Refused, InWords) {
  EXPECT_FALSE(read(GetParam().ini));
  EXPECT_THAT(said(), HasSubstr(GetParam().said));
  EXPECT_THAT(said(), HasSubstr("shop.ini"));
}

INSTANTIATE_TEST_SUITE_P(
    Configurations, Refused,
    ::testing::Values(
        Refusal{"[EMC]\nVERSION = 1.1\n", "[KINS]KINEMATICS is missing"},
        Refusal{"[KINS]\nKINEMATICS = genhexkins\n", "genhexkins are those of a hexapod"},
        Refusal{"[KINS]\nKINEMATICS = mykins\n", "mykins are not known"},
        Refusal{"[KINS]\nKINEMATICS = trivkins coordinates=XYUV\n", "no axis Z"},
        Refusal{"[KINS]\nKINEMATICS = trivkins coordinates=XYQ\n", "no axis Q"},
        Refusal{"[KINS]\nKINEMATICS = trivkins\nJOINTS = 4\n[TRAJ]\nCOORDINATES = XYZC\n", "axis C is joint 5"},
        Refusal{"[KINS]\nKINEMATICS = trivkins coordinates=XYZ\n", "neither a section [AXIS_X] nor [JOINT_0]"},
        Refusal{"[KINS]\nKINEMATICS = trivkins coordinates=XZ\n[TRAJ]\nLINEAR_UNITS = furlong\n", "furlong is not"},
        Refusal{"[KINS]\nKINEMATICS = trivkins coordinates=XZ\n[JOINT_0]\nMIN_LIMIT = low\n[JOINT_1]\nHOME = 0\n",
                "[JOINT_0]MIN_LIMIT = low is not a number"},
        Refusal{"[KINS]\nKINEMATICS = trivkins coordinates=XZ\n[JOINT_0]\nMIN_LIMIT = 5\nMAX_LIMIT = 4\n[JOINT_1]\n"
                "HOME = 0\n",
                "ends before it begins"},
        Refusal{"#INCLUDE shop.ini\n", "without end"}, Refusal{"#INCLUDE nothing.inc\n", "nothing.inc"}));

TEST_F(Configuration, IsAMachineFileToEverybody) {
  write("shop.ini", "[KINS]\nKINEMATICS = trivkins coordinates=XYZ\n" + joints(3));
  Diagnostics diagnostics;
  const auto machine = readMachine((folder_ / "shop.ini").string(), diagnostics);
  ASSERT_TRUE(machine);
  EXPECT_EQ(machine->axes.size(), 3U);
  EXPECT_TRUE(readTableBody((folder_ / "shop.ini").string()).has_value());
}

/// Every configuration that LinuxCNC brings along is read or refused in words.
TEST(LinuxCncSamples, AreReadOrRefusedInWords) {
  const std::filesystem::path samples = "/usr/share/doc/linuxcnc/examples/sample-configs";
  if (!std::filesystem::exists(samples)) GTEST_SKIP() << "LinuxCNC is not installed here";
  int count = 0, mills = 0;
  for (const auto& file : std::filesystem::recursive_directory_iterator(samples)) {
    if (file.path().extension() != ".ini") continue;
    SCOPED_TRACE(file.path());
    ++count;
    Diagnostics diagnostics;
    const auto machine = readLinuxCncMachine(file.path(), diagnostics);
    EXPECT_NE(machine.has_value(), hasErrors(diagnostics));
    for (const Diagnostic& each : diagnostics) {
      EXPECT_FALSE(each.message.empty());
      EXPECT_FALSE(each.place.file.empty()) << format(each);
    }
    std::ifstream stream(file.path());
    const std::string text((std::istreambuf_iterator<char>(stream)), {});
    const std::regex plain("(^|\n)\\s*KINEMATICS\\s*=\\s*trivkins\\s+coordinates=[xX][yY]+[zZ]\\s*(\n|kinstype)");
    if (!std::regex_search(text, plain)) continue;
    ASSERT_TRUE(machine) << format(diagnostics.front());
    if (machine->description.axisIndex("Y")) ++mills;  // a lathe may have the kinematics of a mill
    for (const char* name : {"X", "Z"})
      EXPECT_TRUE(machine->description.axisIndex(name)) << name;
    for (const Axis& axis : machine->description.axes) {
      EXPECT_LT(axis.minimum, axis.maximum);
      EXPECT_GT(axis.rapid, 0);
      EXPECT_GT(axis.acceleration, 0);
    }
  }
  EXPECT_GT(count, 200);
  EXPECT_GT(mills, 20);
}

}  // namespace
}  // namespace probewright::machine
