#include "simulation/surface_steps.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "simulation/settling.hpp"

namespace probewright::simulation {

bool projectOntoSurface(const FreeformSurface& surface, const Vector3& p, const Vector2& extent, Vector2& at) {
  Settling settling(1e-11);
  for (int i = 0; i < 30; ++i) {
    const SurfacePoint s = surface.at(at);
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

bool solveSurfaceTouch(const FreeformSurface& surface, const Way& way, double radius, const Vector2& extent,
                       const ParameterBox* within, Vector2& at, double& when) {
  Settling settling(1e-12);
  for (int i = 0; i < 25; ++i) {
    const SurfacePoint s = surface.at(at);
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
    if (within != nullptr && ((at - within->low).minCoeff() < 0 || (within->high - at).minCoeff() < 0)) return false;
    const bool still = settling.after(std::abs(step[2]));
    if (still && (s.u * step.x() + s.v * step.y()).norm() < 1e-9) return true;
  }
  return false;
}

}  // namespace probewright::simulation
