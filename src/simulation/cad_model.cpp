#include "simulation/cad_model.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepLib.hxx>
#include <BRep_Tool.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Line.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Poly_Triangulation.hxx>
#include <ShapeUpgrade_ShapeDivideContinuity.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <stdexcept>

#include "simulation/border_middles.hpp"
#include "simulation/cad_refinement.hpp"
#include "simulation/face_grid.hpp"
#include "simulation/face_mesh.hpp"
#include "simulation/memory_text.hpp"
#include "simulation/parallel.hpp"

namespace probewright::simulation {
namespace {

constexpr double kLeastGrowth = 1e-6;
constexpr double kFarthest = 1e9;          // mm
constexpr std::size_t kWorthAThread = 20;  // faces

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

/// How far the corners of a triangle lie from where its parameters are on a plane: the mesher may have mixed them up.
double deviationOf(const CadElement& element, const AnalyticSurface& plane) {
  double deviation = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector2& uv = element.parameters[k];
    const Vector3 place = plane.origin + plane.axes * Vector3(uv.x(), uv.y(), 0);
    deviation = std::max(deviation, (place - element.corners[k]).norm());
  }
  return deviation;
}

double areaInParameters(const CadElement& element) {
  const Vector2 a = element.parameters[1] - element.parameters[0];
  const Vector2 b = element.parameters[2] - element.parameters[0];
  return std::abs(a.x() * b.y() - a.y() * b.x()) / 2;
}

/// A grid over the face, for a mesh that leaves a part of it open. It finds contacts of balls as well as a mesh does;
/// contacts of anything else err by a cell at the borders.
std::vector<CadElement> gridElements(const CadFace& exact, std::uint32_t owner, double deflection) {
  std::vector<CadElement> elements;
  const FaceGrid grid(exact, deflection);
  for (const FaceGrid::Parameters& cell : grid.triangles()) {
    CadElement element;
    element.owner = owner;
    for (std::size_t k = 0; k < 3; ++k) {
      element.parameters[k] = cell[exact.reversed ? 2 - k : k];
      element.corners[k] = vector(exact.surface->Value(element.parameters[k].x(), element.parameters[k].y()));
    }
    element.onFace = exact.domain.contains((cell[0] + cell[1] + cell[2]) / 3);
    element.growth = kLeastGrowth + 1.5 * deviationOf(element, *exact.surface);
    elements.push_back(element);
  }
  return elements;
}

using MeshCorner = BorderMiddles::Middle;

/// A triangle, cut at the middles that some of its sides have: side k runs from corner k to the next.
template <class Add>
void addParts(const std::array<MeshCorner, 3>& corners, const std::array<const MeshCorner*, 3>& middles,
              const Add& add) {
  const auto count = std::ranges::count_if(middles, [](const MeshCorner* middle) { return middle != nullptr; });
  if (count == 0) return add(corners[0], corners[1], corners[2]);
  // Turned so that its first side has a middle and, of two, its last has none.
  std::size_t k = 0;
  while (middles[k] == nullptr || (count == 2 && middles[(k + 2) % 3] != nullptr))
    ++k;
  const MeshCorner &a = corners[k], &b = corners[(k + 1) % 3], &c = corners[(k + 2) % 3];
  const MeshCorner& ab = *middles[k];
  if (count == 1) {
    add(a, ab, c);
    add(ab, b, c);
    return;
  }
  const MeshCorner& bc = *middles[(k + 1) % 3];
  add(ab, b, bc);
  if (count == 2) {
    add(a, ab, bc);
    add(a, bc, c);
    return;
  }
  const MeshCorner& ca = *middles[(k + 2) % 3];
  add(a, ab, ca);
  add(ca, bc, c);
  add(ab, bc, ca);
}

std::vector<CadElement> faceElements(const CadFace& exact, const TopoDS_Face& face, std::uint32_t owner,
                                     double deflection) {
  TopLoc_Location location;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
  if (mesh.IsNull() || !mesh->HasUVNodes()) return gridElements(exact, owner, deflection);
  std::vector<CadElement> elements;
  double area = 0;
  const gp_Trsf transform = location.Transformation();
  const bool flat = exact.forms.isPlane();
  bool straight = true;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More() && straight; edges.Next()) {
    double first = 0;
    double last = 0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(edges.Current()), first, last);
    straight = curve.IsNull() || curve->IsKind(STANDARD_TYPE(Geom_Line));
  }
  const BorderMiddles middles(face, mesh, location, deflection);
  const auto add = [&](const MeshCorner& a, const MeshCorner& b, const MeshCorner& c) {
    CadElement element;
    element.owner = owner;
    element.corners = {a.point, b.point, c.point};
    element.parameters = {a.parameters, b.parameters, c.parameters};
    const double deviation =
        flat ? deviationOf(element, exact.forms.sheets.front()) : deviationOf(element, *exact.surface);
    area += areaInParameters(element);
    // Between a bent border and its chord no triangle lies.
    element.growth = kLeastGrowth + 1.5 * std::max(deviation, straight ? 0.0 : 1.5 * deflection);
    elements.push_back(element);
  };
  for (int i = 1; i <= mesh->NbTriangles(); ++i) {
    std::array<int, 3> nodes{};
    mesh->Triangle(i).Get(nodes[0], nodes[1], nodes[2]);
    if (exact.reversed) std::swap(nodes[1], nodes[2]);
    std::array<MeshCorner, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const gp_Pnt2d uv = mesh->UVNode(nodes[k]);
      corners[k] = {vector(mesh->Node(nodes[k]).Transformed(transform)), {uv.X(), uv.Y()}};
    }
    addParts(
        corners,
        {middles.between(nodes[0], nodes[1]), middles.between(nodes[1], nodes[2]), middles.between(nodes[2], nodes[0])},
        add);
  }
  // Triangles that leave a part of the face open would hide it.
  constexpr double kLeastCover = 0.9;
  if (area < kLeastCover * exact.domain.area()) return gridElements(exact, owner, deflection);
  return elements;
}

