#include "control/sinumerik/measuring_data.hpp"
#include "sinumerik_tools/tool_bench.hpp"

/// CYCLE971 measures mills and drills: planted lengths, radii, run-out and breakage are found, and the tool is
/// corrected as the call says.
namespace probewright {
namespace {

using namespace testing_support;

const NamedNumbers usual = {{"S_PRNUM", 1}, {"S_FA", 3}, {"S_TSA", 2}};
/// The last touch follows the tool by this much in a turn, with the setting data as delivered.
constexpr double accuracy = 0.005;

/// A mill whose teeth run out, in the magazine as tool 2; the control believes that it is a little different.
simulation::TrueTool& plantMill(ToolBench& bench, Planter& plant, double radius, int teeth) {
  simulation::TrueTool& mill = bench.add(2, plant.number(60, 110), radius, teeth);
  mill.cutter.helix = coin(plant) ? 0 : plant.number(-30, 30);
  const double first = plant.number(-180, 180);
  for (int i = 0; i < teeth; ++i) {
    simulation::TrueTooth& tooth = mill.cutter.teeth[static_cast<std::size_t>(i)];
    tooth.angle = first + 360.0 * i / teeth;
    tooth.radial = plant.number(-0.03, 0.03);
    tooth.axial = plant.number(-0.03, 0.03);
  }
  bench.believed(2).length += plant.number(-0.5, 0.5);
  bench.believed(2).radius += plant.number(-0.3, 0.3);
  return mill;
}

double largest(const simulation::TrueTool& tool, double simulation::TrueTooth::*what) {
  double most = -1e9;
  for (const auto& tooth : tool.cutter.teeth)
    most = std::max(most, tooth.*what);
  return most;
}

TEST(MeasureMilledTool, TurningItsLongestAndWidestToothCount) {
  Planter plant(9721);
  for (int world = 0; world < 5; ++world) {
    SCOPED_TRACE(world);
    ToolBench bench;
    world % 2 == 0 ? bench.disc(plant.number(10, 30)) : bench.cuboid(20, 30);
    bench.probe().pretravel = coin(plant) ? 0.004 : 0;
    bench.setup.beliefs.toolProbes = setup::believedToolProbes(bench.setup.world);
    const simulation::TrueTool& mill = plantMill(bench, plant, plant.number(4, 16), whole(plant, 2, 5));
    const double length = mill.length + largest(mill, &simulation::TrueTooth::axial);
    const double radius = mill.radius + largest(mill, &simulation::TrueTooth::radial);
    const bool alongX = coin(plant);

    const ToolRun long_ = bench.measure(beside, with(usual, {{"S_MVAR", 2}, {"S_MA", 3}}));
    EXPECT_LE(long_.ovr(8), length + 1e-6);
    EXPECT_GE(long_.ovr(8), length - accuracy - 1e-6);
    EXPECT_NEAR(long_.ovr(9), long_.ovr(8) - bench.believed(2).length, 1e-9);
    EXPECT_NEAR(long_.written("$TC_DP3[2,1]"), long_.ovr(8), 1e-6);
    EXPECT_EQ(long_.ovi(0), 1);
    // Each touch is expected where the tool as it is believed touches.
    for (const control::TouchRecord& touch : long_.cycle().touches)
      EXPECT_NEAR(touch.direction.dot(touch.surface - touch.target), bench.believed(2).length - long_.ovr(8), 0.1);
    ASSERT_FALSE(long_.cycle().touches.empty());
    EXPECT_EQ(long_.ovi(8), 2);

    const ToolRun wide =
        bench.measure(beside, with(usual, {{"S_MVAR", 2}, {"S_MA", alongX ? 1 : 2}, {"S_MD", world % 3}}));
    EXPECT_LE(wide.ovr(10), radius + 1e-6);
    EXPECT_GE(wide.ovr(10), radius - accuracy - 1e-6);
    EXPECT_NEAR(wide.ovr(11), wide.ovr(10) - bench.believed(2).radius, 1e-9);
    EXPECT_NEAR(wide.written("$TC_DP6[2,1]"), wide.ovr(10), 1e-6);
  }
}

TEST(MeasureMilledTool, StandingTheToothThatStandsThereCounts) {
  Planter plant(9722);
  for (int world = 0; world < 8; ++world) {
    SCOPED_TRACE(world);
    ToolBench bench;
    bench.cuboid(8, 8);
    simulation::TrueTool& mill = plantMill(bench, plant, plant.number(8, 16), 4);
    mill.cutter.helix = 0;
    // The teeth stand along the axes when the spindle does at 0.
    for (int i = 0; i < 4; ++i)
      mill.cutter.teeth[static_cast<std::size_t>(i)].angle = 90.0 * i;
    bench.believed(2).radius = mill.radius;
    // The tool comes from the minus side of X: its tooth at +X touches.
    const int quarter = whole(plant, 0, 3);
    const auto& tooth = mill.cutter.teeth[static_cast<std::size_t>((4 - quarter) % 4)];
    const std::string spos = fmt::format("SPOS={}\n", 90 * quarter);
    const ToolRun left =
        bench.run(2, beside,
                  spos + ToolBench::call(with(usual, {{"S_MVAR", 1}, {"S_MA", 103}})) + spos + "G0 Z=$AA_IM[Z]\n" +
                      ToolBench::call(with(usual, {{"S_MVAR", 1}, {"S_MA", 1}, {"S_MD", 1}})));
    ASSERT_EQ(left.code(), "");
    EXPECT_NEAR(left.written("$TC_DP3[2,1]"), mill.length + tooth.axial, 1e-5);
    EXPECT_NEAR(left.written("$TC_DP6[2,1]"), mill.radius + tooth.radial, 1e-5);
  }
}

TEST(MeasureMilledTool, EachEdgeInItsOrder) {
  Planter plant(9723);
  for (int world = 0; world < 8; ++world) {
    SCOPED_TRACE(world);
    ToolBench bench;
    // The contact is small enough to feel one edge alone.
    world % 2 == 0 ? bench.disc(8) : bench.cuboid(8, 10);
    // A signal needs the contact to be pushed, which takes turns; the edge that pushes it is the same.
    bench.probe().pretravel = world % 3 == 0 ? 0.003 : 0;
    bench.setup.beliefs.toolProbes = setup::believedToolProbes(bench.setup.world);
    const int teeth = whole(plant, 2, 5);
    simulation::TrueTool& mill = plantMill(bench, plant, plant.number(9, 16), teeth);
    // One edge stands out clearly, so that it is the first to touch.
    const int widest = whole(plant, 0, teeth - 1);
    mill.cutter.teeth[static_cast<std::size_t>(widest)].radial = 0.05;
    for (const bool length : {true, false}) {
      const ToolRun left =
          bench.measure(beside, with(usual, {{"S_MVAR", 102}, {"S_MA", length ? 103 : 1}, {"S_MD", 0}}));
      const auto value = [&](int edge) {
        const auto& tooth = mill.cutter.teeth[static_cast<std::size_t>((widest + teeth - edge) % teeth)];
        return length ? mill.length + tooth.axial : mill.radius + tooth.radial;
      };
      double most = 0, least = 1e9;
      for (int edge = 0; edge < teeth; ++edge) {
        most = std::max(most, value(edge));
        least = std::min(least, value(edge));
        EXPECT_NEAR(left.ovr((length ? 300 : 100) + edge), value(edge), 2e-5) << edge;
        EXPECT_NEAR(left.ovr((length ? 400 : 200) + edge),
                    value(edge) - (length ? bench.believed(2).length : bench.believed(2).radius), 2e-5);
      }
      EXPECT_NEAR(left.ovr(length ? 8 : 10), most, 2e-5);
      EXPECT_NEAR(left.ovr(length ? 12 : 14), least, 2e-5);
      EXPECT_NEAR(left.written(length ? "$TC_DP3[2,1]" : "$TC_DP6[2,1]"), most, 2e-5);
      EXPECT_TRUE(std::isnan(left.ovr((length ? 300 : 100) + teeth)));
    }
  }
}

TEST(MeasureMilledTool, NeighbouringEdgesOverAWideContactAreNamed) {
  ToolBench bench;
  bench.disc(30);
  auto& mill = bench.add(2, 80, 6, 2);
  mill.cutter.teeth[1].axial = -0.1;
  const ToolRun left = bench.measure({-45, 3, 25}, with(usual, {{"S_MVAR", 102}, {"S_MA", 103}}));
  EXPECT_TRUE(left.told("longest of those"));
  EXPECT_NEAR(left.ovr(300), 80, 1e-5);
  EXPECT_NEAR(left.ovr(301), 80, 1e-5) << "both edges are above the disc";
}

TEST(MeasureMilledTool, DrillsAndBallsTouchWithTheirHighestPoint) {
  ToolBench bench;
  bench.disc(20);
  auto& drill = bench.add(2, 90, 5, 2);
  drill.cutter.pointAngle = 118;
  bench.believed(2).kind = "drill";
  bench.believed(2).length = 90.4;
  EXPECT_NEAR(bench.measure(above, with(usual, {{"S_MVAR", 1}, {"S_MA", 3}})).written("$TC_DP3[2,1]"), 90, 1e-5);

  // A ball of radius 8: 2 mm above its end it is sqrt(8^2 - 6^2) wide, DZ = 6 lower it is 8.
  ToolBench ball;
  ball.cuboid(20, 20);
  ball.add(2, 90, 8).cutter.cornerRadius = 8;
  const double low = std::sqrt(8 * 8 - 6 * 6);
  EXPECT_NEAR(ball.measure(beside, with(usual, {{"S_MVAR", 1}, {"S_MA", 1}, {"S_TSA", 4}, {"S_FA", 4}})).ovr(10), low,
              1e-5);
  EXPECT_NEAR(ball.measure(beside, with(usual, {{"S_MVAR", 1}, {"S_MA", 1}, {"S_ID", 6}})).ovr(10), 8, 1e-5);
}

TEST(MeasureMilledTool, AProbeCalibratedWithAWrongToolMakesWrongTools) {
  ToolBench bench;
  bench.cuboid(20, 20);
  bench.add(9, 80, 5);
  bench.believed(9).length = 80.03;
  bench.believed(9).radius = 5.02;
  bench.add(2, 95, 6);
  const std::string start = fmt::format("G0 Z{:.6f}\n", bench.contact.z() + 40);
  const ToolRun left = bench.run(9, above,
                                 ToolBench::call(with(usual, {{"S_MVAR", 100000}})) + start + "T2 D1 M6\n" +
                                     fmt::format("G0 X{:.6f} Y{:.6f}\nG0 Z{:.6f}\n", bench.contact.x() - 45,
                                                 bench.contact.y(), bench.contact.z() + 25) +
                                     ToolBench::call(with(usual, {{"S_MVAR", 1}, {"S_MA", 1}})) +
                                     fmt::format("G0 Z{:.6f}\n", bench.contact.z() + 25) +
                                     ToolBench::call(with(usual, {{"S_MVAR", 1}, {"S_MA", 3}})));
  ASSERT_EQ(left.code(), "");
  EXPECT_NEAR(left.written("$TC_DP6[2,1]"), 6.02, 1e-5);
  EXPECT_NEAR(left.written("$TC_DP3[2,1]"), 95.03, 1e-5);
}

TEST(MeasureMilledTool, GeometryOrWear) {
  ToolBench bench;
  bench.disc(20);
  bench.add(2, 80.2, 6);
  bench.believed(2).length = 80;
  bench.datum("$TC_DP12[2,1]", 0.05);
  bench.datum("$SCS_MEA_EMPIRIC_VALUE[3]", 0.02);
  const NamedNumbers length = with(usual, {{"S_MVAR", 1}, {"S_MA", 3}});
  const ToolRun first = bench.measure(above, length);
  EXPECT_NEAR(first.ovr(8), 80.2, 1e-6);
  EXPECT_NEAR(first.ovr(9), 0.15, 1e-6) << "geometry and wear are what the tool was believed to be";
  EXPECT_NEAR(first.written("$TC_DP3[2,1]"), 80.2, 1e-6);
  EXPECT_EQ(first.written("$TC_DP12[2,1]"), 0);
  const ToolRun check = bench.measure(above, with(length, {{"S_KNUM", 1}}));
  EXPECT_NEAR(check.written("$TC_DP12[2,1]"), 0.2, 1e-6);
  EXPECT_TRUE(std::isnan(check.written("$TC_DP3[2,1]")));
  const ToolRun experienced = bench.measure(above, with(length, {{"S_KNUM", 1}, {"S_EVNUM", 4}}));
  EXPECT_NEAR(experienced.written("$TC_DP12[2,1]"), 0.18, 1e-6);
  EXPECT_EQ(experienced.ovr(30), 0.02);
  EXPECT_EQ(experienced.ovi(7), 4);
}

/// A probe that may be touched in the minus directions only has no other trigger points.
TEST(MeasureMilledTool, AtAProbeWithTriggerPointsInMinusDirectionsOnly) {
  ToolBench bench;
  bench.disc(20);
  bench.add(2, 80.2, 6);
  bench.believed(2).length = 80;
  bench.believed(2).radius = 6.1;
  bench.datum("$SNS_MEA_TP_AX_DIR_AUTO_CAL[0]", 111);
  for (const int axis : {1, 2})
    bench.datum(fmt::format("$SNS_MEA_TP_TRIG_PLUS_DIR_AX{}[0]", axis), 0);
  EXPECT_NEAR(bench.measure(above, with(usual, {{"S_MVAR", 1}, {"S_MA", 3}})).ovr(8), 80.2, 1e-5);
  const ToolRun wide = bench.measure({45, 3, 25}, with(usual, {{"S_MVAR", 1}, {"S_MA", 1}, {"S_MD", 0}}));
  EXPECT_NEAR(wide.written("$TC_DP6[2,1]"), 6, 1e-5);
}

TEST(MeasureMilledTool, LimitsDecideWhatIsCorrected) {
  ToolBench bench;
  bench.disc(20);
  bench.add(2, 80.2, 6);
  bench.believed(2).length = 80;
  const NamedNumbers length = with(usual, {{"S_MVAR", 1}, {"S_MA", 3}});
  const auto corrected = [&](const NamedNumbers& more) {
    const ToolRun left = bench.run(2, above, ToolBench::call(with(length, more)));
    return std::pair(!std::isnan(left.written("$TC_DP3[2,1]")), left.code() + left.messages());
  };
  EXPECT_EQ(corrected({{"S_TZL", 0.19}, {"S_TDIF", 0.21}}), std::pair(true, std::string()));
  EXPECT_EQ(corrected({{"S_TZL", 0.21}}), std::pair(false, std::string()));
  EXPECT_EQ(corrected({{"S_TDIF", 0.19}}), std::pair(false, std::string("61306 ")));
  EXPECT_EQ(corrected({{"S_TSA", 0.19}}).second.substr(0, 5), "61303");
  EXPECT_FALSE(corrected({{"S_TSA", 0.19}}).first);
  const ToolRun shown = bench.measure(above, with(length, {{"S_TZL", 0.01}, {"S_TDIF", 0.5}}));
  EXPECT_EQ(shown.ovr(27), 0.01);
  EXPECT_EQ(shown.ovr(28), 2);
  EXPECT_EQ(shown.ovr(29), 0.5);
}

TEST(MeasureMilledTool, MeasuresAgainWhereTheMachineDoes) {
  ToolBench bench;
  bench.disc(20);
  bench.add(2, 80.2, 6);
  bench.believed(2).length = 80;
  bench.datum("$SNS_MEA_FUNCTION_MASK", 65536 + 262144);  // bits 16 and 18
  const ToolRun left = bench.run(2, above, ToolBench::call(with(usual, {{"S_MVAR", 1}, {"S_MA", 3}, {"S_TDIF", 0.1}})));
  EXPECT_EQ(left.code(), "");
  EXPECT_EQ(left.cycle().touches.size(), 5U) << "once, and four times more";
  EXPECT_TRUE(left.told("permissible dimensional difference"));
  // The bits of workpiece measurement do nothing here.
  bench.datum("$SNS_MEA_FUNCTION_MASK", 1);
  EXPECT_EQ(bench.run(2, above, ToolBench::call(with(usual, {{"S_MVAR", 1}, {"S_MA", 3}, {"S_TDIF", 0.1}})))
                .cycle()
                .touches.size(),
            1U);
}

TEST(MeasureMilledTool, ABrokenEdgeIsNamedAndTheLongestCounts) {
  ToolBench bench;
  bench.disc(8);
  auto& mill = bench.add(2, 80.05, 12, 4);
  mill.cutter.teeth[2].axialWear = 0.8;
  mill.cutter.teeth[1].radial = 0.02;
  bench.believed(2).length = 80;
  const NamedNumbers edges = with(usual, {{"S_MVAR", 102}, {"S_MA", 103}});
  const ToolRun worn = bench.measure(beside, with(edges, {{"S_TDIF", 0.3}}));
  EXPECT_NE(worn.messages().find("61306"), std::string::npos);
  EXPECT_TRUE(worn.told("of edge 4")) << "the first is the one that stands out, the others follow";
  EXPECT_NEAR(worn.written("$TC_DP3[2,1]"), 80.05, 1e-5);
  EXPECT_NEAR(worn.ovr(13), -0.75, 1e-5);
  const ToolRun unsafe = bench.run(2, beside, ToolBench::call(with(edges, {{"S_TSA", 0.5}})));
  EXPECT_EQ(unsafe.code(), "61303");
  EXPECT_NEAR(unsafe.written("$TC_DP3[2,1]"), 80.05, 1e-5);
}

TEST(MeasureMilledTool, InWorkpieceCoordinates) {
  ToolBench bench;
  bench.disc(20);
  bench.zeroOffset({100, 10, -430});
  bench.add(2, 80.2, 6.1);
  bench.believed(2).length = 80;
  bench.believed(2).radius = 6;
  const auto place = [&](double x, double z) {
    return fmt::format("G0 X{:.6f} Y{:.6f}\nG0 Z{:.6f}\n", bench.contact.x() - 100 + x, bench.contact.y() - 10,
                       bench.contact.z() + 430 + z);
  };
  const ToolRun left = bench.program("G17 G90 G71 G54\nT2 D1 M6\n" + place(-40, 25) +
                                     ToolBench::call(with(usual, {{"S_MVAR", 11}, {"S_MA", 3}})) + place(-40, 25) +
                                     ToolBench::call(with(usual, {{"S_MVAR", 11}, {"S_MA", 1}})) + "M30\n");
  ASSERT_EQ(left.code(), "");
  EXPECT_NEAR(left.written("$TC_DP3[2,1]"), 80.2, 1e-5);
  EXPECT_NEAR(left.written("$TC_DP6[2,1]"), 6.1, 1e-5);
}

/// A system that is turned about the tool's axis: its sides are where its axes meet the contact.
TEST(MeasureMilledTool, InATurnedWorkpieceSystem) {
  Planter plant(9724);
  for (int world = 0; world < 3; ++world) {
    SCOPED_TRACE(world);
    const double angle = plant.number(-170, 170), size = plant.number(10, 20);
    ToolBench bench;
    bench.disc(size);
    bench.zeroOffset({60, -20, -440});
    bench.setup.beliefs.zeroOffsets.back().rotation = {0, 0, angle};
    Pose machineFromWorkpiece = translation({60, -20, -440}) * rotation(Vector3::UnitZ(), angle);
    const Vector3 at = machineFromWorkpiece.inverse() * bench.contact;
    const auto near = [&](const char* name, double value) {
      bench.datum(fmt::format("$SNS_MEA_TPW_TRIG_{}[0]", name), value + plant.number(-0.3, 0.3));
    };
    near("MINUS_DIR_AX1", at.x() + size / 2);
    near("PLUS_DIR_AX1", at.x() - size / 2);
    near("MINUS_DIR_AX2", at.y() + size / 2);
    near("PLUS_DIR_AX2", at.y() - size / 2);
    near("MINUS_DIR_AX3", at.z());
    bench.datum("$SNS_MEA_TPW_EDGE_DISK_SIZE[0]", size);
    bench.add(9, 80, 5);
    bench.add(2, 95.3, 7.1);
    bench.believed(2).length = 95;
    bench.believed(2).radius = 7;
    const auto place = [&](double x, double z) {
      return fmt::format("G0 X{:.6f} Y{:.6f}\nG0 Z{:.6f}\n", at.x() + x, at.y(), at.z() + z);
    };
    const ToolRun left = bench.program(
        "G17 G90 G71 G54\nT9 D1 M6\n" + place(0, 25) + ToolBench::call(with(usual, {{"S_MVAR", 100010}})) +
        "SUPA G0 Z0 D0\nT2 D1 M6\n" + place(-40, 25) + ToolBench::call(with(usual, {{"S_MVAR", 11}, {"S_MA", 3}})) +
        place(-40, 25) + ToolBench::call(with(usual, {{"S_MVAR", 11}, {"S_MA", 1}})) + "M30\n");
    ASSERT_EQ(left.code(), "");
    EXPECT_NEAR(left.written("$SNS_MEA_TPW_TRIG_PLUS_DIR_AX1[0]"), at.x() - size / 2, 1e-5);
    EXPECT_NEAR(left.written("$TC_DP3[2,1]"), 95.3, 1e-5);
    EXPECT_NEAR(left.written("$TC_DP6[2,1]"), 7.1, 1e-5);
  }
}

TEST(MeasureMilledTool, ATiltedSystemIsRefused) {
  ToolBench bench;
  bench.disc(20);
  bench.add(2, 95, 6);
  const std::string call = ToolBench::call(with(usual, {{"S_MVAR", 11}, {"S_MA", 3}}));
  EXPECT_EQ(bench.run(2, above, "ROT X10\n" + call).code(), "61330");
  EXPECT_EQ(bench.run(2, above, call).code(), "");
  // Machine coordinates have no frame.
  EXPECT_EQ(bench.run(2, above, "ROT X10\n" + ToolBench::call(with(usual, {{"S_MVAR", 1}, {"S_MA", 3}}))).code(), "");
}

/// A signal that comes late is the same when calibrating and measuring, as long as the feed is.
TEST(MeasureMilledTool, OneFeedTakesOutTheDelayOfTheSignal) {
  ToolBench bench;
  bench.cuboid(20, 20);
  bench.probe().signalDelay = 0.002;
  bench.add(9, 80, 5);
  bench.add(2, 95.1, 6);
  bench.believed(2).length = 95;
  const auto measured = [&](double feed) {
    const ToolRun left = bench.run(9, above,
                                   ToolBench::call(with(usual, {{"S_MA", 3}, {"S_VMS", 300}})) +
                                       fmt::format("G0 Z{:.6f}\n", bench.contact.z() + 40) + "T2 D1 M6\n" +
                                       fmt::format("G0 X{:.6f} Y{:.6f}\nG0 Z{:.6f}\n", bench.contact.x(),
                                                   bench.contact.y(), bench.contact.z() + 25) +
                                       ToolBench::call(with(usual, {{"S_MVAR", 1}, {"S_MA", 3}, {"S_VMS", feed}})));
    EXPECT_EQ(left.code(), "");
    return left.written("$TC_DP3[2,1]");
  };
  EXPECT_NEAR(measured(0), 95.1, 1e-5) << "that of the calibration";
  EXPECT_NEAR(measured(600), 95.1 - 300.0 / 60 * 0.002, 1e-5);
}

/// An axis that travels further than it reads is wrong by the difference of the lengths.
TEST(MeasureMilledTool, AnErrorOfTheScaleCountsOverTheDifferenceToThePin) {
  ToolBench bench;
  bench.cuboid(20, 20);
  bench.setup.world.truth.errors.axes.resize(3);
  bench.setup.world.truth.errors.axes[2].scale = 1e-4;
  bench.add(9, 60, 5);
  bench.add(2, 110, 6);
  // Where the scale makes the contact appear, it is found by calibrating.
  const ToolRun left = bench.run(9, above,
                                 ToolBench::call(with(usual, {{"S_MA", 3}})) +
                                     fmt::format("G0 Z{:.6f}\n", bench.contact.z() + 60) + "T2 D1 M6\n" +
                                     fmt::format("G0 X{:.6f} Y{:.6f}\nG0 Z{:.6f}\n", bench.contact.x(),
                                                 bench.contact.y(), bench.contact.z() + 25) +
                                     ToolBench::call(with(usual, {{"S_MVAR", 1}, {"S_MA", 3}})));
  ASSERT_EQ(left.code(), "");
  // The axis reads the way of 50 mm, by which the spindle stands higher, too small by 50 * 1e-4 / (1 + 1e-4).
  EXPECT_NEAR(left.written("$TC_DP3[2,1]"), 110 - 50 * 1e-4 / (1 + 1e-4), 2e-6);
}

}  // namespace
}  // namespace probewright
