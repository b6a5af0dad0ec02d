#include "simulation/cad_kinks.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeUpgrade_ShapeDivideContinuity.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "simulation/cad_face.hpp"

namespace probewright::simulation {
namespace {

/// The normal of a surface; nothing where it has none.
gp_Vec normalAt(const BRepAdaptor_Surface& surface, double u, double v) {
  gp_Pnt place;
  gp_Vec alongU, alongV;
  surface.D1(u, v, place, alongU, alongV);
  const gp_Vec normal = alongU.Crossed(alongV);
  return normal.Magnitude() > 1e-12 ? normal.Normalized() : gp_Vec(0, 0, 0);
}

/// The parameter along which one goes across.
enum class Across : std::uint8_t { U, V };

/// True if the normal of the surface jumps where its parameter across is `at`. Many surfaces are smooth although their
/// splines need not be: a rational circle of four quarters.
bool isKink(const BRepAdaptor_Surface& surface, Across across, double at) {
  const bool acrossU = across == Across::U;
  constexpr int kPlaces = 12;
  constexpr double kVisible = 1e-3;  // rad
  const double low = acrossU ? surface.FirstVParameter() : surface.FirstUParameter();
  const double high = acrossU ? surface.LastVParameter() : surface.LastUParameter();
  const double step = 1e-7 * (acrossU ? surface.LastUParameter() - surface.FirstUParameter()
                                      : surface.LastVParameter() - surface.FirstVParameter());
  for (int i = 0; i < kPlaces; ++i) {
    const double along = low + (high - low) * (i + 0.5) / kPlaces;
    const gp_Vec before = acrossU ? normalAt(surface, at - step, along) : normalAt(surface, along, at - step);
    const gp_Vec after = acrossU ? normalAt(surface, at + step, along) : normalAt(surface, along, at + step);
    if ((after - before).Magnitude() > kVisible) return true;
  }
  return false;
}

bool hasKinks(const BRepAdaptor_Surface& surface, Across across) {
  const bool acrossU = across == Across::U;
  const int count = acrossU ? surface.NbUIntervals(GeomAbs_C1) : surface.NbVIntervals(GeomAbs_C1);
  if (count < 2) return false;
  TColStd_Array1OfReal bounds(1, count + 1);
  acrossU ? surface.UIntervals(bounds, GeomAbs_C1) : surface.VIntervals(bounds, GeomAbs_C1);
  for (int i = 2; i < bounds.Length(); ++i) {
    if (isKink(surface, across, bounds(i))) return true;
  }
  return false;
}

bool hasKinks(const TopoDS_Face& face) {
  const BRepAdaptor_Surface surface(face);
  switch (surface.GetType()) {
    case GeomAbs_BSplineSurface:
    case GeomAbs_SurfaceOfRevolution:
    case GeomAbs_SurfaceOfExtrusion:
      return hasKinks(surface, Across::U) || hasKinks(surface, Across::V);
    default:
      return false;
  }
}

/// Parameters at both sides of each edge of a face.
std::vector<Vector2> placesBesideEdges(const TopoDS_Face& face, const Vector2& size) {
  constexpr double kBeside = 1e-4;
  std::vector<Vector2> places;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    double first = 0, last = 0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(TopoDS::Edge(edges.Current()), face, first, last);
    if (curve.IsNull()) continue;
    for (const double share : {0.21, 0.5, 0.83}) {
      gp_Pnt2d place;
      gp_Vec2d along;
      curve->D1(first + share * (last - first), place, along);
      Vector2 aside = Vector2(-along.Y(), along.X()).cwiseQuotient(size);
      if (!(aside.norm() > 0)) continue;
      aside = kBeside * aside.normalized().cwiseProduct(size);
      const Vector2 on(place.X(), place.Y());
      places.emplace_back(on + aside);
      places.emplace_back(on - aside);
    }
  }
  return places;
}

/// True if the pieces of a face cover what it covers, and each place once.
bool isCutWell(const TopoDS_Face& whole, const TopoDS_Shape& cut) {
  const CadFace face = cadFace(whole);
  std::vector<CadFace> pieces;
  double area = 0;
  for (TopExp_Explorer found(cut, TopAbs_FACE); found.More(); found.Next()) {
    pieces.push_back(cadFace(TopoDS::Face(found.Current())));
    area += pieces.back().domain.area();
  }
  if (face.domain.isEverywhere()) return true;
  constexpr double kSameArea = 1e-4;
  if (std::abs(area - face.domain.area()) > kSameArea * face.domain.area()) return false;
  const Vector2 size = face.domain.high() - face.domain.low();
  // A piece may lie some periods away.
  const auto shifts = [](bool isPeriodic, double period) {
    return isPeriodic ? std::vector<double>{0, period, -period, 2 * period, -2 * period} : std::vector<double>{0};
  };
  const bool periodicU = face.surface->IsUPeriodic(), periodicV = face.surface->IsVPeriodic();
  const std::vector<double> alongU = shifts(periodicU, periodicU ? face.surface->UPeriod() : 0);
  const std::vector<double> alongV = shifts(periodicV, periodicV ? face.surface->VPeriod() : 0);
  const auto lies = [&](const CadFace& piece, const Vector2& p) {
    return std::ranges::any_of(alongU, [&](double u) {
      return std::ranges::any_of(alongV, [&](double v) { return piece.domain.contains(p + Vector2(u, v)); });
    });
  };
  const std::vector<Vector2> places = placesBesideEdges(TopoDS::Face(whole.Oriented(TopAbs_FORWARD)), size);
  return std::ranges::all_of(places, [&](const Vector2& p) {
    const auto count = std::ranges::count_if(pieces, [&](const CadFace& piece) { return lies(piece, p); });
    return count == (face.domain.contains(p) ? 1 : 0);
  });
}

}  // namespace

TopoDS_Shape withoutKinks(const TopoDS_Shape& shape) {
  std::vector<TopoDS_Face> kinked;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
    if (hasKinks(TopoDS::Face(faces.Current()))) kinked.push_back(TopoDS::Face(faces.Current()));
  }
  if (kinked.empty()) return shape;
  ShapeUpgrade_ShapeDivideContinuity divide(shape);
  divide.SetSurfaceCriterion(GeomAbs_C1);
  divide.SetBoundaryCriterion(GeomAbs_C0);
  divide.SetPCurveCriterion(GeomAbs_C0);
  divide.Perform();
  if (divide.Result().IsNull()) return shape;
  const Handle(ShapeBuild_ReShape) made = divide.GetContext();
  const bool isWell =
      std::ranges::all_of(kinked, [&](const TopoDS_Face& face) { return isCutWell(face, made->Apply(face)); });
  return isWell ? divide.Result() : shape;
}

}  // namespace probewright::simulation
