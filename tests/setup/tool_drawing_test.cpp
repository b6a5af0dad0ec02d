#include "setup/tool_drawing.hpp"

#include <gtest/gtest.h>

/// How reports draw cutters.
namespace probewright::setup {
namespace {

TEST(ToolDrawing, DrawsEachToothAsOneLineFromTheAxisUp) {
  simulation::TrueTool mill;
  mill.kind = simulation::ToolKind::Cutter;
  mill.length = 80;
  mill.radius = 5;
  mill.cutter.cutLength = 20;
  mill.cutter.helix = 0;
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

}  // namespace
}  // namespace probewright::setup
