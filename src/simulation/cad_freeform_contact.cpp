#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include "simulation/cad_contact.hpp"
#include "simulation/cad_vectors.hpp"

namespace probewright::simulation {
namespace {

void keep(Meeting& best, double when, const Vector3& point, const Vector3& normal) {
  if (when < best.when) best = {when, point, normal};
}

/// Tells when the steps of an iteration have become small enough. Where coordinates are large, rounding keeps them from
/// shrinking on: then the last step was as good as any.
class Settling {
public:
  explicit Settling(double enough) : enough_(enough) {}
  bool after(double step) {
    constexpr double kRounding = 1e-9;
    const bool settled = step < enough_ || (step < kRounding && step >= last_);
    last_ = step;
    return settled;
  }

private:
  double enough_;  ///< mm, as the steps
  double last_ = 1e300;
};

struct SurfacePoint {
  Vector3 point, u, v, uu, uv, vv;
};

SurfacePoint evaluate(const Geom_Surface& surface, const Vector2& at) {
  gp_Pnt p;
  gp_Vec u, v, uu, vv, uv;
  surface.D2(at.x(), at.y(), p, u, v, uu, vv, uv);
  return {vector(p), vector(u), vector(v), vector(uu), vector(uv), vector(vv)};
}

/// The parameters of the triangle's point, by its barycentric coordinates.
Vector2 parametersOf(const CadElement& t, const Vector3& p) {
  const Vector3 a = t.corners[1] - t.corners[0];
  const Vector3 b = t.corners[2] - t.corners[0];
  const Vector3 w = p - t.corners[0];
  const double aa = a.dot(a);
  const double ab = a.dot(b);
  const double bb = b.dot(b);
  const double determinant = aa * bb - ab * ab;
  if (determinant <= 0) return t.parameters[0];
  const double s = (bb * a.dot(w) - ab * b.dot(w)) / determinant;
  const double r = (aa * b.dot(w) - ab * a.dot(w)) / determinant;
  return t.parameters[0] + s * (t.parameters[1] - t.parameters[0]) + r * (t.parameters[2] - t.parameters[0]);
}

/// The size of the triangle in each parameter, as a limit for steps.
Vector2 parameterExtent(const CadElement& t) {
  const Vector2 low = t.parameters[0].cwiseMin(t.parameters[1]).cwiseMin(t.parameters[2]);
  const Vector2 high = t.parameters[0].cwiseMax(t.parameters[1]).cwiseMax(t.parameters[2]);
  return high - low;
}

/// The size of the whole surface in each parameter, as a limit for steps. At a pole the equations for a step have no
/// single solution; splines that close refuse parameters many turns away.
Vector2 parameterSize(const Geom_Surface& surface) {
  constexpr double kMost = 1e6;
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  surface.Bounds(u0, u1, v0, v1);
  return Vector2(u1 - u0, v1 - v0).cwiseMin(kMost);
}

/// Moves `at` to the parameters of the surface's point nearest to p, starting nearby. False if that does not settle.
bool projectOntoSurface(const Geom_Surface& surface, const Vector3& p, const Vector2& extent, Vector2& at) {
  Settling settling(1e-11);
  for (int i = 0; i < 30; ++i) {
    const SurfacePoint s = evaluate(surface, at);
    const Vector3 w = p - s.point;
    const Vector2 gradient(-w.dot(s.u), -w.dot(s.v));
    Eigen::Matrix2d hessian;
    hessian << s.u.dot(s.u) - w.dot(s.uu), s.u.dot(s.v) - w.dot(s.uv), 0, s.v.dot(s.v) - w.dot(s.vv);
    hessian(1, 0) = hessian(0, 1);
    if (hessian(0, 0) <= 0 || hessian.determinant() <= 0) {
      hessian << s.u.dot(s.u), s.u.dot(s.v), s.u.dot(s.v), s.v.dot(s.v);
    }
    if (hessian.determinant() <= 0) return false;
    Vector2 step = -hessian.inverse() * gradient;
    if (!step.allFinite()) return false;
    step = step.cwiseMax(-extent).cwiseMin(extent);
    at += step;
    if (settling.after((s.u * step.x() + s.v * step.y()).norm())) return true;
  }
  return false;
}

/// Newton's method for the place where a ball on its way touches the surface. False if it does not settle.
bool solveSurfaceTouch(const Geom_Surface& surface, const Way& way, double radius, const Vector2& extent, Vector2& at,
                       double& when) {
  Settling settling(1e-12);
  for (int i = 0; i < 25; ++i) {
    const SurfacePoint s = evaluate(surface, at);
    const Vector3 w = way.at(when) - s.point;
    const Vector3 f(w.dot(s.u), w.dot(s.v), (w.squaredNorm() - radius * radius) / (2 * radius));
    Matrix3 jacobian;
    jacobian << w.dot(s.uu) - s.u.dot(s.u), w.dot(s.uv) - s.u.dot(s.v), way.direction.dot(s.u),
        w.dot(s.uv) - s.u.dot(s.v), w.dot(s.vv) - s.v.dot(s.v), way.direction.dot(s.v), -w.dot(s.u) / radius,
        -w.dot(s.v) / radius, way.direction.dot(w) / radius;
    const Eigen::PartialPivLU<Matrix3> lu(jacobian);
    const Vector3 step = -lu.solve(f);
    if (!step.allFinite()) return false;
    double scale = 1;
    for (Eigen::Index k = 0; k < 2; ++k) {
      if (std::abs(step[k]) > extent[k]) scale = std::min(scale, extent[k] / std::abs(step[k]));
    }
    if (std::abs(step[2]) > radius) scale = std::min(scale, radius / std::abs(step[2]));
    at += scale * step.head<2>();
    when += scale * step[2];
    const bool still = settling.after(std::abs(step[2]));
    if (still && (s.u * step.x() + s.v * step.y()).norm() < 1e-9) return true;
  }
  return false;
}

/// One search for the contact of a ball with a free-form face.
class FaceSearch {
public:
  FaceSearch(const CadFace& face, const Way& way, double radius, Meeting& best)
      : face_(face), surface_(*face.surface), way_(way), radius_(radius), best_(best) {}

