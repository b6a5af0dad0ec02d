#pragma once

#include "cycles/catalogue.hpp"

namespace probewright::session {

/// What a call of a cycle has for a parameter before somebody fills it in: the default; where there is none the first
/// choice, or the number nearest to 0 that may stand there.
double firstValue(const cycles::Parameter& parameter);

}  // namespace probewright::session
