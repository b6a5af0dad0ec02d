#include <BRepAdaptor_Curve.hxx>
#include <BRep_Tool.hxx>
#include <GCPnts_TangentialDeflection.hxx>
#include <Geom_Surface.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shape.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <gp_Vec.hxx>
#include <unordered_map>

#include "simulation/cad_model.hpp"
#include "simulation/cad_solid.hpp"
#include "simulation/parallel.hpp"

namespace probewright::simulation {
namespace {

constexpr double kDeflection = 0.05;  // mm: how far a drawing may leave the surface
constexpr double kAngularDeflection = 0.35;

Vector3 vector(const gp_XYZ& p) { return {p.X(), p.Y(), p.Z()}; }

void append(std::vector<float>& list, const Vector3& p) {
  for (const double coordinate : p)
    list.push_back(static_cast<float>(coordinate));
}

/// The triangles of a face, halved where they leave it further than a drawing may: they were made to find the face.
class FaceDrawing {
public:
  explicit FaceDrawing(const CadFace& face) : face_(face), flat_(face.forms.isPlane()) {}

  void add(const CadElement& triangle) {
    Corners corners{};
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = node(triangle.corners[k], triangle.parameters[k]);
    triangles_.push_back(corners);
  }

  void refine() {
    constexpr int kMostHalvings = 6;
    // Of a face as large as a hall nobody wants them all.
    constexpr std::size_t kEnough = 100'000;
    for (int i = 0; i < kMostHalvings && !flat_ && triangles_.size() < kEnough && halve(); ++i) {
    }
  }

  void appendTo(DrawingMesh& drawing) const {
    const auto first = static_cast<std::uint32_t>(drawing.positions.size() / 3);
    for (const Node& node : nodes_) {
      append(drawing.positions, node.point);
      append(drawing.normals, node.normal);
    }
    for (const Corners& nodes : triangles_) {
      std::array<Eigen::Vector3f, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t corner = first + nodes[k];
        drawing.indices.push_back(corner);
        corners[k] = Eigen::Map<const Eigen::Vector3f>(&drawing.positions[3 * std::size_t{corner}]);
      }
      // At a pole or tip the surface has no normal.
      const Eigen::Vector3f flat = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
      for (const std::uint32_t node : nodes) {
        Eigen::Map<Eigen::Vector3f> normal(&drawing.normals[3 * (std::size_t{first} + node)]);
        if (normal.squaredNorm() < 0.5F) normal = flat;
      }
    }
  }

private:
  struct Node {
    Vector3 point;
    Vector2 parameters;
    Vector3 normal = Vector3::Zero();  ///< outward; zero where the surface has none
  };
  using Corners = std::array<std::uint32_t, 3>;
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  struct Hash {
    std::size_t operator()(const Vector2& p) const {
      return std::hash<double>()(p.x()) * 31 + std::hash<double>()(p.y());
    }
  };

  /// The point of the surface; gives the node its normal.
  Vector3 place(Node& node) const {
    gp_Pnt point;
    gp_Vec u, v;
    face_.surface->D1(node.parameters.x(), node.parameters.y(), point, u, v);
    const Vector3 normal = vector(u.Crossed(v).XYZ());
    if (const double size = normal.norm(); size > 1e-12) node.normal = normal / (face_.reversed ? -size : size);
    return vector(point.XYZ());
  }

  std::uint32_t node(const Vector3& point, const Vector2& parameters) {
    const auto [found, isNew] = numbers_.try_emplace(parameters, static_cast<std::uint32_t>(nodes_.size()));
    if (isNew) {
      Node made{point, parameters};
      place(made);
      nodes_.push_back(made);
    }
    return found->second;
  }

