#pragma once

#include <optional>

#include "conversion/call.hpp"
#include "cycles/catalogue.hpp"

/// What the results of the catalogue mean to a conversion.
namespace probewright::conversion {

/// Nothing for what has no counterpart in the other vendor's cycles: results in machine coordinates, of one among
/// several features, positions along an axis that the call does not name.
std::optional<Meaning> meaningOf(const control::ResultKind& kind);

/// The results that have a meaning, by name. `units`: those of S_MVAR.
Results resultsOf(const cycles::CycleDefinition& cycle, int units = -1);

}  // namespace probewright::conversion
