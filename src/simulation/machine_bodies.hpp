#pragma once

#include <vector>

#include "base/diagnostic.hpp"
#include "simulation/machine_body.hpp"
#include "simulation/world.hpp"

namespace probewright::simulation {

/// Loads the shape of a part, a fixture or a body.
Result<std::unique_ptr<Solid>> loadSolid(const SolidSource& source, const ImportOptions& import);

/// The bodies of a machine, ready to be put into Truth. One that is boxes and cylinders alone becomes a body each, in
/// analytic form: the same surface, at once.
Result<std::vector<MachineBody>> loadBodies(const std::vector<WorldBody>& bodies, const ImportOptions& import = {});

/// The machine's table as a solid on it.
PlacedSolid solidOf(const machine::TableBody& table);

}  // namespace probewright::simulation
