#include <cmath>
#include <numbers>

#include "linuxcnc/run_bench.hpp"

/// Tilted working planes on a LinuxCNC with rotary axes: what its configuration says of them is all that is known.
namespace probewright::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double pivotZ = -310, presetX = 12, presetY = -7, presetZ = -250, length = 100;

class TiltedOnLinuxCnc : public LinuxCncRun {
protected:
  /// The mill of the tests with a table that A tilts and C turns.
  void withTable(const std::string& kinematics, const std::string& hal) {
    std::string ini = text("mill.ini");
    const auto replace = [&](const std::string& what, const std::string& by) {
      ASSERT_NE(ini.find(what), std::string::npos) << what;
      ini.replace(ini.find(what), what.size(), by);
    };
    replace("KINEMATICS = trivkins coordinates=XYZ", "KINEMATICS = " + kinematics);
    replace("JOINTS = 3", "JOINTS = 5");
    replace("COORDINATES = XYZ\n", "COORDINATES = XYZAC\n");
    replace("HALFILE = plate.hal", "HALFILE = plate.hal\nHALFILE = table.hal");
    const std::string rotary = "MIN_LIMIT = -360\nMAX_LIMIT = 360\nMAX_VELOCITY = 200\nMAX_ACCELERATION = 3000\n";
    for (const char* axis : {"A]\n", "C]\n"})
      ini += std::string("[AXIS_") + axis + rotary;
    for (const char* joint : {"3", "4"})
      ini += std::string("[JOINT_") + joint + "]\nTYPE = ANGULAR\nFERROR = 5\nMIN_FERROR = 5\nHOME_SEQUENCE = 0\n" +
             rotary;
    session_.write("mill.ini", ini + "[PROBEWRIGHT]\nSHARE_TABLES = 0\nSPINDLE_ORIENTS = 1\n");
    session_.write("table.hal",
                   "net a joint.3.motor-pos-cmd => joint.3.motor-pos-fb\n"
                   "net c joint.4.motor-pos-cmd => joint.4.motor-pos-fb\n"
                   "net orient spindle.0.orient => spindle.0.is-oriented\n" +
                       hal);
    session_.write("setup.toml",
                   "[control]\ntype = \"TNC640\"\n[[tool]]\nnumber = 1\nname = \"PROBE\"\nkind = \"probe\"\n"
                   "length = 100\nball_radius = 3\n[[preset]]\nrow = 1\norigin = [12, -7, -250]\n"
                   "active = true\n");
    session_.write("tilted.h",
                   "0 BEGIN PGM TILTED MM\n1 TOOL CALL 1 Z\n2 L Z-20 R0 FMAX M91\n"
                   "3 PLANE SPATIAL SPA+20 SPB+0 SPC+0 TURN FMAX\n4 L X+5 Y-3 Z+60 R0 FMAX\n"
                   "5 CYCL DEF 13.0 ORIENTATION\n6 CYCL DEF 13.1 ANGLE 45\n7 L M19\n"
                   "8 END PGM TILTED MM\n");
  }
  static constexpr const char* turns = R"(
hal('below.in1', -1000)
ended(desk, 'run', start('tilted.h'))
still(desk)
desk.tell('stands', *desk.status.joint_position[:5], look('spindle.0.orient-angle'))
)";
  static constexpr const char* trunnion = "setp xyzac-trt-kins.z-rot-point -310\n";
};

TEST_F(TiltedOnLinuxCnc, TheSwitchableKinematicsOfTheConfigurationSayHow) {
  withTable("xyzac-trt-kins sparm=identityfirst", trunnion);
  atTheDesk(turns);
  ASSERT_THAT(told("run"), StartsWith("0 ")) << output;
  const std::vector<double> stands = session_.told(output, "stands");
  ASSERT_EQ(stands.size(), 6U) << output;
  // The table turns back what the plane is tilted by, so that its normal is Z again: the preset's place on the table
  // goes round the axis of A, and from there on X, Y and Z of the program are those of the machine.
  const double back = -20 * std::numbers::pi / 180, y = presetY, z = presetZ - pivotZ;
  EXPECT_NEAR(stands[0], presetX + 5, 1e-6);
  EXPECT_NEAR(stands[1], y * std::cos(back) - z * std::sin(back) - 3, 1e-6);
  EXPECT_NEAR(stands[2], pivotZ + y * std::sin(back) + z * std::cos(back) + 60 + length, 1e-6);
  EXPECT_NEAR(std::abs(stands[3]), 20, 1e-6);
  EXPECT_NEAR(stands[4], 0, 1e-6);
  EXPECT_EQ(stands[5], 45) << "the spindle was oriented";
}

TEST_F(TiltedOnLinuxCnc, AxesOfWhichTheConfigurationSaysNothingAreRefusedInWords) {
  withTable("trivkins coordinates=XYZAC", "");
  atTheDesk(turns);
  EXPECT_THAT(told("run"), StartsWith("3 ")) << output;
  EXPECT_THAT(told("run"), HasSubstr("rotary axes")) << output;
  const std::vector<double> stands = session_.told(output, "stands");
  ASSERT_EQ(stands.size(), 6U) << output;
  EXPECT_EQ(stands[3], 0) << "nothing has turned";
}

TEST_F(TiltedOnLinuxCnc, KinematicsOfTheToolTipAreToBeSwitchedOffFirst) {
  withTable("xyzac-trt-kins", trunnion);
  atTheDesk(turns);
  EXPECT_THAT(told("run"), HasSubstr("switch to identity kinematics first")) << output;
}

}  // namespace
}  // namespace probewright::testing
