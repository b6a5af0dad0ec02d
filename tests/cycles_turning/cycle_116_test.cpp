#include "support/lathe_bench.hpp"

namespace probewright {
namespace {

using namespace testing_support;

/// Runs CYCLE116 on the points and leaves centre, radius, status and _MODE in R1 to R5.
void compute(LatheBench& bench, const std::vector<Vector2>& points, double count) {
  std::string values = fmt::format("{}", count);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2 point = i < points.size() ? points[i] : Vector2::Zero();
    values += fmt::format(",{:.12f},{:.12f}", point.x(), point.y());
  }
  bench.run("DEF INT _MODE\nDEF REAL _CAL[13]=(" + values + ",0,0,0,0)\nCYCLE116(_CAL[ ], _MODE)\n" +
            "R1=_CAL[9] R2=_CAL[10] R3=_CAL[11] R4=_CAL[12] R5=_MODE");
  if (testing::Test::HasFailure()) return;
  for (const char* done : {"parsed", "runs", "results"})
    coverage::note(control::ControlKind::Sinumerik840Dsl, "CYCLE116", done);
}

double r(const LatheBench& bench, int number) { return bench.data("R", {number}); }

TEST(Cycle116, ComputesTheManualsExample) {
  LatheBench bench(latheSetup({}));
  compute(bench, {{0, 10}, {-10, 0}, {0, -10}}, 3);
  EXPECT_NEAR(r(bench, 1), 0, 1e-9);
  EXPECT_NEAR(r(bench, 2), 0, 1e-9);
  EXPECT_NEAR(r(bench, 3), 10, 1e-9);
  EXPECT_EQ(r(bench, 4), 0);
  EXPECT_EQ(r(bench, 5), 0);
}

/// The statements of the example as they are printed, its comments in place.
TEST(Cycle116, RunsTheManualsProgram) {
  LatheBench bench(latheSetup({}));
  bench.run(
      "DEF INT _MODE\n"
      "DEF REAL _CAL[13]= (3,0,10,-10,0,0,-10,0,0,0,0,0,0) ;three points\n"
      "CYCLE116(_CAL[ ], _MODE) ;_CAL[9]=0 _CAL[10]=0 _CAL[11]=10 _CAL[12]=0 _ALM=0\n"
      "R1=_CAL[9] R2=_CAL[10] R3=_CAL[11] R4=_CAL[12] R5=_MODE\nM0\nSTOPRE\nM30");
  EXPECT_NEAR(r(bench, 1), 0, 1e-9);
  EXPECT_NEAR(r(bench, 2), 0, 1e-9);
  EXPECT_NEAR(r(bench, 3), 10, 1e-9);
  EXPECT_EQ(r(bench, 4), 0);
  EXPECT_EQ(r(bench, 5), 0);
}

TEST(Cycle116, FindsCirclesThroughThreeAndFourPoints) {
  Planter plant(116);
  for (int world = 0; world < 200; ++world) {
    LatheBench bench(latheSetup({}));
    const Vector2 centre(plant.number(-200, 200), plant.number(-200, 200));
    const double radius = plant.number(1, 100), start = plant.number(0, 360);
    const int count = 3 + world % 2;
    std::vector<Vector2> points;
    for (int i = 0; i < count; ++i) {
      const double angle = radiansFromDegrees(start + i * plant.number(40, 80));
      points.push_back(centre + radius * Vector2(std::cos(angle), std::sin(angle)));
    }
    compute(bench, points, count);
    EXPECT_NEAR(r(bench, 1), centre.x(), 1e-7) << "world " << world;
    EXPECT_NEAR(r(bench, 2), centre.y(), 1e-7);
    EXPECT_NEAR(r(bench, 3), radius, 1e-7);
    EXPECT_EQ(r(bench, 4), 0);
  }
}

TEST(Cycle116, SaysWhyThereIsNoCircle) {
  LatheBench bench(latheSetup({}));
  compute(bench, {{0, 0}, {1, 1}, {2, 2}}, 3);
  EXPECT_EQ(r(bench, 4), 1);
  EXPECT_EQ(r(bench, 5), 61316) << "on a line";
  compute(bench, {{1, 1}, {1, 1}, {2, 2}}, 3);
  EXPECT_EQ(r(bench, 5), 61316) << "twice the same";
  for (const double count : {0.0, 2.0, 5.0, 3.5}) {
    compute(bench, {{0, 10}, {-10, 0}, {0, -10}, {10, 0}}, count);
    EXPECT_EQ(r(bench, 4), 1);
    EXPECT_EQ(r(bench, 5), 61317) << count;
  }
  EXPECT_EQ(bench.alarmOf("DEF INT _MODE\nDEF REAL _CAL[12]\nCYCLE116(_CAL[], _MODE)"), "14020") << "too short";
  EXPECT_EQ(bench.alarmOf("DEF REAL _CAL[13]\nCYCLE116(_CAL[])"), "14020");
  EXPECT_EQ(bench.alarmOf("CYCLE116(1, 2)"), "14020");
}

}  // namespace
}  // namespace probewright