CadEdge cadEdge(const TopoDS_Edge& edge) {
  CadEdge exact;
  exact.curve = BRep_Tool::Curve(edge, exact.first, exact.last);
  if (exact.curve.IsNull()) return exact;
  while (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(exact.curve))
    exact.curve = trimmed->BasisCurve();
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

/// The ends of the parts of an edge that have no kink.
std::vector<double> smoothParts(const CadEdge& edge) {
  std::vector<double> ends;
  if (edge.kind == CadEdge::Kind::Curve) {
    const GeomAdaptor_Curve curve(edge.curve, edge.first, edge.last);
    TColStd_Array1OfReal bounds(1, curve.NbIntervals(GeomAbs_C1) + 1);
    curve.Intervals(bounds, GeomAbs_C1);
    for (int i = 2; i < bounds.Length(); ++i)
      ends.push_back(bounds(i));
  }
  ends.push_back(edge.last);
  return ends;
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
  const std::vector<double> smooth = smoothParts(edge);
  const int pieces = edge.kind == CadEdge::Kind::Line ? 1 : std::max(1, 8 / static_cast<int>(smooth.size()));
  double from = edge.first;
  for (const double to : smooth) {
    for (int i = 0; i < pieces; ++i) {
      subdivide(
          from + (to - from) * i / pieces, from + (to - from) * (i + 1) / pieces,
          edge.kind == CadEdge::Kind::Line ? 0 : 10, [&](double a, double b) { return deviation(a, b) > deflection; },
          parameters);
    }
    from = to;
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

/// The parameters within a face at which its surface has a kink, across u or across v.
std::vector<double> kinksOf(const CadFace& face, bool acrossU) {
  std::vector<double> kinks;
  const Vector2& low = face.domain.low();
  const Vector2& high = face.domain.high();
  if (face.forms.count > 0 || face.surface->IsKind(STANDARD_TYPE(Geom_OffsetSurface))) return kinks;
  if (!(low.x() < high.x() && low.y() < high.y())) return kinks;
  const GeomAdaptor_Surface surface(face.surface, low.x(), high.x(), low.y(), high.y());
  TColStd_Array1OfReal bounds(1, (acrossU ? surface.NbUIntervals(GeomAbs_C1) : surface.NbVIntervals(GeomAbs_C1)) + 1);
  acrossU ? surface.UIntervals(bounds, GeomAbs_C1) : surface.VIntervals(bounds, GeomAbs_C1);
  for (int i = 2; i < bounds.Length(); ++i)
    kinks.push_back(bounds(i));
  return kinks;
}

/// The kinks within a face, as edges: there no point of the surface has a normal along which a ball could touch it.
void addRidges(CadModel& model, std::uint32_t owner) {
  for (const bool acrossU : {true, false}) {
    for (const double at : kinksOf(model.faces[owner], acrossU)) {
      const CadFace& face = model.faces[owner];
      CadEdge ridge;
      ridge.curve = acrossU ? face.surface->UIso(at) : face.surface->VIso(at);
      ridge.first = acrossU ? face.domain.low().y() : face.domain.low().x();
      ridge.last = acrossU ? face.domain.high().y() : face.domain.high().x();
      ridge.within = owner;
      ridge.acrossU = acrossU;
      ridge.kinkAt = at;
      model.edges.push_back(std::move(ridge));
    }
  }
}

struct Faces {
  std::vector<TopoDS_Face> faces;
  std::vector<bool> boundSolid;  ///< those of closed solids tell inside from outside, whatever loose faces there are
  int closedBodies = 0;
};

bool isClosed(const TopoDS_Shape& solid) {
  for (TopExp_Explorer shells(solid, TopAbs_SHELL); shells.More(); shells.Next()) {
    if (!BRep_Tool::IsClosed(shells.Current())) return false;
  }
  return true;
}

/// True if the surface has a kink within the face.
bool hasKinks(const TopoDS_Face& face) {
  const BRepAdaptor_Surface surface(face);
  switch (surface.GetType()) {
    case GeomAbs_BSplineSurface:
    case GeomAbs_SurfaceOfRevolution:
    case GeomAbs_SurfaceOfExtrusion:
      return surface.NbUIntervals(GeomAbs_C1) > 1 || surface.NbVIntervals(GeomAbs_C1) > 1;
    default:
      return false;
  }
}

}  // namespace

double deviationOf(const CadElement& element, const Geom_Surface& surface) {
  double deviation = 0;
  const auto probe = [&](double a, double b, double c) {
    const Vector2 uv = a * element.parameters[0] + b * element.parameters[1] + c * element.parameters[2];
    const Vector3 chord = a * element.corners[0] + b * element.corners[1] + c * element.corners[2];
    deviation = std::max(deviation, (vector(surface.Value(uv.x(), uv.y())) - chord).norm());
  };
  probe(0.5, 0.5, 0);
  probe(0, 0.5, 0.5);
  probe(0.5, 0, 0.5);
  probe(1.0 / 3, 1.0 / 3, 1.0 / 3);
  probe(2.0 / 3, 1.0 / 6, 1.0 / 6);
  probe(1.0 / 6, 2.0 / 3, 1.0 / 6);
  probe(1.0 / 6, 1.0 / 6, 2.0 / 3);
  return deviation;
}

TopoDS_Shape withoutKinks(const TopoDS_Shape& shape) {
  TopExp_Explorer faces(shape, TopAbs_FACE);
  while (faces.More() && !hasKinks(TopoDS::Face(faces.Current())))
    faces.Next();
  if (!faces.More()) return shape;
  ShapeUpgrade_ShapeDivideContinuity divide(shape);
  divide.SetSurfaceCriterion(GeomAbs_C1);
  divide.SetBoundaryCriterion(GeomAbs_C0);
  divide.SetPCurveCriterion(GeomAbs_C0);
  divide.Perform();
  return divide.Result().IsNull() ? shape : divide.Result();
}

namespace {

Faces facesOf(const TopoDS_Shape& shape) {
  Faces found;
  const auto add = [&](TopExp_Explorer faces, bool boundSolid) {
    for (; faces.More(); faces.Next()) {
      found.faces.push_back(TopoDS::Face(faces.Current()));
      found.boundSolid.push_back(boundSolid);
    }
  };
  for (TopExp_Explorer solids(shape, TopAbs_SOLID); solids.More(); solids.Next()) {
    const bool closed = isClosed(solids.Current());
    found.closedBodies += closed ? 1 : 0;
    add(TopExp_Explorer(solids.Current(), TopAbs_FACE), closed);
  }
  add(TopExp_Explorer(shape, TopAbs_FACE, TopAbs_SOLID), false);
  return found;
}

/// The exact faces and edges of a shape.
CadModel exactModel(const TopoDS_Shape& shape, const Faces& faces, double deflection) {
  CadModel model;
  model.shape = shape;
  model.deflection = deflection;
  model.closedBodies = faces.closedBodies;
  model.faces.resize(faces.faces.size());
  inParallel(faces.faces.size(), kWorthAThread, [&](std::size_t i) {
    model.faces[i] = cadFace(faces.faces[i]);
    model.faces[i].boundsSolid = faces.boundSolid[i];
  });
  for (std::size_t i = 0; i < faces.faces.size(); ++i)
    addRidges(model, static_cast<std::uint32_t>(i));
  // Lines that belong to no face are drawn in the file, axes for instance, but nothing that could be touched.
  TopTools_IndexedMapOfShape edges;
  for (TopExp_Explorer every(shape, TopAbs_FACE); every.More(); every.Next())
    TopExp::MapShapes(every.Current(), TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge& edge = TopoDS::Edge(edges(i));
    if (BRep_Tool::Degenerated(edge) || edge.Orientation() == TopAbs_EXTERNAL) continue;
    CadEdge exact = cadEdge(edge);
    if (!exact.curve.IsNull()) model.edges.push_back(std::move(exact));
  }
  if (model.faces.empty()) throw std::runtime_error("the shape has no face that can be touched");
  return model;
}

/// A box about the shape, to within its deflection.
Bounds boundsOf(const CadModel& model) {
  Bounds corners;
  const auto add = [](Bounds& bounds, const Triangle& triangle) {
    for (const Vector3& corner : triangle) {
      bounds.minimum = bounds.minimum.cwiseMin(corner);
      bounds.maximum = bounds.maximum.cwiseMax(corner);
    }
  };
  for (const CadElement& element : model.elements)
    add(corners, element.corners);
  // The surface may reach further than the corners of its triangles.
  Bounds bounds = corners;
  const auto reachesFurther = [&](const Triangle& triangle, double growth) {
    return std::ranges::any_of(triangle, [&](const Vector3& corner) {
      return (corner.array() - growth < corners.minimum.array()).any() ||
             (corner.array() + growth > corners.maximum.array()).any();
    });
  };
  for (const CadElement& element : model.elements) {
    if (element.isTriangle())
      visitFinely(model, element, reachesFurther, [&](const Triangle& triangle) { add(bounds, triangle); });
  }
  return bounds;
}

}  // namespace

CadModel cadModel(const TopoDS_Shape& part, double deflection) {
  const bool meshed = isMeshed(part, deflection);
  const TopoDS_Shape shape = meshed ? part : withoutKinks(part);
  BRepLib::BuildCurves3d(shape);
  if (!meshed) meshFaces(shape, deflection);
  const Faces faces = facesOf(shape);
  CadModel model = exactModel(shape, faces, deflection);
  std::vector<std::vector<CadElement>> ofFaces(faces.faces.size());
  inParallel(ofFaces.size(), kWorthAThread, [&](std::size_t i) {
    ofFaces[i] = faceElements(model.faces[i], faces.faces[i], static_cast<std::uint32_t>(i), deflection);
  });
  for (const std::vector<CadElement>& elements : ofFaces)
    model.elements.insert(model.elements.end(), elements.begin(), elements.end());
  for (std::size_t i = 0; i < model.edges.size(); ++i)
    addEdgeElements(model, static_cast<std::uint32_t>(i), deflection);
  for (const CadElement& element : model.elements) {
    if (!std::isfinite(element.growth))
      throw std::runtime_error("a face or edge has points whose coordinates are not numbers");
    for (const Vector3& corner : element.corners) {
      if (!(corner.cwiseAbs().maxCoeff() <= kFarthest)) throw std::runtime_error("it reaches further than 1000 km");
    }
  }
  model.bounds = boundsOf(model);
  std::vector<SearchElement> search;
  search.reserve(model.elements.size());
  for (const CadElement& element : model.elements)
    search.push_back({element.corners, element.growth});
  model.tree = SearchTree(search, Elements::NearTriangles);
  std::vector<CadElement> ordered;
  ordered.reserve(model.elements.size());
  for (const std::uint32_t i : model.tree.order())
    ordered.push_back(model.elements[i]);
  model.elements = std::move(ordered);
  return model;
}

namespace {

/// Numbers that tell one face or edge from another, in their order.
std::vector<double> marksOf(const CadModel& model) {
  std::vector<double> marks{static_cast<double>(model.faces.size())};
  for (const CadFace& face : model.faces)
    marks.insert(marks.end(), {face.domain.low().x(), face.domain.high().x(), face.domain.low().y()});
  for (const CadEdge& edge : model.edges)
    marks.insert(marks.end(), {edge.first, edge.start.x(), edge.start.y(), edge.start.z()});
  return marks;
}

/// Equal to within what writing and reading a shape does to the matrices of its instances.
bool agree(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double x, double y) { return std::abs(x - y) <= 1e-8 * (1 + std::abs(x)); });
}

}  // namespace

