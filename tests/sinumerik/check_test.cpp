#include "language/sinumerik/check.hpp"

#include <gtest/gtest.h>

#include "cycles/catalogue.hpp"

namespace probewright::language::sinumerik {
namespace {

Diagnostics checkText(const std::string& text) {
  const auto program = SinumerikProgram::fromText("test.mpf", text);
  return check(*program);
}

TEST(SinumerikCheck, AGoodProgramHasNoMistakes) {
  const Diagnostics found = checkText(
      "%_N_RING_MPF\n"
      "DEF REAL DIA_1, DIA_2[3]\n"
      "DEF STRING[20] GOAL=\"LB_1\"\n"
      "G54 G17 T=\"PROBE\" M6 D1\n"
      "DIA_1=_OVR[4]+$AA_IM[X]\n"
      "FOR R1=0 TO 2\n"
      "  DIA_2[R1]=DIA_1*R1\n"
      "ENDFOR\n"
      "IF DIA_1>5 GOTOF GOAL\n"
      "IF DIA_1>5 GOTOF LB_1\n"
      "GOTOC LB_9\n"
      "GOTOB N10\n"
      "LB_1: M30\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].message, "the destination N10 is missing");
}

TEST(SinumerikCheck, NamesTheNextProgramOfAnArchive) {
  const Diagnostics found =
      checkText("%_N_AA_MPF\n;$PATH=/_N_MPF_DIR\nG0 X5\nM30\n%_N_BB_SPF\n;$PATH=/_N_SPF_DIR\nG0 X6\nM17\n");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].place.line, 5U);
  EXPECT_EQ(found[0].message, "%_N_BB_SPF begins another program in the middle of this one");
  EXPECT_TRUE(checkText("\n; archived\n%_N_AA_MPF\n;$PATH=/_N_MPF_DIR\nG0 X5\nM30\n").empty());
}

TEST(SinumerikCheck, KnowsWhatEachDigitOfACycleParameterCanBe) {
  const auto complaint = [](const std::string& call) {
    const Diagnostics found = checkText(call + "\nM30\n");
    return found.empty() ? std::string() : found[0].message;
  };
  // A hole, with correction of the radius of D2 in the wear, inverted; coarse; four measurements at each point.
  EXPECT_EQ(complaint("CYCLE977(21201,10001,10400002,1,40,,,8,4,0,,,,1,4,\"\",,0,,,,,,,,1,1)"), "");
  EXPECT_EQ(complaint("CYCLE977(108,,,1,40)"),
            "argument 1 of CYCLE977: S_MVAR (measuring variant) cannot be 108: its units (feature) can be 1 (hole), 2 "
            "(circular spigot), 3 (groove), 4 (rib), 5 (rectangular pocket), 6 (rectangular spigot); not 8");
  EXPECT_EQ(complaint("CYCLE977(171,,,1,40)"),
            "argument 1 of CYCLE977: S_MVAR (measuring variant) cannot be 171: its tens have no meaning and must be 0, "
            "not 7");
  EXPECT_EQ(complaint("CYCLE977(-101,,,1,40)"),
            "argument 1 of CYCLE977: S_MVAR (measuring variant) cannot be -101: a coded number is not negative");
  EXPECT_EQ(complaint("CYCLE978(100,14001,,1,0)"),
            "argument 2 of CYCLE978: S_KNUM (zero offset to correct) cannot be 14001: its thousands (kind) can be 0 "
            "(settable zero offset), 1 (basic zero offset of the channel), 2 (base reference), 3 (global basic zero "
            "offset), 9 (active zero offset); not 4");
  EXPECT_EQ(complaint("CYCLE978(100,1,,13,0)"),
            "argument 4 of CYCLE978: S_PRNUM (calibration data set of the probe, 1 to 12; 0 counts as 1) cannot be 13: "
            "the largest is 12");
}

TEST(SinumerikCheck, NamesAllMistakesInTheOrderOfTheProgram) {
  const Diagnostics found = checkText(
      "DEF REAL DEPTH\n"
      "DEPHT=5\n"
      "G0 X10 X20\n"
      "AB_1: R1=NOWHERE\n"
      "IF R1==1\n"
      "GOTOF AB_1\n"
      "GOTOB AB_2\n"
      "AB_1: R1=$XYZ\n"
      "DEF INT DEPTH\n"
      "M30\n");
  ASSERT_EQ(found.size(), 9u);
  std::vector<std::string> messages;
  for (const Diagnostic& diagnostic : found)
    messages.push_back(std::to_string(diagnostic.place.line) + ":" + std::to_string(diagnostic.place.column) + " " +
                       diagnostic.message);
  EXPECT_EQ(messages, (std::vector<std::string>{
                          "2:1 DEPHT is not declared",
                          "3:8 the address X appears twice in this block",
                          "4:10 NOWHERE is not declared",
                          "5:1 IF is not closed by ENDIF",
                          "7:7 the destination AB_2 is missing",
                          "8:1 the label AB_1 is also defined in line 4",
                          "8:10 the control has no system variable $XYZ",
                          "9:1 this DEF comes after the first block that is executed",
                          "9:9 the variable DEPTH is declared twice",
                      }));
  EXPECT_EQ(found[0].advice, "Did you mean DEPTH?");
  EXPECT_EQ(found[4].advice, "Did you mean AB_1?");
  EXPECT_EQ(format(found[1]),
            "test.mpf:3:8: error: the address X appears twice in this block\n    G0 X10 X20\n"
            "    Write each address once in a block.");
}

TEST(SinumerikCheck, AJumpInTheWrongDirectionIsAMistake) {
  const Diagnostics found = checkText("AB_1: R1=1\nGOTOF AB_1\nM30\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].message, "the destination AB_1 exists only before this block");
  EXPECT_EQ(found[0].advice, "Write GOTOB or GOTO.");
}

TEST(SinumerikCheck, MachiningCyclesAreNamedAsSkipped) {
  const Diagnostics found = checkText("CYCLE81(10,0,2,-5)\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Severity::Warning);
}

TEST(SinumerikCheck, ComparisonsBesideLogicWantParentheses) {
  const Diagnostics found = checkText(
      "IF R1==1 AND R2==2 GOTOF AB_1\nIF (R1==1) AND (R2==2) GOTOF AB_1\n"
      "R3=R1==(R1 OR R2)\nAB_1: M30\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Severity::Warning);
  EXPECT_EQ(found[0].place.line, 1u);
}

TEST(SinumerikCheck, MeasuringCyclesThatAreMissingAreNamedSo) {
  if (cycles::sinumerikCycle("CYCLE9960") != nullptr) GTEST_SKIP() << "the catalogue has CYCLE9960";
  const Diagnostics found = checkText("CYCLE9960(1)\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].message, "the measuring cycle CYCLE9960 is not available");
}

TEST(SinumerikCheck, ArgumentsOfMeasuringCyclesAreHeldAgainstTheCatalogue) {
  if (cycles::sinumerikCycle("CYCLE977") == nullptr) GTEST_SKIP() << "the catalogue has no CYCLE977";
  std::string call = "CYCLE977(1";
  for (int i = 0; i < 60; ++i)
    call += i < 40 ? ",0" : ",1";
  bool tooMany = false;
  for (const Diagnostic& diagnostic : checkText(call + ")\n"))
    tooMany |= diagnostic.message.find("CYCLE977 takes at most") == 0;
  EXPECT_TRUE(tooMany);
  // Places that newer versions of the cycles have more ask for nothing while they are empty or 0.
  const std::string known = "CYCLE977(1,,,1,40,,,10,5,,,,,,,,,,,,,,,,,,1";
  for (const char* more : {",,,", ",0,0", ",,,\"\",,0"})
    EXPECT_TRUE(checkText(known + more + ")\n").empty()) << more;
  EXPECT_EQ(checkText(known + ",,2)\n").size(), 1u);
  const Diagnostics text = checkText("CYCLE977(\"hole\",,,1,40,,,10,5)\n");
  ASSERT_FALSE(text.empty());
  EXPECT_NE(text[0].message.find("argument 1 of CYCLE977: S_MVAR"), std::string::npos) << text[0].message;
  EXPECT_EQ(text[0].place.column, 10u);
}

/// The messages of errors, those of warnings in parentheses.
std::string told(const std::string& text) {
  std::string all;
  for (const Diagnostic& each : checkText(text)) {
    const std::string line = std::to_string(each.place.line) + ":" + std::to_string(each.place.column);
    all +=
        each.severity == Severity::Error ? line + " " + each.message + "\n" : "(" + line + " " + each.message + ")\n";
  }
  return all;
}

TEST(SinumerikCheck, SystemVariablesAreKnownByTheirNames) {
  for (const char* wrong : {"$P_UIFRR[1,X,TR]", "$SNS_MEA_WP_BALL_DIAMM[0]", "$TC_DPX[1,1]", "$TC_DP26[1,1]",
                            "$AA_FOO[X]", "$AC_TIMR", "$A_IM[1]", "$P_", "$TC_", "$FOO"}) {
    const std::string name = std::string(wrong).substr(0, std::string(wrong).find('['));
    EXPECT_EQ(told(std::string("R1=") + wrong + "\nM30"), "1:4 the control has no system variable " + name + "\n");
    EXPECT_EQ(told(std::string(wrong) + "=1\nM30"), "1:1 the control has no system variable " + name + "\n");
  }
  for (const char* right :
       {"$P_UIFR[1,X,TR]", "$SNS_MEA_WP_BALL_DIAM[0]", "$TC_DP25[1,1]", "$TC_SCP13[1,1]", "$TC_TP2[1]", "$AA_IW[X]",
        "$AA_MW1[X]", "$AC_TIME", "$A_YEAR", "$P_TOOLNO", "$MC_MM_NUM_USER_FRAMES", "$PI", "$P_IFRAME[X,TR]", "$R[1]",
        "$SCS_MEA_EMPIRIC_VALUE[3]", "$AC_MARKER[1]", "$TC_CARR34[1]"})
    EXPECT_EQ(told(std::string("R1=") + right + "\nM30"), "");
  // The control has it, the virtual machine nothing behind it: named once.
  EXPECT_EQ(told("R1=$AA_CURR[X]\nR2=$AA_CURR[Y]\n$MN_FOO=3\nM30"),
            "(1:4 $AA_CURR has no meaning here)\n(3:1 $MN_FOO has no meaning here)\n");
  const Diagnostics close = checkText("R1=$P_UIFRR[1,X,TR]\nR2=$SNS_MEA_WP_BALL_DIAMM[0]\nM30");
  ASSERT_EQ(close.size(), 2u);
  EXPECT_EQ(close[0].advice, "Did you mean $P_UIFR?");
  EXPECT_EQ(close[1].advice, "Did you mean $SNS_MEA_WP_BALL_DIAM?");
}

TEST(SinumerikCheck, NamesOfDataThatTheControlHasAreRight) {
  const auto program = SinumerikProgram::fromText("test.mpf", "R1=$MN_USER_DATA_INT[1]\nR2=$AA_FOO[X]\nM30");
  CheckOptions options;
  options.globalVariables = {"$MN_USER_DATA_INT", "$AA_FOO"};
  EXPECT_TRUE(check(*program, options).empty());
}

TEST(SinumerikCheck, DefinitionsStandAtTheBeginning) {
  EXPECT_EQ(told("G0 X1\nDEF REAL XX1\nDEF REAL XX2\nXX1=XX2\nM30"),
            "2:1 this DEF comes after the first block that is executed\n");
  EXPECT_EQ(told("; remark\nPROC MAIN(REAL AA_1)\nEXTERN SUB_1(REAL)\nN10 DEF REAL XX1\nDEFINE QUICK AS G0\n"
                 "DEF INT XX2\nXX1=XX2\nM30"),
            "");
}

TEST(SinumerikCheck, OnlyTheCauseOfABrokenProcIsTold) {
  EXPECT_EQ(told("PROC SUB_1(REAL AA_1,REAL B,INT CC_1)\nAA_1=CC_1+AA_1\nM17"),
            "1:27 the name B of a parameter does not begin with two letters or underscores\n");
  EXPECT_EQ(told("PROC SUB_1(RAEL AA_1,INT CC_1)\nAA_1=CC_1\nM17"), "1:12 the type of a parameter was expected\n");
}

TEST(SinumerikCheck, KnowsWhatForbidsAMeasuringCycle) {
  const std::string cycle = "CYCLE978(0,,,1,0,5,3,1,1)\nM30";
  EXPECT_EQ(told("G41 X5\nX10\n" + cycle), "3:1 G41 is active: the control refuses CYCLE978 with alarm 61300\n");
  EXPECT_EQ(told("G42 X5\nG40 X10\n" + cycle), "");
  EXPECT_EQ(told("SCALE X2 Y2\nAROT Z10\n" + cycle),
            "3:1 a scale factor is active: the control refuses CYCLE978 with alarm 61310\n");
  CheckOptions mill;
  mill.onMill = true;
  const auto onMill = [&](const std::string& before) {
    const Diagnostics found = check(*SinumerikProgram::fromText("test.mpf", before + "\n" + cycle), mill);
    return found.empty() ? "" : found.front().message;
  };
  EXPECT_EQ(onMill("MIRROR X0"),
            "mirroring is active: the control refuses CYCLE978 with alarm 61310, except with a turning probe");
  EXPECT_EQ(onMill("MIRROR X0\nAMIRROR X0"), "");
  EXPECT_EQ(onMill("MIRROR X0\nMIRROR"), "");
  EXPECT_EQ(told("MIRROR X0\n" + cycle), "") << "counter-spindles of lathes may be mirrored";
  for (const char* harmless :
       {"SCALE X1", "SCALE X2\nSCALE", "SCALE X2\nTRANS X5", "ASCALE X=R1", "SCALE X2\nASCALE X0.5"})
    EXPECT_EQ(told(std::string(harmless) + "\n" + cycle), "") << harmless;
  for (const char* unknown :
       {"G41 X5\nIF R1==1\nG40\nENDIF", "IF R1==1 GOTOF NEXT_1\nG41\nNEXT_1:", "G41 X5\n/G40", "G41 X5\nCALL R2"})
    EXPECT_EQ(told(std::string(unknown) + "\n" + cycle).find("is active"), std::string::npos) << unknown;
}

TEST(SinumerikCheck, LengthsBelowZeroAreMistakes) {
  EXPECT_NE(told("CYCLE978(0,,,1,0,-5,3,1,1)\nM30").find("argument 6 of CYCLE978: S_FA"), std::string::npos);
  EXPECT_NE(told("CYCLE978(0,,,1,0,5,-3,1,1)\nM30").find("argument 7 of CYCLE978: S_TSA"), std::string::npos);
  EXPECT_EQ(told("CYCLE978(0,,,1,0,5,3,1,1)\nM30"), "");
}

}  // namespace
}  // namespace probewright::language::sinumerik
