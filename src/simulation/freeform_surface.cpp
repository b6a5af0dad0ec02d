#include "simulation/freeform_surface.hpp"

#include <GeomConvert.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>
#include <vector>

#include "simulation/cad_vectors.hpp"
#include "simulation/freeform_curve.hpp"
#include "simulation/spline_net.hpp"

namespace probewright::simulation {
namespace {

class Spline : public FreeformSurface {
public:
  explicit Spline(SplineNet net) : net_(std::move(net)) {}
  SurfacePoint at(const Vector2& parameters) const override { return net_.at(parameters); }
  Vector3 pointAt(const Vector2& parameters) const override {
    const Eigen::Vector4d numerator = net_.weighted(parameters);
    return numerator.head<3>() / numerator.w();
  }
  SurfaceBends bends(const Vector2& low, const Vector2& high) const override { return net_.bends(low, high); }
  bool covers(const Vector2& low, const Vector2& high) const override { return net_.covers(low, high); }
  std::optional<SurfaceCurving> curving(const Vector2& low, const Vector2& high, const Vector3& point,
                                        const Vector3& normal) const override {
    return net_.curving(low, high, point, normal);
  }
  double weightAt(const Vector2& parameters) const override { return net_.weighted(parameters).w(); }
  std::optional<double> kinkAcrossU(double low, double high) const override { return net_.kinkAcrossU(low, high); }
  std::optional<double> kinkAcrossV(double low, double high) const override { return net_.kinkAcrossV(low, high); }

private:
  SplineNet net_;
};

class Drawn : public FreeformSurface {
public:
  Drawn(FreeformCurve profile, const Vector3& direction) : profile_(std::move(profile)), direction_(direction) {}

  SurfacePoint at(const Vector2& parameters) const override {
    const CurvePoint p = profile_.at(parameters.x());
    const Vector3 none = Vector3::Zero();
    return {p.point + parameters.y() * direction_, p.d1, direction_, p.d2, none, none};
  }
  SurfaceBends bends(const Vector2& low, const Vector2& high) const override {
    const CurveBends c = profile_.bends(low.x(), high.x());
    SurfaceBends b;
    b.u = c.d1, b.uu = c.d2, b.uuu = c.d3;
    b.v = direction_.norm();
    return b;
  }
  bool covers(const Vector2& low, const Vector2& high) const override { return profile_.covers(low.x(), high.x()); }
  std::optional<double> kinkAcrossU(double low, double high) const override { return profile_.kink(low, high); }
  std::optional<double> kinkAcrossV(double /*low*/, double /*high*/) const override { return std::nullopt; }

private:
  FreeformCurve profile_;
  Vector3 direction_;
};

class Turned : public FreeformSurface {
public:
  Turned(FreeformCurve profile, const Vector3& origin, const Vector3& axis)
      : profile_(std::move(profile)), origin_(origin), axis_(axis), most_(profile_.farthestFrom(origin, axis)) {}

