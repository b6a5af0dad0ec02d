#pragma once

#include <functional>
#include <optional>
#include <string>

#include "control/channel.hpp"

/// The measuring move of SINUMERIK cycles, and what they say of one that fails.
namespace probewright::probing {

struct SinumerikStroke {
  ProgramPlace start;  ///< of the tip
  ProgramPlace end;
  double feed = 300;  ///< mm/min
  machine::Feed retract;
  machine::Sensor sensor = machine::Sensor::TouchProbe;
  control::TouchWith part = control::TouchWith::Ball;
  int attempts = 5;  ///< while nothing is touched, each from the start
};

struct StrokeTouch {
  control::Touch touch;
  std::optional<double> spindleAngle;  ///< degrees at the signal, where the machine says it
};

/// Moves from where the tip stands towards the end. Nothing where no attempt touched anything: the tip is back at the
/// start then. `note` hears how each attempt ended that touched nothing. Throws Alarm 61302, 61309.
std::optional<StrokeTouch> carryOut(control::Channel& channel, const SinumerikStroke& stroke,
                                    const std::function<void(std::string)>& note);

/// Alarm 61301: nothing was touched on the measuring path, there and as far again.
[[noreturn]] void refuseUntouched(const control::Channel& channel, double path);

}  // namespace probewright::probing
