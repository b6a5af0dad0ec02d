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
#include "simulation/cad_vectors.hpp"
#include "simulation/face_grid.hpp"
#include "simulation/mesh_limits.hpp"

namespace probewright::simulation {
namespace {

constexpr double kLeastGrowth = 1e-6;
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

/// A grid over the face, for a mesh that leaves a part of it open. It finds contacts of balls as well as a mesh does;
/// contacts of anything else err by a cell at the borders.
std::vector<CadElement> gridElements(const CadFace& exact, std::uint32_t owner, double deflection) {
  std::vector<CadElement> elements;
  const FaceGrid grid(exact, deflection);
  const GeomAdaptor_Surface surface(exact.surface);
  for (const FaceGrid::Parameters& cell : grid.triangles()) {
    CadElement element;
    element.owner = owner;
    for (std::size_t k = 0; k < 3; ++k) {
      element.parameters[k] = cell[exact.reversed ? 2 - k : k];
      element.corners[k] = vector(exact.surface->Value(element.parameters[k].x(), element.parameters[k].y()));
    }
    element.onFace = exact.domain.contains((cell[0] + cell[1] + cell[2]) / 3);
    element.growth = kLeastGrowth + kDeviationSafety * deviationOf(element, surface);
    elements.push_back(element);
  }
  return elements;
}

using Corner = BorderSides::Point;
using Side = std::optional<BorderSides::Side>;

/// A triangle, halved along those of its sides that are parts of bent edges until they are near enough: side k runs
/// from corner k to the next.
template <class Add>
void addParts(const std::array<Corner, 3>& corners, const std::array<Side, 3>& sides, const BorderSides& borders,
              double deviation, int halvings, const Add& add) {
  constexpr int kMost = 6;
  std::array<std::optional<Corner>, 3> middles;
  for (std::size_t k = 0; k < 3 && halvings < kMost; ++k) {
    if (sides[k]) middles[k] = borders.middle(*sides[k], deviation);
  }
  const auto count = std::ranges::count_if(middles, [](const auto& middle) { return middle.has_value(); });
  if (count == 0) return add(corners[0], corners[1], corners[2]);
  // Turned so that its first side has a middle and, of two, its last has none.
  std::size_t k = 0;
  while (!middles[k] || (count == 2 && middles[(k + 2) % 3]))
    ++k;
  const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
  const auto part = [&](const Corner& a, const Corner& b, const Corner& c, const Side& ab, const Side& bc,
                        const Side& ca) {
    addParts({a, b, c}, {ab, bc, ca}, borders, deviation, halvings + 1, add);
  };
  const auto first = [&](std::size_t side) { return Side(sides[side]->firstHalf()); };
  const auto second = [&](std::size_t side) { return Side(sides[side]->secondHalf()); };
  const Corner &a = corners[k], &b = corners[l], &c = corners[m], &ab = *middles[k];
  if (count == 1) {
    part(a, ab, c, first(k), {}, {});
    part(ab, b, c, second(k), {}, {});
    return;
  }
  const Corner& bc = *middles[l];
  part(ab, b, bc, second(k), first(l), {});
  if (count == 2) {
    part(a, ab, bc, first(k), {}, {});
    part(a, bc, c, {}, second(l), {});
    return;
  }
  const Corner& ca = *middles[m];
  part(a, ab, ca, first(k), {}, second(m));
  part(ca, bc, c, {}, second(l), first(m));
  add(ab, bc, ca);
}

template <class Surface>
double deviationAt(const CadElement& element, const Surface& surface, double a, double b) {
  const double c = 1 - a - b;
  const Vector2 uv = a * element.parameters[0] + b * element.parameters[1] + c * element.parameters[2];
  const Vector3 chord = a * element.corners[0] + b * element.corners[1] + c * element.corners[2];
  return (vector(surface.Value(uv.x(), uv.y())) - chord).norm();
}

template <class Surface>
double sampledDeviation(const CadElement& element, const Surface& surface) {
  constexpr double half = 1.0 / 2, third = 1.0 / 3, sixth = 1.0 / 6;
  constexpr std::array<std::array<double, 2>, 7> places{
      {{half, half}, {0, half}, {half, 0}, {third, third}, {4 * sixth, sixth}, {sixth, 4 * sixth}, {sixth, sixth}}};
  double deviation = 0;
  for (const auto& [a, b] : places)
    deviation = std::max(deviation, deviationAt(element, surface, a, b));
  return deviation;
}

/// How far a free-form face leaves its triangles, sampled so that no wave of it remains unseen.
class Deviations {
public:
  Deviations(const CadFace& face, const Adaptor3d_Surface& surface)
      : face_(face),
        surface_(surface),
        free_(face.forms.count == 0),
        knotsU_(knotsOf(face, true)),
        knotsV_(knotsOf(face, false)) {}

