#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "sinumerik/world.hpp"

/// Where the axes go, held against the geometry that the blocks describe.
namespace probewright::language::sinumerik {
namespace {

Vector3 tipOf(World& world, std::size_t move) {
  return world.control.channel.programFromAxes(world.machine.moves.at(move).to).vector();
}

Vector3 lastTip(World& world) { return world.control.channel.position().vector(); }

TEST(SinumerikMotion, StraightLinesInEveryWayOfWriting) {
  World world;
  world.run("G0 X10 Y20 Z30\n");
  EXPECT_TRUE(world.machine.moves[0].feed.rapid);
  EXPECT_EQ(lastTip(world), Vector3(10, 20, 30));
  world.run("G1 X=5*2+1 F500\n");
  EXPECT_EQ(world.machine.moves[1].feed.perMinute, 500);
  EXPECT_EQ(lastTip(world), Vector3(11, 20, 30));
  world.run("R1=$P_GG[1]\nG0 X11\nR2=$P_GG[1] R3=$P_GG[7] R4=$P_GG[14]\n");
  EXPECT_EQ(world.r(1), 2);
  EXPECT_EQ(world.r(2), 1);
  EXPECT_EQ(world.r(3), 1);
  EXPECT_EQ(world.r(4), 1);
  world.run("G91 G1 X1 Y=AC(0)\nG90 Z=IC(-5)\n");
  EXPECT_EQ(lastTip(world), Vector3(12, 0, 25));
  world.run("G70 X1\nG71\n");
  EXPECT_NEAR(lastTip(world).x(), 25.4, 1e-12);
  world.run("G111 X10 Y10\nG0 AP=90 RP=5\n");
  EXPECT_LT((lastTip(world) - Vector3(10, 15, 25)).norm(), 1e-12);
  world.run("AP=IC(90)\n");
  EXPECT_LT((lastTip(world) - Vector3(5, 10, 25)).norm(), 1e-12);
  world.run("FA[X]=600\nPOS[X]=6\n");
  EXPECT_EQ(world.machine.moves.back().feed.perMinute, 600);
  EXPECT_FALSE(world.machine.moves.back().feed.rapid);
  world.run("FA[X]=0\nPOS[X]=5\n");
  EXPECT_TRUE(world.machine.moves.back().feed.rapid) << "no feed of its own again";
  world.run("DEF AXIS AXV=(Y)\nAX[AXV]=3\nPOS[Z]=1\n");
  EXPECT_LT((lastTip(world) - Vector3(5, 3, 1)).norm(), 1e-12);
}

TEST(SinumerikMotion, TheEdgeMayStandInFrontOfTheChange) {
  for (const char* change : {"T=\"MILL\" D1\nM6\n", "T=\"MILL\"\nD1\nM6\n", "T1 D1 M6\n", "T1 M6\nD1\n"}) {
    World world;
    world.run(change + std::string("G0 Z0\n"));
    EXPECT_NEAR(world.machine.moves.back().to[2], 100, 1e-12) << change;
  }
  World world;
  EXPECT_EQ(world.alarm("T1 D9\nM6\n"), "17180");
}

/// By number and by name, also where these are computed.
TEST(SinumerikMotion, ToolsAreCalledByWhatIsComputed) {
  World world;
  world.run("R1=1\nT=R1 M6\n");
  EXPECT_EQ(world.control.tool.number, 1);
  world.run("T=R1+1 M6\n");
  EXPECT_EQ(world.control.tool.number, 2);
  world.run("DEF STRING[8] FIRST_1=\"MI\"\nT=FIRST_1<<\"LL\" M6\n");
  EXPECT_EQ(world.control.tool.number, 1);
}

TEST(SinumerikMotion, DiametersAndRadiiByTheWordItself) {
  World world("lathe2c");
  const auto radius = [&world] { return world.control.channel.position().x(); };
  for (const char* mode : {"DIAMON", "DIAM90", "DIAMOF", "DIAMONA[X]", "DIAM90A[X]", "DIAMOFA[X]"}) {
    SCOPED_TRACE(mode);
    world.machine.moves.clear();
    world.run(std::string(mode) + "\nG0 X=DAC(90) Z=RAC(-5)\nX=RAC(30)\nX=DIC(4)\nX=RIC(-4)\n");
    ASSERT_EQ(world.machine.moves.size(), 4u);
    EXPECT_NEAR(tipOf(world, 0).x(), 45, 1e-12);
    EXPECT_NEAR(tipOf(world, 0).z(), -5, 1e-12) << "Z has no diameter";
    EXPECT_NEAR(tipOf(world, 1).x(), 30, 1e-12);
    EXPECT_NEAR(tipOf(world, 2).x(), 32, 1e-12);
    EXPECT_NEAR(tipOf(world, 3).x(), 28, 1e-12);
  }
  world.run("DIAMON\nDIAMCHANA[X]\nDIAMOFA[Z]\nG0 X50\n");
  EXPECT_EQ(radius(), 25) << "the channel's own diameters stay";
  EXPECT_EQ(world.alarm("X=DAC(\"A\")\n"), "12150");
}

/// D0 before a tool is in the spindle is no edge of the tool to come: that begins with its first.
TEST(SinumerikMotion, ANextToolBeginsWithItsFirstEdge) {
  const std::pair<const char*, double> programs[] = {{"T1\nM6\n", 100},   {"T1\nD0\nM6\n", 100}, {"T1\nD2\nM6\n", 90},
                                                     {"T1\nD2 M6\n", 90}, {"T1\nD0 M6\n", 0},    {"T1\nM6\nD0\n", 0}};
  for (const auto& [program, length] : programs) {
    World world;
    world.run(std::string(program) + "G0 Z10\n");
    EXPECT_EQ(world.machine.moves.back().to[2], 10 + length) << program;
  }
}

/// T0 prepares no tool whose edge could be kept: an edge is refused at once.
TEST(SinumerikMotion, NoToolHasAnEdge) {
  for (const char* program : {"T0\nD1\nG0 Z10\n", "T0\nD2\nT1\nM6\n"}) {
    World world;
    EXPECT_EQ(world.alarm(program), "17180") << program;
  }
  World world;
  world.run("T0\nD0\nG0 Z10\n");
  EXPECT_EQ(world.machine.moves.back().to[2], 10);
}

TEST(SinumerikMotion, FunctionsAreChosenByTheirPlaceInTheGroup) {
  World world;
  world.control.data.load({"$P_UIFR", {2, "X", "TR"}}, 100.0);
  world.control.data.load({"$P_UIFR", {5, "X", "TR"}}, 50.0);
  // What a subprogram changes is brought back by what $P_GG said before.
  world.run(
      "G55 G91 G18\nR1=$P_GG[8] R2=$P_GG[14] R3=$P_GG[6]\nG54 G90 G17\nG[8]=R1 G[14]=R2\nG[6]=R3\n"
      "R4=$P_GG[8] R5=$P_GG[14] R6=$P_GG[6]\n");
  EXPECT_EQ(world.r(4), 3);
  EXPECT_EQ(world.r(5), 2);
  EXPECT_EQ(world.r(6), 2);
  EXPECT_EQ(world.control.frames.settable, 2);
  world.run("G90 G17 G[8]=6\nG0 X1\n");
  EXPECT_EQ(world.machine.moves.back().to[0], 51) << "G505";
  world.control.data.load({"$P_UIFR", {99, "X", "TR"}}, 70.0);
  world.run("G[8]=100\nG0 X2\n");
  EXPECT_EQ(world.machine.moves.back().to[0], 72) << "G599";
  world.run("G[1]=2 F100\nX5\n");
  EXPECT_EQ(world.machine.moves.back().feed.perMinute, 100);
  world.run("G[8]=1\nG0 X1\n");
  EXPECT_EQ(world.machine.moves.back().to[0], 1);
  for (const auto& [code, number] : {std::pair(94, 2), {95, 3}, {961, 7}, {971, 8}, {962, 11}, {972, 12}, {973, 13}}) {
    world.run(fmt::format("G{} S100\nR7=$P_GG[15]\n", code));
    EXPECT_EQ(world.r(7), number) << code;
  }
  for (const int number : {1, 2, 3, 4}) {  // DIAMOF, DIAMON, DIAM90, DIAMCYCOF
    world.run(fmt::format("G[29]={}\nR7=$P_GG[29]\n", number));
    EXPECT_EQ(world.r(7), number);
  }
  const int units[] = {70, 71, 700, 710};
  for (int number = 1; number <= 4; ++number) {
    world.run(fmt::format("G{}\nR7=$P_GG[13]\n", units[number - 1]));
    EXPECT_EQ(world.r(7), number);
    world.run(fmt::format("G710\nG[13]={}\nR7=$P_GG[13]\n", number));
    EXPECT_EQ(world.r(7), number);
  }
  EXPECT_EQ(world.alarm("G[29]=0\n"), "12470");
  EXPECT_EQ(world.alarm("G[29]=5\n"), "12470");
  EXPECT_EQ(world.alarm("G[6]=4\n"), "12470");
  EXPECT_EQ(world.alarm("G[99]=1\n"), "12470");
}

TEST(SinumerikMotion, AxesThatTheMachineHasNotAreRefusedByNumber) {
  World world("lathe2c");
  world.run("G0 X80 Z5\n");
  EXPECT_EQ(world.alarm("G0 Y0\n"), "12080") << "also where the axis would not move";
  EXPECT_EQ(world.alarm("G0 Y5\n"), "12080");
  EXPECT_EQ(world.alarm("G91 G1 X1 Y1 F100\n"), "12080");
}

TEST(SinumerikMotion, ToolLengthAndFramesMakeTheAxesPosition) {
  World world;
  world.control.data.load({"$P_UIFR", {1, "X", "TR"}}, 100.0);
  world.control.data.load({"$P_UIFR", {1, "Z", "TR"}}, -200.0);
  world.control.data.load({"$P_UIFR", {1, "Z", "FI"}}, 0.5);
  world.run("T=\"MILL\" D1 M6\nG54 G0 X10 Y0 Z5\n");
  const auto& axes = world.machine.moves.back().to;
  EXPECT_NEAR(axes[0], 110, 1e-12);
  EXPECT_NEAR(axes[2], 5 - 200 + 0.5 + 100, 1e-12);
  ASSERT_EQ(world.machine.tools.size(), 1u);
  EXPECT_EQ(world.machine.tools[0].number, 1);
  world.run("TRANS X1 Y2\nAROT Z90\nG0 X10 Y0\n");
  // Y of the rotated system points along -X of the workpiece: X10 lies 10 in +Y.
  EXPECT_NEAR(world.machine.moves.back().to[0], 101, 1e-9);
  EXPECT_NEAR(world.machine.moves.back().to[1], 12, 1e-9);
  world.run("MIRROR X0\nG0 X10 Y0\n");
  EXPECT_NEAR(world.machine.moves.back().to[0], 90, 1e-9);
  world.run("SCALE X2\nG0 X10\nTRANS\n");
  EXPECT_NEAR(world.machine.moves.back().to[0], 120, 1e-9);
  world.run("SUPA G0 X1 Z500 D0\n");
  EXPECT_EQ(world.machine.moves.back().to[0], 1);
  EXPECT_EQ(world.machine.moves.back().to[2], 500);
  world.run("G500 D2 G0 X0 Z0\n");
  EXPECT_EQ(world.machine.moves.back().to[0], 0);
  EXPECT_EQ(world.machine.moves.back().to[2], 90);
  EXPECT_EQ(world.alarm("T7 M6\n"), "17190");
  EXPECT_EQ(world.alarm("D9\n"), "17180");
}

TEST(SinumerikMotion, ProgrammedToolOffsetsAddToTheTool) {
  World world;
  world.run("T1 M6\nG0 Z0\nTOFFL=2.5\nZ0\n");
  EXPECT_NEAR(world.machine.moves.back().to[2], 102.5, 1e-12);
  world.run("TOFFL=0\nZ0\n");
  EXPECT_NEAR(world.machine.moves.back().to[2], 100, 1e-12);
}

TEST(SinumerikMotion, AFrameIsAlignedWithTheTool) {
  World world("mill5-table-table");
  const auto& axes = world.machine.description().axes;
  std::size_t tilting = 0;
  while (axes[tilting].kind != machine::AxisKind::Rotary)
    ++tilting;
  world.run("T2 M6\nTRAORI\nG0 " + axes[tilting].name + "20\nTOROT\n");
  EXPECT_LT((world.control.channel.toolAxis() - ProgramWay(0, 0, 1)).norm(), 1e-12);
  const Vector3 before = world.machine.position()[tilting] * Vector3::UnitX();
  const auto start = world.machine.position();
  world.run("G1 Z=IC(10) F100\n");
  // Along the tool: the rotary axes stay, the spindle moves by 10 along its own axis.
  double travelled = 0;
  for (std::size_t i = 0; i < 3; ++i)
    travelled += std::pow(world.machine.position()[i] - start[i], 2);
  EXPECT_NEAR(std::sqrt(travelled), 10, 1e-9);
  EXPECT_NEAR(world.machine.position()[2] - start[2], 10, 1e-9) << "a table tilts the part, the spindle stands";
  EXPECT_EQ(before.x(), world.machine.position()[tilting]);
  world.run("TOROTOF\n");
  EXPECT_GT((world.control.channel.toolAxis() - ProgramWay(0, 0, 1)).norm(), 0.1);
}

TEST(SinumerikMotion, ArcsStayOnTheirCircle) {
  struct Case {
    const char* text;
    Vector3 centre, end;
    double radius, sweepDegrees;  // counterclockwise positive
  };
  const Case cases[] = {
      {"G3 X0 Y10 I-10 J0", {0, 0, 0}, {0, 10, 0}, 10, 90},
      {"G2 X0 Y10 I-10 J0", {0, 0, 0}, {0, 10, 0}, 10, -270},
      {"G2 X10 Y0 I-10 J0", {0, 0, 0}, {10, 0, 0}, 10, -360},
      {"G3 X0 Y10 I=AC(0) J=AC(0)", {0, 0, 0}, {0, 10, 0}, 10, 90},
      {"G3 X0 Y10 CR=10", {0, 0, 0}, {0, 10, 0}, 10, 90},
      {"G3 X0 Y10 CR=-10", {10, 10, 0}, {0, 10, 0}, 10, 270},
      {"G3 AR=90 I-10 J0", {0, 0, 0}, {0, 10, 0}, 10, 90},
      {"G3 X-10 Y0 AR=180", {0, 0, 0}, {-10, 0, 0}, 10, 180},
      {"G3 X0 Y10 Z6 I-10 J0 TURN=1", {0, 0, 0}, {0, 10, 6}, 10, 450},
      {"CIP X-10 Y0 I1=0 J1=10 K1=0", {0, 0, 0}, {-10, 0, 0}, 10, 180},
      {"CIP X-10 Y0 I1=IC(-10) J1=IC(10) K1=0", {0, 0, 0}, {-10, 0, 0}, 10, 180},
      {"G111 X0 Y0\nG3 AP=90 RP=10", {0, 0, 0}, {0, 10, 0}, 10, 90},
      {"G111 X10 Y5\nG2 AP=0 RP=5", {10, 5, 0}, {15, 5, 0}, 5, -270},
  };
  for (const Case& c : cases) {
    World world;
    world.run(std::string("G0 X10 Y0\nF1000\n") + c.text + "\n");
    ASSERT_GT(world.machine.moves.size(), 3u) << c.text;
    double angle = 0, previous = 0;
    for (std::size_t i = 1; i < world.machine.moves.size(); ++i) {
      const Vector3 tip = tipOf(world, i);
      EXPECT_NEAR(std::hypot(tip.x() - c.centre.x(), tip.y() - c.centre.y()), c.radius, 1e-9) << c.text;
      const double now = std::atan2(tip.y() - c.centre.y(), tip.x() - c.centre.x());
      const double from = i == 1 ? std::atan2(0 - c.centre.y(), 10 - c.centre.x()) : previous;
      angle += std::remainder(now - from, 2 * std::numbers::pi);
      previous = now;
    }
    EXPECT_NEAR(angle * 180 / std::numbers::pi, c.sweepDegrees, 1e-6) << c.text;
    EXPECT_LT((lastTip(world) - c.end).norm(), 1e-9) << c.text;
  }
  World world;
  EXPECT_EQ(world.alarm("G0 X10 Y0\nF100 G2 X0 Y11 I-10 J0\n"), "14040");
  EXPECT_EQ(world.alarm("G0 X10 Y0\nF100 G2 X-20 Y0 CR=5\n"), "14040");
  EXPECT_EQ(world.alarm("G0 X10 Y0\nF100 G2 X-20 Y0\n"), "14040");
  for (const char* opening : {"0", "360", "-90", "400"}) {
    EXPECT_EQ(world.alarm(fmt::format("G0 X10 Y0\nF100 G3 X-10 Y0 AR={}\n", opening)), "14040") << opening;
    EXPECT_EQ(world.alarm(fmt::format("G0 X10 Y0\nF100 G3 I-10 J0 AR={}\n", opening)), "14040") << opening;
  }
}

TEST(SinumerikMotion, ATangentialArcLeavesInTheLastDirection) {
  World world;
  world.run("F1000 G1 X0 Y0\nX10\nCT X20 Y10\n");
  // Tangent +X at (10,0), end (20,10): centre (10,10), radius 10.
  for (std::size_t i = 2; i < world.machine.moves.size(); ++i)
    EXPECT_NEAR((tipOf(world, i) - Vector3(10, 10, 0)).norm(), 10, 1e-9);
  EXPECT_LT((lastTip(world) - Vector3(20, 10, 0)).norm(), 1e-9);
  EXPECT_EQ(World().alarm("F1000 CT X20 Y10\n"), "14045") << "nothing moved before";
  EXPECT_EQ(World().alarm("F1000 G1 X10 Y0\nCT X10 Y0\n"), "14045") << "no way to go";
}

TEST(SinumerikMotion, ToolRadiusCompensationKeepsTheDistance) {
  // A square of 40 walked clockwise with the tool (radius 5) on the left: outside, so the path keeps 5 away.
  World world;
  world.run("T1 M6\nG0 X-20 Y-20\nF500\nG41 G1 X0 Y0\nY40\nX40\nY0\nX0\nG40 X-20 Y-20\n");
  const auto distanceToSquare = [](const Vector3& p) {
    const double dx = std::max({-p.x(), 0.0, p.x() - 40}), dy = std::max({-p.y(), 0.0, p.y() - 40});
    return std::hypot(dx, dy);
  };
  ASSERT_GT(world.machine.moves.size(), 8u);
  for (std::size_t i = 1; i + 1 < world.machine.moves.size(); ++i)
    EXPECT_NEAR(distanceToSquare(tipOf(world, i)), 5, 1e-9) << i;
  EXPECT_LT((lastTip(world) - Vector3(-20, -20, 0)).head<2>().norm(), 1e-9);
  EXPECT_LT((tipOf(world, 1) - Vector3(-5, 0, 0)).head<2>().norm(), 1e-9);

  // With G451 outside corners are cut, too, until G450.
  World sharp;
  sharp.run("T1 M6\nG0 X-20 Y-20\nF500\nG451\nG41 G1 X0 Y0\nY40\nX40\nY0\nX0\nG40 X-20 Y-20\n");
  const Vector3 outer[] = {{-5, 0, 0}, {-5, 45, 0}, {45, 45, 0}, {45, -5, 0}, {0, -5, 0}, {-20, -20, 0}};
  ASSERT_EQ(sharp.machine.moves.size(), 7u);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_LT((tipOf(sharp, i + 1) - outer[i]).head<2>().norm(), 1e-9) << i << ": " << tipOf(sharp, i + 1).transpose();
  World rounded;
  rounded.run("T1 M6\nG0 X-20 Y-20\nF500\nG451\nG450\nG41 G1 X0 Y0\nY40\nX40\nY0\nX0\nG40 X-20 Y-20\n");
  ASSERT_EQ(rounded.machine.moves.size(), world.machine.moves.size());
  for (std::size_t i = 0; i < world.machine.moves.size(); ++i)
    EXPECT_LT((tipOf(rounded, i) - tipOf(world, i)).norm(), 1e-9) << i;

  // Inside the square, on the right side: corners are cut, so the path is a square of 30.
  World inside;
  inside.run("T1 M6\nG0 X20 Y20\nF500\nG42 G1 X0 Y10\nY40\nX40\nY0\nX0\nY10\nG40 X20 Y20\n");
  const Vector3 corners[] = {{5, 10, 0}, {5, 35, 0}, {35, 35, 0}, {35, 5, 0}, {5, 5, 0}, {5, 10, 0}, {20, 20, 0}};
  ASSERT_EQ(inside.machine.moves.size(), 8u);
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_LT((tipOf(inside, i + 1) - corners[i]).head<2>().norm(), 1e-9)
        << i << ": " << tipOf(inside, i + 1).transpose();

  // A full circle of radius 20 from outside: radius 25.
  World round;
  round.run("T1 M6\nG0 X40 Y0\nF500\nG42 G1 X20 Y0\nG3 X20 Y0 I-20 J0\nG40 G1 X40 Y0\n");
  for (std::size_t i = 1; i + 1 < round.machine.moves.size(); ++i)
    EXPECT_NEAR(tipOf(round, i).head<2>().norm(), 25, 1e-9);
  // What the machine does by an M function of its builder waits for the way that compensation still holds back.
  World builder;
  builder.machine.has.push_back(100);
  builder.run("T1 M6\nG0 X-20 Y-20\nF500\nG41 G1 X0 Y0\nY40\nM100\nX40\nG40 X60 Y60\n");
  ASSERT_EQ(builder.machine.functions, std::vector<int>{100});
  ASSERT_GE(builder.machine.movesBefore[0], 3U);
  EXPECT_NEAR(tipOf(builder, builder.machine.movesBefore[0] - 1).y(), 40, 1e-9) << "at the end of the block before it";
  // Coolant does not.
  for (const int coolant : {7, 8, 9}) {
    World cooled;
    cooled.run(fmt::format("T1 M6\nG0 X-20 Y-20\nF500\nG41 G1 X0 Y0\nY40\nM{}\nX40\nG40 X60 Y60\n", coolant));
    ASSERT_EQ(cooled.machine.functions, std::vector<int>{coolant});
    EXPECT_LT(cooled.machine.movesBefore[0], builder.machine.movesBefore[0]) << coolant;
  }
  World tight, equal;
  EXPECT_EQ(tight.alarm("T1 M6\nG0 X0 Y0\nF500\nG41 G1 X3 Y0\nG3 X3 Y0 I-3 J0\nG40 G1 X0 Y0\n"), "10753");
  EXPECT_EQ(equal.alarm("T1 M6\nG0 X0 Y0\nF500\nG41 G1 X5 Y0\nG3 X5 Y0 I-5 J0\nG40 G1 X0 Y0\n"), "10753")
      << "nothing is left of the arc";
}

TEST(SinumerikMotion, MeasuringBlocksLatchThePosition) {
  World world;
  world.control.data.load({"$P_UIFR", {1, "X", "TR"}}, 50.0);
  world.machine.wall = 80;
  world.run(
      "T2 M6\nG54 G0 X0 Y0 Z0\nMEAS=1 G1 X100 F300\nSTOPRE\n"
      "R1=$AC_MEA[1] R2=$AA_MW[X] R3=$AA_MM[X] R4=$AA_IW[X] R5=$AA_IM[Z]\n");
  EXPECT_EQ(world.r(1), 1);
  EXPECT_NEAR(world.r(2), 30, 1e-12);
  EXPECT_NEAR(world.r(3), 80, 1e-12);
  EXPECT_NEAR(world.r(4), 30, 1e-12);
  EXPECT_NEAR(world.r(5), 150, 1e-12);
  ASSERT_EQ(world.control.journal.cycles.size(), 1u);
  EXPECT_EQ(world.control.journal.cycles[0].touches.at(0).outcome, "touched");
  world.run("G0 X0\nMEAW=1 G1 X100\nR2=$AA_MW[X] R4=$AA_IW[X]\nG0 X0\nMEAS=1 G1 X20\nR1=$AC_MEA[1]\n");
  EXPECT_NEAR(world.r(2), 30, 1e-12);
  EXPECT_NEAR(world.r(4), 100, 1e-12) << "MEAW travels on";
  EXPECT_EQ(world.r(1), 0);
  world.run("G0 X0\nMEASA[X]=(1,1) G1 X100 F300\nR2=$AA_MW1[X]\n");
  EXPECT_NEAR(world.r(2), 30, 1e-12);
  EXPECT_EQ(world.alarm("G0 X0\nMEAS=3 G1 X10 F100\n"), "14020");
}

/// An angle below 0 or beyond the turn leads down or up to the same place within it: told again, the axis stays there.
TEST(SinumerikMotion, AnglesBeyondTheTurnOfAModuloAxisDoNotTurnItOnAndOn) {
  for (const auto& [told, place, back] :
       {std::tuple{"-20", -20.0, -350.0}, std::tuple{"AC(-380)", -20.0, -350.0}, std::tuple{"375", 15.0, 10.0}}) {
    World world("mill5-table-table");
    const auto c = *world.machine.description().axisIndex("C");
    const std::string block = std::string("G0 C=") + told + "\n";
    world.run(block);
    EXPECT_NEAR(world.machine.position()[c], place, 1e-9) << told;
    world.run(block + block);
    EXPECT_NEAR(world.machine.position()[c], place, 1e-9) << told;
    // Down from 340 as from 15.
    world.run("G0 C10\n");
    EXPECT_NEAR(world.machine.position()[c], back, 1e-9) << told;
  }
}

TEST(SinumerikMotion, RotaryAxesTurnAsTold) {
  World world("mill5-table-table");
  const auto& axes = world.machine.description().axes;
  const auto c = *world.machine.description().axisIndex("C");
  ASSERT_EQ(axes[c].kind, machine::AxisKind::Rotary);
  world.run("G0 C350\n");
  EXPECT_EQ(world.machine.position()[c], 350);
  world.run("C=DC(10)\n");
  EXPECT_EQ(world.machine.position()[c], 370);
  world.run("C=ACN(0)\n");
  EXPECT_EQ(world.machine.position()[c], 360);
  world.run("C=ACP(350)\n");
  EXPECT_EQ(world.machine.position()[c], 710);
  world.run("C=IC(-710)\n");
  EXPECT_EQ(world.machine.position()[c], 0);
  // The other way round than the nearest.
  world.run("C=ACN(30)\n");
  EXPECT_EQ(world.machine.position()[c], -330);
  world.run("C=ACP(20)\n");
  EXPECT_EQ(world.machine.position()[c], 20);
  world.run("G91 C15\nG90\n");
  EXPECT_EQ(world.machine.position()[c], 35);
  // A zero offset of the axis: the program counts from there, the machine does not.
  world.control.data.load({"$P_UIFR", {1, "C", "TR"}}, 25.0);
  world.run("G54\nC10\nR1=$AA_IW[C] R2=$AA_IM[C]\n");
  EXPECT_EQ(world.machine.position()[c], 35);
  EXPECT_NEAR(world.r(1), 10, 1e-12);
  EXPECT_NEAR(world.r(2), 35, 1e-12);
  // Whole turns are not shown: 715 degrees are 355, and 330 from the zero offset; -10 degrees are 350 and 325.
  world.run("G91 C680\nG90\nR1=$AA_IW[C] R2=$AA_IM[C] R3=$P_EP[C]\n");
  EXPECT_EQ(world.machine.position()[c], 715);
  EXPECT_NEAR(world.r(1), 330, 1e-9);
  EXPECT_NEAR(world.r(2), 355, 1e-9);
  EXPECT_NEAR(world.r(3), 330, 1e-9);
  world.run("G91 C-725\nG90\nR1=$AA_IW[C] R2=$AA_IM[C]\n");
  EXPECT_EQ(world.machine.position()[c], -10);
  EXPECT_NEAR(world.r(1), 325, 1e-9);
  EXPECT_NEAR(world.r(2), 350, 1e-9);
}

/// From X10 Y5: the angle counts from the 1st axis of the plane, and so does AP; the pole of G110 counts from where the
/// tool stands, that of G112 from the last pole.
TEST(SinumerikMotion, AnglesCountFromWhereTheToolStands) {
  const double root = std::sqrt(3);
  for (const auto& [text, end] : {std::pair("G1 X20 ANG=30 F1000", Vector3(20, 5 + 10 / root, 0)),
                                  {"G1 Y8 ANG=30 F1000", {10 + 3 * root, 8, 0}},
                                  {"G110 AP=30 RP=4\nG0 AP=90 RP=2", {10 + 2 * root, 9, 0}},
                                  {"G111 X1 Y2\nG112 AP=60 RP=4\nG0 AP=0 RP=2", {5, 2 + 2 * root, 0}},
                                  {"G111 AP=60 RP=4\nG0 AP=0 RP=2", {4, 2 * root, 0}}}) {
    World world;
    world.run(std::string("G0 X10 Y5\n") + text + "\n");
    EXPECT_LT((lastTip(world) - end).norm(), 1e-9) << text << ": " << lastTip(world).transpose();
  }
}

}  // namespace
}  // namespace probewright::language::sinumerik
