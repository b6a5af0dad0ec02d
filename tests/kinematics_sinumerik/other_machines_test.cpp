#include "support/other_machines.hpp"
#include "kinematics_sinumerik/scene.hpp"

/// CYCLE996 on machines with other axes, orders and senses than the ready-made ones.
namespace probewright {
namespace {

using namespace testing_support;

std::vector<Build> measuredOf() {
  return {{"mill5-table-table", {"A", "C"}, {{{0, 50, -50}, {0, 120, -120}}}, 0, {110, 70, -520}},
          {"mill5-table-table", {"B", "C"}, {{{0, 50, -50}, {0, 120, -120}}}, 0, {80, 90, -520}},
          {"mill5-table-table", {"C", "A"}, {{{0, 120, -120}, {0, 50, -50}}}, 0, {110, 70, -520}},
          {"mill5-head-table", {"B", "C"}, {{{0, 45, -45}, {0, 90, 180}}}, 0, {130, 120, -620}},
          {"mill5-head-table", {"B", "A"}, {{{0, 45, -45}, {0, 40, -40}}}, 0, {100, 60, -600}}};
}

class OtherMachines : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Machines, OtherMachines, testing::Range(0, 5));

TEST_P(OtherMachines, ShowTheirPlantedAxesAndNothingASecondTime) {
  const OtherMachine other = otherMachines()[static_cast<std::size_t>(GetParam())];
  SCOPED_TRACE(other.name);
  const Build build = measuredOf()[static_cast<std::size_t>(GetParam())];
  Planter plant(static_cast<std::uint64_t>(99650 + GetParam()));
  simulation::Truth truth = perfectWorld(build.machine);
  other.change(truth.machine);
  plantAxisErrors(truth, plant);
  KinematicsScene scene(build, truth);
  EXPECT_GT(scene.errorOfDataSet(plant), 0.05);
  scene.measureAll();
  scene.calculate();
  for (int axis = 0; axis < scene.axes(); ++axis)
    EXPECT_LT(angleBetween(scene.found(7 + 3 * axis), scene.trueDirection(axis)), 1e-8) << "axis " << axis;
  scene.enterDirections();
  EXPECT_LT(scene.errorOfDataSet(plant), 1e-6);
  const std::array before = {scene.datum(1), scene.datum(4), scene.datum(15), scene.datum(18)};
  scene.measureAll(0);
  scene.calculate();
  const std::array after = {scene.datum(1), scene.datum(4), scene.datum(15), scene.datum(18)};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_LT((after[i] - before[i]).norm(), 1e-6) << "I" << i + 1;
}

}  // namespace
}  // namespace probewright
