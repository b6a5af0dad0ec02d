#include "support/sinumerik_bench.hpp"

namespace probewright {
namespace {

using namespace testing_support;

constexpr double table = -350;

/// Four walls about a rectangular opening, lengths in X and Y, down from z = 0.
void placePocket(simulation::Truth& truth, double x, double y, const Pose& pose) {
  place(truth, simulation::Box({x / 2, -200, -60}, {200, 200, 0}), pose, "plus X");
  place(truth, simulation::Box({-200, -200, -60}, {-x / 2, 200, 0}), pose, "minus X");
  place(truth, simulation::Box({-200, y / 2, -60}, {200, 200, 0}), pose, "plus Y");
  place(truth, simulation::Box({-200, -200, -60}, {200, -y / 2, 0}), pose, "minus Y");
}

TEST(Cycle977, FindsTheCentreOfAHoleAndItsDiameter) {
  Planter plant(977);
  for (int world = 0; world < 40; ++world) {
    const double radius = plant.number(15, 40);
    const Vector3 origin = Vector3(plant.number(-50, 50), plant.number(-50, 50), table);
    Vector3 error = plant.within(2);
    error.z() = 0;
    simulation::Truth truth = perfectWorld();
    place(truth, simulation::Ring(radius, 300, -60), translation(origin + error));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, origin, {0, 0, plant.number(-180, 180)});
    bench.start({0, 0, -10});
    bench.run("CYCLE977", {{"S_MVAR", 101},
                           {"S_KNUM", 1},
                           {"S_SETV", 2 * radius - 0.5},
                           {"S_FA", 5},
                           {"S_TSA", 4},
                           {"S_STA1", plant.number(-90, 90)}});
    EXPECT_NEAR(bench.ovr(4), 2 * radius, 1e-9);
    EXPECT_NEAR(bench.ovr(16), 0.5, 1e-9);
    const Vector3 found = inWorkpiece(bench, origin + error);
    EXPECT_NEAR(found.head<2>().norm(), 0, 1e-9) << "the workpiece zero lies in the centre now";
    EXPECT_EQ(bench.ovi(11), 1);
    EXPECT_EQ(bench.ovi(3), 101);
  }
}

TEST(Cycle977, TheStartPositionIsTheSetCentre) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Ring(20, 300, -60), translation({30.5, 20.25, table}));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.start({30, 20, -10});
  bench.run("CYCLE977", {{"S_MVAR", 101}, {"S_KNUM", 10001}, {"S_SETV", 40}, {"S_FA", 5}, {"S_TSA", 1}});
  EXPECT_NEAR(bench.ovr(1), 30, 1e-9);
  EXPECT_NEAR(bench.ovr(2), 20, 1e-9);
  EXPECT_NEAR(bench.ovr(5), 30.5, 1e-9);
  EXPECT_NEAR(bench.ovr(6), 20.25, 1e-9);
  EXPECT_NEAR(bench.data("$P_UIFR", {1, "X", "TR"}), 0.5, 1e-9);
  EXPECT_NEAR(bench.data("$P_UIFR", {1, "Y", "TR"}), 0.25, 1e-9);
  EXPECT_NEAR((bench.control.channel.position() - ProgramPlace(30, 20, -10)).norm(), 0, 1e-9)
      << "the probe is in the centre";
}

