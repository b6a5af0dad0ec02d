#include "simulation/freeform_curve.hpp"

#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_Line.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include "simulation/cad_vectors.hpp"

namespace probewright::simulation {

FreeformCurve::FreeformCurve(const Handle(Geom_Curve) & curve, double first, double last) : curve_(curve) {
  if (!findBends()) sampleBends(first, last);
}

std::optional<FreeformCurve> FreeformCurve::bounded(const Handle(Geom_Curve) & curve) {
  FreeformCurve made;
  made.curve_ = curve;
  return made.findBends() ? std::optional(std::move(made)) : std::nullopt;
}

bool FreeformCurve::findBends() {
  Handle(Geom_BSplineCurve) spline = Handle(Geom_BSplineCurve)::DownCast(curve_);
  if (const auto bezier = Handle(Geom_BezierCurve)::DownCast(curve_)) spline = GeomConvert::CurveToBSplineCurve(bezier);
  if (!spline.IsNull()) {
    net_ = SplineNet::of(spline);
    return net_.has_value();
  }
  if (curve_->IsKind(STANDARD_TYPE(Geom_Line))) {
    bends_.d1 = 1;
    return true;
  }
  double radius = 0;
  if (const auto circle = Handle(Geom_Circle)::DownCast(curve_)) radius = circle->Radius();
  if (const auto ellipse = Handle(Geom_Ellipse)::DownCast(curve_)) radius = ellipse->MajorRadius();
  if (radius <= 0) return false;
  bends_ = {radius, radius, radius};
  return true;
}

void FreeformCurve::sampleBends(double first, double last) {
  constexpr int kCells = 64;
  constexpr double kSafety = 1.5;
  first_ = first;
  cell_ = (last - first) / kCells;
  CurvePoint from = at(first);
  for (int i = 0; i < kCells; ++i) {
    // In the middle and at both ends of the cell, and the change between them.
    CurveBends b;
    for (const double t : {first + (i + 0.5) * cell_, first + (i + 1.0) * cell_}) {
      const CurvePoint to = at(t);
      for (const CurvePoint* const p : std::array<const CurvePoint*, 2>{&from, &to}) {
        b.d1 = std::max(b.d1, p->d1.norm());
        b.d2 = std::max(b.d2, p->d2.norm());
      }
      b.d3 = std::max(b.d3, (to.d2 - from.d2).norm() / std::abs(cell_ / 2));
      from = to;
    }
    cells_.push_back({kSafety * b.d1, kSafety * b.d2, kSafety * b.d3});
  }
}

CurvePoint FreeformCurve::at(double t) const {
  if (net_) {
    const SurfacePoint p = net_->at({t, 0});
    return {p.point, p.u, p.uu};
  }
  gp_Pnt p;
  gp_Vec d1, d2;
  curve_->D2(t, p, d1, d2);
  return {vector(p), vector(d1), vector(d2)};
}

CurveBends FreeformCurve::bends(double low, double high) const {
  if (net_) {
    const SurfaceBends b = net_->bends({low, 0}, {high, 0});
    return {b.u, b.uu, b.uuu};
  }
  if (cells_.empty()) return bends_;
  const auto cellAt = [&](double t) {
    const double last = static_cast<double>(cells_.size()) - 1;
    return static_cast<std::size_t>(std::clamp(std::floor((t - first_) / cell_), 0.0, last));
  };
  CurveBends found;
  for (std::size_t i = cellAt(low); i <= cellAt(high); ++i)
    found = {std::max(found.d1, cells_[i].d1), std::max(found.d2, cells_[i].d2), std::max(found.d3, cells_[i].d3)};
  return found;
}

std::optional<double> FreeformCurve::kink(double low, double high) const {
  return net_ ? net_->kinkAcrossU(low, high) : std::nullopt;
}

double FreeformCurve::farthestFrom(const Vector3& origin, const Vector3& axis) const {
  constexpr double kNoBound = 1e300;
  return net_ ? net_->farthestFrom(origin, axis) : kNoBound;
}

}  // namespace probewright::simulation
