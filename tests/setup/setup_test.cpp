#include "setup/setup.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "simulation/virtual_machine.hpp"
#include "support/virtual_world.hpp"

namespace probewright::setup {
namespace {

using namespace simulation;
using control::BelievedTool;

using testing::HasSubstr;
using testing::SizeIs;

Setup read(const std::string& text) {
  Diagnostics diagnostics;
  auto setup = parseSetup(text, "setup.toml", diagnostics);
  for (const Diagnostic& diagnostic : diagnostics)
    ADD_FAILURE() << format(diagnostic);
  return setup ? std::move(*setup) : Setup{};
}

TEST(Setup, EmptyIsAPerfectThreeAxisMillWithNothingOnIt) {
  const auto setup = read("");
  EXPECT_EQ(setup.world.truth.machine.name, "3-axis mill");
  EXPECT_FALSE(setup.beliefs.control);
  EXPECT_THAT(setup.world.solids, SizeIs(0));
}

TEST(Setup, ReadsEverySection) {
  const auto setup = read(R"(
seed = 42
[machine]
name = "mill5-table-table"
start = { X = 10, C = 400 }
[ring]
diameter = 50
pose = { x = 100, z = -500 }
[sphere]
diameter = 25
stem_diameter = 8
[gauge_block]
size = [10, 20, 30]
[[tool]]
number = 7
name = "TS"
kind = "probe"
length = 150
ball_radius = 3
tip_offset = [0.02, -0.01]
pretravel = 0.01
axial_pretravel = 0.004
signal_delay = 0.0002
probing_feed = 600
in_spindle = true
[[tool]]
number = 8
kind = "mill"
length = 90
radius = 8
believed_length = 90.5
[[preset]]
row = 3
origin = [1, 2, 3]
rotation = [0, 0, 5]
rotary = { C = 0.5 }
active = true
[[zero_offset]]
name = "G505"
origin = [4, 5, 6]
[errors.axis.X]
scale_mm_per_m = 0.02
backlash = 0.005
[[errors.axis.X.deviation]]
amplitude = 0.002
wavelength = 10
[[errors.axis.Y.deviation]]
direction = [2, 0, 0]
polynomial = [0, 0, 0.1]
[[errors.squareness]]
axis = "Y"
towards = "X"
degrees = 0.01
[errors.rotary.C]
position = [0.1, 0.2, 0]
orientation = [0.01, 0, 0]
[errors]
spindle_tilt = [0.002, 0, 0]
[[errors.thermal]]
amount = [0, 0, 0.02]
time_constant = 1800
[parameters]
MP6140 = 3
"$MN_MM" = "text"
flag = true
)");
  EXPECT_EQ(setup.world.truth.seed, 42u);
  EXPECT_EQ(read("[control]\ntype = \"840Dsl\"").beliefs.control, control::ControlKind::Sinumerik840Dsl);
  EXPECT_EQ(read("[control]\ntype = \"828D\"").beliefs.control, control::ControlKind::Sinumerik840Dsl);
  EXPECT_EQ(setup.world.truth.machine.axes.size(), 5u);
  EXPECT_EQ(setup.world.truth.start[0], 10);
  EXPECT_EQ(setup.world.truth.start[4], 400);
  ASSERT_THAT(setup.world.solids, SizeIs(3));
  EXPECT_EQ(setup.world.solids[0].tableFromSolid.translation(), Vector3(100, 0, -500));

  ASSERT_THAT(setup.beliefs.tools, SizeIs(2));
  const BelievedTool& probe = setup.beliefs.tools[0];
  // At 600 mm/min the delay is worth 10 mm/s * 0.0002 s = 0.002 mm.
  EXPECT_NEAR(probe.length, 150 - 0.004 - 0.002, 1e-12);
  EXPECT_NEAR(probe.radius, 3 - 0.01 - 0.002, 1e-12);
  EXPECT_EQ(probe.tipOffset, Vector2(0.02, -0.01));
  EXPECT_TRUE(probe.inSpindle);
  EXPECT_EQ(setup.beliefs.tools[1].length, 90.5);
  EXPECT_EQ(setup.world.truth.tools[1].length, 90);
  EXPECT_EQ(setup.world.truth.tools[1].kind, ToolKind::Cutter);

  ASSERT_THAT(setup.beliefs.presets, SizeIs(1));
  EXPECT_EQ(setup.beliefs.presets[0].index, 3);
  EXPECT_EQ(setup.beliefs.presets[0].rotation.z(), 5);
  EXPECT_EQ(setup.beliefs.presets[0].rotary.at("C"), 0.5);
  EXPECT_TRUE(setup.beliefs.presets[0].active);
  EXPECT_EQ(setup.beliefs.zeroOffsets.at(0).index, 5);

  const MachineErrors& errors = setup.world.truth.errors;
  EXPECT_NEAR(errors.axes[0].scale, 2e-5, 1e-18);
  EXPECT_EQ(errors.axes[0].deviations.at(0).direction, Vector3::UnitX());
  EXPECT_EQ(errors.axes[1].deviations.at(0).direction, Vector3::UnitX());
  EXPECT_EQ(errors.squareness.at(0).axis, 1u);
  EXPECT_EQ(errors.rotaryAxes.at(0).axis, 4u);
  EXPECT_EQ(errors.spindleTilt.x(), 0.002);
  EXPECT_EQ(errors.thermal.at(0).timeConstant, 1800);
  EXPECT_EQ(std::get<double>(setup.beliefs.parameters.at("MP6140").value), 3);
  EXPECT_EQ(std::get<std::string>(setup.beliefs.parameters.at("$MN_MM").value), "text");
  EXPECT_EQ(std::get<double>(setup.beliefs.parameters.at("flag").value), 1);
}

TEST(Setup, PoseTurnsAboutXThenYThenZOfTheTable) {
  const auto setup = read("[ring]\ndiameter = 50\npose = { x = 1, y = 2, z = 3, a = 90, c = 90 }\n");
  // Z of the ring goes to -Y by the turn about X, and on to +X by the turn about Z.
  const Pose& pose = setup.world.solids.at(0).tableFromSolid;
  EXPECT_LT((pose.linear() * Vector3::UnitZ() - Vector3::UnitX()).norm(), 1e-15);
  EXPECT_EQ(pose.translation(), Vector3(1, 2, 3));
}

class SetupOnDisk : public testing::Test {
protected:
  void SetUp() override {
    folder = std::filesystem::temp_directory_path() /
             (std::string("probewright-setup-") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder);
    // A tetrahedron whose corner lies at the origin.
    std::ofstream stl(folder / "part.stl");
    stl << "solid part\n";
    const Vector3 p[] = {{0, 0, 0}, {50, 0, 0}, {0, 50, 0}, {0, 0, 50}};
    for (const auto& face : {std::array{0, 2, 1}, std::array{0, 1, 3}, std::array{0, 3, 2}, std::array{1, 2, 3}}) {
      stl << "facet normal 0 0 0\nouter loop\n";
      for (const int i : face)
        stl << "vertex " << p[i].x() << " " << p[i].y() << " " << p[i].z() << "\n";
      stl << "endloop\nendfacet\n";
    }
    stl << "endsolid part\n";
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::filesystem::path write(const std::string& text) const {
    std::ofstream(folder / "setup.toml") << text;
    return folder / "setup.toml";
  }

  std::filesystem::path folder;
};

TEST_F(SetupOnDisk, BuildsAMachineThatFeelsThePart) {
  Diagnostics diagnostics;
  const auto setup = readSetup(write(R"(
[part]
file = "part.stl"
pose = { x = 20, y = 10, z = -450 }
[[tool]]
number = 1
kind = "probe"
length = 100
ball_radius = 2
in_spindle = true
)"),
                               diagnostics);
  ASSERT_TRUE(setup) << format(diagnostics.at(0));
  auto machine = buildMachine(setup->world);
  ASSERT_TRUE(machine) << format(machine.error());
  using testing_support::positions;
  (*machine)->move(positions({0, 15, -345}), machine::Feed::rapidTraverse());
  const auto result = (*machine)->measure({positions({30, 15, -345}), machine::Feed::at(300)});
  ASSERT_EQ(result.end, machine::MeasureEnd::Touched) << result.detail;
  EXPECT_NEAR(result.latched[0], 18, 1e-9) << "the face x = 20, one ball radius before it";
  const double pressed = (*machine)->position()[0];
  (*machine)->retract(positions({pressed, 16, -345}), machine::Feed::at(300));
  EXPECT_TRUE((*machine)->deflected(machine::Sensor::TouchProbe)) << "it moved along the face";
  (*machine)->retract(positions({0, 16, -345}), machine::Feed::at(300));
  EXPECT_FALSE((*machine)->deflected(machine::Sensor::TouchProbe));
}

TEST(Setup, BuildsPartsOfFeaturesAndGauges) {
  const auto setup = read(R"(
[part]
pose = { x = 100, z = -500, c = 90 }
[[part.feature]]
shape = "box"
size = [120, 80, 40]
[[part.feature]]
shape = "hole"
diameter = 30
depth = 20
centre = [20, 0, 40]
[ring]
diameter = 50
pose = { x = -100, z = -480 }
[sphere]
diameter = 30
pose = { x = -100, y = 100, z = -450 }
[gauge_block]
size = [20, 20, 50]
pose = { x = -100, y = -100, z = -450 }
[[tool]]
number = 1
kind = "probe"
length = 100
ball_radius = 2
in_spindle = true
)");
  auto built = buildMachine(setup.world);
  ASSERT_TRUE(built) << format(built.error());
  VirtualMachine& machine = **built;
  using testing_support::positions;
  const auto touch = [&](std::initializer_list<double> from, std::initializer_list<double> to, std::size_t axis) {
    machine.move(positions({from.begin()[0], from.begin()[1], 0}), machine::Feed::rapidTraverse());
    EXPECT_EQ(machine.move(positions(from), machine::Feed::rapidTraverse()).end, machine::MoveEnd::Reached);
    const auto result = machine.measure({positions(to), machine::Feed::at(300)});
    EXPECT_EQ(result.end, machine::MeasureEnd::Touched) << result.detail;
    machine.retract(positions(from), machine::Feed::rapidTraverse());
    machine.move(positions({from.begin()[0], from.begin()[1], 0}), machine::Feed::rapidTraverse());
    return result.latched[axis];
  };
  // The hole lies 20 mm along the part's X, which is the table's Y: x 100, y 20, and is 15 - 2 mm wide to the ball.
  EXPECT_NEAR(touch({100, 20, -370}, {130, 20, -370}, 0), 113, 1e-6);
  EXPECT_NEAR(touch({100, 20, -370}, {100, 0, -370}, 1), 7, 1e-6);
  EXPECT_NEAR(touch({100, -40, -350}, {100, -40, -370}, 2), -360, 1e-6) << "the top, 40 mm above z = -500";
  EXPECT_NEAR(touch({-100, 0, -385}, {-60, 0, -385}, 0), -77, 1e-6) << "the ring";
  EXPECT_NEAR(touch({-100, 100, -330}, {-100, 100, -340}, 2), -335, 1e-6) << "the top of the sphere";
  EXPECT_NEAR(touch({-100, -100, -340}, {-100, -100, -360}, 2), -350, 1e-6) << "the top of the gauge block";
}

TEST_F(SetupOnDisk, MissingPartIsReportedWhereItIsNamed) {
  std::filesystem::create_directories(folder / "folder.stl");
  for (const auto& [file, reason] : {std::pair("housing.stl", "there is no file"), {"folder.stl", "is a folder"}}) {
    Diagnostics diagnostics;
    const auto setup = readSetup(write(fmt::format("[part]\nfile = \"{}\"\n", file)), diagnostics);
    ASSERT_TRUE(setup);
    const auto machine = buildMachine(setup->world);
    ASSERT_FALSE(machine);
    EXPECT_THAT(format(machine.error()), ::testing::AllOf(HasSubstr("setup.toml:2:8: error: "), HasSubstr(reason)));
  }
}

TEST_F(SetupOnDisk, PartInTheWayAtTheStartIsRefused) {
  Diagnostics diagnostics;
  const auto setup = readSetup(write(R"(
[part]
file = "part.stl"
pose = { x = -5, y = -5, z = -110 }
[[tool]]
number = 1
kind = "probe"
length = 100
ball_radius = 2
in_spindle = true
)"),
                               diagnostics);
  ASSERT_TRUE(setup) << format(diagnostics.at(0));
  const auto machine = buildMachine(setup->world);
  ASSERT_FALSE(machine);
  EXPECT_THAT(format(machine.error()), HasSubstr("the machine cannot start like this"));
}

TEST(Setup, MissingFileIsReported) {
  Diagnostics diagnostics;
  EXPECT_FALSE(readSetup("/nowhere/setup.toml", diagnostics));
  EXPECT_THAT(diagnostics, SizeIs(1));
}

TEST_F(SetupOnDisk, NamesEveryMistakeOfAMachineFile) {
  std::ofstream(folder / "m.toml")
      << "name = \"m\"\n[[axis]]\nname = \"X\"\nkind = \"linear\"\nmin = -400\nmaximum = 400\n";
  Diagnostics diagnostics;
  EXPECT_FALSE(readSetup(write("[machine]\nfile = \"m.toml\"\n"), diagnostics));
  std::string all;
  for (const Diagnostic& each : diagnostics)
    all += format(each) + "\n";
  EXPECT_THAT(all, HasSubstr("m.toml:2:1: error: \"minimum\" is missing"));
  EXPECT_THAT(all, HasSubstr("m.toml:5:1: error: unknown key \"min\" in [[axis]]"));
  EXPECT_THAT(all, HasSubstr("axis X moves nothing"));
  // The file is there, but under the key of another thing.
  diagnostics.clear();
  EXPECT_FALSE(readSetup(write("[machine]\nname = \"m.toml\"\n"), diagnostics));
  EXPECT_THAT(format(diagnostics.at(0)), HasSubstr("Write file = \"m.toml\" if you mean this file"));
}

constexpr const char* probeHead = "[[tool]]\nnumber = 1\nkind = \"probe\"\nlength = 100\nball_radius = 3\n";

TEST(Setup, RefusesNamesOfTooManyParts) {
  // The parser nests each part of a name: a hundred thousand of them are more than its stack holds.
  std::string parts = "a";
  for (int i = 0; i < 100'000; ++i)
    parts += ".a";
  for (const std::string& text : {"[" + parts + "]\n", parts + " = 1\n", "x = { " + parts + " = 1 }\n"}) {
    Diagnostics diagnostics;
    EXPECT_FALSE(parseSetup(text, "s.toml", diagnostics));
    ASSERT_THAT(diagnostics, SizeIs(1));
    EXPECT_EQ(format(diagnostics[0]), "s.toml:1:1: error: this name has more than 100 parts");
  }
  // Points in texts and comments are none of a name.
  const std::string points(1000, '.');
  const auto setup = read("# " + points + "\n[answers]\na = \"" + points + "\\\"" + points + "\" # " + points +
                          "\nb = '''" + points + "'''\n");
  EXPECT_EQ(setup.beliefs.answers.at("a"), points + "\"" + points);
  EXPECT_EQ(setup.beliefs.answers.at("b"), points);
}

TEST(Setup, KnowsEveryKeyOfAProbe) {
  Diagnostics diagnostics;
  const auto setup = parseSetup(std::string(probeHead) + R"(
name = "P"
stylus_radius = 1
stylus_length = 40
body_radius = 20
body_length = 80
lobing = 0.002
lobing_phase = 30
repeatability = 0.0005
switched_on = false
shank_direction = [2, 0, 0]
probe_number = 2
probing_rapid = 3000
maximum_travel = 20
set_up_clearance = 3
calibration_angle = 90
orient = true
believed_radius = 2.9
believed_tip_offset = [0.1, 0.2]
)",
                                "s.toml", diagnostics);
  ASSERT_TRUE(setup) << format(diagnostics.at(0));
  const TrueTool& tool = setup->world.truth.tools.at(0);
  EXPECT_EQ(tool.probe.stylusLength, 40);
  EXPECT_EQ(tool.probe.bodyLength, 80);
  EXPECT_EQ(tool.probe.lobingPhase, 30);
  EXPECT_FALSE(tool.probe.switchedOn);
  EXPECT_EQ(tool.shankDirection, Vector3::UnitX());
  const BelievedTool& believed = setup->beliefs.tools.at(0);
  EXPECT_EQ(believed.probeNumber, 2);
  EXPECT_EQ(believed.rapid, 3000);
  EXPECT_EQ(believed.maximumTravel, 20);
  EXPECT_EQ(believed.setUpClearance, 3);
  EXPECT_EQ(believed.calibrationAngle, 90);
  EXPECT_TRUE(believed.orient);
  EXPECT_EQ(believed.radius, 2.9);
  EXPECT_EQ(believed.tipOffset, Vector2(0.1, 0.2));
}

TEST(Setup, AStarIsKnownByItsReach) {
  Diagnostics diagnostics;
  const std::string tool = "[[tool]]\nnumber = 1\nkind = \"probe\"\nlength = 150\nball_radius = 2\npretravel = 0.01\n";
  const auto setup = parseSetup(tool + "star_arm = 12\n", "s.toml", diagnostics);
  ASSERT_TRUE(setup) << format(diagnostics.at(0));
  EXPECT_EQ(setup->world.truth.tools.at(0).probe.starArm, 12);
  EXPECT_NEAR(setup->beliefs.tools.at(0).radius, 13.99, 1e-12);
  EXPECT_NEAR(setup->beliefs.tools.at(0).axialRadius, 2, 1e-12);
  EXPECT_FALSE(parseSetup(tool + "star_arm = 2.5\n", "s.toml", diagnostics)) << "the balls of the star overlap";
  EXPECT_TRUE(parseSetup(tool + "star_arm = 3\n", "s.toml", diagnostics)) << "the least that the advice names";
  EXPECT_TRUE(parseSetup(tool + "star_arm = 0\n", "s.toml", diagnostics)) << "no star";
}

}  // namespace
}  // namespace probewright::setup