  double of(const CadElement& element) const {
    // Between many knots the adaptor is slower than the surface.
    if (!free_ || !isShort(knotsU_) || !isShort(knotsV_)) return sampledDeviation(element, *face_.surface);
    const double deviation = sampledDeviation(element, surface_);
    const std::ptrdiff_t knots = knotsWithin(element);
    constexpr std::ptrdiff_t kFew = 2, kBent = 8, kMostKnots = kMostStretches;
    const bool bent = isBent(element, deviation);
    if (knots < kFew && !bent) return deviation;
    const auto order = static_cast<double>(std::clamp(knots + 1, bent ? kBent : kFew, kMostKnots));
    double found = deviation;
    for (double i = 0; i <= order; ++i) {
      for (double j = 0; i + j <= order; ++j)
        found = std::max(found, deviationAt(element, surface_, i / order, j / order));
    }
    return found;
  }

private:
  struct Knots {
    std::vector<double> within;
    double period = 0;
  };

  static Knots knotsOf(const CadFace& face, bool alongU) {
    Knots knots;
    const Vector2 &low = face.domain.low(), &high = face.domain.high();
    if (face.forms.count > 0 || face.surface->IsKind(STANDARD_TYPE(Geom_OffsetSurface))) return knots;
    if (!(low.x() < high.x() && low.y() < high.y())) return knots;
    const GeomAdaptor_Surface surface(face.surface, low.x(), high.x(), low.y(), high.y());
    TColStd_Array1OfReal bounds(1, (alongU ? surface.NbUIntervals(GeomAbs_CN) : surface.NbVIntervals(GeomAbs_CN)) + 1);
    alongU ? surface.UIntervals(bounds, GeomAbs_CN) : surface.VIntervals(bounds, GeomAbs_CN);
    knots.within.assign(bounds.begin(), bounds.end());
    if (alongU ? face.surface->IsUPeriodic() : face.surface->IsVPeriodic())
      knots.period = alongU ? face.surface->UPeriod() : face.surface->VPeriod();
    return knots;
  }

  /// How many knots of the surface lie between the corners.
  static std::ptrdiff_t crossed(const Knots& knots, double a, double b, double c) {
    if (knots.within.size() < 3) return 0;
    const auto [low, high] = std::minmax({a, b, c});
    const double shift = knots.period > 0 ? knots.period * std::floor((low - knots.within.front()) / knots.period) : 0;
    const auto first = std::ranges::upper_bound(knots.within, low - shift);
    const auto last = std::ranges::lower_bound(knots.within, high - shift);
    return std::max<std::ptrdiff_t>(0, last - first);
  }

  std::ptrdiff_t knotsWithin(const CadElement& element) const {
    const auto& [p, q, r] = element.parameters;
    return std::max(crossed(knotsU_, p.x(), q.x(), r.x()), crossed(knotsV_, p.y(), q.y(), r.y()));
  }

  static bool isShort(const Knots& knots) { return knots.within.size() <= kMostStretches + 1; }

  static bool isBent(const CadElement& element, double deviation) {
    constexpr double kShare = 0.08;  // of its longest side: an arc of 36 degrees
    const auto& [a, b, c] = element.corners;
    return deviation > kShare * std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  }

