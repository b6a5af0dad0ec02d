#include "simulation/face_mesh.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepMesh_Context.hxx>
#include <BRepMesh_FaceDiscret.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepMesh_MeshAlgoFactory.hxx>
#include <BRepTools.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom_Surface.hxx>
#include <IMeshData_Face.hxx>
#include <Poly_Triangulation.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <map>

namespace probewright::simulation {
namespace {

/// Ball and shaft meet what lies within the deflection of a face; the angle only keeps small curves recognizable.
constexpr double kAngle = 0.5;
constexpr int kMostCells = 10'000;
constexpr int kMostCellsAcross = 400;

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

/// The mesher's own way with a face, watched; or none, for a face that is to be left.
class WatchedAlgo : public IMeshTools_MeshAlgo {
public:
  WatchedAlgo(Handle(IMeshTools_MeshAlgo) algo, const FaceNumbers& numbers, const FaceMeshOptions& options)
      : algo_(std::move(algo)), numbers_(numbers), options_(options) {}

  void Perform(const IMeshData::IFaceHandle& face, const IMeshTools_Parameters& parameters,
               const Message_ProgressRange& range) override {
    const auto found = numbers_.find(face->GetFace().TShape().get());
    const int number = found == numbers_.end() ? 0 : found->second;
    if (options_.left.contains(number) || (options_.leaveAll && !isFlat(face->GetFace()))) return;
    if (options_.begins) options_.begins(number);
    algo_->Perform(face, parameters, range);
    if (options_.ends) options_.ends(number);
  }

private:
  Handle(IMeshTools_MeshAlgo) algo_;
  const FaceNumbers& numbers_;
  const FaceMeshOptions& options_;
};

class WatchedAlgos : public BRepMesh_MeshAlgoFactory {
public:
  WatchedAlgos(const FaceNumbers& numbers, const FaceMeshOptions& options) : numbers_(numbers), options_(options) {}

  Handle(IMeshTools_MeshAlgo)
      GetAlgo(const GeomAbs_SurfaceType type, const IMeshTools_Parameters& parameters) const override {
    const Handle(IMeshTools_MeshAlgo) algo = BRepMesh_MeshAlgoFactory::GetAlgo(type, parameters);
    return algo.IsNull() ? algo : new WatchedAlgo(algo, numbers_, options_);
  }

private:
  const FaceNumbers& numbers_;
  const FaceMeshOptions& options_;
};

/// Cells over the parameters of a face, each halved along u or v until it is true to the surface.
class Grid {
public:
  Grid(const TopoDS_Face& face, double deflection) : face_(face), surface_(BRep_Tool::Surface(face, location_)) {
    BRepTools::UVBounds(face, u0_, u1_, v0_, v1_);
    for (double* bound : {&u0_, &v0_})
      *bound = std::max(*bound, -kFarthest);
    for (double* bound : {&u1_, &v1_})
      *bound = std::min(*bound, kFarthest);
    refine(deflection);
  }

