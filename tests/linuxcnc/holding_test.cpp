#include "linuxcnc/interpreter_bench.hpp"

/// Pause, feed hold and override of LinuxCNC hold for programs of ours as for its own.
namespace probewright::testing {
namespace {

using ::testing::StartsWith;

class HeldByTheOperator : public AsInterpreter {
protected:
  /// A long move at 500 mm/min, and words for what is done to it.
  std::string script() const {
    session_.write("setup.toml", setup("TNC640", world, 1200));
    std::string slow = klartext();
    const std::string fast = "X+25 Y+0 Z+8 R0 FMAX";
    slow.replace(slow.find(fast), fast.size(), "X+200 Y+100 Z+8 R0 F500");
    session_.write("slow.h", slow);
    return std::string(keeps) + call(world) + R"(
def held(name):
    desk.until('a stand', lambda s: s.current_vel == 0)
    place = list(desk.status.position[:3])
    for _ in range(50): desk.until('a look', lambda s: True)
    desk.settle()
    desk.tell(name, *(now - then for now, then in zip(desk.status.position, place)))
def goes(name, least, most):
    desk.until(name, lambda s: least < s.current_vel * 60 < most)
    desk.tell(name, 'mm/min', round(desk.status.current_vel * 60))
def feedHoldAndOverride():
    moving(desk)
    goes('programmed', 499, 501)
    hal('motion.feed-hold', 1)
    held('feedhold')
    hal('motion.feed-hold', 0)
    desk.command.feedrate(0.5)
    goes('override', 249, 251)
    desk.command.feedrate(1)
)";
  }
  void standsAndGoes() const {
    EXPECT_EQ(session_.told(output, "feedhold"), (std::vector<double>{0, 0, 0})) << output;
    EXPECT_EQ(told("programmed"), "mm/min 500");
    EXPECT_EQ(told("override"), "mm/min 250");
  }
};

TEST_F(HeldByTheOperator, AProgramThatLinuxCncRuns) {
  atTheDesk(script() + R"(
begin('slow.h')
feedHoldAndOverride()
desk.command.auto(linuxcnc.AUTO_PAUSE)
held('pause')
desk.command.auto(linuxcnc.AUTO_RESUME)
goes('resumed', 499, 501)
desk.command.abort()
written()
)");
  standsAndGoes();
  EXPECT_EQ(session_.told(output, "pause"), (std::vector<double>{0, 0, 0})) << output;
  EXPECT_EQ(told("resumed"), "mm/min 500");
}

TEST_F(HeldByTheOperator, AProgramFromOutside) {
  atTheDesk(script() + R"(
run = start('slow.h')
feedHoldAndOverride()
desk.command.abort()
ended(desk, 'run', run)
)");
  standsAndGoes();
  EXPECT_THAT(told("run"), StartsWith("3 "));
}

}  // namespace
}  // namespace probewright::testing
