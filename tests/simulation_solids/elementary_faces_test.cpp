#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Line.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <TopoDS_Face.hxx>
#include <cmath>
#include <optional>
#include <string>

#include "oracle.hpp"
#include "simulation/cad_model.hpp"
#include "simulation/cad_solid.hpp"
#include "worlds.hpp"

/// Faces on cylinders, cones, spheres and tori that are written as something else.
namespace probewright::simulation {
namespace {

using namespace testing;
using Kind = AnalyticSurface::Kind;

struct Written {
  std::string name;
  TopoDS_Shape face;
  std::optional<Kind> meant;  ///< nothing where it is none of those
};

TopoDS_Shape turned(const gp_Pnt& place, const gp_Dir& along, double u0, double u1, double v0, double v1) {
  const gp_Ax1 axis(gp_Pnt(3, -4, 5), gp_Dir(1, 2, 2));
  gp_Trsf toAxis;
  toAxis.SetTransformation(gp_Ax3(axis.Location(), axis.Direction()), gp_Ax3(gp::XOY()));
  const Handle(Geom_Curve) line = new Geom_Line(place.Transformed(toAxis), along.Transformed(toAxis));
  return BRepBuilderAPI_MakeFace(new Geom_SurfaceOfRevolution(line, axis), u0, u1, v0, v1, 1e-7).Shape();
}

TopoDS_Shape pulled(const gp_Dir& along, double u0, double u1, double v0, double v1) {
  const Handle(Geom_Curve) circle = new Geom_Circle(gp_Ax2(gp_Pnt(2, 3, 4), gp_Dir(2, -1, 2)), 9);
  return BRepBuilderAPI_MakeFace(new Geom_SurfaceOfLinearExtrusion(circle, along), u0, u1, v0, v1, 1e-7).Shape();
}

/// A circle in a plane through the axis, whose parameters begin at `begin`, in rad from outwards.
TopoDS_Shape turnedCircle(double out, double radius, double begin, bool isUpsideDown, double u0, double u1, double v0,
                          double v1) {
  const gp_Ax1 axis(gp_Pnt(3, -4, 5), gp_Dir(1, 2, 2));
  gp_Trsf toAxis;
  toAxis.SetTransformation(gp_Ax3(axis.Location(), axis.Direction()), gp_Ax3(gp::XOY()));
  const gp_Ax2 plane(gp_Pnt(out, 0, 2), isUpsideDown ? gp::DY() : -gp::DY(),
                     gp_Dir(std::cos(begin), 0, std::sin(begin)));
  const Handle(Geom_Curve) circle = new Geom_Circle(plane.Transformed(toAxis), radius);
  return BRepBuilderAPI_MakeFace(new Geom_SurfaceOfRevolution(circle, axis), u0, u1, v0, v1, 1e-7).Shape();
}

/// Lines about the Z axis before all is moved to another axis: that of `turned`.
std::vector<Written> faces() {
  return {
      {"line along the axis", turned({10, 0, 2}, {0, 0, 1}, 0.3, 4, -6, 11), Kind::Cylinder},
      {"line against the axis", turned({0, -10, 2}, {0, 0, -1}, -2, 1, -6, 11), Kind::Cylinder},
      {"line outwards", turned({8, 6, 0}, {0.4, 0.3, 1}, 0.5, 5, -3, 12), Kind::Cone},
      {"line inwards, down", turned({-8, 6, 0}, {0.4, -0.3, -1}, 0.5, 5, -3, 12), Kind::Cone},
      {"line from the apex", turned({0, 0, 0}, {1, 0, 1}, 0, 3, 2, 14), Kind::Cone},
      {"line across the apex", turned({0, 0, 1}, {1, 0, 2}, 0.4, 3, -11, 9), Kind::Cone},
      {"line askew", turned({10, 0, 2}, {0, 0.5, 1}, 0.3, 4, -6, 11), std::nullopt},
      {"line across the axis", turned({4, 0, 2}, {1, 0, 0}, 0.3, 4, 1, 11), std::nullopt},
      {"circle beside the axis", turnedCircle(12, 4, 0, false, 0.3, 5, 0.2, 3), Kind::Torus},
      {"circle that begins elsewhere", turnedCircle(12, 4, 1.9, false, 0.3, 5, 0.2, 6), Kind::Torus},
      {"circle the other way", turnedCircle(12, 4, -0.7, true, 0.3, 5, 1, 4), Kind::Torus},
      {"circle on the other side", turnedCircle(-12, 4, 0.4, false, 0.3, 5, 1, 4), Kind::Torus},
      {"circle about a point of the axis", turnedCircle(0, 9, 0, false, 0.3, 5, -1.2, 1.1), Kind::Sphere},
      {"the same from below", turnedCircle(0, 9, -1.5, false, 0.3, 5, 0.2, 2.8), Kind::Sphere},
      {"the same, its other half", turnedCircle(0, 9, 0, true, 0.3, 5, 2, 4), Kind::Sphere},
      {"circle across the axis", turnedCircle(3, 6, 0, false, 0.3, 5, -1.5, 1.5), std::nullopt},
      {"circle along its normal", pulled({2, -1, 2}, 0.2, 4, -5, 8), Kind::Cylinder},
      {"circle against its normal", pulled({-2, 1, -2}, 1, 6, -5, 8), Kind::Cylinder},
      {"circle aslant", pulled({2, 0, 2}, 1, 6, -5, 8), std::nullopt},
  };
}

TEST(ElementaryFaces, AreMetInClosedFormHoweverTheyAreWritten) {
  std::mt19937_64 random(41);
  for (const Written& written : faces()) {
    const auto solid = cadSolid(written.face);
    ASSERT_TRUE(solid) << written.name << ": " << format(solid.error());
    const auto& prepared = dynamic_cast<const CadSolid&>(**solid);
    ASSERT_EQ(prepared.model().faces.size(), 1U) << written.name;
    const ClosedForms& forms = prepared.model().faces[0].forms;
    EXPECT_EQ(forms.count > 0, written.meant.has_value()) << written.name;
    if (forms.count > 0) {
      EXPECT_EQ(forms.sheets[0].kind, written.meant) << written.name;
    }
    EXPECT_GT(expectTrueContacts(written.name, written.face, prepared, random, waysInCampaign(40)), 4) << written.name;
  }
}

}  // namespace
}  // namespace probewright::simulation
