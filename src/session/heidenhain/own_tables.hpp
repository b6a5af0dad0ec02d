#pragma once

#include <string>
#include <vector>

#include "control/heidenhain/control.hpp"
#include "machine/own_control.hpp"

/// Preset table and tool table of a HEIDENHAIN control, and the tables of the machine's own control: row n of the
/// preset table is its n-th zero offset, tools are the same by their number.
///
/// What the machine's own control has set goes before what the tables say. Of a preset it is X, Y, Z, the basic
/// rotation and the offsets of rotary axes; a preset that is turned about X or Y is the tables' alone. Of a tool it is
/// the length (L and DL) and the radius (R and DR); a touch probe keeps its calibrated radius.
namespace probewright::session::heidenhain {

/// Changes the tables to what `own` has set. Of each row that was something else: what the operator should know.
std::vector<std::string> takeOver(control::heidenhain::Tables& tables, const machine::OwnTables& own,
                                  const machine::MachineDescription& machine);

/// The rows and tools of `tables` that are something else in `own`.
machine::OwnTables differing(const control::heidenhain::Tables& tables, const machine::OwnTables& own,
                             const machine::MachineDescription& machine);

}  // namespace probewright::session::heidenhain
