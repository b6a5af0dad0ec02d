#pragma once

#include "simulation/cad_model.hpp"
#include "simulation/touch_proof.hpp"

namespace probewright::simulation {

/// What the triangle stands for: itself, and what lies between its sides on the border and the border, where no
/// triangle is. That is no farther away than what it was grown by.
class TriangleRegion {
public:
  TriangleRegion(const CadElement& triangle, const TrimmedDomain& domain);

  /// The parameters about it.
  const ParameterBox& whole() const { return whole_; }
  /// True if some of it lies in a box.
  bool reaches(const ParameterBox& box) const;

private:
  /// A side of the triangle in the plane of parameters: out * p <= height on its inner side.
  struct Side {
    Vector2 out = Vector2::Zero();
    double height = 0;
  };

  std::array<Side, 3> sides_;
  ParameterBox whole_;
};

}  // namespace probewright::simulation
