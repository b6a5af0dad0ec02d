#include <algorithm>

#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"
#include "machine/description.hpp"

/// What cycles 401 to 405 leave in the preset and datum tables, row by row, and that the zero of an axis stands where
/// they have put it: a move to angle 0 then moves nothing.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6, digit = 6e-5;
constexpr ControlKind newer = ControlKind::TNC640, older = ControlKind::iTNC530;
constexpr std::size_t c = 4;

const std::string activate5 = "CYCL DEF 247 PRESET ~\n  Q339=5 ;NUMBER\n";
const std::string toZero = "L C+0 R0 FMAX\n";

/// Two holes on a rotary table, 40 mm left and right of the preset in the table's centre line, whose line lies 4
/// degrees off X. The preset has an old basic rotation of 7 degrees.
Bench twoHoles(ControlKind kind) {
  Bench bench(kind, "mill5-table-table");
  bench.preset(1, {0, 0, -400}, 7);
  bench.believedProbe().maximumTravel = 40;
  for (const double side : {-40.0, 40.0})
    bench.part(simulation::Ring(8, 16, -30), pose({0, 0, -400}, {0, 0, 4}) * pose({side, 0, 0}));
  return bench;
}
const Words holes = {{268, -40}, {269, 0}, {270, 40}, {271, 0}, {261, -8},
                     {260, 20},  {307, 0}, {402, 1},  {337, 1}, {305, 0}};

/// C as it stands at the end. The workpiece turns against the count of C.
double angleOfC(const Ran& ran) { return ran.machine->position()[c]; }

TEST(MisalignmentTables, SetTheAxisToZeroInRow0AndActivateIt) {
  const Ran ran = twoHoles(newer).run(probe(401, holes) + toZero);
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(angleOfC(ran), 4, exact) << "it shows 0 there";
  EXPECT_NEAR(ran.cell("PRESET.PR", "0", "C_OFFS"), 4, digit);
  // The rest of row 0 comes from the preset in effect, without the basic rotation that the cycle has reset.
  EXPECT_EQ(ran.cell("PRESET.PR", "0", "X"), 0);
  EXPECT_EQ(ran.cell("PRESET.PR", "0", "Z"), -400);
  EXPECT_EQ(ran.cell("PRESET.PR", "0", "SPC"), 0);
  EXPECT_EQ(ran.cell("PRESET.PR", "1", "SPC"), 7);
  EXPECT_EQ(ran.cell("PRESET.PR", "1", "C_OFFS"), 0);
  EXPECT_TRUE(ran.preset().isApprox(pose({0, 0, -400}), 1e-9));
}

/// What row 0 was before does not show through: all of it comes from the active preset.
TEST(MisalignmentTables, CopyOffsetsOfZeroToo) {
  const std::string activate1 = "CYCL DEF 247 PRESET ~\n  Q339=1 ;NUMBER\n";
  const std::string block = probe(401, holes) + activate1 + probe(404, {{307, 3}, {305, 0}}) + toZero;
  const Ran ran = twoHoles(newer).run(block);
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_EQ(ran.cell("PRESET.PR", "0", "C_OFFS"), 0);
  EXPECT_EQ(ran.cell("PRESET.PR", "0", "SPC"), 3);
  EXPECT_NEAR(angleOfC(ran), 0, exact);
}

TEST(MisalignmentTables, SetTheAxisToZeroInAnyRow) {
  const std::string block = probe(401, with(holes, {{305, 5}}));
  const Ran waiting = twoHoles(newer).run(block + toZero);
  ASSERT_TRUE(waiting.finished()) << waiting.why();
  EXPECT_NEAR(angleOfC(waiting), 0, exact) << "row 5 does not count before it is activated";
  EXPECT_EQ(waiting.cell("PRESET.PR", "1", "C_OFFS"), 0);
  const Ran ran = twoHoles(newer).run(block + activate5 + toZero);
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(angleOfC(ran), 4, exact);
  EXPECT_NEAR(ran.cell("PRESET.PR", "5", "C_OFFS"), 4, digit);
  EXPECT_EQ(ran.cell("PRESET.PR", "5", "Z"), -400);
  EXPECT_FALSE(ran.table("PRESET.PR").hasRow("0") && ran.cell("PRESET.PR", "0", "C_OFFS") != 0);

  // A row that is there keeps all but its offset.
  Bench bench = twoHoles(newer);
  bench.preset(5, {10, 20, -390}, 3, false);
  const Ran kept = bench.run(block);
  ASSERT_TRUE(kept.finished()) << kept.why();
  EXPECT_NEAR(kept.cell("PRESET.PR", "5", "C_OFFS"), 4, digit);
  EXPECT_EQ(kept.cell("PRESET.PR", "5", "X"), 10);
  EXPECT_EQ(kept.cell("PRESET.PR", "5", "SPC"), 3);
}

