#include "simulation/face_at.hpp"

#include <cmath>
#include <set>

#include "simulation/cad_model.hpp"
#include "simulation/cad_solid.hpp"

namespace probewright::simulation {

namespace {

/// True also where the parameters lie on the border to within rounding: on the seam of a cylinder, for instance.
bool covers(const TrimmedDomain& domain, const Vector2& parameters) {
  constexpr double rounding = 1e-6;
  for (const double u : {0.0, -rounding, rounding})
    for (const double v : {0.0, -rounding, rounding})
      if (domain.contains(parameters + Vector2(u, v))) return true;
  return false;
}

}  // namespace

std::optional<AnalyticSurface> faceAt(const Solid& solid, const Vector3& point, const Vector3& normal) {
  const auto* cad = dynamic_cast<const CadSolid*>(&solid);
  if (cad == nullptr) return std::nullopt;
  constexpr double onSurface = 1e-5;  // mm
  const double turned = std::cos(radiansFromDegrees(0.1));
  const CadModel& model = cad->model();
  // Triangles leave a face by up to ten times the deflection.
  const double reach = 10 * model.deflection;
  const Mover mover{{point - reach * normal, normal, 2 * reach}, reach};
  std::optional<AnalyticSurface> found;
  std::set<std::uint32_t> seen;
  model.tree.visitAll(mover, [&](std::uint32_t place, const Triangle&) {
    const CadElement& element = model.elements[place];
    if (found || element.kind != CadElement::Kind::Face || !seen.insert(element.owner).second) return;
    const CadFace& face = model.faces[element.owner];
    for (const AnalyticSurface& form : face.forms) {
      const SurfaceFoot foot = form.foot(point);
      if (!foot.exists || std::abs(foot.signedDistance) > onSurface) continue;
      if (std::abs(foot.normal.dot(normal)) < turned || !covers(face.domain, foot.parameters)) continue;
      found = form;
    }
  });
  return found;
}

}  // namespace probewright::simulation
