#include "support/sinumerik_bench.hpp"

/// The digits of S_MVAR and _DMODE in all their combinations, on worlds that each must find.
namespace probewright {
namespace {

using namespace testing_support;

constexpr double table = -350;
constexpr const char* plus1 = "$SNS_MEA_WP_TRIG_PLUS_DIR_AX1";
constexpr const char* minus1 = "$SNS_MEA_WP_TRIG_MINUS_DIR_AX1";
constexpr const char* plus2 = "$SNS_MEA_WP_TRIG_PLUS_DIR_AX2";
constexpr const char* minus2 = "$SNS_MEA_WP_TRIG_MINUS_DIR_AX2";

enum Method { AsCalibrated, Reversed, Aligned };

/// A tip beside the spindle axis, and what the control must know of it for the method: nothing more.
void runOut(simulation::Truth& truth, Method method) {
  truth.tools[0].probe.tipOffset = {0.1, method == Aligned ? 0.0 : -0.05};
}
void believe(SinumerikBench& bench, Method method) {
  if (method == AsCalibrated) {
    bench.set(plus1, {0}, 2.1);
    bench.set(minus1, {0}, -1.9);
    bench.set(plus2, {0}, 1.95);
    bench.set(minus2, {0}, -2.05);
    bench.set("$SNS_MEA_WP_POS_DEV_AX1", {0}, 0.1);
    bench.set("$SNS_MEA_WP_POS_DEV_AX2", {0}, -0.05);
    return;
  }
  for (const char* trigger : {minus1, plus2, minus2})
    bench.set(trigger, {0}, trigger == plus2 ? 1 : -1);
  bench.set(plus1, {0}, method == Aligned ? 2.1 : 1);
}
/// Beside the middle a chord is shorter than the diameter: a reversed ball passes by on both sides.
double roundTolerance(Method method) { return method == Reversed ? 2e-3 : 1e-7; }

void placeFeature(simulation::Truth& truth, int units, const Pose& pose) {
  using simulation::Box;
  switch (units) {
    case 1:
      return place(truth, simulation::Ring(40, 120, -60), pose);
    case 2:
      return place(truth, simulation::RoundBar(20, -60, 0), pose);
    case 3:
    case 5:
      place(truth, Box({40, -150, -60}, {120, 150, 0}), pose);
      place(truth, Box({-120, -150, -60}, {-40, 150, 0}), pose);
      if (units == 3) return;
      place(truth, Box({-40, 35, -60}, {40, 150, 0}), pose);
      return place(truth, Box({-40, -150, -60}, {40, -35, 0}), pose);
    default:
      return place(truth, Box({-20, units == 4 ? -100.0 : -15, -60}, {20, units == 4 ? 100.0 : 15, 0}), pose);
  }
}

TEST(MeasuringVariants, Cycle977InEveryMethodWithAndWithoutProtectionZone) {
  Planter plant(9770);
  for (int units = 1; units <= 6; ++units) {
    for (const Method method : {AsCalibrated, Reversed, Aligned}) {
      for (const bool zone : {false, true}) {
        for (const double angle : {0.0, 25.0, -70.0}) {
          for (const int across : {1, 2}) {
            const bool oneAxis = units == 3 || units == 4;
            if (across == 2 && !oneAxis) continue;
            SCOPED_TRACE(fmt::format("{} method {} zone {} angle {} axis {}", units, static_cast<int>(method), zone,
                                     angle, across));
            const bool inside = units % 2 == 1, round = units <= 2;
            const Vector3 error(plant.number(-0.6, 0.6), oneAxis ? 0 : plant.number(-0.6, 0.6), 0);
            const Pose turned = rotation(Vector3::UnitZ(), angle + (across == 2 ? 90 : 0));
            const Pose pose = translation({0, 0, table}) * turned * translation(error);
            simulation::Truth truth = perfectWorld();
            runOut(truth, method);
            placeFeature(truth, units, pose);
            if (zone && inside) place(truth, simulation::RoundBar(8, -60, 5), translation({0, 0, table}), "island");
            if (zone && !inside) {
              const Pose around = translation({0, 0, table}) * turned;
              place(truth, simulation::Box({52, -100, -60}, {60, 100, 5}), around, "clamp");
              place(truth, simulation::Box({-100, 52, -60}, {100, 60, 5}), around, "clamp");
            }
            SinumerikBench bench(truth);
            believe(bench, method);
            plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
            const bool over = zone || !inside;
            bench.start({0, 0, over ? 15.0 : -10.0});
            const double size = inside ? 80 : 40;
            bench.run("CYCLE977", {{"S_MVAR", 10000.0 * static_cast<int>(method) + (zone ? 1000 : 0) + units},
                                   {"S_SETV", size},
                                   {"S_SETV0", size},
                                   {"S_SETV1", inside ? 70 : 30},
                                   {"S_FA", 8},
                                   {"S_TSA", 2},
                                   {"S_STA1", angle},
                                   {"S_ID", over ? -25 : 0},
                                   {"S_SZA", zone ? (inside ? 22.0 : 100.0) : 0},
                                   {"S_SZO", zone ? (inside ? 22.0 : 100.0) : 0},
                                   {"S_MA", across}});
            const double tolerance = round ? roundTolerance(method) : 1e-7;
            EXPECT_NEAR(bench.ovr(4), size, tolerance);
            const Vector3 centre = turned * error;
            const int first = units >= 5 ? 6 : 5;
            EXPECT_NEAR(bench.ovr(first), centre.x(), tolerance);
            EXPECT_NEAR(bench.ovr(first + 1), centre.y(), tolerance);
            if (units >= 5) {
              EXPECT_NEAR(bench.ovr(5), inside ? 70 : 30, tolerance);
            }
            EXPECT_NEAR(bench.machine.spindle().angle, 0, 1e-9) << "the spindle goes back";
          }
        }
      }
    }
  }
}

TEST(MeasuringVariants, Cycle979InEveryMethod) {
  Planter plant(9790);
  for (const bool inside : {true, false}) {
    for (const bool four : {true, false}) {
      for (const Method method : {AsCalibrated, Reversed, Aligned}) {
        for (const double step : {50.0, -75.0}) {
          SCOPED_TRACE(
              fmt::format("inside {} four {} method {} step {}", inside, four, static_cast<int>(method), step));
          const Vector3 error(plant.number(-0.6, 0.6), plant.number(-0.6, 0.6), 0);
          const double start = plant.number(-180, 180);
          simulation::Truth truth = perfectWorld();
          runOut(truth, method);
          placeFeature(truth, inside ? 1 : 2, translation(Vector3(0, 0, table) + error));
          SinumerikBench bench(truth);
          believe(bench, method);
          plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
          const double radius = inside ? 40 : 20;
          bench.start(Vector3(0, 0, -10) + probing::directionAt(start).vector() * (radius + (inside ? -10 : 10)));
          bench.run("CYCLE979", {{"S_MVAR", 10000.0 * static_cast<int>(method) + (four ? 1000 : 0) + (inside ? 1 : 2)},
                                 {"S_SETV", 2 * radius},
                                 {"S_FA", 6},
                                 {"S_TSA", 3},
                                 {"S_STA1", start},
                                 {"S_INCA", step}});
          // Three points over 100 degrees show an error of each point several times over.
          const double tolerance = method == AsCalibrated ? 1e-7 : method == Reversed ? 0.02 : 2e-3;
          EXPECT_NEAR(bench.ovr(4), 2 * radius, tolerance);
          EXPECT_NEAR(bench.ovr(5), error.x(), tolerance);
          EXPECT_NEAR(bench.ovr(6), error.y(), tolerance);
        }
      }
    }
  }
}

TEST(MeasuringVariants, Cycle998WithReversalZoneAndExpectedAngle) {
  Planter plant(9980);
  for (const bool reversed : {false, true}) {
    for (const bool zone : {false, true}) {
      for (const bool alongAxes : {false, true}) {
        for (const auto& [measuring, offset] : {std::pair(1, 2), std::pair(2, 1)}) {
          for (const int way : {1, 2}) {
            SCOPED_TRACE(fmt::format("reversed {} zone {} along axes {} axis {} way {}", reversed, zone, alongAxes,
                                     measuring, way));
            const double set = alongAxes ? 0 : plant.number(-4, 4), angle = set + plant.number(-1.5, 1.5);
            const double sign = way == 1 ? 1 : -1;
            // A face at the origin that looks against the touch.
            Vector3 low(-100, -100, -60), high(100, 100, 0);
            (sign > 0 ? low : high)[measuring - 1] = 0;
            simulation::Truth truth = perfectWorld();
            runOut(truth, reversed ? Reversed : AsCalibrated);
            place(truth, simulation::Box(low, high), translation({0, 0, table}) * rotation(Vector3::UnitZ(), angle));
            SinumerikBench bench(truth);
            believe(bench, reversed ? Reversed : AsCalibrated);
            plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
            Vector3 start(0, 0, -10);
            start[measuring - 1] = -sign * (zone ? 32 : 12);
            start[offset - 1] = -20;
            bench.start(start);
            bench.run("CYCLE998",
                      {{"S_MVAR", 5.0 + (zone ? 1000 : 0) + (reversed ? 10000 : 0) + (alongAxes ? 100000 : 0)},
                       {"S_SETV", zone ? 20 * sign : 0},
                       {"S_STA1", set},
                       {"S_FA", 8},
                       {"S_TSA", 10},
                       {"S_MA", 100.0 * offset + measuring},
                       {"S_MD", way},
                       {"S_ID", 45}});
            EXPECT_NEAR(bench.ovr(4), angle, 1e-6);
            EXPECT_NEAR(bench.ovr(0), set, 1e-12);
          }
        }
      }
    }
  }
}

TEST(MeasuringVariants, Cycle997InEveryCombination) {
  Planter plant(9970);
  for (int thousands = 0; thousands <= 2; ++thousands) {
    for (int others = 0; others < 8; ++others) {
      const bool repeat = (others & 1) != 0, four = (others & 2) != 0, diameter = (others & 4) != 0;
      SCOPED_TRACE(fmt::format("thousands {} repeat {} four {} diameter {}", thousands, repeat, four, diameter));
      const Vector3 error = plant.within(0.4);
      simulation::Truth truth = perfectWorld();
      const Method method = thousands == 2 ? Aligned : AsCalibrated;
      runOut(truth, method);
      place(truth, simulation::SolidSphere(error, 15), translation({0, 0, table}));
      SinumerikBench bench(truth);
      believe(bench, method);
      plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
      bench.start({0, 0, 25});
      bench.run("CYCLE997",
                {{"S_MVAR", 9.0 + (repeat ? 10 : 0) + 1000.0 * thousands + (four ? 1e5 : 0) + (diameter ? 1e6 : 0)},
                 {"S_SETV", 30},
                 {"S_FA", 6},
                 {"S_TSA", 2},
                 {"S_STA1", plant.number(-360, four ? 90 : 140)},
                 {"S_INCA", four ? 90.0 : 110.0}});
      // Without repetition the equator is the expected one.
      // A tip beside the axis meets the pole beside it, by 0.1 on radii that add up to 17.
      const double tolerance = (repeat ? 2e-5 : 0.02) + (method == Aligned ? 0.1 * 0.1 / (2 * 17) : 0);
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(bench.ovr(5 + axis), error[axis], tolerance);
      EXPECT_NEAR(bench.ovr(4), 30, diameter ? tolerance : 0);
    }
  }
}

TEST(MeasuringVariants, Cycle961InEveryPosition) {
  // Units, tens, thousands and 10^4: a corner of a block seen from any side, with points by distances and coordinates.
  Planter plant(9610);
  for (const int units : {6, 8}) {
    for (const bool zone : {false, true}) {
      for (int position = 0; position <= 4; ++position) {
        SCOPED_TRACE(fmt::format("units {} zone {} position {}", units, zone, position));
        // The free quadrants: the block lies towards plus or minus of each axis.
        const double x = position == 2 || position == 3 ? -1 : 1, y = position >= 3 ? -1 : 1;
        const double angle = plant.number(-2, 2);
        const Pose part =
            translation({plant.number(-1, 1), plant.number(-1, 1), table}) * rotation(Vector3::UnitZ(), angle);
        simulation::Truth truth = perfectWorld();
        place(truth,
              simulation::Box({std::min(0.0, 100 * x), std::min(0.0, 100 * y), -60},
                              {std::max(0.0, 100 * x), std::max(0.0, 100 * y), 0}),
              part);
        SinumerikBench bench(truth);
        plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
        const Vector3 pole(-15 * x, -15 * y, zone ? 10 : -10);
        bench.start(pole);
        bench.run("CYCLE961", {{"S_MVAR", 10000.0 * position + (zone ? 1000 : 0) + 100 + units},
                               {"S_KNUM", 1},
                               {"S_SETV0", 30 * x},
                               {"S_SETV1", 80 * x},
                               {"S_SETV2", 30 * y},
                               {"S_SETV3", 80 * y},
                               {"S_SETV4", pole.x()},
                               {"S_SETV5", pole.y()},
                               {"S_STA1", 0},
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

TEST(MeasuringVariants, Cycle976WithoutPositionDeviation) {
  for (const int units : {1, 2, 3, 4}) {
    SCOPED_TRACE(units);
    simulation::Truth truth = perfectWorld();
    runOut(truth, AsCalibrated);
    if (units == 3) {
      place(truth, simulation::SolidSphere(Vector3::Zero(), 15), translation({0, 0, table}));
    } else if (units == 4) {
      placeFeature(truth, 5, translation({0, 0, table}));
    } else {
      place(truth, simulation::Ring(20, 60, -40), translation({0, 0, table}));
    }
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    bench.start({0, 0, units == 3 ? 21.0 : -10.0});
    const double size = units == 3 ? 30 : units == 4 ? 80 : 40;
    bench.run("CYCLE976", {{"S_MVAR", 10000.0 + units + (units == 4 ? 2000 : 0)},
                           {"S_SETV", size},
                           {"S_FA", 5},
                           {"S_TSA", 3},
                           {"S_MA", 1}});
    EXPECT_NEAR(bench.data("$SNS_MEA_WP_BALL_DIAM", {0}), 4, 1e-3);
    EXPECT_NEAR(bench.data(plus1, {0}), 2, 1e-3);
    EXPECT_NEAR(bench.data(minus1, {0}), -2, 1e-3);
    EXPECT_EQ(bench.data("$SNS_MEA_WP_POS_DEV_AX1", {0}), 0) << "the ball counts as standing on the axis";
    EXPECT_EQ(bench.data("$SNS_MEA_WP_STATUS_GEN", {0}) >= 1, true);
  }
}

TEST(MeasuringVariants, Cycle976OnSurfacesInEveryDirection) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const int way : {0, 1}) {
      if (axis == 2 && way == 0) continue;
      SCOPED_TRACE(fmt::format("axis {} way {}", axis, way));
      simulation::Truth truth = perfectWorld();
      runOut(truth, AsCalibrated);
      place(truth, simulation::Box({0, 0, -60}, {60, 60, 0}), translation({0, 0, table}));
      SinumerikBench bench(truth);
      plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
      Vector3 start(30, 30, -10);
      start[axis] = axis == 2 ? 12 : way == 0 ? -12 : 72;
      bench.start(start);
      bench.run("CYCLE976", {{"S_MVAR", 1000},
                             {"S_SETV", axis == 2 || way == 0 ? 0 : 60},
                             {"S_MA", axis + 1.0},
                             {"S_MD", way},
                             {"S_FA", 6},
                             {"S_TSA", 3}});
      const double deviation = axis == 0 ? 0.1 : -0.05, radius = axis == 2 ? 0 : 2;
      const std::string name = fmt::format("$SNS_MEA_WP_TRIG_{}_DIR_AX{}", way == 0 ? "PLUS" : "MINUS", axis + 1);
      EXPECT_NEAR(bench.data(name.c_str(), {0}), axis == 2 ? 0 : deviation + (way == 0 ? radius : -radius), 1e-9);
    }
  }
}

TEST(MeasuringVariants, DmodeSelectsThePlaneOfTheCall) {
  // The probe stands in Z of the machine whatever the plane: length 3 acts there in G18, length 2 in G19.
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Box({0, 0, -60}, {100, 100, 0}), translation({0.1, 0.2, table + 0.3}));
  const struct {
    const char* plane;
    const char* length;
    const char* other;
    int dmode;
    int axes[3];  ///< X, Y, Z of the machine as axes of the plane
  } cases[] = {{"G17", "$TC_DP3", "G18", 1, {1, 2, 3}},
               {"G18", "$TC_DP5", "G19", 2, {2, 3, 1}},
               {"G19", "$TC_DP4", "G17", 3, {3, 1, 2}}};
  for (const auto& [plane, length, other, dmode, axes] : cases) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool byCall : {false, true}) {
        SCOPED_TRACE(fmt::format("{} axis {} by call {}", plane, axis, byCall));
        SinumerikBench bench(truth);
        plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
        bench.set("$TC_DP3", {1, 1}, 0);
        bench.set(length, {1, 1}, 98);
        // The length ends at the centre of the ball, so that all six directions are alike.
        bench.set("$MNS_MEA_FUNCTION_MASK", {}, 9);
        for (const char* number : {"1", "2", "3"}) {
          bench.set((std::string("$SNS_MEA_WP_TRIG_PLUS_DIR_AX") + number).c_str(), {0}, 2);
          bench.set((std::string("$SNS_MEA_WP_TRIG_MINUS_DIR_AX") + number).c_str(), {0}, -2);
        }
        bench.plane = plane;
        Vector3 start(30, 30, -10);
        start[axis] = axis == 2 ? 12 : -12;
        bench.start(start);
        const double code = axes[axis];
        bench.run("CYCLE978",
                  {{"S_FA", 6},
                   {"S_TSA", 3},
                   {"S_MA", code},
                   {"S_MD", axis == 2 ? 2.0 : 1.0},
                   {"_DMODE", byCall ? static_cast<double>(dmode) : 0.0}},
                  {}, byCall ? std::string(other) + "\n" : "");
        EXPECT_NEAR(bench.ovr(4), 0.1 * (axis + 1), 1e-9);
        EXPECT_NEAR(bench.ovr(4 + axes[axis]), 0.1 * (axis + 1), 1e-9);
        EXPECT_EQ(bench.control.plane, std::stoi(std::string(byCall ? other : plane).substr(1)));
      }
    }
  }
}

}  // namespace
}  // namespace probewright
