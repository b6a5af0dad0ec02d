#include <set>

#include "kinematics_sinumerik/scene.hpp"

/// The lists of results of the manual for CYCLE996: what stands in a list is set, and everything has a meaning.
namespace probewright {
namespace {

using namespace testing_support;
using Indices = std::set<int>;

Indices range(int from, int to) {
  Indices all;
  for (int i = from; i <= to; ++i)
    all.insert(i);
  return all;
}
Indices joined(Indices first, const Indices& second) {
  first.insert(second.begin(), second.end());
  return first;
}

TEST(KinematicsResultLists, AreThoseOfTheManual) {
  KinematicsScene scene(headTable, perfectWorld(headTable.machine));
  const auto expectLists = [&](const Indices& expected, int variant) {
    Indices reals, integers;
    for (const control::ResultRecord& result : scene.bench.control.journal.cycles.back().results) {
      EXPECT_FALSE(result.meaning.empty()) << result.name;
      (result.name.starts_with("_OVR[") ? reals : integers).insert(std::stoi(result.name.substr(5)));
    }
    EXPECT_EQ(reals, expected) << variant;
    EXPECT_EQ(integers, (Indices{2, 3, 8})) << variant;
    EXPECT_EQ(scene.bench.ovi(2), 996);
    EXPECT_EQ(scene.bench.ovi(3), variant);
    EXPECT_EQ(scene.bench.ovi(8), 1);
  };
  const std::array<std::array<Indices, 3>, 2> lists = {
      {{{{40, 41, 42, 43, 60, 66, 67, 68, 71}, {40, 44, 45, 46, 61}, {40, 47, 48, 49, 62, 32, 33, 34}}},
       {{{40, 51, 52, 53, 63}, {40, 54, 55, 56, 64}, {40, 57, 58, 59, 65, 35, 36, 37}}}}};
  for (int axis = 0; axis < 2; ++axis) {
    for (int measurement = 0; measurement < 3; ++measurement) {
      scene.bench.run("CYCLE996", scene.call(axis, measurement), {}, scene.placeFor(axis, measurement));
      const int count = axis == 0 ? measurement + 1 : 3 + 10 * (measurement + 1);
      EXPECT_EQ(scene.bench.ovr(40), count);
      expectLists(lists[static_cast<std::size_t>(axis)][static_cast<std::size_t>(measurement)],
                  10000 * (axis + 1) + 101 + measurement);
    }
  }
  scene.calculate();
  expectLists(joined(joined(range(1, 12), range(15, 20)), joined(range(32, 37), {40})), 1000);
  // A new beginning clears the places of its axis only.
  const double other = scene.bench.ovr(51);
  scene.bench.run("CYCLE996", scene.call(0, 0), {}, scene.placeFor(0, 0));
  for (int i = 44; i <= 49; ++i)
    EXPECT_EQ(scene.bench.ovr(i), 0) << i;
  EXPECT_EQ(scene.bench.ovr(51), other);
  EXPECT_EQ(scene.bench.ovr(40), 31);
}

}  // namespace
}  // namespace probewright
