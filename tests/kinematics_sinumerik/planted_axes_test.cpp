#include "kinematics_sinumerik/scene.hpp"

/// CYCLE996 finds where rotary axes truly lie, on machines of every build, and what it writes makes the control exact.
namespace probewright {
namespace {

using namespace testing_support;

class PlantedAxes : public testing::TestWithParam<int> {
protected:
  const Build& build() const { return *builds[static_cast<std::size_t>(GetParam())]; }
};
constexpr std::array names = {"TableTable", "HeadTable", "HeadHead", "OneAxis"};
INSTANTIATE_TEST_SUITE_P(Builds, PlantedAxes, testing::Range(0, 4),
                         [](const auto& each) { return names[static_cast<std::size_t>(each.param)]; });

TEST_P(PlantedAxes, AreFoundAndASecondMeasurementShowsNothing) {
  Planter plant(static_cast<std::uint64_t>(9960 + GetParam()));
  for (int world = 0; world < 4; ++world) {
    simulation::Truth truth = perfectWorld(build().machine);
    plantAxisErrors(truth, plant);
    KinematicsScene scene(build(), truth);
    EXPECT_GT(scene.errorOfDataSet(plant), 0.05);
    scene.measureAll(world % 2);
    scene.calculate();
    for (int axis = 0; axis < scene.axes(); ++axis)
      EXPECT_LT(angleBetween(scene.found(7 + 3 * axis), scene.trueDirection(axis)), 1e-8) << world << " axis " << axis;
    EXPECT_GT(scene.errorOfDataSet(plant), 1e-3) << "V1 and V2 stay as they are";
    scene.enterDirections();
    EXPECT_LT(scene.errorOfDataSet(plant), 1e-6) << world;

    const std::array before = {scene.datum(1), scene.datum(4), scene.datum(15), scene.datum(18)};
    scene.measureAll(1 - world % 2);
    scene.calculate();
    const std::array after = {scene.datum(1), scene.datum(4), scene.datum(15), scene.datum(18)};
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_LT((after[i] - before[i]).norm(), 1e-6) << world << " I" << i + 1;
    EXPECT_LT(angleBetween(scene.found(7), scene.datum(7)), 1e-8);
  }
}

/// Whatever the vectors are normalised to, the data set describes the same machine, and the vectors end where asked.
TEST_P(PlantedAxes, AreNormalisedToAnyCoordinate) {
  Planter plant(static_cast<std::uint64_t>(9970 + GetParam()));
  simulation::Truth truth = perfectWorld(build().machine);
  plantAxisErrors(truth, plant);
  KinematicsScene scene(build(), truth);
  scene.measureAll();
  // Along the coordinate that the axis mostly lies in: 1, 2, 3 for X, Y, Z.
  std::array<Eigen::Index, 2> along{};
  for (int axis = 0; axis < scene.axes(); ++axis)
    scene.trueDirection(axis).cwiseAbs().maxCoeff(&along[static_cast<std::size_t>(axis)]);
  for (int i = 0; i < 3; ++i) {
    const double first = plant.number(-200, 200), second = plant.number(-200, 200);
    const double variant = 1000 + 100'000.0 * static_cast<double>(along[0] + 1) +
                           (scene.axes() == 2 ? 1'000'000.0 * static_cast<double>(along[1] + 1) : 0);
    scene.calculate({{"S_MVAR", variant}, {"S_SETV2", first}, {"S_SETV3", second}});
    scene.enterDirections();
    EXPECT_LT(scene.errorOfDataSet(plant), 1e-6);
    const std::string kind = scene.bench.control.data.text("$TC_CARR23", {1});
    const bool two = scene.axes() == 2;
    const Vector3 toFirst = kind == "T" ? Vector3(scene.datum(4) + scene.datum(15)) : scene.datum(4);
    EXPECT_NEAR(toFirst[along[0]], first, 1e-9);
    if (!two) continue;
    const Vector3 toSecond = kind == "P" ? Vector3(scene.datum(4) + scene.datum(15)) : scene.datum(15);
    EXPECT_NEAR(toSecond[along[1]], second, 1e-9);
  }
}

/// A ball set up elsewhere, measured where the other axis does not stand in its basic setting.
TEST_P(PlantedAxes, AreFoundWithTheOtherAxisTurned) {
  Planter plant(static_cast<std::uint64_t>(9980 + GetParam()));
  simulation::Truth truth = perfectWorld(build().machine);
  plantAxisErrors(truth, plant);
  KinematicsScene scene(build(), truth);
  scene.measure(0);
  if (scene.axes() == 2) {
    const auto& positions = build().positions[1];
    for (int i = 0; i < 3; ++i)
      scene.bench.run("CYCLE996", scene.call(1, i), {}, scene.approach(20, positions[static_cast<std::size_t>(i)]));
  }
  scene.calculate();
  scene.enterDirections();
  EXPECT_LT(scene.errorOfDataSet(plant), 1e-6);
}

/// The program's own work: a ball that a swivelled plane shows beside its place is there after the correction.
class TiltingAxes : public PlantedAxes {};
INSTANTIATE_TEST_SUITE_P(Builds, TiltingAxes, testing::Range(0, 3),
                         [](const auto& each) { return names[static_cast<std::size_t>(each.param)]; });
TEST_P(TiltingAxes, MakeSwivelledPlanesExact) {
  Planter plant(static_cast<std::uint64_t>(9990 + GetParam()));
  simulation::Truth truth = perfectWorld(build().machine);
  plantAxisErrors(truth, plant);
  KinematicsScene scene(build(), truth);
  const Vector3 origin = build().ball;
  plantFrame(scene.bench, "$P_UIFR", 1, origin);
  // The ball's own place in the workpiece system is the origin, in every plane.
  const auto error = [&] {
    double worst = 0;
    for (const auto& [a, b] : {std::pair(25.0, 10.0), std::pair(-15.0, 20.0)}) {
      scene.bench.run(
          "CYCLE997", {{"S_MVAR", 101009}, {"S_SETV", 25}, {"S_FA", 5}, {"S_TSA", 3}, {"S_INCA", 90}}, {},
          fmt::format("SUPA G0 Z-100\nCYCLE800(0,\"\",0,57,0,0,0,{},{},0,0,0,0,-1)\nG0 X0 Y0\nG0 Z20\n", a, b));
      worst = std::max(worst, scene.found(5).norm());
      scene.bench.run("CYCLE996", {{"S_MVAR", 0}, {"S_TC", 1}}, {}, "SUPA G0 Z-100\nCYCLE800()\n");
    }
    return worst;
  };
  scene.measureAll();
  EXPECT_GT(error(), 0.05);
  scene.calculate();
  scene.enterDirections();
  EXPECT_LT(error(), 2e-6);
}

}  // namespace
}  // namespace probewright
