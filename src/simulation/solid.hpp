#pragma once

#include <optional>

#include "geometry/primitives.hpp"

/// The real things in the working space, as far as a probe can feel them.
namespace probewright::simulation {

/// Where a moving ball first meets a solid. All in the solid's own frame.
struct BallContact {
  double fraction = 0;  ///< of the way from start to end, 0..1
  Vector3 ballCentre = Vector3::Zero();
  Vector3 touchPoint = Vector3::Zero();  ///< on the surface
  Vector3 normal = Vector3::UnitZ();     ///< unit, from the touch point to the ball centre
};

/// An axis-aligned box; empty while minimum > maximum.
struct Bounds {
  Vector3 minimum = Vector3::Constant(1e300);
  Vector3 maximum = Vector3::Constant(-1e300);
};

/// A rigid body that does not change: safe to query from many threads at once.
class Solid {
public:
  virtual ~Solid() = default;

  virtual Bounds bounds() const = 0;

  /// A box about all that can be touched. Where `bounds` follow a tessellation this one is a little larger.
  virtual Bounds reach() const { return bounds(); }

  /// The first contact of a ball of `radius` (> 0) whose centre moves straight from `from` to `to`, or nothing if the
  /// way is free. A ball that overlaps the solid at `from` by more than 1e-9 mm makes contact at fraction 0; one that
  /// merely touches there and moves away or along does not.
  /// Accuracy: 1e-6 mm on surfaces from STEP, IGES and built solids; exact on the triangles of an STL.
  virtual std::optional<BallContact> firstContact(const Vector3& from, const Vector3& to, double radius) const = 0;

  /// The first contact of a capsule (all points within `radius` of the segment from p to p + `axis`) whose end p moves
  /// straight from `from` to `to`: the shaft of a stylus. Touch point to within 0.01 mm; `ballCentre` is p at contact.
  virtual std::optional<BallContact> firstCapsuleContact(const Vector3& from, const Vector3& to, const Vector3& axis,
                                                         double radius) const = 0;

  /// The same for a cylinder with flat ends, p in the middle of one and p + `axis` (not zero) of the other: the body of
  /// a probe, a mill.
  virtual std::optional<BallContact> firstCylinderContact(const Vector3& from, const Vector3& to, const Vector3& axis,
                                                          double radius) const = 0;
};

}  // namespace probewright::simulation
