#include "simulation/spline_net.hpp"

#include <gtest/gtest.h>

#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <algorithm>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include "worlds.hpp"

/// Values, derivatives and their bounds, judged by OpenCASCADE's.
namespace probewright::simulation {
namespace {

using namespace testing;

Handle(Geom_BSplineSurface) randomSpline(std::mt19937_64& random, bool isRational) {
  const int degree = 2 + static_cast<int>(random() % 3), pieces = 1 + static_cast<int>(random() % 5);
  TColStd_Array1OfReal knots(1, pieces + 1);
  TColStd_Array1OfInteger multiplicities(1, pieces + 1);
  double at = 0;
  for (int i = 1; i <= pieces + 1; ++i) {
    knots(i) = at;
    at += uniform(random, 0.2, 1);
    multiplicities(i) = i == 1 || i == pieces + 1 ? degree + 1 : 1;
  }
  const int count = degree + pieces;
  TColgp_Array2OfPnt poles(1, count, 1, count);
  TColStd_Array2OfReal weights(1, count, 1, count);
  for (int i = 1; i <= count; ++i) {
    for (int j = 1; j <= count; ++j) {
      poles(i, j) = gp_Pnt(5 * i + uniform(random, -1, 1), 5 * j + uniform(random, -1, 1), uniform(random, -3, 3));
      weights(i, j) = isRational ? uniform(random, 0.7, 1.5) : 1;
    }
  }
  const Handle(Geom_BSplineSurface) surface =
      new Geom_BSplineSurface(poles, weights, knots, knots, multiplicities, multiplicities, degree, degree);
  if (pieces > 3 && random() % 2 == 0) surface->SetUPeriodic();
  return surface;
}

TEST(SplineNet, BoundsWhatASplineDoesBetweenItsKnots) {
  std::mt19937_64 random(5);
  for (int k = 0; k < 60; ++k) {
    const Handle(Geom_BSplineSurface) surface = randomSpline(random, k % 2 == 0);
    const auto net = SplineNet::of(surface);
    ASSERT_TRUE(net);
    Vector2 first, last;
    surface->Bounds(first.x(), last.x(), first.y(), last.y());
    for (int i = 0; i < 20; ++i) {
      const auto place = [&] {
        return Vector2(uniform(random, first.x(), last.x()), uniform(random, first.y(), last.y()));
      };
      const Vector2 a = place(), b = a + uniform(random, 0, 1) * (place() - a);
      const Vector2 low = a.cwiseMin(b), high = a.cwiseMax(b);
      const SurfaceBends bends = net->bends(low, high);
      for (int m = 0; m < 10; ++m) {
        const Vector2 at = low + (high - low).cwiseProduct(Vector2(uniform(random, 0, 1), uniform(random, 0, 1)));
        gp_Pnt p;
        gp_Vec u, v, uu, vv, uv, uuu, vvv, uuv, uvv;
        surface->D3(at.x(), at.y(), p, u, v, uu, vv, uv, uuu, vvv, uuv, uvv);
        const SurfacePoint found = net->at(at);
        const auto apart = [](const Vector3& mine, const auto& theirs) {
          return (mine - Vector3(theirs.X(), theirs.Y(), theirs.Z())).norm();
        };
        EXPECT_LT(apart(found.point, p), 1e-9);
        EXPECT_LT(std::max({apart(found.u, u), apart(found.v, v)}), 1e-8);
        EXPECT_LT(std::max({apart(found.uu, uu), apart(found.uv, uv), apart(found.vv, vv)}), 1e-6);
        constexpr double kRounding = 1e-6;
        for (const auto& [most, size] :
             {std::pair(bends.u, u.Magnitude()), std::pair(bends.v, v.Magnitude()), std::pair(bends.uu, uu.Magnitude()),
              std::pair(bends.uv, uv.Magnitude()), std::pair(bends.vv, vv.Magnitude()),
              std::pair(bends.uuu, uuu.Magnitude()), std::pair(bends.uuv, uuv.Magnitude()),
              std::pair(bends.uvv, uvv.Magnitude()), std::pair(bends.vvv, vvv.Magnitude())})
          EXPECT_GE(most, size - kRounding);
        // Along a direction, of the numerator less a point times the weight; bounded where few pieces lie in the box.
        const Vector3 normal = Vector3(uniform(random, -1, 1), uniform(random, -1, 1), 1).normalized();
        const auto curving = net->curving(low, high, found.point, normal);
        if (!curving || surface->IsURational()) continue;
        const auto along = [&](const gp_Vec& d) { return normal.dot(Vector3(d.X(), d.Y(), d.Z())); };
        EXPECT_GE(curving->riseUu, along(uu) - kRounding);
        EXPECT_GE(curving->riseVv, along(vv) - kRounding);
        EXPECT_GE(curving->riseUv, std::abs(along(uv)) - kRounding);
        EXPECT_GE(curving->uu, uu.Magnitude() - kRounding);
      }
    }
  }
}

}  // namespace
}  // namespace probewright::simulation
