#include "lathe_tools/tool_bench.hpp"
#include "setup/simulated_run.hpp"
#include "sinumerik_tools/tool_bench.hpp"

/// CYCLE982 in all its variants on random tools, through the front door: what was planted is found, in machine and in
/// workpiece coordinates, with worn inserts and teeth that run out.
namespace probewright {
namespace {

using namespace testing_support;

/// A lathe with the cube on its bed, and where its program has its origin (Z, X).
struct World {
  setup::Setup setup;
  Vector2 origin = Vector2::Zero();
  bool workpiece = false;
  double pretravel = 0;

  explicit World(Planter& plant, bool anySystem = true) : workpiece(anySystem && coin(plant)) {
    pretravel = coin(plant) ? plant.number(0, 0.02) : 0;
    setup = toolSetup([&](simulation::TrueToolProbe& probe) { probe.pretravel = pretravel; });
    if (workpiece) origin = {plant.number(100, 400), 0};
    setup.beliefs.zeroOffsets.push_back({.index = 1,
                                         .name = "G54",
                                         .origin = {0, 0, origin.x()},
                                         .rotation = Vector3::Zero(),
                                         .rotary = {},
                                         .active = true});
    for (int axis = 1; axis <= 2; ++axis)
      for (const double sign : {-1.0, 1.0})
        datum(triggerName(axis, sign, workpiece ? "TPW" : "TP") + "[0]", trigger(axis, sign));
  }

  void datum(const std::string& name, double value) { setup.beliefs.parameters[name] = {value, {}}; }
  /// Where a tool that travels in this direction of an axis of the plane (1 Z, 2 X) truly gives the signal.
  double trigger(int axis, double direction) const {
    const double middle = axis == 1 ? probeMiddle.z() : probeMiddle.x();
    return middle - origin[axis - 1] - direction * (half - pretravel);
  }
  /// Tool 5 goes to `start` (Z, X; machine), then come the blocks.
  ToolRun run(const Vector2& start, const std::string& blocks, const std::string& way = {}) const {
    const Vector2 at = start - origin;
    const std::string text =
        fmt::format("G18 G90 G71 G54\nDIAMOF\nT5 D1\n{}G0 Z{:.9f}\nG0 X{:.9f}\n{}M30\n", way, at.x(), at.y(), blocks);
    ToolRun left{setup::runText("TOOLS.MPF", text, setup, {}, {.recordPath = false})};
    coverage::noteRun(control::ControlKind::Sinumerik840Dsl, left.journal());
    return left;
  }
  /// Up to the height of the start where nothing is in the way.
  std::string over(const Vector2& start) const {
    return fmt::format("G0 Z{:.9f}\nG0 X{:.9f}\n", 460 - origin.x(), start.y() - origin.y());
  }
  double variant(double digits) const { return digits + (workpiece ? 10 : 0); }
};

/// What the control believes of tool 5 before the call, and how a difference is to be entered.
struct Belief {
  std::array<double, 3> value{}, worn{};  ///< length 1, length 2, radius
  bool wear = false;
  double empirical = 0;
  int memory = 0;

  static constexpr std::array<int, 3> geometryData = {3, 4, 6}, wearData = {12, 13, 15};

  Belief(Planter& plant, World& world, std::array<double, 3> truth, double wrongLength, double wrongRadius)
      : wear(coin(plant)) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double most = i < 2 ? wrongLength : wrongRadius;
      value[i] = truth[i] + plant.number(-most, most);
      // The nose of a turning tool is as it is believed.
      worn[i] = most > 0 ? plant.number(-0.05, 0.05) : 0;
      world.datum(fmt::format("$TC_DP{}[5,1]", geometryData[i]), value[i]);
      world.datum(fmt::format("$TC_DP{}[5,1]", wearData[i]), worn[i]);
    }
    if (coin(plant)) {
      memory = whole(plant, 1, 20);
      empirical = plant.number(-0.02, 0.02);
      world.datum(fmt::format("$SCS_MEA_EMPIRIC_VALUE[{}]", memory - 1), empirical);
    }
  }
  double before(std::size_t i) const { return value[i] + worn[i]; }
  /// Component `i` was found so; nothing: it was not measured, and stays.
  void expect(const ToolRun& left, std::size_t i, std::optional<double> found, double tolerance = 2e-6) const {
    SCOPED_TRACE(i == 2 ? "radius" : i == 0 ? "length 1" : "length 2");
    const int actual = 8 + 2 * static_cast<int>(i);
    const double geometry = left.written(fmt::format("$TC_DP{}[5,1]", geometryData[i]));
    const double worn_ = left.written(fmt::format("$TC_DP{}[5,1]", wearData[i]));
    EXPECT_EQ(!std::isnan(left.ovr(actual)), found.has_value());
    EXPECT_EQ(!std::isnan(geometry), found && !wear);
    EXPECT_EQ(!std::isnan(worn_), found.has_value());
    if (!found) return;
    const double difference = *found - before(i) - empirical;
    EXPECT_NEAR(left.ovr(actual), *found, tolerance);
    EXPECT_NEAR(left.ovr(actual + 1), difference, tolerance);
    if (wear) {
      EXPECT_NEAR(worn_, worn[i] + difference, tolerance);
    } else {
      EXPECT_NEAR(geometry, *found - empirical, tolerance);
      EXPECT_EQ(worn_, 0);
    }
  }
};

