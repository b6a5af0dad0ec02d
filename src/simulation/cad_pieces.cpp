#include "simulation/cad_pieces.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeUpgrade_FaceDivide.hxx>
#include <ShapeUpgrade_ShapeDivide.hxx>
#include <ShapeUpgrade_SplitSurfaceContinuity.hxx>
#include <ShapeUpgrade_WireDivide.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_HSequenceOfReal.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "simulation/cad_face.hpp"

namespace probewright::simulation {
namespace {

/// The normal of a surface; nothing where it has none.
gp_Vec normalAt(const BRepAdaptor_Surface& surface, double u, double v) {
  gp_Pnt place;
  gp_Vec alongU, alongV;
  surface.D1(u, v, place, alongU, alongV);
  const gp_Vec normal = alongU.Crossed(alongV);
  return normal.Magnitude() > 1e-12 ? normal.Normalized() : gp_Vec(0, 0, 0);
}

/// The parameter along which one goes across.
enum class Across : std::uint8_t { U, V };

/// True if the normal of the surface jumps where its parameter across is `at`. Many surfaces are smooth although their
/// splines need not be: a rational circle of four quarters.
bool isKink(const BRepAdaptor_Surface& surface, Across across, double at) {
  const bool acrossU = across == Across::U;
  constexpr int kPlaces = 12;
  constexpr double kVisible = 1e-3;  // rad
  const double low = acrossU ? surface.FirstVParameter() : surface.FirstUParameter();
  const double high = acrossU ? surface.LastVParameter() : surface.LastUParameter();
  const double step = 1e-7 * (acrossU ? surface.LastUParameter() - surface.FirstUParameter()
                                      : surface.LastVParameter() - surface.FirstVParameter());
  for (int i = 0; i < kPlaces; ++i) {
    const double along = low + (high - low) * (i + 0.5) / kPlaces;
    const gp_Vec before = acrossU ? normalAt(surface, at - step, along) : normalAt(surface, along, at - step);
    const gp_Vec after = acrossU ? normalAt(surface, at + step, along) : normalAt(surface, along, at + step);
    if ((after - before).Magnitude() > kVisible) return true;
  }
  return false;
}

bool hasKinks(const BRepAdaptor_Surface& surface, Across across) {
  const bool acrossU = across == Across::U;
  const int count = acrossU ? surface.NbUIntervals(GeomAbs_C1) : surface.NbVIntervals(GeomAbs_C1);
  if (count < 2) return false;
  TColStd_Array1OfReal bounds(1, count + 1);
  acrossU ? surface.UIntervals(bounds, GeomAbs_C1) : surface.VIntervals(bounds, GeomAbs_C1);
  for (int i = 2; i < bounds.Length(); ++i) {
    if (isKink(surface, across, bounds(i))) return true;
  }
  return false;
}

bool hasKinks(const TopoDS_Face& face) {
  const BRepAdaptor_Surface surface(face);
  switch (surface.GetType()) {
    case GeomAbs_BSplineSurface:
    case GeomAbs_SurfaceOfRevolution:
    case GeomAbs_SurfaceOfExtrusion:
      return hasKinks(surface, Across::U) || hasKinks(surface, Across::V);
    default:
      return false;
  }
}

/// Splines of at least twice as many spans are cut into pieces of about so many.
constexpr std::size_t kSpansOfPiece = 16;

/// The knots between two parameters at which a piece of a long spline ends; none where it is short.
std::vector<double> cutsOfLong(const TColStd_Array1OfReal& knots, double from, double to) {
  const double slack = 1e-6 * (to - from);
  std::vector<double> within;
  for (const double knot : knots) {
    if (knot > from + slack && knot < to - slack) within.push_back(knot);
  }
  const std::size_t spans = within.size() + 1, pieces = spans / kSpansOfPiece;
  std::vector<double> cuts;
  for (std::size_t i = 1; i < pieces; ++i)
    cuts.push_back(within[i * spans / pieces - 1]);
  return cuts;
}

bool isLong(const TopoDS_Face& face) {
  const auto spline = Handle(Geom_BSplineSurface)::DownCast(surfaceWithoutLimits(BRep_Tool::Surface(face)));
  if (spline.IsNull()) return false;
  double fromU = 0, toU = 0, fromV = 0, toV = 0;
  BRepTools::UVBounds(face, fromU, toU, fromV, toV);
  return !cutsOfLong(spline->UKnots(), fromU, toU).empty() || !cutsOfLong(spline->VKnots(), fromV, toV).empty();
}

/// Where a face is cut along its kinks. OpenCASCADE's time grows with the square of the pieces that it makes of a face
/// at once, so it is told of some of the kinks first, then of the others.
class KinkCuts : public ShapeUpgrade_SplitSurfaceContinuity {
public:
  enum class Which : std::uint8_t { Some, All };
  explicit KinkCuts(Which which) : which_(which) { SetCriterion(GeomAbs_C1); }

