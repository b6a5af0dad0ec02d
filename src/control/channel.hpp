#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "control/journal.hpp"
#include "geometry/places.hpp"
#include "machine/machine.hpp"

/// Where a program's coordinates meet the axes: the common part of every control.
namespace probewright::control {

using machine::AxisPositions;
using machine::Feed;
using machine::TouchWith;

/// How program coordinates follow the axes.
enum class Following {
  LinearAxes,  ///< positions are those of the linear axes alone; turning a rotary axis changes nothing
  Kinematics,  ///< positions are those of the tool tip on the workpiece, wherever the rotary axes stand
};

/// What an alarm is called on the control that runs.
struct MotionAlarms {
  std::string limit = "Limit switch";
  std::string collision = "Collision";
  std::string probeSignal = "Touch probe deflected";
  std::string toolMissing = "Tool not in the magazine";
  std::string orientation = "Spindle orientation not possible";
  std::string refused = "Machine not ready";  ///< whatever else the machine cannot do
};

/// What the operator is asked where a tool is put in by hand.
std::string askForTool(const machine::ToolOrder& order, const std::string& detail);

/// A target: what is absent keeps its place.
struct Target {
  std::array<std::optional<double>, 3> linear;                     ///< program coordinates X, Y, Z
  std::array<std::optional<double>, machine::maximumAxes> rotary;  ///< program angles, by axis index
};

/// A touch as the channel sees it.
struct Touch {
  ProgramPlace tip;  ///< controlled point at the signal
  AxisPositions latched;
};

/// Positions and moves in program coordinates.
///
/// The controlled point is the tool tip: the tool reference point of the spindle minus `toolVector`. Program
/// coordinates are reached from machine coordinates through the frame. With Following::LinearAxes the machine
/// coordinates of the tip are the readings of X, Y, Z minus the tool vector. With Following::Kinematics they are the
/// coordinates of the tip in the table frame as it lies when the rotary axes stand at the reference posture, so a
/// frame measured there goes on following the workpiece when the table turns.
/// Every move ends in straight lines of axis space; what bends becomes a path of them. Alarms are thrown (Alarm), and
/// so is a stop that reached the machine (Cancelled).
class Channel {
public:
  Channel(machine::Machine& machine, Journal& journal);

  machine::Machine& machine() { return machine_; }
  const machine::MachineDescription& description() const { return description_; }
  Journal& journal() { return journal_; }

  MotionAlarms alarms;
  /// Largest deviation of a curved tip path from its straight pieces, mm.
  double pathTolerance = 1e-3;

  // ---- the coordinate system ----

  /// Machine coordinates from program coordinates; may mirror and scale, must be invertible.
  void setFrame(const Eigen::Affine3d& machineFromProgram);
  const Eigen::Affine3d& frame() const { return machineFromProgram_; }
  template <places::Of of>
  places::Place<places::Axes::Machine, of> machineFromProgram(
      const places::Place<places::Axes::Program, of>& place) const {
    return places::Place<places::Axes::Machine, of>(machineFromProgram_ * place.vector());
  }
  MachineWay machineFromProgram(const ProgramWay& way) const {
    return MachineWay(machineFromProgram_.linear() * way.vector());
  }
  template <places::Of of>
  places::Place<places::Axes::Program, of> programFromMachine(
      const places::Place<places::Axes::Machine, of>& place) const {
    return places::Place<places::Axes::Program, of>(programFromMachine_ * place.vector());
  }
  ProgramWay programFromMachine(const MachineWay& way) const {
    return ProgramWay(programFromMachine_.linear() * way.vector());
  }
  /// Program angle = machine angle - offset, for each rotary axis.
  AxisPositions rotaryOffset;

  void setFollowing(Following following, const AxisPositions& reference);
  Following following() const { return following_; }
  const AxisPositions& reference() const { return reference_; }
  /// True: linear axes hold the tip still on the workpiece while rotary axes turn (M128, TCPM, TRAORI).
  bool holdTip = false;

  /// mm in one unit that the program counts in, for positions in messages; null: mm.
  const double* programUnit = nullptr;

  /// The believed machine: descriptions of kinematics that cycles correct. Starts as the machine's own.
  void setDescription(const machine::MachineDescription& believed);
  /// How much further the tip is than the axes tell, as far as the control knows: machine axes X, Y, Z, mm, by the
  /// positions of the rotary axes. Linear axes must not matter. Empty: nowhere.
  std::function<Vector3(const AxisPositions& axes)> tipDeviation;

