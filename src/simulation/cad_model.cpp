#include "simulation/cad_model.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Line.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Cone.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Pln.hxx>
#include <gp_Sphere.hxx>
#include <gp_Torus.hxx>
#include <stdexcept>

namespace probewright::simulation {
namespace {

/// A border polygon may leave its edge by this much: the contact of a ball then errs by the square over its diameter.
constexpr double kBorderTolerance = 2e-4;
constexpr double kAngularDeflection = 0.3;
constexpr double kLeastGrowth = 1e-6;

template <class Triple>
Vector3 vector(const Triple& p) {
  return {p.X(), p.Y(), p.Z()};
}

template <class Position>
Matrix3 axesOf(const Position& position) {
  Matrix3 axes;
  axes << vector(position.XDirection()), vector(position.YDirection()), vector(position.Direction());
  return axes;
}

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
      // A tube wider than its ring meets itself; the closed form knows only the outer part.
      if (s.tubeRadius >= s.radius) return std::nullopt;
      break;
    default:
      return std::nullopt;
  }
  s.origin = vector(position.Location());
  s.axes = axesOf(position);
  return s;
}

/// Appends the parameters of a curve's points so that chords stay within a tolerance. `deviates(a, b)` tells whether
/// the chord between two parameters does not.
template <class Deviates>
void subdivide(double a, double b, int depth, const Deviates& deviates, std::vector<double>& parameters) {
  if (depth > 0 && deviates(a, b)) {
    const double middle = (a + b) / 2;
    subdivide(a, middle, depth - 1, deviates, parameters);
    subdivide(middle, b, depth - 1, deviates, parameters);
  } else {
    parameters.push_back(b);
  }
}

/// The points of an edge's parameter curve on a face, in the direction in which the wire runs.
std::vector<Vector2> borderPoints(const TopoDS_Edge& edge, const TopoDS_Face& face, const Geom_Surface& surface) {
  double first = 0;
  double last = 0;
  const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
  std::vector<Vector2> points;
  if (curve.IsNull()) return points;
  const auto at = [&](double t) {
    const gp_Pnt2d p = curve->Value(t);
    return Vector2(p.X(), p.Y());
  };
  Handle(Geom2d_Curve) plain = curve;
  if (const auto trimmed = Handle(Geom2d_TrimmedCurve)::DownCast(plain)) plain = trimmed->BasisCurve();
  std::vector<double> parameters{first};
  if (plain->IsKind(STANDARD_TYPE(Geom2d_Line))) {
    parameters.push_back(last);
  } else {
    const auto onSurface = [&](const Vector2& uv) { return vector(surface.Value(uv.x(), uv.y())); };
    const auto deviates = [&](double a, double b) {
      const Vector2 from = at(a);
      const Vector2 to = at(b);
      for (const double part : {0.5, 0.3}) {
        const Vector2 chord = from + part * (to - from);
        if ((onSurface(at(a + part * (b - a))) - onSurface(chord)).norm() > kBorderTolerance) return true;
      }
      return false;
    };
    constexpr int kPieces = 4;
    for (int i = 0; i < kPieces; ++i) {
      subdivide(first + (last - first) * i / kPieces, first + (last - first) * (i + 1) / kPieces, 12, deviates,
                parameters);
    }
  }
  for (const double t : parameters)
    points.push_back(at(t));
  if (edge.Orientation() == TopAbs_REVERSED) std::reverse(points.begin(), points.end());
  return points;
}

