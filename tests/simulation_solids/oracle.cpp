#include "oracle.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepClass_FaceClassifier.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <Geom_Surface.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <IMeshTools_Parameters.hxx>
#include <Message_ProgressIndicator.hxx>
#include <Poly_Triangulation.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <map>

namespace probewright::simulation::testing {

struct Oracle::Face {
  TopoDS_Face face;
  Bnd_Box box;
  std::vector<Vector3> ends;  ///< of the curves of its edges
};

namespace {

template <class Triple>
Vector3 vector(const Triple& p) {
  return {p.X(), p.Y(), p.Z()};
}

/// Corners at the same place to 1e-6 mm become one.
class Welder {
public:
  explicit Welder(TriangleMesh& mesh) : mesh_(mesh) {}

  std::uint32_t corner(const Vector3& p) {
    const std::array<std::int64_t, 3> key{std::llround(p.x() * 1e6), std::llround(p.y() * 1e6),
                                          std::llround(p.z() * 1e6)};
    const auto [place, added] = corners_.try_emplace(key, static_cast<std::uint32_t>(mesh_.corners.size()));
    if (added) mesh_.corners.push_back(p);
    return place->second;
  }

private:
  TriangleMesh& mesh_;
  std::map<std::array<std::int64_t, 3>, std::uint32_t> corners_;
};

/// Where the curves of a face's edges end: their vertices may lie elsewhere, within their tolerances.
std::vector<Vector3> endsOfEdges(const TopoDS_Face& face) {
  std::vector<Vector3> ends;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    double first = 0, last = 0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(edges.Current()), first, last);
    if (curve.IsNull() || Precision::IsInfinite(first) || Precision::IsInfinite(last)) continue;
    ends.push_back(vector(curve->Value(first)));
    ends.push_back(vector(curve->Value(last)));
  }
  return ends;
}

/// How far from a point the nearest of some places is that lie within a distance of a middle; 0 without any.
double nearestWithin(const std::vector<Vector3>& places, const Vector3& middle, double distance, const Vector3& point) {
  double nearest = 1e300;
  for (const Vector3& place : places) {
    if ((place - middle).norm() <= distance) nearest = std::min(nearest, (place - point).norm());
  }
  return nearest < 1e300 ? nearest : 0;
}

bool isClosed(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      uses[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  return std::all_of(uses.begin(), uses.end(), [](const auto& use) { return use.second == 0; });
}

/// Asks OpenCASCADE's mesher to give up after some seconds of processor time.
class Patience : public Message_ProgressIndicator {
public:
  explicit Patience(double seconds) : end_(std::clock() + static_cast<std::clock_t>(seconds * CLOCKS_PER_SEC)) {}
  Standard_Boolean UserBreak() override { return std::clock() > end_; }
  void Show(const Message_ProgressScope& /*scope*/, const Standard_Boolean /*force*/) override {}

private:
  std::clock_t end_;
};

/// Tessellates a shape as finely as the mesher can in a few seconds. Along kinks within a face it would halve triangles
/// nearly without end, so they have a least size. Returns the deflection.
double tessellate(const TopoDS_Shape& shape, double deflection) {
  for (;; deflection *= 4) {
    IMeshTools_Parameters parameters;
    parameters.Deflection = deflection;
    parameters.Angle = 0.2;
    parameters.MinSize = 2 * deflection;
    const Handle(Patience) patience = new Patience(2);
    const BRepMesh_IncrementalMesh mesher(shape, parameters, patience->Start());
    if (!patience->UserBreak()) return deflection;
    BRepTools::Clean(shape);
  }
}

}  // namespace

