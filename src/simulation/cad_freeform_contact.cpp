#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "simulation/ball_on_face.hpp"
#include "simulation/cad_contact.hpp"
#include "simulation/surface_steps.hpp"

namespace probewright::simulation {
namespace {

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

/// One search for the contact of a ball with a free-form face.
class FaceSearch {
public:
  FaceSearch(const CadFace& face, const Way& way, double radius, Meeting& best)
      : surface_(**face.freeform), way_(way), radius_(radius), best_(best), ball_(face, way, radius, best) {}

  /// Looks near one triangle; `coarse` is the meeting with the grown triangle. False if it cannot tell.
  bool near(FaceQuestion& question, const Meeting& coarse) { return settles(question, coarse) || best_.when < 0; }

private:
  /// True if what happens near the triangle is known: a contact, which goes into the best, or none.
  bool settles(FaceQuestion& question, const Meeting& coarse) {
    const CadElement& triangle = question.triangle;
    const Vector2 extent = 2 * parameterExtent(triangle);
    const Vector2 low = triangle.parameters[0].cwiseMin(triangle.parameters[1]).cwiseMin(triangle.parameters[2]);
    const auto isNear = [&](const Vector2& at) {
      return (at - low + 1.5 * extent).minCoeff() >= 0 && (low + 2 * extent - at).minCoeff() >= 0;
    };
    Vector2 at = parametersOf(triangle, coarse.point);
    if (coarse.when < 0 && ball_.meetsAtStart(at, extent)) return true;
    // The grown triangle is met a little early; the triangle itself, where it is met at all, gives the better start.
    Meeting middle;
    sweepTriangle(way_, radius_, triangle.corners, middle);
    if (middle.found()) at = parametersOf(triangle, middle.point);
    const Vector2 seed = at;
    double when = std::max(0.0, middle.found() ? middle.when : coarse.when);
    const auto approaches = [&] { return (way_.at(when) - surface_.at(at).point).dot(way_.direction) < 0; };
    const bool solved = solveSurfaceTouch(surface_, way_, radius_, extent, nullptr, at, when) && approaches();
    if (solved) question.isSolved = true, question.at = at, question.when = when;
    if (solved && isNear(at)) return ball_.accept(when, at);
    // A contact elsewhere counts, too, but this place is still open.
    if (solved) ball_.accept(when, at);
    // Walk up to the surface: slower, but never past the first contact.
    at = seed;
    when = std::max(0.0, coarse.when);
    for (int i = 0; i < 50; ++i) {
      if (!projectOntoSurface(surface_, way_.at(when), extent, at) || !isNear(at)) return false;
      const double gap = ball_.gapAt(when, at);
      if (gap < -1e-6) return false;
      if (std::abs(gap) < 1e-9) {
        if (!approaches()) return true;
        question.isSolved = true, question.at = at, question.when = when;
        return ball_.accept(when, at);
      }
      when += gap;
      if (when > way_.length || when >= best_.when) return true;
    }
    return false;
  }

  const FreeformSurface& surface_;
  const Way& way_;
  double radius_;
  Meeting& best_;
  BallOnFace ball_;
};

}  // namespace

bool meetFaceNear(const CadFace& face, FaceQuestion& question, const Meeting& coarse, const Way& way, double radius,
                  Meeting& best) {
  return FaceSearch(face, way, radius, best).near(question, coarse);
}

}  // namespace probewright::simulation
