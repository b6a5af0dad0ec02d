#include "simulation/search_tree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/mesh_solid.hpp"
#include "worlds.hpp"

namespace probewright::simulation {

static const char* nameOf(Instructions instructions) { return instructions == Instructions::Plain ? "plain" : "wide"; }
static void PrintTo(Instructions instructions, std::ostream* out) { *out << nameOf(instructions); }

namespace {

using testing::randomDirection;
using testing::randomPoint;
using testing::uniform;

/// Every triangle looked at: what a search must come to.
Meeting meetingWithAny(const std::vector<SearchElement>& elements, const Mover& mover) {
  Meeting best;
  for (const SearchElement& element : elements) {
    if (mover.axis.isZero()) {
      sweepTriangle(mover.way, mover.radius, element.corners, best);
    } else {
      sweepCapsule(mover.way, mover.radius, mover.axis, element.corners, best);
    }
  }
  return best;
}

Meeting meetingFound(const SearchTree& tree, const Mover& mover, std::size_t* visits = nullptr) {
  Meeting best;
  tree.search(mover, best, [&](std::uint32_t, const Triangle& triangle) {
    if (visits != nullptr) ++*visits;
    if (mover.axis.isZero()) {
      sweepTriangle(mover.way, mover.radius, triangle, best);
    } else {
      sweepCapsule(mover.way, mover.radius, mover.axis, triangle, best);
    }
  });
  return best;
}

/// A surface over x and y with waves, ridges and steps, `cells` squares a side.
std::vector<SearchElement> landscape(std::mt19937_64& random, int cells, double size) {
  const double waves = uniform(random, 0.5, 4);
  const double amplitude = uniform(random, 0, 0.2) * size;
  const double step = uniform(random, 0, 0.1) * size;
  const auto place = [&](int i, int j) {
    const double x = size * i / cells;
    const double y = size * j / cells;
    const double z = amplitude * std::abs(std::sin(waves * x / size)) * std::cos(waves * y / size);
    return Vector3(x, y, z + (i > cells / 2 ? step : 0));
  };
  std::vector<SearchElement> elements;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      elements.push_back({{place(i, j), place(i + 1, j), place(i + 1, j + 1)}});
      elements.push_back({{place(i, j), place(i + 1, j + 1), place(i, j + 1)}});
    }
  }
  return elements;
}

/// Long thin triangles, as a tessellated cylinder has them: some thousand times as long as wide.
std::vector<SearchElement> needles(std::mt19937_64& random, int count, double size) {
  std::vector<SearchElement> elements;
  for (int i = 0; i < count; ++i) {
    const double from = 2 * std::numbers::pi * i / count;
    const double to = 2 * std::numbers::pi * (i + 1) / count;
    const double height = uniform(random, 0.5, 1) * size;
    const Vector3 a = 0.2 * size * Vector3(std::cos(from), std::sin(from), 0);
    const Vector3 b = 0.2 * size * Vector3(std::cos(to), std::sin(to), 0);
    const Vector3 up(0, 0, height);
    elements.push_back({{a, b, b + up}});
    elements.push_back({{a, b + up, a + up}});
  }
  return elements;
}

/// Triangles anywhere, crossing one another; some without an area, some without any size.
std::vector<SearchElement> heap(std::mt19937_64& random, int count, double size) {
  std::vector<SearchElement> elements;
  for (int i = 0; i < count; ++i) {
    const Vector3 place = randomPoint(random, size / 2);
    const double reach = size * std::pow(10, uniform(random, -4, -0.5));
    Triangle t{place, place + randomPoint(random, reach), place + randomPoint(random, reach)};
    if (i % 7 == 0) t[2] = t[1];
    if (i % 11 == 0) t[2] = t[0] + uniform(random, 0, 1) * (t[1] - t[0]);
    if (i % 41 == 0) t[1] = t[2] = t[0];
    elements.push_back({t});
  }
  return elements;
}

class SearchWith : public ::testing::TestWithParam<Instructions> {
protected:
  void SetUp() override {
    if (GetParam() == Instructions::Wide && bestInstructions() != Instructions::Wide)
      GTEST_SKIP() << "this processor has no such instructions";
  }

