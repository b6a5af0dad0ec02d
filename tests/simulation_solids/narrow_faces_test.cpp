#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRep_Builder.hxx>
#include <Geom_BezierSurface.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>
#include <utility>
#include <vector>

#include "simulation/cad_solid.hpp"
#include "simulation/face_mesh.hpp"
#include "worlds.hpp"

/// Narrow faces between two arcs, which are nearer to each other than the chords of a mesh are to them.
namespace probewright::simulation {
namespace {

using namespace testing;
using ::testing::IsEmpty;

/// Of a circle: from (length/2, 0) to (-length/2, 0) over (0, height).
struct Arc {
  double length, height;

  double radius() const { return (length * length / 4 + height * height) / (2 * height); }
  Vector2 centre() const { return {0, height - radius()}; }
  double halfAngle() const { return std::asin(length / 2 / radius()); }

  bool covers(const Vector2& p) const { return (p - centre()).norm() <= radius() && p.y() >= 0; }

  double distance(const Vector2& p) const {
    const Vector2 from = p - centre();
    if (std::abs(std::atan2(from.x(), from.y())) <= halfAngle()) return std::abs(from.norm() - radius());
    return std::min((p - Vector2(length / 2, 0)).norm(), (p - Vector2(-length / 2, 0)).norm());
  }

  /// As edges of different lengths.
  std::vector<TopoDS_Edge> edges(int parts) const {
    const gp_Circ circle(gp_Ax2(gp_Pnt(centre().x(), centre().y(), 0), gp::DZ()), radius());
    const auto angle = [&](int i) {
      const double share = static_cast<double>(i) / parts;
      return M_PI / 2 - halfAngle() + 2 * halfAngle() * share * share;
    };
    std::vector<TopoDS_Edge> edges;
    for (int i = 0; i < parts; ++i)
      edges.push_back(BRepBuilderAPI_MakeEdge(circle, angle(i), angle(i + 1)));
    return edges;
  }
};

struct Crescent {
  Arc inner, outer;

  /// From the area between the arcs.
  double distance(const Vector2& p) const {
    return outer.covers(p) && !inner.covers(p) ? 0 : std::min(inner.distance(p), outer.distance(p));
  }

  TopoDS_Face face() const {
    BRepBuilderAPI_MakeWire border;
    for (const TopoDS_Edge& edge : outer.edges(1))
      border.Add(edge);
    const std::vector<TopoDS_Edge> back = inner.edges(3);
    for (auto edge = back.rbegin(); edge != back.rend(); ++edge)
      border.Add(TopoDS::Edge(edge->Reversed()));
    return BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), border.Wire());
  }
};

/// From `narrowest` (mm) to 1 mm wide.
Crescent randomCrescent(std::mt19937_64& random, double narrowest) {
  const double length = uniform(random, 5, 40), height = uniform(random, 0.05, 0.3) * length;
  return {{length, height}, {length, height + std::pow(10, uniform(random, std::log10(narrowest), 0))}};
}

TEST(NarrowFaces, GetTriangles) {
  std::mt19937_64 random(2611);
  for (int i = 0; i < 60; ++i)
    EXPECT_THAT(meshFaces(randomCrescent(random, 0.01).face(), 0.01), IsEmpty()) << "crescent " << i;
}

TEST(NarrowFaces, ThatHaveComeToNothingAreNotMissing) {
  const gp_Pnt begin(1, 2, 3), middle(4, 6, 3), end(7, 10, 3);
  BRepBuilderAPI_MakeWire border;
  for (const auto& [from, to] : {std::pair(begin, end), {end, middle}, {middle, begin}})
    border.Add(BRepBuilderAPI_MakeEdge(from, to).Edge());
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 0, 3), gp::DZ()), border.Wire());
  EXPECT_THAT(meshFaces(face, 0.01), IsEmpty());
}

/// As wings are closed whose end is sharp: both sides of the surface are the same line, or all of it is a point.
TEST(NarrowFaces, OfSurfacesThatAreALineAreNotMissing) {
  for (const double length : {0.0, 30.0}) {
    TColgp_Array2OfPnt poles(1, 2, 1, 4);
    for (int j = 1; j <= 4; ++j) {
      for (int i = 1; i <= 2; ++i)
        poles(i, j) = gp_Pnt(length * (j - 1) / 3, 0.2 * length * (j - 1), 5);
    }
    const Handle(Geom_BezierSurface) surface = new Geom_BezierSurface(poles);
    BRep_Builder builder;
    TopoDS_Face face;
    builder.MakeFace(face, surface, 1e-7);
    builder.NaturalRestriction(face, Standard_True);
    EXPECT_THAT(meshFaces(face, 0.01), IsEmpty()) << length << " mm long";
  }
}

TEST(NarrowFaces, AreMetWhereTheyAre) {
  std::mt19937_64 random(2612);
  for (int world = 0; world < 40; ++world) {
    const Crescent crescent = randomCrescent(random, 0.003);
    constexpr double kThickness = 5;
    const auto solid = cadSolid(BRepPrimAPI_MakePrism(crescent.face(), gp_Vec(0, 0, -kThickness)).Shape());
    ASSERT_TRUE(solid);
    const double length = crescent.outer.length;
    for (int i = 0; i < 40; ++i) {
      const double radius = std::pow(10, uniform(random, -0.7, 0.7));
      // Over the area, or beside it.
      const double angle = uniform(random, -1, 1) * crescent.inner.halfAngle();
      const double along = uniform(random, 0, 1) < 0.5 ? 0.5 : uniform(random, -2, 3);
      const double width = crescent.outer.height - crescent.inner.height;
      const Vector2 place = crescent.inner.centre() +
                            (crescent.inner.radius() + along * width) * Vector2(std::sin(angle), std::cos(angle));
      const double distance = crescent.distance(place);
      if (std::abs(distance - radius) < 1e-3) continue;
      const auto contact =
          (*solid)->firstContact(Vector3(place.x(), place.y(), length), Vector3(place.x(), place.y(), -length), radius);
      const auto where = [&] {
        return fmt::format("crescent {}, {:.4f} mm long, heights {:.4f} and {:.4f}; ball {:.4f} at {:.4f} {:.4f}",
                           world, length, crescent.inner.height, crescent.outer.height, radius, place.x(), place.y());
      };
      ASSERT_EQ(contact.has_value(), distance < radius) << where();
      if (!contact) continue;
      EXPECT_NEAR(contact->ballCentre.z(), std::sqrt(radius * radius - distance * distance), 1e-6) << where();
    }
  }
}

}  // namespace
}  // namespace probewright::simulation