  /// The node between two others if the straight line between them is not near enough to the surface: the same for both
  /// triangles of a side.
  std::uint32_t between(std::uint32_t from, std::uint32_t to) {
    const auto [low, high] = std::minmax(from, to);
    const auto [found, isNew] = middles_.try_emplace(std::uint64_t{low} << 32U | high, kNone);
    if (!isNew) return found->second;
    const Node &a = nodes_[from], &b = nodes_[to];
    Node middle;
    middle.parameters = (a.parameters + b.parameters) / 2;
    middle.point = place(middle);
    const Vector3 line = b.point - a.point, off = middle.point - a.point;
    const double length = line.norm(), deviation = length > 1e-9 ? off.cross(line).norm() / length : off.norm();
    const bool bent =
        a.normal.norm() > 0.5 && b.normal.norm() > 0.5 && a.normal.dot(b.normal) < std::cos(2 * kAngularDeflection);
    if (deviation <= kDeflection && !bent) return kNone;
    found->second = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back(middle);
    return found->second;
  }

  /// Halves sides; false if there was none to halve.
  bool halve() {
    middles_.reserve(3 * triangles_.size());
    std::vector<Corners> made;
    made.reserve(2 * triangles_.size());
    bool any = false;
    for (const Corners& t : triangles_) {
      const Corners middle{between(t[0], t[1]), between(t[1], t[2]), between(t[2], t[0])};
      const auto count = 3 - std::ranges::count(middle, kNone);
      any = any || count > 0;
      if (count == 0) {
        made.push_back(t);
      } else if (count == 3) {
        made.insert(made.end(), {{t[0], middle[0], middle[2]},
                                 {middle[0], t[1], middle[1]},
                                 {middle[2], middle[1], t[2]},
                                 {middle[0], middle[1], middle[2]}});
      } else {
        // Turned so that its first side has a middle and, of two, its last has none.
        std::size_t k = 0;
        while (middle[k] == kNone || (count == 2 && middle[(k + 2) % 3] != kNone))
          ++k;
        const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], ab = middle[k], bc = middle[(k + 1) % 3];
        if (count == 1)
          made.insert(made.end(), {{a, ab, c}, {ab, b, c}});
        else
          made.insert(made.end(), {{ab, b, bc}, {a, ab, bc}, {a, bc, c}});
      }
    }
    triangles_ = std::move(made);
    return any;
  }

  const CadFace& face_;
  bool flat_;
  std::vector<Node> nodes_;
  std::vector<Corners> triangles_;
  std::unordered_map<Vector2, std::uint32_t, Hash> numbers_;  ///< of nodes, by their parameters
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;  ///< by the nodes that they lie between
};

void appendFeatureEdges(DrawingMesh& drawing, const TopoDS_Shape& shape) {
  TopTools_IndexedDataMapOfShapeListOfShape facesOfEdges;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, facesOfEdges);
  for (int i = 1; i <= facesOfEdges.Extent(); ++i) {
    const TopoDS_Edge& edge = TopoDS::Edge(facesOfEdges.FindKey(i));
    const TopTools_ListOfShape& faces = facesOfEdges(i);
    const bool seam = faces.Extent() > 1 && faces.First().IsSame(faces.Last());
    // As between the pieces of one surface. A fillet, which begins at a tangent only, is seen.
    const bool smooth = BRep_Tool::MaxContinuity(edge) >= GeomAbs_C1;
    if (seam || smooth || BRep_Tool::Degenerated(edge)) continue;
    const GCPnts_TangentialDeflection points(BRepAdaptor_Curve(edge), kAngularDeflection, kDeflection);
    std::vector<float> line;
    for (int k = 1; k <= points.NbPoints(); ++k)
      append(line, vector(points.Value(k).XYZ()));
    drawing.featureEdges.push_back(std::move(line));
  }
}

}  // namespace

DrawingMesh CadSolid::drawing() const {
  DrawingMesh drawing;
  std::vector<FaceDrawing> faces(model_->faces.begin(), model_->faces.end());
  for (const CadElement& element : model_->elements) {
    if (element.isTriangle()) faces[element.owner].add(element);
  }
  constexpr std::size_t kWorthAThread = 20;
  try {
    inParallel(faces.size(), kWorthAThread, [&](std::size_t i) { faces[i].refine(); });
    for (const FaceDrawing& face : faces)
      face.appendTo(drawing);
    appendFeatureEdges(drawing, model_->shape);
  } catch (const Standard_Failure&) {
    // A shape that could be prepared for contact can be drawn; what is there so far is drawn in any case.
  }
  return drawing;
}

}  // namespace probewright::simulation
