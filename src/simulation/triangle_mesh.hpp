#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/diagnostic.hpp"
#include "geometry/primitives.hpp"
#include "simulation/import_watch.hpp"

namespace probewright::simulation {

/// Triangles over shared corners, counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Vector3> corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// An STL file, ASCII or binary, coordinates in mm. Corners with the same coordinates are one corner; triangles without
/// area are left out. Refused: files that are neither kind, cut short, without triangles, or with numbers that are
/// none. Throws ImportStopped if the watch does.
Result<TriangleMesh> readStlMesh(const std::filesystem::path& path, ImportWatch& watch);

}  // namespace probewright::simulation