  /// Looks near one triangle; `coarse` is the meeting with the grown triangle. False if it cannot tell.
  bool near(const CadElement& triangle, const Meeting& coarse) {
    return settles(triangle, coarse, Otherwise::Walk) || best_.when < 0;
  }

  /// Looks again where the iterations went astray: at smaller triangles around, those first that would be met first,
  /// until they settle or are as good as the surface.
  void closely(const CadElement& triangle) {
    for (const CadElement& piece : widened(triangle)) {
      for (const CadElement& part : quarters(piece))
        consider(part, 1);
    }
    for (int looked = 0; !open_.empty() && best_.when >= 0; ++looked) {
      std::pop_heap(open_.begin(), open_.end(), later);
      const Part next = std::move(open_.back());
      open_.pop_back();
      if (next.coarse.when > best_.when - kSame) return;
      if (settles(next.element, next.coarse, Otherwise::LeaveOpen)) continue;
      if (next.depth < kDeepest && next.element.growth > kFlat && looked < kMostParts) {
        for (const CadElement& quarter : quarters(next.element))
          consider(quarter, next.depth + 1);
      } else {
        meetFlat(next);
      }
    }
  }

private:
  static constexpr int kDeepest = 16;
  static constexpr int kMostParts = 20000;
  static constexpr double kFlat = 1e-8;  ///< mm: a triangle that leaves the surface by less is as good as the surface
  static constexpr double kSame = 1e-7;  ///< mm: contacts nearer to each other are the same

  /// A piece of the surface that may be met, and where at the earliest.
  struct Part {
    Meeting coarse;
    CadElement element;
    int depth = 0;
  };
  static bool later(const Part& a, const Part& b) { return a.coarse.when > b.coarse.when; }

  CadElement element(const std::array<Vector2, 3>& parameters) const {
    CadElement e;
    e.parameters = parameters;
    for (std::size_t k = 0; k < 3; ++k)
      e.corners[k] = evaluate(surface_, parameters[k]).point;
    double deviation = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t j = (k + 1) % 3;
      const Vector3 middle = evaluate(surface_, (parameters[k] + parameters[j]) / 2).point;
      deviation = std::max(deviation, (middle - (e.corners[k] + e.corners[j]) / 2).norm());
    }
    e.growth = 1e-9 + 2 * deviation;
    return e;
  }

