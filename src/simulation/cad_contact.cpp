#include "simulation/cad_contact.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

namespace probewright::simulation {
namespace {

void keep(Meeting& best, double when, const Vector3& point, const Vector3& normal) {
  if (when < best.when) best = {when, point, normal};
}

template <class Triple>
Vector3 vector(const Triple& p) {
  return {p.X(), p.Y(), p.Z()};
}

/// The parameter of the point of a circle nearest to p, moved by whole turns into [first, first + 360 degrees).
struct CircleFoot {
  Vector3 point;
  double parameter;
};

CircleFoot circleFoot(const CadEdge& edge, const Vector3& p) {
  const Vector3 q = edge.axes.transpose() * (p - edge.centre);
  double parameter = std::atan2(q.y(), q.x());
  const Vector3 point =
      edge.centre + edge.axes * Vector3(edge.radius * std::cos(parameter), edge.radius * std::sin(parameter), 0);
  const double turn = 2 * std::numbers::pi;
  parameter += turn * std::ceil((edge.first - parameter) / turn);
  return {point, parameter};
}

void meetCircle(const CadEdge& edge, const Way& way, double radius, Meeting& best) {
  const auto gapAndSlope = [&](double when) {
    const Vector3 p = way.at(when);
    const Vector3 arm = p - circleFoot(edge, p).point;
    const double distance = arm.norm();
    return std::pair(distance - radius, distance > 0 ? arm.dot(way.direction) / distance : 0.0);
  };
  const double gapAtStart = gapAndSlope(0).first;
  if (gapAtStart < -kTouchTolerance) {
    const CircleFoot foot = circleFoot(edge, way.start);
    if (foot.parameter <= edge.last) keep(best, gapAtStart, foot.point, Vector3::Zero());
  }
  std::array<double, 6> touches{};
  std::size_t count = 0;
  if (std::abs(gapAtStart) <= kTouchTolerance) touches[count++] = 0;
  const Vector3 start = edge.axes.transpose() * (way.start - edge.centre);
  const Vector3 direction = edge.axes.transpose() * way.direction;
  for (const double root : circleDistanceRoots(start, direction, way.length, edge.radius, radius)) {
    touches[count++] = refineTouch(root, gapAndSlope);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double when = touches[i];
    if (when < 0 || when > way.length || when >= best.when) continue;
    const double next = i + 1 < count ? touches[i + 1] : way.length;
    if (std::min(gapAndSlope((when + next) / 2).first, gapAndSlope(next).first) >= -kTouchTolerance) continue;
    const auto [gap, slope] = gapAndSlope(when);
    if (slope >= 0 || std::abs(gap) > 1e-7) continue;
    const CircleFoot foot = circleFoot(edge, way.at(when));
    if (foot.parameter <= edge.last) {
      keep(best, when, foot.point, Vector3::Zero());
      return;
    }
  }
}

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

/// Moves `at` to the parameters of the surface's point nearest to p, starting nearby. False if that does not settle.
bool projectOntoSurface(const Geom_Surface& surface, const Vector3& p, const Vector2& extent, Vector2& at) {
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
    step = step.cwiseMax(-extent).cwiseMin(extent);
    at += step;
    if ((s.u * step.x() + s.v * step.y()).norm() < 1e-11) return true;
  }
  return false;
}

/// Newton's method for the place where a ball on its way touches the surface. False if it does not settle.
bool solveSurfaceTouch(const Geom_Surface& surface, const Way& way, double radius, const Vector2& extent, Vector2& at,
                       double& when) {
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
    if (std::abs(step[2]) < 1e-12 && (s.u * step.x() + s.v * step.y()).norm() < 1e-9) return true;
  }
  return false;
}

}  // namespace

