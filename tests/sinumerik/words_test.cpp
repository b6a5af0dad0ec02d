#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "language/sinumerik/check.hpp"
#include "sinumerik/world.hpp"

/// Words of the language as posts and setters write them: what they do, and that nothing is ignored without a word.
namespace probewright::language::sinumerik {
namespace {

Vector3 tip(World& world) { return world.control.channel.position().vector(); }

std::vector<std::string> texts(const World& world, control::EventKind kind) {
  std::vector<std::string> found;
  for (const auto& event : world.control.journal.events)
    if (event.kind == kind) found.push_back(event.text);
  return found;
}

/// What MSG(expression) shows behind `before`.
std::string shown(const std::string& before, const std::string& expression) {
  World world;
  world.run(before + "MSG(" + expression + ")\n");
  const auto messages = texts(world, control::EventKind::Message);
  return messages.empty() ? "" : messages.back();
}

std::string mistake(const std::string& text) {
  const auto program = SinumerikProgram::fromText("test.mpf", text);
  const Diagnostics found = check(*program);
  return found.empty() ? "" : found.front().message;
}

// ---- feeds ----

TEST(SinumerikFeeds, TakePolynomialsAndTheirUnit) {
  for (const char* block : {"G1 X30 F=FPO(1000,2,3)", "G1 X30 F=FPO(1000)", "G1 DISR=5 FAD=PM(200) X10 F500",
                            "G1 DISR=5 FAD = PR(0.2) X20", "R1=5 G1 X1 F=FPO(R1*2,0,R1)"})
    EXPECT_EQ(mistake(std::string(block) + "\nM30\n"), "") << block;
  for (const char* block : {"G1 X30 F=FPO(1,2,3,4)", "G1 X30 F=FPO()", "G1 X30 F=PM(200)", "R1=FPO(3)", "R1=PM(3)",
                            "G1 FAD=FPO(3) X3", "G1 FAD=PM(3 X3"})
    EXPECT_NE(mistake(std::string(block) + "\nM30\n"), "") << block;
}

/// The feed at the end of the block is that of the blocks after it.
TEST(SinumerikFeeds, OfAPolynomialEndWhereItSays) {
  World world;
  world.run("R1=300\nG1 G94 X10 F=FPO(2*R1,1,-2)\nR2=$P_F\nM30\n");
  EXPECT_EQ(world.r(2), 600);
}

// ---- RET with arguments ----

/// R1 after a subprogram that ends with `ret`: each block of the main program adds another power of ten.
double afterReturn(const std::string& ret) {
  World world;
  world.texts.add("SUBR", ret + "\n");
  world.run(
      "R1=0\nN10 SUBR\nR1=R1+1\nN90 TGT1: R1=R1+10\nR1=R1+100\nN95 IF R1<1000 GOTOF ENDE\nM30\nENDE: "
      "R1=R1+1000\nM30\n");
  return world.r(1);
}

TEST(SinumerikReturn, GoesOnWhereItsArgumentsSay) {
  EXPECT_EQ(afterReturn("RET"), 1111);
  EXPECT_EQ(afterReturn("RET(\"TGT1\")"), 1110);
  EXPECT_EQ(afterReturn("RET(\"tgt1\")"), 1110);
  EXPECT_EQ(afterReturn("RET(\"N90\")"), 1110);
  EXPECT_EQ(afterReturn("RET(\"TGT1\",0)"), 1110);
  EXPECT_EQ(afterReturn("RET(\"TGT1\",1)"), 1100);
  EXPECT_EQ(afterReturn("DEF STRING[20] GOAL=\"ENDE\"\nRET(GOAL)"), 1000);
  EXPECT_EQ(afterReturn("RET(\"TGT1\",,1)"), 1110);
}

TEST(SinumerikReturn, FindsTheBlockWithATextInIt) {
  for (const auto& [ret, value] : std::vector<std::pair<std::string, double>>{
           {"RET(\"PART_NO\")", 1101}, {"RET(\"write_log\")", 1001}, {"RET(\"WRITE_LOG\",1)", 1}}) {
    World world;
    world.texts.add("SUBR", ret + "\n");
    world.texts.add("WRITE_LOG", "R1=R1+1000\n");
    world.run(
        "DEF REAL PART_NO, WRITE_LOG_2\nR1=1 ; WRITE_LOG\nSUBR\nR1=R1+10 WRITE_LOG_2=3\nR1=R1+100 PART_NO=5\n"
        "WRITE_LOG\nM30\n");
    EXPECT_EQ(world.r(1), value) << ret;
  }
}

TEST(SinumerikReturn, LeavesSeveralLevels) {
  World world;
  world.texts.add("INNER", "R1=R1+1\nRET(,,2)\n");
  world.texts.add("OUTER", "INNER\nR1=R1+10\nM17\n");
  world.run("R1=0\nOUTER\nR1=R1+100\n");
  EXPECT_EQ(world.r(1), 101);
  world.texts.add("INNER2", "RET(\"LAST\",,2)\n");
  world.texts.add("OUTER2", "INNER2\nR1=R1+10\nM17\n");
  world.run("R1=0\nOUTER2\nR1=R1+100\nLAST: R1=R1+1000\n");
  EXPECT_EQ(world.r(1), 1000);
}

TEST(SinumerikReturn, DropsThePassesOfTheCallThatAreStillToCome) {
  World world;
  world.texts.add("SUBR", "R1=R1+1\nIF R1==2 GOTOF OUT\nRET\nOUT: RET(\"DONE\")\n");
  world.run("R1=0\nSUBR P5\nR1=R1+10\nDONE: R1=R1+100\n");
  EXPECT_EQ(world.r(1), 102);
}

TEST(SinumerikReturn, BringsBackWhatSaveKept) {
  World world;
  world.texts.add("INNER", "PROC INNER SAVE\nG91\nRET(,,2)\n");
  world.texts.add("OUTER", "PROC OUTER SAVE\nG18 G91\nINNER\nM17\n");
  world.run("G17 G90\nOUTER\nR1=$P_GG[6] R2=$P_GG[14]\n");
  EXPECT_EQ(world.r(1), 1);
  EXPECT_EQ(world.r(2), 1);
}

TEST(SinumerikReturn, RefusesAMissingTargetAndTooManyLevels) {
  World world;
  world.texts.add("SUBR", "RET(\"NOWHERE\")\n");
  EXPECT_EQ(world.alarm("SUBR\n"), "14080");
  world.texts.add("SUBR2", "RET(,,2)\n");
  EXPECT_EQ(world.alarm("SUBR2\n"), "14000");
  EXPECT_EQ(world.alarm("TGT1: RET(\"TGT1\")\n"), "14000") << "the main program returns to nobody";
}

// ---- addresses with an extension ----

TEST(SinumerikWords, ExtensionsOfAddressesMayBeComputed) {
  World world;
  world.run("DEF INT SPINU=1\nS[SPINU]=500 M[SPINU]=3\nR1=$P_S R2=$P_SDIR\n");
  EXPECT_EQ(world.r(1), 500);
  EXPECT_EQ(world.r(2), 3);
  world.run("S[1]=600 M[1]=4 H[2]=3\nR1=$P_S R2=$P_SDIR\n");
  EXPECT_EQ(world.r(1), 600);
  EXPECT_EQ(world.r(2), 4);
  world.run("DEF INT SPINU=2\nS[SPINU]=700 M[SPINU]=5 M[2]=3 S2=9\nR1=$P_S R2=$P_SDIR\n");
  EXPECT_EQ(world.r(1), 600) << "those are of another spindle";
  EXPECT_EQ(world.r(2), 4);
  world.run("DEF INT MM=5\nM1=MM\nR2=$P_SDIR\nT[1]=2 M6\nR3=$P_TOOLNO\n");
  EXPECT_EQ(world.r(2), 5);
  EXPECT_EQ(world.r(3), 2);
  world.run("T2=1 M6\nR3=$P_TOOLNO\n");
  EXPECT_EQ(world.r(3), 2) << "T2= is the tool of another spindle";
  EXPECT_EQ(mistake("S[1000]=5\n"), "the extension of an address is a whole number from 0 to 999");
  EXPECT_EQ(mistake("S[1]\n"), "'=' expected after the extension of the address");
}

TEST(SinumerikWords, ToolsHaveNumbersFromZeroOn) {
  EXPECT_EQ(mistake("T-1\n"), "the number of a tool is 0 or more");
  World world;
  EXPECT_EQ(world.alarm("R1=-1\nT=R1\n"), "17190");
}

TEST(SinumerikWords, FramesTakeAxesFromVariables) {
  World world;
  world.run("DEF AXIS AXV=(Y)\nG0 X0 Y0 Z0\nTRANS X1 AX[AXV]=5\nG0 X0 Y0\n");
  EXPECT_NEAR(world.machine.position()[1], 5, 1e-12);
  world.run("DEF AXIS AXV=(Y)\nATRANS AX[AXV]=2\nG0 Y0\n");
  EXPECT_NEAR(world.machine.position()[1], 7, 1e-12);
  world.run("DEF AXIS AXV=(X)\nTRANS\nSCALE AX[AXV]=2\nASCALE AX[AXV]=2\nG0 X3\n");
  EXPECT_NEAR(world.machine.position()[0], 12, 1e-12);
  world.run("DEF AXIS AXV=(X)\nMIRROR AX[AXV]=0\nG0 X3\n");
  EXPECT_NEAR(world.machine.position()[0], -3, 1e-12);
  world.run("DEF AXIS AXV=(Z)\nTRANS\nAMIRROR AX[AXV]=0\nTRANS\nROT AX[AXV]=90\nG0 X3 Y0\n");
  EXPECT_NEAR(world.machine.position()[1], 3, 1e-12);
  EXPECT_EQ(world.alarm("TRANS IP[X]=3\n"), "12080");
}

TEST(SinumerikWords, ParametersOfArcsTakeAxesFromVariables) {
  World world;
  world.run("DEF AXIS AXV=(X)\nG17 G0 X0 Y0 Z0\nG3 X20 Y0 IP[AXV]=10 J0 F100\n");
  EXPECT_LT((tip(world) - Vector3(20, 0, 0)).norm(), 1e-12);
  double lowest = 0;
  for (const auto& move : world.machine.moves)
    lowest = std::min(lowest, world.control.channel.programFromAxes(move.to).y());
  EXPECT_NEAR(lowest, -10, 0.02) << "half a circle below the X axis";
}

TEST(SinumerikWords, PolynomialsEndWhereTheySay) {
  World world;
  world.run("G0 X0 Y0 Z0\nPOLY PO[X]=(10,1,2) PO[Y]=(5) F100\n");
  EXPECT_EQ(tip(world), Vector3(10, 5, 0));
  world.run("DEF AXIS AXV=(Z)\nPOLY PO[AXV]=(7,0.5) PO[PHI]=(1,2)\n");
  EXPECT_EQ(tip(world), Vector3(10, 5, 7));
  EXPECT_EQ(texts(world, control::EventKind::Skipped), std::vector<std::string>{"POLY is travelled as straight lines"});
}

TEST(SinumerikWords, PositioningInPartsGoesToTheEnd) {
  World world;
  world.run("G0 X0 Y0 Z0\nPOSP[X]=(30,5,0)\n");
  EXPECT_EQ(tip(world), Vector3(30, 0, 0));
}

TEST(SinumerikWords, ThreadsHaveTheFeedOfTheirPitch) {
  World world;
  world.run("G0 X0 Y0 Z0\nS500 M3\nG33 Z-10 K2\n");
  EXPECT_EQ(tip(world), Vector3(0, 0, -10));
  EXPECT_NEAR(world.machine.moves.back().feed.perMinute, 1000, 1e-9);
  world.run("G331 Z-20 K1.5 S200\nG332 Z0 K1.5\n");
  EXPECT_NEAR(world.machine.moves.back().feed.perMinute, 300, 1e-9);
  EXPECT_EQ(tip(world), Vector3(0, 0, 0));
  // A taper: the pitch counts along Z, the way is longer.
  world.run("G34 X10 Z-10 K2 F0.1 S100\n");
  EXPECT_NEAR(world.machine.moves.back().feed.perMinute, 200 * std::sqrt(2.0), 1e-9);
  world.run("G1 Z0 F50\n");
  EXPECT_EQ(world.machine.moves.back().feed.perMinute, 50);
  EXPECT_EQ(world.alarm("G33 Z-10 K0\n"), "16720");
  World still;
  EXPECT_EQ(still.alarm("G33 Z-10 K2\n"), "16710");
  EXPECT_EQ(World().alarm("G1 Z-10 K2\n"), "10860");
}

TEST(SinumerikWords, ALimitOfTheSpindleIsNoSpeed) {
  World world;
  world.run("S800 M3\nG26 S5000\nR1=$P_S\n");
  EXPECT_EQ(world.r(1), 800);
  EXPECT_TRUE(texts(world, control::EventKind::Skipped).empty());
  world.run("G25 X-100 Y-100\n");
  EXPECT_EQ(texts(world, control::EventKind::Skipped).size(), 1u);
}

TEST(SinumerikWords, AnAxisThatTheMachineLacksIsRefusedAtEveryPlace) {
  World lathe("lathe2c");
  EXPECT_EQ(lathe.alarm("G0 Y0\n"), "12080");
  EXPECT_EQ(lathe.alarm("G0 Y5\n"), "12080");
}

// ---- texts ----

TEST(SinumerikTexts, SingleCharactersAreReadAndWritten) {
  const std::string text = "DEF STRING[50] SS=\"Axis n has reached position\"\n";
  EXPECT_EQ(shown(text + "SS[5]=\"X\"\n", "SS"), "Axis X has reached position");
  EXPECT_EQ(shown(text, "SS[0]"), "A");
  EXPECT_EQ(shown(text, "\"<\"<<SS[5]<<\">\""), "<n>");
  EXPECT_EQ(shown("DEF STRING[20] SA[2]=SET(\"abc\",\"xyz\")\nSA[1,0]=SA[0,2]\n", "SA[1]"), "cyz");
  EXPECT_EQ(shown("DEF STRING[5] SS=\"ab\"\nSS[2]=\"c\"\n", "SS"), "abc") << "one more after the last";
  World world;
  world.run(text + "IF SS[0]==\"A\"\nR1=1\nENDIF\nR2=SS[0]\nIF SS[1]<>\"A\"\nR3=1\nENDIF\n");
  EXPECT_EQ(world.r(1), 1);
  EXPECT_EQ(world.r(2), 65);
  EXPECT_EQ(world.r(3), 1);
  EXPECT_EQ(World().alarm(text + "MSG(SS[27])\n"), "17020");
  EXPECT_EQ(World().alarm("DEF STRING[2] SS=\"ab\"\nSS[2]=\"c\"\n"), "17020");
  EXPECT_EQ(World().alarm("DEF STRING[5] SS=\"ab\"\nSS[0]=\"cd\"\n"), "12150");
}

TEST(SinumerikTexts, AssignmentsConvertAsTheTableOfTheLanguageSays) {
  EXPECT_EQ(shown("DEF CHAR CC=\"A\"\nDEF STRING[9] SS\nSS=CC\n", "SS"), "A");
  EXPECT_EQ(shown("DEF CHAR CC=\"A\"\n", "\"c\"<<CC"), "cA");
  EXPECT_EQ(shown("DEF CHAR CC=66\n", "CC"), "B");
  EXPECT_EQ(shown("DEF BOOL BB=TRUE\nDEF STRING[9] SS\nSS=BB\n", "SS"), "1");
  EXPECT_EQ(shown("DEF STRING[9] SS[2]=REP(\"-\")\nDEF CHAR CC=\"z\"\nSS[1]=REP(CC)\n", "SS[0]<<SS[1]"), "-z");
  World world;
  world.run("DEF STRING[9] SS=\"x\"\nDEF BOOL BB\nBB=SS\nR1=BB\nSS=\"\"\nBB=SS\nR2=BB\n");
  EXPECT_EQ(world.r(1), 1);
  EXPECT_EQ(world.r(2), 0);
  EXPECT_EQ(world.alarm("DEF STRING[9] SS\nDEF INT II=5\nSS=II\n"), "12150");
  EXPECT_EQ(world.alarm("DEF STRING[9] SS=\"5\"\nDEF INT II\nII=SS\n"), "12150");
  world.texts.add("TAKE", "PROC TAKE(STRING[8] TT)\nMSG(TT)\n");
  world.run("DEF CHAR CC=\"q\"\nTAKE(CC)\n");
  EXPECT_EQ(texts(world, control::EventKind::Message).back(), "q");
}

TEST(SinumerikTexts, NumbersArePlainDecimals) {
  EXPECT_EQ(shown("", "\"\"<<-0.00001"), "-0.00001");
  EXPECT_EQ(shown("R1=1/3\n", "\"\"<<R1"), "0.3333333333");
  EXPECT_EQ(shown("R1=100/3\n", "\"\"<<R1"), "33.33333333");
  EXPECT_EQ(shown("R1=0.1+0.2-0.3\n", "\"\"<<R1"), "0");
  EXPECT_EQ(shown("R1=-7.1EX-15\n", "\"\"<<R1"), "0");
  EXPECT_EQ(shown("R1=12.5\n", "\"\"<<R1<<\" \"<<-3<<\" \"<<1EX12"), "12.5 -3 1000000000000");
  EXPECT_EQ(shown("R1=1234567.891\n", "\"\"<<R1"), "1234567.891");
  EXPECT_EQ(shown("R1=1/3\n", "STRING(R1)"), "0.3333333333");
  EXPECT_EQ(shown("", "SPRINT(\"%B %B\",TRUE,0)"), "TRUE FALSE");
}

TEST(SinumerikTexts, LengthsAreBounded) {
  EXPECT_EQ(mistake("DEF STRING[0] SS\n"), "a STRING has 1 to 400 characters");
  EXPECT_EQ(mistake("DEF STRING[-3] SS\n"), "a STRING has 1 to 400 characters");
  EXPECT_EQ(mistake("DEF STRING[99999999999] SS\n"), "a STRING has 1 to 400 characters");
  EXPECT_EQ(mistake("PROC TEST(STRING[0] SS)\n"), "a STRING has 1 to 400 characters");
  EXPECT_EQ(mistake("DEF STRING[255] SS\n"), "");
  EXPECT_EQ(World().alarm("DEF INT LENG=-1\nDEF STRING[LENG] SS\n"), "12200");
  EXPECT_EQ(World().alarm("DEF STRING[9] SS=\"abc\"\nSS=SUBSTR(SS,0,-5)\n"), "14020");
  EXPECT_EQ(shown("DEF STRING[9] SS=\"abc\"\n", "\"<\"<<SUBSTR(SS,-1)<<\">\""), "<>");
}

// ---- numbers, names ----

TEST(SinumerikNumbers, ThatNoDoubleHoldsAreRefused) {
  const std::string tooLarge = "this number is too large to compute with";
  EXPECT_EQ(mistake("R1=1EX309\n"), tooLarge);
  EXPECT_EQ(mistake("R1=" + std::string(400, '9') + "\n"), tooLarge);
  EXPECT_EQ(mistake("G0 X1EX400\n"), tooLarge);
  EXPECT_EQ(mistake("G0 X-" + std::string(5000, '9') + "\n"), tooLarge);
  World world;
  EXPECT_EQ(world.value("1EX-400"), 0);
  EXPECT_EQ(world.value("1.5EX3"), 1500);
  EXPECT_EQ(world.value("0." + std::string(400, '0') + "1"), 0);
  EXPECT_EQ(world.alarm("R1=1EX200*1EX200\n"), "14051");
  EXPECT_EQ(mistake("R6=1e12\n"), "this number has an exponent as other languages write it");
  EXPECT_EQ(mistake("R6=1.5E-3\n"), "this number has an exponent as other languages write it");
}

TEST(SinumerikNames, BeginWithTwoLettersAndTheMessageSaysSo) {
  EXPECT_EQ(mistake("DEF INT I\n"), "I cannot name a variable: names begin with two letters or underscores");
  EXPECT_EQ(mistake("L1: G0 X1\n"), "L1 cannot be a label: the names of labels begin with two letters or underscores");
  EXPECT_EQ(mistake("DEF INT\n"), "the name of the variable was expected");
  EXPECT_EQ(mistake("R1=0" +
                    [] {
                      std::string sum;
                      for (int i = 0; i < 300000; ++i)
                        sum += "+1";
                      return sum;
                    }() +
                    "\n"),
            "this expression has too many terms");
}

TEST(SinumerikCalls, ArgumentsAreHeldAgainstTheTypesOfThePROCLine) {
  Texts library;
  CheckOptions beside;
  beside.library = &library;
  library.add("UP", "PROC UP(REAL AA,STRING[9] BB,AXIS CC)\nM17\n");
  const auto complaint = [&](const std::string& call) {
    const auto program = SinumerikProgram::fromText("test.mpf", call + "\nM30\n");
    const Diagnostics found = check(*program, beside);
    return found.empty() ? std::string() : found.front().message;
  };
  EXPECT_EQ(complaint("UP(1,\"a\",X)"), "");
  EXPECT_EQ(complaint("UP(\"a\")"), "argument 1 of UP is a text, and the parameter AA has the type REAL");
  EXPECT_EQ(complaint("UP(1,5)"), "argument 2 of UP is a number, and the parameter BB has the type STRING");
  EXPECT_EQ(complaint("UP(1,,5)"), "argument 3 of UP is a number, and the parameter CC has the type AXIS");
  EXPECT_EQ(complaint("UP(Y)"), "argument 1 of UP is the name of an axis, and the parameter AA has the type REAL");
  EXPECT_EQ(complaint("CALL \"/\""), "\"/\" names a folder, not a program");
  const auto program = SinumerikProgram::fromText("test.mpf", "CALL \"/dev/zero\"\nM30\n");
  const Diagnostics found = check(*program, beside);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].advice.find("Did you mean"), std::string::npos) << found[0].advice;
}

