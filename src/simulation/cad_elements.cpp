#include "simulation/cad_elements.hpp"

#include <BRep_Tool.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_Line.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Poly_Triangulation.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "simulation/border_sides.hpp"
#include "simulation/cad_deviation.hpp"
#include "simulation/cad_vectors.hpp"
#include "simulation/face_grid.hpp"
#include "simulation/loose_sides.hpp"
#include "simulation/mesh_limits.hpp"

namespace probewright::simulation {
namespace {

constexpr double kLeastGrowth = 1e-6;
constexpr double kChordDeflections = 1.5;
constexpr double kBesideBorders = 1.5;  // deflections, from a bent edge to its chords

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

/// How far the corners of a triangle lie from where its parameters are on a plane: the mesher may have mixed them up.
double distanceFrom(const AnalyticSurface& plane, const CadElement& element) {
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

/// A corner of a triangle.
struct Corner {
  Vector3 point;
  Vector2 parameters;
  double apart = 0;  ///< mm: how far the point lies from where its parameters are on the surface of a free-form face
};

/// A side of a triangle.
struct Side {
  std::optional<BorderSides::Side> bent = std::nullopt;  ///< the part of a bent edge that it lies on
  bool isBorder = false;                                 ///< no triangle lies beyond it
};

/// A triangle, halved along those of its sides that are parts of bent edges until they are near enough: side k runs
/// from corner k to the next. `middleOf(side)` is a corner in the middle of such a part, if it is not near enough.
template <class MiddleOf, class Add>
void addParts(const std::array<Corner, 3>& corners, const std::array<Side, 3>& sides, const MiddleOf& middleOf,
              int halvings, const Add& add) {
  constexpr int kMost = 6;
  std::array<std::optional<Corner>, 3> middles;
  for (std::size_t k = 0; k < 3 && halvings < kMost; ++k) {
    if (sides[k].bent) middles[k] = middleOf(*sides[k].bent);
  }
  const auto count = std::ranges::count_if(middles, [](const auto& middle) { return middle.has_value(); });
  if (count == 0) return add(corners, {sides[0].isBorder, sides[1].isBorder, sides[2].isBorder});
  // Turned so that its first side has a middle and, of two, its last has none.
  std::size_t k = 0;
  while (!middles[k] || (count == 2 && middles[(k + 2) % 3]))
    ++k;
  const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
  const auto part = [&](const Corner& a, const Corner& b, const Corner& c, const Side& ab, const Side& bc,
                        const Side& ca) {
    addParts({a, b, c}, {ab, bc, ca}, middleOf, halvings + 1, add);
  };
  const auto first = [&](std::size_t side) { return Side{sides[side].bent->firstHalf(), sides[side].isBorder}; };
  const auto second = [&](std::size_t side) { return Side{sides[side].bent->secondHalf(), sides[side].isBorder}; };
  // One that is straight enough.
  const auto whole = [&](std::size_t side) { return Side{std::nullopt, sides[side].isBorder}; };
  const Corner &a = corners[k], &b = corners[l], &c = corners[m], &ab = *middles[k];
  if (count == 1) {
    part(a, ab, c, first(k), {}, whole(m));
    part(ab, b, c, second(k), whole(l), {});
    return;
  }
  const Corner& bc = *middles[l];
  part(ab, b, bc, second(k), first(l), {});
  if (count == 2) {
    part(a, ab, bc, first(k), {}, {});
    part(a, bc, c, {}, second(l), whole(m));
    return;
  }
  const Corner& ca = *middles[m];
  part(a, ab, ca, first(k), {}, second(m));
  part(ca, bc, c, {}, second(l), first(m));
  add({ab, bc, ca}, {false, false, false});
}

double deviationAt(const CadElement& element, const CadFace& face, double a, double b) {
  const double c = 1 - a - b;
  const Vector2 uv = a * element.parameters[0] + b * element.parameters[1] + c * element.parameters[2];
  return (face.pointAt(uv) - (a * element.corners[0] + b * element.corners[1] + c * element.corners[2])).norm();
}

}  // namespace

double deviationOf(const CadElement& element, const CadFace& face) {
  constexpr double half = 1.0 / 2, third = 1.0 / 3, sixth = 1.0 / 6;
  constexpr std::array<std::array<double, 2>, 7> places{
      {{half, half}, {0, half}, {half, 0}, {third, third}, {4 * sixth, sixth}, {sixth, 4 * sixth}, {sixth, sixth}}};
  double deviation = 0;
  for (const auto& [a, b] : places)
    deviation = std::max(deviation, deviationAt(element, face, a, b));
  return deviation;
}

namespace {

/// How far a face leaves an element at most; `sampled` as far as the samples show.
double largestDeviation(const CadElement& element, const CadFace& face, double sampled, double apart) {
  constexpr double kMostSteps = 24;
  return face.freeform ? certainDeviation(element, face, kDeviationSafety * sampled, apart, kMostSteps)
                       : kDeviationSafety * sampled;
}

double cornersOff(const CadElement& element, const CadFace& face) {
  return face.freeform ? cornersApart(element, face) : 0;
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
      element.corners[k] = exact.pointAt(element.parameters[k]);
    }
    element.onFace = exact.domain.contains((cell[0] + cell[1] + cell[2]) / 3);
    element.growth =
        kLeastGrowth + largestDeviation(element, exact, deviationOf(element, exact), cornersOff(element, exact));
    elements.push_back(element);
  }
  return elements;
}

constexpr int kMostHalvings = 12;

/// Gives an element to `keep`, or its halves where the face leaves it further than is enough, as the mesher's look at a
/// few places of large triangles may miss. A triangle is cut at the side that the face leaves furthest, or at its
/// longest where the face leaves all sides by little.
template <class Keep>
void addHalves(CadElement& element, const CadFace& face, double apart, double enough, int halvings, const Keep& keep) {
  const double sampled = deviationOf(element, face);
  // Little is gained where only the bounds are coarse.
  constexpr int kForBounds = 4;
  const bool isTooFar = sampled > enough;
  const int left = halvings - (isTooFar ? 1 : kForBounds);
  // What is halved in any case needs no bounds.
  const double deviation =
      isTooFar && left >= 0 ? kDeviationSafety * sampled : largestDeviation(element, face, sampled, apart);
  if (left < 0 || !(deviation > kDeviationSafety * enough)) return keep(element, deviation);
  std::array<Vector3, 3> middles;
  std::array<double, 3> lengths{}, offs{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
    const Vector2 uv = (element.parameters[k] + element.parameters[l]) / 2;
    middles[k] = face.pointAt(uv);
    offs[k] = (middles[k] - (element.corners[k] + element.corners[l]) / 2).norm();
    lengths[k] = (element.corners[k] - element.corners[l]).norm();
  }
  constexpr double kWorthIt = 0.17;
  const bool bent = *std::ranges::max_element(offs) > kWorthIt * deviation;
  const auto& sizes = bent ? offs : lengths;
  const auto k = static_cast<std::size_t>(std::ranges::max_element(sizes) - sizes.begin());
  const std::size_t l = (k + 1) % 3;
  const Vector2 middle = (element.parameters[k] + element.parameters[l]) / 2;
  for (const std::size_t corner : {l, k}) {
    CadElement half = element;
    half.corners[corner] = middles[k];
    half.parameters[corner] = middle;
    half.setBorder(corner == l ? l : (k + 2) % 3, false);
    addHalves(half, face, apart, enough, left, keep);
  }
}

}  // namespace