  void expectTheFirstMeetings(const std::vector<SearchElement>& elements, std::mt19937_64& random, int ways,
                              double size, bool capsules) {
    const SearchTree tree(elements, Elements::Triangles, GetParam());
    const Vector3 middle = (tree.bounds().minimum + tree.bounds().maximum) / 2;
    int met = 0;
    for (int i = 0; i < ways; ++i) {
      Mover mover;
      mover.radius = size * std::pow(10, uniform(random, -3.5, -0.7));
      const Vector3 from = middle + uniform(random, 0.2, 2) * size * randomDirection(random);
      const Vector3 corner = elements[random() % elements.size()].corners[random() % 3];
      const Vector3 goal = i % 3 == 0 ? corner : Vector3(corner + randomPoint(random, 2 * mover.radius));
      mover.way = wayBetween(from, from + uniform(random, 0.5, 1.5) * (goal - from));
      if (i % 5 == 0) mover.way.direction = Vector3::Unit(i % 3) * (i % 2 == 0 ? 1 : -1);
      if (i % 5 == 0) mover.way.start = corner - mover.way.direction * size + 0.5 * randomPoint(random, mover.radius);
      if (i % 13 == 0) mover.way.length = 0;
      if (capsules) mover.axis = uniform(random, 0.01, 1) * size * randomDirection(random);
      const Meeting expected = meetingWithAny(elements, mover);
      const Meeting found = meetingFound(tree, mover);
      ASSERT_EQ(found.found(), expected.found()) << i;
      if (!expected.found()) continue;
      ++met;
      ASSERT_NEAR(found.when, expected.when, 1e-12 * size) << i;
    }
    EXPECT_GT(met, ways / 5);
  }
};

INSTANTIATE_TEST_SUITE_P(Instructions, SearchWith, ::testing::Values(Instructions::Plain, Instructions::Wide),
                         [](const auto& tested) { return nameOf(tested.param); });

TEST_P(SearchWith, FindsTheFirstTriangleOnLandscapes) {
  std::mt19937_64 random(11);
  for (const double size : {1.0, 100.0, 3000.0}) {
    for (int i = 0; i < 5; ++i)
      expectTheFirstMeetings(landscape(random, 24, size), random, 400, size, false);
  }
}

TEST_P(SearchWith, FindsTheFirstTriangleAmongNeedles) {
  std::mt19937_64 random(12);
  for (int i = 0; i < 6; ++i)
    expectTheFirstMeetings(needles(random, 50 << i, 100), random, 400, 100, false);
}

TEST_P(SearchWith, FindsTheFirstTriangleInHeaps) {
  std::mt19937_64 random(13);
  for (const int count : {1, 2, 7, 8, 9, 65, 300, 2000})
    expectTheFirstMeetings(heap(random, count, 100), random, 400, 100, false);
}

TEST_P(SearchWith, FindsTheFirstTriangleWhereTheyGetSmallerWithoutEnd) {
  // Halves of halves towards a corner make the deepest trees; a thousand times the same triangle cannot be split at
  // all.
  std::mt19937_64 random(20);
  std::vector<SearchElement> elements;
  for (double size = 100; size > 1e-25; size *= 0.9)
    elements.push_back({{Vector3(size, 0, 0), Vector3(0, size, 0), Vector3(0.9 * size, 0.9 * size, 0.1 * size)}});
  elements.insert(elements.end(), 1000, {{Vector3(20, 20, 20), Vector3(21, 20, 20), Vector3(20, 21, 20)}});
  expectTheFirstMeetings(elements, random, 1000, 100, false);
}

TEST_P(SearchWith, FindsTheFirstTriangleForCapsules) {
  std::mt19937_64 random(14);
  expectTheFirstMeetings(landscape(random, 12, 100), random, 300, 100, true);
  expectTheFirstMeetings(needles(random, 120, 100), random, 300, 100, true);
  expectTheFirstMeetings(heap(random, 300, 100), random, 300, 100, true);
}

TEST_P(SearchWith, FindsTheFirstTriangleFarFromTheOrigin) {
  std::mt19937_64 random(15);
  std::vector<SearchElement> elements = landscape(random, 24, 50);
  for (SearchElement& element : elements) {
    for (Vector3& corner : element.corners)
      corner += Vector3(4000, -7000, 1500);
  }
  expectTheFirstMeetings(elements, random, 1000, 50, false);
}

