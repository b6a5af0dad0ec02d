#include <cmath>

#include "linuxcnc/interpreter_bench.hpp"

/// What LinuxCNC's moves are made with and what its status tells differ after an emergency stop or an abort: the status
/// is told of offsets by messages that wait in line behind the moves, and the line is thrown away. A program that then
/// measures goes by the offsets of the moves, by both ways.
namespace probewright::testing {
namespace {

using ::testing::StartsWith;

constexpr double feed = 600;
constexpr double bound = feed / 60 * 0.001 + 1e-4;  // mm: a servo period at the probing feed

/// Words for the scripts: what the interpreter holds and what the status tells of G54 in X, Y, Z and its rotation.
constexpr const char* looks = R"(
def tell_offsets(name):
    desk.mdi('(PRINT,desk: ' + name + '-held #5221 #5222 #5223 #5230)')
    desk.status.poll()
    desk.tell(name + '-told', *desk.status.g5x_offset[:3], desk.status.rotation_xy)
lowest = [0.0]
def watch(run):
    while run.poll() is None:
        desk.status.poll()
        lowest[0] = min(lowest[0], desk.status.position[2])
        time.sleep(0.002)
)";

/// A program of LinuxCNC's own whose offsets are in line behind a slow move, which `stops` ends.
constexpr const char* queued =
    "G21 G90 G94 G54\nG10 L2 P1 X0 Y0 Z-248 R0\nG53 G0 X0 Y0\nG53 G1 X60 F300\nG10 L2 P1 X0.3 Y-0.2 Z-250.1 R20\n"
    "G92 X3 Z4\nG43.1 Z7\nG53 G1 X61\nM2\n";

std::string stops(const std::string& how) {
  return "desk.begin('queued.ngc')\ndesk.until('the move', lambda s: s.current_vel > 0 and 2 < s.position[0] < 50)\n" +
         how + "\nstill(desk)\ndesk.switch_on()\n";
}
constexpr const char* emergencyStop = "desk.command.state(linuxcnc.STATE_ESTOP)";
constexpr const char* abortion = "desk.command.abort()";

class OffsetsFromOutside : public LinuxCncRun {
protected:
  void measure(const std::string& how) {
    session_.write("setup.toml", setup("TNC640", world, feed));
    session_.write("bore.h", klartext());
    session_.write("queued.ngc", queued);
    atTheDesk(looks + call(world) + stops(how) + R"(
tell_offsets('before')
run = start('bore.h')
watch(run)
ended(desk, 'run', run)
tell_offsets('after')
desk.tell('lowest', lowest[0])
)");
    const std::vector<double> held = session_.told(output, "before-held"),
                              status = session_.told(output, "before-told");
    ASSERT_EQ(held.size(), 4U) << output;
    ASSERT_EQ(status.size(), 4U) << output;
    EXPECT_NEAR(held[2], -250.1, 1e-6);
    EXPECT_NEAR(status[2], -248, 1e-6) << "LinuxCNC tells no longer what it did before: this test tests nothing";
    EXPECT_THAT(told("run"), StartsWith("0 ")) << output;
    const std::vector<double> found = preset("out");
    ASSERT_EQ(found.size(), 3U) << output;
    EXPECT_NEAR(found[0], world.x, bound);
    EXPECT_NEAR(found[1], world.y, bound);
    EXPECT_NEAR(found[2], world.top, bound);
    // The ball's centre goes to 8 mm below the top; the probe is 100 mm long.
    const std::vector<double> lowest = session_.told(output, "lowest");
    ASSERT_EQ(lowest.size(), 1U);
    EXPECT_NEAR(lowest[0], world.top - 8 - ball + 100, 0.01);
    EXPECT_EQ(session_.told(output, "after-held"), session_.told(output, "after-told")) << output;
  }
  World world;
};

TEST_F(OffsetsFromOutside, AreTheOnesOfTheMovesAfterAnEmergencyStop) { measure(emergencyStop); }

TEST_F(OffsetsFromOutside, AreTheOnesOfTheMovesAfterAnAbort) { measure(abortion); }

TEST_F(OffsetsFromOutside, NothingMovesWhereTheyCannotBeSetAnew) {
  session_.write("setup.toml", setup("TNC640", world, feed));
  session_.write("bore.h", klartext());
  atTheDesk(call(world) + R"(
desk.mdi('G41.1 D6')
ended(desk, 'compensated', start('bore.h', 'compensated'))
desk.tell('stands', *desk.status.position[:3])
desk.mdi('G40')
ended(desk, 'run', start('bore.h'))
)");
  EXPECT_TRUE(std::regex_search(told("compensated"), std::regex("^2 .*zero offset.*G10 L2 P0.*cutter radius comp")))
      << told("compensated");
  EXPECT_EQ(session_.told(output, "stands"), (std::vector<double>{0, 0, 0}));
  EXPECT_THAT(told("run"), StartsWith("0 ")) << output;
}

class OffsetsAsInterpreter : public AsInterpreter {};

/// A program of ours has written G54 when it is stopped, while it positions for the next cycle; then another one
/// measures, by both ways.
TEST_F(OffsetsAsInterpreter, AreToldAsTheyAreAfterAStop) {
  std::string believed = setup("TNC640", world, feed);
  const std::string origin = "origin = [0, 0, -250]";
  ASSERT_NE(believed.find(origin), std::string::npos);
  believed.replace(believed.find(origin), origin.size(), "origin = [0, 0, -248]");
  session_.write("setup.toml", believed);
  session_.write("bore.h", klartext());
  atTheDesk(std::string(keeps) + looks + call(world) + R"(
def estop():
    desk.command.state(linuxcnc.STATE_ESTOP)
def command(name):
    estop()
    keep(name)
    desk.switch_on()
def quick(name):
    estop()
    desk.switch_on()
    keep(name)
def chain(name):
    subprocess.run(['halcmd', 'unlinkp', 'iocontrol.0.emc-enable-in'], check=True)
    hal('iocontrol.0.emc-enable-in', 0)
    keep(name)
    subprocess.run(['halcmd', 'net', 'estop-loop', 'iocontrol.0.emc-enable-in'], check=True)
    desk.switch_on()
def abort(name):
    desk.command.abort()
    keep(name)
for stop in (command, quick, chain, abort):
    name = stop.__name__
    desk.mdi('G53 G0 Z-100')
    desk.mdi('G10 L2 P1 X0 Y0 Z-248 R0')
    begin('bore.h')
    desk.until('the way to the top', lambda s: s.current_vel > 0 and s.position[0] > 20)
    desk.until('the touch of cycle 417', lambda s: not s.probing and s.probe_tripped and s.position[2] < -148)
    desk.until('the way to the bore', lambda s: s.current_vel > 0 and s.position[0] < 20)
    stop(name)
    still(desk)
    tell_offsets(name)
    run_outside = start('bore.h', name + '-outside')
    watch(run_outside)
    ended(desk, name + '-outside', run_outside)
run('bore.h', 'inside')
desk.tell('lowest', lowest[0])
)",
            500);
  for (const std::string name : {"command", "quick", "chain", "abort"}) {
    const std::vector<double> held = session_.told(output, name + "-held"),
                              status = session_.told(output, name + "-told");
    ASSERT_EQ(held.size(), 4U) << output;
    EXPECT_NEAR(held[2], world.top, bound) << name << ": cycle 417 has written Z";
    EXPECT_EQ(held, status) << name;
    EXPECT_THAT(told(name + "-outside"), StartsWith("0 ")) << output;
  }
  for (const char* folder : {"command-outside", "quick-outside", "chain-outside", "abort-outside", "inside"}) {
    const std::vector<double> found = preset(folder);
    ASSERT_EQ(found.size(), 3U) << folder << output;
    EXPECT_NEAR(found[0], world.x, bound) << folder;
    EXPECT_NEAR(found[1], world.y, bound) << folder;
    EXPECT_NEAR(found[2], world.top, bound) << folder;
  }
  const std::vector<double> lowest = session_.told(output, "lowest");
  ASSERT_EQ(lowest.size(), 1U) << output;
  EXPECT_NEAR(lowest[0], world.top - 8 - ball + 100, 0.01);
}

