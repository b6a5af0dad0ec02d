#pragma once

#include <cstdint>
#include <set>

#include "conversion/flow_graph.hpp"
#include "conversion/job.hpp"
#include "language/program.hpp"

/// Positions of rotary axes that the two controls may reach the other way round. A HEIDENHAIN control counts on from
/// where the axis stands; a SINUMERIK counts an axis that turns endlessly within the turn that it stands in.
namespace probewright::conversion {

inline constexpr const char* fromBeyondATurn =
    "a rotary axis that turns endlessly may turn the other way round to this position: after one below 0, beyond 360 "
    "degrees or turned to by an increment a HEIDENHAIN control counts on, a SINUMERIK counts within the turn";

/// The offsets of blocks that give an absolute position to a rotary axis which, on one of the ways to the block at
/// least, may stand below 0 or beyond 360 degrees.
std::set<std::uint64_t> positionsFromBeyondATurn(language::Program& program, const FlowGraph& graph, const Job& job);

}  // namespace probewright::conversion
