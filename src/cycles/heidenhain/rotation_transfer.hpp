#pragma once

#include <initializer_list>

#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/nominal_position.hpp"

/// What cycles 1410, 1411 and 1420 do with position and rotation: Q1120, Q1121, Q1126. The active preset takes it.
namespace probewright::cycles::heidenhain {

/// Refuses two positions that coincide: `axes` of the coordinates from Q1100 and from Q1103 on say where they lie.
void planeRotationRules(CallRules& call, std::initializer_list<std::uint32_t> axes);

/// Refuses what cannot be done before the probe moves: Q1126 without Q1121, a preset that must not be written.
void requireRotationCycle(Context& context);

/// Refuses to turn the table where its axis does not align what is measured in the working plane (1410, 1411).
void requireAlignmentAxis(Context& context);

/// The rotary axis of the table that is nearest to the workpiece.
struct TableAxis {
  std::size_t index = 0;
  double workpieceTurn = 1;  ///< degrees that the workpiece turns about the tool axis for one degree of the axis
};
/// Nothing if the machine has none or it does not turn about the active tool axis.
std::optional<TableAxis> alignmentAxis(Context& context);

/// A rotation in the working plane, degrees from nominal to actual, and the same as an angle of the table's axis. Where
/// chkTiltingAxes finds that the rotary axes do not agree with the tilt, it is one in the workpiece coordinate system.
struct PlaneRotation {
  bool inWorkpiece = false;
  double nominal = 0, actual = 0, deviation = 0;
  double tableActual = 0, tableDeviation = 0;
  std::optional<TableAxis> axis;
};
/// From the line between two positions. Throws Alarm where they coincide in the working plane.
PlaneRotation planeRotation(Context& context, const MeasuredPosition& first, const MeasuredPosition& second);

/// Q964, Q965, Q994 and Q995.
void addAngles(RotationFindings& findings, const PlaneRotation& rotation);

/// Writes the rotation about the tool axis (1410, 1411) as Q1121 says, the position as Q1120 says (1, 2, 3: mean) and
/// aligns the table as Q1126 says.
void transferPlaneRotation(Context& context, const PlaneRotation& rotation, const MeasuredPosition& first,
                           const MeasuredPosition& second);

/// Writes `rotation` of the I-CS (main, minor, tool axis) as 3-D basic rotation (1420), the position (1, 2, 3, 4: mean)
/// and positions the rotary axes so that the tool stands square to the plane.
void transferSpaceRotation(Context& context, const Matrix3& rotation, std::span<const MeasuredPosition, 3> points);

}  // namespace probewright::cycles::heidenhain
