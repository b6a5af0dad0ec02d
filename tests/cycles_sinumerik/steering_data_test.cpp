#include <algorithm>

#include "support/sinumerik_bench.hpp"

/// Every machine and setting datum that steers measuring workpieces, changed alone.
namespace probewright {
namespace {

using namespace testing_support;
using simulation::PathKind;

constexpr double table = -350;

/// A block whose faces look into minus X, minus Y and plus Z from its corner.
simulation::Truth block(const Vector3& corner = {0, 0, table}) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Box({0, 0, -60}, {120, 100, 0}), translation(corner));
  return truth;
}

class SteeredBench : public SinumerikBench {
public:
  explicit SteeredBench(const simulation::Truth& truth) : SinumerikBench(truth) {
    plantFrame(*this, "$P_UIFR", 1, {0, 0, table});
  }

  static NamedNumbers touching(int axis, int way) {
    return {{"S_FA", 6}, {"S_TSA", 5}, {"S_MA", axis + 1.0}, {"S_MD", static_cast<double>(way)}};
  }

  /// Touches the face across `axis` of the block; returns its position.
  double face(int axis, const NamedNumbers& changed = {}) {
    Vector3 at(30, 30, -10);
    at[axis] = axis == 2 ? 40 : -40;
    start(at);
    from_ = machine.path().points.size();
    run("CYCLE978", with(touching(axis, axis == 2 ? 2 : 1), changed));
    return ovr(4);
  }

  /// True if a piece of path of this kind, at least 3 mm (arcs: any), was travelled at `feed`, mm/min, since the start.
  bool travelled(PathKind kind, double feed, double least = 3) const {
    const auto& points = machine.path().points;
    for (std::size_t i = std::max<std::size_t>(from_, 1); i < points.size(); ++i) {
      const double way = (points[i].tip - points[i - 1].tip).norm();
      if (points[i].kind != kind || way < least) continue;
      // Starting and stopping take their time.
      const double speed = 60 * way / (points[i].seconds - points[i - 1].seconds);
      if (speed < 1.0001 * feed && speed > 0.95 * feed) return true;
    }
    return false;
  }
  std::size_t countOf(PathKind kind) const {
    const auto& points = machine.path().points;
    return static_cast<std::size_t>(std::count_if(points.begin() + static_cast<std::ptrdiff_t>(from_), points.end(),
                                                  [kind](const auto& point) { return point.kind == kind; }));
  }
  std::size_t stops() const {
    return static_cast<std::size_t>(
        std::count_if(control.journal.events.begin(), control.journal.events.end(),
                      [](const auto& event) { return event.kind == control::EventKind::Stop; }));
  }
  void watch() { from_ = machine.path().points.size(); }

private:
  std::size_t from_ = 0;
};

void setBit(SteeredBench& bench, const char* mask, int bit, bool value) {
  control::sinumerik::setMaskBit(bench.control.data, mask, bit, value);
}

TEST(SteeringData, Sd54600To54606ShiftWhatTheirDirectionTouches) {
  const char* triggers[3][2] = {{"$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", "$SNS_MEA_WP_TRIG_PLUS_DIR_AX1"},
                                {"$SNS_MEA_WP_TRIG_MINUS_DIR_AX2", "$SNS_MEA_WP_TRIG_PLUS_DIR_AX2"},
                                {"$SNS_MEA_WP_TRIG_MINUS_DIR_AX3", "$SNS_MEA_WP_TRIG_PLUS_DIR_AX3"}};
  for (int changedAxis = 0; changedAxis < 3; ++changedAxis) {
    for (int changedWay = 0; changedWay < 2; ++changedWay) {
      SteeredBench bench(block());
      const char* name = triggers[changedAxis][changedWay];
      bench.set(name, {0}, bench.data(name, {0}) + 0.125);
      for (int axis = 0; axis < 3; ++axis) {
        const int way = axis == 2 ? 0 : 1;  // the faces are touched in plus, the top in minus direction
        EXPECT_NEAR(bench.face(axis), axis == changedAxis && way == changedWay ? 0.125 : 0, 1e-9) << name << axis;
      }
    }
  }
  // The back of the block, in minus direction.
  SteeredBench bench(block());
  bench.set("$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", {0}, -2.25);
  bench.start({140, 30, -10});
  bench.run("CYCLE978", with(SteeredBench::touching(0, 2), {{"S_SETV", 120}}));
  EXPECT_NEAR(bench.ovr(4), 119.75, 1e-9);
  // A reversed spindle needs the diameter alone.
  bench.set("$SNS_MEA_WP_BALL_DIAM", {0}, 4.5);
  EXPECT_NEAR(bench.face(0, {{"S_MVAR", 10000}}), 0.25, 1e-9);
}

