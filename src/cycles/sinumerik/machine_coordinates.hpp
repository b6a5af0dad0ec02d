#pragma once

#include "control/sinumerik/control.hpp"

namespace probewright::cycles::sinumerik {

/// Machine coordinates while it lives: no frame acts, and where asked for no transformation (TRAORI, CYCLE800) either.
class MachineCoordinates {
public:
  enum class Transformation { Kept, Off };
  explicit MachineCoordinates(control::sinumerik::Control& control,
                              Transformation transformation = Transformation::Kept)
      : control_(control),
        suppressed_(control.frames.suppressed),
        swivelled_(control.swivelled),
        transformation_(control.transformation) {
    control_.frames.suppressed = true;
    if (transformation == Transformation::Off) control_.swivelled = control_.transformation = false;
    control_.handOverFrames();
  }
  ~MachineCoordinates() {
    control_.frames.suppressed = suppressed_;
    control_.swivelled = swivelled_;
    control_.transformation = transformation_;
    control_.handOverFrames();
  }
  MachineCoordinates(const MachineCoordinates&) = delete;
  MachineCoordinates& operator=(const MachineCoordinates&) = delete;

private:
  control::sinumerik::Control& control_;
  bool suppressed_, swivelled_, transformation_;
};

}  // namespace probewright::cycles::sinumerik