double growthBesideBorders(double deflection) { return kDeviationSafety * kBesideBorders * deflection + kLeastGrowth; }

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
  const BorderSides borders(face, mesh, location);
  const auto cornerAt = [&](const Vector3& point, const Vector2& parameters) {
    const double apart = exact.freeform ? ((**exact.freeform).pointAt(parameters) - point).norm() : 0;
    return Corner{point, parameters, apart};
  };
  const auto middleOf = [&](const BorderSides::Side& side) -> std::optional<Corner> {
    const auto middle = borders.middle(side, deflection);
    return middle ? std::optional(cornerAt(middle->point, middle->parameters)) : std::nullopt;
  };
  const LooseSides onBorder(*mesh);
  const auto add = [&](const std::array<Corner, 3>& corners, const std::array<bool, 3>& isBorder) {
    CadElement element;
    element.owner = owner;
    for (std::size_t k = 0; k < 3; ++k) {
      element.corners[k] = corners[k].point;
      element.parameters[k] = corners[k].parameters;
      element.setBorder(k, isBorder[k]);
    }
    area += areaInParameters(element);
    const auto keep = [&](CadElement& part, double deviation) {
      // Between a bent border and its chord no triangle lies.
      part.growth = std::max(kLeastGrowth + deviation, straight ? 0.0 : growthBesideBorders(deflection));
      elements.push_back(part);
    };
    if (flat) return keep(element, kDeviationSafety * distanceFrom(exact.forms.sheets.front(), element));
    const int halvings = elements.size() < kMostMeshPoints ? kMostHalvings : 0;
    // A little more finely than the mesher: that costs less here than in each contact.
    const double apart = std::max({corners[0].apart, corners[1].apart, corners[2].apart});
    addHalves(element, exact, apart, kInteriorDeflections / 2 * deflection, halvings, keep);
  };
  std::vector<Corner> cornerOf;
  for (int i = 1; i <= mesh->NbNodes(); ++i) {
    const gp_Pnt2d uv = mesh->UVNode(i);
    cornerOf.push_back(cornerAt(vector(mesh->Node(i).Transformed(transform)), {uv.X(), uv.Y()}));
  }
  for (int i = 1; i <= mesh->NbTriangles(); ++i) {
    std::array<int, 3> nodes{};
    mesh->Triangle(i).Get(nodes[0], nodes[1], nodes[2]);
    if (exact.reversed) std::swap(nodes[1], nodes[2]);
    std::array<Corner, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = cornerOf[static_cast<std::size_t>(nodes[k] - 1)];
    std::array<Side, 3> sides;
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = nodes[k], to = nodes[(k + 1) % 3];
      sides[k] = {borders.between(from, to), onBorder.contains(from, to)};
    }
    addParts(corners, sides, middleOf, 0, add);
  }
  // Triangles that leave a part of the face open would hide it.
  constexpr double kLeastCover = 0.9;
  if (area < kLeastCover * exact.domain.area()) return gridElements(exact, owner, deflection);
  if (!straight && !endsAtItsEdges(face, mesh, location)) {
    for (CadElement& element : gridElements(exact, owner, deflection)) {
      element.onFace = false;
      elements.push_back(element);
    }
  }
  return elements;
}

