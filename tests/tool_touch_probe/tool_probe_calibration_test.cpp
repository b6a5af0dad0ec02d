#include <gmock/gmock.h>

#include <sstream>

#include "tool_touch_probe/tool_worlds.hpp"

/// Cycles 480, 30 and 484: where the tool touch probe is found, and what mistakes in the calibration do to the tools.
namespace probewright::testing_support {
namespace {

using testing::HasSubstr;

/// A calibrating pin whose axis is not that of the spindle.
struct Calibrating {
  Calibrating(ControlKind kind, Dice& dice) : world(kind) {
    world.contact = {written(dice.between(80, 160)), written(dice.between(-80, 0)), written(dice.between(-480, -460))};
    dice.coin() ? world.disc(written(dice.between(20, 40)))
                : world.cuboid(written(dice.between(16, 30)), written(dice.between(16, 30)));
    pin.length = written(dice.between(60, 90));
    pin.radius = written(dice.between(5, 9));
    pin.cutter.eccentricity = {dice.between(-0.03, 0.03), dice.between(-0.03, 0.03)};
  }
  void believePlace(const Vector3& place) {
    const char* tnc640[] = {"centerPos.0", "centerPos.1", "centerPos.2"};
    const char* iTNC530[] = {"MP6580.0", "MP6580.1", "MP6580.2"};
    for (int i = 0; i < 3; ++i)
      world.parameter(tnc640[i], iTNC530[i], place[i]);
  }
  std::string cycle(int form) const {
    if (form == 0) return probe(480, {{260, 60}});
    if (form == 1) return "TCH PROBE 30.0 CALIBRATE TT\nTCH PROBE 30.1 HEIGHT: +60\n";
    // Above the tool touch probe, about in its middle; coordinates of the workpiece.
    const std::string there = fmt::format("L X{:+.3f} Y{:+.3f} R0 FMAX\nL Z{:+.3f} R0 FMAX\n", world.contact.x() + 0.4,
                                          world.contact.y() - 0.6, world.contact.z() + 420 + 6);
    return there + (world.bench.control == ControlKind::TNC640 ? probe(484, {{536, 1}}) : "TCH PROBE 484 CALIBRATE\n");
  }

