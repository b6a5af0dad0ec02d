#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "klartext/expectations.hpp"
#include "klartext/host_world.hpp"

namespace probewright::language::klartext::testing {
namespace {

using ::testing::HasSubstr;

std::string messageOf(const RunResult& result) {
  return result.diagnostics.empty() ? std::string("none") : result.diagnostics.front().message;
}

TEST(SystemData, OfToolAndPosition) {
  World world;
  expectFinished(
      world.run("TOOL CALL 5 Z S1200 DR+0.1\nL X+3 Y+4 Z-100 FMAX\nFN 18: SYSREAD Q1 = ID20 NR1\n"
                "FN18 : SYSREAD Q2 = ID270 NR1 IDX2\nFN 18: SYSREAD Q3 = ID50 NR2 IDX1\n"
                "FN 18: SYSREAD Q4 = ID200 NR1 IDX3\nFN 18: SYSREAD Q5 = ID20 NR4\nQS7 = \"PROBE\"\n"
                "FN 18: SYSREAD Q6 = ID990 NR10 IDX7\nFN 17: SYSWRITE ID50 NR4 IDX5 = +0.25\n"
                "FN 18: SYSREAD Q7 = ID50 NR4 IDX5\nFN 18: SYSREAD Q8 = ID240 NR1 IDX3\nQ9 = Q108"));
  EXPECT_EQ(world.q(1), 5);
  EXPECT_EQ(world.q(2), 4);
  EXPECT_EQ(world.q(3), 2);
  EXPECT_DOUBLE_EQ(world.q(4), 5.1);
  EXPECT_EQ(world.q(5), 1200);
  EXPECT_EQ(world.q(6), 1);
  EXPECT_EQ(world.q(7), 0.25);
  EXPECT_DOUBLE_EQ(world.q(8), -50);
  EXPECT_DOUBLE_EQ(world.q(9), 5.1);
  EXPECT_THAT(world.run("FN 18: SYSREAD Q1 = ID99999 NR1").diagnostics.front().message, HasSubstr("ID99999"));
}

TEST(Protocols, FollowTheirMask) {
  World world;
  world.control->wallClockStart = 1'700'000'000;  // 2023-11-14 22:13:20 UTC
  world.files["M.A"] =
      "\"RESULT OF %S\",QS1;\n\"X = %9.3LF (%+.1F) %%\",Q31, Q32;\n\"%2d.%02d.%4d %02d:%02d\", "
      "DAY,MONTH,YEAR4,HOUR,MIN;\n"
      "M_CLOSE\n";
  expectFinished(world.run("QS1 = \"RING\"\nQ31 = 12.34567\nQ32 = 5\nFN 16: F-PRINT M.A / TNC:\\LOG\\R.TXT\n"));
  EXPECT_EQ(world.control->panel.files().at("R.TXT"), "RESULT OF RING\nX =    12.346 (+5.0) %\n14.11.2023 22:13\n");
  EXPECT_THAT(world.run("FN 16: F-PRINT NONE.A / R.TXT").diagnostics.front().message, HasSubstr("NONE.A"));
  expectFinished(world.run("FN 16: F-PRINT M.A / ../logs/S.TXT\n"));
  EXPECT_TRUE(world.control->panel.files().contains("S.TXT"));
}

TEST(SystemData, LengthsAreInMillimetresInInchProgramsToo) {
  World world;
  expectFinished(
      world.run("BEGIN PGM A INCH\nTOOL CALL 5 Z\nL X+1 FMAX\nFN 18: SYSREAD Q1 = ID270 NR1 IDX1\n"
                "FN 18: SYSREAD Q2 = ID50 NR1 IDX5\nFN 17: SYSWRITE ID50 NR4 IDX5 = +0.5\n"
                "END PGM A INCH\n"));
  EXPECT_DOUBLE_EQ(world.q(1), 25.4);
  EXPECT_DOUBLE_EQ(world.q(2), 50);
  EXPECT_EQ(world.control->tables.tools.number("5", "DL"), 0.5);
}

TEST(SystemData, OversizesOfTableAndToolCall) {
  World world;
  ASSERT_TRUE(world.control->tables.tools.setNumber("5", "DR", 0.25));
  expectFinished(
      world.run("TOOL CALL 5 Z DR+0.5\nFN 18: SYSREAD Q1 = ID200 NR1 IDX1\n"
                "FN 18: SYSREAD Q2 = ID200 NR1 IDX2\nFN 18: SYSREAD Q3 = ID200 NR1 IDX3\n"
                "FN 18: SYSREAD Q4 = ID200 NR6 IDX1\nFN 18: SYSREAD Q5 = ID950 NR2\n"
                "FN 18: SYSREAD Q6 = ID50 NR36 IDX1\nFN 18: SYSREAD Q7 = ID50 NR36 IDX5\n"));
  EXPECT_DOUBLE_EQ(world.q(1), 5);
  EXPECT_DOUBLE_EQ(world.q(2), 5.25);
  EXPECT_DOUBLE_EQ(world.q(3), 5.75);
  EXPECT_DOUBLE_EQ(world.q(4), 100);
  EXPECT_DOUBLE_EQ(world.q(5), 5);
  EXPECT_EQ(world.q(6), 21);
  EXPECT_EQ(world.q(7), 0);
}

TEST(SystemData, StateOfSpindleAndSwitches) {
  World world("mill5-table-table");
  expectFinished(
      world.run("TOOL CALL 5 Z S500\nFN 18: SYSREAD Q1 = ID20 NR5\nM4\nFN 18: SYSREAD Q2 = ID20 NR5\n"
                "Q3 = Q110\nM5\nFN 18: SYSREAD Q4 = ID20 NR5\nM3\nM5\nQ5 = Q110\n"
                "M126\nM128\nFN 18: SYSREAD Q6 = ID310 NR126\nFN 18: SYSREAD Q7 = ID280 NR1\n"
                "FN 18: SYSREAD Q8 = ID210 NR6\nFN 18: SYSREAD Q9 = ID992 NR16\nTOOL DEF 1\n"
                "FN 18: SYSREAD Q10 = ID20 NR2\n"));
  EXPECT_EQ(world.q(1), -1);
  EXPECT_EQ(world.q(2), 1);
  EXPECT_EQ(world.q(3), 1);
  EXPECT_EQ(world.q(4), 3);
  EXPECT_EQ(world.q(5), 2);
  EXPECT_EQ(world.q(6), -1);
  EXPECT_EQ(world.q(7), -1);
  EXPECT_EQ(world.q(8), 0);
  EXPECT_EQ(world.q(9), 1);
  EXPECT_EQ(world.q(10), 1);
}

TEST(SystemData, ParametersByComputedNumbersAndPrograms) {
  World world;
  world.files["LOG.A"] = "text";
  world.library.texts["SUB.H"] =
      "BEGIN PGM SUB MM\nFN 18: SYSREAD Q4 = ID10 NR7\nFN 18: SYSREAD Q5 = ID10 NR8 IDX1\nEND PGM SUB MM\n";
  expectFinished(
      world.run("BEGIN PGM A INCH\nQ20 = 7\nQ1 = 20\nFN 18: SYSREAD Q2 = ID15 NR11 IDXQ1\nQL3 = 9\n"
                "FN 18: SYSREAD Q3 = ID15 NR12 IDX3\nCALL PGM SUB.H\nQS1 = \"TNC:\\LOG.A\"\n"
                "FN 18: SYSREAD Q6 = ID10 NR110 IDX1\nQS1 = \"NONE.A\"\n"
                "FN 18: SYSREAD Q7 = ID10 NR110 IDX1\nFN 18: SYSREAD Q8 = ID10 NR6\n"
                "CYCL DEF 200 A ~\n Q200=1\nFN 18: SYSREAD Q9 = ID10 NR3\nEND PGM A INCH\n"));
  EXPECT_EQ(world.q(2), 7);
  EXPECT_EQ(world.q(3), 9);
  EXPECT_EQ(world.q(4), 0);
  EXPECT_EQ(world.q(5), 1);
  EXPECT_EQ(world.q(6), 1);
  EXPECT_EQ(world.q(7), 0);
  EXPECT_EQ(world.q(8), -1);
  EXPECT_EQ(world.q(9), 200);
}

/// ID 350 NR 10 to 15 are those of the older control.
TEST(SystemData, CalibrationOfTheTouchProbe) {
  World world;
  auto& tools = world.control->tables.tools;
  auto& probes = world.control->tables.probes;
  ASSERT_TRUE(probes.setNumber("1", "CAL_OF1", 0.03));
  ASSERT_TRUE(probes.setNumber("1", "CAL_OF2", 0.03));
  ASSERT_TRUE(probes.setNumber("1", "CAL_ANG", 15));
  expectFinished(
      world.run("TOOL CALL 1 Z\nFN 18: SYSREAD Q1 = ID350 NR10\nFN 18: SYSREAD Q2 = ID350 NR11\n"
                "FN 18: SYSREAD Q3 = ID350 NR12\nFN 18: SYSREAD Q4 = ID350 NR14 IDX1\n"
                "FN 18: SYSREAD Q5 = ID350 NR15\nFN 18: SYSREAD Q6 = ID350 NR54\n"));
  EXPECT_EQ(world.q(1), 2);
  EXPECT_EQ(world.q(2), tools.number("1", "R"));
  EXPECT_EQ(world.q(3), tools.number("1", "L"));
  EXPECT_DOUBLE_EQ(world.q(4), 0.03);
  EXPECT_DOUBLE_EQ(world.q(5), 30);
  EXPECT_DOUBLE_EQ(world.q(6), 15);
}

/// The newer control keeps centre offset and angle in the touch probe table; FN 17 writes them where FN 18 reads them.
TEST(SystemData, ProgramsWriteTheCentreOffset) {
  World world;
  expectFinished(
      world.run("TOOL CALL 1 Z\nFN 17: SYSWRITE ID50 NR24 IDX1 = +0.03\nFN 17: SYSWRITE ID950 NR25 = -0.02\n"
                "FN 17: SYSWRITE ID50 NR26 IDX1 = +15\nFN 18: SYSREAD Q1 = ID50 NR24 IDX1\n"
                "FN 18: SYSREAD Q2 = ID350 NR53 IDX2\nFN 18: SYSREAD Q3 = ID350 NR54\n"));
  EXPECT_DOUBLE_EQ(world.q(1), 0.03);
  EXPECT_DOUBLE_EQ(world.q(2), -0.02);
  EXPECT_DOUBLE_EQ(world.q(3), 15);
  const auto& probes = world.control->tables.probes;
  EXPECT_DOUBLE_EQ(probes.number("1", "CAL_OF1").value_or(0), 0.03);
  // A tool that is not a touch probe has no row there.
  EXPECT_THAT(messageOf(world.run("FN 17: SYSWRITE ID50 NR24 IDX2 = +0.03\n")), HasSubstr("ID50 NR24"));
}

TEST(SystemData, ModelOfTheTouchProbe) {
  const std::pair<const char*, int> models[] = {{"TS120", 0}, {"TS220", 1}, {"TS440", 2}, {"TS630", 3}, {"TS632", 4},
                                                {"TS640", 5}, {"TS444", 6}, {"TS740", 7}, {"TS999", 0}};
  for (const auto& [model, number] : models) {
    World world;
    ASSERT_TRUE(world.control->tables.probes.setText("1", "TYPE", model));
    expectFinished(
        world.run("TOOL CALL 1 Z\nFN 18: SYSREAD Q1 = ID350 NR50 IDX1\n"
                  "FN 18: SYSREAD Q2 = ID350 NR50 IDX2\n"));
    EXPECT_EQ(world.q(1), number) << model;
    EXPECT_EQ(world.q(2), 1) << "the row";
  }
}

TEST(SystemData, ReadingOfARotaryAxisWithoutWholeTurns) {
  World world("mill5-head-table");
  expectFinished(
      world.run("L C+730 R0 FMAX\nFN 18: SYSREAD Q1 = ID240 NR1 IDX6\nM94 C\n"
                "FN 18: SYSREAD Q2 = ID240 NR1 IDX6\nL C+20 R0 FMAX\nFN 18: SYSREAD Q3 = ID240 NR1 IDX6\n"));
  EXPECT_NEAR(world.q(1), 730, 1e-9);
  EXPECT_NEAR(world.q(2), 10, 1e-9);
  EXPECT_NEAR(world.q(3), 20, 1e-9);
}

/// ID 360 NR 2 reads the machine's axes at the last touch, with the whole turns and the offset of a rotary axis.
TEST(SystemData, AxesOfTheLastTouch) {
  World world("mill5-head-table");
  const auto c = world.machine->description().axisIndex("C");
  ASSERT_TRUE(c);
  control::TouchRecord touch;
  touch.outcome = "touched";
  touch.surface = {1, 2, 3};
  touch.latched[0] = 11;
  touch.latched[1] = -12;
  touch.latched[2] = -130.5;
  touch.latched[*c] = 400;
  world.control->journal.cycles.emplace_back().touches = {touch};
  expectFinished(
      world.run("FN 18: SYSREAD Q1 = ID360 NR2 IDX1\nFN 18: SYSREAD Q2 = ID360 NR2 IDX2\n"
                "FN 18: SYSREAD Q3 = ID360 NR2 IDX3\nFN 18: SYSREAD Q6 = ID360 NR2 IDX6\n"
                "FN 18: SYSREAD Q11 = ID360 NR1 IDX1\n"));
  EXPECT_EQ(world.q(1), 11);
  EXPECT_EQ(world.q(2), -12);
  EXPECT_EQ(world.q(3), -130.5);
  EXPECT_EQ(world.q(6), 400);
  EXPECT_EQ(world.q(11), 1);
  EXPECT_THAT(messageOf(world.run("FN 18: SYSREAD Q1 = ID360 NR2 IDX7\n")), HasSubstr("ID360")) << "no axis U";
}

TEST(SystemData, WhatTheControlDoesNotHaveIsRefused) {
  World world;
  EXPECT_THAT(messageOf(world.run("FN 18: SYSREAD Q1 = ID990 NR77\n")), HasSubstr("ID990 NR77"));
  EXPECT_THAT(messageOf(world.run("FN 18: SYSREAD Q1 = ID360 NR1 IDX1\n")), HasSubstr("ID360"));
  EXPECT_THAT(messageOf(world.run("FN 17: SYSWRITE ID50 NR99 IDX1 = +1\n")), HasSubstr("ID50 NR99"));
  World fresh;
  for (const char* block : {"FN 18: SYSREAD Q1 = ID50 NR1 IDX7\n", "FN 17: SYSWRITE ID50 NR4 IDX7 = +1\n"})
    EXPECT_THAT(messageOf(fresh.run(block)), HasSubstr("IDX7 on this control: TOOL.T has no row 7"));
  // What is no datum of a tool is missing whichever row is asked for.
  EXPECT_THAT(messageOf(fresh.run("FN 18: SYSREAD Q1 = ID50 NR99 IDX7\n")),
              ::testing::AllOf(HasSubstr("ID50 NR99"), ::testing::Not(HasSubstr("TOOL.T"))));
  for (const int format : {-1, 17, 18, 19, 21, 22, 40})
    EXPECT_THAT(messageOf(world.run(fmt::format("QS1 = SYSSTR( ID10321 NR{} )\n", format))), HasSubstr("ID10321"));
  EXPECT_THAT(messageOf(world.run("QS1 = \"\"\nQS2 = CFGREAD( KEY_QS1 TAG_\"CfgX\" ATR_\"unknown\" )\n")),
              HasSubstr("unknown of CfgX"));
}

TEST(SystemData, Texts) {
  World world;
  world.control->wallClockStart = 1'699'261'506;  // 2023-11-06 09:05:06 UTC, a Monday of week 45
  const auto text = [&](const std::string& arguments) {
    expectFinished(world.run("TOOL CALL 1 Z\nQS1 = \"\"\nQS9 = " + arguments + "\n"));
    return world.control->q.qs(9);
  };
  EXPECT_EQ(text("SYSSTR( ID10321 NR0 )"), "06.11.2023 09:05:06");
  EXPECT_EQ(text("SYSSTR( ID10321 NR3 )"), "6.11.23 9:05");
  EXPECT_EQ(text("SYSSTR( ID10321 NR4 )"), "2023-11-06 09:05:06");
  EXPECT_EQ(text("SYSSTR( ID10321 NR10 )"), "6.11.23");
  EXPECT_EQ(text("SYSSTR( ID10321 NR12 )"), "23-11-06");
  EXPECT_EQ(text("SYSSTR( ID10321 NR15 )"), "9:05");
  EXPECT_EQ(text("SYSSTR( ID10321 NR20 )"), "45");
  EXPECT_EQ(text("SYSSTR( ID10321 NR11 LEN4 )"), "2023");
  EXPECT_EQ(text("SYSSTR( ID10321 NR11 LEN1 )"), "2");
  EXPECT_EQ(text("SYSSTR( ID10321 NR11 LEN0 )"), "");
  EXPECT_EQ(text("SYSSTR( ID10321 NR11 LEN99 )"), "2023-11-06");
  EXPECT_EQ(text("SYSSTR( ID10060 NR1 )"), "PROBE");
  EXPECT_EQ(text("SYSSTR( ID10950 NR1 IDX5 )"), "MILL");
  EXPECT_EQ(text("SYSSTR( ID10010 NR1 )"), "main.h");
  world.library.texts["COUNT.H"] = "BEGIN PGM COUNT MM\nEND PGM COUNT MM\n";
  world.library.texts["OTHER.H"] = "BEGIN PGM OTHER MM\nEND PGM OTHER MM\n";
  expectFinished(
      world.run("CYCL DEF 12.0 PGM CALL\nCYCL DEF 12.1 PGM COUNT.H\nSEL PGM \"OTHER.H\"\n"
                "QS3 = SYSSTR( ID10010 NR3 )\nQS4 = SYSSTR( ID10010 NR10 )\n"));
  EXPECT_EQ(world.control->q.qs(3), "COUNT.H");
  EXPECT_EQ(world.control->q.qs(4), "OTHER.H");
  EXPECT_EQ(text("CFGREAD( KEY_QS1 TAG_\"CfgDisplayLanguage\" ATR_\"ncLanguage\" )"), "ENGLISH");
  EXPECT_EQ(text("CFGREAD( KEY_QS1 TAG_\"CfgDisplayData\" ATR_\"axisDisplayOrder\" IDX1 )"), "Y");
  EXPECT_EQ(text("CFGREAD( KEY_QS1 TAG_\"CfgDisplayData\" ATR_\"axisDisplayOrder\" IDX0 )"), "X");
  world.control->panel.language = control::DialogLanguage::Swedish;
  EXPECT_EQ(text("CFGREAD( KEY_QS1 TAG_\"CfgDisplayLanguage\" ATR_\"ncLanguage\" )"), "SWEDISH");
  expectFinished(world.run("QS1 = \"\"\nQ1 = CFGREAD( KEY_QS1 TAG_\"CfgTS\" ATR_\"maxTouchFeed\" )\n"));
  EXPECT_EQ(world.q(1), world.control->parameters.maxTouchFeed);
}

TEST(Protocols, ShowOnlyTheLinesOfTheControlsLanguage) {
  World world;
  world.files["M.A"] =
      "* a comment; \"with\" signs\nL_GERMAN\n\"MESSPROTOKOLL\";\nL_ENGLISH;\n\"MEASURING LOG\";\nL_ALL;\n\"D = "
      "%7.2f\",Q1;\n";
  expectFinished(world.run("Q1 = 5\nFN 16: F-PRINT M.A / R.TXT\n"));
  EXPECT_EQ(world.control->panel.files().at("R.TXT"), "MEASURING LOG\nD =    5.00\n");
}

TEST(Protocols, HideLinesWithoutTexts) {
  World world;
  world.files["M.A"] = "\"<%S>\",QS1;\nM_EMPTY_HIDE\n\"[%S]\",QS1;\n\"[%S%S]\",QS1,QS2;\nM_EMPTY_SHOW\n\"(%S)\",QS1;\n";
  expectFinished(world.run("QS1 = \"\"\nQS2 = \"B\"\nFN 16: F-PRINT M.A / R.TXT\n"));
  EXPECT_EQ(world.control->panel.files().at("R.TXT"), "<>\n[B]\n()\n");
}

TEST(Protocols, GoOnOrBeginAnewAsTheMaskSays) {
  const auto twice = [](const std::string& keyword) {
    World world;
    world.files["M.A"] = keyword + "\n\"LINE %d\",Q1;\n";
    expectFinished(world.run("Q1 = 1\nFN 16: F-PRINT M.A / R.TXT\nQ1 = 2\nFN 16: F-PRINT M.A / R.TXT\n"));
    return world.control->panel.files().at("R.TXT");
  };
  EXPECT_EQ(twice(""), "LINE 1\nLINE 2\n");
  EXPECT_EQ(twice("M_CLOSE"), "LINE 2\n");
  EXPECT_EQ(twice("M_TRUNCATE"), "LINE 2\n");
  EXPECT_EQ(twice("M_APPEND\nM_CLOSE"), "LINE 1\nLINE 2\n");
  World world;
  world.files["M.A"] = "M_APPEND_MAX1\n\"" + std::string(599, '=') + "\";\n";
  expectFinished(world.run("FN 16: F-PRINT M.A / R.TXT\nFN 16: F-PRINT M.A / R.TXT\n"));
  EXPECT_EQ(world.control->panel.files().at("R.TXT").size(), 600);
}

TEST(Protocols, GoToTheScreenAndNameTheirProgram) {
  World world;
  world.files["M.A"] = "CALL_PATH\n\"DONE\";\n";
  expectFinished(world.run("FN 16: F-PRINT M.A / Screen:\nfn 16: f-print M.A / sclr:\n"));
  const auto& events = world.control->journal.events;
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].text, "main.h\nDONE");
  EXPECT_TRUE(world.control->panel.files().empty());
}