TEST(SteeringData, Sd54607And54608LeadTheBallToTheSetPoint) {
  simulation::Truth truth = perfectWorld();
  truth.tools[0].probe.tipOffset = {0.3, -0.2};
  place(truth, simulation::Ring(20, 60, -40), translation({0, 0, table}));
  SteeredBench bench(truth);
  const char* names[] = {"$SNS_MEA_WP_POS_DEV_AX1", "$SNS_MEA_WP_POS_DEV_AX2"};
  for (int axis = 0; axis < 2; ++axis) {
    const double deviation = truth.tools[0].probe.tipOffset[axis];
    bench.set(names[axis], {0}, deviation);
    bench.set(axis == 0 ? "$SNS_MEA_WP_TRIG_PLUS_DIR_AX1" : "$SNS_MEA_WP_TRIG_PLUS_DIR_AX2", {0}, deviation + 2);
    bench.set(axis == 0 ? "$SNS_MEA_WP_TRIG_MINUS_DIR_AX1" : "$SNS_MEA_WP_TRIG_MINUS_DIR_AX2", {0}, deviation - 2);
  }
  const auto diameter = [&] {
    bench.start({0, 0, -10});
    bench.run("CYCLE977", {{"S_MVAR", 1}, {"S_SETV", 40}, {"S_FA", 5}, {"S_TSA", 2}});
    return bench.ovr(4);
  };
  EXPECT_NEAR(diameter(), 40, 1e-9);
  bench.set(names[0], {0}, 0);
  bench.set(names[1], {0}, 0);
  EXPECT_LT(diameter(), 40 - 1e-4) << "a chord beside the middle is shorter";
}

TEST(SteeringData, Sd54611AndSd55630GiveTheMeasuringFeed) {
  SteeredBench bench(block());
  bench.face(0);
  EXPECT_TRUE(bench.travelled(PathKind::Measure, 300));
  bench.set("$SCS_MEA_FEED_MEASURE", {}, 180);
  bench.face(0);
  EXPECT_TRUE(bench.travelled(PathKind::Measure, 180)) << "a data set without feed";
  bench.set("$SNS_MEA_WP_FEED", {0}, 90);
  bench.face(0);
  EXPECT_TRUE(bench.travelled(PathKind::Measure, 90)) << "as calibrated";
}

TEST(SteeringData, CalibrationLeavesItsFeedAndStatus) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Ring(20, 60, -40), translation({0, 0, table}));
  SteeredBench bench(truth);
  for (const char* name : {"$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", "$SNS_MEA_WP_TRIG_PLUS_DIR_AX1",
                           "$SNS_MEA_WP_TRIG_MINUS_DIR_AX2", "$SNS_MEA_WP_TRIG_PLUS_DIR_AX2"}) {
    bench.set(name, {0}, 0);
  }
  const auto calibrate = [&](const NamedNumbers& changed) {
    bench.start({0, 0, -10});
    bench.run("CYCLE976", with({{"S_MVAR", 1001}, {"S_SETV", 40}, {"S_FA", 8}, {"S_TSA", 3}, {"S_MA", 1}}, changed));
  };
  bench.set("$SCS_MEA_FEED_MEASURE", {}, 210);
  calibrate({});
  EXPECT_EQ(bench.data("$SNS_MEA_WP_FEED", {0}), 210);
  EXPECT_EQ(bench.data("$SNS_MEA_WP_STATUS_RT", {0}), 2) << "the 1st axis in plus direction";
  calibrate({{"S_MD", 1}, {"S_VMS", 150}});
  EXPECT_EQ(bench.data("$SNS_MEA_WP_FEED", {0}), 150);
  EXPECT_EQ(bench.data("$SNS_MEA_WP_STATUS_RT", {0}), 3);
  calibrate({{"S_MVAR", 12001}, {"S_MA", 2}});
  EXPECT_EQ(bench.data("$SNS_MEA_WP_STATUS_RT", {0}), 33);
  EXPECT_EQ(bench.data("$SNS_MEA_WP_STATUS_GEN", {0}), 1) << "in G17, without position deviation";
  calibrate({{"S_MVAR", 1}});
  EXPECT_EQ(bench.data("$SNS_MEA_WP_STATUS_GEN", {0}), 11);
}

