#include <algorithm>

#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"

/// Where the presetting cycles of the TNC 640 write: every combination of Q303 and Q305, with rows that are new, active
/// or already there.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6, digit = 6e-5;

/// A hole at X50 Y40 of the active preset in row 2; row 7 has a rotation and a height of its own.
struct World {
  World() {
    bench.preset(1, {1, 2, -300}, 0, false);
    bench.preset(7, {-30, 15, -380}, 20, false);
    bench.preset(2, {10, 20, -400}, 5);
    bench.part(simulation::Ring(15, 40, -30), pose(hole));
    folder.put("ZERO.D", control::heidenhain::defaultDatumTable(ControlKind::TNC640, "ZERO.D"));
  }
  /// 412 with the place wished at X7 Y-2.
  std::string block(int transfer, int row) const {
    return probe(412, {{321, 50},
                       {322, 40},
                       {262, 30},
                       {325, 0},
                       {247, 90},
                       {261, -8},
                       {320, 0},
                       {260, 20},
                       {301, 0},
                       {305, row},
                       {331, 7},
                       {332, -2},
                       {303, transfer},
                       {381, 0}});
  }
  Ran run(const std::string& blocks) const { return bench.run(blocks); }
  /// Only the table of the setup is in the folder; the rows come from the setup.
  Bench bench;
  TableFolder folder{bench};
  Pose active = pose({10, 20, -400}, {0, 0, 5});
  Vector3 hole = active * Vector3(50, 40, 0);
};

const std::string select = "SEL TABLE \"ZERO.D\"\n";
std::string activate(int row) { return fmt::format("CYCL DEF 247 PRESET ~\n  Q339={} ;NUMBER\n", row); }

void expectSeen(const Ran& ran, const Vector3& place, const Vector3& expected) {
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_LT((ran.seen(place) - expected).norm(), exact) << ran.seen(place).transpose();
}

/// The rows that the run has written, as the journal tells.
std::vector<std::string> rowsWritten(const Ran& ran) {
  std::vector<std::string> rows;
  for (const auto& write : ran.cycle().writes) {
    const std::string row = write.table + " " + write.entry.substr(0, write.entry.find(','));
    if (std::ranges::find(rows, row) == rows.end()) rows.push_back(row);
  }
  return rows;
}

TEST(PresetRows, AreSetAtOnceThroughRow0) {
  const World world;
  // -1 comes from older programs; 0 counts so only where no datum table is active.
  for (const int transfer : {1, -1, 0}) {
    SCOPED_TRACE(transfer);
    const Ran ran = world.run(world.block(transfer, 0));
    expectSeen(ran, world.hole, {7, -2, 0});
    EXPECT_EQ(rowsWritten(ran), std::vector<std::string>{"PRESET.PR row 0"});
    EXPECT_EQ(ran.cell("PRESET.PR", "0", "SPC"), 5);
    EXPECT_EQ(ran.cell("PRESET.PR", "0", "Z"), -400);
    EXPECT_EQ(ran.cell("PRESET.PR", "2", "X"), 10);
  }
}

/// Row 0 ends a rotation by cycle 10; with the active row it goes on. Either way the display reads what was wished.
TEST(PresetRows, ReadAsWishedWithARotationByCycle10) {
  const World world;
  const Vector3 seen = pose(Vector3::Zero(), {0, 0, -30}).linear() * Vector3(50, 40, 0);
  const std::string rotation = "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+30\n";
  const std::string over = "L X+7 Y-2 Z+30 R0 FMAX\nL IX+10 R0 FMAX\n";
  for (const int row : {0, 2}) {
    SCOPED_TRACE(row);
    const Words words = {{321, written(seen.x())},
                         {322, written(seen.y())},
                         {262, 30},
                         {325, 0},
                         {247, 90},
                         {261, -8},
                         {320, 0},
                         {260, 20},
                         {301, 0},
                         {305, row},
                         {331, 7},
                         {332, -2},
                         {303, 1},
                         {381, 0}};
    const Ran ran = world.run(rotation + probe(412, words) + over);
    ASSERT_TRUE(ran.finished()) << ran.why();
    const Vector3 along = pose(Vector3::Zero(), {0, 0, row == 0 ? 5.0 : 35.0}).linear().col(0);
    const Vector3 expected = world.hole + 10 * along;
    const auto stands = ran.machine->position();
    EXPECT_NEAR(stands[0], expected.x(), 1e-3);
    EXPECT_NEAR(stands[1], expected.y(), 1e-3);
  }
}

