#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stop_token>
#include <thread>

#include "support/virtual_world.hpp"

namespace probewright::simulation {
namespace {

using machine::AxisPositions;
using machine::Feed;
using machine::MeasureEnd;
using machine::MoveEnd;
using testing::HasSubstr;
using testing_support::idealProbe;
using testing_support::perfectWorld;
using testing_support::place;
using testing_support::positions;

/// A mill with a plane on its table whose surface is z = `height` of the table, and the ideal probe in the spindle.
Truth worldWithFloor(double height = -400) {
  Truth truth = perfectWorld();
  place(truth, HalfSpace({Vector3(0, 0, height), Vector3::UnitZ()}));
  return truth;
}

TEST(IdealMachine, LatchesWhereTheBallTouchesAPlane) {
  VirtualMachine machine(worldWithFloor());
  ASSERT_EQ(machine.changeTool({1, ""}).end, machine::ToolChangeEnd::Changed);
  // The ball's lowest point is 100 mm below the nose: contact at Z -300.
  ASSERT_EQ(machine.move(positions({10, 20, -290}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  const auto result = machine.measure({positions({10, 20, -310}), Feed::at(300)});
  ASSERT_EQ(result.end, MeasureEnd::Touched) << result.detail;
  EXPECT_NEAR(result.latched[2], -300, 1e-9);
  EXPECT_EQ(result.latched[0], 10);
  EXPECT_TRUE(machine.deflected(machine::Sensor::TouchProbe));
  // 5 mm/s, 2500 mm/s^2: the axes stop 0.005 mm further.
  EXPECT_NEAR(machine.position()[2], -300.005, 1e-9);
}

TEST(IdealMachine, TouchesAnObliquePlaneFromAnyDirection) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 300; ++i) {
    const Vector3 normal = Vector3(uniform(random), uniform(random), 3 + uniform(random)).normalized();
    const Plane plane{Vector3(0, 0, -400), normal};
    Truth truth = perfectWorld();
    place(truth, HalfSpace(plane));
    VirtualMachine machine(truth);
    machine.changeTool({0, "PROBE"});
    const Vector3 target(50 * uniform(random), 50 * uniform(random), -380);
    const AxisPositions from = positions({target.x() + 20 * uniform(random), target.y() + 20 * uniform(random), -200});
    const AxisPositions to = positions({target.x(), target.y(), target.z()});
    ASSERT_EQ(machine.move(from, Feed::rapidTraverse()).end, MoveEnd::Reached);
    const auto result = machine.measure({to, Feed::at(600)});
    ASSERT_EQ(result.end, MeasureEnd::Touched);
    const Vector3 centre(result.latched[0], result.latched[1], result.latched[2] - 98);
    EXPECT_NEAR((centre - plane.point).dot(normal), 2, 1e-9);
  }
}

TEST(IdealMachine, RetractFreesTheStylusAndWatchesAgainAfterwards) {
  Truth truth = worldWithFloor();
  place(truth, HalfSpace({Vector3(0, 0, -280), -Vector3::UnitZ()}), Pose::Identity(), "ceiling");
  truth.tools[0].probe.stylusRadius = 0;
  truth.tools[0].probe.bodyRadius = 0;
  truth.start = positions({0, 0, -200});
  VirtualMachine machine(truth);
  ASSERT_EQ(machine.changeTool({1, ""}).end, machine::ToolChangeEnd::ProbeSignal)
      << "the tool change position is inside the ceiling";
  ASSERT_EQ(machine.retract(positions({0, 0, -250}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  ASSERT_FALSE(machine.deflected(machine::Sensor::TouchProbe));
  ASSERT_EQ(machine.measure({positions({0, 0, -310}), Feed::at(100)}).end, MeasureEnd::Touched);
  EXPECT_EQ(machine.measure({positions({0, 0, -310}), Feed::at(100)}).end, MeasureEnd::DeflectedAtStart);
  EXPECT_EQ(machine.move(positions({0, 0, -290}), Feed::at(100)).end, MoveEnd::ProbeSignal);
  ASSERT_EQ(machine.retract(positions({0, 0, -290}), Feed::at(100)).end, MoveEnd::Reached);
  EXPECT_FALSE(machine.deflected(machine::Sensor::TouchProbe));
  EXPECT_EQ(machine.measure({positions({0, 0, -310}), Feed::at(100)}).end, MeasureEnd::Touched);
  // The ball's top meets the ceiling at Z -280 + 100 - 4.
  const auto up = machine.retract(positions({0, 0, -150}), Feed::at(100));
  EXPECT_EQ(up.end, MoveEnd::ProbeSignal);
  EXPECT_THAT(up.detail, HasSubstr("\"ceiling\""));
  EXPECT_NEAR(machine.position()[2], -184, 0.01);
}

TEST(IdealMachine, RetractOnAnotherWayToTheStartMeetsWhatStandsThere) {
  Truth truth = worldWithFloor();
  // Over the way along the floor, but under the slanting one.
  place(truth, Box({4, -5, -395.5}, {6, 5, -392}), Pose::Identity(), "bridge");
  truth.tools[0].probe.stylusRadius = 0;
  truth.tools[0].probe.bodyRadius = 0;
  truth.start = positions({0, 0, -200});
  VirtualMachine machine(truth);
  ASSERT_EQ(machine.changeTool({1, ""}).end, machine::ToolChangeEnd::Changed);
  ASSERT_EQ(machine.move(positions({0, 0, -290}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  ASSERT_EQ(machine.measure({positions({0, 0, -310}), Feed::at(100)}).end, MeasureEnd::Touched);
  ASSERT_EQ(machine.retract(positions({10, 0, machine.position()[2]}), Feed::at(100)).end, MoveEnd::Reached);
  ASSERT_TRUE(machine.deflected(machine::Sensor::TouchProbe));
  const auto back = machine.retract(positions({0, 0, -290}), Feed::at(100));
  EXPECT_EQ(back.end, MoveEnd::ProbeSignal);
  EXPECT_THAT(back.detail, HasSubstr("\"bridge\""));
}

TEST(IdealMachine, RetractIntoTheMaterialIsRefused) {
  VirtualMachine machine(worldWithFloor());
  machine.changeTool({1, ""});
  machine.move(positions({0, 0, -290}), Feed::rapidTraverse());
  ASSERT_EQ(machine.measure({positions({0, 0, -310}), Feed::at(100)}).end, MeasureEnd::Touched);
  EXPECT_EQ(machine.retract(positions({0, 0, -350}), Feed::at(100)).end, MoveEnd::Collision);
  // Sideways the stylus stays deflected.
  EXPECT_EQ(machine.retract(positions({10, 0, machine.position()[2]}), Feed::at(100)).end, MoveEnd::Reached);
  EXPECT_TRUE(machine.deflected(machine::Sensor::TouchProbe));
}

TEST(IdealMachine, ContactWhilePositioningStopsTheAxes) {
  Truth truth = perfectWorld();
  place(truth, Box({-20, -20, -500}, {20, 20, -400}), Pose::Identity(), "vice", SolidRole::Fixture);
  VirtualMachine machine(truth);
  machine.changeTool({1, ""});
  ASSERT_EQ(machine.move(positions({-50, 0, -310}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  const auto result = machine.move(positions({50, 0, -310}), Feed::at(1000));
  EXPECT_EQ(result.end, MoveEnd::ProbeSignal);
  EXPECT_THAT(result.detail, HasSubstr("stylus tip of tool 1 \"PROBE\" touched the fixture \"vice\""));
  EXPECT_NEAR(machine.position()[0], -22, 0.05);
  EXPECT_TRUE(machine.deflected(machine::Sensor::TouchProbe));
}

TEST(IdealMachine, ShaftBodyAndCuttersCollide) {
  Truth truth = perfectWorld();
  place(truth, Box({-20, -20, -440}, {20, 20, -400}), Pose::Identity(), "vice", SolidRole::Fixture);
  truth.tools.push_back({});
  truth.tools.back().number = 5;
  truth.tools.back().kind = ToolKind::Cutter;
  truth.tools.back().radius = 10;
  truth.tools.back().length = 80;
  {
    VirtualMachine machine(truth);
    machine.changeTool({1, ""});
    // The ball passes below the top of the vice and touches first, its radius being larger than the shaft's.
    machine.move(positions({-60, 0, -330}), Feed::rapidTraverse());
    EXPECT_EQ(machine.measure({positions({60, 0, -330}), Feed::at(1000)}).end, MeasureEnd::Touched);
  }
  {
    VirtualMachine machine(truth);
    machine.changeTool({1, ""});
    // The ball passes below the vice's lower face, the shaft meets its side at x = -20 - 1.
    machine.move(positions({-60, 0, -350}), Feed::rapidTraverse());
    const auto result = machine.measure({positions({60, 0, -350}), Feed::at(1000)});
    EXPECT_EQ(result.end, MeasureEnd::Collision);
    EXPECT_THAT(result.detail, HasSubstr("the stylus of tool 1"));
    EXPECT_NEAR(machine.position()[0], -21, 0.01);
  }
  {
    VirtualMachine machine(truth);
    machine.changeTool({1, ""});
    // The body begins 62 mm above the tip and meets the side at x = -20 - 20 well above the shaft.
    machine.move(positions({-60, 0, -390}), Feed::rapidTraverse());
    const auto result = machine.move(positions({60, 0, -390}), Feed::at(1000));
    EXPECT_EQ(result.end, MoveEnd::Collision);
    EXPECT_THAT(result.detail, HasSubstr("the body of tool 1"));
    EXPECT_NEAR(machine.position()[0], -40, 0.01);
    // Away from there it may go.
    EXPECT_EQ(machine.retract(positions({-80, 0, -390}), Feed::at(1000)).end, MoveEnd::Reached);
  }
  {
    VirtualMachine machine(truth);
    ASSERT_EQ(machine.changeTool({5, ""}).end, machine::ToolChangeEnd::Changed);
    EXPECT_EQ(machine.measure({positions({0, 0, -350}), Feed::at(100)}).end, MeasureEnd::NotReady);
    const auto result = machine.move(positions({0, 0, -350}), Feed::at(1000));
    EXPECT_EQ(result.end, MoveEnd::Collision);
    EXPECT_NEAR(machine.position()[2], -320, 0.01);
  }
}

/// What is wider than the edges may meet a tool touch probe where nothing else is in the way.
TEST(IdealMachine, TheShankCollidesWithAToolTouchProbe) {
  Truth truth = perfectWorld();
  TrueTool mill;
  mill.number = 5;
  mill.kind = ToolKind::Cutter;
  mill.length = 80;
  mill.radius = 5;
  mill.cutter.cutLength = 20;
  mill.cutter.shankRadius = 15;
  truth.tools.push_back(mill);
  // The pin stands 10 mm beside the axis: past the edges, below the shank, which begins 20 mm above the tip.
  testing_support::placeToolProbe(truth, RoundBar(3, -40, 0), translation({10, 0, -400}));
  for (const bool blocked : {false, true}) {
    Truth world = truth;
    if (blocked) place(world, Box({-20, -20, -500}, {20, 20, -430}), Pose::Identity(), "vice", SolidRole::Fixture);
    VirtualMachine machine(std::move(world));
    ASSERT_EQ(machine.changeTool({5, ""}).end, machine::ToolChangeEnd::Changed);
    const auto moved = machine.move(positions({0, 0, -380}), Feed::at(1000));
    EXPECT_EQ(moved.end, MoveEnd::Collision);
    EXPECT_THAT(moved.detail, HasSubstr("the shank of tool 5 touched the tool touch probe \"TT\""));
    EXPECT_NEAR(machine.position()[2], -400 - 20 + 80, 0.01) << "before the edges reach the vice at -350";
    EXPECT_EQ(machine.retract(positions({0, 0, -300}), Feed::at(1000)).end, MoveEnd::Reached);
    const auto measured = machine.measure({positions({0, 0, -380}), Feed::at(300), machine::Sensor::ToolTouchProbe});
    EXPECT_EQ(measured.end, MeasureEnd::Collision);
    EXPECT_THAT(measured.detail, HasSubstr("the shank of tool 5 touched the tool touch probe \"TT\""));
    EXPECT_NEAR(machine.position()[2], -400 - 20 + 80, 0.01);
  }
}

TEST(IdealMachine, EdgesOfBodyAndCutterReachAlmostToTheirCorners) {
  // A pin of radius 1 stands 17 mm beside the axis of the probe: the face of the body (radius 20) comes down on it.
  Truth truth = perfectWorld();
  place(truth, RoundBar(1, -500, -400));
  VirtualMachine machine(truth);
  machine.changeTool({1, ""});
  machine.move(positions({-17, 0, 0}), Feed::rapidTraverse());
  const auto result = machine.move(positions({-17, 0, -380}), Feed::at(1000));
  EXPECT_EQ(result.end, MoveEnd::Collision);
  EXPECT_THAT(result.detail, HasSubstr("the body of tool 1"));
  // The face is 62 mm above the tip: at Z -362 it stands on z = -400.
  EXPECT_NEAR(machine.position()[2], -362, 0.2);
}

TEST(IdealMachine, RefusesTargetsBeyondTheTravelWithoutMoving) {
  VirtualMachine machine(perfectWorld());
  const auto result = machine.move(positions({500.001, 0, -10}), Feed::rapidTraverse());
  EXPECT_EQ(result.end, MoveEnd::AxisLimit);
  EXPECT_EQ(result.detail, "axis X would go to 500.0010 mm; its travel ends at 500.0000");
  EXPECT_LT(machine.move(positions({1e300, 0, -10}), Feed::rapidTraverse()).detail.size(), 80U) << "no 300 digits";
  EXPECT_EQ(machine.position(), AxisPositions{});
  EXPECT_EQ(machine.seconds(), 0);
  EXPECT_EQ(machine.move(positions({0, 0, std::nan("")}), Feed::rapidTraverse()).end, MoveEnd::AxisLimit);
}

TEST(IdealMachine, TakesTheTimeOfATrapezoid) {
  VirtualMachine machine(perfectWorld());
  // X: 30000 mm/min = 500 mm/s, 3000 mm/s^2: 300 mm take 300/500 + 500/3000 s.
  machine.move(positions({300, 0, 0}), Feed::rapidTraverse());
  EXPECT_NEAR(machine.seconds(), 0.6 + 500.0 / 3000, 1e-12);
  // 10 mm never reach 500 mm/s: 2 * sqrt(10 / 3000) s.
  double before = machine.seconds();
  machine.move(positions({310, 0, 0}), Feed::rapidTraverse());
  EXPECT_NEAR(machine.seconds() - before, 2 * std::sqrt(10.0 / 3000), 1e-12);
  // X and Z at 45 degrees: Z (400 mm/s, 2500 mm/s^2) is the slower one; along the path sqrt(2) times as much.
  before = machine.seconds();
  machine.move(positions({10, 0, -300}), Feed::rapidTraverse());
  const double path = 300 * std::numbers::sqrt2, speed = 400 * std::numbers::sqrt2,
               acceleration = 2500 * std::numbers::sqrt2;
  EXPECT_NEAR(machine.seconds() - before, path / speed + speed / acceleration, 1e-12);
  // A feed counts along the path.
  before = machine.seconds();
  machine.move(positions({40, 40, -300}), Feed::at(600));
  EXPECT_NEAR(machine.seconds() - before, 50.0 / 10 + 10.0 / (3000 / 0.8), 1e-9);
  machine.dwell(2.5);
  EXPECT_NEAR(machine.seconds() - before, 2.5 + 5 + 10.0 / (3000 / 0.8), 1e-9);
}

TEST(IdealMachine, RotaryMovesFindContactOnTheirArc) {
  // A box stands on the rotary table; turning C carries it against the ball.
  Truth truth = perfectWorld("mill5-table-table");
  place(truth, Box({40, -5, -600}, {60, 5, -500}), Pose::Identity(), "post");
  VirtualMachine machine(truth);
  machine.changeTool({1, ""});
  const double x = 50, y = 30;
  ASSERT_EQ(machine.move(positions({x, y, -430, 0, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  const auto result = machine.measure({positions({x, y, -430, 0, 90}), Feed::at(600)});
  EXPECT_EQ(result.end, MeasureEnd::NoContact) << "C+ turns the tool away from the post as seen from the table";
  const auto back = machine.measure({positions({x, y, -430, 0, -90}), Feed::at(600)});
  ASSERT_EQ(back.end, MeasureEnd::Touched) << back.detail;
  // On the table the ball turns about Z by C; it meets y = 5 + 2 if its x lies on the face, which it does at
  // sin(angle) = 7 / radius: x = sqrt(3400 - 49) = 57.9.
  const double expected = degreesFromRadians(std::asin(7 / std::hypot(x, y)) - std::atan2(y, x));
  EXPECT_NEAR(back.latched[4], expected, 1e-7);
}

TEST(IdealMachine, HeadMovesFindContactOnTheirArc) {
  // B swings the probe about a line 150 mm above the nose: the ball's centre runs on a circle of radius 248.
  Truth truth = perfectWorld("mill5-head-table");
  place(truth, HalfSpace({Vector3(-100, 0, 0), Vector3::UnitX()}));
  VirtualMachine machine(truth);
  machine.changeTool({1, ""});
  ASSERT_EQ(machine.move(positions({0, 0, -100, 0, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  const auto result = machine.measure({positions({0, 0, -100, 60, 0}), Feed::at(600)});
  ASSERT_EQ(result.end, MeasureEnd::Touched) << result.detail;
  EXPECT_NEAR(result.latched[3], degreesFromRadians(std::asin(98.0 / 248)), 1e-7);
  const double swung = radiansFromDegrees(machine.position()[3]);
  EXPECT_LT((machine.path().points.back().shank - Vector3(std::sin(swung), 0, std::cos(swung))).norm(), 1e-9)
      << "the shank points from the ball to the swivel axis";
}

TEST(IdealMachine, ItsPathTellsWhenASwingingHeadStoodWhere) {
  VirtualMachine machine(perfectWorld("mill5-head-table"));
  machine.changeTool({1, ""});
  ASSERT_EQ(machine.move(positions({0, 0, -100, 0, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  const double start = machine.seconds();
  ASSERT_EQ(machine.move(positions({0, 0, -100, 60, 0}), Feed::at(600)).end, MoveEnd::Reached);
  const double duration = machine.seconds() - start;
  int between = 0;
  for (const PathPoint& point : machine.path().points) {
    const double swung = degreesFromRadians(std::atan2(point.shank.x(), point.shank.z()));
    if (swung < 5 || swung > 55) continue;
    ++between;
    EXPECT_NEAR(point.seconds - start, duration * swung / 60, 0.02 * duration) << swung;
  }
  EXPECT_GT(between, 5);
}

TEST(IdealMachine, LatheProbesTheTurnedDiameterInItsRadius) {
  // A probe that lies across the turning axis: its shank points to the turret in +X.
  Truth truth = perfectWorld("lathe2c");
  truth.tools[0].shankDirection = Vector3::UnitX();
  place(truth, RoundBar(25, 0, 120));
  VirtualMachine machine(truth);
  ASSERT_EQ(machine.changeTool({1, ""}).end, machine::ToolChangeEnd::Changed);
  ASSERT_EQ(machine.move(positions({300, 60, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  for (const double c : {0.0, 77.0}) {
    ASSERT_EQ(machine.move(positions({150, 60, c}), Feed::rapidTraverse()).end, MoveEnd::Reached);
    const auto result = machine.measure({positions({100, 60, c}), Feed::at(300)});
    ASSERT_EQ(result.end, MeasureEnd::Touched) << result.detail;
    EXPECT_NEAR(result.latched[0], 125, 1e-9) << "100 mm of probe on a radius of 25 mm";
    ASSERT_EQ(machine.retract(positions({150, 60, c}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  }
}

TEST(IdealMachine, RecordsPathAndTouchesOnTheTable) {
  VirtualMachine machine(worldWithFloor());
  machine.changeTool({1, ""});
  machine.move(positions({10, 20, -290}), Feed::rapidTraverse());
  machine.measure({positions({10, 20, -310}), Feed::at(300)});
  machine.retract(positions({10, 20, -290}), Feed::rapidTraverse());
  const PathRecord& path = machine.path();
  ASSERT_GE(path.points.size(), 4u);
  EXPECT_EQ(path.points.back().kind, PathKind::Retract);
  EXPECT_LT((path.points.back().tip - Vector3(10, 20, -388)).norm(), 1e-9);
  ASSERT_EQ(path.touches.size(), 1u);
  EXPECT_EQ(path.touches[0].solid, "part");
  EXPECT_EQ(path.touches[0].part, "ball");
  EXPECT_LT((path.touches[0].point - Vector3(10, 20, -400)).norm(), 1e-9);
  EXPECT_LT((path.touches[0].normal - Vector3::UnitZ()).norm(), 1e-9);
  EXPECT_NEAR(path.touches[0].latched[2], -300, 1e-9);
  EXPECT_EQ(path.points[path.touches[0].pathPoint].kind, PathKind::Measure);
}

TEST(IdealMachine, ChangesToolsAtTheirPlace) {
  Truth truth = perfectWorld();
  truth.machine.toolChange = positions({100, 50, 0});
  VirtualMachine machine(truth);
  EXPECT_EQ(machine.measure({positions({0, 0, -10}), Feed::at(100)}).end, MeasureEnd::NotReady);
  EXPECT_EQ(machine.changeTool({1, ""}).end, machine::ToolChangeEnd::Changed);
  EXPECT_EQ(machine.position(), positions({100, 50, 0}));
  machine.move(positions({0, 0, -100}), Feed::rapidTraverse());
  EXPECT_EQ(machine.changeTool({0, "PROBE"}).end, machine::ToolChangeEnd::Changed) << "it is in the spindle already";
  EXPECT_EQ(machine.position(), positions({0, 0, -100}));
  const auto missing = machine.changeTool({7, ""});
  EXPECT_EQ(missing.end, machine::ToolChangeEnd::Missing);
  EXPECT_THAT(missing.detail, HasSubstr("holds no tool 7"));
}

/// Turning a million degrees takes long to search: the stop comes from another thread while that goes on.
TEST(IdealMachine, StopsOnTheWayWhereTheSearchHasGotTo) {
  Truth truth = perfectWorld("mill5-table-table");
  place(truth, Box({-50, -50, -20}, {50, 50, 0}), Pose(Eigen::Translation3d(0, 0, -400)));
  VirtualMachine machine(truth);
  ASSERT_EQ(machine.changeTool({1, ""}).end, machine::ToolChangeEnd::Changed);
  const std::size_t c = *machine.description().axisIndex("C");
  AxisPositions start = machine.position(), target = start;
  start[2] = -299.5;
  start[0] = 30;
  ASSERT_EQ(machine.move(start, Feed::rapidTraverse()).end, MoveEnd::Reached);
  target = start;
  std::stop_source source;
  machine.stopOn(source.get_token());
  std::jthread stopper([&] { source.request_stop(); });
  MoveEnd end = MoveEnd::Reached;
  double turned = 0;
  while (end == MoveEnd::Reached) {
    target[c] += 1e6;
    const double before = machine.position()[c];
    end = machine.move(target, Feed::rapidTraverse()).end;
    turned = machine.position()[c] - before;
  }
  EXPECT_EQ(end, MoveEnd::Cancelled);
  EXPECT_GE(turned, 0);
  EXPECT_LT(turned, 1e6) << "the axes stand before the target";
  EXPECT_EQ(machine.position()[2], -299.5);
  const AxisPositions stood = machine.position();
  EXPECT_EQ(machine.move(start, Feed::rapidTraverse()).end, MoveEnd::Cancelled);
  EXPECT_EQ(machine.position(), stood);
  machine.stopOn({});
  EXPECT_EQ(machine.move(stood, Feed::rapidTraverse()).end, MoveEnd::Reached);
}

}  // namespace
}  // namespace probewright::simulation