Oracle::Oracle(const TopoDS_Shape& shape, double doubt) : shape_(BRepBuilderAPI_Copy(shape).Shape()) {
  Bnd_Box all;
  BRepBndLib::Add(shape_, all);
  const double size = all.CornerMin().Distance(all.CornerMax());
  const double deflection = tessellate(shape_, 8e-4 * size);  // exact distances tell smaller errors
  TriangleMesh mesh;
  Welder welder(mesh);
  auto faces = std::make_shared<std::vector<Face>>();
  double deviation = 0;
  for (TopExp_Explorer found(shape_, TopAbs_FACE); found.More(); found.Next()) {
    Face face{TopoDS::Face(found.Current()), {}, endsOfEdges(TopoDS::Face(found.Current()))};
    BRepBndLib::Add(face.face, face.box);
    faces->push_back(face);
    TopLoc_Location location;
    const Handle(Poly_Triangulation) triangles = BRep_Tool::Triangulation(face.face, location);
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(face.face);
    if (triangles.IsNull()) {
      // Not even OpenCASCADE can tessellate it: its distances alone must do.
      double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
      BRepTools::UVBounds(face.face, u0, u1, v0, v1);
      for (int i = 0; i < 64; ++i)
        places_.push_back(
            vector(surface->Value(u0 + (i % 8 + 0.5) / 8 * (u1 - u0), v0 + (i / 8 + 0.5) / 8 * (v1 - v0))));
      continue;
    }
    for (int i = 1; i <= triangles->NbTriangles(); ++i) {
      std::array<int, 3> nodes{};
      triangles->Triangle(i).Get(nodes[0], nodes[1], nodes[2]);
      if (face.face.Orientation() == TopAbs_REVERSED) std::swap(nodes[1], nodes[2]);
      std::array<std::uint32_t, 3> corners{};
      Vector3 middle = Vector3::Zero();
      gp_XY uv(0, 0);
      for (std::size_t k = 0; k < 3; ++k) {
        const gp_Pnt p = triangles->Node(nodes[k]).Transformed(location.Transformation());
        corners[k] = welder.corner(vector(p));
        middle += vector(p) / 3;
        uv += triangles->UVNode(nodes[k]).XY() / 3;
      }
      const Vector3 above = vector(surface->Value(uv.X(), uv.Y()));
      deviation = std::max(deviation, (above - middle).norm());
      places_.push_back(above);
      if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) {
        mesh.triangles.push_back({corners[0], corners[1], corners[2]});
      }
    }
  }
  faces_ = std::move(faces);
  tolerance_ = 2 * std::max(deviation, deflection);
  // Edges and surfaces of a shape meet to within its tolerance only: which of them is met decides about as much.
  constexpr double kPromised = 1e-6, kMostDoubt = 1e-5;
  precision_ = kPromised + doubt + std::min(kMostDoubt, BRep_Tool::MaxTolerance(shape_, TopAbs_EDGE));
  closed_ = isClosed(mesh) && !mesh.triangles.empty();
  skin_ = !TopExp_Explorer(shape_, TopAbs_SOLID).More();
  for (const Vector3& place : places_) {
    bounds_.minimum = bounds_.minimum.cwiseMin(place);
    bounds_.maximum = bounds_.maximum.cwiseMax(place);
  }
  mesh_ = std::make_unique<MeshSolid>(std::move(mesh));
}

namespace {

/// True if the place that OpenCASCADE has found in a face lies outside of it by OpenCASCADE's own classifier: on some
/// surfaces of revolution it takes the angle with the wrong sign, and sees places beyond where the face ends. The
/// classifier errs, too, where a curve that is turned lies on both sides of the axis.
bool liesOutside(const BRepExtrema_DistShapeShape& distance, const TopoDS_Face& face) {
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  const bool isTurned = surface->IsKind(STANDARD_TYPE(Geom_SurfaceOfRevolution));
  if (!isTurned || distance.SupportTypeShape2(1) != BRepExtrema_IsInFace) return false;
  // A surface that meets itself has several parameters there.
  const GeomAPI_ProjectPointOnSurf projected(distance.PointOnShape2(1), surface);
  bool isOnSurface = false;
  for (int i = 1; i <= projected.NbPoints(); ++i) {
    if (projected.Distance(i) > 1e-6) continue;
    isOnSurface = true;
    double u = 0, v = 0;
    projected.Parameters(i, u, v);
    const double turnV = surface->IsVPeriodic() ? surface->VPeriod() : 0;
    for (const int turns : {0, -1, 1}) {
      for (const int turnsV : {0, -1, 1}) {
        const gp_Pnt2d place(u + turns * surface->UPeriod(), v + turnsV * turnV);
        if (BRepClass_FaceClassifier(face, place, 1e-7).State() != TopAbs_OUT) return false;
      }
    }
  }
  return isOnSurface;
}

/// From a point to the edges of a face.
double distanceToEdges(const TopoDS_Shape& vertex, const TopoDS_Face& face) {
  double least = 1e300;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    const BRepExtrema_DistShapeShape distance(vertex, edges.Current());
    if (distance.IsDone()) least = std::min(least, distance.Value());
  }
  return least;
}

