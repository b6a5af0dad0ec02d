#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "klartext/expectations.hpp"
#include "klartext/host_world.hpp"
#include "language/din_iso/program.hpp"
#include "language/klartext/check.hpp"

namespace probewright::language::klartext::testing {
namespace {

/// What is said about these blocks: "line:column: message", or "code: message" for what only the run finds.
std::string saidOf(const std::string& blocks) {
  World world;
  const RunResult result = world.run("TOOL CALL 1 Z\nL X+0 Y+0 Z+100 R0 FMAX\n" + blocks + "\n");
  if (result.diagnostics.empty()) return "nothing";
  const Diagnostic& first = result.diagnostics.front();
  if (!first.code.empty()) return first.code + ": " + first.message;
  return std::to_string(first.place.line) + ":" + std::to_string(first.place.column) + ": " + first.message;
}

struct Mistake {
  std::string blocks, said;
};

void expectSaid(const std::vector<Mistake>& mistakes) {
  for (const Mistake& mistake : mistakes)
    EXPECT_EQ(saidOf(mistake.blocks), mistake.said) << mistake.blocks;
}

TEST(Mistakes, OfPathBlocks) {
  expectSaid(
      {{"L X+", "3:5: a number or a Q parameter is expected for X"},
       {"L X+1 X+2 FMAX", "3:7: X is given twice in this block"},
       {"L X+1 IX+2 FMAX", "3:7: X is given twice in this block"},
       {"L X+5 RX", "3:8: a number or a Q parameter is expected for the radius R"},
       {"L X+1e5 FMAX", "3:6: an axis, R0/RL/RR, F or M is expected here"},
       {"APPR LT X+5", "3:12: LEN with the length of the line is expected in this block"},
       {"APPR XX", "3:6: LT, LN, CT, LCT or one of their polar forms PLT, PLN, PCT, PLCT is expected"},
       {"CR X+5 Y+5 R10 DR", "3:18: + or - is expected after DR"},
       {"C X+5 Y+5 DR+ F100", "Circle centre missing: There is no circle centre"},
       {"CT X+5 F100", "Tangential arc not permitted: There is no contour element before CT"},
       {"LP PR+10 PA+45 FMAX", "Pole missing: There is no pole for polar coordinates"},
       {"M140", "3:5: MB with the retraction distance is expected after M140"},
       {"M140 MB-5", "Retraction not permitted: M140 MB retracts along the tool axis: its distance cannot be negative"},
       {"HELLO", "3:1: this is not a block of the Klartext language"}});
}

TEST(Mistakes, OfParameterNumbers) {
  expectSaid({{"Q2000 = 1", "3:6: there is no parameter Q2000"},
              {"Q1 = QL500 + 1", "3:11: there is no parameter QL500"},
              {"L X+QR500 FMAX", "3:10: there is no parameter QR500"},
              {"QS99999999 = \"A\"", "3:11: there is no parameter QS99999999"},
              {"Q1999 = 1", "nothing"},
              {"QR499 = QL499", "nothing"}});
}

TEST(Mistakes, OfFeedsAndTimes) {
  expectSaid(
      {{"L X+1 F-5", "Feed rate wrong: A feed rate of -5 mm/min is not possible"},
       {"L X+1 F0.0001", "Feed rate wrong: A feed rate of 0.0001 mm/min is not possible"},
       {"L X+1 F0.5 M136",
        "Spindle speed missing: With M136 the feed rate counts per revolution, but the "
        "spindle has no speed"},
       {"L X+1 FMAXX", "3:11: this is not a feed rate"},
       {"L X+1 FMAXM3", "nothing"},
       {"Q1 = 10 ^ 9\nCYCL DEF 9.0 DWELL TIME\nCYCL DEF 9.1 DWELL Q1",
        "Dwell time wrong: A dwell time of 1000000000 s is not possible"},
       {"Q1 = -0.1\nCYCL DEF 9.0 DWELL TIME\nCYCL DEF 9.1 DWELL Q1",
        "Dwell time wrong: A dwell time of -0.1 s is not possible"},
       {"Q1 = 3600.1\nCYCL DEF 9.0 DWELL TIME\nCYCL DEF 9.1 DWELL Q1",
        "Dwell time wrong: A dwell time of 3600.1 s is not possible"},
       {"CYCL DEF 9.0 DWELL TIME\nCYCL DEF 9.1 DWELL 0\nCYCL DEF 9.0 DWELL TIME\nCYCL DEF 9.1 DWELL 3600", "nothing"},
       {"M140 MB 5 F1", "nothing"}});
}

TEST(Mistakes, OfTexts) {
  expectSaid({{"QS1 = \"0123456789ABCDEF\"\nLBL 1\nQS1 = QS1 || QS1\nCALL LBL 1 REP9",
               "String too long: QS1 takes at most 255 characters, these are 256"},
              {"QS1 = SUBSTR( SRC_QS2 BEG-1 LEN2 )", "3:28: BEG of SUBSTR is 0 or more"},
              {"QS1 = SUBSTR( SRC_QS2 BEG1 LEN-5 )", "3:33: LEN of SUBSTR is 0 or more"},
              {"Q1 = INSTR( SRC_QS2 SEA_QS3 BEG-3 )", "3:34: BEG of INSTR is 0 or more"},
              {"QS1 = TOCHAR( DAT+Q1 DECIMALS-1 )", "3:32: DECIMALS of TOCHAR is 0 or more"},
              {"QS2 = \"AB\"\nQ5 = -1\nQS1 = SUBSTR( SRC_QS2 BEGQ5 LEN2 )",
               "Argument out of range: SUBSTR cannot begin at BEG-1"},
              {"QS2 = \"AB\"\nQ5 = -3\nQ1 = INSTR( SRC_QS2 SEA_QS2 BEGQ5 )",
               "Argument out of range: INSTR cannot begin at BEG-3"}});
}

/// The advice for a block that begins with no keyword.
TEST(Mistakes, KeywordsThatAreNearlyRightAreNamed) {
  const auto advice = [](const std::string& block) {
    World world;
    const RunResult result = world.run(block + "\n");
    return result.diagnostics.empty() ? std::string("nothing") : result.diagnostics.front().advice;
  };
  EXPECT_EQ(advice("TOL CALL 1 Z"), "Did you mean TOOL CALL?");
  EXPECT_EQ(advice("CYCLE DEF 247 PRESET ~\n Q339=1"), "Did you mean CYCL DEF?");
  EXPECT_EQ(advice("PLAIN SPATIAL SPA+0"), "Did you mean PLANE SPATIAL?");
  EXPECT_EQ(advice("L X+1 FMAXX"), "Did you mean FMAX?");
}

TEST(Mistakes, OfToolsAndCalls) {
  expectSaid({{"TOOL CALL 99999999999 Z", "3:22: there is no tool with such a number"},
              {"TOOL CALL 99 Z", "Tool not defined: TOOL.T has no tool 99"},
              {"TOOL CALL \"NONE\" Z", "Tool not defined: TOOL.T has no tool named NONE"},
              {"TOOL CALL 5 Q", "3:13: the tool axis, S, F, DL, DR, DR2 or M is expected here"},
              {"TOOL CALL 1 U S500", "3:13: the tool axis U is not available: tools lie along X, Y or Z here"},
              {"TOOL CALL W", "3:11: the tool axis W is not available: tools lie along X, Y or Z here"},
              {"TOOL CALL 5 Z S-5", "Spindle speed wrong: A spindle speed of -5 is not possible"},
              {"TOOL DEF", "3:9: a tool number or name is expected after TOOL DEF"},
              {"LBL \"A", "3:5: a label number, a label name in quotation marks or a QS parameter is expected"},
              {"CALL LBL 7", "Label not found: there is no label 7 in this program"},
              {"CALL LBL QS4", "Label not found: there is no label \"\" in this program"},
              {"CALL PGM NONE.H", "Program not found: there is no program NONE.H"},
              {"CALL SELECTED PGM", "Program not selected: CALL SELECTED PGM finds no program selected"},
              {"SEL TABLE", "3:10: the name of a file is expected here"}});
}

TEST(Mistakes, OfCyclesInParts) {
  expectSaid(
      {{"CYCL DEF 7", "3:11: cycle 7 is written in parts"},
       {"CYCL DEF 7.1 X+5", "3:13: this part of a cycle stands alone"},
       {"CYCL DEF 7.0 SHIFT", "3:19: part 7.1 of this cycle is missing"},
       {"CYCL DEF 7.0\nCYCL DEF 7.1",
        "4:13: an axis with its shift, or # with a row of the datum table, is expected here"},
       {"CYCL DEF 8.0\nCYCL DEF 8.1 X+5", "4:15: an axis letter is expected here"},
       {"CYCL DEF 10.0\nCYCL DEF 10.1", "4:14: a number or a Q parameter is expected for the angle ROT"},
       {"CYCL DEF 11.0\nCYCL DEF 11.1 SCL 0", "Scaling factor wrong: A scaling factor must be greater than 0"},
       {"CYCL DEF 247 PRESET ~\nQ340=+3",
        "4:8: cycle 247 takes Q339 with the row of the preset table and nothing else"},
       {"CYCL DEF 247 PRESET ~\nQ339=+77", "Preset not defined: The preset table has no row 77"},
       {"TCH PROBE 0.0 REF Q5 X-", "3:24: part 0.1 of this touch probe cycle is missing"},
       {"TCH PROBE 0.0 REF Q5 X\nTCH PROBE 0.1 X+5", "3:23: the probing direction + or - is expected after the axis"},
       {"TCH PROBE 17 X", "3:13: touch probe cycle 17 is written in parts"},
       {"CYCL DEF 200 X ~\nQ200=2 ~\nQ200=3", "5:1: Q200 is given twice in this cycle"}});
}

TEST(Mistakes, OfFunctionsAndFormulas) {
  expectSaid({{"FN 99: Q1 = 2", "3:6: a number from 0 to 38 is expected after FN"},
              {"FN 1: Q1 = +1 - +2", "3:15: + is expected between the two values"},
              {"FN 4: Q1 = +1 DIV +0", "Division by zero: the divisor is 0"},
              {"FN 5: Q1 = SQRT -4", "Argument out of range: the square root of -4 does not exist"},
              {"FN 9: IF +1 EQU +1 LBL 3", "3:20: GOTO LBL is expected after the condition"},
              {"FN 14: ERROR", "3:13: '=' is expected after ERROR"},
              {"FN 26: TABOPEN", "Table missing: FN 26 names no table"},
              {"FN 27: TABWRITE 5/\"A\" = Q1", "Table missing: No table is open for FN 27"},
              {"Q1 = (3", "3:8: ')' is expected after the expression in parentheses"},
              {"Q1 = \"A\"", "Wrong data type: A Q parameter takes a number, not a text"},
              {"QS1 = 5", "Wrong data type: QS1 takes a text, not a number"},
              {"Q1 = TONUMB( SRC_\"abc\" )", "String is not a number: TONUMB cannot read \"abc\" as a number"}});
}

/// Only a division has a divisor: 0 stands in any other operation.
TEST(Mistakes, OfDivisorsOnly) {
  for (const char* formula : {"Q1 = Q2 + 0", "Q1 = Q2 - 0", "Q1 = Q2 * 0", "Q1 = Q2 ^ 0", "FN 1: Q1 = +Q2 + +0",
                              "FN 2: Q1 = +Q2 - +0", "FN 3: Q1 = +Q2 * +0"}) {
    KlartextProgram program("a.h", fmt::format("BEGIN PGM A MM\n1 {}\nEND PGM A MM\n", formula));
    EXPECT_EQ(checkProgram(program, control::ControlKind::TNC640).size(), 0U) << formula;
  }
  for (const char* formula : {"Q1 = Q2 / 0", "Q1 = Q2 % 0", "FN 4: Q1 = +Q2 DIV +0"}) {
    KlartextProgram program("a.h", fmt::format("BEGIN PGM A MM\n1 {}\nEND PGM A MM\n", formula));
    EXPECT_EQ(checkProgram(program, control::ControlKind::TNC640).size(), 1U) << formula;
  }
}

/// What is refused in a run is refused by the check, with a place, in both languages.
TEST(Mistakes, OfFormulasWithTooManyTerms) {
  const auto repeated = [](const std::string& text, int count) {
    std::string all;
    for (int i = 0; i < count; ++i)
      all += text;
    return all;
  };
  const std::string nested = "(1" + repeated(" + 1", 300) + ")" + repeated(" + 1", 300);
  for (const std::string& formula : {"Q1 = 1" + repeated(" + 1", 600), "Q1 = 1" + repeated(" * 1 - 1", 300000),
                                     "QS1 = \"\"" + repeated(" || \"\"", 600), "Q1 = " + nested}) {
    KlartextProgram program("a.h", "BEGIN PGM A MM\n1 " + formula + "\nEND PGM A MM\n");
    const Diagnostics found = checkProgram(program, control::ControlKind::TNC640);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].message, "a formula of this block has too many terms");
    EXPECT_EQ(found[0].advice, "compute it in several blocks");
    EXPECT_EQ(found[0].place.line, 2U);
    EXPECT_EQ(World().run("1 " + formula + "\n").end, RunEnd::BrokenProgram);
    din_iso::DinIsoProgram iso("a.i", "%A G71 *\nN10 " + formula + " *\nN99999999 %A G71 *\n");
    EXPECT_EQ(checkProgram(iso, control::ControlKind::TNC640).size(), 1U);
  }
  World world;
  expectFinished(world.run("Q1 = 1" + repeated(" + 1", 490) + "\nQS1 = \"a\"" + repeated(" || \"b\"", 200) + "\n"));
  EXPECT_EQ(world.q(1), 491);
}