/// An old basic rotation does not come back into effect once the workpiece lies straight.
TEST(MisalignmentTables, EndTheOldBasicRotationOfTheActiveRow) {
  for (const int row : {0, 1, 5}) {
    SCOPED_TRACE(row);
    const Ran ran = twoHoles(newer).run(probe(401, with(holes, {{337, 0}, {305, row}})) + toZero);
    ASSERT_TRUE(ran.finished()) << ran.why();
    // Q305 has no effect: the axis shows in the active row what it showed before, and a move there moves nothing.
    EXPECT_NEAR(angleOfC(ran), 4, exact);
    EXPECT_NEAR(ran.cell("PRESET.PR", "1", "C_OFFS"), 4, digit);
    EXPECT_EQ(ran.cell("PRESET.PR", "1", "SPC"), 0);
    EXPECT_FALSE(ran.table("PRESET.PR").hasRow("5"));
    EXPECT_TRUE(ran.preset().isApprox(pose({0, 0, -400}), 1e-9));
  }
  const Ran active = twoHoles(newer).run(probe(401, with(holes, {{305, 1}})) + toZero);
  ASSERT_TRUE(active.finished()) << active.why();
  EXPECT_NEAR(angleOfC(active), 4, exact);
  EXPECT_EQ(active.cell("PRESET.PR", "1", "SPC"), 0);
  EXPECT_TRUE(active.preset().isApprox(pose({0, 0, -400}), 1e-9));
  // The older control zeroes the display, with Q337 = 1 alone.
  for (const int zero : {0, 1}) {
    const Ran ran = twoHoles(older).run(probe(401, with(holes, {{337, zero}})) + toZero);
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(angleOfC(ran), zero == 1 ? 4 : 0, exact);
    EXPECT_TRUE(ran.preset().isApprox(pose({0, 0, -400}), 1e-9));
  }
}

std::size_t warnings(const Ran& ran, const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(ran.outcome.journal.events, [&](const control::EventRecord& event) {
        return event.kind == control::EventKind::Warning && event.text.find(text) != std::string::npos;
      }));
}

TEST(MisalignmentTables, SayThatQ337DoesNothingToABasicRotation) {
  for (const ControlKind kind : {newer, older}) {
    const Ran ran = twoHoles(kind).run(probe(401, with(holes, {{402, 0}, {305, 1}})));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_EQ(warnings(ran, "Q337 = 1"), 1U);
    EXPECT_NEAR(angleOfC(ran), 0, exact);
    EXPECT_NEAR(ran.cell("PRESET.PR", "1", kind == newer ? "SPC" : "ROT"), 4, digit);
    EXPECT_EQ(ran.cell("PRESET.PR", "1", kind == newer ? "C_OFFS" : "C"), 0);
    EXPECT_EQ(warnings(twoHoles(kind).run(probe(401, with(holes, {{402, 0}, {337, 0}}))), "Q337"), 0U);
  }
}

/// An edge that lies 2 degrees off X of the preset, which has a basic rotation of its own.
Bench edge(ControlKind kind, double rotation) {
  Bench bench(kind, "mill5-table-table");
  bench.preset(1, {0, 0, -400}, rotation);
  bench.believedProbe().maximumTravel = 40;
  bench.part(simulation::Box({-50, 0, -40}, {50, 60, 0}), pose({0, 0, -400}, {0, 0, rotation + 2}));
  return bench;
}
const Words edgeWords = {{263, -30}, {264, 0}, {265, 30}, {266, 0}, {272, 2}, {267, 1}, {261, -8}, {320, 4},
                         {260, 20},  {301, 1}, {312, 6},  {337, 1}, {305, 5}, {303, 1}, {380, 0}};

