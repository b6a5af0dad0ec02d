#include "cycles_heidenhain/across.hpp"

/// Cycles 1411 and 1420 with touch probe axis X and Y: main and minor axis are Y and Z, or Z and X.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6;
const Words travel = {{320, 4}, {260, 30}, {1125, 1}, {309, 0}, {1126, 0}, {1120, 0}, {1121, 1}};

TEST(RotationToolAxes, TurnAlongTwoCircles) {
  Dice dice(14120);
  for (int at = 0; at < 40; ++at) {
    SCOPED_TRACE(at);
    Across world(ControlKind::TNC640, at % 2 == 0 ? 'X' : 'Y');
    const double skew = dice.between(-2, 2);
    const Pose part = pose(Vector3(dice.between(-0.5, 0.5), dice.between(-0.5, 0.5), 0), {0, 0, skew});
    for (const double side : {-40.0, 40.0})
      world.part(simulation::RoundBar(10, -30, 0), part * pose({side, 0, 0}));
    const Words words = {{1100, -40}, {1101, 0}, {1102, -8}, {1116, 20}, {1103, 40},  {1104, 0}, {1105, -8},
                         {1117, 20},  {1115, 1}, {423, 4},   {325, 30},  {1119, 360}, {1120, 1}};
    const Ran ran = world.run(probe(1411, with(travel, words)));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(994), skew, exact);
    EXPECT_NEAR(ran.q(966), 20, exact);
    // The first circle reads its nominal place, the second lies on the main axis behind it.
    EXPECT_LT((world.seen(ran, part * Vector3(-40, 0, 0)) - Vector3(-40, 0, 0)).norm(), exact);
    EXPECT_LT((world.seen(ran, part * Vector3(40, 0, 0)) - Vector3(40, 0, 0)).norm(), exact);
  }
}

/// Faces square to the tool axis and walls on all four sides, turned a little.
TEST(RotationToolAxes, FindPlanesAndWalls) {
  Dice dice(14204);
  for (int at = 0; at < 100; ++at) {
    const int directions[] = {-3, 1, -1, 2, -2};
    const int direction = directions[at % 5], axis = std::abs(direction) - 1, sign = direction > 0 ? 1 : -1;
    const char toolAxis = "XYZ"[at / 5 % 3];
    SCOPED_TRACE(fmt::format("world {}, Q372 {}, tool axis {}", at, direction, toolAxis));
    Across world(ControlKind::TNC640, toolAxis);
    Vector3 turns(dice.between(-3, 3), dice.between(-3, 3), dice.between(-3, 3));
    // Walls lean back from the probe.
    if (axis != 2)
      turns = axis == 0 ? Vector3(0, sign * std::abs(turns.y()), turns.z())
                        : Vector3(-sign * std::abs(turns.x()), 0, turns.z());
    const Matrix3 lies = pose(Vector3::Zero(), turns).linear();
    Pose part = Pose::Identity();
    part.linear() = lies;
    // The face to be probed goes through the preset.
    Vector3 low(-70, -70, -60), high(70, 70, 5);
    if (axis == 2)
      high.z() = 0;
    else
      (sign > 0 ? low : high)[axis] = 0;
    world.part(simulation::Box(low, high), part);
    const Vector3 normal = lies * (-sign * Vector3::Unit(axis));
    const Vector2 places[] = {{-30, -25}, {30, -25}, {5, axis == 2 ? 30.0 : -6.0}};
    Words words = with(travel, {{372, direction}});
    for (int i = 0; i < 3; ++i) {
      Vector3 place = Vector3::Zero();
      place[axis == 0 ? 1 : 0] = places[i].x();
      place[axis == 2 ? 1 : 2] = places[i].y();
      for (int k = 0; k < 3; ++k)
        words.emplace_back(1100 + 3 * i + k, place[k]);
    }
    const Ran ran = world.run(probe(1420, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const auto xyz = [&](const Vector3& v) { return world.plane.xyzFromPlane(v); };
    const Matrix3 measured = pose(Vector3::Zero(), {ran.q(961), ran.q(962), ran.q(963)}).linear();
    EXPECT_LT((measured * xyz(Vector3::UnitZ()) - xyz(normal)).norm(), 1e-7);
    EXPECT_LT((ran.preset().linear() * xyz(-sign * Vector3::Unit(axis)) - xyz(normal)).norm(), 1e-8);
  }
}

}  // namespace
}  // namespace probewright::testing_support