TEST(Mistakes, LabelIsWrittenLbl) {
  KlartextProgram program("a.h", "BEGIN PGM A MM\nLABEL 5\nEND PGM A MM\n");
  const Diagnostics found = checkProgram(program, control::ControlKind::TNC640);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].advice, "Did you mean LBL?");
}

TEST(Mistakes, OfPlanesAndTransformations) {
  expectSaid({{"PLANE SPATIAL TURN FMAX", "3:24: the values that define the plane are missing"},
              {"PLANE SPATIAL SPAX TURN", "3:18: a number or a Q parameter is expected for SPA"},
              {"PLANE VECTOR BX0 BY0 BZ0 NX0 NY0 NZ1 STAY", "Plane definition wrong: the base vector has no length"},
              {"TRANS DATUM", "3:12: AXIS, TABLE or RESET is expected after TRANS DATUM"},
              {"TRANS DATUM AXIS", "3:17: an axis with its shift is expected here"},
              {"TRANS DATUM TABLE TABLINE 5", "Datum table missing: No datum table is selected"},
              {"CYCL DEF 26.0 SCALING\nCYCL DEF 26.1 X1 C2", "Axis not permitted: Cycle 26 scales X, Y and Z, not C"},
              {"TOOL CALL QS5 Z", "Tool not defined: The name of the tool is empty"},
              {"PRESET SELECT 5", "3:15: '#' is expected after PRESET SELECT"},
              {"FUNCTION MODE X", "3:15: MILL, TURN, GRIND, DRESS or SET is expected after FUNCTION MODE"},
              {"FUNCTION TCPM F TCP AXIS POS",
               "Function not available: M128 and FUNCTION TCPM need a machine with rotary axes"}});
}

TEST(Mistakes, QuoteTheFirstLineOfTheirBlock) {
  World world;
  const RunResult result = world.run("CYCL DEF 247 PRESET ~\n  Q339=+77\n");
  ASSERT_FALSE(result.diagnostics.empty());
  EXPECT_EQ(result.diagnostics.front().excerpt, "CYCL DEF 247 PRESET");
}

TEST(Mistakes, WhatHasNoEffectIsNamedOrRefused) {
  World world;
  EXPECT_EQ(world.run("FUNCTION FILECOPY \"A\" TO \"B\"\nFUNCTION MODE MILL\n").end, RunEnd::Finished);
  const auto& events = world.control->journal.events;
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].kind, control::EventKind::Skipped);
  EXPECT_EQ(events[0].text, "FUNCTION FILECOPY \"A\" TO \"B\" is not simulated and was skipped");
  world.options.strict = true;
  EXPECT_EQ(world.run("FUNCTION FILECOPY \"A\" TO \"B\"\n").end, RunEnd::Alarm);
}

}  // namespace
}  // namespace probewright::language::klartext::testing
