#include <algorithm>
#include <tuple>

#include "support/sinumerik_bench.hpp"

/// Call parameters that mean the same in many cycles, and digits that change the way through one.
namespace probewright {
namespace {

using namespace testing_support;
using simulation::PathKind;

constexpr double table = -350;

std::size_t measuringMoves(const SinumerikBench& bench, std::size_t from) {
  const auto& points = bench.machine.path().points;
  return static_cast<std::size_t>(std::count_if(points.begin() + static_cast<std::ptrdiff_t>(from), points.end(),
                                                [](const auto& point) { return point.kind == PathKind::Measure; }));
}

TEST(CallParameters, NmspMeasuresEachPointSoManyTimes) {
  using simulation::Box;
  const auto hole = simulation::Ring(20, 80, -60);
  const auto block = Box({0, 0, -60}, {80, 80, 0});
  const auto ball = simulation::SolidSphere(Vector3::Zero(), 15);
  const struct {
    const char* cycle;
    int what;  // 0 hole, 1 block, 2 ball
    NamedNumbers call;
    Vector3 start;
    std::size_t points;
  } cases[] = {
      {"CYCLE976", 0, {{"S_MVAR", 1}, {"S_SETV", 40}}, {0, 0, -10}, 8},
      {"CYCLE977", 0, {{"S_MVAR", 1}, {"S_SETV", 40}}, {0, 0, -10}, 4},
      {"CYCLE979", 0, {{"S_MVAR", 1}, {"S_SETV", 40}, {"S_INCA", 90}}, {8, 0, -10}, 3},
      {"CYCLE979", 0, {{"S_MVAR", 1001}, {"S_SETV", 40}, {"S_INCA", 90}}, {8, 0, -10}, 4},
      {"CYCLE978", 1, {{"S_MA", 1}, {"S_MD", 1}}, {-12, 30, -10}, 1},
      {"CYCLE998", 1, {{"S_MVAR", 100005}, {"S_MA", 201}, {"S_MD", 1}, {"S_ID", 40}}, {-12, 20, -10}, 2},
      {"CYCLE998", 1, {{"S_MVAR", 100006}, {"S_SETV0", 40}, {"S_SETV3", 40}}, {20, 20, 10}, 3},
      {"CYCLE961",
       1,
       {{"S_MVAR", 6}, {"S_SETV0", 30}, {"S_SETV1", 70}, {"S_SETV2", 40}, {"S_SETV4", -12}, {"S_SETV5", -12}},
       {-12, -12, -10},
       3},
      {"CYCLE997", 2, {{"S_MVAR", 9}, {"S_SETV", 30}}, {0, 0, 25}, 4},
      {"CYCLE997", 2, {{"S_MVAR", 1101019}, {"S_SETV", 30}, {"S_INCA", 90}}, {0, 0, 25}, 11},
  };
  for (const auto& [cycle, what, call, start, points] : cases) {
    SCOPED_TRACE(fmt::format("{} {}", cycle, call.front().second));
    simulation::Truth truth = perfectWorld();
    const Pose here = translation({0, 0, table});
    if (what == 0) place(truth, hole, here);
    if (what == 1) place(truth, block, here);
    if (what == 2) place(truth, ball, here);
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    for (const int times : {1, 2, 5}) {
      bench.start(start);
      const std::size_t from = bench.machine.path().points.size();
      bench.run(cycle, with(call, {{"S_FA", 6}, {"S_TSA", 5}, {"S_NMSP", times}}));
      EXPECT_EQ(measuringMoves(bench, from), points * static_cast<std::size_t>(times)) << times;
    }
  }
}

TEST(CallParameters, PrnumSelectsOneOfTwelveDataSets) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Ring(20, 80, -60), translation({0, 0, table}));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  // Each set believes in a ball of its own: the hole is found larger or smaller by as much.
  for (int set = 0; set < 12; ++set) {
    const double radius = 1.5 + 0.1 * set;
    bench.set("$SNS_MEA_WP_BALL_DIAM", {set}, 2 * radius);
    for (const char* axis : {"1", "2"}) {
      bench.set((std::string("$SNS_MEA_WP_TRIG_PLUS_DIR_AX") + axis).c_str(), {set}, radius);
      bench.set((std::string("$SNS_MEA_WP_TRIG_MINUS_DIR_AX") + axis).c_str(), {set}, -radius);
    }
  }
  for (int number = 0; number <= 12; ++number) {
    const double radius = 1.5 + 0.1 * std::max(0, number - 1);
    for (const auto& [cycle, start, call] :
         {std::tuple("CYCLE977", Vector3(0, 0, -10), NamedNumbers{{"S_MVAR", 1}}),
          std::tuple("CYCLE979", Vector3(8, 0, -10), NamedNumbers{{"S_MVAR", 1}, {"S_INCA", 90}})}) {
      bench.start(start);
      bench.run(cycle, with(call, {{"S_SETV", 40}, {"S_FA", 6}, {"S_TSA", 5}, {"S_PRNUM", number}}));
      EXPECT_NEAR(bench.ovr(4), 40 + 2 * (radius - 2), 1e-7) << cycle << " " << number;
      EXPECT_EQ(bench.ovi(5), std::max(1, number)) << "0 counts as 1";
    }
  }
  // A calibration fills the set that it is given.
  bench.start({0, 0, -10});
  bench.run("CYCLE976", {{"S_MVAR", 1}, {"S_SETV", 40}, {"S_FA", 6}, {"S_TSA", 5}, {"S_PRNUM", 12}});
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_BALL_DIAM", {11}), 4, 1e-9);
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_BALL_DIAM", {10}), 5, 1e-9);
}

