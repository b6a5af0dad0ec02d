#pragma once

#include <vector>

#include "geometry/primitives.hpp"

/// How far something that follows from several touches can be from where it is, when each touch i shifts by s_i, at
/// most S_i, from what each touch does alone.
///
/// Let f be a place of a later move, g_i(s) its derivative by touch i. What the proof measures of touch i alone, to the
/// worse of both sides, is d_i = max(|f(S_i) - f(0)|, |f(-S_i) - f(0)|). Of two vectors a + b and -a + b one is at
/// least as long as a; with a half of f(S_i) - f(-S_i) that is
///     d_i >= |m_i| S_i,   m_i the mean of g_i while touch i alone goes from -S_i to S_i.
/// Of all touches together, along the straight way from 0 to s,
///     |f(s) - f(0)| <= sum of S_i |mean of g_i on the way| <= sum of d_i + e_i S_i,
/// where e_i is the most that g_i can differ between two points of the ranges. No terms are left out. So the bound
///     |f(s) - f(0)| <= sum of curvature * d_i + S_i^2 / size
/// holds wherever
///     e_i <= (curvature - 1) |m_i| + S_i / size.                                                         (1)
/// What a cycle computes has no length but those between its touches and the levers of later moves, so the derivatives
/// change by a share that follows from q = S / size alone; nearEnough is the most that all q of a program may add up
/// to.
///  - One coordinate, the middle of two, a width: f is linear, e = 0.
///  - The direction of a line through two touches a distance L apart, both across it: it turns by no more than 2 S / L,
///    and size <= 0.45 L makes that 0.9 q. The part of g that turns with it, v / L with a lever v, changes by this
///    share and by its square in length: 0.9 q + 0.81 q^2 <= 0.1. Where the touch also shifts f itself, that part is at
///    most 1 and does not change, so the other one is at most |g| + 1: e <= 0.1 |g| + q, which is (1).
///  - The crossing of two lines under the angle w: as for lines, each over sin w, and size has the factor sin w.
///  - The slopes of a plane through three touches are linear in the shifts: by no more than 1 / h for each touch, h the
///    least height of the triangle. With size <= 0.4 h they change by 3 S / h <= 1.2 q. Derivatives of the normal turn
///    by that and change in length by that: 1.7 q together.
///  - A circle on a short arc of sagitta h is a parabola: its curvature k is linear in the shifts and changes, of n
///    touches spread evenly, by the share (sum of |y_i^2 - mean|) / (sum of (y_i^2 - mean) y_i^2) * S / h: 2 of three
///    touches, never more than 2.89, its limit for many. With size <= h / 3 that is 0.97 q, and derivatives of the
///    middle, as 1 / k^2, change by no more than 1 / (1 - 0.97 q)^2 - 1 <= 0.23 of themselves. On longer arcs the
///    changes are smaller against h, which is up to the diameter.
///  - Several cycles: the shares multiply. (1 - a)(1 - b) >= 1 - a - b, so what holds for one q holds for their sum.
/// What is left to tests (tests/survival/curvature_test.cpp holds (1) itself, at all corners of the ranges): circles on
/// arcs that are no parabolas, and a shift and a turn that follow from the same touches and cancel.
namespace probewright::survival {

inline constexpr double curvature = 1.25;  ///< of what one touch does alone
inline constexpr double nearEnough =
    0.1;  ///< the most that all q = S / size may add up to, where anything depends on it

/// The size of what the touches of a cycle are on, for (1): the ball's middle at each touch and the unit way on which
/// it came. A quick touch and the slow one after it are one place. A large number if nothing can bend.
double sizeOf(const std::vector<Vector3>& touches, const std::vector<Vector3>& ways);

/// The same of middles that were measured apart from each other, bores on a circle.
double sizeOfArc(const std::vector<Vector3>& middles);

/// The same of middles in pairs, 1 and 3, 2 and 4, through which two lines go.
double sizeOfCrossing(const std::vector<Vector3>& middles);

}  // namespace probewright::survival
