#pragma once

#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_Direction.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TCollection_HAsciiString.hxx>
#include <optional>

#include "geometry/primitives.hpp"

/// Points and directions of STEP as vectors and back, in the units of the file; nothing where an entity does not say
/// enough.
namespace probewright::simulation {

inline Handle(TCollection_HAsciiString) noName() { return new TCollection_HAsciiString(""); }

inline std::optional<Vector3> vectorOf(const Handle(StepGeom_CartesianPoint) & point) {
  if (point.IsNull() || point->NbCoordinates() < 3) return std::nullopt;
  return Vector3(point->CoordinatesValue(1), point->CoordinatesValue(2), point->CoordinatesValue(3));
}

inline std::optional<Vector3> unitOf(const Handle(StepGeom_Direction) & direction) {
  if (direction.IsNull() || direction->NbDirectionRatios() < 3) return std::nullopt;
  const Vector3 ratios(direction->DirectionRatiosValue(1), direction->DirectionRatiosValue(2),
                       direction->DirectionRatiosValue(3));
  if (!(ratios.norm() > 1e-12)) return std::nullopt;
  return ratios.normalized();
}

inline Handle(TColStd_HArray1OfReal) arrayOf(const Vector3& v) {
  const Handle(TColStd_HArray1OfReal) array = new TColStd_HArray1OfReal(1, 3);
  for (int i = 1; i <= 3; ++i)
    array->SetValue(i, v[i - 1]);
  return array;
}

inline Handle(StepGeom_CartesianPoint) pointAt(const Vector3& place) {
  const Handle(StepGeom_CartesianPoint) point = new StepGeom_CartesianPoint;
  point->Init(noName(), arrayOf(place));
  return point;
}

inline Handle(StepGeom_Direction) along(const Vector3& unit) {
  const Handle(StepGeom_Direction) direction = new StepGeom_Direction;
  direction->Init(noName(), arrayOf(unit));
  return direction;
}

}  // namespace probewright::simulation
