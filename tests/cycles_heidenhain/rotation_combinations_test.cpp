#include "cycles_heidenhain/worlds.hpp"

/// Cycles 1410, 1411 and 1420: every combination of Q1121 and Q1126 on machines with and without rotary axes, and the
/// coordinate system of the rotation where rotary axes and tilt do not agree.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6;

/// A block whose top is the preset's plane, turned by `skew` and leaning by `lean`; two studs stand on it.
struct Block {
  Bench bench;
  double skew = 0;
  Vector3 lean = Vector3::Zero();  ///< degrees about X and Y
  Pose machineFromPart = Pose::Identity();
};

constexpr double studDiameter = 16;
const std::array<Vector3, 2> studs = {Vector3(-30, 0, 0), Vector3(30, 0, 0)};

void layBlock(Block& world, double skew, const Vector3& lean) {
  const Vector3 origin(12, -7, -450);
  world.skew = skew;
  world.lean = lean;
  world.bench.preset(1, origin);
  world.bench.believedProbe().maximumTravel = 40;
  world.bench.believedProbe().setUpClearance = 5;
  world.machineFromPart = pose(origin, {lean.x(), lean.y(), skew});
  world.bench.part(simulation::Box({-60, -50, -40}, {60, 50, 0}), world.machineFromPart);
  for (const Vector3& stud : studs) {
    world.bench.part(simulation::RoundBar(studDiameter / 2, 0, 20), world.machineFromPart * pose(stud));
  }
}

Block block(const std::string& machine, double skew, const Vector3& lean) {
  Block world{Bench(ControlKind::TNC640, machine)};
  layBlock(world, skew, lean);
  return world;
}

const Words travel = {{320, 0}, {260, 60}, {1125, 1}, {309, 0}};

Words wordsOf(int cycle) {
  if (cycle == 1410) {
    return with({{1100, -40}, {1101, -50}, {1102, -8}, {1103, 40}, {1104, -50}, {1105, -8}, {372, 2}}, travel);
  }
  if (cycle == 1411) {
    return with({{1100, -30},
                 {1101, 0},
                 {1102, 12},
                 {1116, studDiameter},
                 {1103, 30},
                 {1104, 0},
                 {1105, 12},
                 {1117, studDiameter},
                 {1115, 1},
                 {423, 4},
                 {325, 0},
                 {1119, 360}},
                travel);
  }
  return with({{1100, -50},
               {1101, -40},
               {1102, 0},
               {1103, 50},
               {1104, -40},
               {1105, 0},
               {1106, 0},
               {1107, 40},
               {1108, 0},
               {372, -3}},
              with(travel, {{1125, 2}}));
}

Ran run(const Block& world, int cycle, int position, int rotation, int alignment) {
  return world.bench.run(probe(cycle, with(wordsOf(cycle), {{1126, alignment}, {1120, position}, {1121, rotation}})));
}

TEST(RotationCycles, KnowEveryCombinationWithoutRotaryAxes) {
  for (const int cycle : {1410, 1411, 1420}) {
    const Vector3 lean = cycle == 1420 ? Vector3(0.6, -0.4, 0) : Vector3(0, 0, 0);
    const Block world = block("mill3", cycle == 1420 ? 0 : 1.5, lean);
    for (int rotation = 0; rotation <= (cycle == 1420 ? 1 : 2); ++rotation) {
      for (int alignment = 0; alignment <= 2; ++alignment) {
        SCOPED_TRACE(fmt::format("cycle {}, Q1121 {}, Q1126 {}", cycle, rotation, alignment));
        const Ran ran = run(world, cycle, 0, rotation, alignment);
        if (alignment != 0 || rotation == 2) {
          EXPECT_EQ(ran.alarm(), "Rotary axes cannot be aligned");
          EXPECT_NE(ran.why().find(rotation == 0 ? "Q1121" : "rotary ax"), std::string::npos) << ran.why();
          EXPECT_EQ(ran.touches(), 0U);
          continue;
        }
        ASSERT_TRUE(ran.finished()) << ran.why();
        const Matrix3 expected = rotation == 1 ? world.machineFromPart.linear() : Matrix3(Matrix3::Identity());
        EXPECT_LT((ran.preset().linear() - expected).norm(), cycle == 1420 ? 1e-4 : 1e-7);
      }
    }
  }
}

