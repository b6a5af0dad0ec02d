#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "linuxcnc/interpreter_bench.hpp"

/// A contour of short lines through Probewright's interpreter and through LinuxCNC's own, on the same machine: how many
/// blocks pass in a second, how long a contour takes, and what the servo thread has to do meanwhile.
namespace probewright::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class ShortLines : public AsInterpreter {
protected:
  /// The same contour as way.h and way.ngc.
  void contour(int lines, double pitch, double perMinute) const {
    constexpr double radius = 30;
    std::string klartext = "0 BEGIN PGM WAY MM\n1 TOOL CALL 1 Z\n2 L X+30 Y+0 Z+100 R0 FMAX\n";
    std::string gcode = "G21 G90 G94 G53 G0 Z-50 X30 Y0\nG64 P0.01\nG49 G10 L2 P1 X0 Y0 Z0\n";
    for (int i = 0; i < lines; ++i) {
      const double x = radius * std::cos(i * pitch / radius), y = radius * std::sin(i * pitch / radius);
      const std::string feed = i == 0 ? fmt::format(" F{:.0f}", perMinute) : "";
      klartext += fmt::format("{} L X{:+.4f} Y{:+.4f}{}\n", i + 3, x, y, feed);
      gcode += fmt::format("G1 X{:.4f} Y{:.4f}{}\n", x, y, feed);
    }
    session_.write("setup.toml", setup("TNC640", world, 300));
    session_.write("way.h", klartext + fmt::format("{} END PGM WAY MM\n", lines + 3));
    session_.write("way.ngc", gcode + "M2\n");
  }
  /// Words for the desk: runs a program, tells seconds from the first line to the last and from cycle start to the end.
  static constexpr const char* timed = R"(
def timed(name):
    shutil.rmtree('out', ignore_errors=True)
    moved = []
    def look(status):
        if status.current_vel > 0 and status.motion_line > 10: moved.append(time.monotonic())
        return status.interp_state == linuxcnc.INTERP_IDLE and status.inpos
    began = time.monotonic()
    begin(name)
    desk.until('the end', look)
    return moved[-1] - moved[0], time.monotonic() - began
hal('below.in1', -1000)
)";
};

/// On axes that are faster than any program: LinuxCNC's planner is all that counts. Both take turns until the best of
/// ours is as good as the best of the other, as whatever else the computer does only makes them slower. That nothing of
/// this is luck, the processor's time in LinuxCNC's planner tells.
TEST_F(ShortLines, PassAsFastAsThroughLinuxCncsOwnInterpreter) {
  constexpr int lines = 60'000;
  contour(lines, 0.02, 240'000);
  fastAxes();
  atTheDesk(std::string(keeps) + timed + R"(
from statistics import median
planner = subprocess.run(['pgrep', '-x', 'milltask'], capture_output=True, text=True).stdout.split()[0]
def used():
    with open(f'/proc/{planner}/stat') as file: words = file.read().split(')')[-1].split()
    return [(int(words[own]) + int(words[own + 1])) / os.sysconf('SC_CLK_TCK') for own in (11, 13)]
def both(name):
    idle()
    before = used()
    seconds = timed(name)[0]
    if name == 'way.h': desk.until('the end of the engine', lambda s: used()[1] > before[1])
    return seconds, *(now - then for now, then in zip(used(), before))
ours, own = [], []
while len(ours) < 10 and not (len(ours) > 2 and min(ours)[0] <= min(own)[0]):
    ours.append(both('way.h'))
    own.append(both('way.ngc'))
desk.tell('best', min(ours)[0], min(own)[0], len(ours))
desk.tell('medians', *(median(run[i] for run in runs) for i in range(3) for runs in (ours, own)))
)",
            500);
  const std::vector<double> best = session_.told(output, "best"), medians = session_.told(output, "medians");
  ASSERT_EQ(best.size(), 3U) << output;
  ASSERT_EQ(medians.size(), 6U) << output;
  EXPECT_LT(medians[2], medians[3]) << "s of the processor in LinuxCNC's planner for " << lines << " blocks";
  // On a busy computer ours has another process that wants a processor.
  const bool calm = std::getenv("PROBEWRIGHT_LONG_TESTS") != nullptr;
  EXPECT_LE(best[0], best[1] * (calm ? 1 : 1.2)) << "s for " << lines << " blocks, the best of " << best[2];
  std::printf(
      "blocks a second: %.0f through Probewright, %.0f through LinuxCNC's own interpreter, the best of %.0f (in the "
      "middle %.0f and %.0f); of the processor %.2f s in the planner and %.2f s in the engine, against %.2f s\n",
      lines / best[0], lines / best[1], best[2], lines / medians[0], lines / medians[1], medians[2], medians[4],
      medians[3]);
}