// ---- nothing is ignored without a word ----

TEST(SinumerikEffects, WhatIsNotCarriedOutIsNamedOnceAndRefusedUnderStrict) {
  const std::pair<const char*, const char*> words[] = {
      {"M25", "M25"},
      {"M1=50", "M50"},
      {"H5", "the auxiliary function H"},
      {"TRANSMIT", "TRANSMIT"},
      {"CUT3DC", "CUT3DC"},
      {"TCARR=1", "TCARR"},
      {"OFFN=0.5", "OFFN"},
      {"FXS[X]=1", "FXS"},
      {"TOFF[Z]=1", "TOFF"},
      {"CUTMOD=1", "CUTMOD"},
      {"ORIMKS", "ORIMKS"},
      {"TRAILON(X,Y,1)", "TRAILON"},
      {"GEOAX(1,X)", "GEOAX"},
      {"SETMS(3)", "SETMS"},
      {"DELDL(1,1)", "DELDL"},
      {"TCA(\"MILL\")", "TCA"},
      {"CALLPATH(\"/_N_WKS_DIR\")", "CALLPATH"},
      {"REDEF CHAN INT AAA APR 7", "REDEF"},
      {"PTP", "PTP"},
      {"TOWMCS", "TOWMCS"},
      {"G7", "G7"},
      {"G810", "G810"},
      {"G[25]=2", "G[25]=2"},
      {"G75 FP=2 X1=0", "FP=2"},
      {"ID=1 WHENEVER $AA_IW[X]>5 DO $AC_OVR=50", "the synchronized action ID"},
      {"SETINT(1) PRIO=1 LIFTOUT", "the interrupt SETINT"},
      {"T2=1", "T2="},
      {"OS[X]=1", "OS"},
      {"OSP1[X]=10", "OSP1"},
      {"DELTC(1,2)", "DELTC"},
      {"POSM(1,2)", "POSM"},
      {"G1 X1 F100 TOFFLR=0.1", "TOFFLR"},
      {"G461", "G461"},
      {"DISC=50", "DISC"},
      {"GFRAME3", "GFRAME3"},
      {"WALCS2", "WALCS2"},
      {"MEAC[X]=(1,2,-1)", "MEAC"},
      {"CPDEF=(X)", "CPDEF"},
      {"CPLON[X]=Y", "CPLON"},
      {"CPLPOS[X,Y]=5", "CPLPOS"},
      {"FOCON[X]", "FOCON"},
      {"TOFFON(Z,1)", "TOFFON"},
      {"G1 X1 F100 MOVT=IC(5)", "MOVT"},
      {"G1 X1 F100 STAT='B010'", "STAT"},
      {"G1 X1 F100 A7=1", "A7"},
      {"G1 X1 F100 THETA=5", "THETA"},
      {"TRAORI(2)", "TRAORI with another transformation"},
      {"TRAORI(1,1,0,0)", "TRAORI with another direction"},
      {"$P_EXTFRAME=CTRANS(X,3)", "$P_EXTFRAME"},
      {"$P_CYCFRAME[X,TR]=3", "$P_CYCFRAME"},
      {"$P_TRAFR=CTRANS(X,3)", "$P_TRAFR"},
      {"$P_GFR[1]=CTRANS(X,3)", "$P_GFR"},
  };
  for (const auto& [block, name] : words) {
    World world;
    world.run(std::string(block) + "\n" + block + "\n");
    const auto named = texts(world, control::EventKind::Skipped);
    ASSERT_EQ(named.size(), 1u) << block;
    EXPECT_TRUE(named[0].starts_with(name)) << block << ": " << named[0];
    const auto checked = SinumerikProgram::fromText("test.mpf", block);
    const Diagnostics told = check(*checked);
    ASSERT_EQ(told.size(), 1u) << block;
    EXPECT_EQ(told[0].severity, Severity::Warning) << block;
    EXPECT_TRUE(told[0].message.starts_with(name)) << block << ": " << told[0].message;
    NotingMachine machine("mill3");
    control::sinumerik::Control control(machine, World::data());
    SinumerikHost strict(control, {.strict = true});
    Texts none;
    const auto result = execution::Interpreter(none, strict).run(SinumerikProgram::fromText("MAIN.MPF", block));
    EXPECT_EQ(result.end, execution::RunEnd::Alarm) << block;
  }
}

