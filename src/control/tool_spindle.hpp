#pragma once

#include "control/channel.hpp"
#include "machine/tool_spindle.hpp"

/// The spindle of driven tools, as programs and cycles order it. Throws what Channel throws.
namespace probewright::control {

/// Null where the main spindle carries the tool, or the machine drives none.
machine::ToolSpindle* toolSpindleOf(Channel& channel);

void turnTool(Channel& channel, machine::ToolSpindle& spindle, machine::Rotation rotation, double speed);
void orientTool(Channel& channel, machine::ToolSpindle& spindle, double degrees);

}  // namespace probewright::control
