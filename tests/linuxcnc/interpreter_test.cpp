#include "linuxcnc/interpreter_bench.hpp"

/// Programs of both languages that LinuxCNC opens and runs itself.
namespace probewright::testing {
namespace {

using ::testing::HasSubstr;

TEST_F(AsInterpreter, RunsBothLanguagesAndLeavesGCodeToLinuxCnc) {
  constexpr double feed = 300;
  const double bound = feed / 60 * period + 1e-4;
  session_.write("bore.h", klartext());
  session_.write("bore.mpf", sinumerik());
  session_.write("setup.toml", setup("840Dsl", world, feed));
  runVirtually("bore.mpf", "virtual-mpf");
  session_.write("mpf.toml", text("setup.toml"));
  session_.write("setup.toml", setup("TNC640", world, feed));
  runVirtually("bore.h", "virtual-h");
  session_.write("plain.ngc",
                 "G21 G90 G94 G55 T1 M6\nG0 X0 Y0 Z-20\nG1 X40 F6000\n(PRINT,desk: plain #5420 #5422)\nM2\n");
  // An active offset of LinuxCNC's own changes nothing of a program of ours, and a program of ours nothing of it.
  atTheDesk(std::string(keeps) + call(world) + R"(
desk.mdi('G10 L2 P2 X10 Y20 Z-30 R15')
desk.mdi('G55')
run('bore.h', 'h')
desk.status.poll()
desk.tell('offset', desk.status.g5x_offset[0], desk.status.g5x_offset[1], desk.status.rotation_xy)
desk.mdi('G0 Z-60')
desk.run('plain.ngc')
desk.status.poll()
desk.tell('place', desk.status.position[0], desk.status.position[2])
desk.mdi('G53 G0 Z0')
fresh()
shutil.copy('mpf.toml', 'setup.toml')
run('bore.mpf', 'mpf')
)",
            300);
  agrees("h", bound);
  agrees("mpf", bound);
  const std::vector<double> found = preset("h");
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(found[0], world.x, bound);
  EXPECT_NEAR(found[1], world.y, bound);
  EXPECT_NEAR(found[2], world.top, bound);
  EXPECT_THAT(told("offset"), HasSubstr("10.0 20.0 15.0"));
  EXPECT_EQ(session_.told(output, "plain"), (std::vector<double>{40, -20}));
  ASSERT_EQ(session_.told(output, "place").size(), 2U) << output;
  EXPECT_NEAR(session_.told(output, "place")[1], -50, 1e-6);
}

/// The program with another text in place of `what`.
std::string with(std::string program, const std::string& what, const std::string& by) {
  program.replace(program.find(what), what.size(), by);
  return program;
}

TEST_F(AsInterpreter, WhateverGoesWrongEndsInAnAlarmAndTheNextRunWorks) {
  session_.write("setup.toml",
                 setup("TNC640", world, 1200) +
                     "[[tool]]\nnumber = 3\nname = \"DRILL\"\nkind = \"drill\"\nlength = 80\nradius = 4\n");
  session_.write("mill.ini", with(text("mill.ini"), "[TRAJ]", "[TRAJ]\nNO_FORCE_HOMING = 1"));
  session_.write("bore.h", klartext());
  session_.write("top.h", top());
  session_.write("limit.h", with(klartext(), "X+25 Y+0 Z+8 R0", "X+290 Y+0 Z+8 R0"));
  session_.write("crash.h", with(klartext(), "X+25 Y+0 Z+8 R0", "X+25 Y+0 Z-3 R0"));
  session_.write("last.h", with(klartext(), "5 L Z+8 R0 FMAX", "5 L X+30 Z-8 R0 F3000"));
  session_.write("slow.h", with(klartext(), "X+25 Y+0 Z+8 R0 FMAX", "X+200 Y+100 Z+8 R0 F500"));
  session_.write("broken.h", with(klartext(), "Q263=+25", "Q999=+25"));
  session_.write("stop.h", with(klartext(), "5 L Z+8 R0 FMAX", "5 STOP\n6 L Z+8 R0 FMAX"));
  session_.write("tool.h", klartext(3));
  session_.write(
      "small.h",
      "0 BEGIN PGM SMALL MM\n1 TOOL CALL 1 Z\n2 TCH PROBE 421 MEASURE HOLE ~\n Q273=+0 ~\n Q274=+0 ~\n Q262=+30 ~\n"
      " Q325=+0 ~\n Q247=+90 ~\n Q261=-8 ~\n Q320=+0 ~\n Q260=+5 ~\n Q301=+0 ~\n Q275=+30.5 ~\n Q276=+30.4 ~\n"
      " Q279=+2 ~\n Q280=+2 ~\n Q281=+0 ~\n Q309=+1 ~\n Q330=+0 ~\n Q423=+4 ~\n Q365=+1\n3 END PGM SMALL MM\n");
  atTheDesk(std::string(keeps) + call(world) + R"(
def works(name):
    still(desk)
    fresh()
    run('top.h', name)
    fresh()

fresh()
run('limit.h', 'limit')
works('after-limit')
run('crash.h', 'crash')
desk.mdi('G53 G0 Z-100')
works('after-crash')
run('last.h', 'last')
desk.mdi('G53 G0 Z-100')
works('after-last')
run('tool.h', 'tool')
works('after-tool')
run('small.h', 'small')
begin('broken.h')
desk.until('its mistake', lambda s: any('Q999' in message for message in desk.messages))
idle()

# The part is not there.
hal('below.in1', -240)
run('bore.h', 'air')
desk.mdi('G53 G0 Z-100')
)" + call(world) +
                R"(
works('after-air')

# The probe hangs.
hal('signal.in1', 1)
run('bore.h', 'hangs')
hal('signal.in1', 0)
works('after-hangs')

begin('bore.h')
probing(desk)
desk.command.state(linuxcnc.STATE_ESTOP)
keep('estop')
desk.switch_on()
works('after-estop')

begin('slow.h')
moving(desk)
desk.command.abort()
keep('abort')
works('after-abort')

begin('slow.h')
moving(desk)
os.kill(engine(), signal.SIGKILL)
idle()
still(desk)
desk.tell('engine', desk.status.position[0] < 199)
works('after-engine')

begin('stop.h')
desk.until('a stop', lambda s: s.interp_state == linuxcnc.INTERP_PAUSED)
desk.command.abort()
keep('dialog')
works('after-dialog')

desk.messages.clear()
begin('stop.h')
desk.until('a stop', lambda s: s.interp_state == linuxcnc.INTERP_PAUSED and desk.messages)
desk.settle()
desk.tell('paused', len(desk.messages), desk.status.motion_line)
desk.command.auto(linuxcnc.AUTO_RESUME)
keep('stop')

# The configuration lets axes move that are not homed.
desk.mode(linuxcnc.MODE_MANUAL)
desk.command.teleop_enable(0)
desk.taken()
desk.until('the joints', lambda s: s.motion_mode == linuxcnc.TRAJ_MODE_FREE)
desk.command.unhome(-1)
desk.until('no homed axis', lambda s: not any(s.homed))
begin('top.h')
desk.until('a refusal', lambda s: any('axes of LinuxCNC are not homed' in message for message in desk.messages))
idle()
desk.tell('refused', 1)
)",
            500);
  const std::vector<std::pair<std::string, std::string>> ends = {
      {"limit", "software limit of X"},
      // It comes with the order after the move, which is that of a touch.
      {"crash", "Stylus already in contact: The stylus is deflected before probing begins: the probe has signalled"},
      {"last", "the probe has signalled on the way"},
      {"tool", "LinuxCNC's tool table has no tool 3"},
      {"air", "Touch point inaccessible"},
      {"small", "Tolerance exceeded: Rework"},
      {"hangs", "deflected"},
      {"estop", "LinuxCNC is in emergency stop"},
      {"abort", ""},
      {"dialog", ""}};
  for (const auto& [name, message] : ends) {
    const nlohmann::json left = results(name);
    ASSERT_TRUE(left.is_object()) << name << "\n" << output;
    EXPECT_THAT(left.dump(), HasSubstr(message)) << name;
    EXPECT_THAT(left.dump(), HasSubstr("\"exit\":{\"code\":3")) << name;
    // No table half written: preset 1 is what it was, or what the cycles that ended wrote.
    const std::vector<double> row = preset(name);
    if (name != "last" && name != "dialog") {
      EXPECT_EQ(row, (std::vector<double>{0, 0, -250})) << name;
    }
    if (name == "small") continue;
    const nlohmann::json next = results("after-" + name);
    ASSERT_TRUE(next.is_object()) << name << "\n" << output;
    EXPECT_EQ(touches(next).size(), 3U) << "after " << name;
  }
  EXPECT_THAT(told("engine"), HasSubstr("True")) << "the axes stop when the engine is gone";
  EXPECT_EQ(touches(results("after-engine")).size(), 3U);
  EXPECT_THAT(output, ::testing::ContainsRegex("desk: message .*Q999")) << "the mistake of the program is shown";
  EXPECT_THAT(told("paused"), ::testing::StartsWith("1 ")) << "the stop is shown once: " << output;
  EXPECT_EQ(touches(results("stop")).size(), 15U);
  EXPECT_EQ(told("refused"), "1") << output;
  // LinuxCNC's screen says what the control's alarm was, also where LinuxCNC itself has stopped.
  for (const char* message : {"Limit switch", "Tolerance exceeded", "Touch probe deflected", "Machine not ready",
                              "Stylus already in contact", "probewright has ended unexpectedly"})
    EXPECT_THAT(output, ::testing::ContainsRegex(std::string("desk: message .*") + message));
}

