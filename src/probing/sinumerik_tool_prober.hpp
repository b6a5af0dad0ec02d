#pragma once

#include <optional>

#include "probing/sinumerik_prober.hpp"

/// How SINUMERIK cycles lead a tool to the tool touch probe and back.
namespace probewright::probing {

/// A touch of the tool touch probe that is to be made.
struct ToolStroke {
  PlanePlace start;             ///< before the contact
  PlaneWay direction;           ///< unit length
  double path = 0;              ///< DFA, mm: the contact is expected there, and sought twice as far
  double feed = 300;            ///< mm/min
  bool mayApproachFast = true;  ///< bit 18 of SD 55740 counts: not while the spindle turns
};

/// The tip at the signal.
struct ToolStrokeTouch {
  PlanePlace tip;
  std::optional<double> spindleAngle;  ///< degrees, where the machine says it
};

/// Moves the tip of a tool in coordinates (1st, 2nd, 3rd axis of the plane) of the system in effect.
class SinumerikToolProber {
public:
  SinumerikToolProber(control::Channel& channel, const control::WorkingPlane& plane, const SinumerikHabits& habits)
      : channel_(channel), plane_(plane), habits_(habits), positioning_(channel, plane, {}, habits) {}

  PlanePlace position() const { return positioning_.position(); }
  /// Straight to the place; watched for collisions (alarm 61302).
  void moveTo(const PlanePlace& tip) { positioning_.moveTo(tip); }
  void moveInPlane(const PlanePlace& tip) { positioning_.moveInPlane(tip); }
  void moveHeightTo(double height) { positioning_.moveHeightTo(height); }
  /// Upwards first, or downwards last: never through what is beside the lower end of the way.
  void approach(const PlanePlace& tip);

  /// From the start, where the tip is, towards the contact and back to the start. Alarm 61301 if nothing is touched.
  ToolStrokeTouch touch(const ToolStroke& stroke);

private:
  control::Channel& channel_;
  control::WorkingPlane plane_;
  SinumerikHabits habits_;
  SinumerikProber positioning_;
};

}  // namespace probewright::probing