TEST(SteeringData, Sd55634And55636GiveThePositioningFeeds) {
  SteeredBench bench(block());
  bench.face(0);
  EXPECT_TRUE(bench.travelled(PathKind::Feed, 1000));
  EXPECT_TRUE(bench.travelled(PathKind::Retract, 1000));
  bench.set("$SCS_MEA_FEED_PLANE_VALUE", {}, 500);
  bench.face(0);
  EXPECT_TRUE(bench.travelled(PathKind::Feed, 500));
  EXPECT_TRUE(bench.travelled(PathKind::Retract, 500));
  EXPECT_FALSE(bench.travelled(PathKind::Feed, 1000));
  bench.face(2);
  EXPECT_TRUE(bench.travelled(PathKind::Feed, 1000)) << "along the infeed axis";
  bench.set("$SCS_MEA_FEED_FEEDAX_VALUE", {}, 700);
  bench.face(2);
  EXPECT_TRUE(bench.travelled(PathKind::Feed, 700));
  bench.set("$SCS_MEA_FEED_FEEDAX_VALUE", {}, 0);
  bench.start({-40, 30, -10});
  EXPECT_EQ(bench.alarmOf("CYCLE978", SteeredBench::touching(0, 1)), "61338");
}

TEST(SteeringData, Sd55740Bit0AndSd55632PositionAtReducedRapid) {
  SteeredBench bench(block());
  setBit(bench, "$SCS_MEA_FUNCTION_MASK", 0, false);
  bench.set("$SCS_MEA_FEED_RAPID_IN_PERCENT", {}, 5);
  bench.face(0);
  EXPECT_TRUE(bench.travelled(PathKind::Feed, 0.05 * 30000)) << "X at 5 percent of its rapid traverse";
  bench.face(2);
  EXPECT_TRUE(bench.travelled(PathKind::Feed, 0.05 * 24000)) << "Z";
}

TEST(SteeringData, Sd55740Bit5RetractsAtReducedRapid) {
  SteeredBench bench(block());
  setBit(bench, "$SCS_MEA_FUNCTION_MASK", 5, true);
  bench.set("$SCS_MEA_FEED_RAPID_IN_PERCENT", {}, 2);
  bench.face(0);
  EXPECT_TRUE(bench.travelled(PathKind::Retract, 0.02 * 30000));
}

TEST(SteeringData, Sd55740Bit4AndSd55638ApproachFast) {
  SteeredBench bench(block());
  setBit(bench, "$SCS_MEA_FUNCTION_MASK", 4, true);
  bench.set("$SCS_MEA_FEED_FAST_MEASURE", {}, 600);
  EXPECT_NEAR(bench.face(0), 0, 1e-9);
  EXPECT_EQ(bench.countOf(PathKind::Measure), 2U) << "fast, and the one that counts";
  EXPECT_TRUE(bench.travelled(PathKind::Measure, 600));
  EXPECT_TRUE(bench.travelled(PathKind::Measure, 300, 1.5));
}

TEST(SteeringData, Sd55640GivesTheFeedOnArcs) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::SolidSphere(Vector3::Zero(), 15), translation({0, 0, table}));
  SteeredBench bench(truth);
  bench.set("$SCS_MEA_FEED_CIRCLE", {}, 60);
  bench.start({0, 0, 25});
  bench.watch();
  bench.run("CYCLE997", {{"S_MVAR", 101009}, {"S_SETV", 30}, {"S_FA", 5}, {"S_TSA", 2}, {"S_INCA", 90}});
  EXPECT_TRUE(bench.travelled(PathKind::Feed, 60, 0.5));
}

