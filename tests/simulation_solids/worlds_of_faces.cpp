#include "worlds_of_faces.hpp"

#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_GTransform.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeChamfer.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <ShapeCustom.hxx>
#include <ShapeUpgrade_ShapeDivideAngle.hxx>
#include <ShapeUpgrade_ShapeDivideClosed.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>

#include "worlds.hpp"

namespace probewright::simulation::testing {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTurn = 2 * kPi;

gp_Pnt point(const Vector3& p) { return {p.x(), p.y(), p.z()}; }

gp_Ax2 randomAxes(std::mt19937_64& random) {
  const Vector3 z = randomDirection(random);
  return {point(randomPoint(random, 30)), gp_Dir(z.x(), z.y(), z.z())};
}

/// A curve in the plane of x and z to the right of the axis, degree 1 (with kinks) or 3.
Handle(Geom_BSplineCurve) profile(int degree) {
  const std::array<gp_Pnt, 7> poles{
      {{12, 0, 0}, {16, 0, 4}, {11, 0, 9}, {14, 0, 13}, {9, 0, 18}, {13, 0, 22}, {8, 0, 26}}};
  TColgp_Array1OfPnt points(1, 7);
  for (int i = 0; i < 7; ++i)
    points(i + 1) = poles[static_cast<std::size_t>(i)];
  const int count = 8 - degree;
  TColStd_Array1OfReal knots(1, count);
  TColStd_Array1OfInteger multiplicities(1, count);
  for (int i = 1; i <= count; ++i) {
    knots(i) = i;
    multiplicities(i) = i == 1 || i == count ? degree + 1 : 1;
  }
  return new Geom_BSplineCurve(points, knots, multiplicities, degree);
}

Handle(Geom_BSplineSurface) waves() {
  TColgp_Array2OfPnt points(1, 9, 1, 8);
  for (int i = 1; i <= 9; ++i) {
    for (int j = 1; j <= 8; ++j)
      points(i, j) = gp_Pnt(5.0 * i - 25, 5.0 * j - 22, 3 * std::sin(0.9 * i) * std::cos(0.8 * j) + 0.05 * i * j);
  }
  return GeomAPI_PointsToBSplineSurface(points, 3, 8, GeomAbs_C2, 1e-4).Surface();
}

TopoDS_Shape face(const Handle(Geom_Surface) & surface, double u0, double u1, double v0, double v1) {
  return BRepBuilderAPI_MakeFace(surface, u0, u1, v0, v1, 1e-7).Shape();
}

/// A range of at most a turn, some turns away.
std::pair<double, double> arc(std::mt19937_64& random) {
  const double from = kTurn * static_cast<double>(static_cast<int>(random() % 5) - 2) + uniform(random, -kPi, kPi);
  return {from, from + (random() % 4 == 0 ? kTurn : uniform(random, 0.3, 6))};
}

TopoDS_Shape moved(const TopoDS_Shape& shape, const gp_Trsf& by) {
  return BRepBuilderAPI_Transform(shape, by, Standard_True).Shape();
}

/// The profile of a body of revolution, closed, as a face in the plane of x and z.
TopoDS_Shape turned(const Handle(Geom_Curve) & side, double inner, const gp_Ax1& axis, double angle) {
  const gp_Pnt low = side->Value(side->FirstParameter());
  const gp_Pnt high = side->Value(side->LastParameter());
  const gp_Pnt innerLow(inner, 0, low.Z()), innerHigh(inner, 0, high.Z());
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(innerLow, low), BRepBuilderAPI_MakeEdge(side),
                               BRepBuilderAPI_MakeEdge(high, innerHigh), BRepBuilderAPI_MakeEdge(innerHigh, innerLow));
  return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(wire.Wire(), Standard_True).Shape(), axis, angle).Shape();
}

TopoDS_Shape rounded(const TopoDS_Shape& body, double radius) {
  BRepFilletAPI_MakeFillet fillet(body);
  for (TopExp_Explorer edges(body, TopAbs_EDGE); edges.More(); edges.Next())
    fillet.Add(radius, TopoDS::Edge(edges.Current()));
  return fillet.Shape();
}

}  // namespace

