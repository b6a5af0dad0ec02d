#include "simulation/face_mesh.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepMesh_Context.hxx>
#include <BRepMesh_FaceDiscret.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepMesh_MeshAlgoFactory.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Geom2d_Line.hxx>
#include <IMeshData_Face.hxx>
#include <Message_ProgressIndicator.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <gp_Lin.hxx>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <vector>

#include "simulation/face_grid.hpp"
#include "simulation/loose_sides.hpp"

namespace probewright::simulation {
namespace {

/// The angle only keeps small curves recognizable.
constexpr double kAngle = 0.5;
/// Sides on a bent edge are halved before it matters.
constexpr double kAlongEdges = 8;
/// Of a large shape the triangles may be as much coarser: a share of its size.
constexpr double kAlongEdgesOfSize = 2e-5, kInteriorOfSize = 2e-4;
/// How far triangles may leave the faces, as a share of the shape's size: at least, as a large shape's need not be as
/// fine as a small one's, and at most.
constexpr double kFinestOfSize = 2.5e-6, kCoarsestOfSize = 1e-3;

double coarsest(double size) {
  constexpr double kLeast = 1e-5;  // mm
  return size > 0 ? std::max(kLeast, kCoarsestOfSize * size) : std::numeric_limits<double>::infinity();
}

/// The faces by what they share with their instances elsewhere in the shape, counted from 1.
using FaceNumbers = std::map<const TopoDS_TShape*, int>;

FaceNumbers numbered(const TopoDS_Shape& shape) {
  FaceNumbers numbers;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next())
    numbers.try_emplace(faces.Current().TShape().get(), static_cast<int>(numbers.size()) + 1);
  return numbers;
}

const char* kindOf(const TopoDS_Face& face) {
  switch (BRepAdaptor_Surface(face, Standard_False).GetType()) {
    case GeomAbs_Plane:
      return "plane";
    case GeomAbs_Cylinder:
      return "cylinder";
    case GeomAbs_Cone:
      return "cone";
    case GeomAbs_Sphere:
      return "sphere";
    case GeomAbs_Torus:
      return "torus";
    case GeomAbs_BezierSurface:
    case GeomAbs_BSplineSurface:
      return "B-spline surface";
    case GeomAbs_SurfaceOfRevolution:
      return "surface of revolution";
    case GeomAbs_SurfaceOfExtrusion:
      return "surface of extrusion";
    default:
      return "free-form surface";
  }
}

bool isFlat(const TopoDS_Face& face) { return BRepAdaptor_Surface(face, Standard_False).GetType() == GeomAbs_Plane; }

/// The line along which the seam of a cone runs over its parameters, with the same u all along; nothing if it is not
/// such a line but for rounding.
Handle(Geom2d_Line) uprightSeam(const TopoDS_Edge& edge, const TopoDS_Face& cone) {
  constexpr double kRounding = 1e-9;
  double first = 0, last = 0;
  const auto line = Handle(Geom2d_Line)::DownCast(BRep_Tool::CurveOnSurface(edge, cone, first, last));
  if (line.IsNull() || std::abs(line->Direction().X()) > kRounding) return {};
  const double u = line->Value((first + last) / 2).X();
  return new Geom2d_Line(gp_Pnt2d(u, line->Location().Y()), gp_Dir2d(0, line->Direction().Y()));
}

/// OpenCASCADE's mesher tells the two lines of a cone's seam from each other by where they begin, infinitely far away:
/// if they are upright but for rounding, it takes the wrong one, and gives the face up.
void straightenSeams(const TopoDS_Shape& shape) {
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Face face = TopoDS::Face(faces.Current().Oriented(TopAbs_FORWARD));
    if (BRepAdaptor_Surface(face, Standard_False).GetType() != GeomAbs_Cone) continue;
    for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(edges.Current().Oriented(TopAbs_FORWARD));
      if (!BRep_Tool::IsClosed(edge, face)) continue;
      const Handle(Geom2d_Line) line = uprightSeam(edge, face);
      const Handle(Geom2d_Line) other = uprightSeam(TopoDS::Edge(edge.Reversed()), face);
      if (line.IsNull() || other.IsNull()) continue;
      BRep_Builder().UpdateEdge(edge, line, other, face, BRep_Tool::Tolerance(edge));
    }
  }
}

