#pragma once

#include <cstddef>
#include <optional>
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
///  - A circle: circle_curvature.hpp bounds e_i for the touches as they lie, on arcs of any length; the size is the
///    greatest for which (1) holds.
///  - A corner that shifts and turns, where both may cancel. Let X be the crossing of the lines through touches on two
///    edges, w the angle between them, f = X + R v with R the turn of the first edge and a lever v; l the least
///    distance of two touches on one edge, A the greatest distance of X from a touch, o the greatest cosine between a
///    way and its edge, s = sin w. With k = (way . normal) / l, touch 1 has the derivative k ((a / s) along edge 2 - J
///    R v), a the signed distance from X to touch 2 and J a quarter turn. By touch j, k changes by 2 o / l^2 at most,
///    edges turn by 1 / l, X moves by A / (l s), a by A / (l s) + 1, 1 / s by |cos w| / (s^2 l). So the second
///    derivatives are at most (2 o (A / s + |v|) + 3 A / s^2 + |v|) / l^2 + 1 / (l s). Of three touches, the second
///    edge square to the first, touch 1 has (way . n) n - k (b e + u n + J R v), b and u the distances of touches 3 and
///    1 from X, and a like sum gives (2 o (1.5 A + |v|) + 3.5 A + |v|) / l^2 + 4 / l. CornerSize takes K, the greater
///    of each term, with l, A and s at their worst in the box: shifts of a tenth of the size 0.45 l s leave 0.91 l and
///    0.8 s, and A is at most 1.35 A + 0.25 l, with the derivatives there. Then e_i <= (n + 1/2) K S for n touches,
///    whatever cancels: from the middle to any point by n K S, to the mean by half of K S. 1 / ((n + 1/2) K) takes the
///    place of the size in (1).
///  - Several cycles: the shares multiply. (1 - a)(1 - b) >= 1 - a - b, so what holds for one q holds for their sum.
/// tests/survival/curvature_test.cpp holds (1) itself against the fits that cycles compute, at all corners of the
/// ranges.
namespace probewright::survival {

inline constexpr double curvature = 1.25;  ///< of what one touch does alone
inline constexpr double nearEnough =
    0.1;  ///< the most that all q = S / size may add up to, where anything depends on it

/// The size of what the touches of a cycle are on, for (1): the ball's middle at each touch and the unit way on which
/// it came. A quick touch and the slow one after it are one place. A large number if nothing can bend.
double sizeOf(const std::vector<Vector3>& touches, const std::vector<Vector3>& ways);

/// The same of a circle through touches, with their ways.
double sizeOfRound(const std::vector<Vector3>& touches, const std::vector<Vector3>& ways);

/// Two edges of a corner: how far later places are from it matters, for they may turn with it.
struct CornerSize {
  std::size_t touches = 0;
  double edge = 0;     ///< mm, l: the least distance of two touches on one edge
  double away = 0;     ///< mm, A
  double sine = 1;     ///< s
  double oblique = 0;  ///< o

  /// What takes the place of the size in (1) for places within `lever` of the corner, mm.
  double at(double lever) const;
};
/// Of touches on two edges, two and two or two and one; nothing of others.
std::optional<CornerSize> cornerOf(const std::vector<Vector3>& touches, const std::vector<Vector3>& ways);

/// The same of middles that were measured apart from each other, bores on a circle, each by touches in pairs.
double sizeOfArc(const std::vector<Vector3>& middles);

/// The same of middles in pairs, 1 and 3, 2 and 4, through which two lines go.
double sizeOfCrossing(const std::vector<Vector3>& middles);

}  // namespace probewright::survival