  ToolWorld world;
  simulation::TrueTool pin;
};

/// What the screen shows of the tool's run-out.
Vector2 runOutOf(const Ran& ran) {
  const std::string title = "RUN-OUT OF THE TOOL ";
  for (const std::string& screen : ran.screens()) {
    const std::size_t at = screen.find(title);
    if (at == std::string::npos) continue;
    std::istringstream numbers(screen.substr(at + title.size()));
    Vector2 found;
    numbers >> found.x() >> found.y();
    return found;
  }
  return Vector2::Constant(1e9);
}

TEST(ToolProbeCalibration, FindsPlaceAndWidthWithAPinThatRunsOut) {
  Dice dice(4801);
  for (int at = 0; at < 12; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Calibrating calibrating(controlOf(at), dice);
    calibrating.world.toolProbe().pretravel = at % 3 == 0 ? 0.004 : 0;
    calibrating.world.add(calibrating.pin, 9, calibrating.pin.length, calibrating.pin.radius);
    const int form = at / 2 % 3;
    if (form < 2) calibrating.believePlace(calibrating.world.contact + dice.within(2));
    for (const char* wrong : {"calibratedContactX", "calibratedContactY", "calibratedContactZ",
                              "calibratedContactRadius1", "calibratedContactRadius2"})
      calibrating.world.bench.setup.beliefs.parameters[wrong] = {7.0, {}};
    const Ran ran = calibrating.world.run(calibrating.cycle(form), 9);
    ASSERT_TRUE(ran.finished()) << ran.why();
    const auto values = found(ran);
    const double early = calibrating.world.toolProbe().pretravel;
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(values[static_cast<std::size_t>(i)], calibrating.world.contact[i] - (i == 2 ? early : 0), 2e-6) << i;
    EXPECT_NEAR(values[3], calibrating.world.half1 - early, 2e-6);
    EXPECT_NEAR(values[4], calibrating.world.half2 - early, 2e-6);
    const auto& aside = calibrating.pin.cutter.eccentricity;
    const Vector2 told = runOutOf(ran);
    EXPECT_NEAR(told.x(), aside.x(), 1.1e-4) << ran.screens().back();
    EXPECT_NEAR(told.y(), aside.y(), 1.1e-4) << ran.screens().back();
  }
}

TEST(ToolProbeCalibration, FindsCuboidsThatAreLongerThanWide) {
  Dice dice(4804);
  for (int at = 0; at < 6; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Calibrating calibrating(controlOf(at), dice);
    const double edge = written(dice.between(14, 20)), longer = edge + written(dice.between(12, 25));
    calibrating.world.bench.setup.world.truth.toolProbes.clear();
    at % 2 == 0 ? calibrating.world.cuboid(edge, longer) : calibrating.world.cuboid(longer, edge);
    for (const char* wrong : {"calibratedContactRadius1", "calibratedContactRadius2"})
      calibrating.world.bench.setup.beliefs.parameters[wrong] = {7.0, {}};
    calibrating.world.add(calibrating.pin, 9, calibrating.pin.length, calibrating.pin.radius);
    const Ran ran = calibrating.world.run(calibrating.cycle(at / 2), 9);
    ASSERT_TRUE(ran.finished()) << ran.why();
    const auto values = found(ran);
    EXPECT_NEAR(values[3], calibrating.world.half1, 2e-6);
    EXPECT_NEAR(values[4], calibrating.world.half2, 2e-6);
  }
}

/// What the pin is thicker and longer than TOOL.T says makes the contact wider and higher, and tools thinner and
/// shorter by as much.
TEST(ToolProbeCalibration, HandsTheMistakesOfThePinOnToTheTools) {
  Dice dice(4802);
  for (int at = 0; at < 4; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Calibrating calibrating(controlOf(at), dice);
    const double thicker = written(dice.between(-0.1, 0.1)), longer = written(dice.between(-0.1, 0.1));
    calibrating.world.add(calibrating.pin, 9, calibrating.pin.length - longer, calibrating.pin.radius - thicker);
    simulation::TrueTool mill;
    mill.length = 75.25;
    mill.radius = 6.125;
    mill.cutter.teeth.resize(2);
    mill.cutter.teeth[1].angle = 180;
    calibrating.world.add(mill, 12, 75.25, 6.125);
    calibrating.world.parameter("measureTolerance1", "MP6510", 0.001);
    const Ran ran =
        calibrating.world.run(calibrating.cycle(at / 2 % 2) + "TOOL CALL 12 Z\n" + toolCycle(483, 1, false, false), 9);
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(found(ran)[3], calibrating.world.half1 + thicker, 2e-6);
    EXPECT_NEAR(ran.q(115), -longer, 0.0011);
    EXPECT_NEAR(ran.q(116), -thicker, 0.0011);
  }
}

/// A tilted top is met off its middle: by the run-out of the edge that touches first.
TEST(ToolProbeCalibration, ATiltedContactMakesWideToolsLonger) {
  ToolWorld world;
  world.contact = {120, -60, -470};
  const double tilt = 0.2;
  placeToolProbe(world.bench.setup.world.truth, simulation::Box({-15, -15, -12}, {15, 15, 0}),
                 pose(world.contact, {0, tilt, 0}));
  world.half1 = world.half2 = 15;
  simulation::TrueTool mill;
  mill.length = 80;
  mill.radius = 10;
  mill.cutter.teeth.resize(1);
  world.add(mill, 12, 80, 10);
  world.parameter("measureTolerance1", "", 0.001);
  world.parameter("calibratedContactX", "", world.contact.x());
  TableFolder folder(world.bench);
  enter(folder, world, {{"R-OFFS", "0.0001"}, {"CUT", "1"}});
  const Ran ran = world.run(toolCycle(481, 1, false, false));
  ASSERT_TRUE(ran.finished()) << ran.why();
  // The top rises by tan(tilt) to -X: the tooth meets it there, a radius from the middle.
  EXPECT_NEAR(ran.q(115), 10 * std::tan(radians(tilt)), 0.0015);
}

/// A cuboid that is turned about the tool axis and tipped, and an exact pin of 5 mm radius.
struct Cuboid {
  Cuboid(ControlKind kind, double turned, double tipped) : world(kind) {
    world.contact = {120, -60, -470};
    placeToolProbe(world.bench.setup.world.truth, simulation::Box({-12.5, -10, -12}, {12.5, 10, 0}),
                   pose(world.contact, {tipped, 0, turned}));
    simulation::TrueTool pin;
    pin.length = 70;
    pin.radius = 5;
    world.add(pin, 9, 70, 5);
    world.parameter("detectStylusRot", "MP6500", kind == ControlKind::TNC640 ? 1 : 97 + 512);
    for (const char* wrong : {"calibratedContactRadius1", "calibratedContactRadius2"})
      world.bench.setup.beliefs.parameters[wrong] = {7.0, {}};
  }
  Ran calibrated() const { return world.run(probe(480, {{260, 60}}), 9); }

