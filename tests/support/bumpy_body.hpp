#pragma once

#include <cmath>
#include <numbers>

#include "simulation/mesh_solid.hpp"

namespace probewright::simulation {

/// How the radius of a body swings about its mean.
struct Bumps {
  double height = 0;  ///< share of the radius
  double alongPolar;  ///< swings in the angle from the pole
  double aroundAxis;  ///< swings around the axis
};

/// A bumpy closed body of the mean radius `size` (mm) with about 4 * rings * rings triangles.
inline TriangleMesh bumpyBody(std::uint32_t rings, double size, const Bumps& bumps) {
  TriangleMesh mesh;
  const std::uint32_t around = 2 * rings;
  const auto place = [&](double polar, double azimuth) {
    const double r =
        size * (1 + bumps.height * std::sin(bumps.alongPolar * polar) * std::cos(bumps.aroundAxis * azimuth));
    return Vector3(r * std::sin(polar) * std::cos(azimuth), r * std::sin(polar) * std::sin(azimuth),
                   r * std::cos(polar));
  };
  mesh.corners.push_back(place(0, 0));
  for (std::uint32_t i = 1; i < rings; ++i) {
    for (std::uint32_t j = 0; j < around; ++j) {
      mesh.corners.push_back(place(std::numbers::pi * i / rings, 2 * std::numbers::pi * j / around));
    }
  }
  mesh.corners.push_back(place(std::numbers::pi, 0));
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return 1 + (i - 1) * around + j % around; };
  const auto last = static_cast<std::uint32_t>(mesh.corners.size() - 1);
  for (std::uint32_t j = 0; j < around; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    mesh.triangles.push_back({last, at(rings - 1, j + 1), at(rings - 1, j)});
    for (std::uint32_t i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

}  // namespace probewright::simulation