std::vector<NamedShape> singleFaces(std::mt19937_64& random) {
  std::vector<NamedShape> faces;
  const auto add = [&](const std::string& name, const Handle(Geom_Surface) & surface, std::pair<double, double> u,
                       std::pair<double, double> v) {
    faces.push_back({name, face(surface, u.first, u.second, v.first, v.second)});
  };
  const gp_Ax3 axes(randomAxes(random));
  gp_Ax3 leftHanded = axes;
  leftHanded.YReverse();
  const gp_Ax3& frame = random() % 2 == 0 ? axes : leftHanded;
  const double radius = uniform(random, 4, 20);
  const auto length = [&] {
    const double from = uniform(random, -40, 20);
    return std::pair(from, from + uniform(random, 3, 40));
  };
  add("plane", new Geom_Plane(frame), length(), length());
  add("cylinder", new Geom_CylindricalSurface(frame, radius), arc(random), length());
  const double low = uniform(random, -1.5, 1.2);
  add("sphere", new Geom_SphericalSurface(frame, radius), arc(random),
      {low, std::min(kPi / 2, low + uniform(random, 0.3, 3))});
  const double slope = uniform(random, 0.15, 1.2) * (random() % 2 == 0 ? 1 : -1);
  const Handle(Geom_Surface) cone = new Geom_ConicalSurface(frame, slope, radius);
  const double apex = -radius / std::sin(slope);
  add("cone before its apex", cone, arc(random), {apex + (slope > 0 ? 2 : -20), apex + (slope > 0 ? 20 : -2)});
  add("cone beyond its apex", cone, arc(random), {apex - (slope > 0 ? 20 : -2), apex - (slope > 0 ? 2 : -20)});
  add("cone across its apex", cone, arc(random), {apex - uniform(random, 3, 15), apex + uniform(random, 3, 15)});
  add("cone to its apex", cone, arc(random), {apex - 12, apex});
  add("ring torus", new Geom_ToroidalSurface(frame, radius, uniform(random, 0.1, 0.9) * radius), arc(random),
      arc(random));
  add("horn torus", new Geom_ToroidalSurface(frame, radius, radius), arc(random), arc(random));
  add("spindle torus", new Geom_ToroidalSurface(frame, radius, uniform(random, 1.1, 2) * radius), arc(random),
      arc(random));
  const Handle(Geom_BSplineSurface) wavy = waves();
  add("B-spline", wavy, {0.1, 0.9}, {0.05, 1});
  add("offset B-spline", new Geom_OffsetSurface(wavy, uniform(random, -1, 1)), {0, 0.8}, {0.1, 1});
  add("offset cylinder", new Geom_OffsetSurface(new Geom_CylindricalSurface(frame, radius), 0.3 * radius), arc(random),
      length());
  add("offset torus", new Geom_OffsetSurface(new Geom_ToroidalSurface(frame, radius, 0.4 * radius), 0.2 * radius),
      arc(random), arc(random));
  const gp_Ax1 axis(gp::Origin(), gp::DZ());
  for (const int degree : {1, 3}) {
    const Handle(Geom_Curve) curve = profile(degree);
    const std::string kind = degree == 1 ? "kinked " : "smooth ";
    const std::pair<double, double> part(1.3, curve->LastParameter() - 0.4);
    add(kind + "revolution", new Geom_SurfaceOfRevolution(curve, axis), arc(random), part);
    add(kind + "extrusion", new Geom_SurfaceOfLinearExtrusion(curve, gp_Dir(0.3, 1, 0.2)), part, length());
  }
  const Handle(Geom_Curve) circle = new Geom_Circle(gp_Ax2(gp_Pnt(14, 0, 3), gp::DY()), 6);
  add("revolved circle", new Geom_SurfaceOfRevolution(circle, axis), arc(random), arc(random));
  add("extruded circle", new Geom_SurfaceOfLinearExtrusion(circle, gp_Dir(0.2, 1, 0)), arc(random), length());
  const Handle(Geom_Curve) part = new Geom_TrimmedCurve(circle, 5.5, 9);
  add("revolved arc", new Geom_SurfaceOfRevolution(part, axis), arc(random), {5.5, 9});
  add("extruded arc", new Geom_SurfaceOfLinearExtrusion(part, gp_Dir(0, 1, 0.4)), {5.6, 8.9}, length());
  const Handle(Geom_BSplineSurface) rational = GeomConvert::SurfaceToBSplineSurface(
      new Geom_RectangularTrimmedSurface(new Geom_ToroidalSurface(frame, radius, 0.5 * radius), 0, kTurn, 1, 1 + kPi));
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  rational->Bounds(u0, u1, v0, v1);
  add("rational B-spline", rational, {u0, u1}, {v0, v0 + 0.8 * (v1 - v0)});
  return faces;
}

