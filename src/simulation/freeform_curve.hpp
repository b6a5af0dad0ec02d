#pragma once

#include <Geom_Curve.hxx>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "geometry/primitives.hpp"
#include "simulation/spline_net.hpp"

namespace probewright::simulation {

/// A place of a curve with its derivatives.
struct CurvePoint {
  Vector3 point, d1, d2;
};

/// The largest sizes of the derivatives of a curve in an interval of its parameter.
struct CurveBends {
  double d1 = 0, d2 = 0;
  double d3 = 0;  ///< without bound where the second derivative jumps

  /// How far a curve leaves the straight line between two of its points, their parameters so far apart.
  double fromChord(double length) const { return d2 * length * length / 8; }
};

/// A curve as the search for contacts needs it. Any thread may use it.
class FreeformCurve {
public:
  /// Splines, circles, ellipses and lines have proven bends; those of other curves are taken from samples between two
  /// parameters.
  FreeformCurve(const Handle(Geom_Curve) & curve, double first, double last);
  /// Nothing for curves whose bends are not proven.
  static std::optional<FreeformCurve> bounded(const Handle(Geom_Curve) & curve);

  CurvePoint at(double t) const;
  CurveBends bends(double low, double high) const;
  /// True if the bends of an interval hold: it does not reach beyond the ends of a spline.
  bool covers(double low, double high) const { return !net_ || net_->covers({low, 0}, {high, 0}); }
  /// A place within an interval where the first derivative may jump. Bends of intervals that have one within do not
  /// bound how far the curve leaves a line.
  std::optional<double> kink(double low, double high) const;
  /// A distance from an axis that no point of the curve exceeds, as far as one is known.
  double farthestFrom(const Vector3& origin, const Vector3& axis) const;

private:
  FreeformCurve() = default;
  bool findBends();
  void sampleBends(double first, double last);

  Handle(Geom_Curve) curve_;
  std::optional<SplineNet> net_;
  CurveBends bends_;  ///< the same everywhere, unless there are cells
  double first_ = 0, cell_ = 0;
  std::vector<CurveBends> cells_;
};

/// A curve that is made ready when somebody first asks for it, by any thread.
class LazyFreeformCurve {
public:
  LazyFreeformCurve(Handle(Geom_Curve) curve, double first, double last)
      : curve_(std::move(curve)), first_(first), last_(last) {}
  const FreeformCurve& operator*() const {
    std::call_once(once_, [&] { made_.emplace(curve_, first_, last_); });
    return *made_;
  }

private:
  Handle(Geom_Curve) curve_;
  double first_, last_;
  mutable std::once_flag once_;
  mutable std::optional<FreeformCurve> made_;
};

}  // namespace probewright::simulation
