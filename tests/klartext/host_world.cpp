#include "klartext/host_world.hpp"

#include <gtest/gtest.h>

#include "control/heidenhain/preset_table.hpp"
#include "control/heidenhain/probe_table.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "machine/machine_file.hpp"

namespace probewright::language::klartext::testing {

namespace hh = control::heidenhain;

Result<std::shared_ptr<Program>> MemoryLibrary::open(std::string_view name, const Program*) {
  const auto found = texts.find(std::string(name));
  if (found == texts.end()) return fail("there is no program " + std::string(name));
  return std::make_shared<KlartextProgram>(found->first, found->second);
}

namespace {

machine::MachineDescription readyMade(const std::string& machineName) {
  auto description = machine::readMachine(machineName);
  EXPECT_TRUE(description) << format(description.error());
  return std::move(*description);
}

}  // namespace

World::World(const std::string& machineName, control::ControlKind kind) : World(readyMade(machineName), kind) {}

World::World(machine::MachineDescription description, control::ControlKind kind) {
  machine = std::make_unique<TraceMachine>(std::move(description));
  hh::Tables tables{
      hh::defaultToolTable(kind), hh::defaultProbeTable(kind), hh::defaultPresetTable(kind), {}, {}, {}, {}};
  const auto tool = [&](const std::string& row, const std::string& name, double length, double radius) {
    EXPECT_TRUE(tables.tools.ensureRow(row));
    EXPECT_TRUE(tables.tools.setText(row, "NAME", name));
    EXPECT_TRUE(tables.tools.setNumber(row, "L", length));
    EXPECT_TRUE(tables.tools.setNumber(row, "R", radius));
  };
  tool("1", "PROBE", 100, 2);
  tool("5", "MILL", 50, 5);
  if (tables.tools.hasColumn("TP_NO")) {
    EXPECT_TRUE(tables.tools.setText("1", "TP_NO", "1"));
  }
  control = std::make_unique<hh::Control>(kind, *machine, std::move(tables));
  control->applyCoordinates();
  options.readFile = [this](const std::string& name) -> Result<std::string> {
    const auto found = files.find(name);
    if (found == files.end()) return fail("the file " + name + " does not exist");
    return found->second;
  };
}

RunResult World::run(const std::string& text) {
  KlartextHost host(*control, options);
  Interpreter interpreter(library, host);
  return interpreter.run(std::make_shared<KlartextProgram>("main.h", text));
}

std::vector<std::string> World::told(control::EventKind kind) const {
  std::vector<std::string> texts;
  for (const control::EventRecord& event : control->journal.events) {
    if (event.kind == kind) texts.push_back(event.text);
  }
  return texts;
}

std::vector<Vector3> World::path() const {
  std::vector<Vector3> points;
  for (const TraceMachine::Step& step : machine->steps) {
    const Vector3 nose(step.axes[0], step.axes[1], step.axes[2]);
    points.push_back(nose - control->channel.toolVector);
  }
  return points;
}

}  // namespace probewright::language::klartext::testing
