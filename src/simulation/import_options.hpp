#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>

#include "simulation/mesh_limits.hpp"

namespace probewright::simulation {

/// How the file of a part is imported.
struct ImportOptions {
  /// As CadOptions::deflection.
  double deflection = 0.01;
  /// The folder that keeps what was imported, for the next time; empty: none.
  std::filesystem::path cache;
  /// Asked to stop, the import ends at once with a mistake.
  std::stop_token stop;
  /// Told from time to time what is being done, once an import takes longer than `patience`.
  std::function<void(const std::string& what)> progress;
  double patience = 1;  ///< seconds

  double seconds = 1800;             ///< after which an import is given up
  int facePoints = kMostMeshPoints;  ///< after which a face is not meshed any further, but gets a grid
  double faceSeconds = 4;            ///< of the processor without a further point: the same, for the rare face
  std::uint64_t bytes = std::uint64_t{8} << 30U;  ///< of memory that an import may take
};

}  // namespace probewright::simulation
