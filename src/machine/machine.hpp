#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <stop_token>
#include <string>

#include "machine/description.hpp"

/// The border between what a control believes and what is: a machine moves, feels and tells where its axes stand.
///
/// A control knows nothing of the part, the true stylus or the true axes; it sees only this interface. A virtual
/// machine and a real one implement it. All positions are axis positions in the machine coordinate system (mm,
/// degrees); every move is a straight line in axis space (curves and tool-centre-point motion arrive as paths of short
/// lines).
///
/// Calls and threads. A call returns when what it orders has ended, well or not. One thread makes all calls, one after
/// another. A stop may be asked for from any thread, at any time, through the token of stopOn(); that is the only way
/// into a call that has not returned yet.
///
/// Ends. What went wrong is in the result, never an exception; `detail` says it for a person: which axis, what touched
/// what. Whatever the end, position() tells where the axes stand, and they do stand.
namespace probewright::machine {

/// Feed along the path. For moves in which only rotary axes move the unit is degrees/min, otherwise mm/min.
struct Feed {
  double perMinute = 0;  ///< used unless `rapid`; above 0
  bool rapid = false;    ///< as fast as the axes allow
  static Feed rapidTraverse() { return {0, true}; }
  static Feed at(double perMinute) { return {perMinute, false}; }
};

enum class MoveEnd {
  Reached,      ///< the target
  ProbeSignal,  ///< a sensor was deflected where no contact was expected; the axes stopped
  Collision,    ///< something other than a sensor touched; the axes stopped
  AxisLimit,    ///< the target lies outside the travel; nothing moved
  Cancelled,    ///< a stop was asked for; the axes stopped where that reached them, or did not start
  Refused,      ///< the machine cannot do what is ordered, wherever its axes stand; nothing moved
};

struct MoveResult {
  MoveEnd end = MoveEnd::Reached;
  std::string detail;
};

/// A straight line of a path, from where the one before it ended.
struct PathPiece {
  AxisPositions target;
  Feed feed;
};

struct PathResult {
  MoveEnd end = MoveEnd::Reached;
  std::size_t reached = 0;  ///< pieces travelled to their end; the piece of this index is the one that `end` is about
  std::string detail;
};

/// What can signal a touch.
enum class Sensor {
  TouchProbe,      ///< the touch probe in the spindle
  ToolTouchProbe,  ///< the one on the table, which tools touch
};

/// The part of the stylus that is meant to touch.
enum class TouchWith { Ball, Shaft };

struct MeasureOrder {
  AxisPositions target;
  Feed feed;
  Sensor sensor = Sensor::TouchProbe;
  /// A probe signals for its shaft as for its ball; with Ball, machines that know which of them touches call a touch of
  /// the shaft a collision. Means nothing to a tool touch probe.
  TouchWith part = TouchWith::Ball;
};

enum class MeasureEnd {
  Touched,           ///< `latched` holds the position at the signal
  NoContact,         ///< the target was reached without a signal
  DeflectedAtStart,  ///< the sensor was deflected before the motion began; nothing moved
  Collision,         ///< something else than was meant to touched; the axes stopped
  AxisLimit,         ///< the target lies outside the travel; nothing moved
  Cancelled,         ///< as MoveEnd::Cancelled: a signal that comes afterwards counts for nothing
  NotReady,          ///< the sensor is not there, is switched off, or cannot signal with what is in the spindle
  Refused,           ///< as MoveEnd::Refused
};

struct MeasureResult {
  MeasureEnd end = MeasureEnd::NoContact;
  AxisPositions latched;  ///< axis positions when the signal came, as the control's measuring systems read them
  std::string detail;
  /// degrees, of the spindle when the signal came, as orientSpindle() counts; nothing if the machine does not say
  std::optional<double> spindleAngle = std::nullopt;
};

/// How the main spindle turns: seen along the tool from the spindle nose towards the workpiece (ISO 841: M3, M4).
enum class Rotation { None, Clockwise, CounterClockwise };

struct SpindleState {
  Rotation rotation = Rotation::None;
  double speed = 0;  ///< revolutions/min, as it turns; 0 while it stands
  double angle = 0;  ///< degrees, that it was last oriented to; says nothing of a spindle that has turned since
};

enum class FunctionEnd {
  CarriedOut,
  Unknown,    ///< the machine has no such function; nothing has happened
  Refused,    ///< it has, but cannot now
  Cancelled,  ///< a stop was asked for
};

struct FunctionResult {
  FunctionEnd end = FunctionEnd::CarriedOut;
  std::string detail;
};

/// What a control orders from the tool changer. Which true tool that is, is the machine's business.
struct ToolOrder {
  int number = 0;    ///< 0 empties the spindle where the control counts tools
  std::string name;  ///< the control's name of the tool; may be empty
};

/// What the tool changer answers.
enum class ToolChangeEnd {
  Changed,      ///< the tool ordered is in the spindle
  ByHand,       ///< somebody has to put it in, where the axes stand now; the same order again says that it is done
  Missing,      ///< no magazine has the tool; nothing moved
  Refused,      ///< the changer cannot work: an open door, no air; the tool is the one before
  ProbeSignal,  ///< a sensor is deflected: before the change, then nothing moved, or by the new tool
  Collision,    ///< the new tool touches something where it was put in
  Cancelled,    ///< a stop was asked for; the tool is the one before
};

struct ToolChangeResult {
  ToolChangeEnd end = ToolChangeEnd::Changed;
  std::string detail;
};

enum class WaitEnd { Over, Cancelled };

class Machine {
public:
  virtual ~Machine() = default;

