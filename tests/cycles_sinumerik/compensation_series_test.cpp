#include <array>

#include "support/sinumerik_bench.hpp"

/// Series of parts measured with tool correction, against the decisions of the manual's flow chart, written here once
/// more from its words.
namespace probewright {
namespace {

using namespace testing_support;

constexpr double table = -350;

/// What one measurement is to do, chapters 1.9 to 1.11 of the manual.
struct Model {
  double zeroOffsetRange = 0, twoThirds = 0, dimensionalDifference = 0, upper = 0, lower = 0, empirical = 0;
  int weight = 1;
  bool tolerance = false, averages = false;

  double mean = 0, corrected = 0;  ///< memory of the mean; sum of all corrections
  double shown = 0;                ///< the mean as a result: also where it has corrected and is cleared
  std::string message;

  void measure(double set, double actual) {
    message.clear();
    shown = mean;
    const double middle = tolerance ? (upper + lower) / 2 : 0, half = (upper - lower) / 2;
    const double difference = actual - (set + middle) - empirical, size = std::abs(difference);
    if (size > dimensionalDifference) {
      message = "61306 ";
      return;
    }
    if (tolerance && size > half) message = difference > 0 ? "61304 " : "61305 ";
    if (size >= twoThirds || (tolerance && size > half)) {
      corrected += difference;  // all of it, and the mean begins anew
      if (averages) shown = mean = 0;
      return;
    }
    const double value = averages ? mean - (mean - difference) / weight : difference;
    const bool counts = std::abs(value) > zeroOffsetRange;
    if (counts) corrected += value;
    if (averages) {
      shown = value;
      mean = counts ? 0 : value;
    }
  }
};

struct Feature {
  const char* cycle;
  NamedNumbers call;
  Vector3 start;
  double size;    ///< what is truly there
  double factor;  ///< from a correction to the change of the radius
};

TEST(CompensationSeries, FollowTheFlowChart) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Box({0, 0, -60}, {100, 80, 0}), translation({0, 0, table}));
  place(truth, simulation::Ring(20, 45, -60), translation({-150, 0, table}));
  place(truth, simulation::RoundBar(15, -60, 0), translation({0, -150, table}));
  const std::array<Feature, 5> features = {{
      {"CYCLE978", {{"S_MVAR", 200}, {"S_MA", 1}, {"S_MD", 2}}, {112, 30, -10}, 100, -1},
      {"CYCLE977", {{"S_MVAR", 201}}, {-150, 0, -10}, 40, 0.5},
      {"CYCLE977", {{"S_MVAR", 202}, {"S_ID", -20}}, {0, -150, 10}, 30, -0.5},
      {"CYCLE979", {{"S_MVAR", 201}, {"S_CPA", -150}, {"S_INCA", 90}}, {-142, 0, -10}, 40, 0.5},
      {"CYCLE979", {{"S_MVAR", 1202}, {"S_CPO", -150}, {"S_INCA", 80}}, {27, -150, -10}, 30, -0.5},
  }};
  Planter plant(1100);
  for (int series = 0; series < 30; ++series) {
    const Feature& feature = features[static_cast<std::size_t>(series) % features.size()];
    Model model;
    model.zeroOffsetRange = plant.number(0, 0.03);
    model.twoThirds = plant.number(0.04, 0.08);
    model.dimensionalDifference = plant.number(0.15, 0.25);
    model.upper = plant.number(0.05, 0.12);
    model.lower = plant.number(-0.12, -0.02);
    model.weight = 1 + series % 4;
    model.tolerance = series % 3 != 0;
    model.averages = series % 2 == 0;
    model.empirical = series % 7 == 3 ? 0 : plant.number(-0.02, 0.02);
    const int memory = 1 + series % 20, empirical = 1 + (3 * series) % 20;
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    bench.control.data.set("$TC_TP2", {7}, std::string("MILL"));
    bench.set("$TC_DP1", {7, 1}, 120);
    bench.set("$SCS_MEA_EMPIRIC_VALUE", {empirical - 1}, model.empirical);
    for (int part = 0; part < 12; ++part) {
      const double set = feature.size - plant.number(-0.2, 0.2) * (part % 3 == 0 ? 1 : 0.3);
      bench.control.journal.events.clear();
      bench.start(feature.start);
      bench.run(feature.cycle,
                with(feature.call, {{"S_KNUM1", 1},
                                    {"S_SETV", set},
                                    {"S_FA", 5},
                                    {"S_TSA", 1},
                                    {"S_TZL", model.zeroOffsetRange},
                                    {"S_TMV", model.twoThirds},
                                    {"S_TDIF", model.dimensionalDifference},
                                    {"S_TUL", model.upper},
                                    {"S_TLL", model.lower},
                                    {"S_K", model.weight},
                                    {"S_EVNUM", empirical + (model.averages ? 10000 * memory : 0)},
                                    {"_AMODE", model.tolerance ? 1 : 0}}),
                {{"S_TNAME", "MILL"}});
      const double before = model.corrected;
      model.measure(set, feature.size);
      SCOPED_TRACE(fmt::format("series {} part {} {}", series, part, feature.cycle));
      EXPECT_NEAR(bench.data("$TC_DP15", {7, 1}), feature.factor * model.corrected, 1e-6);
      EXPECT_NEAR(bench.data("$SCS_MEA_AVERAGE_VALUE", {memory - 1}), model.mean, 1e-6);
      EXPECT_EQ(bench.messages(), model.message);
      EXPECT_NEAR(bench.ovr(20), feature.factor * (model.corrected - before), 1e-6);
      EXPECT_NEAR(bench.ovr(27), model.zeroOffsetRange, 1e-12);
      EXPECT_NEAR(bench.ovr(28), 1, 1e-12);
      EXPECT_NEAR(bench.ovr(29), model.dimensionalDifference, 1e-12);
      EXPECT_NEAR(bench.ovr(30), model.empirical, 1e-12);
      EXPECT_NEAR(bench.ovr(31), model.shown, 1e-6);
      EXPECT_EQ(bench.ovi(4), model.weight);
      EXPECT_EQ(bench.ovi(6), model.averages ? memory : 0);
      EXPECT_EQ(bench.ovi(7), empirical);
    }
  }
}

