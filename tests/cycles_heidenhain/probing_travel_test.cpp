#include <algorithm>

#include "cycles_heidenhain/worlds.hpp"

/// How the probe travels in cycles 400 to 405 and 408 to 419: from where it touches, in which order and direction, and
/// when it visits the clearance height. Every value follows from the cycle's parameters by hand.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6, clearance = 20, ball = 2;
/// Ball radius 2, SET_UP 2 and Q320 = 1 lie between a surface and the ball's centre in front of it.
constexpr double standOff = 5;

struct Stroke {
  Vector3 start, direction;
};

enum class Way { Straight, AlongAxes, Arc };

struct Case {
  int cycle;
  Words words;
  std::function<void(Bench&)> lay;
  std::vector<Stroke> strokes;
  std::size_t perObject =
      0;                    ///< strokes of one object; between objects the probe always goes up; 0: there is one object
  Way way = Way::Straight;  ///< between strokes at the measuring height
  bool ordered = true;      ///< the manual tells the order of the strokes
  bool newerOnly = false;
};

const Vector3 right = Vector3::UnitX(), back = Vector3::UnitY(), up = Vector3::UnitZ();

void block(Bench& bench) { bench.part(simulation::Box({0, 0, -40}, {100, 80, 0}), pose({0, 0, -400})); }
void hole(Bench& bench, double x, double y, double radius) {
  bench.part(simulation::Ring(radius, radius + 8, -40), pose({x, y, -400}));
}
void stud(Bench& bench, double x, double y, double radius) {
  bench.part(simulation::RoundBar(radius, -40, 0), pose({x, y, -400}));
}
void walls(Bench& bench, const Vector2& centre, const Vector2& room) {
  const double x = room.x() / 2, y = room.y() / 2;
  const Pose at = pose({centre.x(), centre.y(), -400});
  bench.part(simulation::Box({x, -y - 20, -40}, {x + 20, y + 20, 0}), at);
  bench.part(simulation::Box({-x - 20, -y - 20, -40}, {-x, y + 20, 0}), at);
  bench.part(simulation::Box({-x, y, -40}, {x, y + 20, 0}), at);
  bench.part(simulation::Box({-x, -y - 20, -40}, {x, -y, 0}), at);
}

/// Four strokes from the middle of a hole outwards, along the main axis first.
std::vector<Stroke> fromMiddle(const std::vector<Vector2>& centres) {
  std::vector<Stroke> strokes;
  for (const Vector2& centre : centres) {
    for (const Vector3& direction : {right, Vector3(-right), back, Vector3(-back)})
      strokes.push_back({{centre.x(), centre.y(), -8}, direction});
  }
  return strokes;
}

/// Strokes on a circle at `angles`, from `radius`, outwards (1) or inwards (-1).
std::vector<Stroke> onCircle(const Vector2& centre, double radius, double height, const std::vector<double>& angles,
                             double sense) {
  std::vector<Stroke> strokes;
  for (const double angle : angles) {
    const Vector3 radial(std::cos(radians(angle)), std::sin(radians(angle)), 0);
    strokes.push_back({Vector3(centre.x(), centre.y(), height) + radius * radial, sense * radial});
  }
  return strokes;
}

