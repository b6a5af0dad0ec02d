#include "simulation/link_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "simulation/true_kinematics.hpp"
#include "support/virtual_world.hpp"

/// How far points of a machine's parts may travel on a motion.
namespace probewright::simulation {
namespace {

/// A ball beside the axis that turns it: its farthest point runs on an arc, whatever carries the axis.
TEST(LongestWay, IsTheArcOfTheFarthestPoint) {
  const Truth truth = testing_support::perfectWorld("mill5-table-table");
  const machine::MachineDescription& machine = truth.machine;
  const TrueKinematics kinematics(machine, truth.errors);
  const std::size_t slide = *machine.axisIndex("X"), turn = *machine.axisIndex("C");
  using machine::ChainElement;
  const ChainElement alongX{slide, Vector3::UnitX(), Vector3::Zero()}, aboutZ{turn, Vector3::UnitZ(), {0, 0, 0}};
  const ChainElement outwards{{}, Vector3::UnitX(), {100, 0, 0}};
  machine::AxisPositions from, to;
  const auto way = [&](const std::vector<ChainElement>& chain) {
    const Motion motion{kinematics, from, to, from, 0, MotionProfile(500, 100, 1000)};
    return longestWay(chain, machine.axes, motion, Vector3::Zero(), 5);
  };
  to[turn] = 60;
  const double arc = std::numbers::pi / 3;
  EXPECT_NEAR(way({aboutZ}), arc * 5, 1e-9);
  EXPECT_NEAR(way({aboutZ, outwards}), arc * 105, 1e-9);
  EXPECT_NEAR(way({alongX, aboutZ, outwards}), arc * 105, 1e-9);
  from[slide] = to[slide] = 20;
  EXPECT_NEAR(way({aboutZ, alongX, outwards}), arc * 125, 1e-9) << "the slide stands 20 mm farther out";
  to[turn] = 0, to[slide] = -10;
  EXPECT_NEAR(way({aboutZ, alongX, outwards}), 30, 1e-9);
}

}  // namespace
}  // namespace probewright::simulation
