#include <gmock/gmock.h>

#include "conversion/twins.hpp"

/// Words of PLANE and arguments of CYCLE800: both machines stand alike, or what they would do differently is listed.
namespace probewright::testing_support {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

PlantedPart trunnion() {
  PlantedPart part{Bench(ControlKind::TNC640, "mill5-table-table")};
  part.bench.preset(1, {10, 20, -400});
  return part;
}

std::string plane(const std::string& words) {
  return klartextProgram("L Z-20 R0 FMAX M91\nL C+30 R0 FMAX\nPLANE " + words + "\n");
}
std::string swivelled(const std::string& arguments) {
  return "G17 G90 G710\nT1 M6 D1\nG54\nSUPA G0 Z-20 D0\nD1\nG0 C30\nCYCLE800(" + arguments + ")\n";
}

::testing::AssertionResult standAlike(const std::string& program, ProgramLanguage language) {
  const PlantedPart part = trunnion();
  const Twin original = run(program, language, part);
  const Twin there = runConverted(original, part);
  for (const auto& result : {ranWhole(original), ranWhole(there), sameEnd(original, there)})
    if (!result) return result;
  return ::testing::AssertionSuccess();
}

TEST(ConvertPostures, OfPlaneWithSeq) {
  for (const char* words : {"SPATIAL SPA+10 SPB+5 SPC+20 TURN FMAX SEQ+", "SPATIAL SPA+10 SPB+5 SPC+20 TURN FMAX SEQ-",
                            "SPATIAL SPA-10 SPB+25 SPC+0 TURN FMAX SEQ-", "SPATIAL SPA+0 SPB+25 SPC+0 STAY"}) {
    const std::string program = plane(std::string(words) + "\nL X+5 Y+7 R0 FMAX");
    EXPECT_TRUE(standAlike(program, ProgramLanguage::Klartext)) << words;
    EXPECT_TRUE(toSinumerik(program).notCarriedOver.empty()) << words;
  }
  for (const char* words : {"SPATIAL SPA+10 SPB+5 SPC+20 TURN FMAX", "SPATIAL SPA+Q5 SPB+5 SPC+20 TURN FMAX SYM+"})
    EXPECT_TRUE(
        lists(toSinumerik(plane(words)),
              *words == 'S' && std::string_view(words).find("SYM") == std::string::npos ? "without SEQ" : "SYM"))
        << words;
}

/// COORD ROT, which is the standard, turns a table that is free in a level plane to 0.
TEST(ConvertPostures, OfLevelPlanes) {
  for (const char* words : {"SPATIAL SPA+0 SPB+0 SPC+20 TURN FMAX", "SPATIAL SPA+0 SPB+0 SPC+20 TURN FMAX COORD ROT",
                            "SPATIAL SPA+Q5 SPB+0 SPC+20 TURN FMAX SEQ+", "SPATIAL SPA+Q5 SPB+Q6 SPC+Q6 TURN FMAX SEQ+",
                            "SPATIAL SPA+0 SPB+0 SPC+20 STAY", "RESET TURN FMAX", "RESET STAY"}) {
    for (const char* values : {"Q5 = 0\nQ6 = 0\n", "Q5 = 7\nQ6 = -8\n"}) {
      EXPECT_TRUE(standAlike(klartextProgram(std::string(values) + "L Z-20 R0 FMAX M91\nL C+30 R0 FMAX\nPLANE " +
                                             words + "\nL X+5 Y+7 R0 FMAX\n"),
                             ProgramLanguage::Klartext))
          << words;
    }
  }
}

TEST(ConvertPostures, RetractsBeforePlaneTurns) {
  for (const char* words :
       {"SPATIAL SPA+10 SPB+5 SPC+20 TURN MB15 FMAX SEQ+", "SPATIAL SPA+0 SPB+0 SPC+20 TURN MB15 FMAX",
        "SPATIAL SPA+Q5 SPB+0 SPC+20 TURN MB15 FMAX SEQ+", "RESET TURN MB15 FMAX"})
    EXPECT_TRUE(standAlike(plane(words), ProgramLanguage::Klartext)) << words;
  for (const auto& [words, call] : {std::pair("SPATIAL SPA+10 SPB+5 SPC+20 TURN MB MAX FMAX SEQ-",
                                              "CYCLE800(4,\"\",0,27,0,0,0,20,5,10,0,0,0,-1)\n"),
                                    {"RESET TURN MB MAX FMAX", "CYCLE800(4,\"\",0,192,"}}) {
    const conversion::Conversion there = toSinumerik(plane(words));
    EXPECT_FALSE(std::ranges::any_of(there.notCarriedOver, isLoss)) << words;
    EXPECT_THAT(there.text, HasSubstr(call));
  }
}

TEST(ConvertPostures, NamesWhatCycle800DoesNotDo) {
  for (const auto& [words, message] : {std::pair("SPATIAL SPA+10 SPB+5 SPC+20 MOVE DIST50 FMAX SEQ+", "MOVE"),
                                       {"RESET MOVE DIST50 FMAX", "MOVE"},
                                       {"SPATIAL SPA+10 SPB+5 SPC+20 TURN F2000 SEQ+", "F: "},
                                       {"RESET TURN F2000", "F: "},
                                       {"SPATIAL SPA+0 SPB+0 SPC+20 TURN FMAX TABLE ROT", "TABLE ROT"},
                                       {"SPATIAL SPA+Q5 SPB+0 SPC+20 TURN FMAX SEQ+ TABLE ROT", "TABLE ROT"}})
    EXPECT_TRUE(lists(toSinumerik(plane(words)), message)) << words;
  // Where the plane is tilted no axis is free.
  const std::string tilted = plane("SPATIAL SPA+10 SPB+5 SPC+20 TURN FMAX SEQ+ TABLE ROT");
  EXPECT_TRUE(toSinumerik(tilted).notCarriedOver.empty());
  EXPECT_TRUE(standAlike(tilted, ProgramLanguage::Klartext));
}

TEST(ConvertPostures, OfCycle800) {
  for (const char* arguments :
       {"0,\"\",0,57,0,0,0,10,0,0,0,0,0,1", "0,\"\",0,57,0,0,0,10,0,0,0,0,0,-1", "0,\"\",0,57,0,0,0,10,0,0,0,0,0",
        "0,\"\",0,27,0,0,0,20,-15,10,0,0,0,1", "0,\"\",0,27,0,0,0,20,-15,10,0,0,0,-1",
        "5,\"\",0,57,0,0,0,10,5,0,0,0,0,1,15", "5,\"\",0,57,0,0,0,10,5,0,0,0,0,0,15",
        "0,\"\",0,192,0,0,0,0,0,0,0,0,0,1", "5,\"\",0,192,0,0,0,0,0,0,0,0,0,1,15"})
    EXPECT_TRUE(standAlike(swivelled(arguments) + "M30\n", ProgramLanguage::Sinumerik)) << arguments;
  const auto listed = [](const char* arguments, const char* message) {
    return lists(toKlartext(swivelled(arguments) + "M30\n"), message);
  };
  EXPECT_TRUE(listed("0,\"\",0,57,0,0,0,10,0,0,0,0,0,1", "SEQ stops"));
  EXPECT_TRUE(listed("0,\"\",1,57,0,0,0,10,0,0,0,0,0,1", "_ST"));
  EXPECT_TRUE(listed("0,\"\",1,57,0,0,0,0,0,0,0,0,0,1", "_ST"));
  EXPECT_TRUE(listed("0,\"\",10,57,0,0,0,10,0,0,0,0,0,1", "_ST"));
  EXPECT_TRUE(listed("0,\"\",R1,57,0,0,0,10,0,0,0,0,0,1", "_ST"));
  EXPECT_TRUE(listed("0,\"\",0,57,0,0,0,10,0,0,0,0,0,R1", "_DIR"));
  EXPECT_TRUE(listed("R1,\"\",0,57,0,0,0,10,0,0,0,0,0,1", "_FR"));
  EXPECT_TRUE(listed("3,\"\",0,57,0,0,0,10,0,0,0,0,0,1", "_FR"));
  EXPECT_TRUE(listed("0,\"\",0,57,0,0,R1,10,0,0,0,0,0,1", "shifts"));
  EXPECT_TRUE(listed("0,\"\",0,57,0,0,0,0,0,20,0,0,0,1", "level plane"));
  EXPECT_TRUE(listed("0,\"\",0,57,0,0,0,0,0,0,0,0,0,1", "level plane"));
  EXPECT_TRUE(listed("0,\"\",0,27,0,0,0,R1,R2,R3,0,0,0,1", "level plane"));
  EXPECT_FALSE(listed("0,\"\",0,192,0,0,0,0,0,0,0,0,0,1", "level plane"));
}

TEST(ConvertPostures, RetractsBeforeCycle800Turns) {
  for (const int way : {1, 2, 4}) {
    const conversion::Conversion there =
        toKlartext(swivelled(fmt::format("{},\"\",0,57,0,0,0,10,0,20,0,0,0,1", way)) + "M30\n");
    EXPECT_THAT(there.text, HasSubstr(" TURN MB MAX FMAX SEQ+\n"));
    EXPECT_EQ(lists(there, "where the machine retracts to"), way != 4);
  }
  EXPECT_THAT(toKlartext(swivelled("4,\"\",0,57,0,0,0,10,0,20,0,0,0,0") + "M30\n").text,
              HasSubstr("L R0 FMAX M140 MB MAX\n"));
  EXPECT_THAT(toKlartext(swivelled("4,\"0\"") + "M30\n").text, HasSubstr("L R0 FMAX M140 MB MAX\n"));
}

/// CYCLE800 cancels the frames of the program; what deselects the plane leaves the rotary axes, and frames, alone.
TEST(ConvertPostures, KnowsWhatCycle800Cancels) {
  for (const char* frame : {"TRANS X11 Y-3\n", "TRANS X11\nAROT Z15\n", "R1=7\nTRANS X=R1\n"})
    EXPECT_TRUE(standAlike("G17 G90 G710\nT1 M6 D1\nG54\nSUPA G0 Z-20 D0\nD1\n" + std::string(frame) +
                               "CYCLE800(0,\"\",0,57,0,0,0,10,0,0,0,0,0,1)\nG0 X1 Y2\nM30\n",
                           ProgramLanguage::Sinumerik))
        << frame;
  const std::string tilted = swivelled("0,\"\",0,57,0,0,0,10,5,0,0,0,0,1");
  for (const char* deselected : {"CYCLE800()\n", "CYCLE800(0,\"0\",0,57,0,0,0,0,0,0,0,0,0,1)\n"}) {
    EXPECT_TRUE(standAlike(tilted + deselected + "G0 X1 Y2\nM30\n", ProgramLanguage::Sinumerik)) << deselected;
    EXPECT_TRUE(lists(toKlartext(tilted + "TRANS X5\n" + deselected + "G0 X1\nM30\n"), "outlives"));
  }
}

}  // namespace
}  // namespace probewright::testing_support
