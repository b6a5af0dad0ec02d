#include <algorithm>

#include "cycles_heidenhain/travel_cases.hpp"

/// How the probe travels in cycles 400 to 405 and 408 to 419: from where it touches, in which order and direction, and
/// when it visits the clearance height.
namespace probewright::testing_support {
namespace {

using namespace travel;

constexpr double exact = 1e-6;

/// The way of the ball's centre in the preset: to the start of a stroke from that of the one before (at first: from
/// where the program has left the probe), and back from the last.
struct Travel {
  std::vector<std::vector<Vector3>> ways;
  std::vector<Stroke> strokes;
  std::vector<Vector3> leaving;
};

/// The block with its clearances and heights from GLOBAL DEF 120.
std::string predefined(std::string block) {
  for (const int number : {320, 260, 301}) {
    const std::size_t at = block.find(fmt::format("Q{}=", number));
    if (at == std::string::npos) continue;
    block.replace(at + 5, block.find(' ', at) - at - 5, "PREDEF");
  }
  return fmt::format("GLOBAL DEF 120 PROBING ~\n  Q320=+1 ;CLEARANCE ~\n  Q260=+{} ;HEIGHT ~\n  Q301=+1 ;TRAVEL\n",
                     clearance) +
         block;
}

/// The clearance height counts for the ball's lowest point: while that is below it, the probe rises first, even with
/// its centre above; and what stands in the way between is passed over.
TEST(ClearanceHeight, IsThatOfTheBallsLowestPoint) {
  constexpr double height = 30, radius = 3;
  for (const double start : {height - 0.5, height - 2 * radius + 0.5, height + 0.5}) {
    Bench bench;
    bench.probeOf(110, radius);
    bench.preset(1, {0, 0, -400});
    bench.part(simulation::Box({-50, -20, -30}, {-40, 20, height - 0.4}), pose({0, 0, -400}));
    bench.part(simulation::Box({0, -20, -30}, {40, 20, 10}), pose({0, 0, -400}));
    const bool below = start < height;
    session::RunOptions options;
    options.control = bench.control;
    const std::string way =
        fmt::format("TOOL CALL 1 Z\nL X{} Y+0 R0 FMAX\nL Z{:+.3f} R0 FMAX\n", below ? -70 : -45, start);
    const Ran ran(setup::runText("BENCH.H",
                                 "BEGIN PGM BENCH MM\n" + way +
                                     probe(427, {{263, 0},
                                                 {264, 0},
                                                 {261, 5},
                                                 {320, 1},
                                                 {272, 1},
                                                 {267, 1},
                                                 {260, height},
                                                 {281, 0},
                                                 {288, 0},
                                                 {289, 0},
                                                 {309, 0},
                                                 {330, 0}}) +
                                     "END PGM BENCH MM\n",
                                 bench.setup, options));
    ASSERT_TRUE(ran.finished()) << start << ran.why();
    EXPECT_NEAR(ran.q(160), 0, 1e-6);
    double highest = -1e9;  // of the ball's lowest point, between its start and the measuring height
    bool begun = false;
    for (const auto& point : ran.machine->path().points) {
      const double lowest = point.tip.z() + 400 - radius;
      begun = begun || std::abs(lowest - start) < 1e-6;
      if (begun) highest = std::max(highest, lowest);
      if (begun && lowest < 10) break;
    }
    EXPECT_NEAR(highest, std::max(height, start), 1e-6);
  }
}

Travel travelOf(const Case& one, ControlKind kind, const Words& words, const std::string& startHeight,
                bool globally = false) {
  Bench bench(kind, one.cycle == 403 || one.cycle == 405 ? "mill5-table-table" : "mill3");
  bench.preset(1, {0, 0, -400});
  one.lay(bench);
  session::RunOptions options;
  options.control = kind;
  const std::string cycle = probe(one.cycle, words);
  const Ran ran(setup::runText("BENCH.H",
                               "BEGIN PGM BENCH MM\nTOOL CALL 1 Z\nL X-90 Y-90 R0 FMAX\nL Z" + startHeight +
                                   " R0 FMAX\n" + (globally ? predefined(cycle) : cycle) + "END PGM BENCH MM\n",
                               bench.setup, options));
  EXPECT_TRUE(ran.finished()) << ran.why();
  Travel travel;
  if (!ran.finished()) return travel;
  const auto& path = ran.machine->path();
  const auto at = [&](std::size_t i) { return Vector3(path.points[i].tip + Vector3(0, 0, 400)); };
  // Where the program has left the probe: X-90 Y-90 at the height asked for.
  std::size_t from = 0;
  const double height = std::stod(startHeight) + ball;
  while (from < path.points.size() && (at(from) - Vector3(-90, -90, height)).norm() > exact)
    ++from;
  std::vector<Vector3> way;
  std::size_t next = 0;
  for (std::size_t i = from; i < path.points.size(); ++i) {
    if (next < path.touches.size() && path.touches[next].pathPoint == i) {
      // The contact itself is no part of the way; the ball returns to the start of the stroke.
      travel.strokes.push_back({way.back(), -path.touches[next].normal});
      travel.ways.push_back(way);
      way = {way.back()};
      ++next;
      continue;
    }
    way.push_back(at(i));
  }
  travel.leaving = way;
  return travel;
}

double highest(const std::vector<Vector3>& way) {
  return std::ranges::max(way, {}, [](const Vector3& p) { return p.z(); }).z() - ball;
}
double lowest(const std::vector<Vector3>& way) {
  return std::ranges::min(way, {}, [](const Vector3& p) { return p.z(); }).z() - ball;
}

/// The smallest distance of a way from the axis of a circle.
double nearest(const std::vector<Vector3>& way, const Vector2& centre) {
  double least = 1e9;
  for (std::size_t i = 1; i < way.size(); ++i) {
    for (int part = 0; part <= 50; ++part) {
      const Vector3 place = way[i - 1] + (way[i] - way[i - 1]) * (part / 50.0);
      least = std::min(least, (place.head<2>() - centre).norm());
    }
  }
  return least;
}

void expectStrokes(const Travel& travel, const Case& one) {
  ASSERT_EQ(travel.strokes.size(), one.strokes.size());
  std::vector<Stroke> expected = one.strokes;
  for (const Stroke& stroke : travel.strokes) {
    const auto fits = [&](const Stroke& other) {
      return (stroke.start - other.start).norm() < exact && (stroke.direction - other.direction).norm() < 1e-3;
    };
    const auto found = std::ranges::find_if(expected, fits);
    if (one.ordered ? expected.empty() || !fits(expected.front()) : found == expected.end()) {
      ADD_FAILURE() << "a stroke from " << stroke.start.transpose() << " along " << stroke.direction.transpose();
      return;
    }
    expected.erase(found);
  }
}

Vector2 centreOf(const Case& one, std::size_t gap) {
  if (one.cycle == 402) return {gap < 4 ? 0.0 : 60.0, 0};
  return {0, one.cycle == 405 ? 60.0 : 0.0};
}

void expectWays(const Travel& travel, const Case& one, bool atClearance, Way arcAtClearance) {
  const auto& ways = travel.ways;
  for (std::size_t gap = 1; gap < ways.size(); ++gap) {
    SCOPED_TRACE(fmt::format("way to stroke {}", gap + 1));
    const auto& way = ways[gap];
    const bool betweenObjects = one.perObject != 0 && gap % one.perObject == 0;
    if (betweenObjects || atClearance) {
      EXPECT_NEAR(highest(way), clearance, exact);
    } else {
      EXPECT_NEAR(highest(way), way.front().z() - ball, exact);
      EXPECT_NEAR(lowest(way), way.back().z() - ball, exact);
    }
    if (betweenObjects) continue;
    const Way wanted = atClearance ? arcAtClearance : one.way;
    if (wanted == Way::Arc) {
      const double radius = (way.back().head<2>() - centreOf(one, gap)).norm();
      EXPECT_GT(nearest(way, centreOf(one, gap)), radius - 0.05);
    } else if (wanted == Way::AlongAxes) {
      for (std::size_t i = 1; i < way.size(); ++i) {
        const Vector3 step = (way[i] - way[i - 1]).cwiseAbs();
        EXPECT_NEAR(step.sum(), step.maxCoeff(), exact) << "not along an axis";
      }
    } else {
      // The shortest way across.
      double across = 0;
      for (std::size_t i = 1; i < way.size(); ++i)
        across += (way[i] - way[i - 1]).head<2>().norm();
      // The outside corner lies between the second and the third touch.
      const bool around = one.cycle == 414 && gap == 2 && !atClearance;
      if (!around) {
        EXPECT_NEAR(across, (way.back() - way.front()).head<2>().norm(), exact);
      }
    }
  }
}

bool knows(int cycle, std::uint32_t parameter) {
  return (parameter == 301 && cycle != 401 && cycle != 409 && cycle < 416) || (parameter == 365 && cycle == 412) ||
         (parameter == 365 && cycle == 413);
}

TEST(ProbingTravel, StartsEveryStrokeWhereTheParametersSay) {
  for (const Case& one : cases()) {
    for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
      if (one.newerOnly && kind != ControlKind::TNC640) continue;
      for (const int move : {0, 1}) {
        if (move == 1 && !knows(one.cycle, 301)) continue;
        SCOPED_TRACE(fmt::format("cycle {} on the {}, Q301 = {}", one.cycle, control::name(kind), move));
        const Words words = knows(one.cycle, 301) ? with(one.words, {{301, move}}) : one.words;
        const Travel travel = travelOf(one, kind, words, "+5");
        expectStrokes(travel, one);
        if (HasFailure()) return;
        const bool round = one.way == Way::Arc;
        expectWays(travel, one, move == 1, round ? Way::Arc : Way::Straight);
        // From below: up to the clearance height first, then across, then down.
        const auto& first = travel.ways.front();
        EXPECT_NEAR(highest(first), clearance, exact);
        for (std::size_t i = 1; i < first.size(); ++i) {
          const Vector3 step = (first[i] - first[i - 1]).cwiseAbs();
          EXPECT_NEAR(std::min(step.z(), step.head<2>().norm()), 0, exact) << "oblique";
          if (step.head<2>().norm() > exact) {
            EXPECT_NEAR(first[i].z() - ball, clearance, exact);
          }
        }
        EXPECT_NEAR(travel.leaving.back().z() - ball, clearance, exact);
      }
    }
  }
}

TEST(ProbingTravel, GoesStraightDownFromAboveTheClearanceHeight) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(fmt::format("cycle {}", one.cycle));
    const Words words = knows(one.cycle, 301) ? with(one.words, {{301, 0}}) : one.words;
    const Travel travel = travelOf(one, ControlKind::TNC640, words, "+50");
    ASSERT_FALSE(travel.ways.empty());
    const auto& first = travel.ways.front();
    // Across at the present height, then down without a stop.
    EXPECT_NEAR(highest(first), 50, exact);
    EXPECT_NEAR(lowest(first), first.back().z() - ball, exact);
    for (std::size_t i = 1; i < first.size(); ++i) {
      EXPECT_TRUE(std::abs(first[i].z() - ball - 50) < exact || i + 1 == first.size()) << first[i].transpose();
    }
    EXPECT_NEAR(travel.leaving.back().z() - ball, clearance, exact);
  }
}

