#include "kinematics_sinumerik/scene.hpp"

/// One ball at one position: what a measuring call of CYCLE996 leaves, whatever is active when it comes.
namespace probewright {
namespace {

using namespace testing_support;

simulation::Truth planted(const Build& build, std::uint64_t seed) {
  Planter plant(seed);
  simulation::Truth truth = perfectWorld(build.machine);
  plantAxisErrors(truth, plant);
  return truth;
}

/// The readings of the axes with the ball of the probe (radius 2, length 100 to its pole) in the calibration ball, less
/// the way from there to the spindle nose.
Vector3 placeOf(const KinematicsScene& scene, double first, double second) {
  return scene.above(scene.turned(first, second), -KinematicsScene::ballRadius - 2) - Vector3(0, 0, 98);
}

TEST(BallPlaces, AreThoseOfTheMachine) {
  for (const Build* build : builds) {
    for (int way = 0; way < 3; ++way) {
      KinematicsScene scene(*build, planted(*build, 99620));
      plantFrame(scene.bench, "$P_UIFR", 1, {10, 20, -300}, {0.5, -1, 30});
      scene.measureAll(way);
      for (int axis = 0; axis < scene.axes(); ++axis) {
        const auto which = static_cast<std::size_t>(axis);
        for (int k = 0; k < 3; ++k) {
          const double angle = build->positions[which][static_cast<std::size_t>(k)];
          const Vector3 expected = axis == 0 ? placeOf(scene, angle, build->secondStands) : placeOf(scene, 0, angle);
          EXPECT_LT((scene.found(41 + 10 * axis + 3 * k) - expected).norm(), 1e-6) << build->machine << " way " << way;
          // An axis without end stops is shown from 0 to 360 degrees.
          const auto& machine = scene.trueMachine();
          const bool endless = machine.axes[*machine.axisIndex(build->axes[which])].modulo;
          EXPECT_NEAR(scene.bench.ovr(60 + 3 * axis + k), endless && angle < 0 ? angle + 360 : angle, 1e-9);
        }
      }
      EXPECT_EQ(scene.bench.ovr(40), scene.axes() == 2 ? 33 : 3);
      EXPECT_NEAR(scene.bench.ovr(66), 0.5, 1e-12);
      EXPECT_NEAR(scene.bench.ovr(67), -1, 1e-12);
      EXPECT_NEAR(scene.bench.ovr(68), 30, 1e-12);
      EXPECT_NEAR(scene.bench.ovr(71), 25, 1e-6);
      EXPECT_EQ(scene.bench.ovi(2), 996);
      EXPECT_EQ(scene.bench.ovi(8), 1);
      EXPECT_EQ(scene.bench.ovi(3), 10000 * scene.axes() + 100 * way + 3);
    }
  }
}

/// The vector to an axis of the table: the centre of the circle through three places, solved as a system of equations.
TEST(BallPlaces, GiveTheLinearVectorAfterTheThird) {
  KinematicsScene scene(tableTable, planted(tableTable, 99621));
  scene.measure(0);
  const Vector3 a = placeOf(scene, 0, 0), b = placeOf(scene, 50, 0), c = placeOf(scene, -50, 0);
  Matrix3 equations;
  equations << (b - a).transpose(), (c - a).transpose(), (b - a).cross(c - a).transpose();
  const Vector3 sides((b.squaredNorm() - a.squaredNorm()) / 2, (c.squaredNorm() - a.squaredNorm()) / 2,
                      (b - a).cross(c - a).dot(a));
  EXPECT_LT((scene.found(32) - equations.colPivHouseholderQr().solve(sides)).norm(), 1e-5);
}

TEST(BallPlaces, EndTheMeasuringPathAboveTheBall) {
  KinematicsScene scene(headTable, perfectWorld(headTable.machine));
  // From 1 mm above, as programs do that turn the axes about the ball.
  scene.bench.run("CYCLE996", scene.call(0, 0), {}, scene.approach(45, 0, 1));
  machine::AxisPositions rotary = scene.turned(45, 0);
  const Vector3 expected = scene.above(rotary, KinematicsScene::clearance);
  const machine::AxisPositions axes = scene.bench.control.channel.axes();
  EXPECT_LT((scene.trueTip(axes, {0, 0, 100}) - scene.trueTip(
                                                    [&] {
                                                      for (std::size_t i = 0; i < 3; ++i)
                                                        rotary[i] = expected[static_cast<Eigen::Index>(i)];
                                                      return rotary;
                                                    }(),
                                                    {0, 0, 100}))
                .norm(),
            1e-6);
}

/// TRAORI and swivelled planes do not count while a ball is measured, and are as before afterwards.
TEST(BallPlaces, DoNotDependOnTransformations) {
  for (const Build* build : {&tableTable, &headTable, &headHead}) {
    for (const std::string& active :
         {std::string("TRAORI\n"), std::string("CYCLE800(0,\"\",0,57,0,0,0,10,5,0,0,0,0,0)\n"),
          std::string("ROT Z25\n")}) {
      KinematicsScene scene(*build, planted(*build, 99622));
      const double first = build->positions[0][1], second = build->secondStands;
      scene.bench.run("CYCLE996", scene.call(0, 0), {}, scene.placeFor(0, 0));
      scene.bench.run("CYCLE996", scene.call(0, 1), {}, scene.approach(first, second) + active);
      EXPECT_LT((scene.found(44) - placeOf(scene, first, second)).norm(), 1e-6) << build->machine << ' ' << active;
      const control::sinumerik::Control& control = scene.bench.control;
      EXPECT_EQ(control.transformation, active.starts_with("TRAORI"));
      EXPECT_EQ(control.channel.following() == control::Following::Kinematics, !active.starts_with("ROT"));
      EXPECT_TRUE(control.channel.frame().isApprox(control.machineFromWorkpiece()));
    }
  }
}

TEST(BallPlaces, CountInTheUnitOfTheProgram) {
  KinematicsScene scene(headTable, planted(headTable, 99623));
  NamedNumbers call = scene.call(0, 0);
  for (auto& [name, value] : call)
    if (name == "S_SETV" || name == "S_FA" || name == "S_TSA") value /= 25.4;
  scene.bench.run("CYCLE996", call, {}, scene.placeFor(0, 0) + "G700\n");
  EXPECT_LT((25.4 * scene.found(41) - placeOf(scene, 0, 0)).norm(), 1e-6);
  EXPECT_NEAR(25.4 * scene.bench.ovr(71), 25, 1e-6);
}

/// A ball on a stem, seen from the side: round the equator and starting beside the stem the probe passes, along the
/// axes it meets the stem.
TEST(BallPlaces, AreFoundBesideTheStem) {
  Build raised = headTable;
  raised.ball.z() = -450;
  simulation::Truth truth = planted(raised, 99624);
  place(truth, simulation::RoundBar(5, -80, -11), translation(raised.ball), "stem", simulation::SolidRole::Fixture);
  KinematicsScene scene(raised, truth);
  // With B at 90 degrees the stem lies in plus of the tool's first axis.
  NamedNumbers call = with(scene.call(0, 0), {{"S_STA1", 45}});
  scene.bench.run("CYCLE996", call, {}, scene.approach(90, 0));
  EXPECT_LT((scene.found(41) - placeOf(scene, 90, 0)).norm(), 1e-6);
  EXPECT_FALSE(scene.bench.alarmOf("CYCLE996", scene.call(0, 0, 0)).empty());
}

/// The tip runs out by 0.1 mm and only one trigger point is known: aligned, the probe finds the ball all the same.
TEST(BallPlaces, AreExactWithAnAlignedProbe) {
  simulation::Truth truth = planted(headTable, 99625);
  truth.tools[0].probe.tipOffset = {0.1, 0};
  KinematicsScene scene(headTable, truth);
  scene.bench.set("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", {0}, 2.1);
  scene.bench.run("CYCLE996", scene.call(0, 0, 2), {}, scene.approach(-30, 0));
  // The pole is touched with the tip 0.1 beside it.
  const double low = 14.5 - std::sqrt(14.5 * 14.5 - 0.01);
  EXPECT_LT((scene.found(41) - placeOf(scene, -30, 0)).norm(), 2 * low + 1e-6);
}

/// A rotary table that is turned by hand: the control does not know where it stands, the call says it.
TEST(ManualAxis, IsMeasuredByTheAngleOfTheCall) {
  Planter plant(99626);
  KinematicsScene scene(oneAxis, planted(oneAxis, 99626));
  scene.bench.control.data.set("$TC_CARR35", {1}, std::string("HAND"));
  for (int i = 0; i < 3; ++i) {
    const double angle = oneAxis.positions[0][static_cast<std::size_t>(i)];
    scene.bench.run("CYCLE996", with(scene.call(0, i), {{"S_SETV0", angle}}), {}, scene.placeFor(0, i));
    EXPECT_EQ(scene.bench.ovr(60 + i), angle);
  }
  scene.calculate();
  scene.enterDirections();
  EXPECT_LT(scene.errorOfDataSet(plant), 1e-6);
}

/// A data set of which only the kind and the names are known.
TEST(NewDataSet, IsMeasuredFromNothing) {
  Planter plant(99627);
  KinematicsScene scene(tableTable, planted(tableTable, 99627));
  for (int i = 1; i <= 20; ++i)
    if (i != 13 && i != 14) scene.bench.set(fmt::format("$TC_CARR{}", i).c_str(), {1}, 0);
  scene.measureAll();
  scene.calculate();
  scene.enterDirections();
  EXPECT_LT(scene.errorOfDataSet(plant), 1e-6);
}

/// Programs may hand one measurement over to the other axis: the basic setting is the same for both.
TEST(BallPlaces, MayBeCopiedByThePrograms) {
  Planter plant(99628);
  KinematicsScene scene(tableTable, planted(tableTable, 99628));
  scene.measure(0);
  for (int i = 1; i < 3; ++i)
    scene.bench.run(
        "CYCLE996", scene.call(1, i), {},
        (i == 1 ? std::string("_OVR[51]=_OVR[41] _OVR[52]=_OVR[42] _OVR[53]=_OVR[43]\n_OVR[40]=_OVR[40]+10\n")
                : std::string()) +
            scene.placeFor(1, i));
  EXPECT_EQ(scene.bench.ovr(40), 33);
  scene.calculate();
  scene.enterDirections();
  EXPECT_LT(scene.errorOfDataSet(plant), 1e-6);
}

}  // namespace
}  // namespace probewright
