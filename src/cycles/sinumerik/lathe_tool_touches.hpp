#pragma once

#include <vector>

#include "cycles/sinumerik/lathe_tool.hpp"
#include "probing/sinumerik_tool_prober.hpp"

/// How CYCLE982 leads the tip of a tool round the contact of a tool touch
/// probe, axis by axis, and what it touches.
namespace probewright::cycles::sinumerik {

/// Which angles of the spindle a place is touched with: the digits 10^2 and
/// 10^6 of S_MVAR.
struct SpindleAngles {
  bool positions = false;  ///< to the first angle before anything is touched
  bool reverses = false;   ///< each place is touched at both angles
  double first = 0;        ///< degrees
  double second = 0;
};

class LatheToolTouches {
public:
  /// `axis` 0 and 1 are the axes of the plane, `direction` is +1 or -1,
  /// everywhere.
  LatheToolTouches(Context& context, const LatheTool& tool, const ToolProbeField& field, double feed,
                   SpindleAngles angles);

  const ToolProbeField& field() const { return field_; }
  double path() const { return path_; }
  /// The tip.
  Vector2 at() const { return prober_.position().inPlane(); }
  double middle(int axis) const { return field_.centre(axis); }
  double trigger(int axis, double direction) const { return field_.trigger(axis, direction); }
  /// Which way the middle of the contact lies. Alarm 61326 on it.
  double towardsMiddle(int axis) const;

  /// Along one axis; watched for collisions.
  void go(int axis, double place);
  /// Alarm 61332 if a body that reaches `radius` round a point, which moves
  /// along `axis` from `from` to `place`, meets the contact.
  void requireWay(int axis, const Vector2& from, double place, double radius);
  /// From where the tip is, the measuring path and as far again: the tip at the
  /// signal, along the axis. The mean of S_NMSP touches, and of both angles of
  /// the spindle. The tip is back afterwards.
  double touch(int axis, double direction);
  /// Back the way that the tip has come.
  void back();

private:
  double touchOnce(int axis, double direction);
  void positionSpindle(double degrees);

  Context& context_;
  ToolProbeField field_;
  probing::SinumerikToolProber prober_;
  double feed_, path_;
  SpindleAngles angles_;
  std::vector<Vector2> trail_;
};

}  // namespace probewright::cycles::sinumerik
