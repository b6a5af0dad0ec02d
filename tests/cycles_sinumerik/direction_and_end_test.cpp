#include "support/sinumerik_bench.hpp"

/// Which way the probe goes where the call leaves it open, and where it stands after the cycle.
namespace probewright {
namespace {

using namespace testing_support;

constexpr double table = -350;

/// A block whose faces towards minus X, plus X, minus Y, plus Y and up lie at -45, 45, -35, 35 and 0.
simulation::Truth block(double turn = 0) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Box({-45, -35, -60}, {45, 35, 0}),
        translation({0, 0, table}) * rotation(Vector3::UnitZ(), turn));
  return truth;
}

TEST(MeasuringDirection, LeadsFromTheProbeToTheSetValueWhereSMdIsLeftOut) {
  const struct {
    int axis;
    double set;
    Vector3 start;
  } faces[] = {{0, -45, {-60, 3, -10}},
               {0, 45, {60, 3, -10}},
               {1, -35, {3, -50, -10}},
               {1, 35, {3, 50, -10}},
               {2, 0, {3, 3, 12}}};
  for (const auto& [axis, set, start] : faces) {
    for (const bool given : {false, true}) {
      SinumerikBench bench(block());
      plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
      NamedNumbers call = {{"S_SETV", set + 0.3}, {"S_FA", 8}, {"S_TSA", 5}, {"S_MA", axis + 1.0}};
      if (given) call.emplace_back("S_MD", 0);
      bench.start(start);
      bench.run("CYCLE978", call);
      EXPECT_NEAR(bench.ovr(4), set, 1e-9) << "axis " << axis << " set " << set;
      const Vector3 end = bench.control.channel.position().vector();
      const double outwards = start[axis] > set ? 1 : -1;
      EXPECT_NEAR(end[axis], set + 0.3 + outwards * (8 + (axis < 2 ? 2 : 0)), 1e-9) << "DFA from the set value";
    }
  }
}

TEST(MeasuringDirection, OfAnEdgeIsThatOfItsSetPlace) {
  // The sign of the set place alone would lead away from these faces.
  for (const double turn : {0.2, -1.5}) {
    SinumerikBench bench(block(turn));
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    const NamedNumbers call = {{"S_MVAR", 105}, {"S_KNUM", 10001}, {"S_FA", 10},
                               {"S_TSA", 5},    {"S_MA", 201},     {"S_ID", 20}};
    bench.start({-60, -10, -20});
    bench.run("CYCLE998", with(call, {{"S_SETV", -45}}));
    EXPECT_NEAR(bench.ovr(4), turn, 1e-9);
    bench.set("$P_UIFR", {1, "Z", "RT"}, 0);
    bench.start({60, -10, -20});
    bench.run("CYCLE998", with(call, {{"S_SETV", 45}}));
    EXPECT_NEAR(bench.ovr(4), turn, 1e-9);
    bench.set("$P_UIFR", {1, "Z", "RT"}, 0);
    bench.start({-60, -10, -20});
    bench.run("CYCLE998", with(call, {{"S_SETV", -45}, {"S_MD", 1}}));
    EXPECT_NEAR(bench.ovr(4), turn, 1e-9);
  }
}

TEST(EndPosition, OfCycle998IsDfaFromTheSurfaceAtTheSecondPoint) {
  for (const double variant : {5.0, 100005.0}) {
    for (const double turn : {-3.0, 2.0}) {
      SinumerikBench bench(block(turn));
      plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
      bench.start({-58, -15, -20});
      bench.run("CYCLE998", {{"S_MVAR", variant}, {"S_FA", 8}, {"S_TSA", 5}, {"S_MA", 201}, {"S_MD", 1}, {"S_ID", 30}});
      const Vector3 end = bench.control.channel.position().vector();
      EXPECT_NEAR(end.y(), 15, 1e-9);
      // Where the ball touches at Y15, its surface lies DFA from the face that it touched.
      const double touched = bench.control.journal.cycles.back().touches.back().surface.x();
      EXPECT_NEAR(end.x(), touched - 8 - 2, 1e-9) << variant << ' ' << turn;
      EXPECT_NEAR(end.z(), -20, 1e-9);
    }
  }
  SinumerikBench bench(block());
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.start({-20, -20, 9});
  bench.run("CYCLE998", {{"S_MVAR", 6}, {"S_FA", 7}, {"S_TSA", 5}, {"S_SETV0", 40}, {"S_SETV2", 10}, {"S_SETV3", 35}});
  EXPECT_NEAR((bench.control.channel.position() - ProgramPlace(-10, 15, 7)).norm(), 0, 1e-9);
}