  Handle(Poly_Triangulation) triangles() {
    const BRepTopAdaptor_FClass2d domain(face_, Precision::PConfusion());
    std::vector<std::pair<int, int>> inside;
    for (int i = 0; i < columns_; ++i) {
      for (int j = 0; j < rows_; ++j) {
        if (touches(domain, i, j)) inside.emplace_back(i, j);
      }
    }
    if (inside.empty()) return {};
    const Handle(Poly_Triangulation) mesh =
        new Poly_Triangulation((columns_ + 1) * (rows_ + 1), 2 * static_cast<int>(inside.size()), Standard_True);
    for (int i = 0; i <= columns_; ++i) {
      for (int j = 0; j <= rows_; ++j) {
        mesh->SetNode(node(i, j), at(i, j));
        mesh->SetUVNode(node(i, j), {u(i), v(j)});
      }
    }
    int next = 0;
    for (const auto& [i, j] : inside) {
      mesh->SetTriangle(++next, {node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      mesh->SetTriangle(++next, {node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
    return mesh;
  }

  double deviation() const { return std::max(deviationAlong(true), deviationAlong(false)); }

  double largestCell() const {
    double largest = 0;
    for (int i = 0; i < columns_; ++i) {
      for (int j = 0; j < rows_; ++j)
        largest = std::max(largest, at(i, j).Distance(at(i + 1, j + 1)));
    }
    return largest;
  }

private:
  static constexpr double kFarthest = 1e5;

  double u(double i) const { return u0_ + (u1_ - u0_) * i / columns_; }
  double v(double j) const { return v0_ + (v1_ - v0_) * j / rows_; }
  gp_Pnt at(double i, double j) const { return surface_->Value(u(i), v(j)); }
  int node(int i, int j) const { return 1 + i * (rows_ + 1) + j; }

  /// How far the surface leaves the middle of the cells' sides along u, or v.
  double deviationAlong(bool alongU) const {
    double largest = 0;
    for (int i = 0; i < columns_; ++i) {
      for (int j = 0; j < rows_; ++j) {
        const gp_Pnt middle = alongU ? at(i + 0.5, j) : at(i, j + 0.5);
        const gp_XYZ chord = (at(i, j).XYZ() + (alongU ? at(i + 1, j) : at(i, j + 1)).XYZ()) / 2;
        largest = std::max(largest, (middle.XYZ() - chord).Modulus());
      }
    }
    return largest;
  }

  void refine(double deflection) {
    while (2 * columns_ * rows_ <= kMostCells) {
      const double alongU = deviationAlong(true), alongV = deviationAlong(false);
      const bool halveU =
          alongU > deflection && 2 * columns_ <= kMostCellsAcross && (alongU >= alongV || rows_ > columns_);
      const bool halveV = alongV > deflection && 2 * rows_ <= kMostCellsAcross;
      if (halveU) {
        columns_ *= 2;
      } else if (halveV) {
        rows_ *= 2;
      } else if (alongU > deflection && 2 * columns_ <= kMostCellsAcross) {
        columns_ *= 2;
      } else {
        break;
      }
    }
  }

  bool touches(const BRepTopAdaptor_FClass2d& domain, int i, int j) const {
    for (const auto& [di, dj] : {std::pair(0.5, 0.5), {0.02, 0.02}, {0.98, 0.02}, {0.98, 0.98}, {0.02, 0.98}}) {
      if (domain.Perform({u(i + di), v(j + dj)}) != TopAbs_OUT) return true;
    }
    return false;
  }

  TopoDS_Face face_;
  TopLoc_Location location_;
  Handle(Geom_Surface) surface_;
  double u0_ = 0, u1_ = 1, v0_ = 0, v1_ = 1;
  int columns_ = 16;
  int rows_ = 16;
};

bool hasTriangles(const TopoDS_Face& face) {
  TopLoc_Location location;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
  return !mesh.IsNull() && mesh->HasUVNodes() && mesh->NbTriangles() > 0;
}

}  // namespace

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
  const FaceNumbers numbers = numbered(shape);
  BRepTools::Clean(shape);
  const Handle(BRepMesh_Context) context = new BRepMesh_Context();
  context->SetFaceDiscret(new BRepMesh_FaceDiscret(new WatchedAlgos(numbers, options)));
  BRepMesh_IncrementalMesh mesher;
  mesher.SetShape(shape);
  IMeshTools_Parameters& parameters = mesher.ChangeParameters();
  parameters.Deflection = deflection;
  parameters.Angle = kAngle;
  parameters.InParallel = options.parallel;
  mesher.Perform(context);

  std::vector<GridFace> grids;
  std::set<int> seen;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Face face = TopoDS::Face(faces.Current().Oriented(TopAbs_FORWARD));
    const int number = numbers.at(face.TShape().get());
    if (!seen.insert(number).second) continue;
    if (hasTriangles(face)) {
      TopLoc_Location location;
      BRep_Tool::Triangulation(face, location)->Deflection(deflection);
      continue;
    }
    GridFace found{number, kindOf(face), 0, 0};
    try {
      Grid grid(face, deflection);
      const Handle(Poly_Triangulation) mesh = grid.triangles();
      if (!mesh.IsNull()) {
        mesh->Deflection(deflection);
        BRep_Builder().UpdateFace(face, mesh);
        found.deviation = grid.deviation();
        found.cell = grid.largestCell();
      }
    } catch (const Standard_Failure&) {  // the face stays without triangles, which its entry tells
    }
    grids.push_back(std::move(found));
  }
  return grids;
}

}  // namespace probewright::simulation