  /// The same triangle, large enough to cover what a chord cuts off beside it, in pieces: without what lies beyond the
  /// box about the borders, where a spline is nothing that anybody meant.
  std::vector<CadElement> widened(const CadElement& triangle) const {
    const auto& [a, b, c] = triangle.parameters;
    const Vector2 middle = (a + b + c) / 3;
    std::vector<Vector2> polygon;
    for (const Vector2& corner : triangle.parameters)
      polygon.push_back(corner + 0.5 * (corner - middle));
    if (!face_.domain.isEverywhere()) {
      const Vector2 low = face_.domain.low().cwiseMin(a).cwiseMin(b).cwiseMin(c);
      const Vector2 high = face_.domain.high().cwiseMax(a).cwiseMax(b).cwiseMax(c);
      for (Eigen::Index k = 0; k < 2; ++k) {
        polygon = cut(polygon, [&](const Vector2& p) { return p[k] - low[k]; });
        polygon = cut(polygon, [&](const Vector2& p) { return high[k] - p[k]; });
      }
    }
    std::vector<CadElement> pieces;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      pieces.push_back(triangle);
      pieces.back().parameters = {polygon[0], polygon[i - 1], polygon[i]};
    }
    return pieces;
  }

  /// The part of a convex polygon where `height`, which is linear, is not negative.
  template <class Height>
  static std::vector<Vector2> cut(const std::vector<Vector2>& polygon, const Height& height) {
    std::vector<Vector2> part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vector2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const double from = height(p), to = height(q);
      if (from >= 0) part.push_back(p);
      if ((from < 0) != (to < 0)) part.emplace_back(p + from / (from - to) * (q - p));
    }
    return part;
  }

  std::array<CadElement, 4> quarters(const CadElement& t) const {
    const Vector2& a = t.parameters[0];
    const Vector2& b = t.parameters[1];
    const Vector2& c = t.parameters[2];
    const Vector2 ab = (a + b) / 2;
    const Vector2 bc = (b + c) / 2;
    const Vector2 ca = (c + a) / 2;
    return {element({a, ab, ca}), element({ab, b, bc}), element({ca, bc, c}), element({ab, bc, ca})};
  }

  void consider(const CadElement& element, int depth) {
    Part part{{}, element, depth};
    part.coarse.when = best_.when;
    if (!sweepTriangle(way_, radius_ + element.growth, element.corners, part.coarse)) return;
    if (part.coarse.when > best_.when - kSame) return;
    open_.push_back(std::move(part));
    std::push_heap(open_.begin(), open_.end(), later);
  }

  /// As a last resort the triangle itself, unless what is known already is the same within its precision.
  void meetFlat(const Part& part) {
    const Vector2 at = parametersOf(part.element, part.coarse.point);
    Meeting flat;
    flat.when = best_.when - 4 * part.element.growth;
    if (face_.domain.contains(at) && sweepTriangle(way_, radius_, part.element.corners, flat)) meet(flat.when, at);
  }

  void meet(double when, const Vector2& at) {
    const SurfacePoint s = evaluate(surface_, at);
    const Vector3 normal = s.u.cross(s.v);
    keep(best_, when, s.point,
         normal.norm() > 0 ? Vector3(normal.normalized() * (face_.reversed ? -1 : 1)) : Vector3::Zero());
  }

  double gapAt(double when, const Vector2& at) const {
    return (way_.at(when) - evaluate(surface_, at).point).norm() - radius_;
  }

  /// What is done where the iteration from the triangle leads nowhere.
  enum class Otherwise : std::uint8_t { Walk, LeaveOpen };
  /// True if what happens near the triangle is known: a contact, which goes into the best, or none.
  bool settles(const CadElement& triangle, const Meeting& coarse, Otherwise otherwise) {
    const Vector2 extent = 2 * parameterExtent(triangle);
    const Vector2 low = triangle.parameters[0].cwiseMin(triangle.parameters[1]).cwiseMin(triangle.parameters[2]);
    const auto isNear = [&](const Vector2& at) {
      return (at - low + 1.5 * extent).minCoeff() >= 0 && (low + 2 * extent - at).minCoeff() >= 0;
    };
    Vector2 at = parametersOf(triangle, coarse.point);
    if (coarse.when < 0) {
      Vector2 nearest = at;
      if (projectOntoSurface(surface_, way_.start, extent, nearest)) {
        const double gap = gapAt(0, nearest);
        if (gap < -kTouchTolerance && gap < best_.when && face_.domain.contains(nearest)) {
          meet(gap, nearest);
          return true;
        }
      }
    }
    // The grown triangle is met a little early; the triangle itself, where it is met at all, gives the better start.
    Meeting middle;
    sweepTriangle(way_, radius_, triangle.corners, middle);
    if (middle.found()) at = parametersOf(triangle, middle.point);
    const Vector2 seed = at;
    double when = std::max(0.0, middle.found() ? middle.when : coarse.when);
    const auto approaches = [&] { return (way_.at(when) - evaluate(surface_, at).point).dot(way_.direction) < 0; };
    const bool solved = solveSurfaceTouch(surface_, way_, radius_, extent, at, when) && approaches();
    if (solved && isNear(at)) return accept(when, at);
    // A contact elsewhere counts, too, but this place is still open.
    if (solved) accept(when, at);
    if (otherwise == Otherwise::LeaveOpen) return false;
    // Walk up to the surface: slower, but never past the first contact.
    at = seed;
    when = std::max(0.0, coarse.when);
    for (int i = 0; i < 50; ++i) {
      if (!projectOntoSurface(surface_, way_.at(when), extent, at) || !isNear(at)) return false;
      const double gap = gapAt(when, at);
      if (gap < -1e-6) return false;
      if (std::abs(gap) < 1e-9) return !approaches() || accept(when, at);
      when += gap;
      if (when > way_.length || when >= best_.when) return true;
    }
    return false;
  }

  /// Takes a touch of the whole surface as a contact if the face is there and the ball goes on into it. False if it is
  /// no touch.
  bool accept(double when, const Vector2& at) {
    if (when < -1e-7 || when > way_.length || when >= best_.when || !face_.domain.contains(at)) return true;
    if (std::abs(gapAt(when, at)) > 1e-7) return false;
    // A ball that touches at the start within the tolerance and would graze only has nothing to meet.
    Vector2 later = at;
    const double end = std::min(way_.length, std::max(when, 0.0) + 1e-3 * radius_);
    if (projectOntoSurface(surface_, way_.at(end), parameterSize(surface_), later) &&
        gapAt(end, later) >= -kTouchTolerance)
      return true;
    meet(std::max(0.0, when), at);
    return true;
  }

  const CadFace& face_;
  const Geom_Surface& surface_;
  const Way& way_;
  double radius_;
  Meeting& best_;
  std::vector<Part> open_;
};

