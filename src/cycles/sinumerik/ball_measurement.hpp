#pragma once

#include "cycles/sinumerik/measuring_method.hpp"

/// Measuring a ball of known size by points on its equator and one on its pole.
namespace probewright::cycles::sinumerik {

struct BallPlan {
  PartPoint centre = {};      ///< where the ball is expected
  double diameter = 0;        ///< set value, mm
  int points = 4;             ///< on the equator: 3 or 4
  bool round = false;         ///< round the equator from point to point; otherwise over the pole each time
  double startAngle = 0;      ///< degrees, of the first point, if `round`
  double step = 90;           ///< degrees, from point to point, if `round`
  bool alignProbe = false;    ///< the spindle turns the probe into each touch
  bool repeat = false;        ///< measure again about the centre found first
  bool findDiameter = false;  ///< one more touch on the equator, towards plus of the 1st axis
  double safeHeight = 0;      ///< of the tool centre point, where the probe passes over the ball
  double path = 0;            ///< S_FA
};

struct MeasuredBall {
  PartPoint centre;
  double diameter = 0;  ///< found, or the set value
};

/// The probe ends over the centre at the safe height. The centre is exact whatever the first touches missed in the
/// plane; its height is computed with the diameter. Without repetition the equator is the expected one: the diameter
/// found is still exact to the second order of the error in height, since the pole is touched before.
MeasuredBall measureBall(Context& context, const BallPlan& plan);

}  // namespace probewright::cycles::sinumerik
