#include "camera/scenes.hpp"
#include "setup/camera_shots.hpp"
#include "vision/png.hpp"

/// What the report shows of the camera.
namespace probewright::testing_support {
namespace {

TEST(CameraShots, ShowReferenceImageAndErrorsOfEachCycle) {
  CameraBench bench;
  RunFolder folder;
  bench.answers({{"601 OS", teach(10, bench.camera())}});
  const Ran taught = bench.run(local(1, 10) + local(0, 10, 0, "OTHER"));
  const auto before = setup::cameraShots(taught.outcome);
  ASSERT_EQ(before.size(), 2U);
  EXPECT_EQ(before[0].point, "BENCH.OS");
  EXPECT_EQ(before[0].number, 10) << "the last of those that REPEAT took";
  EXPECT_EQ(before[0].references, 10);
  EXPECT_EQ(before[0].errors, 0);
  EXPECT_EQ(before[1].point, "BENCH.OTHER");
  EXPECT_EQ(before[1].taken, taught.log("BENCH.OTHER.0001.PNG"));
  EXPECT_EQ(before[1].reference + before[1].evaluated, "") << "nothing to compare with";

  folder.keep(taught);
  bench.setup.beliefs.tables = folder.path();
  const Vector3 place(-20, 20, plateTop);
  bench.put("forgotten clamp", SolidRole::Fixture, {box({40, 16, 12})}, place, 30);
  const Ran ran = bench.run(local(0, 10));
  const auto shots = setup::cameraShots(ran.outcome);
  ASSERT_EQ(shots.size(), 1U) << "images of earlier runs belong to no cycle of this one";
  EXPECT_EQ(shots[0].cycle, 0U);
  EXPECT_EQ(shots[0].number, 11);
  EXPECT_EQ(shots[0].taken, ran.log("BENCH.OS.0011.PNG"));
  EXPECT_GT(shots[0].errors, 0);
  const auto reference = vision::fromPng(shots[0].reference, "reference");
  const auto evaluated = vision::fromPng(shots[0].evaluated, "evaluated");
  const auto current = vision::fromPng(shots[0].taken, "taken");
  ASSERT_TRUE(reference && evaluated && current);
  EXPECT_EQ(reference->width, bench.camera().width);
  // The clamp is in the image and not in the reference; frames are drawn on the image only.
  const Vector2 middle = bench.pixel(place + Vector3(0, 0, 12));
  const auto pixel = [&](const machine::Picture& picture) {
    return static_cast<int>(picture.at(static_cast<int>(middle.x()), static_cast<int>(middle.y())));
  };
  EXPECT_GT(std::abs(pixel(*current) - pixel(*reference)), 20);
  EXPECT_EQ(pixel(*current), pixel(*evaluated));
  EXPECT_NE(*current, *evaluated);
}

TEST(CameraShots, AreThoseOfTheLastCycles) {
  CameraBench bench;
  std::string many;
  for (int i = 0; i < 25; ++i)
    many += local(0, 1);
  const auto shots = setup::cameraShots(bench.run(many).outcome);
  // Of images that are not marked the control keeps the newest 20.
  ASSERT_EQ(shots.size(), 20U);
  EXPECT_EQ(shots.front().cycle, 5U);
  EXPECT_EQ(shots.back().number, 25);
}

}  // namespace
}  // namespace probewright::testing_support