/// One search for the contact of a ball with a curved edge.
class EdgeSearch {
public:
  EdgeSearch(const CadEdge& edge, const TrimmedDomain* within, const Way& way, double radius, Meeting& best)
      : edge_(edge), within_(within), way_(way), radius_(radius), best_(best) {}

  /// Looks near the chord between two parameters; `coarse` is the meeting with the grown chord.
  void near(double low, double high, const Meeting& coarse, int depth = 0) {
    if (depth == 0) {
      for (const double t : {low, high}) {
        if (counts(t)) sweepPoint(way_, radius_, pointAt(t), best_);
      }
    }
    if (settles(low, high, coarse)) return;
    constexpr int kDeepest = 14;
    const double middle = (low + high) / 2;
    const std::array<double, 3> ends{low, middle, high};
    for (std::size_t k = 0; k < 2; ++k) {
      const Vector3 a = pointAt(ends[k]);
      const Vector3 b = pointAt(ends[k + 1]);
      const double deviation = (pointAt((ends[k] + ends[k + 1]) / 2) - (a + b) / 2).norm();
      Meeting finer;
      finer.when = best_.when;
      if (!sweepSegment(way_, radius_ + 1e-9 + 2 * deviation, a, b, finer)) continue;
      if (finer.when > best_.when - 1e-7) continue;
      if (depth < kDeepest && deviation > 1e-8) {
        near(ends[k], ends[k + 1], finer, depth + 1);
      } else if (deviation < 1e-6) {
        meetStraight(ends[k], ends[k + 1], a, b);
      }
    }
  }

private:
  std::array<Vector3, 3> evaluateCurve(double t) const {
    gp_Pnt p;
    gp_Vec d1, d2;
    edge_.curve->D2(t, p, d1, d2);
    return {vector(p), vector(d1), vector(d2)};
  }
  Vector3 pointAt(double t) const { return vector(edge_.curve->Value(t)); }

  bool counts(double t) const {
    return within_ == nullptr || within_->contains(edge_.acrossU ? Vector2(edge_.kinkAt, t) : Vector2(t, edge_.kinkAt));
  }

  /// Meets a piece that is as good as straight; beyond the border of the face that it is a kink of, there is nothing.
  void meetStraight(double low, double high, const Vector3& a, const Vector3& b) {
    Meeting met;
    met.when = best_.when;
    if (!sweepSegment(way_, radius_, a, b, met)) return;
    const Vector3 line = b - a;
    const double share =
        line.squaredNorm() > 0 ? std::clamp(line.dot(met.point - a) / line.squaredNorm(), 0.0, 1.0) : 0;
    if (counts(low + share * (high - low))) keep(best_, met.when, met.point, met.normal);
  }

