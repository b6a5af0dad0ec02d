#pragma once

#include <array>
#include <optional>

#include "control/working_plane.hpp"
#include "geometry/primitives.hpp"
#include "machine/description.hpp"

/// The chain of coordinate systems of a HEIDENHAIN control: machine, preset with basic rotation, datum shift, mirror
/// image, rotation and scaling, tilted working plane, and the same transformations once more in the tilted plane.
namespace probewright::control::heidenhain {

/// The active preset: origin in machine coordinates (mm), basic rotation as space angles (degrees) and the offsets of
/// the rotary axes (degrees, by axis index).
struct ActivePreset {
  int row = 0;
  Vector3 origin = Vector3::Zero();
  Vector3 spaceAngles = Vector3::Zero();  ///< SPA, SPB, SPC; SPC alone is the classic basic rotation
  machine::AxisPositions rotaryOffset;
};

/// Coordinate transformations of one level, in the order in which they act.
struct Transformations {
  Vector3 shift = Vector3::Zero();        ///< cycle 7, TRANS DATUM
  std::array<bool, 3> mirror{};           ///< cycle 8: X, Y, Z
  double rotation = 0;                    ///< cycle 10, degrees in the working plane
  Vector3 scale = Vector3::Ones();        ///< cycles 11 and 26
  Vector3 scaleCentre = Vector3::Zero();  ///< cycle 26
  machine::AxisPositions axisShift;       ///< cycle 7, TRANS DATUM: axes beside X, Y, Z, by axis index
  unsigned mirroredAxes = 0;              ///< cycle 8: rotary and parallel axes, a bit by axis index
  bool active() const;
  Eigen::Affine3d matrix(const WorkingPlane& plane) const;
  /// The directions of `matrix` without the scaling: orthogonal, with the determinant -1 if it mirrors.
  Matrix3 directions(const WorkingPlane& plane) const;
};

struct Coordinates {
  WorkingPlane plane;
  ActivePreset preset;
  Transformations workpiece;     ///< in the workpiece coordinate system W-CS
  std::optional<Matrix3> tilt;   ///< PLANE, cycle 19: the tilted plane's axes in the workpiece coordinate system
  bool tiltIsAxial = false;      ///< the tilt was defined by axis angles (PLANE AXIAL)
  Transformations workingPlane;  ///< in the working plane coordinate system WPL-CS, while a tilt is active
  /// M144: positions are those of the tip on the workpiece, though nothing moves with the rotary axes by itself.
  bool tiltedAxesInPosition = false;
  /// What M94 has taken from the readings of rotary axes: whole turns in degrees, by axis index.
  machine::AxisPositions turnsTaken;

  /// Where new transformations go: the tilted plane if there is one.
  Transformations& current() { return tilt ? workingPlane : workpiece; }
  const Transformations& current() const { return tilt ? workingPlane : workpiece; }

  /// Program position = machine position - offset, of axes beside X, Y, Z, by axis index: the preset's offset, the
  /// datum shifts and the turns that M94 has taken.
  machine::AxisPositions axisOffset() const;
  /// -1 for axes beside X, Y, Z that are mirrored, by axis index: program position = sign * (machine - offset).
  double axisSign(std::size_t axis) const;

  /// Machine from the workpiece system of the preset, basic rotation included.
  Pose machineFromPreset() const;
  /// Machine from the coordinates that programs use.
  Eigen::Affine3d machineFromProgram() const;
};

/// The rotation by space angles: about the fixed axes X, then Y, then Z, as A, B, C of PLANE SPATIAL are seen from
/// the machine; equal to turning about Z, then the new Y, then the new X.
Matrix3 rotationFromSpaceAngles(const Vector3& degrees);
/// The space angles of a rotation, B within [-90, 90]; A = 0 where B is +-90.
Vector3 spaceAnglesFromRotation(const Matrix3& rotation);

}  // namespace probewright::control::heidenhain
