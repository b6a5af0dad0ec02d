#include "cycles_heidenhain/wrong_probe.hpp"

/// Every way of touching with a probe that is not as the control believes: its tip lies beside the spindle axis and
/// its signal comes late. What is found is wrong by what theory says: by -offset everywhere, and by the late way along
/// the direction of the touch.
namespace probewright::testing_support {
namespace {

constexpr int worlds = 20;
constexpr double exact = 1e-6;

TEST(WrongProbe, MovesSinglePoints) {
  Dice dice(1);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(world);
    WrongProbe wrong(dice);
    wrong.layBlock();
    const int axis = world % 2;
    const double expected = -wrong.offset[axis] + wrong.late;
    Vector3 start(30, 30, -8);
    start[axis] = -7;
    const auto blocks = [&](const std::string& cycle, const std::string& how) {
      return wrong.bench.run(fmt::format("L X{0:+} Y{1:+} R0 FMAX\n{2}\n{3} X{0:+} Y{1:+} Z{4:+}\n", start.x(),
                                         start.y(), cycle, how, start.z()));
    };
    const Ran zero = blocks(fmt::format("TCH PROBE 0.0 REF. PLANE Q7 {}+", "XY"[axis]), "TCH PROBE 0.1");
    ASSERT_TRUE(zero.finished()) << zero.why();
    EXPECT_NEAR(zero.q(7), expected, exact);
    const Ran polar = blocks(fmt::format("TCH PROBE 1.0 POLAR\nTCH PROBE 1.1 X ANGLE: {}", axis * 90), "TCH PROBE 1.2");
    ASSERT_TRUE(polar.finished()) << polar.why();
    EXPECT_NEAR(polar.q(115 + axis), expected - 2, exact) << "the ball's centre, not the surface";

    const Words side = with(height, {{263, axis == 0 ? 0 : 30}, {264, axis == 0 ? 30 : 0}, {272, axis + 1}, {267, 1}});
    const Ran coordinate =
        wrong.run(427, with(side, {{281, 0}, {288, 0}, {289, 0}, {309, 0}, {330, 0}, {498, 0}, {531, 0}}));
    EXPECT_NEAR(coordinate.q(160), expected, exact);
    const Ran preset = wrong.run(419, with(side, {{305, 1}, {333, 0}, {303, 1}}));
    EXPECT_NEAR(wrong.moved(preset)[axis], expected, exact);
    const Ran top = wrong.run(417, {{263, 30}, {264, 30}, {294, 0}, {320, 0}, {260, 20}, {305, 1}, {333, 0}, {303, 1}});
    EXPECT_NEAR(wrong.moved(top).z(), -wrong.lateAlong, exact) << "only what comes late along the stylus counts";
  }
}

TEST(WrongProbe, MovesCentresAndChangesSizes) {
  Dice dice(2);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(world);
    // What is felt from within grows by the late way on each side, what is felt from without shrinks.
    for (const bool inside : {true, false}) {
      WrongProbe wrong(dice);
      const double sign = inside ? 1 : -1;
      const auto expectCentre = [&](const Vector3& found) {
        EXPECT_NEAR(found.x(), 40 - wrong.offset.x(), exact);
        EXPECT_NEAR(found.y(), 30 - wrong.offset.y(), exact);
      };
      {
        WrongProbe rectangle = wrong;
        if (inside) {
          PlantedPart part{rectangle.bench};
          part.machineFromPart = pose(wrong.origin + Vector3(40, 30, 0));
          layPocket(part, {80, 60});
          rectangle.bench = part.bench;
        } else {
          rectangle.layBlock();
        }
        const Words place = with(heights, {{321, 40}, {322, 30}, {323, 80}, {324, 60}, {381, 0}});
        expectCentre(rectangle.moved(rectangle.run(inside ? 410 : 411, with(place, intoPreset))));
        if (inside) {
          const Ran slot = rectangle.run(
              408, with(heights, {{321, 40}, {322, 30}, {311, 80}, {272, 1}, {305, 1}, {405, 0}, {303, 1}, {381, 0}}));
          EXPECT_NEAR(rectangle.moved(slot).x(), 40 - wrong.offset.x(), exact);
          EXPECT_NEAR(slot.q(166), 80 + 2 * wrong.late, exact);
        } else {
          const Ran measured = rectangle.run(
              424, with(with(heights, unmonitored),
                        {{273, 40}, {274, 30}, {282, 80}, {283, 60}, {284, 0}, {285, 0}, {286, 0}, {287, 0}}));
          expectCentre({measured.q(151), measured.q(152), 0});
          EXPECT_NEAR(measured.q(154), 80 - 2 * wrong.late, exact);
          EXPECT_NEAR(measured.q(155), 60 - 2 * wrong.late, exact);
        }
      }
      const Pose middle = pose(wrong.origin + Vector3(40, 30, 0));
      if (inside) {
        wrong.bench.part(simulation::Ring(20, 60, -40), middle);
      } else {
        wrong.bench.part(simulation::RoundBar(20, -40, 0), middle);
      }
      const Ran circle =
          wrong.run(inside ? 412 : 413,
                    with(with(heights, intoPreset), {{321, 40}, {322, 30}, {262, 40}, {325, 10}, {247, 90}, {381, 0}}));
      expectCentre(wrong.moved(circle));
      // Beside the axis the tip meets the wall at a slant of up to 0.28 / 18: the late way counts half its square more.
      EXPECT_NEAR(circle.q(153), 40 + sign * 2 * wrong.late, 8e-6);
    }
  }
}

