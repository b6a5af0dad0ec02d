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

/// Derivatives of each place by each touch, in the world of these places.
std::vector<Places> derivatives(const Places& places, const Places& ways, const Effect& effect, double step) {
  std::vector<Places> columns;
  for (std::size_t i = 0; i < places.size(); ++i) {
    Places further = places, nearer = places;
    further[i] += step * ways[i];
    nearer[i] -= step * ways[i];
    const Places a = effect(further), b = effect(nearer);
    Places column;
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
      column.push_back((a[k] - b[k]) / (2 * step));
    columns.push_back(std::move(column));
  }
  return columns;
}

/// The largest share of the bound that is used up, by the places themselves and by the condition (1) on derivatives:
/// touches at `places` shift along `ways`, each by the most that the proof lets pass for a `size` or a part of it;
/// `bending` takes the place of the size in the bound.
double used(const Places& places, const Places& ways, const Effect& effect, double size, double bending) {
  const Places plain = effect(places);
  if (plain.empty()) return 0;
  const std::size_t corners = std::size_t{1} << places.size();
  std::mt19937_64 random(20261122);
  double worst = 0;
  for (const double shift : {nearEnough * size, 0.2 * nearEnough * size}) {
    const double step = 1e-4 * shift;
    std::vector<double> bound(plain.size(), static_cast<double>(places.size()) * shift * shift / bending);
    std::vector<std::vector<double>> alone(places.size(), std::vector<double>(plain.size()));
    std::vector<Places> means;
    bool refused = false;
    for (std::size_t i = 0; i < places.size(); ++i) {
      std::vector<Places> ends;
      for (const double way : {-shift, shift}) {
        Places moved = places;
        moved[i] += way * ways[i];
        ends.push_back(effect(moved));
        refused = refused || ends.back().size() != plain.size();
        for (std::size_t k = 0; k < std::min(ends.back().size(), plain.size()); ++k)
          alone[i][k] = std::max(alone[i][k], (ends.back()[k] - plain[k]).norm());
      }
      if (refused) break;
      Places mean;
      for (std::size_t k = 0; k < plain.size(); ++k) {
        bound[k] += curvature * alone[i][k];
        mean.push_back((ends[1][k] - ends[0][k]) / (2 * shift));
      }
      means.push_back(std::move(mean));
    }
    if (refused) continue;  // the box stays undecided
    std::vector<std::vector<Places>> seen;
    for (std::size_t corner = 0; corner < corners + 20; ++corner) {
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
      const std::vector<Places> columns = derivatives(moved, ways, effect, step);
      for (std::size_t k = 0; k < plain.size(); ++k) {
        // (1), summed over the touches: what one of them has left the others may use.
        double differs = 0, allowed = 1e-6;
        for (std::size_t i = 0; i < places.size(); ++i) {
          if (columns[i].size() != plain.size()) continue;
          differs += (columns[i][k] - means[i][k]).norm();
          allowed += (curvature - 1) * means[i][k].norm() + shift / bending;
        }
        worst = std::max(worst, differs / allowed);
      }
    }
  }
  return worst;
}

double used(const Places& places, const Places& ways, const Effect& effect, double size) {
  return used(places, ways, effect, size, size);
}

