#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepLib.hxx>
#include <Geom2d_Ellipse.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>

#include "simulation/cad_solid.hpp"
#include "worlds.hpp"

/// Free-form faces of metres, metres away from the zero point.
namespace probewright::simulation {
namespace {

using namespace testing;

/// A sheet of 4 m by 10 m on the XY plane of `pose`, as a spline of degree one over parameters from 0 to 1. One corner
/// is lifted by `twist`, in mm.
Handle(Geom_BSplineSurface) straightSheet(const Pose& pose, double twist) {
  TColgp_Array2OfPnt poles(1, 2, 1, 2);
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const Vector3 p = pose * Vector3(4000.0 * i, 10000.0 * j, twist * i * j);
      poles(i + 1, j + 1) = gp_Pnt(p.x(), p.y(), p.z());
    }
  }
  return GeomConvert::SurfaceToBSplineSurface(new Geom_BezierSurface(poles));
}

/// The part of a surface within an ellipse that nearly fills the square of its parameters, which go from 0 to 1.
TopoDS_Face withinEllipse(const Handle(Geom_Surface) & surface) {
  const Handle(Geom2d_Curve) ellipse = new Geom2d_Ellipse(gp_Ax2d(gp_Pnt2d(0.5, 0.5), gp_Dir2d(0.8, 0.6)), 0.49, 0.35);
  const TopoDS_Face face =
      BRepBuilderAPI_MakeFace(surface, BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(ellipse, surface)).Wire());
  BRepLib::BuildCurves3d(face);
  return face;
}

double distance(const TopoDS_Shape& shape, const Vector3& p) {
  return BRepExtrema_DistShapeShape(BRepBuilderAPI_MakeVertex(gp_Pnt(p.x(), p.y(), p.z())).Vertex(), shape).Value();
}

/// Triangles of such a sheet are slim and reach from border to border. So far from the zero point rounding is larger
/// than the last step that an iteration would take near it.
TEST(LargeFaces, AreMetBetweenBentBordersFarFromTheZeroPoint) {
  std::mt19937_64 random(31);
  int met = 0;
  for (const double twist : {0.0, 3.0, 400.0}) {
    const Pose pose = translation({-6000, 18000, 21000}) * rotation(Vector3(1, 2, 3).normalized(), 70);
    const TopoDS_Face face = withinEllipse(straightSheet(pose, twist));
    const auto solid = cadSolid(face);
    ASSERT_TRUE(solid) << format(solid.error());
    for (int i = 0; i < 150; ++i) {
      const double radius = uniform(random, 0.5, 20);
      // Through the sheet, often at small angles.
      const double turn = uniform(random, -180, 180), steep = uniform(random, 4, 60);
      const Vector3 way = rotation(Vector3::UnitZ(), turn) * rotation(Vector3::UnitY(), steep) * Vector3::UnitX();
      const Vector3 middle(uniform(random, 200, 3800), uniform(random, 500, 9500), uniform(random, 0, twist));
      const Vector3 from = pose * (middle - uniform(random, 1000, 6000) * way);
      const Vector3 to = pose * (middle + 500 * way);
      const auto contact = (*solid)->firstContact(from, to, radius);
      const double end = contact ? contact->fraction : 1;
      if (contact) {
        ++met;
        EXPECT_NEAR(distance(face, contact->ballCentre), radius, 1e-6) << "twist " << twist << ", way " << i;
      }
      // Before, the sheet is nowhere nearer than the radius.
      constexpr int kSteps = 300;
      for (int k = 0; k <= kSteps; ++k) {
        const Vector3 at = from + end * k / kSteps * (to - from);
        if (std::abs((pose.inverse() * at).z()) > radius + std::abs(twist)) continue;
        ASSERT_GT(distance(face, at), radius - 1e-6) << "twist " << twist << ", way " << i << " at " << k;
      }
    }
  }
  EXPECT_GT(met, 200);
}

}  // namespace
}  // namespace probewright::simulation
