#pragma once

#include "cycles_heidenhain/worlds.hpp"

namespace probewright::testing_support {

/// A plane tilted by PLANE SPATIAL about the axes of a preset with a basic rotation.
struct TiltedPlace {
  Bench bench;
  Matrix3 tilt = Matrix3::Identity();
  Pose preset;
  Pose input;          ///< machine coordinates from those of the tilted plane
  std::string before;  ///< blocks that tilt the plane, with the rotary axes in place

  TiltedPlace(Dice& dice, ControlKind kind) : bench(kind, "mill5-head-table") {
    const Vector3 origin(written(dice.between(-60, 60)), written(dice.between(-60, 60)), -500);
    const double rotation = written(dice.between(-20, 20));
    bench.preset(1, origin, rotation);
    bench.believedProbe().maximumTravel = 40;
    const double a = written(dice.between(-25, 25)), b = written(dice.between(-25, 25));
    tilt = pose(Vector3::Zero(), {a, b, 0}).linear();
    preset = pose(origin, {0, 0, rotation});
    input = preset * pose(Vector3::Zero(), {a, b, 0});
    before = fmt::format("L Z+0 R0 FMAX M91\nPLANE SPATIAL SPA{:+.3f} SPB{:+.3f} SPC+0 TURN FMAX\n", a, b);
  }
  /// A place of the machine in the tilted plane of a preset.
  Vector3 inPlane(const Pose& machineFromPreset, const Vector3& place) const {
    return tilt.transpose() * (machineFromPreset.inverse() * place);
  }
};

}  // namespace probewright::testing_support
