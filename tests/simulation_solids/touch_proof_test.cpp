#include "simulation/touch_proof.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

/// Bounds that prove where a ball touches a surface, against the surface itself.
namespace probewright::simulation {
namespace {

/// A surface whose coordinates are cubic polynomials of both parameters.
struct Cubic {
  std::array<std::array<Vector3, 4>, 4> c;  ///< of u^i v^j, where i + j < 4

  Cubic() {
    for (auto& row : c)
      row.fill(Vector3::Zero());
  }
  Vector3 derivative(double u, double v, int du, int dv) const {
    Vector3 sum = Vector3::Zero();
    for (int i = du; i < 4; ++i)
      for (int j = dv; i + j < 4; ++j) {
        double factor = 1;
        for (int k = 0; k < du; ++k)
          factor *= i - k;
        for (int k = 0; k < dv; ++k)
          factor *= j - k;
        sum += factor * std::pow(u, i - du) * std::pow(v, j - dv) *
               c.at(static_cast<std::size_t>(i)).at(static_cast<std::size_t>(j));
      }
    return sum;
  }
  SurfacePoint at(double u, double v) const {
    return {derivative(u, v, 0, 0), derivative(u, v, 1, 0), derivative(u, v, 0, 1),
            derivative(u, v, 2, 0), derivative(u, v, 1, 1), derivative(u, v, 0, 2)};
  }
  double largest(const Vector2& half, int du, int dv) const {
    double most = 0;
    for (int i = -10; i <= 10; ++i)
      for (int j = -10; j <= 10; ++j)
        most = std::max(most, derivative(half.x() * i / 10, half.y() * j / 10, du, dv).norm());
    return most;
  }
  SurfaceBends bends(const Vector2& half) const {
    return {largest(half, 1, 0), largest(half, 0, 1), largest(half, 2, 0), largest(half, 1, 1), largest(half, 0, 2),
            largest(half, 3, 0), largest(half, 2, 1), largest(half, 1, 2), largest(half, 0, 3)};
  }
};

/// Near the sheet x = u, y = v. Where `lean`, its parameter lines draw together within the sheet, otherwise it bends.
Cubic anyCubic(std::mt19937_64& random, bool lean) {
  std::uniform_real_distribution<double> any(-1, 1);
  Cubic cubic;
  cubic.c[1][0] = Vector3::UnitX();
  cubic.c[0][1] = Vector3::UnitY();
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; i + j < 4; ++j) {
      if (i + j < 2) continue;
      const double size = i + j == 2 ? 0.2 : 0.02;
      cubic.c[i][j] = size * Vector3(any(random), any(random), lean ? 0.05 * any(random) : any(random));
    }
  return cubic;
}

/// The second derivatives of half of the square of the distance from the centre are never below the bounds, wherever
/// the surface and whenever the ball is looked at. At one place and time they are the bounds.
TEST(TouchProof, FormBoundsTheCurvingOfTheDistance) {
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> any(-1, 1), share(0.1, 1);
  for (int round = 0; round < 400; ++round) {
    SCOPED_TRACE(round);
    const Cubic cubic = anyCubic(random, round % 2 == 0);
    const Vector2 half(0.5 * share(random), 0.5 * share(random));
    const double time = 0.3 * share(random);
    const Vector3 direction = Vector3(any(random), any(random), any(random)).normalized();
    const SurfacePoint s = cubic.at(0, 0);
    const Vector3 centre = s.point + Vector3(0.2 * any(random), 0.2 * any(random), 2 * share(random));
    const Vector3 w = centre - s.point;
    const auto formWithin = [&](const Vector2& h, double seconds, double longest) {
      const SurfaceBends b = cubic.bends(h);
      return formAbout(s, b, Shift{s, h, b.fromPlane(h), seconds}, w, longest, direction, Vector3::Zero());
    };
    const Form exact = formWithin(Vector2::Zero(), 0, w.norm());
    EXPECT_NEAR(exact.uu, s.u.dot(s.u) - w.dot(s.uu), 1e-12);
    EXPECT_NEAR(exact.uv, std::abs(s.u.dot(s.v) - w.dot(s.uv)), 1e-12);
    EXPECT_NEAR(exact.vv, s.v.dot(s.v) - w.dot(s.vv), 1e-12);

    std::vector<std::pair<SurfacePoint, Vector3>> seen;  // from the surface to the centre
    double longest = 0;
    for (int i = -4; i <= 4; ++i)
      for (int j = -4; j <= 4; ++j)
        for (const double when : {-time, 0.0, time}) {
          const SurfacePoint here = cubic.at(half.x() * i / 4, half.y() * j / 4);
          seen.emplace_back(here, centre + when * direction - here.point);
          longest = std::max(longest, seen.back().second.norm());
        }
    const Form form = formWithin(half, time, longest);
    double least = 1e9, mixed = 0, leastV = 1e9;
    for (const auto& [here, way] : seen) {
      least = std::min(least, here.u.dot(here.u) - way.dot(here.uu));
      mixed = std::max(mixed, std::abs(here.u.dot(here.v) - way.dot(here.uv)));
      leastV = std::min(leastV, here.v.dot(here.v) - way.dot(here.vv));
    }
    EXPECT_LE(form.uu, least + 1e-12);
    EXPECT_GE(form.uv, mixed - 1e-12);
    EXPECT_LE(form.vv, leastV + 1e-12);
  }
}

}  // namespace
}  // namespace probewright::simulation
