#include "setup/camera_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "setup/axis_names.hpp"
#include "setup/shape_keys.hpp"

namespace probewright::setup {

using camera::CameraFault;
using camera::Finish;
using camera::Lamp;
using camera::TrueCamera;

namespace {

constexpr long long mostPixelsAcross = 2048;
constexpr NumberRange partOfWhite{0, 1};

machine::AxisPositions readOverview(TomlReader& reader, const simulation::World& world) {
  const machine::MachineDescription& machine = world.truth.machine;
  machine::AxisPositions position = machine.toolChange;
  for (const std::string& key : reader.keys()) {
    const auto axis = axisNamed(reader, key, key, machine);
    NumberRange range;
    if (axis && !machine.axes[*axis].modulo) range = {machine.axes[*axis].minimum, machine.axes[*axis].maximum};
    const auto value = reader.number(key, range);
    if (axis && value) position[*axis] = *value;
  }
  return position;
}

Lamp readLamp(TomlReader& reader) {
  Lamp lamp;
  reader.require("position");
  lamp.position = readVector(reader, "position").value_or(Vector3::Zero());
  if (reader.choice("on", {"bed", "spindle"}).value_or(0) == 1) lamp.on = camera::Mounted::Spindle;
  lamp.brightness = reader.number("brightness", {0, 10}).value_or(lamp.brightness);
  reader.finish();
  return lamp;
}

void readFinish(TomlReader& reader, const simulation::World& world, TrueCamera& camera) {
  Finish finish;
  finish.reflectance = reader.number("reflectance", partOfWhite).value_or(finish.reflectance);
  finish.gloss = reader.number("gloss", partOfWhite).value_or(finish.gloss);
  if (const auto solid = reader.requiredText("solid")) {
    const bool known = std::ranges::find(world.solids, *solid, &simulation::WorldSolid::name) != world.solids.end() ||
                       (world.table && world.table->name == *solid);
    if (!known) {
      std::string names = world.table ? "\"" + world.table->name + "\"" : "";
      for (const auto& each : world.solids)
        names += (names.empty() ? "\"" : ", \"") + each.name + "\"";
      reader.report("solid", fmt::format("there is nothing called \"{}\"", *solid), "The setup has " + names);
    } else if (!camera.finishes.emplace(*solid, finish).second) {
      reader.report("solid", fmt::format("the surface of \"{}\" is described twice", *solid));
    }
  }
  reader.finish();
}

void readView(TomlReader& reader, TrueCamera& camera) {
  camera.position = readVector(reader, "position").value_or(camera.position);
  const Vector3 direction = readVector(reader, "direction").value_or(camera.direction);
  const Vector3 up = readVector(reader, "up").value_or(camera.up);
  if (!(direction.norm() > 1e-9)) {
    reader.report("direction", "a direction cannot be [0, 0, 0]");
  } else if (direction.normalized().cross(up).norm() < 1e-6) {
    reader.report(reader.has("up") ? "up" : "direction", "\"up\" lies along the direction in which the camera looks",
                  "Name a direction that is up in its pictures, such as up = [0, 1, 0]");
  } else {
    camera.direction = direction.normalized();
    camera.up = up;
  }
}

void readLens(TomlReader& reader, TrueCamera& camera) {
  if (const auto pixels = reader.numbers("resolution", 2, {16, static_cast<double>(mostPixelsAcross)})) {
    camera.width = static_cast<int>((*pixels)[0]);
    camera.height = static_cast<int>((*pixels)[1]);
    if (camera.width != (*pixels)[0] || camera.height != (*pixels)[1])
      reader.report("resolution", "\"resolution\" must be two whole numbers");
  }
  camera.fieldOfView = reader.number("field_of_view", {1, 120}).value_or(camera.fieldOfView);
  if (const auto distortion = reader.numbers("distortion", 4, NumberRange::within(0.3)))
    std::ranges::copy(*distortion, camera.distortion.begin());
  camera.noise = reader.number("noise", {0, 50}).value_or(camera.noise);
  static const std::vector<std::string> faults = {"none", "no signal", "cover stuck"};
  constexpr std::array meant = {CameraFault::None, CameraFault::NoSignal, CameraFault::CoverStuck};
  camera.fault = meant[reader.choice("fault", faults).value_or(0)];
}

}  // namespace

std::optional<TrueCamera> readCamera(TomlReader& root, const simulation::World& world) {
  auto reader = root.table("camera");
  if (!reader) return std::nullopt;
  TrueCamera camera;
  readView(*reader, camera);
  readLens(*reader, camera);
  if (auto overview = reader->table("overview")) camera.overview = readOverview(*overview, world);
  camera.ambient = reader->number("ambient", partOfWhite).value_or(camera.ambient);
  camera.flicker = reader->number("flicker", partOfWhite).value_or(camera.flicker);
  for (TomlReader& lamp : reader->tables("lamp"))
    camera.lamps.push_back(readLamp(lamp));
  for (TomlReader& surface : reader->tables("surface"))
    readFinish(surface, world, camera);
  reader->finish();
  return camera;
}

}  // namespace probewright::setup