  const CadFace& face_;
  const Adaptor3d_Surface& surface_;
  bool free_;
  Knots knotsU_, knotsV_;
};

constexpr int kMostHalvings = 12;

/// Gives an element to `keep`, or its halves where the face leaves it further than is enough, as the mesher's look at a
/// few places of large triangles may miss. A triangle is cut at the side that the face leaves furthest, or at its
/// longest where the face leaves all sides by little.
template <class Keep>
void addHalves(CadElement& element, const Adaptor3d_Surface& surface, const Deviations& deviations, double enough,
               int halvings, const Keep& keep) {
  const double deviation = deviations.of(element);
  if (halvings == 0 || !(deviation > enough)) return keep(element, deviation);
  std::array<Vector3, 3> middles;
  std::array<double, 3> lengths{}, offs{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
    const Vector2 uv = (element.parameters[k] + element.parameters[l]) / 2;
    middles[k] = vector(surface.Value(uv.x(), uv.y()));
    offs[k] = (middles[k] - (element.corners[k] + element.corners[l]) / 2).norm();
    lengths[k] = (element.corners[k] - element.corners[l]).norm();
  }
  constexpr double kWorthIt = 0.25;
  const bool bent = *std::ranges::max_element(offs) > kWorthIt * deviation;
  const auto& sizes = bent ? offs : lengths;
  const auto k = static_cast<std::size_t>(std::ranges::max_element(sizes) - sizes.begin());
  const std::size_t l = (k + 1) % 3;
  const Vector2 middle = (element.parameters[k] + element.parameters[l]) / 2;
  for (const std::size_t corner : {l, k}) {
    CadElement half = element;
    half.corners[corner] = middles[k];
    half.parameters[corner] = middle;
    addHalves(half, surface, deviations, enough, halvings - 1, keep);
  }
}

}  // namespace

double deviationOf(const CadElement& element, const Geom_Surface& surface) {
  return sampledDeviation(element, surface);
}

double deviationOf(const CadElement& element, const Adaptor3d_Surface& surface) {
  return sampledDeviation(element, surface);
}

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
  const GeomAdaptor_Surface surface(exact.surface);
  const Deviations deviations(exact, surface);
  const BorderSides borders(face, mesh, location);
  const auto add = [&](const Corner& a, const Corner& b, const Corner& c) {
    CadElement element;
    element.owner = owner;
    element.corners = {a.point, b.point, c.point};
    element.parameters = {a.parameters, b.parameters, c.parameters};
    area += areaInParameters(element);
    const auto keep = [&](CadElement& part, double deviation) {
      // Between a bent border and its chord no triangle lies.
      part.growth =
          std::max(kLeastGrowth + kDeviationSafety * deviation, straight ? 0.0 : growthBesideBorders(deflection));
      elements.push_back(part);
    };
    if (flat) return keep(element, distanceFrom(exact.forms.sheets.front(), element));
    const int halvings = elements.size() < kMostMeshPoints ? kMostHalvings : 0;
    // A little more finely than the mesher: that costs less here than in each contact.
    addHalves(element, surface, deviations, kInteriorDeflections / 2 * deflection, halvings, keep);
  };
  for (int i = 1; i <= mesh->NbTriangles(); ++i) {
    std::array<int, 3> nodes{};
    mesh->Triangle(i).Get(nodes[0], nodes[1], nodes[2]);
    if (exact.reversed) std::swap(nodes[1], nodes[2]);
    std::array<Corner, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const gp_Pnt2d uv = mesh->UVNode(nodes[k]);
      corners[k] = {vector(mesh->Node(nodes[k]).Transformed(transform)), {uv.X(), uv.Y()}};
    }
    addParts(
        corners,
        {borders.between(nodes[0], nodes[1]), borders.between(nodes[1], nodes[2]), borders.between(nodes[2], nodes[0])},
        borders, deflection, 0, add);
  }
  // Triangles that leave a part of the face open would hide it.
  constexpr double kLeastCover = 0.9;
  if (area < kLeastCover * exact.domain.area()) return gridElements(exact, owner, deflection);
  return elements;
}

void addEdgeElements(CadModel& model, std::uint32_t owner, double deflection) {
  const CadEdge& edge = model.edges[owner];
  const GeomAdaptor_Curve curve(edge.curve);
  const auto at = [&](double t) { return vector(curve.Value(t)); };
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

}  // namespace probewright::simulation