  bool project(const Vector3& p, double extent, double& t) const {
    Settling settling(1e-11);
    for (int i = 0; i < 30; ++i) {
      const auto [c, d1, d2] = evaluateCurve(t);
      const Vector3 w = p - c;
      double curvature = d1.squaredNorm() - w.dot(d2);
      if (curvature <= 0) curvature = d1.squaredNorm();
      if (curvature <= 0) return false;
      const double step = std::clamp(w.dot(d1) / curvature, -extent, extent);
      t += step;
      if (settling.after(std::abs(step) * d1.norm())) return true;
    }
    return false;
  }

  double gapAt(double when, double t) const { return (way_.at(when) - pointAt(t)).norm() - radius_; }

  /// True if what happens near the chord is known: a contact, which goes into the best, or none.
  bool settles(double low, double high, const Meeting& coarse) {
    const double extent = high - low;
    const Vector3 from = pointAt(low);
    const Vector3 line = pointAt(high) - from;
    const double share =
        line.squaredNorm() > 0 ? std::clamp(line.dot(coarse.point - from) / line.squaredNorm(), 0.0, 1.0) : 0.5;
    const double seed = low + share * extent;
    const auto onChord = [&](double t) {
      return t >= low - 0.01 * extent && t <= high + 0.01 * extent && t >= edge_.first && t <= edge_.last;
    };
    if (coarse.when < 0) {
      double t = seed;
      if (project(way_.start, extent, t) && onChord(t) && counts(t)) {
        const double gap = gapAt(0, t);
        if (gap < -kTouchTolerance) {
          keep(best_, gap, pointAt(t), Vector3::Zero());
          return true;
        }
      }
    }
    double at = seed;
    double when = std::max(0.0, coarse.when);
    if (!solve(extent, at, when)) return false;
    if (!onChord(at)) return false;
    const Vector3 touch = pointAt(at);
    if ((way_.at(when) - touch).dot(way_.direction) >= 0) return false;
    if (!counts(at) || when < -1e-7 || when > way_.length || when >= best_.when) return true;
    if (std::abs(gapAt(when, at)) > 1e-7) return false;
    const double end = std::min(way_.length, std::max(when, 0.0) + 1e-3 * radius_);
    double later = at;
    if (project(way_.at(end), extent, later) && gapAt(end, later) >= -kTouchTolerance) return true;
    keep(best_, std::max(0.0, when), touch, Vector3::Zero());
    return true;
  }

  /// Newton's method for the place where the ball touches the curve.
  bool solve(double extent, double& at, double& when) const {
    Settling settling(1e-12);
    for (int i = 0; i < 25; ++i) {
      const auto [c, d1, d2] = evaluateCurve(at);
      const Vector3 w = way_.at(when) - c;
      const Vector2 f(w.dot(d1), (w.squaredNorm() - radius_ * radius_) / (2 * radius_));
      Eigen::Matrix2d jacobian;
      jacobian << w.dot(d2) - d1.squaredNorm(), way_.direction.dot(d1), -w.dot(d1) / radius_,
          way_.direction.dot(w) / radius_;
      if (std::abs(jacobian.determinant()) < 1e-300) return false;
      const Vector2 step = -jacobian.inverse() * f;
      const double scale = std::min(
          {1.0, extent / std::max(std::abs(step.x()), 1e-300), radius_ / std::max(std::abs(step.y()), 1e-300)});
      at += scale * step.x();
      when += scale * step.y();
      const bool still = settling.after(std::abs(step.y()));
      if (still && std::abs(step.x()) * d1.norm() < 1e-9) return true;
    }
    return false;
  }

  const CadEdge& edge_;
  const TrimmedDomain* within_;
  const Way& way_;
  double radius_;
  Meeting& best_;
};

}  // namespace

bool meetFaceNear(const CadFace& face, const CadElement& triangle, const Meeting& coarse, const Way& way, double radius,
                  Meeting& best) {
  return FaceSearch(face, way, radius, best).near(triangle, coarse);
}

void meetFaceClosely(const CadFace& face, const CadElement& triangle, const Way& way, double radius, Meeting& best) {
  FaceSearch(face, way, radius, best).closely(triangle);
}

void meetEdgeNear(const CadEdge& edge, const TrimmedDomain* within, const CadElement& chord, const Meeting& coarse,
                  const Way& way, double radius, Meeting& best) {
  EdgeSearch(edge, within, way, radius, best).near(chord.parameters[0].x(), chord.parameters[1].x(), coarse);
}

}  // namespace probewright::simulation