TEST(ProbingTravel, CutsCornersAtTheClearanceHeightWithQ365) {
  for (const Case& one : cases()) {
    if (!knows(one.cycle, 365)) continue;
    for (const int move : {0, 1}) {
      for (const int line : {0, 1}) {
        SCOPED_TRACE(fmt::format("cycle {}, Q301 = {}, Q365 = {}", one.cycle, move, line));
        const Travel travel = travelOf(one, ControlKind::TNC640, with(one.words, {{301, move}, {365, line}}), "+5");
        expectStrokes(travel, one);
        // Q365 counts at the clearance height alone.
        expectWays(travel, one, move == 1, line == 1 ? Way::Arc : Way::Straight);
      }
    }
  }
}

TEST(ProbingTravel, TakesClearancesAndHeightsFromGlobalDefinitions) {
  for (const Case& one : cases()) {
    for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
      if (one.newerOnly && kind != ControlKind::TNC640) continue;
      SCOPED_TRACE(fmt::format("cycle {} on the {}", one.cycle, control::name(kind)));
      const Words words = knows(one.cycle, 301) ? with(one.words, {{301, 1}}) : one.words;
      const Travel named = travelOf(one, kind, words, "+5"), global = travelOf(one, kind, words, "+5", true);
      expectStrokes(global, one);
      ASSERT_EQ(global.ways.size(), named.ways.size());
      for (std::size_t i = 0; i < named.ways.size(); ++i) {
        EXPECT_NEAR(highest(global.ways[i]), highest(named.ways[i]), exact);
        EXPECT_EQ(global.ways[i].size(), named.ways[i].size());
      }
    }
  }
}