/// The form of versions newer than 4.4: the tens of _AMODE, and two more arguments.
TEST(Cycle977, PutsTheCentreWhereTheCallSays) {
  Planter plant(9773);
  for (int world = 0; world < 40; ++world) {
    const int feature = 1 + world % 4, axis = 1 + world / 4 % 2;
    const bool oneAxis = feature > 2;
    const double size = plant.number(20, 40), angle = plant.number(-180, 180);
    const Vector2 set(plant.number(-40, 40), plant.number(-40, 40)), error(plant.number(-1, 1), plant.number(-1, 1));
    // The frame believes the centre at `set`; in truth it lies `error` beside it.
    const Pose believed = translation(Vector3(0, 0, table)) * rotation(Vector3::UnitZ(), angle);
    const Pose part = believed * translation(Vector3(set.x() + error.x(), set.y() + error.y(), 0));
    simulation::Truth truth = perfectWorld();
    const Vector3 half = axis == 1 ? Vector3(size / 2, 60, 0) : Vector3(60, size / 2, 0);
    if (feature == 1) place(truth, simulation::Ring(size / 2, 60, -60), part);
    if (feature == 2) place(truth, simulation::RoundBar(size / 2, -60, 0), part);
    if (feature == 3) {
      const Vector3 across = axis == 1 ? Vector3::UnitX() : Vector3::UnitY();
      place(truth, simulation::Box(Vector3(-20, -20, -60), Vector3(20, 20, 0)),
            part * translation(across * (size / 2 + 20)), "plus");
      place(truth, simulation::Box(Vector3(-20, -20, -60), Vector3(20, 20, 0)),
            part * translation(-across * (size / 2 + 20)), "minus");
    }
    if (feature == 4) place(truth, simulation::Box(-half - Vector3(0, 0, 60), half), part);
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table}, {0, 0, angle});
    const Vector2 off(plant.number(-0.4, 0.4), plant.number(-0.4, 0.4));
    bench.start({set.x() + off.x(), set.y() + off.y(), feature % 2 == 1 ? -10.0 : 10.0});
    const double first = oneAxis ? set[axis - 1] : set.x();
    bench.run("CYCLE977", {{"S_MVAR", 100.0 + feature},
                           {"S_KNUM", 10001},
                           {"S_SETV", size},
                           {"S_FA", 5},
                           {"S_TSA", 3},
                           {"S_ID", -20},
                           {"S_MA", static_cast<double>(axis)},
                           {"_AMODE", world % 2 == 0 ? 10 : 11},
                           {"S_POS1", first},
                           {"S_POS2", oneAxis ? 0 : set.y()}});
    EXPECT_NEAR(bench.ovr(4), size, 1e-9) << world;
    const Vector3 found = inWorkpiece(bench, part.translation());
    EXPECT_NEAR(!oneAxis || axis == 1 ? found.x() - set.x() : 0, 0, 1e-9) << world;
    EXPECT_NEAR(!oneAxis || axis == 2 ? found.y() - set.y() : 0, 0, 1e-9) << world;
    EXPECT_NEAR(bench.ovr(oneAxis ? axis : 1), first, 1e-9);
    EXPECT_NEAR(bench.ovr(oneAxis ? 16 + axis : 17), oneAxis ? error[axis - 1] : error.x(), 1e-9);
  }
}

TEST(Cycle977, MeasuresSpigotsOverTheTop) {
  Planter plant(9772);
  for (int world = 0; world < 20; ++world) {
    const double radius = plant.number(10, 30);
    const Vector3 error = {plant.number(-1, 1), plant.number(-1, 1), 0};
    simulation::Truth truth = perfectWorld();
    place(truth, simulation::RoundBar(radius, -60, 0), translation(Vector3(0, 0, table) + error));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    bench.start({0, 0, 10});
    bench.run("CYCLE977", {{"S_MVAR", 102},
                           {"S_KNUM", 1},
                           {"S_SETV", 2 * radius + 0.3},
                           {"S_FA", 4},
                           {"S_TSA", 2},
                           {"S_STA1", plant.number(0, 90)},
                           {"S_ID", -20}});
    EXPECT_NEAR(bench.ovr(4), 2 * radius, 1e-9);
    EXPECT_NEAR(inWorkpiece(bench, Vector3(0, 0, table) + error).head<2>().norm(), 0, 1e-9);
    EXPECT_NEAR(bench.control.channel.position().z(), 10, 1e-9);
  }
}

