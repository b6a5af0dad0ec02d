#include "simulation/touch_proof.hpp"

#include <algorithm>
#include <cmath>

namespace probewright::simulation {

Form formAbout(const SurfacePoint& s, const SurfaceBends& b, const Shift& shift, const Vector3& w, double longest,
               const Vector3& direction, const Vector3& without) {
  const Vector2& h = shift.half;
  const Vector3 u = s.u - without * without.dot(s.u), v = s.v - without * without.dot(s.v);
  const double sizeU = u.norm(), sizeV = v.norm();
  const double turnU = b.uu * h.x() + b.uv * h.y(), turnV = b.uv * h.x() + b.vv * h.y();
  // How much a slope may change as seen along a vector, by its derivatives there and by what these change by.
  const double more = h.x() * h.x() / 2, mixed = h.x() * h.y(), moreV = h.y() * h.y() / 2;
  const double restU =
      std::min(turnU + s.uu.norm() * h.x() + s.uv.norm() * h.y(), b.uuu * more + b.uuv * mixed + b.uvv * moreV);
  const double restV =
      std::min(turnV + s.uv.norm() * h.x() + s.vv.norm() * h.y(), b.uuv * more + b.uvv * mixed + b.vvv * moreV);
  const auto turn = [&](const Vector3& by, double size, const Vector3& alongU, const Vector3& alongV, double rest) {
    return std::abs(by.dot(alongU)) * h.x() + std::abs(by.dot(alongV)) * h.y() + size * rest;
  };
  const auto bend = [&](const Vector3& here, double most, double slopeU, double slopeV) {
    return shift.along(here, direction) + longest * std::min(2 * most, slopeU * h.x() + slopeV * h.y());
  };
  return {u.dot(u) - w.dot(s.uu) - 2 * turn(u, sizeU, s.uu, s.uv, restU) - bend(s.uu, b.uu, b.uuu, b.uuv),
          std::abs(u.dot(v) - w.dot(s.uv)) + turn(u, sizeU, s.uv, s.vv, restV) + turn(v, sizeV, s.uu, s.uv, restU) +
              turnU * turnV + bend(s.uv, b.uv, b.uuv, b.uvv),
          v.dot(v) - w.dot(s.vv) - 2 * turn(v, sizeV, s.uv, s.vv, restV) - bend(s.vv, b.vv, b.uvv, b.vvv)};
}

bool hasKink(const FreeformSurface& surface, const ParameterBox& box) {
  return surface.kinkAcrossU(box.low.x(), box.high.x()) || surface.kinkAcrossV(box.low.y(), box.high.y());
}

bool TouchProof::isClearBefore(const SurfaceTouch& touch, const ParameterBox& part, double soonest) const {
  const ParameterBox box{part.low.cwiseMin(touch.at), part.high.cwiseMax(touch.at)};
  if (!surface_.covers(box.low, box.high)) return false;
  const SurfacePoint s = surface_.at(touch.at);
  const Vector3 normal = (way_.at(touch.when) - s.point) / radius_;
  const double towards = -normal.dot(way_.direction);
  if (!(towards > 0)) return false;
  const auto curving = surface_.curving(box.low, box.high, s.point, normal);
  if (!curving) return false;
  const double share = std::max(0.0, touch.when - soonest) / (2 * radius_ * towards);
  const double weight = surface_.weightAt(touch.at);
  const Vector2 h = (box.low - touch.at).cwiseAbs().cwiseMax((box.high - touch.at).cwiseAbs());
  const double uu = weight * weight * s.u.squaredNorm(), uv = weight * weight * s.u.dot(s.v);
  const double vv = weight * weight * s.v.squaredNorm(), determinant = uu * vv - uv * uv;
  if (!(determinant > 0)) return false;
  // How much of q its first derivatives give at least.
  const double off = (curving->uu * h.x() + curving->uv * h.y()) * std::sqrt(vv / determinant) +
                     (curving->vv * h.y() + curving->uv * h.x()) * std::sqrt(uu / determinant);
  const double straight = std::max(0.0, 1 - off / 2);
  const auto rise = [&](double most) {
    return radius_ * std::max(curving->leastWeight * most, curving->mostWeight * most);
  };
  const auto isBehind = [&](double much) {
    const Form form{much * uu - rise(curving->riseUu), much * std::abs(uv) + rise(curving->riseUv),
                    much * vv - rise(curving->riseVv)};
    return form.uu >= 0 && form.vv >= 0 && form.uu * form.vv >= form.uv * form.uv;
  };
  return isBehind(0) || (share < 1 && straight > 0 && isBehind((1 - share) * straight * straight));
}

bool TouchProof::isOnlyTouch(const SurfaceTouch& touch, const ParameterBox& part, const Times& times) const {
  const Vector2& at = touch.at;
  const double when = touch.when;
  const ParameterBox hull{part.low.cwiseMin(at), part.high.cwiseMax(at)};
  if (!surface_.covers(hull.low, hull.high) || hasKink(surface_, hull)) return false;
  const SurfacePoint s = surface_.at(at);
  SurfaceBends b = surface_.bends(hull.low, hull.high);
  const Vector2 h = (hull.low - at).cwiseAbs().cwiseMax((hull.high - at).cwiseAbs());
  b.narrow(s, h);
  const Vector3 w = way_.at(when) - s.point, &along = way_.direction;
  const Shift shift{s, h, b.fromPlane(h), std::max(when - times.from, times.to - when)};
  const double longest = radius_ + b.u * h.x() + b.v * h.y() + shift.time;
  const Form form = formAbout(s, b, shift, w, longest, along, Vector3::Zero());
  if (!form.isConvex()) return false;
  const double slopeU = std::abs(along.dot(s.u)) + b.uu * h.x() + b.uv * h.y();
  const double slopeV = std::abs(along.dot(s.v)) + b.uv * h.x() + b.vv * h.y();
  if (shift.time * (1 + form.ofInverse(slopeU, slopeV)) < -w.dot(along)) return true;
  return formAbout(s, b, shift, w, longest, along, along).isConvex();
}

}  // namespace probewright::simulation
