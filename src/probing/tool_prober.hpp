#pragma once

#include <optional>

#include "control/channel.hpp"
#include "control/working_plane.hpp"

/// How tools are led to the tool touch probe TT on the machine table. What the tool measuring cycles share.
namespace probewright::probing {

using control::WorkingPlane;

/// The tool touch probe as the control knows it, mm and mm/min.
struct ToolTouchProbe {
  PartInMachine place;   ///< middle of the upper edge of its contact
  double size = 40;      ///< diameter or edge length of the contact, along the main axis
  double size2 = 40;     ///< the same along the minor axis
  double depth = 5;      ///< of the tool's lower end below the upper edge in radial probing
  double clearance = 5;  ///< about the contact
  double reach = 50;     ///< longest stroke
  double feed = 300;     ///< of the touch
  double rapid = 2000;   ///< near the contact
};

/// The tip of a tool when the tool touch probe signalled.
struct ToolTouch {
  MachinePlace tip;
  std::optional<double> spindleAngle;  ///< degrees then, where the machine says it
};

/// Leads the tip of a tool to the contact and back. Main, minor and tool axis are those of the working plane. The
/// spindle stands or turns as the caller has ordered.
class ToolProber {
public:
  /// `clearanceHeight`: machine coordinate along the tool axis between the touches; it is raised to the clearance above
  /// the contact where it is lower.
  ToolProber(control::Channel& channel, const WorkingPlane& plane, const ToolTouchProbe& probe, double clearanceHeight);

  /// To the clearance height, unless the tool is above it.
  void rise();
  /// From above onto the contact, the tool's axis beside its middle by `offset` in the plane. Returns the tip at the
  /// signal; the tool is back at the clearance in front of the contact. Throws Alarm.
  ToolTouch touchTop(const Vector2& offset);
  /// Against the side of the contact along main (0) or minor axis (1) in the direction `sense` (+1, -1), the tool's
  /// lower end `depth` below the upper edge, starting `toolRadius` and the clearance in front of it and `aside` along
  /// the other axis from the middle. Ends at the clearance height.
  ToolTouch touchSide(int axis, int sense, double toolRadius, double depth, double aside = 0);
  /// To the clearance height above the middle of the contact.
  void centre();
  /// mm/min, of the touches that follow.
  void setFeed(double feed) { probe_.feed = feed; }
  /// Where the middle of the upper edge is taken to be from now on.
  void setPlace(const PartInMachine& place) { probe_.place = place; }

private:
  void moveTo(const MachinePlace& tip);
  void approach(const MachinePlace& tip);
  ToolTouch stroke(const MachineWay& direction);
  MachinePlace tip() const;
  MachineWay inPlane(int axis, double value) const;

  control::Channel& channel_;
  WorkingPlane plane_;
  ToolTouchProbe probe_;
  double height_ = 0;
};

}  // namespace probewright::probing