std::vector<Stroke> joined(std::vector<Stroke> first, const std::vector<Stroke>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

std::vector<Case> cases() {
  const Words heights = {{261, -8}, {260, clearance}, {320, 1}};
  const Words holeHeights = {{261, -8}, {260, clearance}};
  const Words target = {{305, 1}, {303, 1}, {331, 0}, {332, 0}};
  const Words edge = with(heights, {{263, 20}, {264, 0}, {265, 70}, {266, 0}, {272, 2}, {267, 1}});
  const Words rectangle = with(heights, with(target, {{321, 0}, {322, 0}, {323, 100}, {324, 60}}));
  const Words circle = with(heights, with(target, {{321, 0}, {322, 0}, {262, 40}, {325, 30}, {247, -60}}));
  const Words width = with(heights, {{321, 50}, {322, 40}, {311, 40}, {305, 1}, {303, 1}, {405, 0}});
  const std::vector<double> clockwise = {30, -30, -90, -150}, quarters = {0, 90, 180, 270};
  const auto two = [](const auto& lay) {
    return [lay](Bench& bench) {
      lay(bench, 0, 0, 10);
      lay(bench, 60, 0, 10);
    };
  };
  const Words pair = {{268, 0}, {269, 0}, {270, 60}, {271, 0}, {307, 0}, {305, 1}};
  return {
      {.cycle = 400,
       .words = with(edge, {{307, 0}, {305, 1}}),
       .lay = block,
       .strokes = {{{20, -5, -8}, back}, {{70, -5, -8}, back}}},
      {.cycle = 401,
       .words = with(holeHeights, pair),
       .lay = two(hole),
       .strokes = fromMiddle({{0, 0}, {60, 0}}),
       .perObject = 4},
      {.cycle = 402,
       .words = with(heights, with(pair, {{313, 20}, {314, 20}, {315, -12}})),
       .lay = two(stud),
       .strokes = joined(onCircle({0, 0}, 15, -8, quarters, -1), onCircle({60, 0}, 15, -12, quarters, -1)),
       .perObject = 4,
       .way = Way::Arc},
      {.cycle = 403,
       .words = with(edge, {{312, 6}}),
       .lay = block,
       .strokes = {{{20, -5, -8}, back}, {{70, -5, -8}, back}}},
      {.cycle = 405,
       .words = with(heights, {{321, 0}, {322, 60}, {262, 30}, {325, 0}, {247, 90}, {337, 0}}),
       .lay = [](Bench& bench) { hole(bench, 0, 60, 15); },
       .strokes = onCircle({0, 60}, 10, -8, quarters, 1),
       .way = Way::Arc},
      {.cycle = 408,
       .words = with(width, {{272, 2}}),
       .lay =
           [](Bench& bench) {
             walls(bench, {50, 40}, {200, 40});
           },
       .strokes = {{{50, 55, -8}, back}, {{50, 25, -8}, -back}},
       .ordered = false},
      {.cycle = 409,
       .words = with(width, {{272, 1}}),
       .lay =
           [](Bench& bench) {
             bench.part(simulation::Box({30, -40, -40}, {70, 120, 0}), pose({0, 0, -400}));
           },
       .strokes = {{{75, 40, -8}, -right}, {{25, 40, -8}, right}},
       .perObject = 1,
       .ordered = false},
      {.cycle = 410,
       .words = rectangle,
       .lay =
           [](Bench& bench) {
             walls(bench, {0, 0}, {100, 60});
           },
       .strokes = {{{45, 0, -8}, right}, {{0, 25, -8}, back}, {{-45, 0, -8}, -right}, {{0, -25, -8}, -back}},
       .way = Way::AlongAxes,
       .ordered = false},
      {.cycle = 411,
       .words = rectangle,
       .lay =
           [](Bench& bench) {
             bench.part(simulation::Box({-50, -30, -40}, {50, 30, 0}), pose({0, 0, -400}));
           },
       .strokes = {{{55, 0, -8}, -right}, {{0, 35, -8}, -back}, {{-55, 0, -8}, right}, {{0, -35, -8}, back}},
       .way = Way::AlongAxes,
       .ordered = false},
      {.cycle = 412,
       .words = circle,
       .lay = [](Bench& bench) { hole(bench, 0, 0, 20); },
       .strokes = onCircle({0, 0}, 20 - standOff, -8, clockwise, 1),
       .way = Way::Arc},
      {.cycle = 413,
       .words = circle,
       .lay = [](Bench& bench) { stud(bench, 0, 0, 20); },
       .strokes = onCircle({0, 0}, 20 + standOff, -8, clockwise, -1),
       .way = Way::Arc},
      {.cycle = 414,
       .words = with(heights, with(target, {{263, 30}, {264, 0}, {326, 40}, {296, 0}, {297, 20}, {327, 30}, {304, 0}})),
       .lay = block,
       .strokes = {{{30, -5, -8}, back}, {{70, -5, -8}, back}, {{-5, 20, -8}, right}, {{-5, 50, -8}, right}}},
      // From the corner the first and third place lie the clearances away in both axes.
      {.cycle = 415,
       .words = with(heights, with(target, {{263, 0}, {264, 0}, {326, 30}, {327, 40}, {308, 1}, {304, 0}})),
       .lay =
           [](Bench& bench) {
             bench.part(simulation::Box({-40, -40, -40}, {0, 80, 0}), pose({0, 0, -400}));
             bench.part(simulation::Box({0, -40, -40}, {80, 0, 0}), pose({0, 0, -400}));
           },
       .strokes = {{{5, 5, -8}, -back}, {{30, 5, -8}, -back}, {{5, 5, -8}, -right}, {{5, 40, -8}, -right}},
       .newerOnly = true},
      {.cycle = 416,
       .words = with(holeHeights, with(target, {{273, 0}, {274, 0}, {262, 80}, {291, 0}, {292, 90}, {293, 180}})),
       .lay =
           [](Bench& bench) {
             for (const Vector2& at : {Vector2(40, 0), Vector2(0, 40), Vector2(-40, 0)})
               hole(bench, at.x(), at.y(), 10);
           },
       .strokes = fromMiddle({{40, 0}, {0, 40}, {-40, 0}}),
       .perObject = 4},
      {.cycle = 417,
       .words = {{263, 20}, {264, 30}, {294, 0}, {320, 1}, {260, clearance}, {305, 1}, {333, 0}, {303, 1}},
       .lay = block,
       .strokes = {{{20, 30, 5}, -up}}},
      {.cycle = 418,
       .words =
           with(holeHeights,
                with(target, {{268, 0}, {269, 0}, {270, 60}, {271, 0}, {316, 60}, {317, 50}, {318, 0}, {319, 50}})),
       .lay =
           [](Bench& bench) {
             for (const Vector2& at : {Vector2(0, 0), Vector2(60, 0), Vector2(60, 50), Vector2(0, 50)})
               hole(bench, at.x(), at.y(), 10);
           },
       .strokes = fromMiddle({{0, 0}, {60, 0}, {60, 50}, {0, 50}}),
       .perObject = 4},
      {.cycle = 419,
       .words = with(heights, {{263, 0}, {264, 40}, {272, 1}, {267, 1}, {305, 1}, {333, 0}, {303, 1}}),
       .lay = block,
       .strokes = {{{-5, 40, -8}, right}}},
      {.cycle = 419,
       .words = with(heights, {{263, 30}, {264, 40}, {261, 0}, {272, 3}, {267, -1}, {305, 1}, {333, 0}, {303, 1}}),
       .lay = block,
       .strokes = {{{30, 40, 5}, -up}}},
  };
}

/// The way of the ball's centre in the preset: to the start of a stroke from that of the one before (at first: from
/// where the program has left the probe), and back from the last.
struct Travel {
  std::vector<std::vector<Vector3>> ways;
  std::vector<Stroke> strokes;
  std::vector<Vector3> leaving;
};

Travel travelOf(const Case& one, ControlKind kind, const Words& words, const std::string& startHeight) {
  Bench bench(kind, one.cycle == 403 || one.cycle == 405 ? "mill5-table-table" : "mill3");
  bench.preset(1, {0, 0, -400});
  one.lay(bench);
  session::RunOptions options;
  options.control = kind;
  const Ran ran(session::runText("BENCH.H",
                                 "BEGIN PGM BENCH MM\nTOOL CALL 1 Z\nL X-90 Y-90 R0 FMAX\nL Z" + startHeight +
                                     " R0 FMAX\n" + probe(one.cycle, words) + "END PGM BENCH MM\n",
                                 bench.setup, options));
  EXPECT_TRUE(ran.finished()) << ran.why();
  Travel travel;
  if (!ran.finished()) return travel;
  const auto& path = ran.outcome.machine->path();
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
