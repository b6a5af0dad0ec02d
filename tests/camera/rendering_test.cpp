#include "camera/rendering.hpp"

#include "camera/scenes.hpp"
#include "camera/virtual_camera.hpp"
#include "machine/links.hpp"
#include "simulation/world.hpp"

/// What the virtual camera sees, against the closed form of the projection.
namespace probewright::testing_support {
namespace {

std::unique_ptr<simulation::VirtualMachine> built(const CameraBench& bench) {
  auto machine = simulation::buildMachine(bench.setup.world);
  EXPECT_TRUE(machine) << format(machine.error());
  (*machine)->fit(std::make_unique<camera::VirtualCamera>(**machine, *bench.setup.camera));
  return std::move(*machine);
}

machine::Picture pictureOf(machine::Machine& machine) {
  machine::Camera& camera = *machine::cameraOf(machine);
  EXPECT_EQ(camera.openCover().end, machine::CameraEnd::Done);
  return camera.takePicture().picture;
}

TEST(Lens, TakesItsDistortionOutAgain) {
  Dice dice(7);
  for (int i = 0; i < 200; ++i) {
    camera::TrueCamera camera;
    camera.fieldOfView = dice.between(10, 70);
    camera.distortion = {dice.between(-0.2, 0.2), dice.between(-0.05, 0.05), dice.between(-0.01, 0.01),
                         dice.between(-0.01, 0.01)};
    const Vector2 pixel(dice.between(0, camera.width), dice.between(0, camera.height));
    EXPECT_LT((camera::pixelOf(camera, camera::rayThrough(camera, pixel.x(), pixel.y())) - pixel).norm(), 1e-6);
  }
}

TEST(Lens, WithoutDistortionIsAPinhole) {
  camera::TrueCamera camera;
  camera.width = 400;
  camera.height = 300;
  camera.fieldOfView = 90;
  EXPECT_TRUE(camera::rayThrough(camera, 400, 150).isApprox(Vector3(1, 0, 1), 1e-12)) << "the edge of 90 degrees";
  EXPECT_TRUE(camera::pixelOf(camera, Vector3(-50, 30, 100)).isApprox(Vector2(100, 210), 1e-12));
}

TEST(VirtualCamera, SeesABallWhereItsProjectionIs) {
  Dice dice(11);
  for (int world = 0; world < 20; ++world) {
    CameraBench bench;
    bench.setup.world.solids.clear();
    bench.setup.world.table.reset();
    camera::TrueCamera& camera = bench.camera();
    camera.position = dice.within(100);
    camera.direction = (Vector3(0, 0, -1) + 0.2 * dice.within(1)).normalized();
    camera.up = Vector3(0, 1, 0) + 0.3 * dice.within(1);
    camera.ambient = 1;
    camera.lamps.clear();
    camera.noise = camera.flicker = 0;
    // Somewhere ahead, and small against its distance.
    const Vector3 ahead = 400 * camera.direction + 60 * dice.within(1);
    const Vector3 centre = camera.position + ahead + Vector3(0, 0, -300);
    simulation::SolidFeature ball;
    ball.shape = simulation::FeatureShape::Sphere;
    ball.diameter = 24;
    bench.put("ball", SolidRole::Sphere, {ball}, centre);
    camera.finishes["ball"] = {1, 0};
    const machine::Picture picture = pictureOf(*built(bench));
    Vector2 sum = Vector2::Zero();
    double weight = 0;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        const double light = picture.at(x, y) - 8.0;  // without the background
        if (light <= 0) continue;
        sum += light * Vector2(x + 0.5, y + 0.5);
        weight += light;
      }
    }
    ASSERT_GT(weight, 0);
    EXPECT_LT((sum / weight - bench.pixel(centre)).norm(), 0.15) << world;
    const double pixels = weight / (255 - 8);
    const double focal = camera.width / 2.0 / std::tan(radians(camera.fieldOfView / 2));
    EXPECT_NEAR(std::sqrt(pixels / std::numbers::pi), 12 / ahead.dot(camera.direction) * focal, 0.5) << world;
  }
}

