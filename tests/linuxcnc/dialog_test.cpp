#include "linuxcnc/interpreter_bench.hpp"

/// What a control asks its operator, as LinuxCNC shows it: texts with a wait for cycle start, and a window for answers.
namespace probewright::testing {
namespace {

using ::testing::HasSubstr;

class AsksTheOperator : public AsInterpreter {
protected:
  /// A plane whose first point the operator is asked for; the part is lower than the drawing allows.
  static constexpr const char* program =
      "0 BEGIN PGM ASK MM\n1 TOOL CALL 1 Z\n2 L X+25 Y+0 Z+8 R0 FMAX\n3 TCH PROBE 1420 PROBING IN PLANE ~\n"
      " QS1100=\"?25\" ~\n QS1101=\"?0\" ~\n QS1102=\"?0\" ~\n Q1103=-25 ~\n Q1104=+0 ~\n QS1105=\"0+-0.1\" ~\n"
      " Q1106=+0 ~\n Q1107=+25 ~\n Q1108=+0 ~\n Q372=-3 ~\n Q320=+0 ~\n Q260=+8 ~\n Q1125=+0 ~\n Q309=+1 ~\n"
      " Q1126=+0 ~\n Q1120=+1 ~\n Q1121=+0\n4 L Z+8 R0 FMAX\n5 END PGM ASK MM\n";
  /// LinuxCNC with a screen, on a display that nobody sees.
  void atTheScreen(const std::string& script) {
    forTheDesk(script);
    output = session_.command("sh -c \"xvfb-run -a -s '-screen 0 1280x960x24' linuxcnc -r mill.ini; true\"", 200);
  }
};

TEST_F(AsksTheOperator, InAWindowAndByCycleStart) {
  session_.write("setup.toml", setup("TNC640", world, 600));
  session_.write("ask.h", program);
  session_.write("bore.h", klartext());
  atTheScreen(std::string(keeps) + call(world) + R"(
import tkinter
screen = tkinter.Tk()
def window(*words, seconds=60):
    end = time.monotonic() + seconds
    while True:
        try: return screen.tk.call('send', 'probewright-dialog', *words)
        except tkinter.TclError as error:
            if time.monotonic() > end: raise
        desk.until('a look', lambda s: True)
        time.sleep(0.05)
def windows():
    return sum('probewright-dialog' in str(name) for name in screen.tk.splitlist(screen.tk.call('winfo', 'interps')))
def asked(seconds=60):
    desk.until('a stop', lambda s: s.interp_state == linuxcnc.INTERP_PAUSED)
    desk.settle()
    desk.command.auto(linuxcnc.AUTO_RESUME)

fresh()
begin('ask.h')
asked()
desk.tell('title', window('wm', 'title', '.'))
window('.answer', 'insert', '0', '{over there}')
window('.buttons.continue', 'invoke')
# It is not a position: the question comes again.
desk.until('the question once more', lambda s: 'over there' in str(window('.wanted', 'cget', '-text')))
window('.answer', 'insert', '0', '{25 0 5}')
window('.buttons.continue', 'invoke')
asked()
keep('answered')

fresh()
begin('ask.h')
asked()
window('.buttons.cancel', 'invoke')
keep('cancelled')

fresh()
begin('ask.h')
asked()
window('wm', 'title', '.')
desk.command.abort()
keep('aborted')
end = time.monotonic() + 30
while windows() and time.monotonic() < end: time.sleep(0.05)
desk.tell('left', windows())
fresh()
run('bore.h', 'after')
)");
  EXPECT_EQ(told("title"), "Probewright: 1420 point 1") << output;
  EXPECT_THAT(output, HasSubstr("desk: message 1420 point 1: move the probe in front of the point"));
  EXPECT_THAT(output, HasSubstr("desk: message Tolerance exceeded: scrap"));
  EXPECT_THAT(output, HasSubstr("Position 3, tool axis: nominal 0.0000, actual -0.2")) << "to its end";
  const nlohmann::json answered = results("answered");
  ASSERT_TRUE(answered.is_object()) << output;
  EXPECT_THAT(answered.dump(), HasSubstr("\"exit\":{\"code\":1")) << "it ran to its end, the part is out of tolerance";
  const std::vector<double> felt = touches(answered), found = preset("answered");
  ASSERT_EQ(felt.size(), 9U) << output;
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(felt[0], 25, 1e-4) << "where the operator has put the probe";
  EXPECT_NEAR(found[2], world.top, 600.0 / 60 * period + 1e-4);
  for (const char* name : {"cancelled", "aborted"}) {
    const nlohmann::json ended = results(name);
    ASSERT_TRUE(ended.is_object()) << name << "\n" << output;
    EXPECT_THAT(ended.dump(), HasSubstr("\"exit\":{\"code\":3")) << name;
    EXPECT_EQ(touches(ended).size(), 0U) << name;
    EXPECT_EQ(preset(name), (std::vector<double>{0, 0, -250})) << name;
  }
  EXPECT_THAT(output, HasSubstr("the program stopped here and was not continued"));
  EXPECT_EQ(session_.told(output, "left"), (std::vector<double>{0})) << "the window closes";
  EXPECT_EQ(touches(results("after")).size(), 15U);
}

/// Without a screen nobody can be asked: what the setup does not know ends in words.
TEST_F(AsksTheOperator, NobodyWhereThereIsNoScreen) {
  session_.write("setup.toml", setup("TNC640", world, 600));
  session_.write("ask.h", program);
  session_.write("known.toml", setup("TNC640", world, 600) + "[answers]\n\"1420 point 1\" = \"25 0 5\"\n");
  atTheDesk(std::string(keeps) + call(world) + R"(
def goOn():
    desk.until('a stop', lambda s: s.interp_state == linuxcnc.INTERP_PAUSED)
    desk.settle()
    desk.command.auto(linuxcnc.AUTO_RESUME)
fresh()
begin('ask.h')
goOn()
keep('unknown')
shutil.copy('known.toml', 'setup.toml')
fresh()
begin('ask.h')
goOn()
goOn()
keep('known')
)");
  EXPECT_THAT(results("unknown").dump(), HasSubstr("No answer says where the probe is to be for 1420 point 1"))
      << output;
  EXPECT_THAT(output, HasSubstr("Semi-automatic probing without operator"));
  EXPECT_EQ(touches(results("known")).size(), 9U) << output;
}

}  // namespace
}  // namespace probewright::testing
