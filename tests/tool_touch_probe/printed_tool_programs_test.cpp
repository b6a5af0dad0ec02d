#include <gmock/gmock.h>

#include "tool_touch_probe/tool_worlds.hpp"

/// The examples that the manuals print for cycles 30 to 33 and 480 to 484, in the words of each edition, in a world
/// that the control knows a little wrong. 485 is in the tests of turning tools.
namespace probewright::testing_support {
namespace {

using testing::HasSubstr;

/// What an edition calls the lines of the old form.
struct Edition {
  ControlKind control;
  const char* name;
  const char* height;
  const char* check;
  const char* teeth;
};

const std::vector<Edition>& editions() {
  static const std::vector<Edition> all = {
      {ControlKind::TNC640, "KALIBROWKA TT", "WYSOTA:", "PROWIERIT:", "IZMERENJE RESH.KROMOK"},
      {ControlKind::TNC640, "KALIBRERING AV TT", "HOEJD:", "KONTROLL:", "AVKAENNING AV SKAER"},
      {ControlKind::iTNC530, "CALIBRATE TT", "HEIGHT:", "CHECK:", "PROBING THE TEETH:"},
      {ControlKind::iTNC530, "TT KALIBROWA\xC4\x86", "WYSOKO\xC5\x9A\xC4\x86:", "SPRAWDZENIE:", "POMIAR OSTRZY:"}};
  return all;
}

/// The pin is tool 1, the mill tool 12.
struct Printed {
  explicit Printed(const Edition& edition_, Dice& dice)
      : edition(edition_), world(edition.control), folder(world.bench) {
    world.bench.setup.world.truth.tools.clear();
    world.bench.setup.beliefs.tools.clear();
    world.contact = {written(dice.between(80, 160)), written(dice.between(-80, 0)), written(dice.between(-480, -460))};
    world.disc(written(dice.between(36, 40)));
    simulation::TrueTool pin;
    pin.length = 74.5;
    pin.radius = 6;
    world.add(pin, 1, pin.length, pin.radius);
    mill.length = written(dice.between(70, 90));
    mill.radius = written(dice.between(8, 10));
    mill.cutter.cutLength = 30;
    for (int i = 0; i < 4; ++i)
      mill.cutter.teeth.push_back({.angle = 20.0 + 90 * i, .radial = -0.01 * i, .axial = -0.03 * ((i + 2) % 4)});
    world.add(mill, 12, mill.length - wrongLength, mill.radius - wrongRadius);
    world.parameter("measureTolerance1", "MP6510", tolerance);
    world.parameter("stopOnCheck", "", 0);
    enter(folder, world, {{"CUT", "4"}, {"LTOL", "0.05"}, {"RTOL", "0.05"}, {"LBREAK", "0.2"}, {"RBREAK", "0.2"}});
  }

  std::string old(int cycle, const std::string& check, int teeth) const {
    return fmt::format(
        "TOOL CALL 12 Z\n7 TCH PROBE {0}.0 {1}\n8 TCH PROBE {0}.1 {2} {3}\n9 TCH PROBE {0}.2 {4} +120\n"
        "10 TCH PROBE {0}.3 {5} {6}\n",
        cycle, edition.name, edition.check, check, edition.height, edition.teeth, teeth);
  }
  std::string current(int cycle) const {
    return fmt::format(
        "TOOL CALL 12 Z\n7 TCH PROBE {} {} ~\n  Q340=1 ;CHECK ~\n  Q260=+100 ;HEIGHT ~\n  Q341=1 ;TEETH\n", cycle,
        edition.name);
  }

  /// A check of single teeth: of lengths exact, of radii after a touch with the turning tool.
  void expectChecked(const Ran& ran, int cycle, int statusIn) const {
    ASSERT_TRUE(ran.finished()) << ran.why();
    const int kind = cycle % 10;
    const bool length = kind != 2, radius = kind != 1;
    if (length) {
      EXPECT_NEAR(ran.q(115), wrongLength, 1e-4);
      EXPECT_NEAR(ran.cell("TOOL.T", "12", "DL"), wrongLength, 1e-4);
    }
    if (radius) {
      EXPECT_NEAR(ran.q(116), wrongRadius, tolerance + 1e-4);
      EXPECT_NEAR(ran.cell("TOOL.T", "12", "DR"), wrongRadius, tolerance + 1e-4);
    }
    // Worn: each tooth is held against the tolerances, and the shortest is 0.09 mm shorter than the longest.
    EXPECT_EQ(ran.q(statusIn), length ? 1 : 0);
    EXPECT_EQ(ran.table("TOOL.T").text("12", "TL"), length ? "L" : "");
    const auto screens = ran.screens();
    ASSERT_FALSE(screens.empty());
    if (length) {
      EXPECT_THAT(screens.back(), HasSubstr(fmt::format("{:+.4f}", mill.length - 0.06)));
    }
  }