TEST(SteeringData, Sd55740Bit3TriesOnce) {
  SteeredBench bench(block());
  const auto attempts = [&] {
    bench.start({-40, 30, -10});
    bench.watch();
    EXPECT_EQ(bench.alarmOf("CYCLE978", with(SteeredBench::touching(0, 1), {{"S_SETV", -20}})), "61301");
    return bench.countOf(PathKind::Measure);
  };
  const auto failed = [&] {
    const auto& touches = bench.control.journal.cycles.back().touches;
    return std::ranges::count(touches, "no contact", &control::TouchRecord::outcome);
  };
  EXPECT_EQ(attempts(), 5U);
  EXPECT_EQ(failed(), 5) << "each attempt counts";
  setBit(bench, "$SCS_MEA_FUNCTION_MASK", 3, true);
  EXPECT_EQ(attempts(), 1U);
  EXPECT_EQ(failed(), 1);
}

TEST(SteeringData, Md51740Bit2ObservesTheTurnedHead) {
  // The head lies: the probe looks into plus Y, as the mill did whose end made the face. It cut 0.15 too deep, so it is
  // 0.15 longer than its data say.
  for (const bool observed : {false, true}) {
    simulation::Truth truth = perfectWorld("mill5-head-head");
    place(truth, simulation::Box({0, 0.15, -60}, {120, 100, 0}), translation({0, 0, table}));
    SteeredBench bench(truth);
    setBit(bench, "$MNS_MEA_FUNCTION_MASK", 1, false);  // the length ends at the ball's centre
    setBit(bench, "$MNS_MEA_FUNCTION_MASK", 2, observed);
    bench.set("$TC_DP3", {1, 1}, 98);
    bench.control.data.set("$TC_TP2", {2}, std::string("MILL"));
    bench.set("$TC_DP1", {2, 1}, 120);
    bench.set("$TC_DP3", {2, 1}, 80);
    bench.set("$TC_DP6", {2, 1}, 5);
    bench.run("CYCLE978", with(SteeredBench::touching(1, 1), {{"S_MVAR", 200}, {"S_KNUM1", 1}, {"S_SETV", 0}}),
              {{"S_TNAME", "MILL"}}, "SUPA G0 Z0 D0\nD1\nTRAORI\nG0 A90 C0\nG0 X30 Y-60 Z-20\nG0 Y-20\n");
    EXPECT_NEAR(bench.ovr(4), 0.15, 1e-7);
    EXPECT_NEAR(bench.data("$TC_DP12", {2, 1}), observed ? 0.15 : 0, 1e-7);
    EXPECT_NEAR(bench.data("$TC_DP15", {2, 1}), observed ? 0 : 0.15, 1e-7) << "an edge across Y: the radius";
  }
}

TEST(SteeringData, Sd42940KeepsTheAxesOfTheLengths) {
  // In G18 the probe still stands along Z: its length is length 1 of G17, and the cycle corrects it there.
  SteeredBench bench(block());
  bench.set("$SC_TOOL_LENGTH_CONST", {}, 17);
  setBit(bench, "$MNS_MEA_FUNCTION_MASK", 1, false);  // the length ends at the ball's centre
  bench.set("$TC_DP3", {1, 1}, 98);
  bench.plane = "G18";
  bench.start({30, 30, 40});
  bench.run("CYCLE978", {{"S_FA", 6}, {"S_TSA", 5}, {"S_SETV", 0}, {"S_MA", 1}, {"S_MD", 2}}, {}, "");
  EXPECT_NEAR(bench.ovr(4), 0, 1e-9) << "the top of the block, along the 1st axis of G18";
  bench.set("$SC_TOOL_LENGTH_CONST", {}, 0);
  EXPECT_EQ(bench.control.channel.toolVector, Vector3(0, 0, 98)) << "until the tool is called again";
}

