#include "cycles_heidenhain/rotation_worlds.hpp"
#include "machine/rotary_solver.hpp"

/// Cycle 1420: the angles of a plane.
namespace probewright::testing_support {
namespace {

TEST(Cycle1420, FindsTheAnglesOfAnyPlane) {
  Dice dice(1420);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 1, 0);
    const Tilted plane = layPlane(dice, place, 5);
    const int position = dice.whole(0, 4);
    const int rotation = dice.whole(0, 1);
    Words words = with(with(plane.words(), common(dice, place)), {{1120, position}, {1121, rotation}});
    const Ran ran = place.bench.run(place.before + probe(1420, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(ran.q(950 + 3 * i + axis), plane.expected[at][axis], exact);
        EXPECT_NEAR(ran.q(980 + 3 * i + axis), plane.expected[at][axis] - plane.nominal[at][axis], exact);
      }
    }
    const Vector3 inWorkpiece =
        place.machineFromPreset.linear().transpose() * place.machineFromInput.linear() * plane.normal;
    EXPECT_NEAR(ran.q(961), degrees(std::asin(-inWorkpiece.y())), exact);
    EXPECT_NEAR(ran.q(962), degrees(std::atan2(inWorkpiece.x(), inWorkpiece.z())), exact);
    EXPECT_NEAR(ran.q(963), 0, exact);
    if (rotation == 1) {
      const Vector3 square = ran.preset().linear().col(2);
      EXPECT_LT((square - place.machineFromInput.linear() * plane.normal).norm(), 1e-9);
    }
    if (position == 0) continue;
    const auto chosen = [&](const std::array<Vector3, 3>& points) -> Vector3 {
      return position == 4 ? Vector3((points[0] + points[1] + points[2]) / 3)
                           : points[static_cast<std::size_t>(position - 1)];
    };
    expectTransfer(ran, place, rotation == 1 ? turnTo(plane.normal) : Matrix3(Matrix3::Identity()),
                   chosen(plane.expected), chosen(plane.nominal));
    EXPECT_NE(ran.log("TCHPRAUTO.html").find("<h2>1420 "), std::string::npos);
  }
}

/// Where the tool points in the table as it lies when all rotary axes stand at 0.
Vector3 toolOnTable(const Ran& ran) {
  const auto& machine = ran.outcome.machine->description();
  return machine::toolOrientation(machine, {}, ran.outcome.machine->position()).col(2);
}

TEST(Cycle1420, StandsTheToolSquareToThePlane) {
  Dice dice(14201);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 1, 0, dice.coin() ? "mill5-table-table" : "mill5-head-table");
    place.before.clear();
    place.machineFromInput = place.machineFromPreset;
    place.machineFromPart = place.machineFromInput * pose(place.nominal + dice.within(1));
    const Tilted plane = layPlane(dice, place, 5);
    Words words = with(with(plane.words(), common(dice, place)),
                       {{1120, 1}, {1121, 1}, {1126, dice.whole(1, 2)}, {1125, 2}, {260, place.nominal.z() + 60}});
    // The second run finds the plane as it should be, but for what the ball radius cost on the slanting plane.
    const Ran ran = place.bench.run(probe(1420, words) + probe(1420, with(words, {{1121, 0}, {1126, 0}})) +
                                    probe(1420, with(words, {{1121, 0}, {1126, 0}})));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_LT((toolOnTable(ran) - place.machineFromInput.linear() * plane.normal).norm(), 1e-9);
    EXPECT_NEAR(ran.q(961), 0, exact);
    EXPECT_NEAR(ran.q(962), 0, exact);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(ran.q(982 + 3 * i), 0, exact);
  }
}

}  // namespace
}  // namespace probewright::testing_support
