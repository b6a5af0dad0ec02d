#pragma once

#include <vector>

#include "geometry/primitives.hpp"

/// How far something that follows from several touches can be from where it is, when each touch i shifts by s_i, at
/// most S_i, from what each touch does alone.
///
/// Let f be a coordinate of a later move, g its derivatives by the touches, H the second ones. What the proof measures
/// of touch i alone, to the worse of both sides, is
///     d_i = max(|f(S_i) - f(0)|, |f(-S_i) - f(0)|) = |g_i| S_i + |H_ii| S_i^2 / 2
/// but for terms of the third order, for of a + b and -a + b the larger one is |a| + |b|. Of all touches together
///     |f(s) - f(0)| <= sum |g_i| S_i + sum |H_ii| S_i^2 / 2 + sum over pairs |H_ij| S_i S_j
///                   <= sum d_i + sum over pairs |H_ij| (S_i^2 + S_j^2) / 2.
/// So what each touch does alone misses the products of pairs, half of which each of the two answers for. They are
/// bounded by
///     (curvature - 1) d_i + S_i^2 / size,
/// where size is half of the least distance between two touches of the cycle, for round features no more than
/// acrossArc(), for these reasons:
///  - Lines, circles and planes through touches, their crossings and angles have no length but the distances of the
///  touches and
///    the lever L by which a later move is away. Derivatives of directions are some |g_i| = L / distance, second ones
///    L / distance^2; those of centres 1 and 1 / distance.
///  - Where g_i is not small, sum over j of |H_ij| S_j / 2 is at most |g_i| times n S / distance or so. S is at most
///    nearEnough * size = distance / 20, which leaves it below a quarter of |g_i| for the touches of these cycles.
///  - The middle of a circle by touches on a short arc follows from how far they are off a straight line, acrossArc():
///  derivatives
///    grow with its inverse. So it is the length that touches must be small against.
///  - Where g_i vanishes for reasons of symmetry (the way along an edge, the radius of a circle against a shift
///  across), H_ij is
///    not larger than 2 / distance = 1 / size in sum.
/// The proof compares places, not coordinates: where H stands square to g, the larger of |a + b| and |-a + b| is a
/// little less than their sum, and the quarter answers for what |H_ii| leaves, S / distance of |g_i| S_i at most, as
/// well. The last three reasons are estimates, not proofs: tests/survival/curvature_test.cpp holds the bound
/// against the fits themselves, with touches at all spacings that cycles have, shifted to all corners. There are terms
/// of the third order in it too.
namespace probewright::survival {

inline constexpr double curvature = 1.25;  ///< of what one touch does alone
inline constexpr double nearEnough =
    0.1;  ///< the most that a touch may shift, over the size, where anything depends on it

/// How far touches on the surface of a round feature are off the line through the two that are farthest apart. A large
/// number for touches that come from no more than two directions and their opposites: of edges, corners and widths.
double acrossArc(const std::vector<Vector3>& touches, const std::vector<Vector3>& ways);

}  // namespace probewright::survival
