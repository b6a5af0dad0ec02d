#pragma once

#include <array>
#include <optional>

#include "control/scoped.hpp"
#include "cycles/sinumerik/context.hpp"
#include "cycles/sinumerik/machine_coordinates.hpp"
#include "cycles/sinumerik/tool_probe_data.hpp"

/// The tool that CYCLE982 leads to the tool touch probe, and how it stands in
/// the plane.
namespace probewright::cycles::sinumerik {

enum class LatheToolKind { Turning, Mill, Drill };

/// The active tool in the system that the probe is measured in: while it lives,
/// positions of the channel are those of the tool's tip there, and no
/// transformation acts.
///
/// Vectors count along the 1st and 2nd axis of the plane. Where a rotary axis
/// of the head has turned the tool and bit 16 of MD 51740 says that tool
/// carriers count, so do tip, nose and lengths turn.
class LatheTool {
public:
  /// Refuses tools that cannot be measured: 61314 (type), 61315 (cutting edge
  /// position), 61329 (angle of the head or of the tool spindle), 61319 (not in
  /// G18 with a tool carrier).
  LatheTool(Context& context, ProbeSystem system);

  LatheToolKind kind() const { return kind_; }
  /// A calibrating tool, whose ball reaches every side of the contact.
  bool calibrates() const { return type_ == 580; }
  /// True where the carrier counts and has turned the tool.
  bool onCarrier() const { return carrier_; }
  double radius() const { return radius_; }
  double cornerRadius() const { return cornerRadius_; }
  const control::WorkingPlane& plane() const { return plane_; }
  /// $TC_DP2.
  int position() const { return position_; }

  /// From the tip to the centre of the nose of a turning tool.
  Vector2 nose() const;
  /// Where the tip of a turning tool points: of the cutting edge position as it
  /// stands now; not of unit length.
  Vector2 pointing() const;
  /// The axis of the plane that a mill or drill lies along, 0 or 1; nothing:
  /// S_MVAR tells.
  std::optional<int> axis() const { return axis_; }
  /// From the tip towards the holder along an axis of the plane: -1, 0, 1.
  double holder(int axis) const;

  /// By how much lengths 1, 2, 3 are wrong if the tip stood `deviation` beside
  /// where it was believed to be; nothing for a length that the axes that were
  /// measured say nothing of.
  std::array<std::optional<double>, 3> lengths(const std::array<std::optional<double>, 2>& deviation) const;

private:
  Vector2 inPlane(const Vector3& ofTool) const;
  Vector3 ofEdgePosition() const;
  void turnWithCarrier();
  void requireMultiples(double angle, double step, const char* what) const;

  Context& context_;
  FramesAgain again_;  // goes last of the two
  control::Scoped<bool> suppressed_;
  control::WorkingPlane plane_;
  LatheToolKind kind_ = LatheToolKind::Turning;
  int type_ = 0, position_ = 0;
  double radius_ = 0, cornerRadius_ = 0;
  std::array<int, 3> lengthAxes_ = {};
  std::optional<int> axis_;
  bool carrier_ = false;
  Matrix3 programFromTool_ = Matrix3::Identity();  ///< X, Y, Z
};

}  // namespace probewright::cycles::sinumerik
