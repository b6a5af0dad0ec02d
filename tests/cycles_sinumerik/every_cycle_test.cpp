#include "cycles_sinumerik/milling_variants.hpp"

/// What holds for every call of a milling cycle: it is left out in dry run, program test and block search, and its
/// results fit together.
namespace probewright {
namespace {

using namespace testing_support;

TEST(EveryCycle, IsLeftOutInDryRunProgramTestAndBlockSearch) {
  for (const Variant& variant : everyCall()) {
    for (int state = 0; state < 3; ++state) {
      SCOPED_TRACE(fmt::format("{} in state {}", variant.name, state));
      simulation::Truth truth = perfectWorld();
      variant.part(truth, translation(origin + Vector3(0.2, 0.1, 0)));
      SinumerikBench bench(truth);
      plantFrame(bench, "$P_UIFR", 1, origin);
      bench.control.ovr[4] = 123;
      bench.control.dryRun = state == 0;
      bench.control.programTest = state == 1;
      bench.control.blockSearch = state == 2;
      bench.hostOptions.searchLine = 1000;
      bench.start(variant.start);
      // Not even what the call would be refused for counts.
      bench.run(variant.cycle, with(variant.call, {{"S_KNUM", variant.axes.empty() ? 0.0 : 1.0}, {"S_FA", 0}}));
      EXPECT_TRUE(bench.control.journal.cycles.empty());
      EXPECT_TRUE(bench.machine.path().touches.empty());
      EXPECT_EQ(bench.control.ovr[4], 123) << "the results of the last cycle stay";
      EXPECT_EQ(bench.data("$P_UIFR", {1, "X", "FI"}), 0);
      EXPECT_EQ(bench.control.journal.events.back().kind, control::EventKind::Skipped);
    }
  }
}

/// The cycles that give set value, actual value and difference of one thing in elements that lie 4 and 16 apart.
TEST(EveryCycle, DifferencesAreActualLessSetValue) {
  Planter plant(501);
  for (const Variant& variant : everyCall()) {
    const std::string_view cycle = variant.cycle;
    if (cycle == "CYCLE961" || cycle == "CYCLE976" || cycle == "CYCLE995") continue;
    SCOPED_TRACE(variant.name);
    const Pose part = displaced(variant, translation(origin), plant);
    simulation::Truth truth = perfectWorld();
    variant.part(truth, part);
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin);
    bench.start(variant.start);
    bench.run(variant.cycle, with(variant.call, {{"S_KNUM", 1}}));
    const int apart = cycle == "CYCLE997" ? 8 : 16, balls = variant.tilts && cycle == "CYCLE997" ? 3 : 1;
    int seen = 0;
    for (int element = 0; element < 4; ++element) {
      EXPECT_NEAR(bench.ovr(apart + element), bench.ovr(4 + element) - bench.ovr(element), 1e-9) << element;
      seen += bench.ovr(apart + element) != 0 ? 1 : 0;
    }
    EXPECT_GE(seen, 1);
    for (int ball = 1; ball < balls; ++ball) {
      Vector3 set;
      for (int axis = 0; axis < 3; ++axis)
        set[axis] = valueOf(variant.call, fmt::format("S_SETV{}", 3 * ball + axis));
      const Vector3 actual = translation(origin).inverse() * (part * set);
      EXPECT_NEAR(bench.ovr(4 + 8 * ball), 20, 1e-6);
      EXPECT_NEAR(bench.ovr(8 + 8 * ball), 0, 1e-6);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(bench.ovr(5 + 8 * ball + axis), actual[axis], 1e-6) << ball;
        EXPECT_NEAR(bench.ovr(9 + 8 * ball + axis), actual[axis] - set[axis], 1e-6) << ball;
      }
    }
    EXPECT_EQ(bench.ovi(2), std::stoi(variant.cycle + 5));
    EXPECT_EQ(bench.ovi(3), valueOf(variant.call, "S_MVAR"));
    EXPECT_EQ(bench.ovi(5), 1);
    EXPECT_EQ(bench.ovi(9), 0);
    EXPECT_EQ(bench.ovr(28), valueOf(variant.call, "S_TSA"));
  }
}

