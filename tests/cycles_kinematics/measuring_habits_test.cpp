#include "cycles_kinematics/sphere_worlds.hpp"

/// Cycle 451 beside its fit: presets, backlash, errors of probe and machine, collisions, refusals.
namespace probewright::testing_support {
namespace {

/// The value behind a label of an HTML log, in the n-th place where it stands.
double logged(const std::string& log, const std::string& label, int nth = 0, int cell = 0) {
  std::size_t at = 0;
  for (int i = 0; i <= nth; ++i)
    at = log.find("<td>" + label + "</td>", i == 0 ? 0 : at + 1);
  if (at == log.npos) return std::nan("");
  for (int i = 0; i <= cell; ++i)
    at = log.find("<td>", at + 1);
  return std::atof(log.c_str() + at + 4);
}

/// The probe stands roughly above the sphere, the preset is elsewhere.
TEST(SpherePreset, IsSetBeforeAndAfterMeasuring) {
  Dice dice(4520);
  for (const int preset : {1, 2, 3}) {
    for (std::size_t at = 0; at < 4; ++at) {
      SCOPED_TRACE(fmt::format("Q431={} on {}", preset, builds()[at].machine));
      SphereWorld world(builds()[at], controlOf(static_cast<int>(at)));
      world.plant(dice, 0.1, 0);
      // The preset table has four decimals.
      const Vector3 off = dice.within(0.8).unaryExpr([](double value) { return written(value, 4); });
      world.bench.setup.beliefs.presets.front().origin += off;
      const std::string above = fmt::format("L X{:+.4f} Y{:+.4f} R0 FMAX\nL Z{:+.4f} R0 FMAX\n", -off.x() + 0.6,
                                            -off.y() - 0.5, -off.z() + sphereRadius + 2 + 0.4);
      const Ran ran = world.bench.run(above + probe(451, words451(world.build, 1, {{431, preset}})));
      ASSERT_TRUE(ended(ran)) << ran.why();
      EXPECT_LT((ran.preset().translation() - world.build.sphere).norm(), 1e-6)
          << ran.preset().translation().transpose();
      EXPECT_NEAR(ran.cell("PRESET.PR", "1", "X"), world.build.sphere.x(), 1e-4);
      if (preset != 2) continue;
      EXPECT_NEAR(ran.q(147), -off.x(), 1e-6);
    }
  }
}

/// GLOBAL DEF may hold FMAX and FAUTO; a cycle with PREDEF then goes as with the word itself.
TEST(PositioningFeed, OfGlobalDefMayBeFmax) {
  const auto ranWith = [](const std::string& before, const std::string& feed) {
    SphereWorld world(builds()[0]);
    std::string block = probe(451, words451(world.build, 0));
    const std::size_t at = block.find("Q253=");
    block.replace(at, block.find_first_of(" ;\n", at) - at, "Q253=" + feed);
    const Ran ran = world.bench.run("L Z+20 R0 FMAX\n" + before + block);
    EXPECT_TRUE(ended(ran)) << feed << ": " << ran.why();
    return ran.outcome.info.totalSeconds;
  };
  const std::string global = "GLOBAL DEF 100 GENERAL ~\n Q200=2 ~\n Q204=50 ~\n Q253=FMAX ~\n Q208=999\n";
  EXPECT_NEAR(ranWith(global, "PREDEF"), ranWith("", "FMAX"), 1e-6);
  EXPECT_GT(ranWith("", "500"), 1.2 * ranWith("", "FMAX"));
}

TEST(Backlash, OfEachAxisIsInTheLog) {
  for (const double overrun : {0.5, -1.0}) {
    SphereWorld world(builds()[0]);
    auto& errors = world.bench.setup.world.truth.errors;
    errors.axes.resize(world.built().axes.size());
    errors.axes[*world.built().axisIndex("A")].backlash = 0.006;
    errors.axes[*world.built().axisIndex("C")].backlash = 0.011;
    const Ran ran = world.bench.run(probe(451, words451(world.build, 0, {{432, overrun}})));
    ASSERT_TRUE(ended(ran)) << ran.why();
    const std::string log = ran.log("TCHPR451.html");
    EXPECT_NEAR(logged(log, "Averaged backlash", 0), 0.006, 2e-6) << log;
    EXPECT_NEAR(logged(log, "Averaged backlash", 1), 0.011, 2e-6);
    // Each position twice.
    EXPECT_EQ(ran.touches(), 5U * 2 * (5 + 4));
  }
  SphereWorld none(builds()[0]);
  const Ran ran = none.bench.run(probe(451, words451(none.build, 0)));
  EXPECT_NE(ran.log("TCHPR451.html").find("<td>Averaged backlash</td><td>-</td>"), std::string::npos);
}

/// A probe that signals late by the same way everywhere is calibrated; what differs along its axis shifts every sphere
/// alike along the tool. On a table nothing of it is left; a head takes it for a longer pivot.
TEST(WrongProbe, ShiftsThePivotOfAHeadAndNothingElse) {
  // The equator is sought as much too low, which makes the pole of the fit lie a little higher.
  constexpr double late = 0.01, seen = late - late * late / (2 * (sphereRadius + 2));
  for (const std::size_t at : {0U, 1U}) {
    SphereWorld world(builds()[at]);
    world.bench.trueProbe().axialPretravel = late;  // the control believes none
    const Ran ran = world.bench.run(probe(451, words451(world.build, 1)));
    ASSERT_TRUE(ended(ran)) << ran.why();
    const machine::MachineDescription found = machine::corrected(world.built(), kinematicsOf(ran, world.built()).axes);
    const Apart off = apart(found, world.built(), at == 0 ? "AC" : "C");
    if (at == 0) {
      // The axis of A lies as much lower as the sphere is seen.
      EXPECT_NEAR(off.place, seen, 1e-7);
    } else {
      EXPECT_LT(off.place, 1e-6);
      EXPECT_NEAR(apart(found, world.built(), "B").place, seen, 1e-7);
    }
    EXPECT_LT(ran.q(at == 0 ? 144 : 145), 1e-6);
    EXPECT_LT(ran.q(146), 1e-6);
  }
}

/// Scatter of the probe: the error of the found axis is what the covariance of the fit says.
TEST(WrongProbe, ScattersTheAxisAsTheCovarianceSays) {
  constexpr double sigma = 0.002;
  constexpr int runs = 60;
  SphereWorld world(builds()[3]);
  world.bench.trueProbe().repeatability = sigma;
  double sum = 0;
  for (int at = 0; at < runs; ++at) {
    world.bench.setup.world.truth.seed = static_cast<std::uint64_t>(at + 1);
    const Ran ran = world.bench.run(probe(451, words451(world.build, 1)));
    ASSERT_TRUE(ended(ran)) << ran.why();
    const machine::MachineDescription found = machine::corrected(world.built(), kinematicsOf(ran, world.built()).axes);
    sum += std::pow(apart(found, world.built()).place, 2);
  }
  // Four touches around: a centre scatters by sigma / sqrt 2 across the tool, along it by the pole and the radius:
  // sqrt(1 + 1/4) sigma. Centres at 0, 90, 180 and 270 degrees tell the axis with half of that.
  const double expected = std::sqrt(0.5 * sigma * sigma / 4 + 1.25 * sigma * sigma / 4);
  EXPECT_NEAR(std::sqrt(sum / runs), expected, 0.3 * expected);
}

/// X drifts towards Z by an angle: the circle becomes an ellipse, which no axis explains. At 0, 90, 180 and 270 degrees
/// the axis is where it is, and the errors are that angle times the radius at two of three positions.
TEST(WrongMachine, LeavesWhatSquarenessDoes) {
  Build build = builds()[3];
  constexpr double radius = 80, degrees = 0.005;
  build.sphere = {radius, -380, -700};
  SphereWorld world(build);
  const machine::MachineDescription machine = world.built();
  world.bench.setup.world.truth.errors.squareness.push_back(
      {*machine.axisIndex("X"), *machine.axisIndex("Z"), degrees});
  const Ran ran = world.bench.run(probe(451, words451(build, 1)));
  ASSERT_TRUE(ended(ran)) << ran.why();
  const double expected = radius * std::tan(radians(degrees)) * std::sqrt(2.0 / 3);
  EXPECT_NEAR(ran.q(142), expected, 1e-6);
  EXPECT_NEAR(ran.q(145), expected, 1e-6);
  EXPECT_LT(apart(machine::corrected(machine, kinematicsOf(ran, machine).axes), machine).place, 1e-6);
}

/// A block beside the sphere stands where the probe is to lean: it stops, and the kinematics stays.
TEST(Indexing, StopsAtWhatIsInTheWay) {
  SphereWorld world(builds()[1]);
  Dice dice(4523);
  world.plant(dice, 0.1, 0);
  world.bench.part(simulation::Box({-20, -40, -60}, {20, 40, 90}), pose(world.build.sphere + Vector3(70, 0, 0)));
  const Ran ran = world.bench.run(probe(451, words451(world.build, 1)));
  EXPECT_EQ(ran.alarm(), "Collision");
  EXPECT_FALSE(ran.outcome.files.contains("KINEMATIC.TAB"));
  // Without the reference angle of 45 degrees the touches around the sphere meet its stem.
  SphereWorld stem(builds()[0]);
  EXPECT_NE(stem.bench.run(probe(451, words451(stem.build, 1, {{380, 0}}))).alarm(), "");
}

/// A post that the stylus passes and the body of the probe does not, once the table leans.
TEST(Indexing, StopsWhereTheBodyOfTheProbeMeetsSomething) {
  for (const bool post : {true, false}) {
    Dice dice(4524);
    SphereWorld world(builds()[0]);
    world.plant(dice, 0.1, 0);
    world.bench.trueProbe().stylusLength = 30;
    world.bench.trueProbe().bodyRadius = 40;
    if (post)
      world.bench.part(simulation::Box({-4, -4, -60}, {4, 4, 20}), pose(world.build.sphere + Vector3(0, 60, 0)));
    const Ran ran = world.bench.run(probe(451, words451(world.build, 1)));
    EXPECT_EQ(ended(ran), !post) << ran.why();
    if (!post) continue;
    EXPECT_EQ(ran.alarm(), "Collision");
    EXPECT_NE(ran.why().find("the body of tool 1"), std::string::npos) << ran.why();
    EXPECT_FALSE(ran.outcome.files.contains("KINEMATIC.TAB"));
  }
}

/// A table that turns over leads the stem towards the probe, which turns about the sphere: the flank of the stem meets
/// the rim of the body. The rim is `rim` from the tool's axis and `along` from the middle of the sphere; where the stem
/// leans b from that axis, the rim is along sin b - rim cos b from the axis of the stem.
TEST(Indexing, StopsWhereTheBodyOfTheProbeMeetsTheStem) {
  constexpr double stylus = 30, rim = 20, flank = 4, ball = 2;
  for (const double sense : {-1.0, 1.0}) {
    SphereWorld world(builds()[0]);
    for (machine::Axis& axis : world.bench.setup.world.truth.machine.axes) {
      axis.minimum = axis.kind == machine::AxisKind::Rotary ? -360 : -2000;
      axis.maximum = -axis.minimum;
    }
    world.bench.trueProbe().stylusLength = stylus;
    world.bench.trueProbe().bodyRadius = rim;
    world.build.axes = {{'A', {sense * 175, sense * 95, 0, 3}}};
    const Ran ran = world.bench.run(probe(451, words451(world.build, 1)));
    EXPECT_EQ(ran.alarm(), "Collision");
    EXPECT_NE(ran.why().find("the body of tool 1"), std::string::npos) << ran.why();
    const double along = sphereRadius + ball + world.bench.believedProbe().setUpClearance + stylus;
    const double lean = std::asin(flank / std::hypot(along, rim)) + std::atan2(rim, along);
    const std::size_t a = *world.built().axisIndex("A");
    ASSERT_TRUE(ran.machine);
    EXPECT_NEAR(ran.machine->position()[a], sense * (180 - degrees(lean)), 0.1);
  }
}

TEST(Refusals, OfCycle451) {
  const auto refusal = [](const Words& changes, const std::string& before = {},
                          const std::map<std::string, double>& parameters = {}, std::size_t build = 0,
                          ControlKind control = ControlKind::TNC640) {
    SphereWorld world(builds()[build], control);
    for (const auto& [name, value] : parameters)
      world.bench.setup.beliefs.parameters[name] = {value, {}};
    const Ran ran = world.bench.run(before + probe(451, words451(world.build, 1, changes)));
    const std::string alarm = ran.alarm();
    return alarm.empty() ? ran.why() : alarm;
  };
  EXPECT_EQ(refusal({{407, 12.6}}), "Calibration sphere radius wrong");
  EXPECT_EQ(refusal({{407, 12.55}}, "", {{"maxDevCalBall", 0.1}}), "");
  EXPECT_EQ(refusal({}, "", {{"option48", 0}}), "Function not enabled");
  EXPECT_EQ(refusal({{406, 2}}, "", {{"option52", 0}}), "Function not enabled");
  EXPECT_EQ(refusal({{406, 3}}, "", {}, 1), "Machine datum not correctable");
  EXPECT_EQ(refusal({{406, 3}, {422, 0}}), "Machine datum not correctable");
  EXPECT_EQ(refusal({{414, 0}, {422, 0}}), "No axis to measure");
  EXPECT_EQ(refusal({}, "M128\n"), "TCPM not permitted");
  EXPECT_EQ(refusal({}, "", {{"toolCentreOption", 0}}), "Cycle parameter wrong");
  EXPECT_EQ(refusal({}, "TOOL CALL 1 Y\n"), "Tool axis not permitted");
  EXPECT_EQ(refusal({}, "FUNCTION MODE TURN\n"), "Function not permitted");
  EXPECT_EQ(refusal({}, "CYCL DEF 7.0 DATUM\nCYCL DEF 7.1 X+1\n"), "Coordinate transformation not permitted");
  EXPECT_EQ(refusal({{411, 0}, {412, 0}, {414, 1}}), "Measuring position not permitted");
  EXPECT_EQ(refusal({{411, 0.02}, {412, 0.02}, {414, 1}, {422, 0}}, "", {}, 0), "Kinematics not determined");
  EXPECT_EQ(refusal({}, "L C+10 R0 FMAX\n", {{"mStrobeRotAxPos", 40}}), "Rotary axes not at 0");
  EXPECT_EQ(refusal({}, "", {{"mStrobeRotAxPos", 940}}), "M function missing");
  EXPECT_EQ(refusal({{411, -90}, {412, 90}, {414, 3}}, "", {}, 0, ControlKind::iTNC530),
            "Measuring position not permitted");
  EXPECT_EQ(refusal({{406, 3}}, "", {}, 0, ControlKind::iTNC530), "Cycle parameter wrong");
  EXPECT_EQ(refusal({}, "", {{"FCL", 2}}, 0, ControlKind::iTNC530), "Function not enabled");
  EXPECT_EQ(refusal({}, "PLANE SPATIAL SPA+10 SPB+0 SPC+0 STAY\n", {}, 0, ControlKind::iTNC530),
            "Tilted working plane not permitted");
  SphereWorld hirth(builds()[0]);
  hirth.bench.setup.beliefs.kinematics["A"].hirthGrid = 3;
  EXPECT_EQ(hirth.bench.run(probe(451, words451(hirth.build, 1))).alarm(), "Cycle parameter wrong");
}

/// The iTNC 530 ends M128 and FUNCTION TCPM with the cycle: C is an axis again then, no angle of the tool, and while it
/// turns the linear axes stand.
TEST(ToolGuidance, EndsWithCycle451OnTheOlderControl) {
  for (const std::string on : {"M128\n", "FUNCTION TCPM F TCP AXIS SPAT PATHCTRL AXIS\n"}) {
    SphereWorld world(builds()[1], ControlKind::iTNC530);
    const std::string axes = "FN 18: SYSREAD Q{} = ID240 NR1 IDX{}\n";
    std::string program = on + probe(451, words451(world.build, 0));
    for (const int after : {0, 10}) {
      if (after > 0) program += "L C+20 R0 FMAX\n";
      for (const int axis : {1, 2, 6})
        program += fmt::format(fmt::runtime(axes), after + axis, axis);
    }
    const Ran ran = world.bench.run(program);
    ASSERT_TRUE(ended(ran)) << on << ran.why();
    EXPECT_NEAR(ran.q(16), 20, 1e-6) << on;
    EXPECT_NE(ran.q(6), ran.q(16));
    EXPECT_EQ(ran.q(1), ran.q(11)) << on;
    EXPECT_EQ(ran.q(2), ran.q(12)) << on;
  }
}

/// More than maxModification: NC start takes the values over, a stop leaves the kinematics as it is.
TEST(MaxModification, AsksBeforeItWrites) {
  Dice dice(4524);
  SphereWorld world(builds()[1]);
  world.bench.setup.world.truth.errors.rotaryAxes.push_back({*world.built().axisIndex("C"), {0.3, 0, 0}, {0, 0, 0}});
  const Ran taken = world.bench.run(probe(451, words451(world.build, 1)));
  ASSERT_TRUE(ended(taken)) << taken.why();
  ASSERT_EQ(taken.screens().size(), 1u);
  EXPECT_NE(taken.screens()[0].find("by up to 0.3000 mm"), std::string::npos) << taken.screens()[0];
  world.bench.onStop = control::OnStop::Abort;
  const Ran left = world.bench.run(probe(451, words451(world.build, 1)));
  EXPECT_FALSE(left.outcome.files.contains("KINEMATIC.TAB"));
  world.bench.setup.beliefs.parameters["maxModification"] = {0.4, {}};
  EXPECT_TRUE(ended(world.bench.run(probe(451, words451(world.build, 1)))));
}

/// An M function positions the rotary axes (M8 stands for that of a builder); no backlash is measured then.
TEST(BuilderFunction, IsGivenTheAngles) {
  Dice dice(4525);
  SphereWorld world(builds()[3]);
  world.plant(dice, 0.1, 0);
  world.bench.setup.beliefs.parameters["mStrobeRotAxPos"] = {8.0, {}};
  const Ran ran = world.bench.run(probe(451, words451(world.build, 1, {{432, 0.5}})));
  ASSERT_TRUE(ended(ran)) << ran.why();
  EXPECT_EQ(ran.q(121), 270);
  EXPECT_EQ(ran.touches(), 4U * 5);
  EXPECT_LT(apart(machine::corrected(world.built(), kinematicsOf(ran, world.built()).axes), world.truth()).place, 1e-6);
  // A stands at its angle of incidence while C is measured.
  SphereWorld head(builds()[2]);
  head.bench.setup.beliefs.parameters["mStrobeRotAxPos"] = {8.0, {}};
  const Ran both = head.bench.run(probe(451, words451(head.build, 0)));
  ASSERT_TRUE(ended(both)) << both.why();
  EXPECT_EQ(both.q(120), 45);
  EXPECT_EQ(both.q(122), 270);
}

}  // namespace
}  // namespace probewright::testing_support
