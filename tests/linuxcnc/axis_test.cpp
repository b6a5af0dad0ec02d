#include <set>

#include "linuxcnc/interpreter_bench.hpp"

/// LinuxCNC's screens open a program, draw it and run it, on a display that nobody sees.
namespace probewright::testing {
namespace {

class OnTheScreen : public AsInterpreter {
protected:
  /// What the screen has drawn of the bore: numbers of moves by the kind of line, the box around them in mm.
  static void expectTheBore(const nlohmann::json& drawn) {
    // Both cycles and the last retraction; the screens do not draw the first move.
    const auto lines = drawn.at("lines").get<std::set<int>>();
    for (const int line : {4, 13, 34})
      EXPECT_TRUE(lines.contains(line)) << line << drawn;
    // The touches of the bore: its wall is 12 mm from its middle for the ball's centre, the first touch lies at X25.
    EXPECT_NEAR(drawn.at("most")[0].get<double>(), 25, 1e-6) << drawn;
    EXPECT_LT(drawn.at("least")[0].get<double>(), -9);
    EXPECT_GT(drawn.at("least")[0].get<double>(), -25);
    EXPECT_GE(drawn.at("most")[2].get<double>(), -250 + 8 + 100);
  }
  /// Python that writes what a canvas of LinuxCNC's screens has drawn to preview.json.
  static constexpr const char* writesDown = R"(
import json
def write_down(canon, **more):
    drawn = {'lines': sorted({line[0] for kind in (canon.feed, canon.traverse) for line in kind}),
             'feed': len(canon.feed), 'traverse': len(canon.traverse),
             'least': [25.4 * x for x in canon.min_extents], 'most': [25.4 * x for x in canon.max_extents], **more}
    with open('preview.part', 'w') as file: json.dump(drawn, file)
    os.rename('preview.part', 'preview.json')
)";
  /// Runs the configuration `ini` on a display that nobody sees; with which DISPLAY, instead of the test's own.
  nlohmann::json show(const std::string& display) {
    std::string ini = text("mill.ini");
    const std::string own = "DISPLAY = ./display.py";
    ini.replace(ini.find(own), own.size(), display + "\nPROGRAM_PREFIX = .\nPOSITION_OFFSET = RELATIVE");
    session_.write("screen.ini", ini);
    // A server tells its parent that it is ready, but not the first process of a namespace.
    output = session_.command("sh -c \"xvfb-run -a -s '-screen 0 1280x960x24' linuxcnc -r screen.ini; true\"", 300);
    return nlohmann::json::parse(text("preview.json"), nullptr, false);
  }
};

class OnTheScreenAxis : public OnTheScreen {
protected:
  /// Opens the program; what AXIS then draws, and says.
  nlohmann::json preview(const std::string& program) {
    session_.write(".axisrc", "import os" + std::string(writesDown) + R"(
def look_at_the_preview(patience=1200):
    if o.canon is None and patience > 0:
        root_window.after(100, look_at_the_preview, patience - 1)
        return
    write_down(o.canon, dialog=int(root_window.tk.call('winfo', 'exists', '.error')),
               shown=root_window.tk.call('.pane.bottom.t.text', 'get', '1.0', '4.0'))
    root_window.tk.call('destroy', '.')
root_window.after(2500, look_at_the_preview)
)");
    return show("DISPLAY = axis\nOPEN_FILE = " + program);
  }
};

TEST_F(OnTheScreenAxis, AProgramIsDrawnAsItRuns) {
  session_.write("setup.toml", setup("TNC640", world, 300));
  session_.write("bore.h", klartext());
  const nlohmann::json drawn = preview("bore.h");
  ASSERT_TRUE(drawn.is_object()) << output;
  EXPECT_EQ(drawn.at("dialog"), 0) << output;
  EXPECT_THAT(drawn.at("shown").get<std::string>(), ::testing::HasSubstr("0 BEGIN PGM BORE MM"));
  expectTheBore(drawn);
}

/// QtVCP's screen QtDragon opens a program at an order from beside, draws it with the command file of
/// linuxcnc/interpreter, and follows while it runs.
TEST_F(OnTheScreen, QtDragonDrawsAProgramAndRunsIt) {
  session_.write("setup.toml", setup("TNC640", world, 1200));
  session_.write("bore.h", klartext());
  session_.write("commands.py", "import os, subprocess, traceback\nfrom PyQt5.QtCore import QTimer\nexec(open('" +
                                    (session_.source() / "linuxcnc/interpreter/probewright_preview.py").string() +
                                    "').read())" + writesDown + R"(
desk = subprocess.Popen(['/usr/bin/python3', 'beside.py'])
def look():
    try:
        canon = self.w.gcodegraphics.canon
        if not os.path.exists('preview.json') and canon is not None and canon.feed:
            write_down(canon, shown=self.w.gcodegraphics._current_file)
    except Exception:
        traceback.print_exc()
    if desk.poll() is not None: os._exit(0)
timer = QTimer()
timer.timeout.connect(look)
timer.start(200)
self.look_at_the_preview = timer
)");
  session_.write("beside.py",
                 "from bench import *\ndesk = Desk()\ndesk.ready()\n" + std::string(keeps) + call(world) + R"(
fresh()
desk.mode(linuxcnc.MODE_AUTO)
desk.command.program_open('bore.h')
desk.taken()
desk.until('a preview', lambda s: os.path.exists('preview.json'))
run('bore.h', 'done')
)");
  const nlohmann::json drawn = show("DISPLAY = qtvcp qtdragon\nUSER_COMMAND_FILE = WORKINGFOLDER/commands.py");
  ASSERT_TRUE(drawn.is_object()) << output;
  EXPECT_THAT(drawn.at("shown").get<std::string>(), ::testing::HasSubstr("bore.h"));
  expectTheBore(drawn);
  const nlohmann::json done = results("done");
  ASSERT_TRUE(done.is_object()) << output;
  EXPECT_EQ(touches(done).size(), 15U);
}

/// Other screens ask for previews without saying which interpreter the configuration has: with the command file of
/// linuxcnc/interpreter they get it all the same.
TEST_F(AsInterpreter, TheCommandFileLetsOtherScreensDraw) {
  std::filesystem::copy(std::filesystem::path(PROBEWRIGHT_SOURCE_DIR) / "tests/linuxcnc/world/canvas.py",
                        session_.outside() / "canvas.py");
  session_.write("setup.toml", setup("TNC640", world, 300));
  session_.write("bore.h", klartext());
  session_.write("plain.ngc", "G21 G90\nG0 X1 Y2 Z3\nG1 X5 F100\nM2\n");
  // As a screen does it, and its command file is run within a function.
  session_.write("screen.py", R"(
import sys
import gcode
from canvas import Canvas
def command(file):
    exec(compile(open(file).read(), file, 'exec'))
def draw(name, file):
    canvas = Canvas()
    result, line = gcode.parse(file, canvas, 'G21', '')
    print('desk:', name, int(result <= gcode.MIN_ERROR), canvas.moves, flush=True)
draw('before', 'bore.h')
command(sys.argv[1])
draw('bore', 'bore.h')
draw('plain', 'plain.ngc')
)");
  output = session_.command("env INI_FILE_NAME=mill.ini /usr/bin/python3 screen.py '" +
                            (session_.source() / "linuxcnc/interpreter/probewright_preview.py").string() + "'");
  const std::vector<double> before = session_.told(output, "before"), bore = session_.told(output, "bore");
  ASSERT_EQ(before.size(), 2U) << output;
  ASSERT_EQ(bore.size(), 2U) << output;
  EXPECT_EQ(before[0], 0) << "then the file is needed no more";
  EXPECT_EQ(bore[0], 1) << output;
  EXPECT_GT(bore[1], 20);
  EXPECT_EQ(session_.told(output, "plain"), (std::vector<double>{1, 2})) << output;
}

}  // namespace
}  // namespace probewright::testing
