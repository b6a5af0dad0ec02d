#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "machine/linuxcnc_machine.hpp"
#include "support/linuxcnc_session.hpp"

/// The chains that are read of a configuration, against where LinuxCNC's own kinematics say that the tool is.
namespace probewright::testing {
namespace {

struct Configuration {
  const char* name;
  const char* letters;
  const char* kinematics;
  const char* hal;
  const char* still = "";  ///< axes that the chains leave out
};
void PrintTo(const Configuration& configuration, std::ostream* out) { *out << configuration.kinematics; }

class LinuxCncKinematics : public ::testing::TestWithParam<Configuration> {};

std::string iniOf(const Configuration& configuration) {
  const std::string letters = configuration.letters;
  std::string ini = fmt::format(
      "[EMC]\nVERSION = 1.1\n[DISPLAY]\nDISPLAY = ./display.py\n[TASK]\nTASK = milltask\nCYCLE_TIME = 0.001\n"
      "[RS274NGC]\nPARAMETER_FILE = k.var\n[EMCMOT]\nEMCMOT = motmod\nSERVO_PERIOD = 1000000\n[EMCIO]\nEMCIO = io\n"
      "CYCLE_TIME = 0.1\nTOOL_TABLE = k.tbl\n[HAL]\nHALFILE = k.hal\n[TRAJ]\nCOORDINATES = {}\nLINEAR_UNITS = mm\n"
      "ANGULAR_UNITS = degree\nMAX_LINEAR_VELOCITY = 1000\nMAX_ANGULAR_VELOCITY = 1000\n[KINS]\nKINEMATICS = {}\n"
      "JOINTS = {}\n",
      letters, configuration.kinematics, letters.size());
  for (std::size_t i = 0; i < letters.size(); ++i) {
    const std::string numbers = "MIN_LIMIT = -1000\nMAX_LIMIT = 1000\nMAX_VELOCITY = 1000\nMAX_ACCELERATION = 20000\n";
    const bool rotary = letters[i] >= 'A' && letters[i] <= 'C';
    ini +=
        fmt::format("[AXIS_{}]\n{}[JOINT_{}]\nTYPE = {}\n{}FERROR = 10\nMIN_FERROR = 10\nHOME = 0\nHOME_SEQUENCE = 0\n",
                    letters[i], numbers, i, rotary ? "ANGULAR" : "LINEAR", numbers);
  }
  return ini;
}

std::string halOf(const Configuration& configuration) {
  std::string hal =
      "loadrt [KINS]KINEMATICS\nloadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS\n"
      "addf motion-command-handler servo-thread\naddf motion-controller servo-thread\n"
      "net e iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in\n";
  for (std::size_t i = 0; i < std::string(configuration.letters).size(); ++i)
    hal += fmt::format("net j{0} joint.{0}.motor-pos-cmd => joint.{0}.motor-pos-fb\n", i);
  return hal + configuration.hal;
}

TEST_P(LinuxCncKinematics, PutTheToolWhereTheChainsDo) {
  const Configuration& configuration = GetParam();
  LinuxCncSession session(PROBEWRIGHT_SOURCE_DIR, PROBEWRIGHT_BUILD_DIR);
  session.write("k.ini", iniOf(configuration));
  session.write("k.hal", halOf(configuration));
  session.write("k.tbl", "T1 P1 D6 Z0\n");
  session.write("k.var", "");
  // Moves of the tool tip: the joints follow by LinuxCNC's own kinematics.
  session.display(R"(
desk.ready()
import math
letters = ')" + std::string(configuration.letters) +
                  "'\nstill = '" + configuration.still + R"('
for n in range(4):
    words = []
    for i, letter in enumerate(letters):
        if letter in still:
            continue
        words.append('%s%.3f' % (letter, 37 * math.sin(1 + 2.3 * n + 1.7 * i)))
    desk.mdi('G21 G90 G0 ' + ' '.join(words))
    desk.status.poll()
    s = desk.status
    desk.tell('pose%d' % n, *s.joint_position[: len(letters)], *s.position[:3])
)");
  const std::string output = session.run("k.ini");
  Diagnostics diagnostics;
  const auto machine = machine::readLinuxCncMachine(session.outside() / "k.ini", diagnostics);
  ASSERT_TRUE(machine) << format(diagnostics.front());
  const std::string letters = configuration.letters;
  for (int n = 0; n < 4; ++n) {
    const auto pose = LinuxCncSession::told(output, fmt::format("pose{}", n));
    ASSERT_EQ(pose.size(), letters.size() + 3) << output;
    machine::AxisPositions axes;
    for (std::size_t i = 0; i < letters.size(); ++i) {
      const auto axis = machine->description.axisIndex(letters.substr(i, 1));
      const bool still = std::string(configuration.still).find(letters[i]) != std::string::npos;
      ASSERT_NE(axis.has_value(), still) << letters[i];
      if (axis) axes[*axis] = pose[i];
    }
    const Vector3 tool =
        baseFromTable(machine->description, axes).inverse() * baseFromSpindle(machine->description, axes).translation();
    const Vector3 linuxcnc(pose[letters.size()], pose[letters.size() + 1], pose[letters.size() + 2]);
    EXPECT_LT((tool - linuxcnc).norm(), 1e-6) << tool.transpose() << " or " << linuxcnc.transpose();
    EXPECT_GT((tool - Vector3(pose[0], pose[1], pose[2])).norm(), 1) << "these are not identity kinematics";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Switchable, LinuxCncKinematics,
    ::testing::Values(Configuration{"Trunnion", "XYZAC", "xyzac-trt-kins",
                                    "setp xyzac-trt-kins.x-rot-point 3\nsetp xyzac-trt-kins.y-rot-point -7\n"
                                    "setp xyzac-trt-kins.z-rot-point -310\nsetp xyzac-trt-kins.y-offset 20\n"
                                    "setp xyzac-trt-kins.z-offset 11\n"},
                      Configuration{"TrunnionB", "XYZBC", "xyzbc-trt-kins",
                                    "setp xyzbc-trt-kins.x-rot-point 3\nsetp xyzbc-trt-kins.y-rot-point -7\n"
                                    "setp xyzbc-trt-kins.z-rot-point -310\nsetp xyzbc-trt-kins.x-offset 20\n"
                                    "setp xyzbc-trt-kins.z-offset 11\n"},
                      Configuration{"DualRotary", "XYZAB", "xyzab_tdr_kins",
                                    "setp xyzab_tdr_kins.x-rot-point 3\nsetp xyzab_tdr_kins.y-rot-point -7\n"
                                    "setp xyzab_tdr_kins.z-rot-point -310\nsetp xyzab_tdr_kins.x-offset 20\n"
                                    "setp xyzab_tdr_kins.z-offset 11\n"
                                    "setp motion.switchkins-type 1\n"},
                      Configuration{"HeadAndTable", "XYZABCUVW", "maxkins", "setp maxkins.pivot-length 180\n", "AUV"},
                      Configuration{"Head", "XYZBCW", "5axiskins", "setp 5axiskins.pivot-length 180\n"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace probewright::testing
