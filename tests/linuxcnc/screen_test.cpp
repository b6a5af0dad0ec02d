#include <regex>

#include "linuxcnc/interpreter_bench.hpp"

/// What LinuxCNC's screen does with a program of ours: the line that runs, steps, a start in the middle, messages; and
/// machines other than three axes in millimetres.
namespace probewright::testing {
namespace {

using ::testing::HasSubstr;

class FromTheScreen : public AsInterpreter {
protected:
  static constexpr const char* words = R"(
def paused(x=None):
    desk.until('a pause', lambda s: s.interp_state == linuxcnc.INTERP_PAUSED and s.inpos)
def where():
    desk.settle()
    return round(desk.status.position[0], 3)
)";
  static constexpr const char* program =
      "N10 G17 G90 G71 G94 G54\nN20 G0 X10 Y10 Z150\nN30 MSG(\"LOOK HERE\")\nN40 G1 X20 F6000\nN50 M0\nN60 G1 "
      "X30\nM30\n";
};

TEST_F(FromTheScreen, AProgramRunsLineByLineAndStartsWhereItIsTold) {
  session_.write("setup.toml", setup("840Dsl", world, 300));
  session_.write("way.mpf", program);
  session_.write("from.mpf",
                 "N10 G17 G90 G71 G94 G54\nN20 G0 X10 Y10 Z150\nN30 G1 X20 F6000\nN40 X60\nN50 X90 F3000\nM30\n");
  session_.write("tnc.toml", setup("TNC640", world, 300));
  session_.write("way.h",
                 "0 BEGIN PGM W MM\n1 L X+10 Y+10 Z+150 R0 FMAX\n2 L X+60 R0 F6000\n3 L X+90 F3000\n4 END PGM W MM\n");
  atTheDesk(std::string(keeps) + words + call(world) + R"(
begin('way.mpf')
paused()
desk.tell('stop', where(), desk.status.motion_line)
desk.command.auto(linuxcnc.AUTO_RESUME)
keep('whole')
desk.tell('end', where())

# From line 5 on: the axes go straight to where line 4 leaves the program.
desk.mdi('G53 G0 X0')
desk.begin('from.mpf', 5)
seen = set()
def look(status):
    if status.current_vel > 0: seen.add(status.motion_line)
    return os.path.exists('out/results.json')
desk.until('results', look)
keep('from')
desk.tell('from', where(), *sorted(seen))

desk.command.program_open('way.mpf')
desk.taken()
desk.mdi('G53 G0 X0')
desk.mode(linuxcnc.MODE_AUTO)
places = [where()]
def quiet(status, seen=[0, None]):
    # No state says that a step has ended: nothing changes for a hundred looks.
    now = (status.interp_state, status.exec_state, status.motion_line, status.inpos, *status.position)
    seen[0] = seen[0] + 1 if now == seen[1] else 0
    seen[1] = now
    return seen[0] > 100
for _ in range(60):
    desk.command.auto(linuxcnc.AUTO_STEP)
    desk.taken()
    desk.until('the step', quiet)
    place = where()
    if place != places[-1]: places.append(place)
    if desk.status.interp_state == linuxcnc.INTERP_IDLE: break
desk.tell('steps', *places)
keep('stepped')

# A HEIDENHAIN program from line 4 on.
shutil.copy('tnc.toml', 'setup.toml')
desk.mdi('G53 G0 X0')
seen = set()
desk.begin('way.h', 4)
desk.until('results', look)
keep('middle')
desk.tell('middle', where(), *sorted(seen))
)");
  EXPECT_EQ(session_.told(output, "stop"), (std::vector<double>{20, 4})) << output;
  EXPECT_EQ(session_.told(output, "end"), (std::vector<double>{30}));
  EXPECT_THAT(output, HasSubstr("desk: message LOOK HERE"));
  EXPECT_EQ(session_.told(output, "from"), (std::vector<double>{90, 5})) << "no line before the fifth moves";
  EXPECT_EQ(session_.told(output, "steps"), (std::vector<double>{0, 10, 20, 30})) << output;
  EXPECT_EQ(session_.told(output, "middle"), (std::vector<double>{90, 4})) << output;
}

TEST_F(FromTheScreen, InchesARotaryAxisSpindleAndCoolantPassThrough) {
  std::string ini = text("mill.ini");
  const auto replace = [&](const std::string& what, const std::string& by) {
    ASSERT_NE(ini.find(what), std::string::npos) << what;
    ini.replace(ini.find(what), what.size(), by);
  };
  // The same machine in inches.
  std::string inches;
  const std::regex length(
      "((?:M..)_LIMIT|MAX_VELOCITY|MAX_ACCELERATION|FERROR|MIN_FERROR|DEFAULT_LINEAR_VELOCITY|"
      "MAX_LINEAR_VELOCITY|MINUS_X|MINUS_Y|RADIUS|TOP) = ([-0-9.]+)");
  std::string::const_iterator from = ini.begin();
  for (std::sregex_iterator at(ini.begin(), ini.end(), length), end; at != end; ++at) {
    inches.append(from, (*at)[0].first);
    inches += (*at)[1].str() + " = " + std::to_string(std::stod((*at)[2].str()) / 25.4);
    from = (*at)[0].second;
  }
  inches.append(from, ini.cend());
  ini = inches;
  replace("LINEAR_UNITS = mm", "LINEAR_UNITS = imperial");
  replace("coordinates=XYZ", "coordinates=XYZA");
  replace("COORDINATES = XYZ\n", "COORDINATES = x y z a\n");
  replace("JOINTS = 3", "JOINTS = 4");
  replace("HALFILE = plate.hal", "HALFILE = plate.hal\nHALFILE = a.hal");
  const std::string turns = "MIN_LIMIT = -360\nMAX_LIMIT = 360\nMAX_VELOCITY = 100\nMAX_ACCELERATION = 1000\n";
  ini += "SHARE_TABLES = 1\nSPINDLE_ORIENTS = 1\n[AXIS_A]\n" + turns +
         "[JOINT_3]\nTYPE = ANGULAR\nFERROR = 5\nMIN_FERROR = 5\nHOME_SEQUENCE = 0\n" + turns;
  session_.write("mill.ini", ini);
  session_.write("a.hal",
                 "net a joint.3.motor-pos-cmd => joint.3.motor-pos-fb\n"
                 "net orient spindle.0.orient => spindle.0.is-oriented\n");
  session_.write("tool.tbl", "T1 P1 D0 Z0\nT2 P2 D0 Z0\n");
  constexpr double feed = 600;
  session_.write("setup.toml", setup("840Dsl", world, feed));
  std::string measuring = sinumerik();
  measuring.insert(measuring.find("M30"),
                   "G0 Z100\nT=\"MILL\"\nM6 D1\nSPOS=75\nM3 S500\nM8\nG0 A30\nM0\nM5 M9\nG0 A0\n");
  session_.write("bore.mpf", measuring);
  atTheDesk(std::string(keeps) + words + R"(
world()" + std::to_string(world.x / 25.4) +
            ", " + std::to_string(world.y / 25.4) + ", " + std::to_string((world.diameter / 2 - ball) / 25.4) + ", " +
            std::to_string((world.top + 100) / 25.4) +
            R"()
begin('bore.mpf')
paused()
desk.tell('state', desk.status.position[3], desk.status.spindle[0]['speed'], desk.status.flood, desk.status.tool_in_spindle,
          look('spindle.0.orient-angle'))
desk.command.auto(linuxcnc.AUTO_RESUME)
keep('done')
desk.status.poll()
desk.tell('after', desk.status.position[3], desk.status.spindle[0]['speed'], desk.status.flood)
desk.mdi('(PRINT,desk: inches #5221 #5222 #5223)')
)");
  const std::vector<double> state = session_.told(output, "state");
  ASSERT_EQ(state.size(), 5U) << output;
  EXPECT_NEAR(state[0], 30, 1e-6);
  EXPECT_EQ(state[1], 500);
  EXPECT_EQ(state[2], 1);
  EXPECT_EQ(state[3], 2);
  EXPECT_EQ(state[4], 75) << "the spindle was oriented";
  EXPECT_EQ(session_.told(output, "after"), (std::vector<double>{0, 0, 0}));
  const std::vector<double> g54 = session_.told(output, "inches");
  ASSERT_EQ(g54.size(), 3U);
  const double bound = feed / 60 * period + 1e-4;
  EXPECT_NEAR(g54[0] * 25.4, world.x, bound);
  EXPECT_NEAR(g54[1] * 25.4, world.y, bound);
  EXPECT_NEAR(g54[2] * 25.4, world.top, bound);
}

}  // namespace
}  // namespace probewright::testing
