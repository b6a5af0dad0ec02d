#pragma once

#include <array>
#include <vector>

#include "simulation/cad_face.hpp"

namespace probewright::simulation {

/// A grid of triangles over the parameters of a face, for faces that the mesher cannot do: true to the surface, but
/// reaching over the border of the face by up to a cell. No part of the face is left out, however slim it is.
class FaceGrid {
public:
  /// Halves cells along u or v until the surface leaves them by at most `deflection`, or there are 10,000 of them.
  FaceGrid(const CadFace& face, double deflection);

  using Parameters = std::array<Vector2, 3>;
  /// Two triangles for each cell that has a part of the face, in the sense of the surface's own normal.
  const std::vector<Parameters>& triangles() const { return triangles_; }
  /// mm: how far the surface leaves the cells.
  double deviation() const;
  /// mm: the diagonal of the largest cell.
  double largestCell() const;

private:
  Vector2 parameters(double i, double j) const;
  Vector3 at(double i, double j) const;
  enum class Along { U, V };
  double deviationAlong(Along along) const;
  void refine(double deflection);

  const CadFace& face_;
  Vector2 low_ = Vector2::Zero();
  Vector2 high_ = Vector2::Zero();
  int columns_ = 16;
  int rows_ = 16;
  std::vector<Parameters> triangles_;
};

}  // namespace probewright::simulation