/// CYCLE982 with these arguments.
std::string call(const World& world, const Belief* belief, double variant, int axis, int way, const std::string& offset,
                 double path, double angle, double correction, int display) {
  return fmt::format("CYCLE982({},{},1,{},{},{},{},1.5,,{:.9f},{:.9f},,,1,{},,{})\n", world.variant(variant),
                     belief != nullptr && belief->wear ? 1 : 0, axis, way, offset, path, angle, correction,
                     belief != nullptr ? belief->memory : 0, display);
}

TEST(RandomLatheTools, CalibratingFindsEachTriggerPoint) {
  Planter plant(98201);
  for (int round = 0; round < 60; ++round) {
    World world(plant);
    const bool pin = coin(plant), incremental = coin(plant);
    const int position = pin ? 3 : whole(plant, 1, 4), axis = whole(plant, 1, 2);
    const double radius = pin ? plant.number(3, 6) : plant.number(0.2, 1.6);
    const double direction = pin ? (coin(plant) ? 1 : -1) : pointing(position)[axis - 1];
    SCOPED_TRACE(fmt::format("{}: position {}, axis {}, {}", round, position, axis, direction));
    Vector2 lengths(plant.number(60, 90), plant.number(20, 50));
    if (!pin && pointing(position).y() > 0) lengths.x() = -lengths.x();
    add(world.setup, pin ? calibrationPin(5, lengths, radius) : turningTool(5, position, lengths, radius),
        pin ? "calibration" : "turn");
    const std::string name = triggerName(axis, direction, world.workpiece ? "TPW" : "TP") + "[0]";
    const double approximate = world.trigger(axis, direction) + plant.number(-0.9, 0.9);
    world.datum(name, approximate);
    // The middle of the nose: in front of the face, or where the cycle finds its way from.
    Vector2 nose(probeMiddle.z(), probeMiddle.x());
    nose[axis - 1] -= direction * (incremental ? half + 4 + radius : 40);
    if (!pin && !incremental) nose[2 - axis] -= 40 * pointing(position)[2 - axis];
    const Vector2 start = nose + radius * pointing(position);
    const int way = coin(plant) ? 0 : direction > 0 ? 1 : 2;
    // Past the contact at a distance along Z, then in.
    const double beyond = incremental && axis == 2 ? start.y() - 40 * direction : start.y();
    const double clear = (direction > 0 && axis == 1 ? 340 : 460) - world.origin.x();
    const std::string path = fmt::format("G0 Z{:.9f}\nG0 X{:.9f}\n", clear, beyond);
    const ToolRun left =
        world.run(start,
                  fmt::format("CYCLE982({},,1,{},{},,5,2,{},,,,,{})\n", world.variant(incremental ? 100000 : 0), axis,
                              way, whole(plant, 100, 300), whole(plant, 1, 3)),
                  path);
    ASSERT_EQ(left.code(), "");
    const int result = 4 + 4 * axis + (direction < 0 ? 0 : 2);
    EXPECT_NEAR(left.written(name), world.trigger(axis, direction), 2e-6);
    EXPECT_NEAR(left.ovr(result), world.trigger(axis, direction), 2e-6);
    EXPECT_NEAR(left.ovr(result + 1), world.trigger(axis, direction) - approximate, 2e-6);
    for (int other = 8; other < 16; other += 2)
      EXPECT_EQ(std::isnan(left.ovr(other)), other != result);
  }
}

