#pragma once

#include <vector>

#include "cycles/sinumerik/context.hpp"

/// How a point is touched: with the calibrated probe as it stands, twice with the spindle reversed, or with the probe
/// turned into the direction of the touch.
namespace probewright::cycles::sinumerik {

/// The 10^4 of S_MVAR.
enum class Method { Standard, SpindleReversal, ProbeAligned };

/// The method of this call. Alarms 61307 (no such digit), 61309 (spindle reversal and alignment need a probe that
/// switches in all directions, type 710), 61372 (they need a spindle that can be positioned).
Method methodOf(Context& context);

/// Refuses to measure with a data set that was never calibrated (61341). Spindle reversal needs none: where there is
/// none, the ball counts as large as the tool data say (61351 if they say nothing).
void requireCalibrationFor(Context& context, Method method);

/// The measuring direction, +1 or -1: S_MD = 1 or 2. Where S_MD is 0 or left out, it leads from where the probe stands
/// to the set value, which is `toSetValue` away along the measuring axis. Alarm 61326 if that is 0.
double measuringDirection(Context& context, double toSetValue);

/// Touches points with one method, S_NMSP times each.
///
/// Spindle reversal: the first point along an axis is touched with the spindle at 180 degrees and again at its position
/// at the start; the mean of both is free of the ball's deviation from the spindle axis, which is known from then on
/// and serves the opposite point. Of the calibration only the effective ball diameter is used.
class Toucher {
public:
  Toucher(Context& context, Method method);

  /// As SinumerikProber::measure. `direction` lies in the plane for all methods but the standard one.
  MeasuredPoint measure(const PartPoint& setpoint, const PlaneWay& direction, double path);

  /// Where measure() leads to: the surface that it would expect with the probe standing at the start position.
  PartPoint expectedFrom(const PlanePlace& start, const PlaneWay& direction, double path) const;

  /// The start position that measure() moves to first.
  PlanePlace startOf(const PartPoint& setpoint, const PlaneWay& direction, double path) const;

  /// Turns the spindle back to where it stood.
  void finish();

private:
  MeasuredPoint measureReversed(const PartPoint& setpoint, const PlaneWay& direction, double path);

  Context& context_;
  Method method_;
  double spindle_;
  struct Deviation {
    PlaneWay direction;
    double along = 0;
  };
  std::vector<Deviation> deviations_;
};

}  // namespace probewright::cycles::sinumerik