/// A pocket too narrow for the clearances: every stroke from its middle, and no way up between them.
TEST(ProbingTravel, ProbesNarrowPocketsFromTheirMiddle) {
  const Words circle = {{261, -8}, {260, clearance}, {320, 1}, {262, 9}, {325, 0}, {247, 90}};
  const Words target = {{305, 1}, {303, 1}, {331, 0}, {332, 0}};
  const auto narrow = [](Bench& bench) { hole(bench, 0, 60, 4.5); };
  const auto pocket = [](Bench& bench) { walls(bench, {0, 0}, {60, 9}); };
  const std::vector<Case> all = {
      {.cycle = 405,
       .words = with(circle, {{321, 0}, {322, 60}, {337, 0}}),
       .lay = narrow,
       .strokes = onCircle({0, 60}, 0, -8, {0, 90, 180, 270}, 1)},
      {.cycle = 412,
       .words = with(circle, with(target, {{321, 0}, {322, 60}})),
       .lay = narrow,
       .strokes = onCircle({0, 60}, 0, -8, {0, 90, 180, 270}, 1)},
      {.cycle = 408,
       .words = {{321, 0},
                 {322, 0},
                 {311, 9},
                 {272, 2},
                 {261, -8},
                 {260, clearance},
                 {320, 1},
                 {305, 1},
                 {303, 1},
                 {405, 0}},
       .lay = pocket,
       .strokes = {{{0, 0, -8}, back}, {{0, 0, -8}, -back}},
       .ordered = false},
      {.cycle = 410,
       .words = with(target, {{321, 0}, {322, 0}, {323, 30}, {324, 9}, {261, -8}, {260, clearance}, {320, 1}}),
       .lay =
           [](Bench& bench) {
             walls(bench, {0, 0}, {30, 9});
           },
       .strokes = {{{0, 0, -8}, right}, {{0, 0, -8}, back}, {{0, 0, -8}, -right}, {{0, 0, -8}, -back}},
       .ordered = false},
  };
  for (const Case& one : all) {
    for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
      for (const int move : {0, 1}) {
        SCOPED_TRACE(fmt::format("cycle {} on the {}, Q301 = {}", one.cycle, control::name(kind), move));
        const Travel travel = travelOf(one, kind, with(one.words, {{301, move}}), "+5");
        expectStrokes(travel, one);
        for (std::size_t gap = 1; gap < travel.ways.size(); ++gap)
          EXPECT_NEAR(highest(travel.ways[gap]), -8 - ball, exact);
      }
    }
  }
}

}  // namespace
}  // namespace probewright::testing_support
