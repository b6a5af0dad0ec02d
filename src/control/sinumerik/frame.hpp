#pragma once

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/diagnostic.hpp"
#include "geometry/primitives.hpp"

/// SINUMERIK frames: a translation, a rotation, scale factors and mirrorings, entered axis by axis.
namespace probewright::control::sinumerik {

/// The parts of a frame that have a component per axis, by the names that system variables give them.
enum class FramePart {
  Translation,  ///< TR, coarse translation: mm, degrees for rotary axes
  Fine,         ///< FI, fine translation, added to the coarse one
  Rotation,     ///< RT, degrees; geometry axes only
  Scale,        ///< SC, neutral 1
  Mirror,       ///< MI, 0 or 1
};
inline constexpr std::array allFrameParts = {FramePart::Translation, FramePart::Fine, FramePart::Rotation,
                                             FramePart::Scale, FramePart::Mirror};

/// "TR", "FI", "RT", "SC", "MI".
std::string_view name(FramePart part);
std::optional<FramePart> framePartOf(std::string_view name);

struct FrameAxis {
  double coarse = 0, fine = 0;
  double rotation = 0;
  double scale = 1;
  bool mirror = false;
  double translation() const { return coarse + fine; }
  bool operator==(const FrameAxis&) const = default;
};

/// One frame. A point p of the child system has in the parent system the coordinates
///
///     t + Rz(rz) * Ry(ry) * Rx(rx) * S * M * p,        t = coarse + fine
///
/// with S the scale factors and M the mirrorings on the diagonal. The angles are RPY angles: about Z, then about the
/// new Y, then about the new X ($MN_FRAME_ANGLE_INPUT_MODE = 1, as delivered). Other axes are shifted, scaled and
/// mirrored one by one.
struct Frame {
  std::array<FrameAxis, 3> geometry;        ///< X, Y, Z
  std::map<std::string, FrameAxis> others;  ///< by axis name in capitals: "A", "C"

  double get(std::string_view axis, FramePart part) const;
  void set(std::string_view axis, FramePart part, double value);
  Vector3 translation() const {
    return {geometry[0].translation(), geometry[1].translation(), geometry[2].translation()};
  }
  bool operator==(const Frame&) const = default;
};

/// 0, 1, 2 for X, Y, Z (either case), nothing for other axes.
std::optional<std::size_t> geometryAxisOf(std::string_view axis);

/// Parent coordinates from child coordinates.
Eigen::Affine3d transform(const Frame& frame);

/// Rz * Ry * Rx from angles about X, Y, Z in degrees.
Matrix3 rotationFromRpy(const Vector3& degrees);

/// The angles about X, Y, Z in degrees with X and Z in (-180, 180] and Y in [-90, 90]. Where Y is +-90 only the
/// difference or the sum of the two others is determined: then X is 0 and Z carries it (within about 1e-7 degrees of
/// the pole). `rotation` must be orthonormal with determinant 1.
Vector3 rpyFromRotation(const Matrix3& rotation);

/// The frame of an affine map, all of the translation in the coarse part. A map with negative determinant mirrors the
/// axes of `mirrors`; an even number of them, or none, means X. Error if the map shears (unequal scale factors before a
/// rotation) or is singular: a frame cannot hold it.
Result<Frame> frameFromTransform(const Eigen::Affine3d& map, std::array<bool, 3> mirrors = {});

/// The chain outer:inner, "inner in the system that outer makes", as the operator ':' does. Fine translations stay fine
/// as long as `outer` neither rotates, scales nor mirrors; otherwise they go into the coarse part of the result (those
/// of `outer` stay fine). Errors as frameFromTransform.
Result<Frame> chain(const Frame& outer, const Frame& inner);

struct AxisValue {
  std::string axis;
  double value = 0;
};

/// What CTRANS, CFINE, CROT, CROTS, CSCALE and CMIRROR return; CMIRROR takes axes and ignores the values. CROTS takes
/// two solid angles, in the order X, Y or Y, Z or Z, X (or one, as CROT): the axis named first stays in its coordinate
/// plane (new X in ZX, new Y in XY, new Z in YZ) and the second angle is that of the plane's trace. Errors: an unknown
/// function, an axis named twice, a rotation about an axis that isn't a geometry axis, a scale factor 0, solid angles
/// that give no plane.
Result<Frame> frameFunction(std::string_view function, std::span<const AxisValue> arguments);

/// The frame as an expression that reads back the same: "CTRANS(X,10,Y,5):CROT(Z,3)"; "CTRANS()" if it is neutral.
std::string frameExpression(const Frame& frame);

}  // namespace probewright::control::sinumerik