/// Ends the mesher's work on a face after so many points: it asks before each whether to go on. Says meanwhile that it
/// does.
class PointLimit : public Message_ProgressIndicator {
public:
  PointLimit(int most, std::function<void()> goesOn) : left_(most), goesOn_(std::move(goesOn)) {}
  bool isReached() const { return left_ < 0; }

protected:
  Standard_Boolean UserBreak() override {
    constexpr int kPointsPerSign = 10000;
    if (left_ < 0 || --left_ < 0) return Standard_True;
    if (left_ % kPointsPerSign == 0 && goesOn_) goesOn_();
    return Standard_False;
  }
  void Show(const Message_ProgressScope&, const Standard_Boolean) override {}

private:
  int left_;
  std::function<void()> goesOn_;
};

/// The faces that the mesher gave up, noted by several threads.
class GivenUp {
public:
  void add(int face) {
    const std::scoped_lock lock(mutex_);
    faces_.insert(face);
  }
  bool contains(int face) const { return faces_.contains(face); }

private:
  std::mutex mutex_;
  std::set<int> faces_;
};

/// The mesher's own way with a face, watched; or none, for a face that is to be left.
class WatchedAlgo : public IMeshTools_MeshAlgo {
public:
  WatchedAlgo(Handle(IMeshTools_MeshAlgo) algo, const FaceNumbers& numbers, const FaceMeshOptions& options,
              GivenUp& givenUp)
      : algo_(std::move(algo)), numbers_(numbers), options_(options), givenUp_(givenUp) {}

  void Perform(const IMeshData::IFaceHandle& face, const IMeshTools_Parameters& parameters,
               const Message_ProgressRange&) override {
    const auto found = numbers_.find(face->GetFace().TShape().get());
    const int number = found == numbers_.end() ? 0 : found->second;
    if (options_.left.contains(number) || (options_.leaveAll && !isFlat(face->GetFace()))) return;
    if (options_.begins) options_.begins(number);
    const Handle(PointLimit) limit = new PointLimit(options_.mostPoints, [this, number] {
      if (options_.goesOn) options_.goesOn(number);
    });
    algo_->Perform(face, parameters, limit->Start());
    if (limit->isReached()) givenUp_.add(number);
    if (options_.ends) options_.ends(number);
  }

private:
  Handle(IMeshTools_MeshAlgo) algo_;
  const FaceNumbers& numbers_;
  const FaceMeshOptions& options_;
  GivenUp& givenUp_;
};

class WatchedAlgos : public BRepMesh_MeshAlgoFactory {
public:
  WatchedAlgos(const FaceNumbers& numbers, const FaceMeshOptions& options, GivenUp& givenUp)
      : numbers_(numbers), options_(options), givenUp_(givenUp) {}

  Handle(IMeshTools_MeshAlgo)
      GetAlgo(const GeomAbs_SurfaceType type, const IMeshTools_Parameters& parameters) const override {
    const Handle(IMeshTools_MeshAlgo) algo = BRepMesh_MeshAlgoFactory::GetAlgo(type, parameters);
    return algo.IsNull() ? algo : new WatchedAlgo(algo, numbers_, options_, givenUp_);
  }

private:
  const FaceNumbers& numbers_;
  const FaceMeshOptions& options_;
  GivenUp& givenUp_;
};

/// A grid as triangles of the face, in the face's own frame; none where the face has no extent.
Handle(Poly_Triangulation) triangulation(const CadFace& face, const FaceGrid& grid) {
  const auto count = static_cast<int>(grid.triangles().size());
  if (count == 0) return {};
  Handle(Poly_Triangulation) mesh = new Poly_Triangulation(3 * count, count, Standard_True);
  int node = 0;
  for (int i = 0; i < count; ++i) {
    for (const Vector2& uv : grid.triangles()[static_cast<std::size_t>(i)]) {
      mesh->SetNode(++node, face.surface->Value(uv.x(), uv.y()));
      mesh->SetUVNode(node, {uv.x(), uv.y()});
    }
    mesh->SetTriangle(i + 1, {node - 2, node - 1, node});
  }
  return mesh;
}

bool hasTriangles(const TopoDS_Face& face, int mostPoints = std::numeric_limits<int>::max()) {
  TopLoc_Location location;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
  return !mesh.IsNull() && mesh->HasUVNodes() && mesh->NbTriangles() > 0 && mesh->NbNodes() <= mostPoints;
}

