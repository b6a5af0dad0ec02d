#pragma once

/// How a straight move proceeds in time: from standstill at constant acceleration to its speed, and back to standstill.
namespace probewright::simulation {

class MotionProfile {
public:
  /// `length` >= 0, `speed` > 0 per second, `acceleration` > 0 per second squared, all in the same unit of path. A path
  /// too short to reach `speed` turns from accelerating to braking in its middle.
  MotionProfile(double length, double speed, double acceleration);

  double length() const { return length_; }
  double targetSpeed() const { return target_; }  ///< the `speed` asked for, reached or not
  double acceleration() const { return acceleration_; }
  double duration() const;                           ///< seconds
  double speedAt(double travelled) const;            ///< per second
  double secondsAt(double travelled) const;          ///< since the start
  double travelledAt(double seconds) const;          ///< since the start; the length from the end on
  double brakingDistanceAt(double travelled) const;  ///< from the speed there to standstill

private:
  double length_, target_, speed_, acceleration_;
};

}  // namespace probewright::simulation
