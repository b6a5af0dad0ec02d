#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/number_text.hpp"
#include "klartext/expectations.hpp"
#include "klartext/host_world.hpp"
#include "machine/machine_file.hpp"

namespace probewright::language::klartext::testing {
namespace {

TEST(Tilting, TiltedPlanesPointTheToolAlongTheirNormal) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> angle(-50, 50);
  for (const char* name : {"mill5-table-table", "mill5-head-table", "mill5-head-head"}) {
    for (int i = 0; i < 20; ++i) {
      World world(name);
      const double a = angle(random), b = angle(random), c = angle(random);
      const RunResult result = world.run("TOOL CALL 1 Z\nPLANE SPATIAL SPA" + formatSigned(a, 6) + " SPB" +
                                         formatSigned(b, 6) + " SPC" + formatSigned(c, 6) + " TURN F5000\n");
      ASSERT_EQ(result.end, RunEnd::Finished) << name << " " << a << " " << b << " " << c << "\n"
                                              << (result.diagnostics.empty() ? "" : format(result.diagnostics[0]));
      EXPECT_TRUE(near(world.control->channel.toolAxis().vector(), Vector3::UnitZ(), 1e-9)) << name;
    }
  }
}

/// PLANE AXIAL names positions of the axes as the program counts them: from the offsets of the preset. I adds to where
/// they stand.
TEST(Tilting, AxialPlanesCountFromTheOffsetsOfThePreset) {
  World world("mill5-table-table");
  const std::size_t a = *world.machine->description().axisIndex("A"), c = *world.machine->description().axisIndex("C");
  control::heidenhain::Control::PresetChange change;
  change.rotaryOffset[c] = 30;
  world.control->writePreset(world.control->coordinates.preset.row, change);
  expectFinished(world.run("TOOL CALL 1 Z\nPLANE AXIAL A+10 C+20 TURN F5000\n"));
  EXPECT_NEAR(world.machine->position()[a], 10, 1e-9);
  EXPECT_NEAR(world.machine->position()[c], 50, 1e-9);
  expectFinished(world.run("PLANE AXIAL IA+5 IC-10 TURN F5000\n"));
  EXPECT_NEAR(world.machine->position()[a], 15, 1e-9);
  EXPECT_NEAR(world.machine->position()[c], 40, 1e-9);
  EXPECT_TRUE(near(world.control->channel.toolAxis().vector(), Vector3::UnitZ(), 1e-9));
}

TEST(Tilting, PlaneDefinitionsAgree) {
  const auto tiltOf = [](const std::string& block) {
    World world("mill5-table-table");
    const RunResult result = world.run("TOOL CALL 1 Z\n" + block + "\n");
    EXPECT_EQ(result.end, RunEnd::Finished) << block;
    return world.control->coordinates.tilt.value_or(Matrix3::Zero());
  };
  const Matrix3 a30 = tiltOf("PLANE SPATIAL SPA+30 SPB+0 SPC+0 STAY");
  EXPECT_NEAR((a30 * Vector3::UnitZ() - Vector3(0, -0.5, std::sqrt(0.75))).norm(), 0, 1e-12);
  EXPECT_NEAR((tiltOf("PLANE EULER EULPR0 EULNU30 EULROT0 STAY") - a30).norm(), 0, 1e-12);
  EXPECT_NEAR((tiltOf("PLANE PROJECTED PROPR0 PROMIN30 ROT0 STAY") - a30).norm(), 0, 1e-12);
  EXPECT_NEAR((tiltOf("PLANE VECTOR BX1 BY0 BZ0 NX0 NY-0.5 NZ0.8660254037844386 STAY") - a30).norm(), 0, 1e-12);
  EXPECT_NEAR((tiltOf("PLANE POINTS P1X0 P1Y0 P1Z0 P2X10 P2Y0 P2Z0 P3X0 P3Y8.660254037844386 P3Z5 STAY") - a30).norm(),
              0, 1e-12);
  EXPECT_NEAR((tiltOf("PLANE SPATIAL SPA+10 SPB+0 SPC+0 STAY\nPLANE RELATIV SPA20 STAY") - a30).norm(), 0, 1e-12);
  EXPECT_NEAR((tiltOf("CYCL DEF 19.0 TILT\nCYCL DEF 19.1 A+30 B+0 C+0") - a30).norm(), 0, 1e-12);
  EXPECT_NEAR((tiltOf("PLANE AXIAL A30 C0 STAY") - a30).norm(), 0, 1e-12);
  EXPECT_NEAR((tiltOf("PLANE SPATIAL SPA+30 SPB+0 SPC+0 STAY\nPLANE RESET STAY") - Matrix3::Zero()).norm(), 0, 1e-12);
}

TEST(Tilting, SequencePicksTheSignOfTheTiltingAxis) {
  for (const int sign : {1, -1}) {
    World world("mill5-table-table");
    const RunResult result = world.run(std::string("TOOL CALL 1 Z\nPLANE SPATIAL SPA+0 SPB+30 SPC+0 TURN FMAX SEQ") +
                                       (sign > 0 ? "+" : "-") + "\n");
    ASSERT_EQ(result.end, RunEnd::Finished);
    EXPECT_NEAR(world.machine->position()[3], sign * 30, 1e-9);
    EXPECT_NEAR(world.q(120), sign * 30, 1e-9);
  }
}

TEST(Tilting, MoveKeepsTheTipOnTheWorkpiece) {
  World world("mill5-table-table");
  const RunResult result = world.run(
      "TOOL CALL 1 Z\nL X+10 Y+20 Z-400 FMAX\n"
      "PLANE SPATIAL SPA+20 SPB+0 SPC+0 MOVE DIST0 F2000\nPLANE RESET STAY\n");
  ASSERT_EQ(result.end, RunEnd::Finished);
  world.control->coordinates.tilt = Matrix3::Identity();
  world.control->applyCoordinates();
  EXPECT_TRUE(near(world.control->channel.position().vector(), {10, 20, -400}, 1e-9));
}

TEST(Tilting, MoveWithADistanceKeepsThePointAboveTheTip) {
  World world("mill5-table-table");
  const RunResult result = world.run(
      "TOOL CALL 1 Z\nL X+10 Y+20 Z-400 FMAX\n"
      "PLANE SPATIAL SPA+20 SPB+0 SPC+0 MOVE DIST50 F2000\nPLANE RESET STAY\n");
  ASSERT_EQ(result.end, RunEnd::Finished);
  world.control->coordinates.tilt = Matrix3::Identity();
  world.control->applyCoordinates();
  // The tool stands square to the tilted plane; 50 mm up its axis lies the point that was 50 mm above the tip before.
  const Vector3 axis(0, -std::sin(radiansFromDegrees(20)), std::cos(radiansFromDegrees(20)));
  EXPECT_TRUE(near(world.control->channel.position().vector() + 50 * axis, {10, 20, -350}, 1e-9));
}

/// A in the bed and B on it, the tool upright at A = B = 0.
machine::MachineDescription tableWithAandB() {
  machine::MachineDescription description = *machine::readMachine("mill5-table-table");
  description.axes[3].minimum = -100;
  description.axes[3].maximum = 180;
  description.axes[4].name = "B";
  description.tableChain[1].direction = {0, -1, 0};
  return description;
}

/// Axis positions at the end, and what the machine's X, Y, Z do while the program goes 10 mm along X.
struct Turned {
  machine::AxisPositions axes;
  Vector3 step = Vector3::Zero();
};

Turned turnedBy(World& world, const std::string& blocks) {
  expectFinished(world.run("TOOL CALL 1 Z\n" + blocks + "\nL X+0 Y+0 Z-300 FMAX\nL X+10 FMAX\n"));
  const auto& steps = world.machine->steps;
  Turned turned{world.machine->position(), {}};
  for (std::size_t i = 0; i < 3; ++i)
    turned.step[static_cast<Eigen::Index>(i)] = steps.back().axes[i] - steps[steps.size() - 2].axes[i];
  return turned;
}

const Vector3 along30 = {10 * std::cos(radiansFromDegrees(30)), 5, 0};

TEST(Tilting, CoordRotLeavesAFreeTableAtZeroAndTurnsTheCoordinates) {
  for (const char* type : {"COORD ROT", ""}) {
    World world("mill5-table-table");
    const Turned turned =
        turnedBy(world, std::string("L C+90 FMAX\nPLANE SPATIAL SPA+0 SPB+0 SPC+30 TURN FMAX ") + type);
    EXPECT_NEAR(turned.axes[4], 0, 1e-9) << type;
    EXPECT_NEAR(world.q(122), 0, 1e-9) << type;
    EXPECT_TRUE(near(turned.step, along30)) << type;
  }
}

TEST(Tilting, TableRotTurnsTheTableUntilThePlaneLiesAlongTheMachine) {
  for (const char* name : {"mill5-table-table", "mill5-head-table"}) {
    World world(name);
    const Turned turned = turnedBy(world, "L C+90 FMAX\nPLANE SPATIAL SPA+0 SPB+0 SPC+30 TURN FMAX TABLE ROT");
    EXPECT_NEAR(turned.axes[4], 30, 1e-9) << name;
    EXPECT_NEAR(world.q(122), 30, 1e-9) << name;
    EXPECT_TRUE(near(turned.step, {10, 0, 0})) << name;
  }
}

TEST(Tilting, TableRotTurnsTheBasicRotationOfTheWorkpieceAway) {
  World world("mill5-table-table");
  world.control->coordinates.preset.spaceAngles = {0, 0, 12};
  world.control->applyCoordinates();
  const Turned turned = turnedBy(world, "PLANE SPATIAL SPA+0 SPB+0 SPC+0 TURN FMAX TABLE ROT");
  EXPECT_NEAR(turned.axes[4], 12, 1e-9);
  EXPECT_TRUE(near(turned.step, {10, 0, 0}));
}

TEST(Tilting, AFreeAxisOfTheHeadDoesNotTurnTheWorkpiece) {
  for (const auto& [type, expected] : {std::pair("TABLE ROT", 30.0), std::pair("COORD ROT", 0.0)}) {
    World world("mill5-head-head");
    const Turned turned =
        turnedBy(world, std::string("L C+90 FMAX\nPLANE SPATIAL SPA+0 SPB+0 SPC+30 TURN FMAX ") + type);
    EXPECT_NEAR(turned.axes[4], expected, 1e-9) << type;
    EXPECT_TRUE(near(turned.step, along30)) << type;
  }
}

TEST(Tilting, TableRotLeavesAFreeAxisWhereItStandsUnderATiltedPlane) {
  for (const auto& [type, expected] : {std::pair("TABLE ROT", 45.0), std::pair("COORD ROT", 0.0)}) {
    World world(tableWithAandB());
    expectFinished(world.run(std::string("TOOL CALL 1 Z\nL B+45 FMAX\nPLANE SPATIAL SPA-90 SPB+20 SPC+0 TURN F5000 ") +
                             type + "\n"));
    EXPECT_NEAR(world.machine->position()[3], -90, 1e-9) << type;
    EXPECT_NEAR(world.machine->position()[4], expected, 1e-9) << type;
    EXPECT_TRUE(near(world.control->channel.toolAxis().vector(), Vector3::UnitZ())) << type;
  }
}

TEST(Tilting, TheTypeOfTransformationMeansNothingWithoutAFreeAxis) {
  for (const char* type : {"TABLE ROT", "COORD ROT", ""}) {
    World world("mill5-table-table");
    expectFinished(
        world.run(std::string("TOOL CALL 1 Z\nPLANE SPATIAL SPA+30 SPB+0 SPC+0 TURN FMAX SEQ+ ") + type + "\n"));
    EXPECT_NEAR(world.machine->position()[3], 30, 1e-9) << type;
    EXPECT_NEAR(world.machine->position()[4], 0, 1e-9) << type;
  }
}

TEST(Tilting, SymCountsFromThePointOfSymmetryAndSeqFromZero) {
  // The two positions of the plane are A-45 B0 and A-135 B180; the second is beyond the travel. Symmetry lies at A-90.
  const auto end = [](const std::string& side) {
    World world(tableWithAandB());
    const RunResult result = world.run("TOOL CALL 1 Z\nPLANE SPATIAL SPA-45 SPB+0 SPC+0 TURN FMAX " + side + "\n");
    if (result.end != RunEnd::Finished) return result.diagnostics.front().code;
    return formatFixed(world.machine->position()[3], 3) + " " + formatFixed(world.machine->position()[4], 3);
  };
  EXPECT_EQ(end("SYM+"), "-45.000 0.000");
  EXPECT_EQ(end("SYM-"), "Entered angle not permitted");
  EXPECT_EQ(end("SEQ+"), "Entered angle not permitted");
  EXPECT_EQ(end("SEQ-"), "-45.000 0.000");
  EXPECT_EQ(end(""), "-45.000 0.000");
}

TEST(Tilting, TcpmGuidesTheTipByAxisAnglesOnly) {
  const auto codeOf = [](const std::string& block) {
    World world("mill5-table-table");
    const RunResult result = world.run(block + "\n");
    return result.diagnostics.empty() ? std::string() : result.diagnostics.front().code;
  };
  EXPECT_EQ(codeOf("FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS REFPNT TIP-TIP"), "");
}

TEST(Tilting, AxialTiltsGoToTheirAnglesFromTheShiftedZero) {
  World world("mill5-table-table");
  expectFinished(
      world.run("TOOL CALL 1 Z\nTRANS DATUM AXIS C+15\nPLANE AXIAL A+20 C+10 TURN FMAX\n"
                "FN 18: SYSREAD Q1 = ID210 NR10\nFN 18: SYSREAD Q2 = ID210 NR6\n"));
  EXPECT_NEAR(world.machine->position()[3], 20, 1e-9);
  EXPECT_NEAR(world.machine->position()[4], 25, 1e-9);
  EXPECT_EQ(world.q(1), 1);
  EXPECT_EQ(world.q(2), -1);
}

}  // namespace
}  // namespace probewright::language::klartext::testing
