#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "machine/links.hpp"
#include "simulation/body_guard.hpp"
#include "support/virtual_world.hpp"

/// What is known to be clear needs no search: with and without that knowledge a machine does the same.
namespace probewright::simulation {
namespace {

using machine::AxisPositions;
using machine::Feed;
using machine::MoveEnd;
using testing_support::perfectWorld;
using testing_support::place;
using testing_support::positions;

/// Arcs and zigzags in a pocket, some of which meet a wall: in one path, and piece by piece.
TEST(ClearWay, APathIsTheSumOfItsPieces) {
  Truth truth = perfectWorld("mill3");
  place(truth, Box({-60, -60, -700}, {-20, 60, -430}));
  place(truth, Box({25, -60, -700}, {60, 60, -430}));
  place(truth, Box({-60, -60, -700}, {60, -22, -440}));
  place(truth, Box({-60, 28, -700}, {60, 60, -440}));
  place(truth, SolidSphere(Vector3(3, 2, -460), 6));
  std::mt19937_64 random(20261123);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int clear = 0, stopped = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const Vector3 centre(uniform(-3, 6), uniform(-3, 6), uniform(-358, -335));
    const double radius = uniform(6, 22), phase = uniform(0, 6.28), turn = uniform(-4, 4), jitter = uniform(0, 0.4);
    const auto at = [&](double share) {
      const double angle = phase + share * turn;
      return positions({centre.x() + radius * std::cos(angle) + uniform(-jitter, jitter),
                        centre.y() + radius * std::sin(angle), centre.z() + 3 * share});
    };
    Truth here = truth;
    here.errors.axes.resize(here.machine.axes.size());
    if (i % 5 == 0) here.errors.axes[0].backlash = 0.01;
    if (i % 7 == 0) here.errors.axes[1].scale = 1e-4;
    here.start = at(0);
    VirtualMachine together(here), apart(here);
    if (together.insertTool({1, ""}).end != machine::ToolChangeEnd::Changed) continue;
    apart.insertTool({1, ""});
    std::vector<machine::PathPiece> path;
    for (int k = 1; k <= 40; ++k)
      path.push_back({at(k / 40.0), Feed::at(2000)});
    const auto whole = together.moveAlong(path);
    machine::PathResult expected{MoveEnd::Reached, path.size(), {}};
    for (std::size_t k = 0; k < path.size() && expected.end == MoveEnd::Reached; ++k) {
      auto piece = apart.move(path[k].target, path[k].feed);
      if (piece.end != MoveEnd::Reached) expected = {piece.end, k, piece.detail};
    }
    EXPECT_EQ(whole.end, expected.end);
    EXPECT_EQ(whole.reached, expected.reached);
    EXPECT_EQ(whole.detail, expected.detail);
    EXPECT_EQ(together.position(), apart.position());
    EXPECT_EQ(together.seconds(), apart.seconds());
    EXPECT_EQ(together.path().points.size(), apart.path().points.size());
    ++(whole.end == MoveEnd::Reached ? clear : stopped);
  }
  EXPECT_GT(clear, 40);
  EXPECT_GT(stopped, 15);
}

/// Tool touch probes of a lathe stand on its bed, whatever the main spindle does: no path misses them for that, neither
/// with a tool that touches one already nor with one that comes from afar.
TEST(ClearWay, PathsMeetProbesOnTheBedOfALathe) {
  Truth truth = perfectWorld("lathe2c");
  testing_support::placeToolProbe(truth, Box({100, -4, 96}, {108, 4, 104}));
  TrueTool pin;
  pin.number = 2;
  pin.name = "PIN";
  pin.kind = ToolKind::Cutter;
  pin.length = 50;
  pin.radius = 3;
  truth.tools.push_back(pin);
  for (const int number : {1, 2}) {
    for (const double turned : {0.0, 90.0}) {
      for (const double aside : {40.0, 0.0}) {
        SCOPED_TRACE(fmt::format("tool {} at C{}, {} mm aside", number, turned, aside));
        Truth here = truth;
        here.start = positions({104 + aside, 260, turned});
        VirtualMachine together(here), apart(here);
        together.insertTool({number, ""});
        apart.insertTool({number, ""});
        std::vector<machine::PathPiece> path;
        for (int k = 1; k <= 40; ++k)
          path.push_back({positions({104 + aside + (k % 2 == 0 ? 0.5 : 0), 260 - 4.0 * k, turned}), Feed::at(2000)});
        const auto whole = together.moveAlong(path);
        machine::PathResult expected{MoveEnd::Reached, path.size(), {}};
        for (std::size_t k = 0; k < path.size() && expected.end == MoveEnd::Reached; ++k) {
          auto piece = apart.move(path[k].target, path[k].feed);
          if (piece.end != MoveEnd::Reached) expected = {piece.end, k, piece.detail};
        }
        EXPECT_EQ(whole.end == MoveEnd::Reached, aside > 0) << whole.detail;
        EXPECT_EQ(whole.end, expected.end);
        EXPECT_EQ(whole.reached, expected.reached);
        EXPECT_EQ(together.position(), apart.position());
        // What touches stands still until it is taken away.
        const auto further = together.moveAlong(path);
        EXPECT_EQ(further.end == MoveEnd::Reached, aside > 0) << further.detail;
        EXPECT_EQ(further.reached, aside > 0 ? path.size() : 0);
      }
    }
  }
}

/// The way back from a touch is the one that the probe has come by: as if it had been searched anew, as it is for a
/// probe that goes a little aside of it.
TEST(ClearWay, TheProbeGoesBackAsItCame) {
  Truth truth = perfectWorld("mill3");
  place(truth, Box({-60, -60, -700}, {-20, 60, -430}));
  place(truth, Box({25, -60, -700}, {60, 60, -430}));
  place(truth, SolidSphere(Vector3(3, 2, -460), 6));
  std::mt19937_64 random(20261124);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int touches = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    Truth here = truth;
    here.errors.axes.resize(here.machine.axes.size());
    if (i % 5 == 0) here.errors.axes[0].backlash = 0.01;
    here.tools[0].probe.pretravel = 0.01;
    const AxisPositions start = positions({uniform(-15, 20), uniform(-20, 20), uniform(-352, -335)});
    here.start = start;
    VirtualMachine atOnce(here), inTwo(here);
    if (atOnce.insertTool({1, ""}).end != machine::ToolChangeEnd::Changed) continue;
    inTwo.insertTool({1, ""});
    const machine::MeasureOrder order{
        positions({start[0] + uniform(-40, 40), start[1] + uniform(-10, 10), start[2] + uniform(-30, 0)}),
        Feed::at(800)};
    if (atOnce.measure(order).end != machine::MeasureEnd::Touched) continue;
    inTwo.measure(order);
    const AxisPositions stood = inTwo.position();
    AxisPositions first = stood;
    for (std::size_t axis = 0; axis < 3; ++axis)
      first[axis] += 0.9 * (start[axis] - stood[axis]);
    first[2] += 1e-6;
    const auto back = atOnce.retract(start, Feed::at(2000));
    auto expected = inTwo.retract(first, Feed::at(2000));
    if (expected.end == MoveEnd::Reached) expected = inTwo.retract(start, Feed::at(2000));
    EXPECT_EQ(back.end, expected.end) << back.detail << expected.detail;
    EXPECT_EQ(atOnce.position(), inTwo.position());
    EXPECT_FALSE(atOnce.deflected(machine::Sensor::TouchProbe));
    // What it does not come back to is watched: from there straight through what it has touched.
    const AxisPositions through = positions({start[0] + 2 * (order.target[0] - start[0]), start[1], start[2]});
    EXPECT_EQ(atOnce.move(through, Feed::at(2000)).end, inTwo.move(through, Feed::at(2000)).end);
    ++touches;
  }
  EXPECT_GT(touches, 60);
}

