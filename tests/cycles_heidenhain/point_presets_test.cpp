#include "cycles_heidenhain/worlds.hpp"

/// Cycles 414 to 419: the preset goes to a corner, the middle of a pattern of holes, or a touched point.
namespace probewright::testing_support {
namespace {

constexpr int worlds = 100;
constexpr double exact = 1e-6;

/// Where the new preset goes and what it is to read there.
struct Wish {
  Vector2 plane = Vector2::Zero();
  double height = 0;
  bool toolAxis = false;
  Transfer transfer;
  Words words;
};

Wish randomWish(Dice& dice, const PlantedPart& part, const Vector3& onTop) {
  Wish wish;
  wish.plane = {written(dice.between(-50, 50)), written(dice.between(-50, 50))};
  wish.height = written(dice.between(-50, 50));
  wish.toolAxis = dice.coin();
  const int rows[] = {0, 1, 7};
  wish.transfer = transferInto(rows[dice.whole(0, 2)]);
  const Vector3 top = part.machineFromPreset.inverse() * (part.machineFromPart * onTop);
  wish.words = with({{331, wish.plane.x()},
                     {332, wish.plane.y()},
                     {381, wish.toolAxis ? 1 : 0},
                     {382, written(top.x())},
                     {383, written(top.y())},
                     {384, part.nominal.z()},
                     {333, wish.height}},
                    wish.transfer.words);
  return wish;
}

/// The preset reads the wish at the feature (machine coordinates) and its X axis lies `turned` degrees from that of the
/// old preset.
void expectPreset(const Ran& ran, const PlantedPart& part, const Wish& wish, const Vector3& feature, double turned) {
  EXPECT_NEAR(ran.seen(feature).x(), wish.plane.x(), exact);
  EXPECT_NEAR(ran.seen(feature).y(), wish.plane.y(), exact);
  EXPECT_NEAR(ran.seen(part.machineFromPart.translation()).z(), wish.toolAxis ? wish.height : part.truth().z(), exact);
  const Pose expected = part.machineFromPreset * pose(Vector3::Zero(), {0, 0, turned});
  EXPECT_TRUE(ran.preset().linear().isApprox(expected.linear(), 1e-10));
}

/// Cycles 414 and 415: any of the four corners, skewed by up to 8 degrees, with and without a basic rotation.
void expectCorner(int cycle, bool outside) {
  Dice dice(static_cast<unsigned>(cycle));
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 0.5, 8);
    // The corner is the part's origin; the material lies towards side1 in X, side2 in Y, from the corner.
    const double side1 = dice.coin() ? 1 : -1, side2 = dice.coin() ? 1 : -1;
    const auto box = [&](double x1, double x2, double y1, double y2) {
      part.bench.part(
          simulation::Box({std::min(x1, x2), std::min(y1, y2), -40}, {std::max(x1, x2), std::max(y1, y2), 0}),
          part.machineFromPart);
    };
    const double far = 100 * side1, wide = 100 * side2;
    // An inside corner: the free room lies towards side1, side2, walls behind.
    if (outside) {
      box(0, far, 0, wide);
    } else {
      box(0, -far, -wide, wide);
      box(0, far, 0, -wide);
    }
    // Nominal points on the skewed sides, as measured on the drawing of the clamped part.
    const auto drawn = [&](double x, double y) {
      const Vector3 at = pose(part.nominal, {0, 0, part.skew}) * Vector3(x, y, 0);
      return Vector2(written(at.x()), written(at.y()));
    };
    const bool rotate = dice.coin();
    const Wish wish = randomWish(dice, part, outside ? Vector3(50 * side1, 50 * side2, 0) : Vector3(-50 * side1, 0, 0));
    Words words = with(wish.words, {{261, part.nominal.z() - 8},
                                    {320, 4},
                                    {260, part.nominal.z() + 20},
                                    {301, dice.whole(0, 1)},
                                    {304, rotate ? 1 : 0}});
    if (outside) {
      // The distances count in +: the touch with the smaller coordinate is named.
      const double q326 = written(dice.between(15, 30)), q327 = written(dice.between(15, 30));
      const Vector2 first = drawn(side1 > 0 ? 10 : -10 - q326, 0);
      const Vector2 third = drawn(0, side2 > 0 ? 10 : -10 - q327);
      words = with(words,
                   {{263, first.x()}, {264, first.y()}, {326, q326}, {296, third.x()}, {297, third.y()}, {327, q327}});
    } else {
      const int number = side1 > 0 ? (side2 > 0 ? 1 : 4) : (side2 > 0 ? 2 : 3);
      words = with(words, {{263, part.nominal.x()},
                           {264, part.nominal.y()},
                           {326, written(dice.between(20, 35))},
                           {327, written(dice.between(20, 35))},
                           {308, number}});
    }
    const Ran ran = part.bench.run(probe(cycle, words) + wish.transfer.after);
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(151), part.truth().x(), exact);
    EXPECT_NEAR(ran.q(152), part.truth().y(), exact);
    expectPreset(ran, part, wish, part.machineFromPart.translation(), rotate ? part.skew : 0);
  }
}

