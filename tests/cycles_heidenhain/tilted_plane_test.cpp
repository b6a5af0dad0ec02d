#include "cycles_heidenhain/worlds.hpp"

/// Cycle 431 on a machine with a rotary table: the plane it has measured is tilted level, and measured again. Cycles
/// 400 to 402 in tilted planes of the iTNC 530, which does not forbid them.
namespace probewright::testing_support {
namespace {

TEST(Cycle431, MeasuresAnglesThatTiltThePlaneLevel) {
  Dice dice(4310);
  for (int world = 0; world < 100; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part{Bench(controlOf(world), "mill5-table-table")};
    const Vector3 origin(written(dice.between(-30, 30)), written(dice.between(-30, 30)), -400);
    part.bench.preset(1, origin);
    part.bench.believedProbe().maximumTravel = 30;
    const Pose plane = pose(Vector3(0, 0, dice.between(-3, 3)), {dice.between(-15, 15), dice.between(-15, 15), 0});
    part.bench.part(simulation::Box({-60, -60, -60}, {60, 60, 0}), pose(origin) * plane);
    const Vector3 n = plane.linear().col(2);
    const auto onPlane = [&](double x, double y) {
      const double z = plane.translation().z() - (n.x() * x + n.y() * y) / n.z();
      return Vector3(x, y, z);
    };
    const Vector3 p1 = onPlane(-20, written(dice.between(-25, -15))), p2 = onPlane(25, written(dice.between(-20, -10))),
                  p3 = onPlane(0, 20);
    const auto measure = [](const Vector3& a, const Vector3& b, const Vector3& c, double clearance) {
      return probe(431, {{263, a.x()},
                         {264, a.y()},
                         {294, a.z()},
                         {265, b.x()},
                         {266, b.y()},
                         {295, b.z()},
                         {296, c.x()},
                         {297, c.y()},
                         {298, c.z()},
                         {320, 1},
                         {260, clearance},
                         {281, 0}});
    };
    // The axes of the plane: X from the first to the second point, Z along the normal.
    Matrix3 axes;
    axes.col(0) = (p2 - p1).normalized();
    axes.col(2) = n;
    axes.col(1) = n.cross(axes.col(0));
    const auto level = [&](const Vector3& p) { return Vector3(axes.transpose() * p); };
    const Ran ran = part.bench.run(measure(p1, p2, p3, 60) + "L Z-1 R0 FMAX M91\n" +
                                   "PLANE SPATIAL SPA+Q170 SPB+Q171 SPC+Q172 TURN FMAX\n" + "L Z+100 R0 FMAX\n" +
                                   measure(level(p1), level(p2), level(p3), 60));
    ASSERT_TRUE(ran.finished()) << ran.why();
    ASSERT_EQ(ran.outcome.journal.cycles.size(), 2U);
    for (const int angle : {158, 159, 170, 171, 172})
      EXPECT_NEAR(ran.q(angle), 0, 1e-6) << angle;
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(ran.q(173 + i), level(p1).z(), 1e-6);
  }
}

/// The angle is that of the tilted plane; the basic rotation turns the workpiece system by it, in front of the tilt.
TEST(Cycles400To402, MeasureInTheTiltedPlaneOfTheITNC530) {
  Dice dice(4000);
  for (int world = 0; world < 30; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Bench bench(ControlKind::iTNC530, "mill5-head-table");
    const Vector3 origin(written(dice.between(-60, 60)), written(dice.between(-60, 60)), -500);
    bench.preset(1, origin, written(dice.between(-20, 20)));
    bench.believedProbe().maximumTravel = 40;
    // The basic rotation is reset before the measurement. A plane turned about the tool axis alone ends up aligned.
    const bool flat = world % 2 == 0;
    const Vector3 tilt = flat ? Vector3(0, 0, written(dice.between(-30, 30)))
                              : Vector3(written(dice.between(-25, 25)), written(dice.between(-25, 25)), 0);
    const Pose tilted = pose(Vector3::Zero(), tilt);
    const double skew = dice.between(-3, 3);
    const int cycle = 400 + world % 3;
    const Pose part = pose(origin) * tilted * pose(Vector3::Zero(), {0, 0, skew});
    Words words = {{261, -8}, {260, 30}, {307, 0}, {305, 1}};
    if (cycle == 400) {
      bench.part(simulation::Box({-50, -50, -30}, {50, 50, 0}), part);
      words = with(words, {{263, -30}, {264, -50}, {265, 30}, {266, -50}, {272, 2}, {267, 1}, {320, 4}, {301, 1}});
    } else {
      for (const double side : {-40.0, 40.0}) {
        if (cycle == 401) {
          bench.part(simulation::Ring(8, 14, -30), part * pose({side, 0, 0}));
        } else {
          bench.part(simulation::RoundBar(8, -30, 0), part * pose({side, 0, 0}));
        }
      }
      words = with(words, {{268, -40}, {269, 0}, {270, 40}, {271, 0}, {402, 0}, {337, 0}});
      if (cycle == 402) words = with(words, {{313, 16.5}, {314, 16.5}, {315, -8}, {320, 1}, {301, 1}});
    }
    // The tilt is defined without the basic rotation, which the cycle resets.
    const std::string plane = fmt::format(
        "TCH PROBE 404 SET ~\n  Q307=+0\nL Z+0 R0 FMAX M91\nPLANE SPATIAL SPA{:+.3f} SPB{:+.3f} SPC{:+.3f} "
        "TURN FMAX\n",
        tilt.x(), tilt.y(), tilt.z());
    const Ran ran = bench.run(plane + probe(cycle, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.cell("PRESET.PR", "1", "ROT"), skew, 6e-5);
    EXPECT_TRUE(ran.preset().isApprox(pose(origin, {0, 0, skew}), 1e-9));
    if (flat) {
      EXPECT_LT((ran.preset().linear() * tilted.linear() - part.linear()).norm(), 1e-9);
    }
  }
}

}  // namespace
}  // namespace probewright::testing_support
