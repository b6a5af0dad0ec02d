#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <Eigen/Dense>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <numeric>

#include "oracle.hpp"
#include "simulation/cad_solid.hpp"

/// Splines that bend between a few samples of them: high degrees, uneven knots, thin ridges, weights that differ a
/// thousandfold, rolls, cusps at poles. A dense search of its own judges the contacts of small balls:
/// BRepExtrema misses places of such surfaces.
namespace probewright::simulation {
namespace {

using namespace testing;

enum class Bend { Waves, Ridge, Weights, Rough, Cusp, Roll, Count };

int any(std::mt19937_64& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<std::uint64_t>(high - low + 1));
}

struct Knots {
  Knots(std::mt19937_64& random, int poles, int degree)
      : values(1, poles - degree + 1), multiplicities(1, poles - degree + 1) {
    double t = 0;
    for (int i = 1; i <= values.Length(); ++i) {
      values(i) = t;
      t += random() % 3 == 0 ? uniform(random, 0.02, 0.2) : 1;
      multiplicities(i) = i == 1 || i == values.Length() ? degree + 1 : 1;
    }
  }
  TColStd_Array1OfReal values;
  TColStd_Array1OfInteger multiplicities;
};

Handle(Geom_BSplineSurface) bentSurface(std::mt19937_64& random, Bend bend) {
  const int degreeU = any(random, 2, 9), degreeV = any(random, 2, 7);
  const int rows = degreeU + any(random, 1, 9), columns = degreeV + any(random, 1, 7);
  const double height = std::pow(10, uniform(random, -0.5, 1.2)), width = uniform(random, 10, 60);
  const double depth = uniform(random, 10, 40), alongU = uniform(random, 0.2, 3.1), alongV = uniform(random, 0.2, 3.1);
  const int ridge = any(random, 1, rows);
  TColgp_Array2OfPnt poles(1, rows, 1, columns);
  TColStd_Array2OfReal weights(1, rows, 1, columns);
  for (int i = 1; i <= rows; ++i) {
    for (int j = 1; j <= columns; ++j) {
      const double down = static_cast<double>(j - 1) / (columns - 1);
      Vector3 p(width * (i - 1) / (rows - 1), depth * down, 0);
      weights(i, j) = 1;
      if (bend == Bend::Waves) p.z() = height * std::sin(alongU * i) * std::cos(alongV * j);
      if (bend == Bend::Ridge) p.z() = i == ridge ? 3 * height : 0;
      if (bend == Bend::Weights) {
        p.z() = height * std::sin(alongU * i + alongV * j);
        weights(i, j) = std::pow(10, uniform(random, -1.7, 1.7));
      }
      if (bend == Bend::Rough)
        p += Vector3(uniform(random, -0.3, 0.3) * width / rows, 0, uniform(random, -1, 1) * height);
      if (bend == Bend::Cusp)
        p = {width / 2 + (p.x() - width / 2) * down, depth * down * down, height * std::sin(alongU * i) * down};
      if (bend == Bend::Roll)
        p = {width / 2 * (1 + std::cos(alongU * i)), p.y(),
             width / 2 * std::sin(alongU * i) + uniform(random, -1, 1) * height};
      poles(i, j) = gp_Pnt(p.x(), p.y(), p.z());
    }
  }
  const Knots u(random, rows, degreeU), v(random, columns, degreeV);
  return new Geom_BSplineSurface(poles, weights, u.values, v.values, u.multiplicities, v.multiplicities, degreeU,
                                 degreeV);
}

/// Looks at a surface everywhere, then more closely about the best place.
class DenseSearch {
public:
  DenseSearch(const Handle(Geom_BSplineSurface) & surface, int steps) : surface_(surface), steps_(steps) {
    surface->Bounds(low_.x(), high_.x(), low_.y(), high_.y());
    for (int i = 0; i <= steps_; ++i) {
      for (int j = 0; j <= steps_; ++j) {
        const Vector2 at = low_ + (high_ - low_).cwiseProduct(Vector2(i, j)) / steps_;
        places_.push_back({at, pointAt(at)});
      }
    }
  }

  const Vector3& randomPlace(std::mt19937_64& random) const { return places_[random() % places_.size()].point; }

  template <class Function>
  double least(const Function& function) const {
    double found = 1e300;
    Vector2 at = low_;
    for (const Place& place : places_) {
      const double here = function(place.point);
      if (here < found) found = here, at = place.at;
    }
    constexpr int kMost = 300;
    Vector2 step = (high_ - low_) / steps_;
    for (int i = 0; i < kMost && found < 1e300 && step.x() > 1e-12; ++i) {
      const Vector2 middle = at;
      bool better = false;
      for (int k = 0; k < 9; ++k) {
        const Vector2 next = (middle + step.cwiseProduct(Vector2(k % 3 - 1, k / 3 - 1))).cwiseMax(low_).cwiseMin(high_);
        const double there = function(pointAt(next));
        if (there < found) found = there, at = next, better = true;
      }
      if (!better) step /= 2;
    }
    return found;
  }

