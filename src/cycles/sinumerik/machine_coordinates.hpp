#pragma once

#include "control/scoped.hpp"
#include "control/sinumerik/control.hpp"

namespace probewright::cycles::sinumerik {

/// Hands the control's frames over to the channel again when it goes.
class FramesAgain {
public:
  explicit FramesAgain(control::sinumerik::Control& control) : control_(control) {}
  ~FramesAgain() { control_.handOverFrames(); }
  FramesAgain(const FramesAgain&) = delete;
  FramesAgain& operator=(const FramesAgain&) = delete;

private:
  control::sinumerik::Control& control_;
};

/// Machine coordinates while it lives: no frame acts, and where asked for no transformation (TRAORI, CYCLE800) either.
class MachineCoordinates {
public:
  enum class Transformation { Kept, Off };
  explicit MachineCoordinates(control::sinumerik::Control& control,
                              Transformation transformation = Transformation::Kept)
      : again_(control),
        suppressed_(control.frames.suppressed, true),
        swivelled_(control.swivelled, control.swivelled && transformation == Transformation::Kept),
        transformation_(control.transformation, control.transformation && transformation == Transformation::Kept) {
    control.handOverFrames();
  }

private:
  FramesAgain again_;  // goes last
  control::Scoped<bool> suppressed_, swivelled_, transformation_;
};

}  // namespace probewright::cycles::sinumerik
