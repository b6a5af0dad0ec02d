#pragma once

#include <vector>

#include "simulation/cutting_edges.hpp"

/// How near pieces of cutting edges come to a solid. All poses are those of the edges' frame in the solid's.
namespace probewright::simulation {

/// The point of the pieces that comes nearest. Of turned pieces that are more than 0.2 mm away, a gap that is not wider
/// than the true one.
EdgeDistance nearestOf(const std::vector<EdgePiece>& pieces, const Pose& pose, const DistanceSolid& solid);

/// The same of the flank of an insert, whose lines move evenly from `front` through `behind`, 1 mm across the insert's
/// plane, to `depth`.
EdgeDistance nearestOfFlank(const EdgePiece& front, const EdgePiece& behind, double depth, const Pose& pose,
                            const DistanceSolid& solid);

/// At most as far as the body that the pieces turn out is from the solid; short of it by 1e-4 mm and a hundredth where
/// a plane parts the two, by more where none does.
double leastGapOf(const std::vector<EdgePiece>& turned, const Pose& pose, const DistanceSolid& solid);

/// The border of the half space with this outward normal that the solid just fits into, to 1e-5 mm and never too near.
Plane planeBeside(const DistanceSolid& solid, const Vector3& normal);

/// All that a turn about an axis, by up to `angle` radians in its sense, leads behind a plane. Its distance is how far
/// from the plane a point stays on such a turn.
class TurnsBehindPlane final : public DistanceSolid {
public:
  TurnsBehindPlane(const Plane& plane, const Line& axis, double angle) : plane_(plane), axis_(axis), angle_(angle) {}
  Bounds bounds() const override { return HalfSpace(plane_).bounds(); }
  ClosestPoint closest(const Vector3& point) const override;

private:
  Plane plane_;
  Line axis_;
  double angle_;
};

/// A value along a curve and how fast it changes.
struct Slope {
  double at = 0, value = 0, slope = 0;
};

/// The least of what `along` says of places from 0 to 1: the least of `intervals` + 1 places and of the bottoms between
/// them. Exact to about 1e-12 where it has one bottom in each interval.
template <class Along>
Slope leastAlong(const Along& along, int intervals) {
  Slope low = along(0.0), least = low;
  for (int i = 1; i <= intervals; ++i) {
    const Slope high = along(static_cast<double>(i) / intervals);
    if (high.value < least.value) least = high;
    if (low.slope < 0 && high.slope > 0) {
      if (const Slope found = bottomBetween(along, low, high); found.value < least.value) least = found;
    }
    low = high;
  }
  return least;
}

/// The bottom between a place where the value falls and one where it rises.
template <class Along>
Slope bottomBetween(const Along& along, Slope low, Slope high) {
  constexpr double enough = 1e-12;
  Slope best = low.value < high.value ? low : high;
  double weightLow = 1, weightHigh = 1;  // of a false position: halved at an end that stays
  for (int i = 0; i < 60; ++i) {
    // Where the tangents meet, a convex value cannot be less.
    const double crossing =
        (low.value - high.value - low.slope * low.at + high.slope * high.at) / (high.slope - low.slope);
    if (best.value - (low.value + low.slope * (crossing - low.at)) < enough) break;
    const double fromLow = weightLow * low.slope, fromHigh = weightHigh * high.slope;
    double at = (low.at * fromHigh - high.at * fromLow) / (fromHigh - fromLow);
    if (i % 4 == 3 || !(at > low.at && at < high.at)) at = 0.5 * (low.at + high.at);
    if (!(at > low.at && at < high.at)) break;
    const Slope middle = along(at);
    if (middle.value < best.value) best = middle;
    if (middle.slope == 0) break;
    if (middle.slope < 0) {
      low = middle;
      weightLow = 1;
      weightHigh *= 0.5;
    } else {
      high = middle;
      weightHigh = 1;
      weightLow *= 0.5;
    }
  }
  return best;
}

}  // namespace probewright::simulation
