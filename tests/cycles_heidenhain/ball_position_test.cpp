#include "cycles_heidenhain/worlds.hpp"
#include "session/heidenhain/beliefs.hpp"

/// A straight stylus whose ball is known to stand beside the spindle axis: the ball goes to the programmed point.
namespace probewright::testing_support {
namespace {

// The tables of the controls keep four decimals of the offset.
constexpr double exact = 1e-4;

/// The ball stands at `tip` while the spindle is at 0; the control knows it for the spindle at `calibrated`.
Bench offsetBench(ControlKind kind, const Vector2& tip, double calibrated, bool track) {
  Bench bench(kind);
  bench.preset(1, {5, -8, -400}, 20);
  bench.believedProbe().maximumTravel = 30;
  bench.trueProbe().tipOffset = tip;
  bench.believedProbe().tipOffset = Eigen::Rotation2Dd(radians(calibrated)) * tip;
  bench.believedProbe().calibrationAngle = calibrated;
  bench.believedProbe().orient = track;
  return bench;
}

const Pose lying = pose({5, -8, -400}, {0, 0, 20});

TEST(BallPosition, OfCycle444IsOnTheNormal) {
  Dice dice(4440);
  for (int at = 0; at < 40; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    const Vector2 tip(dice.between(-0.4, 0.4), dice.between(-0.4, 0.4));
    Bench bench = offsetBench(ControlKind::TNC640, tip, written(dice.between(-180, 180)), dice.coin());
    bench.part(simulation::SolidSphere({0, 0, 0}, 10), lying);
    const Vector3 normal = Vector3(dice.between(-1, 1), dice.between(-1, 1), dice.between(0.3, 1)).normalized();
    const Vector3 nominal = 10 * normal;
    const Ran ran = bench.run(probe(444,
                                    {{263, nominal.x()},
                                     {264, nominal.y()},
                                     {294, nominal.z()},
                                     {581, normal.x()},
                                     {582, normal.y()},
                                     {583, normal.z()},
                                     {320, 0},
                                     {260, 40},
                                     {309, 0}},
                                    " ~\n  QS400=\" \" ;TOLERANCE"));
    ASSERT_TRUE(ran.finished()) << ran.why();
    for (int result = 161; result <= 164; ++result)
      EXPECT_NEAR(ran.q(result), 0, exact) << result;
  }
}

TEST(BallPosition, OfCycle1410IsAtTheNominalPosition) {
  Dice dice(14100);
  for (int at = 0; at < 20; ++at) {
    const Vector2 tip(dice.between(-0.4, 0.4), dice.between(-0.4, 0.4));
    Bench bench = offsetBench(ControlKind::TNC640, tip, written(dice.between(-180, 180)), dice.coin());
    bench.part(simulation::Box({-50, -30, -40}, {50, 30, 0}), lying);
    const Ran ran = bench.run(probe(1410, {{1100, -20},
                                           {1101, -30},
                                           {1102, -8},
                                           {1103, 25},
                                           {1104, -30},
                                           {1105, -8},
                                           {372, 2},
                                           {320, 0},
                                           {260, 40},
                                           {1125, 1},
                                           {309, 0},
                                           {1126, 0},
                                           {1120, 0},
                                           {1121, 0}}));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(950), -20, exact);
    EXPECT_NEAR(ran.q(953), 25, exact);
    EXPECT_NEAR(ran.q(951), -30, exact);
    EXPECT_NEAR(ran.q(980), 0, exact);
  }
}

/// A round part whose centre is where the program has it is met head-on: no touch lies beside its radius.
TEST(BallPosition, OfCirclesIsOnTheRadius) {
  Dice dice(4210);
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    for (const int heightBetween : {0, 1}) {
      const Vector2 tip(dice.between(-0.4, 0.4), dice.between(-0.4, 0.4));
      Bench bench = offsetBench(kind, tip, 0, dice.coin());
      bench.part(simulation::Ring(20, 35, -40), lying);
      const Ran ran = bench.run(probe(421, {{273, 0},
                                            {274, 0},
                                            {262, 39},
                                            {325, 15},
                                            {247, 90},
                                            {261, -8},
                                            {320, 0},
                                            {260, 20},
                                            {301, heightBetween},
                                            {275, 0},
                                            {276, 0},
                                            {279, 0},
                                            {280, 0},
                                            {281, 0},
                                            {309, 0},
                                            {330, 0}}));
      ASSERT_TRUE(ran.finished()) << ran.why();
      const double radius = 20 - bench.believedProbe().radius;
      int at = 0;
      for (const auto& touch : ran.cycle().touches) {
        const double angle = radians(15 + 90 * at++);
        EXPECT_LT((touch.ballCentre.head<2>() - radius * Vector2(std::cos(angle), std::sin(angle))).norm(), exact);
      }
      EXPECT_EQ(at, 4);
    }
  }
}

/// CAL_ANG without a word on the offset: the control has the true one, as it stands at that angle.
TEST(BallPosition, IsTrueWhereTheSetupNamesNoBelief) {
  for (const double angle : {0.0, 90.0, -45.0}) {
    const std::string text = fmt::format(
        "[control]\ntype = \"TNC640\"\n[[tool]]\nnumber = 1\nname = \"P\"\nkind = \"probe\"\n"
        "length = 150\nball_radius = 3\ntip_offset = [0.3, -0.2]\ncalibration_angle = {}\nmaximum_travel = 30\n"
        "[[preset]]\nrow = 1\norigin = [0, 0, -400]\nactive = true\n",
        angle);
    Diagnostics diagnostics;
    const auto setup = setup::parseSetup(text, "s.toml", diagnostics);
    ASSERT_TRUE(setup) << (diagnostics.empty() ? "" : format(diagnostics.front()));
    const auto tables = session::heidenhain::heidenhainTables(setup->beliefs, ControlKind::TNC640, diagnostics);
    // Turned to CAL_ANG, the ball that stands at (0.3, -0.2) of the spindle stands there in the machine's axes.
    const Vector2 there = Eigen::Rotation2Dd(radians(angle)) * Vector2(0.3, -0.2);
    EXPECT_NEAR(tables.probes.numberOr("1", "CAL_OF1", 99), there.x(), 5e-5);
    EXPECT_NEAR(tables.probes.numberOr("1", "CAL_OF2", 99), there.y(), 5e-5);
    const auto parameters = session::heidenhain::machineParameters(setup->beliefs, ControlKind::iTNC530, diagnostics);
    EXPECT_NEAR(parameters.calibratedOffset1, there.x(), exact);
    EXPECT_NEAR(parameters.calibratedOffset2, there.y(), exact);
  }
}

}  // namespace
}  // namespace probewright::testing_support
