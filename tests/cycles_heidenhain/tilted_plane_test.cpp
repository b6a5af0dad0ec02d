#include "cycles_heidenhain/worlds.hpp"
#include "machine/description.hpp"

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
    for (int i = 0; i < (part.bench.control == ControlKind::TNC640 ? 3 : 1); ++i)
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

TEST(Tcpm, TouchProbeCyclesPlaceTheTip) {
  Bench bench(ControlKind::TNC640, "mill5-table-table");
  bench.preset(1, {0, 0, -400});
  bench.believedProbe().maximumTravel = 40;
  bench.part(simulation::HalfSpace({Vector3(0, 0, -398.75), Vector3(0, 0, 1)}));
  const std::string face = probe(427, {{263, 10},
                                       {264, 0},
                                       {261, 0},
                                       {320, 0},
                                       {272, 3},
                                       {267, -1},
                                       {260, 30},
                                       {281, 0},
                                       {288, 9},
                                       {289, -9},
                                       {309, 0},
                                       {330, 0}});
  for (const char* point : {"TIP-TIP", "TIP-CENTER", "CENTER-CENTER"}) {
    SCOPED_TRACE(point);
    const auto ran =
        bench.run(fmt::format("FN 17: SYSWRITE ID50 NR3 IDX1 = +2\nL Z+50 R0 FMAX\n"
                              "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS REFPNT {}\n{}L X+0 Y+0 R0 FMAX\n"
                              "L Z+20 R0 FMAX\nFN 18: SYSREAD Q40 = ID240 NR1 IDX3\n",
                              point, face));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(160), 1.25, 1e-6);
    EXPECT_NEAR(ran.q(40), -400 + 20 + 100 - (std::string(point) == "CENTER-CENTER" ? 2 : 0), 1e-6);
  }
}

/// In the tilted plane of the iTNC 530 the angle is that of the plane. The C axis turns by it about the machine's Z,
/// which aligns a plane that is turned about the tool axis alone.
TEST(Cycle405, MeasuresInAnyTiltedPlaneOfTheITNC530) {
  Dice dice(4053);
  for (int at = 0; at < 40; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Bench bench(ControlKind::iTNC530, "mill5-head-table");
    const Vector3 origin(0, 0, -500);
    bench.preset(1, origin);
    bench.believedProbe().maximumTravel = 40;
    const bool flat = at % 2 == 0;
    const Vector3 tilt =
        flat ? Vector3(0, 0, written(dice.between(-60, 60)))
             : Vector3(written(dice.between(-25, 25)), written(dice.between(-25, 25)), written(dice.between(-60, 60)));
    const Pose tilted = pose(Vector3::Zero(), tilt);
    const double off = dice.between(-4, 4), far = dice.between(50, 70);
    // Aligned to the positive Y axis of the plane, or to a nominal place.
    const bool toAxis = dice.coin();
    const double nominal = toAxis ? 90 : written(dice.between(40, 140));
    const Vector3 drawn =
        toAxis ? Vector3(0, 0, 0)
               : Vector3(written(far * std::cos(radians(nominal))), written(far * std::sin(radians(nominal))), 0);
    const double target = toAxis ? 90 : degrees(std::atan2(drawn.y(), drawn.x()));
    // With a nominal minor coordinate of 0 the hole itself must lie where the cycle looks for it.
    const Vector3 centre = toAxis ? Vector3(dice.between(30, 40), dice.between(-0.5, 0.5), 0)
                                  : Vector3(drawn + Vector3(-drawn.y(), drawn.x(), 0) * radians(off / 4));
    const double q321 = toAxis ? written(centre.x()) : drawn.x();
    bench.part(simulation::Ring(16, 24, -30), pose(origin) * tilted * pose(centre));
    const std::string plane = fmt::format(
        "L Z+0 R0 FMAX M91\nPLANE SPATIAL SPA{:+.3f} SPB{:+.3f} SPC{:+.3f} TURN FMAX\n", tilt.x(), tilt.y(), tilt.z());
    const Words words = {{321, q321}, {322, drawn.y()}, {262, 24}, {325, 0}, {247, 90},
                         {261, -8},   {320, 0},         {260, 30}, {301, 0}, {337, 0}};
    const Ran ran = bench.run(plane + "FN 18: SYSREAD Q40 = ID240 NR1 IDX6\n" + probe(405, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const double measured = degrees(std::atan2(centre.y(), centre.x())) - target;
    EXPECT_NEAR(std::remainder(ran.q(150) - measured, 360), 0, 1e-6);
    machine::AxisPositions before = ran.machine->position();
    before[*bench.setup.world.truth.machine.axisIndex("C")] = ran.q(40);
    const Matrix3 turn = machine::baseFromTable(bench.setup.world.truth.machine, ran.machine->position()).linear() *
                         machine::baseFromTable(bench.setup.world.truth.machine, before).linear().transpose();
    EXPECT_LT((turn - pose(Vector3::Zero(), {0, 0, -measured}).linear()).norm(), 1e-8);
    if (!flat || toAxis) continue;
    const Ran again = bench.run(plane + probe(405, words) + probe(405, words));
    ASSERT_TRUE(again.finished()) << again.why();
    EXPECT_NEAR(again.q(150), 0, 1e-6);
  }
  // A trunnion that has tilted takes C along: it turns about no axis of the plane any more.
  Bench trunnion(ControlKind::iTNC530, "mill5-table-table");
  trunnion.preset(1, {0, 0, -500});
  trunnion.believedProbe().maximumTravel = 40;
  trunnion.part(simulation::Ring(16, 24, -30), pose({0, 0, -500}, {20, 0, 0}) * pose({0, 40, 0}));
  const Ran refused = trunnion.run(
      "L Z+0 R0 FMAX M91\nPLANE SPATIAL SPA+20 SPB+0 SPC+0 TURN FMAX\n" +
      probe(405,
            {{321, 0}, {322, 40}, {262, 24}, {325, 0}, {247, 90}, {261, -8}, {320, 0}, {260, 30}, {301, 0}, {337, 0}}));
  EXPECT_EQ(refused.alarm(), "Rotary axis not available") << refused.why();
}

}  // namespace
}  // namespace probewright::testing_support
