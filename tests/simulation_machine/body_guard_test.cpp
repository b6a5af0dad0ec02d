#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "machine/links.hpp"
#include "simulation/body_guard.hpp"
#include "simulation/mesh_solid.hpp"
#include "support/virtual_world.hpp"

/// Where two bodies first meet on random moves, against boxes that are tested for separating axes at many places of the
/// way.
namespace probewright::simulation {
namespace {

using testing_support::perfectWorld;
using testing_support::positions;

/// How far apart two boxes are along the direction that separates them best; below 0 they overlap.
double separation(const Vector3& halfOne, const Vector3& halfOther, const Pose& oneFromOther) {
  std::vector<Vector3> directions;
  const std::array<Vector3, 3> own = {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
  for (const Vector3& axis : own) {
    directions.push_back(axis);
    directions.emplace_back(oneFromOther.linear() * axis);
    for (const Vector3& other : own) {
      const Vector3 across = axis.cross(oneFromOther.linear() * other);
      if (across.norm() > 1e-6) directions.push_back(across.normalized());
    }
  }
  double best = -1e300;
  for (const Vector3& direction : directions) {
    const double one = halfOne.dot(direction.cwiseAbs());
    const double other = halfOther.dot((oneFromOther.linear().transpose() * direction).cwiseAbs());
    best = std::max(best, std::abs(direction.dot(oneFromOther.translation())) - one - other);
  }
  return best;
}

/// A sheet of metal as it may come from a CAD system: a rectangle without thickness.
std::shared_ptr<const Solid> sheet(const Vector3& half) {
  TriangleMesh mesh;
  mesh.corners = {
      {-half.x(), -half.y(), 0}, {half.x(), -half.y(), 0}, {half.x(), half.y(), 0}, {-half.x(), half.y(), 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return std::make_shared<MeshSolid>(std::move(mesh));
}

enum class Cradle : std::uint8_t { Box, Sheet };

void expectTheFirstContactOnRandomMoves(Cradle kind) {
  std::mt19937_64 random(20261122);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int hits = 0, misses = 0;
  for (int world = 0; world < 150; ++world) {
    Truth truth = perfectWorld("mill5-table-table");
    const machine::MachineDescription& machine = truth.machine;
    const machine::Link cradle = machine::linkNamed(machine, "A").value(), head = machine::headLink(machine);
    const Vector3 halfHead(between(10, 60), between(10, 60), between(10, 60));
    Vector3 halfCradle(between(10, 80), between(10, 80), between(10, 80));
    if (kind == Cradle::Sheet) halfCradle.z() = 0;
    const Pose headFromBox = translation({0, 0, halfHead.z()});
    const Pose cradleFromBox = translation({between(-100, 100), between(-100, 100), between(-600, -480)}) *
                               rotation(Vector3(1, 2, 3).normalized(), between(0, 180));
    truth.bodies.push_back({"head", head, std::make_shared<Box>(-halfHead, halfHead), headFromBox});
    truth.bodies.push_back(
        {"cradle", cradle,
         kind == Cradle::Sheet ? sheet(halfCradle) : std::make_shared<const Box>(-halfCradle, halfCradle),
         cradleFromBox});
    const auto from = positions({between(-300, 300), between(-250, 250), between(-200, 0), between(-90, 90), 0});
    const auto to = positions({between(-100, 100), between(-100, 100), between(-540, -420), between(-90, 90), 0});
    const auto apart = [&](double fraction) {
      machine::AxisPositions q = from;
      for (std::size_t i = 0; i < 5; ++i)
        q[i] += fraction * (to[i] - from[i]);
      const Pose cradleBox = machine::baseFromLink(machine, q, cradle) * cradleFromBox;
      return separation(halfCradle, halfHead,
                        cradleBox.inverse() * machine::baseFromLink(machine, q, head) * headFromBox);
    };
    if (apart(0) < 0.1) continue;
    // The first place where they overlap, to a thousandth of the way and then by halving.
    constexpr int places = 2000;
    double expected = 2, least = 1e300;
    for (int i = 1; i <= places && expected > 1; ++i) {
      double high = static_cast<double>(i) / places, low = high - 1.0 / places;
      least = std::min(least, apart(high));
      if (apart(high) > 0) continue;
      for (int k = 0; k < 40; ++k)
        (apart(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
      expected = high;
    }
    BodyGuard guard(truth);
    const TrueKinematics kinematics(machine, truth.errors);
    const Motion motion{kinematics, from, to, from, 0, MotionProfile(500, 100, 1000)};
    const auto hit = guard.firstHit(motion, 1, ToolShape(), BodyGuard::Touching::Counts, {});
    SCOPED_TRACE(world);
    if (expected > 1) {
      // Boxes that pass each other closer than triangles are searched may be taken for a contact.
      if (least > 0.01) {
        EXPECT_FALSE(hit) << "they stay " << least << " mm apart";
      }
      ++misses;
      continue;
    }
    ASSERT_TRUE(hit) << "they meet after " << expected << " of the way";
    // Where they come together slowly a hundredth of a millimetre is a longer way: compare the gap there.
    EXPECT_LE(hit->fraction, expected + 1e-4);
    EXPECT_LT(apart(hit->fraction), 0.01) << hit->fraction << ", not " << expected;
    ++hits;
  }
  EXPECT_GT(hits, 10);
  EXPECT_GT(misses, 15);
}

TEST(BodyGuard, FindsTheFirstContactOfBoxesOnRandomMoves) { expectTheFirstContactOnRandomMoves(Cradle::Box); }

TEST(BodyGuard, FindsTheFirstContactOfSheetsOnRandomMoves) { expectTheFirstContactOnRandomMoves(Cradle::Sheet); }

}  // namespace
}  // namespace probewright::simulation
