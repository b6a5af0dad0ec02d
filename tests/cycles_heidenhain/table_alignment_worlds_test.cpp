#include "cycles_heidenhain/across.hpp"
#include "machine/description.hpp"
#include "machine/rotary_solver.hpp"

/// Rotary tables A and B, and machines that are not perfect: cycles 401, 402, 403, 405, 1410, 1411 and 1420 turn the
/// workpiece until it is aligned.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6;

const machine::MachineDescription& believed(const Bench& bench) { return bench.setup.world.truth.machine; }

/// How the table of a perfect machine has turned its workpiece from where all axes read `from`.
Matrix3 tableTurn(const Bench& bench, const Ran& ran, const machine::AxisPositions& from) {
  return machine::baseFromTable(believed(bench), ran.machine->position()).linear() *
         machine::baseFromTable(believed(bench), from).linear().transpose();
}

/// A table of one kind, and the face that it can level below a probe along Z.
struct Table {
  const char* machine;
  char axis;
  int about;  ///< 0: X, 1: Y
  int word;   ///< of Q312
  bool nextToWorkpiece;

  std::size_t index(const Bench& bench) const { return *believed(bench).axisIndex(std::string_view(&axis, 1)); }
  Vector3 angles(double degreesTurned) const {
    Vector3 result = Vector3::Zero();
    result[about] = degreesTurned;
    return result;
  }
  Vector3 normal(double lies) const { return pose(Vector3::Zero(), angles(lies)).linear().col(2); }
};
constexpr Table tables[] = {{"mill5-table-table", 'A', 0, 4, false}, {"mill4-table", 'B', 1, 5, true}};

/// Two touches from above, 60 mm apart across the axis of the table; `swapped` the other way round.
Words across(const Table& table, bool swapped) {
  const double first = swapped ? 30 : -30;
  const Words place = table.about == 0 ? Words{{263, 4}, {264, first}, {265, 4}, {266, -first}}
                                       : Words{{263, first}, {264, 4}, {265, -first}, {266, 4}};
  return with(place,
              {{272, 3}, {267, -1}, {261, 0}, {320, 6}, {260, 20}, {301, 1}, {337, 0}, {305, 0}, {303, 1}, {380, 0}});
}

