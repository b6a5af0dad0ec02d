#include "cycles_heidenhain/worlds.hpp"

/// The ways of cycles 420 to 431 as their pages describe them: where each stroke begins and where it goes, at which
/// height and in which form the probe travels between the strokes, and how the cycle begins and ends.
namespace probewright::testing_support {
namespace {

constexpr double near = 1e-6, ball = 2, setUp = 3, extra = 1, clearance = 20, depth = -8;
/// From the surface to the ball's centre in a pre-position.
constexpr double off = ball + setUp + extra;

struct Stroke {
  Vector3 start;  ///< ball centre
  Vector3 direction;
};

enum class Way { MeasuringHeight, ClearanceHeight };

struct Page {
  int cycle;
  Words words;
  std::vector<Stroke> strokes;
  Way way;
  bool arcs = false;  ///< between the strokes
};

struct Travel {
  std::vector<Stroke> strokes;
  std::vector<double> highest;       ///< of the ball, from stroke to stroke
  std::vector<std::size_t> corners;  ///< points of the way between two strokes
  std::vector<Vector3> points;       ///< of the whole cycle, after its first point
  Vector3 first = Vector3::Zero(), last = Vector3::Zero();
};

Travel travelOf(const Bench& bench, const std::string& before, const std::string& block) {
  session::RunOptions options;
  options.control = bench.control;
  const Ran ran(setup::runText("BENCH.H", "BEGIN PGM BENCH MM\nTOOL CALL 1 Z\n" + before + block + "END PGM BENCH MM\n",
                               bench.setup, options));
  EXPECT_TRUE(ran.finished()) << ran.why();
  Travel travel;
  const auto& path = ran.machine->path();
  const Vector3 origin(0, 0, -400);
  bool begun = false, behindStroke = false;
  double highest = -1e9;
  std::size_t corners = 0;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const auto& point = path.points[i];
    if (point.seconds <= ran.cycle().startSeconds + 1e-9) continue;
    const Vector3 from = path.points[i - 1].tip - origin, tip = point.tip - origin;
    if (!begun) travel.first = from;
    begun = true;
    travel.points.push_back(tip);
    if (point.kind == simulation::PathKind::Measure) {
      travel.strokes.push_back({from, (tip - from).normalized()});
      if (behindStroke) {
        travel.highest.push_back(highest);
        travel.corners.push_back(corners);
      }
      highest = -1e9;
      corners = 0;
      behindStroke = true;
      continue;
    }
    if (point.kind != simulation::PathKind::Retract) ++corners;
    highest = std::max(highest, tip.z());
  }
  travel.last = travel.points.empty() ? travel.first : travel.points.back();
  return travel;
}

Vector3 at(double angle) { return {std::cos(radians(angle)), std::sin(radians(angle)), 0}; }

const Vector3 middle(50, 40, depth);

/// A bench with a preset at (0, 0, -400) and a probe that stands off by `off`.
Bench travelBench(ControlKind kind) {
  Bench bench(kind);
  bench.preset(1, {0, 0, -400});
  bench.believedProbe().setUpClearance = setUp;
  bench.believedProbe().maximumTravel = 30;
  return bench;
}

const Words common = {{261, depth}, {320, extra}, {260, clearance}, {281, 0}, {309, 0}, {330, 0}};

/// All pages of a control, each with its part on the table.
std::vector<std::pair<Bench, Page>> pages(ControlKind kind) {
  const bool newer = kind == ControlKind::TNC640;
  std::vector<std::pair<Bench, Page>> all;
  const Pose lies = pose({50, 40, -400});
  const auto add = [&](auto solid, const Pose& where, Page page) {
    Bench bench = travelBench(kind);
    bench.part(std::move(solid), where);
    all.emplace_back(std::move(bench), std::move(page));
  };
  for (const int between : {0, 1}) {
    const Way way = between == 1 ? Way::ClearanceHeight : Way::MeasuringHeight;
    for (const bool inside : {true, false}) {
      for (const double step : {60.0, -75.0}) {
        for (const int count : {4, 3}) {
          for (const int traverse : {1, 0}) {
            if (!newer && (count == 3 || traverse == 0)) continue;
            Words words = with(common, {{273, 50},
                                        {274, 40},
                                        {262, 60},
                                        {325, 20},
                                        {247, step},
                                        {301, between},
                                        {inside ? 275 : 277, 0},
                                        {inside ? 276 : 278, 0},
                                        {279, 0},
                                        {280, 0}});
            if (newer) words = with(words, {{423, count}, {365, traverse}});
            Page page{inside ? 421 : 422, words, {}, way, between == 0 || traverse == 1};
            for (int i = 0; i < count; ++i) {
              const Vector3 outwards = at(20 + i * step);
              page.strokes.push_back({middle + outwards * (30 + (inside ? -off : off)), (inside ? 1 : -1) * outwards});
            }
            if (inside) {
              add(simulation::Ring(30, 60, -40), lies, page);
            } else {
              add(simulation::RoundBar(30, -40, 0), lies, page);
            }
          }
        }
      }
      const Words words = with(common, {{273, 50},
                                        {274, 40},
                                        {282, 60},
                                        {283, 50},
                                        {301, between},
                                        {284, 0},
                                        {285, 0},
                                        {286, 0},
                                        {287, 0},
                                        {279, 0},
                                        {280, 0}});
      Page page{inside ? 423 : 424, words, {}, way};
      for (int i = 0; i < 4; ++i) {
        const Vector3 outwards = at(90 * i).unaryExpr([](double v) { return std::round(v); });
        const double half = i % 2 == 0 ? 30 : 25;
        page.strokes.push_back({middle + outwards * (half + (inside ? -off : off)), (inside ? 1 : -1) * outwards});
      }
      if (inside) {
        Bench bench = travelBench(kind);
        PlantedPart pocket{bench};
        pocket.machineFromPart = lies;
        layPocket(pocket, {60, 50});
        all.emplace_back(pocket.bench, page);
      } else {
        add(simulation::Box({-30, -25, -40}, {30, 25, 0}), lies, page);
      }
    }
    // 420: an edge along the minor axis, touched in the positive direction.
    Words edge = with(common, {{263, 20}, {264, 25}, {265, 20}, {266, 55}, {272, 1}, {267, 1}, {301, between}});
    std::erase_if(edge, [](const auto& word) { return word.first == 309 || word.first == 330; });
    add(simulation::Box({-30, -25, -40}, {30, 25, 0}), lies,
        {420, edge, {{{20 - off, 25, depth}, Vector3::UnitX()}, {{20 - off, 55, depth}, Vector3::UnitX()}}, way});
    // 425 with an offset: the first stroke begins where it is told, positive; the second in front of the other wall.
    if (newer || between == 0) {
      Bench bench = travelBench(kind);
      PlantedPart slot{bench};
      slot.machineFromPart = lies;
      layPocket(slot, {60, 200});
      Words words = with(common, {{328, 55}, {329, 40}, {310, 12}, {272, 1}, {311, 60}, {288, 0}, {289, 0}});
      if (newer) {
        words = with(words, {{301, between}});
      } else {
        std::erase_if(words, [](const auto& word) { return word.first == 320; });
      }
      const double inFront = newer ? off : off - extra;
      all.emplace_back(slot.bench,
                       Page{425,
                            words,
                            {{{55, 40, depth}, Vector3::UnitX()}, {{20 + inFront, 52, depth}, -Vector3::UnitX()}},
                            newer ? way : Way::MeasuringHeight});
    }
  }
  // 426: over the ridge in any case; first in the negative direction.
  add(simulation::Box({-30, -25, -40}, {30, 25, 0}), lies,
      {426,
       with(common, {{263, 45}, {264, 65}, {265, 55}, {266, 15}, {272, 2}, {311, 50}, {288, 0}, {289, 0}}),
       {{{45, 65 + off, depth}, -Vector3::UnitY()}, {{55, 15 - off, depth}, Vector3::UnitY()}},
       Way::ClearanceHeight});
  for (const auto& [axis, sense, place] :
       {std::tuple(1, -1, Vector3(80, 40, depth)), std::tuple(2, 1, Vector3(50, 15, depth)),
        std::tuple(3, -1, Vector3(50, 40, 0))}) {
    const Vector3 direction = sense * Vector3::Unit(axis - 1);
    add(simulation::Box({-30, -25, -40}, {30, 25, 0}), lies,
        {427,
         with(common,
              {{263, place.x()}, {264, place.y()}, {261, place.z()}, {272, axis}, {267, sense}, {288, 0}, {289, 0}}),
         {{place - direction * off, direction}},
         Way::MeasuringHeight});
  }
  // 431: from above, over the clearance height.
  Words plane = with({{320, extra}, {260, clearance}, {281, 0}},
                     {{263, 30}, {264, 20}, {294, 0}, {265, 70}, {266, 20}, {295, 0}, {296, 50}, {297, 60}, {298, 0}});
  add(simulation::Box({-30, -25, -40}, {30, 25, 0}), lies,
      {431,
       plane,
       {{{30, 20, off}, -Vector3::UnitZ()}, {{70, 20, off}, -Vector3::UnitZ()}, {{50, 60, off}, -Vector3::UnitZ()}},
       Way::ClearanceHeight});
  // 430: four strokes from the middle of each hole, over the clearance height from hole to hole.
  Bench holes = travelBench(kind);
  Page bolt{
      430,
      with(common,
           {{273, 50}, {274, 40}, {262, 60}, {291, 0}, {292, 120}, {293, 240}, {288, 0}, {289, 0}, {279, 0}, {280, 0}}),
      {},
      Way::ClearanceHeight};
  std::erase_if(bolt.words, [](const auto& word) { return word.first == 320; });
  for (const double angle : {0.0, 120.0, 240.0}) {
    const Vector3 hole = middle + 30 * at(angle);
    holes.part(simulation::Ring(8, 14, -40), pose({hole.x(), hole.y(), -400}));
    for (const Vector3& direction : {Vector3(1, 0, 0), Vector3(-1, 0, 0), Vector3(0, 1, 0), Vector3(0, -1, 0)})
      bolt.strokes.push_back({hole, direction});
  }
  all.emplace_back(std::move(holes), std::move(bolt));
  return all;
}

TEST(InspectionTravel, IsThatOfThePages) {
  std::size_t tested = 0;
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    for (const auto& [bench, page] : pages(kind)) {
      std::string words;
      for (const auto& [number, value] : page.words)
        words += fmt::format(" Q{}={}", number, value);
      SCOPED_TRACE(fmt::format("{} cycle {}{}", control::name(kind), page.cycle, words));
      const std::string block = probe(page.cycle, page.words);
      // From below the clearance height: up to it, across, down.
      const Travel low = travelOf(bench, "L Z+60 R0 FMAX\nL X-60 Y-60 R0 FMAX\nL Z+5 R0 FMAX\n", block);
      ASSERT_EQ(low.strokes.size(), page.strokes.size());
      EXPECT_LT((low.points[0] - Vector3(-60, -60, clearance + ball)).norm(), near);
      const Vector3 begin = page.strokes.front().start;
      EXPECT_LT((low.points[1] - Vector3(begin.x(), begin.y(), clearance + ball)).norm(), near);
      EXPECT_LT((low.points[2] - begin).norm(), near);
      // From above it: across where it stands, straight down.
      const Travel high = travelOf(bench, "L Z+60 R0 FMAX\nL X-60 Y-60 R0 FMAX\n", block);
      EXPECT_LT((high.points[0] - Vector3(begin.x(), begin.y(), 60 + ball)).norm(), near);
      EXPECT_LT((high.points[1] - begin).norm(), near);
      for (std::size_t i = 0; i < page.strokes.size(); ++i) {
        EXPECT_LT((low.strokes[i].start - page.strokes[i].start).norm(), near) << "stroke " << i;
        EXPECT_LT((low.strokes[i].direction - page.strokes[i].direction).norm(), near) << "stroke " << i;
      }
      for (std::size_t i = 0; i < low.highest.size(); ++i) {
        const bool sameHole = page.cycle == 430 && i % 4 != 3;
        const bool up = page.way == Way::ClearanceHeight && !sameHole;
        EXPECT_NEAR(low.highest[i], up ? clearance + ball : page.strokes[i].start.z(), near) << "gap " << i;
        if (page.cycle == 421 || page.cycle == 422) {
          EXPECT_EQ(low.corners[i] > 4, page.arcs) << "gap " << i;
        }
      }
      EXPECT_NEAR(low.last.z(), clearance + ball, near) << "the way ends at the clearance height";
      ++tested;
    }
  }
  EXPECT_GT(tested, 50U);
}