TEST(SinumerikEffects, WhatSaysNothingAboutTheToolPassesInSilence) {
  for (const char* block : {"M8",
                            "M9",
                            "M7",
                            "M41",
                            "SOFT",
                            "FFWON",
                            "COMPCAD",
                            "CTOL=0.01",
                            "SETMS",
                            "SETMS(1)",
                            "DELAYFSTON",
                            "DELAYFSTOF",
                            "CLGON",
                            "CTOLG0=0.01",
                            "G1 X1 F100 F7=200 F6=50 ST=1 SR=0.5",
                            "FMA[2,X]=100",
                            "WAITC(X,1)",
                            "GEOAX()",
                            "OFFN=0",
                            "TCARR=0",
                            "CUTMOD=0",
                            "FINEA[X]",
                            "COARSEA=X",
                            "IPOBRKA[X]=50",
                            "SCPARA[X]=1",
                            "POLF[Z]=100",
                            "TOWSTD",
                            "CP",
                            "G64",
                            "G60",
                            "G641 ADIS=0.1",
                            "G601",
                            "DYNFINISH",
                            "FGROUP(X,Y)",
                            "WAITM(1,1,2)",
                            "CDOF",
                            "NORM",
                            "G[10]=2",
                            "RTLION",
                            "UPATH",
                            "ORIAXES",
                            "STOLF=0.1",
                            "G75 FP=1 X1=0",
                            "ENDPROC",
                            "TRAORI(1)",
                            "DISC=0",
                            "SCC[X]",
                            "BNAT EAUTO",
                            "FENDNORM",
                            "LFOF",
                            "WALCS0",
                            "CPLNUM[X,Y]=2",
                            "G460",
                            "ADISPOSA=(X,50)"}) {
    World world;
    world.run(std::string(block) + "\n");
    EXPECT_TRUE(texts(world, control::EventKind::Skipped).empty()) << block;
    EXPECT_EQ(mistake(std::string(block) + "\n"), "") << block;
  }
}