TEST(MisalignmentTables, ShiftTheZeroOfTheAxisInADatumTable) {
  for (const ControlKind kind : {newer, older}) {
    for (const double rotation : {0.0, 9.0}) {
      SCOPED_TRACE(fmt::format("{}, basic rotation {}", control::name(kind), rotation));
      Bench bench = edge(kind, rotation);
      const TableFolder folder(bench);
      folder.put("ZERO.D", control::heidenhain::defaultDatumTable(kind, "ZERO.D"));
      const std::string block = "SEL TABLE \"ZERO.D\"\n" + probe(403, with(edgeWords, {{303, 0}}));
      const Ran ran = bench.run(block + "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 #5\n" + toZero);
      ASSERT_TRUE(ran.finished()) << ran.why();
      // 403 measures in the rotated system and leaves the rotation as it is.
      EXPECT_NEAR(ran.q(150), 2, exact);
      EXPECT_NEAR(angleOfC(ran), 2, exact);
      EXPECT_NEAR(ran.cell("ZERO.D", "5", "C"), 2, digit);
      EXPECT_EQ(ran.cell("PRESET.PR", "1", kind == newer ? "C_OFFS" : "C"), 0);
      EXPECT_TRUE(ran.preset().isApprox(pose({0, 0, -400}, {0, 0, rotation}), 1e-9));
      const Ran nowhere = edge(kind, rotation).run(probe(403, with(edgeWords, {{303, 0}})));
      EXPECT_EQ(nowhere.alarm(), "Datum table not selected") << nowhere.why();
    }
  }
  // An offset of the axis in the preset stays: the datum table counts from it.
  for (const ControlKind kind : {newer, older}) {
    Bench bench = edge(kind, 0);
    const TableFolder folder(bench);
    folder.put("ZERO.D", control::heidenhain::defaultDatumTable(kind, "ZERO.D"));
    const std::string twice = probe(403, with(edgeWords, {{305, 1}})) + "SEL TABLE \"ZERO.D\"\n" +
                              probe(403, with(edgeWords, {{303, 0}, {380, 1}}));
    const Ran aligned = bench.run(twice),
              ran = bench.run(twice + "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 #5\n" + toZero);
    ASSERT_TRUE(aligned.finished()) << aligned.why();
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.cell("PRESET.PR", "1", kind == newer ? "C_OFFS" : "C"), 2, digit);
    EXPECT_NEAR(std::abs(angleOfC(aligned) - 2), 1, exact) << "the edge lies 1 degree off now";
    EXPECT_NEAR(ran.cell("ZERO.D", "5", "C"), angleOfC(aligned) - 2, digit);
    EXPECT_NEAR(angleOfC(ran), angleOfC(aligned), exact) << "it shows 0 there";
  }
  // There is no older program that could have left the table open.
  const Ran open = edge(newer, 0).run(probe(403, with(edgeWords, {{303, -1}})));
  EXPECT_EQ(open.outcome.info.exit, records::ExitState::InputMistake);
  EXPECT_NE(open.why().find("Q303"), std::string::npos) << open.why();
}

/// A basic rotation asks whether the row that takes it is locked, and for no other.
TEST(MisalignmentTables, AskForTheRowOfABasicRotationOnly) {
  for (const int row : {0, 1, 5}) {
    for (const int locked : {0, 1, 5}) {
      SCOPED_TRACE(fmt::format("Q305 {}, row {} locked", row, locked));
      Bench bench = twoHoles(newer);
      bench.setup.beliefs.presets.clear();
      const TableFolder folder(bench);
      control::heidenhain::TypedTable presets = control::heidenhain::defaultPresetTable(newer);
      for (const char* name : {"0", "1", "5"}) {
        ASSERT_TRUE(presets.ensureRow(name));
        ASSERT_TRUE(presets.setNumber(name, "Z", -400));
      }
      ASSERT_TRUE(presets.setText(std::to_string(locked), "LOCKED", "L"));
      folder.put("PRESET.PR", presets);
      const Ran ran = bench.run("CYCL DEF 247 PRESET ~\n  Q339=1 ;NUMBER\n" +
                                probe(401, with(holes, {{402, 0}, {337, 0}, {305, row}})));
      if (locked != row) {
        EXPECT_TRUE(ran.finished()) << ran.why();
        continue;
      }
      EXPECT_EQ(ran.alarm(), "Preset locked") << ran.why();
      EXPECT_TRUE(ran.cycle().touches.empty());
    }
  }
}

