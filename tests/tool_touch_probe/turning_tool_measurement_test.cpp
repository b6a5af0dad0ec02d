#include <gmock/gmock.h>

#include <set>

#include "control/heidenhain/turning_tool_table.hpp"
#include "setup/setup.hpp"
#include "tool_touch_probe/tool_worlds.hpp"

/// Cycle 485: lengths of turning tools, by where their tips point.
namespace probewright::testing_support {
namespace {

/// A turning tool in a mill that turns, and a cuboid to touch.
struct Turning {
  explicit Turning(Dice& dice) : folder(world.bench) {
    world.contact = {written(dice.between(80, 160)), written(dice.between(-80, 0)), written(dice.between(-480, -460))};
    world.cuboid(written(dice.between(16, 30)), written(dice.between(16, 30)));
  }

  /// The insert of a tip that points to (x, z), each -1, 0 or 1, in the spindle at the angle `orientation`; its edges
  /// face `half` degrees away from there.
  void plant(double xLength, double zLength, double nose, int x, int z, double orientation, double half = 50) {
    simulation::TrueTool tool;
    tool.length = zLength;
    tool.radius = 2;
    tool.cutter.shankRadius = 2;
    simulation::TrueInsert insert;
    insert.noseRadius = nose;
    const double towards = degrees(std::atan2(z, x));
    insert.firstNormal = towards - half;
    insert.secondNormal = towards + half;
    insert.orientation = -orientation;
    tool.cutter.insert = insert;
    tool.cutter.eccentricity = {xLength, 0};
    world.add(tool, 12, zLength, nose);
    world.bench.setup.beliefs.tools.back().kind = "turn";
  }

  /// TOOL.T and TOOLTURN.TRN of the tool.
  void enterTool(const std::vector<std::pair<std::string, std::string>>& turning,
                 const std::vector<std::pair<std::string, std::string>>& entries = {}) {
    auto all = entries;
    all.emplace_back("TYP", "TURN");
    enter(folder, world, all);
    auto table = control::heidenhain::defaultTurningToolTable();
    EXPECT_TRUE(table.ensureRow("12"));
    for (const auto& [column, text] : turning)
      EXPECT_TRUE(table.setText("12", control::heidenhain::Column::named(column), text)) << column;
    folder.put("TOOLTURN.TRN", table);
  }

  double turned(const Ran& ran, const char* column) const {
    const std::string entry = fmt::format("row 12, column {}", column);
    coverage::writesRead(ran.outcome.control, ran.outcome.journal,
                         [&](const control::WriteRecord& write) { return write.entry == entry; });
    Diagnostics diagnostics;
    auto table = control::heidenhain::TypedTable::parse(ran.outcome.files.at("TOOLTURN.TRN"), "TOOLTURN.TRN",
                                                        control::heidenhain::turningToolColumns(), diagnostics);
    return table ? table->number("12", control::heidenhain::NumberColumn::named(column)).value_or(std::nan(""))
                 : std::nan("");
  }

  Ran run(int mode) const { return world.run(probe(485, {{340, mode}, {260, 60}})); }