void appendElements(std::string& bytes, const CadModel& model) {
  // With the tree: more would be copied each time that it does not suffice.
  bytes.reserve(bytes.size() + 250 * model.elements.size());
  append(bytes, marksOf(model));
  append(bytes, model.bounds);
  append(bytes, model.elements.size());
  // One by one: between the members of an element lie bytes without a value.
  for (const CadElement& element : model.elements) {
    append(bytes, element.corners);
    append(bytes, element.parameters);
    append(bytes, element.growth);
    append(bytes, element.owner);
    append(bytes, element.kind);
    append(bytes, element.onFace);
  }
  model.tree.appendTo(bytes);
}

CadModel cadModel(const TopoDS_Shape& shape, double deflection, std::string_view bytes) {
  BRepLib::BuildCurves3d(shape);
  CadModel model = exactModel(shape, facesOf(shape), deflection);
  const auto refuse = [] { return std::runtime_error("its elements are not those of the shape"); };
  std::vector<double> marks;
  std::size_t count = 0;
  if (!take(bytes, marks) || !agree(marks, marksOf(model)) || !take(bytes, model.bounds) || !take(bytes, count) ||
      count > bytes.size())
    throw refuse();
  model.elements.resize(count);
  for (CadElement& element : model.elements) {
    if (!take(bytes, element.corners) || !take(bytes, element.parameters) || !take(bytes, element.growth) ||
        !take(bytes, element.owner) || !take(bytes, element.kind) || !take(bytes, element.onFace) ||
        element.owner >= (element.kind == CadElement::Kind::Face ? model.faces.size() : model.edges.size()))
      throw refuse();
  }
  std::optional<SearchTree> tree = SearchTree::takeFrom(bytes, model.elements.size());
  if (!tree || !bytes.empty()) throw refuse();
  model.tree = std::move(*tree);
  return model;
}

}  // namespace probewright::simulation