/// Results and frame after a call on a displaced part.
std::vector<double> outcome(const Variant& variant, const NamedNumbers& more, const std::string& before = {},
                            int dataSet = 0) {
  Planter plant(503);
  simulation::Truth truth = perfectWorld();
  variant.part(truth, displaced(variant, translation(origin), plant));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, origin);
  if (dataSet != 0) {
    for (const auto& name : {"$SNS_MEA_WP_BALL_DIAM", "$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", "$SNS_MEA_WP_TRIG_PLUS_DIR_AX1",
                             "$SNS_MEA_WP_TRIG_MINUS_DIR_AX2", "$SNS_MEA_WP_TRIG_PLUS_DIR_AX2"}) {
      bench.set(name, {dataSet}, bench.data(name, {0}));
      bench.set(name, {0}, 0);
    }
  }
  bench.start(variant.start);
  bench.run(variant.cycle, with(with(variant.call, {{"S_KNUM", variant.axes.empty() && !variant.turns ? 0 : 1}}), more),
            {}, before);
  EXPECT_EQ(bench.control.plane, before.starts_with("G18") ? 18 : 17) << "PROC ... SAVE";
  std::vector<double> all(bench.control.ovr.begin(), bench.control.ovr.end());
  for (const auto& key : bench.control.data.keys("$P_UIFR"))
    all.push_back(bench.control.data.number(key));
  all.push_back(bench.ovi(5));
  return all;
}

void expectAlike(const std::vector<double>& first, const std::vector<double>& second) {
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i)
    EXPECT_NEAR(first[i], second[i], 1e-9) << i;
}

TEST(EveryCycle, TakesPlaneAndDataSetOfTheCall) {
  for (const Variant& variant : everyCall()) {
    SCOPED_TRACE(variant.name);
    const std::vector<double> plain = outcome(variant, {});
    EXPECT_EQ(plain.back(), 1);
    expectAlike(plain, outcome(variant, {{"_DMODE", 1}}));
    // In G18 the length of the probe acts in Y: the plane is changed in front of the call only.
    expectAlike(plain, outcome(variant, {{"_DMODE", 1}}, "G18\n"));
    for (const int number : {2, 12}) {
      std::vector<double> other = outcome(variant, {{"S_PRNUM", number}}, {}, number - 1);
      EXPECT_EQ(other.back(), number);
      other.back() = 1;
      expectAlike(plain, other);
    }
  }
}

TEST(EveryCycle, ReservedArgumentsChangeNothing) {
  for (const Variant& variant : everyCall()) {
    SCOPED_TRACE(variant.name);
    NamedNumbers reserved = {{"S_MCBIT", 255}};
    const std::string_view cycle = variant.cycle;
    if (cycle == "CYCLE961" || cycle == "CYCLE976" || cycle == "CYCLE997" || cycle == "CYCLE998")
      reserved.emplace_back("_AMODE", 1);
    if (cycle == "CYCLE998") reserved.emplace_back("S_SETV1", 17);
    if (cycle == "CYCLE995")
      reserved = with(reserved, {{"S_INCA", 30}, {"S_SETV0", 7}, {"S_SETV1", 8}, {"S_SETV2", 9}, {"S_KNUM", 0}});
    if (cycle == "CYCLE998") reserved.erase(reserved.begin());  // has none
    expectAlike(outcome(variant, {}), outcome(variant, reserved));
  }
}

TEST(EveryCycle, EndsWhereTheManualSays) {
  // In front of the last surface by the measuring path, in the middle of what was measured, or where it began. The ball
  // has radius 2, positions are those of its lowest point.
  Planter plant(502);
  for (const Variant& variant : everyCall()) {
    const std::string_view name = variant.name;
    SCOPED_TRACE(name);
    const Pose part = displaced(variant, translation(origin), plant);
    simulation::Truth truth = perfectWorld();
    variant.part(truth, part);
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin);
    NamedNumbers call = variant.call;
    for (auto& [parameter, value] : call)
      if (parameter == "S_MVAR" && static_cast<int>(value) / 100 % 10 == 1) value -= 100;
    bench.start(variant.start);
    bench.run(variant.cycle, call);
    const Vector3 middle = part.translation() - origin;
    const double path = valueOf(call, "S_FA");
    Vector3 end = variant.start;
    if (name.starts_with("978")) {
      const int axis = variant.axes.front();
      end[axis] = axis == 2 ? path : -path - 2;
    } else if (name.starts_with("977")) {
      for (const int axis : variant.axes)
        end[axis] = middle[axis];
    } else if (name.starts_with("979")) {
      const double step = valueOf(call, "S_INCA");
      end = name == "979 inside" ? (20 - path - 2) * probing::directionAt(2 * step).vector()
                                 : (20 + path + 2) * probing::directionAt(3 * step).vector();
      end.z() = variant.start.z();
    } else if (name == "997 ball") {
      end.head<2>() = middle.head<2>();
    } else if (name == "997 three balls") {
      end.head<2>() = (part * Vector3(20, 50, -5) - origin).head<2>();
    } else if (name.starts_with("961 any")) {
      end = Vector3(valueOf(call, "S_SETV4"), valueOf(call, "S_SETV5") + valueOf(call, "S_SETV3"), variant.start.z());
    } else if (name == "998 edge") {
      // The ball's centre at the touch lies its radius from the face.
      end.y() += valueOf(call, "S_ID");
      const Vector3 normal = part.linear().col(0);
      end.x() = (normal.dot(middle) - 2 - normal.y() * end.y()) / normal.x() - path;
    } else if (name == "998 plane") {
      end += Vector3(valueOf(call, "S_SETV2"), valueOf(call, "S_SETV3"), 0);
      const Vector3 normal = part.linear().col(2);
      const double along = normal.x() * end.x() + normal.y() * end.y();
      end.z() = (normal.dot(middle) + 2 - along) / normal.z() - 2 + path;
    }
    const Vector3 here = bench.control.channel.position().vector();
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(here[axis], end[axis], name == "995" ? 1e-3 : 1e-6) << axis;
  }
}