void meetAnalyticFace(const CadFace& face, const Way& way, double radius, Meeting& best) {
  const AnalyticSurface& surface = *face.analytic;
  const double side = face.reversed ? -1 : 1;
  const double handed = surface.axes.determinant() < 0 ? -1 : 1;
  const auto gapAndSlope = [&](double when) {
    const SurfaceFoot foot = surface.foot(way.at(when));
    const double sign = foot.signedDistance < 0 ? -1 : 1;
    return std::pair(std::abs(foot.signedDistance) - radius, sign * foot.normal.dot(way.direction));
  };
  const auto meet = [&](double when, const SurfaceFoot& foot) {
    keep(best, when, foot.point, side * handed * foot.normal);
  };
  const SurfaceFoot atStart = surface.foot(way.start);
  const double gapAtStart = std::abs(atStart.signedDistance) - radius;
  if (gapAtStart < -kTouchTolerance && atStart.exists && gapAtStart < best.when &&
      face.domain.contains(atStart.parameters)) {
    meet(gapAtStart, atStart);
    return;
  }
  AnalyticSurface::Touches touches = surface.touches(way, radius);
  for (std::size_t i = 0; i < touches.count; ++i)
    touches.values[i] = refineTouch(touches.values[i], gapAndSlope);
  if (std::abs(gapAtStart) <= kTouchTolerance) {
    touches.values[touches.count++] = 0;
    std::rotate(touches.values.begin(), touches.values.begin() + static_cast<std::ptrdiff_t>(touches.count) - 1,
                touches.values.begin() + static_cast<std::ptrdiff_t>(touches.count));
  }
  for (std::size_t i = 0; i < touches.count; ++i) {
    const double when = touches.values[i];
    if (when < 0 || when > way.length || when >= best.when) continue;
    const auto [gap, slope] = gapAndSlope(when);
    if (slope >= 0 || std::abs(gap) > 1e-7) continue;
    const double next = i + 1 < touches.count ? touches.values[i + 1] : way.length;
    if (std::min(gapAndSlope((when + next) / 2).first, gapAndSlope(next).first) >= -kTouchTolerance) continue;
    const SurfaceFoot foot = surface.foot(way.at(when));
    if (foot.exists && face.domain.contains(foot.parameters)) {
      meet(when, foot);
      return;
    }
  }
}

void meetFaceNear(const CadFace& face, const CadElement& triangle, const Meeting& coarse, const Way& way, double radius,
                  Meeting& best) {
  const Geom_Surface& surface = *face.surface;
  const Vector2 extent = 2 * parameterExtent(triangle);
  Vector2 at = parametersOf(triangle, coarse.point);
  const auto meet = [&](double when) {
    const SurfacePoint s = evaluate(surface, at);
    Vector3 normal = s.u.cross(s.v);
    normal = normal.norm() > 0 ? Vector3(normal.normalized() * (face.reversed ? -1 : 1)) : Vector3::Zero();
    keep(best, when, s.point, normal);
  };
  if (coarse.when < 0) {
    Vector2 nearest = at;
    if (projectOntoSurface(surface, way.start, extent, nearest)) {
      const double gap = (way.start - evaluate(surface, nearest).point).norm() - radius;
      if (gap < -kTouchTolerance && gap < best.when && face.domain.contains(nearest)) {
        at = nearest;
        return meet(gap);
      }
    }
  }
  // The grown triangle is met a little early; the triangle itself, where it is met at all, gives the better start.
  Meeting middle;
  sweepTriangle(way, radius, triangle.corners, middle);
  if (middle.found()) at = parametersOf(triangle, middle.point);
  const double begin = std::max(0.0, middle.found() ? middle.when : coarse.when);
  const Vector2 seed = at;
  double when = begin;
  bool settled = solveSurfaceTouch(surface, way, radius, extent, at, when);
  const auto approaches = [&] { return (way.at(when) - evaluate(surface, at).point).dot(way.direction) < 0; };
  if (!settled || !approaches()) {
    // Walk up to the surface: slower, but never past the first contact.
    at = seed;
    when = std::max(0.0, coarse.when);
    settled = false;
    for (int i = 0; i < 200 && !settled && when <= way.length; ++i) {
      if (!projectOntoSurface(surface, way.at(when), extent, at)) return;
      const double gap = (way.at(when) - evaluate(surface, at).point).norm() - radius;
      settled = std::abs(gap) < 1e-9;
      when += gap;
    }
    if (!settled || !approaches()) return;
  }
  if (when < -1e-7 || when > way.length || when >= best.when || !face.domain.contains(at)) return;
  // A ball that touches at the start within the tolerance and would graze only has nothing to meet.
  if (std::abs((way.at(when) - evaluate(surface, at).point).norm() - radius) > 1e-7) return;
  Vector2 later = at;
  const double end = std::min(way.length, std::max(when, 0.0) + 1e-3 * radius);
  if (projectOntoSurface(surface, way.at(end), extent, later) &&
      (way.at(end) - evaluate(surface, later).point).norm() - radius >= -kTouchTolerance) {
    return;
  }
  meet(std::max(0.0, when));
}