/// What LinuxCNC does in each servo cycle while a program of ours runs: nothing of ours is among it, so that it cannot
/// make a cycle late.
TEST_F(ShortLines, AddNothingToTheServoThread) {
  contour(3000, 0.1, 6000);
  atTheDesk(std::string(keeps) + timed + R"(
def realtime():
    thread = subprocess.run(['halcmd', 'show', 'thread'], capture_output=True, text=True).stdout
    parts = subprocess.run(['halcmd', 'show', 'comp'], capture_output=True, text=True).stdout
    functions = [words[1] for words in map(str.split, thread.split('\n')) if len(words) == 2 and words[0].isdigit()]
    return functions, sorted(words[2] for words in map(str.split, parts.split('\n')) if len(words) > 2 and words[1] == 'RT')
def during(name):
    begin(name)
    desk.until('its lines', lambda s: s.motion_line > 100)
    found = realtime()
    desk.tell(name, *found[0], *found[1])
    desk.command.abort()
    idle()
during('way.ngc')
during('way.h')
written()
)");
  EXPECT_THAT(told("way.h"), HasSubstr("motion-controller")) << output;
  EXPECT_EQ(told("way.h"), told("way.ngc"));
  EXPECT_THAT(told("way.h"), Not(HasSubstr("probewright")));
}

TEST_F(ShortLines, TakeNoLongerThanThroughLinuxCncsOwnInterpreter) {
  if (std::getenv("PROBEWRIGHT_LONG_TESTS") == nullptr) GTEST_SKIP() << "set PROBEWRIGHT_LONG_TESTS to run it";
  contour(6000, 0.1, 6000);
  // Each servo cycle is written down: when it began after the one before, and how long its functions took.
  std::string ini = text("mill.ini");
  ini.replace(ini.find("HALFILE = plate.hal"), 19, "HALFILE = plate.hal\nHALFILE = late.hal");
  session_.write("mill.ini", ini);
  session_.write("late.hal",
                 "loadrt sampler depth=4000 cfg=us\naddf sampler.0 servo-thread\n"
                 "net late motion.servo.last-period => sampler.0.pin.0\n"
                 "net lasts motion-controller.time => sampler.0.pin.1\n");
  atTheDesk(std::string(keeps) + timed + R"(
taken = {'way.h': [], 'way.ngc': []}
late = {'way.h': [], 'way.ngc': []}
lasts = {'way.h': [], 'way.ngc': []}
for turn in range(6):
    name = ('way.h', 'way.ngc')[turn % 2]
    cycles = open('cycles', 'w')
    sampler = subprocess.Popen(['halsampler'], stdout=cycles)
    taken[name].append(timed(name))
    sampler.send_signal(signal.SIGINT)
    sampler.wait()
    # What was written down before the first run comes with it.
    for line in open('cycles') if turn > 1 else ():
        words = line.split()
        if len(words) == 2 and words[0].isdigit():
            late[name].append(int(words[0]))
            lasts[name].append(int(words[1]))
normal = sorted(late['way.ngc'])[len(late['way.ngc']) // 2]
for name, short in (('way.h', 'ours'), ('way.ngc', 'own')):
    longest = max(late[name]) / normal
    lasts[name].sort()
    middle, most = (1000 * lasts[name][int(len(lasts[name]) * part)] / normal for part in (0.5, 0.99))
    desk.tell(short, '%.2f %.2f %d %d %.2f %.2f %.2f' % (*min(taken[name]), len(late[name]), sum(x > 1.5 * normal for x in late[name]), longest, middle, most))
)",
            500);
  const std::vector<double> ours = session_.told(output, "ours"), own = session_.told(output, "own");
  ASSERT_EQ(ours.size(), 7U) << output;
  ASSERT_EQ(own.size(), 7U) << output;
  EXPECT_LE(ours[0], own[0] * 1.02);
  for (const auto& [name, told] : {std::pair{"Probewright", ours}, std::pair{"LinuxCNC", own}})
    std::printf(
        "%-12s %5.2f s from line to line, %5.2f s in all; %6.0f servo cycles, %3.0f of them began half a period "
        "late, the latest %.2f periods; the motion controller takes %.2f us in the middle, %.2f us in 99 of 100\n",
        name, told[0], told[1], told[2], told[3], told[4], told[5], told[6]);
}

}  // namespace
}  // namespace probewright::testing