  SurfacePoint at(const Vector2& parameters) const override {
    const CurvePoint c = profile_.at(parameters.y());
    const double cosine = std::cos(parameters.x()), sine = std::sin(parameters.x());
    struct Turning {
      Vector3 along, across, beside;
    };
    const auto split = [&](const Vector3& v) -> Turning {
      const Vector3 along = axis_ * axis_.dot(v);
      return {along, v - along, axis_.cross(v)};
    };
    const Turning p = split(c.point - origin_), d1 = split(c.d1), d2 = split(c.d2);
    const auto turned = [&](const Turning& t) -> Vector3 { return t.along + cosine * t.across + sine * t.beside; };
    const auto slope = [&](const Turning& t) -> Vector3 { return cosine * t.beside - sine * t.across; };
    return {origin_ + turned(p), slope(p), turned(d1), -cosine * p.across - sine * p.beside, slope(d1), turned(d2)};
  }
  SurfaceBends bends(const Vector2& low, const Vector2& high) const override {
    const CurveBends c = profile_.bends(low.y(), high.y());
    const auto armAt = [&](double v) { return axis_.cross(profile_.at(v).point - origin_).norm(); };
    // Along a line the distance from the axis is largest at an end; another curve may add to it on the way there.
    const double onLine = std::max(armAt(low.y()), armAt(high.y()));
    const double half = (high.y() - low.y()) / 2;
    const double arm = std::min(onLine + c.d2 * half * half / 2, most_);
    return {arm, c.d1, arm, c.d1, c.d2, arm, c.d1, c.d2, c.d3};
  }
  bool covers(const Vector2& low, const Vector2& high) const override { return profile_.covers(low.y(), high.y()); }
  std::optional<double> kinkAcrossU(double /*low*/, double /*high*/) const override { return std::nullopt; }
  std::optional<double> kinkAcrossV(double low, double high) const override { return profile_.kink(low, high); }

private:
  FreeformCurve profile_;
  Vector3 origin_, axis_;
  double most_;  ///< no point is farther from the axis
};

/// Any surface, its bends from samples on a grid.
class Sampled : public FreeformSurface {
public:
  Sampled(const Handle(Geom_Surface) & surface, const Vector2& low, const Vector2& high, int cells)
      : surface_(surface), low_(low), cell_((high - low) / cells), cellCount_(cells), sampleCount_(2 * cells + 1) {
    // Twice as dense as the cells, each of which counts what its nine samples show, and the change between them.
    std::vector<SurfacePoint> samples;
    for (int i = 0; i < sampleCount_; ++i) {
      for (int j = 0; j < sampleCount_; ++j)
        samples.push_back(at(low + cell_.cwiseProduct(Vector2(i, j)) / 2));
    }
    const auto sample = [&](int i, int j) -> const SurfacePoint& {
      return samples[static_cast<std::size_t>(i * sampleCount_ + j)];
    };
    for (int i = 0; i < cellCount_; ++i) {
      for (int j = 0; j < cellCount_; ++j) {
        SurfaceBends b;
        for (int k = 0; k < 9; ++k) {
          const int m = 2 * i + k / 3, n = 2 * j + k % 3;
          const SurfacePoint& s = sample(m, n);
          b.widen({s.u.norm(), s.v.norm(), s.uu.norm(), s.uv.norm(), s.vv.norm(), 0, 0, 0, 0});
          if (k / 3 < 2) {
            const SurfacePoint& next = sample(m + 1, n);
            const double step = cell_.x() / 2;
            b.widen({0, 0, 0, 0, 0, (next.uu - s.uu).norm() / step, (next.uv - s.uv).norm() / step,
                     (next.vv - s.vv).norm() / step, 0});
          }
          if (k % 3 < 2) {
            const SurfacePoint& next = sample(m, n + 1);
            const double step = cell_.y() / 2;
            b.widen({0, 0, 0, 0, 0, 0, (next.uu - s.uu).norm() / step, (next.uv - s.uv).norm() / step,
                     (next.vv - s.vv).norm() / step});
          }
        }
        constexpr double kSafety = 1.5;
        for (double* const most : {&b.u, &b.v, &b.uu, &b.uv, &b.vv, &b.uuu, &b.uuv, &b.uvv, &b.vvv})
          *most *= kSafety;
        cells_.push_back(b);
      }
    }
  }

