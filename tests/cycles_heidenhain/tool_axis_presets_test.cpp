#include "cycles_heidenhain/across.hpp"

/// Touch probe axis X and Y: slots, ridges, rectangles, corners and patterns of holes become presets; edges, holes and
/// studs become basic rotations, on both controls.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6;
const Words heights = {{261, -9}, {320, 1}, {260, 20}, {301, 1}};

/// Runs `body` in worlds of both controls and both tool axes.
template <class Body>
void inEachWorld(unsigned seed, int worlds, const Body& body, const std::string& machine = "mill3") {
  Dice dice(seed);
  for (int at = 0; at < worlds; ++at) {
    const char axis = at % 4 < 2 ? 'X' : 'Y';
    SCOPED_TRACE(fmt::format("world {}, tool axis {}", at, axis));
    Across world(controlOf(at), axis, machine);
    body(world, dice);
  }
}

TEST(ToolAxis, PresetsSlotsAndRidges) {
  inEachWorld(408, 16, [](Across& world, Dice& dice) {
    const bool slot = dice.coin();
    const int axis = dice.whole(0, 1);
    const double width = dice.between(24, 36), middle = dice.between(-0.8, 0.8), top = dice.between(-0.5, 0.5);
    Vector3 low(-60, -60, -40), high(60, 60, top);
    if (slot) {
      Vector3 inner = high, outer = low;
      inner[axis] = middle - width / 2;
      outer[axis] = middle + width / 2;
      world.part(simulation::Box(low, inner), Pose::Identity());
      world.part(simulation::Box(outer, high), Pose::Identity());
    } else {
      low[axis] = middle - width / 2;
      high[axis] = middle + width / 2;
      world.part(simulation::Box(low, high), Pose::Identity());
    }
    // The touch along the tool axis: on the ridge, or beside the slot.
    Vector2 onTop = Vector2::Zero();
    if (slot) onTop[axis] = 40;
    Words words = with(presetInto1(heights), {{321, 0}, {322, 0}, {311, 30}, {272, axis + 1}, {405, 4.5}, {381, 1}});
    words = with(words, {{382, onTop.x()}, {383, onTop.y()}, {333, -2}});
    if (!slot) std::erase_if(words, [](const auto& word) { return word.first == 301; });
    const Ran ran = world.run(probe(slot ? 408 : 409, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(166), width, exact);
    EXPECT_NEAR(ran.q(157), middle, exact);
    Vector3 feature(0, 0, top);
    feature[axis] = middle;
    Vector3 expected(0, 0, -2);
    expected[axis] = 4.5;
    EXPECT_LT((world.seen(ran, feature) - expected).norm(), exact);
  });
}

TEST(ToolAxis, PresetsRectangles) {
  inEachWorld(410, 16, [](Across& world, Dice& dice) {
    const bool pocket = dice.coin();
    const Vector3 centre(dice.between(-0.6, 0.6), dice.between(-0.6, 0.6), dice.between(-0.5, 0.5));
    const Vector2 half(dice.between(19, 21), dice.between(14, 16));
    if (pocket) {
      world.part(simulation::Box({half.x(), -40, -40}, {60, 40, 0}), pose(centre));
      world.part(simulation::Box({-60, -40, -40}, {-half.x(), 40, 0}), pose(centre));
      world.part(simulation::Box({-half.x(), half.y(), -40}, {half.x(), 40, 0}), pose(centre));
      world.part(simulation::Box({-half.x(), -40, -40}, {half.x(), -half.y(), 0}), pose(centre));
    } else {
      world.part(simulation::Box({-half.x(), -half.y(), -40}, {half.x(), half.y(), 0}), pose(centre));
    }
    const Words place = {{321, 0}, {322, 0},  {323, 40}, {324, 30},
                         {331, 7}, {332, -3}, {381, 1},  {382, pocket ? 40 : 0},
                         {383, 0}, {333, 2.5}};
    const Ran ran = world.run(probe(pocket ? 410 : 411, with(presetInto1(heights), place)));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(151), centre.x(), exact);
    EXPECT_NEAR(ran.q(152), centre.y(), exact);
    EXPECT_NEAR(ran.q(154), 2 * half.x(), exact);
    EXPECT_NEAR(ran.q(155), 2 * half.y(), exact);
    EXPECT_LT((world.seen(ran, centre) - Vector3(7, -3, 2.5)).norm(), exact);
  });
}