  void Compute(const Standard_Boolean segment) override {
    ShapeUpgrade_SplitSurfaceContinuity::Compute(segment);
    if (which_ == Which::All) return;
    keepSome(*myUSplitValues);
    keepSome(*myVSplitValues);
  }

private:
  static void keepSome(TColStd_HSequenceOfReal& cuts) {
    const int pieces = cuts.Length() - 1;
    const int together = static_cast<int>(std::ceil(std::sqrt(pieces)));
    for (int i = pieces; i > 1; --i) {
      if ((i - 1) % together != 0) cuts.Remove(i);
    }
  }

  Which which_;
};

/// Where a face on a long spline is cut.
class LongCuts : public ShapeUpgrade_SplitSurface {
public:
  void Compute(const Standard_Boolean) override {
    const auto spline = Handle(Geom_BSplineSurface)::DownCast(mySurface);
    if (spline.IsNull()) return;
    add(*myUSplitValues, spline->UKnots());
    add(*myVSplitValues, spline->VKnots());
  }

private:
  static void add(TColStd_HSequenceOfReal& cuts, const TColStd_Array1OfReal& knots) {
    for (const double cut : cutsOfLong(knots, cuts.First(), cuts.Last()))
      cuts.InsertBefore(cuts.Length(), cut);
  }
};

/// Parameters at both sides of each edge of a face.
std::vector<Vector2> placesBesideEdges(const TopoDS_Face& face, const Vector2& size) {
  constexpr double kBeside = 1e-4;
  std::vector<Vector2> places;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    double first = 0, last = 0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(TopoDS::Edge(edges.Current()), face, first, last);
    if (curve.IsNull()) continue;
    for (const double share : {0.21, 0.5, 0.83}) {
      gp_Pnt2d place;
      gp_Vec2d along;
      curve->D1(first + share * (last - first), place, along);
      Vector2 aside = Vector2(-along.Y(), along.X()).cwiseQuotient(size);
      if (!(aside.norm() > 0)) continue;
      aside = kBeside * aside.normalized().cwiseProduct(size);
      const Vector2 on(place.X(), place.Y());
      places.emplace_back(on + aside);
      places.emplace_back(on - aside);
    }
  }
  return places;
}

/// True if the pieces of a face cover what it covers, and each place once.
bool isCutWell(const TopoDS_Face& whole, const TopoDS_Shape& cut) {
  const CadFace face = cadFace(whole);
  std::vector<CadFace> pieces;
  double area = 0;
  for (TopExp_Explorer found(cut, TopAbs_FACE); found.More(); found.Next()) {
    pieces.push_back(cadFace(TopoDS::Face(found.Current())));
    area += pieces.back().domain.area();
  }
  if (face.domain.isEverywhere()) return true;
  constexpr double kSameArea = 1e-4;
  if (std::abs(area - face.domain.area()) > kSameArea * face.domain.area()) return false;
  const Vector2 size = face.domain.high() - face.domain.low();
  // A piece may lie some periods away.
  const auto shifts = [](bool isPeriodic, double period) {
    return isPeriodic ? std::vector<double>{0, period, -period, 2 * period, -2 * period} : std::vector<double>{0};
  };
  const bool periodicU = face.surface->IsUPeriodic(), periodicV = face.surface->IsVPeriodic();
  const std::vector<double> alongU = shifts(periodicU, periodicU ? face.surface->UPeriod() : 0);
  const std::vector<double> alongV = shifts(periodicV, periodicV ? face.surface->VPeriod() : 0);
  const auto lies = [&](const CadFace& piece, const Vector2& p) {
    return std::ranges::any_of(alongU, [&](double u) {
      return std::ranges::any_of(alongV, [&](double v) { return piece.domain.contains(p + Vector2(u, v)); });
    });
  };
  const std::vector<Vector2> places = placesBesideEdges(TopoDS::Face(whole.Oriented(TopAbs_FORWARD)), size);
  return std::ranges::all_of(places, [&](const Vector2& p) {
    const auto count = std::ranges::count_if(pieces, [&](const CadFace& piece) { return lies(piece, p); });
    return count == (face.domain.contains(p) ? 1 : 0);
  });
}

/// A shape whose faces are being cut.
class Cutting {
public:
  explicit Cutting(const TopoDS_Shape& shape) : shape_(shape) {}

