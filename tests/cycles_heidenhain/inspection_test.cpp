#include "cycles_heidenhain/findings.hpp"

/// Cycles 421 to 427: measured values, deviations, verdicts, tools and logs.
namespace probewright::testing_support {
namespace {

constexpr int worlds = 100;
constexpr double exact = 1e-6;

struct CircleFeature {
  int cycle;
  bool inside;
  int maximum, minimum;  ///< the parameters with the limits
};

/// Cycles 421 and 422 in any unit.
void expectCircle(const CircleFeature& feature) {
  Dice dice(static_cast<unsigned>(feature.cycle));
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 0.5, 180);
    const double ball = part.bench.believedProbe().radius;
    const double diameter = dice.between(2 * ball + 6, 90);
    if (feature.inside) {
      part.bench.part(simulation::Ring(diameter / 2, diameter / 2 + 40, -40), part.machineFromPart);
    } else {
      part.bench.part(simulation::RoundBar(diameter / 2, -40, 0), part.machineFromPart);
    }
    part.bench.knows(5, "MILL", 50, 8);
    const double nominal = written(diameter + dice.between(-0.3, 0.3));
    const Vector3 truth = part.truth();
    const Limits limits = limitsAround(dice, diameter);
    const double tolerance1 = toleranceAround(dice, truth.x() - part.nominal.x());
    const double tolerance2 = toleranceAround(dice, truth.y() - part.nominal.y());
    const bool correct = dice.coin();
    // In an inch program the same numbers mean inches: everything is written divided by 25.4.
    const bool inch = dice.whole(0, 3) == 0;
    const double unit = inch ? 25.4 : 1;
    const double bottom = part.nominal.z() - 8;
    Words words = {{273, part.nominal.x() / unit},
                   {274, part.nominal.y() / unit},
                   {262, nominal / unit},
                   {325, written(dice.between(-360, 360))},
                   {247, written(dice.between(20, 120))},
                   {261, bottom / unit},
                   {320, 0},
                   {260, (part.nominal.z() + 20) / unit},
                   {301, dice.whole(0, 1)},
                   {feature.maximum, limits.maximum / unit},
                   {feature.minimum, limits.minimum / unit},
                   {279, tolerance1 / unit},
                   {280, tolerance2 / unit},
                   {281, 1},
                   {309, 0},
                   {330, correct ? 5 : 0}};
    if (part.bench.control == ControlKind::TNC640)
      words = with(words, {{423, dice.whole(3, 4)}, {365, dice.whole(0, 1)}});
    const Ran ran = part.bench.run(probe(feature.cycle, words), inch ? "INCH" : "MM");
    ASSERT_TRUE(ran.finished()) << ran.why();
    // Numbers of the program have six decimals here.
    const double near = inch ? 3e-5 : exact;
    EXPECT_NEAR(ran.q(151) * unit, truth.x(), exact);
    EXPECT_NEAR(ran.q(152) * unit, truth.y(), exact);
    EXPECT_NEAR(ran.q(153) * unit, diameter, exact);
    EXPECT_NEAR(ran.q(161) * unit, truth.x() - part.nominal.x(), near);
    EXPECT_NEAR(ran.q(162) * unit, truth.y() - part.nominal.y(), near);
    EXPECT_NEAR(ran.q(163) * unit, diameter - nominal, near);
    const Finding finding = std::max({dimension(diameter, limits.maximum, limits.minimum, feature.inside),
                                      position(truth.x() - part.nominal.x(), tolerance1),
                                      position(truth.y() - part.nominal.y(), tolerance2)});
    expectStatus(ran, finding);
    // A hole that is too small was made by a tool that is smaller than believed, a stud by one that is larger.
    const double left = (feature.inside ? nominal - diameter : diameter - nominal) / 2;
    EXPECT_NEAR(ran.cell("TOOL.T", "5", "DR"), correct ? -left : 0, 6e-5);

    const auto log = readLog(ran.log(fmt::format("TCHPR{}.TXT", feature.cycle)));
    const double shown = inch ? 0.6e-5 * 25.4 + near : 0.6e-4;
    const auto value = [&](const std::string& key) {
      const auto found = log.find(key);
      return found == log.end() ? std::nan("") : found->second * unit;
    };
    EXPECT_NEAR(value("Nominal values:Center in reference axis"), part.nominal.x(), shown);
    EXPECT_NEAR(value("Nominal values:Diameter"), nominal, shown);
    EXPECT_NEAR(value("Actual values:Center in minor axis"), truth.y(), shown);
    EXPECT_NEAR(value("Actual values:Diameter"), diameter, shown);
    EXPECT_NEAR(value("Deviations:Diameter"), diameter - nominal, shown);
    EXPECT_NEAR(value("Deviations:Center in reference axis"), truth.x() - part.nominal.x(), shown);
    EXPECT_NEAR(value("Further measuring results:Measuring height"), bottom, shown);
    const std::string what = feature.inside ? "hole" : "stud";
    if (limits.maximum != 0) {
      EXPECT_NEAR(value("Given limit values:Maximum dimension for " + what), limits.maximum, shown);
      EXPECT_NEAR(value("Given limit values:Minimum dimension for " + what), limits.minimum, shown);
    } else {
      EXPECT_FALSE(log.contains("Given limit values:Maximum dimension for " + what));
    }
    if (tolerance1 != 0) {
      EXPECT_NEAR(value("Given limit values:Maximum limit for center in reference axis"), part.nominal.x() + tolerance1,
                  2 * shown);
    }
  }
}

