#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "simulation/virtual_machine.hpp"
#include "support/virtual_world.hpp"

/// Where cutters with teeth first touch a tool touch probe, against points of the edges that are stepped through time.
namespace probewright::simulation {
namespace {

using machine::Feed;
using machine::MeasureEnd;
using machine::Rotation;
using machine::Sensor;
using testing_support::placeToolProbe;
using testing_support::positions;

constexpr double fullTurn = 2 * std::numbers::pi;
constexpr double discRadius = 20, discThickness = 10;

class Dice {
public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }

private:
  std::mt19937_64 engine_;
};

TrueTool randomMill(double radius, int teeth, Dice& dice) {
  TrueTool tool;
  tool.number = 2;
  tool.kind = ToolKind::Cutter;
  tool.length = 80;
  tool.radius = radius;
  tool.cutter.cutLength = 25;
  tool.cutter.shankRadius = 0.8 * radius;
  const double first = dice.between(-180, 180);
  for (int i = 0; i < teeth; ++i) {
    TrueTooth tooth;
    tooth.angle = first + 360.0 * i / teeth + dice.between(-5, 5);
    tooth.radial = dice.between(-0.03, 0.03);
    tooth.axial = dice.between(-0.02, 0.02);
    tool.cutter.teeth.push_back(tooth);
  }
  return tool;
}

/// A machine with a tool touch probe at X0 Y0 Z-400 of the table, the tool in the spindle at the tool change position.
struct World {
  explicit World(TrueTool tool) : cutter(tool) {
    Truth truth = testing_support::perfectWorld();
    truth.tools.push_back(std::move(tool));
    placeToolProbe(truth, RoundBar(discRadius, -discThickness, 0), translation({0, 0, -400}));
    machine = std::make_unique<VirtualMachine>(std::move(truth));
    EXPECT_EQ(machine->changeTool({2, ""}).end, machine::ToolChangeEnd::Changed);
  }

  /// To axis positions, without hurry for what is in the way.
  void to(double x, double y, double z) {
    const auto moved = machine->move(positions({x, y, z}), Feed::rapidTraverse());
    EXPECT_EQ(moved.end, machine::MoveEnd::Reached) << moved.detail;
  }

  TrueTool cutter;
  std::unique_ptr<VirtualMachine> machine;
};

/// Where the axis of the tool is, the spindle turned by `turned` radians, seen from the spindle's.
Vector2 axisAside(const TrueTool& tool, double turned) { return Eigen::Rotation2Dd(turned) * tool.cutter.eccentricity; }

/// How far the flank of a tooth is from the axis of the disc, from its end up to `height`: nearest where it winds
/// towards that axis, or at one of its ends. `axis`: of the tool, seen from the disc's.
double flankDistance(const TrueTool& tool, const TrueTooth& tooth, double height, const Vector2& axis, double turned) {
  const double radius = tool.radius + tooth.radial;
  const double winding = std::tan(tool.cutter.helix * fullTurn / 360) / tool.radius * height;
  const double first = tooth.angle * fullTurn / 360 + turned;
  const double towards = std::atan2(-axis.y(), -axis.x());
  const double sense = winding < 0 ? -1 : 1;
  double wind = std::fmod(sense * (towards - first), fullTurn);
  if (wind < 0) wind += fullTurn;
  if (wind <= std::abs(winding)) return std::abs(axis.norm() - radius);
  const auto at = [&](double angle) { return (axis + radius * Vector2(std::cos(angle), std::sin(angle))).norm(); };
  return std::min(at(first), at(first + winding));
}

/// How far the straight end of a tooth, from the tool's axis outwards, is from the axis of the disc.
double endDistance(const TrueTool& tool, const TrueTooth& tooth, const Vector2& axis, double turned) {
  const double angle = tooth.angle * fullTurn / 360 + turned;
  const Vector2 along(std::cos(angle), std::sin(angle));
  const double share = std::clamp(-axis.dot(along), 0.0, tool.radius + tooth.radial);
  return (axis + share * along).norm();
}

/// A feed motion of one axis from standstill, and a spindle that turns.
struct Stepped {
  double start = 0, sense = 1;
  double speed = 0, acceleration = 0;  ///< mm and seconds
  double turned = 0, rate = 0;         ///< radians

