#include "setup/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simulation/solid_recipe.hpp"
#include "support/virtual_world.hpp"

namespace probewright::setup {
namespace {

using machine::Feed;
using reports::MoveKind;
using testing_support::perfectWorld;
using testing_support::positions;

/// A block of 60 x 40 x 20 mm, its top at Z 20, turned by 90 degrees and shifted on the table.
simulation::Truth worldWithBlock(const Pose& tableFromBlock) {
  simulation::SolidFeature box;
  box.size = {60, 40, 20};
  simulation::SolidRecipe recipe;
  recipe.features = {box};
  auto truth = perfectWorld();
  auto solid = simulation::buildSolid(recipe);
  EXPECT_TRUE(solid) << format(solid.error());
  if (solid) truth.solids.push_back({std::move(*solid), tableFromBlock, "block", simulation::SolidRole::Part});
  return truth;
}

class SceneOfRun : public testing::Test {
protected:
  SceneOfRun() {
    EXPECT_EQ(machine_.insertTool({1, "PROBE"}).end, machine::ToolChangeEnd::Changed);
    goTo(0, 0, 150);
  }

  /// The readings at which the ball's centre stands at a point of the table, Z counted from the vice's floor. The tool
  /// is 100 mm long to the ball's lowest point.
  machine::AxisPositions axesFor(double x, double y, double z) const {
    return positions({x, y, floor_ + z + 100 - ballRadius_});
  }
  static reports::Vector3f onTable(float x, float y, float z) { return {x, y, static_cast<float>(floor_) + z}; }
  void goTo(double x, double y, double z) {
    EXPECT_EQ(machine_.move(axesFor(x, y, z), Feed::rapidTraverse()).end, machine::MoveEnd::Reached);
  }
  void backTo(double x, double y, double z) {
    EXPECT_EQ(machine_.retract(axesFor(x, y, z), Feed::at(2000)).end, machine::MoveEnd::Reached);
  }
  control::TouchRecord probe(double x, double y, double z) {
    const auto result = machine_.measure({axesFor(x, y, z), Feed::at(300)});
    control::TouchRecord record;
    record.outcome = result.end == machine::MeasureEnd::Touched ? "touched" : "no contact";
    record.latched = result.latched;
    record.seconds = machine_.seconds();
    return record;
  }