TEST(SinumerikEffects, EveryWordOfTheTableDoesWhatItsRowSays) {
  int rows = 0;
  for (const KeywordEntry& row : keywords()) {
    std::string block(row.name);
    switch (row.keyword) {
      case Keyword::Modal:
        break;
      case Keyword::Statement:
        block += "(2,1)";
        break;
      case Keyword::Setting:
        block += "=1";
        break;
      case Keyword::Axial:
        block += "[X]";
        break;
      case Keyword::MoveWord:
        block = "G1 X1 F100 " + block + "=1";
        break;
      case Keyword::Motion:
        block += " X1 F100";
        break;
      default:
        continue;
    }
    if (row.effect == Effect::CarriedOut) continue;
    ++rows;
    World world;
    world.run(block + "\n");
    const auto named = texts(world, control::EventKind::Skipped);
    ASSERT_EQ(named.size(), row.effect == Effect::Harmless ? 0u : 1u) << block;
    if (!named.empty()) {
      EXPECT_EQ(named[0], std::string(row.name) + " " + std::string(skippedFunction(row.name)));
    }
  }
  EXPECT_GT(rows, 200);
}

TEST(SinumerikEffects, CheckNamesThemToo) {
  EXPECT_EQ(mistake("M25\nM25\n"), "M25 is not carried out");
  EXPECT_EQ(mistake("OFFN=0.5\n"), "OFFN is not carried out");
  EXPECT_EQ(mistake("TRAORI\nG1 X1 LEAD=3 F5\n"), "LEAD is not carried out");
  EXPECT_EQ(mistake("DEF BOOL OK_1\nOK_1=CHKDNO(1)\n"), "the function CHKDNO is not available here");
  EXPECT_EQ(mistake("R1=SETDNO(1,1,3)\n"), "the function SETDNO is not available here");
  EXPECT_EQ(mistake("POS[C]=CAC(5)\n"), "the function CAC is not available here");
  EXPECT_EQ(mistake("G291\n"), "G291: programs of the ISO dialect are not available");
  EXPECT_EQ(World().alarm("G291\nG28 U0\n"), "14011");
}

