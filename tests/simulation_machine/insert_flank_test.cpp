#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "simulation/virtual_machine.hpp"
#include "support/virtual_world.hpp"

/// An insert with a thickness: its flank may touch before its edge does.
namespace probewright::simulation {
namespace {

using machine::Feed;
using machine::MeasureEnd;
using machine::Sensor;
using testing_support::placeToolProbe;
using testing_support::positions;

constexpr double discRadius = 20;

/// A turning tool that stands upright, its insert in the plane of X and Z: one edge faces +X, the other one -Z.
TrueTool turningTool(double thickness, double clearance) {
  TrueTool tool;
  tool.number = 2;
  tool.kind = ToolKind::Cutter;
  tool.length = 80;
  tool.radius = 4;
  TrueInsert insert;
  insert.firstNormal = 0;
  insert.secondNormal = -90;
  insert.edgeLength = 6;
  insert.thickness = thickness;
  insert.clearance = clearance;
  tool.cutter.insert = insert;
  return tool;
}

template <class Contact>
VirtualMachine world(const TrueTool& tool, const Contact& contact, const Pose& pose) {
  Truth truth = testing_support::perfectWorld();
  truth.tools.push_back(tool);
  placeToolProbe(truth, contact, pose);
  VirtualMachine machine(std::move(truth));
  EXPECT_EQ(machine.changeTool({2, ""}).end, machine::ToolChangeEnd::Changed);
  return machine;
}

/// How far from the axis of the disc the tip stands when the insert touches its side, the tip `y` beside that axis:
/// the farthest that a point of the flank, `d` across and d * tan(clearance) back, allows. The derivative of
/// sqrt(R^2 - (y + d)^2) - d * tan(clearance) vanishes where y + d = -R * sin(clearance).
double touchingDistance(double y, double thickness, double clearance) {
  const double slope = std::tan(radiansFromDegrees(clearance));
  const double best = -discRadius * std::sin(radiansFromDegrees(clearance)) - y;
  const double d = std::clamp(best, 0.0, thickness);
  return std::sqrt(discRadius * discRadius - (y + d) * (y + d)) - d * slope;
}

TEST(InsertFlank, TouchesTheSideOfADiscWhereTheTangentSays) {
  std::mt19937_64 engine(1310);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  int byEdge = 0, byFlank = 0, byEnd = 0;
  for (int at = 0; at < 40; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    const double clearance = between(0, 9), thickness = between(1, 4), y = between(-8, 4);
    // Towards -Y: the same mirrored.
    const bool mirrored = at % 2 == 1;
    VirtualMachine machine = world(turningTool(mirrored ? -thickness : thickness, clearance),
                                   RoundBar(discRadius, -10, 0), translation({0, 0, -400}));
    const double across = mirrored ? -y : y, z = -405 + 80;
    EXPECT_EQ(machine.move(positions({-60, across, -200}), Feed::rapidTraverse()).end, machine::MoveEnd::Reached);
    EXPECT_EQ(machine.move(positions({-60, across, z}), Feed::rapidTraverse()).end, machine::MoveEnd::Reached);
    const auto touched = machine.measure({positions({-5, across, z}), Feed::at(300), Sensor::ToolTouchProbe});
    ASSERT_EQ(touched.end, MeasureEnd::Touched) << touched.detail;
    EXPECT_NEAR(touched.latched[0], -touchingDistance(y, thickness, clearance), 1e-6);
    const double best = -discRadius * std::sin(radiansFromDegrees(clearance)) - y;
    ++(best <= 0 ? byEdge : best < thickness ? byFlank : byEnd);
  }
  EXPECT_GT(byEdge, 3);
  EXPECT_GT(byFlank, 3);
  EXPECT_GT(byEnd, 3);
}

/// A top that falls towards +Y by more than the clearance meets the far end of the flank first.
TEST(InsertFlank, TouchesATiltedTopBeforeTheEdgeIfItsClearanceIsLess) {
  constexpr double thickness = 3;
  for (const double clearance : {0.0, 2.0, 5.0, 7.0}) {
    for (const double tilt : {-4.0, 1.0, 3.0, 6.0}) {
      SCOPED_TRACE(fmt::format("clearance {}, tilt {}", clearance, tilt));
      VirtualMachine machine = world(turningTool(thickness, clearance), Box({-30, -30, -12}, {30, 30, 0}),
                                     translation({0, 0, -400}) * rotation(Vector3::UnitX(), tilt));
      constexpr double y = 1.5;
      machine.move(positions({0, y, -300}), Feed::rapidTraverse());
      const auto touched = machine.measure({positions({0, y, -335}), Feed::at(300), Sensor::ToolTouchProbe});
      ASSERT_EQ(touched.end, MeasureEnd::Touched) << touched.detail;
      // The top is -400 + y * tan(tilt); a point d across is d * tan(clearance) higher than the edge.
      const double rise = std::tan(radiansFromDegrees(tilt)), slope = std::tan(radiansFromDegrees(clearance));
      const double d = rise > slope ? thickness : 0;
      EXPECT_NEAR(touched.latched[2], -400 + 80 + (y + d) * rise - d * slope, 1e-6);
    }
  }
}

TEST(InsertFlank, EndsWhereTheNoseHasNoRadiusLeft) {
  EXPECT_DOUBLE_EQ(flankDepth({.noseRadius = 0.8, .thickness = 4, .clearance = 7}), 4);
  EXPECT_DOUBLE_EQ(flankDepth({.noseRadius = 0.8, .thickness = -4, .clearance = 7}), 4);
  EXPECT_NEAR(flankDepth({.noseRadius = 0.4, .wear = 0.1, .thickness = 4, .clearance = 45}), 0.3, 1e-12);
  EXPECT_EQ(flankDepth({.thickness = 0}), 0);
}

}  // namespace
}  // namespace probewright::simulation
