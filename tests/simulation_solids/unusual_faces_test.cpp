#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <BRepAlgoAPI_Common.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GC_MakeSegment.hxx>
#include <Geom2d_Circle.hxx>
#include <Geom2d_Line.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <ctime>
#include <gp_Ax3.hxx>
#include <gp_Pln.hxx>
#include <numbers>

#include "oracle.hpp"
#include "simulation/cad_solid.hpp"
#include "simulation/face_grid.hpp"
#include "simulation/face_mesh.hpp"
#include "worlds.hpp"

/// What files hold besides plain bodies: lines, slim faces, circles turned about an axis that they meet.
namespace probewright::simulation {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::ScratchFolder;
using testing::uniform;

TopoDS_Shape blockWithLines() {
  BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  builder.Add(all, BRepPrimAPI_MakeBox(gp_Pnt(-20, -15, 0), gp_Pnt(20, 15, 10)).Shape());
  builder.Add(all, BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, -40), gp_Pnt(0, 0, 40)).Edge());
  builder.Add(all, BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(gp_Pnt(0, 0, 25), gp::DZ()), 12)).Edge());
  return all;
}

void expectLinesAreFree(const Solid& solid) {
  EXPECT_FALSE(solid.firstContact({-50, 0, 30}, {50, 0, 30}, 2)) << "through the axis";
  EXPECT_FALSE(solid.firstContact({12, 0, 40}, {12, 0, 15}, 2)) << "through the circle";
  const auto contact = solid.firstContact({12, 0, 40}, {12, 0, 5}, 2);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->ballCentre.z(), 12, 1e-9) << "the block's top";
}

TEST(LooseLines, AreNothingToTouch) {
  const auto solid = cadSolid(blockWithLines());
  ASSERT_TRUE(solid) << format(solid.error());
  expectLinesAreFree(**solid);
}

TEST(LooseLines, OfAFileAreNothingToTouch) {
  const ScratchFolder folder;
  ASSERT_TRUE(writeStep(blockWithLines(), folder / "part.step"));
  const auto solid = readStep(folder / "part.step");
  ASSERT_TRUE(solid) << format(solid.error());
  expectLinesAreFree(**solid);
}

/// A cone about Z as a spline that closes: its tip at the origin, its rim `fall` below with radius 12; a disc if that
/// is nothing.
TopoDS_Shape splineCone(double fall) {
  const Handle(Geom_TrimmedCurve) line = GC_MakeSegment(gp_Pnt(0, 0, 0), gp_Pnt(12, 0, -fall)).Value();
  const Handle(Geom_BSplineSurface) spline = GeomConvert::SurfaceToBSplineSurface(
      new Geom_RectangularTrimmedSurface(new Geom_SurfaceOfRevolution(line, gp::OZ()), 0, 2 * std::numbers::pi,
                                         line->FirstParameter(), line->LastParameter()));
  spline->SetUPeriodic();
  return BRepBuilderAPI_MakeFace(spline, 1e-7).Shape();
}

/// Balls that touch a pole, or so near that the equations there have no single solution.
TEST(Poles, OfSplinesThatCloseAreTouchedFromAnySide) {
  std::mt19937_64 random(41);
  for (const double fall : {0.0, 2.0, 9.0}) {
    const auto solid = cadSolid(splineCone(fall));
    ASSERT_TRUE(solid) << format(solid.error());
    for (int i = 0; i < 60; ++i) {
      const double ball = uniform(random, 0.5, 9), turn = uniform(random, -4, 4);
      const double off = i % 3 == 0 ? 0 : std::pow(10, uniform(random, -17, -3));
      const Vector3 place(off * std::cos(turn), off * std::sin(turn), 0);
      Vector3 from = testing::randomDirection(random);
      from.z() = std::abs(from.z()) + 0.3;
      // Where the ball stands on the tip.
      const Vector3 centre = place + Vector3(0, 0, ball);
      const auto contact = (*solid)->firstContact(centre + 40 * from, centre - 0.3 * from, ball);
      ASSERT_TRUE(contact) << i;
      EXPECT_NEAR(contact->fraction * 40.3, 40, fall > 0 ? 1e-6 + 2 * off : 1e-7) << i << ": " << off << " off";
    }
  }
}

