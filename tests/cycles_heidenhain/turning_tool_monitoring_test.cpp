#include "control/heidenhain/turning_tool_table.hpp"
#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"

/// Q330 with a turning tool on a TNC 640: TOOLTURN.TRN is corrected so that the next part comes out right.
namespace probewright::testing_support {
namespace {

namespace hh = control::heidenhain;

/// How a turning tool stands: its axes in (away from the turning axis, along the tool axis).
struct Posture {
  int reversed = 0;
  double incidence = 0;
  Vector2 z() const { return {std::sin(radians(incidence)), std::cos(radians(incidence))}; }
  Vector2 x() const {
    return (reversed == 1 ? -1 : 1) * Vector2(std::cos(radians(incidence)), -std::sin(radians(incidence)));
  }
  /// Where the tip stands from the tool's reference point with these lengths.
  Vector2 tip(double zl, double xl) const { return -zl * z() + xl * x(); }
};

/// A turning tool whose lengths are a little wrong in the table; tool 7, "TURN".
struct Turned {
  Bench bench{ControlKind::TNC640};
  Posture posture;
  double zl = 0, xl = 0, dzl = 0, dxl = 0;  ///< as the table has them
  Vector2 missing = Vector2::Zero();        ///< true tip minus that of the table

  /// The error that the lengths of `ran` leave in the part.
  Vector2 left(const Ran& ran) const {
    Diagnostics diagnostics;
    const auto table = hh::TypedTable::parse(ran.outcome.files.at("TOOLTURN.TRN"), "TOOLTURN.TRN",
                                             hh::turningToolColumns(), diagnostics);
    EXPECT_TRUE(table);
    const Vector2 believed = posture.tip(zl + table->numberOr("7", "DZL", 99), xl + table->numberOr("7", "DXL", 99));
    return posture.tip(zl + dzl, xl + dxl) + missing - believed;
  }
};

hh::TypedTable toolTable(double breakage) {
  hh::TypedTable tools = hh::defaultToolTable(ControlKind::TNC640);
  EXPECT_TRUE(tools.setText("7", "NAME", "TURN"));
  EXPECT_TRUE(tools.setText("7", "TYP", "TURN"));
  EXPECT_TRUE(tools.setNumber("7", "LBREAK", breakage));
  EXPECT_TRUE(tools.setText("7.1", "NAME", "TURN_B"));
  EXPECT_TRUE(tools.setText("7.1", "TYP", "TURN"));
  return tools;
}

hh::TypedTable turningTable(const Turned& world, const std::string& row = "7") {
  hh::TypedTable table = hh::defaultTurningToolTable();
  EXPECT_TRUE(table.setNumber(row, "ZL", world.zl));
  EXPECT_TRUE(table.setNumber(row, "XL", world.xl));
  EXPECT_TRUE(table.setNumber(row, "DZL", world.dzl));
  EXPECT_TRUE(table.setNumber(row, "DXL", world.dxl));
  return table;
}

Turned turned(Dice& dice) {
  Turned world;
  world.bench.preset(1, {0, 0, -400});
  world.bench.believedProbe().maximumTravel = 30;
  world.posture = {dice.whole(0, 1), written(dice.between(-180, 180))};
  world.zl = written(dice.between(80, 150), 4);
  world.xl = written(dice.between(-20, 20), 4);
  world.dzl = written(dice.between(-0.1, 0.1), 4);
  world.dxl = written(dice.between(-0.1, 0.1), 4);
  world.missing = {dice.between(-0.2, 0.2), dice.between(-0.2, 0.2)};
  return world;
}

Words circleWords(int cycle, double nominal) {
  return {{273, 0},
          {274, 0},
          {262, nominal},
          {325, 0},
          {247, 90},
          {261, -10},
          {320, 0},
          {260, 30},
          {301, 1},
          {cycle == 421 ? 275 : 277, 0},
          {cycle == 421 ? 276 : 278, 0},
          {279, 0},
          {280, 0},
          {281, 0},
          {309, 0},
          {330, 7},
          {423, 4},
          {365, 1}};
}

TEST(Inspection, CorrectsTurningToolsSoThatTheNextPartIsRight) {
  Dice dice(4217);
  for (int at = 0; at < 80; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Turned world = turned(dice);
    const TableFolder folder(world.bench);
    folder.put("TOOL.T", toolTable(2));
    folder.put("TOOLTURN.TRN", turningTable(world));
    const Words posture = {{498, world.posture.reversed}, {531, world.posture.incidence}};
    const int cycle = std::array{421, 422, 427}[static_cast<std::size_t>(dice.whole(0, 2))];
    const bool byName = dice.coin();
    const auto blocks = [&](Words words) {
      if (!byName) return probe(cycle, words);
      std::erase_if(words, [](const auto& word) { return word.first == 330; });
      return probe(cycle, words, " ~\n  QS330=\"TURN\" ;TOOL");
    };
    int measured = 0;  // of the two components of the error
    std::string text;
    if (cycle == 427) {
      measured = dice.whole(0, 1);
      // A turned face, cylinder or bore that the tip's error has moved.
      // On either side of the turning axis.
      const double side = measured == 0 && dice.coin() ? -1 : 1;
      const bool bored = measured == 0 && dice.coin();
      const double nominal = measured == 0 ? side * 40 : 0;
      const double actual = nominal + side * world.missing[measured];
      const double other = actual + (bored ? side : -side) * 60;
      const double sense = bored ? side : -side;
      const bool turned = measured == 0;
      const Vector3 least(turned ? std::min(actual, other) : -40, -40, -70);
      const Vector3 greatest(turned ? std::max(actual, other) : 40, 40, turned ? 0 : actual);
      world.bench.part(simulation::Box(least, greatest), pose({0, 0, -400}));
      text = blocks(with({{263, measured == 0 ? nominal : 0},
                          {264, 0},
                          {261, measured == 0 ? -10 : nominal},
                          {320, 0},
                          {272, measured == 0 ? 1 : 3},
                          {267, sense},
                          {260, 30},
                          {281, 0},
                          {288, 0},
                          {289, 0},
                          {309, 0},
                          {330, 7}},
                         posture));
    } else {
      const double nominal = 50, diameter = nominal + 2 * world.missing[0];
      if (cycle == 421) {
        world.bench.part(simulation::Ring(diameter / 2, 60, -40), pose({0, 0, -400}));
      } else {
        world.bench.part(simulation::RoundBar(diameter / 2, -40, 0), pose({0, 0, -400}));
      }
      text = blocks(with(circleWords(cycle, nominal), posture));
    }
    const Ran ran = world.bench.run(text);
    ASSERT_TRUE(ran.finished()) << ran.why();
    // Both deltas have four decimals.
    EXPECT_NEAR(world.left(ran)[measured], 0, 1e-4);
    // The mill's columns stay.
    EXPECT_EQ(ran.cell("TOOL.T", "7", "DR"), 0);
  }
}

TEST(Inspection, KnowsTurningToolsByIndexAndWhatTheyNeed) {
  Dice dice(4218);
  Turned world = turned(dice);
  world.bench.part(simulation::Ring(25.1, 60, -40), pose({0, 0, -400}));
  const TableFolder folder(world.bench);
  folder.put("TOOL.T", toolTable(0.15));
  folder.put("TOOLTURN.TRN", turningTable(world, "7.1"));
  const Words words = with(circleWords(421, 50), {{498, 0}, {531, 0}});
  // 0.2 mm too large: without a row in TOOLTURN.TRN nothing can be corrected; tool 7.1 has one and no LBREAK.
  EXPECT_EQ(world.bench.run(probe(421, with(words, {{330, 7.1}}))).why(), "");
  folder.put("TOOLTURN.TRN", turningTable(world));
  const Ran broken = world.bench.run(probe(421, words));
  folder.put("TOOLTURN.TRN", turningTable(world, "7.1"));
  EXPECT_EQ(broken.alarm(), "Tool breakage");
  EXPECT_NE(broken.why().find("LBREAK"), std::string::npos) << broken.why();
  EXPECT_EQ(broken.table("TOOL.T").text("7", "TL"), "L");
  folder.put("TOOL.T", toolTable(0.3));
  const Ran missing = world.bench.run(probe(421, words));
  EXPECT_EQ(missing.alarm(), "Tool not defined");
  EXPECT_NE(missing.why().find("TOOLTURN.TRN"), std::string::npos) << missing.why();
  const Ran unsaid = world.bench.run(probe(421, with(circleWords(421, 50), {{330, 7.1}})));
  EXPECT_EQ(unsaid.alarm(), "Cycle parameter wrong");
  EXPECT_NE(unsaid.why().find("Q531"), std::string::npos) << unsaid.why();
  // Cycles without Q498 know mills and drills only.
  world.bench.setup.world.truth.solids.clear();
  world.bench.part(simulation::Box({-30, 10, -20}, {30, 30, 0}), pose({0, 0, -400}));
  world.bench.part(simulation::Box({-30, -30, -20}, {30, -10, 0}), pose({0, 0, -400}));
  const Ran slot = world.bench.run(probe(425, {{328, 0},
                                               {329, 0},
                                               {310, 5},
                                               {272, 2},
                                               {261, -5},
                                               {260, 20},
                                               {311, 20},
                                               {288, 0},
                                               {289, 0},
                                               {281, 0},
                                               {309, 0},
                                               {330, 7.1},
                                               {320, 0},
                                               {301, 0}}));
  EXPECT_EQ(slot.alarm(), "Tool type not permitted");
}

}  // namespace
}  // namespace probewright::testing_support
