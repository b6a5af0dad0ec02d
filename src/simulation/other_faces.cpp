#include "simulation/other_faces.hpp"

#include <BRep_Builder.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <algorithm>
#include <cmath>

#include "simulation/cad_face.hpp"
#include "simulation/cad_solid.hpp"

namespace probewright::simulation {

bool sameSurface(const AnalyticSurface& a, const AnalyticSurface& b) {
  if (a.kind != b.kind || a.farSheet != b.farSheet) return false;
  constexpr double near = 1e-6;
  if (std::abs(std::abs(a.radius) - std::abs(b.radius)) > near && a.kind != AnalyticSurface::Kind::Cone) return false;
  const Vector3 axisA = a.axes.col(2), axisB = b.axes.col(2), apart = b.origin - a.origin;
  const bool parallel = axisA.cross(axisB).norm() < 1e-9;
  switch (a.kind) {
    case AnalyticSurface::Kind::Plane:
      return parallel && std::abs(apart.dot(axisA)) < near;
    case AnalyticSurface::Kind::Cylinder:
      return parallel && apart.cross(axisA).norm() < near;
    case AnalyticSurface::Kind::Sphere:
      return apart.norm() < near;
    case AnalyticSurface::Kind::Torus:
      return parallel && apart.norm() < near && std::abs(a.tubeRadius - b.tubeRadius) < near;
    case AnalyticSurface::Kind::Cone:
      return parallel && apart.norm() < near && std::abs(std::abs(a.radius) - std::abs(b.radius)) < near &&
             std::abs(std::abs(a.coneSine) - std::abs(b.coneSine)) < 1e-9;
  }
  return false;
}

std::shared_ptr<const Solid> otherFaces(const Solid& solid, const AnalyticSurface& face) {
  const auto* cad = dynamic_cast<const CadSolid*>(&solid);
  if (cad == nullptr) return nullptr;
  TopoDS_Compound rest;
  BRep_Builder builder;
  builder.MakeCompound(rest);
  bool any = false;
  for (TopExp_Explorer each(cad->shape(), TopAbs_FACE); each.More(); each.Next()) {
    const CadFace read = cadFace(TopoDS::Face(each.Current()));
    const auto isIt = [&](const AnalyticSurface& form) { return sameSurface(form, face); };
    if (std::any_of(read.forms.begin(), read.forms.end(), isIt)) continue;
    builder.Add(rest, each.Current());
    any = true;
  }
  if (!any) return nullptr;
  auto skin = cadSolid(rest);
  if (!skin) return nullptr;
  return *std::move(skin);
}

}  // namespace probewright::simulation
