#include <set>

#include "linuxcnc/interpreter_bench.hpp"

/// LinuxCNC's screen AXIS opens a program and draws it, on a display that nobody sees.
namespace probewright::testing {
namespace {

class OnTheScreenAxis : public AsInterpreter {
protected:
  /// Opens the program; what AXIS then draws, and says, is in preview.json: numbers of moves by the kind of line, the
  /// box around them in mm.
  nlohmann::json preview(const std::string& program) {
    std::string ini = text("mill.ini");
    const std::string display = "DISPLAY = ./display.py";
    ini.replace(ini.find(display), display.size(),
                "DISPLAY = axis\nOPEN_FILE = " + program + "\nPROGRAM_PREFIX = .\nPOSITION_OFFSET = RELATIVE");
    session_.write("axis.ini", ini);
    session_.write(".axisrc", R"(
import json
def look_at_the_preview(patience=1200):
    if o.canon is None and patience > 0:
        root_window.after(100, look_at_the_preview, patience - 1)
        return
    drawn = {'lines': sorted({line[0] for kind in (o.canon.feed, o.canon.traverse) for line in kind}),
             'feed': len(o.canon.feed), 'traverse': len(o.canon.traverse),
             'least': [25.4 * x for x in o.canon.min_extents], 'most': [25.4 * x for x in o.canon.max_extents],
             'dialog': int(root_window.tk.call('winfo', 'exists', '.error')),
             'shown': root_window.tk.call('.pane.bottom.t.text', 'get', '1.0', '4.0')}
    json.dump(drawn, open('preview.json', 'w'))
    root_window.tk.call('destroy', '.')
root_window.after(2500, look_at_the_preview)
)");
    // A server tells its parent that it is ready, but not the first process of a namespace.
    output = session_.command("sh -c \"xvfb-run -a -s '-screen 0 1280x960x24' linuxcnc -r axis.ini; true\"", 200);
    return nlohmann::json::parse(text("preview.json"), nullptr, false);
  }
};

TEST_F(OnTheScreenAxis, AProgramIsDrawnAsItRuns) {
  session_.write("setup.toml", setup("TNC640", world, 300));
  session_.write("bore.h", klartext());
  const nlohmann::json drawn = preview("bore.h");
  ASSERT_TRUE(drawn.is_object()) << output;
  EXPECT_EQ(drawn.at("dialog"), 0) << output;
  EXPECT_THAT(drawn.at("shown").get<std::string>(), ::testing::HasSubstr("0 BEGIN PGM BORE MM"));
  // Both cycles and the last retraction; AXIS does not draw the first move.
  const auto lines = drawn.at("lines").get<std::set<int>>();
  for (const int line : {4, 13, 34})
    EXPECT_TRUE(lines.contains(line)) << line << drawn;
  // The touches of the bore: its wall is 12 mm from its middle for the ball's centre, the first touch lies at X25.
  EXPECT_NEAR(drawn.at("most")[0].get<double>(), 25, 1e-6) << drawn;
  EXPECT_LT(drawn.at("least")[0].get<double>(), -9);
  EXPECT_GT(drawn.at("least")[0].get<double>(), -25);
  EXPECT_GE(drawn.at("most")[2].get<double>(), -250 + 8 + 100);
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
