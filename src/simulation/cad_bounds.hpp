#pragma once

#include "simulation/cad_model.hpp"

namespace probewright::simulation {

/// A box about the shape of a model that has its elements, to within its deflection.
Bounds boundsOf(const CadModel& model);

}  // namespace probewright::simulation