/// The shadow of a tall block ends where the ray of the lamp over its edge meets the table.
/// Bodies of the machine are where the axes have them; the head that carries the camera is not seen.
TEST(VirtualCamera, SeesBodiesOfTheMachineWhereTheyStand) {
  CameraBench bench;
  camera::TrueCamera& camera = bench.camera();
  camera.ambient = 1;
  camera.lamps.clear();
  camera.noise = camera.flicker = 0;
  camera.finishes["guard"] = {1, 0};
  camera.finishes["plate"] = camera.finishes["table"] = {0.3, 0};
  const machine::MachineDescription& machine = bench.setup.world.truth.machine;
  const Vector3 place(-30, -10, tableSurface);  // base frame with all axes at 0, which is the table's there
  simulation::WorldBody guard;
  guard.name = "guard";
  guard.source.recipe.features = {box({60, 40, 60})};
  guard.linkFromSolid = translation(place);
  // The brightness of the picture where the place on the table is, with Y there.
  const auto brightness = [&](const std::string& link, const Vector3& at, double y) {
    bench.setup.world.bodies.clear();
    if (!link.empty()) {
      guard.link = *machine::linkNamed(machine, link);
      bench.setup.world.bodies.push_back(guard);
    }
    bench.setup.world.truth.start[*machine.axisIndex("Y")] = y;
    const Vector2 pixel = bench.pixel(at + Vector3(0, 0, 60));
    const auto moving = built(bench);
    return static_cast<int>(pictureOf(*moving).at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y())));
  };
  const int table = brightness("", place, 0);
  EXPECT_GT(brightness("table", place, 0), table + 50);
  EXPECT_GT(brightness("bed", place, 0), table + 50);
  // The table carries it away with it; what stands on the bed stays behind.
  const Vector3 behind = place + Vector3(0, 50, 0);  // of the table, when Y has taken it 50 mm towards -Y
  EXPECT_GT(brightness("table", place, 50), table + 50);
  EXPECT_LT(brightness("bed", place, 50), table + 50);
  EXPECT_GT(brightness("bed", behind, 50), table + 50);
  EXPECT_NEAR(brightness("head", place, 0), table, 3);
}

TEST(VirtualCamera, ThrowsShadowsAwayFromTheLamp) {
  CameraBench bench;
  bench.setup.world.solids.clear();
  camera::TrueCamera& camera = bench.camera();
  camera.noise = camera.flicker = 0;
  camera.ambient = 0.1;
  bench.put("block", SolidRole::Fixture, {box({20, 60, 40})}, {0, 0, tableSurface});
  camera.lamps = {{{-400, 0, -250}, Mounted::Bed, 0.8}};
  const machine::Picture picture = pictureOf(*built(bench));
  // The lamp is 400 above the table, the upper edge 40: the shadow reaches (400 + 10) * 40 / (400 - 40) beyond it.
  const double end = 10 + 410 * 40 / 360.0;
  const auto grey = [&](double x) {
    const Vector2 at = bench.pixel({x, 0, tableSurface});
    return static_cast<int>(picture.at(static_cast<int>(at.x()), static_cast<int>(at.y())));
  };
  EXPECT_LT(grey(end - 8), 20);
  EXPECT_GT(grey(end + 8), 50);
  EXPECT_GT(grey(-25), 50) << "the side of the lamp";
}

TEST(VirtualCamera, SeesWhatTheErrorsOfTheAxesMakeOfItsPlace) {
  CameraBench bench;
  bench.camera().noise = bench.camera().flicker = 0;
  const machine::Picture before = pictureOf(*built(bench));
  EXPECT_EQ(pictureOf(*built(bench)), before) << "the same world, the same picture";
  bench.setup.world.truth.errors.axes.resize(3);
  bench.setup.world.truth.errors.axes[0].offset = 4;
  EXPECT_NE(pictureOf(*built(bench)), before);
}

TEST(VirtualCamera, IsNoisyByTheSeedOfTheWorld) {
  CameraBench bench;
  bench.camera().noise = 2;
  bench.camera().flicker = 0;
  const auto machine = built(bench);
  const machine::Picture first = pictureOf(*machine), second = pictureOf(*machine);
  double squares = 0;
  for (std::size_t i = 0; i < first.grey.size(); ++i)
    squares += std::pow(static_cast<double>(first.grey[i]) - second.grey[i], 2);
  // The difference of two pictures, each rounded to whole grey levels.
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(first.grey.size())), std::sqrt(2 * (4 + 1.0 / 12)), 0.1);
  EXPECT_EQ(pictureOf(*built(bench)), first);
  bench.setup.world.truth.seed = 2;
  EXPECT_NE(pictureOf(*built(bench)), first);
}

TEST(VirtualCamera, IsDarkBehindItsCover) {
  CameraBench bench;
  bench.camera().noise = 0;
  const auto machine = built(bench);
  machine::Camera& camera = *machine->camera();
  EXPECT_FALSE(camera.coverOpen());
  EXPECT_EQ(std::ranges::max(camera.takePicture().picture.grey), 0);
  camera.openCover();
  EXPECT_GT(std::ranges::max(camera.takePicture().picture.grey), 100);
  camera.closeCover();
  EXPECT_FALSE(camera.coverOpen());
}

}  // namespace
}  // namespace probewright::testing_support
