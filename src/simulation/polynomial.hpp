#pragma once

#include <array>
#include <cstddef>

namespace probewright::simulation {

/// Up to four ascending real roots.
struct Roots {
  std::array<double, 4> values{};
  std::size_t count = 0;

  const double* begin() const { return values.data(); }
  const double* end() const { return values.data() + count; }
};

/// The roots of c[0] + c[1] x + ... + c[4] x^4 in [low, high] at which the sign changes, each to the last few digits
/// that the coefficients allow. Roots of even multiplicity are left out: there the curve touches zero and turns back.
Roots realRoots(const std::array<double, 5>& c, double low, double high);

}  // namespace probewright::simulation
