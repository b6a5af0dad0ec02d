#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "linuxcnc_simulator/example_mill.hpp"

/// The same bore and the same corner measured on LinuxCNC by G38 macros as people write them and by cycles 412 and 414.
/// docs/linuxcnc.md shows what came out.
namespace probewright::testing {
namespace {

constexpr double bound = within(300);

// The truth: the plate lies here, the ball a little beside the spindle axis.
constexpr double plateX = 1.7, plateY = -0.9, skew = 0.5;
constexpr double tipX = 0.012, tipY = -0.007, pretravel = 0.004;

constexpr const char* world = R"(
[control]
type = "TNC640"
[part]
name = "plate"
pose = { x = 1.7, y = -0.9, z = -270, c = 0.5 }
[[part.feature]]
shape = "box"
size = [80, 60, 20]
[[part.feature]]
shape = "hole"
centre = [0, 0, 20]
diameter = 30.01
[[tool]]
number = 1
name = "PROBE"
kind = "probe"
length = 100
ball_radius = 3
stylus_radius = 1.5
stylus_length = 40
body_radius = 20
body_length = 80
tip_offset = [0.012, -0.007]
pretravel = 0.004
probing_feed = 300
[[preset]]
row = 1
origin = [0, 0, -250]
active = true
)";

constexpr const char* bore412 =
    "0 BEGIN PGM BORE MM\n1 TOOL CALL 1 Z\n2 L X+0 Y+0 Z+50 R0 FMAX\n"
    "3 TCH PROBE 412 PRESET INSIDE CIRCLE ~\n Q321=+0 ~\n Q322=+0 ~\n Q262=+30 ~\n Q325=+0 ~\n Q247=+90 ~\n"
    " Q261=-5 ~\n Q320=+0 ~\n Q260=+10 ~\n Q301=+0 ~\n Q305=+2 ~\n Q331=+0 ~\n Q332=+0 ~\n Q303=+1 ~\n Q381=+0 ~\n"
    " Q382=+0 ~\n Q383=+0 ~\n Q384=+0 ~\n Q333=+0 ~\n Q423=+4 ~\n Q365=+1\n4 L Z+50 R0 FMAX\n"
    "5 END PGM BORE MM\n";
constexpr const char* corner414 =
    "0 BEGIN PGM CORNER MM\n1 TOOL CALL 1 Z\n2 L X-50 Y-50 Z+50 R0 FMAX\n"
    "3 TCH PROBE 414 PRESET OUTSIDE CORNER ~\n Q263=-28 ~\n Q264=-30 ~\n Q326=+40 ~\n Q296=-40 ~\n Q297=-18 ~\n"
    " Q327=+30 ~\n Q261=-5 ~\n Q320=+3 ~\n Q260=+10 ~\n Q301=+0 ~\n Q304=+1 ~\n Q305=+3 ~\n Q331=+0 ~\n Q332=+0 ~\n"
    " Q303=+1 ~\n Q381=+0 ~\n Q382=+0 ~\n Q383=+0 ~\n Q384=+0 ~\n Q333=+0\n4 END PGM CORNER MM\n";

/// Touches between `begin` and `end` of what was printed.
int touches(const std::string& output, const std::string& begin, const std::string& end) {
  int count = 0;
  const std::size_t last = output.find(end);
  for (std::size_t at = output.find(begin); (at = output.find("of tool 1 touched", at + 1)) < last;)
    ++count;
  return count;
}

/// Numbers of a row of the preset table: NO X Y Z SPA SPB SPC.
std::vector<double> preset(const std::filesystem::path& file, int number) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::vector<double> row;
    for (double value = 0; words >> value;)
      row.push_back(value);
    if (row.size() >= 7 && row[0] == number) return row;
  }
  return {};
}

