#include "simulation/trimmed_domain.hpp"

#include <gtest/gtest.h>

#include <numbers>

/// Faces on surfaces that close in themselves: a place has many parameters.
namespace probewright::simulation {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// The border of a rectangle of parameters.
std::vector<TrimmedDomain::Segment> rectangle(const Vector2& low, const Vector2& high) {
  const Vector2 corners[] = {low, {high.x(), low.y()}, high, {low.x(), high.y()}, low};
  std::vector<TrimmedDomain::Segment> border;
  for (int i = 0; i < 4; ++i)
    border.push_back({corners[i], corners[i + 1]});
  return border;
}

TEST(TrimmedDomain, HasAPlaceUnderAllItsParameters) {
  // Two radians of a torus in both directions, drawn in any period.
  for (int drawn = -3; drawn <= 3; ++drawn) {
    const Vector2 low(0.5 + drawn * turn, -1 - drawn * turn);
    const TrimmedDomain domain(rectangle(low, low + Vector2(2, 2)), turn, turn);
    for (int asked = -3; asked <= 3; ++asked) {
      const Vector2 by(asked * turn, (asked % 2) * turn);
      for (const double u : {0.6, 1.5, 2.4, 2.6, 4.0, 6.7}) {
        for (const double v : {-0.9, 0.0, 0.9, 1.1, 3.0, -1.1}) {
          const bool inside = u < 2.5 && v > -1 && v < 1;
          EXPECT_EQ(domain.contains(Vector2(u, v) + by), inside)
              << u << " " << v << ", drawn in period " << drawn << ", asked in " << asked;
        }
      }
    }
  }
}

TEST(TrimmedDomain, WithoutAPeriodHasItsPlacesOnce) {
  const TrimmedDomain domain(rectangle({0, 0}, {2, 1}), 0, 0);
  EXPECT_TRUE(domain.contains({1, 0.5}));
  EXPECT_FALSE(domain.contains({1 + turn, 0.5}));
  EXPECT_FALSE(domain.contains({1, -0.5}));
}

}  // namespace
}  // namespace probewright::simulation
