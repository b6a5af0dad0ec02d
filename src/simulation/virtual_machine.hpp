#pragma once

#include <memory>
#include <optional>
#include <random>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "machine/camera.hpp"
#include "machine/machine.hpp"
#include "machine/tool_spindle.hpp"
#include "simulation/body_guard.hpp"
#include "simulation/contact_search.hpp"
#include "simulation/continuous_path.hpp"
#include "simulation/edge_contact.hpp"
#include "simulation/path_record.hpp"
#include "simulation/tool_shape.hpp"
#include "simulation/true_kinematics.hpp"
#include "simulation/truth.hpp"

namespace probewright::simulation {

/// A machine that exists only in memory, with real parts on its table and a real probe in its spindle.
///
/// Motion. Every move is a straight line in axis space from standstill to standstill: acceleration, speed, braking,
/// each constant along the path and limited by the slowest axis. Path and feed count in mm over the linear axes, in
/// degrees if only rotary axes move. A target beyond a travel end is refused before anything moves. Feed moves that
/// follow each other, in a path or not, take the time of a control that looks ahead; see ContinuousPath.
///
/// Stop. Moves are computed, so a stop reaches the machine between two of them, or where the search for contact has got
/// to: the axes stand on the line at a place up to which nothing touches.
///
/// Contact. The tool is the ball, the shaft and the body of a probe, or a cutter. Where only linear axes without
/// position-dependent errors move, the ball's path on the table is straight and contact is as accurate as the solid's
/// own query; otherwise the path is cut until its chords are true to 1e-7 mm when measuring and 1e-4 mm when
/// positioning.
///
/// Signal. The ball touches (or the shaft, where it is meant to); the axes travel on by the pretravel, by speed times
/// signal delay, and by a random amount with the probe's repeatability; there the readings are latched. The axes brake
/// and stop, at most 0.8 ball radii beyond the contact, and never beyond the target. If the target comes before the
/// signal, there is none. Pretravel, delay and noise act along the path.
///
/// Tool touch probe. When it is the sensor that measures, it signals at the first touch of an edge of the cutter; see
/// CuttingEdges. The axes travel on as with a touch probe's signal. The contact does not give way in every direction,
/// and an edge that turns as it cuts damages it: collisions, as is every other solid in the way and the shank. To
/// moves that do not measure, a cutter is the cylinder about all of its edges.
///
/// Spindle. It turns without taking time; the edges of a cutter turn with it, other tools touch as they were oriented.
/// Stopped, it stands where it is. Of M functions the machine has coolant: 7, 8, 9.
///
/// Lathes, whose main spindle turns the workpiece, drive the tool with a spindle of its own (ToolSpindle). Their tool
/// touch probes stand on the bed: the main spindle does not carry them along. The table frame of what touched them is
/// that in which the main spindle stands at 0.
///
/// Bodies of the machine stop what they run into, and what runs into them, the ball of a probe too: a collision. See
/// BodyGuard.
///
/// Errors of the axes act between the readings and the true place of the spindle; see MachineErrors.
///
/// Hirth coupling. A rotary axis that has one moves to the positions of its grid only; other targets are refused. Where
/// something stopped it in between, it stays unlocked until it has reached such a position.
///
/// Tool change. The last linear axis of the spindle chain goes to the tool change position first, then the other linear
/// axes together. Changing to the tool in the spindle does nothing. Not watched for collisions except at its end.
class VirtualMachine final : public machine::Machine, public machine::ToolSpindle, public machine::CameraOwner {
public:
  explicit VirtualMachine(Truth truth);

