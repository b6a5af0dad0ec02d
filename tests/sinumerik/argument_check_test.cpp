#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cycles/catalogue.hpp"
#include "language/sinumerik/check.hpp"

namespace probewright::language::sinumerik {
namespace {

/// "5:12 message" of each mistake in a program.
std::vector<std::string> mistakesIn(const std::string& text) {
  std::vector<std::string> messages;
  for (const Diagnostic& each : check(*SinumerikProgram::fromText("TEST.MPF", text)))
    messages.push_back(std::to_string(each.place.line) + ":" + std::to_string(each.place.column) +
                       (each.severity == Severity::Warning ? " warning: " : " ") + each.message);
  return messages;
}

using Messages = std::vector<std::string>;

constexpr const char* path = "S_FA (measuring path DFA: from the start position to the expected surface)";

TEST(SinumerikArguments, CallsAsPostProcessorsWriteThemHaveNoMistakes) {
  EXPECT_EQ(mistakesIn("DEF REAL DIA_1=40\n"
                       "DEF INT AXIS_1=1\n"
                       "DEF STRING[32] CUTTER=\"MILL_20\"\n"
                       "N10 CYCLE977(101,10001,,1,40,,,8,4,0,,,,1,1,\"\",,0,0,0,,,,,1,) ; bore\n"
                       "cycle977 (101,10001,,1,dia_1*2,,,8,4,0)\n"
                       "  Cycle978( 0 , , , 1 , R5+20 , R1 , 4 , axis_1 , 1 , 1 )\n"
                       "CYCLE978(0,,,1,20,5,1,1,1,1,\"\",0,0,0,0,0,0,0,0,0,1,0)\n"
                       "CYCLE978(200,,1,1,20.,5.0,1,3,2,1,CUTTER,,0,.5,+0.1,-0.1,,1)\n"
                       "CYCLE977(201,,1,1,40,,,8,4,0,,,,1,1,\"MILL_\"<<20,,0,0.5,0.1,-0.1,,1,,,1,1)\n"
                       "CYCLE961(107,1,1,20,40,20,40,0,0,,,0,0,0,90,2,5,2,1,,1,)\n"
                       "CYCLE998(105,10004,0,1,1,0,,5,5,201,1,10,,,,,1,,1,)\n"
                       "CYCLE979(R10,,,1,40,5,2,0,0,0,90)\n"
                       "CYCLE997(109,1,1,25,5,2,0,90,,,,,,,,,,,1,,1,)\n"
                       "CYCLE976(1000,1,0,,3,1,5,1,0,0,1,,1,)\n"
                       "CYCLE973(12103,1,1,0,1,1,3,1,0,1,0,2,0)\n"
                       "CYCLE974(2,0,0,1,80,2,2,1)\n"
                       "CYCLE994(2,0,0,1,80,2,,10,2,1)\n"
                       "CYCLE995(1102015,,1,25,4,1,0,,30,,,,0.1,,1,,1,1)\n"
                       "CYCLE150(31,101,\"PART\")\n"
                       "CYCLE800(1,\"TABLE\",100000,57,0,0,0,0,0,0,0,0,0,-1,100,1)\n"
                       "CYCLE800()\n"
                       "M30\n"),
            Messages{});
}

TEST(SinumerikArguments, MissingOnesAreNamedByPlaceNameAndMeaning) {
  EXPECT_EQ(
      mistakesIn("CYCLE978(0,,,1,20)\n"),
      (Messages{std::string("1:18 argument 6 of CYCLE978: ") + path + " is missing",
                "1:18 warning: argument 7 of CYCLE978: S_TSA (safe area: a larger difference from the set value stops "
                "the program) is missing: the smallest difference stops the program",
                "1:18 argument 8 of CYCLE978: S_MA (measuring axis: 1, 2 in the plane, 3 along the tool) is missing"}));
  // Where it should stand, if that place is there.
  EXPECT_EQ(mistakesIn("N10 CYCLE978(0,,,1,20, ,1,1,1) ; (5,5)\n"),
            (Messages{std::string("1:24 argument 6 of CYCLE978: ") + path + " is missing"}));
  EXPECT_EQ(mistakesIn("CYCLE977\n"), (Messages{"1:1 argument 1 of CYCLE977: S_MVAR (measuring variant) is missing"}));
  EXPECT_EQ(mistakesIn("CYCLE979()\n"),
            (Messages{"1:10 argument 1 of CYCLE979: S_MVAR (measuring variant) is missing"}));
}

TEST(SinumerikArguments, WhatIsNeededDependsOnTheVariant) {
  const auto missing = [](const std::string& call) {
    std::string names;
    for (const std::string& message : mistakesIn(call + "\n")) {
      const std::size_t at = message.find(": ") + 2;
      names += message.substr(at, message.find(' ', at) - at) + ' ';
    }
    return names;
  };
  EXPECT_EQ(missing("CYCLE977(1,,,1,,,,8,4)"), "S_SETV ");
  EXPECT_EQ(missing("CYCLE977(5,,,1,,,,8,4)"), "S_SETV0 S_SETV1 ");
  EXPECT_EQ(missing("CYCLE977(3,,,1,40,,,8,4)"), "S_MA ");
  EXPECT_EQ(missing("CYCLE998(5,,,1,1,,,8,4,201,1)"), "S_ID ");
  EXPECT_EQ(missing("CYCLE998(6,,,1,1,,,8,4)"), "S_SETV0 S_SETV3 ");
  EXPECT_EQ(missing("CYCLE961(6,,1,10,20,10,,,,,,,,,,,8,4)"), "");
  EXPECT_EQ(missing("CYCLE961(7,,1,10,20,10,20,,,,,,,,,,8,4)"), "S_INCA ");
  EXPECT_EQ(missing("CYCLE997(9,,1,25,8,4)"), "");
  EXPECT_EQ(missing("CYCLE997(1009,,1,25,8,4)"), "S_INCA ");
  EXPECT_EQ(missing("CYCLE976(1,1,,,,,8,4)"), "S_SETV ");
  EXPECT_EQ(missing("CYCLE973(100,1,,0,0,1,8,4)"), "S_MA ");
  EXPECT_EQ(missing("CYCLE973(102,1,0,,,,8,4)"), "S_CALNUM ");
  // Groove 1, its axis 1, and the variant 12103 are what the call stands for without them.
  EXPECT_EQ(missing("CYCLE973(,1,,,,,8,4)"), "");
  EXPECT_EQ(missing("CYCLE994(2,,,1,40,2,,,8,4)"), "S_SZO ");
  // A variant that only the run computes needs no more than all of them do.
  EXPECT_EQ(mistakesIn("CYCLE977(R1)\n").front(), std::string("1:12 argument 8 of CYCLE977: ") + path + " is missing");
}

TEST(SinumerikArguments, NeitherSignNorKindMayBeWrong) {
  EXPECT_EQ(mistakesIn("CYCLE978(0,,,1,20,-5,1,1,1)\n"), (Messages{std::string("1:19 argument 6 of CYCLE978: ") + path +
                                                                   " cannot be -5; its range is 0 to 99999.9999 mm"}));
  EXPECT_EQ(mistakesIn("CYCLE978(0,,,1,20,0,1,1,1)\n"),
            (Messages{std::string("1:19 argument 6 of CYCLE978: ") + path + " cannot be 0 here"}));
  EXPECT_EQ(mistakesIn("DEF STRING[8] WIDTH\nCYCLE978(0,,,1,WIDTH,5,1,1,1)\n"),
            (Messages{"2:16 argument 5 of CYCLE978: S_SETV (set value of the surface) takes a number, not a text"}));
  EXPECT_EQ(mistakesIn("CYCLE978(0,,,1,20,5,1,X,1)\n"),
            (Messages{"1:23 argument 8 of CYCLE978: S_MA (measuring axis: 1, 2 in the plane, 3 along the tool) takes a "
                      "number, not the name of an axis"}));
  EXPECT_EQ(
      mistakesIn("CYCLE978(200,,1,1,20,5,1,1,1,1,R5)\n"),
      (Messages{"1:32 argument 11 of CYCLE978: S_TNAME (name of the tool to correct) takes a text, not a number"}));
  EXPECT_EQ(mistakesIn("CYCLE978(0,,,1,20,5,1,1,1.5)\n"),
            (Messages{"1:25 argument 9 of CYCLE978: S_MD (measuring direction: 1 plus, 2 minus; 0: from the present "
                      "position of the probe towards the set value) takes a whole number, "
                      "not 1.5"}));
}

TEST(SinumerikArguments, CorrectionsWithoutATargetAreNamed) {
  EXPECT_EQ(mistakesIn("CYCLE978(100,,,1,20,5,1,1,1)\n"),
            (Messages{"1:14 warning: argument 2 of CYCLE978: S_KNUM (zero offset to correct) is missing: S_MVAR asks "
                      "for a correction, and nothing is corrected"}));
  EXPECT_EQ(mistakesIn("CYCLE978(200,,0,1,20,5,1,1,1)\n"),
            (Messages{"1:15 warning: argument 3 of CYCLE978: S_KNUM1 (tool offset to correct) cannot be 0 here: S_MVAR "
                      "asks for a correction, and nothing is corrected"}));
}

TEST(SinumerikArguments, ValuesThatNoRunTakesAreNamed) {
  /// The parameters that are refused in a call.
  const auto refused = [](const std::string& call) {
    std::string names;
    for (const std::string& message : mistakesIn(call + "\n")) {
      if (message.find("warning") != std::string::npos) continue;
      const std::size_t at = message.find(": ") + 2;
      names += message.substr(at, message.find(' ', at) - at) + ' ';
    }
    return names;
  };
  EXPECT_EQ(refused("CYCLE977(3,,,1,40,,,8,4,,,,,3)"), "S_MA ");
  EXPECT_EQ(refused("CYCLE977(3,,,1,40,,,8,4,,,,,2)"), "");
  EXPECT_EQ(refused("CYCLE977(201,,1,1,40,,,8,4,,,,,,,\"MILL\",,,,,,,1,21)"), "S_EVNUM ");
  EXPECT_EQ(refused("CYCLE977(201,,1,1,40,,,8,4,,,,,,,\"MILL\",,,,,,,1,210000)"), "S_EVNUM ");
  EXPECT_EQ(refused("CYCLE977(201,,1,1,40,,,8,4,,,,,,,\"MILL\",,,,,,,1,200020)"), "");
  EXPECT_EQ(refused("CYCLE978(100,1,,1,20,5,1,1,1,1,,,,,,,,,21)"), "S_EVNUM ");
  for (const char* axes : {"101", "1", "211", "104", "401"})
    EXPECT_EQ(refused(fmt::format("CYCLE998(105,1,,1,,,,8,4,{},1,20)", axes)), "S_MA ") << axes;
  for (const char* axes : {"201", "102", "301", "203"})
    EXPECT_EQ(refused(fmt::format("CYCLE998(105,1,,1,,,,8,4,{},1,20)", axes)), "") << axes;
  EXPECT_EQ(refused("CYCLE998(105,1,,1,,45.5,,8,4,201,1,20)"), "S_STA1 ");
  EXPECT_EQ(refused("CYCLE998(105,1,,1,,-45,,8,4,201,1,20)"), "");
  EXPECT_EQ(refused("CYCLE998(106,1,,1,,70,40,8,4,,,,20,,,20)"), "S_STA1 S_INCA ");
  EXPECT_EQ(refused("CYCLE998(105,3001,,1,,,,8,4,201,1,20)"), "S_KNUM ");
  EXPECT_EQ(refused("CYCLE961(106,3001,1,10,20,10,,,,,,,,,,,8,4)"), "S_KNUM ");
  EXPECT_EQ(refused("CYCLE961(106,1,1,10,20,10,,,,,,,,271,,,8,4)"), "S_STA1 ");
  EXPECT_EQ(refused("CYCLE961(107,1,1,10,20,10,20,,,,,,,,181,,8,4)"), "S_INCA ");
  EXPECT_EQ(refused("CYCLE979(1,,,1,40,5,2,0,0,361,121)"), "S_STA1 S_INCA ");
  EXPECT_EQ(refused("CYCLE979(1001,,,1,40,5,2,0,0,360,91)"), "S_INCA ");
  EXPECT_EQ(refused("CYCLE997(101009,,1,25,8,4,,91)"), "S_INCA ");
  EXPECT_EQ(refused("CYCLE976(1001,1,40,,3,0,8,4)"), "S_MA ");
  EXPECT_EQ(refused("CYCLE976(1000,1,0,,3,1,8,4)"), "");
  EXPECT_EQ(refused("CYCLE976(4,1,0,,1,1,8,4)"), "S_MVAR ") << "an edge in one direction or in both";
  EXPECT_EQ(refused("CYCLE976(1004,1,0,,1,1,8,4)"), "");
  EXPECT_EQ(refused("CYCLE976(2004,1,0,,1,1,8,4)"), "S_SETV ") << "how far the edges are apart";
  for (const char* axes : {"-1", "4", "12", "100", "401", "101", "1"})
    EXPECT_EQ(refused(std::string("CYCLE994(2,,,1,40,") + axes + ",,20,8,1)"), "S_MA ") << axes;
  for (const char* axes : {"2", "102", "201", "302"})
    EXPECT_EQ(refused(std::string("CYCLE994(2,,,1,40,") + axes + ",,20,8,1)"), "") << axes;
  EXPECT_EQ(refused("CYCLE994(1,,,1,40,1,,,8,1)"), "") << "without a zone the probe stays in the hole";
  EXPECT_EQ(refused("CYCLE994(2001,,,1,40,2,30,20,8,1)"), "S_MA ") << "past the zone in the axis that is measured";
  EXPECT_EQ(refused("CYCLE971(1,,1,200,,,8,1)"), "S_MA ") << "an offset axis alone";
  EXPECT_EQ(refused("CYCLE971(1,,1,201,,,8,1)"), "");
  EXPECT_EQ(refused("CYCLE976(2004,1,50,,1,1,8,4)"), "");
}

TEST(SinumerikArguments, WhatTheVersionReservesIsNamed) {
  EXPECT_EQ(
      mistakesIn("CYCLE997(9,,1,25,8,4,,,,,,,,,,,,,,,1,10)\n"),
      (Messages{"1:38 warning: argument 22 of CYCLE997: _AMODE = 10 is not observed: version 4.4 of the measuring "
                "cycles reserves it"}));
  EXPECT_EQ(mistakesIn("CYCLE997(9,,1,25,8,4,,,,,,,,,,,,,,0,1,0)\n"), Messages{});
}

TEST(SinumerikArguments, DigitsAndArgumentsOfNewerVersionsAreNamedSo) {
  EXPECT_EQ(mistakesIn("CYCLE977(101,10001,,1,32,,,7,5,0,-6,,,,1,\"\",,0,1.01,1.01,-1.01,0.34,1,0,,1,11,-3,15)\n"),
            Messages{});
  EXPECT_EQ(
      mistakesIn("CYCLE977(101,10001,,1,32,,,7,5,0,-6,,,,1,\"\",,0,1.01,1.01,-1.01,0.34,1,0,,1,1,-3,15)\n"),
      (Messages{"1:78 warning: argument 28 of CYCLE977: S_POS1 = -3 is not observed: the tens of _AMODE are not 1"}));
  const std::string note =
      "; such digits belong to versions of the measuring cycles newer than 4.4, and what they mean is not published";
  EXPECT_EQ(
      mistakesIn("CYCLE978(0,,,1,20,5,1,1,1,1,,,,,,,,,,,1,11)\n"),
      (Messages{"1:41 argument 22 of CYCLE978: _AMODE (1: S_TUL and S_TLL are a tolerance) cannot be 11: its tens "
                "have no meaning and must be 0, not 1" +
                note}));
  EXPECT_EQ(mistakesIn("CYCLE978(0,,,1,20,5,1,1,1,1,,,,,,,,,,,101)\n"),
            (Messages{"1:39 argument 21 of CYCLE978: _DMODE (plane: 0 as active, 1 G17, 2 G18, 3 G19) cannot be 101: "
                      "its hundreds have no meaning and must be 0, not 1" +
                      note}));
  const Messages more = mistakesIn("CYCLE978(0,,,1,20,5,1,1,1,1,,,,,,,,,,,1,1,5)\n");
  ASSERT_EQ(more.size(), 1u);
  EXPECT_NE(more[0].find("newer than 4.4"), std::string::npos) << more[0];
}

TEST(SinumerikArguments, WhatCannotGoTogetherIsNamed) {
  /// The mistakes, without warnings.
  const auto mistakes = [](const std::string& call) {
    Messages found = mistakesIn(call + "\n");
    std::erase_if(found, [](const std::string& each) { return each.find("warning") != std::string::npos; });
    for (std::string& each : found)
      each.erase(0, each.find(": ") + 2);
    return found;
  };
  const std::string bore = "CYCLE977(201,,{},1,40,,,8,4,0,,,,,1,{},,0,1,{},{},,{},{},,1,{})";
  const auto tool = [&](const char* target, const char* name, const char* upper, const char* lower, const char* weight,
                        const char* memories, const char* mode) {
    return mistakes(fmt::format(fmt::runtime(bore), target, name, upper, lower, weight, memories, mode));
  };
  EXPECT_EQ(tool("1", "\"MILL\"", "0.1", "0.2", "", "", "1"), (Messages{"S_TUL = 0.1 is smaller than S_TLL = 0.2"}));
  EXPECT_EQ(tool("1", "\"MILL\"", "0.1", "0.2", "", "", "0"), Messages{}) << "no tolerance";
  EXPECT_EQ(tool("1", "\"MILL\"", "", "0.2", "", "", "1"), (Messages{"S_TUL = 0 is smaller than S_TLL = 0.2"}));
  EXPECT_EQ(tool("0", "\"MILL\"", "0.1", "0.2", "", "", "1"), Messages{}) << "corrects nothing";
  EXPECT_EQ(tool("1", "\"MILL\"", "R1", "0.2", "", "", "1"), Messages{}) << "only the run knows it";
  const Messages weight = {"S_K = 0: the weighting factor of mean value 2 must be greater than 0"};
  EXPECT_EQ(tool("1", "\"MILL\"", "1", "0", "0", "20001", "1"), weight);
  EXPECT_EQ(tool("1", "\"MILL\"", "1", "0", "", "20001", "1"), weight);
  EXPECT_EQ(tool("1", "\"MILL\"", "1", "0", "0", "1", "1"), Messages{}) << "no mean value";
  EXPECT_EQ(tool("1", "\"MILL\"", "1", "0", "2", "20001", "1"), Messages{});
  const std::string line = "the set centres of the three balls (S_SETV0 to S_SETV8) lie on one line";
  EXPECT_EQ(mistakes("CYCLE997(10119,10001,1,25,8,5,,,0,0,10,50,0,10,100,0,10,,1,,1)"), (Messages{line}));
  EXPECT_EQ(mistakes("CYCLE997(10119,10001,1,25,8,5,,,0,0,10,50,0,10,0,0,10,,1,,1)"), (Messages{line}));
  EXPECT_EQ(mistakes("CYCLE997(10119,10001,1,25,8,5,,,0,0,10,50,0,10,50,40,10,,1,,1)"), Messages{});
  const std::string first = "points 1 and 2 (S_SETV0, S_SETV1) do not lie along one edge";
  const std::string second = "points 3 and 4 (S_SETV2, S_SETV3) do not lie along one edge";
  const std::string corner = "S_INCA is not a possible angle of a corner";
  EXPECT_EQ(mistakes("CYCLE961(106,1,1,30,30,60,,-15,-15,,,,,,,,20,5)"), (Messages{first}));
  EXPECT_EQ(mistakes("CYCLE961(106,1,1,-30,80,60,,-15,-15,,,,,,,,20,5)"), (Messages{first}));
  EXPECT_EQ(mistakes("CYCLE961(20106,1,1,-30,80,60,,-15,-15,,,,,,,,20,5)"), Messages{}) << "corner 2 takes amounts";
  EXPECT_EQ(mistakes("CYCLE961(108,1,1,30,80,60,60,-15,-15,,,,,,90,,20,5)"), (Messages{second}));
  EXPECT_EQ(mistakes("CYCLE961(108,1,1,30,80,60,-90,-15,-15,,,,,,90,,20,5)"), (Messages{second}));
  EXPECT_EQ(mistakes("CYCLE961(108,1,1,30,80,60,90,-15,-15,,,,,,180,,20,5)"), (Messages{corner}));
  EXPECT_EQ(mistakes("CYCLE961(108,1,1,30,80,60,90,-15,-15,,,,,,90,,20,5)"), Messages{});
  EXPECT_EQ(mistakes("CYCLE961(106,1,1,30,80,60,,-15,-15,,,,,,,,20,5)"), Messages{});
  EXPECT_EQ(mistakes("CYCLE961(117,1,1,5,5,5,5,10,0,20,0,,,,,,10,5)"),
            (Messages{"points 1 and 2 (S_SETV0 to S_SETV3) coincide"}));
  EXPECT_EQ(mistakes("CYCLE961(117,1,1,0,0,9,0,10,5,20,5,,,,,,10,5)"),
            (Messages{"the points of the two edges (S_SETV0 to S_SETV7) do not enclose an angle"}));
  EXPECT_EQ(mistakes("CYCLE961(117,1,1,0,0,9,6,10,5,28,17,,,,,,10,5)"),
            (Messages{"the points of the two edges (S_SETV0 to S_SETV7) do not enclose an angle"}))
      << "both rise by 2 on 3";
  EXPECT_EQ(mistakes("CYCLE961(117,1,1,0,0,9,6,10,5,28,-7,,,,,,10,5)"), Messages{}) << "one rises, the other falls";
  EXPECT_EQ(mistakes("CYCLE977(1101,1,,1,40,,,8,4,0,-10,50)"),
            (Messages{"S_SZA = 50: the protection zone leaves no room within the set size 40"}));
  EXPECT_EQ(mistakes("CYCLE977(1106,1,,1,,40,30,8,4,0,-10,60,30)"),
            (Messages{"S_SZO = 30: the protection zone leaves no room around the set size 30"}));
  EXPECT_EQ(mistakes("CYCLE977(1106,1,,1,,40,30,8,4,0,-10,0,0)"), Messages{}) << "a zone of no width is none";
  EXPECT_EQ(mistakes("CYCLE977(1106,1,,1,,40,30,8,4,0,-10,40.1,30.1)"), Messages{});
  EXPECT_EQ(mistakes("CYCLE977(1101,1,,1,40,,,8,4,0,-10,39.9)"), Messages{});
  EXPECT_EQ(mistakesIn("CYCLE977(201,,1,1,40,,,8,4,0,,,,,1,\"\")\n"),
            (Messages{"1:36 warning: argument 16 of CYCLE977: S_TNAME names no tool to correct, which only machines "
                      "with unique D numbers can do with"}));
}

TEST(SinumerikArguments, CallsOfTheOldFormTakeVariables) {
  EXPECT_EQ(mistakesIn("_MVAR=101 _SETVAL=40 _FA=8 _TSA=4 _KNUM=1\n"
                       "CYCLE977\n"
                       "CYCLE977()\n"
                       "IF _OVS_TNAME==\"MILL\"\nM0\nENDIF\n_ALM=0\nM30\n"),
            Messages{});
  EXPECT_EQ(mistakesIn("CYCLE978\n_MVAR=100\nM30\n"),
            (Messages{std::string("1:1 argument 6 of CYCLE978: ") + path + " is missing",
                      "1:1 warning: argument 7 of CYCLE978: S_TSA (safe area: a larger difference from the set value "
                      "stops the program) is missing: the smallest difference stops the program",
                      "1:1 argument 8 of CYCLE978: S_MA (measuring axis: 1, 2 in the plane, 3 along the tool) is "
                      "missing"}));
}

TEST(SinumerikArguments, ThoseOfCycle800And116AreCounted) {
  EXPECT_EQ(mistakesIn("CYCLE800(1,TABLE,100000)\n"), (Messages{"1:12 TABLE is not declared"}));
  EXPECT_EQ(mistakesIn("CYCLE800(1,5,100000,\"57\")\n"),
            (Messages{"1:12 argument 2 of CYCLE800: _TC (name of the swivel data set) takes a text",
                      "1:21 argument 4 of CYCLE800: _MODE (kind and order of the angles) takes a number"}));
  EXPECT_EQ(mistakesIn("CYCLE800(1,\"\",0,57,0,0,0,0,0,0,0,0,0,-1,100,1,2)\n"),
            (Messages{"1:47 CYCLE800 takes at most 16 arguments, but 17 are given"}));
  EXPECT_EQ(mistakesIn("CYCLE116()\n").size(), 1u);
}

/// As the run does: 61307, 61329.
TEST(SinumerikArguments, VariantsThatDoNotFitTogetherAreNamed) {
  const auto told = [](const std::string& call) {
    const Messages found = mistakesIn(call + "\nM30\n");
    return found.empty() ? "" : found.front();
  };
  EXPECT_EQ(told("CYCLE973(1001101,1,1,40,2,1,8,2,,1,,0,0)"),
            "1:10 argument 1 of CYCLE973: S_MVAR does not fit together: a radius does not correct the length");
  EXPECT_EQ(told("CYCLE973(100,1,1,40,2,1,8,2,,1,,0,0)"),
            "1:10 argument 1 of CYCLE973: S_MVAR does not fit together: a surface is touched in one given direction");
  EXPECT_EQ(told("CYCLE974(10000,0,0,1,80,1,2,1)"),
            "1:10 argument 1 of CYCLE974: S_MVAR does not fit together: a front edge is not measured with reversal");
  EXPECT_EQ(told("CYCLE974(10102,1,0,1,80,2,2,1)"),
            "1:10 argument 1 of CYCLE974: S_MVAR does not fit together: with reversal no zero offset is corrected");
  EXPECT_EQ(told("CYCLE978(10000,,,1,20,5,1,3,2,1)"),
            "1:10 argument 1 of CYCLE978: S_MVAR does not fit S_MA: along the tool only the standard method measures");
  EXPECT_EQ(told("CYCLE998(10006,,0,1,1,0,0,5,5,201,1,10,10,,,10,1,,1,)"),
            "1:10 argument 1 of CYCLE998: S_MVAR does not fit together: a plane is measured along the "
            "tool by the standard method only");
  EXPECT_EQ(told("CYCLE998(10005,,0,1,1,0,,5,5,103,1,10,,,,,1,,1,)"),
            "1:30 argument 10 of CYCLE998: S_MA does not fit the measuring variant: spindle reversal measures only in "
            "the plane");
  EXPECT_EQ(told("CYCLE998(6,,1,1,1,0,0,5,5,201,1,10,10,,,10,1,,1,)"),
            "1:13 argument 3 of CYCLE998: S_RA does not fit the measuring variant: a plane corrects rotations only: "
            "S_RA = 0");
}

}  // namespace
}  // namespace probewright::language::sinumerik
