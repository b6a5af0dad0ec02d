#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geometry/primitives.hpp"

/// What a machine is made of: its axes and the chains that carry the workpiece and the tool.
namespace probewright::machine {

/// The most axes that one machine has here: X Y Z A B C U V W.
inline constexpr std::size_t maximumAxes = 9;

/// One value per axis, in the order of MachineDescription::axes, in the machine coordinate system (REF, MCS): mm for
/// linear axes, degrees for rotary axes. Unused places are 0.
struct AxisPositions {
  std::array<double, maximumAxes> values{};
  double& operator[](std::size_t axis) { return values[axis]; }
  double operator[](std::size_t axis) const { return values[axis]; }
  bool operator==(const AxisPositions&) const = default;
};

enum class AxisKind { Linear, Rotary };

/// One axis. Speeds in mm/min or degrees/min, acceleration in mm/s^2 or degrees/s^2.
struct Axis {
  std::string name;  ///< as programs write it: "X", "C", "B1"
  AxisKind kind = AxisKind::Linear;
  double minimum = -1000;
  double maximum = 1000;
  double rapid = 30000;
  double acceleration = 3000;
  bool modulo = false;  ///< a rotary axis without end stops; shown in [0, 360)
};

/// What a control shows of a position of this axis, mm or degrees: of one without end stops the angle within the turn,
/// where less than 1e-9 degrees below 0 count as 0.
double shownPosition(const Axis& axis, double position);

/// One element of a kinematic chain, given at the position where all axes stand at 0, in base coordinates: a fixed
/// offset has no axis; a moving element shifts along `direction` or turns about the line `point` + t*`direction`.
struct ChainElement {
  std::optional<std::size_t> axis;       ///< index into MachineDescription::axes
  Vector3 direction = Vector3::UnitX();  ///< unit vector, base frame at zero position
  Vector3 point = Vector3::Zero();       ///< rotary: a point on the axis of rotation, base frame at zero position
};

/// A machine as a control believes it to be, or as it truly is: the same words describe both.
///
/// Base frame: ISO 841 axes X, Y, Z of the machine, fixed to the bed; its origin is where the spindle nose (tool
/// reference point) stands when all axes read 0. The table frame and the spindle frame coincide with the base frame
/// then. A tool points along -Z of the spindle frame on mills: a tool of length L has its tip at (0, 0, -L).
/// `tableChain` runs from the bed to the table, `spindleChain` from the bed to the spindle; a table that moves in +X of
/// the machine (tool to workpiece) moves against X of the base, so its element's direction is -X.
struct MachineDescription {
  std::string name;
  std::vector<Axis> axes;
  std::vector<ChainElement> tableChain;
  std::vector<ChainElement> spindleChain;
  bool spindleOrients = true;  ///< the main spindle can be positioned (M19, SPOS)
  /// The rotary axis that is the main spindle where that turns the workpiece, as on lathes; none: it carries the tool.
  std::optional<std::size_t> mainSpindle;
  AxisPositions toolChange;  ///< where tools are changed
  double toolChangeSeconds = 6;

  /// The index of the axis called `name` (case matters), or nothing.
  std::optional<std::size_t> axisIndex(std::string_view axisName) const;
};

/// Base from table and base from spindle at the axis positions `q`. Product of exponentials; exact to rounding.
Pose baseFromTable(const MachineDescription& machine, const AxisPositions& q);
Pose baseFromSpindle(const MachineDescription& machine, const AxisPositions& q);

}  // namespace probewright::machine