  ToolWorld world;
  TableFolder folder;
};

std::string text(double value) { return fmt::format("{:+.4f}", value); }

struct Direction {
  int orientation, x, z;
  bool measuresZ, measuresX;
};

TEST(TurningToolMeasurement, FindsTheLengthsThatTheOrientationLetsItTouch) {
  Dice dice(4850);
  const Direction directions[] = {{1, -1, -1, true, true},
                                  {7, 1, -1, true, true},
                                  {2, -1, 0, false, true},
                                  {6, 1, 0, false, true},
                                  {8, 0, -1, true, false}};
  for (int at = 0; at < 15; ++at) {
    const Direction& direction = directions[at % 5];
    SCOPED_TRACE(fmt::format("world {} TO {}", at, direction.orientation));
    Turning turning(dice);
    const double nose = written(dice.between(0.2, 1.2)), x = dice.between(-40, 40), z = dice.between(70, 110);
    const double orientation = written(dice.between(-180, 180), 1);
    turning.plant(x, z, nose, direction.x, direction.z, orientation);
    const double believedX = written(x + dice.between(-1, 1)), believedZ = written(z + dice.between(-1, 1));
    turning.enterTool({{"ZL", text(believedZ)},
                       {"XL", text(believedX)},
                       {"RS", text(nose)},
                       {"TO", fmt::format("{}", direction.orientation)},
                       {"ORI", fmt::format("{:.1f}", orientation)},
                       {"TYPE", "ROUGH"}});
    const Ran ran = turning.run(at < 5 ? 0 : 1);
    ASSERT_TRUE(ran.finished()) << ran.why();
    if (at < 5) {
      EXPECT_NEAR(turning.turned(ran, "ZL"), direction.measuresZ ? z : believedZ, 5.1e-5);
      EXPECT_NEAR(turning.turned(ran, "XL"), direction.measuresX ? x : believedX, 5.1e-5);
      EXPECT_EQ(turning.turned(ran, "DZL"), 0);
      continue;
    }
    if (direction.measuresZ) {
      EXPECT_NEAR(ran.q(115), z - believedZ, 2e-6);
      EXPECT_NEAR(turning.turned(ran, "DZL"), z - believedZ, 5.1e-5);
    }
    if (direction.measuresX) {
      EXPECT_NEAR(ran.q(116), x - believedX, 2e-6);
      EXPECT_NEAR(turning.turned(ran, "DXL"), x - believedX, 5.1e-5);
    }
  }
}

/// Each type of tool with each orientation: both lengths, one, or a refusal, as the page of the cycle lists them. The
/// length across the direction of a tip that points straight along or across is to the middle of its nose.
TEST(TurningToolMeasurement, MeasuresOfEachTypeWhatItsOrientationPermits) {
  Dice dice(4854);
  constexpr std::pair<int, int> pointing[] = {{-1, -1}, {-1, 0}, {-1, 1}, {0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}};
  const std::set<int> wideX = {1, 2, 3, 5, 6, 7}, wideZ = {1, 7, 8}, narrowX = {1, 2, 3, 5, 7, 8},
                      narrowZ = {1, 2, 7, 8};
  for (const char* type : {"ROUGH", "FINISH", "BUTTON", "RECESS", "RECTURN", "THREAD"}) {
    const bool narrow = std::string(type).starts_with("REC") || std::string(type) == "THREAD";
    for (int orientation = 1; orientation <= 9; ++orientation) {
      SCOPED_TRACE(fmt::format("{} TO {}", type, orientation));
      Turning turning(dice);
      const double nose = written(dice.between(0.2, 1.2)), x = dice.between(-40, 40), z = dice.between(70, 110);
      const auto [towardsX, towardsZ] = pointing[orientation == 9 ? 0 : orientation - 1];
      // The sides of a recessing tool are parallel.
      const bool straight = narrow && (towardsX == 0 || towardsZ == 0);
      turning.plant(x, z, nose, towardsX, towardsZ, 0, straight ? 89.9999 : 50);
      const double believedX = written(x + dice.between(-1, 1)), believedZ = written(z + dice.between(-1, 1));
      turning.enterTool({{"ZL", text(believedZ)},
                         {"XL", text(believedX)},
                         {"RS", text(nose)},
                         {"TO", fmt::format("{}", orientation)},
                         {"TYPE", type}});
      const bool measuresX = (narrow ? narrowX : wideX).contains(orientation),
                 measuresZ = (narrow ? narrowZ : wideZ).contains(orientation);
      const Ran ran = turning.run(0);
      EXPECT_EQ(ran.alarm(), measuresX || measuresZ ? "" : "Tool orientation not permitted") << ran.why();
      if (!ran.finished()) continue;
      EXPECT_NEAR(turning.turned(ran, "ZL"), measuresZ ? z : believedZ, 5.1e-5);
      EXPECT_NEAR(turning.turned(ran, "XL"), measuresX ? x : believedX, 5.1e-5);
      ASSERT_FALSE(ran.screens().empty());
      EXPECT_EQ(ran.screens().back().find("ZL") != std::string::npos, measuresZ);
      EXPECT_EQ(ran.screens().back().find("XL") != std::string::npos, measuresX);
    }
  }
}

/// A setup without tables: the control knows the tool as it was planted, but for what the setup says of its beliefs.
TEST(TurningToolMeasurement, KnowsATurningToolOfASetup) {
  const std::pair<std::string, int> directions[] = {{"[-90, 180]", 1}, {"[-90, 0]", 7}, {"[-140, -220]", 2}};
  for (const auto& [normals, orientation] : directions) {
    SCOPED_TRACE(orientation);
    const std::string text =
        "[machine]\nname = \"mill3\"\n[control]\ntype = \"TNC640\"\n[tool_probe]\nsize = [24, 20]\nthickness = 8\n"
        "pose = { x = 250, y = 120, z = -560 }\n[[preset]]\nrow = 1\norigin = [0, 0, -480]\nactive = true\n"
        "[[tool]]\nnumber = 12\nname = \"TURN\"\nkind = \"turn\"\nlength = 90.3\nradius = 0.8\n"
        "believed_length = 90\n[tool.cutter]\nshank_radius = 5\neccentricity = [20, 0]\n"
        "[tool.cutter.insert]\nnose_radius = 0.8\nedge_normals = " +
        normals + "\n";
    Diagnostics diagnostics;
    const auto setup = setup::parseSetup(text, "turn.toml", diagnostics);
    ASSERT_TRUE(setup) << format(diagnostics.front());
    session::RunOptions options;
    options.control = ControlKind::TNC640;
    const Ran ran(setup::runText(
        "BENCH.H", "BEGIN PGM BENCH MM\nTOOL CALL 12 Z\n" + probe(485, {{340, 1}, {260, 60}}) + "END PGM BENCH MM\n",
        *setup, options, {.recordPath = false}));
    ASSERT_TRUE(ran.finished()) << ran.why();
    if (orientation != 2) {
      EXPECT_NEAR(ran.q(115), 0.3, 2e-6);
    }
    EXPECT_NEAR(ran.q(116), 0, 2e-6);
  }
}

/// What the manuals warn of: data that are farther off than 2 mm may end in a collision.
TEST(TurningToolMeasurement, NeedsDataThatAreAboutRight) {
  Dice dice(4855);
  for (const double wrong : {-2.0, 2.0, 8.0}) {
    Turning turning(dice);
    turning.plant(25, 90, 0.8, -1, -1, 0);
    turning.enterTool({{"ZL", text(90 - wrong)}, {"XL", "25"}, {"RS", "0.8"}, {"TO", "1"}});
    const Ran ran = turning.run(0);
    EXPECT_EQ(ran.alarm(), wrong > 2 ? "Collision" : "") << ran.why();
    EXPECT_NEAR(turning.turned(ran, "ZL"), wrong > 2 ? 90 - wrong : 90, 5.1e-5);
  }
}

/// The example that the manuals print: a check.
TEST(TurningToolMeasurement, RunsThePrintedExample) {
  Dice dice(4853);
  Turning turning(dice);
  turning.plant(25.5, 88.25, 0.8, -1, -1, 0);
  turning.enterTool({{"ZL", "88.2200"}, {"XL", "25.5500"}, {"RS", "0.8"}, {"TO", "1"}, {"TYPE", "ROUGH"}});
  const Ran ran = turning.world.bare(
      "6 TOOL CALL 12 Z\n7 TCH PROBE 485 IZMERIT TOKARNYJ INSTR. ~\n  Q340=+1 ;PROWERKA ~\n  Q260=+100 ;HEIGHT\n");
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(ran.q(115), 0.03, 2e-6);
  EXPECT_NEAR(ran.q(116), -0.05, 2e-6);
  EXPECT_NEAR(turning.turned(ran, "DZL"), 0.03, 5.1e-5);
  EXPECT_NEAR(turning.turned(ran, "DXL"), -0.05, 5.1e-5);
  // In the words of the other edition.
  const Ran other = turning.world.bare(
      "6 TOOL CALL 12 Z\n7 TCH PROBE 485 MAT VRIDVERKTYG ~\n  Q340=+1 ;KONTROLL ~\n  Q260=+100 ;H\n");
  EXPECT_NEAR(other.q(115), 0.03, 2e-6);
}

TEST(TurningToolMeasurement, LocksBeyondItsTolerances) {
  Dice dice(4851);
  for (const int mode : {0, 1, 2}) {
    for (const auto& [wrong, status] : {std::pair(0.02, 0), std::pair(0.1, 1), std::pair(0.5, 2)}) {
      SCOPED_TRACE(fmt::format("mode {} wrong {}", mode, wrong));
      Turning turning(dice);
      turning.plant(10, 90, 0.8, -1, -1, 0);
      turning.world.parameter("stopOnCheck", "", 0);
      // In mode 2 the delta values count, too.
      turning.enterTool({{"ZL", mode == 2 ? "+88.0000" : text(90 - wrong)},
                         {"DZL", mode == 2 ? text(2 - wrong) : "0"},
                         {"XL", "+10.0000"},
                         {"TO", "1"},
                         {"TYPE", "FINISH"}},
                        {{"LTOL", "0.05"}, {"LBREAK", "0.2"}});
      const Ran ran = turning.run(mode);
      ASSERT_TRUE(ran.finished()) << ran.why();
      EXPECT_EQ(ran.q(199), status);
      const std::string mark = mode == 0 || status == 0 ? "" : status == 1 ? " *" : " B";
      EXPECT_NE(ran.screens().back().find("+90.0000" + mark + "\n"), std::string::npos) << ran.screens().back();
      EXPECT_EQ(ran.table("TOOL.T").text("12", "TL"), mode > 0 && status > 0 ? "L" : "");
      turning.world.parameter("stopOnCheck", "", 1);
      EXPECT_EQ(turning.run(mode).alarm(), mode > 0 && status == 2 ? "Tool breakage" : "");
    }
  }
}

TEST(TurningToolMeasurement, RefusesWhatItCannotMeasure) {
  Dice dice(4852);
  const auto refusal = [&](const std::vector<std::pair<std::string, std::string>>& entries) {
    Turning turning(dice);
    turning.plant(10, 90, 0.8, -1, -1, 0);
    auto all = std::vector<std::pair<std::string, std::string>>{{"ZL", "90"}, {"XL", "10"}, {"TO", "1"}};
    all.insert(all.end(), entries.begin(), entries.end());
    turning.enterTool(all);
    return turning.run(1).alarm();
  };
  EXPECT_EQ(refusal({}), "");
  EXPECT_EQ(refusal({{"SPB-INSERT", "5"}}), "Tool angle not permitted");
  EXPECT_EQ(refusal({{"YL", "4"}, {"DYL", "1.5"}}), "Touch point inaccessible");
  for (const char* to : {"4", "9"})
    EXPECT_EQ(refusal({{"TO", to}}), "Tool orientation not permitted");
  for (const char* type : {"RECESS", "RECTURN", "THREAD"})
    EXPECT_EQ(refusal({{"TO", "6"}, {"TYPE", type}}), "Tool orientation not permitted");
  Turning round(dice);
  round.plant(10, 90, 0.8, -1, -1, 0);
  round.enterTool({{"ZL", "90"}, {"XL", "10"}, {"TO", "1"}});
  round.world.parameter("rectStylus", "", 0);
  EXPECT_EQ(round.run(1).alarm(), "Tool touch probe not suitable");
  Turning across(dice);
  across.plant(10, 90, 0.8, -1, -1, 0);
  across.enterTool({{"ZL", "90"}, {"XL", "10"}, {"TO", "1"}});
  EXPECT_EQ(across.world.bare("TOOL CALL 12 Y\n" + probe(485, {{340, 1}, {260, 60}})).alarm(),
            "Tool axis not permitted");
  Turning unknown(dice);
  unknown.plant(10, 90, 0.8, -1, -1, 0);
  unknown.world.bench.setup.beliefs.tools.back().kind = "mill";
  enter(unknown.folder, unknown.world, {{"TYP", "TURN"}});
  EXPECT_EQ(unknown.run(1).alarm(), "Tool type not permitted") << "no row in TOOLTURN.TRN";
  Turning mill(dice);
  mill.plant(10, 90, 0.8, -1, -1, 0);
  mill.world.bench.setup.beliefs.tools.back().kind = "mill";
  EXPECT_EQ(mill.run(1).alarm(), "Tool type not permitted");
}

}  // namespace
}  // namespace probewright::testing_support
