#pragma once

#include "conversion/measuring_task.hpp"
#include "conversion/output.hpp"

namespace probewright::conversion {

/// Notes, once a program, that the touch probe cycle and the SINUMERIK cycle for this task touch the feature at other
/// places, where they do.
void noteTouchPlaces(Output& out, const language::Block& block, const MeasuringTask& task);

}  // namespace probewright::conversion
