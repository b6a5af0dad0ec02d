#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/primitives.hpp"
#include "machine/rotary_correction.hpp"

/// The kinematic model of a control: where it believes the axes of rotation to be. Cycles that measure a machine's
/// kinematics correct it; what is true does not concern it.
namespace probewright::control {

/// An axis of rotation as the control has been told. Base frame, all axes at 0.
struct BelievedRotaryAxis {
  std::optional<Vector3> point;           ///< mm, on the axis; nothing: as the builder of the machine describes it
  std::optional<Vector3> direction;       ///< unit; nothing: as the builder describes it
  Vector3 position = Vector3::Zero();     ///< mm, added to the point
  Vector3 orientation = Vector3::Zero();  ///< degrees, a rotation vector that turns the direction
  double hirthGrid = 0;                   ///< degrees between the positions of a Hirth coupling; 0: it stands anywhere
};

/// By the name of the axis; those that are not named are as the builder describes them.
using BelievedKinematics = std::map<std::string, BelievedRotaryAxis>;

/// What separates the beliefs from `built`, which is what the machine says of itself: one correction for each rotary
/// axis in a chain, in the order of the axes.
std::vector<machine::RotaryCorrection> believedCorrections(const machine::MachineDescription& built,
                                                           const BelievedKinematics& kinematics);

/// The machine that a control computes with.
machine::MachineDescription believedMachine(const machine::MachineDescription& built,
                                            const BelievedKinematics& kinematics);

}  // namespace probewright::control
