#include "kinematics_sinumerik/scene.hpp"

/// Play of rotary axes and CYCLE996: three balls lie on the circle of the axis wherever its play leaves them, and an
/// axis that stands meanwhile carries the other one as its play lets it.
namespace probewright {
namespace {

using namespace testing_support;

void plantBacklash(simulation::Truth& truth, const char* axis, double play) {
  truth.errors.axes.resize(truth.machine.axes.size());
  if (*axis != 0) truth.errors.axes[*truth.machine.axisIndex(axis)].backlash = play;
}

class BacklashOfBoth : public testing::TestWithParam<int> {};
constexpr std::array names = {"TableTable", "HeadTable", "HeadHead", "OneAxis"};
INSTANTIATE_TEST_SUITE_P(Builds, BacklashOfBoth, testing::Range(0, 4),
                         [](const auto& each) { return names[static_cast<std::size_t>(each.param)]; });

/// A program that reaches each position in +: a data set that is right stays right.
TEST_P(BacklashOfBoth, LeavesTheVectorsWhereEachPositionIsReachedInPlus) {
  const Build& build = *builds[static_cast<std::size_t>(GetParam())];
  Planter plant(static_cast<std::uint64_t>(9980 + GetParam()));
  simulation::Truth truth = perfectWorld(build.machine);
  for (const char* axis : build.axes)
    plantBacklash(truth, axis, plant.number(0.002, 0.02));
  KinematicsScene scene(build, truth);
  EXPECT_LT(scene.errorOfDataSet(plant), 1e-6);
  constexpr double below = 2;
  for (int axis = 0; axis < scene.axes(); ++axis) {
    for (int measurement = 0; measurement < 3; ++measurement) {
      const double angle = build.positions[static_cast<std::size_t>(axis)][static_cast<std::size_t>(measurement)];
      const double first = axis == 0 ? angle : 0, second = axis == 0 ? build.secondStands : angle;
      scene.bench.run("CYCLE996", scene.call(axis, measurement), {},
                      scene.approach(first - below, second - below) + scene.approach(first, second));
    }
  }
  scene.calculate();
  EXPECT_LT(scene.errorOfDataSet(plant), 1e-6);
  for (int axis = 0; axis < scene.axes(); ++axis)
    EXPECT_LT(angleBetween(scene.found(7 + 3 * axis), scene.trueDirection(axis)), 1e-8);
}

/// C of a table on a table, measured while A stands where it was reached in -: the found C leans by the play of A.
TEST(BacklashOfTheCarrier, LeansTheCarriedAxis) {
  constexpr double play = 0.015;
  for (const double from : {-5.0, 5.0}) {
    simulation::Truth truth = perfectWorld(tableTable.machine);
    plantBacklash(truth, "A", play);
    KinematicsScene scene(tableTable, truth);
    scene.measure(0);
    for (int measurement = 0; measurement < 3; ++measurement) {
      const double angle = tableTable.positions[1][static_cast<std::size_t>(measurement)];
      scene.bench.run("CYCLE996", scene.call(1, measurement), {},
                      scene.approach(from, angle) + scene.approach(0, angle));
    }
    scene.calculate();
    EXPECT_NEAR(angleBetween(scene.found(10), scene.trueDirection(1)), from > 0 ? radiansFromDegrees(play) : 0, 1e-8);
  }
}

}  // namespace
}  // namespace probewright
