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

/// Each image that a cycle takes is entered in the file of its point.
TEST(CameraShots, AreEnteredInTheFileOfTheirPoint) {
  CameraBench bench;
  bench.answers({{"600 OS", teach(3, bench.camera())}});
  const Ran ran = bench.run(global(1, 3) + local(0, 3));
  ASSERT_TRUE(ran.finished()) << ran.why();
  const auto entered = [&](std::size_t cycle) {
    std::vector<std::string> names;
    for (const auto& write : ran.outcome.journal.cycles[cycle].writes) {
      EXPECT_EQ(write.table, "BENCH.OS.VSC");
      EXPECT_TRUE(ran.outcome.files.contains(write.after)) << write.after;
      names.push_back(write.entry + " " + write.after);
    }
    return names;
  };
  EXPECT_EQ(entered(0), (std::vector<std::string>{"image 1 BENCH.OS.0001.PNG", "image 2 BENCH.OS.0002.PNG",
                                                  "image 3 BENCH.OS.0003.PNG"}));
  EXPECT_EQ(entered(1), std::vector<std::string>{"image 4 BENCH.OS.0004.PNG"});
  coverage::writesRead(ran.outcome.control, ran.outcome.journal, [&](const control::WriteRecord& write) {
    return ran.log("BENCH.OS.VSC").find("[[image]]") != std::string::npos && write.table == "BENCH.OS.VSC";
  });
  EXPECT_FALSE(ran.screens().empty());
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

TEST(CameraShots, AreTheNewestFortyOfSeveralPoints) {
  CameraBench bench;
  std::string many;
  for (int i = 0; i < 15; ++i)
    for (const char* point : {"A", "B", "C"})
      many += local(0, 1, 0, point);
  const auto shots = setup::cameraShots(bench.run(many).outcome);
  ASSERT_EQ(shots.size(), setup::mostCameraShots);
  EXPECT_EQ(shots.front().cycle, 45 - setup::mostCameraShots);
  EXPECT_EQ(shots.back().cycle, 44U);
}

}  // namespace
}  // namespace probewright::testing_support