  // ---- the tool ----

  /// From the tool tip to the tool reference point at the spindle nose, in the spindle frame (mm): (0, 0, L) on mills.
  Vector3 toolVector = Vector3::Zero();
  double toolRadius = 0;

  /// The direction from the tool tip towards the spindle, unit length.
  ProgramWay toolAxis() const;

  /// Program coordinates of a point from its place on the table, as the control believes, with the axes at `axes`.
  Eigen::Affine3d programFromTable(const AxisPositions& axes) const;

  /// Directions in the spindle frame, not turned with the spindle, from directions in program coordinates.
  Matrix3 spindleFromProgram() const;

  // ---- where things are ----

  AxisPositions axes() const { return machine_.position(); }
  ProgramPlace position() const { return programFromAxes(axes()); }
  ProgramPlace programFromAxes(const AxisPositions& axes) const;
  /// Coordinates of the tip before the frame is applied.
  MachinePlace machineFromAxes(const AxisPositions& axes) const;
  /// The axis positions that bring the tip to the program point with the rotary axes as in `rotary`.
  AxisPositions axesFromProgram(const ProgramPlace& tip, const AxisPositions& rotary) const;
  AxisPositions axesFromMachine(const MachinePlace& tip, const AxisPositions& rotary) const;

  // ---- motion ----

  void moveTo(const ProgramPlace& tip, Feed feed);
  void moveTo(const Target& target, Feed feed);
  /// Straight to axis positions of the machine coordinate system.
  void moveAxes(const AxisPositions& target, Feed feed);
  /// Through the program points, the rotary axes standing, without a stop between them.
  void moveAlong(std::span<const ProgramPlace> tips, Feed feed);

  /// Towards the program point until the sensor signals. The outcome is the caller's to judge, but for a stop.
  machine::MeasureResult measureTo(const ProgramPlace& tip, Feed feed, machine::Sensor sensor,
                                   TouchWith part = TouchWith::Ball);
  bool deflected(machine::Sensor sensor) const { return machine_.deflected(sensor); }
  Touch touchFrom(const machine::MeasureResult& result) const;
  void retractTo(const ProgramPlace& tip, Feed feed);

  /// Lets the main spindle turn, or stand.
  void turnSpindle(machine::Rotation rotation, double speed);
  machine::Rotation spindleRotation() const { return machine_.spindle().rotation; }
  /// Turns the main spindle to an angle: the tool, or on lathes the workpiece by the shorter way.
  void orientSpindle(double degrees);
  double spindleAngle() const;
  /// Hands an M function to the machine. False if the machine does not have it.
  bool function(int number);
  void changeTool(const machine::ToolOrder& order);
  /// Called where somebody has to put the tool in: tells them, and comes back when they have.
  std::function<void(const machine::ToolOrder& order, const std::string& detail)> onToolByHand;
  void dwell(double seconds);
  double seconds() const { return machine_.seconds(); }

  /// Path of the tip over the table since the channel was made, mm; rotary axes of head and table count.
  double pathLength() const { return pathLength_; }

private:
  void count(const AxisPositions& from, const AxisPositions& to);
  void travel(std::vector<machine::PathPiece> path);
  void judge(const machine::MoveResult& result) const;
  void judgeTravel(machine::MoveResult result) const;
  /// Notes a motion that did not end as it should.
  void note(machine::MoveEnd end, const AxisPositions& from, const AxisPositions& to);
  void note(machine::MeasureEnd end, const AxisPositions& from, const AxisPositions& to);
  void note(Interruption why, bool measuring, const AxisPositions& from, const AxisPositions& to);
  /// Adds where the tip is in program coordinates: the numbers that the person at the control can look at.
  void addPlace(std::string& detail) const;

  machine::Machine& machine_;
  Journal& journal_;
  machine::MachineDescription description_;
  std::array<std::optional<std::size_t>, 3> linearAxis_;
  Eigen::Affine3d machineFromProgram_ = Eigen::Affine3d::Identity();
  Eigen::Affine3d programFromMachine_ = Eigen::Affine3d::Identity();
  Following following_ = Following::LinearAxes;
  AxisPositions reference_;
  Pose referenceFromTable_ = Pose::Identity();
  double pathLength_ = 0;
};

}  // namespace probewright::control
