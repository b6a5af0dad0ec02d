#include "simulation/cad_model.hpp"

#include <BRepLib.hxx>
#include <BRep_Tool.hxx>
#include <BinTools.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Line.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Poly_Triangulation.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <functional>
#include <future>
#include <map>
#include <sstream>
#include <stdexcept>

#include "simulation/cad_bounds.hpp"
#include "simulation/cad_elementary.hpp"
#include "simulation/cad_elements.hpp"
#include "simulation/cad_pieces.hpp"
#include "simulation/cad_vectors.hpp"
#include "simulation/face_mesh.hpp"
#include "simulation/memory_text.hpp"
#include "simulation/parallel.hpp"

namespace probewright::simulation {
namespace {

constexpr double kFarthest = 1e9;         // mm
constexpr std::size_t kWorthAThread = 4;  // faces or edges

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

/// Gives the edges their curves with bounds. Those of a spline do not depend on where an edge begins and ends: what was
/// cut out of one spline shares them.
void addBounds(std::vector<CadEdge>& edges) {
  std::map<const Geom_Curve*, std::shared_ptr<const LazyFreeformCurve>> splines;
  for (CadEdge& edge : edges) {
    const bool isSpline = edge.curve->IsKind(STANDARD_TYPE(Geom_BSplineCurve));
    if (isSpline) edge.bounded = splines[edge.curve.get()];
    if (edge.bounded) continue;
    edge.bounded = std::make_shared<const LazyFreeformCurve>(edge.curve, edge.first, edge.last);
    if (isSpline) splines[edge.curve.get()] = edge.bounded;
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
CadModel modelOf(const TopoDS_Shape& shape, double deflection, std::vector<TrimmedDomain> domains,
                 const std::stop_token& stop) {
  BRepLib::BuildCurves3d(shape);
  const Faces faces = facesOf(shape);
  if (!domains.empty() && domains.size() != faces.faces.size())
    throw std::runtime_error("its borders are not those of the shape");
  CadModel model;
  model.shape = shape;
  model.deflection = deflection;
  model.closedBodies = faces.closedBodies;
  model.faces.resize(faces.faces.size());
  inParallel(faces.faces.size(), kWorthAThread, [&](std::size_t i) {
    if (stop.stop_requested()) throw std::runtime_error("it was interrupted");
    model.faces[i] = domains.empty() ? cadFace(faces.faces[i]) : cadFace(faces.faces[i], std::move(domains[i]));
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
  addBounds(model.edges);
  if (model.faces.empty()) throw std::runtime_error("the shape has no face that can be touched");
  return model;
}

}  // namespace

CadModel exactModel(const TopoDS_Shape& shape, double deflection) { return modelOf(shape, deflection, {}, {}); }

void appendShape(std::string& bytes, const CadModel& model) {
  std::ostringstream brep;
  BinTools::Write(model.shape, brep, Standard_False, Standard_False, BinTools_FormatVersion_CURRENT);
  append(bytes, brep.view().size());
  bytes += brep.view();
  append(bytes, model.faces.size());
  for (const CadFace& face : model.faces)
    face.domain.appendTo(bytes);
}

CadModel exactModel(std::string_view bytes, double deflection, const std::stop_token& stop) {
  const auto refuse = [] { return std::runtime_error("its bytes are not those of a shape"); };
  std::size_t size = 0, count = 0;
  if (!take(bytes, size) || size > bytes.size()) throw refuse();
  TopoDS_Shape shape;
  std::istringstream stream{std::string(bytes.substr(0, size))};
  BinTools::Read(shape, stream);
  if (shape.IsNull()) throw std::runtime_error("it is empty");
  bytes.remove_prefix(size);
  if (!take(bytes, count) || count > bytes.size()) throw refuse();
  std::vector<TrimmedDomain> domains(count);
  for (TrimmedDomain& domain : domains) {
    auto taken = TrimmedDomain::takeFrom(bytes);
    if (!taken) throw refuse();
    domain = std::move(*taken);
  }
  if (!bytes.empty()) throw refuse();
  return modelOf(shape, deflection, std::move(domains), stop);
}

void addElements(CadModel& model) {
  model.deflection = suitableDeflection(model.deflection, sizeOf(model.shape));
  const Faces faces = facesOf(model.shape);
  std::vector<std::vector<CadElement>> ofFaces(faces.faces.size());
  inParallel(ofFaces.size(), kWorthAThread, [&](std::size_t i) {
    ofFaces[i] = faceElements(model.faces[i], faces.faces[i], static_cast<std::uint32_t>(i), model.deflection);
  });
  std::vector<std::vector<CadElement>> ofEdges(model.edges.size());
  inParallel(ofEdges.size(), kWorthAThread, [&](std::size_t i) {
    ofEdges[i] = edgeElements(model.edges[i], static_cast<std::uint32_t>(i), model.deflection);
  });
  std::size_t count = 0;
  for (const auto* const those : {&ofFaces, &ofEdges}) {
    for (const std::vector<CadElement>& elements : *those)
      count += elements.size();
  }
  model.elements.reserve(count);
  for (const auto* const those : {&ofFaces, &ofEdges}) {
    for (const std::vector<CadElement>& elements : *those)
      model.elements.insert(model.elements.end(), elements.begin(), elements.end());
  }
  for (const CadElement& element : model.elements) {
    if (!std::isfinite(element.growth))
      throw std::runtime_error("a face or edge has points whose coordinates are not numbers");
    for (const Vector3& corner : element.corners) {
      if (!(corner.cwiseAbs().maxCoeff() <= kFarthest)) throw std::runtime_error("it reaches further than 1000 km");
    }
  }
  std::future<Bounds> bounds = std::async(std::launch::async, boundsOf, std::cref(model));
  std::vector<SearchElement> search;
  search.reserve(model.elements.size());
  for (const CadElement& element : model.elements)
    search.push_back({element.corners, element.growth});
  model.tree = SearchTree(search, Elements::NearTriangles);
  model.bounds = bounds.get();
  std::vector<CadElement> ordered;
  ordered.reserve(model.elements.size());
  for (const std::uint32_t i : model.tree.order())
    ordered.push_back(model.elements[i]);
  model.elements = std::move(ordered);
}

CadModel cadModel(const TopoDS_Shape& part, double deflection) {
  const bool meshed = isMeshed(part, deflection);
  const TopoDS_Shape shape = meshed ? part : inPieces(withElementarySurfaces(part));
  BRepLib::BuildCurves3d(shape);
  if (!meshed) meshFaces(shape, deflection);
  CadModel model = exactModel(shape, deflection);
  addElements(model);
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
  append(bytes, model.deflection);
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
    append(bytes, element.borders);
  }
  model.tree.appendTo(bytes);
}

void takeElements(CadModel& model, std::string_view bytes) {
  const auto refuse = [] { return std::runtime_error("its elements are not those of the shape"); };
  std::vector<double> marks;
  std::size_t count = 0;
  if (!take(bytes, marks) || !agree(marks, marksOf(model)) || !take(bytes, model.deflection) ||
      !take(bytes, model.bounds) || !take(bytes, count) || count > bytes.size())
    throw refuse();
  model.elements.resize(count);
  for (CadElement& element : model.elements) {
    if (!take(bytes, element.corners) || !take(bytes, element.parameters) || !take(bytes, element.growth) ||
        !take(bytes, element.owner) || !take(bytes, element.kind) || !take(bytes, element.onFace) ||
        !take(bytes, element.borders) ||
        element.owner >= (element.kind == CadElement::Kind::Face ? model.faces.size() : model.edges.size()))
      throw refuse();
  }
  std::optional<SearchTree> tree = SearchTree::takeFrom(bytes, model.elements.size());
  if (!tree || !bytes.empty()) throw refuse();
  model.tree = std::move(*tree);
}

}  // namespace probewright::simulation
