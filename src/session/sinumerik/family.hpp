#pragma once

#include "session/control_family.hpp"

namespace probewright::session::sinumerik {

/// The SINUMERIK controls.
ControlFamily sinumerikFamily();

}  // namespace probewright::session::sinumerik
