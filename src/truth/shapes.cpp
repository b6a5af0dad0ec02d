#include "truth/shapes.hpp"

#include <algorithm>
#include <cmath>

#include "metrology/fits.hpp"

namespace probewright::truth {

using records::TruthBasis;
using simulation::AnalyticSurface;

namespace {

std::vector<Vector3> pointsOf(const Touches& touches, Vector3 TouchedPoint::*member) {
  std::vector<Vector3> points;
  points.reserve(touches.size());
  for (const TouchedPoint* touch : touches)
    points.push_back(touch->*member);
  return points;
}

std::optional<Round> roundThrough(const std::vector<Vector3>& points, RoundShape shape) {
  if (shape == RoundShape::Sphere) {
    const auto fit = metrology::fitSphere(points);
    if (!fit) return std::nullopt;
    return Round{fit->shape.centre, 2 * fit->shape.radius};
  }
  const auto fit = metrology::fitCircleInPlane(points, Vector3::UnitZ());
  if (!fit) return std::nullopt;
  return Round{fit->shape.centre, 2 * fit->shape.radius};
}

bool onOneFace(const Touches& touches) {
  return std::ranges::all_of(touches, [&](const TouchedPoint* touch) { return sameFace(*touches.front(), *touch); });
}

/// Where the axis of a round face is at a height, and how wide the face is there.
std::optional<Round> sectionOf(const AnalyticSurface& face, double height) {
  const Vector3 axis = face.axes.col(2);
  if (std::abs(axis.z()) < 0.1) return std::nullopt;
  const double along = (height - face.origin.z()) / axis.z();
  const Vector3 centre = face.origin + along * axis;
  switch (face.kind) {
    case AnalyticSurface::Kind::Cylinder:
      return Round{centre, 2 * std::abs(face.radius)};
    case AnalyticSurface::Kind::Cone:
      return Round{centre, 2 * std::abs(face.radius + along * face.coneSine / face.coneCosine)};
    case AnalyticSurface::Kind::Plane:
    case AnalyticSurface::Kind::Sphere:
    case AnalyticSurface::Kind::Torus:
      break;
  }
  return std::nullopt;
}

std::optional<Round> exactRound(const AnalyticSurface& face, double height, RoundShape shape) {
  if (face.kind != AnalyticSurface::Kind::Sphere)
    return shape == RoundShape::Sphere ? std::nullopt : sectionOf(face, height);
  if (shape == RoundShape::Sphere) return Round{face.origin, 2 * face.radius};
  const double above = height - face.origin.z();
  const double squared = face.radius * face.radius - above * above;
  if (!(squared > 0)) return std::nullopt;
  return Round{{face.origin.x(), face.origin.y(), height}, 2 * std::sqrt(squared)};
}

/// How much the ball's radius adds to the radius of a circle of ball centres: more in holes, less around studs.
double beyondBalls(const Touches& touches, const Vector3& centre) {
  double sum = 0;
  for (const TouchedPoint* touch : touches) {
    const Vector3 outward = touch->surface - touch->ball;
    const bool hole = outward.dot(touch->ball - centre) > 0;
    sum += hole ? outward.norm() : -outward.norm();
  }
  return sum / static_cast<double>(touches.size());
}

}  // namespace

Vector3 meanOf(const Touches& touches, Vector3 TouchedPoint::*member) {
  Vector3 sum = Vector3::Zero();
  for (const TouchedPoint* touch : touches)
    sum += touch->*member;
  return sum / static_cast<double>(touches.size());
}

std::vector<Round> believedRounds(const Touches& touches, RoundShape shape) {
  std::vector<Round> rounds;
  if (const auto surface = roundThrough(pointsOf(touches, &TouchedPoint::surface), shape)) rounds.push_back(*surface);
  if (auto balls = roundThrough(pointsOf(touches, &TouchedPoint::ball), shape)) {
    balls->diameter += 2 * beyondBalls(touches, balls->centre);
    rounds.push_back(*balls);
  }
  return rounds;
}

std::optional<TrueRound> trueRound(const Touches& touches, RoundShape shape) {
  if (touches.empty()) return std::nullopt;
  if (onOneFace(touches)) {
    const AnalyticSurface& face = *touches.front()->face;
    if (const auto exact = exactRound(face, meanOf(touches, &TouchedPoint::point).z(), shape))
      return TrueRound{*exact, {TruthBasis::Face, nameOf(face.kind)}};
  }
  const auto fitted = roundThrough(pointsOf(touches, &TouchedPoint::point), shape);
  if (!fitted) return std::nullopt;
  return TrueRound{*fitted, {TruthBasis::Points, {}}};
}

std::optional<TrueFlat> trueFlat(const Touches& touches) {
  if (touches.empty()) return std::nullopt;
  const TouchedPoint& first = *touches.front();
  const Vector3 outward = meanOf(touches, &TouchedPoint::normal);
  if (onOneFace(touches) && first.face->kind == AnalyticSurface::Kind::Plane)
    return TrueFlat{{first.point, first.normal}, {TruthBasis::Face, "plane"}};
  Plane plane{meanOf(touches, &TouchedPoint::point), outward};
  if (touches.size() >= 3) {
    if (const auto fit = metrology::fitPlane(pointsOf(touches, &TouchedPoint::point))) plane.normal = fit->shape.normal;
  } else if (touches.size() == 2) {
    plane.normal = (touches[1]->point - first.point).cross(Vector3::UnitZ());
  }
  if (!(plane.normal.norm() > 1e-9)) return std::nullopt;
  plane.normal.normalize();
  if (plane.normal.dot(outward) < 0) plane.normal = -plane.normal;
  return TrueFlat{plane, {TruthBasis::Points, {}}};
}

std::vector<Plane> believedFlats(const Touches& touches) {
  std::vector<Plane> flats;
  const Vector3 against = -meanOf(touches, &TouchedPoint::direction);
  for (const auto member : {&TouchedPoint::surface, &TouchedPoint::ball}) {
    Plane plane{meanOf(touches, member), against};
    if (touches.size() >= 3) {
      if (const auto fit = metrology::fitPlane(pointsOf(touches, member))) plane.normal = fit->shape.normal;
    } else if (touches.size() == 2) {
      plane.normal = (touches[1]->*member - touches[0]->*member).cross(Vector3::UnitZ());
    }
    if (!(plane.normal.norm() > 1e-9)) continue;
    plane.normal.normalize();
    if (plane.normal.dot(against) < 0) plane.normal = -plane.normal;
    if (member == &TouchedPoint::ball)
      plane.point -= plane.normal * (touches.front()->surface - touches.front()->ball).norm();
    flats.push_back(plane);
  }
  return flats;
}

std::optional<double> distanceToFace(const TouchedPoint& touched, const Vector3& from, const Vector3& axis) {
  const double slope = touched.normal.dot(axis);
  if (std::abs(slope) < 0.05) return std::nullopt;
  // On the plane that touches; from there Newton's method finds any closed form.
  double distance = (touched.point - from).dot(touched.normal) / slope;
  if (!touched.face) return distance;
  for (int i = 0; i < 20; ++i) {
    const simulation::SurfaceHeight height = touched.face->height(from + distance * axis);
    const double rise = height.normal.dot(axis);
    if (std::abs(rise) < 0.05) return std::nullopt;
    const double step = height.signedDistance / rise;
    distance -= step;
    if (std::abs(step) < 1e-12) break;
  }
  return distance;
}

std::vector<Touches> byDirection(const Touches& touches) {
  std::vector<Touches> groups;
  for (const TouchedPoint* touch : touches) {
    const auto same = std::ranges::find_if(
        groups, [&](const Touches& group) { return group.front()->direction.dot(touch->direction) > 0.9; });
    if (same != groups.end())
      same->push_back(touch);
    else
      groups.push_back({touch});
  }
  return groups;
}

std::vector<Touches> byRoundFace(const Touches& touches) {
  std::vector<Touches> groups;
  for (const TouchedPoint* touch : touches) {
    if (!touch->face || touch->face->kind == AnalyticSurface::Kind::Plane) continue;
    const auto same =
        std::ranges::find_if(groups, [&](const Touches& group) { return sameFace(*group.front(), *touch); });
    if (same != groups.end())
      same->push_back(touch);
    else
      groups.push_back({touch});
  }
  return groups;
}

}  // namespace probewright::truth
