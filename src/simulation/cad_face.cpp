#include "simulation/cad_face.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Cone.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Lin.hxx>
#include <gp_Pln.hxx>
#include <gp_Sphere.hxx>
#include <gp_Torus.hxx>
#include <optional>
#include <stdexcept>

#include "simulation/cad_vectors.hpp"

namespace probewright::simulation {
namespace {

/// A border polygon may leave its edge by this much: the contact of a ball then errs by the square over its diameter.
constexpr double kBorderTolerance = 2e-4;

std::optional<AnalyticSurface> analyticSurface(const BRepAdaptor_Surface& face) {
  AnalyticSurface s;
  gp_Ax3 position;
  switch (face.GetType()) {
    case GeomAbs_Plane:
      s.kind = AnalyticSurface::Kind::Plane;
      position = face.Plane().Position();
      break;
    case GeomAbs_Cylinder:
      s.kind = AnalyticSurface::Kind::Cylinder;
      position = face.Cylinder().Position();
      s.radius = face.Cylinder().Radius();
      break;
    case GeomAbs_Cone:
      s.kind = AnalyticSurface::Kind::Cone;
      position = face.Cone().Position();
      s.radius = face.Cone().RefRadius();
      s.coneSine = std::sin(face.Cone().SemiAngle());
      s.coneCosine = std::cos(face.Cone().SemiAngle());
      break;
    case GeomAbs_Sphere:
      s.kind = AnalyticSurface::Kind::Sphere;
      position = face.Sphere().Position();
      s.radius = face.Sphere().Radius();
      break;
    case GeomAbs_Torus:
      s.kind = AnalyticSurface::Kind::Torus;
      position = face.Torus().Position();
      s.radius = face.Torus().MajorRadius();
      s.tubeRadius = face.Torus().MinorRadius();
      break;
    default:
      return std::nullopt;
  }
  s.origin = vector(position.Location());
  s.axes = axesOf(position);
  return s;
}

ClosedForms closedForms(const BRepAdaptor_Surface& face, const TrimmedDomain& domain) {
  ClosedForms forms;
  const std::optional<AnalyticSurface> surface = analyticSurface(face);
  if (!surface) return forms;
  const double low = domain.isEverywhere() ? -1e9 : domain.low().y();
  const double high = domain.isEverywhere() ? 1e9 : domain.high().y();
  if (surface->reachesNearSheet(low, high)) forms.sheets[forms.count++] = *surface;
  if (surface->reachesFarSheet(low, high)) forms.sheets[forms.count++] = surface->otherSheet();
  return forms;
}

Handle(Geom_Curve) curveWithoutLimits(const Handle(Geom_Curve) & curve) {
  Handle(Geom_Curve) plain = curve;
  while (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(plain))
    plain = trimmed->BasisCurve();
  return plain;
}

/// The ranges of a surface's parameters; of splines, between their ends.
struct ParameterRanges {
  Vector2 low, high;