TEST(Cycle414, FindsAnyOutsideCorner) { expectCorner(414, true); }
TEST(Cycle415, FindsAnyInsideCorner) { expectCorner(415, false); }

/// The manual of the iTNC 530 calls Q263 and Q264 the first touch point, that of the TNC 640 the corner. Whatever a
/// programmer puts there, the corner or a point of the first wall beside it, both controls find the same corner.
TEST(Cycle415, FindsTheCornerFromAPointOfTheFirstWallToo) {
  Dice dice(4151);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 0.5, 5);
    part.bench.part(simulation::Box({-140, -100, -40}, {0, 100, 0}), part.machineFromPart);
    part.bench.part(simulation::Box({0, -100, -40}, {140, 0, 0}), part.machineFromPart);
    const double beside = written(dice.between(0, 15));
    const Words words = {{263, part.nominal.x() + beside},
                         {264, part.nominal.y()},
                         {326, written(dice.between(20, 35))},
                         {327, written(dice.between(20, 35))},
                         {308, 1},
                         {261, part.nominal.z() - 8},
                         {320, 4},
                         {260, part.nominal.z() + 20},
                         {301, dice.whole(0, 1)},
                         {304, 0},
                         {305, 0},
                         {331, 0},
                         {332, 0},
                         {303, 1},
                         {381, 0},
                         {382, 0},
                         {383, 0},
                         {384, 0},
                         {333, 0}};
    const Ran ran = part.bench.run(probe(415, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(151), part.truth().x(), exact);
    EXPECT_NEAR(ran.q(152), part.truth().y(), exact);
    EXPECT_LT((ran.seen(part.machineFromPart.translation()).head<2>()).norm(), exact);
  }
}

TEST(Cycle416, FindsTheCentreOfAnyBoltHoleCircle) {
  Dice dice(416);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 0.5, 3);
    const double circle = dice.between(100, 160), hole = dice.between(10, 25);
    const double first = dice.between(-180, 180);
    const std::array<double, 3> angles = {first, first + dice.between(60, 140), first + dice.between(180, 290)};
    Words words = {{273, part.nominal.x()}, {274, part.nominal.y()}, {262, written(circle)}};
    for (int i = 0; i < 3; ++i) {
      const double angle = angles[static_cast<std::size_t>(i)];
      const Vector3 centre(circle / 2 * std::cos(radians(angle)), circle / 2 * std::sin(radians(angle)), 0);
      part.bench.part(simulation::Ring(hole / 2, hole / 2 + 10, -40), part.machineFromPart * pose(centre));
      words.emplace_back(291 + i, written(std::remainder(angle + part.skew, 360)));
    }
    const Vector3 rim(circle / 2 * std::cos(radians(first)) + hole / 2 + 5, circle / 2 * std::sin(radians(first)), 0);
    const Wish wish = randomWish(dice, part, rim);
    words = with(with(words, wish.words), {{261, part.nominal.z() - 8}, {260, part.nominal.z() + 20}});
    const Ran ran = part.bench.run(probe(416, words) + wish.transfer.after);
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(151), part.truth().x(), exact);
    EXPECT_NEAR(ran.q(152), part.truth().y(), exact);
    EXPECT_NEAR(ran.q(153), circle, exact);
    expectPreset(ran, part, wish, part.machineFromPart.translation(), 0);
  }
}