TEST(SteeringData, Md51740Bit0WatchesTheCalibration) {
  SteeredBench bench(block());
  bench.start({-40, 30, -10});
  const NamedNumbers other = with(SteeredBench::touching(0, 1), {{"S_PRNUM", 2}});
  EXPECT_EQ(bench.alarmOf("CYCLE978", other), "61341");
  bench.set("$SNS_MEA_WP_BALL_DIAM", {1}, 4);
  bench.set("$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", {1}, -2);
  bench.start({-40, 30, -10});
  EXPECT_EQ(bench.alarmOf("CYCLE978", other), "61341") << "never touched in plus direction";
  setBit(bench, "$MNS_MEA_FUNCTION_MASK", 0, false);
  bench.start({-40, 30, -10});
  EXPECT_EQ(bench.alarmOf("CYCLE978", other), "");
  EXPECT_NEAR(bench.ovr(4), -2, 1e-9) << "what the axes read";
}

TEST(SteeringData, Md51740Bit1SaysWhereTheLengthEnds) {
  SteeredBench bench(block());
  EXPECT_NEAR(bench.face(2), 0, 1e-9);
  setBit(bench, "$MNS_MEA_FUNCTION_MASK", 1, false);
  bench.set("$TC_DP3", {1, 1}, 98);  // to the centre of the ball
  bench.set("$SNS_MEA_WP_TRIG_MINUS_DIR_AX3", {0}, -2);
  EXPECT_NEAR(bench.face(2), 0, 1e-9);
  // Round a ball, the equator is met at the height of the ball's centre.
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::SolidSphere(Vector3::Zero(), 15), translation({0, 0, table}));
  for (const bool toCentre : {false, true}) {
    SteeredBench ball(truth);
    setBit(ball, "$MNS_MEA_FUNCTION_MASK", 1, !toCentre);
    ball.set("$TC_DP3", {1, 1}, toCentre ? 98 : 100);
    ball.set("$SNS_MEA_WP_TRIG_MINUS_DIR_AX3", {0}, toCentre ? -2 : 0);
    ball.start({0, 0, 25});
    ball.run("CYCLE997", {{"S_MVAR", 1101019}, {"S_SETV", 30}, {"S_FA", 5}, {"S_TSA", 2}, {"S_INCA", 90}});
    EXPECT_NEAR(ball.ovr(4), 30, 1e-6);
  }
}

TEST(SteeringData, Md51740Bit3LetsTheCorrectionAngleAct) {
  // A probe with one direction whose ball lies 0.1 beside the axis, 30 degrees away from where it should.
  simulation::Truth truth = block();
  truth.tools[0].probe.tipOffset = {0.1 * std::cos(radiansFromDegrees(-30)), 0.1 * std::sin(radiansFromDegrees(-30))};
  SteeredBench bench(truth);
  bench.set("$TC_DP1", {1, 1}, 712);
  bench.set("$TC_DP10", {1, 1}, 30);
  bench.set("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", {0}, 2.1);
  EXPECT_NEAR(bench.face(0), 0, 1e-9);
  EXPECT_NEAR(bench.machine.spindle().angle, 30, 1e-9);
  setBit(bench, "$MNS_MEA_FUNCTION_MASK", 3, false);
  EXPECT_NEAR(bench.face(0), 0.1 - 0.1 * std::cos(radiansFromDegrees(30)), 1e-9);
}

TEST(SteeringData, Sd54740Bit0RepeatsWhatExceedsTheSafeArea) {
  SteeredBench bench(block());
  const NamedNumbers call = with(SteeredBench::touching(0, 1), {{"S_SETV", 3}, {"S_TSA", 1}});
  const auto touches = [&] {
    bench.start({-40, 30, -10});
    bench.watch();
    EXPECT_EQ(bench.alarmOf("CYCLE978", call), "61303");
    return bench.countOf(PathKind::Measure);
  };
  EXPECT_EQ(touches(), 1U);
  setBit(bench, "$SNS_MEA_FUNCTION_MASK", 0, true);
  EXPECT_EQ(touches(), 5U) << "four repetitions";
  EXPECT_EQ(bench.stops(), 0U);
  EXPECT_EQ(bench.messages().find("61303"), std::string::npos);
  setBit(bench, "$SNS_MEA_FUNCTION_MASK", 1, true);
  EXPECT_EQ(touches(), 5U);
  EXPECT_EQ(bench.stops(), 4U) << "NC start before each";
  EXPECT_EQ(bench.messages().rfind("61303 61303 61303 61303", 0), 0U) << bench.messages();
}