TEST(Cycle421, MeasuresAnyHole) { expectCircle({421, true, 275, 276}); }
TEST(Cycle422, MeasuresAnyStud) { expectCircle({422, false, 277, 278}); }

void expectRectangle(int cycle, bool inside) {
  Dice dice(static_cast<unsigned>(cycle));
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 0.5, 2);
    const double ball = part.bench.believedProbe().radius;
    const Vector2 length(dice.between(2 * ball + 8, 80), dice.between(2 * ball + 8, 80));
    if (inside) {
      layPocket(part, length);
    } else {
      part.bench.part(simulation::Box({-length.x() / 2, -length.y() / 2, -40}, {length.x() / 2, length.y() / 2, 0}),
                      part.machineFromPart);
    }
    part.bench.knows(5, "MILL", 50, 8);
    const FoundRectangle found =
        foundRectangle(part.truth().head<2>(), length, part.skew, ball, part.nominal.head<2>(), inside ? -1 : 1);
    const Vector2 nominal(written(length.x() + dice.between(-0.3, 0.3)), written(length.y() + dice.between(-0.3, 0.3)));
    const Limits limits1 = limitsAround(dice, found.length.x());
    const Limits limits2 = limitsAround(dice, found.length.y());
    const Vector2 off = found.centre - part.nominal.head<2>();
    const double tolerance1 = toleranceAround(dice, off.x());
    const double tolerance2 = toleranceAround(dice, off.y());
    const Words words = {{273, part.nominal.x()},
                         {274, part.nominal.y()},
                         {282, nominal.x()},
                         {283, nominal.y()},
                         {261, part.nominal.z() - 8},
                         {320, 1},
                         {260, part.nominal.z() + 20},
                         {301, dice.whole(0, 1)},
                         {284, limits1.maximum},
                         {285, limits1.minimum},
                         {286, limits2.maximum},
                         {287, limits2.minimum},
                         {279, tolerance1},
                         {280, tolerance2},
                         {281, 1},
                         {309, 0},
                         {330, 5}};
    const Ran ran = part.bench.run(probe(cycle, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(151), found.centre.x(), exact);
    EXPECT_NEAR(ran.q(152), found.centre.y(), exact);
    EXPECT_NEAR(ran.q(154), found.length.x(), exact);
    EXPECT_NEAR(ran.q(155), found.length.y(), exact);
    EXPECT_NEAR(ran.q(161), off.x(), exact);
    EXPECT_NEAR(ran.q(162), off.y(), exact);
    EXPECT_NEAR(ran.q(164), found.length.x() - nominal.x(), exact);
    EXPECT_NEAR(ran.q(165), found.length.y() - nominal.y(), exact);
    expectStatus(ran, std::max({dimension(found.length.x(), limits1.maximum, limits1.minimum, inside),
                                dimension(found.length.y(), limits2.maximum, limits2.minimum, inside),
                                position(off.x(), tolerance1), position(off.y(), tolerance2)}));
    // Only the first side corrects the tool.
    const double left = (inside ? -1 : 1) * (found.length.x() - nominal.x()) / 2;
    EXPECT_NEAR(ran.cell("TOOL.T", "5", "DR"), -left, 6e-5);
    const auto log = readLog(ran.log(fmt::format("TCHPR{}.TXT", cycle)));
    const bool capitals = cycle == 423 && part.bench.control == ControlKind::iTNC530;
    EXPECT_NEAR(
        log.at(capitals ? "ACTUAL VALUES:SIDE LENGTH IN REF. AXIS" : "Actual values:Side length in reference axis"),
        found.length.x(), 0.6e-4);
    EXPECT_NEAR(log.at(capitals ? "DEVIATIONS:SIDE LENGTH IN MINOR AXIS" : "Deviations:Side length in minor axis"),
                found.length.y() - nominal.y(), 0.6e-4);
  }
}

TEST(Cycle423, MeasuresAnyRectangularPocket) { expectRectangle(423, true); }
TEST(Cycle424, MeasuresAnyRectangularStud) { expectRectangle(424, false); }