/// A bent sheet along Y whose spline need not be smooth in the middle, at X10, where it reaches to Y20 only.
TopoDS_Shape cutSheet() {
  TColgp_Array1OfPnt poles(1, 5);
  const std::array<gp_Pnt, 5> places{{{0, 0, 0}, {5, 0, 2}, {10, 0, 3}, {15, 0, 4}, {20, 0, 3}}};
  for (int i = 0; i < 5; ++i)
    poles(i + 1) = places[static_cast<std::size_t>(i)];
  TColStd_Array1OfReal knots(1, 3);
  TColStd_Array1OfInteger multiplicities(1, 3);
  for (int i = 1; i <= 3; ++i) {
    knots(i) = i - 1;
    multiplicities(i) = i == 2 ? 2 : 3;
  }
  const Handle(Geom_Surface) surface =
      new Geom_SurfaceOfLinearExtrusion(new Geom_BSplineCurve(poles, knots, multiplicities, 2), gp::DY());
  const std::array<gp_Pnt2d, 5> corners{{{0, 0}, {2, 0}, {2, 2}, {1, 20}, {0, 38}}};
  BRepBuilderAPI_MakeWire wire;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const gp_Pnt2d from = corners[i], to = corners[(i + 1) % corners.size()];
    wire.Add(
        BRepBuilderAPI_MakeEdge(new Geom2d_Line(from, gp_Dir2d(gp_Vec2d(from, to))), surface, 0, from.Distance(to)));
  }
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(surface, wire.Wire(), Standard_True);
  BRepLib::BuildCurves3d(face);
  return TopoDS_Shape(face);
}

/// Balls past the end of what is left of the line in the middle.
/// Pictures show the borders of sheets and the edges between faces, not the seam of a round face.
TEST(Sheets, AreDrawnWithTheirBorders) {
  const auto edgesOf = [](const TopoDS_Shape& shape) {
    const auto solid = cadSolid(shape);
    EXPECT_TRUE(solid);
    return solid ? drawingMesh(**solid).featureEdges.size() : 0;
  };
  EXPECT_EQ(edgesOf(BRepBuilderAPI_MakeFace(gp_Pln(), 0, 10, 0, 20).Shape()), 4U);
  EXPECT_EQ(edgesOf(BRepPrimAPI_MakeBox(10, 20, 30).Shape()), 12U);
  EXPECT_EQ(edgesOf(BRepPrimAPI_MakeCylinder(5, 20).Shape()), 2U) << "the two rims";
}

TEST(Sheets, EndWhereTheirBordersCrossALineThatNeedNotBeSmooth) {
  const auto solid = cadSolid(cutSheet());
  ASSERT_TRUE(solid) << format(solid.error());
  for (double y = 23; y < 45; y += 0.5) {
    // The border is about 10 mm in X for 18 in Y.
    EXPECT_FALSE((*solid)->firstContact({12, y, 40}, {12, y, -40}, 1)) << y;
    EXPECT_FALSE((*solid)->firstContact({40, y, 3}, {11.2, y, 3}, 1)) << y;
    const double far = (y - 20) * 10 / std::hypot(10, 18);
    EXPECT_FALSE((*solid)->firstContact({14, y, 40}, {10, y, 2}, 0.8 * far)) << y;
  }
  std::mt19937_64 random(42);
  const auto& sheet = dynamic_cast<const CadSolid&>(**solid);
  testing::expectTrueContacts("sheet", sheet.shape(), sheet, random, 300);
  for (double y = 1; y < 18; y += 0.5) {
    const auto contact = (*solid)->firstContact({10, y, 40}, {10, y, -40}, 1);
    ASSERT_TRUE(contact) << y;
    // There it rises by one in five.
    EXPECT_NEAR(contact->touchPoint.z(), 3 + (contact->touchPoint.x() - 10) / 5, 0.02) << y;
  }
}