/// True if a solid of the shape holds the point, by OpenCASCADE's classifier.
bool isWithin(const TopoDS_Shape& shape, const Vector3& point) {
  for (TopExp_Explorer solids(shape, TopAbs_SOLID); solids.More(); solids.Next()) {
    const gp_Pnt place(point.x(), point.y(), point.z());
    if (BRepClass3d_SolidClassifier(solids.Current(), place, Precision::Confusion()).State() == TopAbs_IN) return true;
  }
  return false;
}

}  // namespace

Oracle::Distance Oracle::exactDistance(const Vector3& point, double about) const {
  const gp_Pnt p(point.x(), point.y(), point.z());
  const TopoDS_Shape vertex = BRepBuilderAPI_MakeVertex(p).Shape();
  Bnd_Box here;
  here.Set(p);
  here.Enlarge(about + 1e-3);
  Distance nearest;
  double ends = 1e300;
  for (const Face& face : *faces_) {
    if (here.IsOut(face.box)) continue;
    for (const Vector3& end : face.ends)
      ends = std::min(ends, (end - point).norm());
    const BRepExtrema_DistShapeShape distance(vertex, face.face);
    if (!distance.IsDone()) continue;
    const Vector3 place = vector(distance.PointOnShape2(1));
    const bool isFarOff = !mesh_->firstContact(place, place, tolerance_) && liesOutside(distance, face.face);
    const double value = isFarOff ? distanceToEdges(vertex, face.face) : distance.Value();
    nearest.least = std::min(nearest.least, value);
    double most = value;
    if (distance.SupportTypeShape2(1) == BRepExtrema_IsVertex) {
      const TopoDS_Vertex met = TopoDS::Vertex(distance.SupportOnShape2(1));
      most = std::max(most,
                      nearestWithin(face.ends, vector(BRep_Tool::Pnt(met)), 1e-7 + BRep_Tool::Tolerance(met), point));
    }
    nearest.most = std::min(nearest.most, most);
  }
  if (nearest.least <= about - precision_) {
    // On some wrapped surfaces OpenCASCADE sees places that do not belong to the face; asked for all at once, it does
    // not.
    const BRepExtrema_DistShapeShape whole(vertex, shape_);
    if (whole.IsDone()) nearest = {std::max(nearest.least, whole.Value()), std::max(nearest.most, whole.Value())};
  }
  return {std::min(nearest.least, ends), std::min(nearest.most, ends)};
}

std::string Oracle::objectionTo(const std::optional<BallContact>& contact, const Vector3& from, const Vector3& to,
                                double radius, bool exactly) const {
  const double length = (to - from).norm();
  // What a larger ball meets on the tessellation is met no later, what a smaller one meets no sooner.
  const auto early = mesh_->firstContact(from, to, radius + tolerance_);
  const auto late = radius > tolerance_ ? mesh_->firstContact(from, to, radius - tolerance_) : std::nullopt;
  // A tessellation can be worse than it looks; then the other means decides, too.
  const auto isThere = [&](const BallContact& met) {
    return (met.fraction == 0 && !skin_) || exactDistance(met.ballCentre, radius).most < radius - precision_;
  };
  const auto isTouched = [&] {
    if (contact->fraction == 0 && isWithin(shape_, from)) return true;  // bodies that overlap have no closed mesh
    const auto [least, most] = exactDistance(contact->ballCentre, radius);
    return least <= radius + precision_ && most >= radius - precision_;
  };
  if (!contact) {
    for (const double share : {0.13, 0.31, 0.52, 0.77, 1.0}) {
      if (exactly && exactDistance(from + share * (to - from), radius).most < radius - precision_)
        return "passes the shape";
    }
    return late && isThere(*late) ? fmt::format("passes what is in the way after {:.4f} mm", late->fraction * length)
                                  : "";
  }
  const double travelled = contact->fraction * length;
  if (!early && !isTouched()) return fmt::format("stops after {:.4f} mm where nothing is", travelled);
  if (early && travelled < early->fraction * length - 1e-6 && !isTouched())
    return fmt::format("stops after {:.4f} mm, {:.4f} mm too early", travelled, early->fraction * length - travelled);
  if (late && travelled > late->fraction * length + 1e-6 && isThere(*late))
    return fmt::format("stops after {:.4f} mm, {:.4f} mm too late", travelled, travelled - late->fraction * length);
  if (contact->fraction == 0) return "";
  // Where OpenCASCADE cannot even tessellate a face, the places that it finds near the way are often not on the face.
  constexpr double kUsable = 0.05;
  if (exactly && tolerance_ < kUsable * (bounds_.maximum - bounds_.minimum).norm()) {
    // Some places on the way up to there.
    for (const double share : {0.31, 0.77, 0.97}) {
      const double distance = exactDistance(from + share * contact->fraction * (to - from), radius).most;
      if (distance < radius - precision_)
        return fmt::format("stops after {:.4f} mm, past a part of the shape", travelled);
    }
  }
  if (std::abs((contact->touchPoint - contact->ballCentre).norm() - radius) > precision_)
    return fmt::format("touches {:.7f} mm away from its centre", (contact->touchPoint - contact->ballCentre).norm());
  if (!exactly) return "";
  const auto [least, most] = exactDistance(contact->ballCentre, radius);
  if (least <= radius + precision_ && most >= radius - precision_) return "";
  const double distance = least > radius ? least : most;
  // OpenCASCADE misses places of some wrapped surfaces: then the point that was touched must be on the surface.
  if (distance > radius && exactDistance(contact->touchPoint, 0).least < precision_) return "";
  return fmt::format("stops {:.7f} mm from the shape, {:.7f} mm too far", distance, distance - radius);
}

