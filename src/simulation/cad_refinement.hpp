#pragma once

#include <algorithm>

#include "simulation/cad_model.hpp"
#include "simulation/quick_surfaces.hpp"

/// Triangles of a face as fine as a contact needs them, made where something comes near.
namespace probewright::simulation {

namespace detail {

inline constexpr int kMostHalvings = 6;

template <class IsNear, class Visit>
void visitParts(CadElement& element, const Adaptor3d_Surface& surface, double limit, double beside, int halvings,
                const IsNear& isNear, const Visit& visit);

/// The quarters of an element, and of them what is near.
template <class IsNear, class Visit>
void visitQuarters(const CadElement& element, const Adaptor3d_Surface& surface, double limit, double beside,
                   int halvings, const IsNear& isNear, const Visit& visit) {
  const auto& [a, b, c] = element.parameters;
  const std::array<Vector2, 6> parameters{a, b, c, (a + b) / 2, (b + c) / 2, (c + a) / 2};
  std::array<Vector3, 6> points{element.corners[0], element.corners[1], element.corners[2]};
  for (std::size_t i = 3; i < 6; ++i) {
    const gp_Pnt p = surface.Value(parameters[i].x(), parameters[i].y());
    points[i] = {p.X(), p.Y(), p.Z()};
  }
  CadElement part = element;
  for (const auto& corners : std::array<std::array<std::size_t, 3>, 4>{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}}) {
    for (std::size_t k = 0; k < 3; ++k) {
      part.parameters[k] = parameters[corners[k]];
      part.corners[k] = points[corners[k]];
    }
    visitParts(part, surface, limit, beside, halvings + 1, isNear, visit);
  }
}

template <class IsNear, class Visit>
void visitParts(CadElement& element, const Adaptor3d_Surface& surface, double limit, double beside, int halvings,
                const IsNear& isNear, const Visit& visit) {
  const double deviation = deviationOf(element, surface);
  element.growth = std::max(kDeviationSafety * deviation, beside);
  if (!isNear(element)) return;
  if (deviation <= limit || halvings == kMostHalvings) return visit(element);
  visitQuarters(element, surface, limit, beside, halvings, isNear, visit);
}

}  // namespace detail

/// Calls `visit(triangle)` for triangles that stand for the element, a triangle of a face, and leave the face by at
/// most the deflection of the model. `isNear(triangle, growth)` rules out what matters to nobody: the surface lies
/// within `growth` of the triangle.
template <class IsNear, class Visit>
void visitFinely(const CadModel& model, const CadElement& element, QuickSurfaces& surfaces, const IsNear& isNear,
                 const Visit& visit) {
  const CadFace& face = model.faces[element.owner];
  if (face.forms.isPlane()) return visit(element.corners);
  if (!isNear(element.corners, element.growth)) return;
  CadElement whole = element;
  detail::visitParts(
      whole, surfaces.of(element.owner), model.deflection, 0, 0,
      [&](const CadElement& part) { return isNear(part.corners, part.growth); },
      [&](const CadElement& part) { visit(part.corners); });
}

/// Calls `visit(part)` for triangles that stand for the element, a triangle of a free-form face, and leave the face by
/// so little that a search for the contact of a ball with the exact surface may begin there. `isNear(part)` rules out
/// parts; the element itself is near.
template <class IsNear, class Visit>
void visitForBall(const CadModel& model, const CadElement& element, QuickSurfaces& surfaces, double radius,
                  const IsNear& isNear, const Visit& visit) {
  // A triangle that is coarse for the ball may hold several touches, and the search finds one of them.
  constexpr double kEnough = 30;  // deflections
  constexpr double kShare = 0.1;  // of the radius
  const double limit = std::min(kEnough * model.deflection, kShare * radius);
  if (element.growth <= kDeviationSafety * limit) return visit(element);
  detail::visitQuarters(element, surfaces.of(element.owner), limit, growthBesideBorders(model.deflection), 0, isNear,
                        visit);
}

}  // namespace probewright::simulation
