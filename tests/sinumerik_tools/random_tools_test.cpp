#include "sinumerik_tools/tool_bench.hpp"

/// CYCLE971 in all its variants on random probes and tools: what was planted is found, in machine and in workpiece
/// coordinates, with wear, run-out, an axis beside the spindle's and broken teeth.
namespace probewright {
namespace {

using namespace testing_support;

/// The last touch of a turning tool follows it by this much in a turn, with the setting data as delivered.
constexpr double accuracy = 0.005;

Vector2 direction(double degrees) {
  return {std::cos(radiansFromDegrees(degrees)), std::sin(radiansFromDegrees(degrees))};
}

/// A tooth as it stands at spindle angle 0: the place of its edge across the spindle's axis, and how long it is.
struct Edge {
  Vector2 place;
  double length;
};
Edge edgeOf(const simulation::TrueTool& tool, const simulation::TrueTooth& tooth) {
  return {tool.cutter.eccentricity + (tool.radius + tooth.radial - tooth.radialWear) * direction(tooth.angle),
          tool.length + tooth.axial - tooth.axialWear - tooth.broken};
}

/// Turns the teeth to any angle, lets them run out and wear by up to `worn` mm.
void useTeeth(simulation::TrueTool& mill, Planter& plant, double worn) {
  const double first = plant.number(-180, 180);
  std::size_t number = 0;
  for (simulation::TrueTooth& tooth : mill.cutter.teeth) {
    tooth.angle = first + 360.0 * static_cast<double>(number++) / static_cast<double>(mill.cutter.teeth.size());
    tooth.radial = plant.number(-0.03, 0.03);
    tooth.axial = plant.number(-0.03, 0.03);
    tooth.radialWear = plant.number(0, worn);
    tooth.axialWear = plant.number(0, worn);
  }
}

/// A world with a probe that the control believes a little beside its place, and the origin of the program.
struct World {
  ToolBench bench;
  Vector3 origin = Vector3::Zero();
  bool workpiece = false;
  double pretravel = 0;