/// Offsets of all kinds that a program of LinuxCNC's own has left in line.
TEST_F(OffsetsAsInterpreter, AreTheOnesOfTheMovesAfterLinuxCncsOwnProgram) {
  session_.write("setup.toml", setup("TNC640", world, feed));
  session_.write("bore.h", klartext());
  session_.write("queued.ngc", queued);
  std::string script = std::string(keeps) + looks + call(world);
  for (const auto& [name, how] : {std::pair{"estop", emergencyStop}, std::pair{"abort", abortion}}) {
    script += stops(how) + "tell_offsets('" + name + "')\nrun('bore.h', '" + name +
              "')\ndesk.mdi('G53 G0 Z-100')\ndesk.mdi('G92.1')\ndesk.mdi('G49')\n";
  }
  atTheDesk(script);
  for (const std::string name : {"estop", "abort"}) {
    EXPECT_EQ(session_.told(output, name + "-held"), session_.told(output, name + "-told")) << output;
    const std::vector<double> found = preset(name);
    ASSERT_EQ(found.size(), 3U) << output;
    EXPECT_NEAR(found[0], world.x, bound) << name;
    EXPECT_NEAR(found[1], world.y, bound) << name;
    EXPECT_NEAR(found[2], world.top, bound) << name;
  }
}

/// A servo thread whose functions run in the other order: LinuxCNC's status tells of a move one cycle after it has been
/// handed over, each time.
class LateStatus : public AsInterpreter {
protected:
  LateStatus() {
    const auto replace = [&](const std::string& file, const std::string& what, const std::string& by) {
      std::string all = text(file);
      EXPECT_NE(all.find(what), std::string::npos);
      session_.write(file, all.replace(all.find(what), what.size(), by));
    };
    replace("mill.ini", "SERVO_PERIOD = 1000000", "SERVO_PERIOD = 10000000");
    replace("plate.hal", "addf motion-command-handler servo-thread\naddf motion-controller servo-thread\n",
            "addf motion-controller servo-thread\naddf motion-command-handler servo-thread\n");
  }
};

TEST_F(LateStatus, EndsNoMoveBeforeItHasBegun) {
  constexpr double slow = 120, late = slow / 60 * 0.02 + 1e-4;
  session_.write("setup.toml", setup("TNC640", world, slow));
  session_.write("bore.h", klartext());
  atTheDesk(std::string(keeps) + call(world) + R"(
ended(desk, 'outside', start('bore.h', 'outside'))
desk.mdi('G53 G0 Z-100')
fresh()
run('bore.h', 'inside')
)");
  EXPECT_THAT(told("outside"), StartsWith("0 ")) << output;
  for (const char* folder : {"outside", "inside"}) {
    const std::vector<double> found = preset(folder);
    ASSERT_EQ(found.size(), 3U) << folder << output;
    EXPECT_NEAR(found[0], world.x, late) << folder;
    EXPECT_NEAR(found[1], world.y, late) << folder;
    EXPECT_NEAR(found[2], world.top, late) << folder;
  }
}

}  // namespace
}  // namespace probewright::testing
