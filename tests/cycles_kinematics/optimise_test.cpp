#include <ctime>

#include "cycles_kinematics/sphere_worlds.hpp"
#include "setup/calibrated_beliefs.hpp"

/// Cycle 451: planted places and directions of rotary axes are found, on every build of machine.
namespace probewright::testing_support {
namespace {

class Cycle451 : public ::testing::TestWithParam<std::size_t> {
protected:
  Build build() const { return builds()[GetParam()]; }
};

TEST_P(Cycle451, FindsPlantedPlacesAndDirections) {
  Dice dice(4510);
  for (int at = 0; at < 4; ++at) {
    SCOPED_TRACE(at);
    Build somewhere = build();
    // The preset table has four decimals.
    somewhere.sphere += dice.within(10).unaryExpr([](double value) { return written(value, 4); });
    SphereWorld world(somewhere, controlOf(at));
    world.plant(dice, 0.2, 0.02);
    const Ran ran = world.bench.run(probe(451, words451(world.build, 2)));
    ASSERT_TRUE(ended(ran)) << ran.why();
    // The older control measures the positions again once the angles are in effect.
    std::size_t spheres = 0;
    for (const auto& [axis, measured] : world.build.axes)
      spheres += static_cast<std::size_t>(measured.points) + 1;
    EXPECT_EQ(ran.touches(), 5 * spheres * (world.bench.control == ControlKind::iTNC530 ? 2 : 1));
    const KinematicData found = kinematicsOf(ran, world.built());
    const Apart off = apart(machine::corrected(world.built(), found.axes), world.truth());
    EXPECT_LT(off.place, 1e-6);
    EXPECT_LT(off.direction, 1e-8);
    for (const char axis : {'A', 'B', 'C'}) {
      const bool measured = world.build.axes.contains(axis);
      if (measured) {
        EXPECT_GT(ran.q(141 + axis - 'A'), 1e-3);
        EXPECT_LT(ran.q(144 + axis - 'A'), 1e-6);
        EXPECT_GE(ran.q(144 + axis - 'A'), 0);
      } else {
        EXPECT_EQ(ran.q(141 + axis - 'A'), -1);
        EXPECT_EQ(ran.q(144 + axis - 'A'), -1);
      }
    }
  }
}

TEST_P(Cycle451, FindsPlacesAloneOnBothControlsFromASetupThatIsWrong) {
  Dice dice(4512);
  for (int at = 0; at < 4; ++at) {
    SCOPED_TRACE(at);
    SphereWorld world(build(), controlOf(at));
    // The machine is as its builder says; the control has been told otherwise.
    for (const auto& [axis, measured] : world.build.axes)
      world.bench.setup.beliefs.kinematics[std::string(1, axis)].position = dice.within(0.3);
    const Ran ran = world.bench.run(probe(451, words451(world.build, 1, {{408, at < 2 ? 0 : 100}})));
    ASSERT_TRUE(ended(ran)) << ran.why();
    const KinematicData found = kinematicsOf(ran, world.built());
    EXPECT_LT(apart(machine::corrected(world.built(), found.axes), world.truth()).place, 1e-6);
  }
}

TEST_P(Cycle451, SecondMeasurementShowsZero) {
  Dice dice(4511);
  SphereWorld world(build());
  world.plant(dice, 0.2, 0.02);
  const Ran ran = world.bench.run(probe(451, words451(world.build, 2)) + "PLANE RESET STAY\n" +
                                  probe(451, words451(world.build, 0)));
  ASSERT_TRUE(ended(ran)) << ran.why();
  for (const auto& [axis, measured] : world.build.axes) {
    EXPECT_LT(ran.q(141 + axis - 'A'), 1e-6);
    EXPECT_EQ(ran.q(144 + axis - 'A'), -1);
  }
}

/// A test changes nothing; what it says is attainable is what optimising attains.
TEST_P(Cycle451, TestTellsWhatOptimisingWouldAttain) {
  Dice dice(4513);
  SphereWorld world(build());
  world.plant(dice, 0.1, 0.02);
  const Ran tested = world.bench.run(probe(451, words451(world.build, 0)));
  ASSERT_TRUE(ended(tested)) << tested.why();
  EXPECT_FALSE(tested.outcome.files.contains("KINEMATIC.TAB"));
  const Ran optimised = world.bench.run(probe(451, words451(world.build, 1)));
  ASSERT_TRUE(ended(optimised));
  for (const auto& [axis, measured] : world.build.axes) {
    const double attained = optimised.q(144 + axis - 'A');
    EXPECT_NEAR(tested.q(141 + axis - 'A'), optimised.q(141 + axis - 'A'), 1e-9);
    EXPECT_NE(tested.log("TCHPR451.html").find(fmt::format("<td>{:.4f}</td></tr>", attained)), std::string::npos)
        << attained << tested.log("TCHPR451.html");
  }
}

INSTANTIATE_TEST_SUITE_P(Builds, Cycle451, ::testing::Range<std::size_t>(0, 4));

/// The preset has a basic rotation, and an offset of the rotary table: angles of the call count from there.
TEST(Cycle451Presets, MayBeTurned) {
  Dice dice(4518);
  for (const std::size_t build : {0U, 1U}) {
    SCOPED_TRACE(builds()[build].machine);
    SphereWorld world(builds()[build]);
    world.plant(dice, 0.2, 0.02);
    const std::size_t c = *world.built().axisIndex("C");
    control::BelievedFrame& preset = world.bench.setup.beliefs.presets.front();
    preset.rotation = {0, 0, 20};
    preset.rotary["C"] = 12.5;
    // With C at 12.5 degrees the sphere is where the preset is.
    machine::AxisPositions reference;
    reference[c] = 12.5;
    world.bench.setup.world.truth.solids.clear();
    const Vector3 onTable = machine::baseFromTable(world.truth(), reference).inverse() * world.build.sphere;
    world.plantSphere(onTable);
    const Ran ran = world.bench.run("L C+0 R0 FMAX\n" + probe(451, words451(world.build, 2)) + "PLANE RESET STAY\n" +
                                    probe(451, words451(world.build, 0)));
    ASSERT_TRUE(ended(ran)) << ran.why();
    const Apart off = apart(machine::corrected(world.built(), kinematicsOf(ran, world.built()).axes), world.truth());
    EXPECT_LT(off.place, 1e-6);
    EXPECT_LT(off.direction, 1e-8);
    EXPECT_LT(ran.q(143), 1e-6);
  }
}

/// Lengths of the call are inches, results stay millimetres.
TEST(Cycle451Units, ResultsAreMillimetresInInchProgramsToo) {
  Dice dice(4519);
  SphereWorld world(builds()[1]);
  world.plant(dice, 0.1, 0);
  const Ran plain = world.bench.run(probe(451, words451(world.build, 0)));
  const Words inches = {{407, sphereRadius / 25.4}, {253, 200}};
  const Ran ran = world.bench.run(probe(451, words451(world.build, 0, inches)), "INCH");
  ASSERT_TRUE(ended(ran)) << ran.why();
  EXPECT_NEAR(ran.q(142), plain.q(142), 1e-6);
  EXPECT_NEAR(ran.q(147), plain.q(147), 1e-6);
}

/// A setup may name point and direction themselves; what it adds comes on top.
TEST(BelievedKinematics, AreReadFromTheSetup) {
  Diagnostics diagnostics;
  const auto setup = setup::parseSetup(
      "[machine]\nname = \"mill5-table-table\"\n[control.kinematics.A]\npoint = [0, 1, -549]\n"
      "direction = [-2, 0, 0.02]\nposition = [0, 0.5, 0]\nhirth_grid = 3\n",
      "setup.toml", diagnostics);
  ASSERT_TRUE(setup) << format(diagnostics.front());
  const machine::MachineDescription built = *machine::readMachine("mill5-table-table");
  const auto believed = control::believedMachine(built, setup->beliefs.kinematics);
  EXPECT_LT((believed.tableChain[0].point - Vector3(0, 1.5, -549)).norm(), 1e-12);
  EXPECT_LT((believed.tableChain[0].direction - Vector3(-2, 0, 0.02).normalized()).norm(), 1e-12);
  EXPECT_LT((believed.tableChain[1].direction - built.tableChain[1].direction).norm(), 1e-15);
  EXPECT_EQ(setup->beliefs.kinematics.at("A").hirthGrid, 3);
  EXPECT_FALSE(setup::parseSetup("[control.kinematics.C]\nposition = [1, 0, 0]\n", "setup.toml", diagnostics));
  EXPECT_EQ(diagnostics.back().message, "the machine has no rotary axis called C");
  EXPECT_FALSE(
      setup::parseSetup("[machine]\nname = \"mill5-table-table\"\n[control.kinematics.C]\n"
                        "direction = [0, 0, 0]\n",
                        "setup.toml", diagnostics));
  EXPECT_EQ(diagnostics.back().message, "a direction cannot be [0, 0, 0]");
}

/// What the next run computes with.
TEST(Cycle451Tables, OneRunIsTheStartOfTheNext) {
  Dice dice(4514);
  SphereWorld world(builds()[0]);
  world.plant(dice, 0.2, 0.02);
  const Ran first = world.bench.run(probe(451, words451(world.build, 2)));
  ASSERT_TRUE(ended(first)) << first.why();
  const TableFolder folder(world.bench);
  folder.put("KINEMATIC.TAB", first.outcome.files.at("KINEMATIC.TAB"));
  const Ran second = world.bench.run(probe(451, words451(world.build, 0)));
  ASSERT_TRUE(ended(second)) << second.why();
  EXPECT_LT(second.q(141), 1e-6);
  EXPECT_LT(second.q(143), 1e-6);
  EXPECT_EQ(second.outcome.files.at("KINEMATIC.TAB"), first.outcome.files.at("KINEMATIC.TAB"));
  // Of another machine.
  SphereWorld other(builds()[1]);
  const TableFolder wrong(other.bench);
  wrong.put("KINEMATIC.TAB", first.outcome.files.at("KINEMATIC.TAB"));
  const Ran refused = other.bench.run("");
  EXPECT_NE(refused.why().find("KINEMATIC.TAB"), std::string::npos) << refused.why();
}

/// The pole of the sphere in a plane tilted by 30 degrees: wrong before, right after.
TEST(Cycle451InTiltedPlanes, MakesWorkpieceCyclesExact) {
  Dice dice(4515);
  const Words pole = {
      {263, 0}, {264, 0}, {261, sphereRadius}, {320, 0}, {272, 3}, {267, -1}, {260, 60}, {281, 0}, {288, 0}, {289, 0},
      {309, 0}, {330, 0}};
  const std::string tilted =
      "PLANE RESET STAY\nL Z+150 R0 FMAX\nPLANE SPATIAL SPA+30 SPB+0 SPC+20 TURN FMAX\n"
      "L Z+80 R0 FMAX\nL X+0 Y+0 R0 FMAX\n" +
      probe(427, pole);
  for (const std::size_t build : {0U, 1U, 2U}) {
    SCOPED_TRACE(builds()[build].machine);
    SphereWorld world(builds()[build]);
    world.plant(dice, 0.2, 0.02);
    const Ran before = world.bench.run(tilted);
    ASSERT_TRUE(ended(before)) << before.why();
    EXPECT_GT(std::abs(before.q(160) - sphereRadius), 5e-3);
    const Ran after = world.bench.run(probe(451, words451(world.build, 2)) + tilted);
    ASSERT_TRUE(ended(after)) << after.why();
    EXPECT_NEAR(after.q(160), sphereRadius, 1e-6);
  }
}

/// An axis that stands elsewhere than it reads turns the axis that it carries. Q406 = 3 corrects its machine datum.
TEST(Cycle451MachineDatum, IsFound) {
  for (const std::size_t build : {0U, 2U}) {
    SCOPED_TRACE(builds()[build].machine);
    SphereWorld world(builds()[build]);
    const std::size_t inner = *world.built().axisIndex(build == 0 ? "A" : "C");
    const std::size_t outer = *world.built().axisIndex(build == 0 ? "C" : "A");
    world.bench.setup.world.truth.errors.axes.resize(world.built().axes.size());
    world.bench.setup.world.truth.errors.axes[inner].offset = 0.004;
    const Ran ran = world.bench.run(probe(451, words451(world.build, 3)) + "PLANE RESET STAY\n" +
                                    probe(451, words451(world.build, 0)));
    ASSERT_TRUE(ended(ran)) << ran.why();
    const KinematicData found = kinematicsOf(ran, world.built());
    for (const machine::RotaryCorrection& axis : found.axes) {
      EXPECT_NEAR(axis.zero, axis.axis == inner ? 0.004 : 0, 1e-6);
      if (axis.axis == outer) {
        EXPECT_LT(axis.orientation.norm(), 1e-6);
      }
    }
    EXPECT_LT(ran.q(141), 1e-6);
    EXPECT_LT(ran.q(143), 1e-6);
  }
}

/// Hirth coupling of 3 degrees: the positions of the manual's example, and the axis found from them.
TEST(Cycle451Hirth, MeasuresWhereTheAxisCanStand) {
  Dice dice(4516);
  SphereWorld world(builds()[0]);
  world.plant(dice, 0.1, 0);
  world.bench.setup.beliefs.kinematics["A"].hirthGrid = 3;
  world.build.axes = {{'A', {-30, 90, 0, 4}}};
  const Ran ran = world.bench.run(probe(451, words451(world.build, 1, {{408, 250}, {432, 0.5}})));
  ASSERT_TRUE(ended(ran)) << ran.why();
  std::vector<double> angles;
  const std::size_t a = *world.built().axisIndex("A");
  for (const control::TouchRecord& touch : ran.cycle().touches) {
    if (angles.empty() || std::abs(angles.back() - touch.latched[a]) > 1e-6) angles.push_back(touch.latched[a]);
  }
  EXPECT_EQ(angles, (std::vector<double>{0, -30, 9, 51, 90}));
  EXPECT_LT(apart(machine::corrected(world.built(), kinematicsOf(ran, world.built()).axes), world.truth(), "A").place,
            1e-6);
}

/// A coupling that the machine truly has: the control that knows it measures where the axis stands; one that does not,
/// or another grid, is stopped.
TEST(Cycle451Hirth, IsOfTheMachineToo) {
  Dice dice(4518);
  SphereWorld world(builds()[0]);
  world.plant(dice, 0.1, 0);
  simulation::Truth& truth = world.bench.setup.world.truth;
  truth.hirthGrid[*world.built().axisIndex("A")] = 3;
  world.build.axes = {{'A', {-30, 90, 0, 4}}};
  const std::string cycle = probe(451, words451(world.build, 1, {{408, 250}}));
  const Ran unaware = world.bench.run(cycle);
  EXPECT_EQ(unaware.outcome.result.end, execution::RunEnd::Alarm);
  EXPECT_NE(unaware.why().find("axis A has a Hirth coupling: it stands at multiples of 3 degrees, not at 10"),
            std::string::npos)
      << unaware.why();
  setup::believeHirthCouplings(world.bench.setup.beliefs, truth);
  const Ran ran = world.bench.run(cycle);
  ASSERT_TRUE(ended(ran)) << ran.why();
  EXPECT_LT(apart(machine::corrected(world.built(), kinematicsOf(ran, world.built()).axes), world.truth(), "A").place,
            1e-6);
  world.bench.setup.beliefs.kinematics["A"].hirthGrid = 2.5;
  EXPECT_EQ(world.bench.run(cycle).outcome.result.end, execution::RunEnd::Alarm);
}

TEST(Cycle451Hirth, IsReadFromTheSetup) {
  Diagnostics diagnostics;
  const auto parsed = [&](const std::string& machine, const std::string& more = {}) {
    diagnostics.clear();
    return setup::parseSetup("[machine]\nname = \"mill5-table-table\"\n" + machine + more, "hirth.toml", diagnostics);
  };
  const auto told = parsed("hirth = { A = 2.5 }\n");
  ASSERT_TRUE(told);
  const std::size_t a = *told->world.truth.machine.axisIndex("A");
  EXPECT_EQ(told->world.truth.hirthGrid[a], 2.5);
  EXPECT_EQ(told->beliefs.kinematics.at("A").hirthGrid, 2.5) << "where the setup is silent the control knows it";
  const auto wrong = parsed("hirth = { A = 2.5 }\n", "[control.kinematics.A]\nhirth_grid = 5\n");
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->beliefs.kinematics.at("A").hirthGrid, 5);
  for (const char* mistake : {"hirth = { X = 1 }\n", "hirth = { A = 0 }\n", "hirth = { A = 200 }\n", "hirth = 3\n"}) {
    EXPECT_FALSE(parsed(mistake)) << mistake;
    EXPECT_FALSE(diagnostics.empty()) << mistake;
  }
}

/// Three rotary axes of eight positions each.
TEST(Cycle451Speed, ThreeAxesOfEightPositionsTakeLessThanASecond) {
  SphereWorld world(builds()[0]);
  machine::MachineDescription& machine = world.bench.setup.world.truth.machine;
  machine.axes.push_back(
      {.name = "B", .kind = machine::AxisKind::Rotary, .minimum = -110, .maximum = 110, .rapid = 9000});
  machine.spindleChain.push_back({machine.axes.size() - 1, Vector3::UnitY(), Vector3(0, 0, 150)});
  Dice dice(4517);
  world.plant(dice, 0.05, 0);
  world.build.axes = {{'A', {-70, 75, 0, 8}}, {'B', {-20, 30, 0, 8}}, {'C', {40, 320, 0, 8}}};
  const std::clock_t begin = std::clock();
  const Ran ran = world.bench.run(probe(451, words451(world.build, 1)));
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;  // of the processor
  ASSERT_TRUE(ended(ran)) << ran.why();
  EXPECT_EQ(ran.touches(), 3U * 9 * 5);
  EXPECT_LT(apart(machine::corrected(machine, kinematicsOf(ran, machine).axes), world.truth()).place, 1e-6);
  RecordProperty("seconds", fmt::format("{:.3f}", seconds));
#if !defined(__SANITIZE_ADDRESS__)  // which takes six times as long
  EXPECT_LT(seconds, 1);
#endif
}

}  // namespace
}  // namespace probewright::testing_support
