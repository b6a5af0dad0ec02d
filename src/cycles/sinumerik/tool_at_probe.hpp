#pragma once

#include <functional>
#include <optional>

#include "cycles/sinumerik/context.hpp"
#include "cycles/sinumerik/tool_probe_data.hpp"
#include "probing/sinumerik_tool_prober.hpp"

/// How CYCLE971 leads the tool of a mill to the tool touch probe: from above, or against a side of its contact.
///
/// Coordinates are (1st, 2nd, 3rd axis of the plane) of the machine or of the workpiece, as the units of S_MVAR say.
namespace probewright::cycles::sinumerik {

/// Refuses a tool that is not parallel to the 3rd axis of the plane, along which it touches from above (61330).
void requireUprightTool(Context& context);

/// The direction, +1 or -1, in which the tool as it stands touches the side that it is on.
double sideOfTool(Context& context, int axis, const ToolProbeField& field);
/// The direction of a touch along an axis of the plane, S_MD: 1 plus, 2 minus, 0 as the tool stands. Else alarm 61326.
double signOfTouch(Context& context, int axis, const ToolProbeField& field);

class ToolAtProbe {
public:
  /// `below`: how far the place that touches a side is above the tool's lower end.
  ToolAtProbe(Context& context, const ToolProbeField& field, double feed, double below = 0);

  probing::SinumerikToolProber& prober() { return prober_; }
  const ToolProbeField& field() const { return field_; }
  /// Where the upper face of the contact is taken to be.
  double top() const { return top_; }
  void setTop(double top) { top_ = top; }
  double radius() const { return radius_; }
  double path() const { return path_; }

  /// To where the next touch begins: before the upper face, the tool's axis at (1st, 2nd axis); before a side, at
  /// `across` in the other axis of the plane.
  void goAbove(const Vector2& place);
  void goBeside(int axis, double sign, double across);
  /// Up to where the tool clears the contact.
  void rise();

  /// From where the tip is along the tool axis or against the side: S_NMSP touches with the spindle standing, as their
  /// mean.
  PlanePlace touch(const PlaneWay& direction);
  /// One touch at another feed, while the spindle turns.
  probing::ToolStrokeTouch touchTurning(const PlaneWay& direction, double feed);

  static PlaneWay down() { return {0, 0, -1}; }
  static PlaneWay along(int axis, double sign) { return sign * PlaneWay::unit(axis); }

private:
  Context& context_;
  ToolProbeField field_;
  probing::SinumerikToolProber prober_;
  double radius_ = 0;
  double path_ = 0;
  double feed_ = 0;
  double below_ = 0;
  double top_ = 0;
};

}  // namespace probewright::cycles::sinumerik
