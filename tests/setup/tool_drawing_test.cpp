#include "setup/tool_drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// How reports draw cutters.
namespace probewright::setup {
namespace {

/// 10 mm wide and 80 mm long, its edges upright and 20 mm long; without teeth.
simulation::TrueTool straightMill() {
  simulation::TrueTool mill;
  mill.kind = simulation::ToolKind::Cutter;
  mill.length = 80;
  mill.radius = 5;
  mill.cutter.cutLength = 20;
  mill.cutter.helix = 0;
  return mill;
}

TEST(ToolDrawing, DrawsEachToothAsOneLineFromTheAxisUp) {
  simulation::TrueTool mill = straightMill();
  const std::size_t body = drawnTool(mill).featureEdges.size();
  mill.cutter.teeth.resize(1);
  const reports::Mesh mesh = drawnTool(mill);
  ASSERT_GT(mesh.featureEdges.size(), body);
  // The teeth come before the rims of the body.
  std::vector<reports::Vector3f> tooth(mesh.featureEdges.begin(),
                                       mesh.featureEdges.end() - static_cast<std::ptrdiff_t>(body));
  ASSERT_EQ(tooth.size() % 2, 0U);
  EXPECT_LT(tooth.front().norm(), 1e-6) << "it begins at the end of the tool, on its axis";
  EXPECT_LT((tooth.back() - reports::Vector3f(5.01F, 0, 20)).norm(), 1e-3) << "and ends with the edges";
  for (std::size_t i = 0; i < tooth.size(); i += 2) {
    EXPECT_GT((tooth[i + 1] - tooth[i]).norm(), 1e-3) << "no piece is a point";
    EXPECT_EQ(tooth[i], tooth[i == 0 ? 0 : i - 1]) << "the pieces hang together";
  }
}

TEST(ToolDrawing, DrawsRunOutWearAndWhatHasBrokenOffATooth) {
  simulation::TrueTool mill = straightMill();
  const std::size_t body = drawnTool(mill).featureEdges.size();
  mill.cutter.teeth = {{.radial = 0.1, .axial = 0.3, .radialWear = 0.04, .axialWear = 0.2}};
  const reports::Mesh shifted = drawnTool(mill);
  ASSERT_GT(shifted.featureEdges.size(), body);
  // A longer tooth ends below the tool's end, a worn one above it.
  const std::size_t last = shifted.featureEdges.size() - body - 1;
  EXPECT_LT((shifted.featureEdges.front() - reports::Vector3f(0.06F, 0, -0.1F)).norm(), 1e-5);
  EXPECT_LT((shifted.featureEdges[last] - reports::Vector3f(5.01F + 0.06F, 0, 19.9F)).norm(), 1e-5);
  mill.cutter.teeth = {{.broken = 6}};
  const reports::Mesh broken = drawnTool(mill);
  for (std::size_t i = 0; i + body < broken.featureEdges.size(); ++i)
    EXPECT_GE(broken.featureEdges[i].z(), 6 - 1e-5F);
}

/// The edges of a tool in a holder cannot reach into it, and the shank ends where the holder begins.
TEST(ToolDrawing, DrawsTheHolderFromItsLowerEndToTheSpindle) {
  simulation::TrueTool mill = straightMill();
  mill.cutter.cutLength = 100;
  mill.cutter.shankRadius = 4;
  mill.cutter.holderLength = 30;
  mill.cutter.holderRadius = 20;
  const reports::Mesh mesh = drawnTool(mill);
  /// How far from the tool's axis the body reaches at a height.
  const auto widest = [&](float height) {
    float found = 0;
    for (const reports::Vector3f& each : mesh.positions)
      if (std::abs(each.z() - height) < 1e-4F) found = std::max(found, each.head<2>().norm());
    return found;
  };
  EXPECT_NEAR(widest(50), 20, 1e-3) << "80 mm less the 30 mm of the holder";
  EXPECT_NEAR(widest(80), 20, 1e-3);
  const auto highest = std::ranges::max_element(mesh.positions, {}, [](const auto& each) { return each.z(); });
  EXPECT_NEAR(highest->z(), 80, 1e-4);
}

/// The edges of an insert run along X and Z through its theoretical tip, which is the origin: the nose touches both.
TEST(ToolDrawing, DrawsBothEdgesOfAnInsertAndItsNose) {
  simulation::TrueTool tool = straightMill();
  tool.radius = 12;
  tool.cutter.insert =
      simulation::TrueInsert{.noseRadius = 0.8, .firstNormal = -90, .secondNormal = 0, .edgeLength = 10};
  for (const double orientation : {0.0, 90.0}) {
    tool.cutter.insert->orientation = orientation;
    const reports::Mesh mesh = drawnTool(tool);
    const auto at = [&](float x, float z) {
      return orientation == 0 ? reports::Vector3f(x, 0, z) : reports::Vector3f(0, x, z);
    };
    const auto draws = [&](const reports::Vector3f& point) {
      return std::ranges::any_of(mesh.featureEdges, [&](const auto& each) { return (each - point).norm() < 1e-4F; });
    };
    EXPECT_LT((mesh.featureEdges.front() - at(-10.8F, 0)).norm(), 1e-4F) << "the end of the edge along X";
    EXPECT_TRUE(draws(at(-0.8F, 0))) << "there the nose begins";
    const float middle = -0.8F + 0.8F * std::sqrt(0.5F);
    EXPECT_TRUE(draws(at(middle, -middle)));
    EXPECT_TRUE(draws(at(0, 0.8F))) << "there it ends";
    EXPECT_TRUE(draws(at(0, 10.8F))) << "the end of the edge along Z";
  }
}

}  // namespace
}  // namespace probewright::setup
