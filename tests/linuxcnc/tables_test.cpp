#include "linuxcnc/interpreter_bench.hpp"

/// Zero offsets and tools of LinuxCNC and of the control are one. What they are afterwards, LinuxCNC says itself: its
/// status, its parameters, its tool table.
namespace probewright::testing {
namespace {

using ::testing::HasSubstr;

constexpr double feed = 600;
constexpr double bound = feed / 60 * 0.001 + 1e-4;  // mm: a servo period at the probing feed

class TablesOfLinuxCnc : public AsInterpreter {
protected:
  /// What stands at LinuxCNC before the run is neither what the setup says nor what the part is: the program must begin
  /// from LinuxCNC's G54. Of the rest, G58 and a tool, the program tells.
  void isOne(const std::string& run) {
    session_.write("setup.toml", setup("840Dsl", world, feed));
    std::string program = sinumerik();
    program.insert(program.find("M30"),
                   "$TC_DP3[2,1]=91.5\n$TC_DP6[2,1]=4.9\n$P_UIFR[5]=CTRANS(X,11,Y,-12,Z,-13):CROT(Z,5)\n");
    session_.write("bore.mpf", program);
    atTheDesk(std::string(keeps) + call(world) + R"(
def parameters(name):
    desk.mdi('(PRINT,desk: ' + name + ' #5221 #5222 #5223 #5230 #5301 #5302 #5303 #5310 #5241)')
desk.mdi('G10 L2 P2 X33 Y44')
desk.mdi('G10 L2 P1 X0.5 Y-0.1 Z-250.1')
)" + run + R"(
parameters('parameters')
desk.mdi('G54')
desk.status.poll()
desk.tell('status', *desk.status.g5x_offset[:3])
tool = next(t for t in desk.status.tool_table if t.id == 2)
desk.tell('tool', tool.zoffset, tool.diameter)
)");
    const std::vector<double> parameters = session_.told(output, "parameters");
    ASSERT_EQ(parameters.size(), 9U) << output;
    EXPECT_NEAR(parameters[0], world.x, bound);
    EXPECT_NEAR(parameters[1], world.y, bound);
    EXPECT_NEAR(parameters[2], world.top, bound);
    EXPECT_NEAR(parameters[3], 0, 1e-6);
    EXPECT_NEAR(parameters[4], 11, 1e-6);
    EXPECT_NEAR(parameters[5], -12, 1e-6);
    EXPECT_NEAR(parameters[6], -13, 1e-6);
    EXPECT_NEAR(parameters[7], 5, 1e-6);
    EXPECT_NEAR(parameters[8], 33, 1e-6) << "what the program does not touch stays";
    const std::vector<double> status = session_.told(output, "status");
    ASSERT_EQ(status.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(status[i], parameters[i], 1e-6);
    const std::vector<double> tool = session_.told(output, "tool");
    ASSERT_EQ(tool.size(), 2U);
    EXPECT_NEAR(tool[0], 91.5, 1e-6);
    EXPECT_NEAR(tool[1], 9.8, 1e-6);
    EXPECT_THAT(text("tool.tbl"), ::testing::ContainsRegex("T2 .*D\\+?9\\.8")) << "the file is LinuxCNC's own";
    // The first move of the program went where LinuxCNC's offset puts it.
    EXPECT_THAT(text("out/results.json") + text("done/results.json"),
                HasSubstr("$P_UIFR[1] is what the machine has as G54: X0.5000"));
  }
};

/// A program that is started again, as screens do it, begins from what it has found.
TEST_F(TablesOfLinuxCnc, AreOneWithTheControlsAsItsInterpreter) {
  isOne("run('bore.mpf', 'done')\ndesk.command.auto(linuxcnc.AUTO_RUN, 0)\ndesk.taken()\nkeep('again')\n");
  std::smatch found;
  const std::string again = text("again/results.json");
  ASSERT_TRUE(std::regex_search(again, found, std::regex("is what the machine has as G54: X([-0-9.]+) Y([-0-9.]+)")))
      << output;
  EXPECT_NEAR(std::stod(found[1]), world.x, bound);
  EXPECT_NEAR(std::stod(found[2]), world.y, bound);
}

TEST_F(TablesOfLinuxCnc, AreOneWithTheControlsFromOutside) { isOne("ended(desk, 'run', start('bore.mpf'))\n"); }

TEST_F(TablesOfLinuxCnc, StayApartOnDemand) {
  session_.write("mill.ini", text("mill.ini") + "SHARE_TABLES = 0\n");
  session_.write("setup.toml", setup("TNC640", world, feed));
  session_.write("bore.h", klartext());
  atTheDesk(std::string(keeps) + call(world) + R"(
desk.mdi('G10 L2 P1 X7 Y8 Z-9')
run('bore.h', 'done')
desk.mdi('(PRINT,desk: parameters #5221 #5222 #5223)')
)");
  EXPECT_EQ(session_.told(output, "parameters"), (std::vector<double>{7, 8, -9})) << output;
  const std::vector<double> found = preset("done");
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(found[0], world.x, bound);
}

}  // namespace
}  // namespace probewright::testing