/// A slide upon the rotary table moves the workpiece, but does not turn it: the table is still the axis to align by.
TEST(RotationCycles, AlignByATableThatCarriesASlide) {
  for (const int cycle : {1410, 1411}) {
    Block world{Bench(ControlKind::TNC640, "mill5-head-table")};
    machine::MachineDescription& machine = world.bench.setup.world.truth.machine;
    const std::size_t x = *machine.axisIndex("X");
    std::erase_if(machine.tableChain, [&](const auto& element) { return element.axis == x; });
    std::erase_if(machine.spindleChain, [&](const auto& element) { return element.axis == x; });
    machine.tableChain.push_back({x, -Vector3::UnitX(), Vector3::Zero()});
    layBlock(world, 1.5, Vector3::Zero());
    const Ran ran = run(world, cycle, 0, 1, 1);
    ASSERT_TRUE(ran.finished()) << ran.why();
    const Matrix3 turn = machine::baseFromTable(machine, ran.machine->position()).linear();
    EXPECT_LT((turn * world.machineFromPart.linear() - Matrix3::Identity()).norm(), 1e-7) << cycle;
  }
}

TEST(RotationCycles, KnowEveryCombinationOnFiveAxes) {
  for (const std::string machine : {"mill5-head-table", "mill5-table-table"}) {
    for (const int cycle : {1410, 1411}) {
      const Block world = block(machine, 1.5, Vector3::Zero());
      const Ran still = run(world, cycle, 0, 1, 0);
      ASSERT_TRUE(still.finished()) << still.why();
      const auto& axes = still.machine->description();
      const std::size_t c = *axes.axisIndex("C");
      for (int rotation = 0; rotation <= 2; ++rotation) {
        for (int alignment = 0; alignment <= 2; ++alignment) {
          for (const int position : {0, 3}) {
            SCOPED_TRACE(fmt::format("{}, cycle {}, Q1121 {}, Q1126 {}, Q1120 {}", machine, cycle, rotation, alignment,
                                     position));
            const Ran ran = run(world, cycle, position, rotation, alignment);
            if (alignment != 0 && rotation == 0) {
              EXPECT_EQ(ran.alarm(), "Rotary axes cannot be aligned");
              continue;
            }
            ASSERT_TRUE(ran.finished()) << ran.why();
            EXPECT_NEAR(ran.q(994), 1.5, exact);
            const auto end = ran.machine->position();
            const auto before = still.machine->position();
            EXPECT_NEAR(ran.cell("PRESET.PR", "1", "C_OFFS"), rotation == 2 ? 1.5 : 0, 1e-4);
            EXPECT_NEAR(end[c], alignment == 0 ? 0 : 1.5, exact);
            if (alignment == 2) {
              for (const char* axis : {"X", "Y", "Z"})
                EXPECT_NEAR(end[*axes.axisIndex(axis)], before[*axes.axisIndex(axis)], exact);
            }
            if (alignment == 1) {
              EXPECT_LT((ran.machine->tipOnTable() - still.machine->tipOnTable()).norm(), exact);
            }
            if (rotation == 1 && alignment == 0) {
              EXPECT_NEAR(ran.cell("PRESET.PR", "1", "SPC"), 1.5, 1e-4);
            }
          }
        }
      }
    }
    const Block leaning = block(machine, 0, {0.6, -0.4, 0});
    const Ran still = run(leaning, 1420, 0, 1, 0);
    ASSERT_TRUE(still.finished()) << still.why();
    for (int alignment = 0; alignment <= 2; ++alignment) {
      SCOPED_TRACE(fmt::format("{}, cycle 1420, Q1126 {}", machine, alignment));
      EXPECT_EQ(run(leaning, 1420, 0, 0, alignment).finished(), alignment == 0);
      const Ran ran = run(leaning, 1420, 0, 1, alignment);
      ASSERT_TRUE(ran.finished()) << ran.why();
      const Vector3 tool = ran.machine->tableFromSpindle().linear().col(2);
      const Vector3 normal = leaning.machineFromPart.linear().col(2);
      EXPECT_NEAR(tool.dot(alignment == 0 ? Vector3(Vector3::UnitZ()) : normal), 1, 1e-9);
      if (alignment == 1) {
        // What stays is the south pole of the ball.
        const Vector3 before = still.machine->tipOnTable() - 2 * Vector3::UnitZ();
        EXPECT_LT((ran.machine->tipOnTable() - 2 * tool - before).norm(), 1e-3);
      }
    }
  }
}

