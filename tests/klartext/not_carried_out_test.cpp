#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "execution/din_iso/host.hpp"
#include "klartext/expectations.hpp"
#include "klartext/host_world.hpp"
#include "language/din_iso/program.hpp"

/// What changes where the tool is and is not carried out is named once in a run, and refused under --strict.
namespace probewright::language::klartext::testing {

using namespace execution;
using namespace execution::klartext;
namespace {

using control::ControlKind;
using control::EventKind;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Case {
  const char* blocks;  ///< twice in a program
  const char* named;
};

constexpr std::array namedCases = {
    Case{"FUNCTION MODE TURN", "FUNCTION MODE TURN is not simulated and was skipped"},
    Case{"FUNCTION MODE MILL \"B-HEAD\"", "FUNCTION MODE MILL \"B-HEAD\" is not simulated and was skipped"},
    Case{"FUNCTION MODE SET \"LONG\"", "FUNCTION MODE SET \"LONG\" is not simulated and was skipped"},
    Case{"FUNCTION MODE GRIND", "FUNCTION MODE GRIND is not simulated and was skipped"},
    Case{"FUNCTION TURNDATA CORR-TCS:Z/X DZL:0.1 DXL:0.05",
         "FUNCTION TURNDATA CORR-TCS:Z/X DZL:0.1 DXL:0.05 is not simulated and was skipped"},
    Case{"FUNCTION CORRDATA TCS #1", "FUNCTION CORRDATA TCS #1 is not simulated and was skipped"},
    Case{"FUNCTION PARAXMODE X Y W", "FUNCTION PARAXMODE X Y W is not simulated and was skipped"},
    Case{"FUNCTION POLARKIN AXES X C MODE:POS POLE:ALLOWED",
         "FUNCTION POLARKIN AXES X C MODE:POS POLE:ALLOWED is not simulated and was skipped"},
    Case{"FUNCTION FACING HEAD POS Z+50", "FUNCTION FACING HEAD POS Z+50 is not simulated and was skipped"},
    Case{"FUNCTION COUNT REPEAT LBL 11", "FUNCTION COUNT REPEAT LBL 11 is not simulated and was skipped"},
    Case{"FUNCTION TCPM F TCP AXIS POS PATHCTRL VECTOR",
         "PATHCTRL VECTOR, which guides the tool direction between the ends of a block, is not simulated and was "
         "skipped"},
    Case{"SEL CORR-TABLE TCS \"WEAR.TCO\"", "SEL CORR-TABLE TCS WEAR.TCO is not simulated and was skipped"},
    Case{"SEL CORR-TABLE WPL \"WEAR.WCO\"", "SEL CORR-TABLE WPL WEAR.WCO is not simulated and was skipped"},
    Case{"TOOL DEF 1 L+77 R+2",
         "TOOL DEF with a length or radius other than that in TOOL.T is not simulated and was skipped"},
    Case{"TOOL CALL 1 Z S(VC=120)", "The cutting speed VC of TOOL CALL is not simulated and was skipped"},
    Case{"TOOL CALL S(VC=Q1) F500", "The cutting speed VC of TOOL CALL is not simulated and was skipped"},
    Case{"TOOL DEF 9 L+77",
         "TOOL DEF with a length or radius other than that in TOOL.T is not simulated and was skipped"},
    Case{"FN 17: SYSWRITE ID990 NR1 = +1", "FN 17: SYSWRITE ID990 NR1 is not simulated and was skipped"},
    Case{"FN 17: SYSWRITE ID990 NR2 = +0", "FN 17: SYSWRITE ID990 NR2 is not simulated and was skipped"},
    Case{"L IX+1 R+ F500", "The paraxial radius compensation R+ is not simulated and was skipped"},
    Case{"CYCL DEF 332 TUNING ~\n  Q240=+1", "Cycle 332 is not simulated and was skipped"},
    Case{"CYCL DEF 800 ADAPT XZ SYSTEM ~\n  Q497=+0", "Cycle 800 is not simulated and was skipped"},
    Case{"CYCL DEF 1032 WHEEL LENGTH ~\n  Q1012=+0", "Cycle 1032 is not simulated and was skipped"},
    Case{"CYCL DEF 203 DRILLING ~\n  Q200=+2\nL X+1 FMAX M99\nCYCL CALL", "Cycle 203 is not simulated and was skipped"},
    Case{"CYCL DEF 1.0 PECKING\nCYCL DEF 1.1 SET UP2\nCYCL DEF 1.2 DEPTH-5\nCYCL DEF 1.3 PECKG2\nCYCL DEF 1.4 DWELL0\n"
         "CYCL DEF 1.5 F100\nCYCL CALL",
         "Cycle 1 is not simulated and was skipped"},
    Case{"TCH PROBE 584 LASER ~\n  Q350=+1",
         "Touch probe cycle 584, which is of the machine tool builder, is not simulated and was skipped"},
};

TEST(NotCarriedOut, IsNamedOnceAndRefusedUnderStrict) {
  for (const Case& each : namedCases) {
    const std::string once = std::string(each.blocks) + "\n";
    World world("mill5-head-table");
    expectFinished(world.run(once + once));
    EXPECT_THAT(world.told(EventKind::Skipped), ElementsAre(each.named));
    World strict("mill5-head-table");
    strict.options.strict = true;
    EXPECT_EQ(strict.run(once).end, RunEnd::Alarm) << each.blocks;
  }
}

TEST(NotCarriedOut, IsNamedInDinIsoToo) {
  constexpr std::array cases = {
      Case{"N10 FUNCTION MODE TURN *", "FUNCTION MODE TURN is not simulated and was skipped"},
      Case{"N10 G99 T1 L+77 R+2 *",
           "TOOL DEF with a length or radius other than that in TOOL.T is not simulated and was skipped"},
      Case{"N10 T1 G17 S(VC=120) *", "The cutting speed VC of TOOL CALL is not simulated and was skipped"},
      Case{"N10 S(VC=120) *", "The cutting speed VC of TOOL CALL is not simulated and was skipped"},
      Case{"N10 G01 G43 G91 X+1 F500 *", "The paraxial radius compensation R+ is not simulated and was skipped"},
      Case{"N10 G44 G91 X+1 F500 *", "The paraxial radius compensation R- is not simulated and was skipped"},
      Case{"N10 D17 SYSWRITE ID990 NR1 = +1 *", "FN 17: SYSWRITE ID990 NR1 is not simulated and was skipped"},
      Case{"N10 M138 A *", "M138 is not simulated and was skipped"},
      Case{"N10 G203 DRILLING Q200=+2 *\nN20 G79 *", "Cycle 203 is not simulated and was skipped"},
      Case{"N10 G584 LASER Q350=+1 *",
           "Touch probe cycle 584, which is of the machine tool builder, is not simulated and was skipped"},
      Case{"N10 G332 TUNING Q240=+1 *", "Cycle 332 is not simulated and was skipped"}};
  for (const Case& each : cases) {
    World world("mill5-head-table");
    const auto program = std::make_shared<din_iso::DinIsoProgram>(
        "main.i", fmt::format("%A G71 *\n{0}\n{0}\nN99999999 %A G71 *\n", each.blocks));
    KlartextHost klartext(*world.control, world.options);
    execution::din_iso::DinIsoHost host(klartext);
    expectFinished(Interpreter(world.library, host).run(program));
    EXPECT_THAT(world.told(EventKind::Skipped), ElementsAre(each.named));
  }
}

/// Whatever the number of a cycle: it is unknown, carried out, or named where it acts or is called.
TEST(NotCarriedOut, IsNoCycleInSilence) {
  for (int number = 200; number < 1700; ++number) {
    World world("mill5-head-table");
    const RunResult result = world.run(fmt::format("CYCL DEF {} NAME ~\n  Q339=+0\nCYCL CALL\n", number));
    if (number == 247) {
      EXPECT_NE(result.end, RunEnd::Finished) << "cycle 247 is no machining cycle";
      continue;
    }
    // Cycles that act where they stand leave nothing to call.
    if (result.end != RunEnd::Finished) {
      EXPECT_EQ(result.diagnostics.front().code, "Cycle not defined") << number;
    }
    EXPECT_EQ(world.told(EventKind::Skipped).size(), 1U) << number;
  }
}

TEST(NotCarriedOut, LeavesWhatMovesNothingAlone) {
  World world("mill5-head-table");
  expectFinished(
      world.run("FUNCTION MODE MILL\nFUNCTION PARAXCOMP OFF\nFUNCTION PARAXMODE OFF\nFUNCTION POLARKIN OFF\nTOOL DEF "
                "5\nTOOL DEF 5 L+50 R+5\nTOOL DEF 1 R+2\nFN 17: SYSWRITE ID990 NR6 = +1\n"
                "FN 17: SYSWRITE ID990 NR1 = +0\nCYCL DEF 203 DRILLING ~\n  Q200=+2\nFUNCTION TCPM F TCP AXIS POS "
                "PATHCTRL AXIS\nFUNCTION RESET TCPM\n"));
  EXPECT_THAT(world.told(EventKind::Skipped), IsEmpty());
}

TEST(NotCarriedOut, TurningModeIsKnownWithKinematicsToo) {
  World world("mill5-head-table");
  expectFinished(world.run("FUNCTION MODE TURN \"LATHE\"\n"));
  EXPECT_TRUE(world.control->turningMode);
  expectFinished(world.run("FUNCTION MODE MILL\n"));
  EXPECT_FALSE(world.control->turningMode);
}

}  // namespace
}  // namespace probewright::language::klartext::testing
