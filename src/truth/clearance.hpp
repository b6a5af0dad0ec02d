#pragma once

#include <vector>

#include "records/truth.hpp"
#include "session/run.hpp"
#include "simulation/virtual_machine.hpp"

/// How near the machine came to things, and to the ends of its axes.
namespace probewright::truth {

/// The least distance of the tool from what lies on the table, move by move: the tool is made thicker by it, until it
/// touches on the way.
///
/// Distances are true to 0.05 mm for balls and capsules. Cylinders with flat ends grow into longer and wider cylinders:
/// what stands off their rim may be up to 1.4 times as far away as is told, never less. Of measuring moves and
/// retractions what is meant to touch does not count: ball and stylus, the edges of a cutter. Moves that come no nearer
/// than 20 mm are told as one. `limit`: 0 for none.
records::Clearance clearanceOf(const session::RunOutcome& outcome, const simulation::VirtualMachine& machine,
                               double limit);

/// Of each axis with end stops, how near it came to one.
std::vector<records::TravelMargin> travelMargins(const simulation::VirtualMachine& machine);

/// Of each block each axis that came nearer than `limit` (mm, degrees) to an end of its travel, in the order of the
/// run. Tool changes do not count: the machine goes there by itself.
std::vector<records::TravelMargin> nearEnds(const session::RunOutcome& outcome,
                                            const simulation::VirtualMachine& machine, double limit);

}  // namespace probewright::truth
