#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "linuxcnc_simulator/example_mill.hpp"

/// Programs in plain G-code on a real LinuxCNC whose probe feels a virtual part.
namespace probewright::testing {
namespace {

/// The example's mill with another part and another display.
class Feeling : public ::testing::Test {
protected:
  Feeling() {
    mill_.copyAll();
    mill_.leaveInterpreterOut();
  }

  void SetUp() override {
    if (!mill_.feels()) GTEST_SKIP() << ExampleMill::unfelt;
  }

  std::string run(const std::string& display) { return mill_.run(display); }

  ExampleMill mill_;
  const LinuxCncSession& session_ = mill_.session;
};

constexpr double period = 0.001;       // s
constexpr double feed = 300.0 / 60.0;  // mm/s
constexpr double bound = feed * period + 1e-4;

/// A probe of ball radius 2.5 without errors, 100 mm long, over a block whose faces are known.
constexpr const char* exactWorld = R"(
[part]
name = "block"
pose = { x = 10.25, y = -4.5, z = -280.125 }
[[part.feature]]
shape = "box"
size = [60, 40, 30]
[[tool]]
number = 1
name = "P"
kind = "probe"
length = 100
ball_radius = 2.5
stylus_radius = 1
stylus_length = 40
body_radius = 20
body_length = 60
in_spindle = true
)";

TEST_F(Feeling, ProbesTheTopAndTheSidesOfABlockWhereTheyAre) {
  session_.write("practice.toml", exactWorld);
  session_.write("p.ngc", R"(
G21 G90 G49 G10 L2 P1 X0 Y0 Z0
G0 X40 Y0 Z-149
G38.2 Z-152 F300
(PRINT,desk: top #5063)
G0 Z-149
G0 X44.5
G0 Z-155
G38.2 X41 F300
(PRINT,desk: side #5061)
G0 X46 Y-29
G0 X40
G38.3 Y-25 F300
(PRINT,desk: front #5062 #5070)
G0 Y-29
M2
)");
  const std::string output = run(R"(
import threading
import hal
look = hal.component('look')
look.ready()
latencies = []
going = True
def listen():
    while going:
        latencies.append(hal.get_value('probewright-feel.latency'))
        time.sleep(0.005)
desk.ready()
listener = threading.Thread(target=listen)
listener.start()
desk.run('p.ngc')
going = False
listener.join()
latencies.sort()
desk.tell('latency', *['%.7f' % latencies[len(latencies) * part // 10] for part in (5, 9)])
desk.tell('late', hal.get_value('probewright-feel.late'))
)");
  // Faces: top z = -250.125; x from -19.75 to 40.25; y from -24.5 to 15.5. The tip is 100 mm below the nose.
  const auto top = session_.told(output, "top"), side = session_.told(output, "side"),
             front = session_.told(output, "front");
  ASSERT_EQ(top.size(), 1U) << output;
  ASSERT_EQ(side.size(), 1U) << output;
  ASSERT_EQ(front.size(), 2U) << output;
  EXPECT_NEAR(top[0], -150.125, bound);
  EXPECT_NEAR(side[0], 42.75, bound);
  EXPECT_NEAR(front[0], -27.0, bound);
  EXPECT_EQ(front[1], 1) << "the probe said that it had tripped";
  // An answer takes a small part of the servo period, and none is missed, however long the processes wait for each
  // other on a busy computer.
  const auto latency = session_.told(output, "latency"), late = session_.told(output, "late");
  ASSERT_EQ(latency.size(), 2U) << output;
  ASSERT_EQ(late.size(), 1U) << output;
  EXPECT_EQ(late[0], 0) << output;
  std::smatch answered;
  ASSERT_TRUE(std::regex_search(output, answered,
                                std::regex("answered in ([0-9.]+) microseconds of the processor on average")));
  EXPECT_LT(std::stod(answered[1]) * 1e-6, period / 10);
  std::printf("an answer takes %s microseconds; from question to answer %.0f in the middle, 9 of 10 within %.0f\n",
              answered[1].str().c_str(), 1e6 * latency[0], 1e6 * latency[1]);
  // Never before the contact.
  EXPECT_LE(top[0], -150.125 + 1e-6);
  EXPECT_LE(side[0], 42.75 + 1e-6);
  EXPECT_GE(front[0], -27.0 - 1e-6);
}

TEST_F(Feeling, TurnsTheBallWithTheSpindle) {
  std::string world = exactWorld;
  world.insert(world.find("in_spindle"), "tip_offset = [0.3, 0]\n");
  session_.write("practice.toml", world);
  session_.write("p.ngc", R"(
G21 G90 G49 G10 L2 P1 X0 Y0 Z0
G0 X44.5 Y0
G0 Z-155
M19 R0 Q10
G38.2 X41 F300
(PRINT,desk: upright #5061)
G0 X44.5
M19 R180 Q10
G38.2 X41 F300
(PRINT,desk: reversed #5061)
G0 X46
M2
)");
  const std::string output = run("desk.ready()\ndesk.run('p.ngc')\n");
  const auto upright = session_.told(output, "upright"), reversed = session_.told(output, "reversed");
  ASSERT_EQ(upright.size(), 1U) << output;
  ASSERT_EQ(reversed.size(), 1U) << output;
  // The face lies at X40.25, the ball's centre 0.3 mm aside of the spindle's axis.
  EXPECT_NEAR(upright[0], 42.75 - 0.3, bound);
  EXPECT_NEAR(reversed[0], 42.75 + 0.3, bound);
}

TEST_F(Feeling, SwitchesTheMachineOffInACollisionAndOnAgain) {
  session_.write("practice.toml", exactWorld);
  session_.write("p.ngc", "G21 G90 G49 G10 L2 P1 X0 Y0 Z0\nG0 X80 Y0\nG0 Z-220\nG1 X40 F2000\nM2\n");
  session_.write("q.ngc", "G0 X70\n(PRINT,desk: away #5420)\nM2\n");
  // The body (radius 20, its lower end 42.5 mm above the tip's lowest point) meets the block at X60.25.
  const std::string output = run(R"(
desk.ready()
desk.run('p.ngc')
desk.status.poll()
desk.tell('stopped', desk.status.joint_position[0], desk.status.task_state == linuxcnc.STATE_ON)
desk.command.state(linuxcnc.STATE_ESTOP)
desk.command.wait_complete()
desk.switch_on()
desk.run('q.ngc')
)");
  const auto stopped = session_.told(output, "stopped"), away = session_.told(output, "away");
  ASSERT_EQ(stopped.size(), 1U) << output;  // "False" follows
  EXPECT_NEAR(stopped[0], 60.25, 2000.0 / 60 * 0.002) << output;
  EXPECT_NE(output.find("False"), std::string::npos) << output;
  ASSERT_EQ(away.size(), 1U) << output;
  EXPECT_NEAR(away[0], 70, 1e-6);
}

TEST_F(Feeling, FeelsAPartFromCad) {
  // The top of the housing of the examples is its z = 0; at x = 5, y = 45 of the part nothing is cut into it.
  session_.write("practice.toml", "[part]\nfile = \"" + (session_.source() / "examples/parts/housing.step").string() +
                                      "\"\npose = { x = -20, y = -20, z = -280 }\n" +
                                      std::string(exactWorld).substr(std::string(exactWorld).find("[[tool]]")));
  session_.write("p.ngc", R"(
G21 G90 G49 G10 L2 P1 X0 Y0 Z0
G0 X-15 Y25 Z-150
G38.2 Z-250 F1500
(PRINT,desk: rough #5063)
G91 G0 Z1
G38.2 Z-2 F60
(PRINT,desk: fine #5063)
G90 G0 Z-140
M2
)");
  const std::string output = run("desk.ready()\ndesk.run('p.ngc')\n");
  const auto fine = session_.told(output, "fine");
  ASSERT_EQ(fine.size(), 1U) << output;
  EXPECT_NEAR(fine[0], -180, 60.0 / 60 * 0.001 + 1e-4) << output;
}

}  // namespace
}  // namespace probewright::testing
