#pragma once

#include <algorithm>

#include "simulation/cad_deviation.hpp"
#include "simulation/cad_model.hpp"

/// Triangles of a face as fine as a contact needs them, made where something comes near.
namespace probewright::simulation {

namespace detail {

inline constexpr int kMostHalvings = 6;

/// Calls `use(part)` with the quarters of an element.
template <class Use>
void forQuarters(const CadElement& element, const CadFace& face, const Use& use) {
  const auto& [a, b, c] = element.parameters;
  const std::array<Vector2, 6> parameters{a, b, c, (a + b) / 2, (b + c) / 2, (c + a) / 2};
  std::array<Vector3, 6> points{element.corners[0], element.corners[1], element.corners[2]};
  for (std::size_t i = 3; i < 6; ++i)
    points[i] = face.pointAt(parameters[i]);
  CadElement part = element;
  constexpr std::array<std::array<std::size_t, 3>, 4> kCorners{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};
  constexpr std::array<std::uint8_t, 4> kOuterSides{0b101, 0b011, 0b110, 0};
  for (std::size_t i = 0; i < kCorners.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      part.parameters[k] = parameters[kCorners[i][k]];
      part.corners[k] = points[kCorners[i][k]];
    }
    part.borders = element.borders & kOuterSides[i];
    use(part);
  }
}

/// The face that is looked at, and how closely.
struct Fineness {
  const CadFace& face;
  double limit = 0;  ///< mm, between triangles and face
  double apart = 0;  ///< mm, between the corners and where their parameters are
};

template <class IsNear, class Visit>
void visitParts(CadElement& element, const Fineness& fineness, int halvings, const IsNear& isNear, const Visit& visit) {
  constexpr double kMostSteps = 6;
  const double sampled = deviationOf(element, fineness.face);
  element.growth = kDeviationSafety * sampled;
  if (fineness.face.freeform)
    element.growth = certainDeviation(element, fineness.face, element.growth, fineness.apart, kMostSteps);
  if (!isNear(element)) return;
  if (sampled <= fineness.limit || halvings == kMostHalvings) return visit(element);
  forQuarters(element, fineness.face,
              [&](CadElement& part) { visitParts(part, fineness, halvings + 1, isNear, visit); });
}

/// How parts of an element are found for a ball.
struct ForBall {
  const CadFace& face;
  double limit = 0;   ///< mm, between triangles and face
  double beside = 0;  ///< mm: no part is grown by less
  double apart = 0;   ///< mm, between the corners and where their parameters are
  int mostHalvings = kMostHalvings;
};

template <class IsNear, class Visit, class Doubt>
void visitPartsForBall(CadElement& element, const ForBall& how, int halvings, bool isCovered, const IsNear& isNear,
                       const Visit& visit, const Doubt& doubt) {
  const double sampled = deviationOf(element, how.face);
  element.growth = std::max(kDeviationSafety * sampled, how.beside);
  if (!isCovered && !isCertain(element, how.face, element.growth, how.apart)) {
    doubt(element);
    isCovered = true;
  }
  if (!isNear(element)) return;
  if (sampled <= how.limit || halvings >= how.mostHalvings) return visit(element, isCovered);
  forQuarters(element, how.face,
              [&](CadElement& part) { visitPartsForBall(part, how, halvings + 1, isCovered, isNear, visit, doubt); });
}

}  // namespace detail

/// Calls `visit(triangle)` for triangles that stand for the element, a triangle of a face, and leave the face by at
/// most the deflection of the model. `isNear(triangle, growth)` rules out what matters to nobody: the surface lies
/// within `growth` of the triangle.
template <class IsNear, class Visit>
void visitFinely(const CadModel& model, const CadElement& element, const IsNear& isNear, const Visit& visit) {
  const CadFace& face = model.faces[element.owner];
  if (face.forms.isPlane()) return visit(element.corners);
  if (!isNear(element.corners, element.growth)) return;
  CadElement whole = element;
  const double apart = face.freeform ? cornersApart(element, face) : 0;
  detail::visitParts(
      whole, {face, model.deflection, apart}, 0,
      [&](const CadElement& part) { return isNear(part.corners, part.growth); },
      [&](const CadElement& part) { visit(part.corners); });
}

/// Calls `visit(part, isCovered)` for triangles that stand for the element, a triangle of a free-form face, and leave
/// the face by so little that a search for the contact of a ball with the exact surface may begin there. `isNear(part)`
/// rules out parts; the element itself is near. Where it is not certain that this rules out nothing that counts,
/// `doubt(part)` is called with what has to be looked at as a whole; what is found in it later is covered by that.
/// Not `finely` if there were too many parts already: then only the element's quarters are visited.
template <class IsNear, class Visit, class Doubt>
void visitForBall(const CadModel& model, const CadElement& element, double radius, bool finely, const IsNear& isNear,
                  const Visit& visit, const Doubt& doubt) {
  // A triangle that is coarse for the ball may hold several touches, and the search finds one of them.
  constexpr double kEnough = 30;  // deflections
  constexpr double kShare = 0.1;  // of the radius
  const double limit = std::min(kEnough * model.deflection, kShare * radius);
  if (element.growth <= kDeviationSafety * limit) return visit(element, false);
  const CadFace& face = model.faces[element.owner];
  const detail::ForBall how{face, limit, growthBesideBorders(model.deflection), cornersApart(element, face),
                            finely ? detail::kMostHalvings : 1};
  detail::forQuarters(element, face,
                      [&](CadElement& part) { detail::visitPartsForBall(part, how, 1, false, isNear, visit, doubt); });
}

}  // namespace probewright::simulation