/// A bowl z = (x x + y y) / `width` over 80 x 80 mm, as a spline, with a hole of radius 30 about Z.
TopoDS_Shape bowlWithAHole(double width) {
  TColgp_Array2OfPnt poles(1, 3, 1, 3);
  for (const int i : {-1, 0, 1}) {
    for (const int j : {-1, 0, 1}) {
      const double edge = 1600 / width;  // the height at the middle of a side
      poles(i + 2, j + 2) = gp_Pnt(40 * i, 40 * j, (i == 0 ? -edge : edge) + (j == 0 ? -edge : edge));
    }
  }
  TColStd_Array1OfReal knots(1, 2);
  knots(1) = -40;
  knots(2) = 40;
  TColStd_Array1OfInteger multiplicities(1, 2);
  multiplicities.Init(3);
  const Handle(Geom_Surface) bowl = new Geom_BSplineSurface(poles, knots, knots, multiplicities, multiplicities, 2, 2);
  const Handle(Geom2d_Circle) circle = new Geom2d_Circle(gp_Ax2d(gp_Pnt2d(0, 0), gp_Dir2d(1, 0)), 30);
  const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(circle, bowl);
  BRep_Builder().UpdateEdge(edge, new Geom_Circle(gp_Ax2(gp_Pnt(0, 0, 900 / width), gp::DZ()), 30), 1e-7);
  const TopoDS_Wire hole = BRepBuilderAPI_MakeWire(edge);
  BRepBuilderAPI_MakeFace face(bowl, 1e-7);
  face.Add(TopoDS::Wire(hole.Reversed()));
  BRepLib::BuildCurves3d(face.Face());
  return face.Shape();
}

double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Balls in the hole go to its edge, so near to what the surface does beyond the edge that they touch it nowhere.
TEST(Sheets, EndAtTheEdgesOfHoles) {
  std::mt19937_64 random(43);
  for (const double width : {1e4, 100.0, 20.0}) {
    const auto solid = cadSolid(bowlWithAHole(width));
    ASSERT_TRUE(solid) << format(solid.error());
    const double edge = 900 / width, begin = processorSeconds();
    for (int i = 0; i < 100; ++i) {
      const double turn = uniform(random, 0, 2 * std::numbers::pi), ball = uniform(random, 0.5, 12);
      const double below = uniform(random, 0, 0.6) * ball;
      const Vector3 way(std::cos(turn), std::sin(turn), 0);
      const auto contact = (*solid)->firstContact({0, 0, edge - below}, 40 * way + Vector3(0, 0, edge - below), ball);
      ASSERT_TRUE(contact) << i;
      EXPECT_NEAR(contact->fraction * 40, 30 - std::sqrt(ball * ball - below * below), 1e-6)
          << i << ": a ball of " << ball << " towards " << turn;
    }
    EXPECT_LT(processorSeconds() - begin, 10) << "where a contact is looked for all over the surface: minutes";
  }
}

/// From within one of two bodies that touch, through the face that they share: the ball starts in material.
TEST(BodiesThatTouch, AreMaterialWithinEach) {
  BRep_Builder builder;
  for (const bool swapped : {false, true}) {
    const TopoDS_Shape left = BRepPrimAPI_MakeBox(gp_Pnt(-20, -20, 0), gp_Pnt(0, 20, 40)).Shape();
    const TopoDS_Shape right = BRepPrimAPI_MakeBox(gp_Pnt(0, -10, 10), gp_Pnt(20, 10, 30)).Shape();
    TopoDS_Compound both;
    builder.MakeCompound(both);
    builder.Add(both, swapped ? right : left);
    builder.Add(both, swapped ? left : right);
    const auto solid = cadSolid(both);
    ASSERT_TRUE(solid) << format(solid.error());
    for (const double x : {-11.0, 11.0}) {
      const auto contact = (*solid)->firstContact({x, 1, 21}, {-x, 2, 22}, 3);
      ASSERT_TRUE(contact);
      EXPECT_EQ(contact->fraction, 0) << "from x " << x;
    }
    const auto outside = (*solid)->firstContact({50, 0, 20}, {0, 0, 20}, 3);
    ASSERT_TRUE(outside);
    EXPECT_NEAR(outside->ballCentre.x(), 23, 1e-9);
  }
}

/// A wavy sheet of 100 x 100 mm over x and y, as a spline over parameters 0 to 1.
Handle(Geom_BSplineSurface) sheet() {
  TColgp_Array2OfPnt points(1, 6, 1, 6);
  for (int i = 1; i <= 6; ++i) {
    for (int j = 1; j <= 6; ++j)
      points(i, j) = gp_Pnt(20 * i - 20, 20 * j - 20, 2 * std::sin(1.1 * i) * std::cos(0.9 * j));
  }
  return GeomAPI_PointsToBSplineSurface(points, 3, 3, GeomAbs_C2, 1e-6).Surface();
}

