#pragma once

#include <array>
#include <optional>

#include "control/sinumerik/tool_carrier.hpp"

/// What CYCLE996 makes of the places of a ball: lines of rotary axes through three points each, and the vectors of a
/// swivel data set of these lines. Lengths in mm, angles in degrees, vectors in machine coordinates.
namespace probewright::cycles::sinumerik {

using control::sinumerik::ToolCarrier;

/// Three places of the ball about one rotary axis.
struct RotaryAxisMeasurement {
  /// Of the ball's centre: the machine's X, Y, Z less `tool`.
  std::array<Vector3, 3> ball{Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
  std::array<double, 3> angle{};   ///< of the rotary axis, from the basic setting
  Vector3 tool = Vector3::Zero();  ///< from the ball of the probe to the tool adapter, basic setting
  double otherAngle = 0;           ///< where the other rotary axis stood, from the basic setting
};

/// The axis of rotation that the three places tell.
struct RotaryLine {
  Vector3 direction = Vector3::UnitZ();  ///< unit; the ball turns right-handed about it with the axis
  Vector3 centre = Vector3::Zero();      ///< of the circle through the places
  Vector3 radius = Vector3::Zero();      ///< from there to the ball with the axis in the basic setting
  double leastAngle = 0;  ///< degrees, the least interior angle of the triangle of the places: 60 at best
  double residual = 0;    ///< mm: how far the angles leave the places from where they were measured, root mean square
};

/// Exact for exact places, whatever the order of the angles. Nothing if the places lie on one line, to about 1e-6 mm.
std::optional<RotaryLine> rotaryLine(const RotaryAxisMeasurement& measured);

/// Where on its line a vector to a rotary axis ends.
struct Normalisation {
  int along = -1;    ///< 0, 1, 2: at the given X, Y or Z; -1: in the plane of the circle
  double value = 0;  ///< mm
};

enum class Chain { Closed, Open };

struct KinematicsEvaluation {
  ToolCarrier carrier;  ///< the data set with its new vectors; basic settings and names as before
  std::array<Vector3, 2> linear{Vector3::Zero(), Vector3::Zero()};  ///< to the axes, not normalised
};

/// The vector from the tool adapter (an axis of the head) or from the machine's zero point (an axis of the table) to a
/// point of the axis, as it is not normalised and with the other rotary axis where it stood.
Vector3 linearVector(const RotaryLine& line, const RotaryAxisMeasurement& measured, bool inHead);

/// The data set of the lines of its one or two rotary axes. `before` has the kind, and the vectors that an open chain
/// keeps (head: I1, table: I4, mixed: both). Nothing if an axis is normalised along a direction that it turns about at
/// right angles: its line does not reach the value.
std::optional<KinematicsEvaluation> evaluateKinematics(const ToolCarrier& before,
                                                       const std::array<std::optional<RotaryLine>, 2>& lines,
                                                       const std::array<RotaryAxisMeasurement, 2>& measured,
                                                       const std::array<Normalisation, 2>& normalisation, Chain chain);

}  // namespace probewright::cycles::sinumerik
