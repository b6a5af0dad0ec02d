#include <algorithm>

#include "kinematics_sinumerik/scene.hpp"

/// CYCLE996 on random machines: axes in any direction, order and sense, off their middle, with planted errors of
/// position and orientation, two of them or one, in table and head.
namespace probewright {
namespace {

using namespace testing_support;

struct Chain {
  const char* name;
  const char* machine;
  std::array<const char*, 2> axes;
  std::array<bool, 2> inHead;
  Vector3 ball;
};
const std::array<Chain, 5> chains = {{{"TableTable", "mill5-table-table", {"A", "C"}, {false, false}, {110, 70, -520}},
                                      {"HeadTable", "mill5-head-table", {"B", "C"}, {true, false}, {130, 120, -620}},
                                      {"HeadHead", "mill5-head-head", {"C", "A"}, {true, true}, {60, -40, -850}},
                                      {"Table", "mill5-table-table", {"A", ""}, {false, false}, {110, 70, -520}},
                                      {"Head", "mill5-head-table", {"B", ""}, {true, false}, {130, 120, -620}}}};

machine::ChainElement& elementOf(machine::MachineDescription& machine, const char* axis) {
  const std::size_t wanted = *machine.axisIndex(axis);
  for (auto* chain : {&machine.tableChain, &machine.spindleChain})
    for (machine::ChainElement& element : *chain)
      if (element.axis == wanted) return element;
  throw std::logic_error(axis);
}

void removeLastAxis(machine::MachineDescription& machine) {
  const std::size_t last = machine.axes.size() - 1;
  for (auto* chain : {&machine.tableChain, &machine.spindleChain})
    std::erase_if(*chain, [&](const machine::ChainElement& element) { return element.axis == last; });
  machine.axes.pop_back();
}

/// Along X, Y or Z, between two of them, or anywhere; in either sense.
Vector3 anyDirection(Planter& plant) {
  Vector3 direction = Vector3::Zero();
  const double kind = plant.number(0, 3);
  const auto first = static_cast<Eigen::Index>(std::min(2.0, plant.number(0, 3)));
  if (kind < 2) direction[first] = 1;
  if (kind >= 1 && kind < 2) direction[(first + 1) % 3] = 1;
  if (kind >= 2)
    while (direction.norm() < 0.3)
      direction = plant.within(1);
  return (plant.number(-1, 1) < 0 ? -1 : 1) * direction.normalized();
}

/// How far a direction is from being parallel to another one.
double apart(const Vector3& a, const Vector3& b) { return a.cross(b).norm(); }

class RandomMachines : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Chains, RandomMachines, testing::Range(0, 5),
                         [](const auto& each) { return chains[static_cast<std::size_t>(each.param)].name; });

TEST_P(RandomMachines, ShowTheirAxesAndNothingASecondTime) {
  const Chain& chain = chains[static_cast<std::size_t>(GetParam())];
  Planter plant(static_cast<std::uint64_t>(99700 + GetParam()));
  const bool two = *chain.axes[1] != 0;
  double worstDirection = 0, worstPlace = 0, worstAgain = 0;
  for (int world = 0; world < 12; ++world) {
    SCOPED_TRACE(world);
    simulation::Truth truth = perfectWorld(chain.machine);
    if (!two) removeLastAxis(truth.machine);
    for (machine::Axis& axis : truth.machine.axes) {
      const double most = axis.kind == machine::AxisKind::Linear ? 5000 : 360;
      axis.minimum = -most;
      axis.maximum = most;
    }
    // The last axis of a head turns the tool about another line than its own; nor may two axes be parallel.
    std::array<Vector3, 2> directions;
    do {
      directions = {anyDirection(plant), anyDirection(plant)};
    } while ((two && apart(directions[0], directions[1]) < 0.5) ||
             (chain.inHead[two && chain.inHead[1] ? 1 : 0] &&
              apart(directions[two && chain.inHead[1] ? 1 : 0], Vector3::UnitZ()) < 0.6));
    Build build{chain.machine, chain.axes, {}, 0, chain.ball + plant.within(20)};
    if (chain.inHead[1]) build.secondStands = plant.number(25, 35);
    for (std::size_t i = 0; i < (two ? 2U : 1U); ++i) {
      machine::ChainElement& element = elementOf(truth.machine, chain.axes[i]);
      element.direction = directions[i];
      element.point += plant.within(40);
      build.positions[i] = {0, plant.number(50, 65), -plant.number(50, 65)};
      // The ball is far from the axis of a table.
      Vector3 arm = build.ball - element.point;
      arm -= directions[i] * directions[i].dot(arm);
      const Vector3 level = directions[i].cross(Vector3::UnitZ());
      if (!chain.inHead[i] && arm.norm() < 60)
        build.ball += 80 * (level.norm() < 0.1 ? Vector3::UnitX() : Vector3(level.normalized()));
    }
    plantAxisErrors(truth, plant);
    KinematicsScene scene(build, truth);
    scene.safeHeight = 600;
    Planter postures(static_cast<std::uint64_t>(world));
    EXPECT_GT(scene.errorOfDataSet(postures), 0.02);
    scene.measureAll(world % 2);
    scene.calculate();
    for (int axis = 0; axis < scene.axes(); ++axis)
      worstDirection = std::max(worstDirection, angleBetween(scene.found(7 + 3 * axis), scene.trueDirection(axis)));
    scene.enterDirections();
    worstPlace = std::max(worstPlace, scene.errorOfDataSet(postures));
    const std::string kind = scene.bench.control.data.text("$TC_CARR23", {1});
    EXPECT_EQ(kind, two && chain.inHead[0] != chain.inHead[1] ? "M" : chain.inHead[0] ? "T" : "P");
    // The chain of vectors is closed.
    if (kind == "M") {
      EXPECT_EQ(scene.datum(1), Vector3(-scene.datum(4)));
      EXPECT_EQ(scene.datum(18), Vector3(-scene.datum(15)));
    } else {
      EXPECT_LT((scene.datum(1) + scene.datum(4) + scene.datum(15) + scene.datum(18)).norm(), 1e-9);
    }

    const std::array before = {scene.datum(1), scene.datum(4), scene.datum(15), scene.datum(18)};
    scene.measureAll(1 - world % 2);
    scene.calculate({{"_AMODE", 11}, {"S_SETV4", 1e-6}, {"S_SETV5", 6e-7}});
    const std::array after = {scene.datum(1), scene.datum(4), scene.datum(15), scene.datum(18)};
    for (std::size_t i = 0; i < 4; ++i)
      worstAgain = std::max(worstAgain, (after[i] - before[i]).norm());
  }
  EXPECT_LT(worstDirection, 1e-8);
  EXPECT_LT(worstPlace, 1e-6);
  EXPECT_LT(worstAgain, 1e-6);
  RecordProperty("directionRadians", fmt::format("{:.2e}", worstDirection));
  RecordProperty("placeMillimetres", fmt::format("{:.2e}", worstPlace));
  RecordProperty("secondTimeMillimetres", fmt::format("{:.2e}", worstAgain));
}

}  // namespace
}  // namespace probewright