/// Too narrow for the set-up clearance: all strokes begin in the middle, at the measuring height whatever Q301 says.
TEST(InspectionTravel, BeginsInTheMiddleOfNarrowPockets) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    for (const int between : {0, 1}) {
      for (const bool round : {true, false}) {
        SCOPED_TRACE(fmt::format("{} Q301 = {} {}", control::name(kind), between, round));
        Bench bench = travelBench(kind);
        PlantedPart pocket{bench};
        pocket.machineFromPart = pose({50, 40, -400});
        Words words = with(common, {{273, 50}, {274, 40}, {301, between}, {279, 0}, {280, 0}});
        if (round) {
          pocket.bench.part(simulation::Ring(off - 0.1, 40, -40), pocket.machineFromPart);
          words = with(words, {{262, 2 * off - 0.2}, {325, 0}, {247, 90}, {275, 0}, {276, 0}});
        } else {
          layPocket(pocket, {60, 2 * off - 0.2});
          words = with(words, {{282, 60}, {283, 2 * off - 0.2}, {284, 0}, {285, 0}, {286, 0}, {287, 0}});
        }
        const Travel travel =
            travelOf(pocket.bench, "L Z+60 R0 FMAX\nL X-60 Y-60 R0 FMAX\n", probe(round ? 421 : 423, words));
        ASSERT_EQ(travel.strokes.size(), 4U);
        for (const Stroke& stroke : travel.strokes)
          EXPECT_LT((stroke.start - middle).norm(), near);
        for (const double height : travel.highest)
          EXPECT_NEAR(height, depth, near);
        EXPECT_NEAR(travel.last.z(), clearance + ball, near) << "the lowest point of the ball ends at Q260";
      }
    }
  }
}