Oracle::Way Oracle::randomWay(std::mt19937_64& random) const {
  const Vector3 middle = (bounds_.minimum + bounds_.maximum) / 2;
  const double size = (bounds_.maximum - bounds_.minimum).norm();
  Way way;
  way.radius = size * std::pow(10, uniform(random, -2.3, -0.9));
  const Vector3 aim = places_[random() % places_.size()] + randomPoint(random, way.radius);
  switch (random() % 5) {
    case 0:  // straight along an axis
      way.from = aim;
      way.from[static_cast<Eigen::Index>(random() % 3)] += (random() % 2 == 0 ? 1 : -1) * size;
      break;
    case 1:  // from a place about it, perhaps within
      way.from = middle + randomPoint(random, size / 2);
      if (!closed_) way.from = middle + size * randomDirection(random);
      break;
    case 2: {  // in a plane through the middle, along an axis
      way.from = middle;
      way.from[static_cast<Eigen::Index>(random() % 3)] += (random() % 2 == 0 ? 1 : -1) * size;
      way.to = middle + uniform(random, -0.3, 1) * (middle - way.from);
      return way;
    }
    default:
      way.from = middle + size * randomDirection(random);
  }
  way.to = way.from + uniform(random, 0.3, 2.2) * (aim - way.from);
  return way;
}

int expectTrueContacts(const std::string& name, const TopoDS_Shape& shape, const Solid& solid, std::mt19937_64& random,
                       int count, double doubt) {
  const Oracle oracle(shape, doubt);
  int contacts = 0;
  int objections = 0;
  int sent = 0;
  for (int i = 0; i < count && objections < 3; ++i) {
    ++sent;
    const Oracle::Way way = oracle.randomWay(random);
    const auto contact = solid.firstContact(way.from, way.to, way.radius);
    if (contact) ++contacts;
    const std::string objection = oracle.objectionTo(contact, way.from, way.to, way.radius, i % 4 == 0);
    if (objection.empty()) continue;
    ++objections;
    ADD_FAILURE() << name << ", way " << i << " from " << way.from.transpose() << " to " << way.to.transpose()
                  << " radius " << way.radius << ": the ball " << objection << " (tolerance " << oracle.tolerance()
                  << ")";
  }
  static int parts = 0, ways = 0;
  ++parts, ways += sent;
  if (campaignFactor() > 1 && parts % 100 == 0) fmt::print("{} parts, {} ways so far\n", parts, ways);
  return contacts;
}

int campaignFactor() {
  const char* factor = std::getenv("PROBEWRIGHT_CAMPAIGN");
  return factor != nullptr ? std::max(1, std::atoi(factor)) : 1;
}

int campaignStart() {
  const char* from = std::getenv("PROBEWRIGHT_CAMPAIGN_FROM");
  return from != nullptr ? std::atoi(from) : 0;
}

int waysInCampaign(int usual) {
  constexpr int kMore = 3;
  return campaignFactor() > 1 ? kMore * usual : usual;
}

}  // namespace probewright::simulation::testing