/// Cycles 425 and 426: a slot or a ridge across either axis.
void expectWidth(int cycle, bool inside) {
  Dice dice(static_cast<unsigned>(cycle));
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 0.5, 2);
    const double ball = part.bench.believedProbe().radius;
    const int axis = dice.whole(0, 1);
    const double width = dice.between(2 * ball + 6, 80);
    Vector2 length(200, 200);
    length[axis] = width;
    if (inside) {
      layPocket(part, length);
    } else {
      part.bench.part(simulation::Box({-length.x() / 2, -length.y() / 2, -40}, {length.x() / 2, length.y() / 2, 0}),
                      part.machineFromPart);
    }
    part.bench.knows(5, "MILL", 50, 8);
    const double nominal = written(width + dice.between(-0.3, 0.3));
    // The second touch stands aside by so much.
    const double aside = dice.coin() ? 0 : written(dice.between(-30, 30));
    // A wall at w/2 from the middle, met at v along it, is found at (w/2 +- ball)/cos - v tan, less the ball.
    const Vector3 truth = part.truth();
    const double c = std::cos(radians(part.skew));
    const double t = std::tan(radians(part.skew)) * (axis == 0 ? -1 : 1);
    const double out = inside ? -1 : 1;
    const double v1 = part.nominal[1 - axis] - truth[1 - axis];
    const double v2 = v1 + aside;
    const double half = (width / 2 + out * ball) / c - out * ball;
    const double plus = truth[axis] + half + v1 * t, minus = truth[axis] - half + v2 * t;
    const double found = plus - minus;
    const Limits limits = limitsAround(dice, found);
    Words words = {{272, axis + 1},
                   {261, part.nominal.z() - 8},
                   {260, part.nominal.z() + 20},
                   {311, nominal},
                   {288, limits.maximum},
                   {289, limits.minimum},
                   {281, 1},
                   {309, 0},
                   {330, 5}};
    if (inside) {
      words = with(words, {{328, part.nominal.x()}, {329, part.nominal.y()}, {310, aside}});
      if (part.bench.control == ControlKind::TNC640) words = with(words, {{320, 1}, {301, dice.whole(0, 1)}});
    } else {
      Vector2 first = part.nominal.head<2>(), second = first;
      first[axis] += nominal / 2;
      second[axis] -= nominal / 2;
      second[1 - axis] += aside;
      words = with(words, {{263, first.x()}, {264, first.y()}, {265, second.x()}, {266, second.y()}, {320, 1}});
    }
    const Ran ran = part.bench.run(probe(cycle, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(156), found, exact);
    EXPECT_NEAR(ran.q(157), (plus + minus) / 2, exact);
    EXPECT_NEAR(ran.q(166), found - nominal, exact);
    expectStatus(ran, dimension(found, limits.maximum, limits.minimum, inside));
    EXPECT_NEAR(ran.cell("TOOL.T", "5", "DR"), -out * (found - nominal) / 2, 6e-5);
    const auto log = readLog(ran.log(fmt::format("TCHPR{}.TXT", cycle)));
    EXPECT_NEAR(log.at("Actual values:Length"), found, 0.6e-4);
    EXPECT_NEAR(log.at("Actual values:Position of center line"), (plus + minus) / 2, 0.6e-4);
  }
}

TEST(Cycle425, MeasuresAnySlot) { expectWidth(425, true); }
TEST(Cycle426, MeasuresAnyRidge) { expectWidth(426, false); }

TEST(Cycle427, MeasuresACoordinateInAnyAxis) {
  Dice dice(427);
  for (int world = 0; world < worlds; ++world) {
    SCOPED_TRACE(fmt::format("world {}", world));
    PlantedPart part = plant(dice, controlOf(world), 0.5, 0);
    const double half = 20;
    part.bench.part(simulation::Box({-half, -half, -40}, {half, half, 0}), part.machineFromPart);
    part.bench.knows(5, "MILL", 50, 8);
    const int axis = dice.whole(0, 2);
    const double sense = axis == 2 || dice.coin() ? -1 : 1;
    Vector3 nominal = part.nominal;
    nominal[axis] -= axis == 2 ? 0 : sense * half;
    if (axis != 2) nominal.z() -= 10;
    double actual = part.truth()[axis];
    if (axis != 2) actual -= sense * half;
    Limits limits = limitsAround(dice, actual);
    // Exchanged limits make it the wall of a recess.
    const bool inside = limits.maximum != 0 && dice.coin();
    const Finding finding = dimension(actual, limits.maximum, limits.minimum, inside);
    if (inside) std::swap(limits.maximum, limits.minimum);
    const Words words = {{263, nominal.x()},
                         {264, nominal.y()},
                         {261, nominal.z()},
                         {320, 1},
                         {272, axis + 1},
                         {267, sense},
                         {260, part.nominal.z() + 20},
                         {281, 1},
                         {288, limits.maximum},
                         {289, limits.minimum},
                         {309, 0},
                         {330, 5}};
    const Ran ran = part.bench.run(probe(427, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(160), actual, exact);
    expectStatus(ran, finding);
    // A surface met earlier than expected has material left.
    const double left = -sense * (actual - nominal[axis]);
    EXPECT_NEAR(ran.cell("TOOL.T", "5", axis == 2 ? "DL" : "DR"), -left, 6e-5);
    EXPECT_NEAR(ran.cell("TOOL.T", "5", axis == 2 ? "DR" : "DL"), 0, 1e-12);
    EXPECT_NEAR(readLog(ran.log("TCHPR427.TXT")).at("Actual values:Measured coordinate"), actual, 0.6e-4);
  }
}

}  // namespace
}  // namespace probewright::testing_support
