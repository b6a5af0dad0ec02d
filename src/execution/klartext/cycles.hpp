#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "execution/klartext/motion.hpp"
#include "execution/klartext/parameters.hpp"

namespace probewright::execution::klartext {

/// Touch probe cycles run; cycle 12 calls its program, at each point of a pattern if there is one; all other machining
/// cycles are named as skipped.
class Cycles {
public:
  Cycles(RunContext& run, Motion& motion, ToolGuidance& guidance, Parameters& parameters)
      : run_(run), control_(run.control), motion_(motion), guidance_(guidance), parameters_(parameters) {}

  void carryOut(const CycleCall& call, Evaluation& evaluation);
  /// Cycle 12 with its program.
  void defineProgramCycle(std::string program);
  /// CYCL CALL, CYCL CALL POS at a position, CYCL CALL PAT, and M99, which ends M89.
  void callCycle(const Command& command, Evaluation& evaluation);
  /// M89: at once, and after each move.
  void callAtEachMove();
  /// After a move has been handed on: M89.
  void afterMove(const Move& move, Evaluation& evaluation);

  /// PATTERN DEF.
  void definePattern(std::string_view text);
  /// SEL PATTERN.
  void selectPattern(const std::string& path);
  /// The program that was called at a point of a pattern is left.
  void nextPatternPoint();

  /// The program to be called after this instruction; empty: none. Forgotten with the answer.
  std::string takeRequestedProgram() { return std::exchange(requestedProgram_, {}); }

  std::optional<int> machiningCycle() const { return machiningCycle_; }
  std::optional<int> lastProbeCycle() const { return lastProbeCycle_; }

private:
  void measure(const CycleCall& call, Evaluation& evaluation);
  void defineCycle(int number);
  void moveToCallPosition(const Command& command, Evaluation& evaluation);
  void callMachiningCycle();
  void callAtPattern();
  void skip(int number);

  RunContext& run_;
  control::heidenhain::Control& control_;
  Motion& motion_;
  ToolGuidance& guidance_;
  Parameters& parameters_;
  std::optional<int> machiningCycle_;
  std::optional<int> lastProbeCycle_;
  std::string requestedProgram_;
  bool cycleAtEachMove_ = false;  ///< M89
  std::vector<Vector3> pattern_;  ///< of PATTERN DEF or SEL PATTERN, mm
};

}  // namespace probewright::execution::klartext