TEST(EndPosition, OfCycle976AtAnEdgeLeavesTheBallsCentreDfaAway) {
  for (const double path : {8.0, 3.0}) {
    SinumerikBench bench(block());
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    bench.start({-60, 0, -20});
    bench.run("CYCLE976", {{"S_MVAR", 1004}, {"S_SETV", -45}, {"S_MA", 1}, {"S_MD", 0}, {"S_FA", path}, {"S_TSA", 3}});
    // With less than the ball's radius of room it stays clear of the edge.
    EXPECT_NEAR(bench.control.channel.position().x(), path >= 4 ? -45 - path : -45 - path - 2, 1e-9);
  }
}

TEST(Ranges, TheAngleOfACornerIsBetweenMinusAndPlus180) {
  SinumerikBench bench(block());
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  for (const double angle : {181.0, -270.0}) {
    bench.start({-55, -45, -20});
    EXPECT_EQ(bench.alarmOf("CYCLE961", {{"S_MVAR", 8},
                                         {"S_SETV0", 20},
                                         {"S_SETV1", 60},
                                         {"S_SETV2", 20},
                                         {"S_SETV3", 50},
                                         {"S_SETV4", -55},
                                         {"S_SETV5", -45},
                                         {"S_INCA", angle},
                                         {"S_FA", 10},
                                         {"S_TSA", 5}}),
              "61319");
  }
}

TEST(LShapedProbes, CalibrateInARingInTheOneDirectionThatTheyReach) {
  simulation::Truth truth = perfectWorld();
  truth.tools[0].length = 150;
  truth.tools[0].probe.stylusLength = 90;
  truth.tools[0].probe.tipOffset = {30, 0};
  truth.tools[0].probe.pretravel = 0.015;
  place(truth, simulation::Ring(50, 80, -30), translation({0, 0, table}));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.set("$TC_DP1", {1, 1}, 713);
  bench.set("$TC_DP3", {1, 1}, 148);
  bench.set("$TC_DP6", {1, 1}, 30);
  bench.set("$TC_DP7", {1, 1}, 2);
  bench.set("$SNS_MEA_WP_BALL_DIAM", {0}, 4);
  bench.set("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", {0}, 0);
  const NamedNumbers call = {{"S_SETV", 100}, {"S_FA", 6}, {"S_TSA", 40}};
  for (const NamedNumbers& other :
       {NamedNumbers{{"S_MVAR", 1}}, NamedNumbers{{"S_MVAR", 2}}, NamedNumbers{{"S_MVAR", 2001}, {"S_MA", 1}},
        NamedNumbers{{"S_MVAR", 1001}, {"S_MA", 2}, {"S_MD", 0}},
        NamedNumbers{{"S_MVAR", 1001}, {"S_MA", 1}, {"S_MD", 1}}}) {
    bench.start({0, 0, -10});
    const execution::RunResult result = bench.tryRun("CYCLE976", with(call, other));
    ASSERT_FALSE(result.diagnostics.empty());
    EXPECT_EQ(result.diagnostics[0].code, "61309");
    EXPECT_NE(result.diagnostics[0].message.find("S_MVAR = 1001"), std::string::npos);
    EXPECT_TRUE(bench.control.journal.cycles.back().touches.empty()) << "refused before anything moves";
  }
  bench.start({0, 0, -10});
  bench.run("CYCLE976", with(call, {{"S_MVAR", 1001}, {"S_MA", 1}, {"S_MD", 0}}));
  // The arm keeps its length; the ball is as small as it acts.
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", {0}), 32 - 0.015, 1e-7);
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_BALL_DIAM", {0}), 2 * (2 - 0.015), 1e-7);
  EXPECT_EQ(bench.data("$TC_DP6", {1, 1}), 30);
}

TEST(ToolData, WhatAProgramWritesActsWithTheNextTOrD) {
  SinumerikBench bench(block());
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  const NamedNumbers call = {{"S_FA", 8}, {"S_TSA", 5}, {"S_MA", 3}, {"S_MD", 2}};
  bench.start({3, 3, 12});
  bench.run("CYCLE978", call, {}, "$TC_DP3[1,1]=95\nTRANS X1\nTRANS\nG54\n");
  EXPECT_NEAR(bench.ovr(4), 0, 1e-9) << "the length is still that of the last D";
  bench.set("$TC_DP3", {1, 1}, 100);
  bench.start({3, 3, 12});
  bench.run("CYCLE978", call, {}, "$TC_DP3[1,1]=99\nD1\n");
  EXPECT_NEAR(bench.ovr(4), 1, 1e-9);
}

}  // namespace
}  // namespace probewright
