#include "cycles_heidenhain/worlds.hpp"

/// Cycles 0 and 1 in their old block form.
namespace probewright::testing_support {
namespace {

constexpr int worlds = 100;
constexpr double exact = 1e-6;

TEST(Cycle0, MeasuresACoordinateAlongAnyAxis) {
  Dice dice(1000);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 0.5, 0);
    const double length = part.bench.believedProbe().length, ball = part.bench.believedProbe().radius;
    part.bench.part(simulation::Box({-20, -20, -40}, {20, 20, 0}), part.machineFromPart);
    const int axis = dice.whole(0, 2);
    const double sense = axis == 2 || dice.coin() ? -1 : 1;
    Vector3 surface = part.truth(), start = part.nominal;
    if (axis != 2) {
      surface[axis] -= sense * 20;
      start[axis] -= sense * (20 + ball + 3);
      start.z() -= 10;
    } else {
      start.z() += 5;
    }
    const bool inch = dice.whole(0, 3) == 0;
    const double unit = inch ? 25.4 : 1;
    const int number = dice.whole(1, 99);
    // First beside the part, then to the pre-position with all axes together.
    const std::string text = fmt::format(
        "L X{0:+.5f} Y{1:+.5f} R0 FMAX\nTCH PROBE 0.0 REF. PLANE Q{2} {3}{4}\nTCH PROBE 0.1 X{0:+.5f} Y{1:+.5f} "
        "Z{5:+.5f}\n",
        start.x() / unit, start.y() / unit, number, "XYZ"[axis], sense > 0 ? '+' : '-', start.z() / unit);
    const Ran ran = part.bench.run(text, inch ? "INCH" : "MM");
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(number) * unit, surface[axis], exact);
    // The spindle stands a ball radius in front of the surface, or a tool length above it; elsewhere as positioned.
    Vector3 spindle = start;
    spindle[axis] = axis == 2 ? surface.z() : surface[axis] - sense * ball;
    spindle.z() += length;
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(ran.q(115 + i) * unit, spindle[i], i == axis ? exact : 2e-4);
    // Back at the pre-position.
    const auto axes = ran.machine->position();
    const Vector3 tip = ran.seen(Vector3(axes[0], axes[1], axes[2] - length));
    EXPECT_NEAR((tip - start).norm(), 0, 4e-4);
    EXPECT_EQ(ran.touches(), 1U);
  }
}

TEST(Cycle1, TouchesInAnyDirectionOfThePlane) {
  Dice dice(1001);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 0.5, 0);
    const double length = part.bench.believedProbe().length, ball = part.bench.believedProbe().radius;
    // A bar stands where the probe looks: the ball's centre stops on a circle about it.
    const double radius = dice.between(5, 20), towards = written(dice.between(-180, 180));
    part.bench.part(simulation::RoundBar(radius, -40, 0), part.machineFromPart);
    const Vector3 direction(std::cos(radians(towards)), std::sin(radians(towards)), 0);
    Vector3 start = part.nominal - (radius + ball + 5) * direction;
    start = {written(start.x()), written(start.y()), part.nominal.z() - 10};
    const Ran ran = part.bench.run(fmt::format(
        "L X{0} Y{1} R0 FMAX\nTCH PROBE 1.0 POLAR\nTCH PROBE 1.1 X ANGLE: {2:+}\nTCH PROBE 1.2 X{0:+} Y{1:+} Z{3:+}\n",
        start.x(), start.y(), towards, start.z()));
    ASSERT_TRUE(ran.finished()) << ran.why();
    // Where the ray first meets the circle of the ball centres.
    const Vector2 away = (start - part.truth()).head<2>(), along = direction.head<2>();
    const double b = away.dot(along), c = away.squaredNorm() - (radius + ball) * (radius + ball);
    const double way = -b - std::sqrt(b * b - c);
    EXPECT_NEAR(ran.q(115), start.x() + way * along.x(), exact);
    EXPECT_NEAR(ran.q(116), start.y() + way * along.y(), exact);
    EXPECT_NEAR(ran.q(117), start.z() + length, exact);
  }
}

TEST(Cycle1, KnowsThreePlanes) {
  Bench bench;
  bench.preset(1, {0, 0, -400});
  bench.probeOf(100, 2);
  bench.part(simulation::HalfSpace(Plane{{0, 0, -400}, Vector3::UnitZ()}));
  // Z/X: 180 - 30 degrees from Z towards X goes down and to +X.
  const Ran down =
      bench.run("L X+0 Y+0 R0 FMAX\nTCH PROBE 1.0 P\nTCH PROBE 1.1 Z ANGLE: +150\nTCH PROBE 1.2 X+0 Y+7 Z+5\n");
  ASSERT_TRUE(down.finished()) << down.why();
  EXPECT_NEAR(down.q(115), 5 * std::tan(radians(30)), exact);
  EXPECT_NEAR(down.q(116), 7, exact);
  EXPECT_NEAR(down.q(117), 100, exact);
  // Y/Z: -60 degrees from Y towards Z goes down and to +Y.
  const Ran side =
      bench.run("L X+0 Y+0 R0 FMAX\nTCH PROBE 1.0 P\nTCH PROBE 1.1 Y ANGLE: -60\nTCH PROBE 1.2 X+3 Y+0 Z+5\n");
  ASSERT_TRUE(side.finished()) << side.why();
  EXPECT_NEAR(side.q(116), 5 / std::tan(radians(60)), exact);
}

TEST(Cycle0, NamesTheRotaryAxesToo) {
  Bench bench(ControlKind::TNC640, "mill5-table-table");
  bench.preset(1, {0, 0, -400});
  bench.setup.beliefs.presets.back().rotary["C"] = 10;
  bench.part(simulation::HalfSpace(Plane{{0, 0, -400}, Vector3::UnitZ()}));
  const Ran ran = bench.run("TCH PROBE 0.0 REF. PLANE Q7 Z-\nTCH PROBE 0.1 X+0 Y+0 Z+5 C+25\n");
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(ran.q(7), 0, exact);
  EXPECT_NEAR(ran.q(118), 0, exact);
  EXPECT_NEAR(ran.q(119), 25, exact);
  EXPECT_NEAR(ran.machine->position()[4], 35, exact);
}

}  // namespace
}  // namespace probewright::testing_support