/// The part of a surface within a polygon of its parameters.
TopoDS_Face within(const Handle(Geom_Surface) & surface, const std::vector<Vector2>& corners) {
  BRepBuilderAPI_MakeWire wire;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2 from = corners[i], way = corners[(i + 1) % corners.size()] - from;
    wire.Add(BRepBuilderAPI_MakeEdge(new Geom2d_Line(gp_Pnt2d(from.x(), from.y()), gp_Dir2d(way.x(), way.y())), surface,
                                     0, way.norm()));
  }
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(surface, wire.Wire(), Standard_True);
  BRepLib::BuildCurves3d(face);
  return face;
}

/// A square with a tail that is slimmer than a cell of the grid and slanted to it.
TEST(FaceGrid, LeavesOutNoSlimPartOfAFace) {
  const Handle(Geom_BSplineSurface) surface = sheet();
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  surface->Bounds(u0, u1, v0, v1);
  const auto at = [&](double a, double b) { return Vector2(u0 + a * (u1 - u0), v0 + b * (v1 - v0)); };
  const TopoDS_Face tailed = within(surface, {at(0.1, 0.1), at(0.4, 0.1), at(0.4, 0.2), at(0.9, 0.61), at(0.9, 0.618),
                                              at(0.4, 0.208), at(0.4, 0.4), at(0.1, 0.4)});
  FaceMeshOptions options;
  options.leaveAll = true;
  constexpr double kCoarse = 0.5;
  ASSERT_EQ(meshFaces(tailed, kCoarse, options).size(), 1U);
  const auto solid = cadSolid(tailed, {kCoarse});
  ASSERT_TRUE(solid) << format(solid.error());
  std::mt19937_64 random(11);
  for (int i = 0; i < 300; ++i) {
    const double along = uniform(random, 0.01, 0.99);
    const Vector2 uv = at(0.4 + along * 0.5, 0.204 + along * 0.41);
    const gp_Pnt p = surface->Value(uv.x(), uv.y());
    EXPECT_TRUE((*solid)->firstContact({p.X(), p.Y(), 50}, {p.X(), p.Y(), -50}, 0.1)) << along;
  }
}

/// Cells are halved along the direction in which the surface leaves them, and along no other: the quarter of a circle
/// of radius 40 in chords, the straight line in the 16 cells that it begins with.
TEST(FaceGrid, HalvesCellsOnlyWhereTheSurfaceIsBent) {
  constexpr double quarter = std::numbers::pi / 2;
  const Handle(Geom_Curve) arc =
      new Geom_TrimmedCurve(new Geom_Circle(gp_Ax2(gp_Pnt(0, 0, 0), gp::DZ()), 40), 0, quarter);
  const Handle(Geom_Surface) drawn =
      new Geom_RectangularTrimmedSurface(new Geom_SurfaceOfLinearExtrusion(arc, gp::DZ()), 0.0, quarter, 0.0, 30.0);
  for (const bool bentAlongV : {false, true}) {
    const Handle(Geom_BSplineSurface) surface = GeomConvert::SurfaceToBSplineSurface(drawn);
    if (bentAlongV) surface->ExchangeUV();
    const CadFace face = cadFace(BRepBuilderAPI_MakeFace(surface, 1e-6));
    // A chord over an angle a lies 40 (1 - cos(a / 2)) from the arc: 0.048 mm in 16 cells, 0.012 mm in 32, 0.003 mm in
    // 64. Cells of a spline are not all alike, some half as much farther.
    for (const auto& [deflection, across] : {std::pair(0.1, 16U), {0.03, 32U}, {0.008, 64U}}) {
      const FaceGrid grid(face, deflection);
      EXPECT_EQ(grid.triangles().size(), 2 * 16 * across) << deflection;
      EXPECT_LE(grid.deviation(), deflection);
      EXPECT_GE(grid.deviation(), 40 * (1 - std::cos(quarter / across / 2)));
    }
  }
}