  const machine::MachineDescription& description() const override { return truth_.machine; }
  void stopOn(std::stop_token stop) override { stop_ = std::move(stop); }
  machine::AxisPositions position() const override { return reading_; }
  machine::MoveResult move(const machine::AxisPositions& target, machine::Feed feed) override;
  machine::PathResult moveAlong(std::span<const machine::PathPiece> path) override;
  machine::MeasureResult measure(const machine::MeasureOrder& order) override;
  machine::MoveResult retract(const machine::AxisPositions& target, machine::Feed feed) override;
  bool deflected(machine::Sensor sensor) const override {
    return (sensor == machine::Sensor::TouchProbe ? deflection_ : toolContact_).has_value();
  }
  std::string probeSerial() const override {
    return tool_ && tool_->kind == ToolKind::Probe ? tool_->probe.serial : std::string();
  }
  machine::MoveResult turnSpindle(machine::Rotation rotation, double speed) override;
  machine::MoveResult orientSpindle(double degrees) override;
  machine::SpindleState spindle() const override { return spindle_; }
  bool drivesTools() const override { return truth_.machine.mainSpindle.has_value(); }
  machine::MoveResult turnTool(machine::Rotation rotation, double speed) override;
  machine::MoveResult orientTool(double degrees) override;
  machine::SpindleState toolSpindle() const override { return driven_; }
  bool hasFunction(int number) const override { return number >= 7 && number <= 9; }
  machine::FunctionResult function(int number) override;
  machine::ToolChangeResult changeTool(const machine::ToolOrder& order) override;
  machine::WaitEnd dwell(double seconds) override;
  double seconds() const override { return clock_; }

  machine::Camera* camera() override { return camera_.get(); }
  /// Fits a camera to the machine.
  void fit(std::unique_ptr<machine::Camera> camera) { camera_ = std::move(camera); }

  /// Puts a tool into the spindle by hand: at once, where the axes stand.
  machine::ToolChangeResult insertTool(const machine::ToolOrder& order);

  /// Switched off, results tell only what a real control would know too: that something touched, not what and where. On
  /// at the start.
  void tellTouches(bool on) { tellsTouches_ = on; }

  /// What bodies of the machine touch where the axes stand, in words.
  std::optional<std::string> bodyContact() const;

  const Truth& truth() const { return truth_; }
  const PathRecord& path() const { return path_.record(); }
  /// What is added to the record from now on; everything at the start.
  void record(Recording what) { recording_ = what; }

  /// The true place of the spindle (at spindle angle 0) on the table now, and of the tip of the tool.
  Pose tableFromSpindle() const;
  Vector3 tipOnTable() const;

private:
  static constexpr double mostOvertravel = 0.8;  // ball radii
  static constexpr const char* stoppedText = "the machine was stopped";
  static constexpr const char* reachedText = "the target was reached without contact";
  static constexpr const char* ranIntoSomething = "the machine has run into something";

  /// The first touch of a motion and how the motion ends because of it, in fractions of its way.
  struct Stop {
    std::optional<Touch> touch;
    std::optional<double> signal;  ///< where the readings are latched; may lie beyond the end of the way
    double end = 1;
  };

