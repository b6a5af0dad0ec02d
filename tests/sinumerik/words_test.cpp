#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sinumerik/told.hpp"

/// Words of the language as posts and setters write them: what they do, and that nothing is ignored without a word.
namespace probewright::language::sinumerik {
namespace {

/// What MSG(expression) shows behind `before`.
std::string shown(const std::string& before, const std::string& expression) {
  World world;
  world.run(before + "MSG(" + expression + ")\n");
  const auto messages = texts(world, control::EventKind::Message);
  return messages.empty() ? "" : messages.back();
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
  EXPECT_EQ(mistake("TRANS IP[X]=3\nM30\n"), "TRANS takes no IP");
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
  std::string many = "POSP[X]=(30,5,0";
  for (int i = 0; i < 60; ++i)
    many += ",1";
  for (const std::string& block : {std::string("POSP[X]=(30,5,0,1)"), many + ")"}) {
    EXPECT_NE(mistake(block + "\nM30\n").find("after end position, part and mode"), std::string::npos)
        << block << ": " << mistake(block + "\nM30\n");
  }
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
  EXPECT_EQ(mistake("G1 Z-10 K2\nM30\n"), "G1 takes no K");
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
  EXPECT_EQ(mistake("DEF STRING[1] SS\nDEF STRING[400] TT\n"), "");
  EXPECT_EQ(mistake("DEF STRING[401] SS\n"), "a STRING has 1 to 400 characters");
  EXPECT_EQ(World().alarm("DEF INT LENG=-1\nDEF STRING[LENG] SS\n"), "12200");
  EXPECT_EQ(World().alarm("DEF INT LENG=0\nDEF STRING[LENG] SS\n"), "12200");
  EXPECT_EQ(World().alarm("DEF INT LENG=401\nDEF STRING[LENG] SS\n"), "12200");
  EXPECT_EQ(shown("DEF INT LENG=1\nDEF STRING[LENG] SS=\"a\"\nDEF STRING[400*LENG] TT=\"b\"\n", "SS<<TT"), "ab");
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