  World(Planter& plant, bool cuboid, double least, double most) : workpiece(coin(plant)) {
    cuboid ? bench.cuboid(plant.number(least, most), plant.number(least, most)) : bench.disc(plant.number(least, most));
    pretravel = coin(plant) ? plant.number(0, 0.01) : 0;
    bench.probe().pretravel = pretravel;
    bench.setup.beliefs.toolProbes = setup::believedToolProbes(bench.setup.world);
    if (!workpiece) return;
    origin = {plant.number(-80, 80), plant.number(-80, 80), plant.number(-450, -350)};
    bench.zeroOffset(origin);
  }
  /// From the middle of the contact's upper face.
  ToolRun run(int tool, const Vector3& from, const std::string& blocks) const {
    const Vector3 start = bench.contact - origin + from;
    return bench.program(fmt::format("G17 G90 G71 {}\nT{} D1 M6\nG0 X{:.9f} Y{:.9f}\nG0 Z{:.9f}\n{}M30\n",
                                     workpiece ? "G54" : "G500", tool, start.x(), start.y(), start.z(), blocks));
  }
  std::string trigger(int axis, double sign) const {
    return fmt::format("$SNS_MEA_{}_TRIG_{}_DIR_AX{}[0]", workpiece ? "TPW" : "TP", sign < 0 ? "MINUS" : "PLUS",
                       axis + 1);
  }
  /// Where a tool that travels this way truly gives the signal.
  double truth(int axis, double sign) const {
    const double half = axis == 0 ? bench.half1 : axis == 1 ? bench.half2 : 0;
    return bench.contact[axis] - origin[axis] - sign * (half - pretravel);
  }
};

/// 10 in the tens of S_MVAR.
double inSystem(const World& world, double variant) { return variant + (world.workpiece ? 10 : 0); }

TEST(RandomTools, CalibratingFindsEachTriggerPoint) {
  Planter plant(97101);
  for (int round = 0; round < 60; ++round) {
    SCOPED_TRACE(round);
    const int axis = round % 4;  // 3: completely
    const bool centred = axis < 2 && coin(plant), reverses = axis != 2 && coin(plant);
    // Beside the middle a disc is touched on a chord.
    World world(plant, axis < 2 && !centred ? true : coin(plant), 12, 30);
    auto& pin = world.bench.add(9, plant.number(60, 110), plant.number(3, 6));
    if (reverses) pin.cutter.eccentricity = plant.number(0, 0.05) * direction(plant.number(-180, 180));
    world.bench.misplace({plant.number(-0.8, 0.8), plant.number(-0.8, 0.8), plant.number(-0.8, 0.8)});
    const double variant = (axis == 3 ? 100000 : 0) + (reverses ? 1000000 : 0);
    const int way = axis == 2 ? 2 * whole(plant, 0, 1) : axis == 3 ? 0 : whole(plant, 0, 2);
    NamedNumbers call = {{"S_MVAR", inSystem(world, variant)},
                         {"S_PRNUM", whole(plant, 0, 1)},
                         {"S_FA", 4},
                         {"S_TSA", 3},
                         {"S_NMSP", whole(plant, 1, 3)},
                         {"S_MD", way}};
    if (axis < 3) call = with(call, {{"S_MA", axis + 1 + (centred ? 100 * (2 - axis) : 0)}});
    Vector3 from(0, 0, 25);
    double side = coin(plant) ? 1 : -1;
    if (axis < 2) from[axis] = -45 * side;
    if (way != 0) side = way == 1 ? 1 : -1;
    if (axis == 2) side = -1;
    const ToolRun left = world.run(9, from, ToolBench::call(call));
    ASSERT_EQ(left.code(), "");
    for (int each = 0; each < 3; ++each) {
      for (const double sign : {-1.0, 1.0}) {
        const bool found = axis == 3 ? each < 2 || sign < 0 : each == axis && sign == side;
        const int result = 8 + 4 * each + (sign > 0 ? 2 : 0);
        SCOPED_TRACE(world.trigger(each, sign));
        EXPECT_EQ(!std::isnan(left.ovr(result)), found);
        EXPECT_EQ(!std::isnan(left.written(world.trigger(each, sign))), found);
        if (!found) continue;
        // Both positions of the reversed spindle touch a disc as far beside its middle as the pin's axis is.
        const double apart = world.bench.half1 + pin.radius, aside = each < 2 ? pin.cutter.eccentricity[1 - each] : 0;
        const double nearer = world.bench.probe().cuboid ? 0 : apart - std::sqrt(apart * apart - aside * aside);
        const double expected = world.truth(each, sign) + sign * nearer;
        EXPECT_NEAR(left.written(world.trigger(each, sign)), expected, 5e-6);
        EXPECT_NEAR(left.ovr(result), expected, 5e-6);
      }
    }
  }
}

/// What a measurement is to find.
struct Expected {
  double least = 0, most = 0;
};

TEST(RandomTools, MeasuringFindsLengthAndRadius) {
  Planter plant(97102);
  for (int round = 0; round < 80; ++round) {
    const bool length = round % 2 == 0, turning = round / 2 % 2 == 0, wear = coin(plant);
    SCOPED_TRACE(fmt::format("{}: {} {}", round, turning ? "turning" : "standing", length ? "length" : "radius"));
    // A standing tooth that looks at a face of a cuboid touches it with its edge.
    World world(plant, !turning || coin(plant), turning ? 12 : 8, turning ? 30 : 10);
    const int teeth = whole(plant, 2, 5);
    simulation::TrueTool& mill = world.bench.add(2, plant.number(60, 110), plant.number(8, 16), teeth);
    // An edge that winds about an axis beside the spindle's is not as far from that at every height.
    if (turning && coin(plant)) {
      mill.cutter.helix = plant.number(-30, 30);
    } else {
      mill.cutter.eccentricity = plant.number(0, 0.02) * direction(plant.number(-180, 180));
    }
    useTeeth(mill, plant, 0.1);
    if (turning) mill.cutter.teeth.back().broken = plant.number(0.2, 1.5);

    const int axis = whole(plant, 0, 1), offset = length && coin(plant) ? whole(plant, 1, 2) : 0;
    const int way = length ? 2 * whole(plant, 0, 1) : whole(plant, 0, 2);
    double side = coin(plant) ? 1 : -1;  // the direction of travel towards the middle
    Vector3 from(0, 0, 25);
    const int along = length ? (offset == 0 ? 0 : offset - 1) : axis;
    from[along] = -45 * side;
    if (!length && way != 0) side = way == 1 ? 1 : -1;

    // A standing tool: tooth 1 looks where its edge touches the contact.
    const simulation::TrueTooth& tooth = mill.cutter.teeth.front();
    const double towards = (along == 0 ? 0 : 90) + (side > 0 ? 0 : 180), spindle = towards - tooth.angle;
    Expected expected;
    if (turning) {
      for (const auto& each : mill.cutter.teeth) {
        const Edge edge = edgeOf(mill, each);
        expected.most = std::max(expected.most, length ? edge.length : edge.place.norm());
      }
      expected.least = expected.most - accuracy;
    } else {
      const Edge edge = edgeOf(mill, tooth);
      expected.most =
          length ? edge.length : (Eigen::Rotation2Dd(radiansFromDegrees(spindle)) * edge.place).dot(direction(towards));
      expected.least = expected.most;
    }

    control::BelievedTool& believed = world.bench.believed(2);
    believed.length = mill.length + plant.number(-0.5, 0.5);
    believed.radius = mill.radius + plant.number(-0.3, 0.3);
    const double worn = plant.number(-0.1, 0.1), empirical = coin(plant) ? plant.number(-0.02, 0.02) : 0;
    const std::string geometry = length ? "$TC_DP3[2,1]" : "$TC_DP6[2,1]";
    const std::string wears = length ? "$TC_DP12[2,1]" : "$TC_DP15[2,1]";
    world.bench.datum(wears, worn);
    const int memory = empirical == 0 ? 0 : whole(plant, 1, 20);
    if (memory > 0) world.bench.datum(fmt::format("$SCS_MEA_EMPIRIC_VALUE[{}]", memory - 1), empirical);
    const double before = (length ? believed.length : believed.radius) + worn;

    // A length of a tool wider than the contact is touched by the edge, V inwards of its end.
    NamedNumbers call = {{"S_MVAR", inSystem(world, turning ? 2 : 1)},
                         {"S_KNUM", wear},
                         {"S_PRNUM", 1},
                         {"S_MA", length ? 3 + 100 * offset : axis + 1},
                         {"S_MD", way},
                         {"S_ID", length ? plant.number(0, 1) : plant.number(0, 4)},
                         {"S_FA", 3},
                         {"S_TSA", 2},
                         {"S_NMSP", whole(plant, 1, 2)},
                         {"S_EVNUM", memory}};
    const ToolRun left =
        world.run(2, from, (turning ? "" : fmt::format("SPOS={:.9f}\n", spindle)) + ToolBench::call(call));
    ASSERT_EQ(left.code(), "");
    const double found = left.ovr(length ? 8 : 10);
    EXPECT_LE(found, expected.most + 1e-5);
    EXPECT_GE(found, expected.least - 1e-5);
    EXPECT_NEAR(left.ovr(length ? 9 : 11), found - before - empirical, 1e-9);
    EXPECT_NEAR(left.ovr(30), empirical, 1e-12);
    EXPECT_EQ(left.ovi(7), memory);
    EXPECT_TRUE(std::isnan(left.ovr(length ? 10 : 8)));
    if (wear) {
      EXPECT_NEAR(left.written(wears), worn + found - before - empirical, 1e-6);
      EXPECT_TRUE(std::isnan(left.written(geometry)));
    } else {
      EXPECT_NEAR(left.written(geometry), found - empirical, 1e-6);
      EXPECT_EQ(left.written(wears), 0);
    }
  }
}

TEST(RandomTools, EachEdgeIsFoundInItsOrder) {
  Planter plant(97103);
  for (int round = 0; round < 50; ++round) {
    const bool length = round % 2 == 0, wear = coin(plant);
    SCOPED_TRACE(fmt::format("{} {}", round, length ? "length" : "radius"));
    // The contact is small enough to feel one edge alone.
    World world(plant, coin(plant), 7, 9);
    const int teeth = whole(plant, 1, 5);
    simulation::TrueTool& mill = world.bench.add(2, plant.number(60, 110), plant.number(10, 16), teeth);
    mill.cutter.eccentricity = plant.number(0, 0.005) * direction(plant.number(-180, 180));
    useTeeth(mill, plant, 0.05);
    // One edge stands out clearly, so that it is the first to touch; another one may be broken.
    const int widest = whole(plant, 0, teeth - 1);
    simulation::TrueTooth& wide = mill.cutter.teeth[static_cast<std::size_t>(widest)];
    wide.radial = 0.06;
    wide.radialWear = 0;
    const bool broken = teeth > 1 && coin(plant);
    const int gap = (widest + 1) % teeth;
    if (broken) mill.cutter.teeth[static_cast<std::size_t>(gap)].broken = plant.number(0.7, 1.5);

    const int axis = whole(plant, 0, 1);
    const double side = coin(plant) ? 1 : -1;
    Vector3 from(0, 0, 25);
    from[axis] = -45 * side;
    control::BelievedTool& believed = world.bench.believed(2);
    believed.length = mill.length + plant.number(-0.2, 0.2);
    believed.radius = mill.radius + plant.number(-0.2, 0.2);
    const double before = length ? believed.length : believed.radius;
    const double empirical = plant.number(-0.02, 0.02);
    world.bench.datum("$SCS_MEA_EMPIRIC_VALUE[2]", empirical);

    const ToolRun left = world.run(2, from,
                                   ToolBench::call({{"S_MVAR", inSystem(world, 102)},
                                                    {"S_KNUM", wear},
                                                    {"S_MA", length ? 103 + 100 * axis : axis + 1},
                                                    {"S_ID", length ? plant.number(0, 1) : plant.number(0, 3)},
                                                    {"S_FA", 3},
                                                    {"S_TSA", 2.2},
                                                    {"S_TDIF", 0.5},
                                                    {"S_EVNUM", 3}}));
    ASSERT_EQ(left.code(), "");
    // At this angle of the tool its edges touch, the first where its highest point is.
    const Vector2 highest = edgeOf(mill, wide).place;
    const double at = degreesFromRadians(std::atan2(highest.y(), highest.x()));
    double longest = 0, shortest = 1e9;
    for (int k = 0; k < teeth; ++k) {
      const Edge edge = edgeOf(mill, mill.cutter.teeth[static_cast<std::size_t>((widest + teeth - k) % teeth)]);
      const double value = length ? edge.length : edge.place.dot(direction(at - 360.0 * k / teeth));
      longest = std::max(longest, value);
      shortest = std::min(shortest, value);
      EXPECT_NEAR(left.ovr((length ? 300 : 100) + k), value, 3e-5) << "edge " << k;
      EXPECT_NEAR(left.ovr((length ? 400 : 200) + k), value - before - empirical, 3e-5) << "edge " << k;
    }
    EXPECT_TRUE(std::isnan(left.ovr((length ? 300 : 100) + teeth)));
    EXPECT_NEAR(left.ovr(length ? 8 : 10), longest, 3e-5);
    EXPECT_NEAR(left.ovr(length ? 9 : 11), longest - before - empirical, 3e-5);
    EXPECT_NEAR(left.ovr(length ? 12 : 14), shortest, 3e-5);
    EXPECT_NEAR(left.ovr(length ? 13 : 15), shortest - before - empirical, 3e-5);
    if (wear) {
      EXPECT_NEAR(left.written(length ? "$TC_DP12[2,1]" : "$TC_DP15[2,1]"), longest - before - empirical, 3e-5);
    } else {
      EXPECT_NEAR(left.written(length ? "$TC_DP3[2,1]" : "$TC_DP6[2,1]"), longest - empirical, 3e-5);
    }
    EXPECT_EQ(left.messages().find("61306") != std::string::npos, length && broken);
  }
}

/// Trigger points that are wrong make wrong tools, by just that.
TEST(RandomTools, WrongTriggerPointsMakeWrongTools) {
  Planter plant(97104);
  for (int round = 0; round < 20; ++round) {
    SCOPED_TRACE(round);
    const bool length = round % 2 == 0;
    World world(plant, true, 14, 24);
    world.bench.add(2, plant.number(60, 110), plant.number(3, 6));
    const Vector3 wrong(plant.number(-0.1, 0.1), plant.number(-0.1, 0.1), plant.number(-0.1, 0.1));
    world.bench.misplace(wrong);
    const int axis = whole(plant, 0, 1);
    const double side = coin(plant) ? 1 : -1;
    Vector3 from(0, 0, 25);
    from[axis] = -45 * side;
    const ToolRun left = world.run(
        2, from,
        ToolBench::call({{"S_MVAR", inSystem(world, 1)}, {"S_MA", length ? 3 : axis + 1}, {"S_FA", 3}, {"S_TSA", 1}}));
    ASSERT_EQ(left.code(), "");
    EXPECT_NEAR(left.ovr(length ? 9 : 11), length ? -wrong.z() : side * wrong[axis], 1e-5);
  }
}

}  // namespace
}  // namespace probewright