  /// Where `tableFromSpindle` puts the tool, as a point of the path.
  PathPoint pathPoint(const Pose& tableFromSpindle, const machine::AxisPositions& axes, PathKind kind,
                      double seconds) const;
  std::optional<std::string> beyondTravel(const machine::AxisPositions& target) const;
  /// Why an order is not begun, if it is not: a stop, a feed that is none, an axis that cannot stand at its target.
  std::optional<machine::MoveResult> refusal(machine::Feed feed, const machine::AxisPositions& target) const;
  std::optional<std::string> besideHirthGrid(const machine::AxisPositions& target) const;
  machine::MeasureResult refusedMeasurement(machine::MoveResult why) const;
  Motion motionTo(const machine::AxisPositions& target, machine::Feed feed) const;
  machine::MeasureResult measureWithProbe(const machine::MeasureOrder& order);
  Touch preciseShaftTouch(const Motion& motion, const Touch& touch) const;
  Stop stopFor(const Motion& motion, const Touch& touch);
  Stop signalStop(const Motion& motion, const Touch& touch);
  double pretravel(const Motion& motion, const Touch& touch) const;
  machine::MeasureResult measureTool(const machine::MeasureOrder& order);
  /// What the cutter runs into with anything but its edges, the tool touch probes aside, on a measuring motion.
  std::optional<Touch> obstacle(const Motion& motion) const;
  /// The first touch of a tool touch probe.
  struct ProbeTouch {
    std::size_t probe = 0;
    EdgeContact contact;
    Touch touch;
  };
  std::optional<ProbeTouch> toolProbeTouch(const Motion& motion) const;
  machine::MeasureResult signalOfTool(const Motion& motion, const ProbeTouch& touched);
  machine::MoveResult turn(machine::SpindleState& spindle, machine::Rotation rotation, double speed);
  machine::MoveResult orient(machine::SpindleState& spindle, double degrees);
  /// The spindle as it turns the tool in it now.
  double spindleDegrees() const { return spin_.at(clock_); }
  void advance(const Motion& motion, const Stop& stop, PathKind kind);
  machine::MoveResult finish(const Motion& motion, std::optional<Touch> touch, PathKind kind);
  /// What a body of the machine hits before the tool touches anything.
  std::optional<BodyHit> bodyHit(const Motion& motion, const std::optional<Touch>& touch,
                                 BodyGuard::Touching touching = BodyGuard::Touching::Counts) const;
  /// The end of a motion there, in words.
  std::string stopAt(const Motion& motion, const BodyHit& hit, PathKind kind);
  std::string describe(const BodyHit& hit) const;
  std::string toolName() const;
  std::optional<double> freeFrom(const Motion& motion) const;
  /// The stylus is deflected at the end of a measuring move.
  void lean(const Motion& measuring, const Touch& touch);
  /// True if it leads back along the measuring move that deflected the stylus.
  bool isWayBack(const Motion& motion) const;
  std::string describe(const Touch& touch) const;
  /// What the tool touch probe signals, in words, while it does.
  std::string toolSignal() const;
  const char* partOf(const Touch& touch) const;
  /// The tool that is ordered, null for none; nothing if the magazine does not hold it.
  std::optional<const TrueTool*> findTool(const machine::ToolOrder& order) const;
  machine::ToolChangeResult load(const TrueTool* tool);
  /// What the tool touches where it stands.
  std::optional<Touch> overlap();
  /// True if the tool touch probes stand on the bed of a lathe.
  bool probesOnBed() const { return truth_.machine.mainSpindle && !truth_.toolProbes.empty(); }
  /// The motion as it is seen from the bed of a lathe: the main spindle stands at 0.
  Motion onBed(const Motion& motion) const;
  Motion seenFromTouched(const Motion& motion) const;
  Pose bedFromSpindle() const;
  /// The first touch of anything, on the table or on the bed.
  std::optional<Touch> firstTouchOf(const Motion& motion, double begin, const SearchOptions& options) const;
  /// What the ball overlaps `fraction` of the way.
  std::optional<Touch> ballTouchAt(const Motion& motion, double fraction) const;
  std::optional<Touch> shaftTouch() const;
  /// The spindle that carries the tool.
  machine::SpindleState& carrying() { return truth_.machine.mainSpindle ? driven_ : spindle_; }
  const machine::SpindleState& carrying() const { return truth_.machine.mainSpindle ? driven_ : spindle_; }
  std::string stillDeflected() const;
  SearchOptions searchOptions(double precision) const { return {.precision = precision, .stop = &stop_}; }
  /// Ends a motion where a stop has caught it.
  void standAt(const Motion& motion, double fraction, PathKind kind);

  Truth truth_;
  TrueKinematics kinematics_;
  Surroundings surroundings_;
  Surroundings withoutToolProbes_, toolProbesOnly_;
  std::unique_ptr<BodyGuard> guard_;           ///< null: the machine has no bodies
  std::vector<std::size_t> solidOfToolProbe_;  ///< which of the solids draws each of the tool touch probes
  const TrueTool* tool_ = nullptr;
  ToolShape shape_;
  std::optional<CuttingEdges> edges_;  ///< of a cutter
  machine::AxisPositions reading_;
  machine::AxisPositions slides_;
  std::optional<Touch> deflection_;  ///< the touch that deflected the stylus, while it is deflected
  /// Where the measuring move began that deflected the stylus: between there and the touch nothing is in the way.
  std::optional<machine::AxisPositions> cameFrom_;
  std::optional<Touch> toolContact_;  ///< that of a tool with the tool touch probe, until it is pulled off
  machine::SpindleState spindle_;
  machine::SpindleState driven_;  ///< of a lathe: the spindle of driven tools
  Spin spin_;                     ///< of the tool
  double clock_ = 0;
  std::mt19937_64 noise_;
  std::normal_distribution<double> gaussian_;
  std::stop_token stop_;
  Recording recording_ = Recording::Everything;
  bool tellsTouches_ = true;
  ContinuousPath continuous_;
  PathRecorder path_;
  std::unique_ptr<machine::Camera> camera_;
};

/// The seed of the random stream called `name` in a world seeded with `seed`.
std::uint64_t streamSeed(std::uint64_t seed, std::string_view name);

}  // namespace probewright::simulation