  /// The machine as its builder describes it: axes, travels, chains. Not its errors.
  virtual const MachineDescription& description() const = 0;

  /// From now on a stop asked for through `stop` ends the call under way and every later one with Cancelled: the axes
  /// brake at once and stand when the call returns. What only tells, and stopping the spindle, go on working. Another
  /// token, or one without a source, lets the machine move again. Whoever builds or runs the machine calls this, while
  /// no other call is under way.
  virtual void stopOn(std::stop_token stop) = 0;

  // ---- axes ----

  /// Where the axes stand by their own measuring systems.
  virtual AxisPositions position() const = 0;

  /// Moves in a straight line. A signal of a sensor or a collision on the way stops the axes at once.
  virtual MoveResult move(const AxisPositions& target, Feed feed) = 0;

  /// The pieces one after another, each as by move(), but the axes need not stop between them. A piece that cannot be
  /// travelled ends the path where the piece before it ends, or before anything has moved: `reached` says which.
  virtual PathResult moveAlong(std::span<const PathPiece> path) = 0;

  /// Moves in a straight line towards the target until the sensor signals, latches, stops. The machine does not
  /// retract.
  virtual MeasureResult measure(const MeasureOrder& order) = 0;

  /// Moves in a straight line away from a contact: while a sensor is deflected at the start of this move its signal is
  /// no mistake; once it is free, contact stops the move as in move().
  virtual MoveResult retract(const AxisPositions& target, Feed feed) = 0;

  // ---- sensors ----

  /// True while the sensor is deflected. False of a sensor that is not there.
  virtual bool deflected(Sensor sensor) const = 0;

  /// The serial number that the touch probe in the spindle tells by its interface; empty if it tells none.
  virtual std::string probeSerial() const { return {}; }

  // ---- spindle, functions, tools ----

  /// Lets the main spindle turn at `speed` revolutions/min (0 or above), or stand (None; `speed` means nothing), and
  /// returns when it does. While it turns the call changes its speed or its direction.
  virtual MoveResult turnSpindle(Rotation rotation, double speed) = 0;

  /// Turns the spindle to `degrees` (counter-clockwise seen against the tool direction is positive) and holds it. A
  /// spindle that turns is stopped.
  virtual MoveResult orientSpindle(double degrees) = 0;

  virtual SpindleState spindle() const = 0;

  /// True if the machine has the M function: coolant (7, 8, 9) and whatever its builder has added. Those by which a
  /// control flows, turns the spindle or changes tools are no functions of a machine.
  virtual bool hasFunction(int number) const = 0;

  /// Carries out M`number`. Unknown exactly where hasFunction() says no.
  virtual FunctionResult function(int number) = 0;

  /// Puts a tool into the spindle; the axes go where the machine changes tools. To order the tool that is there already
  /// does nothing. A spindle that carries the tool stands afterwards.
  virtual ToolChangeResult changeTool(const ToolOrder& order) = 0;

  // ---- clock ----

  /// Waits. A negative time is none.
  virtual WaitEnd dwell(double seconds) = 0;

  /// Seconds since the machine was started, by its own clock: simulated time on a virtual machine, which stands still
  /// between calls; real time on a real one. Never goes back, and moves on by at least what dwell() waits.
  virtual double seconds() const = 0;
};

}  // namespace probewright::machine
