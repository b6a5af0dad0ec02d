#include "linuxcnc/interpreter_bench.hpp"

/// Spindle, coolant, tools by hand, M functions and speeds: what a program orders, LinuxCNC has, by both ways.
namespace probewright::testing {
namespace {

class PassThrough : public AsInterpreter, public ::testing::WithParamInterface<bool> {
protected:
  PassThrough() {
    // An operator changes tools, a spindle that can be oriented.
    std::string hal = text("plate.hal");
    const std::string loop = "net change-loop iocontrol.0.tool-change => iocontrol.0.tool-changed\n";
    hal.replace(hal.find(loop), loop.size(), "net orient spindle.0.orient => spindle.0.is-oriented\n");
    session_.write("plate.hal", hal);
    const std::string display = "DISPLAY = ./display.py\n";
    std::string ini = text("mill.ini");
    ini.replace(ini.find(display), display.size(), display + "PROGRAM_PREFIX = .\n");
    session_.write("mill.ini", ini + "SPINDLE_ORIENTS = 1\nSHARE_TABLES = 0\n");
    session_.write("M107", "#!/bin/sh\necho carried out >>m107\n");
    std::filesystem::permissions(session_.outside() / "M107", std::filesystem::perms(0755));
  }
  /// True: LinuxCNC runs the program itself.
  static bool inside() { return GetParam(); }
  /// Words for the desk: starts the program, waits for its end.
  std::string ways() const {
    return std::string(keeps) + call(world) +
           (inside() ? R"(
def starts(program): begin(program)
def ends(name): keep(name)
)"
                     : R"(
running = []
def starts(program): running.append(start(program))
def ends(name):
    ended(desk, name, running.pop())
    os.rename('out', name)
)");
  }
};

TEST_P(PassThrough, SpindleCoolantFunctionsAndToolsByHand) {
  session_.write("setup.toml", setup("840Dsl", world, 300));
  session_.write(
      "all.mpf",
      "N10 G17 G90 G71 G94 G54\nG0 X10 Y10 Z150\nT=\"MILL\"\nM6 D1\nSPOS=75\nM3 S500\nM8\nM107\nG4 F2\nM5 M9\n"
      "M4 S300\nG4 F2\nM5\nM30\n");
  atTheDesk(ways() + R"(
starts('all.mpf')
desk.until('a tool change', lambda s: look('iocontrol.0.tool-change') == 'TRUE')
desk.tell('asked', look('iocontrol.0.tool-prep-number'), desk.status.tool_in_spindle)
hal('iocontrol.0.tool-changed', 1)
desk.until('the new tool', lambda s: look('iocontrol.0.tool-change') == 'FALSE')
hal('iocontrol.0.tool-changed', 0)
desk.until('the spindle', lambda s: s.spindle[0]['speed'] == 500 and s.flood)
desk.tell('forward', desk.status.tool_in_spindle, look('spindle.0.orient-angle'), desk.status.spindle[0]['direction'])
desk.until('no coolant', lambda s: not s.flood and s.spindle[0]['direction'] == -1)
desk.tell('backward', desk.status.spindle[0]['speed'])
ends('done')
desk.until('a spindle that stands', lambda s: s.spindle[0]['direction'] == 0)
desk.tell('stands')
)");
  EXPECT_EQ(session_.told(output, "asked"), (std::vector<double>{2, 0})) << output;
  EXPECT_EQ(session_.told(output, "forward"), (std::vector<double>{2, 75, 1})) << output;
  EXPECT_EQ(session_.told(output, "backward"), (std::vector<double>{-300}));
  EXPECT_EQ(text("m107"), "carried out\n");
  EXPECT_THAT(output, ::testing::HasSubstr("desk: stands"));
}

/// Rapid traverse is that of the configuration, probing that of the probe's row.
TEST_P(PassThrough, NoAxisIsFasterThanConfigurationAndProbeAllow) {
  session_.write("tool.tbl", "T1 P1 D0 Z0\nT2 P2 D0 Z0\n");
  session_.write("setup.toml", setup("TNC640", world, 480));
  session_.write("bore.h", klartext());
  atTheDesk(ways() + R"(
hal('iocontrol.0.tool-changed', 1)
starts('bore.h')
rapid, probed = [0], [0]
def fast(status):
    most = probed if status.motion_type == 5 else rapid
    most[0] = max(most[0], status.current_vel)
    return os.path.exists('out/results.json')
desk.until('results', fast)
ends('done')
desk.tell('fastest', rapid[0], probed[0])
)");
  const std::vector<double> fastest = session_.told(output, "fastest");
  ASSERT_EQ(fastest.size(), 2U) << output;
  // mm/s; each of three axes may have 200, a path 300.
  EXPECT_LE(fastest[0], 300 * 1.001);
  EXPECT_GT(fastest[0], 20);
  EXPECT_NEAR(fastest[1], 480.0 / 60, 0.01);
  EXPECT_EQ(touches(results("done")).size(), 15U) << output;
}

INSTANTIATE_TEST_SUITE_P(ByBothWays, PassThrough, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "AsItsInterpreter" : "FromOutside"; });

}  // namespace
}  // namespace probewright::testing
