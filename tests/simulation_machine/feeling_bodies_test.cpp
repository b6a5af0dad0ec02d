#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "simulation/feeling_probe.hpp"
#include "support/virtual_world.hpp"

/// Bodies of the machine while another control moves the axes.
namespace probewright::simulation {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing_support::perfectWorld;
using testing_support::place;
using testing_support::positions;

/// A nose of 80 x 80 mm whose face is 10 mm below the spindle nose; a wall on the bed.
Truth world() {
  Truth truth = perfectWorld();
  truth.bodies.push_back({"nose", machine::headLink(truth.machine),
                          std::make_shared<Box>(Vector3(-40, -40, -10), Vector3(40, 40, 60)), Pose::Identity()});
  truth.bodies.push_back({"wall", machine::Link{},
                          std::make_shared<Box>(Vector3(-300, 100, -500), Vector3(300, 120, -300)), Pose::Identity()});
  return truth;
}

TEST(FeelingBodies, CollideUntilTheyComeApart) {
  Truth truth = world();
  place(truth, Box({-50, -50, -100}, {50, 50, 0}), translation({0, 0, -400}));
  FeelingProbe probe(std::move(truth), std::nullopt);
  std::vector<std::string> events;
  probe.onEvent([&](const std::string& what) { events.push_back(what); });
  const auto feel = [&](double z) { return probe.feel({positions({0, 0, z}), 0, 0, 0.01}).collision; };
  // The face of the block is z = -400: the nose meets it at Z-390.
  EXPECT_FALSE(feel(-380));
  EXPECT_FALSE(feel(-389.9));
  EXPECT_TRUE(feel(-390.1));
  EXPECT_TRUE(feel(-391));
  EXPECT_FALSE(feel(-389)) << "apart again";
  EXPECT_FALSE(feel(-389.5));
  EXPECT_TRUE(feel(-390.5));
  EXPECT_THAT(events, ElementsAre(HasSubstr("the machine's \"nose\" touched \"part\" at X"),
                                  HasSubstr("the machine's \"nose\" touched \"part\" at X")));
}

/// On a mill it stands on the table and travels with it.
TEST(FeelingBodies, MeetTheToolTouchProbeOnTheTable) {
  Truth truth = world();
  testing_support::placeToolProbe(truth, RoundBar(20, -10, 0), translation({150, 0, -400}));
  FeelingProbe probe(std::move(truth), std::nullopt);
  std::vector<std::string> events;
  probe.onEvent([&](const std::string& what) { events.push_back(what); });
  const auto feel = [&](double x, double z) { return probe.feel({positions({x, 0, z}), 0, 0, 0.1}).collision; };
  EXPECT_FALSE(feel(0, -380));
  EXPECT_FALSE(feel(0, -395)) << "the table has it elsewhere";
  EXPECT_FALSE(feel(0, -380));
  EXPECT_FALSE(feel(150, -380));
  EXPECT_FALSE(feel(150, -389.9));
  EXPECT_TRUE(feel(150, -390.1));
  EXPECT_THAT(events, ElementsAre(HasSubstr("the machine's \"nose\" touched \"TT\" at X")));
}

TEST(FeelingBodies, MeetTheTool) {
  // An arm on the slide that Y moves, 10 mm below the nose: Y60 would take its near side to the tool's axis.
  Truth truth = world();
  const machine::Link slide = machine::linkNamed(truth.machine, "Y").value();
  truth.bodies.push_back(
      {"arm", slide, std::make_shared<Box>(Vector3(-20, 60, -500), Vector3(20, 80, -350)), Pose::Identity()});
  FeelingProbe probe(std::move(truth), 1);
  std::vector<std::string> events;
  probe.onEvent([&](const std::string& what) { events.push_back(what); });
  const auto feel = [&](double x, double y) { return probe.feel({positions({x, y, -330}), 1, 0, 0.1}).collision; };
  EXPECT_FALSE(feel(0, 0));
  EXPECT_FALSE(feel(50, 39.9)) << "X moves the table upon the slide";
  EXPECT_TRUE(feel(50, 40.1)) << "the body of the probe has a radius of 20 mm";
  EXPECT_FALSE(feel(50, 30));
  EXPECT_THAT(events, ElementsAre(HasSubstr("tool 1 touched \"arm\"")));
}

TEST(FeelingBodies, DoNotMoveWithANewZero) {
  Truth truth = world();
  place(truth, Box({-50, -50, -100}, {50, 50, 0}), translation({0, 0, -400}));
  FeelingProbe probe(std::move(truth), std::nullopt);
  EXPECT_FALSE(probe.feel({positions({200, 0, -420}), 0, 0, 0.001}).collision);
  // 400 mm in a millisecond is no way through the block.
  EXPECT_FALSE(probe.feel({positions({-200, 0, -420}), 0, 0, 0.001}).collision);
  EXPECT_TRUE(probe.feel({positions({-80, 0, -420}), 0, 0, 0.1}).collision);
}

}  // namespace
}  // namespace probewright::simulation
