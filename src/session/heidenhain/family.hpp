#pragma once

#include "session/control_family.hpp"

namespace probewright::session {

/// The HEIDENHAIN controls.
ControlFamily heidenhainFamily();

}  // namespace probewright::session
