#include <gtest/gtest.h>

#include "control/alarm.hpp"
#include "control/heidenhain/preset_table.hpp"
#include "control/heidenhain/probe_table.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "cycles/heidenhain/context.hpp"
#include "support/virtual_world.hpp"

namespace probewright {
namespace {
using namespace testing_support;
namespace hh = control::heidenhain;

TEST(Smoke, Cycle421) {
  auto truth = perfectWorld();
  place(truth, simulation::Ring(20, 200, -40), translation({30.25, -12.5, -300}));
  simulation::VirtualMachine machine(truth);
  hh::Tables tables{hh::defaultToolTable(control::ControlKind::TNC640),
                    hh::defaultProbeTable(control::ControlKind::TNC640),
                    hh::defaultPresetTable(control::ControlKind::TNC640),
                    {}};
  ASSERT_TRUE(tables.tools.ensureRow("1"));
  ASSERT_TRUE(tables.tools.setNumber("1", "L", 100));
  ASSERT_TRUE(tables.tools.setNumber("1", "R", 2));
  ASSERT_TRUE(tables.tools.setText("1", "TP_NO", "1"));
  ASSERT_TRUE(tables.presets.setNumber("1", "X", 30));
  ASSERT_TRUE(tables.presets.setNumber("1", "Y", -12));
  ASSERT_TRUE(tables.presets.setNumber("1", "Z", -300));
  hh::Control control(control::ControlKind::TNC640, machine, tables);
  control.activatePreset(1);
  control.callTool("1", 'Z', 0, 0, 0);
  control.applyCoordinates();
  const auto* entry = cycles::heidenhain::findEntry(412);
  cycles::Arguments arguments(*entry->definition);
  for (auto [q, v] : std::initializer_list<std::pair<unsigned, double>>{{321, 0},
                                                                        {322, 0},
                                                                        {262, 39},
                                                                        {325, 0},
                                                                        {247, 90},
                                                                        {261, -10},
                                                                        {320, 0},
                                                                        {260, 20},
                                                                        {301, 0},
                                                                        {305, 1},
                                                                        {331, 0},
                                                                        {332, 0},
                                                                        {303, 1}})
    arguments.set(q, v);
  try {
    cycles::heidenhain::runCycle(control, *entry, arguments, {});
  } catch (const control::Alarm& a) {
    FAIL() << a.what();
  }
  EXPECT_NEAR(control.coordinates.preset.origin.x(), 30.25, 1e-9);
  EXPECT_NEAR(control.coordinates.preset.origin.y(), -12.5, 1e-9);
  EXPECT_NEAR(control.q.q(153), 40, 1e-9);
  for (auto& w : control.journal.cycles[0].writes)
    std::puts((w.table + " " + w.entry + " " + w.before + "->" + w.after).c_str());
}
}  // namespace
}  // namespace probewright
