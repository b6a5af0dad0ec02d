#include "simulation/polynomial.hpp"

#include <cmath>

namespace probewright::simulation {
namespace {

double value(const std::array<double, 5>& c, std::size_t degree, double x) {
  double sum = c[degree];
  for (std::size_t i = degree; i-- > 0;)
    sum = sum * x + c[i];
  return sum;
}

double slope(const std::array<double, 5>& c, std::size_t degree, double x) {
  double sum = static_cast<double>(degree) * c[degree];
  for (std::size_t i = degree; i-- > 1;)
    sum = sum * x + static_cast<double>(i) * c[i];
  return sum;
}

/// The root between two places of different sign: Newton, kept in the bracket by bisection.
double bracketedRoot(const std::array<double, 5>& c, std::size_t degree, double low, double high, bool lowIsNegative) {
  double x = (low + high) / 2;
  for (int i = 0; i < 100; ++i) {
    const double f = value(c, degree, x);
    if (f == 0) return x;
    ((f < 0) == lowIsNegative ? low : high) = x;
    const double d = slope(c, degree, x);
    double next = d != 0 ? x - f / d : low;
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (next == x || high - low < 1e-15 * (std::abs(low) + std::abs(high))) return next;
    const bool settled = std::abs(next - x) < 1e-14 * (1 + std::abs(x));
    x = next;
    if (settled) return x;
  }
  return x;
}

Roots rootsOfDegree(const std::array<double, 5>& c, std::size_t degree, double low, double high) {
  Roots roots;
  if (degree == 0) return roots;
  if (degree == 1) {
    if (c[1] == 0) return roots;
    const double x = -c[0] / c[1];
    if (x >= low && x <= high) roots.values[roots.count++] = x;
    return roots;
  }
  std::array<double, 5> derivative{};
  for (std::size_t i = 1; i <= degree; ++i)
    derivative[i - 1] = static_cast<double>(i) * c[i];
  const Roots turns = rootsOfDegree(derivative, degree - 1, low, high);
  double from = low;
  double fromValue = value(c, degree, from);
  for (std::size_t i = 0; i <= turns.count; ++i) {
    const double to = i < turns.count ? turns.values[i] : high;
    const double toValue = value(c, degree, to);
    if ((fromValue < 0) != (toValue < 0)) {
      roots.values[roots.count++] = bracketedRoot(c, degree, from, to, fromValue < 0);
    }
    from = to;
    fromValue = toValue;
  }
  return roots;
}

}  // namespace

Roots realRoots(const std::array<double, 5>& c, double low, double high) {
  std::size_t degree = 4;
  while (degree > 0 && c[degree] == 0)
    --degree;
  return rootsOfDegree(c, degree, low, high);
}

}  // namespace probewright::simulation
