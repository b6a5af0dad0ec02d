#pragma once

#include <vector>

#include "geometry/primitives.hpp"

/// The effective ball radius by probing direction, as a 3-D calibration finds it.
namespace probewright::probing {

/// What is to be added to the effective ball radius for touches in a direction. Known on rings of equal polar angle;
/// between two rings it changes linearly with the polar angle, along a ring it is the trigonometric polynomial through
/// its points, which follows up to (n - 1) / 2 lobes exactly.
class DirectionalRadius {
public:
  struct Ring {
    double polar = 0;                ///< degrees between the probing direction and the direction of the stylus: 0 .. 90
    double azimuth = 0;              ///< degrees, of the first point, from the main towards the minor axis
    std::vector<double> deviations;  ///< mm, at equal steps of the azimuth; one for all directions at the pole
  };

  DirectionalRadius() = default;
  /// `rings` by growing polar angle; empty ones are left out.
  explicit DirectionalRadius(std::vector<Ring> rings);

  const std::vector<Ring>& rings() const { return rings_; }

  /// For touches along `direction` (main, minor, tool axis of the probe turned to its calibration angle; the tool axis
  /// points from the tip to the holder), mm. Directions away from the tip count as across it; beyond the outermost ring
  /// its values hold. 0 without rings or direction.
  double at(const Vector3& direction) const;

private:
  std::vector<Ring> rings_;
};

}  // namespace probewright::probing
