#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sinumerik/world.hpp"

/// Roundings and chamfers between the blocks of a contour, held against closed forms.
namespace probewright::language::sinumerik {
namespace {

/// The ends of the moves of `program`, which begins at the origin at rest.
std::vector<Vector3> pathOf(World& world, const std::string& program) {
  world.run("G90 G0 X0 Y0 Z0\n");
  const std::size_t before = world.machine.moves.size();
  world.run("F1000\n" + program);
  std::vector<Vector3> path;
  for (std::size_t i = before; i < world.machine.moves.size(); ++i)
    path.push_back(world.control.channel.programFromAxes(world.machine.moves[i].to).vector());
  return path;
}

double distanceToSegment(const Vector3& point, const Vector3& a, const Vector3& b) {
  const Vector3 along = b - a;
  const double fraction = std::clamp((point - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (point - a - fraction * along).norm();
}

/// A path that leads over a circle: it has a point at both its ends, and between them all points lie on it.
void expectArc(const std::vector<Vector3>& path, const Vector3& from, const Vector3& to, const Vector3& centre,
               double radius) {
  const auto at = [&](const Vector3& wanted) {
    return std::find_if(path.begin(), path.end(), [&](const Vector3& p) { return (p - wanted).norm() < 1e-9; });
  };
  const auto first = at(from), last = at(to);
  ASSERT_NE(first, path.end()) << from.transpose();
  ASSERT_NE(last, path.end()) << to.transpose();
  EXPECT_GT(last - first, 2) << "an arc is more than its chord";
  for (auto point = first; point != last; ++point)
    EXPECT_NEAR((*point - centre).norm(), radius, 1e-9);
}

TEST(SinumerikCorner, RoundingBetweenLines) {
  World world;
  const auto square = pathOf(world, "G1 X20 RND=5\nY20\n");
  EXPECT_LT((square.front() - Vector3(15, 0, 0)).norm(), 1e-12);
  expectArc(square, {15, 0, 0}, {20, 5, 0}, {15, 5, 0}, 5);
  EXPECT_LT((square.back() - Vector3(20, 20, 0)).norm(), 1e-12);
  // Turning by 120 degrees to the right: the tangent points lie r tan(60) from the corner.
  const double root = std::sqrt(3.0);
  const auto sharp = pathOf(world, "G1 X40 RND=4\nX=IC(-15) Y=IC(-15*SQRT(3))\n");
  const double t = 4 * root;
  expectArc(sharp, {40 - t, 0, 0}, {40 - t / 2, -t * root / 2, 0}, {40 - t, -4, 0}, 4);
}

TEST(SinumerikCorner, RoundingBetweenLineAndArc) {
  World world;
  // The arc begins as far to the right of the origin as its centre lies to the left.
  const Vector3 opposite(-10, 0, 0), inside(-10 + std::sqrt(19.0 * 19.0 - 1.0), 1, 0);
  expectArc(pathOf(world, "G1 X10 RND=1\nG3 X-30 Y0 CR=20\n"), opposite + 20 * (inside - opposite) / 19, {-30, 0, 0},
            opposite, 20);
  const auto path = pathOf(world, "G1 X20 RND=4\nG2 X40 Y0 CR=10\n");
  const Vector3 hub(30, 0, 0), centre(30 - std::sqrt(14.0 * 14.0 - 16.0), 4, 0);
  expectArc(path, {centre.x(), 0, 0}, hub + 10 * (centre - hub) / 14, centre, 4);
  EXPECT_LT((path.back() - Vector3(40, 0, 0)).norm(), 1e-12);
  // The same way back: arc, then line.
  const auto back = pathOf(world, "G0 X40\nG3 X20 Y0 CR=10 RND=4\nG1 X0\n");
  expectArc(back, hub + 10 * (centre - hub) / 14, {centre.x(), 0, 0}, centre, 4);
}

TEST(SinumerikCorner, RoundingBetweenArcs) {
  World world;
  const auto path = pathOf(world, "G2 X16 Y0 CR=10 RND=3\nX32 CR=10\n");
  const Vector3 left(8, -6, 0), right(24, -6, 0), centre(16, -6 + std::sqrt(13.0 * 13.0 - 64.0), 0);
  expectArc(path, left + 10 * (centre - left) / 13, right + 10 * (centre - right) / 13, centre, 3);
  // Inside of both circles.
  const auto inside = pathOf(world, "G3 X16 Y0 CR=10 RND=3\nX0 Y0 CR=10\n");
  const Vector3 upper(8, 6, 0), lower(8, -6, 0), middle(8 + std::sqrt(49.0 - 36.0), 0, 0);
  expectArc(inside, upper + 10 * (middle - upper) / 7, lower + 10 * (middle - lower) / 7, middle, 3);
}

TEST(SinumerikCorner, ChamfersByLengthAndByWidth) {
  World world;
  for (const char* word : {"CHR=3", "CHF=3*SQRT(2)"}) {
    const auto path = pathOf(world, std::string("G1 X20 ") + word + "\nY20\n");
    ASSERT_EQ(path.size(), 3u) << word;
    EXPECT_LT((path[0] - Vector3(17, 0, 0)).norm(), 1e-9);
    EXPECT_LT((path[1] - Vector3(20, 3, 0)).norm(), 1e-9);
  }
  const auto arc = pathOf(world, "G1 X20 CHR=3\nG2 X40 Y0 CR=10\n");
  EXPECT_LT((arc[0] - Vector3(17, 0, 0)).norm(), 1e-9);
  EXPECT_NEAR((arc[1] - Vector3(20, 0, 0)).norm(), 3, 1e-9);
  EXPECT_NEAR((arc[1] - Vector3(30, 0, 0)).norm(), 10, 1e-9);
  const auto length = pathOf(world, "G1 X20 CHF=3\nG2 X40 Y0 CR=10\n");
  EXPECT_NEAR((length[1] - length[0]).norm(), 3, 1e-9);
  EXPECT_NEAR((length[1] - Vector3(20, 0, 0)).norm(), (length[0] - Vector3(20, 0, 0)).norm(), 1e-9);
}

TEST(SinumerikCorner, WhatIsTooLargeBecomesAsLargeAsTheElementsPermit) {
  World world;
  expectArc(pathOf(world, "G1 X20 RND=100\nY12\n"), {8, 0, 0}, {20, 12, 0}, {8, 12, 0}, 12);
  const auto chamfer = pathOf(world, "G1 X20 CHR=100\nY12\n");
  EXPECT_LT((chamfer[0] - Vector3(8, 0, 0)).norm(), 1e-9);
  EXPECT_LT((chamfer[1] - Vector3(20, 12, 0)).norm(), 1e-9);
}

TEST(SinumerikCorner, ModalRoundingTakesEveryCornerUntilItEnds) {
  World world;
  const auto path = pathOf(world, "RNDM=2\nG1 X20\nR1=1 M8\nY20\nX0 CHR=1\nY10 RNDM=0\nX10\n");
  expectArc(path, {18, 0, 0}, {20, 2, 0}, {18, 2, 0}, 2);
  expectArc(path, {20, 18, 0}, {18, 20, 0}, {18, 18, 0}, 2);
  const std::vector<Vector3> rest(path.end() - 4, path.end());
  EXPECT_LT((rest[0] - Vector3(1, 20, 0)).norm(), 1e-9);
  EXPECT_LT((rest[1] - Vector3(0, 19, 0)).norm(), 1e-9);
  EXPECT_LT((rest[2] - Vector3(0, 10, 0)).norm(), 1e-9) << "RNDM=0 leaves the corner as it is";
}

TEST(SinumerikCorner, NothingIsInsertedOutsideOfThePlane) {
  World world;
  const auto path = pathOf(world, "G1 X20 RND=3\nZ-5\nX30 RND=3\nX40\nY5 RND=3\nM30\n");
  ASSERT_EQ(path.size(), 5u);
  EXPECT_EQ(path[0], Vector3(20, 0, 0));
  EXPECT_EQ(path[2], Vector3(30, 0, -5)) << "the lines go over into each other";
  EXPECT_EQ(path[4], Vector3(40, 5, -5)) << "nothing follows";
}

TEST(SinumerikCorner, PlanesInchesAndFeeds) {
  World world;
  expectArc(pathOf(world, "G18 G1 Z20 RND=5\nX20\nG17\n"), {0, 0, 15}, {5, 0, 20}, {5, 0, 15}, 5);
  expectArc(pathOf(world, "G19 G1 Y20 RND=5\nZ20\nG17\n"), {0, 15, 0}, {0, 20, 5}, {0, 15, 5}, 5);
  expectArc(pathOf(world, "G70\nG1 X1 RND=0.5\nY1\nG71\n"), {12.7, 0, 0}, {25.4, 12.7, 0}, {12.7, 12.7, 0}, 12.7);
  world.run("G0 X0 Y0 Z0\n");
  std::size_t first = world.machine.moves.size();
  world.run("G1 F1000 X20 CHR=3 FRC=200\nY20 F500 CHR=3\nX0\n");
  const auto feedOf = [&](std::size_t move) { return world.machine.moves.at(first + move).feed.perMinute; };
  EXPECT_EQ(feedOf(0), 1000);
  EXPECT_EQ(feedOf(1), 200);
  EXPECT_EQ(feedOf(2), 500);
  EXPECT_EQ(feedOf(3), 500) << "without FRC that of the next block";
  first = world.machine.moves.size();
  world.run("G0 X0 Y0\nG1 FRCM=300 X20 CHR=3\nY20\nFRCM=0\n");
  EXPECT_EQ(feedOf(2), 300);
  EXPECT_EQ(world.alarm("G1 X30 RND=-1\n"), "14020");
}

TEST(SinumerikCorner, TheToolCentreGoesAroundTheRoundedContour) {
  World world;
  world.run("T=\"MILL\" D1 M6\nG0 X0 Y-30 Z0\n");
  const std::size_t before = world.machine.moves.size();
  world.run("F1000 G1 G42 X0 Y0\nX40 RND=8\nY40\nX0\nG40 X-30\n");
  const Vector3 corners[] = {{0, 0, 0}, {32, 0, 0}, {40, 8, 0}, {40, 40, 0}, {0, 40, 0}};
  for (std::size_t i = before + 1; i + 1 < world.machine.moves.size(); ++i) {
    const Vector3 point = world.control.channel.programFromAxes(world.machine.moves[i].to).vector();
    double least = 1e9;
    for (const auto& [a, b] : {std::pair{0, 1}, std::pair{2, 3}, std::pair{3, 4}})
      least = std::min(least, distanceToSegment(point, corners[a], corners[b]));
    const Vector3 arm = point - Vector3(32, 8, 0);
    if (arm.x() >= 0 && arm.y() <= 0) least = std::abs(arm.norm() - 8);
    EXPECT_NEAR(least, 5, 1e-9) << point.transpose();
  }
}

TEST(SinumerikCorner, LinesGivenByTheirAngle) {
  World world;
  const auto tip = [&] { return world.control.channel.position().vector(); };
  world.run("G90 G0 X0 Y0 Z0\nG1 F500 X20 ANG=30\n");
  EXPECT_LT((tip() - Vector3(20, 20 * std::tan(std::numbers::pi / 6), 0)).norm(), 1e-9);
  world.run("G0 X0 Y0\nG1 Y20 ANG=120\n");
  EXPECT_LT((tip() - Vector3(-20 / std::sqrt(3.0), 20, 0)).norm(), 1e-9);
  // Two lines: the first by its angle alone, both by the end of the second.
  world.run("G0 X0 Y0\n");
  const std::size_t before = world.machine.moves.size();
  world.run("G1 ANG=45\nX40 Y10 ANG=0\n");
  EXPECT_LT(
      (world.control.channel.programFromAxes(world.machine.moves.at(before).to).vector() - Vector3(10, 10, 0)).norm(),
      1e-9);
  expectArc(pathOf(world, "G1 ANG=90 RND=4\nX40 Y10 ANG=0\n"), {0, 6, 0}, {4, 10, 0}, {4, 6, 0}, 4);
  EXPECT_EQ(world.alarm("G1 X50 ANG=90\n"), "14090");
  EXPECT_EQ(world.alarm("G1 ANG=45\nX90 Y90\n"), "14090");
  EXPECT_EQ(world.alarm("G1 X50 ANG1=90 ANG2=0\n"), "12080");
}

}  // namespace
}  // namespace probewright::language::sinumerik