std::vector<CadElement> edgeElements(const CadEdge& edge, std::uint32_t owner, double deflection) {
  const FreeformCurve& curve = **edge.bounded;
  const auto at = [&](double t) { return curve.at(t).point; };
  const auto deviation = [&](double a, double b) { return curve.bends(a, b).fromChord(b - a); };
  std::vector<double> parameters{edge.first};
  const std::vector<double> smooth = smoothParts(edge);
  const int pieces = edge.kind == CadEdge::Kind::Line ? 1 : std::max(1, 8 / static_cast<int>(smooth.size()));
  double from = edge.first;
  for (const double to : smooth) {
    for (int i = 0; i < pieces; ++i) {
      subdivide(
          from + (to - from) * i / pieces, from + (to - from) * (i + 1) / pieces,
          edge.kind == CadEdge::Kind::Line ? 0 : 12,
          [&](double a, double b) { return deviation(a, b) > kChordDeflections * deflection; }, parameters);
    }
    from = to;
  }
  std::vector<CadElement> elements;
  for (std::size_t i = 0; i + 1 < parameters.size(); ++i) {
    CadElement element;
    element.kind = CadElement::Kind::Edge;
    element.owner = owner;
    element.corners = {at(parameters[i]), at(parameters[i + 1]), at(parameters[i + 1])};
    element.parameters = {Vector2(parameters[i], 0), Vector2(parameters[i + 1], 0), Vector2(parameters[i + 1], 0)};
    element.growth =
        kLeastGrowth + (edge.kind == CadEdge::Kind::Line ? 0 : deviation(parameters[i], parameters[i + 1]));
    elements.push_back(element);
  }
  return elements;
}

}  // namespace probewright::simulation