  double way(double t) const {
    const double ramp = speed / acceleration;
    return start + sense * (t < ramp ? 0.5 * acceleration * t * t : speed * (t - 0.5 * ramp));
  }
  /// The axis when `touches(reading, turned)` first says yes: steps of a thousandth of a radian, halved at the end.
  template <class Touches>
  double contact(double duration, const Touches& touches) const {
    const auto at = [&](double t) { return touches(way(t), turned + rate * t); };
    const double step = 1e-4 / std::abs(rate);
    for (double t = 0; t < duration; t += step) {
      if (!at(t)) continue;
      double before = t - step, after = t;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (before + after);
        (at(middle) ? after : before) = middle;
      }
      return way(after);
    }
    return std::nan("");
  }
};

/// The spindle turns against the direction of cutting for a while; what the measuring motion begins with.
Stepped turning(World& world, Dice& dice, double speed, double feed, std::size_t axis, double sense) {
  const bool rightHand = world.cutter.cutter.cutting == Rotation::Clockwise;
  const double since = world.machine->seconds();
  world.machine->turnSpindle(rightHand ? Rotation::CounterClockwise : Rotation::Clockwise, speed);
  world.machine->dwell(dice.between(0, 1));
  Stepped stepped;
  stepped.rate = (rightHand ? 1 : -1) * speed / 60 * fullTurn;
  stepped.turned = stepped.rate * (world.machine->seconds() - since);
  stepped.speed = feed / 60;
  stepped.acceleration = world.machine->description().axes[axis].acceleration;
  stepped.start = world.machine->position()[axis];
  stepped.sense = sense;
  return stepped;
}

TEST(CutterContact, OfATurningMillWithTheSideOfADisc) {
  Dice dice(4811);
  for (int at = 0; at < 24; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    TrueTool tool = randomMill(dice.between(3, 16), dice.whole(1, 6), dice);
    if (at % 3 != 0) tool.cutter.helix = dice.between(-40, 40);
    if (at % 4 == 1) tool.cutter.eccentricity = {dice.between(-0.02, 0.02), dice.between(-0.02, 0.02)};
    if (at % 2 == 1) tool.cutter.cutting = Rotation::CounterClockwise;
    World world(tool);
    const double depth = dice.between(2, 6), y = dice.between(-1, 1), x = -discRadius - tool.radius - 0.2;
    const double z = -400 - depth + tool.length;
    world.to(x, y, -200);
    world.to(x, y, z);
    const double speed = dice.between(100, 900), feed = speed * dice.between(0.004, 0.4);
    const Stepped stepped = turning(world, dice, speed, feed, 0, 1);
    const auto measured = world.machine->measure({positions({x + 2, y, z}), Feed::at(feed), Sensor::ToolTouchProbe});
    ASSERT_EQ(measured.end, MeasureEnd::Touched) << measured.detail;
    const double expected = stepped.contact(60, [&](double reading, double turned) {
      const Vector2 axis = Vector2(reading, y) + axisAside(tool, turned);
      return std::ranges::any_of(tool.cutter.teeth, [&](const TrueTooth& tooth) {
        return flankDistance(tool, tooth, depth + tooth.axial, axis, turned) <= discRadius;
      });
    });
    EXPECT_NEAR(measured.latched[0], expected, 1e-6);
    ASSERT_TRUE(measured.spindleAngle);
  }
}

TEST(CutterContact, OfATurningMillWithTheTopOfADisc) {
  Dice dice(4812);
  for (int at = 0; at < 24; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    TrueTool tool = randomMill(dice.between(5, 25), dice.whole(1, 6), dice);
    if (at % 2 == 1) tool.cutter.cutting = Rotation::CounterClockwise;
    World world(tool);
    const double x = at % 3 == 0 ? 0 : discRadius + tool.radius * dice.between(-0.9, 0.9), z = -399.5 + tool.length;
    world.to(x, 0, -200);
    world.to(x, 0, z);
    const double speed = dice.between(100, 900), feed = speed * dice.between(0.004, 0.2);
    const Stepped stepped = turning(world, dice, speed, feed, 2, -1);
    const auto measured = world.machine->measure({positions({x, 0, z - 2}), Feed::at(feed), Sensor::ToolTouchProbe});
    ASSERT_EQ(measured.end, MeasureEnd::Touched) << measured.detail;
    const double expected = stepped.contact(60, [&](double reading, double turned) {
      return std::ranges::any_of(tool.cutter.teeth, [&](const TrueTooth& tooth) {
        return reading - tool.length - tooth.axial <= -400 &&
               endDistance(tool, tooth, Vector2(x, 0), turned) <= discRadius;
      });
    });
    EXPECT_NEAR(measured.latched[2], expected, 1e-6);
  }
}

