#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepLib.hxx>
#include <Geom2d_Ellipse.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Face.hxx>
#include <cmath>
#include <numbers>

#include "oracle.hpp"
#include "simulation/cad_model.hpp"
#include "simulation/cad_solid.hpp"
#include "worlds.hpp"

/// Faces that are cut into pieces before they are prepared for contact.
namespace probewright::simulation {
namespace {

using namespace testing;
using ::testing::Gt;
using ::testing::SizeIs;

/// The outer half of a tube of radius 3 along a helix of radius 20, four turns.
Handle(Geom_BSplineSurface) spring() {
  constexpr int kAcross = 7, kAlong = 97, kPerTurn = 24;
  constexpr double kRadius = 20, kTube = 3, kRisePerRad = 2;
  TColgp_Array2OfPnt points(1, kAcross, 1, kAlong);
  for (int i = 0; i < kAcross; ++i) {
    for (int k = 0; k < kAlong; ++k) {
      const double across = std::numbers::pi * i / (kAcross - 1), along = 2 * std::numbers::pi * k / kPerTurn;
      const Vector3 out(std::cos(along), std::sin(along), 0);
      const Vector3 tangent = Vector3(-kRadius * out.y(), kRadius * out.x(), kRisePerRad).normalized();
      const Vector3 p = kRadius * out + Vector3(0, 0, kRisePerRad * along) +
                        kTube * (std::sin(across) * out + std::cos(across) * tangent.cross(out));
      points(i + 1, k + 1) = gp_Pnt(p.x(), p.y(), p.z());
    }
  }
  GeomAPI_PointsToBSplineSurface surface;
  surface.Interpolate(points);
  return surface.Surface();
}

/// Plane strips of 2 mm by 30 mm, up and down at 30 degrees: one spline of degree one with a kink between each two.
Handle(Geom_BSplineSurface) zigzag(int strips) {
  TColgp_Array2OfPnt poles(1, strips + 1, 1, 2);
  TColStd_Array1OfReal across(1, strips + 1), along(1, 2);
  TColStd_Array1OfInteger acrossTimes(1, strips + 1), alongTimes(1, 2);
  for (int i = 0; i <= strips; ++i) {
    for (int k = 0; k < 2; ++k)
      poles(i + 1, k + 1) = gp_Pnt(std::sqrt(3) * i, 30.0 * k, i % 2);
    across(i + 1) = i;
    acrossTimes(i + 1) = i == 0 || i == strips ? 2 : 1;
  }
  along(1) = 0, along(2) = 1;
  alongTimes.Init(2);
  return new Geom_BSplineSurface(poles, across, along, acrossTimes, alongTimes, 1, 1);
}

/// The part of a surface within an ellipse that nearly fills the range of its parameters.
TopoDS_Face withinEllipse(const Handle(Geom_BSplineSurface) & surface) {
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  surface->Bounds(u0, u1, v0, v1);
  const bool isLongInU = u1 - u0 > v1 - v0;
  const gp_Pnt2d middle((u0 + u1) / 2, (v0 + v1) / 2);
  const double half = 0.49 * std::max(u1 - u0, v1 - v0), other = 0.48 * std::min(u1 - u0, v1 - v0);
  const Handle(Geom2d_Curve) ellipse =
      new Geom2d_Ellipse(gp_Ax2d(middle, isLongInU ? gp_Dir2d(1, 0) : gp_Dir2d(0, 1)), half, other);
  const TopoDS_Face face =
      BRepBuilderAPI_MakeFace(surface, BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(ellipse, surface)).Wire());
  BRepLib::BuildCurves3d(face);
  return face;
}

TEST(Pieces, OfLongSplinesAreTouchedAsTheWholeIs) {
  const TopoDS_Face face = withinEllipse(spring());
  const auto solid = cadSolid(face);
  ASSERT_TRUE(solid) << format(solid.error());
  const auto& prepared = dynamic_cast<const CadSolid&>(**solid);
  EXPECT_THAT(prepared.model().faces, SizeIs(Gt(std::size_t{3})));
  std::mt19937_64 random(21);
  EXPECT_GT(expectTrueContacts("spring", face, prepared, random, waysInCampaign(60)), 20);
  // Its border alone is drawn as a line.
  TopExp_Explorer border(face, TopAbs_EDGE);
  for (const std::vector<float>& line : prepared.drawing().featureEdges) {
    for (std::size_t i = 0; i + 2 < line.size(); i += 3) {
      const gp_Pnt p(line[i], line[i + 1], line[i + 2]);
      ASSERT_LT(BRepExtrema_DistShapeShape(BRepBuilderAPI_MakeVertex(p).Vertex(), border.Current()).Value(), 1e-3);
    }
  }
}

TEST(Pieces, OfAFaceWithManyKinksHaveNoneAndAreTouchedAsTheWholeIs) {
  const TopoDS_Face face = withinEllipse(zigzag(40));
  const auto solid = cadSolid(face);
  ASSERT_TRUE(solid) << format(solid.error());
  const auto& prepared = dynamic_cast<const CadSolid&>(**solid);
  EXPECT_THAT(prepared.model().faces, SizeIs(40));
  for (const CadEdge& edge : prepared.model().edges)
    EXPECT_FALSE(edge.within);
  std::mt19937_64 random(22);
  EXPECT_GT(expectTrueContacts("zigzag", face, prepared, random, waysInCampaign(60)), 20);
}

}  // namespace
}  // namespace probewright::simulation