/// The angle from the old to the new axes of the preset, about the tool axis.
double turned(const Across& world, const Ran& ran) {
  const Matrix3 plane = world.machineFromPlane().linear();
  const Matrix3 rotation = plane.transpose() * ran.preset().linear() * plane;
  EXPECT_NEAR(rotation(2, 2), 1, 1e-12);
  return degrees(std::atan2(rotation(1, 0), rotation(0, 0)));
}
/// The column of the basic rotation about the tool axis.
std::string column(const Across& world) {
  if (world.bench.control == ControlKind::iTNC530) return "ROT";
  return world.axis == 'X' ? "SPA" : "SPB";
}

TEST(ToolAxis, PresetsCornersAndTurnsToThem) {
  inEachWorld(414, 24, [](Across& world, Dice& dice) {
    const bool outside = dice.coin(), rotate = dice.coin();
    const double skew = dice.between(-3, 3);
    const Vector3 corner(dice.between(-0.4, 0.4), dice.between(-0.4, 0.4), 0);
    const Pose lying = pose(corner, {0, 0, skew});
    if (outside) {
      world.part(simulation::Box({0, 0, -40}, {100, 80, 0}), lying);
    } else {
      world.part(simulation::Box({-40, -40, -40}, {0, 80, 0}), lying);
      world.part(simulation::Box({0, -40, -40}, {100, 0, 0}), lying);
    }
    Words words = with(presetInto1(heights), {{320, 4}, {304, rotate ? 1 : 0}, {331, 5}, {332, -6}});
    words = outside ? with(words, {{263, 12}, {264, 0}, {326, 30}, {296, 0}, {297, 14}, {327, 25}})
                    : with(words, {{263, 0}, {264, 0}, {326, 35}, {327, 30}, {308, 1}});
    const Ran ran = world.run(probe(outside ? 414 : 415, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(151), corner.x(), exact);
    EXPECT_NEAR(ran.q(152), corner.y(), exact);
    EXPECT_LT((world.seen(ran, corner).head<2>() - Vector2(5, -6)).norm(), exact);
    EXPECT_NEAR(turned(world, ran), rotate ? skew : 0, exact);
    EXPECT_NEAR(ran.cell("PRESET.PR", "1", column(world)), rotate ? skew : 0, 6e-5);
  });
}

TEST(ToolAxis, PresetsPatternsOfHoles) {
  inEachWorld(416, 16, [](Across& world, Dice& dice) {
    const Vector3 middle(dice.between(-0.4, 0.4), dice.between(-0.4, 0.4), 0);
    const double radius = dice.between(29.7, 30.3);
    for (const double angle : {20.0, 140.0, 250.0}) {
      const Vector3 at(radius * std::cos(radians(angle)), radius * std::sin(radians(angle)), 0);
      world.part(simulation::Ring(5, 8, -30), pose(middle + at));
    }
    const Words circle = {{273, 0}, {274, 0}, {262, 60}, {291, 20}, {292, 140}, {293, 250}, {261, -9}, {260, 20}};
    const Ran ran = world.run(probe(416, with(presetInto1(circle), {{331, 3}, {332, 4}})));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(151), middle.x(), exact);
    EXPECT_NEAR(ran.q(152), middle.y(), exact);
    EXPECT_NEAR(ran.q(153), 2 * radius, exact);
    EXPECT_LT((world.seen(ran, middle) - Vector3(3, 4, 0)).norm(), exact);

    Across square(world.bench.control, world.axis);
    Words holes = {{261, -9}, {260, 20}};
    const int parameters[] = {268, 270, 316, 318};
    for (int i = 0; i < 4; ++i) {
      const Vector3 at(i == 0 || i == 3 ? -25 : 25, i < 2 ? -20 : 20, 0);
      square.part(simulation::Ring(5, 8, -30), pose(middle + at));
      holes = with(holes, {{parameters[i], at.x()}, {parameters[i] + 1, at.y()}});
    }
    const Ran crossed = square.run(probe(418, with(presetInto1(holes), {{331, -3}, {332, 8}})));
    ASSERT_TRUE(crossed.finished()) << crossed.why();
    EXPECT_LT((square.seen(crossed, middle) - Vector3(-3, 8, 0)).norm(), exact);
  });
}

