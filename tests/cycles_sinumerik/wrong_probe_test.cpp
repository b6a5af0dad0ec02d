#include "support/sinumerik_bench.hpp"

/// Probes and machines that are not as the control believes: results are wrong by what theory says.
namespace probewright {
namespace {

using namespace testing_support;

constexpr double table = -350;
constexpr int worlds = 20;

/// What the control does not know: the tip lies beside the spindle axis, its signal comes late.
struct Unknown {
  explicit Unknown(Planter& plant)
      : offset(plant.number(-0.2, 0.2), plant.number(-0.2, 0.2)), late(plant.number(0, 0.03)) {}
  simulation::Truth truth() const {
    simulation::Truth world = perfectWorld();
    world.tools[0].probe.tipOffset = offset;
    world.tools[0].probe.pretravel = late;
    return world;
  }
  Vector2 offset;
  double late;
};

TEST(WrongProbe, MovesAFaceByItsOffsetAndByTheLateSignal) {
  Planter plant(1);
  for (int world = 0; world < worlds; ++world) {
    const Unknown unknown(plant);
    simulation::Truth truth = unknown.truth();
    place(truth, simulation::Box({0, 0, -60}, {120, 100, 0}), translation({0, 0, table}));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    const int axis = world % 2;
    Vector3 start(20, 20, -10);
    start[axis] = -12;
    bench.start(start);
    bench.run("CYCLE978",
              {{"S_MVAR", 100}, {"S_KNUM", 1}, {"S_FA", 9}, {"S_TSA", 9}, {"S_MA", axis + 1.0}, {"S_MD", 1}});
    const double wrong = -unknown.offset[axis] + unknown.late;
    EXPECT_NEAR(bench.ovr(4), wrong, 1e-6) << world;
    EXPECT_NEAR(inWorkpiece(bench, {0, 0, table})[axis], -wrong, 1e-6) << "the zero offset is wrong by as much";
  }
}

TEST(WrongProbe, MovesCentresAndChangesSizes) {
  Planter plant(2);
  for (int world = 0; world < worlds; ++world) {
    const Unknown unknown(plant);
    // Hole, spigot, groove, rectangular pocket.
    const int feature = std::array{1, 2, 3, 5}[static_cast<std::size_t>(world % 4)];
    const bool inside = feature != 2;
    simulation::Truth truth = unknown.truth();
    const Pose part = translation({0, 0, table});
    if (feature == 1) place(truth, simulation::Ring(20, 300, -60), part);
    if (feature == 2) place(truth, simulation::RoundBar(20, -60, 0), part);
    if (feature >= 3) {
      place(truth, simulation::Box({20, -200, -60}, {200, 200, 0}), part, "plus X");
      place(truth, simulation::Box({-200, -200, -60}, {-20, 200, 0}), part, "minus X");
      place(truth, simulation::Box({-200, 30, -60}, {200, 200, 0}), part, "plus Y");
      place(truth, simulation::Box({-200, -200, -60}, {200, -30, 0}), part, "minus Y");
    }
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    bench.start({0, 0, inside ? -10.0 : 10.0});
    bench.run("CYCLE977", {{"S_MVAR", 100.0 + feature},
                           {"S_KNUM", 1},
                           {"S_SETV", 40},
                           {"S_SETV0", 40},
                           {"S_SETV1", 60},
                           {"S_FA", 4},
                           {"S_TSA", 4},
                           {"S_ID", inside ? 0.0 : -20.0},
                           {"S_MA", 1}});
    const double grown = inside ? 2 * unknown.late : -2 * unknown.late;
    EXPECT_NEAR(bench.ovr(4), 40 + grown, 1e-6) << feature;
    if (feature == 5) {
      EXPECT_NEAR(bench.ovr(5), 60 + grown, 1e-6);
    }
    const Vector3 found = inWorkpiece(bench, {0, 0, table});
    EXPECT_NEAR(found.x(), unknown.offset.x(), 1e-6) << feature;
    if (feature != 3) {
      EXPECT_NEAR(found.y(), unknown.offset.y(), 1e-6) << feature;
    }
  }
}

TEST(WrongProbe, MovesACornerButDoesNotTurnItsEdges) {
  Planter plant(3);
  for (int world = 0; world < worlds; ++world) {
    const Unknown unknown(plant);
    simulation::Truth truth = unknown.truth();
    place(truth, simulation::Box({0, 0, -60}, {200, 150, 0}), translation({0, 0, table}));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    bench.start({-15, -15, -10});
    bench.run("CYCLE961", {{"S_MVAR", 106},
                           {"S_KNUM", 1},
                           {"S_SETV0", 30},
                           {"S_SETV1", 80},
                           {"S_SETV2", 60},
                           {"S_SETV4", -15},
                           {"S_SETV5", -15},
                           {"S_FA", 20},
                           {"S_TSA", 5}});
    const Vector3 found = inWorkpiece(bench, {0, 0, table});
    EXPECT_NEAR(found.x(), unknown.offset.x() - unknown.late, 1e-6);
    EXPECT_NEAR(found.y(), unknown.offset.y() - unknown.late, 1e-6);
    EXPECT_NEAR(bench.ovr(4), 0, 1e-6);

    bench.start({20, -12, -10});
    bench.run("CYCLE998", {{"S_MVAR", 100005}, {"S_FA", 9}, {"S_TSA", 5}, {"S_MA", 102}, {"S_MD", 1}, {"S_ID", 100}});
    EXPECT_NEAR(bench.ovr(4), 0, 1e-6) << "both touches are wrong by the same";
  }
}

TEST(WrongMachine, ASkewedAxisTurnsAnEdgeAndAScaleErrorShrinksAHole) {
  Planter plant(4);
  for (int world = 0; world < worlds; ++world) {
    const double scale = plant.number(-5e-4, 5e-4), square = plant.number(-0.02, 0.02);
    simulation::Truth truth = perfectWorld();
    truth.errors.axes.resize(3);
    truth.errors.axes[0].scale = scale;
    place(truth, simulation::Ring(30, 300, -60), translation({0, 0, table}));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    bench.start({0, 0, -10});
    bench.run("CYCLE977", {{"S_MVAR", 5}, {"S_SETV0", 60}, {"S_SETV1", 60}, {"S_FA", 4}, {"S_TSA", 4}});
    // Between the touches the axis reads less than the ball's centre travels; the ball itself is as it was calibrated.
    EXPECT_NEAR(bench.ovr(4), (60 - 4) / (1 + scale) + 4, 1e-6);
    EXPECT_NEAR(bench.ovr(5), 60, 1e-6);

    simulation::Truth skewed = perfectWorld();
    skewed.errors.squareness.push_back({0, 1, square});
    place(skewed, simulation::Box({0, 0, -60}, {200, 150, 0}), translation({0, 0, table}));
    SinumerikBench edge(skewed);
    plantFrame(edge, "$P_UIFR", 1, {0, 0, table});
    edge.start({20, -12, -10});
    edge.run("CYCLE998", {{"S_MVAR", 100005}, {"S_FA", 9}, {"S_TSA", 5}, {"S_MA", 102}, {"S_MD", 1}, {"S_ID", 100}});
    // Travelling in +X the tool drifts towards +Y: it stands nearer at the second touch, which reads less.
    EXPECT_NEAR(edge.ovr(4), -square, 1e-6);
  }
}

TEST(WrongProbe, CalibratesAWrongRingIntoAWrongBall) {
  Planter plant(5);
  for (int world = 0; world < worlds; ++world) {
    const double ringError = plant.number(-0.05, 0.05), lengthError = plant.number(-0.05, 0.05);
    simulation::Truth truth = perfectWorld();
    place(truth, simulation::Ring(20, 60, -40), translation({0, 0, table}));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    bench.start({0, 0, -10});
    bench.run("CYCLE976", {{"S_MVAR", 1}, {"S_SETV", 40 + ringError}, {"S_FA", 8}, {"S_TSA", 3}});
    EXPECT_NEAR(bench.data("$SNS_MEA_WP_BALL_DIAM", {0}), 4 + ringError, 1e-6);
    bench.start({40, 0, 10});
    bench.run("CYCLE976",
              {{"S_MVAR", 1000000}, {"S_SETV", lengthError}, {"S_MA", 3}, {"S_MD", 1}, {"S_FA", 9}, {"S_TSA", 3}});
    EXPECT_NEAR(bench.data("$TC_DP3", {1, 1}), 100 - lengthError, 1e-6)
        << "a surface believed too high makes the probe too short";
  }
}

}  // namespace
}  // namespace probewright
