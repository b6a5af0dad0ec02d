#include "simulation/triangle_region.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace probewright::simulation {

TriangleRegion::TriangleRegion(const CadElement& triangle, const TrimmedDomain& domain) {
  const std::array<Vector2, 3>& corners = triangle.parameters;
  const double area =
      (triangle.corners[1] - triangle.corners[0]).cross(triangle.corners[2] - triangle.corners[0]).norm();
  constexpr double kBeside = 1.5, kLeastShare = 0.25, kMostShare = 100, kShareOfNothing = 0.5;
  constexpr double kLeastHeight = 1e-7, kWithin = 1e-6;
  std::array<double, 3> shares{};  // of the height of the triangle, beyond each side
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector2 &from = corners[k], &to = corners[(k + 1) % 3], &opposite = corners[(k + 2) % 3];
    const double side = (triangle.corners[(k + 1) % 3] - triangle.corners[k]).norm();
    const double height = side > 0 ? area / side : 0;
    shares[k] = kWithin;
    if (height <= kLeastHeight) {
      shares[k] = kShareOfNothing;
    } else if (triangle.isBorder(k)) {
      shares[k] = std::clamp(kBeside * triangle.growth / height, kLeastShare, kMostShare);
    }
    Vector2 out(to.y() - from.y(), from.x() - to.x());
    if (out.dot(opposite - from) > 0) out = -out;
    sides_[k] = {out, out.dot(from) + shares[k] * out.dot(from - opposite)};
  }
  whole_ = {corners[0], corners[0]};
  for (std::size_t k = 0; k < 3; ++k) {
    // The corner where the sides before and behind it meet once they are moved.
    const double before = shares[(k + 2) % 3], behind = shares[k];
    const Vector2 corner =
        corners[k] + before * (corners[k] - corners[(k + 1) % 3]) + behind * (corners[k] - corners[(k + 2) % 3]);
    whole_ = {whole_.low.cwiseMin(corner), whole_.high.cwiseMax(corner)};
  }
  // Beyond the box about the borders a spline is nothing that anybody meant.
  if (domain.isEverywhere()) return;
  Vector2 low = domain.low(), high = domain.high();
  for (const Vector2& corner : corners)
    low = low.cwiseMin(corner), high = high.cwiseMax(corner);
  whole_ = {whole_.low.cwiseMax(low), whole_.high.cwiseMin(high)};
}

bool TriangleRegion::reaches(const ParameterBox& box) const {
  const Vector2 middle = box.middle(), half = box.half();
  return std::ranges::all_of(
      sides_, [&](const Side& side) { return side.out.dot(middle) - side.out.cwiseAbs().dot(half) <= side.height; });
}

}  // namespace probewright::simulation
