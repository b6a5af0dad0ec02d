#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "machine/machine_file.hpp"
#include "machine/table_body.hpp"
#include "setup/setup.hpp"
#include "simulation/virtual_machine.hpp"
#include "support/virtual_world.hpp"

namespace probewright::setup {
namespace {

using namespace simulation;

using machine::Feed;
using machine::MoveEnd;
using ::testing::HasSubstr;
using testing_support::positions;

std::unique_ptr<VirtualMachine> world(const std::string& machine, const std::string& more = {},
                                      const std::string& probe = {}) {
  Diagnostics diagnostics;
  const auto setup = parseSetup("[machine]\nname = \"" + machine + "\"\n" + more +
                                    "[[tool]]\nnumber = 1\nkind = \"probe\"\nlength = 200\nball_radius = 3\n"
                                    "in_spindle = true\n" +
                                    probe,
                                "setup.toml", diagnostics);
  for (const Diagnostic& diagnostic : diagnostics)
    ADD_FAILURE() << format(diagnostic);
  if (!setup) return nullptr;
  auto built = buildMachine(setup->world);
  EXPECT_TRUE(built) << format(built.error());
  return built ? std::move(*built) : nullptr;
}

TEST(TableBody, StopsAProbeAtTheSurfaceThatTheDocumentationTells) {
  // The tip of the tool of 200 mm stands at z of the reading - 200.
  for (const auto& [name, surface] : {std::pair("mill3", -650.0),
                                      {"mill5-table-table", -600.0},
                                      {"mill5-head-table", -700.0},
                                      {"mill5-head-head", -1000.0}}) {
    const auto machine = world(name);
    ASSERT_TRUE(machine);
    machine::AxisPositions target = machine->position();
    const std::size_t z = *machine->description().axisIndex("Z");
    target[z] = surface + 200 + 1;
    EXPECT_EQ(machine->move(target, Feed::rapidTraverse()).end, MoveEnd::Reached) << name;
    target[z] = surface + 200 - 40;
    const auto hit = machine->move(target, Feed::at(1000));
    EXPECT_EQ(hit.end, MoveEnd::ProbeSignal) << name;
    EXPECT_THAT(hit.detail, HasSubstr("\"table\"")) << name;
    EXPECT_NEAR(machine->position()[z], surface + 200, 2.5) << name << ", less what the stylus gives way";
  }
}

TEST(TableBody, StandsUprightOnTheHorizontalMachine) {
  const auto machine = world("mill4-table", {}, "body_radius = 80\n");
  ASSERT_TRUE(machine);
  // The table's surface is y = -500, from z = -385 on; the body of the probe reaches 80 mm below the spindle axis.
  EXPECT_EQ(machine->move(positions({0, -410, -500, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_EQ(machine->move(positions({0, -430, -500, 0}), Feed::rapidTraverse()).end, MoveEnd::Collision);
}

TEST(TableBody, IsAsWideAsItIs) {
  const auto machine = world("mill5-table-table");
  ASSERT_TRUE(machine);
  // The disc of 500 mm ends at X 250; beyond it there is air.
  EXPECT_EQ(machine->move(positions({300, 0, 0, 0, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_EQ(machine->move(positions({300, 0, -450, 0, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
}

TEST(TableBody, TurnsWithTheTrunnion) {
  const auto machine = world("mill5-table-table");
  ASSERT_TRUE(machine);
  // With A at 90 degrees the disc stands upright from y = -110 to -50, its rim 250 mm above the axis of A: at z = -300.
  EXPECT_EQ(machine->move(positions({0, 200, 0, 0, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_EQ(machine->move(positions({0, 200, 0, 90, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_EQ(machine->move(positions({0, 0, -150, 90, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_EQ(machine->move(positions({0, 0, 0, 90, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_EQ(machine->move(positions({0, -80, -99, 90, 0}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  EXPECT_EQ(machine->move(positions({0, -80, -150, 90, 0}), Feed::rapidTraverse()).end, MoveEnd::ProbeSignal);
}

TEST(TableBody, LetsAPartStandInIt) {
  const auto machine =
      world("mill3", "[part]\npose = { z = -660 }\n[[part.feature]]\nshape = \"box\"\nsize = [50, 50, 60]\n");
  ASSERT_TRUE(machine);
  EXPECT_EQ(machine->move(positions({0, 0, -380}), Feed::rapidTraverse()).end, MoveEnd::Reached);
  const auto touch = machine->measure({positions({0, 0, -420}), Feed::at(300)});
  EXPECT_EQ(touch.end, machine::MeasureEnd::Touched);
  EXPECT_NEAR(touch.latched[2], -400, 1e-6) << "the top of the part, 60 mm above z = -660";
}

TEST(TableBody, OfALatheIsTheChuck) {
  const auto body = machine::readTableBody("lathe2c");
  ASSERT_TRUE(body && *body);
  EXPECT_EQ((*body)->name, "chuck");
  EXPECT_EQ((*body)->normal, Vector3::UnitZ());
}

TEST(TableBody, IsReadFromAMachineFile) {
  const std::string file =
      "name = \"m\"\n[[axis]]\nname = \"Z\"\nkind = \"linear\"\nminimum = -1\nmaximum = 0\n"
      "[[spindle_chain]]\naxis = \"Z\"\ndirection = [0, 0, 1]\n";
  const auto mistakes = [&](const std::string& table) {
    Diagnostics diagnostics;
    const auto machine = machine::parseMachine(file + table, "m.toml", diagnostics);
    EXPECT_EQ(machine.has_value(), diagnostics.empty());
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics)
      text += format(diagnostic);
    return text;
  };
  EXPECT_EQ(mistakes("[table]\ncentre = [0, 0, -5]\nsize = [10, 20]\n"), "");
  EXPECT_EQ(mistakes("[table]\ncentre = [0, 0, -5]\ndiameter = 20\nthickness = 3\nnormal = [0, 2, 0]\n"), "");
  EXPECT_THAT(mistakes("[table]\ndiameter = 20\n"), HasSubstr("centre"));
  EXPECT_THAT(mistakes("[table]\ncentre = [0, 0, 0]\n"), HasSubstr("a size or a diameter"));
  EXPECT_THAT(mistakes("[table]\ncentre = [0, 0, 0]\ndiameter = 20\nsize = [1, 1]\n"),
              HasSubstr("a size or a diameter"));
  EXPECT_THAT(mistakes("[table]\ncentre = [0, 0, 0]\nsize = [1, 0]\n"), HasSubstr("above 0"));
  EXPECT_THAT(mistakes("[table]\ncentre = [0, 0, 0]\ndiameter = 20\nnormal = [0, 0, 0]\n"), HasSubstr("direction"));
  EXPECT_THAT(mistakes("[table]\ncentre = [0, 0, 0]\nradius = 20\n"), HasSubstr("radius"));
}

}  // namespace
}  // namespace probewright::setup
