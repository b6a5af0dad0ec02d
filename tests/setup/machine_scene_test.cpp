#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "control/journal.hpp"
#include "reports/machine_scene.hpp"
#include "setup/scene.hpp"
#include "setup/setup.hpp"
#include "simulation/virtual_machine.hpp"
#include "support/virtual_world.hpp"

/// What a report gets of the machine: its bodies on their links, and where the axes were.
namespace probewright::setup {
namespace {

using machine::Feed;
using testing_support::positions;

constexpr const char* star =
    "[[tool]]\nnumber = 1\nkind = \"probe\"\nlength = 120\nball_radius = 3\nstar_arm = 25\nbody_radius = 20\n"
    "body_length = 70\nstylus_length = 40\n[[tool]]\nnumber = 2\nkind = \"mill\"\nlength = 80\nradius = 5\n";

std::unique_ptr<simulation::VirtualMachine> built(const std::string& text) {
  Diagnostics diagnostics;
  const auto setup = parseSetup(text, "setup.toml", diagnostics);
  EXPECT_TRUE(diagnostics.empty());
  if (!setup) return nullptr;
  auto machine = simulation::buildMachine(setup->world);
  EXPECT_TRUE(machine);
  return machine ? std::move(*machine) : nullptr;
}

TEST(MachineScene, HasThePlaceOfEachAxisAtEachPointOfThePath) {
  const auto machine = built(std::string("[machine]\nname = \"mill5-table-table\"\n") + star);
  ASSERT_TRUE(machine);
  machine->changeTool({1, {}});
  machine->move(positions({50, -20, -100, 0, 0}), Feed::rapidTraverse());
  machine->move(positions({50, -20, -100, 30, 90}), Feed::at(5000));
  machine->changeTool({2, {}});
  const reports::Scene scene = sceneOf(control::Journal(), machine->truth(), machine->path());
  ASSERT_TRUE(scene.machine);
  const reports::MachineReplay& replay = *scene.machine;
  ASSERT_EQ(scene.path.axes.size(), scene.path.points.size());
  EXPECT_EQ(scene.path.axes.back()[4], 90);
  // The tip is where the axes of that point put it: 3 mm over the end of the probe.
  for (std::size_t i = 0; i < scene.path.axes.size(); ++i) {
    const simulation::PathPoint& point = machine->path().points[i];
    const double below = point.tool < 0 ? 0 : point.tool == 0 ? 117 : 80;
    const Pose tableFromSpindle = machine::baseFromTable(replay.scene.machine, scene.path.axes[i]).inverse() *
                                  machine::baseFromSpindle(replay.scene.machine, scene.path.axes[i]);
    EXPECT_NEAR((tableFromSpindle * Vector3(0, 0, -below) - point.tip).norm(), 0, 1e-9) << i;
  }
  ASSERT_EQ(replay.changes.size(), 2U);
  EXPECT_EQ(replay.changes[0].tool, 0);
  EXPECT_EQ(replay.changes[1].tool, -1) << "a mill is drawn as before";
}

TEST(MachineScene, DrawsAProbeWithBodyAndStar) {
  const auto machine = built(std::string("[machine]\nname = \"mill3\"\n") + star);
  ASSERT_TRUE(machine);
  machine->changeTool({1, {}});
  const reports::Scene scene = sceneOf(control::Journal(), machine->truth(), machine->path());
  ASSERT_TRUE(scene.machine);
  ASSERT_EQ(scene.machine->probes.size(), 1U);
  const reports::Mesh& probe = scene.machine->probes[0];
  Eigen::AlignedBox3f box;
  for (const auto& point : probe.positions)
    box.extend(point);
  // The balls of the star reach 25 + 3 mm; the body begins 40 mm over them.
  EXPECT_NEAR(box.max().x(), 28, 1e-4);
  EXPECT_NEAR(box.min().y(), -28, 1e-4);
  EXPECT_NEAR(box.min().z(), -120, 1e-4);
  EXPECT_NEAR(box.max().z(), -117 + 40 + 70, 1e-4);
  float widest = 0;
  for (const auto& point : probe.positions)
    if (point.z() > -76) widest = std::max(widest, point.head<2>().norm());
  EXPECT_NEAR(widest, 20, 1e-4);
}

TEST(MachineScene, PacksTheBodiesOfEachLink) {
  const auto machine = built("[machine]\nname = \"mill3\"\n");
  ASSERT_TRUE(machine);
  machine->move(positions({50, 0, -100}), Feed::rapidTraverse());
  const reports::Scene scene = sceneOf(control::Journal(), machine->truth(), machine->path());
  ASSERT_TRUE(scene.machine);
  const nlohmann::json data = reports::machineData(*scene.machine);
  // The table and all bodies, each on a link of its chain.
  EXPECT_EQ(data["bodies"].size(), machine->truth().bodies.size() + 1);
  for (const auto& body : data["bodies"])
    EXPECT_LE(body["elements"].get<std::size_t>(), data[body["chain"].get<std::string>()].size());
}

TEST(MachineScene, IsLeftOutWithoutBodies) {
  simulation::Truth truth = testing_support::perfectWorld();
  simulation::VirtualMachine machine(std::move(truth));
  machine.move(positions({50, 0, -100}), Feed::rapidTraverse());
  const reports::Scene scene = sceneOf(control::Journal(), machine.truth(), machine.path());
  EXPECT_FALSE(scene.machine);
  // What its axes read is known all the same.
  ASSERT_EQ(scene.path.axes.size(), scene.path.points.size());
  EXPECT_EQ(scene.path.axes.back()[0], 50);
}

}  // namespace
}  // namespace probewright::setup