TEST(MisalignmentTables, EnterTheAxisOf403WhereTheManualSays) {
  struct Row {
    ControlKind kind;
    int axis, zero, row;
    const char* entered;  ///< row that gets the offset
  };
  const Row rows[] = {{newer, 0, 1, 0, "0"}, {newer, 0, 1, 5, "5"}, {newer, 6, 1, 5, "1"}, {newer, 6, 1, 0, "1"},
                      {newer, 0, 0, 5, ""},  {newer, 6, 0, 5, ""},  {older, 6, 1, 5, "5"}, {older, 6, 0, 5, ""}};
  for (const Row& one : rows) {
    SCOPED_TRACE(fmt::format("{}, Q312 {}, Q337 {}, Q305 {}", control::name(one.kind), one.axis, one.zero, one.row));
    const std::string entered = one.entered;
    const std::string after = entered == "5" ? activate5 : "";
    const Ran ran =
        edge(one.kind, 0)
            .run(probe(403, with(edgeWords, {{312, one.axis}, {337, one.zero}, {305, one.row}})) + after + toZero);
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(angleOfC(ran), entered.empty() ? 0 : 2, exact);
    using control::heidenhain::NumberColumn;
    const NumberColumn column = one.kind == newer ? NumberColumn("C_OFFS") : NumberColumn("C");
    for (const std::string row : {"0", "1", "5"}) {
      const auto table = ran.table("PRESET.PR");
      const double offset = table.hasRow(row) ? table.numberOr(row, column, 0) : 0;
      EXPECT_NEAR(offset, row == entered ? 2 : 0, digit) << "row " << row;
    }
  }
}

TEST(MisalignmentTables, SetTheBasicRotationOf404InEveryRow) {
  Bench bench;
  bench.preset(1, {1, 2, -400}, 9, false);
  bench.preset(3, {10, 20, -400}, 5);
  struct Row {
    int row;
    double effect;  ///< the basic rotation in effect afterwards
    const char* written;
  };
  for (const Row& one : {Row{-1, -12.5, "3"}, Row{0, -12.5, "0"}, Row{3, -12.5, "3"}, Row{1, 5, "1"}, Row{8, 5, "8"}}) {
    SCOPED_TRACE(one.row);
    const Ran ran = bench.run(probe(404, {{307, -12.5}, {305, one.row}}));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_TRUE(ran.preset().isApprox(pose({10, 20, -400}, {0, 0, one.effect}), 1e-9));
    EXPECT_EQ(ran.cell("PRESET.PR", one.written, "SPC"), -12.5);
    if (one.row != 3 && one.row != -1) {
      EXPECT_EQ(ran.cell("PRESET.PR", "3", "SPC"), 5);
    }
  }
  // It deletes a rotation, also one of three angles.
  bench.setup.beliefs.presets.back().rotation = {2, -3, 5};
  const Ran none = bench.run(probe(404, {{307, 0}}));
  ASSERT_TRUE(none.finished()) << none.why();
  for (const char* column : {"SPA", "SPB", "SPC"})
    EXPECT_EQ(none.cell("PRESET.PR", "3", column), 0);
}

