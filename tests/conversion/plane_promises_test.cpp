#include <gmock/gmock.h>

#include "conversion/twins.hpp"

/// Planes with a spigot between their points: both programs go over it, aligned or not.
namespace probewright::testing_support {
namespace {

std::string sinumerikProgram(const std::string& blocks) {
  return "G17 G90 G710\nT1 M6 D1\nG54\nG0 Z100\n" + blocks + "M30\n";
}

/// A spigot stands between the points of a plane: both programs go over it.
TEST(ConvertPlanes, GoesUpBetweenThePointsOfAPlane) {
  PlantedPart part{Bench(ControlKind::TNC640, "mill3")};
  part.machineFromPreset = pose({20, -10, -400}, {0, 0, 0});
  part.bench.preset(1, {20, -10, -400}, 0);
  part.bench.believedProbe().maximumTravel = 20;
  part.bench.probeOf(100, 2);
  part.machineFromPart = part.machineFromPreset * pose({0, 0, 0}, {0.2, 0.1, 0});
  part.bench.part(simulation::Box({-60, -40, -20}, {60, 60, 0}), part.machineFromPart);
  part.bench.part(simulation::RoundBar(6, 0, 15), part.machineFromPart * pose({0, -30, 0}, {0, 0, 0}));
  const std::string plane = probe(431, {{263, -50},
                                        {264, -30},
                                        {294, 0},
                                        {265, 50},
                                        {266, -30},
                                        {295, 0},
                                        {296, -50},
                                        {297, 50},
                                        {298, 0},
                                        {320, 3},
                                        {260, 30},
                                        {281, 0}});
  const Twin original = runKlartext(klartextProgram(plane + "L X+Q158 Y+Q159 R0 FMAX\n"), part);
  const Twin there = runConverted(original, part);
  ASSERT_TRUE(ranWhole(original));
  ASSERT_TRUE(ranWhole(there));
  EXPECT_TRUE(sameEnd(original, there));
}

/// A plane with a spigot between its points, and the words of cycle 1420 for it.
PlantedPart planeWithSpigot() {
  PlantedPart part{Bench(ControlKind::TNC640, "mill3")};
  part.machineFromPreset = pose({20, -10, -400}, {0, 0, 0});
  part.bench.preset(1, {20, -10, -400}, 0);
  part.bench.believedProbe().maximumTravel = 20;
  part.bench.probeOf(100, 2);
  part.machineFromPart = part.machineFromPreset * pose({0, 0, 0}, {0.2, 0.1, 0});
  part.bench.part(simulation::Box({-60, -40, -20}, {60, 60, 0}), part.machineFromPart);
  part.bench.part(simulation::RoundBar(6, 0, 15), part.machineFromPart * pose({0, -30, 0}, {0, 0, 0}));
  return part;
}

TEST(ConvertPlanes, GoesUpBetweenThePointsOfAnAlignedPlane) {
  for (const int mode : {0, 1, 2}) {
    SCOPED_TRACE(mode);
    const PlantedPart part = planeWithSpigot();
    const std::string plane = probe(1420, {{1100, -50},
                                           {1101, -30},
                                           {1102, 0},
                                           {1103, 50},
                                           {1104, -30},
                                           {1105, 0},
                                           {1106, -50},
                                           {1107, 50},
                                           {1108, 0},
                                           {372, -3},
                                           {320, 3},
                                           {260, 30},
                                           {1125, mode},
                                           {309, 0},
                                           {1126, 0},
                                           {1120, 0},
                                           {1121, 1}});
    const Twin original = runKlartext(klartextProgram(plane + "L Z+60 R0 FMAX\nL X+Q961 Y+Q962 FMAX\n"), part);
    const Twin there = runConverted(original, part);
    EXPECT_TRUE(there.lost.empty()) << format(there.lost.front());
    // The plane is one object: only 2 leads over the spigot.
    EXPECT_EQ(original.finished, mode == 2) << original.why;
    if (mode == 0) {
      EXPECT_FALSE(there.finished) << there.text;
    }
    if (!original.finished) continue;
    EXPECT_TRUE(there.finished) << there.why << there.text;
    EXPECT_TRUE(sameOrigin(original, there));
    EXPECT_TRUE(sameEnd(original, there));
    const auto one = touchesOf(original), two = touchesOf(there);
    ASSERT_EQ(one.size(), 3U);
    ASSERT_EQ(two.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_LT((one[i] - two[i]).norm(), exactly);
  }
}

/// What cannot be put back is measured first and compared, then measured and corrected: the touches are the same twice.
TEST(ConvertPlanes, MeasuresAlignedPlanesTwiceForTheSafeArea) {
  for (const double safe : {2.0, 0.15}) {
    SCOPED_TRACE(safe);
    PlantedPart part = planeWithSpigot();
    const Twin original = runSinumerik(sinumerikProgram("G0 X20 Y20\nG0 Z5\n" +
                                                        sinumerikCall("CYCLE998", {{"S_MVAR", 106},
                                                                                   {"S_KNUM", 10001},
                                                                                   {"S_PRNUM", 1},
                                                                                   {"S_FA", 5},
                                                                                   {"S_TSA", safe},
                                                                                   {"S_SETV0", 30},
                                                                                   {"S_SETV2", 0},
                                                                                   {"S_SETV3", 25},
                                                                                   {"S_NMSP", 1}}) +
                                                        "G0 Z60\n"),
                                       part);
    const Twin there = runConverted(original, part);
    EXPECT_TRUE(there.lost.empty()) << format(there.lost.front());
    EXPECT_EQ(original.finished, safe > 1) << original.why;
    EXPECT_EQ(there.finished, original.finished) << there.why << there.text;
    EXPECT_TRUE(sameOrigin(original, there));
    const auto one = touchesOf(original), two = touchesOf(there);
    ASSERT_EQ(one.size(), 3U);
    ASSERT_EQ(two.size(), original.finished ? 6U : 3U) << there.text;
    for (std::size_t i = 0; i < two.size(); ++i)
      EXPECT_LT((one[i % 3] - two[i]).norm(), exactly);
  }
}

}  // namespace
}  // namespace probewright::testing_support
