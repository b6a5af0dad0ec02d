#include "language/klartext/commands.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "klartext/samples.hpp"
#include "language/klartext/program.hpp"

namespace probewright::language::klartext::testing {
namespace {

TEST(Commands, EveryKindHasANameOfItsOwn) {
  std::set<std::string_view> names;
  for (int i = 0; i <= static_cast<int>(CommandKind::FreeSelection); ++i) {
    const auto kind = static_cast<CommandKind>(i);
    Block block;
    Command command;
    command.name = block.add(nameOf(kind));
    EXPECT_EQ(kindOf(block, command), kind) << nameOf(kind);
    EXPECT_TRUE(names.insert(nameOf(kind)).second) << nameOf(kind);
  }
  for (int i = 0; i <= static_cast<int>(TransformKind::PlaneReset); ++i) {
    const auto kind = static_cast<TransformKind>(i);
    Block block;
    Transform transform;
    transform.name = block.add(nameOf(kind));
    EXPECT_EQ(kindOf(block, transform), kind) << nameOf(kind);
    EXPECT_TRUE(names.insert(nameOf(kind)).second) << nameOf(kind);
  }
  Block block;
  Command unknown;
  unknown.name = block.add("FN99");
  EXPECT_THROW(kindOf(block, unknown), std::logic_error);
}

/// Whoever carries out, writes or checks blocks asks for the kind of what the parser made.
TEST(Commands, TheParserMakesNoOthers) {
  std::string every;
  for (const std::string_view text : samples)
    every += text;
  for (const char* block : {"FN 14: ERROR = 1000",
                            "FN 15: PRINT Q1",
                            "FN 16: F-PRINT M.A / L.TXT",
                            "FN 17: SYSWRITE ID50 NR1 IDX5 = +1",
                            "FN 18: SYSREAD Q1 = ID20 NR1",
                            "FN 19: PLC=+1/+2",
                            "FN 20: WAIT FOR SYNC",
                            "FN 21: X",
                            "FN 22: X",
                            "FN 23: Q20 = CDATA Q30",
                            "FN 24: Q20 = CDATA Q30",
                            "FN 25: PRESET = X/+0/+1",
                            "FN 26: TABOPEN T.TAB",
                            "FN 27: TABWRITE 5/\"A\" = Q1",
                            "FN 28: TABREAD Q1 = 5/\"A\"",
                            "FN 29: PLC=+1",
                            "FN 37: EXPORT Q1",
                            "FN 38: SEND /\"A\"",
                            "FN 0: Q1 SET UNDEFINED",
                            "SEL PGM \"A.H\"",
                            "SEL TABLE \"A.D\"",
                            "SEL PATTERN \"A.PNT\"",
                            "SEL CONTOUR \"A.HC\"",
                            "SEL CYCLE \"A.H\"",
                            "SEL CORR-TABLE TCS \"A.TCO\"",
                            "SEL CORR-TABLE WPL \"A.WCO\"",
                            "TABDATA READ Q1 = TOOL COLUMN \"L\" KEY \"1\"",
                            "TABDATA WRITE TOOL COLUMN \"DL\" KEY \"1\" = +1",
                            "TABDATA ADD TOOL COLUMN \"DL\" KEY \"1\" = +1",
                            "PRESET SELECT #3",
                            "PRESET COPY #1 TO #2",
                            "PRESET CORR X+1",
                            "FL X+1",
                            "FLT",
                            "FC DR-",
                            "FCT DR-",
                            "FPOL X+0 Y+0",
                            "FSELECT 1",
                            "FUNCTION MODE MILL",
                            "FUNCTION RESET LIFTOFF",
                            "TRANS DATUM AXIS X+1",
                            "TRANS DATUM TABLE TABLINE1",
                            "TRANS DATUM RESET",
                            "TRANS MIRROR AXIS X",
                            "TRANS MIRROR RESET",
                            "TRANS ROTATION ROT+5",
                            "TRANS ROTATION RESET",
                            "TRANS SCALE SCL0.5",
                            "TRANS SCALE RESET",
                            "PLANE AXIAL B+45 STAY",
                            "PLANE RESET STAY",
                            "SQL OPEN \"A\"",
                            "MONITORING OFF",
                            "SECTION A",
                            "OPEN FILE \"A\"",
                            "DECLARE A",
                            "CONTOUR DEF"})
    every += std::string(block) + "\n";
  KlartextProgram program("EVERY.H", every);
  Diagnostics mistakes;
  Block block;
  std::size_t seen = 0;
  for (BlockPosition at = program.begin(); program.parse(at, block, mistakes); at = block.next) {
    for (const Instruction& instruction : block.instructions) {
      if (const auto* command = std::get_if<Command>(&instruction)) {
        EXPECT_NO_THROW(kindOf(block, *command));
        ++seen;
      }
      if (const auto* transform = std::get_if<Transform>(&instruction)) {
        EXPECT_NO_THROW(kindOf(block, *transform));
        ++seen;
      }
    }
  }
  EXPECT_GE(seen, 60U);
}

}  // namespace
}  // namespace probewright::language::klartext::testing
