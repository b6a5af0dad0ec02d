#pragma once

#include <span>

#include "machine/machine.hpp"
#include "simulation/contact_search.hpp"

/// Ways on which nothing is touched for certain, found with a few queries: an arc in a bore is hundreds of pieces.
namespace probewright::simulation {

/// True if no part of the tool comes nearer than `margin` to anything on a motion that is straight on the table.
bool isClear(const Motion& straight, double margin, const ToolShape& shape, const Surroundings& surroundings);

/// How many of the pieces of `path`, from the first, the tool takes without touching anything, as far as a few long
/// chords tell that pass the pieces by less than what is free about them; 0 where they do not tell. `from`: where the
/// axes and their slides stand.
std::size_t clearPieces(const TrueKinematics& kinematics, const machine::AxisPositions& from,
                        std::span<const machine::PathPiece> path, const ToolShape& shape,
                        const Surroundings& surroundings);

}  // namespace probewright::simulation