/// True if a face has triangles, and these end at its edges: in narrow places long chords can cross each other.
bool isWhole(const TopoDS_Face& face) {
  TopLoc_Location location;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
  return hasTriangles(face) && endsAtItsEdges(face, mesh, location);
}

/// Gives a face the mesh of a copy of it, its edges' chords too.
void takeMesh(const TopoDS_Face& face, const TopoDS_Face& copy) {
  TopLoc_Location location;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(copy, location);
  if (mesh.IsNull()) return;
  const BRep_Builder builder;
  BRepTools::Clean(face);
  builder.UpdateFace(face, mesh);
  TopExp_Explorer from(copy, TopAbs_EDGE);
  for (TopExp_Explorer to(face, TopAbs_EDGE); to.More() && from.More(); to.Next(), from.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(to.Current().Oriented(TopAbs_FORWARD));
    const TopoDS_Edge its = TopoDS::Edge(from.Current().Oriented(TopAbs_FORWARD));
    const auto chords = BRep_Tool::PolygonOnTriangulation(its, mesh, location);
    if (chords.IsNull()) continue;
    if (BRep_Tool::IsClosed(its, mesh, location)) {
      const auto otherSide = BRep_Tool::PolygonOnTriangulation(TopoDS::Edge(its.Reversed()), mesh, location);
      builder.UpdateEdge(edge, chords, otherSide, mesh, location);
    } else {
      builder.UpdateEdge(edge, chords, mesh, location);
    }
  }
}

/// True for borders that OpenCASCADE got wrong: they run to and fro, and no place lies within.
bool enclosesNothing(const TrimmedDomain& domain) {
  constexpr double kLeastShare = 1e-9;  // of the box about the border
  return !domain.isEverywhere() && domain.area() <= kLeastShare * (domain.high() - domain.low()).prod();
}

/// mm^2, of a grid on a face.
double areaOf(const CadFace& face, const FaceGrid& grid) {
  double area = 0;
  for (const auto& [a, b, c] : grid.triangles()) {
    const Vector3 corner = face.pointAt(a);
    area += (face.pointAt(b) - corner).cross(face.pointAt(c) - corner).norm() / 2;
  }
  return area;
}

/// True for faces whose border runs to and fro on one straight line, as CAD systems leave where a narrow face has come
/// to nothing.
bool liesOnALine(const TopoDS_Face& face) {
  constexpr double kWidth = 1e-6;  // mm
  std::vector<gp_Pnt> corners;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(edges.Current());
    if (BRep_Tool::Degenerated(edge)) continue;
    const BRepAdaptor_Curve curve(edge);
    if (curve.GetType() != GeomAbs_Line) return false;
    corners.push_back(curve.Value(curve.FirstParameter()));
    corners.push_back(curve.Value(curve.LastParameter()));
  }
  if (corners.empty()) return false;
  const gp_Pnt begin = corners.front();
  const auto distance = [&](const gp_Pnt& corner) { return begin.Distance(corner); };
  const gp_Pnt end = *std::ranges::max_element(corners, {}, distance);
  if (begin.Distance(end) <= kWidth) return true;
  const gp_Lin line(begin, gp_Dir(gp_Vec(begin, end)));
  return std::ranges::all_of(corners, [&](const gp_Pnt& corner) { return line.Distance(corner) <= kWidth; });
}

/// Gives the faces of a shape triangles, one way after the other.
class FaceMesher {
public:
  FaceMesher(const TopoDS_Shape& shape, double deflection, const FaceMeshOptions& options)
      : options_(options),
        numbers_(numbered(shape)),
        size_(sizeOf(shape)),
        deflection_(deflection),
        fine_(std::min(deflection, coarsest(size_))) {}

  int numberOf(const TopoDS_Face& face) const { return numbers_.at(face.TShape().get()); }

  /// All faces of the shape, by OpenCASCADE's mesher.
  void mesh(const TopoDS_Shape& shape) { mesh(shape, 1, givenUp_); }

  /// A face that has no triangles, or whose triangles end elsewhere than at its edges, with finer chords.
  void meshFiner(const TopoDS_Face& face, int number) {
    if (options_.left.contains(number) || (options_.leaveAll && !isFlat(face))) return;
    for (const double finer : {4, 16}) {
      if (isWhole(face) || givenUp_.contains(number)) return;
      // A copy, as edges that have chords of a neighbour keep these.
      const TopoDS_Face bare = TopoDS::Face(face.Located(TopLoc_Location()));
      const TopoDS_Face copy = TopoDS::Face(BRepBuilderAPI_Copy(bare, Standard_False, Standard_False).Shape());
      numbers_[copy.TShape().get()] = number;
      GivenUp tooFine;
      mesh(copy, finer, tooFine);
      if (tooFine.contains(number)) return;
      if (isWhole(copy) || !hasTriangles(face)) takeMesh(bare, copy);
    }
  }

