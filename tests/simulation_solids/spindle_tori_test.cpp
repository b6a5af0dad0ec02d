#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "meant.hpp"
#include "simulation/cad_solid.hpp"
#include "written_step.hpp"

/// Tori that meet themselves, in STEP files: the outer part of a spindle torus (apple), the inner one (lemon), the horn
/// torus between them and a ring torus.
namespace probewright::simulation {
namespace {

using namespace testing;
using ::testing::HasSubstr;

struct Part {
  std::string name;
  Meridian meridian;
  double size = 30;
};

/// Tube 10 about a ring of 6 (they meet at Z +-8), 10 and 14.
std::vector<Part> parts() {
  return {
      {"apple", {{{0, -8, true, 6, 0, true}, {0, 8}}}},
      {"apple with flat ends", {{{0, -7}, {6 + std::sqrt(51), -7, true, 6, 0, true}, {6 + std::sqrt(75), 5}, {0, 5}}}},
      {"half an apple with a dimple", {{{0, 0}, {16, 0, true, 6, 0, true}, {0, 8}}}},
      {"apple with a cut dimple", {{{0, 0}, {16, 0, true, 6, 0, true}, {2, std::sqrt(84)}, {0, std::sqrt(84)}}}},
      {"lemon", {{{0, -8, true, -6, 0, true}, {0, 8}}}, 16},
      {"lemon with flat ends",
       {{{0, -5}, {std::sqrt(75) - 6, -5, true, -6, 0, true}, {std::sqrt(91) - 6, 3}, {0, 3}}},
       10},
      {"half a lemon", {{{0, 0}, {4, 0, true, -6, 0, true}, {0, 8}}}, 10},
      {"horn torus", {{{20, 0, true, 10, 0, true}}}, 40},
      {"half a horn torus", {{{0, 0}, {20, 0, true, 10, 0, true}}}, 40},
      {"ring torus", {{{24, 0, true, 14, 0, true}}}, 48},
  };
}

std::vector<std::pair<std::string, Dialect>> dialects() {
  std::vector<std::pair<std::string, Dialect>> all;
  for (const auto loops : {Dialect::Loops::Seam, Dialect::Loops::TwoCircles, Dialect::Loops::Sectors}) {
    for (int variant = 0; variant < 4; ++variant) {
      Dialect how;
      how.loops = loops;
      how.sectors = 3;
      how.seamAt = variant * 1.7;
      how.axesDown = variant % 2 == 1;
      how.loopsReversed = variant >= 2;
      how.edgesReversed = variant == 1 || variant == 2;
      how.firstEdge = variant;
      all.emplace_back(fmt::format("loops {} variant {}", static_cast<int>(loops), variant), how);
    }
  }
  return all;
}

TEST(SpindleTori, AreMetOnThePartThatTheFileNames) {
  std::mt19937_64 random(77);
  for (const Part& part : parts()) {
    for (const auto& [how, dialect] : dialects()) {
      // Of a horn torus that ends at its own point, as a loop that is a point, nothing can be read; it is named below.
      if (part.name == "half a horn torus" && dialect.loops == Dialect::Loops::TwoCircles) continue;
      const Pose pose = randomPose(random, 20);
      StepFile file;
      const std::string text = file.withItems({file.solid(revolvedFaces(file, part.meridian, pose, dialect))});
      const Pose back = pose.inverse();
      expectStepAsMeant(
          part.name + ", " + how, text, [&](const Vector3& p) { return part.meridian.distance(back * p); }, part.size,
          pose.translation(), random, 40);
    }
  }
}

TEST(SpindleTori, ThatCannotBeReadAreNamed) {
  StepFile file;
  Dialect point;
  point.loops = Dialect::Loops::TwoCircles;
  const Meridian half{{{0, 0}, {20, 0, true, 10, 0, true}}};
  EXPECT_THAT(saidOf(file.withItems({file.solid(revolvedFaces(file, half, Pose::Identity(), point))})),
              HasSubstr("(torus) cannot be meshed and is missing"));
}

}  // namespace
}  // namespace probewright::simulation
