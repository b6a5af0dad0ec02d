#include <fmt/format.h>

#include <algorithm>

#include "simulation/cad_solid.hpp"
#include "simulation/mesh_solid.hpp"
#include "simulation/setup.hpp"
#include "simulation/virtual_machine.hpp"

namespace probewright::simulation {

namespace {

Result<std::unique_ptr<Solid>> load(const SolidSource& source, const ImportOptions& import) {
  if (source.file.empty()) return buildSolid(source.recipe);
  std::string ending = source.file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(source.file, ignored)) {
    return fail(source.place, fmt::format("there is no file \"{}\"", source.file.string()),
                "Name the part's file relative to this file");
  }
  const bool isStep = ending == ".step" || ending == ".stp", isIges = ending == ".iges" || ending == ".igs";
  auto solid = isStep ? readStep(source.file, import) : isIges ? readIges(source.file, import) : readStl(source.file);
  if (!solid && solid.error().place.file.empty()) solid.error().place = source.place;
  return solid;
}

}  // namespace

Result<std::unique_ptr<VirtualMachine>> buildMachine(const Setup& setup, const ImportOptions& import) {
  Truth truth = setup.truth;
  for (const SetupSolid& entry : setup.solids) {
    auto solid = load(entry.source, import);
    if (!solid) return tl::unexpected(std::move(solid.error()));
    truth.solids.push_back({std::move(*solid), entry.tableFromSolid, entry.name, entry.role});
  }
  auto machine = std::make_unique<VirtualMachine>(std::move(truth));
  for (const BelievedTool& tool : setup.tools) {
    if (!tool.inSpindle) continue;
    const machine::MoveResult result = machine->insertTool({tool.number, {}});
    if (result.end != machine::MoveEnd::Reached) {
      return fail({setup.file}, fmt::format("the machine cannot start like this: {}", result.detail),
                  "Move the part or give another start position under [machine.start]");
    }
  }
  return machine;
}

}  // namespace probewright::simulation