TEST(CallParameters, Cycle961InsideCornersInEveryPosition) {
  Planter plant(9615);
  for (const int units : {5, 7}) {
    for (const bool zone : {false, true}) {
      for (int position = 0; position <= 4; ++position) {
        SCOPED_TRACE(fmt::format("units {} zone {} position {}", units, zone, position));
        const double x = position == 2 || position == 3 ? -1 : 1, y = position >= 3 ? -1 : 1;
        const double angle = plant.number(-1.5, 1.5);
        const Pose part =
            translation({plant.number(-1, 1), plant.number(-1, 1), table}) * rotation(Vector3::UnitZ(), angle);
        simulation::Truth truth = perfectWorld();
        // Material behind both walls; the room lies towards plus or minus of each axis.
        place(
            truth,
            simulation::Box({x > 0 ? -60.0 : -150, y > 0 ? -60.0 : 0, -60}, {x > 0 ? 150.0 : 60, y > 0 ? 0.0 : 60, 0}),
            part);
        place(
            truth,
            simulation::Box({x > 0 ? -60.0 : 0, y > 0 ? -60.0 : -150, -60}, {x > 0 ? 0.0 : 60, y > 0 ? 150.0 : 60, 0}),
            part);
        SinumerikBench bench(truth);
        plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
        const Vector3 pole(15 * x, 15 * y, zone ? 10 : -10);
        bench.start(pole);
        bench.run("CYCLE961", {{"S_MVAR", 10000.0 * position + (zone ? 1000 : 0) + 100 + units},
                               {"S_KNUM", 1},
                               {"S_SETV0", 10 * x},
                               {"S_SETV1", 70 * x},
                               {"S_SETV2", 10 * y},
                               {"S_SETV3", 70 * y},
                               {"S_SETV4", pole.x()},
                               {"S_SETV5", pole.y()},
                               {"S_INCA", 90},
                               {"S_ID", zone ? -20 : 0},
                               {"S_FA", 20},
                               {"S_TSA", 5}});
        EXPECT_NEAR(bench.ovr(4), angle, 1e-7);
        EXPECT_NEAR(inWorkpiece(bench, part.translation()).head<2>().norm(), 0, 1e-7);
      }
    }
  }
}