  SurfacePoint at(const Vector2& parameters) const override {
    gp_Pnt p;
    gp_Vec u, v, uu, vv, uv;
    surface_->D2(parameters.x(), parameters.y(), p, u, v, uu, vv, uv);
    return {vector(p), vector(u), vector(v), vector(uu), vector(uv), vector(vv)};
  }
  SurfaceBends bends(const Vector2& low, const Vector2& high) const override {
    const auto cellAt = [&](const Vector2& p, Eigen::Index k) {
      const double cell = std::floor((p[k] - low_[k]) / cell_[k]);
      return static_cast<std::size_t>(std::clamp(cell, 0.0, cellCount_ - 1.0));
    };
    SurfaceBends found;
    for (std::size_t i = cellAt(low, 0); i <= cellAt(high, 0); ++i) {
      for (std::size_t j = cellAt(low, 1); j <= cellAt(high, 1); ++j)
        found.widen(cells_[i * static_cast<std::size_t>(cellCount_) + j]);
    }
    return found;
  }
  bool covers(const Vector2& low, const Vector2& high) const override {
    const Vector2 slack = cell_ / 2;
    return (low - low_ + slack).minCoeff() >= 0 && (low_ + cellCount_ * cell_ + slack - high).minCoeff() >= 0;
  }
  std::optional<double> kinkAcrossU(double /*low*/, double /*high*/) const override { return std::nullopt; }
  std::optional<double> kinkAcrossV(double /*low*/, double /*high*/) const override { return std::nullopt; }

private:
  Handle(Geom_Surface) surface_;
  Vector2 low_, cell_;
  int cellCount_, sampleCount_;  ///< along each parameter
  std::vector<SurfaceBends> cells_;
};

}  // namespace

SurfaceBends& SurfaceBends::widen(const SurfaceBends& other) {
  u = std::max(u, other.u), v = std::max(v, other.v);
  uu = std::max(uu, other.uu), uv = std::max(uv, other.uv), vv = std::max(vv, other.vv);
  uuu = std::max(uuu, other.uuu), uuv = std::max(uuv, other.uuv);
  uvv = std::max(uvv, other.uvv), vvv = std::max(vvv, other.vvv);
  return *this;
}

void SurfaceBends::narrow(const SurfacePoint& place, const Vector2& half) {
  const Vector2& h = half;
  uu = std::min(uu, place.uu.norm() + uuu * h.x() + uuv * h.y());
  uv = std::min(uv, place.uv.norm() + uuv * h.x() + uvv * h.y());
  vv = std::min(vv, place.vv.norm() + uvv * h.x() + vvv * h.y());
  u = std::min(u, place.u.norm() + uu * h.x() + uv * h.y());
  v = std::min(v, place.v.norm() + uv * h.x() + vv * h.y());
}

double SurfaceBends::fromTriangle(const Vector2& p, const Vector2& q, const Vector2& r) const {
  const auto along = [&](const Vector2& side) {
    return uu * side.x() * side.x() + 2 * uv * std::abs(side.x() * side.y()) + vv * side.y() * side.y();
  };
  return std::max({along(q - p), along(r - q), along(p - r)}) / 6;
}

std::unique_ptr<const FreeformSurface> freeformSurface(const Handle(Geom_Surface) & surface, const Vector2& low,
                                                       const Vector2& high) {
  if (const auto bezier = Handle(Geom_BezierSurface)::DownCast(surface))
    return freeformSurface(GeomConvert::SurfaceToBSplineSurface(bezier), low, high);
  if (const auto spline = Handle(Geom_BSplineSurface)::DownCast(surface)) {
    // Quotients of weights that differ much have bounds too large to be of use.
    if (auto net = SplineNet::of(spline); net && !net->isUneven()) return std::make_unique<Spline>(std::move(*net));
    constexpr int kLeast = 24, kMost = 96, kPerKnot = 3;
    const int cells = std::clamp(kPerKnot * std::max(spline->NbUKnots(), spline->NbVKnots()), kLeast, kMost);
    return std::make_unique<Sampled>(surface, low, high, cells);
  }
  if (const auto drawn = Handle(Geom_SurfaceOfLinearExtrusion)::DownCast(surface)) {
    if (auto profile = FreeformCurve::bounded(drawn->BasisCurve()))
      return std::make_unique<Drawn>(std::move(*profile), vector(drawn->Direction()));
  }
  if (const auto turned = Handle(Geom_SurfaceOfRevolution)::DownCast(surface)) {
    if (auto profile = FreeformCurve::bounded(turned->BasisCurve()))
      return std::make_unique<Turned>(std::move(*profile), vector(turned->Location()), vector(turned->Direction()));
  }
  constexpr int kCells = 16;
  return std::make_unique<Sampled>(surface, low, high, kCells);
}

double weightRatio(const Handle(Geom_Surface) & surface) {
  const TColStd_Array2OfReal* weights = nullptr;
  if (const auto spline = Handle(Geom_BSplineSurface)::DownCast(surface)) weights = spline->Weights();
  if (const auto bezier = Handle(Geom_BezierSurface)::DownCast(surface)) weights = bezier->Weights();
  if (weights == nullptr) return 1;
  double least = weights->Value(weights->LowerRow(), weights->LowerCol()), most = least;
  for (int i = weights->LowerRow(); i <= weights->UpperRow(); ++i) {
    for (int j = weights->LowerCol(); j <= weights->UpperCol(); ++j) {
      least = std::min(least, weights->Value(i, j));
      most = std::max(most, weights->Value(i, j));
    }
  }
  return most / least;
}

}  // namespace probewright::simulation