  explicit ParameterRanges(const Geom_Surface& surface) {
    surface.Bounds(low.x(), high.x(), low.y(), high.y());
    constexpr double kEndless = 2e100;
    if (surface.IsUPeriodic()) low.x() = -kEndless, high.x() = kEndless;
    if (surface.IsVPeriodic()) low.y() = -kEndless, high.y() = kEndless;
  }
  Vector2 nearest(const Vector2& uv) const { return uv.cwiseMax(low).cwiseMin(high); }
};

/// True if an edge runs where its spline goes on beyond its ends, as its own curve in space tells: that of a torus
/// whose circle begins elsewhere than the face.
bool isMeantBeyond(const ParameterRanges& ranges, const TopoDS_Edge& edge, const Geom2d_Curve& parameters, double first,
                   double last, const GeomAdaptor_Surface& surface) {
  double begin = 0, end = 0;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, begin, end);
  if (curve.IsNull() || begin != first || end != last) return false;
  bool isBeyond = false;
  for (const double share : {0.0, 0.21, 0.5, 0.79, 1.0}) {
    const double t = first + share * (last - first);
    const gp_Pnt2d p = parameters.Value(t);
    const Vector2 uv(p.X(), p.Y()), inside = ranges.nearest(uv);
    const gp_Pnt place = curve->Value(t), clamped = surface.Value(inside.x(), inside.y());
    if (uv == inside || clamped.Distance(place) <= kBorderTolerance) continue;
    if (surface.Value(uv.x(), uv.y()).Distance(place) > std::max(kBorderTolerance, BRep_Tool::Tolerance(edge)))
      return false;
    isBeyond = true;
  }
  return isBeyond;
}

/// The points of an edge's parameter curve on a face, in the direction in which the wire runs.
std::vector<Vector2> borderPoints(const TopoDS_Edge& edge, const TopoDS_Face& face, const Geom_Surface& surface,
                                  const GeomAdaptor_Surface& quick) {
  double first = 0;
  double last = 0;
  const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
  std::vector<Vector2> points;
  if (curve.IsNull()) return points;
  // Splines go on beyond their ends, but seldom as anybody meant them to.
  const ParameterRanges ranges(surface);
  const bool beyond = isMeantBeyond(ranges, edge, *curve, first, last, quick);
  const Geom2dAdaptor_Curve quickCurve(curve);
  const auto at = [&](double t) {
    const gp_Pnt2d p = quickCurve.Value(t);
    const Vector2 uv(p.X(), p.Y());
    return beyond ? uv : ranges.nearest(uv);
  };
  Handle(Geom2d_Curve) plain = curve;
  if (const auto trimmed = Handle(Geom2d_TrimmedCurve)::DownCast(plain)) plain = trimmed->BasisCurve();
  points.push_back(at(first));
  if (plain->IsKind(STANDARD_TYPE(Geom2d_Line))) {
    points.push_back(at(last));
  } else {
    const bool flat = surface.IsKind(STANDARD_TYPE(Geom_Plane));
    // Appends points until chords leave the edge by little, by the directions of the surface in their middle.
    const auto follow = [&](const auto& self, double a, double b, const Vector2& to, int halvings) -> void {
      const Vector2 from = points.back(), middle = at((a + b) / 2);
      gp_Vec u(1, 0, 0), v(0, 1, 0);
      gp_Pnt place;
      if (!flat) quick.D1(middle.x(), middle.y(), place, u, v);
      const auto deviates = [&](const Vector2& uv, double part) {
        const Vector2 off = uv - from - part * (to - from);
        return (off.x() * vector(u) + off.y() * vector(v)).norm() > kBorderTolerance;
      };
      if (halvings == 0 || !(deviates(middle, 0.5) || deviates(at(a + 0.3 * (b - a)), 0.3))) {
        points.push_back(to);
      } else {
        self(self, a, (a + b) / 2, middle, halvings - 1);
        self(self, (a + b) / 2, b, to, halvings - 1);
      }
    };
    constexpr int kPieces = 4;
    for (int i = 0; i < kPieces; ++i) {
      const double from = first + (last - first) * i / kPieces, to = first + (last - first) * (i + 1) / kPieces;
      follow(follow, from, to, at(to), 12);
    }
  }
  if (edge.Orientation() == TopAbs_REVERSED) std::reverse(points.begin(), points.end());
  return points;
}

/// The edges of a wire, each with the next at its end.
std::vector<TopoDS_Edge> chainOf(const TopoDS_Wire& wire, const TopoDS_Face& face) {
  std::vector<TopoDS_Edge> all;
  for (TopExp_Explorer edges(wire, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopAbs_Orientation orientation = edges.Current().Orientation();
    if (orientation == TopAbs_FORWARD || orientation == TopAbs_REVERSED) all.push_back(TopoDS::Edge(edges.Current()));
  }
  std::vector<TopoDS_Edge> chain;
  for (BRepTools_WireExplorer edges(wire, face); edges.More(); edges.Next())
    chain.push_back(edges.Current());
  return chain.size() == all.size() ? chain : all;
}

/// The closed polygons of a wire. Most wires are one; where an edge does not begin where the one before ends, the piece
/// that begins nearest goes on.
std::vector<std::vector<Vector2>> loopsOf(std::vector<std::vector<Vector2>> pieces, double tolerance) {
  std::vector<std::vector<Vector2>> loops;
  std::vector<bool> used(pieces.size(), false);
  for (std::size_t first = 0; first < pieces.size(); ++first) {
    if (used[first] || pieces[first].empty()) continue;
    used[first] = true;
    std::vector<Vector2> loop = pieces[first];
    std::size_t last = first;
    for (;;) {
      const Vector2 end = loop.back();
      const auto gap = [&](std::size_t i) { return (pieces[i].front() - end).norm(); };
      std::size_t next = pieces.size();
      if (last + 1 < pieces.size() && !used[last + 1] && !pieces[last + 1].empty() && gap(last + 1) <= tolerance) {
        next = last + 1;
      } else {
        for (std::size_t i = 0; i < pieces.size(); ++i) {
          if (used[i] || pieces[i].empty()) continue;
          if (next == pieces.size() || gap(i) < gap(next)) next = i;
        }
        if (next < pieces.size() && gap(next) > (loop.front() - end).norm()) break;
      }
      if (next == pieces.size()) break;
      used[next] = true;
      loop.insert(loop.end(), pieces[next].begin(), pieces[next].end());
      last = next;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

TrimmedDomain trimmedDomain(const TopoDS_Face& oriented, const Handle(Geom_Surface) & exact) {
  const Geom_Surface& surface = *exact;
  const GeomAdaptor_Surface quick(exact);
  const TopoDS_Face face = TopoDS::Face(oriented.Oriented(TopAbs_FORWARD));
  std::vector<TrimmedDomain::Segment> border;
  for (TopExp_Explorer wires(face, TopAbs_WIRE); wires.More(); wires.Next()) {
    std::vector<std::vector<Vector2>> pieces;
    double size = 0;
    for (const TopoDS_Edge& edge : chainOf(TopoDS::Wire(wires.Current()), face)) {
      pieces.push_back(borderPoints(edge, face, surface, quick));
      for (const Vector2& p : pieces.back())
        size = std::max(size, (p - pieces.front().front()).norm());
    }
    for (const std::vector<Vector2>& loop : loopsOf(std::move(pieces), 1e-4 * size)) {
      for (std::size_t i = 0; i < loop.size(); ++i)
        border.push_back({loop[i], loop[(i + 1) % loop.size()]});
    }
  }
  return {std::move(border), surface.IsUPeriodic() ? surface.UPeriod() : 0,
          surface.IsVPeriodic() ? surface.VPeriod() : 0};
}

}  // namespace

LazyFreeformSurface::LazyFreeformSurface(Handle(Geom_Surface) surface, const TrimmedDomain& domain)
    : surface_(std::move(surface)), low_(domain.low()), high_(domain.high()) {
  if (!domain.isEverywhere()) return;
  constexpr double kMost = 1e6;
  surface_->Bounds(low_.x(), high_.x(), low_.y(), high_.y());
  low_ = low_.cwiseMax(-kMost);
  high_ = high_.cwiseMin(kMost);
}

const FreeformSurface& LazyFreeformSurface::operator*() const {
  std::call_once(once_, [&] { made_ = freeformSurface(surface_, low_, high_); });
  return *made_;
}

Vector3 CadFace::pointAt(const Vector2& parameters) const {
  return freeform ? (**freeform).pointAt(parameters) : vector(surface->Value(parameters.x(), parameters.y()));
}

Handle(Geom_Surface) surfaceWithoutLimits(const Handle(Geom_Surface) & surface) {
  if (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface)) {
    return surfaceWithoutLimits(trimmed->BasisSurface());
  }
  if (const auto offset = Handle(Geom_OffsetSurface)::DownCast(surface)) {
    const Handle(Geom_Surface) basis = surfaceWithoutLimits(offset->BasisSurface());
    if (basis == offset->BasisSurface()) return surface;
    return new Geom_OffsetSurface(basis, offset->Offset(), Standard_True);
  }
  if (const auto extrusion = Handle(Geom_SurfaceOfLinearExtrusion)::DownCast(surface)) {
    return new Geom_SurfaceOfLinearExtrusion(curveWithoutLimits(extrusion->BasisCurve()), extrusion->Direction());
  }
  if (const auto revolution = Handle(Geom_SurfaceOfRevolution)::DownCast(surface)) {
    return new Geom_SurfaceOfRevolution(curveWithoutLimits(revolution->BasisCurve()), revolution->Axis());
  }
  return surface;
}

namespace {

/// The axis and the circle's radius of a surface that a circle makes as it turns; nothing of other surfaces.
struct TurnedCircle {
  gp_Lin axis;
  double radius;
  bool meetsAxis;
};

std::optional<TurnedCircle> turnedCircle(const CadFace& face) {
  constexpr double kNearly = 1e-6;
  if (const auto torus = Handle(Geom_ToroidalSurface)::DownCast(face.surface)) {
    const bool meets = torus->MinorRadius() > std::abs(torus->MajorRadius()) * (1 - kNearly);
    return TurnedCircle{gp_Lin(torus->Axis()), torus->MinorRadius(), meets};
  }
  const auto revolution = Handle(Geom_SurfaceOfRevolution)::DownCast(face.surface);
  if (revolution.IsNull()) return std::nullopt;
  const auto circle = Handle(Geom_Circle)::DownCast(revolution->BasisCurve());
  if (circle.IsNull()) return std::nullopt;
  const gp_Lin axis(revolution->Axis());
  const double arm = axis.Distance(circle->Location());
  // One that is turned about its own diameter makes a sphere.
  const bool meets = arm > kNearly * circle->Radius() && circle->Radius() > arm * (1 - kNearly);
  return TurnedCircle{axis, circle->Radius(), meets};
}

}  // namespace

bool reachesItsAxis(const CadFace& face) {
  const auto turned = turnedCircle(face);
  if (!turned || !turned->meetsAxis) return false;
  if (face.domain.isEverywhere()) return true;
  constexpr int kPlaces = 400;
  constexpr double kNear = 0.01;  // more than half the way between two places
  const Vector2 low = face.domain.low(), high = face.domain.high();
  for (int i = 0; i <= kPlaces; ++i) {
    const gp_Pnt place = face.surface->Value(low.x(), low.y() + (high.y() - low.y()) * i / kPlaces);
    if (turned->axis.Distance(place) <= kNear * turned->radius) return true;
  }
  return false;
}

CadFace cadFace(const TopoDS_Face& face, std::optional<TrimmedDomain> domain) {
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  if (surface.IsNull()) throw std::runtime_error("a face has no surface");
  CadFace exact;
  exact.surface = surfaceWithoutLimits(surface);
  exact.reversed = face.Orientation() == TopAbs_REVERSED;
  exact.domain = domain ? std::move(*domain) : trimmedDomain(face, exact.surface);
  exact.forms = closedForms(BRepAdaptor_Surface(face, Standard_False), exact.domain);
  if (exact.forms.count == 0) exact.freeform = std::make_shared<LazyFreeformSurface>(exact.surface, exact.domain);
  return exact;
}

}  // namespace probewright::simulation