TEST(Cycle977, MeasuresRectanglesUnderAnAngle) {
  Planter plant(9775);
  for (int world = 0; world < 20; ++world) {
    const double x = plant.number(30, 60), y = plant.number(30, 60), angle = plant.number(-44, 44);
    const Vector3 error = {plant.number(-1, 1), plant.number(-1, 1), 0};
    const Pose pose = translation(Vector3(0, 0, table) + error) * rotation(Vector3::UnitZ(), angle);
    const bool inside = world % 2 == 0;
    simulation::Truth truth = perfectWorld();
    if (inside) {
      placePocket(truth, x, y, pose);
    } else {
      place(truth, simulation::Box({-x / 2, -y / 2, -60}, {x / 2, y / 2, 0}), pose);
    }
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    bench.start({0, 0, inside ? -10.0 : 10.0});
    bench.run("CYCLE977", {{"S_MVAR", inside ? 105.0 : 106.0},
                           {"S_KNUM", 1},
                           {"S_SETV0", x},
                           {"S_SETV1", y},
                           {"S_FA", 4},
                           {"S_TSA", 2},
                           {"S_STA1", angle},
                           {"S_ID", inside ? 0.0 : -20.0}});
    EXPECT_NEAR(bench.ovr(4), x, 1e-9);
    EXPECT_NEAR(bench.ovr(5), y, 1e-9);
    EXPECT_NEAR(bench.ovr(6), error.x(), 1e-9);
    EXPECT_NEAR(bench.ovr(7), error.y(), 1e-9);
    EXPECT_NEAR(inWorkpiece(bench, pose * Vector3::Zero()).head<2>().norm(), 0, 1e-9);
  }
}

TEST(Cycle977, MeasuresGroovesAndRibsAcrossThemselves) {
  Planter plant(9773);
  for (int world = 0; world < 24; ++world) {
    const bool inside = world % 2 == 0;
    const bool acrossX = world % 4 < 2;
    const double width = plant.number(20, 40), angle = plant.number(-30, 30), error = plant.number(-1, 1);
    // A groove or rib along Y of its own frame, displaced across itself.
    const Pose along = rotation(Vector3::UnitZ(), angle + (acrossX ? 0 : 90));
    const Pose pose = translation({0, 0, table}) * along * translation({error, 0, 0});
    simulation::Truth truth = perfectWorld();
    if (inside) {
      place(truth, simulation::Box({width / 2, -200, -60}, {200, 200, 0}), pose);
      place(truth, simulation::Box({-200, -200, -60}, {-width / 2, 200, 0}), pose);
    } else {
      place(truth, simulation::Box({-width / 2, -100, -60}, {width / 2, 100, 0}), pose);
    }
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    bench.start({0, 0, inside ? -10.0 : 10.0});
    bench.run("CYCLE977", {{"S_MVAR", inside ? 103.0 : 104.0},
                           {"S_KNUM", 1},
                           {"S_SETV", width - 0.2},
                           {"S_FA", 4},
                           {"S_TSA", 2},
                           {"S_STA1", angle},
                           {"S_ID", inside ? 0.0 : -20.0},
                           {"S_MA", acrossX ? 1.0 : 2.0}});
    EXPECT_NEAR(bench.ovr(4), width, 1e-9);
    const Vector3 middle = along * Vector3(error, 0, 0);
    EXPECT_NEAR(bench.ovr(5), middle.x(), 1e-9);
    EXPECT_NEAR(bench.ovr(6), middle.y(), 1e-9);
    EXPECT_NEAR(inWorkpiece(bench, pose * Vector3::Zero()).norm(), 0, 1e-9);
  }
}

TEST(Cycle977, AGrooveMeasuredAtAWrongAngleIsTooWide) {
  // 3 degrees off: the way between the contact points of the ball, plus its diameter, is (w - d)/cos + d.
  const double width = 30, diameter = 4, wrong = 3;
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Box({width / 2, -200, -60}, {200, 200, 0}), translation({0, 0, table}));
  place(truth, simulation::Box({-200, -200, -60}, {-width / 2, 200, 0}), translation({0, 0, table}));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.start({0, 0, -10});
  bench.run("CYCLE977", {{"S_MVAR", 3}, {"S_SETV", width}, {"S_FA", 4}, {"S_TSA", 2}, {"S_STA1", wrong}, {"S_MA", 1}});
  EXPECT_NEAR(bench.ovr(4), (width - diameter) / std::cos(radiansFromDegrees(wrong)) + diameter, 1e-9);
}