  /// How far a point is from the surface, by Newton's method without curvature from each place that is nearer than
  /// those around it (of a roll, from each of its turns) and from the nearest ones, between which a thin bend may lie.
  double distance(const Vector3& point) const {
    std::vector<double> squares;
    squares.reserve(places_.size());
    for (const Place& place : places_)
      squares.push_back((place.point - point).squaredNorm());
    std::vector<std::pair<double, Vector2>> starts;
    for (int i = 0; i <= steps_; ++i) {
      for (int j = 0; j <= steps_; ++j) {
        const double here = squares[index(i, j)];
        bool least = true;
        for (int k = 0; k < 9 && least; ++k)
          least = here <= squares[index(std::clamp(i + k % 3 - 1, 0, steps_), std::clamp(j + k / 3 - 1, 0, steps_))];
        if (least) starts.emplace_back(here, places_[index(i, j)].at);
      }
    }
    std::ranges::sort(starts, {}, &std::pair<double, Vector2>::first);
    constexpr std::ptrdiff_t kNearest = 40;
    std::vector<std::size_t> nearest(places_.size());
    std::iota(nearest.begin(), nearest.end(), std::size_t{0});
    std::ranges::partial_sort(nearest, nearest.begin() + kNearest, {}, [&](std::size_t k) { return squares[k]; });
    for (std::ptrdiff_t i = 0; i < kNearest; ++i) {
      const std::size_t k = nearest[static_cast<std::size_t>(i)];
      starts.emplace_back(squares[k], places_[k].at);
    }
    double found = 1e300;
    for (std::size_t i = 0; i < starts.size() && found > 1e-7; ++i)
      found = std::min(found, distance(point, starts[i].second));
    return found;
  }

private:
  double distance(const Vector3& point, Vector2 at) const {
    double found = (pointAt(at) - point).norm(), share = 1;
    constexpr int kMost = 80;
    for (int i = 0; i < kMost && share > 1e-6; ++i) {
      gp_Pnt p;
      gp_Vec u, v;
      surface_->D1(at.x(), at.y(), p, u, v);
      Eigen::Matrix<double, 3, 2> slopes;
      slopes << u.X(), v.X(), u.Y(), v.Y(), u.Z(), v.Z();
      const Vector3 miss = point - Vector3(p.X(), p.Y(), p.Z());
      const Vector2 step = slopes.colPivHouseholderQr().solve(miss);
      // At a border, along it.
      const Vector2 alongU(miss.dot(slopes.col(0)) / std::max(1e-300, slopes.col(0).squaredNorm()), 0);
      const Vector2 alongV(0, miss.dot(slopes.col(1)) / std::max(1e-300, slopes.col(1).squaredNorm()));
      Vector2 next = at;
      double there = 1e300;
      for (const Vector2& each : {step, alongU, alongV}) {
        const Vector2 place = (at + share * each).cwiseMax(low_).cwiseMin(high_);
        const double here = (pointAt(place) - point).norm();
        if (here < there) there = here, next = place;
      }
      if (there < found) {
        found = there, at = next, share = std::min(1.0, 2 * share);
      } else {
        share /= 2;
      }
    }
    return found;
  }

  std::size_t index(int i, int j) const { return static_cast<std::size_t>(i * (steps_ + 1) + j); }
  struct Place {
    Vector2 at;
    Vector3 point;
  };
  Vector3 pointAt(const Vector2& at) const {
    const gp_Pnt p = surface_->Value(at.x(), at.y());
    return {p.X(), p.Y(), p.Z()};
  }

