#pragma once

#include <optional>
#include <string>
#include <vector>

#include "control/sinumerik/control.hpp"
#include "cycles/catalogue.hpp"

/// CYCLE800: the working plane is swivelled, the rotary axes follow.
namespace probewright::execution::sinumerik {

/// The arguments of CYCLE800 by position.
struct SwivelCall {
  int retract = 0;                      ///< _FR: 0 none, 1 Z, 2 Z then X and Y, 4 and 5 in tool direction
  std::string dataSet;                  ///< _TC: "0" deselects
  int state = 0;                        ///< _ST: units 0 new, 1 additive
  int mode = 57;                        ///< _MODE: bits 7, 6 kind of angles; bit pairs 0-1, 2-3, 4-5 order of the axes
  Vector3 reference = Vector3::Zero();  ///< _X0, _Y0, _Z0: reference point before the rotation, mm
  Vector3 angles = Vector3::Zero();     ///< _A, _B, _C, degrees
  Vector3 shift = Vector3::Zero();      ///< _X1, _Y1, _Z1: zero point after the rotation, mm
  int direction = -1;                   ///< _DIR: -1 smaller, 1 larger value of the rotary axis; 0 computes only
  double retraction = 0;                ///< _FR_I, mm
};

/// Swivels. Throws control::Alarm 62201 and others if the machine cannot take the orientation.
void swivel(control::sinumerik::Control& control, const SwivelCall& call);
/// CYCLE800() and _TC="0": the frames of swivelling go, the rotary axes stay.
void deselectSwivel(control::sinumerik::Control& control);

/// The rotation that _MODE and _A, _B, _C describe; nothing if the mode positions the rotary axes directly.
std::optional<Matrix3> swivelRotation(int mode, const Vector3& angles);

/// Machine angles of the rotary axes (indexed by axis, others as in `now`) that turn the tool axis into `direction`,
/// a unit vector in the table's frame as it lies at `reference`: all of machine::solveRotaryAxes, as exact as they are,
/// the one with the least turning first. An axis that does not matter stays where it is.
std::vector<control::AxisPositions> toolPostures(const machine::MachineDescription& machine,
                                                 const control::AxisPositions& reference,
                                                 const control::AxisPositions& now, const Vector3& direction);

}  // namespace probewright::execution::sinumerik