TEST(CutterContact, OfAStandingMillIsThatOfTheToothThatStandsThere) {
  Dice dice(4813);
  for (int at = 0; at < 24; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    const TrueTool tool = randomMill(dice.between(3, 16), dice.whole(1, 6), dice);
    World world(tool);
    const double y = dice.between(-1, 1), x = -discRadius - tool.radius - 0.2, z = -404 + tool.length;
    world.to(x, y, -200);
    world.to(x, y, z);
    const double angle = dice.between(-180, 180);
    ASSERT_EQ(world.machine->orientSpindle(angle).end, machine::MoveEnd::Reached);
    const double end = x + tool.radius + 5;
    const auto measured = world.machine->measure({positions({end, y, z}), Feed::at(500), Sensor::ToolTouchProbe});
    // The ends of all teeth, from the tool's axis outwards, are within the heights of the disc.
    const auto touches = [&](double reading) {
      return std::ranges::any_of(tool.cutter.teeth, [&](const TrueTooth& tooth) {
        return endDistance(tool, tooth, Vector2(reading, y), angle * fullTurn / 360) <= discRadius;
      });
    };
    double expected = x;
    while (expected < end && !touches(expected))
      expected += 0.001;
    double before = expected - 0.001;
    for (int i = 0; i < 50 && expected < end; ++i) {
      const double middle = 0.5 * (before + expected);
      (touches(middle) ? expected : before) = middle;
    }
    if (expected >= end) {
      EXPECT_EQ(measured.end, MeasureEnd::NoContact);
      continue;
    }
    ASSERT_EQ(measured.end, MeasureEnd::Touched) << measured.detail;
    EXPECT_NEAR(measured.latched[0], expected, 1e-7);
  }
}

/// With little feed to a turn, what touches is the body that the edges turn out.
TEST(CutterContact, OfABallMillWithATiltedCuboidIsThatOfABall) {
  Dice dice(4814);
  for (int at = 0; at < 10; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    TrueTool tool = randomMill(dice.between(2, 8), 4, dice);
    tool.cutter.cornerRadius = tool.radius;
    tool.cutter.helix = dice.between(-30, 30);
    for (TrueTooth& tooth : tool.cutter.teeth)
      tooth.radial = tooth.axial = 0;
    Truth truth = testing_support::perfectWorld();
    truth.tools.push_back(tool);
    Pose pose = translation({0, 0, -400}) * rotation(Vector3(1, 0.3, 0).normalized(), dice.between(-3, 3));
    placeToolProbe(truth, Box({-12, -12, -12}, {12, 12, 0}), pose);
    VirtualMachine machine(std::move(truth));
    machine.changeTool({2, ""});
    machine.turnSpindle(Rotation::CounterClockwise, 600);
    const double feed = 0.6;  // a thousandth of a millimetre a turn
    const double x = dice.between(-2, 2);
    const Vector3 normal = pose.linear() * Vector3::UnitZ();
    // The ball's centre is its radius above the plane through the middle of the top.
    const double centre = -400 + (tool.radius - normal.x() * x) / normal.z();
    const double expected = centre - tool.radius + tool.length;
    machine.move(positions({x, 0, -200}), Feed::rapidTraverse());
    machine.move(positions({x, 0, expected + 0.01}), Feed::rapidTraverse());
    const auto measured = machine.measure({positions({x, 0, expected - 0.02}), Feed::at(feed), Sensor::ToolTouchProbe});
    ASSERT_EQ(measured.end, MeasureEnd::Touched) << measured.detail;
    EXPECT_LE(measured.latched[2], expected + 1e-6);
    EXPECT_GE(measured.latched[2], expected - 0.001 - 1e-6);
  }
}

TEST(CutterContact, OfAPinBesideTheSpindleAxis) {
  Dice dice(4815);
  for (int at = 0; at < 10; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    TrueTool tool = randomMill(dice.between(4, 10), 0, dice);
    tool.cutter.eccentricity = {dice.between(-0.05, 0.05), dice.between(-0.05, 0.05)};
    World world(tool);
    const double angle = dice.between(-180, 180), turned = angle * fullTurn / 360;
    world.to(-60, 0.3, -200);
    world.machine->orientSpindle(angle);
    world.to(-60, 0.3, -405 + tool.length);
    const auto measured =
        world.machine->measure({positions({0, 0.3, -405 + tool.length}), Feed::at(300), Sensor::ToolTouchProbe});
    ASSERT_EQ(measured.end, MeasureEnd::Touched) << measured.detail;
    const Vector2 aside = axisAside(tool, turned);
    const double across = 0.3 + aside.y(), apart = discRadius + tool.radius;
    EXPECT_NEAR(measured.latched[0], -std::sqrt(apart * apart - across * across) - aside.x(), 1e-7);
  }
}

