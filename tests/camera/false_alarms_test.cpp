#include "camera/scenes.hpp"

/// Two hundred random scenes: how often an unchanged scene counts as an error, and a changed one does not.
namespace probewright::testing_support {
namespace {

struct RandomScene {
  CameraBench bench;
  Vector3 freePlace;

  explicit RandomScene(unsigned seed) {
    Dice dice(seed);
    bench.setup.world.truth.seed = seed;
    camera::TrueCamera& camera = bench.camera();
    camera.width = 64;
    camera.height = 48;
    camera.noise = dice.between(0.5, 3);
    camera.flicker = dice.between(0, 0.02);
    camera.ambient = dice.between(0.15, 0.4);
    camera.position += dice.within(20);
    camera.direction = (camera.direction + 0.05 * dice.within(1)).normalized();
    camera.lamps = {{{dice.between(-400, 400), dice.between(-300, 300), dice.between(-100, 200)},
                     dice.coin() ? Mounted::Bed : Mounted::Spindle,
                     dice.between(0.3, 0.7)}};
    bench.setup.world.solids.clear();
    const double length = dice.between(80, 130), width = dice.between(60, 100), height = dice.between(15, 40);
    const double turned = dice.between(-20, 20);
    bench.put("plate", SolidRole::Part, {box({length, width, height})}, {0, 0, tableSurface}, turned);
    for (int clamp = 0; clamp < dice.whole(1, 4); ++clamp) {
      bench.put(fmt::format("clamp {}", clamp), SolidRole::Fixture,
                {box({dice.between(10, 25), dice.between(10, 25), dice.between(20, 60)})},
                {dice.between(-100, 100), dice.coin() ? dice.between(65, 75) : dice.between(-75, -65), tableSurface},
                dice.between(0, 90));
    }
    camera.finishes["plate"] = {dice.between(0.4, 0.8), dice.between(0, 0.3)};
    freePlace = {dice.between(-25, 25), dice.between(-15, 15), tableSurface + height};
  }
};

/// Ten references, then ten images of the same scene, in one program: the last image of ten, and the count of errors.
const std::string tenMore = [] {
  std::string blocks = "Q20 = 0\n";
  for (int i = 0; i < 10; ++i)
    blocks += local(0, 10) + fmt::format("FN 9: IF +Q601 EQU +1 GOTO LBL {}\nQ20 = Q20 + 1\nLBL {}\n", i + 1, i + 1);
  return blocks;
}();

TEST(RandomScenes, GiveNoFalseAlarms) {
  int images = 0, alarms = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    RandomScene scene(seed);
    scene.bench.answers({{"601 OS", teach(10, scene.bench.camera())}});
    const Ran ran = scene.bench.run(local(1, 10) + tenMore);
    ASSERT_TRUE(ran.finished()) << ran.why();
    images += 10;
    alarms += static_cast<int>(ran.q(20));
  }
  EXPECT_EQ(images, 2000);
  EXPECT_EQ(alarms, 0);
}

TEST(RandomScenes, ShowWhatHasComeIn) {
  int found = 0;
  constexpr int scenes = 100;
  for (unsigned seed = 1; seed <= scenes; ++seed) {
    RandomScene scene(seed);
    RunFolder folder;
    scene.bench.answers({{"601 OS", teach(10, scene.bench.camera())}});
    folder.keep(scene.bench.run(local(1, 10)));
    scene.bench.setup.beliefs.tables = folder.path();
    scene.bench.setup.world.truth.seed = seed + 1000;
    scene.bench.put("spanner", SolidRole::Fixture, {box({60, 12, 8})}, scene.freePlace, 17.0 * seed);
    scene.bench.camera().finishes["spanner"] = {0.25, 0.2};
    found += scene.bench.run(local(0, 10)).q(601) == 2 ? 1 : 0;
  }
  EXPECT_EQ(found, scenes);
}

}  // namespace
}  // namespace probewright::testing_support