/// A guard that remembers how far bodies and tool are apart finds what one finds that has just been made.
TEST(ClearWay, BodiesAreFoundWhateverIsRemembered) {
  std::mt19937_64 random(20261124);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int hits = 0, ways = 0;
  for (int world = 0; world < 12; ++world) {
    Truth truth = perfectWorld("mill5-table-table");
    const machine::Link cradle = machine::linkNamed(truth.machine, "A").value(),
                        head = machine::headLink(truth.machine);
    const Vector3 halfHead(uniform(10, 60), uniform(10, 60), uniform(10, 60));
    const Vector3 halfCradle(uniform(10, 80), uniform(10, 80), uniform(10, 80));
    truth.bodies.push_back(
        {"head", head, std::make_shared<Box>(-halfHead, halfHead), translation({0, 0, halfHead.z()})});
    truth.bodies.push_back({"cradle", cradle, std::make_shared<Box>(-halfCradle, halfCradle),
                            translation({uniform(-100, 100), uniform(-100, 100), uniform(-600, -480)}) *
                                rotation(Vector3(1, 2, 3).normalized(), uniform(0, 180))});
    place(truth, Box({-40, -30, -560}, {50, 40, -520}));
    const TrueKinematics kinematics(truth.machine, truth.errors);
    const ToolShape tool = shapeOf(&truth.tools[0], 0);
    BodyGuard remembers(truth);
    AxisPositions here = positions({0, 0, 0, 0, 0});
    for (int i = 0; i < 60; ++i) {
      SCOPED_TRACE(world * 100 + i);
      AxisPositions to = here;
      for (std::size_t axis = 0; axis < 3; ++axis)
        to[axis] += uniform(-40, 40);
      if (i % 3 == 0) to = positions({uniform(-150, 150), uniform(-150, 150), uniform(-540, -300), here[3], 0});
      to[2] = std::clamp(to[2], -540.0, 0.0);
      if (i % 5 == 0) to[3] = uniform(-90, 90);
      const Motion motion{kinematics, here, to, here, 0, MotionProfile(500, 100, 1000)};
      const auto hit = remembers.firstHit(motion, 1, tool, BodyGuard::Touching::Counts, {});
      const auto expected = BodyGuard(truth).firstHit(motion, 1, tool, BodyGuard::Touching::Counts, {});
      ASSERT_EQ(hit.has_value(), expected.has_value());
      ++ways;
      if (!hit) {
        remembers.arrived(1);
        here = to;
        continue;
      }
      ++hits;
      // The axes go back to where they came from, where nothing touches.
      const double way = (Vector3(to[0], to[1], to[2]) - Vector3(here[0], here[1], here[2])).norm();
      EXPECT_LT(std::abs(hit->fraction - expected->fraction) * way, 0.05);
      EXPECT_EQ(hit->byTool, expected->byTool);
      remembers.arrived(0);
    }
  }
  EXPECT_GT(hits, 60);
  EXPECT_GT(ways - hits, 200);
}

}  // namespace
}  // namespace probewright::simulation