TEST(PresetRows, WaitForTheirActivation) {
  const World world;
  // A new row takes the rest from the active preset, one that is there keeps it.
  for (const int row : {5, 7}) {
    SCOPED_TRACE(row);
    const Ran waiting = world.run(world.block(1, row));
    expectSeen(waiting, world.hole, {50, 40, 0});
    EXPECT_EQ(rowsWritten(waiting), std::vector<std::string>{fmt::format("PRESET.PR row {}", row)});
    const Ran ran = world.run(world.block(1, row) + activate(row));
    expectSeen(ran, world.hole, {7, -2, row == 5 ? 0.0 : -20.0});
    EXPECT_EQ(ran.cell("PRESET.PR", std::to_string(row), "SPC"), row == 5 ? 5 : 20);
    EXPECT_EQ(ran.cell("PRESET.PR", std::to_string(row), "Z"), row == 5 ? -400 : -380);
  }
  // The active one counts at once.
  const Ran active = world.run(world.block(1, 2));
  expectSeen(active, world.hole, {7, -2, 0});
  EXPECT_EQ(rowsWritten(active), std::vector<std::string>{"PRESET.PR row 2"});
  EXPECT_EQ(active.cell("PRESET.PR", "2", "SPC"), 5);
}

TEST(PresetRows, OfADatumTableShiftWithCycle7) {
  const World world;
  // Row 0 stands for the preset that is set at once.
  for (const int row : {1, 3}) {
    SCOPED_TRACE(row);
    const Ran ran = world.run(select + world.block(0, row));
    expectSeen(ran, world.hole, {50, 40, 0});
    EXPECT_EQ(rowsWritten(ran), std::vector<std::string>{fmt::format("ZERO.D row {}", row)});
    EXPECT_NEAR(ran.cell("ZERO.D", std::to_string(row), "X"), 43, digit);
    EXPECT_NEAR(ran.cell("ZERO.D", std::to_string(row), "Y"), 42, digit);
    EXPECT_EQ(ran.table("ZERO.D").numberOr(std::to_string(row), "Z", 0), 0);
    const Ran shifted =
        world.run(select + world.block(0, row) + fmt::format("CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 #{}\n", row) +
                  "L X+7 Y-2 Z+30 R0 FMAX\n");
    ASSERT_TRUE(shifted.finished()) << shifted.why();
    const auto stands = shifted.machine->position();
    EXPECT_NEAR(stands[0], world.hole.x(), 1e-3);
    EXPECT_NEAR(stands[1], world.hole.y(), 1e-3);
  }
}

/// 419 axis by axis into one row: every run sets its own axis and leaves the others.
TEST(PresetRows, TakeOneAxisAfterTheOther) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Bench bench(kind);
    bench.preset(1, {10, 20, -400}, 0);
    bench.part(simulation::Box({0, 0, -40}, {80, 60, 0}), pose({10.3, 19.6, -399.8}));
    const Words common = {{320, 0}, {260, 20}, {303, 1}};
    const auto along = [&](int axis, const Vector3& at, int row) {
      return probe(419, with(common, {{263, at.x()},
                                      {264, at.y()},
                                      {261, at.z()},
                                      {272, axis + 1},
                                      {267, axis == 2 ? -1 : 1},
                                      {305, row},
                                      {333, 100 * (axis + 1)}}));
    };
    for (const int row : {0, 1, 6}) {
      SCOPED_TRACE(fmt::format("{}, row {}", control::name(kind), row));
      // Coordinates count in the active preset: with row 0 or 1 it has moved behind each run. An inactive row has not.
      const bool moves = row != 6;
      const Vector3 moved = moves ? Vector3(100, 200, 0) : Vector3(Vector3::Zero());
      const Ran ran = bench.run(along(0, {0, 30, -8}, row) + along(1, {30 + moved.x(), 0, -8}, row) +
                                along(2, {30 + moved.x(), 30 + moved.y(), 0}, row) + (moves ? "" : activate(6)));
      expectSeen(ran, {10.3, 19.6, -399.8}, {100, 200, 300});
    }
  }
}

}  // namespace
}  // namespace probewright::testing_support
