#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "sinumerik/world.hpp"

/// Feeds of paths and speeds of the spindle.
namespace probewright::language::sinumerik {
namespace {

TEST(SinumerikFeeds, FeedMustBeProgrammed) {
  World world;
  EXPECT_EQ(world.alarm("G1 X10\n"), "10860");
  EXPECT_EQ(world.alarm("G95 G1 X10 F0.1\n"), "10860");
  // Which of the two is missing is said.
  for (const auto& [block, missing] :
       {std::pair("G95 G1 X10\n", "no feed"), {"G95 G1 X10 F0.1\n", "turning spindle"}, {"G94 G1 X10\n", "no feed"}}) {
    World without;
    const execution::RunResult result = without.tryRun(block);
    ASSERT_FALSE(result.diagnostics.empty()) << block;
    EXPECT_NE(result.diagnostics[0].message.find(missing), std::string::npos) << result.diagnostics[0].message;
  }
  world.run("S1000 M3 G95 F0.2\nG1 X20\n");
  EXPECT_EQ(world.machine.moves.back().feed.perMinute, 200);
  // A taper thread from X20 Z0: 2 mm along Z with each of 1000 turns a minute, 20 mm down and 10 aside.
  world.run("G33 X30 Z-20 K2\nG95 G1 X20\n");
  EXPECT_NEAR(world.machine.moves[world.machine.moves.size() - 2].feed.perMinute, 2000 * std::sqrt(500) / 20, 1e-9);
  EXPECT_EQ(world.alarm("X1 Q5\n"), "12080") << "the machine has no axis Q";
  for (const char* block : {"TRANS U5", "ATRANS X1 B2", "SCALE Q2", "MIRROR U0", "G58 U3"})
    EXPECT_EQ(world.alarm(fmt::format("{}\n", block)), "12080") << block;
  world.run("TRANS X1 U0\nSCALE X1 Q1\nTRANS\n");
}

TEST(SinumerikFeeds, ConstantCuttingSpeedTurnsTheSpindleByTheDiameter) {
  World world("lathe2c");
  const auto feed = [&world] { return world.machine.moves.back().feed.perMinute; };
  const auto turns = [](double metres, double diameter) { return 1000 * metres / (std::numbers::pi * diameter); };
  // A line along Z: the diameter stays. LIMS and S in any order of the block.
  world.run("DIAMON G0 X80 Z5\nS120 LIMS=3000 G96 M4 F0.2\nG1 Z0\n");
  EXPECT_NEAR(feed(), 0.2 * turns(120, 80), 1e-9);
  // Across: the time is that of the middle diameter.
  world.run("G1 X40\n");
  EXPECT_NEAR(feed(), 0.2 * turns(120, 60), 1e-9);
  world.run("G1 X0\n");
  EXPECT_NEAR(feed(), 0.2 * turns(120, 20), 1e-9);
  world.run("G1 Z-1\n");
  EXPECT_EQ(feed(), 0.2 * 3000) << "at the turning centre LIMS holds";
  // G97 keeps the speed that the spindle has; feeds per minute take no notice.
  world.run("G0 X100\nG97\nG1 X50\n");
  EXPECT_NEAR(feed(), 0.2 * turns(120, 100), 1e-9);
  world.run("G961 S60 F150\nG1 X60\n");
  EXPECT_EQ(feed(), 150);
  world.run("G0 X20 S1000 G971\nG95 F0.1\nG1 X10\n");
  EXPECT_EQ(feed(), 100);
}

TEST(SinumerikFeeds, SpeedsOfOtherSpindlesAreNoConcernOfTheFeed) {
  World world;
  world.run("S1000 M3 S2=50 M2=4 G95 F0.2\nG1 X20\n");
  EXPECT_EQ(world.machine.moves.back().feed.perMinute, 200);
  world.run("S1=500 M1=3 G95 F0.2\nG1 X30\n");
  EXPECT_EQ(world.machine.moves.back().feed.perMinute, 100);
}

/// A feed stays while its kind does: a time, per minute or per revolution.
TEST(SinumerikFeeds, KeepsTheFeedWhileItsKindStays) {
  const std::pair<int, int> kinds[] = {{93, 0}, {94, 1}, {961, 1}, {971, 1}, {95, 2}, {96, 2}, {97, 2}};
  for (const auto& [from, kind] : kinds) {
    for (const auto& [to, other] : kinds) {
      World world("lathe2c");
      world.run(fmt::format("G0 X80 Z5\nG{} S100 M4 F0.2\nG{} S100\n", from, to));
      EXPECT_EQ(world.host.motionState().feed, kind == other ? 0.2 : 0) << from << " " << to;
    }
    for (const int keeps : {962, 972}) {
      World world("lathe2c");
      world.run(fmt::format("G0 X80 Z5\nG{} S100 M4 F0.2\nG{} S100\n", from, keeps));
      EXPECT_EQ(world.host.motionState().feed, 0.2) << from << " " << keeps;
      EXPECT_EQ(world.host.motionState().feedType, kind == 1 ? 94 : from) << keeps;
    }
  }
}

/// G973 turns the spindle as fast as before the constant cutting speed, however often that was programmed.
TEST(SinumerikFeeds, TheSpeedBeforeTheConstantCuttingSpeedComesBack) {
  for (const char* cutting : {"G96 S200", "G96 S200\nG96 S150", "G96 S200\nS150", "G961 S200\nG96\nG962 S90"}) {
    World world("lathe2c");
    world.run(std::string("G0 X80 Z5\nG97 S1000 M4\n") + cutting + "\nG0 X60\nG973\n");
    EXPECT_EQ(world.host.motionState().spindleSpeed, 1000) << cutting;
    EXPECT_FALSE(world.host.motionState().constantCuttingSpeed) << cutting;
  }
}

/// M3 begins with the speed of its block, wherever that stands, and not with the one before.
TEST(SinumerikFeeds, TheSpindleBeginsWithTheSpeedOfItsBlock) {
  for (const char* block : {"M3 S900", "S900 M3", "S1=900 M1=3", "M1=3 S1=900", "M3 S1=900"}) {
    World world;
    world.run(std::string("S500\n") + block + "\n");
    ASSERT_FALSE(world.machine.spindleOrders.empty()) << block;
    // The end of the program stops it.
    for (const machine::SpindleState& order : world.machine.spindleOrders)
      EXPECT_EQ(order.speed, order.rotation == machine::Rotation::None ? 0 : 900) << block;
  }
}

TEST(SinumerikFeeds, DwellSpindleAndSwitches) {
  World world;
  world.run("G4 F2.5\nS60 M3\nG4 S3\nSPOS=90\n");
  EXPECT_NEAR(world.machine.seconds(), 2.5 + 3, 1e-12);
  EXPECT_EQ(world.machine.spindle().angle, 90);
  world.run("SPOS=IC(-20)\nSPOS=IC(35)\n");
  EXPECT_NEAR(world.machine.spindle().angle, 105, 1e-12);
  world.run("DEF INT ERR=5\nWRITE(ERR,\"/_N_WKS_DIR/LOG_MPF\",\"x=\"<<1)\nWRITE(ERR,\"LOG_MPF\",\"y\")\nR1=ERR\nM0\n");
  EXPECT_EQ(world.control.panel.files().at("LOG_MPF"), "x=1\ny\n");
  EXPECT_EQ(world.r(1), 0);
}

}  // namespace
}  // namespace probewright::language::sinumerik
