#include "linuxcnc/run_bench.hpp"

/// Faults of a real LinuxCNC while a program runs on it from outside.
namespace probewright::testing {
namespace {

using ::testing::StartsWith;

class FaultsOnLinuxCnc : public LinuxCncRun {
protected:
  /// Each run begins with what the setup says.
  FaultsOnLinuxCnc() { session_.write("mill.ini", text("mill.ini") + "[PROBEWRIGHT]\nSHARE_TABLES = 0\n"); }
  World world;
};

/// What goes wrong at the machine, one after the other in one session: each ends in a message, and the next run works.
TEST_F(FaultsOnLinuxCnc, WhateverGoesWrongEndsInAnAlarmAndTheNextRunWorks) {
  // The control knows a tool that LinuxCNC does not have.
  session_.write("setup.toml",
                 setup("TNC640", world, 1200) +
                     "[[tool]]\nnumber = 3\nname = \"DRILL\"\nkind = \"drill\"\nlength = 80\nradius = 4\n");
  session_.write("bore.h", klartext());
  session_.write("top.h", top());
  const auto replaced = [](std::string program, const std::string& what, const std::string& by) {
    program.replace(program.find(what), what.size(), by);
    return program;
  };
  session_.write("limit.h", replaced(klartext(), "X+25 Y+0 Z+8 R0", "X+290 Y+0 Z+8 R0"));
  session_.write("crash.h", replaced(klartext(), "X+25 Y+0 Z+8 R0", "X+25 Y+0 Z-3 R0"));
  session_.write("tool.h", klartext(3));
  session_.write("slow.h", replaced(klartext(), "X+25 Y+0 Z+8 R0 FMAX", "X+200 Y+100 Z+8 R0 F500"));
  atTheDesk(call(world) + R"(
desk.mode(linuxcnc.MODE_MANUAL)
desk.command.teleop_enable(0)
desk.taken()
desk.command.unhome(-1)
desk.until('no zero', lambda s: not any(s.homed[: s.joints]))
ended(desk, 'unhomed', start('bore.h', 'unhomed'))
desk.home()

def works(name):
    still(desk)
    ended(desk, name, start('top.h', name))

ended(desk, 'limit', start('limit.h', 'limit'))
works('after-limit')
ended(desk, 'crash', start('crash.h', 'crash'))
desk.mdi('G53 G0 Z-100')
works('after-crash')
ended(desk, 'tool', start('tool.h', 'tool'))
works('after-tool')

# The part is not there.
hal('below.in1', -240)
ended(desk, 'air', start('bore.h', 'air'))
desk.mdi('G53 G0 Z-100')
)" + call(world) +
                R"(
works('after-air')

# The probe hangs.
hal('signal.in1', 1)
ended(desk, 'hangs', start('bore.h', 'hangs'))
hal('signal.in1', 0)
works('after-hangs')

run = start('bore.h', 'estop')
probing(desk)
desk.command.state(linuxcnc.STATE_ESTOP)
ended(desk, 'estop', run)
ended(desk, 'off', start('bore.h', 'off'))
desk.switch_on()
works('after-estop')

run = start('slow.h', 'abort')
moving(desk)
desk.command.abort()
ended(desk, 'abort', run)
works('after-abort')

run = start('slow.h', 'interrupted')
moving(desk)
run.send_signal(signal.SIGINT)
ended(desk, 'interrupted', run)
still(desk)
desk.tell('then', desk.status.position[0] < 199)
works('after-interrupted')

run = start('slow.h', 'adapter')
moving(desk)
os.kill(adapter(), signal.SIGKILL)
ended(desk, 'adapter', run)
desk.command.abort()
works('after-adapter')

run = start('slow.h', 'killed')
moving(desk)
run.kill()
run.wait()
still(desk)
desk.tell('axes', desk.status.position[0] < 199)
works('after-killed')

run = start('slow.h', 'milltask')
moving(desk)
subprocess.run(['pkill', '-KILL', '-x', 'milltask'])
ended(desk, 'milltask', run)
)",
            500);
  const std::vector<std::pair<std::string, std::string>> ends = {
      {"unhomed", "2 .*the axes of LinuxCNC are not homed"},
      {"limit", "3 .*Limit switch.*software limit of X"},
      {"crash", "3 .*Touch probe deflected.*"},
      {"tool", "3 .*LinuxCNC's tool table has no tool 3"},
      {"air", "3 .*"},
      {"hangs", "3 .*[Dd]eflected"},
      {"estop", "3 .*Machine not ready.*emergency stop"},
      {"off", "2 .*the machine is not ready: LinuxCNC is in emergency stop"},
      {"abort", "3 "},
      {"interrupted", "3 "},
      {"adapter", "3 .*Machine not ready.*the connection to the machine adapter is lost"},
      {"milltask", "3 .*Machine not ready.*LinuxCNC has ended"},
  };
  for (const auto& [name, message] : ends) {
    EXPECT_TRUE(std::regex_search(told(name), std::regex("^" + message))) << name << ": " << told(name);
    if (name != "off" && name != "milltask" && name != "unhomed") {
      EXPECT_THAT(told("after-" + name), StartsWith("0 ")) << "after " << name;
    }
    // No table half written: preset 1 is what it was, or what the cycles that ended wrote.
    if (const std::vector<double> row = preset(name); !row.empty()) {
      EXPECT_EQ(row[0], 0) << name;
      EXPECT_EQ(row[1], 0) << name;
      EXPECT_EQ(row[2], -250) << name;
    }
  }
  EXPECT_THAT(told("then"), StartsWith("True")) << "the axes stop when the program is interrupted";
  EXPECT_THAT(told("axes"), StartsWith("True")) << "the axes stop when the program is gone";
  EXPECT_THAT(told("after-killed"), StartsWith("0 "));
}

}  // namespace
}  // namespace probewright::testing
