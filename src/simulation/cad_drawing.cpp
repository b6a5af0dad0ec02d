#include <BRepAdaptor_Curve.hxx>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <GCPnts_TangentialDeflection.hxx>
#include <Geom_Surface.hxx>
#include <Poly_Triangulation.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Vec.hxx>

#include "simulation/cad_solid.hpp"

namespace probewright::simulation {
namespace {

constexpr double kDeflection = 0.05;  // mm: how far a drawing may leave the surface
constexpr double kAngularDeflection = 0.35;
/// A part with more triangles is drawn with those that find its faces: others would take about as long to make.
constexpr std::size_t kMostToCoarsen = 50'000;

template <class Triple>
void append(std::vector<float>& list, const Triple& p) {
  list.push_back(static_cast<float>(p.X()));
  list.push_back(static_cast<float>(p.Y()));
  list.push_back(static_cast<float>(p.Z()));
}

void appendFace(DrawingMesh& drawing, const TopoDS_Face& face) {
  TopLoc_Location location;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
  if (mesh.IsNull()) return;
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  const bool reversed = face.Orientation() == TopAbs_REVERSED;
  const auto first = static_cast<std::uint32_t>(drawing.positions.size() / 3);
  for (int i = 1; i <= mesh->NbNodes(); ++i) {
    append(drawing.positions, mesh->Node(i).Transformed(location.Transformation()));
    gp_Vec normal(0, 0, 0);
    if (mesh->HasUVNodes()) {
      gp_Pnt p;
      gp_Vec u, v;
      surface->D1(mesh->UVNode(i).X(), mesh->UVNode(i).Y(), p, u, v);
      normal = u.Crossed(v);
    }
    // At a pole or tip the surface has no normal; the triangles' own fills in below.
    if (normal.Magnitude() > 1e-12) normal.Normalize();
    if (reversed) normal.Reverse();
    append(drawing.normals, normal);
  }
  for (int i = 1; i <= mesh->NbTriangles(); ++i) {
    std::array<int, 3> nodes{};
    mesh->Triangle(i).Get(nodes[0], nodes[1], nodes[2]);
    if (reversed) std::swap(nodes[1], nodes[2]);
    std::array<Eigen::Vector3f, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = first + static_cast<std::uint32_t>(nodes[k] - 1);
      drawing.indices.push_back(corner);
      corners[k] = Eigen::Map<const Eigen::Vector3f>(&drawing.positions[3 * std::size_t{corner}]);
    }
    const Eigen::Vector3f flat = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    for (const int node : nodes) {
      Eigen::Map<Eigen::Vector3f> normal(
          &drawing.normals[3 * (std::size_t{first} + static_cast<std::size_t>(node - 1))]);
      if (normal.squaredNorm() < 0.5F) normal = flat;
    }
  }
}

/// A shape of as few triangles as a view needs.
TopoDS_Shape coarsened(const TopoDS_Shape& shape) {
  // A copy, because tessellating writes into the shape.
  const TopoDS_Shape copy = BRepBuilderAPI_Copy(shape, Standard_False, Standard_False).Shape();
  BRepMesh_IncrementalMesh mesher(copy, kDeflection, Standard_False, kAngularDeflection);
  return copy;
}

std::size_t triangleCount(const TopoDS_Shape& shape) {
  std::size_t count = 0;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
    TopLoc_Location location;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(TopoDS::Face(faces.Current()), location);
    if (!mesh.IsNull()) count += static_cast<std::size_t>(mesh->NbTriangles());
  }
  return count;
}

}  // namespace

DrawingMesh drawingOf(const TopoDS_Shape& shape, DrawnWith triangles) {
  DrawingMesh drawing;
  try {
    const bool coarsen = triangles == DrawnWith::FewTriangles && triangleCount(shape) <= kMostToCoarsen;
    const TopoDS_Shape drawn = coarsen ? coarsened(shape) : shape;
    for (TopExp_Explorer faces(drawn, TopAbs_FACE); faces.More(); faces.Next()) {
      appendFace(drawing, TopoDS::Face(faces.Current()));
    }
    TopTools_IndexedDataMapOfShapeListOfShape facesOfEdges;
    TopExp::MapShapesAndAncestors(drawn, TopAbs_EDGE, TopAbs_FACE, facesOfEdges);
    for (int i = 1; i <= facesOfEdges.Extent(); ++i) {
      const TopoDS_Edge& edge = TopoDS::Edge(facesOfEdges.FindKey(i));
      const TopTools_ListOfShape& faces = facesOfEdges(i);
      const bool seam = faces.Extent() > 1 && faces.First().IsSame(faces.Last());
      if (seam || BRep_Tool::Degenerated(edge)) continue;
      const GCPnts_TangentialDeflection points(BRepAdaptor_Curve(edge), kAngularDeflection, kDeflection);
      std::vector<float> line;
      for (int k = 1; k <= points.NbPoints(); ++k)
        append(line, points.Value(k));
      drawing.featureEdges.push_back(std::move(line));
    }
  } catch (const Standard_Failure&) {
    // A shape that could be prepared for contact can be drawn; what is there so far is drawn in any case.
  }
  return drawing;
}

DrawingMesh CadSolid::drawing() const {
  return drawing_.empty() ? drawingOf(shape(), DrawnWith::FewTriangles) : drawingFromBytes(drawing_);
}

}  // namespace probewright::simulation