TrimmedDomain trimmedDomain(const TopoDS_Face& oriented, const Geom_Surface& surface) {
  const TopoDS_Face face = TopoDS::Face(oriented.Oriented(TopAbs_FORWARD));
  std::vector<TrimmedDomain::Segment> border;
  for (TopExp_Explorer wires(face, TopAbs_WIRE); wires.More(); wires.Next()) {
    const TopoDS_Wire& wire = TopoDS::Wire(wires.Current());
    std::vector<TopoDS_Edge> chain;
    for (BRepTools_WireExplorer edges(wire, face); edges.More(); edges.Next())
      chain.push_back(edges.Current());
    std::vector<TopoDS_Edge> all;
    for (TopExp_Explorer edges(wire, TopAbs_EDGE); edges.More(); edges.Next()) {
      const TopAbs_Orientation orientation = edges.Current().Orientation();
      if (orientation == TopAbs_FORWARD || orientation == TopAbs_REVERSED) {
        all.push_back(TopoDS::Edge(edges.Current()));
      }
    }
    // The chain joins the ends of neighbours; a wire that the explorer cannot follow is taken as loose pieces.
    const bool chained = chain.size() == all.size();
    std::vector<Vector2> loop;
    for (const TopoDS_Edge& edge : chained ? chain : all) {
      const std::vector<Vector2> points = borderPoints(edge, face, surface);
      if (!chained) loop.clear();
      loop.insert(loop.end(), points.begin(), points.end());
      for (std::size_t i = 0; !chained && i + 1 < loop.size(); ++i)
        border.push_back({loop[i], loop[i + 1]});
    }
    for (std::size_t i = 0; chained && i < loop.size(); ++i)
      border.push_back({loop[i], loop[(i + 1) % loop.size()]});
  }
  return {std::move(border), surface.IsUPeriodic() ? surface.UPeriod() : 0,
          surface.IsVPeriodic() ? surface.VPeriod() : 0};
}

void addFaceElements(CadModel& model, const TopoDS_Face& face, std::uint32_t owner, double deflection) {
  TopLoc_Location location;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
  if (mesh.IsNull() || !mesh->HasUVNodes()) return;
  const CadFace& exact = model.faces[owner];
  const gp_Trsf transform = location.Transformation();
  const bool flat = exact.analytic && exact.analytic->kind == AnalyticSurface::Kind::Plane;
  bool straight = true;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More() && straight; edges.Next()) {
    double first = 0;
    double last = 0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(edges.Current()), first, last);
    straight = curve.IsNull() || curve->IsKind(STANDARD_TYPE(Geom_Line));
  }
  for (int i = 1; i <= mesh->NbTriangles(); ++i) {
    std::array<int, 3> nodes{};
    mesh->Triangle(i).Get(nodes[0], nodes[1], nodes[2]);
    if (exact.reversed) std::swap(nodes[1], nodes[2]);
    CadElement element;
    element.owner = owner;
    for (std::size_t k = 0; k < 3; ++k) {
      element.corners[k] = vector(mesh->Node(nodes[k]).Transformed(transform));
      const gp_Pnt2d uv = mesh->UVNode(nodes[k]);
      element.parameters[k] = {uv.X(), uv.Y()};
    }
    double deviation = 0;
    if (!flat) {
      const auto probe = [&](double a, double b, double c) {
        const Vector2 uv = a * element.parameters[0] + b * element.parameters[1] + c * element.parameters[2];
        const Vector3 chord = a * element.corners[0] + b * element.corners[1] + c * element.corners[2];
        deviation = std::max(deviation, (vector(exact.surface->Value(uv.x(), uv.y())) - chord).norm());
      };
      probe(0.5, 0.5, 0);
      probe(0, 0.5, 0.5);
      probe(0.5, 0, 0.5);
      probe(1.0 / 3, 1.0 / 3, 1.0 / 3);
    }
    // Between a bent border and its chord no triangle lies.
    element.growth = kLeastGrowth + 1.5 * std::max(deviation, straight ? 0.0 : 1.5 * deflection);
    model.elements.push_back(element);
  }
}

CadEdge cadEdge(const TopoDS_Edge& edge) {
  CadEdge exact;
  exact.curve = BRep_Tool::Curve(edge, exact.first, exact.last);
  if (exact.curve.IsNull()) return exact;
  if (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(exact.curve)) exact.curve = trimmed->BasisCurve();
  exact.start = vector(exact.curve->Value(exact.first));
  exact.end = vector(exact.curve->Value(exact.last));
  if (exact.curve->IsKind(STANDARD_TYPE(Geom_Line))) exact.kind = CadEdge::Kind::Line;
  if (const auto circle = Handle(Geom_Circle)::DownCast(exact.curve)) {
    exact.kind = CadEdge::Kind::Circle;
    exact.centre = vector(circle->Position().Location());
    exact.axes = axesOf(circle->Position());
    exact.radius = circle->Radius();
  }
  return exact;
}