/// 425 without an offset: straight across, the larger part of a wide slot at positioning speed.
TEST(InspectionTravel, CrossesASlotStraight) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    const bool newer = kind == ControlKind::TNC640;
    PlantedPart slot{travelBench(kind)};
    slot.machineFromPart = pose({50, 40, -400});
    layPocket(slot, {200, 60});
    Words words = with(common, {{328, 50}, {329, 45}, {310, 0}, {272, 2}, {311, 60}, {288, 0}, {289, 0}});
    if (newer) {
      words = with(words, {{301, 1}});
    } else {
      std::erase_if(words, [](const auto& word) { return word.first == 320; });
    }
    const Travel travel = travelOf(slot.bench, "L Z+60 R0 FMAX\nL X-60 Y-60 R0 FMAX\n", probe(425, words));
    ASSERT_EQ(travel.strokes.size(), 2U);
    EXPECT_LT((travel.strokes[0].start - Vector3(50, 45, depth)).norm(), near);
    EXPECT_LT((travel.strokes[0].direction - Vector3::UnitY()).norm(), near);
    EXPECT_LT((travel.strokes[1].start - Vector3(50, 10 + (newer ? off : off - extra), depth)).norm(), near);
    EXPECT_LT((travel.strokes[1].direction + Vector3::UnitY()).norm(), near);
    EXPECT_NEAR(travel.highest[0], depth, near);
  }
}

}  // namespace
}  // namespace probewright::testing_support