TEST(SteeringData, ARepetitionThatFitsEndsTheCycleWell) {
  simulation::Truth truth = block();
  truth.tools[0].probe.repeatability = 0.05;
  SteeredBench bench(truth);
  setBit(bench, "$SNS_MEA_FUNCTION_MASK", 0, true);
  int repeated = 0, refused = 0;
  for (int i = 0; i < 40; ++i) {
    bench.start({-40, 30, -10});
    bench.watch();
    const std::string alarm = bench.alarmOf(
        "CYCLE978", with(SteeredBench::touching(0, 1), {{"S_MVAR", 100}, {"S_KNUM", 2}, {"S_TSA", 0.05}}));
    if (!alarm.empty()) {
      ++refused;
      continue;
    }
    repeated += bench.countOf(PathKind::Measure) > 1;
    EXPECT_LE(std::abs(bench.ovr(16)), 0.05);
    EXPECT_EQ(bench.control.journal.cycles.back().results.front().name, "_OVI[2]");
  }
  // One in three touches is further off than its standard deviation; five in a row are not.
  EXPECT_GT(repeated, 4);
  EXPECT_LE(refused, 2);
}

TEST(SteeringData, RepetitionsFindTheirWayBack) {
  // Round a spigot, along an edge with a protection zone: not straight.
  simulation::Truth spigot = perfectWorld();
  place(spigot, simulation::RoundBar(20, -40, 0), translation({0, 0, table}));
  SteeredBench round(spigot);
  setBit(round, "$SNS_MEA_FUNCTION_MASK", 0, true);
  round.start({30, 0, -10});
  EXPECT_EQ(round.alarmOf("CYCLE979", {{"S_MVAR", 2}, {"S_SETV", 42}, {"S_FA", 5}, {"S_TSA", 1}, {"S_INCA", 110}}),
            "61303");
  SteeredBench edge(block());
  setBit(edge, "$SNS_MEA_FUNCTION_MASK", 0, true);
  edge.start({-30, 10, -10});
  EXPECT_EQ(edge.alarmOf("CYCLE998", {{"S_MVAR", 101005},
                                      {"S_SETV", 20},
                                      {"S_STA1", 5},
                                      {"S_FA", 8},
                                      {"S_TSA", 1},
                                      {"S_MA", 201},
                                      {"S_MD", 1},
                                      {"S_ID", 60}}),
            "61303");
}

class ToolBench : public SteeredBench {
public:
  explicit ToolBench(const simulation::Truth& truth) : SteeredBench(truth) {
    control.data.set("$TC_TP2", {7}, std::string("MILL"));
    set("$TC_DP1", {7, 1}, 120);
    set("$TC_DP6", {7, 1}, 10);
  }
  double corrected(const NamedNumbers& changed) {
    start({-40, 30, -10});
    watch();
    run("CYCLE978", with(with(touching(0, 1), {{"S_MVAR", 200}, {"S_KNUM1", 1}}), changed), {{"S_TNAME", "MILL"}});
    return data("$TC_DP15", {7, 1});
  }
};

TEST(SteeringData, Sd54740Bit0RepeatsWhatExceedsTheDimensionalDifference) {
  ToolBench bench(block({0.3, 0, table}));
  setBit(bench, "$SNS_MEA_FUNCTION_MASK", 0, true);
  EXPECT_EQ(bench.corrected({{"S_TDIF", 0.2}}), 0) << "worn out: nothing is corrected";
  EXPECT_EQ(bench.countOf(PathKind::Measure), 5U);
  EXPECT_EQ(bench.messages(), "61306 ");
}

TEST(SteeringData, Sd54740Bit2StopsOutOfTolerance) {
  ToolBench bench(block({0.3, 0, table}));
  const NamedNumbers call = {{"_AMODE", 1}, {"S_TUL", 0.1}, {"S_TLL", -0.1}};
  bench.corrected(call);
  EXPECT_EQ(bench.stops(), 0U);
  setBit(bench, "$SNS_MEA_FUNCTION_MASK", 2, true);
  bench.corrected(call);
  EXPECT_EQ(bench.stops(), 1U);
  bench.corrected({{"S_TDIF", 0.2}});
  EXPECT_EQ(bench.stops(), 2U);
}

