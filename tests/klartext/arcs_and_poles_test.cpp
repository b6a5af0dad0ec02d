#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "klartext/expectations.hpp"
#include "klartext/host_world.hpp"

/// Circles, helices and polar coordinates with the tool in every axis, held against their geometry.
namespace probewright::language::klartext::testing {
namespace {

/// The plane of a tool axis: main and minor axis, and the axis of the tool.
struct Plane {
  std::string axes;

  std::string block(double main, double minor) const {
    return fmt::format("{}{:+.6f} {}{:+.6f}", axes[0], main, axes[1], minor);
  }
  /// Main axis, minor axis and height of a place.
  Vector3 of(const Vector3& place) const { return {place[axes[0] - 'X'], place[axes[1] - 'X'], place[axes[2] - 'X']}; }
};

const std::vector<Plane>& planes() {
  static const std::vector<Plane> all = {{"XYZ"}, {"YZX"}, {"ZXY"}};
  return all;
}

constexpr double radiansOfDegree = std::numbers::pi / 180;

/// The places after the one where the blocks begin, 10 from the centre (3, -22), at 36.87 degrees and a height of -24.
std::vector<Vector3> travelled(const Plane& plane, const std::string& blocks) {
  World world;
  const std::string text = fmt::format("TOOL CALL 5 {}\nL {} {}-24 R0 FMAX\nCC {}\n{}\n", plane.axes[2],
                                       plane.block(11, -16), plane.axes[2], plane.block(3, -22), blocks);
  const RunResult result = world.run(text);
  expectFinished(result);
  std::vector<Vector3> places;
  for (const Vector3& place : world.path())
    places.push_back(plane.of(place));
  EXPECT_GT(places.size(), 1U) << text;
  const Vector3 start(11, -16, -24);
  while (!places.empty() && (places.front() - start).norm() > 1e-5)
    places.erase(places.begin());
  EXPECT_FALSE(places.empty()) << text;
  return places;
}

const double startAngle = std::atan2(6, 8) / radiansOfDegree;

TEST(Poles, GiveWhatABlockLeavesOut) {
  struct Part {
    std::string text;
    double value;
  };
  const std::vector<Part> radii = {{"", 10}, {"PR+7", 7}, {"IPR+3.5", 13.5}, {"IPR-4", 6}};
  const std::vector<Part> angles = {
      {"", startAngle}, {"PA+115", 115}, {"PA-20", -20}, {"IPA+40", startAngle + 40}, {"IPA-200", startAngle - 200}};
  const std::vector<Part> heights = {{"", -24}, {"-3", -3}, {"I+5", -19}};
  for (const Plane& plane : planes()) {
    for (const Part& radius : radii) {
      for (const Part& angle : angles) {
        for (const Part& height : heights) {
          if (radius.text.empty() && angle.text.empty()) continue;
          const bool incremental = height.text.starts_with("I");
          const std::string along = height.text.empty() ? ""
                                                        : fmt::format(" {}{}{}", incremental ? "I" : "", plane.axes[2],
                                                                      height.text.substr(incremental ? 1 : 0));
          const std::string block = "LP " + radius.text + " " + angle.text + along + " R0 FMAX";
          SCOPED_TRACE(plane.axes + " " + block);
          const std::vector<Vector3> places = travelled(plane, block);
          ASSERT_FALSE(places.empty());
          const double turned = angle.value * radiansOfDegree;
          const Vector3 meant(3 + radius.value * std::cos(turned), -22 + radius.value * std::sin(turned), height.value);
          EXPECT_LT((places.back() - meant).norm(), 1e-5) << places.back().transpose();
        }
      }
    }
  }
}

struct Arc {
  std::string block;  ///< with {end} for the end point at an angle of 100 degrees
  double sweep;       ///< degrees, anticlockwise positive
  double rise = 0;
  bool otherCentre = false;  ///< on the other side of the chord
};

TEST(Arcs, StayOnTheirCirclesAtEveryHeight) {
  const double forth = 100 - startAngle, back = forth - 360;
  const std::vector<Arc> arcs = {
      {"C {end} DR+", forth},
      {"C {end} DR-", back},
      {"C {start} DR+", 360},
      {"C {start} DR-", -360},
      {"C {end} I{t}+6 DR+", forth, 6},
      {"C {end} {t}-30 DR-", back, -6},
      {"CR {end} R+10 DR+", forth},
      {"CR {end} R-10 DR-", back},
      {"CR {end} R-10 DR+", 360 - forth, 0, true},
      {"CR {end} R+10 DR-", -forth, 0, true},
      {"CP PA+100 DR+", forth},
      {"CP PA+100 DR-", back},
      {"CP IPA+70 DR+", 70},
      {"CP IPA-70 DR-", -70},
      {"CP IPA+800 I{t}+12 DR+", 800, 12},
      {"CP IPA-800 {t}-30 DR-", -800, -6},
  };
  const Vector2 centre(3, -22);
  const auto at = [&](double degrees) {
    return Vector2(centre + 10 * Vector2(std::cos(degrees * radiansOfDegree), std::sin(degrees * radiansOfDegree)));
  };
  for (const Plane& plane : planes()) {
    for (const Arc& arc : arcs) {
      std::string block = arc.block;
      const auto put = [&](const std::string& name, const std::string& text) {
        if (const std::size_t place = block.find(name); place != std::string::npos)
          block.replace(place, name.size(), text);
      };
      put("{end}", plane.block(at(100).x(), at(100).y()));
      put("{start}", plane.block(11, -16));
      put("{t}", plane.axes.substr(2));
      SCOPED_TRACE(plane.axes + " " + block);
      const std::vector<Vector3> places = travelled(plane, block + " F500");
      ASSERT_GT(places.size(), 4U);
      const Vector2 middle = arc.otherCentre ? Vector2(at(startAngle) + at(100) - centre) : centre;
      double angle = 0;
      for (std::size_t i = 1; i < places.size(); ++i) {
        const Vector2 before = places[i - 1].head<2>() - middle, now = places[i].head<2>() - middle;
        EXPECT_NEAR(now.norm(), 10, 1e-4);
        angle += std::atan2(before.x() * now.y() - before.y() * now.x(), before.dot(now)) / radiansOfDegree;
        EXPECT_NEAR(places[i].z(), -24 + arc.rise * angle / arc.sweep, 1e-4) << i;
      }
      EXPECT_NEAR(angle, arc.sweep, 1e-3);
    }
  }
}

}  // namespace
}  // namespace probewright::language::klartext::testing
