#include <gmock/gmock.h>

#include "conversion/twins.hpp"

/// What calls of SINUMERIK cycles ask for and touch probe cycles do not know: it is carried over by other means, or
/// named.
namespace probewright::testing_support {
namespace {

using ::testing::HasSubstr;

std::string sinumerikProgram(const std::string& blocks) {
  return "G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\n" + blocks + "M30\n";
}

/// A block with a hole `off` its origin, where the program expects it.
PlantedPart blockWithHole(double diameter, const Vector3& off) {
  PlantedPart part{Bench(ControlKind::TNC640, "mill3")};
  part.machineFromPreset = pose({20, -10, -400}, {0, 0, 0});
  part.bench.preset(1, {20, -10, -400}, 0);
  part.bench.believedProbe().maximumTravel = 20;
  part.bench.probeOf(100, 2);
  part.machineFromPart = part.machineFromPreset * pose(off, {0, 0, 0});
  part.bench.part(simulation::Ring(diameter / 2, diameter / 2 + 40, -30), part.machineFromPart);
  return part;
}

/// Beyond S_TSA nothing stays corrected, and both programs stop.
TEST(ConvertSinumerikCalls, MonitorsTheSafeArea) {
  for (const int task : {1, 101}) {
    for (const double off : {0.31, 0.05}) {
      SCOPED_TRACE(fmt::format("{} {}", task, off));
      const PlantedPart part = blockWithHole(40.02, {off, -off / 2, 0});
      const double safe = task == 101 ? 0.2 : 0.01;  // of the centre, or of the diameter
      const Twin original =
          runSinumerik(sinumerikProgram("G0 X0 Y0\nG0 Z-10\n" +
                                        sinumerikCall("CYCLE977", {{"S_MVAR", task},
                                                                   {"S_KNUM", task == 101 ? 10001 : 0},
                                                                   {"S_PRNUM", 1},
                                                                   {"S_SETV", 40},
                                                                   {"S_FA", 4},
                                                                   {"S_TSA", safe},
                                                                   {"S_NMSP", 1}}) +
                                        "G0 Z50\nX7\n"),
                       part);
      const bool exceeded = task == 1 || off > safe;
      const Twin there = runConverted(original, part);
      EXPECT_TRUE(there.lost.empty()) << format(there.lost.front());
      EXPECT_EQ(original.finished, !exceeded) << original.why;
      EXPECT_EQ(there.finished, !exceeded) << there.why << there.text;
      EXPECT_TRUE(sameOrigin(original, there));
      if (exceeded) {
        EXPECT_THAT(there.why, HasSubstr("FN 14"));
      }
    }
  }
}

/// 0 or left out, the smallest deviation is too large.
TEST(ConvertSinumerikCalls, StopsAtAnyDeviationWithoutASafeArea) {
  const PlantedPart part = blockWithHole(40.02, {0.05, 0, 0});
  for (const Named& safe : {Named{{"S_TSA", 0}}, Named{}}) {
    for (const Named& task : {Named{{"S_MVAR", 1}}, Named{{"S_MVAR", 101}, {"S_KNUM", 10001}}}) {
      Named words = {{"S_PRNUM", 1}, {"S_SETV", 40}, {"S_FA", 4}, {"S_NMSP", 1}};
      words.insert(words.end(), safe.begin(), safe.end());
      words.insert(words.end(), task.begin(), task.end());
      const Twin original =
          runSinumerik(sinumerikProgram("G0 X0 Y0\nG0 Z-10\n" + sinumerikCall("CYCLE977", words) + "G0 Z50\n"), part);
      const Twin there = runConverted(original, part);
      EXPECT_TRUE(there.lost.empty()) << format(there.lost.front());
      EXPECT_THAT(original.why, HasSubstr("Safe area exceeded"));
      EXPECT_THAT(there.why, HasSubstr("FN 14")) << there.text;
      EXPECT_TRUE(sameOrigin(original, there));
    }
  }
}

/// The standard values of the cycles: an outside corner of 90 degrees, an edge along the main axis.
TEST(ConvertSinumerikCalls, TakesStandardValuesForWhatIsLeftOut) {
  const Named corner = {{"S_PRNUM", 1},  {"S_SETV0", 20}, {"S_SETV1", 60}, {"S_SETV3", 60},
                        {"S_SETV4", -8}, {"S_SETV5", -8}, {"S_FA", 20},    {"S_TSA", 5}};
  const Named edge = {{"S_PRNUM", 1}, {"S_SETV", 40}, {"S_MD", 1}, {"S_ID", 60}, {"S_FA", 10}, {"S_TSA", 5}};
  for (const auto& [cycle, words, standard] : {std::tuple{"CYCLE961", corner, Named{{"S_MVAR", 6}}},
                                               {"CYCLE998", edge, Named{{"S_MVAR", 5}, {"S_MA", 201}}}}) {
    const auto textOf = [&, name = cycle](const Named& all) {
      return toKlartext(sinumerikProgram("G0 X-8 Y-8\nG0 Z-8\n" + sinumerikCall(name, all))).text;
    };
    Named written = words;
    written.insert(written.end(), standard.begin(), standard.end());
    EXPECT_EQ(textOf(words), textOf(written)) << cycle;
  }
}

/// 0 turns the coordinate system, another number a rotary axis.
TEST(ConvertSinumerikCalls, NamesWhatIsCorrectedByARunningValue) {
  const std::string call = "CYCLE998(105,10001,R1,1,0,0,,5,5,102,1,40)\n";
  EXPECT_TRUE(lists(toKlartext(sinumerikProgram("R1=0\n" + call)), "S_RA of CYCLE998 is known only"));
}

/// A program may calibrate one data set and measure with another, which may be empty.
TEST(ConvertSinumerikCalls, NamesOtherDataSetsOfTheProbe) {
  for (const int set : {0, 1, 2}) {
    const Named words = {{"S_MVAR", 1}, {"S_PRNUM", set}, {"S_SETV", 40}, {"S_FA", 4}, {"S_TSA", 8}};
    const Named ring = {{"S_MVAR", 2}, {"S_PRNUM", set}, {"S_SETV", 40}, {"S_MA", 1}, {"S_FA", 4}, {"S_TSA", 8}};
    EXPECT_EQ(lists(toKlartext(sinumerikProgram(sinumerikCall("CYCLE977", words))), "S_PRNUM"), set == 2);
    EXPECT_EQ(lists(toKlartext(sinumerikProgram(sinumerikCall("CYCLE976", ring))), "S_PRNUM"), set == 2);
  }
}

/// Touch probe cycles calibrate in all directions, and where the ball lies beside the axis with it.
TEST(ConvertSinumerikCalls, NamesCalibrationsOfOneDirection) {
  const auto listed = [](int variant, int touches) {
    const Named ring = {{"S_MVAR", variant}, {"S_PRNUM", 1}, {"S_SETV", 40},     {"S_MA", 1},
                        {"S_FA", 5},         {"S_TSA", 8},   {"S_NMSP", touches}};
    return !warningsOf(toKlartext(sinumerikProgram(sinumerikCall("CYCLE976", ring)))).empty();
  };
  for (const int variant : {1, 2, 3}) {
    EXPECT_FALSE(listed(variant, 1)) << variant;
    EXPECT_TRUE(listed(variant, 2)) << variant;
    EXPECT_TRUE(listed(variant + 10000, 1)) << variant;
  }
  EXPECT_TRUE(listed(1001, 1));
  EXPECT_TRUE(listed(2001, 1));
}

/// CYCLE978 and CYCLE998 take the empirical value off what corrects a zero offset.
TEST(ConvertSinumerikCalls, NamesEmpiricalValues) {
  for (const int variant : {0, 100}) {
    const conversion::Conversion there =
        toKlartext(sinumerikProgram("G0 X-10 Y0\nG0 Z-5\n" + sinumerikCall("CYCLE978", {{"S_MVAR", variant},
                                                                                        {"S_KNUM", 10001},
                                                                                        {"S_SETV", 0},
                                                                                        {"S_FA", 4},
                                                                                        {"S_TSA", 8},
                                                                                        {"S_MA", 1},
                                                                                        {"S_MD", 1},
                                                                                        {"S_EVNUM", 3}})));
    EXPECT_EQ(lists(there, "S_EVNUM"), variant == 100) << there.text;
  }
}

}  // namespace
}  // namespace probewright::testing_support
