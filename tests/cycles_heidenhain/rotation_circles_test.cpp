#include "cycles_heidenhain/rotation_worlds.hpp"

/// Cycle 1411: the misalignment of two circles, tolerances, the alignment of a rotary table.
namespace probewright::testing_support {
namespace {

TEST(Cycle1411, FindsTheMisalignmentOfAnyTwoCircles) {
  Dice dice(1411);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 0.8, 0.3);
    const Circles circles = layCircles(dice, place);
    const int position = dice.whole(0, 3);
    const int rotation = dice.whole(0, 1);
    const Words words = with(with(circles.words(dice), common(dice, place)),
                             {{1120, position}, {1121, rotation}, {1125, dice.whole(1, 2)}});
    const Ran ran = place.bench.run(place.before + probe(1411, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    for (int i = 0; i < 2; ++i) {
      const auto at = static_cast<std::size_t>(i);
      for (int axis = 0; axis < 2; ++axis) {
        EXPECT_NEAR(ran.q(950 + 3 * i + axis), circles.centre[at][axis], exact);
        EXPECT_NEAR(ran.q(980 + 3 * i + axis), circles.centre[at][axis] - circles.nominal[at][axis], exact);
      }
      EXPECT_NEAR(ran.q(966 + i), circles.diameter[at], exact);
    }
    const double turned = std::remainder(angleBetween(circles.centre) - angleBetween(circles.nominal), 360);
    EXPECT_NEAR(ran.q(964), angleBetween(circles.centre), exact);
    EXPECT_NEAR(ran.q(994), turned, exact);
    EXPECT_EQ(ran.q(183), -1);
    if (position == 0) continue;
    expectTransfer(ran, place, aboutZ(rotation * turned), chosen(position, circles.centre),
                   chosen(position, circles.nominal));
    EXPECT_NE(ran.log("TCHPRAUTO.html").find("<h2>1411 "), std::string::npos);
  }
}

TEST(Cycle1411, MonitorsDiametersAndCentres) {
  Dice dice(14111);
  int states[4] = {0, 0, 0, 0};
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 0.2, 0.1);
    Circles circles = layCircles(dice, place);
    const double nominal = written(circles.diameter[0] + dice.between(-0.3, 0.3), 2);
    const double low = -0.2, high = 0.1;
    Words words = with(circles.words(dice), common(dice, place));
    words = with(words, {{1125, 1}, {309, dice.whole(0, 2)}});
    const double reaction = std::ranges::find(words, 309, &std::pair<int, double>::first)->second;
    std::erase_if(words, [](const auto& word) { return word.first == 1116 || word.first == 1100; });
    const double width = written(dice.between(0.05, 0.4), 3);
    const std::string texts = fmt::format(" ~\n  QS1116=\"{:.2f}-0,2+0.1\" ;D ~\n  QS1100=\"{:.3f}+-{:.3f}\" ;X",
                                          nominal, circles.nominal[0].x(), width);
    const Ran ran = place.bench.run(place.before + probe(1411, words, texts));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const double size = circles.diameter[0] - nominal;
    const bool stud = circles.geometry == 1 || circles.geometry == 3;
    int state = 0;
    if (size > high) state = stud ? 1 : 2;
    if (size < low) state = stud ? 2 : 1;
    if (std::abs(circles.centre[0].x() - circles.nominal[0].x()) > width) state = 2;
    ++states[state];
    EXPECT_EQ(ran.q(183), state);
    EXPECT_NEAR(ran.q(996), size - (low + high) / 2, exact);
    const auto stops =
        std::ranges::count(ran.outcome.journal.events, control::EventKind::Stop, &control::EventRecord::kind);
    const bool asked = (reaction == 1 && state > 0) || (reaction == 2 && state == 2);
    EXPECT_EQ(stops, asked ? 1 : 0);
  }
  EXPECT_GT(states[0], 5);
  EXPECT_GT(states[1], 5);
  EXPECT_GT(states[2], 5);
}

TEST(Cycle1411, AlignsTheRotaryTable) {
  Dice dice(14112);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    Place place = placeAt(dice, 0.8, 0.3, dice.coin() ? "mill5-table-table" : "mill5-head-table");
    place.before.clear();
    const Pose inputFromPart = place.inputFromPart();
    place.machineFromInput = place.machineFromPreset;
    place.machineFromPart = place.machineFromPreset * inputFromPart;
    const Circles circles = layCircles(dice, place);
    const int rotation = dice.whole(1, 2);
    const Words words = with(with(circles.words(dice), common(dice, place)),
                             {{1120, dice.whole(1, 3)}, {1121, rotation}, {1126, dice.whole(1, 2)}, {1125, 2}});
    // Measured again, the rotation is gone and what was transferred stands where it should.
    const Ran once = place.bench.run(probe(1411, words));
    ASSERT_TRUE(once.finished()) << once.why();
    const double turned = std::remainder(angleBetween(circles.centre) - angleBetween(circles.nominal), 360);
    EXPECT_NEAR(once.q(994), turned, exact);
    // C turns the workpiece against its own count.
    EXPECT_NEAR(once.q(995), -turned, exact);
    const std::size_t axis = *once.machine->description().axisIndex("C");
    EXPECT_NEAR(std::remainder(once.machine->position()[axis] - turned, 360), 0, exact);
    if (rotation == 2) {
      EXPECT_NEAR(once.cell("PRESET.PR", "1", "C_OFFS"), turned, 1e-4);
    }
    const Ran twice = place.bench.run(probe(1411, words) + probe(1411, with(words, {{1126, 0}, {1121, 0}})));
    ASSERT_TRUE(twice.finished()) << twice.why();
    EXPECT_NEAR(twice.q(994), 0, exact);
    const double position = std::ranges::find(words, 1120, &std::pair<int, double>::first)->second;
    for (int i = 0; i < 2; ++i) {
      if (position != i + 1) continue;
      EXPECT_NEAR(twice.q(980 + 3 * i), 0, exact);
      EXPECT_NEAR(twice.q(981 + 3 * i), 0, exact);
    }
  }
}

