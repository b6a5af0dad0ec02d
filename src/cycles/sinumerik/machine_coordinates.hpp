#pragma once

#include "control/sinumerik/control.hpp"

namespace probewright::cycles::sinumerik {

/// Machine coordinates while it lives: no frame acts.
class MachineCoordinates {
public:
  explicit MachineCoordinates(control::sinumerik::Control& control)
      : control_(control), before_(control.frames.suppressed) {
    control_.frames.suppressed = true;
    control_.handOverFrames();
  }
  ~MachineCoordinates() {
    control_.frames.suppressed = before_;
    control_.handOverFrames();
  }
  MachineCoordinates(const MachineCoordinates&) = delete;
  MachineCoordinates& operator=(const MachineCoordinates&) = delete;

private:
  control::sinumerik::Control& control_;
  bool before_;
};

}  // namespace probewright::cycles::sinumerik
