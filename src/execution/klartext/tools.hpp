#pragma once

#include "execution/klartext/spindle.hpp"
#include "execution/klartext/tool_guidance.hpp"

namespace probewright::execution::klartext {

/// TOOL CALL and TOOL DEF.
class Tools {
public:
  Tools(RunContext& run, ToolGuidance& guidance, Spindle& spindle)
      : run_(run), control_(run.control), guidance_(guidance), spindle_(spindle) {}

  void callTool(const ToolCall& call, Evaluation& evaluation);
  void defineTool(const Command& command, Evaluation& evaluation);
  /// After its data have changed in the table: those of the tool in the spindle act.
  void refresh();
  void publishTool();

  /// Of the tool in the spindle, at least 1.
  double teeth() const;
  /// The number of TOOL DEF; 0 before it.
  double prepared() const { return prepared_; }

private:
  RunContext& run_;
  control::heidenhain::Control& control_;
  ToolGuidance& guidance_;
  Spindle& spindle_;
  double prepared_ = 0;
};

}  // namespace probewright::execution::klartext
