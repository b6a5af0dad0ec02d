#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "simulation/true_kinematics.hpp"
#include "survival/box_proof.hpp"
#include "survival/course.hpp"
#include "survival/curvature.hpp"

/// The run in the middle of a box that its proof goes by, and what follows from where it touches.
namespace probewright::survival {

/// The size of what the touches of a cycle are on, for (1) of curvature.hpp.
struct CycleSize {
  double size = 0;
  std::optional<CornerSize> corner;  ///< of a corner, which turns what comes later

  /// What bends by the square of a shift over it, of places within `lever` of a touch.
  double bending(double lever) const { return corner ? std::min(size, corner->at(lever + corner->away)) : size; }
};

struct MiddleRun : WatchedRun {
  /// Runs the program in the middle of the box and looks whether it can be replayed: the same orders for what is
  /// measured a little otherwise, wherever the axes stop after a touch. Else the verdict.
  std::optional<BoxVerdict> carryOut(const ClampedProgram& program, const Box& box);

  const machine::MachineDescription& machine() const { return truth.machine; }
  double way(const machine::AxisPositions& a, const machine::AxisPositions& b) const { return wayOf(machine(), a, b); }
  /// Where the spindle is with the axes there, on the table.
  Vector3 spindleAt(const machine::AxisPositions& axes) const {
    return kinematics->tableFromSpindle(axes, 0).translation();
  }
  Course course() const { return {steps, optional}; }
  /// Undecided, because of what the step is in the way of.
  BoxVerdict undecided(std::string why, const Step* at = nullptr) const;

  /// The cycle that a touch belongs to, by its place in the journal; one past the last for touches of no cycle.
  std::size_t cycleOf(std::size_t touch) const;
  const CycleSize& sizeAround(std::size_t cycle);
  /// The greatest distance of later steps from where the step touches, mm.
  double leverAfter(std::size_t step) const;

  std::vector<bool> optional;        ///< of the steps: see Course
  std::vector<PlannedTouch> plan;    ///< what the touches answer
  std::vector<std::size_t> touches;  ///< steps
  Displacements displacements;       ///< of the box
  double farthest = 0;               ///< mm: of solids from where they are in the middle of all tolerances
  std::optional<simulation::TrueKinematics> kinematics;

private:
  CycleSize findSize(std::size_t cycle) const;
  std::optional<BoxVerdict> findTouches();
  std::optional<BoxVerdict> replays(const ClampedProgram& program);
  /// Touches of a circle that the control has fitted, in the cycle.
  std::vector<std::vector<std::size_t>> circlesOf(std::size_t cycle, const std::vector<std::size_t>& own) const;
  CycleSize sizeOfBores(std::size_t bores, const std::vector<Vector3>& places, const std::vector<Vector3>& ways) const;

  std::map<std::size_t, CycleSize> sizes_;  ///< by cycle
};

}  // namespace probewright::survival