TEST(EveryCycle, ACalibrationShowsAllOfItsData) {
  // The lists of results: ball, trigger points of the axes concerned, deviations, length; changed or not.
  simulation::Truth truth = perfectWorld();
  truth.tools[0].probe.tipOffset = {0.03, -0.02};
  place(truth, simulation::Ring(20, 60, -40), translation(origin));
  place(truth, simulation::SolidSphere({100, 0, 0}, 12), translation(origin));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, origin);
  const struct {
    NamedNumbers call;
    Vector3 start;
    std::vector<int> shown;
  } cases[] = {
      {{{"S_MVAR", 0}, {"S_SETV", 0}}, {30, 0, 8}, {4, 5, 16, 17, 18, 19, 22, 28}},
      {{{"S_MVAR", 1}, {"S_SETV", 40}}, {0, 0, -10}, {4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 20, 21, 24, 28}},
      {{{"S_MVAR", 1001}, {"S_SETV", 40}, {"S_MA", 2}, {"S_MD", 1}},
       {0, 0, -10},
       {4, 5, 8, 9, 10, 11, 12, 13, 14, 15, 20, 21, 24, 28}},
      {{{"S_MVAR", 2004}, {"S_SETV", 40}, {"S_MA", 1}},
       {0, 0, -10},
       {4, 5, 8, 9, 10, 11, 12, 13, 14, 15, 20, 21, 24, 28}},
      {{{"S_MVAR", 3}, {"S_SETV", 24}}, {100, 0, 20}, {4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14,
                                                       15, 16, 17, 18, 19, 20, 21, 22, 24, 28}},
  };
  constexpr const char* data[] = {"$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", "$SNS_MEA_WP_TRIG_PLUS_DIR_AX1",
                                  "$SNS_MEA_WP_TRIG_MINUS_DIR_AX2", "$SNS_MEA_WP_TRIG_PLUS_DIR_AX2",
                                  "$SNS_MEA_WP_TRIG_MINUS_DIR_AX3", "$SNS_MEA_WP_TRIG_PLUS_DIR_AX3"};
  for (const auto& [call, start, shown] : cases) {
    SCOPED_TRACE(call.front().second);
    double before[6];
    for (int i = 0; i < 6; ++i)
      before[i] = bench.data(data[i], {0});
    const double ball = bench.data("$SNS_MEA_WP_BALL_DIAM", {0});
    bench.start(start);
    bench.run("CYCLE976", with({{"S_FA", 6}, {"S_TSA", 4}}, call));
    for (const int index : shown) {
      const auto& results = bench.control.journal.cycles.back().results;
      const std::string name = fmt::format("_OVR[{}]", index);
      EXPECT_TRUE(std::ranges::any_of(results, [&](const auto& result) { return result.name == name; })) << name;
    }
    EXPECT_NEAR(bench.ovr(4), bench.data("$SNS_MEA_WP_BALL_DIAM", {0}), 1e-12);
    EXPECT_NEAR(bench.ovr(5), bench.data("$SNS_MEA_WP_BALL_DIAM", {0}) - ball, 1e-12);
    for (int i = 0; i < 6; ++i) {
      if (std::ranges::find(shown, 8 + 2 * i) == shown.end()) continue;
      EXPECT_NEAR(bench.ovr(8 + 2 * i), bench.data(data[i], {0}), 1e-12) << i;
      EXPECT_NEAR(bench.ovr(9 + 2 * i), bench.data(data[i], {0}) - before[i], 1e-12) << i;
    }
    if (shown.back() == 28 && std::ranges::find(shown, 22) != shown.end()) {
      EXPECT_NEAR(bench.ovr(22), bench.data("$TC_DP3", {1, 1}), 1e-12);
    }
    if (std::ranges::find(shown, 20) != shown.end()) {
      EXPECT_NEAR(bench.ovr(20), bench.data("$SNS_MEA_WP_POS_DEV_AX1", {0}), 1e-12);
      EXPECT_NEAR(bench.ovr(21), bench.data("$SNS_MEA_WP_POS_DEV_AX2", {0}), 1e-12);
    }
  }
}

}  // namespace
}  // namespace probewright
