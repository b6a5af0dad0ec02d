#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "linuxcnc/interpreter_bench.hpp"

/// A contour of short lines through Probewright's interpreter and through LinuxCNC's own, on the same machine: how long
/// it takes, and how late servo cycles begin meanwhile. With PROBEWRIGHT_LONG_TESTS, as a busy computer proves nothing.
namespace probewright::testing {
namespace {

constexpr int lines = 6000;
constexpr double radius = 30, pitch = 0.1;  // mm

TEST_F(AsInterpreter, ShortLinesTakeNoLongerThanThroughLinuxCncsOwnInterpreter) {
  if (std::getenv("PROBEWRIGHT_LONG_TESTS") == nullptr) GTEST_SKIP() << "set PROBEWRIGHT_LONG_TESTS to run it";
  session_.write("setup.toml", setup("TNC640", world, 300));
  std::string klartext = "0 BEGIN PGM WAY MM\n1 TOOL CALL 1 Z\n2 L X+30 Y+0 Z+100 R0 FMAX\n";
  std::string gcode = "G21 G90 G94 G53 G0 Z-50 X30 Y0\nG64 P0.01\nG49 G10 L2 P1 X0 Y0 Z0\n";
  for (int i = 0; i < lines; ++i) {
    const double x = radius * std::cos(i * pitch / radius), y = radius * std::sin(i * pitch / radius);
    const char* feed = i == 0 ? " F6000" : "";
    klartext += fmt::format("{} L X{:+.4f} Y{:+.4f}{}\n", i + 3, x, y, feed);
    gcode += fmt::format("G1 X{:.4f} Y{:.4f}{}\n", x, y, feed);
  }
  session_.write("way.h", klartext + fmt::format("{} END PGM WAY MM\n", lines + 3));
  session_.write("way.ngc", gcode + "M2\n");
  // Each servo cycle is written down.
  std::string ini = text("mill.ini");
  ini.replace(ini.find("HALFILE = plate.hal"), 19, "HALFILE = plate.hal\nHALFILE = late.hal");
  session_.write("mill.ini", ini);
  session_.write("late.hal",
                 "loadrt sampler depth=4000 cfg=u\naddf sampler.0 servo-thread\n"
                 "net late motion.servo.last-period => sampler.0.pin.0\n");
  atTheDesk(std::string(keeps) + call(world) + R"(
hal('below.in1', -1000)
taken = {'way.h': [], 'way.ngc': []}
late = {'way.h': [], 'way.ngc': []}
for turn in range(6):
    name = ('way.h', 'way.ngc')[turn % 2]
    shutil.rmtree('out', ignore_errors=True)
    cycles = open('cycles', 'w')
    sampler = subprocess.Popen(['halsampler'], stdout=cycles)
    moved = []
    def look(status):
        if status.current_vel > 0 and status.motion_line > 10: moved.append(time.monotonic())
        return status.interp_state == linuxcnc.INTERP_IDLE and status.inpos
    began = time.monotonic()
    begin(name)
    desk.until('the end', look)
    taken[name].append((moved[-1] - moved[0], time.monotonic() - began))
    sampler.send_signal(signal.SIGINT)
    sampler.wait()
    # What was written down before the first run comes with it.
    if turn > 1: late[name] += [int(line) for line in open('cycles') if line.strip().isdigit()]
normal = sorted(late['way.ngc'])[len(late['way.ngc']) // 2]
for name, short in (('way.h', 'ours'), ('way.ngc', 'own')):
    longest = max(late[name]) / normal
    desk.tell(short, '%.2f %.2f %d %d %.2f' % (*min(taken[name]), len(late[name]), sum(x > 1.5 * normal for x in late[name]), longest))
)",
            500);
  const std::vector<double> ours = session_.told(output, "ours"), own = session_.told(output, "own");
  ASSERT_EQ(ours.size(), 5U) << output;
  ASSERT_EQ(own.size(), 5U) << output;
  EXPECT_LE(ours[0], own[0] * 1.02);
  for (const auto& [name, told] : {std::pair{"Probewright", ours}, std::pair{"LinuxCNC", own}})
    std::printf(
        "%-12s %5.2f s from line to line, %5.2f s in all; %6.0f servo cycles, %3.0f of them began half a period "
        "late, the latest %.2f periods\n",
        name, told[0], told[1], told[2], told[3], told[4]);
}

}  // namespace
}  // namespace probewright::testing