/// 400 to 402 measure in the unturned system, whatever three angles the preset had, and leave one about the tool axis.
TEST(MisalignmentTables, ReplaceARotationOfThreeAngles) {
  Bench straight = edge(newer, 0);
  straight.setup.beliefs.presets.front().rotation = {1, -2, 5};
  Words words = edgeWords;
  std::erase_if(words, [](const auto& word) {
    return word.first == 312 || word.first == 337 || word.first == 303 || word.first == 380;
  });
  Bench pair = twoHoles(newer);
  pair.setup.beliefs.presets.front().rotation = {1, -2, 5};
  const Ran along = straight.run(probe(400, with(words, {{307, 0}, {305, 0}})));
  const Ran between = pair.run(probe(401, with(holes, {{402, 0}, {337, 0}, {305, 1}})));
  for (const auto& [ran, angle] : {std::pair(&along, 2.0), std::pair(&between, 4.0)}) {
    ASSERT_TRUE(ran->finished()) << ran->why();
    EXPECT_EQ(ran->cell("PRESET.PR", "1", "SPA"), 0);
    EXPECT_EQ(ran->cell("PRESET.PR", "1", "SPB"), 0);
    EXPECT_NEAR(ran->cell("PRESET.PR", "1", "SPC"), angle, digit);
    EXPECT_TRUE(ran->preset().isApprox(pose({0, 0, -400}, {0, 0, angle}), 1e-9));
  }
}

/// 405 counts from the axes of the active system, whichever way they are turned.
TEST(MisalignmentTables, Align405ToTheRotatedSystem) {
  for (const ControlKind kind : {newer, older}) {
    for (const double rotation : {-8.0, 0.0, 11.0}) {
      SCOPED_TRACE(fmt::format("{}, basic rotation {}", control::name(kind), rotation));
      Bench bench(kind, "mill5-table-table");
      bench.preset(1, {0, 0, -400}, rotation);
      bench.believedProbe().maximumTravel = 40;
      // A hole 1 degree beside the nominal place at X30 Y50 of the preset.
      const double nominal = degrees(std::atan2(50, 30)), radius = std::hypot(30, 50), lies = rotation + nominal + 1;
      bench.part(simulation::Ring(10, 18, -30),
                 pose({radius * std::cos(radians(lies)), radius * std::sin(radians(lies)), -400}));
      const Words words = {{321, 30}, {322, 50}, {262, 18}, {325, 0}, {247, 90},
                           {261, -8}, {320, 0},  {260, 20}, {301, 0}, {337, 0}};
      const Ran ran = bench.run(probe(405, words) + toZero);
      ASSERT_TRUE(ran.finished()) << ran.why();
      EXPECT_NEAR(ran.q(150), 1, exact);
      EXPECT_NEAR(angleOfC(ran), 1, exact) << "it shows 0 there";
      EXPECT_EQ(warnings(ran, "positive side"), 0U);
    }
  }
  Bench behind(newer, "mill5-table-table");
  behind.preset(1, {0, 0, -400});
  behind.part(simulation::Ring(10, 18, -30), pose({30, -50, -400}));
  const Ran ran = behind.run(probe(
      405,
      {{321, 30}, {322, -50}, {262, 18}, {325, 0}, {247, 90}, {261, -8}, {320, 0}, {260, 20}, {301, 0}, {337, 0}}));
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_EQ(warnings(ran, "positive side of the Y axis"), 1U);
}

/// A machine without a table that turns the workpiece about the tool axis: nothing is written.
TEST(MisalignmentTables, RefuseTablesThatAreNotThere) {
  for (const ControlKind kind : {newer, older}) {
    for (const char* machine : {"mill3", "mill5-head-head"}) {
      SCOPED_TRACE(fmt::format("{}, {}", control::name(kind), machine));
      Bench bench(kind, machine);
      bench.preset(1, {0, 0, -400});
      bench.believedProbe().maximumTravel = 40;
      for (const double side : {-40.0, 40.0})
        bench.part(simulation::Ring(8, 16, -30), pose({side, 0, -400}, {0, 0, 4}));
      const Words hole = {{321, 40}, {322, 0}, {262, 14}, {325, 0}, {247, 90},
                          {261, -8}, {320, 0}, {260, 20}, {301, 0}, {337, 0}};
      for (const std::string& block : {probe(401, holes), probe(403, edgeWords), probe(405, hole)}) {
        const Ran ran = bench.run(block);
        EXPECT_EQ(ran.alarm(), "Rotary axis not available") << ran.why();
        EXPECT_NE(ran.why().find("no rotary table that turns the workpiece about Z"), std::string::npos) << ran.why();
        EXPECT_EQ(ran.touches(), 0U) << "found out before the first touch";
        EXPECT_TRUE(ran.cycle().writes.empty());
      }
    }
  }
}

}  // namespace
}  // namespace probewright::testing_support