TEST(SinumerikEffects, BlocksOfAContourTableDoNotMoveTheAxes) {
  World world;
  world.run(
      "DEF REAL TAB[30,11]\nDEF INT NUM, ERR\nG0 X1 Y1 Z1\nCONTPRON(TAB,\"N\",NUM)\nG1 X50 Y50 F100\nG2 X60 Y60 CR=50\n"
      "EXECUTE(ERR)\n");
  EXPECT_EQ(tip(world), Vector3(1, 1, 1));
  world.run("G0 X2\n");
  EXPECT_EQ(tip(world), Vector3(2, 1, 1));
}

TEST(SinumerikEffects, ToolsAndCirclesThatProgramsAskForAreTold) {
  World world;
  world.run("DEF INT TNO\nT1 M6\nT2\nGETSELT(TNO)\nR1=TNO\nM6\nGETEXET(TNO)\nR2=TNO\nR3=GETDNO(2,1)\n");
  EXPECT_EQ(world.r(1), 2);
  EXPECT_EQ(world.r(2), 2);
  EXPECT_EQ(world.r(3), 1);
  EXPECT_NEAR(world.value("MODAXVAL(X,-30)"), 330, 1e-12);
  // Three points of the circle about (10, 20) with radius 5.
  world.run(
      "DEF REAL PT[4,2]=SET(15,20,10,25,5,20)\nDEF REAL RES[3]\nDEF BOOL FOUND\nFOUND=CALCDAT(PT,3,RES)\n"
      "R1=FOUND R2=RES[0] R3=RES[1] R4=RES[2]\n");
  EXPECT_EQ(world.r(1), 1);
  EXPECT_NEAR(world.r(2), 10, 1e-9);
  EXPECT_NEAR(world.r(3), 20, 1e-9);
  EXPECT_NEAR(world.r(4), 5, 1e-9);
  EXPECT_EQ(world.alarm("DEF REAL PT[3,2]=SET(0,0,1,0,2,0)\nDEF REAL RES[3]\nCALCDAT(PT,3,RES)\n"), "14051");
  EXPECT_EQ(world.alarm("CALCDAT(1,3,2)\n"), "14020");
}

