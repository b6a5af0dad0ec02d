#pragma once

#include "geometry/primitives.hpp"

/// Places and ways whose types say along which axes they count and what is there. A program coordinate cannot be taken
/// for a machine coordinate, nor the centre of the ball for the point that it touches: what leads from one to the other
/// has a name (Channel, WorkingPlane, ballAt, partAt, tipAt). vector() gives the plain numbers for mathematics, and
/// back into a type leads only its constructor.
namespace probewright::places {

/// The axes that coordinates count along. Positions of the machine's axes are another thing: machine::AxisPositions.
enum class Axes {
  Machine,  ///< X, Y, Z of the machine coordinate system, before the frame of the program is applied
  Program,  ///< X, Y, Z of the active program (workpiece) coordinate system
  Plane,    ///< the same system, counted along main, minor and tool axis (1st, 2nd, 3rd axis) of the working plane
};

/// What is at a place.
enum class Of {
  Tip,   ///< the controlled point: the tip of the tool, as its length defines it
  Ball,  ///< the centre of the ball of the touch probe
  Part,  ///< a point of the workpiece: on its surface, or the centre of one of its features
};

/// A direction or a distance with its direction, mm.
template <Axes axes>
class Way {
public:
  Way() = default;
  Way(double first, double second, double third) : numbers_(first, second, third) {}
  explicit Way(const Vector3& numbers) : numbers_(numbers) {}
  /// The unit vector along axis 0, 1 or 2.
  static Way unit(Eigen::Index axis) { return Way(Vector3::Unit(axis)); }

  const Vector3& vector() const { return numbers_; }
  double operator[](Eigen::Index axis) const { return numbers_[axis]; }
  double& operator[](Eigen::Index axis) { return numbers_[axis]; }
  double x() const { return numbers_.x(); }
  double y() const { return numbers_.y(); }
  double z() const { return numbers_.z(); }
  /// What lies in the working plane: along main and minor axis.
  Vector2 inPlane() const requires(axes == Axes::Plane) { return numbers_.head<2>(); }

  double norm() const { return numbers_.norm(); }
  double dot(const Way& other) const { return numbers_.dot(other.numbers_); }
  Way cross(const Way& other) const { return Way(numbers_.cross(other.numbers_)); }
  Way normalized() const { return Way(numbers_.normalized()); }

  Way operator-() const { return Way(-numbers_); }
  friend Way operator+(const Way& a, const Way& b) { return Way(a.numbers_ + b.numbers_); }
  friend Way operator-(const Way& a, const Way& b) { return Way(a.numbers_ - b.numbers_); }
  friend Way operator*(const Way& way, double factor) { return Way(way.numbers_ * factor); }
  friend Way operator*(double factor, const Way& way) { return Way(factor * way.numbers_); }
  friend Way operator/(const Way& way, double divisor) { return Way(way.numbers_ / divisor); }

private:
  Vector3 numbers_ = Vector3::Zero();
};

/// Where something is, mm. Ways lead from place to place; two places of one kind have a way between them.
template <Axes axes, Of of>
class Place {
public:
  Place() = default;
  Place(double first, double second, double third) : numbers_(first, second, third) {}
  explicit Place(const Vector3& numbers) : numbers_(numbers) {}

  const Vector3& vector() const { return numbers_; }
  double operator[](Eigen::Index axis) const { return numbers_[axis]; }
  double& operator[](Eigen::Index axis) { return numbers_[axis]; }
  double x() const { return numbers_.x(); }
  double y() const { return numbers_.y(); }
  double z() const { return numbers_.z(); }
  /// The coordinates along main and minor axis.
  Vector2 inPlane() const requires(axes == Axes::Plane) { return numbers_.head<2>(); }

  friend Place operator+(const Place& place, const Way<axes>& way) { return Place(place.numbers_ + way.vector()); }
  friend Place operator-(const Place& place, const Way<axes>& way) { return Place(place.numbers_ - way.vector()); }
  friend Way<axes> operator-(const Place& to, const Place& from) { return Way<axes>(to.numbers_ - from.numbers_); }
  Place& operator+=(const Way<axes>& way) { return *this = *this + way; }
  Place& operator-=(const Way<axes>& way) { return *this = *this - way; }

private:
  Vector3 numbers_ = Vector3::Zero();
};

/// The tip, the centre of the ball or the point of the part that is at another place, or lies `way` from it.
template <Axes axes, Of of>
Place<axes, Of::Tip> tipAt(const Place<axes, of>& place) {
  return Place<axes, Of::Tip>(place.vector());
}
template <Axes axes, Of of>
Place<axes, Of::Ball> ballAt(const Place<axes, of>& place) {
  return Place<axes, Of::Ball>(place.vector());
}
template <Axes axes, Of of>
Place<axes, Of::Part> partAt(const Place<axes, of>& place) {
  return Place<axes, Of::Part>(place.vector());
}
template <Axes axes, Of of>
Place<axes, Of::Tip> tipAt(const Place<axes, of>& from, const Way<axes>& way) {
  return Place<axes, Of::Tip>(from.vector() + way.vector());
}
template <Axes axes, Of of>
Place<axes, Of::Ball> ballAt(const Place<axes, of>& from, const Way<axes>& way) {
  return Place<axes, Of::Ball>(from.vector() + way.vector());
}
template <Axes axes, Of of>
Place<axes, Of::Part> partAt(const Place<axes, of>& from, const Way<axes>& way) {
  return Place<axes, Of::Part>(from.vector() + way.vector());
}

}  // namespace probewright::places

namespace probewright {

using MachineWay = places::Way<places::Axes::Machine>;
using ProgramWay = places::Way<places::Axes::Program>;
using PlaneWay = places::Way<places::Axes::Plane>;

using MachinePlace = places::Place<places::Axes::Machine, places::Of::Tip>;
using ProgramPlace = places::Place<places::Axes::Program, places::Of::Tip>;
using PlanePlace = places::Place<places::Axes::Plane, places::Of::Tip>;

using PartInMachine = places::Place<places::Axes::Machine, places::Of::Part>;
using PartInProgram = places::Place<places::Axes::Program, places::Of::Part>;

/// As cycles and probers count: along the axes of the working plane.
using BallCentre = places::Place<places::Axes::Plane, places::Of::Ball>;
using PartPoint = places::Place<places::Axes::Plane, places::Of::Part>;

}  // namespace probewright
