#pragma once

#include <filesystem>
#include <fstream>

#include "camera/rendering.hpp"
#include "support/heidenhain_bench.hpp"

/// A table with a plate in two clamps, seen by a camera beside the spindle nose.
namespace probewright::testing_support {

using camera::Lamp;
using camera::Mounted;
using simulation::SolidRole;

inline simulation::SolidFeature box(const Vector3& size, const Vector3& centre = Vector3::Zero()) {
  simulation::SolidFeature feature;
  feature.shape = simulation::FeatureShape::Box;
  feature.size = size;
  feature.centre = centre;
  return feature;
}

inline simulation::SolidFeature hole(const Vector3& centre, double diameter) {
  simulation::SolidFeature feature;
  feature.shape = simulation::FeatureShape::Hole;
  feature.centre = centre;
  feature.diameter = diameter;
  return feature;
}

inline simulation::WorldSolid body(std::string name, SolidRole role, std::vector<simulation::SolidFeature> features,
                                   const Pose& tableFromSolid) {
  simulation::WorldSolid solid;
  solid.name = std::move(name);
  solid.role = role;
  solid.source.recipe.features = std::move(features);
  solid.tableFromSolid = tableFromSolid;
  return solid;
}

/// The surface of the table of mill3, and of the plate.
inline constexpr double tableSurface = -650, plateTop = -620;

/// TNC 640 on mill3. Tools are changed at X0 Y0 Z-300, where the axes start: the camera is 320 mm above the plate, a
/// pixel is 1.5 mm there.
struct CameraBench : Bench {
  CameraBench() {
    setup.world.truth.start[2] = setup.world.truth.machine.toolChange[2] = -300;
    setup.world.table = machine::TableBody{"table", {0, 0, tableSurface}, Vector3::UnitZ(), {1000, 600}, 0, 80};
    put("plate", SolidRole::Part, {box({120, 80, 30}), hole({40, 25, 30}, 16)}, {0, 0, tableSurface});
    put("left clamp", SolidRole::Fixture, {box({20, 40, 45})}, {-75, 0, tableSurface});
    put("right clamp", SolidRole::Fixture, {box({20, 40, 45})}, {75, 0, tableSurface});
    camera::TrueCamera camera;
    camera.position = {0, -60, 0};
    camera.direction = Vector3(0, 0.18, -1).normalized();
    camera.width = 160;
    camera.height = 120;
    camera.fieldOfView = 42;
    camera.distortion = {-0.08, 0.01, 0.001, -0.0005};
    camera.ambient = 0.3;
    camera.lamps = {{{-300, -200, 100}, Mounted::Bed, 0.6}, {{0, -80, 20}, Mounted::Spindle, 0.3}};
    camera.overview = machine::AxisPositions{};
    (*camera.overview)[2] = -300;
    setup.camera = camera;
  }

  void put(const std::string& name, SolidRole role, std::vector<simulation::SolidFeature> features,
           const Vector3& place, double turned = 0) {
    setup.world.solids.push_back(
        body(name, role, std::move(features), translation(place) * rotation(Vector3::UnitZ(), turned)));
  }
  simulation::WorldSolid& solid(const std::string& name) {
    return *std::ranges::find(setup.world.solids, name, &simulation::WorldSolid::name);
  }
  camera::TrueCamera& camera() { return *setup.camera; }

  /// Answers by question, for the run.
  void answers(std::map<std::string, std::string> given) {
    answer = [given = std::move(given)](const std::string& question) -> std::optional<std::string> {
      const auto found = given.find(question);
      return found == given.end() ? std::nullopt : std::optional(found->second);
    };
  }

  /// Where a place on the table appears in a picture with the axes at their start.
  Vector2 pixel(const Vector3& onTable) const {
    const auto& machine = setup.world.truth.machine;
    const auto& axes = setup.world.truth.start;
    const Pose tableFromSpindle =
        machine::baseFromTable(machine, axes).inverse() * machine::baseFromSpindle(machine, axes);
    return camera::pixelOf(*setup.camera,
                           (tableFromSpindle * camera::spindleFromCamera(*setup.camera)).inverse() * onTable);
  }
};

/// TCH PROBE 601 at the point OS.
inline std::string local(int stops, int references, int open = 0, const std::string& point = "OS") {
  return fmt::format(
      "TCH PROBE 601 LOCAL ~\n  QS600=\"{}\" ;POINT ~\n  Q309=+{} ;STOP ~\n  Q613=+{} ;OPEN ~\n  Q617=+{} ;IMAGES\n",
      point, stops, open, references);
}
/// TCH PROBE 600 at the point OS.
inline std::string global(int stops, int references, double feed = 5000) {
  return fmt::format(
      "TCH PROBE 600 GLOBAL ~\n  QS600=\"OS\" ;POINT ~\n  Q616={} ;FEED ~\n  Q309=+{} ;STOP ~\n  Q617=+{} ;IMAGES\n",
      feed, stops, references);
}

/// The soft keys of an operator who takes `count` reference images and draws one area of the whole image.
inline std::string teach(int count, const camera::TrueCamera& camera) {
  std::string keys = fmt::format("REFERENCE IMAGE YES; CONFIGURE; DRAW AREA 2 2 {} {}; SAVE AND BACK", camera.width - 4,
                                 camera.height - 4);
  for (int i = 1; i < count; ++i)
    keys += "; REPEAT; REFERENCE IMAGE";
  return keys + "; BACK";
}

/// A folder that is removed again, with what a run has left in it.
class RunFolder {
public:
  RunFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "probewright-camera-XXXXXX").string();
    EXPECT_NE(::mkdtemp(name.data()), nullptr);
    path_ = name;
  }
  ~RunFolder() { std::filesystem::remove_all(path_); }
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  void put(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
  }
  void keep(const Ran& ran) const {
    for (const auto& [name, bytes] : ran.outcome.files)
      put(name, bytes);
  }
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

}  // namespace probewright::testing_support
