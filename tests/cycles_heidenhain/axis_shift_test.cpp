#include "control/heidenhain/axis_shift_table.hpp"
#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"

/// Cycle 440 of the iTNC 530: how far the axes have shifted since a calibration, by a tool at the tool touch probe.
namespace probewright::testing_support {
namespace {

constexpr double exact = 2e-6;

/// A tool touch probe on the table, a calibrating tool (tool 9), a block with a wall at X+0 of the preset.
struct Shifting {
  Bench bench{ControlKind::iTNC530};
  Vector3 contact = Vector3::Zero();  ///< middle of its upper edge
  double radius = 0;                  ///< of the tool
  bool disc = false;                  ///< the contact is round
  std::string before = "TOOL CALL 9 Z\n";

  Ran run(int mode, int directions, const std::string& after = {}) const {
    return bench.runBare(before + probe(440, {{363, mode}, {364, directions}, {320, 1}, {260, 20}}) + after);
  }
  void shift(const Vector3& amount) {
    auto& errors = bench.setup.world.truth.errors;
    errors.axes.resize(3);
    for (std::size_t i = 0; i < 3; ++i)
      errors.axes[i].offset = amount[static_cast<Eigen::Index>(i)];
  }
};

Shifting shifting(Dice& dice) {
  Shifting world;
  Bench& bench = world.bench;
  bench.preset(1, {0, 0, -420});
  world.radius = written(dice.between(4, 12), 4);
  const double length = written(dice.between(60, 90), 4);
  bench.knows(9, "PIN", length, world.radius);
  simulation::TrueTool pin;
  pin.number = 9;
  pin.name = "PIN";
  pin.kind = simulation::ToolKind::Cutter;
  pin.length = length;
  pin.radius = world.radius;
  bench.setup.world.truth.tools.push_back(pin);
  world.contact = {written(dice.between(120, 160)), written(dice.between(-80, -60)), written(dice.between(-480, -460))};
  const double half = written(dice.between(12, 20));
  world.disc = dice.coin();
  if (world.disc) {
    placeToolProbe(bench.setup.world.truth, simulation::RoundBar(half, -10, 0), pose(world.contact));
  } else {
    placeToolProbe(bench.setup.world.truth, simulation::Box({-half, -half, -10}, {half, half, 0}), pose(world.contact));
  }
  bench.part(simulation::Box({0, -20, -40}, {40, 20, 0}), pose({0, 0, -420}));
  // The control knows place and size a little wrong.
  const Vector3 roughly = world.contact + dice.within(world.disc ? 0.05 : 0.5);
  const char* names[] = {"MP6580.0", "MP6580.1", "MP6580.2"};
  for (int i = 0; i < 3; ++i)
    bench.setup.beliefs.parameters[names[i]] = {roughly[i], {}};
  bench.setup.beliefs.parameters["MP6531"] = {2 * half, {}};
  return world;
}

/// AXSHIFT.TAB as a run has left it; the cycles that wrote it count as read.
control::heidenhain::TypedTable calibration(const Ran& ran) {
  coverage::writesRead(ran.outcome.control, ran.outcome.journal,
                       [](const control::WriteRecord& write) { return write.table == "AXSHIFT.TAB"; });
  Diagnostics diagnostics;
  auto table = control::heidenhain::TypedTable::parse(ran.outcome.files.at("AXSHIFT.TAB"), "AXSHIFT.TAB",
                                                      control::heidenhain::axisShiftColumns(), diagnostics);
  EXPECT_TRUE(table);
  return *table;
}

TEST(Cycle440, WritesWhereItMetTheToolTouchProbe) {
  Dice dice(4404);
  for (int at = 0; at < 40; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Shifting world = shifting(dice);
    const int directions = at % 8;
    const Ran ran = world.run(0, directions);
    ASSERT_TRUE(ran.finished()) << ran.why();
    const auto table = calibration(ran);
    EXPECT_EQ(table.text("1", "TOOL"), "9");
    EXPECT_EQ(table.number("1", "DIRECTION"), directions);
    // The tip stands on the upper edge, the flank beside it.
    constexpr double flank = 1e-5;  // how far a tool enters a solid of the bench before they count as touching
    EXPECT_NEAR(*table.number("1", "Z"), world.contact.z(), flank);
    const double half = std::get<double>(world.bench.setup.beliefs.parameters.at("MP6531").value) / 2;
    static constexpr int senses[8][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
    for (int axis = 0; axis < 2; ++axis) {
      const int sense = senses[directions][axis];
      using control::heidenhain::NumberColumn;
      const NumberColumn column = axis == 0 ? NumberColumn("X") : NumberColumn("Y");
      if (sense == 0) {
        EXPECT_EQ(table.text("1", column), "");
        continue;
      }
      const double near = world.disc ? 0.05 * 0.05 / 12 : flank;
      EXPECT_NEAR(*table.number("1", column), world.contact[axis] - sense * (half + world.radius), near);
    }
    // The next calibration overwrites it, also what it does not probe.
    const Ran again =
        world.bench.runBare(world.before + probe(440, {{363, 0}, {364, directions}, {320, 1}, {260, 20}}) +
                            probe(440, {{363, 0}, {364, 0}, {320, 1}, {260, 20}}));
    ASSERT_TRUE(again.finished()) << again.why();
    EXPECT_EQ(calibration(again).text("1", "Y"), "");
    EXPECT_EQ(calibration(again).number("1", "DIRECTION"), 0);
    // Measuring writes nothing.
    const Ran measured =
        world.bench.runBare(world.before + probe(440, {{363, 0}, {364, directions}, {320, 1}, {260, 20}}) +
                            probe(440, {{363, 1}, {364, directions}, {320, 1}, {260, 20}}));
    ASSERT_TRUE(measured.finished()) << measured.why();
    EXPECT_TRUE(measured.cycle().writes.empty());
    EXPECT_EQ(calibration(measured).table().bytes(), table.table().bytes());
  }
}

/// The spindle turns afterwards as it did before.
TEST(Cycle440, LeavesTheSpindleAsItWas) {
  Dice dice(4407);
  for (const char* function : {"M3", "M4", "M5"}) {
    Shifting world = shifting(dice);
    const Ran ran =
        world.bench.runBare(fmt::format("TOOL CALL 9 Z S640\n{}\n", function) +
                            probe(440, {{363, 0}, {364, 4}, {320, 1}, {260, 20}}) + "FN 18: SYSREAD Q1 = ID20 NR5\n");
    ASSERT_TRUE(ran.finished()) << ran.why();
    // -1: it has not run yet
    EXPECT_EQ(ran.q(1), function == std::string("M3") ? 0 : function == std::string("M4") ? 1 : -1);
  }
}

/// What is wrong at both runs alike drops out: length and radius of the tool, its place, pretravel. Scales and
/// squareness do not: an axis that displays too little shifts by less.
TEST(Cycle440, IsWrongByTheGeometryOfTheMachineOnly) {
  Dice dice(4405);
  for (int at = 0; at < 30; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Shifting world = shifting(dice);
    if (world.disc) continue;
    auto& believed = world.bench.setup.beliefs.tools.back();
    believed.length += written(dice.between(-0.5, 0.5), 4);
    believed.radius += written(dice.between(-0.5, 0.5), 4);
    auto& errors = world.bench.setup.world.truth.errors;
    errors.axes.resize(3);
    for (auto& axis : errors.axes)
      axis.scale = dice.between(-1e-3, 1e-3);
    const double square = dice.between(-0.05, 0.05);
    errors.squareness = {{0, 1, square}};
    const Ran calibrated = world.run(0, 4);
    ASSERT_TRUE(calibrated.finished()) << calibrated.why();
    const TableFolder folder(world.bench);
    folder.put("AXSHIFT.TAB", calibrated.outcome.files.at("AXSHIFT.TAB"));
    const Vector3 shift = dice.within(0.3);
    world.shift(shift);
    const Ran ran = world.run(1, 4);
    ASSERT_TRUE(ran.finished()) << ran.why();
    // The offsets are those of the slides, along their own directions: X drags Y along.
    const double aside = std::sin(radians(square));
    EXPECT_NEAR(ran.q(185), -shift.x() / (1 + errors.axes[0].scale), exact);
    EXPECT_NEAR(ran.q(186), -(shift.y() + shift.x() * aside) / (1 + errors.axes[1].scale), exact);
    EXPECT_NEAR(ran.q(187), -shift.z() / (1 + errors.axes[2].scale), exact);
  }
}

/// The results are in the unit of the program; each run resets them, and the spindle is left as it was.
TEST(Cycle440, ResetsItsResultsAndLeavesTheSpindleRunning) {
  Dice dice(4406);
  Shifting world = shifting(dice);
  world.disc = false;
  const std::string old = "Q184 = 4\nQ185 = 5\nQ186 = 6\nQ187 = 7\nQ188 = 8\n";
  const Words words = {{363, 0}, {364, 4}, {320, 1}, {260, 20}};
  const Ran calibrated = world.bench.runBare("TOOL CALL 9 Z S100\nM4\n" + old + probe(440, words));
  ASSERT_TRUE(calibrated.finished()) << calibrated.why();
  for (int i = 185; i <= 187; ++i)
    EXPECT_EQ(calibrated.q(i), 0);
  EXPECT_EQ(calibrated.q(184), 4) << "a result of another cycle";
  EXPECT_EQ(calibrated.q(188), 8) << "a result of another cycle";
  EXPECT_EQ(calibrated.q(110), 1) << "M4 is active";
  const Ran refused = world.bench.runBare(world.before + old + probe(440, with(words, {{363, 1}})));
  EXPECT_EQ(refused.alarm(), "Axis shift not calibrated");
  for (int i = 185; i <= 187; ++i)
    EXPECT_EQ(refused.q(i), 0);
  const TableFolder folder(world.bench);
  folder.put("AXSHIFT.TAB", calibrated.outcome.files.at("AXSHIFT.TAB"));
  world.shift({0.1016, -0.0508, 0.2032});
  const Ran inch =
      world.bench.runBare(world.before + probe(440, {{363, 1}, {364, 4}, {320, 0.04}, {260, 0.8}}), "INCH");
  ASSERT_TRUE(inch.finished()) << inch.why();
  EXPECT_NEAR(inch.q(187), -0.008, 1e-7);
  EXPECT_NEAR(inch.q(185), -0.004, 1e-4);
}

TEST(Cycle440, FindsAnyShiftOfTheAxes) {
  Dice dice(440);
  for (int at = 0; at < 60; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Shifting world = shifting(dice);
    const int directions = dice.whole(0, 7);
    const Ran calibrated = world.run(0, directions);
    ASSERT_TRUE(calibrated.finished()) << calibrated.why();
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(calibrated.q(185 + i), 0);
    // The tip stands above the contact again.
    EXPECT_GE(calibrated.machine->tipOnTable().z(), -400 - exact);
    const TableFolder folder(world.bench);
    folder.put("AXSHIFT.TAB", calibrated.outcome.files.at("AXSHIFT.TAB"));
    const Vector3 shift = dice.within(0.3);
    world.shift(shift);
    const Ran ran = world.run(1, directions);
    ASSERT_TRUE(ran.finished()) << ran.why();
    const bool alongX = directions == 0 || directions == 2 || directions > 3;
    const bool alongY = directions == 1 || directions == 3 || directions > 3;
    // A disc that is met beside its middle is met later.
    const double near = world.disc ? 0.35 * 0.35 / (2 * 12) : exact;
    EXPECT_NEAR(ran.q(185), alongX ? -shift.x() : 0, near);
    EXPECT_NEAR(ran.q(186), alongY ? -shift.y() : 0, near);
    EXPECT_NEAR(ran.q(187), -shift.z(), exact);
    EXPECT_EQ(ran.touches(), 1U + (alongX ? 1 : 0) + (alongY ? 1 : 0));
  }
}

TEST(Cycle440, LetsADatumShiftFollowTheAxes) {
  Dice dice(4401);
  Shifting world = shifting(dice);
  const std::string wall = "TOOL CALL 1 Z\n" + probe(427, {{263, 0},
                                                           {264, 0},
                                                           {261, -8},
                                                           {320, 0},
                                                           {272, 1},
                                                           {267, 1},
                                                           {260, 20},
                                                           {281, 0},
                                                           {288, 0},
                                                           {289, 0},
                                                           {309, 0},
                                                           {330, 0}});
  const Ran calibrated = world.run(0, 4, wall);
  ASSERT_TRUE(calibrated.finished()) << calibrated.why();
  EXPECT_NEAR(calibrated.q(160), 0, exact);
  const TableFolder folder(world.bench);
  folder.put("AXSHIFT.TAB", calibrated.outcome.files.at("AXSHIFT.TAB"));
  world.shift({0.17, -0.11, 0.08});
  const Ran wrong = world.run(1, 4, wall);
  ASSERT_TRUE(wrong.finished()) << wrong.why();
  EXPECT_NEAR(wrong.q(160), -0.17, exact);
  const std::string follow = "CYCL DEF 7.0 SHIFT\nCYCL DEF 7.1 IX+Q185\nCYCL DEF 7.2 IY+Q186\nCYCL DEF 7.3 IZ+Q187\n";
  const Ran right = world.run(1, 4, follow + wall);
  ASSERT_TRUE(right.finished()) << right.why();
  EXPECT_NEAR(right.q(160), 0, exact);
}

TEST(Cycle440, RefusesAndStops) {
  Dice dice(4402);
  Shifting world = shifting(dice);
  EXPECT_EQ(world.run(1, 4).alarm(), "Axis shift not calibrated");
  EXPECT_EQ(world.bench.runBare(probe(440, {{363, 0}, {364, 0}, {320, 0}, {260, 20}})).alarm(),
            "Touch probe axis not defined");
  const Ran calibrated = world.run(0, 4);
  ASSERT_TRUE(calibrated.finished()) << calibrated.why();
  const TableFolder folder(world.bench);
  folder.put("AXSHIFT.TAB", calibrated.outcome.files.at("AXSHIFT.TAB"));
  const Ran other = world.run(1, 5);
  EXPECT_EQ(other.alarm(), "Probing directions differ");
  EXPECT_NE(other.why().find("Q364 = 5"), std::string::npos) << other.why();
  EXPECT_EQ(other.q(185), 0);

  control::heidenhain::TypedTable tools = control::heidenhain::defaultToolTable(ControlKind::iTNC530);
  ASSERT_TRUE(tools.setText("9", "NAME", "PIN"));
  ASSERT_TRUE(tools.setNumber("9", "L", world.bench.setup.beliefs.tools.back().length));
  ASSERT_TRUE(tools.setNumber("9", "R", world.radius));
  ASSERT_TRUE(tools.setNumber("9", "LTOL", 0.05));
  ASSERT_TRUE(tools.setNumber("9", "RTOL", 0.1));
  folder.put("TOOL.T", tools);
  world.shift({0.08, 0, 0.03});
  EXPECT_TRUE(world.run(1, 4).finished()) << world.run(1, 4).why();
  world.shift({0.08, 0, 0.06});
  const Ran length = world.run(1, 4);
  EXPECT_EQ(length.alarm(), "Axis shift too large");
  EXPECT_NE(length.why().find("LTOL"), std::string::npos) << length.why();
  EXPECT_NEAR(length.q(187), -0.06, exact);
  world.shift({0.12, 0, 0.03});
  const Ran radius = world.run(1, 4);
  EXPECT_EQ(radius.alarm(), "Axis shift too large");
  EXPECT_NE(radius.why().find("RTOL"), std::string::npos) << radius.why();

  Shifting gone = shifting(dice);
  gone.bench.setup.world.truth.solids.clear();
  gone.bench.setup.world.truth.toolProbes.clear();
  EXPECT_EQ(gone.run(0, 4).alarm(), "Touch probe not ready");
  Shifting away = shifting(dice);
  away.bench.setup.world.truth.solids.front().tableFromSolid.translation().z() -= 100;
  away.bench.setup.world.truth.toolProbes.front().tableFromContact.translation().z() -= 100;
  EXPECT_EQ(away.run(0, 4).alarm(), "Touch point inaccessible");
  Shifting unset = shifting(dice);
  unset.bench.setup.beliefs.parameters.clear();
  EXPECT_EQ(unset.run(0, 4).alarm(), "Tool touch probe not calibrated");
  Bench newer(ControlKind::TNC640);
  EXPECT_FALSE(newer.run(probe(440, {{363, 0}, {364, 0}, {320, 0}, {260, 20}})).finished());
}

TEST(Cycle440, UsesFeedsDepthAndOffsetsOfTheTables) {
  Dice dice(4403);
  Shifting world = shifting(dice);
  const Ran plain = world.run(0, 0);
  ASSERT_TRUE(plain.finished()) << plain.why();
  const auto seconds = [](const Ran& ran) { return ran.cycle().endSeconds - ran.cycle().startSeconds; };
  world.bench.setup.beliefs.parameters["MP6520"] = {30.0, {}};
  const Ran slow = world.run(0, 0);
  EXPECT_GT(seconds(slow), seconds(plain) + 10);
  world.bench.setup.beliefs.parameters["MP6550"] = {100.0, {}};
  EXPECT_GT(seconds(world.run(0, 0)), seconds(slow) + 60);
  // The top is touched beside the middle by R-OFFS, the side MP6530 plus L-OFFS below the upper edge.
  const auto tip = [&](const Ran& ran, std::size_t touch) {
    const auto& latched = ran.cycle().touches[touch].latched;
    return Vector3(latched[0], latched[1], latched[2] - world.bench.setup.beliefs.tools.back().length);
  };
  const double depth = tip(plain, 0).z() - tip(plain, 1).z();
  control::heidenhain::TypedTable tools = control::heidenhain::defaultToolTable(ControlKind::iTNC530);
  ASSERT_TRUE(tools.setText("9", "NAME", "PIN"));
  ASSERT_TRUE(tools.setNumber("9", "L", world.bench.setup.beliefs.tools.back().length));
  ASSERT_TRUE(tools.setNumber("9", "R", world.radius));
  ASSERT_TRUE(tools.setNumber("9", "R-OFFS", 1.5));
  ASSERT_TRUE(tools.setNumber("9", "L-OFFS", 2));
  const TableFolder folder(world.bench);
  folder.put("TOOL.T", tools);
  const Ran offset = world.run(0, 0);
  ASSERT_TRUE(offset.finished()) << offset.why();
  EXPECT_NEAR(tip(plain, 0).x() - tip(offset, 0).x(), world.radius - 1.5, exact);
  EXPECT_NEAR(tip(offset, 0).z() - tip(offset, 1).z(), depth + 2, exact);
}

/// Another pin than the one that calibrated: the run goes on, but the operator is told.
TEST(Cycle440, WarnsOfAnotherTool) {
  Dice dice(4407);
  Shifting world = shifting(dice);
  simulation::TrueTool other = world.bench.setup.world.truth.tools.back();
  other.number = 8;
  other.name = "OTHER";
  world.bench.setup.world.truth.tools.push_back(other);
  world.bench.knows(8, "OTHER", other.length, other.radius);
  const Words calibrate = {{363, 0}, {364, 4}, {320, 1}, {260, 20}}, measure = with(calibrate, {{363, 1}});
  const auto warnings = [&](int tool) {
    const Ran ran = world.bench.runBare(world.before + probe(440, calibrate) + fmt::format("TOOL CALL {} Z\n", tool) +
                                        probe(440, measure));
    EXPECT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(185), 0, exact);
    std::string text;
    for (const auto& event : ran.outcome.journal.events) {
      if (event.kind == control::EventKind::Warning) text += event.text;
    }
    return text;
  };
  EXPECT_EQ(warnings(9), "");
  EXPECT_NE(warnings(8).find("Tool 8 measures, but tool 9 has calibrated"), std::string::npos);
}

/// Place and size of the contact come from [tool_probe] of the setup.
TEST(Cycle440, KnowsTheToolTouchProbeOfTheSetup) {
  Diagnostics diagnostics;
  const auto setup = setup::parseSetup(R"(
[control]
type = "iTNC530"
[tool_probe]
size = [30, 30]
pose = { x = 120, y = -60, z = -450 }
[[preset]]
row = 1
origin = [0, 0, -430]
active = true
[[tool]]
number = 9
kind = "mill"
length = 80
radius = 6
[[tool]]
number = 1
kind = "probe"
length = 100
ball_radius = 2
)",
                                       "setup.toml", diagnostics);
  ASSERT_TRUE(setup) << format(diagnostics.front());
  Shifting world{};
  world.bench.setup = *setup;
  const Ran ran = world.run(0, 4);
  ASSERT_TRUE(ran.finished()) << ran.why();
  ASSERT_EQ(ran.touches(), 3U);
  const auto& touches = ran.cycle().touches;
  EXPECT_NEAR(touches[0].latched[2], -450 + 80, exact);
  EXPECT_NEAR(touches[1].latched[0], 120 - 15 - 6, exact);
  EXPECT_NEAR(touches[2].latched[1], -60 - 15 - 6, exact);
}

}  // namespace
}  // namespace probewright::testing_support
