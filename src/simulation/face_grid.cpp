#include "simulation/face_grid.hpp"

namespace probewright::simulation {
namespace {

constexpr int kMostCells = 10'000;
constexpr int kMostCellsAcross = 400;
constexpr double kFarthest = 1e5;  // a surface without end is not followed further

}  // namespace

FaceGrid::FaceGrid(const CadFace& face, double deflection) : face_(face) {
  if (face.domain.isEverywhere()) {
    face.surface->Bounds(low_.x(), high_.x(), low_.y(), high_.y());
  } else {
    low_ = face.domain.low();
    high_ = face.domain.high();
  }
  low_ = low_.cwiseMax(-kFarthest);
  high_ = high_.cwiseMin(kFarthest);
  refine(deflection);
  for (int i = 0; i < columns_; ++i) {
    for (int j = 0; j < rows_; ++j) {
      if (!face.domain.reaches(parameters(i, j), parameters(i + 1, j + 1))) continue;
      triangles_.push_back({parameters(i, j), parameters(i + 1, j), parameters(i + 1, j + 1)});
      triangles_.push_back({parameters(i, j), parameters(i + 1, j + 1), parameters(i, j + 1)});
    }
  }
}

Vector2 FaceGrid::parameters(double i, double j) const {
  return low_ + (high_ - low_).cwiseProduct(Vector2(i / columns_, j / rows_));
}

Vector3 FaceGrid::at(double i, double j) const {
  const Vector2 uv = parameters(i, j);
  const gp_Pnt p = face_.surface->Value(uv.x(), uv.y());
  return {p.X(), p.Y(), p.Z()};
}

double FaceGrid::deviation() const { return std::max(deviationAlong(Along::U), deviationAlong(Along::V)); }

double FaceGrid::largestCell() const {
  double largest = 0;
  for (int i = 0; i < columns_; ++i) {
    for (int j = 0; j < rows_; ++j)
      largest = std::max(largest, (at(i + 1, j + 1) - at(i, j)).norm());
  }
  return largest;
}

/// How far the surface leaves the middle of the cells' sides along u, or v.
double FaceGrid::deviationAlong(Along along) const {
  const bool alongU = along == Along::U;
  double largest = 0;
  for (int i = 0; i < columns_; ++i) {
    for (int j = 0; j < rows_; ++j) {
      const Vector3 middle = alongU ? at(i + 0.5, j) : at(i, j + 0.5);
      const Vector3 chord = (at(i, j) + (alongU ? at(i + 1, j) : at(i, j + 1))) / 2;
      largest = std::max(largest, (middle - chord).norm());
    }
  }
  return largest;
}

void FaceGrid::refine(double deflection) {
  while (2 * columns_ * rows_ <= kMostCells) {
    const double alongU = deviationAlong(Along::U), alongV = deviationAlong(Along::V);
    const bool mayHalveU = alongU > deflection && 2 * columns_ <= kMostCellsAcross;
    const bool mayHalveV = alongV > deflection && 2 * rows_ <= kMostCellsAcross;
    if (mayHalveU && (!mayHalveV || alongU >= alongV || rows_ > columns_)) {
      columns_ *= 2;
    } else if (mayHalveV) {
      rows_ *= 2;
    } else {
      break;
    }
  }
}

}  // namespace probewright::simulation