TEST(RandomLatheTools, TurningToolsOfEveryPosition) {
  Planter plant(98202);
  for (int round = 0; round < 96; ++round) {
    const int position = 1 + round % 8, what = round / 8 % 3;  // completely, along one axis, incrementally
    SCOPED_TRACE(fmt::format("{}: position {}, task {}", round, position, what));
    World world(plant);
    const Vector2 points = pointing(position);
    Vector2 lengths(plant.number(50, 90), plant.number(20, 60));
    if (points.y() > 0) lengths.x() = -lengths.x();
    const double radius = plant.number(0.2, 1.6);
    simulation::TrueTool tool = turningTool(5, position, lengths, radius);
    const double lost = coin(plant) ? plant.number(0, 0.15) : 0;
    tool.cutter.insert->wear = lost;
    add(world.setup, tool, "turn");
    const Belief belief(plant, world, {lengths.x(), lengths.y(), radius}, 0.5, 0);

    const int axis = points.x() == 0 ? 2 : points.y() == 0 ? 1 : whole(plant, 1, 2);
    Vector2 start = startOf(position);
    if (what == 2) {
      // The nose in front of the face.
      start = Vector2(probeMiddle.z(), probeMiddle.x()) + radius * points;
      start[axis - 1] -= points[axis - 1] * (half + 4 + radius);
    }
    const double variant = what == 0 ? 2 : what == 1 ? 1 : 100001;
    const ToolRun left = world.run(start,
                                   call(world, &belief, variant, what == 0 ? 0 : axis,
                                        coin(plant) || what == 0 ? 0
                                        : points[axis - 1] > 0   ? 1
                                                                 : 2,
                                        "", 5, 0, 0, 2),
                                   std::abs(start.y() - probeMiddle.x()) < 25 && axis == 1
                                       ? ""
                                       : world.over(what == 2 && axis == 2 ? Vector2(start - 30 * points) : start));
    ASSERT_EQ(left.code(), "");
    // An edge that has lost material touches later.
    const bool ofX = points.y() != 0 && (what == 0 || axis == 2), ofZ = points.x() != 0 && (what == 0 || axis == 1);
    belief.expect(left, 0, ofX ? std::optional(lengths.x() + points.y() * lost) : std::nullopt);
    belief.expect(left, 1, ofZ ? std::optional(lengths.y() + points.x() * lost) : std::nullopt);
    belief.expect(left, 2, std::nullopt);
  }
}

enum class Teeth { AsTheyStand, Reversed, Turning };