  Handle(Geom_BSplineSurface) surface_;
  int steps_;
  Vector2 low_, high_;
  std::vector<Place> places_;
};

/// How far a ball goes until it meets a point; a very long way if it does not.
double wayTo(const Vector3& point, const Vector3& from, const Vector3& direction, double radius) {
  const Vector3 arm = point - from;
  const double along = arm.dot(direction);
  const double square = radius * radius - arm.squaredNorm() + along * along;
  if (square < 0) return 1e300;
  const double way = along - std::sqrt(square);
  return way >= 0 ? way : arm.norm() < radius ? 0 : 1e300;
}

TEST(BentFaces, AreMetByTheSmallestBallsWhereADenseSearchMeetsThem) {
  std::mt19937_64 random(static_cast<std::uint64_t>(1101 + campaignStart()));
  int met = 0;
  const int faces = 24 * campaignFactor();
  for (int i = 0; i < faces; ++i) {
    const auto bend = static_cast<Bend>(i % static_cast<int>(Bend::Count));
    const Handle(Geom_BSplineSurface) surface = bentSurface(random, bend);
    const auto solid = cadSolid(BRepBuilderAPI_MakeFace(surface, 1e-7).Face());
    ASSERT_TRUE(solid) << i << ": " << format(solid.error());
    const DenseSearch dense(surface, 160);
    const double size = ((*solid)->bounds().maximum - (*solid)->bounds().minimum).norm();
    for (int k = 0; k < 20; ++k) {
      const double radius = 0.1 * std::pow(50, uniform(random, 0, 1));
      const Vector3 direction = k % 3 == 0 ? Vector3(0, 0, random() % 2 == 0 ? 1 : -1) : randomDirection(random);
      const Vector3 aim = dense.randomPlace(random) + randomPoint(random, radius);
      const Vector3 from = aim - uniform(random, 0.05, 1) * size * direction;
      const Vector3 to = aim + uniform(random, 0, 0.5) * size * direction;
      const auto contact = (*solid)->firstContact(from, to, radius);
      const double length = (to - from).norm(), way = contact ? contact->fraction * length : length;
      const double meant = dense.least([&](const Vector3& p) { return wayTo(p, from, direction, radius); });
      // Places between those that were looked at can only be met before them.
      EXPECT_LE(way, std::max(0.0, std::min(meant, length)) + 1e-6) << "face " << i << ", way " << k;
      if (!contact) continue;
      ++met;
      if (contact->fraction == 0) continue;
      EXPECT_NEAR((contact->touchPoint - contact->ballCentre).norm(), radius, 1e-6) << "face " << i << ", way " << k;
      constexpr double kOff = 1.2e-5;
      double off = dense.distance(contact->touchPoint);
      // A bend may be thinner than what lies between two places.
      if (off >= kOff) off = DenseSearch(surface, 2000).distance(contact->touchPoint);
      EXPECT_LT(off, kOff) << "face " << i << ", way " << k;
    }
  }
  EXPECT_GT(met, 15 * faces);
}

/// A cylinder of radius 10 and height 20 as a spline, one pole of its upper end with a weight of many millions.
Handle(Geom_BSplineSurface) cylinderWithAWeight(double weight) {
  constexpr double kRadius = 10, kHeight = 20;
  TColgp_Array2OfPnt poles(1, 2, 1, 9);
  TColStd_Array2OfReal weights(1, 2, 1, 9);
  for (int j = 0; j < 9; ++j) {
    const double turn = j * std::numbers::pi / 4, out = kRadius * (j % 2 == 0 ? 1 : std::numbers::sqrt2);
    for (int i = 0; i < 2; ++i) {
      poles(i + 1, j + 1) = gp_Pnt(out * std::cos(turn), out * std::sin(turn), i * kHeight);
      weights(i + 1, j + 1) = j % 2 == 0 ? 1 : std::numbers::sqrt2 / 2;
    }
  }
  weights(2, 2) = weight;
  TColStd_Array1OfReal ends(1, 2), quarters(1, 5);
  TColStd_Array1OfInteger twice(1, 2), multiplicities(1, 5);
  ends(1) = 0, ends(2) = 1;
  twice.Init(2);
  multiplicities.Init(2);
  multiplicities(1) = multiplicities(5) = 3;
  for (int i = 1; i <= 5; ++i)
    quarters(i) = (i - 1) / 4.0;
  return new Geom_BSplineSurface(poles, weights, ends, quarters, twice, multiplicities, 1, 2);
}

/// The heavy pole draws the upper end of its quarter to itself, and no proof of what a ball meets there comes to an
/// end.
TEST(BentFaces, WithWeightsOfMillionsEndEachQueryAndAreNamed) {
  const ScratchFolder folder;
  for (const double weight : {900.0, 81'186'548.0}) {
    const std::filesystem::path file = folder / "weight.stp";
    ASSERT_TRUE(writeStep(BRepBuilderAPI_MakeFace(cylinderWithAWeight(weight), 1e-7).Face(), file));
    const auto solid = readStep(file);
    ASSERT_TRUE(solid) << format(solid.error());
    std::string remarks;
    for (const Diagnostic& remark : dynamic_cast<const CadSolid&>(**solid).remarks())
      remarks += format(remark) + "\n";
    EXPECT_EQ(remarks.find("1 of 1 faces differ by more than 10000 times") != std::string::npos, weight > 1000)
        << remarks;
    const auto seconds = [] { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
    const double begin = seconds();
    const Vector3 out = Vector3(1, 1, 0).normalized(), up(0, 0, 10);
    const auto bent = (*solid)->firstContact(40 * out + up, 5 * out + up, 2);
    EXPECT_LT(seconds() - begin, 15);
    EXPECT_TRUE(bent || weight > 1000);
    const auto round = (*solid)->firstContact(-40 * out + up, -5 * out + up, 2);
    ASSERT_TRUE(round);
    EXPECT_NEAR(round->ballCentre.dot(out), -12, 1e-6);
  }
}

}  // namespace
}  // namespace probewright::simulation