TEST(CompensationSeries, ARectangleIsJudgedByBothItsLengths) {
  Planter plant(1101);
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Box({-20, -15, -60}, {20, 15, 0}), translation({0, 0, table}));
  for (int world = 0; world < 20; ++world) {
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    bench.control.data.set("$TC_TP2", {7}, std::string("MILL"));
    bench.set("$TC_DP1", {7, 1}, 120);
    const double first = plant.number(-0.1, 0.1), second = plant.number(-0.1, 0.1);
    bench.start({0, 0, 10});
    bench.run("CYCLE977",
              {{"S_MVAR", 206},
               {"S_KNUM1", 1},
               {"S_SETV0", 40 - first},
               {"S_SETV1", 30 - second},
               {"S_FA", 5},
               {"S_TSA", 1},
               {"S_ID", -20},
               {"S_TUL", 0.06},
               {"S_TLL", -0.06},
               {"_AMODE", 1}},
              {{"S_TNAME", "MILL"}});
    std::string expected;
    for (const double difference : {first, second})
      if (std::abs(difference) > 0.06) expected += difference > 0 ? "61304 " : "61305 ";
    EXPECT_EQ(bench.messages(), expected);
    EXPECT_NEAR(bench.data("$TC_DP15", {7, 1}), -(first + second) / 4, 1e-7) << "half of the mean";
    for (const int index : {8, 9})
      EXPECT_NEAR(bench.ovr(index), 0.06, 1e-12);
    for (const int index : {12, 13})
      EXPECT_NEAR(bench.ovr(index), -0.06, 1e-12);
  }
}

TEST(CompensationSeries, UniqueDNumbersNeedNoName) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Ring(20, 45, -60), translation({0, 0, table}));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.set("$TC_DP1", {7, 1}, 120);
  bench.set("$TC_DP1", {7, 31999}, 120);
  bench.set("$TC_DP1", {8, 12345}, 120);
  bench.set("$TC_DP1", {9, 2000}, 120);
  bench.set("$TC_DP1", {8, 2000}, 120);
  const auto call = [](double edge) {
    return NamedNumbers{{"S_MVAR", 201}, {"S_KNUM1", edge}, {"S_SETV", 39.9}, {"S_FA", 5}, {"S_TSA", 1}};
  };
  bench.start({0, 0, -10});
  bench.run("CYCLE977", call(31999));
  EXPECT_NEAR(bench.data("$TC_DP15", {7, 31999}), 0.05, 1e-7);
  EXPECT_EQ(bench.ovi(0), 31999);
  EXPECT_EQ(bench.ovi(8), 7);
  bench.start({0, 0, -10});
  bench.run("CYCLE977", call(412345));
  EXPECT_NEAR(bench.data("$TC_DP15", {8, 12345}), 0.05, 1e-7);
  for (const double edge : {2000.0, 3000.0}) {
    bench.start({0, 0, -10});
    EXPECT_EQ(bench.alarmOf("CYCLE977", call(edge)), "61328") << edge;
  }
  bench.start({0, 0, -10});
  EXPECT_EQ(bench.alarmOf("CYCLE977", call(1)), "61343");
  // Where MD 18102 says that D numbers are unique, those of three digits need none either.
  bench.set("$MN_MM_TYPE_CUTTING_EDGE", {}, 1);
  bench.set("$TC_DP1", {7, 5}, 120);
  bench.start({0, 0, -10});
  bench.run("CYCLE977", call(400005));
  EXPECT_NEAR(bench.data("$TC_DP15", {7, 5}), 0.05, 1e-7);
  bench.start({0, 0, -10});
  EXPECT_EQ(bench.alarmOf("CYCLE977", call(1)), "61328") << "the probe has a D1, too";
}

}  // namespace
}  // namespace probewright