TEST(Cycle418, FindsWhereTheDiagonalsOfFourHolesCross) {
  Dice dice(418);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 0.5, 0.3);
    const double hole = dice.between(10, 25);
    // Two lines through the part's origin at any angle to each other.
    const double line1 = dice.between(20, 50), line2 = dice.between(110, 150);
    const std::array<double, 4> angles = {line1 + 180, line2 + 180, line1, line2};
    Words words;
    const int numbers[] = {268, 270, 316, 318};
    for (std::size_t i = 0; i < 4; ++i) {
      const double reach = dice.between(40, 80);
      const Vector3 centre(reach * std::cos(radians(angles[i])), reach * std::sin(radians(angles[i])), 0);
      part.bench.part(simulation::Ring(hole / 2, hole / 2 + 5, -40), part.machineFromPart * pose(centre));
      const Vector3 drawn = part.nominal + centre;
      words.emplace_back(numbers[i], written(drawn.x()));
      words.emplace_back(numbers[i] + 1, written(drawn.y()));
    }
    part.bench.part(simulation::RoundBar(8, -40, 0), part.machineFromPart);
    const Wish wish = randomWish(dice, part, Vector3::Zero());
    words = with(with(words, wish.words), {{261, part.nominal.z() - 8}, {260, part.nominal.z() + 20}});
    const Ran ran = part.bench.run(probe(418, words) + wish.transfer.after);
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(151), part.truth().x(), exact);
    EXPECT_NEAR(ran.q(152), part.truth().y(), exact);
    expectPreset(ran, part, wish, part.machineFromPart.translation(), 0);
  }
}

TEST(Cycles417And419, SetOneAxis) {
  Dice dice(417);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 0.5, 0);
    part.bench.part(simulation::Box({-20, -20, -40}, {20, 20, 0}), part.machineFromPart);
    const int axis = dice.whole(0, 2);
    const bool use417 = axis == 2 && dice.coin();
    const double sense = axis == 2 || dice.coin() ? -1 : 1;
    Vector3 nominal = part.nominal, surface = part.truth();
    if (axis != 2) {
      nominal[axis] -= sense * 20;
      surface[axis] -= sense * 20;
      nominal.z() -= 10;
    }
    const double wish = written(dice.between(-60, 60));
    const int rows[] = {0, 1, 7};
    const Transfer transfer = transferInto(rows[dice.whole(0, 2)]);
    Words words = with({{263, nominal.x()},
                        {264, nominal.y()},
                        {use417 ? 294 : 261, nominal.z()},
                        {320, 1},
                        {260, part.nominal.z() + 20},
                        {333, wish}},
                       transfer.words);
    if (!use417) words = with(words, {{272, axis + 1}, {267, sense}});
    const Ran ran = part.bench.run(probe(use417 ? 417 : 419, words) + transfer.after);
    ASSERT_TRUE(ran.finished()) << ran.why();
    if (use417) {
      EXPECT_NEAR(ran.q(160), surface.z(), exact);
    }
    // The axis reads the wish, the others what they read before.
    Vector3 expected = surface;
    expected[axis] = wish;
    EXPECT_NEAR((ran.seen(part.machineFromPreset * surface) - expected).norm(), 0, exact);
    EXPECT_TRUE(ran.preset().linear().isApprox(part.machineFromPreset.linear(), 1e-12));
  }
}

}  // namespace
}  // namespace probewright::testing_support
