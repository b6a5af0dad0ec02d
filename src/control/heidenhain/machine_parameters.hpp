#pragma once

#include "control/control_kind.hpp"

/// The machine parameters that touch probe functions read.
namespace probewright::control::heidenhain {

struct MachineParameters {
  // TNC 640, by name and number
  double maxTouchFeed = 3000;     ///< 122602, mm/min: upper limit of the probing feed rate
  bool checkTiltingAxes = false;  ///< 204601 chkTiltingAxes: rotary axes must match the tilt before probing
  // iTNC 530
  double mp6120 = 500;   ///< probing feed rate, mm/min
  double mp6130 = 50;    ///< longest stroke to the touch point, mm
  double mp6140 = 2;     ///< safety clearance to the touch point, mm
  double mp6150 = 3000;  ///< positioning feed rate, mm/min
  bool mp6151 = false;   ///< pre-position at machine rapid
  bool mp6165 = false;   ///< orient the probe to the probing direction
  int mp6170 = 1;        ///< measurements of one point, 1 to 3
  double mp6171 = 0.1;   ///< confidence range of these, mm

  /// Cycles 400 to 499 with cycle 7, 8, 10, 11 or 26 active: the manual forbids it as a danger of collision.
  bool refuseTransformations = true;
};

}  // namespace probewright::control::heidenhain
