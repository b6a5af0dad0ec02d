#include "execution/sinumerik/spindle_speed.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace probewright::execution::sinumerik {

namespace {

/// Of the spindle drive, where neither LIMS nor the machine says less: at the turning centre the formula has no limit.
constexpr double greatestSpeed = 100000;

}  // namespace

double spindleSpeedAt(const MotionState& state, const ProgramPlace& tip) {
  if (!state.constantCuttingSpeed) return state.spindleSpeed;
  const double limit = state.speedLimit > 0 ? state.speedLimit : greatestSpeed;
  const double circumference = 2 * std::numbers::pi * std::abs(tip.x());
  return circumference * limit > 1000 * state.spindleSpeed ? 1000 * state.spindleSpeed / circumference : limit;
}

void setFeedType(MotionState& state, int function, const ProgramPlace& tip, bool blockHasSpeed) {
  const bool constantCut = function == 96 || function == 961 || function == 962;
  const bool freezes = function == 97 || function == 971 || function == 972;
  // G962 and G972 leave the kind of feed as it is.
  const int feedType = function == 961 || function == 971                      ? 94
                       : function == 962 || function == 972 || function == 973 ? state.feedType
                                                                               : function;
  // A feed of one kind means nothing to another.
  if ((state.feedType >= 95) != (feedType >= 95) || (state.feedType == 93) != (feedType == 93)) state.feed = 0;
  state.feedType = feedType;
  if (constantCut && !state.constantCuttingSpeed) {
    state.speedBefore = state.spindleSpeed;
  } else if (blockHasSpeed) {
    // In force already, or to come.
  } else if (freezes && state.constantCuttingSpeed) {
    state.spindleSpeed = spindleSpeedAt(state, tip);
  } else if (function == 973 && state.constantCuttingSpeed) {
    state.spindleSpeed = state.speedBefore;
  }
  if (constantCut || freezes || function == 973) state.constantCuttingSpeed = constantCut;
}

}  // namespace probewright::execution::sinumerik
