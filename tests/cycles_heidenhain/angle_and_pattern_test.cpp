#include "cycles_heidenhain/findings.hpp"

/// Cycles 420, 430 and 431: angles of edges and planes, and bolt hole circles.
namespace probewright::testing_support {
namespace {

constexpr int worlds = 100;
constexpr double exact = 1e-6;

TEST(Cycle420, MeasuresTheAngleOfAnyEdge) {
  Dice dice(420);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 0.3, 20);
    part.bench.part(simulation::Box({-30, -30, -40}, {30, 30, 0}), part.machineFromPart);
    // Touches along the skewed edges, 5 and 15 mm from the middle of the sides.
    const int axis = dice.whole(0, 1);
    const double sense = dice.coin() ? 1 : -1;
    const auto onEdge = [&](double along) {
      Vector3 local = Vector3::Zero();
      local[axis] = -sense * 30;
      local[1 - axis] = along;
      return Vector3(pose(part.nominal, {0, 0, part.skew}) * local);
    };
    const Vector3 a = onEdge(-15), b = onEdge(5);
    const bool swapped = dice.coin();
    const Vector3 first = swapped ? b : a, second = swapped ? a : b;
    const Words words = {{263, written(first.x())},
                         {264, written(first.y())},
                         {265, written(second.x())},
                         {266, written(second.y())},
                         {272, axis + 1},
                         {267, sense},
                         {261, part.nominal.z() - 8},
                         {320, 1},
                         {260, part.nominal.z() + 20},
                         {301, 1},
                         {281, 1}};
    const Ran ran = part.bench.run(probe(420, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    // An edge along the main axis lies at the skew, one along the minor axis at 90 degrees to it, in (-90, 90].
    double expected = part.skew + (axis == 0 ? 90 : 0);
    if (expected > 90) expected -= 180;
    EXPECT_NEAR(ran.q(150), expected, 1e-6);
    EXPECT_NEAR(readLog(ran.log("TCHPR420.TXT")).at("Actual values:Measured angle"), expected, 0.6e-4);
  }
}

/// A plane through the part's origin whose normal is turned by `a` about X and `b` about Y.
TEST(Cycles420And431, MeasureTheTiltOfAnyPlane) {
  Dice dice(431);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 0.3, 0);
    const double ball = part.bench.believedProbe().radius;
    const Vector3 tilt(dice.between(-15, 15), dice.between(-15, 15), 0);
    const Pose machineFromPlane = part.machineFromPart * pose(Vector3::Zero(), tilt);
    part.bench.part(simulation::Box({-60, -60, -40}, {60, 60, 0}), machineFromPlane);
    // The normal and heights in the preset's system.
    const Matrix3 axes = part.machineFromPreset.linear().transpose() * machineFromPlane.linear();
    const Vector3 n = axes.col(2);
    const Vector3 origin = part.truth();
    const auto height = [&](const Vector2& at) {
      return origin.z() - (n.x() * (at.x() - origin.x()) + n.y() * (at.y() - origin.y())) / n.z();
    };
    std::array<Vector2, 3> at;
    const Vector2 middle = part.nominal.head<2>();
    at[0] = middle + Vector2(written(dice.between(-30, -20)), written(dice.between(-30, -20)));
    at[1] = middle + Vector2(written(dice.between(20, 30)), written(dice.between(-30, -20)));
    at[2] = middle + Vector2(written(dice.between(-10, 10)), written(dice.between(20, 30)));
    // Point 3 on the other side: the normal still points out of the part.
    if (dice.coin()) std::swap(at[0], at[1]);
    Words words = {{263, at[0].x()},
                   {264, at[0].y()},
                   {294, written(height(at[0]) + dice.between(-1, 1))},
                   {265, at[1].x()},
                   {266, at[1].y()},
                   {295, written(height(at[1]) + dice.between(-1, 1))},
                   {296, at[2].x()},
                   {297, at[2].y()},
                   {298, written(height(at[2]) + dice.between(-1, 1))},
                   {320, 1},
                   {260, part.nominal.z() + 40},
                   {281, 1}};
    const Ran ran = part.bench.run("Q174 = 777\nQ175 = 777\n" + probe(431, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(158), degrees(std::atan2(-n.y(), n.z())), 1e-6);
    EXPECT_NEAR(ran.q(159), degrees(std::atan2(n.x(), n.z())), 1e-6);
    // Space angles about the fixed axes X, then Y, then Z turn the axes onto the plane: Z onto its normal, X onto the
    // line from the first to the second point.
    const Matrix3 turned = pose(Vector3::Zero(), {ran.q(170), ran.q(171), ran.q(172)}).linear();
    const Vector3 along =
        Vector3(at[1].x() - at[0].x(), at[1].y() - at[0].y(), height(at[1]) - height(at[0])).normalized();
    EXPECT_NEAR((turned.col(2) - n).norm(), 0, 1e-8);
    EXPECT_NEAR((turned.col(0) - along).norm(), 0, 1e-8);
    // The ball's lowest point stands above the slope below it.
    const double above = ball / n.z() - ball;
    // The iTNC 530 leaves the second and the third to the program.
    for (int i = 0; i < 3; ++i) {
      const bool set = i == 0 || part.bench.control == ControlKind::TNC640;
      EXPECT_NEAR(ran.q(173 + i), set ? height(at[static_cast<std::size_t>(i)]) + above : 777, exact);
    }
    const auto log = readLog(ran.log("TCHPR431.TXT"));
    EXPECT_NEAR(log.at("Actual values:Space angle B"), ran.q(171), 0.6e-4);
    EXPECT_NEAR(log.at("Actual values:3rd measured value"), height(at[2]) + above, 0.6e-4);

    // Cycle 420 along the touch probe axis: the slope along one axis, as a turn about the other.
    const int axis = dice.whole(0, 1);
    Vector2 second = middle;
    second[axis] += 25;
    const Ran angle = part.bench.run(probe(420, {{263, middle.x()},
                                                 {264, middle.y()},
                                                 {265, second.x()},
                                                 {266, second.y()},
                                                 {272, 3},
                                                 {267, -1},
                                                 {261, part.nominal.z()},
                                                 {320, 10},
                                                 {260, part.nominal.z() + 40},
                                                 {301, 1},
                                                 {281, 0}}));
    ASSERT_TRUE(angle.finished()) << angle.why();
    const double rise = (height(second) - height(middle)) / (second - middle)[axis];
    EXPECT_NEAR(angle.q(150), axis == 1 ? degrees(std::atan(rise)) : -degrees(std::atan(rise)), 1e-6);
    // Points apart in both axes are those of a B axis on the older control only.
    const Vector2 third = second + Vector2(5, 10);
    const Ran aside = part.bench.run(probe(420, {{263, middle.x()},
                                                 {264, middle.y()},
                                                 {265, third.x()},
                                                 {266, third.y()},
                                                 {272, 3},
                                                 {267, -1},
                                                 {261, part.nominal.z()},
                                                 {320, 10},
                                                 {260, part.nominal.z() + 40},
                                                 {301, 1},
                                                 {281, 0}}));
    if (part.bench.control == ControlKind::TNC640) {
      EXPECT_EQ(aside.alarm(), "Angle not determined");
    } else {
      const double climb = (height(third) - height(middle)) / (third - middle).x();
      EXPECT_NEAR(aside.q(150), -degrees(std::atan(climb)), 1e-6);
    }
  }
}

TEST(Cycle430, MeasuresAnyBoltHoleCircle) {
  Dice dice(430);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 0.5, 3);
    const double circle = dice.between(100, 160), hole = dice.between(10, 25);
    const double first = dice.between(-180, 180);
    const std::array<double, 3> angles = {first, first + dice.between(60, 140), first + dice.between(180, 290)};
    const double nominal = written(circle + dice.between(-0.3, 0.3));
    for (const double angle : angles) {
      const Vector3 centre(circle / 2 * std::cos(radians(angle)), circle / 2 * std::sin(radians(angle)), 0);
      part.bench.part(simulation::Ring(hole / 2, hole / 2 + 10, -40), part.machineFromPart * pose(centre));
    }
    const Vector3 truth = part.truth();
    const Limits limits = limitsAround(dice, circle);
    const double tolerance = toleranceAround(dice, truth.x() - part.nominal.x());
    Words words = {{273, part.nominal.x()}, {274, part.nominal.y()}, {262, nominal}};
    for (int i = 0; i < 3; ++i)
      words.emplace_back(291 + i, written(std::remainder(angles[static_cast<std::size_t>(i)] + part.skew, 360)));
    words = with(words, {{261, part.nominal.z() - 8},
                         {260, part.nominal.z() + 20},
                         {288, limits.maximum},
                         {289, limits.minimum},
                         {279, tolerance},
                         {280, 0},
                         {281, 1},
                         {309, 0},
                         {330, 0}});
    const Ran ran = part.bench.run(probe(430, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(151), truth.x(), exact);
    EXPECT_NEAR(ran.q(152), truth.y(), exact);
    EXPECT_NEAR(ran.q(153), circle, exact);
    EXPECT_NEAR(ran.q(163), circle - nominal, exact);
    Finding finding = std::max(dimension(circle, limits.maximum, limits.minimum, true),
                               position(truth.x() - part.nominal.x(), tolerance));
    if (finding == Finding::Rework) finding = Finding::Scrap;
    expectStatus(ran, finding);
  }
}

}  // namespace
}  // namespace probewright::testing_support