TEST_P(SearchWith, PressesABallIntoAPlaneOfManyTrianglesInClosedForm) {
  // A slanted plane in a fine grid: wherever the ball comes down, it stands a radius above the plane.
  const Matrix3 turn = rotation(Vector3(1, 2, 0.5).normalized(), 33).linear();
  std::vector<SearchElement> elements;
  for (int i = -60; i < 60; ++i) {
    for (int j = -60; j < 60; ++j) {
      const auto place = [&](int a, int b) { return Vector3(turn * Vector3(0.3 * (i + a), 0.3 * (j + b), 7)); };
      elements.push_back({{place(0, 0), place(1, 0), place(1, 1)}});
      elements.push_back({{place(0, 0), place(1, 1), place(0, 1)}});
    }
  }
  const SearchTree tree(elements, Elements::Triangles, GetParam());
  std::mt19937_64 random(16);
  for (int i = 0; i < 2000; ++i) {
    const double radius = uniform(random, 0.2, 3);
    const Vector3 above(uniform(random, -8, 8), uniform(random, -8, 8), uniform(random, 11, 60));
    const Vector3 below(above.x() + uniform(random, -5, 5), above.y() + uniform(random, -5, 5), 6);
    Mover mover;
    mover.way = wayBetween(turn * above, turn * below);
    mover.radius = radius;
    const double expected = (above.z() - 7 - radius) / (above.z() - 6) * (above - below).norm();
    std::size_t visits = 0;
    ASSERT_NEAR(meetingFound(tree, mover, &visits).when, expected, 1e-11) << i;
    EXPECT_LT(visits, 40) << "a search must not look at all that the ball covers";
  }
}

TEST_P(SearchWith, FindsTheSamePointWhicheverTriangleItLooksAtFirst) {
  // Over ridges the ball meets the common edge of two triangles at the same time. From either of them that edge gives
  // a point of its own in the last digit: only one may win, in whatever order a walk, or no walk at all, comes to them.
  std::mt19937_64 random(19);
  int onEdges = 0;
  for (int i = 0; i < 20; ++i) {
    const std::vector<SearchElement> elements = landscape(random, 10, 100);
    const std::vector<SearchElement> backwards(elements.rbegin(), elements.rend());
    const SearchTree tree(elements, Elements::Triangles, GetParam());
    for (int way = 0; way < 500; ++way) {
      Mover mover;
      mover.radius = uniform(random, 0.5, 4);
      if (way % 5 == 0) mover.axis = uniform(random, 1, 40) * Vector3::UnitZ();
      const Triangle& t = elements[random() % elements.size()].corners;
      const Vector3 goal = t[0] + uniform(random, 0, 1) * (t[way % 2 == 0 ? 1 : 2] - t[0]);
      mover.way = wayBetween(goal + 40 * (Vector3::UnitZ() + 0.7 * randomDirection(random)).normalized(), goal);
      const Meeting expected = meetingWithAny(elements, mover);
      onEdges += mover.axis.isZero() && expected.normal.isZero() ? 1 : 0;
      for (const Meeting& other : {meetingWithAny(backwards, mover), meetingFound(tree, mover)}) {
        ASSERT_EQ(other.when, expected.when) << way;
        ASSERT_EQ(other.point, expected.point) << way;
      }
    }
  }
  EXPECT_GT(onEdges, 300);
}

TEST_P(SearchWith, VisitsEachOnceHoweverManyAreNearAtOnce) {
  // A ball as large as everything: no box can be left out, and none is nearer than another.
  std::mt19937_64 random(18);
  for (const std::vector<SearchElement>& elements : {landscape(random, 70, 100), heap(random, 20000, 100)}) {
    const SearchTree tree(elements, Elements::Triangles, GetParam());
    Mover mover;
    mover.way = wayBetween(Vector3(40, 50, 20), Vector3(60, 50, 20));
    mover.radius = 400;
    std::vector<int> visits(elements.size());
    tree.visitAll(mover, [&](std::uint32_t place, const Triangle&) { ++visits[tree.order()[place]]; });
    EXPECT_THAT(visits, ::testing::Each(1));
  }
}

TEST_P(SearchWith, FindsAllThatIsNearATriangle) {
  // Elements that bulge out of their triangles by up to their growth: balls about a point of each.
  std::mt19937_64 random(17);
  std::vector<SearchElement> elements = landscape(random, 16, 100);
  std::vector<Vector3> points;
  for (SearchElement& element : elements) {
    element.growth = uniform(random, 0, 3);
    points.push_back((element.corners[0] + element.corners[1] + element.corners[2]) / 3 +
                     uniform(random, 0, 1) * element.growth * randomDirection(random));
  }
  const SearchTree tree(elements, Elements::NearTriangles, GetParam());
  for (int i = 0; i < 1000; ++i) {
    Mover mover;
    mover.radius = uniform(random, 0.5, 8);
    const Vector3 from = Vector3(50, 50, 0) + 120 * randomDirection(random);
    mover.way = wayBetween(from, points[random() % points.size()]);
    Meeting expected;
    for (const Vector3& point : points)
      sweepPoint(mover.way, mover.radius, point, expected);
    Meeting found;
    tree.search(mover, found, [&](std::uint32_t place, const Triangle&) {
      sweepPoint(mover.way, mover.radius, points[tree.order()[place]], found);
    });
    ASSERT_EQ(found.when, expected.when) << i;
  }
}

}  // namespace
}  // namespace probewright::simulation
