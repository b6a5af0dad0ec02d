#include "cycles_heidenhain/wrong_probe.hpp"

/// Misalignment cycles, patterns of holes and inside corners felt with a probe that is not as the control believes, on
/// a machine whose scales are wrong: centres move by what theory says, angles only by the error of the scale.
namespace probewright::testing_support {
namespace {

constexpr int worlds = 20;
constexpr double exact = 1e-6;

/// The scale of X too long by `scale`.
void stretchX(WrongProbe& wrong, double scale) {
  auto& truth = wrong.bench.setup.world.truth;
  truth.errors.axes.resize(truth.machine.axes.size());
  truth.errors.axes[*truth.machine.axisIndex("X")].scale = scale;
}

TEST(WrongProbe, LeavesTheAngleOfTwoFeatures) {
  Dice dice(5);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(world);
    WrongProbe wrong(dice, "mill3", controlOf(world));
    const bool holes = dice.coin();
    const double rise = dice.between(-6, 6), scale = world % 4 < 2 ? 0 : dice.between(-1e-3, 1e-3);
    stretchX(wrong, scale);
    for (const double x : {0.0, 80.0}) {
      const Pose at = pose(wrong.origin + Vector3(x, x == 0 ? 0 : rise, 0));
      if (holes) {
        wrong.bench.part(simulation::Ring(8, 14, -40), at);
      } else {
        wrong.bench.part(simulation::RoundBar(8, -40, 0), at);
      }
    }
    const double drawn = written(rise);
    Words words = {{268, 0},  {269, 0}, {270, 80}, {271, drawn}, {261, -8},
                   {260, 20}, {307, 0}, {305, 1},  {402, 0},     {337, 0}};
    if (!holes) words = with(words, {{313, 16.5}, {314, 16.5}, {315, -8}, {320, 1}, {301, 1}});
    const Ran ran = wrong.run(holes ? 401 : 402, words);
    // A scale that is too long shows 80 mm as less; the probe's errors cancel between the two features.
    const double expected = degrees(std::atan2(rise, 80 / (1 + scale)));
    const double found = degrees(std::atan2(ran.preset().linear()(1, 0), ran.preset().linear()(0, 0)));
    EXPECT_NEAR(found, expected, scale == 0 ? exact : 2e-6);
  }
}

TEST(WrongProbe, MovesPatternsInsideCornersAndRidges) {
  Dice dice(6);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(world);
    const WrongProbe wrong(dice, "mill3", controlOf(world));
    const auto expectMoved = [&](const Ran& ran, const Vector2& where) {
      EXPECT_NEAR(wrong.moved(ran).x(), where.x(), exact);
      EXPECT_NEAR(wrong.moved(ran).y(), where.y(), exact);
    };
    const Vector2 middle(10, -5);
    WrongProbe circle = wrong;
    for (const double angle : {0.0, 100.0, 230.0}) {
      const Vector3 at(10 + 40 * std::cos(radians(angle)), -5 + 40 * std::sin(radians(angle)), 0);
      circle.bench.part(simulation::Ring(6, 10, -40), pose(wrong.origin + at));
    }
    const Words bolts = {{273, 10}, {274, -5}, {262, 80}, {291, 0}, {292, 100}, {293, 230}, {261, -8}, {260, 20}};
    const Ran found = circle.run(416, with(with(bolts, intoPreset), {{381, 0}}));
    expectMoved(found, middle - wrong.offset);
    EXPECT_NEAR(found.q(153), 80, exact);

    WrongProbe square = wrong;
    Words holes = {{261, -8}, {260, 20}, {381, 0}};
    const int parameters[] = {268, 270, 316, 318};
    for (int i = 0; i < 4; ++i) {
      const Vector3 at(i == 0 || i == 3 ? -20 : 40, i < 2 ? -25 : 15, 0);
      square.bench.part(simulation::Ring(6, 10, -40), pose(wrong.origin + at));
      holes = with(holes, {{parameters[i], at.x()}, {parameters[i] + 1, at.y()}});
    }
    expectMoved(square.run(418, with(holes, intoPreset)), middle - wrong.offset);

    // Walls felt in the negative directions: the late signal moves the corner further out.
    WrongProbe corner = wrong;
    corner.bench.part(simulation::Box({-40, -40, -40}, {0, 80, 0}), pose(wrong.origin));
    corner.bench.part(simulation::Box({0, -40, -40}, {80, 0, 0}), pose(wrong.origin));
    const Words inside = {{263, 0}, {264, 0}, {326, 40}, {327, 30}, {308, 1}, {304, 0}, {381, 0}};
    expectMoved(corner.run(415, with(with(heights, intoPreset), inside)),
                -wrong.offset - Vector2(wrong.late, wrong.late));

    WrongProbe ridge = wrong;
    ridge.layBlock();
    const Ran width = ridge.run(
        409, with(height, {{321, 40}, {322, 30}, {311, 60}, {272, 2}, {305, 1}, {405, 0}, {303, 1}, {381, 0}}));
    EXPECT_NEAR(wrong.moved(width).y(), 30 - wrong.offset.y(), exact);
    EXPECT_NEAR(width.q(166), 60 - 2 * wrong.late, exact);
  }
}

