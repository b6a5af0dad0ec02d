#include "cycles_heidenhain/worlds.hpp"

/// Cycles while cycle 11 or 26 scales the coordinates: features come out scaled as a whole, ball radius included.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6;

/// A hole of 30 mm at X50 Y40, a wall at Y-30 and a top face at Z0. The TNC 640 is told to measure all the same.
Bench scaledBench(ControlKind kind) {
  Bench bench(kind);
  bench.preset(1, {0, 0, -400});
  bench.believedProbe().maximumTravel = 12;
  bench.part(simulation::Ring(15, 25, -40), pose({50, 40, -400}));
  bench.part(simulation::Box({-60, -30, -40}, {10, 0, 0}), pose({0, 0, -400}));
  if (kind == ControlKind::TNC640) bench.setup.beliefs.parameters["refuseTransformations"] = {0.0, {}};
  return bench;
}

Words hole(double s) {
  return {{273, 50 / s}, {274, 40 / s}, {262, 30 / s}, {325, 0}, {247, 90}, {261, -8 / s}, {320, 0}, {260, 20 / s},
          {301, 0},      {275, 0},      {276, 0},      {279, 0}, {280, 0},  {281, 0},      {309, 0}, {330, 0}};
}
Words coordinate(double s, int axis) {
  return {{263, -20 / s},
          {264, axis == 3 ? -15 / s : -30 / s},
          {261, axis == 3 ? 0 : -8 / s},
          {320, 0},
          {272, axis},
          {267, axis == 3 ? -1 : 1},
          {260, 20 / s},
          {281, 0},
          {288, 0},
          {289, 0},
          {309, 0},
          {330, 0}};
}

TEST(Scaling, LeavesFeaturesScaledWithTheBall) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    for (const double s : {0.5, 0.98, 2.0}) {
      SCOPED_TRACE(fmt::format("{}, SCL {}", control::name(kind), s));
      const Bench bench = scaledBench(kind);
      const std::string scale = fmt::format("CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL {}\n", s);
      const Ran circle = bench.run(scale + probe(421, hole(s)));
      ASSERT_TRUE(circle.finished()) << circle.why();
      EXPECT_NEAR(circle.q(151), 50 / s, exact);
      EXPECT_NEAR(circle.q(152), 40 / s, exact);
      EXPECT_NEAR(circle.q(153), 30 / s, exact);
      for (const int axis : {2, 3}) {
        const Ran face = bench.run(scale + probe(427, coordinate(s, axis)));
        ASSERT_TRUE(face.finished()) << face.why();
        EXPECT_NEAR(face.q(160), (axis == 2 ? -30 : 0) / s, exact);
      }
      const Ran single =
          bench.run(scale + fmt::format("TCH PROBE 0.0 REF. PLANE Q5 Y+\nTCH PROBE 0.1 X{:+.6f} Y{:+.6f} Z{:+.6f}\n",
                                        -20 / s, -38 / s, -8 / s));
      ASSERT_TRUE(single.finished()) << single.why();
      EXPECT_NEAR(single.q(5), -30 / s, exact);
      // The reference point of the tool, whose length is not taken into account.
      EXPECT_NEAR(single.q(117), (-8 + bench.setup.beliefs.tools.front().length) / s, exact);
    }
  }
}

TEST(Scaling, CountsInTheAxisThatCycle26Scales) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    const Bench bench = scaledBench(kind);
    const std::string scale = "CYCL DEF 26.0 AXIS SCALING\nCYCL DEF 26.1 X1 Y0.5 Z2\n";
    for (const int axis : {2, 3}) {
      Words words = coordinate(1, axis);
      words = with(words, {{264, axis == 3 ? -30 : -60}, {261, axis == 3 ? 0 : -4}, {260, 10}});
      const Ran face = bench.run(scale + probe(427, words));
      ASSERT_TRUE(face.finished()) << face.why();
      EXPECT_NEAR(face.q(160), axis == 2 ? -60 : 0, exact);
    }
  }
}

TEST(Scaling, GivesTheBallCentreOfCycles3And4) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Bench bench = scaledBench(kind);
    bench.setup.beliefs.parameters.erase("refuseTransformations");
    const double ball = bench.believedProbe().radius;
    const std::string before = "CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 2\nL X-10 Y-7.5 R0 FMAX\nL Z+4 R0 FMAX\n";
    for (const char* cycle : {"TCH PROBE 3.0 MEASURING\nTCH PROBE 3.1 Q10\nTCH PROBE 3.2 Z ANGLE: +180\n"
                              "TCH PROBE 3.3 DIST +10 F100 MB1 REFERENCE SYSTEM: 0\n",
                              "TCH PROBE 4.0 MEASURING IN 3-D\nTCH PROBE 4.1 Q10\nTCH PROBE 4.2 IZ-1\n"
                              "TCH PROBE 4.3 ABST+10 F100 MB1 REFERENCE SYSTEM:0\n"}) {
      const Ran ran = bench.run(before + cycle);
      ASSERT_TRUE(ran.finished()) << ran.why();
      EXPECT_EQ(ran.q(13), 1);
      EXPECT_NEAR(ran.q(10), -10, exact);
      EXPECT_NEAR(ran.q(11), -7.5, exact);
      EXPECT_NEAR(ran.q(12), ball / 2, exact);
    }
  }
}

/// SET_UP and DIST are lengths of the machine: a wall 11 mm off is out of reach of 10 mm at any scale.
TEST(Scaling, LeavesTheLongestStrokeAsItIs) {
  for (const double off : {9.0, 11.0}) {
    Bench bench = scaledBench(ControlKind::iTNC530);
    bench.believedProbe().maximumTravel = 10 + bench.believedProbe().setUpClearance;
    Words words = coordinate(2, 2);
    words = with(words, {{264, (-30 - off) / 2}});
    const Ran ran = bench.run("CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 2\n" + probe(427, words));
    if (off < 10) {
      ASSERT_TRUE(ran.finished()) << ran.why();
      EXPECT_NEAR(ran.q(160), -15, exact);
    } else {
      EXPECT_EQ(ran.alarm(), "Touch point inaccessible");
      EXPECT_NE(ran.why().find("within 12.000 mm"), std::string::npos) << ran.why();
      EXPECT_NE(ran.why().find("MP6130"), std::string::npos) << ran.why();
    }
  }
}

TEST(Scaling, IsRefusedByCalibrations) {
  Bench bench(ControlKind::iTNC530);
  bench.preset(1, {0, 0, -400});
  bench.part(simulation::SolidSphere({0, 0, 0}, 12), pose({0, 0, -400}));
  const Ran ran = bench.run("CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 0.5\nL X+0 Y+0 R0 FMAX\nL Z+34 R0 FMAX\n" +
                            probe(460, {{407, 12}, {320, 0}, {301, 1}, {423, 4}, {380, 0}, {433, 0}, {434, 0}}));
  EXPECT_EQ(ran.alarm(), "Coordinate transformation not permitted");
  EXPECT_EQ(ran.touches(), 0U);
}

}  // namespace
}  // namespace probewright::testing_support
