#include "survival/shift.hpp"

#include <gtest/gtest.h>

/// Tools that hold all places where a tool may be.
namespace probewright::survival::testing {
namespace {

/// Each point of a tool that is shifted along and across its shank, its parts displaced of their own, lies within.
TEST(Shift, GrownToolsHoldWhereTheirPartsMayBe) {
  simulation::ToolShape shape;
  shape.shank = Vector3::UnitZ();
  shape.balls.push_back({Vector3::Zero(), 3});
  shape.shafts.push_back({Vector3(0, 0, 1), Vector3(0, 0, 40), 2, "stylus", simulation::Ends::Flat});
  shape.shafts.push_back({Vector3(0, 0, 5), Vector3(20, 0, 0), 1.5, "stylus", simulation::Ends::Flat});
  const Displacements::OfTool own{{0.2}, {0.3, 0.4}};
  for (const Shift& by : {Shift{0.05, 0.07}, Shift{0.5, 0.1}}) {
    const simulation::ToolShape thick = grown(shape, by, own);
    EXPECT_GE(thick.balls[0].radius, 3 + std::hypot(by.along + 0.2, by.across));
    EXPECT_LT(thick.balls[0].radius, 3.05 + std::hypot(by.along + 0.2, by.across));
    // Upright: longer at both ends by what is along it, thicker by what is across.
    const simulation::Shaft& upright = thick.shafts[0];
    EXPECT_LE(upright.start.z(), 1 - by.along - 0.3);
    EXPECT_GE((upright.start + upright.axis).z(), 41 + by.along + 0.3);
    EXPECT_LT(upright.axis.norm(), 40.1 + 2 * (by.along + 0.3));
    EXPECT_GE(upright.radius, 2 + by.across);
    EXPECT_LT(upright.radius, 2.05 + by.across);
    // Lying: in any direction.
    const simulation::Shaft& lying = thick.shafts[1];
    const double any = std::hypot(by.along + 0.4, by.across);
    EXPECT_LE(lying.start.x(), -any);
    EXPECT_GE((lying.start + lying.axis).x(), 20 + any);
    EXPECT_GE(lying.radius, 1.5 + any);
    EXPECT_LT(lying.radius, 1.55 + any);
  }
}

}  // namespace
}  // namespace probewright::survival::testing
