#include "survival/curvature.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "metrology/fits.hpp"
#include "survival/survival_bench.hpp"

/// The bound of what several touches do together, against the fits that cycles compute.
namespace probewright::survival::testing {
namespace {

using Places = std::vector<Vector3>;
/// Places that follow from touches; none if the fit refuses them.
using Effect = std::function<Places(const Places&)>;

/// The largest share of the bound that is used up: touches at `places` shift along `ways`, each by the most that the
/// proof lets pass or a part of it.
double used(const Places& places, const Places& ways, const Effect& effect) {
  double distance = 1e9;
  for (std::size_t a = 0; a < places.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      distance = std::min(distance, (places[a] - places[b]).norm());
  const double size = std::min(distance / 2, acrossArc(places, ways));
  const Places plain = effect(places);
  std::mt19937_64 random(20261122);
  double worst = 0;
  for (const double shift : {nearEnough * size, 0.2 * nearEnough * size, 0.01 * nearEnough * size}) {
    std::vector<double> bound(plain.size(), static_cast<double>(places.size()) * shift * shift / size);
    bool refused = plain.empty();
    for (std::size_t i = 0; i < places.size(); ++i) {
      std::vector<double> alone(plain.size());
      for (const double way : {-shift, shift}) {
        Places moved = places;
        moved[i] += way * ways[i];
        const Places found = effect(moved);
        refused = refused || found.empty();
        for (std::size_t k = 0; k < std::min(found.size(), plain.size()); ++k)
          alone[k] = std::max(alone[k], (found[k] - plain[k]).norm());
      }
      for (std::size_t k = 0; k < plain.size(); ++k)
        bound[k] += curvature * alone[k];
    }
    if (refused) continue;  // the box stays undecided
    const std::size_t corners = std::size_t{1} << places.size();
    for (std::size_t corner = 0; corner < corners + 50; ++corner) {
      Places moved = places;
      for (std::size_t i = 0; i < places.size(); ++i) {
        const double share = corner < corners ? ((corner >> i & 1U) != 0 ? 1.0 : -1.0)
                                              : std::uniform_real_distribution<double>(-1, 1)(random);
        moved[i] += share * shift * ways[i];
      }
      const Places found = effect(moved);
      // A fit that refuses is an alarm, which the proof meets at the corners of what is measured.
      if (found.empty()) continue;
      for (std::size_t k = 0; k < plain.size(); ++k)
        worst = std::max(worst, (found[k] - plain[k]).norm() / bound[k]);
    }
  }
  return worst;
}

/// The middle of a circle, and its radius as the height of a place.
Places circle(const Places& places) {
  std::vector<Vector2> points;
  for (const Vector3& place : places)
    points.emplace_back(place.x(), place.y());
  const auto found = metrology::fitCircle(points);
  if (!found) return {};
  return {Vector3(found->shape.centre.x(), found->shape.centre.y(), 0), Vector3(0, 0, found->shape.radius)};
}

TEST(Curvature, IsBoundedForCirclesOfAnySteps) {
  double worst = 0;
  for (const int count : {3, 4, 5, 6, 8}) {
    for (const double step : {5.0, 10.0, 20.0, 45.0, 60.0, 72.0, 90.0, 120.0}) {
      if (step * (count - 1) >= 360) continue;
      Places places, ways;
      for (int i = 0; i < count; ++i) {
        const double angle = i * step * std::numbers::pi / 180;
        ways.emplace_back(std::cos(angle), std::sin(angle), 0);
        places.push_back(15 * ways.back());
      }
      const double share = used(places, ways, circle);
      EXPECT_LE(share, 1) << count << " touches every " << step << " degrees";
      worst = std::max(worst, share);
    }
  }
  EXPECT_GT(worst, 0.5) << "the bound is so wide that this proves nothing";
}

/// A place `lever` away turns with the line through two touches.
TEST(Curvature, IsBoundedForPlacesFarFromAnEdge) {
  for (const double lever : {0.0, 5.0, 60.0, 1000.0}) {
    const Effect effect = [&](const Places& p) -> Places {
      const Vector3 along = (p[1] - p[0]).normalized();
      return {p[0] + lever * along, p[0] + lever * Vector3::UnitZ().cross(along)};
    };
    EXPECT_LE(used({{0, 0, 0}, {60, 0, 0}}, {{0, 1, 0}, {0, 1, 0}}, effect), 1) << lever;
  }
}

TEST(Curvature, IsBoundedForCornersAndPlanes) {
  const Effect corner = [](const Places& p) -> Places {
    Eigen::Matrix2d sides;
    sides << p[1].x() - p[0].x(), p[2].x() - p[3].x(), p[1].y() - p[0].y(), p[2].y() - p[3].y();
    const Vector2 along = sides.inverse() * Vector2(p[2].x() - p[0].x(), p[2].y() - p[0].y());
    return {p[0] + along.x() * (p[1] - p[0])};
  };
  for (const double away : {5.0, 30.0, 100.0})
    EXPECT_LE(used({{away, 0, 0}, {away + 20, 0, 0}, {0, away, 0}, {0, away + 20, 0}},
                   {{0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 0, 0}}, corner),
              1)
        << away;
  for (const double lever : {0.0, 200.0}) {
    const Effect plane = [&](const Places& p) -> Places {
      const Vector3 normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
      return {p[0] + lever * normal};
    };
    EXPECT_LE(used({{0, 0, 0}, {60, 0, 0}, {0, 50, 0}}, {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, plane), 1) << lever;
  }
}

/// The angle through the middles of two bores, each of four touches, and a place far away.
TEST(Curvature, IsBoundedForTwoBores) {
  Places places, ways;
  for (const double x : {0.0, 60.0}) {
    for (const double angle : {0.0, 0.5, 1.0, 1.5}) {
      ways.emplace_back(std::cos(angle * std::numbers::pi), std::sin(angle * std::numbers::pi), 0);
      places.push_back(Vector3(x, 0, 0) + 10 * ways.back());
    }
  }
  const Effect effect = [](const Places& p) -> Places {
    const Places first = circle({p.begin(), p.begin() + 4}), second = circle({p.begin() + 4, p.end()});
    return {first[0] + 200 * (second[0] - first[0]).normalized()};
  };
  EXPECT_LE(used(places, ways, effect), 1);
}

}  // namespace
}  // namespace probewright::survival::testing
