#include "simulation/cad_deviation.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace probewright::simulation {
namespace {

/// How far a free-form face leaves one of its triangles at most: what it does at points of a grid, and what it can do
/// between them by the bounds of its second derivatives.
class LargestDeviation {
public:
  LargestDeviation(const FreeformSurface& surface, const CadElement& element) : surface_(surface), element_(element) {
    const auto& [a, b, c] = element.parameters;
    toShares_ << b - a, c - a;
    isFlat_ = !(std::abs(toShares_.determinant()) > 0);
    if (!isFlat_) toShares_ = toShares_.inverse().eval();
  }

  /// `sampled`, if that suffices. No more is known of triangles without extent, and of those that reach beyond a
  /// spline.
  double find(double sampled, double apart, double most) const {
    const auto& [a, b, c] = element_.parameters;
    if (!isKnown()) return sampled;
    if (!hasKink()) return ofPiece(a, b, c, sampled, apart, most);
    double found = sampled;
    for (const Polygon& piece : withoutKinks({a, b, c})) {
      for (std::size_t i = 2; i < piece.size(); ++i)
        found = std::max(found, ofPiece(piece[0], piece[i - 1], piece[i], sampled, kUnknown, most));
    }
    return found;
  }

  bool isCertain(double distance, double apart) const {
    const auto& [a, b, c] = element_.parameters;
    return !isKnown() || (!hasKink() && apart + bendOf(a, b, c, distance - apart) <= distance);
  }

private:
  static constexpr double kUnknown = 1e300;

  Vector2 low() const {
    return element_.parameters[0].cwiseMin(element_.parameters[1]).cwiseMin(element_.parameters[2]);
  }
  Vector2 high() const {
    return element_.parameters[0].cwiseMax(element_.parameters[1]).cwiseMax(element_.parameters[2]);
  }
  bool isKnown() const { return !isFlat_ && surface_.covers(low(), high()); }
  bool hasKink() const {
    return surface_.kinkAcrossU(low().x(), high().x()) || surface_.kinkAcrossV(low().y(), high().y());
  }
  using Polygon = std::vector<Vector2>;

  /// The pieces on both sides of each kink.
  std::vector<Polygon> withoutKinks(const Polygon& whole) const {
    std::vector<Polygon> pieces{whole};
    for (std::size_t i = 0; i < pieces.size();) {
      if (pieces[i].empty()) {
        ++i;
        continue;
      }
      Vector2 low = pieces[i][0], high = low;
      for (const Vector2& p : pieces[i])
        low = low.cwiseMin(p), high = high.cwiseMax(p);
      if (const auto u = surface_.kinkAcrossU(low.x(), high.x())) {
        pieces.push_back(side(pieces[i], 0, *u, -1));
        pieces[i] = side(pieces[i], 0, *u, 1);
      } else if (const auto v = surface_.kinkAcrossV(low.y(), high.y())) {
        pieces.push_back(side(pieces[i], 1, *v, -1));
        pieces[i] = side(pieces[i], 1, *v, 1);
      } else {
        ++i;
      }
    }
    return pieces;
  }

  /// What of a convex polygon lies on one side of where a parameter has a value.
  static Polygon side(const Polygon& polygon, Eigen::Index k, double at, double sign) {
    Polygon part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vector2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const double from = sign * (p[k] - at), to = sign * (q[k] - at);
      if (from >= 0) part.push_back(p);
      if ((from > 0 && to < 0) || (from < 0 && to > 0)) {
        part.emplace_back(p + from / (from - to) * (q - p));
        part.back()[k] = at;
      }
    }
    return part;
  }

  double at(const Vector2& uv) const {
    const Vector2 share = toShares_ * (uv - element_.parameters[0]);
    const auto& [a, b, c] = element_.corners;
    return (surface_.pointAt(uv) - (a + share.x() * (b - a) + share.y() * (c - a))).norm();
  }

  /// How far the surface leaves a triangle between three of its points at most; found more exactly if that is not
  /// enough.
  double bendOf(const Vector2& p, const Vector2& q, const Vector2& r, double enough) const {
    const Vector2 low = p.cwiseMin(q).cwiseMin(r), high = p.cwiseMax(q).cwiseMax(r);
    SurfaceBends bends = surface_.bends(low, high);
    const double bend = bends.fromTriangle(p, q, r);
    if (bend <= enough) return bend;
    bends.narrow(surface_.at((low + high) / 2), (high - low) / 2);
    return bends.fromTriangle(p, q, r);
  }

  double ofPiece(const Vector2& p, const Vector2& q, const Vector2& r, double sampled, double apart,
                 double most) const {
    const double bend = bendOf(p, q, r, sampled - apart);
    return apart + bend <= sampled ? sampled : onGrid(p, q, r, bend, sampled, most);
  }

  /// The points of the grid are so near to each other that between them little more can be than at them.
  double onGrid(const Vector2& p, const Vector2& q, const Vector2& r, double bend, double sampled, double most) const {
    const auto& [a, b, c] = element_.corners;
    constexpr double kShare = 0.3, kFine = 1e-3;  // of the longest side
    const double fine = kFine * std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const double enough = std::max(kShare * sampled, fine);
    const double order = std::clamp(std::ceil(std::sqrt(bend / enough)), 1.0, most);
    double found = 0;
    for (double i = 0; i <= order; ++i) {
      for (double j = 0; i + j <= order; ++j)
        found = std::max(found, at(p + (i * (q - p) + j * (r - p)) / order));
    }
    return std::max(sampled, found + bend / (order * order));
  }

  const FreeformSurface& surface_;
  const CadElement& element_;
  Eigen::Matrix2d toShares_;
  bool isFlat_ = false;
};

}  // namespace

double cornersApart(const CadElement& element, const CadFace& face) {
  double apart = 0;
  for (std::size_t k = 0; k < 3; ++k)
    apart = std::max(apart, ((**face.freeform).pointAt(element.parameters[k]) - element.corners[k]).norm());
  return apart;
}

bool isCertain(const CadElement& element, const CadFace& face, double distance, double apart) {
  return LargestDeviation(**face.freeform, element).isCertain(distance, apart);
}

double certainDeviation(const CadElement& element, const CadFace& face, double sampled, double apart, double most) {
  return LargestDeviation(**face.freeform, element).find(sampled, apart, most);
}

}  // namespace probewright::simulation
