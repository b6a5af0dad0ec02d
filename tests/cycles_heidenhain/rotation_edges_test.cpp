#include "cycles_heidenhain/rotation_worlds.hpp"

/// Cycle 1410: the misalignment of an edge, and what all rotation cycles share.
namespace probewright::testing_support {
namespace {

TEST(Cycle1410, FindsTheMisalignmentOfAnyEdge) {
  Dice dice(1410);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 1, 8);
    const Edge edge = layEdge(dice, place);
    const int position = dice.whole(0, 3);
    const int rotation = dice.whole(0, 1);
    const Words words = with(with(edge.words(), common(dice, place)), {{1120, position}, {1121, rotation}});
    const Ran ran = place.bench.run(place.before + probe(1410, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    for (int i = 0; i < 2; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto& expected = edge.expected[static_cast<std::size_t>(i)];
        const auto& nominal = edge.nominal[static_cast<std::size_t>(i)];
        EXPECT_NEAR(ran.q(950 + 3 * i + axis), expected[axis], exact);
        EXPECT_NEAR(ran.q(980 + 3 * i + axis), expected[axis] - nominal[axis], exact);
      }
    }
    const Vector3 along = edge.nominal[1] - edge.nominal[0];
    EXPECT_NEAR(ran.q(994), place.skew, exact);
    EXPECT_NEAR(std::remainder(ran.q(964) - degrees(std::atan2(along.y(), along.x())) - place.skew, 360), 0, exact);
    EXPECT_EQ(ran.q(183), -1);
    if (position == 0) {
      const Matrix3 turned =
          place.machineFromInput.linear() * aboutZ(rotation * place.skew) * place.machineFromInput.linear().transpose();
      EXPECT_TRUE(ran.preset().linear().isApprox(turned * place.machineFromPreset.linear(), 1e-9));
      EXPECT_LT((ran.preset().translation() - place.machineFromPreset.translation()).norm(), exact);
      continue;
    }
    expectTransfer(ran, place, aboutZ(rotation * place.skew), chosen(position, edge.expected),
                   chosen(position, edge.nominal));
    EXPECT_NE(ran.log("TCHPRAUTO.html").find("<h2>1410 "), std::string::npos);
  }
}

TEST(Cycle1410, TurnsTheBasicRotationInATiltedPlane) {
  Dice dice(14102);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Bench bench(ControlKind::TNC640, "mill5-head-table");
    const Vector3 origin(written(dice.between(-60, 60)), written(dice.between(-60, 60)), -500);
    const double rotation = written(dice.between(-20, 20));
    bench.preset(1, origin, rotation);
    const double tilt = written(dice.between(-25, 25)), turn = written(dice.between(-25, 25));
    const Pose preset = pose(origin, {0, 0, rotation});
    // The table stands at 0 when the preset counts; the tilted plane goes with the workpiece.
    const Pose input = preset * pose(Vector3::Zero(), {turn, tilt, 0});
    const double skew = dice.between(-4, 4);
    const Pose part = input * pose(dice.within(1), {0, 0, skew});
    bench.believedProbe().maximumTravel = 40;
    bench.believedProbe().setUpClearance = 8;
    bench.part(simulation::Box({-50, -50, -30}, {50, 50, 0}), part);
    const Words words = with(Words{{1100, -30},
                                   {1101, -50},
                                   {1102, -8},
                                   {1103, 30},
                                   {1104, -50},
                                   {1105, -8},
                                   {372, 2},
                                   {320, 0},
                                   {260, 20},
                                   {1125, 1},
                                   {309, 0},
                                   {1126, 0},
                                   {1120, 0},
                                   {1121, 0}},
                             {{1120, 1}, {1121, 1}, {1125, 1}, {260, 30}});
    const std::string plane =
        fmt::format("L Z+0 R0 FMAX M91\nPLANE SPATIAL SPA{:+.3f} SPB{:+.3f} SPC+0 TURN FMAX\n", turn, tilt);
    const Ran ran = bench.run(plane + probe(1410, words) + probe(1410, with(words, {{1120, 0}, {1121, 0}})));
    ASSERT_TRUE(ran.finished()) << ran.why();
    // The second run finds the edge parallel; the axes of the tilted plane are now those of the part.
    EXPECT_NEAR(ran.q(994), 0, exact);
    const Matrix3 tilted = ran.preset().linear() * pose(Vector3::Zero(), {turn, tilt, 0}).linear();
    EXPECT_TRUE(tilted.isApprox(part.linear(), 1e-9));
    EXPECT_NEAR(ran.outcome.journal.cycles.front().results[14].value, skew, exact);
  }
}

