#pragma once

#include "simulation/solid.hpp"

/// Solids with closed-form distance: for gauges (rings, spheres, blocks) and for tests that need an exact truth.
///
/// All ball contacts are exact to rounding (about 1e-11 mm for coordinates below 1 m); contacts of capsules and
/// cylinders to 1e-3 mm. A ball whose path enters a solid by less than 1e-9 mm counts as passing along it.
namespace probewright::simulation {

/// The nearest point of a surface. `distance` is negative inside the material.
struct ClosestPoint {
  double distance = 0;
  Vector3 point = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();  ///< outward, unit
};

/// A solid that knows the exact distance of a point outside it, and inside it near the surface.
class DistanceSolid : public Solid {
public:
  virtual ClosestPoint closest(const Vector3& point) const = 0;

  std::optional<BallContact> firstContact(const Vector3& from, const Vector3& to, double radius) const override;
  std::optional<BallContact> firstCapsuleContact(const Vector3& from, const Vector3& to, const Vector3& axis,
                                                 double radius) const override;
  std::optional<BallContact> firstCylinderContact(const Vector3& from, const Vector3& to, const Vector3& axis,
                                                  double radius) const override;
};

/// All points behind a plane whose normal points out of the material.
class HalfSpace final : public DistanceSolid {
public:
  explicit HalfSpace(const Plane& plane) : plane_(plane) {}
  Bounds bounds() const override;
  ClosestPoint closest(const Vector3& point) const override;
  std::optional<BallContact> firstContact(const Vector3& from, const Vector3& to, double radius) const override;

private:
  Plane plane_;
};

/// A box along the axes of its own frame, from corner to corner.
class Box final : public DistanceSolid {
public:
  Box(const Vector3& minimum, const Vector3& maximum) : minimum_(minimum), maximum_(maximum) {}
  Bounds bounds() const override { return {minimum_, maximum_}; }
  ClosestPoint closest(const Vector3& point) const override;

private:
  Vector3 minimum_, maximum_;
};

/// A ball of material: a calibration sphere without its shaft.
class SolidSphere final : public DistanceSolid {
public:
  SolidSphere(const Vector3& centre, double radius) : centre_(centre), radius_(radius) {}
  Bounds bounds() const override;
  ClosestPoint closest(const Vector3& point) const override;

private:
  Vector3 centre_;
  double radius_;
};

/// An endless round bar along Z through `centre`.
class EndlessBar final : public DistanceSolid {
public:
  EndlessBar(const Vector2& centre, double radius) : centre_(centre), radius_(radius) {}
  Bounds bounds() const override;
  ClosestPoint closest(const Vector3& point) const override;

private:
  Vector2 centre_;
  double radius_;
};

/// Material everywhere but in an endless round bore along Z through `centre`.
class EndlessBore final : public DistanceSolid {
public:
  EndlessBore(const Vector2& centre, double radius) : centre_(centre), radius_(radius) {}
  Bounds bounds() const override;
  ClosestPoint closest(const Vector3& point) const override;

private:
  Vector2 centre_;
  double radius_;
};

/// A round bar along Z from z = `bottom` to z = `top` about the origin: a spigot.
class RoundBar final : public DistanceSolid {
public:
  RoundBar(double radius, double bottom, double top) : radius_(radius), bottom_(bottom), top_(top) {}
  Bounds bounds() const override;
  ClosestPoint closest(const Vector3& point) const override;

private:
  double radius_, bottom_, top_;
};

/// A plate filling z <= 0 out to `outerRadius` with a round through hole about the Z axis; with a large outer radius a
/// hole in a face, with a small one and a `bottom` a setting ring.
class Ring final : public DistanceSolid {
public:
  Ring(double holeRadius, double outerRadius, double bottom)
      : holeRadius_(holeRadius), outerRadius_(outerRadius), bottom_(bottom) {}
  Bounds bounds() const override;
  ClosestPoint closest(const Vector3& point) const override;

private:
  double holeRadius_, outerRadius_, bottom_;
};

}  // namespace probewright::simulation
