#pragma once

#include <optional>

#include "execution/klartext/run_context.hpp"

namespace probewright::execution::klartext {

/// Spindle and coolant, as M functions switch them.
class Spindle {
public:
  explicit Spindle(RunContext& run) : control_(run.control) {}

  /// M3, M4: with the speed of the last TOOL CALL.
  void turn(machine::Rotation rotation);
  /// M5.
  void stop();
  /// Cycle 13: the angle that orient() turns to. Throws Alarm if it is not from 0 to 360 degrees.
  void setOrientation(double degrees);
  /// M19, M20: to the angle of cycle 13, without one to 0, which the builder of the machine has fixed.
  void orient();
  /// M8, M9.
  void coolant(int number);
  /// The end of the main program stops spindle and coolant.
  void standDown();
  /// As Q110 and FN 18 tell it. -1: it has not run yet, 0: M3, 1: M4, 2: M5 after M3, 3: M5 after M4.
  double state() const;

private:
  control::heidenhain::Control& control_;
  bool hasRun_ = false;
  bool clockwise_ = true;
  std::optional<double> orientation_;  ///< degrees
};

}  // namespace probewright::execution::klartext
