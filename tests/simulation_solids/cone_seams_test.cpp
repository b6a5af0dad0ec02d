#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <BRepAdaptor_Surface.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Line.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <utility>
#include <vector>

#include "simulation/face_mesh.hpp"

namespace probewright::simulation {
namespace {

using ::testing::IsEmpty;

/// The two lines of the seam of a cone's face, turned by so little that it is a rounding error: computed seams of files
/// are like that.
void turnSeam(const TopoDS_Face& cone, double angle, double otherAngle) {
  for (TopExp_Explorer edges(cone, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(edges.Current().Oriented(TopAbs_FORWARD));
    if (!BRep_Tool::IsClosed(edge, cone)) continue;
    double first = 0, last = 0;
    const auto turned = [&](const TopoDS_Shape& side, double by) {
      const gp_Pnt2d from = BRep_Tool::CurveOnSurface(TopoDS::Edge(side), cone, first, last)->Value(0);
      return new Geom2d_Line(from, gp_Dir2d(by, 1));
    };
    const Handle(Geom2d_Line) one = turned(edge, angle), other = turned(edge.Reversed(), otherAngle);
    BRep_Builder().UpdateEdge(edge, one, other, cone, BRep_Tool::Tolerance(edge));
  }
}

/// The same face whose border begins with another of its edges.
TopoDS_Face begunLater(const TopoDS_Face& face, int edges) {
  std::vector<TopoDS_Shape> border;
  for (TopExp_Explorer found(face, TopAbs_EDGE); found.More(); found.Next())
    border.push_back(found.Current());
  std::ranges::rotate(border, border.begin() + edges);
  const BRep_Builder builder;
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (const TopoDS_Shape& edge : border)
    builder.Add(wire, edge);
  wire.Closed(true);
  TopoDS_Face begun = TopoDS::Face(face.EmptyCopied());
  builder.Add(begun, wire);
  return begun;
}

TEST(ConeSeams, UprightButForRoundingLeaveTheFaceItsTriangles) {
  for (const double end : {0.0, 4.0}) {
    for (const auto& [angle, other] : {std::pair(0.0, 0.0),
                                       {1.4e-15, 1.4e-15},
                                       {-1.4e-15, -1.4e-15},
                                       {2.6e-16, 2.6e-16},
                                       {-5e-13, 0.0},
                                       {0.0, -5e-13}}) {
      for (const int begin : {0, 1, 2, 3}) {
        SCOPED_TRACE(
            fmt::format("cone to {}, seam turned by {} and {}, border begun with edge {}", end, angle, other, begin));
        const TopoDS_Shape body = BRepPrimAPI_MakeCone(10, end, 8).Shape();
        TopExp_Explorer faces(body, TopAbs_FACE);
        while (BRepAdaptor_Surface(TopoDS::Face(faces.Current())).GetType() != GeomAbs_Cone)
          faces.Next();
        const TopoDS_Face cone = begunLater(TopoDS::Face(faces.Current().Oriented(TopAbs_FORWARD)), begin);
        turnSeam(cone, angle, other);
        EXPECT_TRUE(BRepCheck_Analyzer(cone).IsValid());
        EXPECT_THAT(meshFaces(cone, 0.01), IsEmpty());
      }
    }
  }
}

}  // namespace
}  // namespace probewright::simulation
