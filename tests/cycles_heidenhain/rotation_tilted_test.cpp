#include "cycles_heidenhain/rotation_worlds.hpp"
#include "cycles_heidenhain/tilted_place.hpp"

/// Cycles 1411 and 1420 in a tilted working plane that the rotary axes agree with.
namespace probewright::testing_support {
namespace {

TEST(Cycle1411, TurnsTheBasicRotationInATiltedPlane) {
  Dice dice(14115);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    TiltedPlace place(dice, ControlKind::TNC640);
    place.bench.believedProbe().setUpClearance = 8;
    const double skew = dice.between(-1, 1);
    const Pose part = place.input * pose(dice.within(0.5), {0, 0, skew});
    const bool studs = dice.coin();
    for (const double x : {-40.0, 40.0}) {
      if (studs) {
        place.bench.part(simulation::RoundBar(10, -30, 0), part * pose({x, 0, 0}));
      } else {
        place.bench.part(simulation::Ring(16, 24, -30), part * pose({x, 0, 0}));
      }
    }
    const double diameter = studs ? 20 : 32;
    const Words words = {{1100, -40},
                         {1101, 0},
                         {1102, -8},
                         {1116, diameter},
                         {1103, 40},
                         {1104, 0},
                         {1105, -8},
                         {1117, diameter},
                         {1115, studs ? 1 : 0},
                         {423, dice.whole(3, 8)},
                         {325, 10},
                         {1119, 360},
                         {320, 0},
                         {260, 30},
                         {1125, 1},
                         {309, 0},
                         {1126, 0},
                         {1120, 1},
                         {1121, 1}};
    const Ran ran =
        place.bench.run(place.before + probe(1411, words) + probe(1411, with(words, {{1120, 0}, {1121, 0}})));
    ASSERT_TRUE(ran.finished()) << ran.why();
    // The second run finds the first circle in its place and the line to the second one parallel.
    EXPECT_NEAR(ran.q(994), 0, exact);
    for (int axis = 0; axis < 2; ++axis)
      EXPECT_NEAR(ran.q(980 + axis), 0, exact);
    EXPECT_NEAR(ran.q(966), diameter, exact);
    EXPECT_TRUE((ran.preset().linear() * place.tilt).isApprox(part.linear(), 1e-9));
  }
}

TEST(Cycle1420, TurnsTheBasicRotationInATiltedPlane) {
  Dice dice(14205);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    TiltedPlace place(dice, ControlKind::TNC640);
    place.bench.believedProbe().setUpClearance = 8;
    const Vector3 lean(dice.between(-3, 3), dice.between(-3, 3), 0);
    const Pose part = place.input * pose(dice.within(0.5), lean);
    place.bench.part(simulation::Box({-80, -80, -30}, {80, 80, 0}), part);
    const Words words = {{1100, -40}, {1101, -30}, {1102, 0}, {1103, 40}, {1104, -30}, {1105, 0},
                         {1106, 0},   {1107, 40},  {1108, 0}, {372, -3},  {320, 0},    {260, 30},
                         {1125, 1},   {309, 0},    {1126, 0}, {1120, 0},  {1121, 1}};
    const Ran once = place.bench.run(place.before + probe(1420, words));
    ASSERT_TRUE(once.finished()) << once.why();
    // What is measured counts in the workpiece system, what is set turns the tilted plane onto the face.
    const Vector3 face = place.tilt * pose(Vector3::Zero(), lean).linear().col(2);
    EXPECT_NEAR(once.q(961), degrees(std::asin(-face.y())), exact);
    EXPECT_NEAR(once.q(962), degrees(std::atan2(face.x(), face.z())), exact);
    EXPECT_LT(((once.preset().linear() * place.tilt).col(2) - part.linear().col(2)).norm(), 1e-9);
    const Ran twice = place.bench.run(place.before + probe(1420, words) + probe(1420, with(words, {{1121, 0}})));
    ASSERT_TRUE(twice.finished()) << twice.why();
    EXPECT_NEAR(twice.q(982) - twice.q(985), 0, exact);
    EXPECT_NEAR(twice.q(982) - twice.q(988), 0, exact);
    EXPECT_NEAR(twice.q(961), degrees(std::asin(-place.tilt.col(2).y())), exact);
    EXPECT_NEAR(twice.q(962), degrees(std::atan2(place.tilt(0, 2), place.tilt(2, 2))), exact);
  }
}

}  // namespace
}  // namespace probewright::testing_support