/// LinuxCNC's planner dies while it runs a program: the program ends with the alarm, and a new LinuxCNC works.
TEST_F(AsInterpreter, ADeadPlannerEndsInAnAlarmAndANewLinuxCncWorks) {
  session_.write("setup.toml", setup("TNC640", world, 1200));
  session_.write("bore.h", klartext());
  session_.write("slow.h", with(klartext(), "X+25 Y+0 Z+8 R0 FMAX", "X+200 Y+100 Z+8 R0 F500"));
  forTheDesk(std::string(keeps) + call(world) + R"(
fresh()
if os.path.exists('dead'):
    run('bore.h', 'new')
else:
    begin('slow.h')
    moving(desk)
    subprocess.run(['pkill', '-KILL', '-x', 'milltask'])
    end = time.monotonic() + 120
    while not os.path.exists('out/results.json') and time.monotonic() < end: time.sleep(0.02)
    os.rename('out', 'dead')
)");
  output = session_.command("sh -c 'linuxcnc -r mill.ini; linuxcnc -r mill.ini'");
  const nlohmann::json dead = results("dead");
  ASSERT_TRUE(dead.is_object()) << output;
  EXPECT_THAT(dead.dump(), HasSubstr("Machine not ready"));
  EXPECT_THAT(dead.dump(), HasSubstr("the connection to the machine adapter is lost"));
  EXPECT_EQ(preset("dead"), (std::vector<double>{0, 0, -250}));
  const nlohmann::json next = results("new");
  ASSERT_TRUE(next.is_object()) << output;
  EXPECT_EQ(touches(next).size(), 15U);
}

}  // namespace
}  // namespace probewright::testing
