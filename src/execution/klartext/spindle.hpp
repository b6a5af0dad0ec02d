#pragma once

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
};

}  // namespace probewright::execution::klartext
