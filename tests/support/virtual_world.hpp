#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "machine/machine_file.hpp"
#include "simulation/analytic_solids.hpp"
#include "simulation/virtual_machine.hpp"
#include "support/axis_positions.hpp"

/// Worlds in one line, for tests that need a machine with something on its table.
namespace probewright::testing_support {

/// A perfect probe, tool 1 "PROBE": length 100, ball radius 2, thin stylus of 60 mm, body of radius 20.
inline simulation::TrueTool idealProbe(double length = 100, double ballRadius = 2) {
  simulation::TrueTool tool;
  tool.number = 1;
  tool.name = "PROBE";
  tool.length = length;
  tool.probe.ballRadius = ballRadius;
  tool.probe.stylusRadius = ballRadius / 2;
  tool.probe.stylusLength = 60;
  tool.probe.bodyRadius = 20;
  tool.probe.bodyLength = 60;
  return tool;
}

/// A perfect machine of the ready-made kind with nothing on it but the ideal probe in its magazine.
inline simulation::Truth perfectWorld(const std::string& machineName = "mill3") {
  simulation::Truth truth;
  auto description = machine::readMachine(machineName);
  EXPECT_TRUE(description) << format(description.error());
  if (description) truth.machine = *description;
  truth.start = truth.machine.toolChange;
  truth.tools.push_back(idealProbe());
  return truth;
}

/// Lays `solid` on the table.
template <class SolidType>
void place(simulation::Truth& truth, SolidType solid, const Pose& tableFromSolid = Pose::Identity(),
           const std::string& name = "part", simulation::SolidRole role = simulation::SolidRole::Part) {
  truth.solids.push_back({std::make_shared<SolidType>(std::move(solid)), tableFromSolid, name, role});
}

/// A tool touch probe whose contact is `solid`.
template <class SolidType>
simulation::TrueToolProbe& placeToolProbe(simulation::Truth& truth, SolidType solid,
                                          const Pose& tableFromContact = Pose::Identity(),
                                          const std::string& name = "TT") {
  simulation::TrueToolProbe probe;
  probe.name = name;
  auto contact = std::make_shared<SolidType>(std::move(solid));
  probe.contact = contact;
  probe.cuboid = std::is_same_v<SolidType, simulation::Box>;
  probe.tableFromContact = tableFromContact;
  truth.solids.push_back({contact, tableFromContact, name, simulation::SolidRole::ToolProbe});
  truth.toolProbes.push_back(probe);
  return truth.toolProbes.back();
}

}  // namespace probewright::testing_support
