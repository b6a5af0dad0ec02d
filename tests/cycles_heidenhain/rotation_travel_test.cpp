#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"

/// When the rotation cycles visit the clearance height, and how fast they pre-position (Q1125).
namespace probewright::testing_support {
namespace {

constexpr double clearance = 30;

/// The highest place of the ball before the first touch, between the touches, and behind the last one, above the
/// clearance height; and the speed of the longest move across before the last touch, mm/min.
struct Travel {
  std::vector<double> highest;
  double across = 0;
};
Travel travelOf(const Bench& bench, const std::string& block) {
  session::RunOptions options;
  options.control = ControlKind::TNC640;
  const Ran ran(setup::runText(
      "BENCH.H",
      "BEGIN PGM BENCH MM\nTOOL CALL 1 Z\nL X+0 Y-60 R0 FMAX\nL Z+5 R0 FMAX\n" + block + "END PGM BENCH MM\n",
      bench.setup, options));
  EXPECT_TRUE(ran.finished()) << ran.why();
  const auto& path = ran.machine->path();
  Travel travel;
  const auto& touches = path.touches;
  std::size_t next = 0;
  double top = -1e9, longest = 0;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const auto& point = path.points[i];
    // What counts begins where the program has brought the probe to its start.
    if (point.tip.z() > -300) continue;
    top = std::max(top, point.tip.z() + 400 - 2 - clearance);
    const Vector3 way = point.tip - path.points[i - 1].tip;
    if (next + 1 == touches.size() && std::abs(way.z()) < 1e-6 && way.norm() > longest && next > 0) {
      longest = way.norm();
      travel.across = 60 * longest / (point.seconds - path.points[i - 1].seconds);
    }
    if (next < touches.size() && touches[next].pathPoint == i) {
      travel.highest.push_back(top);
      top = -1e9;
      ++next;
    }
  }
  travel.highest.push_back(top);
  return travel;
}

/// A block of 100 x 100 mm, or two studs.
Bench benchFor(int cycle) {
  Bench bench;
  bench.preset(1, {0, 0, -400});
  bench.believedProbe().rapid = 900;
  if (cycle == 1411) {
    for (const double x : {-60.0, 60.0})
      bench.part(simulation::RoundBar(10, -40, 0), pose({x, 0, -400}));
  } else {
    bench.part(simulation::Box({-50, -50, -40}, {50, 50, 0}), pose({0, 0, -400}));
  }
  return bench;
}

Words wordsFor(int cycle) {
  const Words travel = {{320, 0}, {260, clearance}, {309, 0}, {1126, 0}, {1120, 0}, {1121, 0}};
  switch (cycle) {
    case 1410:
      return with(travel, {{1100, -30}, {1101, -50}, {1102, -8}, {1103, 30}, {1104, -50}, {1105, -8}, {372, 2}});
    case 1411:
      return with(travel, {{1100, -60},
                           {1101, 0},
                           {1102, -8},
                           {1116, 20},
                           {1103, 60},
                           {1104, 0},
                           {1105, -8},
                           {1117, 20},
                           {1115, 1},
                           {423, 3},
                           {325, 90},
                           {1119, 360}});
    default:
      return with(travel, {{1100, -30},
                           {1101, -30},
                           {1102, 0},
                           {1103, 30},
                           {1104, -30},
                           {1105, 0},
                           {1106, 0},
                           {1107, 30},
                           {1108, 0},
                           {372, -3}});
  }
}

TEST(RotationCycles, VisitTheClearanceHeightAsTheyAreTold) {
  for (const int cycle : {1410, 1411, 1420}) {
    for (const int mode : {-1, 0, 1, 2}) {
      SCOPED_TRACE(fmt::format("cycle {}, Q1125 {}", cycle, mode));
      const Travel travel = travelOf(benchFor(cycle), probe(cycle, with(wordsFor(cycle), {{1125, mode}})));
      const std::size_t touches = cycle == 1410 ? 2 : cycle == 1420 ? 3 : 6;
      ASSERT_EQ(travel.highest.size(), touches + 1);
      for (std::size_t gap = 0; gap <= touches; ++gap) {
        const bool outside = gap == 0 || gap == touches;
        const bool betweenObjects = cycle == 1411 && gap == 3;
        const bool up = mode == 2 || (mode >= 0 && outside) || (mode == 1 && betweenObjects);
        if (up) {
          EXPECT_NEAR(travel.highest[gap], 0, 1e-6) << "gap " << gap;
        } else {
          EXPECT_LT(travel.highest[gap], -10) << "gap " << gap;
        }
      }
      // 60 mm and more across at 2000 mm/min where every touch is for itself, else at FMAX of the probe table.
      if (cycle != 1411) {
        EXPECT_NEAR(travel.across, mode == 2 ? 2000 : 900, mode == 2 ? 200 : 90);
      }
    }
  }
}

/// F_PREPOS = FMAX_MACHINE is for the older cycles: these pre-position at FMAX of the probe, or at 2000 mm/min.
TEST(RotationCycles, PrepositionAtTheFeedOfTheProbe) {
  for (const int cycle : {1410, 1420}) {
    for (const int mode : {-1, 0, 1, 2}) {
      SCOPED_TRACE(fmt::format("cycle {}, Q1125 {}", cycle, mode));
      Bench bench = benchFor(cycle);
      const TableFolder folder(bench);
      auto table = control::heidenhain::defaultProbeTable(ControlKind::TNC640);
      ASSERT_TRUE(table.setNumber("1", "FMAX", 900));
      ASSERT_TRUE(table.setText("1", "F_PREPOS", "FMAX_MACHINE"));
      folder.put("TCHPROBE.TP", table);
      const Travel travel = travelOf(bench, probe(cycle, with(wordsFor(cycle), {{1125, mode}})));
      EXPECT_NEAR(travel.across, mode == 2 ? 2000 : 900, mode == 2 ? 200 : 90);
    }
  }
}

TEST(RotationCycles, TakeClearanceAndHeightFromGlobalDefinitions) {
  const std::string global =
      fmt::format("GLOBAL DEF 120 PROBING ~\n  Q320=+3 ;X ~\n  Q260=+{} ;X ~\n  Q301=+0 ;X\n", clearance);
  for (const int cycle : {1410, 1411, 1420}) {
    SCOPED_TRACE(cycle);
    const Words words = with(wordsFor(cycle), {{1125, 2}, {320, 3}});
    std::string block = probe(cycle, words);
    for (const int number : {320, 260}) {
      const std::size_t at = block.find(fmt::format("Q{}=", number)) + 5;
      block.replace(at, block.find(' ', at) - at, "PREDEF");
    }
    const Bench bench = benchFor(cycle);
    const Ran named = bench.run(probe(cycle, words)), predefined = bench.run(global + block);
    ASSERT_TRUE(predefined.finished()) << predefined.why();
    EXPECT_NEAR(predefined.cycle().pathLength, named.cycle().pathLength, 1e-6);
    // The plane of 1420 is touched along the way that leads down to it: there the longer stroke tells by its time
    // alone.
    const Ran other = bench.run(probe(cycle, with(words, {{320, 0}})));
    const auto seconds = [](const Ran& ran) { return ran.cycle().endSeconds - ran.cycle().startSeconds; };
    EXPECT_GT(seconds(named) - seconds(other), 0.5);
    EXPECT_EQ(bench.run(block).alarm(), "GLOBAL DEF missing");
  }
}

}  // namespace
}  // namespace probewright::testing_support
