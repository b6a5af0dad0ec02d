#pragma once

#include <map>
#include <set>
#include <string>

#include "base/diagnostic.hpp"
#include "control/beliefs.hpp"
#include "control/heidenhain/control.hpp"

/// The kinematics of a control before and after a run: KINEMATIC.TAB, DATA450.KD and *.KCO of the folder of tables.
namespace probewright::session::heidenhain {

/// The active kinematics: that of KINEMATIC.TAB if there is one, else what the beliefs say. Mistakes go to
/// `diagnostics`.
void readKinematics(control::heidenhain::Control& control, const control::Beliefs& beliefs, Diagnostics& diagnostics);

/// What the control leaves: the tables that it had, and those that cycles have made.
void writeKinematics(const control::heidenhain::Control& control, std::map<std::string, std::string>& files);

/// The names that writeKinematics() may use.
std::set<std::string> kinematicFileNames();

}  // namespace probewright::session::heidenhain
