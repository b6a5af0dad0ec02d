#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include "simulation/cad_contact.hpp"
#include "simulation/cad_vectors.hpp"
#include "simulation/settling.hpp"

namespace probewright::simulation {
namespace {

struct SurfacePoint {
  Vector3 point, u, v, uu, uv, vv;
};

SurfacePoint evaluate(const Adaptor3d_Surface& surface, const Vector2& at) {
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
Vector2 parameterSize(const Adaptor3d_Surface& surface) {
  constexpr double kMost = 1e6;
  return Vector2(surface.LastUParameter() - surface.FirstUParameter(),
                 surface.LastVParameter() - surface.FirstVParameter())
      .cwiseMin(kMost);
}

/// Moves `at` to the parameters of the surface's point nearest to p, starting nearby. False if that does not settle.
bool projectOntoSurface(const Adaptor3d_Surface& surface, const Vector3& p, const Vector2& extent, Vector2& at) {
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

/// Newton's method for the place where a ball on its way touches the surface. False if it does not settle, or goes
/// astray on the way.
template <class GoesAstray>
bool solveSurfaceTouch(const Adaptor3d_Surface& surface, const Way& way, double radius, const Vector2& extent,
                       Vector2& at, double& when, const GoesAstray& goesAstray) {
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
    if (goesAstray(at)) return false;
    const bool still = settling.after(std::abs(step[2]));
    if (still && (s.u * step.x() + s.v * step.y()).norm() < 1e-9) return true;
  }
  return false;
}

/// One search for the contact of a ball with a free-form face.
class FaceSearch {
public:
  FaceSearch(const CadFace& face, const Adaptor3d_Surface& surface, const Way& way, double radius, Meeting& best)
      : face_(face), surface_(surface), way_(way), radius_(radius), best_(best) {}

  /// Looks near one triangle; `coarse` is the meeting with the grown triangle. False if it cannot tell.
  bool near(const CadElement& triangle, const Meeting& coarse) {
    return settles(triangle, coarse, Otherwise::Walk) || best_.when < 0;
  }

  /// Looks again where the iterations went astray: at smaller triangles around, those first that would be met first,
  /// until they settle or are as good as the surface.
  void closely(const CadElement& triangle) {
    for (const std::array<Vector2, 3>& piece : widened(triangle)) {
      for (const Patch& part : quarters(patch(sample(piece[0]), sample(piece[1]), sample(piece[2]))))
        consider(part, 1);
    }
    for (int looked = 0; !open_.empty() && best_.when >= 0; ++looked) {
      std::pop_heap(open_.begin(), open_.end(), later);
      const Part next = std::move(open_.back());
      open_.pop_back();
      if (next.coarse.when > best_.when - kSame) return;
      if (settles(next.element, next.coarse, Otherwise::LeaveOpen)) continue;
      if (next.depth < kDeepest && next.element.growth > kFlat && looked < kMostParts) {
        for (const Patch& quarter : quarters(next.patch))
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

  /// A place of the surface; its normal is zero at a pole.
  struct Sample {
    Vector2 at;
    Vector3 point, normal;
  };
  /// The corners of a triangle of the surface; behind them the middles of its sides, the first between the first two.
  using Patch = std::array<Sample, 6>;
  /// A piece of the surface that may be met, and where at the earliest.
  struct Part {
    Meeting coarse;
    CadElement element;
    Patch patch;
    int depth = 0;
  };
  static bool later(const Part& a, const Part& b) { return a.coarse.when > b.coarse.when; }

  Sample sample(const Vector2& at) const {
    gp_Pnt p;
    gp_Vec u, v;
    surface_.D1(at.x(), at.y(), p, u, v);
    const Vector3 alongU = vector(u), alongV = vector(v);
    const Vector3 normal = alongU.cross(alongV);
    constexpr double kFlattest = 1e-7;
    const double size = normal.norm();
    return {at, vector(p),
            size > kFlattest * alongU.norm() * alongV.norm() ? Vector3(normal / size) : Vector3(Vector3::Zero())};
  }

  Sample between(const Sample& a, const Sample& b) const { return sample((a.at + b.at) / 2); }
  Patch patch(const Sample& a, const Sample& b, const Sample& c) const {
    return {a, b, c, between(a, b), between(b, c), between(c, a)};
  }

  std::array<Patch, 4> quarters(const Patch& t) const {
    const auto& [a, b, c, ab, bc, ca] = t;
    const Sample x = between(ab, bc), y = between(bc, ca), z = between(ca, ab);
    return {Patch{a, ab, ca, between(a, ab), z, between(ca, a)}, Patch{ab, b, bc, between(ab, b), between(b, bc), x},
            Patch{ca, bc, c, y, between(bc, c), between(c, ca)}, Patch{ab, bc, ca, x, y, z}};
  }

  static CadElement elementOf(const Patch& patch) {
    CadElement e;
    double deviation = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      e.parameters[k] = patch[k].at;
      e.corners[k] = patch[k].point;
      const Vector3 middle = (patch[k].point + patch[(k + 1) % 3].point) / 2;
      deviation = std::max(deviation, (patch[3 + k].point - middle).norm());
    }
    e.growth = 1e-9 + 2 * deviation;
    return e;
  }

  /// True if the ball may touch the inside of a patch between two times: that happens along a normal of the surface.
  /// Elsewhere only edges and poles are touched.
  bool facesTheBall(const Patch& patch, double from, double to) const {
    Vector3 middle = Vector3::Zero(), normal = Vector3::Zero();
    double known = 0;
    for (const Sample& s : patch) {
      middle += s.point / 6;
      normal += s.normal;
      known += s.normal == Vector3::Zero() ? 0 : 1;
    }
    if (known < 3 || normal.norm() < 0.5 * known) return true;
    normal.normalize();
    double size = 0, spread = 0;
    for (const Sample& s : patch) {
      size = std::max(size, (s.point - middle).norm());
      if (s.normal != Vector3::Zero()) spread = std::max(spread, (s.normal - normal).norm());
    }
    // What lies between the samples may be a little more than they are.
    constexpr double kSizes = 1.2, kSpreads = 2.5, kLeast = 1e-4;
    const Vector3 way = way_.at((from + to) / 2) - middle;
    const double distance = way.norm(), off = kSizes * size + (to - from) / 2;
    if (off > 0.5 * distance) return true;
    return way.cross(normal).norm() / distance < kLeast + kSpreads * spread + 1.2 * off / distance;
  }

  /// True if a plane shows that the ball does not reach a patch before it has made the best contact so far.
  bool liesBehind(const Patch& patch) const {
    if (best_.when < 0 || best_.when > way_.length) return false;
    const Vector3 centre = way_.at(best_.when);
    for (const Vector3& place :
         {best_.point, closestOnTriangle(centre, {patch[0].point, patch[1].point, patch[2].point})}) {
      const Vector3 out = (place - centre).normalized();
      const double ahead = out.dot(way_.direction);
      if (!(ahead > 0)) continue;
      std::array<double, 6> heights{};
      for (std::size_t k = 0; k < 6; ++k)
        heights[k] = out.dot(patch[k].point - centre);
      double bent = 0;
      for (std::size_t k = 0; k < 3; ++k)
        bent = std::max(bent, std::abs(heights[3 + k] - (heights[k] + heights[(k + 1) % 3]) / 2));
      if (*std::ranges::min_element(heights) - 2 * bent > radius_ - kSame * ahead) return true;
    }
    return false;
  }

  /// The same triangle, large enough to cover what a chord cuts off beside it, in pieces: without what lies beyond the
  /// box about the borders, where a spline is nothing that anybody meant.
  std::vector<std::array<Vector2, 3>> widened(const CadElement& triangle) const {
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
    std::vector<std::array<Vector2, 3>> pieces;
    for (std::size_t i = 2; i < polygon.size(); ++i)
      pieces.push_back({polygon[0], polygon[i - 1], polygon[i]});
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

  void consider(const Patch& patch, int depth) {
    Part part{{}, elementOf(patch), patch, depth};
    part.coarse.when = best_.when;
    if (!sweepTriangle(way_, radius_ + part.element.growth, part.element.corners, part.coarse)) return;
    if (part.coarse.when > best_.when - kSame || !reachesDomain(part.element)) return;
    const Vector2 middle = (patch[0].at + patch[1].at + patch[2].at) / 3;
    for (std::size_t k = 0; k < 3; ++k) {
      // A pole is a place where borders meet, at least of the parameters: just within, they tell whose it is.
      if (patch[k].normal == Vector3::Zero() && face_.domain.contains(patch[k].at + 1e-3 * (middle - patch[k].at)))
        sweepPoint(way_, radius_, patch[k].point, best_);
    }
    if (liesBehind(patch)) return;
    if (!facesTheBall(patch, std::max(0.0, part.coarse.when), std::min(best_.when, way_.length))) return;
    open_.push_back(std::move(part));
    std::push_heap(open_.begin(), open_.end(), later);
  }

  /// False if no part of the face is near: what its surface does beyond the borders matters to nobody.
  bool reachesDomain(const CadElement& element) const {
    const auto& [a, b, c] = element.parameters;
    return face_.domain.isEverywhere() || face_.domain.reaches(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c));
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
    const auto goesAstray = [&](const Vector2& place) {
      return otherwise == Otherwise::LeaveOpen &&
             ((place - low + 3 * extent).minCoeff() < 0 || (low + 3.5 * extent - place).minCoeff() < 0);
    };
    const bool solved = solveSurfaceTouch(surface_, way_, radius_, extent, at, when, goesAstray) && approaches();
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
  const Adaptor3d_Surface& surface_;
  const Way& way_;
  double radius_;
  Meeting& best_;
  std::vector<Part> open_;
};

}  // namespace

bool meetFaceNear(const CadFace& face, const Adaptor3d_Surface& surface, const CadElement& triangle,
                  const Meeting& coarse, const Way& way, double radius, Meeting& best) {
  return FaceSearch(face, surface, way, radius, best).near(triangle, coarse);
}

void meetFaceClosely(const CadFace& face, const Adaptor3d_Surface& surface, const CadElement& triangle, const Way& way,
                     double radius, Meeting& best) {
  FaceSearch(face, surface, way, radius, best).closely(triangle);
}

}  // namespace probewright::simulation