TEST(G38MacrosAndCycles, MeasureTheSameBoreAndCorner) {
  ExampleMill mill;
  if (!mill.feels()) GTEST_SKIP() << ExampleMill::unfelt;
  mill.copyAll();
  mill.leaveInterpreterOut();
  const LinuxCncSession& session = mill.session;
  // The macros leave what they have found in G54: what the cycles begin with is the setup's.
  mill.replace("SETUP = practice.toml", "SETUP = practice.toml\nSHARE_TABLES = 0");
  session.write("practice.toml", world);
  session.write("bore.h", bore412);
  session.write("corner.h", corner414);
  const std::string output = mill.run("PROGRAM = '" + mill.program() + R"('
import subprocess
def timed(name, action):
    desk.tell('begin', name)
    begin = time.monotonic()
    action()
    desk.tell('seconds_' + name, '%.1f' % (time.monotonic() - begin))
    desk.tell('end', name)
def cycle(name):
    ran = subprocess.run([PROGRAM, 'run', name + '.h', '--setup', 'practice.toml', '--machine', 'linuxcnc', '--out',
                          name, '--quiet'])
    desk.tell('exit_' + name, ran.returncode)
desk.ready()
timed('macrobore', lambda: desk.run('bore.ngc'))
timed('macrocorner', lambda: desk.run('corner.ngc'))
timed('cyclebore', lambda: cycle('bore'))
timed('cyclecorner', lambda: cycle('corner'))
)",
                                      500);
  const auto macroBore = line(output, "bore"), macroCorner = line(output, "corner");
  const auto cycleBore = preset(session.outside() / "bore/PRESET.PR", 2);
  const auto cycleCorner = preset(session.outside() / "corner/PRESET.PR", 3);
  ASSERT_EQ(macroBore.size(), 4U) << output;
  ASSERT_EQ(macroCorner.size(), 2U) << output;
  ASSERT_GE(cycleBore.size(), 7U) << output;
  ASSERT_GE(cycleCorner.size(), 7U) << output;
  // The macros know nothing of where the ball is: the bore is off by its offset.
  EXPECT_NEAR(macroBore[0], plateX - tipX, bound);
  EXPECT_NEAR(macroBore[1], plateY - tipY, bound);
  EXPECT_NEAR(cycleBore[1], plateX, bound);
  EXPECT_NEAR(cycleBore[2], plateY, bound);
  // Nor can one touch a side tell that the plate is skewed.
  const double angle = skew * std::numbers::pi / 180;
  const double x = plateX - 40 * std::cos(angle) + 30 * std::sin(angle);
  const double y = plateY - 40 * std::sin(angle) - 30 * std::cos(angle);
  EXPECT_GT(std::hypot(macroCorner[0] - x, macroCorner[1] - y), 0.05);
  // The corner lies 12 and 18 mm outside of the touches: what these are off by grows.
  EXPECT_NEAR(cycleCorner[1], x, 3 * bound) << output;
  EXPECT_NEAR(cycleCorner[2], y, 3 * bound);
  EXPECT_NEAR(cycleCorner[6], skew, 2 * bound / 40 * 180 / std::numbers::pi);
  const auto report = [&](const char* name, const char* key, double dx, double dy) {
    std::printf("%-14s %5.1f s %2d touches, off by %+.4f %+.4f mm\n", name,
                LinuxCncSession::told(output, std::string("seconds_") + key).at(0),
                touches(output, std::string("desk: begin ") + key, std::string("desk: end ") + key), dx, dy);
  };
  report("macro, bore", "macrobore", macroBore[0] - plateX, macroBore[1] - plateY);
  report("cycle 412", "cyclebore", cycleBore[1] - plateX, cycleBore[2] - plateY);
  report("macro, corner", "macrocorner", macroCorner[0] - x, macroCorner[1] - y);
  report("cycle 414", "cyclecorner", cycleCorner[1] - x, cycleCorner[2] - y);
  std::printf("diameter by the macro %.4f, rotation by the cycle %.4f\n", macroBore[2] - macroBore[3] + 6,
              cycleCorner[6]);
}

}  // namespace
}  // namespace probewright::testing