TEST(CallParameters, Cycle961RightAngledByCoordinates) {
  Planter plant(9611);
  for (const bool inside : {false, true}) {
    for (const bool zone : {false, true}) {
      for (const double turn : {0.0, 40.0, -130.0}) {
        SCOPED_TRACE(fmt::format("inside {} zone {} turn {}", inside, zone, turn));
        const Pose about = rotation(Vector3::UnitZ(), turn);
        const double angle = plant.number(-1.5, 1.5);
        const Pose part = translation({0, 0, table}) * about *
                          translation({plant.number(-1, 1), plant.number(-1, 1), 0}) *
                          rotation(Vector3::UnitZ(), angle);
        simulation::Truth truth = perfectWorld();
        if (inside) {
          place(truth, simulation::Box({-60, -60, -60}, {150, 0, 0}), part);
          place(truth, simulation::Box({-60, -60, -60}, {0, 150, 0}), part);
        } else {
          place(truth, simulation::Box({0, 0, -60}, {100, 100, 0}), part);
        }
        SinumerikBench bench(truth);
        plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
        const double side = inside ? 15 : -15;
        const Vector3 points[] = {about * Vector3(30, side, 0), about * Vector3(80, side, 0),
                                  about * Vector3(side, 60, 0)};
        const Vector3 pole = about * Vector3(side, side, 0);
        bench.start({pole.x(), pole.y(), zone ? 10.0 : -10.0});
        bench.run("CYCLE961", {{"S_MVAR", (inside ? 115.0 : 116.0) + (zone ? 1000 : 0)},
                               {"S_KNUM", 1},
                               {"S_SETV0", points[0].x()},
                               {"S_SETV1", points[0].y()},
                               {"S_SETV2", points[1].x()},
                               {"S_SETV3", points[1].y()},
                               {"S_SETV4", points[2].x()},
                               {"S_SETV5", points[2].y()},
                               {"S_ID", zone ? -20 : 0},
                               {"S_FA", 20},
                               {"S_TSA", 5}});
        EXPECT_NEAR(std::remainder(bench.ovr(4) - turn - angle, 360), 0, 1e-7);
        EXPECT_NEAR(inWorkpiece(bench, part.translation()).head<2>().norm(), 0, 1e-7);
      }
    }
  }
}

TEST(CallParameters, Cycle998OfAPlaneWithProtectionZone) {
  Planter plant(9986);
  for (const bool zone : {false, true}) {
    for (const bool alongAxes : {false, true}) {
      const double first = plant.number(-3, 3), second = plant.number(-3, 3);
      simulation::Truth truth = perfectWorld();
      place(truth, simulation::Box({-60, -60, -60}, {60, 60, 0}),
            translation({0, 0, table}) * rotation(Vector3::UnitY(), second) * rotation(Vector3::UnitX(), first));
      if (zone) place(truth, simulation::Box({-8, -60, -20}, {8, 60, 20}), translation({0, 0, table}), "rib");
      SinumerikBench bench(truth);
      plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
      bench.start({-30, -30, zone ? 32.0 : 12.0});
      bench.run("CYCLE998", {{"S_MVAR", 6.0 + (zone ? 1000 : 0) + (alongAxes ? 100000 : 0)},
                             {"S_SETV", zone ? -20 : 0},
                             {"S_FA", 10},
                             {"S_TSA", 5},
                             {"S_SETV0", 60},
                             {"S_SETV2", 60},
                             {"S_SETV3", 50}});
      EXPECT_NEAR(bench.ovr(4), first, 1e-6) << zone << alongAxes;
      EXPECT_NEAR(bench.ovr(5), second, 1e-6) << zone << alongAxes;
    }
  }
}

