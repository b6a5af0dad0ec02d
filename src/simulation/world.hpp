#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "geometry/primitives.hpp"
#include "machine/table_body.hpp"
#include "simulation/import_options.hpp"
#include "simulation/solid_recipe.hpp"
#include "simulation/truth.hpp"

/// A virtual world before it is built: what is true, and the files that hold its shapes. No control ever sees it.
namespace probewright::simulation {

class VirtualMachine;

/// Where the shape of a part or fixture comes from: a file, or features if there is none.
struct SolidSource {
  std::filesystem::path file;  ///< STEP, IGES or STL by its ending
  SolidRecipe recipe;
  SourcePlace place;  ///< of the key that names the file
};

/// A solid that is still to be loaded, and where it truly lies.
struct WorldSolid {
  std::string name;
  SolidRole role = SolidRole::Part;
  SolidSource source;
  Pose tableFromSolid = Pose::Identity();
};

/// A body of the machine that is still to be loaded.
struct WorldBody {
  std::string name;
  machine::Link link;
  SolidSource source;
  Pose linkFromSolid = Pose::Identity();
};

struct World {
  std::string file;  ///< that describes it, for messages
  /// Machine, errors, true tools, start, seed. The solids are added by buildMachine().
  Truth truth;
  std::vector<WorldSolid> solids;
  std::vector<WorldBody> bodies;
  std::optional<machine::TableBody> table;  ///< of the machine
  std::optional<int> toolInSpindle;         ///< at the start
  double clearance = 0;                     ///< mm: coming nearer to things is warned of; 0: never
};

/// Loads the solids and puts the machine together. `tellTouches`: as VirtualMachine::tellTouches(), from the first tool
/// on.
Result<std::unique_ptr<VirtualMachine>> buildMachine(const World& world, const ImportOptions& import = {},
                                                     bool tellTouches = true);

}  // namespace probewright::simulation
