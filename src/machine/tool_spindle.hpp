#pragma once

#include "machine/machine.hpp"

/// The spindle of driven tools: of lathes, whose main spindle turns the workpiece.
namespace probewright::machine {

/// A machine that can drive the tool in its turret is a ToolSpindle as well as a Machine. On machines whose main
/// spindle carries the tool there is none. Calls and ends are those of Machine.
class ToolSpindle {
public:
  virtual ~ToolSpindle() = default;

  /// False: there is no such spindle, and nothing else may be called.
  virtual bool drivesTools() const = 0;

  /// As Machine::turnSpindle(): seen along the tool from the holder.
  virtual MoveResult turnTool(Rotation rotation, double speed) = 0;

  /// As Machine::orientSpindle().
  virtual MoveResult orientTool(double degrees) = 0;

  virtual SpindleState toolSpindle() const = 0;
};

}  // namespace probewright::machine
