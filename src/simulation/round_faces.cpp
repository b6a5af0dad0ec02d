#include "simulation/round_faces.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/cad_model.hpp"
#include "simulation/cad_solid.hpp"

namespace probewright::simulation {

namespace {

bool sameCylinder(const RoundFace& a, const RoundFace& b) {
  constexpr double near = 1e-6;  // mm
  const Vector3 axis = a.form.axes.col(2), apart = b.middle - a.middle;
  return std::abs(a.form.radius - b.form.radius) < near && axis.cross(b.form.axes.col(2)).norm() < 1e-9 &&
         apart.norm() < near;
}

}  // namespace

std::vector<RoundFace> roundFaces(const Solid& solid) {
  std::vector<RoundFace> found;
  const auto* cad = dynamic_cast<const CadSolid*>(&solid);
  if (cad == nullptr) return found;
  for (const CadFace& face : cad->model().faces) {
    if (face.forms.count != 1 || face.forms.sheets[0].kind != AnalyticSurface::Kind::Cylinder) continue;
    if (face.domain.isEverywhere()) continue;
    RoundFace round;
    round.form = face.forms.sheets[0];
    round.hole = face.reversed;
    round.middle = round.form.origin + round.form.axes.col(2) * (face.domain.low().y() + face.domain.high().y()) / 2;
    if (std::ranges::none_of(found, [&](const RoundFace& other) { return sameCylinder(other, round); }))
      found.push_back(round);
  }
  return found;
}

}  // namespace probewright::simulation