TEST(Cycle1410, TellsNoRotationAlongTheToolAxis) {
  const Block world = block("mill5-table-table", 0, {0.6, -0.4, 0});
  for (const int direction : {3, -3}) {
    for (int rotation = 1; rotation <= 2; ++rotation) {
      for (int alignment = 0; alignment <= 2; ++alignment) {
        const Words words = with(wordsOf(1410), {{372, direction}, {1126, alignment}, {1120, 1}, {1121, rotation}});
        const Ran ran = world.bench.run(probe(1410, words));
        EXPECT_EQ(ran.alarm(), "Probing direction not permitted");
        EXPECT_EQ(ran.touches(), 0U);
      }
    }
  }
  // The height alone may be measured, and corrected: after it the top reads 0 there.
  const Block flat = block("mill3", 0, Vector3::Zero());
  const Words height =
      with(wordsOf(1410),
           {{372, -3}, {1101, -20}, {1102, 1.25}, {1104, -20}, {1105, 1.25}, {1126, 0}, {1120, 3}, {1121, 0}});
  const Ran ran = flat.bench.run(probe(1410, height));
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(ran.q(952), 0, exact);
  EXPECT_NEAR(ran.q(982), -1.25, exact);
  EXPECT_NEAR(ran.seen({12, -7, -450}).z(), 1.25, exact);
}

/// A block that leans nowhere, probed with TCPM in a plane that is tilted while the rotary axes stand at 0.
TEST(RotationCycles, RotateInTheWorkpieceSystemWhereThePlaneIsInconsistent) {
  Dice dice(14109);
  double apart = 0;
  for (int at = 0; at < 60; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Bench bench(ControlKind::TNC640, dice.coin() ? "mill5-head-table" : "mill5-table-table");
    const Vector3 origin(written(dice.between(-40, 40)), written(dice.between(-40, 40)), -450);
    const double rotation = written(dice.between(-20, 20));
    bench.preset(1, origin, rotation);
    const Pose preset = pose(origin, {0, 0, rotation});
    bench.believedProbe().maximumTravel = 40;
    bench.believedProbe().setUpClearance = 8;
    const double skew = dice.between(-3, 3);
    bench.part(simulation::Box({-50, -50, -60}, {50, 50, 0}), preset * pose(Vector3::Zero(), {0, 0, skew}));
    const Vector3 angles(written(dice.between(-12, 12)), written(dice.between(-12, 12)), 0);
    const Matrix3 tilt = pose(Vector3::Zero(), angles).linear();
    // Both places lie on the nominal wall, in the workpiece system, at different heights.
    std::array<Vector3, 2> nominal = {Vector3(-30, -50, -10), Vector3(30, -50, -25)};
    for (Vector3& place : nominal)
      place = (tilt.transpose() * place).unaryExpr([](double v) { return written(v, 6); });
    const Words words = {{1100, nominal[0].x()},
                         {1101, nominal[0].y()},
                         {1102, nominal[0].z()},
                         {1103, nominal[1].x()},
                         {1104, nominal[1].y()},
                         {1105, nominal[1].z()},
                         {372, 2},
                         {320, 0},
                         {260, 50},
                         {1125, 1},
                         {309, 0},
                         {1126, 0},
                         {1120, 0},
                         {1121, 1}};
    const std::string plane =
        fmt::format("L Z+0 R0 FMAX M91\nPLANE SPATIAL SPA{:+.3f} SPB{:+.3f} SPC+0 STAY\n", angles.x(), angles.y());
    const std::string tcpm = "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS\n";

    bench.setup.beliefs.parameters["chkTiltingAxes"] = {1.0, {}};
    EXPECT_EQ(bench.run(plane + probe(1410, words)).alarm(), "Rotary axes and tilt do not match");
    const Ran ran = bench.run(plane + tcpm + probe(1410, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(964), skew, 1e-5);
    EXPECT_NEAR(ran.q(994), skew, 1e-5);
    EXPECT_LT((ran.preset().linear() - pose(Vector3::Zero(), {0, 0, rotation + skew}).linear()).norm(), 1e-6);

    // Without the check the plane counts as consistent: the rotation is one of the input system.
    bench.setup.beliefs.parameters["chkTiltingAxes"] = {0.0, {}};
    const Ran unchecked = bench.run(plane + tcpm + probe(1410, words));
    ASSERT_TRUE(unchecked.finished()) << unchecked.why();
    const Vector3 outward = tilt.transpose() * pose(Vector3::Zero(), {0, 0, skew}).linear() * Vector3(0, -1, 0);
    std::array<Vector3, 2> met = nominal;
    for (Vector3& place : met)
      place.y() += (50 - outward.dot(place)) / outward.y();
    const auto angle = [](const std::array<Vector3, 2>& line) {
      return degrees(std::atan2(line[1].y() - line[0].y(), line[1].x() - line[0].x()));
    };
    const double inInput = angle(met) - angle(nominal);
    EXPECT_NEAR(unchecked.q(994), inInput, exact);
    apart = std::max(apart, std::abs(inInput - skew));
  }
  EXPECT_GT(apart, 0.05);
}

}  // namespace
}  // namespace probewright::testing_support