TEST(Protocols, FN38SendsItsTextWithItsValues) {
  World world;
  expectFinished(world.run("Q1 = 5\nQ23 = -0.5\nFN 38: SEND /\"Q1: %F, Q23: %F\" / +Q1 / +Q23\nFN 38: SEND\n"));
  const auto& events = world.control->journal.events;
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].text, "FN 38: Q1: 5.000, Q23: -0.500");
}

TEST(Protocols, MistakesOfMasks) {
  World world;
  const auto mistake = [&](const std::string& mask) {
    world.files["M.A"] = mask;
    return messageOf(world.run("Q1 = 1\nFN 16: F-PRINT M.A / R.TXT\n"));
  };
  EXPECT_THAT(mistake("\"%F\";\n"), HasSubstr("more % than parameters"));
  EXPECT_THAT(mistake("\"%Z\",Q1;\n"), HasSubstr("%Z is not a format"));
  EXPECT_THAT(mistake("\"%F\",X1;\n"), HasSubstr("X1 is not a Q parameter"));
  EXPECT_THAT(mistake("M_WRONG\n"), HasSubstr("M_WRONG is neither a format line"));
  EXPECT_THAT(mistake("M_APPEND_MAX\n"), HasSubstr("kilobytes"));
  EXPECT_THAT(messageOf(world.run("FN 16: F-PRINT M.A\n")), HasSubstr("separated by /"));
}

}  // namespace
}  // namespace probewright::language::klartext::testing
