#pragma once

#include <string>

#include "machine/description.hpp"

/// The border between what a control believes and what is: a machine moves, feels and tells where its axes stand.
///
/// A control knows nothing of the part, the true stylus or the true axes; it sees only this interface. A virtual
/// machine and a real one implement it. All positions are axis positions in the machine coordinate system; every move
/// is a straight line in axis space (curves and tool-centre-point motion arrive as short lines). Calls block until the
/// motion has ended.
namespace probewright::machine {

/// Feed along the path. For moves in which only rotary axes move the unit is degrees/min, otherwise mm/min.
struct Feed {
  double perMinute = 0;  ///< used unless `rapid`
  bool rapid = false;    ///< as fast as the axes allow
  static Feed rapidTraverse() { return {0, true}; }
  static Feed at(double perMinute) { return {perMinute, false}; }
};

enum class MoveEnd {
  Reached,      ///< the target
  ProbeSignal,  ///< the probe was deflected where no contact was expected; the axes stopped
  Collision,    ///< something other than the stylus tip touched, or the tool is not a probe; the axes stopped
  AxisLimit,    ///< the target lies outside the travel; nothing moved
  Cancelled,    ///< the user asked to stop
};

struct MoveResult {
  MoveEnd end = MoveEnd::Reached;
  std::string detail;  ///< for a person: which axis, what touched what
};

enum class MeasureEnd {
  Touched,           ///< `latched` holds the position at the signal
  NoContact,         ///< the target was reached without a signal
  DeflectedAtStart,  ///< the stylus was deflected before the motion began; nothing moved
  Collision,
  AxisLimit,
  Cancelled,
  NotReady,  ///< there is no probe that could signal or it is switched off
};

struct MeasureResult {
  MeasureEnd end = MeasureEnd::NoContact;
  AxisPositions latched;  ///< axis positions when the signal came, as the control's measuring systems read them
  std::string detail;
};

/// What a control orders from the tool changer. Which true tool that is, is the machine's business.
struct ToolOrder {
  int number = 0;    ///< 0 empties the spindle where the control counts tools
  std::string name;  ///< the control's name of the tool; may be empty
};

class Machine {
public:
  virtual ~Machine() = default;

  /// The machine as its builder describes it: axes, travels, chains. Not its errors.
  virtual const MachineDescription& description() const = 0;

  /// Where the axes stand by their own measuring systems.
  virtual AxisPositions position() const = 0;

  /// Moves in a straight line. A probe signal or a collision on the way stops the axes at once.
  virtual MoveResult move(const AxisPositions& target, Feed feed) = 0;

  /// Moves in a straight line towards `target` until the probe signals, latches, stops: the touch probe in the spindle
  /// or, with a tool in the spindle, the tool touch probe on the table. The machine does not retract.
  virtual MeasureResult measure(const AxisPositions& target, Feed feed) = 0;

  /// As measure(), for the few touches that the shaft of the stylus is meant to make. A probe signals for its shaft as
  /// for its ball; machines that know which of them touches call a shaft that touches elsewhere a collision.
  virtual MeasureResult measureWithShaft(const AxisPositions& target, Feed feed) { return measure(target, feed); }

  /// Moves in a straight line away from a contact: while the stylus is deflected at the start of this move a signal is
  /// no mistake; once it is free, contact stops the move as in move().
  virtual MoveResult retract(const AxisPositions& target, Feed feed) = 0;

  /// True while the stylus of the probe in the spindle, or the tool touch probe, is deflected.
  virtual bool probeDeflected() const = 0;

  /// The serial number that the touch probe in the spindle tells by its interface; empty if it tells none.
  virtual std::string probeSerial() const { return {}; }

  /// Turns the spindle to `degrees` (counter-clockwise seen against the tool direction is positive) and holds it.
  virtual MoveResult orientSpindle(double degrees) = 0;

  /// The angle that the spindle was last oriented to.
  virtual double spindleAngle() const = 0;

  virtual MoveResult changeTool(const ToolOrder& order) = 0;

  virtual void dwell(double seconds) = 0;

  /// Seconds since the machine was started, by its own clock: simulated time on a virtual machine.
  virtual double seconds() const = 0;
};

}  // namespace probewright::machine