/// A ball that comes to the border of a free-form face stops where it touches the border, not where it touches a
/// triangle of the face near by.
TEST(FreeFormFaces, AreMetExactlyAtTheirBorders) {
  // Revolved, a circle of radius 6 about (14, 0, 3) makes a torus; OpenCASCADE keeps it as a surface of revolution.
  const Handle(Geom_Curve) arc = new Geom_TrimmedCurve(new Geom_Circle(gp_Ax2(gp_Pnt(14, 0, 3), gp::DY()), 6), 5.5, 9);
  const Handle(Geom_Surface) surface = new Geom_SurfaceOfRevolution(arc, gp::OZ());
  struct Way {
    double u0, u1;
    Vector3 from, to;
    double radius;
  };
  const std::vector<Way> ways{{12.917240749028991,
                               14.921869366351153,
                               {27.57558854188223, -17.194863261803935, 1.8869521680004262},
                               {-3.0372697742628212, 9.7277399313015387, 6.790519344778164},
                               3.6180950573900259},
                              {-0.081443549811620386,
                               0.80162059586708567,
                               {15.593013158831514, -16.096752512494678, 7.9879642426746722},
                               {15.593013158831514, 24.417196492574913, 7.9879642426746722},
                               0.81810253116546761},
                              {-13.078618587012373,
                               -10.230999823606764,
                               {3.1264268393513648, 5.1572444286054884, -43.079001957981738},
                               {3.1264268393513648, 5.1572444286054884, 25.067908532239475},
                               5.1613731104368892},
                              {6.0871092689427186,
                               8.6035374300437262,
                               {17.447896606833414, -38.118802000280624, 6.142303333220954},
                               {17.447896606833414, 38.540311905950986, 6.142303333220954},
                               1.4257584344368954},
                              {12.944380546872139,
                               13.595315250247403,
                               {0.73415644931864676, 28.960820098653617, 7.4654809885831757},
                               {19.811419692907066, -17.507764545781672, 10.599567576581046},
                               1.7541978391665938},
                              {-4.4785722391748273,
                               0.7164171768379175,
                               {21.042420369317064, 21.242640505116345, 52.027561346652703},
                               {-9.1522223864564936, -9.3088987126906417, -4.434963983325126},
                               6.9515812291509098}};
  for (const Way& way : ways) {
    const auto solid = cadSolid(BRepBuilderAPI_MakeFace(surface, way.u0, way.u1, 5.5, 9, 1e-7).Shape());
    ASSERT_TRUE(solid);
    const auto contact = (*solid)->firstContact(way.from, way.to, way.radius);
    ASSERT_TRUE(contact);
    EXPECT_NEAR((contact->touchPoint - contact->ballCentre).norm(), way.radius, 1e-7) << way.from.transpose();
    // It is the border that it touches: an end of the range of u, or the circle of an end of the arc.
    const Vector3& p = contact->touchPoint;
    const auto turnsFrom = [&](double u) {
      return std::abs(std::remainder(std::atan2(p.y(), p.x()) - u, 2 * std::numbers::pi));
    };
    const auto ringFrom = [&](double v) {
      const gp_Pnt end = arc->Value(v);
      return std::hypot(std::hypot(p.x(), p.y()) - std::hypot(end.X(), end.Y()), p.z() - end.Z());
    };
    EXPECT_LT(std::min({turnsFrom(way.u0), turnsFrom(way.u1), ringFrom(5.5), ringFrom(9)}), 1e-7);
  }
}

/// An arc from (0, 0, -10) over (sag, 0, 0) to (0, 0, 10), turned about the line between its ends.
TopoDS_Shape turnedChord(double sag) {
  BRepBuilderAPI_MakeWire wire(
      BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(gp_Pnt(0, 0, -10), gp_Pnt(sag, 0, 0), gp_Pnt(0, 0, 10)).Value()),
      BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 10), gp_Pnt(0, 0, -10)));
  return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp::OZ()).Shape();
}

