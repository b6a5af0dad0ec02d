#pragma once

#include <string>
#include <vector>

#include "control/sinumerik/data_store.hpp"
#include "machine/own_control.hpp"

/// Settable frames and tools of a SINUMERIK control, and the tables of the machine's own control: $P_UIFR[n] is its
/// n-th zero offset, tools are the same by their T number, with D1.
///
/// What the machine's own control has set goes before what the data say. Of a frame it is the translation (coarse and
/// fine) and the rotation about Z; a frame that turns about X or Y, scales or mirrors is the data's alone. Of a tool it
/// is the length and the radius, wear and base included; a touch probe keeps its radius, tools of lathes are the data's
/// alone.
namespace probewright::session::sinumerik {

/// As for HEIDENHAIN controls (session/heidenhain/own_tables.hpp).
std::vector<std::string> takeOver(control::sinumerik::DataStore& store, const machine::OwnTables& own,
                                  const machine::MachineDescription& machine);
machine::OwnTables differing(const control::sinumerik::DataStore& store, const machine::OwnTables& own,
                             const machine::MachineDescription& machine);

}  // namespace probewright::session::sinumerik
