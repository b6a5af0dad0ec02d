#pragma once

#include <optional>
#include <vector>

#include "survival/watched_machine.hpp"

/// The orders of a run and those of the same program with other measured values, side by side.
namespace probewright::survival {

/// The steps of a run. Controls leave out moves to where the axes stand; where something else is measured they come.
struct Course {
  std::vector<Step> steps;
  std::vector<bool> optional;  ///< of each step: a short move, or none, which is left out where it moves nothing
};

/// Puts such moves into the course, as a run has them in which everything is measured a little otherwise. False if that
/// run is of another course.
bool addStillMoves(Course& course, const std::vector<Step>& otherwise, const machine::MachineDescription& machine);

/// Of a run, a step for each of the course; nothing if it is of another course: other orders, tools or feeds, other
/// positions of rotary axes.
std::optional<std::vector<Step>> aligned(const Course& course, const std::vector<Step>& steps,
                                         const machine::MachineDescription& machine);

/// True if a rotary axis stands otherwise.
bool rotaryDiffers(const machine::MachineDescription& machine, const machine::AxisPositions& a,
                   const machine::AxisPositions& b);

}  // namespace probewright::survival
