#include "simulation/face_at.hpp"

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <cmath>

#include "simulation/cad_solid.hpp"
#include "simulation/other_faces.hpp"

/// Which face of a part from CAD lies at a point, and what is left of the part without it.
namespace probewright::simulation {
namespace {

using Kind = AnalyticSurface::Kind;

constexpr double radius = 8, apart = 25;

/// A plate of 100 x 60 x 20 mm, its top at Z20, with two equal holes at X-25 and X+25.
std::unique_ptr<Solid> plate() {
  TopoDS_Shape shape = BRepPrimAPI_MakeBox(gp_Pnt(-50, -30, 0), gp_Pnt(50, 30, 20)).Shape();
  for (const double x : {-apart, apart})
    shape =
        BRepAlgoAPI_Cut(shape, BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, 0, -1), gp_Dir(0, 0, 1)), radius, 22).Shape())
            .Shape();
  auto solid = cadSolid(shape);
  EXPECT_TRUE(solid) << format(solid.error());
  return solid ? std::move(*solid) : nullptr;
}

TEST(FaceAt, IsTheFaceThatPassesThroughThePointSquareToTheNormal) {
  const auto part = plate();
  ASSERT_TRUE(part);
  const auto top = faceAt(*part, {0, 0, 20}, Vector3::UnitZ());
  ASSERT_TRUE(top);
  EXPECT_EQ(top->kind, Kind::Plane);
  const auto hole = faceAt(*part, {apart + radius, 0, 10}, -Vector3::UnitX());
  ASSERT_TRUE(hole);
  EXPECT_EQ(hole->kind, Kind::Cylinder);
  EXPECT_NEAR(std::abs(hole->radius), radius, 1e-9);
}

TEST(FaceAt, IsNoneOnAnEdgeNorWhereTheFaceHasAHole) {
  const auto part = plate();
  ASSERT_TRUE(part);
  const Vector3 slanted = Vector3(0, -1, 1).normalized();
  EXPECT_FALSE(faceAt(*part, {0, -30, 20}, slanted)) << "an edge between two planes";
  EXPECT_FALSE(faceAt(*part, {apart, -radius, 20}, Vector3(0, 1, 1).normalized())) << "the rim of a hole";
  EXPECT_FALSE(faceAt(*part, {0, 0, 20}, slanted)) << "the plane has another normal";
  EXPECT_FALSE(faceAt(*part, {apart, 0, 20}, Vector3::UnitZ())) << "the top has a hole here";
  EXPECT_FALSE(faceAt(*part, {0, 0, 20.001}, Vector3::UnitZ()));
}

/// Whichever end of a mill or of a probe's body meets a face first, the normal leads from the face to it.
TEST(CylinderContact, NormalsOfBothEndsLeadToTheBody) {
  const auto part = plate();
  ASSERT_TRUE(part);
  const Vector3 axis(0, 0, 30);
  const auto fromAbove = part->firstCylinderContact({3, 4, 40}, {3, 4, 0}, axis, 5);
  ASSERT_TRUE(fromAbove);
  EXPECT_NEAR(fromAbove->fraction, 0.5, 1e-6);
  EXPECT_LT((fromAbove->normal - Vector3::UnitZ()).norm(), 1e-6);
  const auto fromBelow = part->firstCylinderContact({3, 4, -50}, {3, 4, -10}, axis, 5);
  ASSERT_TRUE(fromBelow);
  EXPECT_NEAR(fromBelow->fraction, 0.5, 1e-6);
  EXPECT_LT((fromBelow->normal + Vector3::UnitZ()).norm(), 1e-6);
}

/// The way of a ball of radius 2 from the middle of a hole to its wall and on.
std::optional<double> wayToTheWall(const Solid& solid, double hole) {
  const auto contact = solid.firstContact({hole, 0, 10}, {hole + 15, 0, 10}, 2);
  return contact ? std::optional(15 * contact->fraction) : std::nullopt;
}

TEST(OtherFaces, KeepAHoleOfTheSameSizeBesideTheOneThatIsTakenAway) {
  const auto part = plate();
  ASSERT_TRUE(part);
  const auto hole = faceAt(*part, {apart + radius, 0, 10}, -Vector3::UnitX());
  ASSERT_TRUE(hole);
  const auto others = otherFaces(*part, *hole);
  ASSERT_TRUE(others);
  const auto left = wayToTheWall(*others, -apart);
  ASSERT_TRUE(left) << "the other hole is there";
  EXPECT_NEAR(*left, radius - 2, 1e-6);
  EXPECT_FALSE(wayToTheWall(*others, apart)) << "this one is gone";
}

TEST(OtherFaces, KnowASurfaceByItsPlaceDirectionAndSize) {
  AnalyticSurface surface;
  surface.origin = {1, 2, 3};
  surface.radius = 8;
  surface.tubeRadius = 3;
  surface.coneSine = 0.5;
  surface.coneCosine = std::sqrt(0.75);
  const Vector3 along = surface.axes.col(2), aside = surface.axes.col(0);
  for (const Kind kind : {Kind::Plane, Kind::Cylinder, Kind::Cone, Kind::Sphere, Kind::Torus}) {
    surface.kind = kind;
    const auto same = [&](auto change) {
      AnalyticSurface other = surface;
      change(other);
      return sameSurface(surface, other) && sameSurface(other, surface);
    };
    EXPECT_TRUE(same([](AnalyticSurface&) {}));
    EXPECT_EQ(same([&](AnalyticSurface& other) { other.origin += 5 * along; }), kind == Kind::Cylinder);
    EXPECT_EQ(same([&](AnalyticSurface& other) { other.origin += 5 * aside; }), kind == Kind::Plane);
    EXPECT_EQ(same([&](AnalyticSurface& other) { other.axes = rotation(Vector3::UnitX(), 10).linear(); }),
              kind == Kind::Sphere);
    EXPECT_FALSE(kind != Kind::Plane && same([](AnalyticSurface& other) { other.radius += 1; }));
    EXPECT_EQ(same([](AnalyticSurface& other) { other.tubeRadius += 1; }), kind != Kind::Torus);
    EXPECT_EQ(same([](AnalyticSurface& other) { other.coneSine = 0.4; }), kind != Kind::Cone);
    EXPECT_FALSE(
        same([](AnalyticSurface& other) { other.kind = other.kind == Kind::Plane ? Kind::Sphere : Kind::Plane; }));
  }
}

}  // namespace
}  // namespace probewright::simulation