  bool isMeshed(const TopoDS_Face& face, int number) const {
    return hasTriangles(face, options_.mostPoints) && !givenUp_.contains(number);
  }

  /// A grid for a face; returns it if it is worth telling. A face that has come to nothing gets none.
  std::optional<GridFace> giveGrid(const TopoDS_Face& face, int number) const {
    if (liesOnALine(face)) return std::nullopt;
    GridFace given{number, kindOf(face), 0, 0};
    try {
      const CadFace exact = cadFace(TopoDS::Face(face.Located(TopLoc_Location())));
      if (enclosesNothing(exact.domain)) return given;
      const FaceGrid grid(exact, fine_);
      const Handle(Poly_Triangulation) mesh = triangulation(exact, grid);
      if (mesh.IsNull()) return given;
      // A surface that is nothing but a line or a point, as some systems close wings with.
      constexpr double kNothing = 1e-6;  // mm^2
      if (areaOf(exact, grid) <= kNothing) return std::nullopt;
      mesh->Deflection(deflection_);
      BRep_Builder().UpdateFace(face, mesh);
      given.deviation = grid.deviation();
      given.cell = grid.largestCell();
      if (given.cell <= deflection_) return std::nullopt;
    } catch (const Standard_Failure&) {    // the face stays without triangles, which its entry tells
    } catch (const std::runtime_error&) {  // the same
    }
    return given;
  }

private:
  /// With chords along the edges `finer` times as fine as usual.
  void mesh(const TopoDS_Shape& shape, double finer, GivenUp& givenUp) const {
    const Handle(BRepMesh_Context) context = new BRepMesh_Context();
    context->SetFaceDiscret(new BRepMesh_FaceDiscret(new WatchedAlgos(numbers_, options_, givenUp)));
    BRepMesh_IncrementalMesh mesher;
    mesher.SetShape(shape);
    IMeshTools_Parameters& parameters = mesher.ChangeParameters();
    parameters.Deflection = std::max(kAlongEdges * fine_, kAlongEdgesOfSize * size_) / finer;
    parameters.DeflectionInterior = std::max(kInteriorDeflections * fine_, kInteriorOfSize * size_);
    parameters.Angle = kAngle;
    parameters.InParallel = options_.parallel;
    mesher.Perform(context);
  }

  const FaceMeshOptions& options_;
  FaceNumbers numbers_;
  GivenUp givenUp_;
  double size_, deflection_, fine_;
};

}  // namespace

double sizeOf(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::Add(shape, box, Standard_False);
  return box.IsVoid() || box.IsOpen() ? 0 : box.CornerMin().Distance(box.CornerMax());
}

double suitableDeflection(double asked, double size) {
  return std::max(std::min(asked, coarsest(size)), kFinestOfSize * size);
}

std::size_t faceCount(const TopoDS_Shape& shape) { return numbered(shape).size(); }

bool isMeshed(const TopoDS_Shape& shape, double deflection) {
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Face& face = TopoDS::Face(faces.Current());
    TopLoc_Location location;
    if (!hasTriangles(face) || BRep_Tool::Triangulation(face, location)->Deflection() > deflection) return false;
  }
  return true;
}

std::vector<GridFace> meshFaces(const TopoDS_Shape& shape, double deflection, const FaceMeshOptions& options) {
  BRepTools::Clean(shape);
  straightenSeams(shape);
  FaceMesher mesher(shape, deflection, options);
  mesher.mesh(shape);
  std::vector<GridFace> grids;
  std::set<int> seen;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Face face = TopoDS::Face(faces.Current().Oriented(TopAbs_FORWARD));
    const int number = mesher.numberOf(face);
    if (!seen.insert(number).second) continue;
    mesher.meshFiner(face, number);
    if (mesher.isMeshed(face, number)) {
      TopLoc_Location location;
      BRep_Tool::Triangulation(face, location)->Deflection(deflection);
    } else if (const auto grid = mesher.giveGrid(face, number)) {
      grids.push_back(*grid);
    }
  }
  return grids;
}

}  // namespace probewright::simulation