  ToolWorld world;
};

TEST(ToolProbeCalibration, FindsHowACuboidIsTurnedAndMeasuresToolsAtIt) {
  Dice dice(4804);
  for (int at = 0; at < 8; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    const double turned = dice.between(-1, 1);
    Cuboid cuboid(controlOf(at), turned, 0);
    cuboid.world.parameter("probingDirRadial", "MP6505", at / 2 % 4);
    cuboid.world.parameter("measureTolerance1", "MP6510", 0.001);
    simulation::TrueTool mill;
    mill.length = 75;
    mill.radius = 30;
    mill.cutter.teeth.resize(1);
    cuboid.world.add(mill, 12, 75, 30);
    TableFolder folder(cuboid.world.bench);
    const auto radius = [&] {
      const Ran ran = cuboid.world.run(
          probe(480, {{260, 60}}) + "TOOL CALL 12 Z\n" + probe(482, {{340, 1}, {260, 60}, {341, 0}}), 9);
      EXPECT_TRUE(ran.finished()) << ran.why();
      return ran.q(116);
    };
    const Ran ran = cuboid.calibrated();
    ASSERT_TRUE(ran.finished()) << ran.why();
    coverage::writesRead(ran.outcome.control, ran.outcome.journal,
                         [](const control::WriteRecord& write) { return write.entry.starts_with("TT "); });
    const auto values = found(ran);
    EXPECT_NEAR(values[3], 12.5, 2e-6);
    EXPECT_NEAR(values[4], 10, 2e-6);
    double found = 0;
    for (const auto& write : ran.cycle().writes)
      if (write.entry == "TT rotation") found = std::stod(write.after);
    EXPECT_NEAR(found, turned, 5.1e-5);
    EXPECT_THAT(ran.cycle().screens.back(), HasSubstr("ROTATION "));
    EXPECT_NEAR(radius(), 0, 0.0011);
    // Without it the larger tool is found larger by what the turn costs it beyond the pin.
    cuboid.world.parameter("detectStylusRot", "MP6500", cuboid.world.bench.control == ControlKind::TNC640 ? 0 : 97);
    EXPECT_NEAR(radius(), (30 - 5) * (1 / std::cos(radians(turned)) - 1), 0.0011);
  }
}

TEST(ToolProbeCalibration, WarnsOfACuboidThatIsTipped) {
  for (const double tipped : {0.1, -0.4}) {
    Cuboid cuboid(ControlKind::TNC640, 0.3, tipped);
    cuboid.world.parameter("tippingTolerance", "", 0.3);
    const Ran ran = cuboid.calibrated();
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_THAT(ran.cycle().screens.back(), HasSubstr(fmt::format("TIPPING {:.2f}", std::abs(tipped))));
    const auto& events = ran.outcome.journal.events;
    const bool warned = std::ranges::any_of(
        events, [](const control::EventRecord& event) { return event.text.find("contact is tipped by") == 4; });
    EXPECT_EQ(warned, std::abs(tipped) > 0.3);
  }
  // The end of a wide tool covers the whole contact: it cannot feel how that is tipped.
  Cuboid wide(ControlKind::TNC640, 0, 0.4);
  wide.world.parameter("tippingTolerance", "", 0.3);
  wide.world.bench.setup.world.truth.tools.back().radius = wide.world.bench.setup.beliefs.tools.back().radius = 9.8;
  const Ran ran = wide.calibrated();
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_TRUE(std::ranges::any_of(ran.outcome.journal.events, [](const control::EventRecord& event) {
    return event.text.find("too wide to determine") != std::string::npos;
  }));
}

/// Only the side that tools are measured at is touched, once with the spindle turned: where the middle is does not
/// matter then.
TEST(ToolProbeCalibration, TouchesOneSideWhereItIsToldTo) {
  Dice dice(4805);
  for (int at = 0; at < 8; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Calibrating calibrating(controlOf(at), dice);
    calibrating.world.add(calibrating.pin, 9, calibrating.pin.length, calibrating.pin.radius);
    calibrating.world.cuboid(24, 18);
    auto& probes = calibrating.world.bench.setup.world.truth;
    if (probes.toolProbes.size() > 1) {
      probes.toolProbes.erase(probes.toolProbes.begin());
      probes.solids.erase(probes.solids.begin());
    }
    const int direction = at / 2 % 4;
    calibrating.world.parameter("probingDirRadial", "MP6505", direction);
    calibrating.world.parameter("probingRoutine", "MP6500",
                                calibrating.world.bench.control == ControlKind::TNC640 ? 1 : 97 + 256);
    const Vector3 wrong = dice.within(1);
    calibrating.believePlace(calibrating.world.contact + wrong);
    simulation::TrueTool mill;
    mill.length = 75.25;
    mill.radius = 6.125;
    mill.cutter.teeth.resize(1);
    calibrating.world.add(mill, 12, 75.25, 6.125);
    calibrating.world.parameter("measureTolerance1", "MP6510", 0.001);
    const Ran ran =
        calibrating.world.run(calibrating.cycle(0) + "TOOL CALL 12 Z\n" + toolCycle(483, 1, false, false), 9);
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_EQ(ran.outcome.journal.cycles.front().touches.size(), 3U);
    const int axis = direction % 2, sense = direction < 2 ? 1 : -1;
    const double half = axis == 0 ? calibrating.world.half1 : calibrating.world.half2;
    EXPECT_NEAR(found(ran)[3 + static_cast<std::size_t>(axis)], half + sense * wrong[axis], 5.1e-5);
    EXPECT_NEAR(runOutOf(ran)[axis], calibrating.pin.cutter.eccentricity[axis], 1.1e-4) << ran.screens().front();
    EXPECT_NEAR(ran.q(115), 0, 0.0011);
    EXPECT_NEAR(ran.q(116), 0, 0.0011);
  }
}

TEST(ToolProbeCalibration, StopsForTheOperatorWhere484IsToldTo) {
  Dice dice(4803);
  Calibrating calibrating(ControlKind::TNC640, dice);
  calibrating.world.add(calibrating.pin, 9, calibrating.pin.length, calibrating.pin.radius);
  std::string program = calibrating.cycle(2);
  program.replace(program.find("Q536=+1"), 7, "Q536=+0");
  calibrating.world.parameter("calibratedContactX", "", 7);
  const Ran ran = calibrating.world.run(program, 9);
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_THAT(ran.screens().front(), HasSubstr("Position the calibrating tool"));
  EXPECT_NEAR(found(ran)[0], calibrating.world.contact.x(), 2e-6);
}

}  // namespace
}  // namespace probewright::testing_support