TEST(Cycle1410, ComputesWithActualPositionsWithoutProbing) {
  Bench bench;
  bench.preset(1, {10, 20, -400}, 0);
  const std::string blocks =
      "Q1900 = -10.05\n"
      "TCH PROBE 1410 EDGE ~\n  QS1100= \"10+0.02@10.0123\" ;A ~\n  QS1101=\"50@50.0321\" ;B ~\n"
      "  QS1102= \"-10-0.2+0.02@Q1900\" ;C ~\n  QS1103=\"60@60\" ;D ~\n  QS1104=\"50@50.5321\" ;E ~\n"
      "  QS1105=\"-10@-10\" ;F ~\n  Q372=+2 ;DIR ~\n  Q320=+0 ~\n  Q260=+100 ~\n  Q1125=+2 ~\n  Q309=+1 ~\n"
      "  Q1126=+0 ~\n  Q1120=+1 ~\n  Q1121=+1\n";
  const Ran ran = bench.run(blocks);
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_EQ(ran.touches(), 0U);
  EXPECT_NEAR(ran.q(950), 10.0123, exact);
  EXPECT_NEAR(ran.q(980), 10.0123 - 10.01, exact);
  EXPECT_NEAR(ran.q(981), 0.0321, exact);
  EXPECT_NEAR(ran.q(982), -10.05 + 10.09, exact);
  EXPECT_EQ(ran.q(183), 0);
  const double angle = degrees(std::atan2(0.5, 60 - 10.0123));
  EXPECT_NEAR(ran.q(964), angle, exact);
  EXPECT_NEAR(ran.cell("PRESET.PR", "1", "SPC"), ran.q(994), 1e-4);
  EXPECT_LT((ran.seen({20.0123, 70.0321, -410.05}) - Vector3(10.01, 50, -10.09)).norm(), exact);
}

TEST(RotationCycles, TakeTheSameValuesInInch) {
  const auto run = [](const std::string& unit, double factor) {
    Bench bench;
    bench.preset(1, {0, 0, -400}, 0);
    bench.part(simulation::Box({-50, -50, -40}, {50, 50, 0}), pose({0.3, -0.2, -400}, {0, 0, 2}));
    const Words words = {{1100, -30 / factor},
                         {1102, -8 / factor},
                         {1103, 30 / factor},
                         {1105, -8 / factor},
                         {372, 2},
                         {320, 0},
                         {260, 30 / factor},
                         {1125, 1},
                         {309, 0},
                         {1126, 0},
                         {1120, 1},
                         {1121, 1}};
    return bench.run(probe(1410, words,
                           fmt::format(" ~\n QS1101=\"{0:.6f}+{1:.6f}\" ~\n QS1104=\"{0:.6f}+{1:.6f}\"", -50 / factor,
                                       5.08 / factor)),
                     unit);
  };
  const Ran metric = run("MM", 1);
  const Ran inch = run("INCH", 25.4);
  ASSERT_TRUE(metric.finished()) << metric.why();
  ASSERT_TRUE(inch.finished()) << inch.why();
  EXPECT_NEAR(metric.q(994), 2, exact);
  EXPECT_NEAR(inch.q(994), 2, 1e-5);
  EXPECT_NEAR(inch.q(981) * 25.4, metric.q(981), 1e-4);
  EXPECT_NEAR(inch.q(951) * 25.4, metric.q(951), 1e-4);
}

}  // namespace
}  // namespace probewright::testing_support
