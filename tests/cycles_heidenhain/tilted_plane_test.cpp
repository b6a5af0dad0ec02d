#include "cycles_heidenhain/worlds.hpp"

/// Cycle 431 on a machine with a rotary table: the plane it has measured is tilted level, and measured again.
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

}  // namespace
}  // namespace probewright::testing_support
