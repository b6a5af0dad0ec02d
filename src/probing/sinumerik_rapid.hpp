#pragma once

#include "control/channel.hpp"

namespace probewright::probing {

/// Rapid traverse on the straight way from where the tip is to `target`, reduced to a percentage of it: SD 55632. 0,
/// and 100 or more, do not reduce it.
machine::Feed reducedRapid(const control::Channel& channel, const ProgramPlace& target, double percent);

}  // namespace probewright::probing