TEST(WrongProbe, MovesCornersButTurnsNothing) {
  Dice dice(3);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(world);
    WrongProbe wrong(dice);
    wrong.layBlock();
    // The lower left corner: both sides are felt in the positive direction.
    const Ran corner =
        wrong.run(414, with(with(heights, intoPreset),
                            {{263, 15}, {264, 0}, {326, 40}, {296, 0}, {297, 15}, {327, 30}, {304, 0}, {381, 0}}));
    EXPECT_NEAR(wrong.moved(corner).x(), -wrong.offset.x() + wrong.late, exact);
    EXPECT_NEAR(wrong.moved(corner).y(), -wrong.offset.y() + wrong.late, exact);

    const Words edge = with(heights, {{263, 10}, {264, 0}, {265, 70}, {266, 0}, {272, 2}, {267, 1}});
    const Ran rotation = wrong.run(400, with(edge, {{307, 0}, {305, 1}}));
    EXPECT_NEAR(rotation.cell("PRESET.PR", "1", "SPC"), 0, 6e-5);
    const Ran plane = wrong.run(431, {{263, 10},
                                      {264, 10},
                                      {294, 0},
                                      {265, 70},
                                      {266, 10},
                                      {295, 0},
                                      {296, 40},
                                      {297, 50},
                                      {298, 0},
                                      {320, 0},
                                      {260, 20},
                                      {281, 0}});
    EXPECT_NEAR(plane.q(158), 0, exact);
    EXPECT_NEAR(plane.q(159), 0, exact);
    for (const int number : {173, 174, 175})
      EXPECT_NEAR(plane.q(number), -wrong.lateAlong, exact);
  }
}

TEST(WrongProbe, LeavesTheAngleOfATableButAScaleErrorDoesNot) {
  Dice dice(4);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(world);
    WrongProbe wrong(dice, "mill5-head-table");
    const double skew = dice.between(-5, 5), scale = world % 2 == 0 ? 0 : dice.between(-1e-3, 1e-3);
    wrong.bench.part(simulation::Box({0, 0, -40}, {80, 60, 0}), pose(wrong.origin, {0, 0, skew}));
    wrong.bench.setup.world.truth.errors.axes.resize(wrong.bench.setup.world.truth.machine.axes.size());
    wrong.bench.setup.world.truth.errors.axes[*wrong.bench.setup.world.truth.machine.axisIndex("X")].scale = scale;
    const double t = std::tan(radians(skew));
    const Ran ran = wrong.run(403, with(heights, {{263, 10},
                                                  {264, written(10 * t)},
                                                  {265, 70},
                                                  {266, written(70 * t)},
                                                  {272, 2},
                                                  {267, 1},
                                                  {312, 6},
                                                  {337, 0},
                                                  {305, 1},
                                                  {303, 1},
                                                  {380, 0}}));
    // 60 mm on the scale are longer by the error in truth: so much more does the edge rise between the touches.
    EXPECT_NEAR(ran.q(150), degrees(std::atan(t * (1 + scale))), exact);
  }
}

}  // namespace
}  // namespace probewright::testing_support
