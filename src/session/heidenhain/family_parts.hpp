#pragma once

#include "session/heidenhain/family.hpp"

/// The parts of the family's entry that are more than a line.
namespace probewright::session {

Diagnostics checkHeidenhain(const CheckRequest& request);
RunOn prepareHeidenhain(const RunRequest& request, Diagnostics& diagnostics);

}  // namespace probewright::session
