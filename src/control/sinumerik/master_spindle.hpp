#pragma once

#include "control/sinumerik/control.hpp"

/// Which spindle M3, S, SPOS and measuring cycles mean: 1 is the main spindle, on lathes 2 drives the tools in the
/// turret.
namespace probewright::control::sinumerik {

inline constexpr int mainSpindle = 1, drivenTools = 2;

inline int masterSpindle(const Control& control) {
  return static_cast<int>(control.machineData("$P_MSNUM", mainSpindle));
}

/// SETMS.
inline void setMasterSpindle(Control& control, int number) {
  // A state, not a datum to be kept: files do not hold it.
  control.data.setDefault("$P_MSNUM", static_cast<double>(number));
}

}  // namespace probewright::control::sinumerik