TEST(SinumerikSystemVariables, TheClockHasMilliseconds) {
  World world;
  world.control.wallClockStart = 100;
  world.run("G4 F2.75\nR1=$A_MSECOND R2=$A_SECOND\n");
  EXPECT_NEAR(world.r(1), 750, 1);
  EXPECT_EQ(world.r(2), 42);
  world.control.programPath = "/parts/ring/MAIN.MPF";
  world.run("DEF STRING[99] PATH_1\nPATH_1=$P_PATH[0]\nMSG(PATH_1)\n");
  EXPECT_EQ(texts(world, control::EventKind::Message).back(), "/parts/ring/");
}

// ---- the run ----

TEST(SinumerikSteps, ElementsOfArraysCount) {
  World world;
  const execution::RunResult result = world.tryRun("DEF REAL ARR[30000]\nLOOP\nARR[0]=REP(5)\nENDLOOP\n");
  EXPECT_EQ(result.end, execution::RunEnd::StepLimit);
  EXPECT_LT(result.blocks, 20u) << "100000 steps are over after the fourth filling";
  EXPECT_NE(result.diagnostics.front().advice.find("--step-limit"), std::string::npos);
}

TEST(SinumerikBlockSkip, GoesByTheLevelBehindTheSlash) {
  World world;
  execution::InterpreterOptions options;
  options.skipLevels.set(0).set(5);
  const auto run = [&](const std::string& text) {
    const auto result =
        execution::Interpreter(world.texts, world.host, options).run(SinumerikProgram::fromText("MAIN.MPF", text));
    EXPECT_EQ(result.end, execution::RunEnd::Finished);
  };
  run("R1=1 R2=1 R3=1 R4=1 R5=1\n/ R1=2\n/0 R2=2\n/5R3=2\n/3 R4=2\nN10 /5 R5=2\n/5 this is no block (\n");
  EXPECT_EQ(world.r(1), 1);
  EXPECT_EQ(world.r(2), 1);
  EXPECT_EQ(world.r(3), 1);
  EXPECT_EQ(world.r(4), 2);
  EXPECT_EQ(world.r(5), 1);
  const auto program = SinumerikProgram::fromText("test.mpf", "/5 this is no block (\nM30\n");
  EXPECT_EQ(check(*program).size(), 1u);
  CheckOptions skipping;
  skipping.skipLevels.set(5);
  EXPECT_TRUE(check(*program, skipping).empty());
}

}  // namespace
}  // namespace probewright::language::sinumerik
