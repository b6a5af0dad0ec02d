#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "sinumerik/world.hpp"

/// A3, B3, C3 and A2, B2, C2 under TRAORI: the tool points where the words say, and its tip goes where X, Y, Z say.
namespace probewright::language::sinumerik {
namespace {

constexpr const char* machines[] = {"mill5-table-table", "mill5-head-table", "mill5-head-head"};

/// The tool axis in the coordinates of the program.
Vector3 toolAxis(World& world) { return world.control.channel.toolAxis().vector(); }

TEST(ToolOrientation, VectorsPointTheTool) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> slope(-0.4, 0.4), length(0.3, 3), place(-40, 40);
  for (const char* name : machines) {
    World world(name);
    world.control.data.load({"$P_UIFR", {1, "Z", "TR"}}, -300.0);
    world.run("T1 M6 D1\nG54\nG0 X0 Y0 Z100\nTRAORI\n");
    for (int i = 0; i < 30; ++i) {
      if (i == 15) {  // and where the zero offset turns the table
        world.control.data.load({"$P_UIFR", {1, "C", "TR"}}, 25.0);
        world.run("G54\n");
      }
      const Vector3 direction = length(random) * Vector3(slope(random), slope(random), 1);
      const Vector3 target(place(random), place(random), 60 + place(random) / 4);
      world.run(fmt::format("G1 X{} Y{} Z{} A3={} B3={} C3={} F1000\n", target.x(), target.y(), target.z(),
                            direction.x(), direction.y(), direction.z()));
      EXPECT_LT((toolAxis(world) - direction.normalized()).norm(), 1e-9) << name << " " << direction.transpose();
      EXPECT_LT((world.control.channel.position().vector() - target).norm(), 1e-9) << name;
    }
  }
}

TEST(ToolOrientation, AnglesPointTheTool) {
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();
  const double a = 20, b = 15, c = 35;
  const Vector3 euler = rotation(z, a) * rotation(x, b) * z, rpy = rotation(z, c) * rotation(y, b) * rotation(x, a) * z,
                rpy2 = rotation(x, a) * rotation(y, b) * z;
  for (const char* name : machines) {
    World world(name);
    world.control.data.load({"$P_UIFR", {1, "Z", "TR"}}, -300.0);
    world.run("T1 M6 D1\nG54\nG0 X0 Y0 Z100\nTRAORI\nG1 X5 A2=20 B2=15 F1000\n");
    EXPECT_LT((toolAxis(world) - euler).norm(), 1e-9) << name;
    world.run("ORIRPY\nG1 X6 A2=20 B2=15 C2=35\n");
    EXPECT_LT((toolAxis(world) - rpy).norm(), 1e-9) << name;
    world.run("ORIRPY2\nG1 X7 A2=20 B2=15\n");
    EXPECT_LT((toolAxis(world) - rpy2).norm(), 1e-9) << name;
    world.run("ORIEULER\nG1 A2=20 B2=15\n");
    EXPECT_LT((toolAxis(world) - euler).norm(), 1e-9) << name;
    EXPECT_LT((world.control.channel.position() - ProgramPlace(7, 0, 100)).norm(), 1e-9) << name;
  }
}

TEST(ToolOrientation, TheVectorCountsInTheProgramsOwnCoordinates) {
  World world("mill5-table-table");
  world.control.data.load({"$P_UIFR", {1, "Z", "TR"}}, -300.0);
  world.run("T1 M6 D1\nG54\nG0 X0 Y0 Z100\nTRAORI\nROT Z30\nG1 X1 A3=0.3 B3=0 C3=1 F1000\n");
  EXPECT_LT((toolAxis(world) - Vector3(0.3, 0, 1).normalized()).norm(), 1e-9);
}

TEST(ToolOrientation, RefusalsAreTheControls) {
  World world("mill5-table-table");
  world.control.data.load({"$P_UIFR", {1, "Z", "TR"}}, -300.0);
  world.run("T1 M6 D1\nG54\nG0 X0 Y0 Z100\n");
  EXPECT_EQ(world.alarm("G1 X10 A3=0 B3=0 C3=1 F100\n"), "14100");
  world.run("TRAORI\n");
  EXPECT_EQ(world.alarm("G1 A3=0 C3=1 A2=5 F100\n"), "14110");
  EXPECT_EQ(world.alarm("G1 A3=0 C3=1 C=5 F100\n"), "14111");
  EXPECT_EQ(world.alarm("G1 A3=0 B3=0 F100\n"), "14112");
  EXPECT_EQ(world.alarm("G1 C3=-1 F100\n"), "14112") << "no axis points the tool up from below the table";
  World three;
  EXPECT_EQ(three.alarm("TRAORI\nG1 A3=1 C3=1 F100\n"), "14112");
}

TEST(ToolOrientation, LeadAndTiltAreNamed) {
  World world("mill5-table-table");
  world.control.data.load({"$P_UIFR", {1, "Z", "TR"}}, -300.0);
  world.run("T1 M6 D1\nG54\nG0 X0 Y0 Z100\nTRAORI\nG1 X10 A3=0.1 C3=1 LEAD=5 TILT=3 A5=0 B5=0 C5=1 F100\n");
  std::vector<std::string> named;
  for (const auto& event : world.control.journal.events)
    if (event.kind == control::EventKind::Skipped) named.push_back(event.text);
  EXPECT_EQ(named,
            (std::vector<std::string>{"LEAD is not carried out", "TILT is not carried out", "A5 is not carried out",
                                      "B5 is not carried out", "C5 is not carried out"}));
  EXPECT_LT((toolAxis(world) - Vector3(0.1, 0, 1).normalized()).norm(), 1e-9);
}

}  // namespace
}  // namespace probewright::language::sinumerik
