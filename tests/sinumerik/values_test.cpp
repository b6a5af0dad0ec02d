#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>

#include "language/sinumerik/check.hpp"
#include "sinumerik/world.hpp"

/// Expressions, variables, flow: what programs compute, held against C++ and closed forms.
namespace probewright::language::sinumerik {
namespace {

TEST(SinumerikValues, ExpressionsAreWorthWhatTheLanguageSays) {
  World world;
  const std::pair<const char*, double> cases[] = {
      {"2+3*4", 14},
      {"(2+3)*4", 20},
      {"-2*-3", 6},
      {"7 DIV 2", 3},
      {"-7 DIV 2", -3},
      {"7 MOD 4", 3},
      {"7/2", 3.5},
      {"1EX2+1EX-1", 100.1},
      {"'HFF' B_AND 'B1100'", 12},
      {"12 B_OR 3", 15},
      {"12 B_XOR 10", 6},
      {"B_NOT 0", -1},
      {"NOT 0", 1},
      {"(1==1) AND NOT (2<1)", 1},
      {"(1>2) OR (2>=2)", 1},
      {"TRUE XOR TRUE", 0},
      {"3<>4", 1},
      {"0.1+0.2==0.3", 1},       // relative equality of 1EX-12
      {"NUMBER(<<1<<2+3)", 15},  // << before a value makes a text of it
      {"STRLEN(<<-12.5)", 5},
      {"STRLEN((<<7)<<(<<8))", 2},
      {"SIN(30)", 0.5},
      {"COS(60)", 0.5},
      {"TAN(45)", 1},
      {"ASIN(1)", 90},
      {"ACOS(0)", 90},
      {"ATAN2(1,-1)", 135},
      {"SQRT(2)*SQRT(2)", 2},
      {"POT(-3)", 9},
      {"ABS(-4.5)", 4.5},
      {"LN(EXP(2))", 2},
      {"ROUND(2.5)", 3},
      {"ROUND(-2.4)", -2},
      {"ROUNDUP(2.1)", 3},
      {"TRUNC(-2.7)", -2},
      {"MINVAL(3,-4)", -4},
      {"MAXVAL(3,-4)", 3},
      {"BOUND(0,10,12)", 10},
      {"BOUND(0,10,-1)", 0},
      {"BOUND(0,10,5)", 5},
      {"$PI", std::numbers::pi},
      {"STRLEN(\"abc\")", 3},
      {"INDEX(\"abcb\",\"b\")", 1},
      {"RINDEX(\"abcb\",\"b\")", 3},
      {"INDEX(\"abc\",\"x\")", -1},
      {"NUMBER(\" -12.5 \")", -12.5},
      {"ISNUMBER(\"12a\")", 0},
      {"ISNUMBER(\"-1.5EX-2\")", 1},
      {"\"A\"<<1==\"A1\"", 1},
      {"ISVAR(\"R7\")", 1},
      {"ISVAR(\"R[7]\")", 1},
      {"ISVAR(\"X12\")", 0},
      {"ISVAR(\"NOTHING_\")", 0},
      {"ISAXIS(3)", 1},
      {"TOUPPER(\"aBc\")==\"ABC\"", 1},
      {"TOUPPER(\"azAZ@[`{\")==\"AZAZ@[`{\"", 1},
      {"TOLOWER(\"azAZ@[`{\")==\"azaz@[`{\"", 1},
      {"SUBSTR(\"PROBE\",1,3)==\"ROB\"", 1},
      {"SUBSTR(\"PROBE\",3)==\"BE\"", 1},
      {"SPRINT(\"%7.2F|%D|%s|%X\",3.14159,7,\"x\",255)==\"   3.14|7|x|FF\"", 1},
      {"SPRINT(\"%05d%%\",42)==\"00042%\"", 1},
  };
  for (const auto& [text, expected] : cases)
    EXPECT_NEAR(world.value(text), expected, 1e-12 * std::max(1.0, std::abs(expected))) << text;
}

/// Arrays have the elements that their declaration says, data of the control those that they have.
TEST(SinumerikValues, IsvarKnowsIndices) {
  const std::pair<const char*, double> cases[] = {
      {"LIST_", 1},        {"LIST_[0]", 1},     {"LIST_[2]", 1},      {"LIST_[3]", 0},     {"LIST_[-1]", 0},
      {"LIST_[?]", 0},     {"GRID_[1,2]", 1},   {"GRID_[0,0]", 1},    {"GRID_[2,0]", 0},   {"GRID_[0,3]", 0},
      {"GRID_[1, 2]", 1},  {"grid_[1,2]", 1},   {"grid_[ 1 , 3]", 0}, {"$TC_DP1[1,1]", 1}, {"$TC_DP1[1,2]", 1},
      {"$TC_DP1[1,3]", 0}, {"$TC_DP1[7,1]", 0}, {"$TC_TP2[2]", 1},    {"$TC_TP2[3]", 0},   {"R[12]", 1},
      {"$P_TOOLNO", 1},    {"$AA_IM[X]", 1},    {"_OVR[4]", 1},       {"$NOTHING[1]", 0},  {"RESTS[1]", 0},
      {"R1X", 0}};
  for (const auto& [name, expected] : cases) {
    World world;
    world.run(fmt::format("DEF REAL LIST_[3]\nDEF INT GRID_[2,3]\nR1=ISVAR(\"{}\")\nM30\n", name));
    EXPECT_EQ(world.r(1), expected) << name;
  }
}

TEST(SinumerikValues, RandomArithmeticAgreesWithTheCompiler) {
  std::mt19937_64 random(11);
  World world;
  for (int i = 0; i < 200; ++i) {
    const double a = static_cast<double>(random() % 20001) / 100 - 100, b = static_cast<double>(random() % 999 + 1) / 7,
                 c = static_cast<double>(random() % 50) - 25;
    const std::string text = fmt::format("({}-{})*{}/({}+1)-{}*({})", a, b, c, b, b, a);
    EXPECT_NEAR(world.value(text), (a - b) * c / (b + 1) - b * a, 1e-9) << text;
  }
}

TEST(SinumerikValues, VariablesConvertToTheirType) {
  World world;
  world.run(
      "DEF INT II\nDEF BOOL BB\nDEF CHAR CC\nDEF STRING[3] SS\nDEF REAL AA[2,3]=SET(1,2,3,4,5,6)\n"
      "II=2.5\nBB=17\nCC=\"A\"\nSS=\"abcdef\"\n"
      "R1=II R2=BB R3=CC R4=STRLEN(SS) R5=AA[1,0] R6=AA[0,2]\n"
      "AA[1,1]=SET(50,60)\nR7=AA[1,2]\nAA[0,0]=REP(9)\nR8=AA[0,0]+AA[1,2]\n"
      "R[10+1]=3\nR12=R[R11+8]\n");
  EXPECT_EQ(world.r(1), 3);
  EXPECT_EQ(world.r(2), 1);
  EXPECT_EQ(world.r(3), 65);
  EXPECT_EQ(world.r(4), 3);
  EXPECT_EQ(world.r(5), 4);
  EXPECT_EQ(world.r(6), 3);
  EXPECT_EQ(world.r(7), 60);
  EXPECT_EQ(world.r(8), 18);
  EXPECT_EQ(world.r(12), 3);
}

TEST(SinumerikValues, MistakesRaiseTheControlsAlarms) {
  World world;
  EXPECT_EQ(world.alarm("R1=NOWHERE\n"), "12550");
  EXPECT_EQ(world.alarm("NOWHERE=1\n"), "12550");
  EXPECT_EQ(world.alarm("DEF REAL AA[3]\nAA[3]=1\n"), "17020");
  EXPECT_EQ(world.alarm("DEF REAL AA[3,2]\nAA[1,2]=1\n"), "17030");
  EXPECT_EQ(world.alarm("DEF INT II\nII=3EX9\n"), "12160");
  EXPECT_EQ(world.alarm("DEF INT II\nII=\"a\"\n"), "12150");
  EXPECT_EQ(world.alarm("R1=1/0\n"), "14051");
  EXPECT_EQ(world.alarm("R1=SQRT(-1)\n"), "14051");
  EXPECT_EQ(world.alarm("GOTOF NO_WHERE\n"), "14080");
  EXPECT_EQ(world.alarm("NO_PROG\n"), "14011");
  EXPECT_EQ(world.alarm("SETAL(65001,\"too hot\")\n"), "65001");
  EXPECT_EQ(world.alarm("R1=NUMBER(\"x\")\n"), "14020");
  EXPECT_EQ(world.alarm("$P_TOOLNO=3\n"), "12130");
  EXPECT_EQ(world.alarm("R20000=1\n"), "17020");
}

TEST(SinumerikValues, ArraysHaveOneTo65536Elements) {
  for (const auto& [size, refused] : {std::pair("0", true),
                                      {"1", false},
                                      {"1.5", true},
                                      {"65536", false},
                                      {"65537", true},
                                      {"-1", true},
                                      {"2000000", true}}) {
    const std::string text = fmt::format("DEF REAL SIZE={}\nDEF BOOL AA[SIZE]\n", size);
    if (refused)
      EXPECT_EQ(World().alarm(text), "12200") << size;
    else
      World().run(text);
  }
  World().run("DEF INT SIZE=256\nDEF BOOL AA[SIZE,SIZE]\n");
  EXPECT_EQ(World().alarm("DEF INT SIZE=256\nDEF BOOL AA[SIZE,SIZE+1]\n"), "12200");
}

TEST(SinumerikValues, BlanksMayStandBeforeAnIndex) {
  World world;
  world.run("DEF REAL AA[3]\nAA[1]=7\nR1=AA [1]+1 R2=$TC_DP3\t[1,2]\n");
  EXPECT_EQ(world.r(1), 8);
  EXPECT_EQ(world.r(2), 90);
}

TEST(SinumerikFlow, LoopsAndBranches) {
  World world;
  world.run(
      "R1=0 R2=0 R3=0 R4=0 R5=0\n"
      "FOR R10=1 TO 10\n R1=R1+R10\nENDFOR\n"
      "WHILE R2<7\n R2=R2+2\nENDWHILE\n"
      "REPEAT\n R3=R3+1\nUNTIL R3>=4\n"
      "LOOP\n R4=R4+1\n IF R4==3 GOTOF OUT_1\nENDLOOP\n"
      "OUT_1: IF R1==55\n  IF R2==9\n R5=1\n ELSE\n R5=2\n ENDIF\nELSE\n R5=3\nENDIF\n"
      "CASE R5 OF 1 GOTOF CASE_A 2 GOTOF CASE_B DEFAULT GOTOF CASE_C\n"
      "CASE_A: R6=R5+10\nCASE_B: R6=R6+20\nGOTOF END_1\nCASE_C: R6=99\n"
      "END_1: R7=0\nSECT_1: R7=R7+1\nREPEAT SECT_1 P=3\nGOTOC NOWHERE_\nR8=8\n");
  EXPECT_EQ(world.r(1), 55);
  EXPECT_EQ(world.r(2), 8);
  EXPECT_EQ(world.r(3), 4);
  EXPECT_EQ(world.r(4), 3);
  EXPECT_EQ(world.r(5), 2);
  EXPECT_EQ(world.r(6), 20);
  EXPECT_EQ(world.r(7), 4);
  EXPECT_EQ(world.r(8), 8);
}

TEST(SinumerikFlow, JumpsToComputedLabelsAndBlockNumbers) {
  World world;
  world.run(
      "DEF STRING[20] GOAL\nR1=2\nGOAL=\"LB_\"<<R1\nGOTOF GOAL\nLB_1: R2=1\nM30\nLB_2: R2=22\nGOTOF N90\nR3=1\n"
      "N90 R4=4\n");
  EXPECT_EQ(world.r(2), 22);
  EXPECT_EQ(world.r(3), 0);
  EXPECT_EQ(world.r(4), 4);
}

TEST(SinumerikFlow, SubprogramsTakeParametersByValueAndByReference) {
  World world;
  world.texts.add("SUM_UP",
                  "PROC SUM_UP(REAL AA,REAL BB=7,VAR REAL RESULT,VAR INT LIST[],STRING[8] NAME=\"dflt\") SAVE\n"
                  "DEF REAL OWN=100\nRESULT=AA+BB+OWN\nLIST[2]=5\nAA=0\nR9=STRLEN(NAME)\nG91\nM17\n");
  world.run(
      "DEF REAL OUT\nDEF INT ARR[3]=SET(1,2,3)\nDEF REAL OWN=1\nR1=3 R9=0\nG90\nSUM_UP(R1,,OUT,ARR)\n"
      "R2=OUT R3=ARR[2]+ARR[0] R4=OWN\nSUM_UP(1,2,R5,ARR[ ],\"abc\")\nR6=$P_GG[14]\n");
  EXPECT_EQ(world.r(1), 3);
  EXPECT_EQ(world.r(2), 110);
  EXPECT_EQ(world.r(3), 6);
  EXPECT_EQ(world.r(4), 1);
  EXPECT_EQ(world.r(5), 103);
  EXPECT_EQ(world.r(9), 3);
  EXPECT_EQ(world.r(6), 1) << "SAVE brings G90 back";
}

TEST(SinumerikFlow, SubprogramsRepeatAndCallByEveryForm) {
  World world;
  world.texts.add("L100", "R1=R1+1\nM17\n");
  world.texts.add("COUNT_", "R2=R2+1\nRET\n");
  world.run("R1=0 R2=0\nL100 P3\nCOUNT_\nCALL \"COUNT_\"\nCOUNT_ P=R1\nEXTERN COUNT_\nPCALL COUNT_\n");
  EXPECT_EQ(world.r(1), 3);
  EXPECT_EQ(world.r(2), 6);
  EXPECT_EQ(world.alarm("L100(1)\n"), "14020");
}

TEST(SinumerikFlow, MacrosStandForTheirText) {
  World world;
  world.run(
      "DEFINE ZERO_ AS R1=0\nDEFINE BOTH_ AS ZERO_ R2=5\ndefine msg_1 as MSG(\"BOTH_ stays\")\n"
      "R1=7\nboth_ R3=R1+1\nMSG_1\n");
  EXPECT_EQ(world.r(1), 0);
  EXPECT_EQ(world.r(2), 5);
  EXPECT_EQ(world.r(3), 1);
  ASSERT_EQ(world.control.journal.events.size(), 1u);
  EXPECT_EQ(world.control.journal.events[0].text, "BOTH_ stays");
}

TEST(SinumerikFlow, UserProgramsTakePrecedenceOverCycles) {
  World world;
  world.texts.add("CYCLE977", "PROC CYCLE977(INT S_MVAR)\nR1=S_MVAR\nM17\n");
  world.run("CYCLE977(42)\n");
  EXPECT_EQ(world.r(1), 42);
}

TEST(SinumerikFlow, MachiningCyclesAreNotedOnceAndRefusedIfStrict) {
  World world;
  world.run("CYCLE81(10,0,2,-5)\nCYCLE81(10,0,2,-5)\nMSG(\"R=\"<<1.5)\nSETAL(62100,\"note\")\n");
  ASSERT_EQ(world.control.journal.events.size(), 3u);
  EXPECT_EQ(world.control.journal.events[0].kind, control::EventKind::Skipped);
  EXPECT_EQ(world.control.journal.events[1].text, "R=1.5");
  EXPECT_EQ(world.control.journal.events[1].place.line, 3u);
  EXPECT_EQ(world.control.journal.events[2].code, "62100");
  SinumerikHost strict(world.control, {.strict = true, .fileExists = {}});
  const auto result =
      execution::Interpreter(world.texts, strict).run(SinumerikProgram::fromText("M.MPF", "CYCLE81(10,0,2,-5)\n"));
  EXPECT_EQ(result.end, execution::RunEnd::Alarm);
}

/// AX1, AX2...: the axes of the machine in their order.
TEST(SinumerikVariables, AxesOfTheMachineHaveNumbers) {
  World world;
  const std::string text =
      "G0 X11 Y12 Z13\nR1=$AA_IM[AX1]-$AA_IM[X] R2=$AA_IM[ax2]-$AA_IM[Y] R3=$AA_IW[AX3] R4=$MA_POS_LIMIT_PLUS[AX1]\n"
      "R5=$MA_POS_LIMIT_PLUS[X]\n$SA_WORKAREA_LIMIT_PLUS[AX2]=5\nR6=$SA_WORKAREA_LIMIT_PLUS[AX2]\nM30\n";
  for (const Diagnostic& each : check(*SinumerikProgram::fromText("MAIN.MPF", text)))
    EXPECT_NE(each.severity, Severity::Error) << format(each);
  world.run(text);
  EXPECT_EQ(world.r(1), 0);
  EXPECT_EQ(world.r(2), 0);
  EXPECT_EQ(world.r(3), 13);
  EXPECT_EQ(world.r(4), world.r(5));
  EXPECT_NE(world.r(4), 0);
  EXPECT_EQ(world.r(6), 5);
}

TEST(SinumerikVariables, SystemVariablesShowAndChangeTheControl) {
  World world;
  world.run(
      "$P_UIFR[1,X,TR]=12.5 $P_UIFR[1,Z,RT]=30\n$P_UIFR[2]=CTRANS(X,1,Y,2):CROT(Z,45)\n"
      "G54\nR1=$P_UIFRNUM R2=$P_IFRAME[X,TR] R3=$P_UIFR[2,Z,RT] R4=$P_ACTFRAME[Z,RT]\n"
      "T1 M6\nR5=$P_TOOLNO R6=$P_TOOL R7=$P_TOOLR R8=$P_TOOLL[1] R9=$TC_DP3[1,2]\n"
      "$TC_DP12[1,1]=0.25\nD1\nR10=$P_TOOLL[1]\nG55\nTRANS X5\nR11=$P_PFRAME[X,TR] R12=$P_ACTFRAME[Y,TR]\n"
      "$SNS_MEA_WP_BALL_DIAM[2]=5.9\nR13=_WP[2,0]\n_OVR[3]=7 R14=_OVR[3]\n");
  EXPECT_EQ(world.r(1), 1);
  EXPECT_EQ(world.r(2), 12.5);
  EXPECT_EQ(world.r(3), 45);
  EXPECT_NEAR(world.r(4), 30, 1e-12);
  EXPECT_EQ(world.r(5), 1);
  EXPECT_EQ(world.r(6), 1);
  EXPECT_EQ(world.r(7), 5);
  EXPECT_EQ(world.r(8), 100);
  EXPECT_EQ(world.r(9), 90);
  EXPECT_EQ(world.r(10), 100.25);
  EXPECT_EQ(world.r(11), 5);
  EXPECT_NEAR(world.r(12), 2 + 5 * std::sin(std::numbers::pi / 4), 1e-12);
  EXPECT_EQ(world.r(13), 5.9);
  EXPECT_EQ(world.r(14), 7);
  ASSERT_FALSE(world.control.journal.writes.empty());
  EXPECT_EQ(world.control.journal.writes[0].table, "$P_UIFR");
  EXPECT_EQ(world.control.journal.writes[0].entry, "[1,X,TR]");
  EXPECT_EQ(world.control.journal.writes[0].after, "12.5");
}

TEST(SinumerikValues, FramesOfTheProgramHaveComponents) {
  World world;
  world.run(
      "DEF FRAME FR_1, FR_2[3]\nFR_1=CTRANS(X,1,Y,2):CROT(Z,10)\nFR_1[X,TR]=5\nFR_1[Y,FI]=0.5\n"
      "R1=FR_1[X,TR] R2=FR_1[Y,TR] R3=FR_1[Z,RT] R4=FR_1[Y,FI]\n"
      "FR_2[2]=FR_1\nFR_2[2,Z,RT]=30\nR5=FR_2[2,Z,RT] R6=FR_1[Z,RT] R7=FR_2[1,X,TR]\n"
      "$P_UIFR[1]=FR_2[2]\nR8=$P_UIFR[1,X,TR]\n");
  const double expected[] = {5, 2, 10, 0.5, 30, 10, 0, 5};
  for (int i = 0; i < 8; ++i)
    EXPECT_NEAR(world.r(i + 1), expected[i], 1e-12) << "R" << i + 1;
  EXPECT_EQ(world.alarm("DEF FRAME FR_1\nR1=FR_1[X]\n"), "17020");
  EXPECT_EQ(world.alarm("DEF FRAME FR_1\nR1=FR_1[X,Y]\n"), "17030");
}

}  // namespace
}  // namespace probewright::language::sinumerik