TEST(RandomLatheTools, MillsWithTeeth) {
  Planter plant(98203);
  for (int round = 0; round < 120; ++round) {
    const bool radial = round % 2 == 1;
    const int what = round / 2 % 5;  // completely; along: length; across: length, radius, length and radius
    const auto how = static_cast<Teeth>(round / 10 % 3);
    SCOPED_TRACE(fmt::format("{}: {} {} {}", round, radial ? "radial" : "axial", what, static_cast<int>(how)));
    World world(plant);
    const Vector2 lengths(plant.number(50, 80), plant.number(60, 100));
    // Standing, so large that its middle is beside the contact: each tooth touches alone. Turning, its teeth come over
    // the sides of the contact that give way.
    const double radius = how == Teeth::Turning ? plant.number(4, 8) : plant.number(13, 16);
    simulation::TrueTool mill = rotatedTool(5, radial, lengths, radius);
    // At the start angle the teeth look to plus and minus of the axis across the tool.
    const Vector3 across = radial ? Vector3::UnitZ() : Vector3::UnitX();
    const Matrix3 frame = simulation::toolFrame(mill);
    const double towards = degreesFromRadians(std::atan2(across.dot(frame.col(1)), across.dot(frame.col(0))));
    const double angle = plant.number(0, 180), correction = how == Teeth::Reversed ? plant.number(-20, 20) : 0;
    const auto tooth = [&](double at) {
      return simulation::TrueTooth{.angle = at,
                                   .radial = plant.number(-0.05, 0.05),
                                   .axial = plant.number(-0.05, 0.05),
                                   .radialWear = plant.number(0, 0.1),
                                   .axialWear = plant.number(0, 0.1)};
    };
    // Reversed, tooth 1 touches first and the other one after half a turn and the correction angle.
    mill.cutter.teeth = {tooth(towards - angle), tooth(towards - angle + 180 - correction)};
    if (how == Teeth::AsTheyStand) mill.cutter.teeth[1].angle = towards - angle + 180;
    const auto reach = [&](std::size_t i) {
      return radius + mill.cutter.teeth[i].radial - mill.cutter.teeth[i].radialWear;
    };
    const auto end = [&](std::size_t i) { return mill.cutter.teeth[i].axial - mill.cutter.teeth[i].axialWear; };
    add(world.setup, mill, "mill");
    const Belief belief(plant, world, {lengths.x(), lengths.y(), radius}, 0.3, 0.2);
    if (how == Teeth::Turning) world.datum(world.workpiece ? "$SNS_MEA_TPW_FEED[0]" : "$SNS_MEA_TP_FEED[0]", 2);

    // Of one side with reversal the tooth must look there: tooth 1 looks to plus, that is travel in plus direction.
    const bool fromMinus = how == Teeth::Reversed || coin(plant);
    const double beside = fromMinus ? -45 : 45;
    const Vector2 start = radial ? Vector2(probeMiddle.z() + beside, 195) : Vector2(445, probeMiddle.x() + beside);
    const int acrossAxis = radial ? 1 : 2, alongAxis = 3 - acrossAxis;
    double variant = radial ? 10000 : 0;
    if (how == Teeth::AsTheyStand) variant += 1000000;
    if (how == Teeth::Reversed) variant += 100;
    constexpr std::array<int, 5> tasks = {2, 1, 1, 1001, 2001};
    variant += tasks[static_cast<std::size_t>(what)] + (what == 0 && coin(plant) ? 2000 : 0);
    const int axis = what == 0 ? 0 : what == 1 ? alongAxis : acrossAxis;
    // Reversed, both sides and the face on both sides of the axis cannot have a tooth each with a correction angle.
    if (how == Teeth::Reversed && what != 1 && what != 2) mill.cutter.teeth[1].angle = towards - angle + 180;
    world.setup.world.truth.tools.back() = mill;
    const double corrected = how == Teeth::Reversed && what != 1 && what != 2 ? 0 : correction;
    const ToolRun left = world.run(start,
                                   std::string("SETMS(2)\n") + (how == Teeth::Turning ? "S2000 M4\n" : "") +
                                       call(world, &belief, variant, axis, 0, "2", how == Teeth::Turning ? 1.5 : 4,
                                            angle, corrected, fromMinus ? 1102 : 102),
                                   world.over(start));
    ASSERT_EQ(left.code(), "");
    // 2 mm/min at 2000 turns a minute.
    const double tolerance = how == Teeth::Turning ? 1.1e-3 : 3e-6;
    // Which tooth touches where: 0 looks to plus, 1 to minus.
    const std::size_t first = fromMinus ? 0 : 1;
    const double mean = (reach(0) + reach(1)) / 2, most = std::max(reach(0), reach(1));
    const double meanEnd = (end(0) + end(1)) / 2, mostEnd = std::max(end(0), end(1));
    std::array<std::optional<double>, 3> found;
    const std::size_t ofAcross = radial ? 1 : 0, ofAlong = 1 - ofAcross;
    const double lengthAcross = radial ? lengths.y() : lengths.x(), lengthAlong = radial ? lengths.x() : lengths.y();
    const bool stands = how == Teeth::AsTheyStand;
    if (what == 0 || what >= 3) {
      found[2] = how == Teeth::Turning ? most : mean;
      // Teeth that are not alike look like an axis beside its place.
      if (what != 3) found[ofAcross] = lengthAcross + (stands ? (reach(1) - reach(0)) / 2 : 0);
    }
    if (what == 0) found[ofAlong] = lengthAlong + (how == Teeth::Turning ? mostEnd : meanEnd);
    // On the side of the start the face is touched by the tooth that looks away from there.
    if (what == 1)
      found[ofAlong] = lengthAlong + (how == Teeth::Turning ? mostEnd : how == Teeth::Reversed ? meanEnd : end(first));
    // The length across the tool counts with the radius that is believed.
    if (what == 2) {
      const double touched = how == Teeth::Turning ? most : how == Teeth::Reversed ? mean : reach(first);
      found[ofAcross] = lengthAcross + (fromMinus ? 1 : -1) * (belief.before(2) - touched);
    }
    for (std::size_t i = 0; i < 3; ++i)
      belief.expect(left, i, found[i], tolerance);
  }
}

