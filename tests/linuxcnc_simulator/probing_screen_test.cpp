#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "linuxcnc_simulator/example_mill.hpp"

/// LinuxCNC's own probing screens practise on the simulator: what QtVCP's probing pages (of QtDragon and others) do
/// when a button is pressed, in the program that they start for it.
namespace probewright::testing {
namespace {

TEST(ProbingScreens, OfQtVcpFindTheBoreThatTheSimulatorFeels) {
  ExampleMill mill;
  if (!mill.feels()) GTEST_SKIP() << ExampleMill::unfelt;
  mill.copyAll();
  mill.leaveInterpreterOut();
  // The ball begins 12 mm above its height in the bore, near its middle.
  const std::string output = mill.run(R"(
import json, os, subprocess
desk.ready()
desk.mdi('T1 M6 G43')
desk.mdi('G10 L2 P1 X0 Y0 Z-250 R0')
desk.mdi('G53 G0 X0 Y0')
desk.mdi('G53 G0 Z-145')
desk.mode(linuxcnc.MODE_MDI)
settings = {'probe_diam': '6', 'latch_return_dist': '1', 'max_travel': '12', 'search_vel': '300', 'probe_vel': '60',
            'rapid_vel': '3000', 'side_edge_length': '12', 'xy_clearance': '4', 'z_clearance': '12', 'extra_depth': '0',
            'allow_auto_zero': '0', 'allow_auto_skew': '0'}
found = subprocess.run(['/usr/bin/python3', '/usr/lib/python3/dist-packages/qtvcp/widgets/probe_subprog.py'], text=True,
                       input='probe_xy_hole$' + json.dumps(settings) + '\n', capture_output=True,
                       env=dict(os.environ, QT_QPA_PLATFORM='offscreen')).stdout
with open('found', 'w') as file: file.write(next((line for line in found.split('\n') if line.startswith('COMPLETE$')), found))
)");
  const std::string found = contents(mill.session.outside() / "found");
  ASSERT_TRUE(found.starts_with("COMPLETE$")) << found << output;
  const auto told = nlohmann::json::parse(found.substr(found.find('$') + 1));
  const auto value = [&](const char* name) { return std::stod(told.at(name).get<std::string>()); };
  constexpr double period = 0.001, bound = 60.0 / 60 * period + 1e-3;  // mm: they tell 0.001 mm
  EXPECT_NEAR(value("xc"), 1.7, bound) << found;
  EXPECT_NEAR(value("yc"), -0.9, bound);
  // Across the middle that it has just found; both touches come too late by the pretravel.
  EXPECT_NEAR(value("ly"), 30.01 + 2 * 0.004, 2 * bound);
}

}  // namespace
}  // namespace probewright::testing
