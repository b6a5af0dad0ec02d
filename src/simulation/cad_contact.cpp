#include "simulation/cad_contact.hpp"

#include <cmath>

namespace probewright::simulation {
namespace {

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
    if (!goesIn(when, next, gapAndSlope)) continue;
    const auto [gap, slope] = gapAndSlope(when);
    if (slope >= 0 || std::abs(gap) > 1e-7) continue;
    const CircleFoot foot = circleFoot(edge, way.at(when));
    if (foot.parameter <= edge.last) {
      keep(best, when, foot.point, Vector3::Zero());
      return;
    }
  }
}

void meetSheet(const CadFace& face, const AnalyticSurface& surface, const Way& way, double radius, Meeting& best) {
  const double side = (face.reversed ? -1 : 1) * (surface.axes.determinant() < 0 ? -1 : 1);
  const auto gapAndSlope = [&](double when) {
    const auto [distance, normal] = surface.height(way.at(when));
    const double sign = distance < 0 ? -1 : 1;
    return std::pair(std::abs(distance) - radius, sign * normal.dot(way.direction));
  };
  const auto meet = [&](double when, const SurfaceFoot& foot) { keep(best, when, foot.point, side * foot.normal); };
  const double gapAtStart = gapAndSlope(0).first;
  if (gapAtStart < -kTouchTolerance && gapAtStart < best.when) {
    const SurfaceFoot atStart = surface.foot(way.start);
    if (atStart.exists && face.domain.contains(atStart.parameters)) {
      meet(gapAtStart, atStart);
      return;
    }
  }
  AnalyticSurface::Touches found = surface.touches(way, radius);
  // Those of the other sheet fall out.
  AnalyticSurface::Touches touches;
  if (std::abs(gapAtStart) <= kTouchTolerance) touches.values[touches.count++] = 0;
  for (std::size_t i = 0; i < found.count; ++i) {
    const double when = refineTouch(found.values[i], gapAndSlope);
    if (std::abs(gapAndSlope(when).first) <= 1e-7) touches.values[touches.count++] = when;
  }
  for (std::size_t i = 0; i < touches.count; ++i) {
    const double when = touches.values[i];
    if (when < 0 || when > way.length || when >= best.when) continue;
    if (gapAndSlope(when).second >= 0) continue;
    const double next = i + 1 < touches.count ? touches.values[i + 1] : way.length;
    if (!goesIn(when, next, gapAndSlope)) continue;
    const SurfaceFoot foot = surface.foot(way.at(when));
    if (foot.exists && face.domain.contains(foot.parameters)) {
      meet(when, foot);
      return;
    }
  }
}

}  // namespace

void meetAnalyticFace(const CadFace& face, const Way& way, double radius, Meeting& best) {
  for (const AnalyticSurface& sheet : face.forms)
    meetSheet(face, sheet, way, radius, best);
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

}  // namespace probewright::simulation