TEST(CallParameters, EvnumTakesAnEmpiricalValueOffWhereItMay) {
  // Angles of 998 and the edge of 978 with zero offset correction; sizes only with tool correction.
  simulation::Truth truth = perfectWorld();
  const Pose part = translation({0, 0, table}) * rotation(Vector3::UnitZ(), 1.5);
  place(truth, simulation::Box({0, -80, -60}, {80, 80, 0}), part);
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.set("$SCS_MEA_EMPIRIC_VALUE", {6}, 0.25);
  const NamedNumbers edge = {{"S_FA", 8}, {"S_TSA", 5}, {"S_MA", 201}, {"S_MD", 1}, {"S_ID", 40}, {"S_EVNUM", 7}};
  bench.start({-12, -20, -10});
  bench.run("CYCLE998", with(edge, {{"S_MVAR", 100005}}));
  EXPECT_NEAR(bench.ovr(16), 1.5, 1e-7) << "only measured";
  bench.start({-12, -20, -10});
  bench.run("CYCLE998", with(edge, {{"S_MVAR", 100105}, {"S_KNUM", 1}}));
  EXPECT_NEAR(bench.ovr(16), 1.25, 1e-7);
  EXPECT_NEAR(bench.ovr(30), 0.25, 1e-12);
  EXPECT_NEAR(bench.data("$P_UIFR", {1, "Z", "RT"}), 1.25, 1e-7);
  EXPECT_EQ(bench.ovi(7), 7);

  simulation::Truth ring = perfectWorld();
  place(ring, simulation::Ring(20.1, 80, -60), translation({0, 0, table}));
  SinumerikBench hole(ring);
  plantFrame(hole, "$P_UIFR", 1, {0, 0, table});
  hole.control.data.set("$TC_TP2", {7}, std::string("MILL"));
  hole.set("$TC_DP1", {7, 1}, 120);
  hole.set("$SCS_MEA_EMPIRIC_VALUE", {6}, 0.05);
  const struct {
    const char* cycle;
    NamedNumbers call;
    Vector3 start;
  } cases[] = {{"CYCLE977", {{"S_MVAR", 201}}, {0, 0, -10}},
               {"CYCLE979", {{"S_MVAR", 201}, {"S_INCA", 80}}, {8, 0, -10}}};
  for (const auto& [cycle, call, start] : cases) {
    hole.set("$TC_DP15", {7, 1}, 0);
    hole.start(start);
    hole.run(cycle, with(call, {{"S_KNUM1", 1}, {"S_SETV", 40}, {"S_FA", 6}, {"S_TSA", 2}, {"S_EVNUM", 7}}),
             {{"S_TNAME", "MILL"}});
    EXPECT_NEAR(hole.data("$TC_DP15", {7, 1}), (0.2 - 0.05) / 2, 1e-7) << cycle;
    EXPECT_NEAR(hole.ovr(4), 40.2, 1e-7) << "what was measured";
    EXPECT_NEAR(hole.ovr(16), 0.2 - 0.05, 1e-7) << cycle;
    EXPECT_NEAR(hole.ovr(30), 0.05, 1e-12);
    // It is taken off before anything is judged: 0.2 lies beyond the safe area, what is left of it within.
    hole.set("$TC_DP15", {7, 1}, 0);
    hole.start(start);
    hole.run(cycle, with(call, {{"S_KNUM1", 1}, {"S_SETV", 40}, {"S_FA", 6}, {"S_TSA", 0.18}, {"S_EVNUM", 7}}),
             {{"S_TNAME", "MILL"}});
    EXPECT_NEAR(hole.data("$TC_DP15", {7, 1}), (0.2 - 0.05) / 2, 1e-7) << cycle;
  }
}