  static constexpr double floor_ = -400, ballRadius_ = 2;
  const Pose tableFromBlock_ = translation({100, 50, floor_ + 30}) * rotation(Vector3::UnitZ(), 90);
  simulation::Truth truth_ = worldWithBlock(tableFromBlock_);
  simulation::VirtualMachine machine_{truth_};
};

TEST_F(SceneOfRun, ShowsTouchesWhereTheyWere) {
  control::Journal journal;
  journal.cycles.resize(2);
  goTo(100, 50, 60);
  journal.cycles[0].touches.push_back(probe(100, 50, 45));  // down onto the top
  backTo(100, 50, 60);
  goTo(60, 50, 60);
  goTo(60, 50, 40);
  journal.cycles[1].touches.push_back(probe(90, 50, 40));  // along X onto the side
  backTo(60, 50, 40);
  journal.cycles[1].touches.push_back(probe(70, 50, 40));  // ends before the part

  const reports::Scene scene = sceneOf(journal, truth_, machine_.path());
  ASSERT_EQ(scene.touches.size(), 3U);
  // The block reaches from Z 30 to Z 50, turned: from X 80 to X 120.
  EXPECT_LT((scene.touches[0].surface - onTable(100, 50, 50)).norm(), 1e-4);
  EXPECT_LT((scene.touches[0].ballCentre - onTable(100, 50, 52)).norm(), 1e-4);
  EXPECT_EQ(scene.touches[1].cycle, 1U);
  EXPECT_LT((scene.touches[1].surface - onTable(80, 50, 40)).norm(), 1e-4);
  EXPECT_EQ(scene.touches[2].touch, 1U);
  EXPECT_LT((scene.touches[2].ballCentre - onTable(70, 50, 40)).norm(), 1e-4);
}

TEST_F(SceneOfRun, MarksWhereThePathRanIntoSomething) {
  goTo(100, 50, 60);
  probe(100, 50, 45);
  EXPECT_TRUE(sceneOf({}, truth_, machine_.path()).collisions.empty()) << "measuring is no collision";
  backTo(100, 50, 60);
  goTo(60, 50, 60);
  goTo(60, 50, 40);
  EXPECT_EQ(machine_.move(axesFor(100, 50, 40), Feed::rapidTraverse()).end, machine::MoveEnd::ProbeSignal);

  const reports::Scene scene = sceneOf({}, truth_, machine_.path());
  ASSERT_EQ(scene.collisions.size(), 1U);
  EXPECT_LT((scene.collisions[0].at - onTable(80, 50, 40)).norm(), 1e-2);
  EXPECT_EQ(scene.collisions[0].what, "ball");
  EXPECT_EQ(scene.collisions[0].solid, "block");
}

TEST_F(SceneOfRun, LeavesOutTouchesThatThePathDoesNotKnow) {
  control::Journal journal;
  journal.cycles.resize(1);
  journal.cycles[0].touches.emplace_back().outcome = "touched";
  EXPECT_TRUE(sceneOf(journal, truth_, machine_.path()).touches.empty());
}

/// A mill and a probe, one after the other, and a tool touch probe beside them.
TEST(SceneOfTools, HoldsTheCutterThatTouchedAndWhereItWasInTheSpindle) {
  simulation::Truth truth = perfectWorld();
  simulation::TrueTool mill;
  mill.number = 12;
  mill.name = "MILL";
  mill.kind = simulation::ToolKind::Cutter;
  mill.length = 80;
  mill.radius = 5;
  mill.cutter.cutLength = 20;
  mill.cutter.shankRadius = 3;
  mill.cutter.teeth = {{.angle = 0, .radial = 0.01}, {.angle = 180}};
  truth.tools.push_back(mill);
  testing_support::placeToolProbe(truth, simulation::RoundBar(20, -10, 0), translation({0, 0, -400}));
  simulation::VirtualMachine machine(truth);
  ASSERT_EQ(machine.changeTool({12, ""}).end, machine::ToolChangeEnd::Changed);
  machine.orientSpindle(0);
  machine.move(positions({-60, 0, -325}), Feed::rapidTraverse());
  const auto measured = machine.measure({positions({-10, 0, -325}), Feed::at(300), machine::Sensor::ToolTouchProbe});
  ASSERT_EQ(measured.end, machine::MeasureEnd::Touched) << measured.detail;
  machine.retract(positions({-60, 0, -325}), Feed::rapidTraverse());
  machine.move(positions({-60, 0, -200}), Feed::rapidTraverse());
  ASSERT_EQ(machine.changeTool({1, ""}).end, machine::ToolChangeEnd::Changed);
  machine.move(positions({0, 0, -200}), Feed::rapidTraverse());

  control::Journal journal;
  journal.cycles.resize(1);
  auto& touch = journal.cycles[0].touches.emplace_back();
  touch.outcome = "touched";
  touch.latched = measured.latched;
  const reports::Scene scene = sceneOf(journal, truth, machine.path());
  ASSERT_EQ(scene.tools.size(), 1U);
  EXPECT_EQ(scene.tools[0].name, "MILL");
  float lowest = 0, widest = 0, longest = 0;
  for (const auto& p : scene.tools[0].positions) {
    lowest = std::min(lowest, p.z());
    longest = std::max(longest, p.z());
    widest = std::max(widest, std::hypot(p.x(), p.y()));
  }
  EXPECT_NEAR(lowest, 0, 1e-6) << "its end lies in the origin";
  EXPECT_NEAR(longest, 80, 1e-4);
  EXPECT_NEAR(widest, 5, 1e-4);
  ASSERT_EQ(scene.touches.size(), 1U);
  EXPECT_EQ(scene.touches[0].tool, 0);
  // The tooth at +X, 5.01 mm from the axis, meets the disc 20 mm beside its middle.
  EXPECT_LT((scene.touches[0].ballCentre - reports::Vector3f(-25.01F, 0, -405)).norm(), 1e-3);
  EXPECT_NEAR(scene.touches[0].surface.x(), -20, 1e-3);
  ASSERT_EQ(scene.path.tools.size(), 2U);
  EXPECT_EQ(scene.path.tools[0].tool, 0);
  EXPECT_EQ(scene.path.tools[1].tool, -1) << "the probe is no cutter";
  EXPECT_LT(scene.path.tools[0].point, scene.path.tools[1].point);
}

TEST_F(SceneOfRun, KeepsTheKindOfEachMove) {
  goTo(100, 50, 60);
  probe(100, 50, 45);
  const reports::Scene scene = sceneOf({}, truth_, machine_.path());
  const auto& path = scene.path;
  ASSERT_EQ(path.kinds.size() + 1, path.points.size());
  ASSERT_EQ(path.seconds.size(), path.points.size());
  EXPECT_EQ(path.kinds.front(), MoveKind::Jump) << "the probe was put in by hand";
  EXPECT_EQ(path.kinds.back(), MoveKind::Measure);
  EXPECT_EQ(path.kinds[path.kinds.size() - 2], MoveKind::Rapid);
  EXPECT_LT((path.points[path.points.size() - 2] - onTable(100, 50, 60)).norm(), 1e-4);
}

TEST_F(SceneOfRun, TellsTheShankOnlyWhereItLeansOver) {
  EXPECT_TRUE(sceneOf({}, truth_, machine_.path()).path.toolAxes.empty()) << "upright all the time";

  auto truth = perfectWorld("mill5-head-table");
  simulation::VirtualMachine swivelling(truth);
  EXPECT_EQ(swivelling.insertTool({1, "PROBE"}).end, machine::ToolChangeEnd::Changed);
  EXPECT_EQ(swivelling.move(positions({0, 0, 0, 30, 0}), Feed::rapidTraverse()).end, machine::MoveEnd::Reached);
  const reports::Path path = sceneOf({}, truth, swivelling.path()).path;
  ASSERT_EQ(path.toolAxes.size(), path.points.size());
  EXPECT_LT((path.toolAxes.front() - reports::Vector3f::UnitZ()).norm(), 1e-6);
  EXPECT_LT((path.toolAxes.back() - reports::Vector3f(0.5F, 0, 0.8660254F)).norm(), 1e-6);
}

TEST_F(SceneOfRun, DrawsThePartWhereItLies) {
  const reports::Scene scene = sceneOf({}, truth_, machine_.path());
  ASSERT_EQ(scene.meshes.size(), 1U);
  const reports::Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.role, reports::MeshRole::Part);
  EXPECT_TRUE(mesh.sceneFromMesh.isApprox(tableFromBlock_));
  EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
  EXPECT_EQ(mesh.triangles.size(), 36U) << "twelve triangles of a box";
  EXPECT_EQ(mesh.featureEdges.size() % 2, 0U);
  double length = 0;
  for (std::size_t i = 0; i + 1 < mesh.featureEdges.size(); i += 2)
    length += (mesh.featureEdges[i] - mesh.featureEdges[i + 1]).norm();
  EXPECT_NEAR(length, 4 * (60 + 40 + 20), 1e-3);
}

}  // namespace
}  // namespace probewright::setup
