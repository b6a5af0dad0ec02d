#pragma once

#include <vector>

namespace probewright::cycles::sinumerik {

/// The numbers of all alarms and messages that the measuring cycles raise, ascending. Their texts: alarmText() and
/// alarmAdvice() in context.hpp.
std::vector<int> alarmNumbers();

}  // namespace probewright::cycles::sinumerik