TEST(Cycle403, LevelsAFaceWithAnyTableWhereverItStands) {
  Dice dice(4033);
  for (int at = 0; at < 60; ++at) {
    const Table& table = tables[at % 2];
    const ControlKind kind = controlOf(at / 2);
    const bool newer = kind == ControlKind::TNC640;
    SCOPED_TRACE(fmt::format("world {}, {} on {}", at, table.axis, table.machine));
    Bench bench(kind, table.machine);
    bench.preset(1, {10, -5, -400});
    bench.believedProbe().maximumTravel = 40;
    // The table has turned before the cycle begins; the face lies askew where it stands then.
    const double stands = written(dice.between(-40, 40)), lies = dice.between(-8, 8);
    machine::AxisPositions turned;
    turned[table.index(bench)] = stands;
    const Pose tableFromBase = machine::baseFromTable(believed(bench), turned).inverse();
    bench.part(simulation::HalfSpace({Vector3(10, -5, -400), table.normal(lies)}), tableFromBase);
    const bool automatic = newer && table.nextToWorkpiece && dice.coin();
    const bool zero = dice.coin();
    const bool swapped = dice.coin() && !automatic;
    const Words words =
        with(across(table, swapped), {{312, automatic ? 0 : table.word}, {337, zero ? 1 : 0}, {305, 6}});
    const Ran ran = bench.run(fmt::format("L {}{:+.4f} R0 FMAX\n", table.axis, stands) + probe(403, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(150), lies, exact);
    EXPECT_NEAR((tableTurn(bench, ran, turned) * table.normal(lies) - Vector3::UnitZ()).norm(), 0, 1e-8);
    // The short way, not once round.
    const double reads = ran.machine->position()[table.index(bench)];
    EXPECT_NEAR(std::abs(std::remainder(reads - stands, 360)), std::abs(lies), exact);
    if (!zero) continue;
    const std::string row = newer && !automatic ? "1" : "6";
    EXPECT_NEAR(ran.cell("PRESET.PR", row, std::string(1, table.axis) + (newer ? "_OFFS" : "")), reads, 6e-5);
  }
}

/// What is wrong with the machine comes out as what the cycle must find and leave, in closed form.
TEST(Cycle403, LeavesWhatTheErrorsOfTheMachineMakeOfIt) {
  Dice dice(4034);
  for (int at = 0; at < 40; ++at) {
    const Table& table = tables[at % 2];
    SCOPED_TRACE(fmt::format("world {}, {} on {}", at, table.axis, table.machine));
    Bench bench(controlOf(at / 2), table.machine);
    bench.preset(1, {0, 0, -400});
    bench.believedProbe().maximumTravel = 40;
    const double lies = dice.between(-6, 6);
    bench.part(simulation::HalfSpace({Vector3(0, 0, -400), table.normal(lies)}));
    auto& errors = bench.setup.world.truth.errors;
    errors.axes.resize(believed(bench).axes.size());
    // The axis across travels further than it reads, the rotary axis turns further and lies elsewhere, and the probe
    // signals late and is believed to be shorter: nothing of the last two changes an angle.
    const double scale = dice.between(-5e-4, 5e-4), rotaryScale = dice.between(-2e-3, 2e-3);
    errors.axes[*believed(bench).axisIndex(table.about == 0 ? "Y" : "X")].scale = scale;
    errors.axes[table.index(bench)].scale = rotaryScale;
    errors.rotaryAxes.push_back({table.index(bench), dice.within(0.3), Vector3::Zero()});
    bench.trueProbe().pretravel = 0.01;
    bench.trueProbe().axialPretravel = dice.between(0, 0.02);
    bench.believedProbe().length -= 0.4;
    const Ran ran = bench.run(probe(403, with(across(table, false), {{312, table.word}})));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const double found = degrees(std::atan(std::tan(radians(lies)) * (1 + scale)));
    EXPECT_NEAR(ran.q(150), found, 1e-5);
    const double turned = std::remainder(ran.machine->position()[table.index(bench)], 360);
    EXPECT_NEAR(std::abs(turned), std::abs(found), 1e-5);
    // The face has truly turned by more than the axis reads.
    const double left = lies - found * (1 + rotaryScale);
    const Vector3 normal =
        pose(Vector3::Zero(), table.angles(-found * (1 + rotaryScale))).linear() * table.normal(lies);
    EXPECT_NEAR((normal - table.normal(left)).norm(), 0, 1e-9);
    const Ran again = bench.run(probe(403, with(across(table, false), {{312, table.word}})) +
                                probe(403, with(across(table, false), {{312, table.word}})));
    ASSERT_TRUE(again.finished()) << again.why();
    EXPECT_NEAR(again.q(150), degrees(std::atan(std::tan(radians(left)) * (1 + scale))), 1e-5);
  }
}

/// A probe in an angle head, along X before an A table or along Y over a B table: what lies askew in the plane across
/// it is aligned by that table.
TEST(ToolAxis, AlignsTheTableByAAndB) {
  Dice dice(4035);
  for (int at = 0; at < 60; ++at) {
    const bool b = at % 2 == 1;
    const int cycle = std::array{401, 402, 403, 1410, 1411}[static_cast<std::size_t>(at / 2) % 5];
    SCOPED_TRACE(fmt::format("world {}, cycle {}, {}", at, cycle, b ? "B" : "A"));
    const ControlKind kind = cycle > 1000 ? ControlKind::TNC640 : controlOf(at / 10);
    Across world(kind, b ? 'Y' : 'X', b ? "mill4-table" : "mill5-table-table");
    if (!b && cycle > 1000) {
      // They take the axis of the table that is nearest to the workpiece: here A carries it.
      machine::MachineDescription& machine = world.bench.setup.world.truth.machine;
      const std::size_t c = *machine.axisIndex("C");
      ASSERT_EQ(c + 1, machine.axes.size());
      machine.axes.pop_back();
      std::erase_if(machine.tableChain, [&](const auto& element) { return element.axis == c; });
    }
    const double skew = dice.between(-3, 3);
    const Pose lying = pose(Vector3::Zero(), {0, 0, skew});
    Words words = {{260, 20}};
    // The cycle turns the table, or enters the offset with which the axis stands aligned at 0.
    const bool enters = cycle > 1000 && dice.coin();
    const Words rotation = {
        {320, 3}, {1125, 1}, {309, 0}, {1126, enters ? 0 : dice.whole(1, 2)}, {1120, 0}, {1121, enters ? 2 : 1}};
    if (cycle == 403 || cycle == 1410) {
      world.part(simulation::Box({-40, -40, -30}, {40, 40, 0}), lying);
      words = with(
          words,
          cycle == 403
              ? Words{{263, -30},
                      {264, -40},
                      {265, 30},
                      {266, -40},
                      {261, -9},
                      {320, 3},
                      {301, 1},
                      {272, 2},
                      {267, 1},
                      {312, b ? 5 : 4},
                      {337, 0},
                      {305, 0},
                      {303, 1},
                      {380, 0}}
              : with(rotation, {{1100, -30}, {1101, -40}, {1102, -9}, {1103, 30}, {1104, -40}, {1105, -9}, {372, 2}}));
    } else {
      for (const double side : {-40.0, 40.0}) {
        if (cycle == 402) {
          world.part(simulation::RoundBar(8, -30, 0), lying * pose({side, 0, 0}));
        } else {
          world.part(simulation::Ring(8, 14, -30), lying * pose({side, 0, 0}));
        }
      }
      words = with(
          words,
          cycle == 1411
              ? with(rotation, {{1100, -40},
                                {1101, 0},
                                {1102, -9},
                                {1116, 14},
                                {1103, 40},
                                {1104, 0},
                                {1105, -9},
                                {1117, 14},
                                {1115, 0},
                                {423, 4},
                                {325, 0},
                                {1119, 360},
                                {320, 0}})
              : Words{{261, -9}, {337, 0}, {305, 0}, {268, -40}, {269, 0}, {270, 40}, {271, 0}, {307, 0}, {402, 1}});
      if (cycle == 402) words = with(words, {{313, 16.5}, {314, 16.5}, {315, -10}, {320, 1}, {301, 1}, {261, -9}});
    }
    const std::string align = fmt::format("L {}+60 R0 FMAX\nL {}+0 R0 FMAX\n", world.axis, b ? 'B' : 'A');
    const Ran ran = world.run(probe(cycle, words) + (enters ? align : ""));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const Matrix3 axes = world.machineFromPlane().linear();
    const Matrix3 now =
        axes.transpose() * tableTurn(world.bench, ran, world.bench.setup.world.truth.start) * axes * lying.linear();
    EXPECT_LT((now - Matrix3::Identity()).norm(), 1e-8);
  }
}

/// 1420 stands the tool square to a face that leans any way, on a trunnion about Y that carries C.
TEST(Cycle1420, LevelsAFaceWithBAndCInTheTable) {
  Dice dice(14202);
  for (int at = 0; at < 20; ++at) {
    SCOPED_TRACE(at);
    Bench bench(ControlKind::TNC640, "mill5-table-table");
    machine::MachineDescription& trunnion = bench.setup.world.truth.machine;
    const std::size_t a = *trunnion.axisIndex("A");
    trunnion.axes[a].name = "B";
    for (machine::ChainElement& element : trunnion.tableChain) {
      if (element.axis == a) element.direction = -Vector3::UnitY();
    }
    bench.preset(1, {0, 0, -400});
    bench.believedProbe().maximumTravel = 40;
    bench.believedProbe().setUpClearance = 10;
    const Vector3 normal = pose(Vector3::Zero(), {dice.between(-6, 6), dice.between(-6, 6), 0}).linear().col(2);
    bench.part(simulation::HalfSpace({Vector3(0, 0, -400), normal}));
    const Words words = {{1100, -30}, {1101, -25}, {1102, 0},  {1103, 35}, {1104, -20},
                         {1105, 0},   {1106, 5},   {1107, 30}, {1108, 0},  {372, -3},
                         {320, 0},    {260, 60},   {1125, 2},  {309, 0},   {1126, dice.whole(1, 2)},
                         {1120, 0},   {1121, 1}};
    const Ran ran = bench.run(probe(1420, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(961), degrees(std::asin(-normal.y())), exact);
    EXPECT_NEAR(ran.q(962), degrees(std::atan2(normal.x(), normal.z())), exact);
    const Vector3 tool = machine::toolOrientation(trunnion, {}, ran.machine->position()).col(2);
    EXPECT_NEAR((tool - normal).norm(), 0, 1e-8);
    EXPECT_GT(std::abs(ran.machine->position()[a]), 0.01);
  }
}

/// A table that had turned before the face was measured: the preset stays at its place of the workpiece, and the tool
/// stands square to the face above it.
TEST(Cycle1420, KeepsThePresetAtItsPlaceOfATurnedTable) {
  Dice dice(14203);
  for (int at = 0; at < 8; ++at) {
    const double stands = at % 4 == 0 ? 0 : written(dice.between(-80, 80));
    SCOPED_TRACE(fmt::format("{} at C{}", at, stands));
    Bench bench(ControlKind::TNC640, "mill5-table-table");
    const Vector3 origin(10, -5, -400);
    bench.preset(1, origin);
    bench.believedProbe().maximumTravel = 40;
    bench.believedProbe().setUpClearance = 10;
    const Vector3 normal = pose(Vector3::Zero(), {dice.between(2, 6), dice.between(2, 6), 0}).linear().col(2);
    machine::AxisPositions turned;
    turned[*believed(bench).axisIndex("C")] = stands;
    const Pose tableFromBase = machine::baseFromTable(believed(bench), turned).inverse();
    bench.part(simulation::HalfSpace({origin, normal}), tableFromBase);
    const Words words = {{1100, -30}, {1101, -25}, {1102, 0},          {1103, 35}, {1104, -20}, {1105, 0},
                         {1106, 5},   {1107, 30},  {1108, 0},          {372, -3},  {320, 0},    {260, 60},
                         {1125, 2},   {309, 0},    {1126, 1 + at % 2}, {1120, 0},  {1121, 1}};
    const Ran ran = bench.run(fmt::format("L C{:+.4f} R0 FMAX\n", stands) + probe(1420, words) +
                              "L Z+60 R0 FMAX\nL X+0 Y+0 R0 FMAX\n");
    ASSERT_TRUE(ran.finished()) << ran.why();
    const Vector3 place = tableFromBase * origin, up = tableFromBase.linear() * normal;
    const machine::AxisPositions now = ran.machine->position();
    const Vector3 tip = machine::baseFromTable(believed(bench), now).inverse() *
                        (machine::baseFromSpindle(believed(bench), now) * Vector3(0, 0, -bench.believedProbe().length));
    const Vector3 above = tip - place;
    EXPECT_LT(above.cross(up).norm(), 1e-6) << above.transpose();
    EXPECT_NEAR(above.dot(up), 60, 5);
  }
}

/// The C axis of 405 on a machine whose axes are not perfect: it turns too far by its own scale, and about another
/// place than the preset.
TEST(Cycle405, LeavesWhatTheErrorsOfTheMachineMakeOfIt) {
  Dice dice(4052);
  for (int at = 0; at < 30; ++at) {
    SCOPED_TRACE(at);
    const bool head = dice.coin();
    Bench bench(controlOf(at), head ? "mill5-head-table" : "mill5-table-table");
    bench.preset(1, {0, 0, -400});
    bench.believedProbe().maximumTravel = 40;
    const double off = dice.between(-1.5, 1.5), from = 80;
    const Vector2 place = from * Vector2(std::cos(radians(90 + off)), std::sin(radians(90 + off)));
    bench.part(simulation::Ring(12, 20, -30), pose({place.x(), place.y(), -400}));
    auto& errors = bench.setup.world.truth.errors;
    errors.axes.resize(believed(bench).axes.size());
    const std::size_t c = *believed(bench).axisIndex("C");
    const double scale = dice.between(-3e-3, 3e-3);
    errors.axes[c].scale = scale;
    const Vector3 displaced(dice.between(-0.2, 0.2), dice.between(-0.2, 0.2), 0);
    errors.rotaryAxes.push_back({c, displaced, Vector3::Zero()});
    const Words words = {{321, 0},  {322, from}, {262, 18}, {325, 0}, {247, 90},
                         {261, -8}, {320, 0},    {260, 20}, {301, 0}, {337, 0}};
    const Ran ran = bench.run(probe(405, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(150), off, exact);
    const Ran again = bench.run(probe(405, words) + probe(405, words));
    ASSERT_TRUE(again.finished()) << again.why();
    const Vector2 centre = displaced.head<2>();
    const Vector2 now = centre + Eigen::Rotation2Dd(radians(-off * (1 + scale))) * (place - centre);
    EXPECT_NEAR(again.q(150), degrees(std::atan2(now.y(), now.x())) - 90, exact);
  }
}

}  // namespace
}  // namespace probewright::testing_support