double used(const Places& places, const Places& ways, const Effect& effect) {
  return used(places, ways, effect, sizeOf(places, ways));
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

/// How far touches of a circle may shift does not depend on where it lies.
TEST(Curvature, IsTheSameWhereverTheCircleLies) {
  for (const int count : {3, 4, 6}) {
    for (const double step : {20.0, 50.0}) {
      Places places, elsewhere, ways;
      for (int i = 0; i < count; ++i) {
        const double angle = i * step * std::numbers::pi / 180;
        ways.emplace_back(std::cos(angle), std::sin(angle), 0);
        places.push_back(15 * ways.back());
        elsewhere.push_back(places.back() + Vector3(120, -80, 0));
      }
      const double size = sizeOfRound(places, ways);
      EXPECT_GT(size, 0);
      EXPECT_NEAR(sizeOfRound(elsewhere, ways), size, 1e-6 * size) << count << " touches every " << step << " degrees";
    }
  }
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
  for (const double lever : {0.0, 20.0, 200.0}) {
    const Effect plane = [&](const Places& p) -> Places {
      const Vector3 normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
      return {p[0] + lever * normal};
    };
    // The third touch is more and more on the line through the others.
    for (const double aside : {50.0, 20.0, 5.0, 1.0})
      EXPECT_LE(used({{0, 0, 0}, {60, 0, 0}, {25, aside, 0}}, {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, plane), 1)
          << lever << " " << aside;
  }
}

/// A corner far from its touches that shifts and turns: places where both nearly cancel, and others.
TEST(Curvature, IsBoundedForCornersThatTurn) {
  const auto corner = [](const Places& p) {
    const Vector3 first = p[1] - p[0];
    const Vector3 second = p.size() == 4 ? Vector3(p[3] - p[2]) : Vector3::UnitZ().cross(first);
    Eigen::Matrix2d sides;
    sides << first.x(), -second.x(), first.y(), -second.y();
    const Vector2 part = sides.inverse() * Vector2(p[2].x() - p[0].x(), p[2].y() - p[0].y());
    return Vector3(p[0] + part.x() * first);
  };
  double worst = 0;
  for (const int count : {3, 4}) {
    for (const double angle : {90.0, 60.0}) {
      if (count == 3 && angle != 90) continue;
      const double turn = angle * std::numbers::pi / 180;
      const Vector3 other(std::cos(turn), std::sin(turn), 0);
      for (const double away : {5.0, 40.0, 150.0}) {
        for (const Vector3& lever :
             {Vector3(away, 0, 0), Vector3(away + 20, 0, 0), Vector3(0, 30, 0), Vector3(200, 100, 0)}) {
          const Effect effect = [&](const Places& p) -> Places {
            const Vector3 along = (p[1] - p[0]).normalized();
            return {corner(p) + lever.x() * along + lever.y() * Vector3::UnitZ().cross(along)};
          };
          Places places = {{away, 0, 0}, {away + 20, 0, 0}, away * other, (away + 20) * other};
          Places ways = {{0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 0, 0}};
          places.resize(static_cast<std::size_t>(count));
          ways.resize(static_cast<std::size_t>(count));
          const auto found = cornerOf(places, ways);
          ASSERT_TRUE(found);
          EXPECT_NEAR(found->sine, std::sin(turn), 1e-9);
          const double share = used(places, ways, effect, sizeOf(places, ways), found->at(lever.norm()));
          EXPECT_LE(share, 1) << count << " touches, " << angle << " degrees, " << away << ", lever "
                              << lever.transpose();
          worst = std::max(worst, share);
        }
      }
    }
  }
  EXPECT_GT(worst, 0.1) << "the bound is so wide that this proves nothing";
}

/// The condition (1) without the share of what touches do alone: at the corner's own bound it must hold by itself.
TEST(Curvature, DependsOnHowFarACornerIs) {
  const CornerSize near =
      *cornerOf({{10, 0, 0}, {30, 0, 0}, {0, 10, 0}, {0, 30, 0}}, {{0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 0, 0}});
  EXPECT_NEAR(near.edge, 20, 1e-9);
  EXPECT_NEAR(near.away, 30, 1e-9);
  EXPECT_NEAR(near.oblique, 0, 1e-9);
  EXPECT_LT(near.at(300), near.at(30));
  const CornerSize elsewhere =
      *cornerOf({{50, -25, 3}, {70, -25, 3}, {40, -15, 3}, {40, 5, 3}}, {{0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 0, 0}});
  EXPECT_NEAR(elsewhere.edge, 20, 1e-9);
  EXPECT_NEAR(elsewhere.away, 30, 1e-9);
  // A pocket by four touches in pairs is no corner, nor is a line.
  EXPECT_FALSE(
      cornerOf({{9, 0, 0}, {-9, 0, 0}, {0, 9, 0}, {0, -9, 0}}, {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}));
  EXPECT_FALSE(cornerOf({{9, 0, 0}, {19, 0, 0}}, {{0, 1, 0}, {0, 1, 0}}));
}

/// Touches with residuals: four that lie on no circle, as in a bore that is tilted or not round.
TEST(Curvature, IsBoundedForCirclesOnEllipses) {
  for (const double flat : {0.99, 0.95, 0.9}) {
    for (const double step : {30.0, 60.0, 90.0}) {
      Places places, ways;
      for (int i = 0; i < 4; ++i) {
        const double angle = (10 + i * step) * std::numbers::pi / 180;
        ways.emplace_back(std::cos(angle), std::sin(angle), 0);
        places.emplace_back(15 * std::cos(angle), 15 * flat * std::sin(angle), 0);
      }
      EXPECT_LE(used(places, ways, circle, sizeOfRound(places, ways)), 1) << flat << " " << step;
    }
  }
}

TEST(Curvature, IsBoundedForEdgesThatCrossAtAnyAngle) {
  for (const double angle : {90.0, 60.0, 30.0, 10.0}) {
    const double turn = angle * std::numbers::pi / 180;
    const Vector3 along(std::cos(turn), std::sin(turn), 0);
    const Effect corner = [](const Places& p) -> Places {
      Eigen::Matrix2d sides;
      sides << p[1].x() - p[0].x(), p[2].x() - p[3].x(), p[1].y() - p[0].y(), p[2].y() - p[3].y();
      const Vector2 part = sides.inverse() * Vector2(p[2].x() - p[0].x(), p[2].y() - p[0].y());
      return {p[0] + part.x() * (p[1] - p[0])};
    };
    for (const double away : {5.0, 30.0})
      EXPECT_LE(used({{away, 0, 0}, {away + 20, 0, 0}, away * along, (away + 20) * along},
                     {{0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 0, 0}}, corner),
                1)
          << angle << " " << away;
  }
}

/// A bore as preset, an edge as rotation about it, each at half of what is near enough: the place of a later move.
TEST(Curvature, IsBoundedForCyclesOneAfterTheOther) {
  for (const double step : {10.0, 40.0, 120.0}) {
    Places round, ways;
    for (int i = 0; i < 3; ++i) {
      const double angle = i * step * std::numbers::pi / 180;
      ways.emplace_back(std::cos(angle), std::sin(angle), 0);
      round.push_back(15 * ways.back());
    }
    const Places edge = {{100, 0, 0}, {103, 0, 0}}, across = {{0, 1, 0}, {0, 1, 0}};
    // The edge is drawn larger, so that one shift is the same share of both sizes.
    const double scale = sizeOf(round, ways) / sizeOf(edge, across);
    Places places = round, all = ways;
    for (std::size_t i = 0; i < 2; ++i) {
      places.emplace_back(100 + scale * (edge[i].x() - 100), 0, 0);
      all.push_back(across[i]);
    }
    const Effect effect = [](const Places& p) -> Places {
      const Places middle = circle({p.begin(), p.begin() + 3});
      if (middle.empty()) return {};
      const Vector3 along = (p[4] - p[3]).normalized();
      return {middle[0] + 50 * along, middle[0] + 200 * Vector3::UnitZ().cross(along)};
    };
    EXPECT_LE(used(places, all, effect, sizeOf(round, ways) / 2), 1) << step;
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
  EXPECT_LE(used(places, ways, effect,
                 std::min(sizeOf({places.begin(), places.begin() + 4}, {ways.begin(), ways.begin() + 4}), 0.45 * 60)),
            1);
}

/// Three bores on an arc, as circles through their middles go.
TEST(Curvature, IsBoundedForMiddlesOnAnArc) {
  for (const double step : {5.0, 20.0, 60.0, 120.0}) {
    Places middles, ways;
    for (int i = 0; i < 3; ++i) {
      const double angle = i * step * std::numbers::pi / 180;
      ways.emplace_back(std::cos(angle), std::sin(angle), 0);
      middles.push_back(80 * ways.back());
    }
    EXPECT_LE(used(middles, ways, circle, sizeOfArc(middles)), 1) << step;
  }
}

TEST(Curvature, KnowsTheSizeOfWhatIsTouched) {
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();
  // Two touches, and a slow one after each.
  EXPECT_NEAR(sizeOf({{0, 0, 0}, {0, 0.01, 0}, {20, 0, 0}, {20, 0.01, 0}}, {y, y, y, y}), 0.45 * 20, 0.01);
  // A plane whose third touch is 3 mm beside the line through the others.
  EXPECT_NEAR(sizeOf({{0, 0, 0}, {60, 0, 0}, {30, 3, 0}}, {z, z, z}), 0.4 * 3, 1e-9);
  // A bore by four touches, one after the other or in pairs: no edges that cross.
  EXPECT_NEAR(sizeOf({{9, 0, 0}, {0, 9, 0}, {-9, 0, 0}, {0, -9, 0}}, {x, y, -x, -y}), 0.45 * 9 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(sizeOf({{9, 0, 0}, {-9, 0, 0}, {0, 9, 0}, {0, -9, 0}}, {x, -x, y, -y}), 0.45 * 9 * std::sqrt(2.0), 1e-9);
  // Edges under 30 degrees.
  EXPECT_NEAR(
      sizeOf({{50, 0, 0}, {70, 0, 0}, {50 * std::sqrt(0.75), 25, 0}, {70 * std::sqrt(0.75), 35, 0}}, {y, y, x, x}),
      0.45 * 20 * 0.5, 1e-9);
  EXPECT_GT(sizeOf({{1, 2, 3}}, {x}), 1e6);
  // A touch in the touch probe axis after a bore or a corner is one by itself.
  EXPECT_NEAR(sizeOf({{9, 0, 0}, {0, 9, 0}, {-9, 0, 0}, {0, -9, 0}, {1, 1, 5}}, {x, y, -x, -y, -z}),
              0.45 * 9 * std::sqrt(2.0), 1e-9);
  EXPECT_TRUE(cornerOf({{10, 0, 0}, {30, 0, 0}, {0, 10, 0}, {0, 30, 0}, {20, 20, 5}}, {y, y, x, x, -z}));
}

}  // namespace
}  // namespace probewright::survival::testing
