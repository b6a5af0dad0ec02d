#pragma once

#include "session/control_family.hpp"

namespace probewright::session {

/// The SINUMERIK controls.
ControlFamily sinumerikFamily();

}  // namespace probewright::session
