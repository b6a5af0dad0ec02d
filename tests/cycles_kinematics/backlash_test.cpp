#include "cycles_kinematics/sphere_worlds.hpp"

/// Play between the encoder and the table of rotary axes: with Q432 it is measured and leaves the kinematics as it is,
/// without it shifts the axes as far as its angle turns the sphere.
namespace probewright::testing_support {
namespace {

/// Play of the rotary axes in `names`, at random; what each has.
std::map<char, double> plantBacklash(SphereWorld& world, Dice& dice, const std::string& names) {
  std::map<char, double> planted;
  auto& errors = world.bench.setup.world.truth.errors;
  errors.axes.resize(world.built().axes.size());
  for (const char name : names) {
    const auto axis = world.built().axisIndex(std::string(1, name));
    if (!axis) continue;
    planted[name] = errors.axes[*axis].backlash = dice.between(0.002, 0.02);
  }
  return planted;
}

/// The averaged backlash of each axis in the log, in their order.
std::vector<double> loggedBacklash(const Ran& ran) {
  const std::string log = ran.log("TCHPR451.html"), label = "<td>Averaged backlash</td><td>";
  std::vector<double> found;
  for (std::size_t at = log.find(label); at != log.npos; at = log.find(label, at + 1))
    found.push_back(std::atof(log.c_str() + at + label.size()));
  return found;
}

struct Case {
  std::size_t build;
  std::string axes;  ///< that have play
};
std::string nameOfCase(const ::testing::TestParamInfo<Case>& each) {
  constexpr std::array machines = {"TableTable", "HeadTable", "HeadHead", "OneTable"};
  return machines.at(each.param.build) + each.param.axes;
}
class BacklashOfRotaryAxes : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(OneAndBoth, BacklashOfRotaryAxes,
                         ::testing::Values(Case{0, "A"}, Case{0, "C"}, Case{0, "AC"}, Case{1, "B"}, Case{1, "C"},
                                           Case{1, "BC"}, Case{2, "A"}, Case{2, "C"}, Case{2, "AC"}, Case{3, "B"}),
                         nameOfCase);

/// Both signs of Q432, every mode that writes, both controls, a machine as it is believed and one that is not.
TEST_P(BacklashOfRotaryAxes, LeavesNoErrorInTheKinematics) {
  const Case& given = GetParam();
  Dice dice(4530 + static_cast<unsigned>(given.build));
  for (int at = 0; at < 4; ++at) {
    SCOPED_TRACE(at);
    SphereWorld world(builds()[given.build], controlOf(at));
    const bool perfect = at < 2;
    const int mode = 1 + at % 2;
    if (!perfect) world.plant(dice, 0.1, mode > 1 ? 0.02 : 0);
    const std::map<char, double> planted = plantBacklash(world, dice, given.axes);
    const double overrun = (at == 1 || at == 2 ? -1 : 1) * dice.between(0.3, 3);
    const Ran measured = world.bench.run(probe(451, words451(world.build, mode, {{432, overrun}})));
    ASSERT_TRUE(ended(measured)) << measured.why();
    const Apart off =
        apart(machine::corrected(world.built(), kinematicsOf(measured, world.built()).axes), world.truth());
    EXPECT_LT(off.place, 1e-6);
    EXPECT_LT(off.direction, 1e-8);
    for (const auto& [axis, asked] : world.build.axes)
      EXPECT_LT(measured.q(144 + axis - 'A'), 1e-6) << axis;
    if (world.bench.control != ControlKind::TNC640) continue;
    const std::vector<double> logged = loggedBacklash(measured);
    ASSERT_EQ(logged.size(), world.build.axes.size());
    std::size_t i = 0;
    for (const auto& [axis, asked] : world.build.axes) {
      const auto has = planted.find(axis);
      EXPECT_NEAR(logged[i++], has == planted.end() ? 0 : has->second, 2e-6) << axis;
    }
  }
}

/// The preset of another head: what 452 pins and shifts is as little touched by play.
TEST_P(BacklashOfRotaryAxes, LeavesNoShiftOfThePreset) {
  const Case& given = GetParam();
  Dice dice(4540 + static_cast<unsigned>(given.build));
  SphereWorld world(builds()[given.build]);
  plantBacklash(world, dice, given.axes);
  Words words = words451(world.build, 0, {{432, dice.between(0.3, 3)}});
  std::erase_if(words, [](const auto& word) { return word.first == 406 || word.first == 431; });
  const Ran ran = world.bench.run(probe(452, words));
  ASSERT_TRUE(ended(ran)) << ran.why();
  const KinematicData found = kinematicsOf(ran, world.built());
  EXPECT_LT(found.base.norm(), 1e-6);
  EXPECT_LT(apart(machine::corrected(world.built(), found.axes), world.built()).place, 1e-6);
}

/// C at 0, 90, 180 and 270 degrees tells its place as the mean of the four spheres. In that order it always turns in +;
/// in the order 0, 270, 180, 90 it lags at the last two, by the play: a quarter of what that moves both together.
TEST(BacklashWithoutQ432, ShiftsTheAxisByWhatTwoPositionsLag) {
  constexpr double play = 0.02;
  for (const bool backwards : {false, true}) {
    Build build = builds()[0];
    build.axes = {{'C', backwards ? Measured{270, 90, 0, 3} : Measured{90, 270, 0, 3}}};
    SphereWorld world(build);
    const std::size_t c = *world.built().axisIndex("C");
    auto& errors = world.bench.setup.world.truth.errors;
    errors.axes.resize(world.built().axes.size());
    errors.axes[c].backlash = play;
    const Ran ran = world.bench.run(probe(451, words451(build, 1)));
    ASSERT_TRUE(ended(ran)) << ran.why();
    Vector3 lever = build.sphere;
    for (const machine::ChainElement& element : world.built().tableChain) {
      if (element.axis == c) lever -= element.point;
    }
    lever.z() = 0;
    const double expected = backwards ? std::sqrt(2.0) / 4 * lever.norm() * 2 * std::sin(radians(play) / 2) : 0;
    const Apart off = apart(machine::corrected(world.built(), kinematicsOf(ran, world.built()).axes), world.built());
    EXPECT_NEAR(off.place, expected, 1e-6);
  }
}

/// A linear axis with play reads half of it wrong between touches from both sides, and all of it above the pole. Around
/// the equator the touches at 45, 135, 225 and 315 degrees see a circle that is too small by (x + y) / sqrt 8, so the
/// centre below the pole lies as much too high. It is the same at each position of a table: both axes move by just
/// that, and nothing is left but what is small of second order.
TEST(BacklashOfLinearAxes, ShiftsTheTableAsAWhole) {
  const Vector3 play(0.006, 0.004, 0.01);
  SphereWorld world(builds()[0]);
  auto& errors = world.bench.setup.world.truth.errors;
  errors.axes.resize(world.built().axes.size());
  for (Eigen::Index i = 0; i < 3; ++i)
    errors.axes[*world.built().axisIndex(std::string(1, static_cast<char>('X' + i)))].backlash = play[i];
  const Ran ran = world.bench.run(probe(451, words451(world.build, 1)));
  ASSERT_TRUE(ended(ran)) << ran.why();
  constexpr double secondOrder = 3e-6;
  EXPECT_LT(ran.q(144), secondOrder);
  EXPECT_LT(ran.q(146), secondOrder);
  machine::MachineDescription expected = world.built();
  for (machine::ChainElement& element : expected.tableChain)
    element.point -= Vector3(play.x() / 2, play.y() / 2, play.z() - (play.x() + play.y()) / std::sqrt(8.0));
  EXPECT_LT(apart(machine::corrected(world.built(), kinematicsOf(ran, world.built()).axes), expected).place,
            secondOrder);
}

}  // namespace
}  // namespace probewright::testing_support