TEST(SteeringData, Sd54740Bit3TakesTheBallToTheToolData) {
  simulation::Truth truth = perfectWorld();
  truth.tools[0].probe.pretravel = 0.01;
  place(truth, simulation::Ring(20, 60, -40), translation({0, 0, table}));
  for (const bool taken : {false, true}) {
    SteeredBench bench(truth);
    setBit(bench, "$SNS_MEA_FUNCTION_MASK", 3, taken);
    bench.start({0, 0, -10});
    bench.run("CYCLE976", {{"S_MVAR", 1}, {"S_SETV", 40}, {"S_FA", 8}, {"S_TSA", 3}});
    EXPECT_NEAR(bench.data("$TC_DP6", {1, 1}), taken ? 1.99 : 2, 1e-9);
  }
}

TEST(SteeringData, Sd55622To55625HoldTheMemories) {
  ToolBench bench(block({0.1, 0, table}));
  bench.set("$SCS_MEA_EMPIRIC_VALUE", {4}, 0.04);
  EXPECT_NEAR(bench.corrected({{"S_EVNUM", 5}}), 0.06, 1e-9);
  bench.set("$TC_DP15", {7, 1}, 0);
  bench.set("$SCS_MEA_AVERAGE_VALUE", {1}, 0.02);
  EXPECT_EQ(bench.corrected({{"S_EVNUM", 20000}, {"S_K", 4}, {"S_TMV", 0.5}, {"S_TZL", 0.08}}), 0);
  EXPECT_NEAR(bench.data("$SCS_MEA_AVERAGE_VALUE", {1}), 0.02 - (0.02 - 0.1) / 4, 1e-9);
  const auto alarm = [&](double memories) {
    bench.start({-40, 30, -10});
    return bench.alarmOf(
        "CYCLE978",
        with(SteeredBench::touching(0, 1), {{"S_MVAR", 200}, {"S_KNUM1", 1}, {"S_K", 1}, {"S_EVNUM", memories}}),
        {{"S_TNAME", "MILL"}});
  };
  bench.set("$SCS_MEA_EMPIRIC_VALUE_NUM", {}, 4);
  EXPECT_EQ(alarm(5), "61319");
  EXPECT_EQ(alarm(4), "");
  bench.set("$SCS_MEA_AVERAGE_VALUE_NUM", {}, 2);
  EXPECT_EQ(alarm(30000), "61319");
  EXPECT_EQ(alarm(20000), "");
}

TEST(SteeringData, Md18108And18080SetUpAdditiveOffsets) {
  ToolBench bench(block({0.1, 0, table}));
  const auto alarm = [&](double dl) {
    bench.start({-40, 30, -10});
    return bench.alarmOf("CYCLE978",
                         with(SteeredBench::touching(0, 1), {{"S_MVAR", 200}, {"S_KNUM1", 1000001}, {"S_DLNUM", dl}}),
                         {{"S_TNAME", "MILL"}});
  };
  EXPECT_EQ(alarm(6), "");
  bench.set("$MN_MM_NUM_SUMCORR", {}, 2);
  EXPECT_EQ(alarm(3), "61319");
  EXPECT_EQ(alarm(2), "");
  bench.set("$MN_MM_TOOL_MANAGEMENT_MASK", {}, 0);
  EXPECT_EQ(alarm(2), "61319");
  bench.set("$MN_MM_TOOL_MANAGEMENT_MASK", {}, 256);
  EXPECT_EQ(alarm(2), "");
}

TEST(SteeringData, OvsTnameNamesTheCorrectedTool) {
  ToolBench bench(block({0.1, 0, table}));
  bench.corrected({});
  EXPECT_EQ(bench.control.data.text("_OVS_TNAME", {}), "MILL");
  // A program reads it as a text.
  bench.start({-40, 30, -10});
  bench.run("CYCLE978", with(SteeredBench::touching(0, 1), {{"S_MVAR", 200}, {"S_KNUM1", 1}}), {{"S_TNAME", "MILL"}},
            "IF _OVS_TNAME<>\"MILL\"\nSETAL(65000)\nENDIF\n");
  bench.face(0);
  EXPECT_EQ(bench.control.data.text("_OVS_TNAME", {}), "") << "nothing was corrected";
}

}  // namespace
}  // namespace probewright
