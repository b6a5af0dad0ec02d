#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sinumerik/world.hpp"

/// Arcs with whole turns and a rise, in every plane and both ways round.
namespace probewright::language::sinumerik {
namespace {

struct Plane {
  int function;
  std::string axes;     ///< 1st, 2nd, 3rd axis of the plane
  std::string centres;  ///< the addresses of the centre in the first two
};

TEST(SinumerikHelix, RisesEvenlyOnItsCylinder) {
  const std::vector<Plane> planes = {{17, "XYZ", "IJ"}, {18, "ZXY", "KI"}, {19, "YZX", "JK"}};
  for (const Plane& plane : planes) {
    for (const bool anticlockwise : {true, false}) {
      for (const int turns : {0, 1, 3}) {
        for (const double rise : {-9.0, 0.0, 4.5}) {
          World world;
          const auto& a = plane.axes;
          const std::string text =
              fmt::format("G{} G0 {}30 {}5 {}-40\nF1000 {} {}20 {}15 {}{} {}-10 {}0{}\n", plane.function, a[0], a[1],
                          a[2], anticlockwise ? "G3" : "G2", a[0], a[1], a[2], rise - 40, plane.centres[0],
                          plane.centres[1], turns > 0 ? fmt::format(" TURN={}", turns) : "");
          SCOPED_TRACE(text);
          world.run(text);
          ASSERT_GT(world.machine.moves.size(), 4U);
          const double sweep = anticlockwise ? 90 + 360 * turns : -270 - 360 * turns;
          Vector2 before(10, 0);
          double angle = 0;
          Vector3 tip;
          for (std::size_t i = 1; i < world.machine.moves.size(); ++i) {
            const Vector3 place = world.control.channel.programFromAxes(world.machine.moves[i].to).vector();
            tip = {place[a[0] - 'X'], place[a[1] - 'X'], place[a[2] - 'X']};
            const Vector2 now = tip.head<2>() - Vector2(20, 5);
            EXPECT_NEAR(now.norm(), 10, 1e-9);
            angle += std::atan2(before.x() * now.y() - before.y() * now.x(), before.dot(now)) * 180 / std::numbers::pi;
            EXPECT_NEAR(tip.z(), -40 + rise * angle / sweep, 1e-9);
            before = now;
          }
          EXPECT_NEAR(angle, sweep, 1e-6);
          EXPECT_LT((tip - Vector3(20, 15, rise - 40)).norm(), 1e-9);
        }
      }
    }
  }
}

}  // namespace
}  // namespace probewright::language::sinumerik