/// The ways in which printed programs write the parameters.
TEST(Cycle1411, ReadsBlocksAsTheyArePrinted) {
  Bench bench;
  bench.preset(1, {0, 0, -400}, 0);
  bench.part(simulation::Ring(4.65, 15, -20), pose({30, 50.01, -400}));
  bench.part(simulation::Ring(4.4, 15, -20), pose({75, 50, -400}));
  const Ran ran = bench.run(
      "TCH PROBE 1411 TWO CIRCLES\n  Q1100=+30 ;1ST POINT\n  Q1101= +50 ;1ST POINT\n  Q1102= -5 ;1ST POINT\n"
      "  QS1116=\"+10-1-0.5\";DIAMETER 1\n  Q1103= +75 ;2ND POINT\n  Q1104=+50 ;2ND POINT\n  QS1105= -5 ;2ND POINT\n"
      "  QS1117=\"+10-1-0,5\";DIAMETER 2\n  Q1115=0 ;GEOMETRY\n  Q423=4 ;POINTS\n  Q325=+0 ;ANGLE\n"
      "  Q1119=+360;LENGTH\n  Q320=+0 ;CLEARANCE\n  Q260=+100 ;HEIGHT\n  Q1125=+2 ;MODE\n  Q309=+2 ;REACTION\n"
      "  Q1126=+0 ;ALIGN\n  Q1120=+0 ;TRANSFER\n  Q1121=+0 ;ROTATION\n");
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(ran.q(966), 9.3, exact);
  EXPECT_NEAR(ran.q(996), 0.05, exact);
  EXPECT_NEAR(ran.q(967), 8.8, exact);
  EXPECT_NEAR(ran.q(997), -0.45, exact);
  // Too small a hole can be reworked: Q309 = 2 lets it pass.
  EXPECT_EQ(ran.q(183), 1);
}

TEST(Cycle1411, ReducesTheClearanceInSmallHoles) {
  Bench bench;
  bench.preset(1, {0, 0, -400}, 0);
  bench.part(simulation::Ring(3.5, 20, -40), pose({-40, 0, -400}));
  bench.part(simulation::Ring(3.5, 20, -40), pose({40, 0.5, -400}));
  const Words words = {{1100, -40}, {1101, 0}, {1102, -8}, {1116, 7}, {1103, 40},  {1104, 0}, {1105, -8},
                       {1117, 7},   {1115, 0}, {423, 4},   {325, 0},  {1119, 360}, {320, 2},  {260, 20},
                       {1125, 1},   {309, 0},  {1126, 0},  {1120, 0}, {1121, 0}};
  const Ran ran = bench.run(probe(1411, words));
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(ran.q(954), 0.5, exact);
  const auto stops =
      std::ranges::count(ran.outcome.journal.events, control::EventKind::Stop, &control::EventRecord::kind);
  EXPECT_EQ(stops, 2);
  // What is shown: the nominal diameter, the ball radius, and the clearance that is left of the radius.
  ASSERT_EQ(ran.screens().size(), 2U);
  for (const char* line : {"1411 object 2: the hole is too small", "Nominal diameter 7.0000", "Ball radius 2.0000",
                           "Possible set-up clearance 1.5000"}) {
    EXPECT_NE(ran.screens().back().find(line), std::string::npos) << ran.screens().back();
  }
  // Cancelled at the first of them: nothing has been touched.
  bench.onStop = control::OnStop::Abort;
  const Ran cancelled = bench.run(probe(1411, words));
  EXPECT_EQ(cancelled.outcome.result.end, execution::RunEnd::Cancelled);
  EXPECT_EQ(cancelled.touches(), 0U);
  bench.onStop = control::OnStop::Continue;
  const Ran tooSmall = bench.run(probe(1411, with(words, {{1117, 3}})));
  EXPECT_EQ(tooSmall.alarm(), "Hole too small");
}

/// A hole with just the room for the set-up clearance: nothing is asked.
TEST(Cycle1411, AsksNothingWhereTheClearanceJustFits) {
  Bench bench(ControlKind::TNC640);
  bench.preset(1, {0, 0, -400});
  bench.probeOf(110, 3);
  for (const double x : {-40.0, 40.0})
    bench.part(simulation::Ring(5, 20, -40), pose({x, 0, -400}));
  // Ball radius 3 and SET_UP 2 make 5, half of the nominal diameter.
  const Ran ran = bench.run(probe(1411, {{1100, -40},
                                         {1101, 0},
                                         {1102, -8},
                                         {1116, 10},
                                         {1103, 40},
                                         {1104, 0},
                                         {1105, -8},
                                         {1117, 10},
                                         {1115, 0},
                                         {423, 4},
                                         {325, 0},
                                         {1119, 360},
                                         {320, 0},
                                         {260, 20},
                                         {1125, 1},
                                         {309, 0},
                                         {1126, 0},
                                         {1120, 0},
                                         {1121, 0}}));
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_TRUE(ran.screens().empty());
  EXPECT_NEAR(ran.q(950), -40, exact);
}

}  // namespace
}  // namespace probewright::testing_support
