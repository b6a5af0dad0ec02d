#pragma once

#include "simulation/cad_model.hpp"

/// Triangles of a face as fine as a contact needs them, made where something comes near.
namespace probewright::simulation {

namespace detail {

inline constexpr int kMostHalvings = 6;

template <class IsNear, class Visit>
void visitFinely(const CadElement& element, const Geom_Surface& surface, double deflection, int halvings,
                 const IsNear& isNear, const Visit& visit) {
  // The samples may miss the place where the surface leaves the triangle most.
  constexpr double kSafety = 1.5;
  const double deviation = deviationOf(element, surface);
  if (!isNear(element.corners, kSafety * deviation)) return;
  if (deviation <= deflection || halvings == kMostHalvings) return visit(element.corners);
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
    visitFinely(part, surface, deflection, halvings + 1, isNear, visit);
  }
}

}  // namespace detail

/// Calls `visit(triangle)` for triangles that stand for the element, a triangle of a face, and leave the face by at
/// most the deflection of the model. `isNear(triangle, growth)` rules out what matters to nobody: the surface lies
/// within `growth` of the triangle.
template <class IsNear, class Visit>
void visitFinely(const CadModel& model, const CadElement& element, const IsNear& isNear, const Visit& visit) {
  const CadFace& face = model.faces[element.owner];
  if (face.forms.isPlane()) return visit(element.corners);
  if (isNear(element.corners, element.growth))
    detail::visitFinely(element, *face.surface, model.deflection, 0, isNear, visit);
}

}  // namespace probewright::simulation