const Words travel = {{320, 0}, {260, 20}, {1125, 1}, {309, 0}, {1126, 0}, {1120, 0}, {1121, 0}};

TEST(WrongProbe, MovesThePositionsOfTheRotationCycles) {
  Dice dice(7);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(world);
    WrongProbe block(dice, world % 2 == 0 ? "mill3" : "mill5-head-table");
    block.layBlock();
    const Words edge = {{1100, 10}, {1101, 0}, {1102, -8}, {1103, 70}, {1104, 0}, {1105, -8}, {372, 2}};
    const Ran side = block.run(1410, with(edge, with(travel, {{1120, 3}, {1121, 1}})));
    EXPECT_NEAR(side.q(994), 0, exact);
    EXPECT_NEAR(side.q(981), -block.offset.y() + block.late, exact);
    EXPECT_NEAR(block.moved(side).y(), -block.offset.y() + block.late, exact);
    Words plane = {{372, -3}};
    const Vector2 places[] = {{10, 10}, {70, 10}, {40, 50}};
    for (int i = 0; i < 3; ++i)
      plane = with(plane, {{1100 + 3 * i, places[i].x()}, {1101 + 3 * i, places[i].y()}, {1102 + 3 * i, 0}});
    const Ran top = block.run(1420, with(plane, with(travel, {{1120, 4}, {1121, 1}})));
    EXPECT_NEAR(top.q(961), 0, exact);
    EXPECT_NEAR(top.q(962), 0, exact);
    EXPECT_NEAR(block.moved(top).z(), -block.lateAlong, exact);

    WrongProbe circles = block;
    circles.bench.setup.world.truth.solids.clear();
    circles.bench.part(simulation::Ring(8, 16, -40), pose(block.origin));
    circles.bench.part(simulation::RoundBar(10, -40, 0), pose(block.origin + Vector3(70, 0, 0)));
    const Words two = {{1100, 0},  {1101, 0},  {1102, -8}, {1116, 16}, {1103, 70}, {1104, 0},
                       {1105, -8}, {1117, 20}, {1115, 2},  {423, 4},   {325, 0},   {1119, 360}};
    const Ran both = circles.run(1411, with(two, with(travel, {{1120, 1}})));
    EXPECT_NEAR(both.q(994), 0, exact);
    EXPECT_NEAR(both.q(980), -block.offset.x(), exact);
    EXPECT_NEAR(both.q(984), -block.offset.y(), exact);
    // Beside the axis the walls are met at a slant of up to 0.28 / 6.
    EXPECT_NEAR(both.q(996), 2 * block.late, 7e-5);
    EXPECT_NEAR(both.q(997), -2 * block.late, 7e-5);
    EXPECT_NEAR(circles.moved(both).x(), -block.offset.x(), exact);
  }
}

}  // namespace
}  // namespace probewright::testing_support
