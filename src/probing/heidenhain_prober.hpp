#pragma once

#include <optional>

#include "control/channel.hpp"
#include "control/working_plane.hpp"
#include "probing/directional_radius.hpp"
#include "probing/touch_plan.hpp"

/// The measuring move and the positioning habits of the HEIDENHAIN touch probe cycles.
namespace probewright::probing {

using control::WorkingPlane;

/// What tool table, touch probe table and machine parameters say about the active probe.
struct HeidenhainProbe {
  double ballRadius = 0;                   ///< effective radius: column R of the tool table
  Vector2 tipOffset = Vector2::Zero();     ///< CAL_OF1, CAL_OF2: ball centre from spindle axis at the calibration angle
  double calibrationAngle = 0;             ///< CAL_ANG, spindle angle that the tip offset belongs to
  double setUp = 2;                        ///< SET_UP
  double distance = 50;                    ///< DIST: longest stroke from the pre-position
  double probingFeed = 500;                ///< F, already limited by maxTouchFeed
  double positioningFeed = 3000;           ///< FMAX
  bool prepositionAtMachineRapid = false;  ///< F_PREPOS = FMAX_MACHINE
  bool track = false;                      ///< TRACK = ON: the spindle turns the same side of the probe to every touch
  bool aside = false;     ///< STYLUS = L-TYPE: the ball stands aside by tipOffset, which is turned to the surface
  int repetitions = 1;    ///< iTNC 530, MP6170: measurements of one point
  double confidence = 0;  ///< iTNC 530, MP6171: largest difference between them, mm
  /// Where the longest stroke is entered, for messages.
  std::string_view distanceName = "DIST of the touch probe table";
  DirectionalRadius directions;  ///< of a 3-D calibration: what comes on top of the ball radius

  /// How far the ball reaches from the spindle axis when it is turned to a surface.
  double reach() const { return ballRadius + (aside ? tipOffset.norm() : 0); }
};

/// One touch, evaluated.
struct EvaluatedTouch {
  BallCentre ballCentre;  ///< tip offset taken into account
  PartPoint surface;      ///< ball centre plus ball radius along the probing direction
  double ballRadius = 0;  ///< along the probing direction: mm divided by the active scaling
  machine::AxisPositions latched;
  std::size_t record = 0;  ///< place of the (last) touch in the cycle's record
};

/// What `length` mm are in program coordinates along `direction` (X, Y, Z; unit length): cycles 11 and 26 scale them.
double inProgramUnits(const control::Channel& channel, double length, const ProgramWay& direction);

/// What leads `length` mm along the tool towards the spindle.
ProgramWay alongTool(const control::Channel& channel, double length);

/// Where the tool reference point of the spindle stands while the axes read this, without ball radius and length.
ProgramPlace spindlePlace(const control::Channel& channel, const machine::AxisPositions& axes);

/// Moves the ball in coordinates (main, minor, tool axis) of the active program coordinate system. What program and
/// cycle give counts in these coordinates; what tables and machine parameters give (ball radius, SET_UP, DIST) is in mm
/// whatever scaling is active.
///
/// Positions are of the ball centre, one ball radius above the tool tip. A probe that the spindle holds still has its
/// ball where CAL_OF1 and CAL_OF2 say. One that the spindle turns to every touch (TRACK, a ball that stands aside) is
/// driven by the spindle axis, and its pre-positions make room for the ball as it will stand.
class HeidenhainProber {
public:
  HeidenhainProber(control::Channel& channel, const WorkingPlane& plane, const HeidenhainProbe& probe)
      : channel_(channel), plane_(plane), probe_(probe) {}

  const HeidenhainProbe& probe() const { return probe_; }

  BallCentre position() const;

  /// The position with the tool tip on the spindle axis at `tip`.
  BallCentre positionWithTip(const PlanePlace& tip) const;

  /// What `length` mm are in program coordinates along `direction`.
  double inProgram(double length, const PlaneWay& direction) const;
  double ballRadius(const PlaneWay& direction) const { return inProgram(probe_.ballRadius, direction); }
  /// The ball radius along the touch probe axis.
  double poleDepth() const { return ballRadius(PlaneWay::unit(2)); }
  /// How far the spindle axis stands back from surfaces of the working plane in pre-positions.
  double standOff(double extra) const;

  /// Pre-position of a touch: ball radius, SET_UP and `extra` (Q320) in front of the surface. If the spindle turns the
  /// probe, its axis stays behind so that the ball gets there once it is turned to the surface.
  BallCentre prePosition(const PlannedTouch& touch, double extra) const;

  /// Straight to the ball centre position at the positioning feed (FMAX of the probe table, or machine rapid).
  void moveTo(const BallCentre& ballCentre);
  /// Along the touch probe axis only: the south pole of the ball to `height`.
  void moveSouthPoleTo(double height);
  /// Along the touch probe axis only: the ball centre to `height`.
  void moveHeightTo(double height);
  /// Parallel to the working plane only.
  void moveInPlane(const BallCentre& ballCentre);

  /// The positioning logic of the cycles: from below the clearance height first up to it, then in the plane, then down;
  /// from above it in the plane at the present height, then straight down.
  void approach(const BallCentre& ballCentre, double clearanceHeight);

  /// On an arc about `centre` in the plane at the present height to the direction of `to`, turning by `angle` degrees.
  void moveOnArc(const PartPoint& centre, double angle);

  /// From the pre-position: probes towards the surface, returns to the pre-position at rapid traverse. Throws Alarm.
  EvaluatedTouch touch(const PlannedTouch& planned);

  /// From wherever the ball is towards `direction`, at most `distance`; stays at the start of the stroke afterwards.
  EvaluatedTouch stroke(const PlaneWay& direction, double distance, const std::optional<PartPoint>& expected = {});
  /// The same, at most DIST.
  EvaluatedTouch stroke(const PlaneWay& direction) { return stroke(direction, inProgram(probe_.distance, direction)); }

  /// The spindle angle of a touch along `direction`: nothing if the probe is not turned to it.
  std::optional<double> orientationFor(const PlaneWay& direction) const;

  /// Where the ball stands from the spindle axis at the present spindle angle.
  PlaneWay tipOffsetNow() const;

private:
  /// From the tool tip to the ball centre that positions count for.
  PlaneWay ballFromTip() const;
  PlaneWay tipOffsetAt(double spindleAngle) const;
  double directionalRadius(const ProgramWay& direction) const;
  machine::Feed positioning() const;

  control::Channel& channel_;
  WorkingPlane plane_;
  HeidenhainProbe probe_;
};

}  // namespace probewright::probing
