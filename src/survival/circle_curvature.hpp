#pragma once

#include <vector>

#include "geometry/primitives.hpp"

/// How much the derivatives of a fitted circle's centre change while its touches shift: (1) of curvature.hpp for
/// circles on arcs of any length.
///
/// The least-squares circle (centre c, radius r) of touches p_j satisfies sum of e_j b_j = 0, with e_j = |p_j - c| - r,
/// u_j the unit vector from c to p_j, t_j square to it, and b_j = (u_j, 1). Let W_j be the way of touch j. From that,
/// with rho_j = |p_j - c|, the derivatives z_k of (c, r) by touch k satisfy
///     (sum of b_j b_j^T + (e_j / rho_j) t_j t_j^T) z_k = b_k (u_k . W_k) + (e_k / rho_k) t_k (t_k . W_k).          (2)
/// Let N have the rows b_j in the middle of the box, N = Q T^-1 with orthonormal columns of Q, and z = T y. In y the
/// matrix of (2) is M = 1 + E in the middle, E the part of the residuals; however short the arc is, M is well
/// conditioned, for T takes the weak directions.
///
/// Suppose that on the straight way from the middle to s, touch j shifting by S_j at most, no y_k has changed by more
/// than D_k. Then of the spoke from c to p_j, with y_k of the middle,
///     across  <= sum of S_k |t_j^T T y_k| + |t_j^T T| sum of S_k D_k + S_j |t_j . W_j|,
///     along   <= sum of S_k |u_j^T T y_k| + |u_j^T T| sum of S_k D_k + S_j |u_j . W_j|,
/// so it turns by delta_j <= across / (rho_j - along); the row b_j^T T of N T changes by
/// nu_j <= delta_j |t_j^T T| + delta_j^2 / 2 |u_j^T T|, and e_j by
/// epsilon_j <= sum of S_k |(j = k) u_j . W_j - q_j . y_k| + |q_j| sum of S_k D_k + across^2 / 2 (rho_j - along), q_j
/// the row of Q. Let nu be the root of the sum of nu_j^2. M changes by no more than
///     m = 2 nu + nu^2 + what the residuals' part does,
/// and with h_k the right side of (2) in y
///     |y_k - its middle| <= |M^-1| (|change of h_k| + m |y_k of the middle|) / (1 - |M^-1| m).
/// If this is less than D_k for all k, it is less than the part of D_k everywhere on the way, for it grows faster than
/// in proportion; no y_k can be the first to change by more: the supposition holds all the way. It concerns the minimum
/// that the middle's changes into; the fits of the control start from an algebraic circle and find that one.
namespace probewright::survival {

/// The greatest size, at most `atMost`, for which (1) holds for the centre of the circle through the points that shift
/// along these unit ways. A hundredth of `atMost` if it holds for none: there is no circle, or hardly one.
double sizeOfCircle(const std::vector<Vector2>& points, const std::vector<Vector2>& ways, double atMost);

/// The same of the circle through middles of bores, each measured by four touches in pairs that shift by as much: a
/// middle shifts anywhere, and the help of |m_i| in (1) is not taken.
double sizeOfBoreCircle(const std::vector<Vector2>& middles, double atMost);

}  // namespace probewright::survival