void addEdgeElements(CadModel& model, std::uint32_t owner, double deflection) {
  const CadEdge& edge = model.edges[owner];
  const auto at = [&](double t) { return vector(edge.curve->Value(t)); };
  const auto deviation = [&](double a, double b) {
    const Vector3 from = at(a);
    const Vector3 to = at(b);
    return std::max((at((a + b) / 2) - (from + to) / 2).norm(),
                    (at(0.7 * a + 0.3 * b) - (0.7 * from + 0.3 * to)).norm());
  };
  std::vector<double> parameters{edge.first};
  const int pieces = edge.kind == CadEdge::Kind::Line ? 1 : 8;
  for (int i = 0; i < pieces; ++i) {
    const double a = edge.first + (edge.last - edge.first) * i / pieces;
    const double b = edge.first + (edge.last - edge.first) * (i + 1) / pieces;
    subdivide(
        a, b, edge.kind == CadEdge::Kind::Line ? 0 : 10,
        [&](double from, double to) { return deviation(from, to) > deflection; }, parameters);
  }
  for (std::size_t i = 0; i + 1 < parameters.size(); ++i) {
    CadElement element;
    element.kind = CadElement::Kind::Edge;
    element.owner = owner;
    element.corners = {at(parameters[i]), at(parameters[i + 1]), at(parameters[i + 1])};
    element.parameters = {Vector2(parameters[i], 0), Vector2(parameters[i + 1], 0), Vector2(parameters[i + 1], 0)};
    element.growth =
        kLeastGrowth + 1.5 * (edge.kind == CadEdge::Kind::Line ? 0 : deviation(parameters[i], parameters[i + 1]));
    model.elements.push_back(element);
  }
}

bool boundsMaterial(const TopoDS_Shape& shape) {
  if (!TopExp_Explorer(shape, TopAbs_SOLID).More()) return false;
  if (TopExp_Explorer(shape, TopAbs_FACE, TopAbs_SOLID).More()) return false;
  for (TopExp_Explorer shells(shape, TopAbs_SHELL); shells.More(); shells.Next()) {
    if (!BRep_Tool::IsClosed(shells.Current())) return false;
  }
  return true;
}

}  // namespace

CadModel cadModel(const TopoDS_Shape& shape, double deflection) {
  CadModel model;
  model.shape = shape;
  BRepLib::BuildCurves3d(shape);
  BRepTools::Clean(shape);
  BRepMesh_IncrementalMesh mesher(shape, deflection, Standard_False, kAngularDeflection);

  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Face& face = TopoDS::Face(faces.Current());
    CadFace exact;
    exact.surface = BRep_Tool::Surface(face);
    if (exact.surface.IsNull()) throw std::runtime_error("a face has no surface");
    exact.analytic = analyticSurface(BRepAdaptor_Surface(face, Standard_False));
    exact.reversed = face.Orientation() == TopAbs_REVERSED;
    exact.domain = trimmedDomain(face, *exact.surface);
    model.faces.push_back(std::move(exact));
    addFaceElements(model, face, static_cast<std::uint32_t>(model.faces.size() - 1), deflection);
  }
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge& edge = TopoDS::Edge(edges(i));
    if (BRep_Tool::Degenerated(edge)) continue;
    CadEdge exact = cadEdge(edge);
    if (exact.curve.IsNull()) continue;
    model.edges.push_back(std::move(exact));
    addEdgeElements(model, static_cast<std::uint32_t>(model.edges.size() - 1), deflection);
  }
  if (model.faces.empty()) throw std::runtime_error("the shape has no face that can be touched");

  std::vector<SearchElement> search;
  search.reserve(model.elements.size());
  for (const CadElement& element : model.elements) {
    for (const Vector3& corner : element.corners) {
      model.bounds.minimum = model.bounds.minimum.cwiseMin(corner);
      model.bounds.maximum = model.bounds.maximum.cwiseMax(corner);
    }
    search.push_back({element.corners, element.growth});
  }
  model.tree = SearchTree(search, Elements::NearTriangles);
  std::vector<CadElement> ordered;
  ordered.reserve(model.elements.size());
  for (const std::uint32_t i : model.tree.order())
    ordered.push_back(model.elements[i]);
  model.elements = std::move(ordered);
  model.closed = boundsMaterial(shape);
  return model;
}

}  // namespace probewright::simulation
