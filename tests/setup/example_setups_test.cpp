#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "setup/setup.hpp"
#include "simulation/virtual_machine.hpp"
#include "support/virtual_world.hpp"

namespace probewright::setup {
namespace {

using namespace simulation;

using machine::Feed;
using machine::MeasureEnd;
using testing_support::positions;

std::unique_ptr<VirtualMachine> build(const std::filesystem::path& path, Setup& setup) {
  Diagnostics diagnostics;
  auto read = readSetup(path, diagnostics);
  for (const Diagnostic& diagnostic : diagnostics)
    ADD_FAILURE() << format(diagnostic);
  if (!read) return nullptr;
  setup = std::move(*read);
  auto built = buildMachine(setup.world);
  if (!built) {
    ADD_FAILURE() << format(built.error());
    return nullptr;
  }
  return std::move(*built);
}

TEST(ExampleSetups, PutTheHousingWhereTheySay) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PROBEWRIGHT_EXAMPLES "/setups")) {
    if (!entry.path().filename().string().starts_with("housing-")) continue;
    ++count;
    setup::Setup setup;
    const auto machine = build(entry.path(), setup);
    ASSERT_TRUE(machine);
    ASSERT_TRUE(setup.beliefs.control) << entry.path();
    ASSERT_EQ(machine->changeTool({1, ""}).end, machine::ToolChangeEnd::Changed);
    // The plain place X 10, Y 40 on the top face, with the tip 140.25 mm below the nose.
    const Pose& table = setup.world.solids.at(0).tableFromSolid;
    const Vector3 top = table * Vector3(10, 40, 0);
    const double z = top.z() + 140.25;
    machine->move(positions({top.x(), top.y(), z + 20}), Feed::rapidTraverse());
    const auto onTop = machine->measure({positions({top.x(), top.y(), z - 5}), Feed::at(300)});
    ASSERT_EQ(onTop.end, MeasureEnd::Touched) << onTop.detail;
    EXPECT_NEAR(onTop.latched[2], z, 0.003 + 6 * 0.0003);
    // Along the face the stylus stays deflected; off it, it comes free.
    const double pressed = machine->position()[2];
    machine->retract(positions({top.x() + 1, top.y(), pressed}), Feed::at(300));
    EXPECT_TRUE(machine->deflected(machine::Sensor::TouchProbe));
    machine->retract(positions({top.x(), top.y(), z + 20}), Feed::rapidTraverse());
    EXPECT_FALSE(machine->deflected(machine::Sensor::TouchProbe));
    // The face X 0 at Y 40, Z -20, approached along the part's X, with the ball's centre 3 mm above the tip.
    const Vector3 along = table.linear() * Vector3::UnitX();
    const auto nose = [&](const Vector3& centre) {
      return positions({centre.x() - 0.012, centre.y() + 0.007, centre.z() + 137.25});
    };
    const Vector3 face = table * Vector3(0, 40, -20);
    machine->move(nose(face - 15 * along + 60 * Vector3::UnitZ()), Feed::rapidTraverse());
    ASSERT_EQ(machine->move(nose(face - 15 * along), Feed::rapidTraverse()).end, machine::MoveEnd::Reached);
    const auto onSide = machine->measure({nose(face + 5 * along), Feed::at(300)});
    ASSERT_EQ(onSide.end, MeasureEnd::Touched) << onSide.detail;
    const Vector3 centre(onSide.latched[0] + 0.012, onSide.latched[1] - 0.007, onSide.latched[2] - 137.25);
    EXPECT_NEAR((centre - face).dot(along), -3 + 0.006, 0.0005 + 6 * 0.0003);
  }
  EXPECT_GE(count, 3);
}

TEST(ExampleSetups, TheManualsExamplesAreRead) {
  std::stringstream file;
  for (const char* name : {"setup-format.md", "machine-files.md"})
    file << std::ifstream(std::string(PROBEWRIGHT_EXAMPLES "/../docs/") + name).rdbuf();
  std::string line, block;
  bool inside = false;
  int count = 0;
  while (std::getline(file, line)) {
    if (!inside) {
      inside = line == "```toml";
      continue;
    }
    if (line != "```") {
      block += line + "\n";
      continue;
    }
    Diagnostics diagnostics;
    if (block.find("[[axis]]") != std::string::npos) {
      EXPECT_TRUE(machine::parseMachine(block, "example.toml", diagnostics));
    } else {
      EXPECT_TRUE(parseSetup(block, "example.toml", diagnostics));
    }
    for (const Diagnostic& diagnostic : diagnostics)
      ADD_FAILURE() << format(diagnostic);
    ++count;
    inside = false;
    block.clear();
  }
  EXPECT_EQ(count, 4);
}

}  // namespace
}  // namespace probewright::setup
