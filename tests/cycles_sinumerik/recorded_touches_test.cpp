#include "cycles_sinumerik/milling_variants.hpp"

/// What the record of a touch says of the ball and of the surface is where they truly were.
namespace probewright {
namespace {

using namespace testing_support;

TEST(RecordedTouches, LieWhereTheBallTouched) {
  Planter plant(731);
  for (const bool toCentre : {false, true}) {
    for (const double tilt : {0.0, 3.0}) {
      for (const Variant& variant : variants()) {
        SCOPED_TRACE(
            fmt::format("{}, length to the {}, tilted by {}", variant.name, toCentre ? "centre" : "south pole", tilt));
        const Vector3 angles(plant.number(-tilt, tilt), plant.number(-tilt, tilt), plant.number(-40, 40));
        const Pose workpiece = translation(origin) * rotation(Vector3::UnitZ(), angles.z()) *
                               rotation(Vector3::UnitY(), angles.y()) * rotation(Vector3::UnitX(), angles.x());
        simulation::Truth truth = perfectWorld();
        truth.tools[0].probe.stylusRadius = 0.5;
        variant.part(truth, workpiece);
        SinumerikBench bench(truth);
        if (toCentre) {
          bench.set("$MNS_MEA_FUNCTION_MASK", {}, 9);
          bench.set("$TC_DP3", {1, 1}, 98);
          bench.set("$SNS_MEA_WP_TRIG_MINUS_DIR_AX3", {0}, -2);
        }
        plantFrame(bench, "$P_UIFR", 1, origin, angles);
        bench.start(variant.start);
        bench.run(variant.cycle, with(variant.call, {{"S_KNUM", 1}}));

        std::vector<simulation::PathTouch> felt;
        for (const simulation::PathTouch& touch : bench.machine.path().touches) {
          if (touch.kind == simulation::PathKind::Measure) felt.push_back(touch);
        }
        std::size_t index = 0;
        for (const control::TouchRecord& record : bench.control.journal.cycles.back().touches) {
          if (record.outcome != "touched") continue;
          ASSERT_LT(index, felt.size());
          const Vector3 ball = workpiece.inverse() * felt[index].ballCentre;
          const Vector3 surface = workpiece.inverse() * felt[index].point;
          ++index;
          EXPECT_NEAR((record.ballCentre - ball).norm(), 0, 1e-6);
          // The control takes the surface for one across the direction of the touch.
          EXPECT_NEAR((record.surface - surface).norm(), 0, tilt == 0 && variant.axes.size() < 3 ? 0.01 : 0.5);
          const Vector3 away = record.surface - record.target;
          EXPECT_NEAR((away - record.direction * away.dot(record.direction)).norm(), 0, 1e-6)
              << "expected on the line along which the ball came";
        }
        EXPECT_EQ(index, felt.size());
        EXPECT_GT(index, 0U);
      }
    }
  }
}

}  // namespace
}  // namespace probewright
