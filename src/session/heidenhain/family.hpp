#pragma once

#include "session/control_family.hpp"

namespace probewright::session::heidenhain {

/// The HEIDENHAIN controls.
ControlFamily heidenhainFamily();

}  // namespace probewright::session::heidenhain