  const TopoDS_Shape& shape() const { return shape_; }

  void cut(const Handle(ShapeUpgrade_SplitSurface) & where) {
    const Handle(ShapeUpgrade_FaceDivide) faces = new ShapeUpgrade_FaceDivide;
    faces->SetSplitSurfaceTool(where);
    faces->SetWireDivideTool({});
    ShapeUpgrade_ShapeDivide divide(shape_);
    divide.SetSplitFaceTool(faces);
    divide.Perform();
    if (divide.Result().IsNull()) return;
    shape_ = divide.Result();
    made_.push_back(divide.GetContext());
  }

  TopoDS_Shape piecesOf(const TopoDS_Face& face) const {
    TopoDS_Shape pieces = face;
    for (const Handle(ShapeBuild_ReShape) & made : made_)
      pieces = made->Apply(pieces);
    return pieces;
  }

  bool isWell(const std::vector<TopoDS_Face>& faces) const {
    return std::ranges::all_of(faces, [&](const TopoDS_Face& face) { return isCutWell(face, piecesOf(face)); });
  }

private:
  TopoDS_Shape shape_;
  std::vector<Handle(ShapeBuild_ReShape)> made_;
};

std::vector<TopoDS_Face> facesThat(const TopoDS_Shape& shape, bool (*are)(const TopoDS_Face&)) {
  std::vector<TopoDS_Face> found;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
    if (are(TopoDS::Face(faces.Current()))) found.push_back(TopoDS::Face(faces.Current()));
  }
  return found;
}

TopoDS_Shape withoutKinks(const TopoDS_Shape& shape) {
  const std::vector<TopoDS_Face> kinked = facesThat(shape, hasKinks);
  if (kinked.empty()) return shape;
  Cutting cutting(shape);
  for (const auto which : {KinkCuts::Which::Some, KinkCuts::Which::All})
    cutting.cut(new KinkCuts(which));
  return cutting.isWell(kinked) ? cutting.shape() : shape;
}

/// Notes that the surface goes on smoothly across the edges between the pieces of a face.
void joinSmoothly(const TopoDS_Shape& pieces) {
  TopTools_IndexedDataMapOfShapeListOfShape facesOfEdges;
  TopExp::MapShapesAndAncestors(pieces, TopAbs_EDGE, TopAbs_FACE, facesOfEdges);
  for (int i = 1; i <= facesOfEdges.Extent(); ++i) {
    if (facesOfEdges(i).Extent() != 2) continue;
    BRep_Builder().Continuity(TopoDS::Edge(facesOfEdges.FindKey(i)), TopoDS::Face(facesOfEdges(i).First()),
                              TopoDS::Face(facesOfEdges(i).Last()), GeomAbs_C1);
  }
}

TopoDS_Shape withoutLongSplines(const TopoDS_Shape& shape) {
  const std::vector<TopoDS_Face> longOnes = facesThat(shape, isLong);
  if (longOnes.empty()) return shape;
  Cutting cutting(shape);
  cutting.cut(new LongCuts);
  if (!cutting.isWell(longOnes)) return shape;
  for (const TopoDS_Face& face : longOnes)
    joinSmoothly(cutting.piecesOf(face));
  return cutting.shape();
}

}  // namespace

TopoDS_Shape inPieces(const TopoDS_Shape& shape) { return withoutLongSplines(withoutKinks(shape)); }

}  // namespace probewright::simulation
