#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "machine/links.hpp"
#include "machine/machine_file.hpp"
#include "setup/setup.hpp"
#include "simulation/virtual_machine.hpp"
#include "support/virtual_world.hpp"

/// Bodies of the machine: what they run into, where, and what passes. All contacts are known in closed form.
namespace probewright::setup {
namespace {

using namespace simulation;

using machine::Feed;
using machine::MeasureEnd;
using machine::MoveEnd;
using ::testing::HasSubstr;
using testing_support::positions;

Result<std::unique_ptr<VirtualMachine>> built(const std::string& text) {
  Diagnostics diagnostics;
  const auto setup = parseSetup(text, "setup.toml", diagnostics);
  for (const Diagnostic& diagnostic : diagnostics)
    ADD_FAILURE() << format(diagnostic);
  if (!setup) return fail("no setup");
  return buildMachine(setup->world);
}

std::unique_ptr<VirtualMachine> world(const std::string& text) {
  auto machine = built(text);
  EXPECT_TRUE(machine) << format(machine.error());
  return machine ? std::move(*machine) : nullptr;
}

std::string machineWith(const std::string& name, const std::string& start, const std::string& bodies) {
  return "[machine]\nname = \"" + name + "\"\nstart = { " + start + " }\n" + bodies;
}

std::string body(const std::string& name, const std::string& link, const std::string& feature) {
  return "[[machine.body]]\nname = \"" + name + "\"\nlink = \"" + link + "\"\n[[machine.body.feature]]\n" + feature;
}

/// From corner to corner.
std::string box(const Vector3& low, const Vector3& high) {
  return fmt::format("shape = \"box\"\ncentre = [{}, {}, {}]\nsize = [{}, {}, {}]\n", (low.x() + high.x()) / 2,
                     (low.y() + high.y()) / 2, low.z(), high.x() - low.x(), high.y() - low.y(), high.z() - low.z());
}

const std::string wideNose = body("wide nose", "head", "shape = \"cylinder\"\ndiameter = 200\nheight = 60\n");
/// Its top is the plane z = -400, its sides x = +-50 and y = +-50.
const std::string block = "[part]\nname = \"block\"\n[[part.feature]]\n" + box({-50, -50, -640}, {50, 50, -400});

TEST(MachineBodies, ANoseMeetsThePartWithItsFace) {
  const auto machine = world(machineWith("mill3", "Z = 0", wideNose) + block);
  ASSERT_TRUE(machine);
  const auto hit = machine->move(positions({10, 20, -500}), Feed::rapidTraverse());
  EXPECT_EQ(hit.end, MoveEnd::Collision);
  EXPECT_THAT(hit.detail, HasSubstr("nose\" touched \"block\""));
  EXPECT_NEAR(machine->position()[2], -400, 0.01);
  EXPECT_NEAR(machine->position()[0], 10 * 0.8, 0.01) << "on the straight way there";
  ASSERT_EQ(machine->path().touches.size(), 1U);
  EXPECT_NEAR(machine->path().touches[0].point.z(), -400, 0.01);
  EXPECT_EQ(machine->path().points.back().axes, machine->position());
  // It may go back, and then along.
  EXPECT_EQ(machine->retract(positions({8, 16, -390}), Feed::at(1000)).end, MoveEnd::Reached);
  EXPECT_EQ(machine->move(positions({-40, 30, -399.9}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_EQ(machine->move(positions({-40, 30, -401}), Feed::rapidTraverse()).end, MoveEnd::Collision);
}

TEST(MachineBodies, ANosePassesBesideThePart) {
  const auto machine = world(machineWith("mill3", "X = 151, Z = 0", wideNose) + block);
  ASSERT_TRUE(machine);
  // Its rim reaches x = 51 at X151: 1 mm beside the side of the block, and at X150.1 0.1 mm.
  EXPECT_EQ(machine->move(positions({151, 0, -500}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_EQ(machine->move(positions({150.1, 40, -500}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_EQ(machine->move(positions({150.1, -40, -420}), Feed::at(2000)).end, MoveEnd::Reached);
  EXPECT_EQ(machine->move(positions({0, -40, -420}), Feed::at(2000)).end, MoveEnd::Collision);
  EXPECT_NEAR(machine->position()[0], 150, 0.02);
}

TEST(MachineBodies, StopAMeasuringMoveToo) {
  const std::string probe = "[[tool]]\nnumber = 1\nkind = \"probe\"\nlength = 80\nball_radius = 2\nin_spindle = true\n";
  const auto machine = world(machineWith("mill3", "X = 140, Z = -330", wideNose) + block + probe);
  ASSERT_TRUE(machine);
  // The ball is beside the block, and the nose over it.
  const auto hit = machine->measure({positions({140, 0, -450}), Feed::at(500)});
  EXPECT_EQ(hit.end, MeasureEnd::Collision);
  EXPECT_THAT(hit.detail, HasSubstr("nose\" touched \"block\""));
  EXPECT_NEAR(machine->position()[2], -400, 0.01);
}

TEST(MachineBodies, ATrunnionMeetsTheHead) {
  // A post of 20 mm stands on the axis of A, which is y = 0, z = -550. At A90 it lies along +Y; towards A0 it rises.
  const auto machine = world(machineWith("mill5-table-table", "Y = 60, Z = -500, A = 90",
                                         body("post", "A", box({-10, -10, -550}, {10, 10, -150})) +
                                             body("small nose", "head", box({-45, -45, 0}, {45, 45, 40}))));
  ASSERT_TRUE(machine);
  const auto hit = machine->move(positions({0, 60, -500, 0, 0}), Feed::rapidTraverse());
  EXPECT_EQ(hit.end, MoveEnd::Collision);
  EXPECT_THAT(hit.detail, HasSubstr("\"post\""));
  // Its upper side meets the edge of the nose at y = 105, 50 mm over the axis: that point is 10 mm from its middle
  // line.
  const double expected = 90 - degreesFromRadians(std::atan2(50, 105) - std::asin(10 / std::hypot(50, 105)));
  EXPECT_NEAR(machine->position()[3], expected, 0.02);
}

TEST(MachineBodies, APartMeetsTheTrunnionThatCarriesItsTable) {
  // Its corners at x = 338, y = +-60 swing out to the inner side of the arm, x = 339.
  const auto machine =
      world(machineWith("mill5-table-table", "Z = 0", body("arm", "A", box({339, -130, -670}, {360, 130, -480}))) +
            "[part]\nname = \"beam\"\n[[part.feature]]\n" + box({100, -60, -599}, {338, 60, -540}));
  ASSERT_TRUE(machine);
  const double swing = std::atan2(60, 338) - std::acos(339 / std::hypot(338, 60));
  const auto hit = machine->move(positions({0, 0, 0, 0, 30}), Feed::rapidTraverse());
  EXPECT_EQ(hit.end, MoveEnd::Collision);
  EXPECT_THAT(hit.detail, HasSubstr("\"arm\" touched \"beam\""));
  EXPECT_NEAR(machine->position()[4], degreesFromRadians(swing), 0.01);
}

TEST(MachineBodies, AToolMeetsTheTrunnion) {
  const std::string tools = "[[tool]]\nnumber = 1\nkind = \"mill\"\nlength = 150\nradius = 10\nin_spindle = true\n";
  const auto machine = world(
      machineWith("mill5-table-table", "Z = -400", body("arm", "A", box({300, -130, -670}, {360, 130, -480}))) + tools);
  ASSERT_TRUE(machine);
  const auto hit = machine->move(positions({380, 0, -400, 0, 0}), Feed::rapidTraverse());
  EXPECT_EQ(hit.end, MoveEnd::Collision);
  EXPECT_THAT(hit.detail, HasSubstr("tool 1 touched the machine's \"arm\" at X+300.000"));
  EXPECT_NEAR(machine->position()[0], 290, 0.002);
  // It turns away under the tool, which then has room.
  EXPECT_EQ(machine->retract(positions({200, 0, -400, 0, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_EQ(machine->move(positions({200, 0, -300, 0, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_EQ(machine->move(positions({380, 0, -300, 0, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
}

TEST(MachineBodies, AHolderMeetsAFixture) {
  const std::string tools =
      "[[tool]]\nnumber = 1\nkind = \"mill\"\nlength = 150\nradius = 5\nin_spindle = true\n"
      "[tool.cutter]\nholder_radius = 30\nholder_length = 90\n";
  const std::string clamp =
      "[[fixture]]\nname = \"clamp\"\n[[fixture.feature]]\n" + box({20, -20, -640}, {60, 20, -500});
  const auto machine = world(machineWith("mill3", "Z = 0", "") + clamp + tools);
  ASSERT_TRUE(machine);
  // The holder's lower face is 60 mm above the end of the mill, which passes beside the clamp.
  const auto hit = machine->move(positions({0, 0, -470}), Feed::rapidTraverse());
  EXPECT_EQ(hit.end, MoveEnd::Collision);
  EXPECT_THAT(hit.detail, HasSubstr("the holder of tool 1 touched the fixture \"clamp\""));
  EXPECT_NEAR(machine->position()[2], -500 + 90, 0.01) << "the holder begins 90 mm below the nose";
}

TEST(MachineBodies, OfTheBedStopTheTable) {
  // The table's edge stands at x = 500 and moves against the axis.
  const auto machine =
      world(machineWith("mill3", "Z = 0", body("wall", "bed", box({700, -100, -720}, {720, 100, -600}))));
  ASSERT_TRUE(machine);
  const auto hit = machine->move(positions({-300, 0, 0}), Feed::rapidTraverse());
  EXPECT_EQ(hit.end, MoveEnd::Collision);
  EXPECT_THAT(hit.detail, HasSubstr("\"wall\" touched \"table\""));
  EXPECT_NEAR(machine->position()[0], -200, 0.01);
}

TEST(MachineBodies, ThatTouchAtTheStartAreLeftOutUntilTheyComeApart) {
  const auto machine = world(machineWith("mill3", "Z = -450", wideNose) + block);
  ASSERT_TRUE(machine);
  EXPECT_THAT(machine->bodyContact().value_or(""), HasSubstr("nose\" touched \"block\""));
  // Within the block it moves as it likes; once out of it, it does not come back.
  EXPECT_EQ(machine->move(positions({5, 0, -460}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_EQ(machine->move(positions({5, 0, -300}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_FALSE(machine->bodyContact());
  EXPECT_EQ(machine->move(positions({5, 0, -310}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_EQ(machine->move(positions({5, 0, -460}), Feed::rapidTraverse()).end, MoveEnd::Collision);
  EXPECT_NEAR(machine->position()[2], -400, 0.01);
}

TEST(MachineBodies, ThatTheToolTouchesAtTheStartAreLeftOutUntilItIsFree) {
  const std::string tools = "[[tool]]\nnumber = 1\nkind = \"mill\"\nlength = 150\nradius = 10\nin_spindle = true\n";
  const auto machine = world(machineWith("mill5-table-table", "X = 300, Z = -400",
                                         body("arm", "A", box({300, -130, -670}, {330, 130, -480}))) +
                             tools);
  ASSERT_TRUE(machine);
  EXPECT_THAT(machine->bodyContact().value_or(""), HasSubstr("tool 1 touched the machine's \"arm\""));
  EXPECT_EQ(machine->move(positions({200, 0, -400, 0, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_EQ(machine->move(positions({250, 0, -400, 0, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_EQ(machine->move(positions({320, 0, -400, 0, 0}), Feed::rapidTraverse()).end, MoveEnd::Collision);
}

TEST(MachineBodies, AreNotTestedAgainstTheirNeighbours) {
  // A sleeve about the post that it slides on, and the table that stands in its cradle.
  const auto machine = world(machineWith("mill3", "Z = 0",
                                         body("post", "bed", box({-20, 600, -900}, {20, 640, 500})) +
                                             body("sleeve", "Z", box({-30, 590, 100}, {30, 650, 200}))));
  ASSERT_TRUE(machine);
  EXPECT_EQ(machine->move(positions({0, 0, -300}), Feed::rapidTraverse()).end, MoveEnd::Reached);
}

/// A tetrahedron with its lower corner in the origin and a triangle 50 mm above it.
std::string tetrahedron() {
  const std::array<Vector3, 4> corners = {Vector3(0, 0, 0), {60, 0, 50}, {-30, 52, 50}, {-30, -52, 50}};
  std::string text = "solid t\n";
  for (const auto& face : {std::array<std::size_t, 3>{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::size_t corner : face)
      text += fmt::format("vertex {} {} {}\n", corners[corner].x(), corners[corner].y(), corners[corner].z());
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid t\n";
}

TEST(MachineBodies, MayComeFromAFileOntoAMachineOfLinuxCnc) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "machine_bodies";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "guard.stl") << tetrahedron();
  std::ofstream(folder / "shop.ini")
      << "[KINS]\nKINEMATICS = trivkins coordinates=XYZ\n"
         "[JOINT_0]\nMIN_LIMIT = -100\nMAX_LIMIT = 100\nMAX_VELOCITY = 50\nMAX_ACCELERATION = 500\n"
         "[JOINT_1]\nMIN_LIMIT = -100\nMAX_LIMIT = 100\nMAX_VELOCITY = 50\nMAX_ACCELERATION = 500\n"
         "[JOINT_2]\nMIN_LIMIT = -300\nMAX_LIMIT = 0\nMAX_VELOCITY = 50\nMAX_ACCELERATION = 500\n";
  const std::string setup =
      "[machine]\nfile = \"shop.ini\"\n[[machine.body]]\nname = \"guard\"\nlink = \"head\"\nfile = \"guard.stl\"\n"
      "pose = { x = 10, z = -20, c = 30 }\n[part]\nname = \"plate\"\n[[part.feature]]\n" +
      box({-90, -90, -260}, {90, 90, -200});
  Diagnostics diagnostics;
  const auto read = parseSetup(setup, (folder / "setup.toml").string(), diagnostics);
  ASSERT_TRUE(read && !hasErrors(diagnostics));
  EXPECT_EQ(read->inputs.back(), folder / "guard.stl");
  const auto built = buildMachine(read->world);
  ASSERT_TRUE(built) << format(built.error());
  const auto& machine = *built;
  // Its corner is 20 mm below the nose.
  const auto hit = machine->move(positions({0, 0, -250}), Feed::rapidTraverse());
  EXPECT_EQ(hit.end, MoveEnd::Collision);
  EXPECT_THAT(hit.detail, HasSubstr("the machine's \"guard\" touched \"plate\" at X+10.0"));
  EXPECT_NEAR(machine->position()[2], -200 + 20, 0.01);
}

TEST(MachineBodies, HaveMistakesWithTheirPlaces) {
  const auto mistakes = [](const std::string& text) {
    Diagnostics diagnostics;
    EXPECT_FALSE(
        parseSetup("[machine]\nname = \"mill5-table-table\"\n[[machine.body]]\n" + text, "s.toml", diagnostics));
    std::string all;
    for (const Diagnostic& diagnostic : diagnostics)
      all += format(diagnostic) + "\n";
    return all;
  };
  const std::string shape = "[[machine.body.feature]]\nshape = \"sphere\"\ndiameter = 5\n";
  EXPECT_THAT(mistakes(shape), HasSubstr("s.toml:3:1: error: \"link\" is missing in [[machine.body]]"));
  EXPECT_THAT(mistakes("link = \"heads\"\n" + shape), HasSubstr("s.toml:4:8: error: there is no axis called heads"));
  EXPECT_THAT(mistakes("link = \"heads\"\n" + shape), HasSubstr("Did you mean \"head\"?"));
  EXPECT_THAT(mistakes("link = \"A\"\n"), HasSubstr("needs either a file or features"));
  EXPECT_THAT(mistakes("link = \"A\"\nfile = \"a.step\"\n" + shape), HasSubstr("needs either a file or features"));
  EXPECT_THAT(mistakes("link = \"A\"\nfile = \"a.obj\"\n"), HasSubstr("not a part file that can be read"));
  EXPECT_THAT(mistakes("link = \"A\"\ncolour = 3\n" + shape), HasSubstr("unknown key \"colour\""));
}

TEST(MachineBodies, LinksAreThePlacesAlongTheChains) {
  const auto machine = machine::readMachine("mill5-table-table");
  ASSERT_TRUE(machine);
  const auto q = positions({10, 20, -30, 40, 50});
  const auto link = [&](const char* name) { return machine::linkNamed(*machine, name).value(); };
  EXPECT_TRUE(machine::baseFromLink(*machine, q, link("bed")).isApprox(Pose::Identity()));
  EXPECT_TRUE(machine::baseFromLink(*machine, q, link("table")).isApprox(machine::baseFromTable(*machine, q)));
  EXPECT_TRUE(machine::baseFromLink(*machine, q, link("head")).isApprox(machine::baseFromSpindle(*machine, q)));
  // The trunnion turns against the tool about the line y = 0, z = -550.
  const Pose trunnion = machine::baseFromLink(*machine, q, link("A"));
  const Vector3 raised = trunnion * Vector3(7, 0, -450);
  const double a = radiansFromDegrees(40);
  EXPECT_NEAR((raised - Vector3(7, 100 * std::sin(a), -550 + 100 * std::cos(a))).norm(), 0, 1e-9);
  EXPECT_EQ(link("Z"), link("head"));
  EXPECT_EQ(link("C"), link("table"));
  EXPECT_FALSE(machine::linkNamed(*machine, "B"));
  EXPECT_TRUE(machine::areNeighbours(link("bed"), link("Y")));
  EXPECT_FALSE(machine::areNeighbours(link("bed"), link("C")));
  EXPECT_FALSE(machine::areNeighbours(link("A"), link("Y")));
}

}  // namespace
}  // namespace probewright::setup
