#pragma once

#include <vector>

#include "geometry/places.hpp"

/// Where a feature is touched: points and directions from nominal geometry, before any control's positioning habits.
/// Coordinates: 1st axis, 2nd axis of the working plane, touch probe axis; mm and degrees.
namespace probewright::probing {

/// A point expected on the surface and the direction in which the ball runs into it (unit length).
struct PlannedTouch {
  PartPoint surface;
  PlaneWay direction = PlaneWay::unit(0);
};

enum class Side { Inside, Outside };

constexpr double outwards(Side side) { return side == Side::Inside ? 1.0 : -1.0; }

/// `count` points on a circle about `centre`, the first at `startAngle` from the 1st axis, `step` apart (negative:
/// clockwise). Inside touches run outwards, outside touches inwards.
std::vector<PlannedTouch> planCircle(const PartPoint& centre, double diameter, double startAngle, double step,
                                     int count, Side side);

/// The four sides of a rectangle parallel to the axes, in the middle of each: 1st axis +, 2nd axis +, 1st axis -, 2nd
/// axis -.
std::vector<PlannedTouch> planRectangle(const PartPoint& centre, double length1, double length2, Side side);

/// The two walls of a slot or ridge whose width lies in the direction `angle` from the 1st axis: first the wall in that
/// direction, then the other.
std::vector<PlannedTouch> planWidth(const PartPoint& centre, double width, double angle, Side side);

/// The unit vector at `angle` degrees from the 1st axis in the working plane.
PlaneWay directionAt(double angle);

/// The unit vector along axis 0, 1 or 2, against it if `sign` < 0.
PlaneWay axisDirection(int axis, double sign);

}  // namespace probewright::probing