/// S_KNUM1 that leaves the component open corrects the radius of a mill, also where lengths count as those of turning
/// tools: those name no axis of the measurement then.
TEST(CallParameters, AMillIsCorrectedByItsRadiusWhereItsLengthsCountAsOnLathes) {
  simulation::Truth ring = perfectWorld();
  place(ring, simulation::Ring(20.1, 80, -60), translation({0, 0, table}));
  SinumerikBench hole(ring);
  plantFrame(hole, "$P_UIFR", 1, {0, 0, table});
  hole.control.data.set("$TC_TP2", {7}, std::string("MILL"));
  hole.set("$TC_DP1", {7, 1}, 120);
  // The third length of a turning tool lies along Z in G17.
  hole.set("$SC_TOOL_LENGTH_TYPE", {}, 2);
  hole.set("$TC_DP5", {1, 1}, hole.data("$TC_DP3", {1, 1}));
  hole.set("$TC_DP3", {1, 1}, 0);
  hole.start({0, 0, -10});
  hole.run("CYCLE977", {{"S_MVAR", 201}, {"S_KNUM1", 1}, {"S_SETV", 40}, {"S_FA", 6}, {"S_TSA", 2}},
           {{"S_TNAME", "MILL"}});
  EXPECT_NEAR(hole.ovr(4), 40.2, 1e-7);
  EXPECT_NEAR(hole.data("$TC_DP15", {7, 1}), 0.1, 1e-7);
  for (const char* length : {"$TC_DP12", "$TC_DP13", "$TC_DP14"})
    EXPECT_EQ(hole.data(length, {7, 1}), 0) << length;
}

TEST(CallParameters, AmodeMakesLimitsATolerance) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Box({0.08, 0, -60}, {80, 80, 0}), translation({0, 0, table}));
  place(truth, simulation::Ring(20.04, 50, -60), translation({-150, 0, table}));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.control.data.set("$TC_TP2", {7}, std::string("MILL"));
  bench.set("$TC_DP1", {7, 1}, 120);
  const struct {
    const char* cycle;
    NamedNumbers call;
    Vector3 start;
    double set, factor;  ///< of the correction of the radius
  } cases[] = {
      {"CYCLE978", {{"S_MVAR", 200}, {"S_MA", 1}, {"S_MD", 1}}, {-12, 30, -10}, 0, 1},
      {"CYCLE977", {{"S_MVAR", 201}, {"S_SETV", 40}}, {-150, 0, -10}, 40, 0.5},
      {"CYCLE979", {{"S_MVAR", 201}, {"S_SETV", 40}, {"S_CPA", -150}, {"S_INCA", 90}}, {-142, 0, -10}, 40, 0.5},
  };
  for (const auto& [cycle, call, start, set, factor] : cases) {
    for (const bool tolerance : {false, true}) {
      SCOPED_TRACE(fmt::format("{} {}", cycle, tolerance));
      bench.set("$TC_DP15", {7, 1}, 0);
      bench.control.journal.events.clear();
      bench.start(start);
      bench.run(cycle,
                with(call, {{"S_KNUM1", 1},
                            {"S_FA", 6},
                            {"S_TSA", 2},
                            {"S_TUL", 0.06},
                            {"S_TLL", -0.02},
                            {"_AMODE", tolerance ? 1.0 : 0.0}}),
                {{"S_TNAME", "MILL"}});
      // The feature is 0.08 too large; its tolerance is 0.02 +-0.04.
      EXPECT_NEAR(bench.ovr(0), set + (tolerance ? 0.02 : 0), 1e-9);
      EXPECT_NEAR(bench.ovr(16), tolerance ? 0.06 : 0.08, 1e-7);
      EXPECT_NEAR(bench.ovr(8), tolerance ? 0.04 : 0, 1e-9);
      EXPECT_NEAR(bench.ovr(12), tolerance ? -0.04 : 0, 1e-9);
      EXPECT_EQ(bench.messages(), tolerance ? "61304 " : "");
      EXPECT_NEAR(bench.data("$TC_DP15", {7, 1}), factor * (tolerance ? 0.06 : 0.08), 1e-7);
    }
  }
}

}  // namespace
}  // namespace probewright