TEST(RandomLatheTools, RearSidesOfDiscs) {
  Planter plant(98204);
  for (int round = 0; round < 24; ++round) {
    const bool radial = round % 2 == 1;
    SCOPED_TRACE(round);
    World world(plant);
    const Vector2 lengths(plant.number(50, 80), plant.number(60, 100));
    const double radius = plant.number(16, 22), width = plant.number(4, 8);
    simulation::TrueTool disc = rotatedTool(5, radial, lengths, radius);
    disc.cutter.cutLength = width;
    disc.cutter.shankRadius = 4;
    add(world.setup, disc, "mill");
    // Its length is that of the rear side.
    const std::array<double, 3> truth = {lengths.x() - (radial ? width : 0), lengths.y() - (radial ? 0 : width),
                                         radius};
    const Belief belief(plant, world, truth, 0.3, 0.2);
    const bool fromMinus = coin(plant);
    const double beside = fromMinus ? -58 : 58;
    const Vector2 start = radial ? Vector2(probeMiddle.z() + beside, 208) : Vector2(458, probeMiddle.x() + beside);
    const ToolRun left =
        world.run(start, call(world, &belief, radial ? 13002 : 3002, 0, 0, "", 5, 0, 0, fromMinus ? 1102 : 102),
                  world.over(start));
    ASSERT_EQ(left.code(), "");
    for (std::size_t i = 0; i < 3; ++i)
      belief.expect(left, i, truth[i], 3e-6);
  }
}

TEST(RandomLatheTools, Drills) {
  Planter plant(98205);
  for (int round = 0; round < 40; ++round) {
    const bool radial = round % 2 == 1, incremental = coin(plant);
    const int axis = whole(plant, 1, 2);
    SCOPED_TRACE(fmt::format("{}: {} axis {}", round, radial ? "radial" : "axial", axis));
    World world(plant);
    const Vector2 lengths(plant.number(50, 80), plant.number(60, 100));
    const double radius = plant.number(2, 6);
    simulation::TrueTool drill = rotatedTool(5, radial, lengths, radius);
    drill.cutter.pointAngle = plant.number(90, 140);
    add(world.setup, drill, "drill");
    const Belief belief(plant, world, {lengths.x(), lengths.y(), radius}, 0.4, 0);
    const bool along = axis == (radial ? 2 : 1);
    const double side = coin(plant) ? 1 : -1;  // that the drill is on
    // Where the point is: in front of the face, or beside it, its shank along the contact.
    Vector2 start(probeMiddle.z(), probeMiddle.x());
    const int own = radial ? 1 : 0, other = 1 - own;
    if (incremental) {
      along ? start[own] += half + 4 : start[own] -= 4;
      if (!along) start[other] += side * (half + 4 + radius);
    } else {
      start[own] += 45;
      start[other] += side * 40;
    }
    const int way = incremental ? along || side > 0 ? 2 : 1 : 0;
    const std::string there = incremental
                                  ? radial ? fmt::format("G0 X{:.9f}\n", 195 - world.origin.y())
                                           : fmt::format("G0 Z{:.9f}\nG0 X{:.9f}\nG0 Z{:.9f}\n", 445 - world.origin.x(),
                                                         start.y() - world.origin.y(), start.x() - world.origin.x())
                                  : world.over(start);
    const ToolRun left = world.run(
        start,
        call(world, &belief, 1 + (radial ? 10000 : 0) + (incremental ? 100000 : 0), axis, way, "4", 5, 0, 0, 202),
        there);
    ASSERT_EQ(left.code(), "");
    for (std::size_t i = 0; i < 3; ++i) {
      const bool measured = i + 1 == static_cast<std::size_t>(axis == 2 ? 1 : 2);
      belief.expect(left, i, measured ? std::optional(i == 0 ? lengths.x() : lengths.y()) : std::nullopt);
    }
  }
}

/// Trigger points that are wrong make wrong lengths, by just that.
TEST(RandomLatheTools, WrongTriggerPointsMakeWrongTools) {
  Planter plant(98206);
  for (int round = 0; round < 16; ++round) {
    SCOPED_TRACE(round);
    const int position = 1 + round % 4;
    World world(plant);
    const Vector2 points = pointing(position);
    Vector2 lengths(plant.number(50, 90), plant.number(20, 60));
    if (points.y() > 0) lengths.x() = -lengths.x();
    add(world.setup, turningTool(5, position, lengths, 0.8), "turn");
    const Vector2 wrong(plant.number(-0.1, 0.1), plant.number(-0.1, 0.1));
    for (int axis = 1; axis <= 2; ++axis)
      world.datum(triggerName(axis, points[axis - 1], world.workpiece ? "TPW" : "TP") + "[0]",
                  world.trigger(axis, points[axis - 1]) + wrong[axis - 1]);
    const Vector2 start = startOf(position);
    const ToolRun left =
        world.run(start, "CYCLE982(" + fmt::format("{}", world.variant(2)) + ",0,1,,,,5,1)\n", world.over(start));
    ASSERT_EQ(left.code(), "");
    EXPECT_NEAR(left.ovr(9), -wrong.y(), 2e-6);
    EXPECT_NEAR(left.ovr(11), -wrong.x(), 2e-6);
  }
}

}  // namespace
}  // namespace probewright