  static constexpr double wrongLength = 0.02, wrongRadius = -0.01, tolerance = 0.002;
  Edition edition;
  ToolWorld world;
  TableFolder folder;
  simulation::TrueTool mill;
};

TEST(PrintedToolPrograms, CalibrateInTheOldAndTheNewForm) {
  Dice dice(4870);
  for (const Edition& edition : editions()) {
    SCOPED_TRACE(edition.name);
    Printed printed(edition, dice);
    for (const char* wrong : {"calibratedContactX", "calibratedContactY", "calibratedContactZ",
                              "calibratedContactRadius1", "calibratedContactRadius2"})
      printed.world.bench.setup.beliefs.parameters[wrong] = {7.0, {}};
    for (const bool old : {true, false}) {
      const std::string cycle =
          old ? fmt::format("7 TCH PROBE 30.0 {}\n8 TCH PROBE 30.1 {} +90\n", edition.name, edition.height)
              : fmt::format("7 TCH PROBE 480 {} ~\n  Q260=+100 ;HEIGHT\n", edition.name);
      const Ran ran = printed.world.bare("6 TOOL CALL 1 Z\n" + cycle);
      ASSERT_TRUE(ran.finished()) << ran.why();
      const auto values = found(ran);
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(values[static_cast<std::size_t>(i)], printed.world.contact[i], 2e-6);
      EXPECT_NEAR(values[3], printed.world.half1, 2e-6);
      EXPECT_THAT(ran.screens(), testing::Not(testing::IsEmpty()));
    }
  }
}

/// 484: the tool is changed above the tool touch probe, whose place the control does not know. The iTNC 530 has no
/// parameters for it.
TEST(PrintedToolPrograms, CalibrateAnInfraredToolTouchProbe) {
  Dice dice(4874);
  for (const Edition& edition : editions()) {
    SCOPED_TRACE(edition.name);
    Printed printed(edition, dice);
    for (const char* wrong : {"calibratedContactX", "calibratedContactY", "calibratedContactZ",
                              "calibratedContactRadius1", "calibratedContactRadius2"})
      printed.world.bench.setup.beliefs.parameters[wrong] = {7.0, {}};
    const Vector3 above = printed.world.contact + Vector3(0.6, -0.4, 7 + 74.5);
    for (std::size_t i = 0; i < 3; ++i)
      printed.world.bench.setup.world.truth.machine.toolChange[i] = above[static_cast<Eigen::Index>(i)];
    const bool newer = edition.control == ControlKind::TNC640;
    const std::string text =
        fmt::format("6 TOOL CALL 1 Z\n7 TCH PROBE 484 {}{}\n", edition.name, newer ? " ~\n  Q536=+0 ;STOP" : "");
    const Ran ran = printed.world.bare(text);
    ASSERT_TRUE(ran.finished()) << ran.why();
    const auto values = found(ran);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(values[static_cast<std::size_t>(i)], printed.world.contact[i], 2e-6);
    EXPECT_NEAR(values[3], printed.world.half1, 2e-6);
    EXPECT_THAT(ran.screens().front(), HasSubstr("Position the calibrating tool"));
    // The tool ends above the middle, and the operator may say no.
    ASSERT_TRUE(ran.machine);
    EXPECT_NEAR(ran.machine->position()[0], printed.world.contact.x(), 1e-5);
    EXPECT_NEAR(ran.machine->position()[1], printed.world.contact.y(), 1e-5);
    printed.world.bench.onStop = control::OnStop::Abort;
    const Ran aborted = printed.world.bare(text);
    EXPECT_EQ(aborted.outcome.result.end, execution::RunEnd::Cancelled);
    EXPECT_EQ(aborted.touches(), 0U);
  }
}

TEST(PrintedToolPrograms, MeasureForTheFirstTimeInTheOldForm) {
  Dice dice(4871);
  for (const Edition& edition : editions()) {
    SCOPED_TRACE(edition.name);
    Printed printed(edition, dice);
    for (const int cycle : {31, 32, 33}) {
      const Ran ran = printed.world.bare("6 " + printed.old(cycle, "0", 0));
      ASSERT_TRUE(ran.finished()) << ran.why();
      const double length = ran.cell("TOOL.T", "12", "L"), radius = ran.cell("TOOL.T", "12", "R");
      const bool findsLength = cycle != 32, findsRadius = cycle != 31;
      // With the turning tool: too short and too thin by at most the feed of a turn.
      const double actualLength = printed.mill.length, actualRadius = printed.mill.radius;
      EXPECT_NEAR(length, findsLength ? actualLength : actualLength - Printed::wrongLength, Printed::tolerance + 1e-4);
      EXPECT_NEAR(radius, findsRadius ? actualRadius : actualRadius - Printed::wrongRadius, Printed::tolerance + 1e-4);
      EXPECT_THAT(ran.screens(), testing::Not(testing::IsEmpty()));
    }
  }
}

TEST(PrintedToolPrograms, CheckEachToothAndStoreTheStatusInQ5) {
  Dice dice(4872);
  for (const Edition& edition : editions()) {
    Printed printed(edition, dice);
    for (const int cycle : {31, 32, 33}) {
      SCOPED_TRACE(fmt::format("{} {}", edition.name, cycle));
      printed.expectChecked(printed.world.bare("6 " + printed.old(cycle, "1 Q5", 1)), cycle, 5);
    }
  }
}

TEST(PrintedToolPrograms, CheckEachToothInTheNewForm) {
  Dice dice(4873);
  for (const Edition& edition : editions()) {
    Printed printed(edition, dice);
    for (const int cycle : {481, 482, 483}) {
      SCOPED_TRACE(fmt::format("{} {}", edition.name, cycle));
      printed.expectChecked(printed.world.bare("6 " + printed.current(cycle)), cycle, 199);
    }
  }
}

}  // namespace
}  // namespace probewright::testing_support