TEST(Cycle977, GoesRoundAnIslandInTheHole) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Ring(40, 300, -60), translation({0.5, -0.25, table}));
  place(truth, simulation::RoundBar(20, -60, 5), translation({0, 0, table}), "island");
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.start({0, 0, 15});
  bench.run("CYCLE977", {{"S_MVAR", 1001}, {"S_SETV", 80}, {"S_FA", 50}, {"S_TSA", 1}, {"S_ID", -25}, {"S_SZA", 43}});
  EXPECT_NEAR(bench.ovr(4), 80, 1e-9);
  EXPECT_NEAR(bench.ovr(5), 0.5, 1e-9);
  EXPECT_NEAR(bench.ovr(6), -0.25, 1e-9);
  EXPECT_NEAR(bench.control.channel.position().z(), 15, 1e-9);
  bench.start({0, 0, 15});
  EXPECT_EQ(bench.alarmOf("CYCLE977",
                          {{"S_MVAR", 1001}, {"S_SETV", 80}, {"S_FA", 50}, {"S_TSA", 1}, {"S_ID", -25}, {"S_SZA", 75}}),
            "61334");
}

TEST(Cycle977, CorrectsTheToolThatMadeTheHole) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Ring(20.03, 300, -60), translation({0, 0, table}));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.control.data.set("$TC_TP2", {7}, std::string("BORER"));
  bench.set("$TC_DP1", {7, 2}, 120);
  bench.set("$TC_DP6", {7, 2}, 8);
  bench.set("$TC_SCP16", {7, 2}, 0.002);
  bench.set("$TC_ECP16", {7, 2}, 0.01);
  const auto measure = [&](const NamedNumbers& values) {
    bench.start({0, 0, -10});
    bench.run("CYCLE977", with({{"S_MVAR", 201}, {"S_SETV", 40}, {"S_FA", 5}, {"S_TSA", 1}, {"S_DLNUM", 1}}, values),
              {{"S_TNAME", "BORER"}});
  };
  measure({{"S_KNUM1", 2}});
  EXPECT_NEAR(bench.data("$TC_DP15", {7, 2}), 0.03, 1e-9) << "the hole is 0.06 too large: the radius by 0.03";
  measure({{"S_KNUM1", 10000002}});
  EXPECT_NEAR(bench.data("$TC_DP15", {7, 2}), 0, 1e-9) << "inverted";
  measure({{"S_KNUM1", 4000002}});
  EXPECT_NEAR(bench.data("$TC_DP6", {7, 2}), 8.03, 1e-9) << "geometry";
  measure({{"S_KNUM1", 1000002}});
  EXPECT_NEAR(bench.data("$TC_SCP16", {7, 2}), 0.032, 1e-9) << "additive offset";
  measure({{"S_KNUM1", 3000002}});
  EXPECT_NEAR(bench.data("$TC_ECP16", {7, 2}), 0.04, 1e-9) << "setup offset";
  measure({{"S_KNUM1", 2000002}});
  EXPECT_NEAR(bench.data("$TC_ECP16", {7, 2}), 0.04 + 0.032 + 0.03, 1e-9) << "setup takes the additive offset over";
  EXPECT_EQ(bench.data("$TC_SCP16", {7, 2}), 0);
  // Tolerance 40 +0.04 +0.01: the middle is 40.025, the hole 0.035 above it, 0.015 allowed.
  measure({{"S_KNUM1", 2}, {"S_TUL", 0.04}, {"S_TLL", 0.01}, {"_AMODE", 1}});
  EXPECT_NEAR(bench.ovr(0), 40.025, 1e-9);
  EXPECT_NEAR(bench.ovr(8), 0.015, 1e-9);
  EXPECT_NEAR(bench.ovr(12), -0.015, 1e-9);
  EXPECT_NEAR(bench.data("$TC_DP15", {7, 2}), 0.0175, 1e-9);
  EXPECT_EQ(bench.messages(), "61304 ");
  EXPECT_EQ(bench.control.journal.cycles.back().verdict, control::Verdict::Scrap) << "too large a hole is lost";
  EXPECT_EQ(bench.ovi(9), 61304);
  // Within the zero offset range nothing is corrected; beyond the dimensional difference neither.
  measure({{"S_KNUM1", 2}, {"S_TZL", 0.07}});
  measure({{"S_KNUM1", 2}, {"S_TDIF", 0.05}});
  EXPECT_NEAR(bench.data("$TC_DP15", {7, 2}), 0.0175, 1e-9);
  EXPECT_EQ(bench.messages(), "61304 61306 ");
  // The mean of 0.06 with weight 3 from 0 is 0.02, then 0.0333: beyond 0.03, corrected and cleared.
  const NamedNumbers averaging = {{"S_KNUM1", 2}, {"S_TZL", 0.03}, {"S_TMV", 0.1}, {"S_K", 3}, {"S_EVNUM", 50000}};
  measure(averaging);
  EXPECT_NEAR(bench.data("$SCS_MEA_AVERAGE_VALUE", {4}), 0.02, 1e-9);
  EXPECT_NEAR(bench.data("$TC_DP15", {7, 2}), 0.0175, 1e-9);
  measure(averaging);
  EXPECT_EQ(bench.data("$SCS_MEA_AVERAGE_VALUE", {4}), 0);
  EXPECT_NEAR(bench.ovr(31), 0.1 / 3, 1e-9) << "the mean that has just corrected";
  EXPECT_NEAR(bench.data("$TC_DP15", {7, 2}), 0.0175 + 0.1 / 3 / 2, 1e-9);
}