std::vector<NamedShape> bodies(std::mt19937_64& random) {
  std::vector<NamedShape> all;
  const gp_Ax2 up = gp::XOY();
  const gp_Ax1 axis = gp::OZ();
  const auto box = [](double x, double y, double z) {
    return BRepPrimAPI_MakeBox(gp_Pnt(-x / 2, -y / 2, 0), gp_Pnt(x / 2, y / 2, z)).Shape();
  };
  all.push_back({"rounded box", rounded(box(40, 30, 20), 4)});
  all.push_back({"cylinder piece", BRepPrimAPI_MakeCylinder(up, 15, 20, uniform(random, 1, 6)).Shape()});
  all.push_back({"cone", BRepPrimAPI_MakeCone(up, 15, uniform(random, 0, 10), 20).Shape()});
  all.push_back({"sphere piece", BRepPrimAPI_MakeSphere(up, 18, -0.6, 1.1, uniform(random, 1, 6)).Shape()});
  all.push_back({"torus", BRepPrimAPI_MakeTorus(up, 20, uniform(random, 3, 15)).Shape()});
  all.push_back({"torus piece", BRepPrimAPI_MakeTorus(up, 20, 6, 0.3, 2.4, uniform(random, 1, 6)).Shape()});
  const TopoDS_Shape bored = BRepAlgoAPI_Cut(box(50, 40, 20), BRepPrimAPI_MakeCylinder(up, 9, 50).Shape()).Shape();
  all.push_back({"bored and rounded", rounded(bored, 2)});
  all.push_back(
      {"cross bore", BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(up, 15, 40).Shape(),
                                     BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(3, -40, 18), gp::DY()), 7, 80).Shape())
                         .Shape()});
  all.push_back({"groove", BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(up, 18, 20).Shape(),
                                           BRepPrimAPI_MakeTorus(gp_Ax2(gp_Pnt(0, 0, 20), gp::DZ()), 10, 4).Shape())
                               .Shape()});
  for (const int degree : {1, 3})
    all.push_back({degree == 1 ? "turned with kinks" : "turned spline",
                   turned(profile(degree), 4, axis, uniform(random, 1.5, 6.28))});
  all.push_back({"turned all around", turned(profile(3), 4, axis, kTurn)});
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(gp_Pnt(12, 3, 14), 11).Shape();
  all.push_back({"ball in a block", BRepAlgoAPI_Fuse(box(30, 30, 14), ball).Shape()});
  all.push_back({"ball out of a block", BRepAlgoAPI_Cut(box(30, 30, 14), ball).Shape()});
  all.push_back({"washer with a bead", beadWasher()});
  return all;
}

