#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "linuxcnc/interpreter_bench.hpp"

/// Programs of a million blocks: how long LinuxCNC's screens take to load one, and how much memory it needs while it is
/// drawn and while it runs.
namespace probewright::testing {
namespace {

class MillionBlocks : public AsInterpreter {
protected:
  void SetUp() override { session_.write("setup.toml", setup("TNC640", world, 300)); }
  /// A spiral of short lines; how many bytes it has.
  std::size_t way(const std::string& name, int blocks) const {
    std::string text = "0 BEGIN PGM WAY MM\n1 TOOL CALL 1 Z\n2 L X+30 Y+0 Z+100 R0 FMAX\n";
    for (int i = 0; i < blocks; ++i) {
      const double angle = i / 300.0;
      text += fmt::format("{} L X{:+.4f} Y{:+.4f}{}\n", i + 3, 30 * std::cos(angle), 30 * std::sin(angle),
                          i == 0 ? " F240000" : "");
    }
    session_.write(name, text += fmt::format("{} END PGM WAY MM\n", blocks + 3));
    return text.size();
  }
};

/// What a screen does when it opens a program, with a canvas that only counts. Tells moves, seconds, seconds of the
/// processor in the screen and in the engine, and the most memory of both, MB.
constexpr const char* preview = R"(
import os, sys, threading, time
sys.setdlopenflags(os.RTLD_NOW | os.RTLD_GLOBAL)
import gcode
from canvas import Canvas
def most(process):
    with open(f'/proc/{process}/status') as lines:
        return next(int(line.split()[1]) / 1024 for line in lines if line.startswith('VmHWM'))
engine = [0]
def watch():
    while True:
        for process in filter(str.isdigit, os.listdir('/proc')):
            try:
                with open(f'/proc/{process}/comm') as name:
                    if name.read().strip() == 'probewright': engine[0] = max(engine[0], most(process))
            except (OSError, StopIteration): pass
        time.sleep(0.05)
threading.Thread(target=watch, daemon=True).start()
canvas, began = Canvas(), time.monotonic()
result, line = gcode.parse(sys.argv[1], canvas, 'G21', '', sys.argv[2])
seconds, used = time.monotonic() - began, os.times()
print('desk: loaded', canvas.moves, '%.2f %.2f %.2f %.0f %.0f' % (seconds, used[0] + used[1], used[2] + used[3],
      most(os.getpid()), engine[0]))
)";

TEST_F(MillionBlocks, LoadInSecondsAndNeedNoMemoryButForTheirText) {
  session_.write("preview.py", preview);
  std::filesystem::copy(std::filesystem::path(PROBEWRIGHT_SOURCE_DIR) / "tests/linuxcnc/world/canvas.py",
                        session_.outside() / "canvas.py");
  const auto load = [&](const std::string& program) {
    return session_.told(
        session_.command("env INI_FILE_NAME=mill.ini /usr/bin/python3 preview.py " + program + " '" +
                         (session_.build() / "linuxcnc/interpreter/libprobewright_interp.so").string() + "'"),
        "loaded");
  };
  const double few = static_cast<double>(way("few.h", 100'000)), many = static_cast<double>(way("many.h", 1'000'000));
  const std::vector<double> small = load("few.h"), large = load("many.h");
  ASSERT_EQ(small.size(), 6U);
  ASSERT_EQ(large.size(), 6U);
  EXPECT_EQ(small[0], 100'000);
  EXPECT_EQ(large[0], 1'000'000);
  // Seconds of the processor: both work at the same time, so that this is what it takes where both have one.
  EXPECT_LT(std::max(large[2], large[3]), 5);
  EXPECT_LT(large[4], small[4] + 2) << "MB in the screen";
  EXPECT_LT(large[5], small[5] + 4 * (many - few) / 1e6) << "MB in the engine";
  std::printf(
      "a million blocks: %.2f s, of the processor %.2f s in the screen and %.2f s in the engine; "
      "%.0f and %.0f MB, of a tenth of it %.0f and %.0f MB\n",
      large[1], large[2], large[3], large[4], large[5], small[4], small[5]);
}

TEST_F(MillionBlocks, RunInTheSameMemory) {
  way("many.h", 1'000'000);
  fastAxes();
  atTheDesk(std::string(keeps) + call(world) + R"(
def memory(process):
    with open(f'/proc/{process}/status') as lines:
        return next(int(line.split()[1]) / 1024 for line in lines if line.startswith('RssAnon'))
hal('below.in1', -1000)
begin('many.h')
# Not what the start has needed, nor pages of the program's file.
desk.until('a start', lambda s: s.motion_line > 100000)
planner = subprocess.run(['pgrep', '-x', 'milltask'], capture_output=True, text=True).stdout.split()[0]
before = memory(planner), memory(engine())
desk.until('blocks', lambda s: s.motion_line > 400000)
desk.tell('grown', memory(planner) - before[0], memory(engine()) - before[1], *before)
desk.command.abort()
written()
)",
            500);
  const std::vector<double> grown = session_.told(output, "grown");
  ASSERT_EQ(grown.size(), 4U) << output;
  // MB for 300,000 blocks, of which ten bytes each would be 3.
  EXPECT_LT(grown[0], 1);
  EXPECT_LT(grown[1], 1);
  std::printf("300,000 blocks: LinuxCNC's planner grows by %.2f MB from %.0f, the engine by %.2f from %.0f\n", grown[0],
              grown[2], grown[1], grown[3]);
}

}  // namespace
}  // namespace probewright::testing