TEST(CutterContact, OfABrokenToothIsWhatIsLeftOfIt) {
  Dice dice(4816);
  TrueTool tool = randomMill(6, 2, dice);
  tool.cutter.teeth[0] = {.angle = 0, .radial = 0, .axial = 0, .broken = 1.5};
  tool.cutter.teeth[1] = {.angle = 180, .radial = -0.01, .axial = -0.02};
  World world(tool);
  const auto down = [&](double angle) {
    world.to(discRadius + 2, 0, -200);
    world.machine->orientSpindle(angle);
    world.to(discRadius + 2, 0, -395 + tool.length);
    const auto measured = world.machine->measure(
        {positions({discRadius + 2, 0, -403 + tool.length}), Feed::at(300), Sensor::ToolTouchProbe});
    EXPECT_EQ(measured.end, MeasureEnd::Touched) << measured.detail;
    world.machine->retract(positions({discRadius + 2, 0, -200}), Feed::rapidTraverse());
    return -400 + tool.length - measured.latched[2];
  };
  EXPECT_NEAR(down(180), 1.5, 1e-7) << "tooth 1 points to the middle of the disc";
  EXPECT_NEAR(down(0), 0.02, 1e-7) << "tooth 2 does";
}

TEST(CutterContact, InTheDirectionOfCuttingOrFromBelowBreaksTheContact) {
  Dice dice(4817);
  const TrueTool tool = randomMill(6, 2, dice);
  World world(tool);
  world.to(-30, 0, -200);
  world.to(-30, 0, -405 + tool.length);
  world.machine->turnSpindle(Rotation::Clockwise, 300);
  const auto target = positions({-20, 0, -405 + tool.length});
  const auto measured = world.machine->measure({target, Feed::at(3), Sensor::ToolTouchProbe});
  EXPECT_EQ(measured.end, MeasureEnd::Collision);
  EXPECT_NE(measured.detail.find("cutting direction"), std::string::npos) << measured.detail;

  Truth truth = testing_support::perfectWorld();
  truth.tools.push_back(tool);
  auto& probe = placeToolProbe(truth, RoundBar(discRadius, -discThickness, 0), translation({0, 0, -400}));
  probe.gives = {false, true, true, true, false, true};
  VirtualMachine machine(std::move(truth));
  machine.changeTool({2, ""});
  machine.move(positions({-30, 0, -200}), Feed::rapidTraverse());
  machine.move(positions({-30, 0, -405 + tool.length}), Feed::rapidTraverse());
  const auto pushed = machine.measure({target, Feed::at(300), Sensor::ToolTouchProbe});
  EXPECT_EQ(pushed.end, MeasureEnd::Collision);
  EXPECT_NE(pushed.detail.find("does not give way in +X"), std::string::npos) << pushed.detail;
}

TEST(CutterContact, IsFeltByASwitchedOnProbeOnly) {
  Dice dice(4818);
  const TrueTool tool = randomMill(6, 0, dice);
  Truth truth = testing_support::perfectWorld();
  truth.tools.push_back(tool);
  auto& probe = placeToolProbe(truth, RoundBar(discRadius, -discThickness, 0), translation({0, 0, -400}));
  probe.pretravel = 0.004;
  probe.signalDelay = 0.002;
  Truth off = truth;
  off.toolProbes[0].switchedOn = false;
  const auto measure = [&](Truth world) {
    VirtualMachine machine(std::move(world));
    machine.changeTool({2, ""});
    machine.move(positions({0, 0, -395 + tool.length}), Feed::rapidTraverse());
    return machine.measure({positions({0, 0, -405 + tool.length}), Feed::at(300), Sensor::ToolTouchProbe});
  };
  const auto felt = measure(truth);
  ASSERT_EQ(felt.end, MeasureEnd::Touched) << felt.detail;
  EXPECT_NEAR(felt.latched[2], -400 + tool.length - 0.004 - 0.002 * 300 / 60, 1e-7);
  EXPECT_EQ(measure(off).end, MeasureEnd::NotReady);
}

}  // namespace
}  // namespace probewright::simulation
