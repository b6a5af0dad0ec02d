#include <gtest/gtest.h>

#include "setup/setup.hpp"
#include "simulation/virtual_machine.hpp"
#include "support/virtual_world.hpp"

/// The tool touch probe on the table: it signals when a tool touches it.
namespace probewright::setup {
namespace {

using namespace simulation;

using machine::Feed;
using machine::MeasureEnd;
using machine::MoveEnd;
using machine::Sensor;
using testing_support::positions;

Setup read(const std::string& text, Diagnostics& diagnostics) {
  auto setup = parseSetup(text, "setup.toml", diagnostics);
  return setup ? std::move(*setup) : Setup{};
}

constexpr const char* mill = R"(
[[tool]]
number = 9
kind = "mill"
length = 80
radius = 6
in_spindle = true
)";

std::unique_ptr<VirtualMachine> built(const std::string& table) {
  Diagnostics diagnostics;
  auto machine = buildMachine(read(table + mill, diagnostics).world);
  EXPECT_TRUE(diagnostics.empty()) << (diagnostics.empty() ? "" : format(diagnostics.front()));
  EXPECT_TRUE(machine);
  return std::move(*machine);
}

TEST(ToolProbe, SignalsWhenAToolTouchesIt) {
  for (const char* contact : {"diameter = 40", "size = [40, 30]"}) {
    const auto machine = built(std::string("[tool_probe]\n") + contact + "\npose = { x = 50, y = 20, z = -400 }\n");
    const Feed rapid = Feed::rapidTraverse(), slow = Feed::at(300);
    EXPECT_EQ(machine->move(positions({0, 20, -325}), rapid).end, MoveEnd::Reached);
    // The side of the contact lies at x 30, the tool is 6 mm thick.
    const auto side = machine->measure({positions({40, 20, -325}), slow, Sensor::ToolTouchProbe});
    ASSERT_EQ(side.end, MeasureEnd::Touched) << side.detail;
    // Tools meet curved faces of a setup's solids as drawn, by facets.
    const bool curved = std::string_view(contact).starts_with("diameter");
    EXPECT_NEAR(side.latched[0], 24, curved ? 0.01 : 1e-6);
    EXPECT_TRUE(machine->deflected(Sensor::ToolTouchProbe));
    EXPECT_GE(machine->position()[0], 24);
    EXPECT_EQ(machine->measure({positions({40, 20, -325}), slow, Sensor::ToolTouchProbe}).end,
              MeasureEnd::DeflectedAtStart);
    EXPECT_EQ(machine->move(positions({0, 20, -325}), rapid).end, MoveEnd::ProbeSignal);
    EXPECT_EQ(machine->retract(positions({0, 20, -325}), rapid).end, MoveEnd::Reached);
    EXPECT_FALSE(machine->deflected(Sensor::ToolTouchProbe));
    machine->move(positions({0, 20, -300}), rapid);
    machine->move(positions({50, 20, -300}), rapid);
    const auto top = machine->measure({positions({50, 20, -330}), slow, Sensor::ToolTouchProbe});
    ASSERT_EQ(top.end, MeasureEnd::Touched) << top.detail;
    EXPECT_NEAR(top.latched[2], -320, 1e-6);
    machine->retract(positions({50, 20, -300}), rapid);
    // Positioning into it is a collision.
    const auto crash = machine->move(positions({50, 20, -330}), rapid);
    EXPECT_EQ(crash.end, MoveEnd::Collision);
    EXPECT_NE(crash.detail.find("tool touch probe"), std::string::npos) << crash.detail;
  }
}

/// What the control is told of the contact: cycles ask whether it is a cuboid.
TEST(ToolProbe, KnowsADiscFromACuboid) {
  for (const auto& [contact, cuboid] : {std::pair("diameter = 40", false), {"size = [40, 30]", true}}) {
    Diagnostics diagnostics;
    const auto setup = read(std::string("[tool_probe]\n") + contact + "\npose = { z = -400 }\n", diagnostics);
    EXPECT_TRUE(diagnostics.empty()) << (diagnostics.empty() ? "" : format(diagnostics.front()));
    ASSERT_EQ(setup.beliefs.toolProbes.size(), 1U) << contact;
    EXPECT_EQ(setup.beliefs.toolProbes.front().cuboid, cuboid) << contact;
  }
}

TEST(ToolProbe, IsNotThereUnlessTheSetupHasIt) {
  const auto without = built("[gauge_block]\nsize = [20, 20, 20]\npose = { z = -400 }\n");
  EXPECT_EQ(without->measure({positions({0, 0, -330}), Feed::at(300), Sensor::ToolTouchProbe}).end,
            MeasureEnd::NotReady);
  const auto aside = built(
      "[tool_probe]\ndiameter = 40\npose = { x = 200, z = -400 }\n[gauge_block]\nsize = [20, 20, 20]\npose = { z "
      "= -400 }\n");
  EXPECT_EQ(aside->measure({positions({0, 0, -330}), Feed::at(300), Sensor::ToolTouchProbe}).end,
            MeasureEnd::Collision);
  const auto missed = built("[tool_probe]\ndiameter = 40\npose = { x = 200, z = -400 }\n");
  EXPECT_EQ(missed->measure({positions({0, 0, -330}), Feed::at(300), Sensor::ToolTouchProbe}).end,
            MeasureEnd::NoContact);
}

TEST(ToolProbe, NeedsOneShape) {
  const auto mistake = [](const std::string& keys) {
    Diagnostics diagnostics;
    read("[tool_probe]\n" + keys + mill, diagnostics);
    return diagnostics.empty() ? std::string() : format(diagnostics.front());
  };
  EXPECT_NE(mistake("").find("needs either a diameter or a size"), std::string::npos);
  EXPECT_NE(mistake("diameter = 40\nsize = [30, 30]\n").find("either a diameter or a size"), std::string::npos);
  EXPECT_NE(mistake("size = [30, 0]\n").find("at least 0.001"), std::string::npos);
  EXPECT_NE(mistake("diameter = 8\nstem_diameter = 9\n").find("must be thinner"), std::string::npos);
  EXPECT_EQ(mistake("diameter = 40\n"), "");
}

}  // namespace
}  // namespace probewright::setup