NamedShape disguised(const NamedShape& body, std::size_t how, std::mt19937_64& random) {
  NamedShape made = body;
  std::size_t next = 0;
  const auto add = [&](const std::string& name, const auto& make) {
    if (next++ != how) return;
    try {
      const TopoDS_Shape shape = make();
      if (!shape.IsNull()) made = {body.name + ", " + name, shape};
    } catch (const Standard_Failure&) {
      // OpenCASCADE cannot make everything of everything.
    }
  };
  const TopoDS_Shape& shape = body.shape;
  add("as it is", [&] { return shape; });
  add("as B-splines",
      [&] { return ShapeCustom::ConvertToBSpline(shape, Standard_True, Standard_True, Standard_True, Standard_True); });
  add("as NURBS", [&] { return BRepBuilderAPI_NurbsConvert(shape, Standard_True).Shape(); });
  add("as revolutions", [&] { return ShapeCustom::ConvertToRevolution(shape); });
  add("split", [&] {
    ShapeUpgrade_ShapeDivideAngle divide(uniform(random, 1, 3), shape);
    divide.Perform();
    return divide.Result();
  });
  add("without seams", [&] {
    ShapeUpgrade_ShapeDivideClosed divide(shape);
    divide.Perform();
    return divide.Result();
  });
  add("split and joined", [&] {
    ShapeUpgrade_ShapeDivideAngle divide(uniform(random, 1, 3), shape);
    divide.Perform();
    ShapeUpgrade_UnifySameDomain unify(divide.Result());
    unify.Build();
    return unify.Shape();
  });
  add("mirrored and scaled", [&] {
    gp_Trsf mirror, scale;
    mirror.SetMirror(randomAxes(random));
    scale.SetScale(gp_Pnt(3, 4, 5), uniform(random, 0.3, 3));
    return moved(shape, scale * mirror);
  });
  add("stretched", [&] {
    gp_GTrsf stretch;
    stretch.SetVectorialPart(gp_Mat(1.3, 0.2, 0, 0, 0.8, 0.1, 0, 0, 1));
    return BRepBuilderAPI_GTransform(shape, stretch, Standard_True).Shape();
  });
  add("three of it", [&] {
    BRep_Builder builder;
    TopoDS_Compound three;
    builder.MakeCompound(three);
    for (int i = 0; i < 3; ++i) {
      gp_Trsf place;
      place.SetTranslation(gp_Vec(90.0 * i, 0, 0));
      gp_Trsf turn;
      turn.SetRotation(randomAxes(random).Axis(), uniform(random, 0, 6));
      builder.Add(three, shape.Moved(TopLoc_Location(place * turn)));
    }
    return TopoDS_Shape(three);
  });
  return made;
}

TopoDS_Shape beadWasher() {
  // Faces of revolution over the meridian bore 8, outer radius 22, height 5, a bead of radius 1.2 about radius 20.8.
  const gp_Ax3 axes(gp_Pnt(0, 0, 0), gp::DZ(), gp_Dir(0.6, 0.8, 0));
  const auto at = [](double z) { return gp_Ax3(gp_Pnt(0, 0, z), gp::DZ(), gp_Dir(0.6, 0.8, 0)); };
  const double from = 1.25 * kTurn;
  BRepBuilderAPI_Sewing sewing(1e-6);
  for (const auto& [u0, u1] : {std::pair(from, from + 0.8 * kPi), std::pair(from + 0.8 * kPi, from + kTurn)}) {
    sewing.Add(face(new Geom_CylindricalSurface(axes, 8), u0, u1, 0, 5));
    sewing.Add(face(new Geom_CylindricalSurface(axes, 22), u0, u1, 0, 5));
    // The tube's parameter v: 0 outside, a quarter turn on top, half a turn inside; one whole turn on.
    sewing.Add(face(new Geom_ToroidalSurface(at(5), 20.8, 1.2), u0, u1, kTurn, kTurn + kPi));
    const auto disc = [&](double z, double inner, double outer) {
      const auto line = [&](double r, double u) {
        return gp_Pnt(r * (0.6 * std::cos(u) - 0.8 * std::sin(u)), r * (0.8 * std::cos(u) + 0.6 * std::sin(u)), z);
      };
      const auto circle = [&](double r) { return gp_Circ(gp_Ax2(gp_Pnt(0, 0, z), gp::DZ(), gp_Dir(0.6, 0.8, 0)), r); };
      BRepBuilderAPI_MakeWire wire(
          BRepBuilderAPI_MakeEdge(circle(outer), u0, u1), BRepBuilderAPI_MakeEdge(line(outer, u1), line(inner, u1)),
          BRepBuilderAPI_MakeEdge(circle(inner), u0, u1), BRepBuilderAPI_MakeEdge(line(inner, u0), line(outer, u0)));
      return BRepBuilderAPI_MakeFace(wire.Wire(), Standard_True).Shape();
    };
    sewing.Add(disc(0, 8, 22));
    sewing.Add(disc(5, 8, 19.6));
  }
  sewing.Perform();
  ShapeUpgrade_UnifySameDomain unify(sewing.SewedShape());
  unify.Build();
  return unify.Shape();
}

}  // namespace probewright::simulation::testing