TEST(Cycle977, RefusesWithTheControlsAlarms) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Ring(20, 300, -60), translation({1.5, 0, table}));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.start({0, 0, -10});
  const auto code = [&](const NamedNumbers& values) { return bench.alarmOf("CYCLE977", values); };
  EXPECT_EQ(code({{"S_MVAR", 7}, {"S_SETV", 40}, {"S_FA", 5}, {"S_TSA", 1}}), "61307");
  EXPECT_EQ(code({{"S_MVAR", 2001}, {"S_SETV", 40}, {"S_FA", 5}, {"S_TSA", 1}}), "61307");
  EXPECT_EQ(code({{"S_MVAR", 3}, {"S_SETV", 40}, {"S_FA", 5}, {"S_TSA", 1}, {"S_MA", 3}}), "61325");
  EXPECT_EQ(code({{"S_MVAR", 1}, {"S_FA", 5}, {"S_TSA", 1}}), "61319");
  EXPECT_EQ(code({{"S_MVAR", 1}, {"S_SETV", 38}, {"S_FA", 5}, {"S_TSA", 1}}), "61303");
  bench.start({0, 0, -10});
  EXPECT_EQ(code({{"S_MVAR", 101}, {"S_KNUM", 1}, {"S_SETV", 40}, {"S_FA", 5}, {"S_TSA", 1}}), "61303")
      << "the centre lies too far away";
  EXPECT_EQ(code({{"S_MVAR", 1}, {"S_SETV", 40}, {"S_FA", 5}, {"S_TSA", 1}}), "") << "but a size can be measured";
  bench.start({0, 0, 10});
  EXPECT_EQ(code({{"S_MVAR", 2}, {"S_SETV", 10}, {"S_FA", 5}, {"S_TSA", 1}, {"S_ID", -60}}), "61301");
  bench.start({0, 0, 10});
  EXPECT_EQ(code({{"S_MVAR", 2}, {"S_SETV", 60}, {"S_FA", 5}, {"S_TSA", 1}, {"S_ID", -20}}), "61302")
      << "the probe goes down onto the plate";
}

}  // namespace
}  // namespace probewright
