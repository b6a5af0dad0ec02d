#include "support/heidenhain_bench.hpp"

/// What cycles leave in the record of the shapes that they lay through their touches.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-9;

double cofactor(const control::FitRecord& fit, std::string_view row, std::string_view column) {
  const auto place = [&](std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(fit.members, name) - fit.members.begin());
  };
  return fit.cofactors.at(place(row) * fit.members.size() + place(column));
}

/// Four touches in a rectangle that a cycle takes for a hole: the circle's radius lies in the middle between the two
/// half lengths, every touch beside it by half their difference.
TEST(FitRecord, TellsTheFormOfAHoleThatIsNotRound) {
  Dice dice(11);
  for (int world = 0; world < 20; ++world) {
    const Vector2 half(dice.between(14, 16), dice.between(14, 16));
    Bench bench(controlOf(world));
    bench.preset(1, {0, 0, -400});
    const auto wall = [&](const Vector3& from, const Vector3& to) {
      bench.part(simulation::Box(from + Vector3(0, 0, -400), to + Vector3(0, 0, -400)));
    };
    wall({half.x(), -40, -30}, {half.x() + 20, 40, 0});
    wall({-half.x() - 20, -40, -30}, {-half.x(), 40, 0});
    wall({-60, half.y(), -30}, {60, half.y() + 20, 0});
    wall({-60, -half.y() - 20, -30}, {60, -half.y(), 0});
    const Ran ran = bench.run(probe(421, {{273, 0},
                                          {274, 0},
                                          {262, 30},
                                          {325, 0},
                                          {247, 90},
                                          {261, -8},
                                          {320, 1},
                                          {260, 20},
                                          {301, 0},
                                          {275, 0},
                                          {276, 0},
                                          {279, 0},
                                          {280, 0},
                                          {281, 0},
                                          {309, 0},
                                          {330, 0}}));
    ASSERT_TRUE(ran.finished()) << ran.why();
    ASSERT_EQ(ran.cycle().fits.size(), 1U);
    const control::FitRecord& fit = ran.cycle().fits.front();
    EXPECT_EQ(fit.shape, "circle");
    EXPECT_EQ(fit.touches, (std::vector<std::size_t>{0, 1, 2, 3}));
    const double beside = (half.x() - half.y()) / 2;
    ASSERT_EQ(fit.residuals.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(fit.residuals[i], i % 2 == 0 ? beside : -beside, exact);
    EXPECT_NEAR(fit.formDeviation, std::abs(half.x() - half.y()), exact);
    EXPECT_EQ(fit.degreesOfFreedom, 1);
    // Two of four touches tell each coordinate of the centre, all four the radius.
    EXPECT_NEAR(cofactor(fit, "centre.main", "centre.main"), 0.5, exact);
    EXPECT_NEAR(cofactor(fit, "centre.minor", "centre.minor"), 0.5, exact);
    EXPECT_NEAR(cofactor(fit, "radius", "radius"), 0.25, exact);
    EXPECT_NEAR(cofactor(fit, "radius", "centre.main"), 0, exact);
  }
}

TEST(FitRecord, CountsRepeatedTouchesOnce) {
  Bench bench(ControlKind::iTNC530);
  bench.preset(1, {0, 0, -400});
  bench.setup.beliefs.parameters["MP6170"] = {3.0, {}};
  bench.part(simulation::Ring(15, 40, -30), pose({0, 0, -400}));
  const Ran ran = bench.run(probe(412, {{321, 0},
                                        {322, 0},
                                        {262, 30},
                                        {325, 0},
                                        {247, 90},
                                        {261, -8},
                                        {320, 1},
                                        {260, 20},
                                        {301, 0},
                                        {305, 2},
                                        {331, 0},
                                        {332, 0},
                                        {303, 1},
                                        {381, 0},
                                        {382, 0},
                                        {383, 0},
                                        {384, 0},
                                        {333, 0},
                                        {423, 3}}));
  ASSERT_TRUE(ran.finished()) << ran.why();
  ASSERT_EQ(ran.cycle().fits.size(), 1U);
  EXPECT_EQ(ran.cycle().fits.front().touches, (std::vector<std::size_t>{2, 5, 8}));
  EXPECT_EQ(ran.cycle().fits.front().degreesOfFreedom, 0);
}

/// The angle of a line through two points, and the tilt of a plane through three, follow an error of the touches the
/// more, the nearer they lie together.
TEST(FitRecord, TellsHowAnglesFollowTheTouches) {
  Dice dice(12);
  for (int world = 0; world < 20; ++world) {
    Bench bench(controlOf(world));
    bench.preset(1, {0, 0, -400});
    bench.part(simulation::Box({-200, 0, -430}, {200, 100, -400}));
    const double length = dice.between(10, 80), depth = dice.between(10, 80);
    const Ran edge = bench.run(probe(420, {{263, 0},
                                           {264, 0},
                                           {265, length},
                                           {266, 0},
                                           {272, 2},
                                           {267, 1},
                                           {261, -5},
                                           {320, 1},
                                           {260, 20},
                                           {301, 0},
                                           {281, 0}}));
    ASSERT_TRUE(edge.finished()) << edge.why();
    const control::FitRecord& line = edge.cycle().fits.at(0);
    EXPECT_EQ(line.shape, "line");
    EXPECT_EQ(line.degreesOfFreedom, 0);
    EXPECT_NEAR(cofactor(line, "direction.minor", "direction.minor"), 2 / (length * length), exact);
    const Ran face = bench.run(probe(431, {{263, 0},
                                           {264, 10},
                                           {294, 0},
                                           {265, length},
                                           {266, 10},
                                           {295, 0},
                                           {296, 0},
                                           {297, 10 + depth},
                                           {298, 0},
                                           {320, 1},
                                           {260, 20},
                                           {281, 0}}));
    ASSERT_TRUE(face.finished()) << face.why();
    const control::FitRecord& plane = face.cycle().fits.at(0);
    EXPECT_EQ(plane.shape, "plane");
    EXPECT_EQ(plane.touches, (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_NEAR(cofactor(plane, "normal.main", "normal.main"), 2 / (length * length), exact);
    EXPECT_NEAR(cofactor(plane, "normal.minor", "normal.minor"), 2 / (depth * depth), exact);
  }
}

}  // namespace
}  // namespace probewright::testing_support
