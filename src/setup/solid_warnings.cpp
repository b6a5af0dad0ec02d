#include "setup/solid_warnings.hpp"

#include <fmt/format.h>

#include "simulation/cad_solid.hpp"
#include "simulation/mesh_solid.hpp"

namespace probewright::setup {

namespace {

void warnOf(const simulation::Solid& solid, const std::string& name, const std::string& file,
            Diagnostics& diagnostics) {
  if (const auto* cad = dynamic_cast<const simulation::CadSolid*>(&solid)) {
    diagnostics.insert(diagnostics.end(), cad->remarks().begin(), cad->remarks().end());
    return;
  }
  const auto* mesh = dynamic_cast<const simulation::MeshSolid*>(&solid);
  if (mesh == nullptr || mesh->isClosed()) return;
  diagnostics.push_back({Severity::Warning,
                         {file, 0, 0},
                         fmt::format("the surface of \"{}\" is not closed: triangles are missing", name),
                         {},
                         "the probe meets only the triangles there are; export the part again as one solid body",
                         {}});
}

}  // namespace

void warnOfSolids(const simulation::Truth& truth, const std::string& file, Diagnostics& diagnostics) {
  for (const simulation::PlacedSolid& placed : truth.solids)
    warnOf(*placed.solid, placed.name, file, diagnostics);
  for (const simulation::MachineBody& body : truth.bodies)
    warnOf(*body.solid, body.name, file, diagnostics);
}

void warnOfBodies(const simulation::VirtualMachine& machine, const std::string& file, Diagnostics& diagnostics) {
  const auto contact = machine.bodyContact();
  if (!contact) return;
  diagnostics.push_back({Severity::Warning,
                         {file, 0, 0},
                         fmt::format("where the machine starts {}", *contact),
                         {},
                         "they are left out until they have come apart: move the part, give another start position "
                         "under [machine.start], or keep bodies of links that are not neighbours apart",
                         {}});
}

}  // namespace probewright::setup