void meetSimpleEdge(const CadEdge& edge, const Way& way, double radius, Meeting& best) {
  if (edge.kind == CadEdge::Kind::Line) {
    sweepSegment(way, radius, edge.start, edge.end, best);
    return;
  }
  meetCircle(edge, way, radius, best);
  sweepPoint(way, radius, edge.start, best);
  sweepPoint(way, radius, edge.end, best);
}

void meetEdgeNear(const CadEdge& edge, const CadElement& chord, const Meeting& coarse, const Way& way, double radius,
                  Meeting& best) {
  sweepPoint(way, radius, chord.corners[0], best);
  sweepPoint(way, radius, chord.corners[1], best);
  const double low = chord.parameters[0].x();
  const double high = chord.parameters[1].x();
  const double extent = high - low;
  const Vector3 line = chord.corners[1] - chord.corners[0];
  const double share = std::clamp(line.dot(coarse.point - chord.corners[0]) / line.squaredNorm(), 0.0, 1.0);
  double at = low + share * extent;
  const auto evaluateCurve = [&](double t) {
    gp_Pnt p;
    gp_Vec d1, d2;
    edge.curve->D2(t, p, d1, d2);
    return std::array<Vector3, 3>{vector(p), vector(d1), vector(d2)};
  };
  const auto onChord = [&](double t) {
    return t >= low - 0.01 * extent && t <= high + 0.01 * extent && t >= edge.first && t <= edge.last;
  };
  const auto project = [&](const Vector3& p, double& t) {
    for (int i = 0; i < 30; ++i) {
      const auto [c, d1, d2] = evaluateCurve(t);
      const Vector3 w = p - c;
      double curvature = d1.squaredNorm() - w.dot(d2);
      if (curvature <= 0) curvature = d1.squaredNorm();
      if (curvature <= 0) return false;
      const double step = std::clamp(w.dot(d1) / curvature, -extent, extent);
      t += step;
      if (std::abs(step) * d1.norm() < 1e-11) return true;
    }
    return false;
  };
  const auto distance = [&](const Vector3& p, double t) { return (p - evaluateCurve(t)[0]).norm(); };
  if (coarse.when < 0) {
    double t = at;
    if (project(way.start, t) && onChord(t)) {
      const double gap = distance(way.start, t) - radius;
      if (gap < -kTouchTolerance) return keep(best, gap, evaluateCurve(t)[0], Vector3::Zero());
    }
  }
  double when = std::max(0.0, coarse.when);
  bool settled = false;
  for (int i = 0; i < 25 && !settled; ++i) {
    const auto [c, d1, d2] = evaluateCurve(at);
    const Vector3 w = way.at(when) - c;
    const Vector2 f(w.dot(d1), (w.squaredNorm() - radius * radius) / (2 * radius));
    Eigen::Matrix2d jacobian;
    jacobian << w.dot(d2) - d1.squaredNorm(), way.direction.dot(d1), -w.dot(d1) / radius, way.direction.dot(w) / radius;
    if (std::abs(jacobian.determinant()) < 1e-300) break;
    const Vector2 step = -jacobian.inverse() * f;
    const double scale =
        std::min({1.0, extent / std::max(std::abs(step.x()), 1e-300), radius / std::max(std::abs(step.y()), 1e-300)});
    at += scale * step.x();
    when += scale * step.y();
    settled = std::abs(step.y()) < 1e-12 && std::abs(step.x()) * d1.norm() < 1e-9;
  }
  if (!settled || !onChord(at) || when < -1e-7 || when > way.length || when >= best.when) return;
  const Vector3 touch = evaluateCurve(at)[0];
  if ((way.at(when) - touch).dot(way.direction) >= 0) return;
  const double end = std::min(way.length, std::max(when, 0.0) + 1e-3 * radius);
  double later = at;
  if (project(way.at(end), later) && distance(way.at(end), later) - radius >= -kTouchTolerance) return;
  keep(best, std::max(0.0, when), touch, Vector3::Zero());
}

}  // namespace probewright::simulation