TEST(ToolAxis, TurnsTheBasicRotationOfBothControls) {
  inEachWorld(400, 24, [](Across& world, Dice& dice) {
    const double skew = dice.between(-3, 3), reference = dice.coin() ? 0 : written(dice.between(-20, 20));
    const int cycle = 400 + dice.whole(0, 2);
    Words words = with(heights, {{320, 3}, {307, reference}, {305, 1}});
    if (cycle == 400) {
      world.part(simulation::Box({-40, -30, -30}, {40, 30, 0}), pose(Vector3::Zero(), {0, 0, skew}));
      words = with(words, {{263, -30}, {264, -30}, {265, 30}, {266, -30}, {272, 2}, {267, 1}});
    } else {
      for (const double side : {-40.0, 40.0}) {
        const Pose at = pose(Vector3::Zero(), {0, 0, skew}) * pose({side, 0, 0});
        if (cycle == 401) {
          world.part(simulation::Ring(8, 14, -30), at);
        } else {
          world.part(simulation::RoundBar(8, -30, 0), at);
        }
      }
      words = with(words, {{268, -40}, {269, 0}, {270, 40}, {271, 0}, {402, 0}, {337, 0}});
      if (cycle == 401) std::erase_if(words, [](const auto& word) { return word.first == 320 || word.first == 301; });
      if (cycle == 402) words = with(words, {{313, 16.5}, {314, 16.5}, {315, -10}});
    }
    const Ran ran = world.run(probe(cycle, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(turned(world, ran), skew - reference, exact);
    EXPECT_NEAR(ran.cell("PRESET.PR", "1", column(world)), skew - reference, 6e-5);
    // 404 takes it back.
    const Ran reset = world.run(probe(cycle, words) + probe(404, {{307, 0}}));
    ASSERT_TRUE(reset.finished()) << reset.why();
    EXPECT_NEAR(turned(world, reset), 0, exact);
  });
}

/// The one angle of the iTNC 530 turns the working plane of whatever tool comes.
TEST(ToolAxis, TheOneAngleOfTheITNC530FollowsTheToolAxis) {
  Bench bench(ControlKind::iTNC530);
  bench.preset(1, {10, 20, -300}, 25);
  for (const auto& [axis, angles] : {std::pair('X', Vector3(25, 0, 0)), {'Y', {0, 25, 0}}, {'Z', {0, 0, 25}}}) {
    const Ran ran = bench.runBare(fmt::format("TOOL CALL 1 Z\nTOOL CALL 1 {}\n", axis));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_TRUE(ran.preset().isApprox(pose({10, 20, -300}, angles), 1e-12)) << axis;
  }
  const Ran set = bench.runBare("TOOL CALL 1 Y\n" + probe(404, {{307, -120}}) + "TOOL CALL 1 Z\n");
  ASSERT_TRUE(set.finished()) << set.why();
  EXPECT_EQ(set.cell("PRESET.PR", "1", "ROT"), -120);
  EXPECT_TRUE(set.preset().isApprox(pose({10, 20, -300}, {0, 0, -120}), 1e-12));
}

}  // namespace
}  // namespace probewright::testing_support
