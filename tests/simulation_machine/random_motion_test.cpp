#include <gtest/gtest.h>

#include <random>

#include "support/virtual_world.hpp"

namespace probewright::simulation {
namespace {

using machine::AxisPositions;
using machine::Feed;
using machine::MeasureEnd;
using machine::MoveEnd;
using testing_support::perfectWorld;
using testing_support::place;

/// Straight moves of random axes past obstacles on the table of `machineName`, checked point by point with the
/// description's own kinematics: no move passes through material, and every contact is where the ball first meets it.
void moveAtRandom(const std::string& machineName, unsigned seed) {
  Truth truth = perfectWorld(machineName);
  truth.tools[0].probe.stylusRadius = 0;
  truth.tools[0].probe.bodyRadius = 0;
  const Box post({-30, -20, -700}, {25, 40, -430});
  const Pose pose = translation({20, -10, 0}) * rotation(Vector3::UnitZ(), 25) * rotation(Vector3::UnitX(), 4);
  place(truth, post, pose);
  const SolidSphere ball(Vector3(90, 60, -420), 35);
  place(truth, ball);
  const double radius = truth.tools[0].probe.ballRadius;
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto randomPosition = [&] {
    AxisPositions q;
    for (std::size_t i = 0; i < truth.machine.axes.size(); ++i) {
      const machine::Axis& axis = truth.machine.axes[i];
      q[i] = axis.kind == machine::AxisKind::Rotary ? uniform(-70, 70)
             : axis.name == "Z"                     ? uniform(-420, -250)
                                                    : uniform(-200, 200);
    }
    return q;
  };
  const auto gap = [&](const AxisPositions& q) {
    const Vector3 tip =
        baseFromTable(truth.machine, q).inverse() * (baseFromSpindle(truth.machine, q) * Vector3(0, 0, -98));
    return std::min(post.closest(pose.inverse() * tip).distance, ball.closest(tip).distance) - radius;
  };
  const auto between = [&](const AxisPositions& from, const AxisPositions& to, double f) {
    AxisPositions q;
    for (std::size_t i = 0; i < truth.machine.axes.size(); ++i)
      q[i] = from[i] + (to[i] - from[i]) * f;
    return q;
  };
  VirtualMachine machine(truth);
  ASSERT_EQ(machine.changeTool({1, ""}).end, machine::ToolChangeEnd::Changed);
  int touched = 0, reached = 0;
  for (int i = 0; i < 100; ++i) {
    const AxisPositions from = machine.position(), to = randomPosition();
    const auto result = machine.measure({to, Feed::at(6000)});
    const AxisPositions end = result.end == MeasureEnd::Touched ? result.latched : to;
    constexpr int samples = 400;
    for (int k = 0; k < samples; ++k) {
      ASSERT_GT(gap(between(from, end, double(k) / samples)), -2e-7) << machineName << " move " << i << " at " << k;
    }
    if (result.end == MeasureEnd::Touched) {
      ++touched;
      EXPECT_NEAR(gap(result.latched), 0, 2e-7) << machineName << " move " << i;
      ASSERT_EQ(machine.retract(from, Feed::at(6000)).end, MoveEnd::Reached) << "back the way it came";
      ASSERT_FALSE(machine.deflected(machine::Sensor::TouchProbe));
    } else {
      ASSERT_EQ(result.end, MeasureEnd::NoContact) << result.detail;
      ++reached;
    }
  }
  EXPECT_GT(touched, 10) << machineName;
  EXPECT_GT(reached, 10) << machineName;
}

TEST(RandomMotion, NeverPassesThroughMaterial) {
  unsigned seed = 1;
  for (const char* name : {"mill3", "mill5-table-table", "mill5-head-table", "mill5-head-head"}) {
    moveAtRandom(name, seed++);
  }
}

}  // namespace
}  // namespace probewright::simulation