TEST(LemonsAndApples, OfStepFilesAreNamedBecauseReadersMixThemUp) {
  const ScratchFolder folder;
  const auto remarksOn = [&](const TopoDS_Shape& shape) {
    EXPECT_TRUE(writeStep(shape, folder / "part.step"));
    ImportOptions options;
    options.faceSeconds = 0.5;  // the mesher takes long for some of them
    const auto solid = readStep(folder / "part.step", options);
    EXPECT_TRUE(solid);
    std::string all;
    for (const Diagnostic& remark : dynamic_cast<const CadSolid&>(**solid).remarks())
      all += format(remark) + "\n";
    return all;
  };
  EXPECT_THAT(remarksOn(turnedChord(4.5)), HasSubstr("1 of 1 faces are circles turned about an axis that they reach"));
  EXPECT_THAT(remarksOn(turnedChord(4.5)), HasSubstr("compare the size of the part"));
  EXPECT_THAT(remarksOn(turnedChord(15)), HasSubstr("circles turned about an axis that they reach"));
  EXPECT_THAT(remarksOn(BRepPrimAPI_MakeTorus(10, 10).Shape()), HasSubstr("horn torus"));
  // Cut off before the axis, on either arc, there is no doubt.
  const auto cutOff = [](const TopoDS_Shape& shape, double height) {
    const gp_Pnt corner(-50, -50, -height);
    return BRepAlgoAPI_Common(shape, BRepPrimAPI_MakeBox(corner, 100, 100, 2 * height).Shape()).Shape();
  };
  EXPECT_THAT(remarksOn(cutOff(turnedChord(4.5), 9)), Not(HasSubstr("turned about an axis")));
  EXPECT_THAT(remarksOn(cutOff(turnedChord(15), 9)), Not(HasSubstr("turned about an axis")));
  EXPECT_THAT(remarksOn(cutOff(BRepPrimAPI_MakeTorus(10, 10).Shape(), 9)), HasSubstr("horn torus"));
  EXPECT_THAT(remarksOn(BRepPrimAPI_MakeTorus(10, 5).Shape()), Not(HasSubstr("turned about an axis")));
  EXPECT_THAT(remarksOn(BRepPrimAPI_MakeSphere(10).Shape()), Not(HasSubstr("turned about an axis")));
}

/// A circle turned about an axis, from any angle on, as a spline: where that closes it begins at an angle of its own,
/// and the face goes on beyond its ends by what it begins earlier.
TEST(UnusualFaces, GoOnBeyondTheEndsOfTheirSplinesWhereTheirEdgesDo) {
  constexpr double kTorus = 20, kTube = 1.5, kTurn = 2 * std::numbers::pi;
  int beyond = 0;
  for (const double start : {0.0, 1.0, 1.5332, 2.2, 3.0, 6.0}) {
    const Handle(Geom_ToroidalSurface) torus = new Geom_ToroidalSurface(gp_Ax3(gp::XOY()), kTorus, kTube);
    const TopoDS_Face face =
        BRepBuilderAPI_MakeFace(torus, start, start + kTurn, 0, std::numbers::pi, Precision::Confusion()).Face();
    const TopoDS_Shape spline = BRepBuilderAPI_NurbsConvert(face, true).Shape();
    if (!BRepCheck_Analyzer(spline).IsValid()) continue;  // of some angles OpenCASCADE makes a face without an inside
    TopExp_Explorer faces(spline, TopAbs_FACE);
    double u0 = 0, u1 = 0, v0 = 0, v1 = 0, first = 0, last = 0, low = 0, high = 0;
    BRepTools::UVBounds(TopoDS::Face(faces.Current()), u0, u1, v0, v1);
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(TopoDS::Face(faces.Current()));
    surface->Bounds(first, last, low, high);
    if (!surface->IsUPeriodic() && (u0 < first - 0.01 || u1 > last + 0.01)) ++beyond;
    const auto solid = cadSolid(spline);
    ASSERT_TRUE(solid);
    // Closely about where the face begins.
    for (double angle = start - 0.1; angle < start + kTurn - 0.1; angle += angle < start + 0.1 ? 0.004 : 0.3) {
      const Vector3 crest(kTorus * std::cos(angle), kTorus * std::sin(angle), 0);
      const auto contact = (*solid)->firstContact(crest + 10 * Vector3::UnitZ(), crest, 0.4);
      ASSERT_TRUE(contact) << start << " " << angle;
      EXPECT_NEAR(contact->ballCentre.z(), kTube + 0.4, 1e-6) << start << " " << angle;
    }
  }
  EXPECT_GT(beyond, 0) << "no spline ends within its face";
}

/// A shape without faces and one without an end have no size.
TEST(UnusualFaces, HaveNoSizeWhereNoBoxHoldsThem) {
  TopoDS_Compound empty;
  BRep_Builder().MakeCompound(empty);
  EXPECT_EQ(sizeOf(empty), 0);
  EXPECT_EQ(sizeOf(BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY())).Face()), 0);
  EXPECT_NEAR(sizeOf(BRepPrimAPI_MakeBox(2, 3, 6).Shape()), 7, 1e-3);
}

}  // namespace
}  // namespace probewright::simulation
