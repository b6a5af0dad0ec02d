#pragma once

#include "control/working_plane.hpp"
#include "cycles_heidenhain/worlds.hpp"

/// Touch probe axis X and Y: a probe in an angle head. Main and minor axis are Y and Z, or Z and X.
namespace probewright::testing_support {

/// A world that is laid out in (main, minor, tool axis) of the touch probe axis.
struct Across {
  Bench bench;
  char axis;
  control::WorkingPlane plane;
  Vector3 origin;  ///< of the preset, machine coordinates
  Vector2 tip = Vector2::Zero();

  Across(ControlKind kind, char toolAxis, const std::string& machine = "mill3")
      : bench(kind, machine), axis(toolAxis), plane(control::WorkingPlane::ofToolAxis(toolAxis)) {
    simulation::TrueTool& tool = bench.setup.world.truth.tools.front();
    tool.shankDirection = Vector3::Zero();
    tool.shankDirection[plane.tool] = 1;
    tip = {0.08, -0.05};
    tool.probe.tipOffset = tip;
    bench.believedProbe().tipOffset = tip;
    bench.believedProbe().maximumTravel = 30;
    origin = {40, -30, -300};
    origin[plane.tool] -= 90;
    bench.preset(1, origin);
  }

  /// Machine coordinates from coordinates (main, minor, tool axis) of the preset.
  Pose machineFromPlane() const {
    Pose result = Pose::Identity();
    result.translation() = origin;
    for (int i = 0; i < 3; ++i)
      result.linear().col(i) = plane.xyzFromPlane(Vector3::Unit(i));
    return result;
  }
  template <class SolidType>
  void part(SolidType solid, const Pose& planeFromSolid) {
    bench.part(std::move(solid), machineFromPlane() * planeFromSolid);
  }
  Ran run(const std::string& blocks) const { return bench.runBare(fmt::format("TOOL CALL 1 {}\n", axis) + blocks); }
  /// A place, given in (main, minor, tool axis) of the old preset, in that of the new one.
  Vector3 seen(const Ran& ran, const Vector3& place) const {
    return plane.planeFromXyz(ran.seen(machineFromPlane() * place));
  }
};

inline Words presetInto1(Words words) {
  return with(std::move(words), {{305, 1}, {303, 1}, {381, 0}, {382, 0}, {383, 0}, {384, 0}, {333, 0}});
}

}  // namespace probewright::testing_support
