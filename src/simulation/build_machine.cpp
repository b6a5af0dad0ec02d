#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "simulation/analytic_solids.hpp"
#include "simulation/cad_solid.hpp"
#include "simulation/machine_bodies.hpp"
#include "simulation/mesh_solid.hpp"
#include "simulation/virtual_machine.hpp"
#include "simulation/world.hpp"

namespace probewright::simulation {

Result<std::unique_ptr<Solid>> loadSolid(const SolidSource& source, const ImportOptions& import) {
  if (source.file.empty()) return buildSolid(source.recipe, {}, import.stop);
  const std::string ending = lowerCase(source.file.extension().string());
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(source.file, ignored)) {
    const bool isThere = std::filesystem::exists(source.file, ignored);
    const char* what = isThere ? "\"{}\" is a folder or a device, a file was expected" : "there is no file \"{}\"";
    return fail(source.place, fmt::format(fmt::runtime(what), source.file.string()),
                "Name the part's file relative to this file");
  }
  const bool isStep = ending == ".step" || ending == ".stp", isIges = ending == ".iges" || ending == ".igs";
  auto solid = isStep   ? readStep(source.file, import)
               : isIges ? readIges(source.file, import)
                        : readStl(source.file, import);
  if (!solid && solid.error().place.file.empty()) solid.error().place = source.place;
  return solid;
}

/// Added last and in analytic form: it stops what runs into it, and stays out of the pictures, which show the part.
PlacedSolid solidOf(const machine::TableBody& table) {
  std::shared_ptr<const Solid> solid;
  if (table.diameter > 0) {
    solid = std::make_shared<RoundBar>(table.diameter / 2, -table.thickness, 0);
  } else {
    const Vector3 half(table.size.x() / 2, table.size.y() / 2, 0);
    solid = std::make_shared<Box>(Vector3(-half.x(), -half.y(), -table.thickness), half);
  }
  Pose pose = translation(table.centre);
  pose.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), table.normal).toRotationMatrix();
  return {.solid = std::move(solid),
          .tableFromSolid = pose,
          .name = table.name,
          .role = SolidRole::Fixture,
          .ofMachine = true};
}

Result<std::unique_ptr<VirtualMachine>> buildMachine(const World& world, const ImportOptions& import,
                                                     bool tellTouches) {
  Truth truth = world.truth;
  for (const WorldSolid& entry : world.solids) {
    auto solid = loadSolid(entry.source, import);
    if (!solid) return tl::unexpected(std::move(solid.error()));
    truth.solids.push_back({std::move(*solid), entry.tableFromSolid, entry.name, entry.role});
  }
  if (world.table) truth.solids.push_back(solidOf(*world.table));
  auto bodies = loadBodies(world.bodies, import);
  if (!bodies) return tl::unexpected(std::move(bodies.error()));
  truth.bodies = *std::move(bodies);
  auto machine = std::make_unique<VirtualMachine>(std::move(truth));
  machine->tellTouches(tellTouches);
  if (world.toolInSpindle) {
    const machine::ToolChangeResult result = machine->insertTool({*world.toolInSpindle, {}});
    if (result.end != machine::ToolChangeEnd::Changed) {
      return fail({world.file}, fmt::format("the machine cannot start like this: {}", result.detail),
                  "Move the part or give another start position under [machine.start]");
    }
  }
  return machine;
}

}  // namespace probewright::simulation
