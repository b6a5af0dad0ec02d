#pragma once

#include "execution/klartext/cycles.hpp"
#include "execution/klartext/motion.hpp"
#include "execution/klartext/spindle.hpp"

namespace probewright::execution::klartext {

/// M functions; language/klartext/m_functions.hpp tells which of them are carried out.
class MachineFunctions {
public:
  MachineFunctions(RunContext& run, Motion& motion, ToolGuidance& guidance, Spindle& spindle, Cycles& cycles)
      : run_(run), control_(run.control), motion_(motion), guidance_(guidance), spindle_(spindle), cycles_(cycles) {}

  void carryOut(const MachineFunction& function, Evaluation& evaluation);

private:
  void nameMachineFunction(int number);
  bool handToMachine(int number);
  void retractAlongTool(const MachineFunction& function, Evaluation& evaluation);
  void takeTurns(const MachineFunction& function, Evaluation& evaluation);
  void deleteBasicRotation();

  RunContext& run_;
  control::heidenhain::Control& control_;
  Motion& motion_;
  ToolGuidance& guidance_;
  Spindle& spindle_;
  Cycles& cycles_;
};

}  // namespace probewright::execution::klartext
