#include "simulation/analytic_surface.hpp"

#include <algorithm>
#include <cmath>

namespace probewright::simulation {
namespace {

/// The squared distance of start + x * direction from the axis (or from the origin), as a polynomial in x.
std::array<double, 3> squaredNorm(const Vector3& start, const Vector3& direction) {
  return {start.squaredNorm(), 2 * start.dot(direction), direction.squaredNorm()};
}

}  // namespace

Roots circleDistanceRoots(const Vector3& localStart, const Vector3& localDirection, double length, double circleRadius,
                          double distance) {
  // (rho^2 + z^2 + R^2 - k^2)^2 = 4 R^2 rho^2, counted from the place nearest to the centre for the sake of rounding.
  const double middle = std::clamp(-localStart.dot(localDirection), 0.0, length);
  const Vector3 start = localStart + middle * localDirection;
  const Vector3 flatStart(start.x(), start.y(), 0);
  const Vector3 flatDirection(localDirection.x(), localDirection.y(), 0);
  const auto all = squaredNorm(start, localDirection);
  const auto flat = squaredNorm(flatStart, flatDirection);
  const double constant = all[0] + circleRadius * circleRadius - distance * distance;
  const double four = 4 * circleRadius * circleRadius;
  const std::array<double, 5> c{constant * constant - four * flat[0], 2 * constant * all[1] - four * flat[1],
                                all[1] * all[1] + 2 * constant * all[2] - four * flat[2], 2 * all[1] * all[2],
                                all[2] * all[2]};
  Roots roots = realRoots(c, -middle, length - middle);
  for (std::size_t i = 0; i < roots.count; ++i)
    roots.values[i] += middle;
  return roots;
}

struct AnalyticSurface::Local {
  Vector3 place;                      ///< of the point
  double rho = 0;                     ///< its distance from the axis
  Vector3 outward = Vector3::Zero();  ///< unit, from the axis to it
  double signedDistance = 0;
  Vector3 normal = Vector3::UnitZ();
};

AnalyticSurface::Local AnalyticSurface::inOwnFrame(const Vector3& p) const {
  Local local;
  local.place = axes.transpose() * (p - origin);
  const Vector3& q = local.place;
  if (kind == Kind::Plane) {
    local.signedDistance = q.z();
    return local;
  }
  local.rho = std::sqrt(q.x() * q.x() + q.y() * q.y());
  local.outward = local.rho > 0 ? Vector3(q.x() / local.rho, q.y() / local.rho, 0) : Vector3::UnitX();
  switch (kind) {
    case Kind::Plane:
      break;
    case Kind::Cylinder:
      local.normal = local.outward;
      local.signedDistance = local.rho - radius;
      break;
    case Kind::Cone:
      local.normal = coneCosine * local.outward - coneSine * Vector3::UnitZ();
      local.signedDistance = (local.rho - radius) * coneCosine - q.z() * coneSine;
      break;
    case Kind::Sphere: {
      const double distance = q.norm();
      local.normal = distance > 0 ? Vector3(q / distance) : Vector3::UnitX();
      local.signedDistance = distance - radius;
      break;
    }
    case Kind::Torus: {
      const Vector3 arm = q - radius * local.outward;
      const double distance = arm.norm();
      const double side = farSheet ? -1 : 1;
      local.normal = side * (distance > 0 ? Vector3(arm / distance) : local.outward);
      local.signedDistance = side * (distance - tubeRadius);
      break;
    }
  }
  return local;
}

SurfaceHeight AnalyticSurface::height(const Vector3& p) const {
  const Local local = inOwnFrame(p);
  return {local.signedDistance, axes * local.normal};
}

SurfaceFoot AnalyticSurface::foot(const Vector3& p) const {
  const Local local = inOwnFrame(p);
  const Vector3& q = local.place;
  // The formula of the far sheet counts its azimuth from the other side of the axis.
  const double side = farSheet ? -1 : 1;
  const auto azimuth = [&] { return std::atan2(side * local.outward.y(), side * local.outward.x()); };
  SurfaceFoot foot;
  foot.exists = true;
  switch (kind) {
    case Kind::Plane:
      foot.parameters = {q.x(), q.y()};
      break;
    case Kind::Cylinder:
      foot.parameters = {azimuth(), q.z()};
      break;
    case Kind::Cone: {
      const double along = (local.rho - radius) * coneSine + q.z() * coneCosine;
      foot.exists = radius + along * coneSine >= 0;
      foot.parameters = {azimuth(), along};
      break;
    }
    case Kind::Sphere:
      foot.parameters = {azimuth(), std::atan2(q.z(), local.rho)};
      break;
    case Kind::Torus:
      foot.exists = radius + tubeRadius * side * local.normal.dot(local.outward) >= 0;
      foot.parameters = {azimuth(), std::atan2(q.z(), side * (local.rho - radius))};
      break;
  }
  foot.signedDistance = local.signedDistance;
  foot.normal = axes * local.normal;
  foot.point = p - foot.signedDistance * foot.normal;
  return foot;
}

bool AnalyticSurface::reachesFarSheet(double lowV, double highV) const {
  if (kind == Kind::Torus) return tubeRadius > radius;
  return kind == Kind::Cone && std::min(radius + lowV * coneSine, radius + highV * coneSine) < 0;
}

bool AnalyticSurface::reachesNearSheet(double lowV, double highV) const {
  return kind != Kind::Cone || std::max(radius + lowV * coneSine, radius + highV * coneSine) >= 0;
}

AnalyticSurface AnalyticSurface::otherSheet() const {
  AnalyticSurface other = *this;
  other.radius = -radius;
  other.coneSine = -coneSine;
  other.farSheet = !farSheet;
  return other;
}

AnalyticSurface::Touches AnalyticSurface::touches(const Way& way, double ballRadius) const {
  const Vector3 start = axes.transpose() * (way.start - origin);
  const Vector3 direction = axes.transpose() * way.direction;
  Touches touches;
  const auto add = [&](double when) { touches.values[touches.count++] = when; };
  const auto addRoots = [&](const std::array<double, 5>& c, double offset) {
    for (const double root : realRoots(c, -offset, way.length - offset))
      add(root + offset);
  };
  for (const double side : {1.0, -1.0}) {
    const double grown = radius + side * ballRadius;
    switch (kind) {
      case Kind::Plane:
        addRoots({start.z() - side * ballRadius, direction.z(), 0, 0, 0}, 0);
        break;
      case Kind::Cylinder:
      case Kind::Sphere: {
        if (grown <= 0) break;
        const Vector3 keep(1, 1, kind == Kind::Sphere ? 1 : 0);
        const Vector3 across = direction.cwiseProduct(keep);
        if (across.squaredNorm() < 1e-24) break;
        const double offset = std::clamp(-start.cwiseProduct(keep).dot(across) / across.squaredNorm(), 0.0, way.length);
        const auto c = squaredNorm((start + offset * direction).cwiseProduct(keep), across);
        addRoots({c[0] - grown * grown, c[1], c[2], 0, 0}, offset);
        break;
      }
      case Kind::Cone: {
        // rho cos = (R cos + z sin) +- r, squared; the side on which the right is negative is the other nappe's.
        const double offset = std::clamp(-start.dot(direction), 0.0, way.length);
        const Vector3 from = start + offset * direction;
        const auto flat = squaredNorm(Vector3(from.x(), from.y(), 0), Vector3(direction.x(), direction.y(), 0));
        const double cc = coneCosine * coneCosine;
        const double g0 = radius * coneCosine + from.z() * coneSine + side * ballRadius;
        const double g1 = direction.z() * coneSine;
        addRoots({cc * flat[0] - g0 * g0, cc * flat[1] - 2 * g0 * g1, cc * flat[2] - g1 * g1, 0, 0}, offset);
        break;
      }
      case Kind::Torus: {
        const double tube = tubeRadius + side * ballRadius;
        if (tube <= 0) break;
        for (const double root : circleDistanceRoots(start, direction, way.length, radius, tube))
          add(root);
        break;
      }
    }
  }
  std::sort(touches.values.begin(), touches.values.begin() + static_cast<std::ptrdiff_t>(touches.count));
  return touches;
}

}  // namespace probewright::simulation
