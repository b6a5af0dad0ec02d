#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "machine/description.hpp"
#include "machine/links.hpp"
#include "reports/scene.hpp"

namespace probewright::reports {

/// A machine as a page draws and moves it: its axes, its chains, and what they carry.
struct MachineScene {
  struct Body {
    machine::Link link;
    Mesh mesh;  ///< placed in the link's frame, which is the base frame where all axes read 0
  };
  machine::MachineDescription machine;
  std::vector<Body> bodies;
  Vector3 up = Vector3::UnitZ();  ///< in the pictures: one of the axes of the base frame
};

/// A machine whose axes have moved on a scene's path.
struct MachineReplay {
  MachineScene scene;
  std::vector<Mesh> probes;             ///< touch probes, spindle frame
  std::vector<Path::ToolFrom> changes;  ///< which of them is in the spindle from a point of the path on
};

/// As the scripts of the pages read it; web/src/links.ts says what they make of it.
nlohmann::json machineData(const MachineScene& scene);
nlohmann::json machineData(const MachineReplay& replay);

/// A page that draws the machine and moves each of its axes. One HTML file that holds everything it needs and asks no
/// network for anything. `file`: what it was read from. `remarks`: what is doubtful about it.
std::string machinePage(const MachineScene& scene, const std::string& file, const std::vector<std::string>& remarks);

/// True if `html` is a page that machinePage() has made.
bool isMachinePage(std::string_view html);

}  // namespace probewright::reports
