#include "kinematics/chain_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "kinematics/dice.hpp"
#include "machine/machine_file.hpp"

/// All axes of rotation at once, on every build of machine.
namespace probewright::kinematics {
namespace {

using machine::AxisPositions;
using machine::MachineDescription;
using machine::RotaryCorrection;

const Vector3 ball(0, 0, -97);

/// The readings with the ball at the place of the table, the rotary axes as in `rotary`: linear axes are solved for.
AxisPositions reaching(const MachineDescription& machine, const Vector3& onTable, AxisPositions rotary) {
  const auto tip = [&](const AxisPositions& axes) {
    return Vector3(machine::baseFromTable(machine, axes).inverse() * (machine::baseFromSpindle(machine, axes) * ball));
  };
  for (const char* name : {"X", "Y", "Z"})
    rotary[*machine.axisIndex(name)] = 0;
  const Vector3 atZero = tip(rotary);
  Matrix3 slope;
  AxisPositions found = rotary;
  for (int i = 0; i < 3; ++i) {
    AxisPositions one = rotary;
    one[*machine.axisIndex(std::array{"X", "Y", "Z"}[static_cast<std::size_t>(i)])] = 1;
    slope.col(i) = tip(one) - atZero;
  }
  const Vector3 way = slope.inverse() * (onTable - atZero);
  for (int i = 0; i < 3; ++i)
    found[*machine.axisIndex(std::array{"X", "Y", "Z"}[static_cast<std::size_t>(i)])] = way[i];
  return found;
}

struct World {
  MachineDescription built, truth;
  std::vector<RotaryCorrection> planted;
  Vector3 sphere;
};

World planted(Dice& dice, const std::string& machine, double place, double degrees) {
  World world{.built = *machine::readMachine(machine), .truth = {}, .planted = {}, .sphere = {}};
  for (std::size_t axis = 0; axis < world.built.axes.size(); ++axis) {
    if (world.built.axes[axis].kind == machine::AxisKind::Rotary)
      world.planted.push_back({axis, dice.within(place), dice.within(degrees)});
  }
  world.truth = machine::corrected(world.built, world.planted);
  world.sphere = Vector3(150, 80, -420) + dice.within(30);
  return world;
}

/// A series for each axis: at 0 and at each angle, the others at `others`.
std::vector<SphereSighting> sightings(const World& world, const std::vector<double>& angles, double others) {
  std::vector<SphereSighting> found;
  for (const RotaryCorrection& measured : world.planted) {
    AxisPositions axes;
    for (const RotaryCorrection& other : world.planted)
      axes[other.axis] = others;
    std::vector<double> all = {0};
    all.insert(all.end(), angles.begin(), angles.end());
    for (const double angle : all) {
      axes[measured.axis] = angle;
      found.push_back({reaching(world.truth, world.sphere, axes), ball});
    }
  }
  return found;
}

ChainFitTask taskOf(const World& world, bool tilt) {
  ChainFitTask task{.built = world.built,
                    .believed = {},
                    .reference = {},
                    .free = {},
                    .tipDeviation = {},
                    .sphere = {},
                    .shift = false,
                    .beforeShift = {}};
  for (const RotaryCorrection& each : world.planted) {
    task.believed.push_back({.axis = each.axis});
    task.free.push_back({.axis = each.axis, .tilt = tilt});
  }
  return task;
}

/// How far a line of the description is from that of another one, and how far its direction.
void expectSameAxes(const MachineDescription& a, const MachineDescription& b) {
  for (auto chain : {&MachineDescription::tableChain, &MachineDescription::spindleChain}) {
    for (std::size_t i = 0; i < (a.*chain).size(); ++i) {
      const auto& first = (a.*chain)[i];
      const auto& second = (b.*chain)[i];
      if (a.axes[*first.axis].kind != machine::AxisKind::Rotary) continue;
      EXPECT_LT(first.direction.cross(second.direction).norm(), 1e-8) << a.axes[*first.axis].name;
      EXPECT_LT(second.direction.cross(first.point - second.point).norm(), 1e-6) << a.axes[*first.axis].name;
    }
  }
}

class OnEveryBuild : public ::testing::TestWithParam<const char*> {};

TEST_P(OnEveryBuild, PlantedPlacesAndDirectionsAreFound) {
  Dice dice(41);
  for (int at = 0; at < 20; ++at) {
    SCOPED_TRACE(at);
    World world = planted(dice, GetParam(), 0.3, 0.05);
    if (world.built.name.find("4-axis") != std::string::npos) world.sphere += Vector3(0, 100, -300);
    const auto found = sightings(world, {-90, -30, 45, 80}, 40);
    const auto fit = fitChain(taskOf(world, true), found);
    ASSERT_TRUE(fit) << format(fit.error());
    EXPECT_TRUE(fit->undetermined.empty()) << fit->undetermined.front();
    EXPECT_LT(fit->rms, 1e-8);
    // Each sighting tells three coordinates; of each axis place and direction are found, two numbers each, and the
    // sphere's three.
    EXPECT_EQ(fit->degreesOfFreedom, static_cast<int>(3 * found.size() - 4 * world.planted.size() - 3));
    EXPECT_EQ(fit->residuals.size(), found.size());
    expectSameAxes(fit->machine, world.truth);
    // A second fit finds nothing more.
    ChainFitTask again = taskOf(world, true);
    again.believed = fit->corrections;
    const auto second = fitChain(again, found);
    ASSERT_TRUE(second);
    for (std::size_t i = 0; i < second->corrections.size(); ++i) {
      EXPECT_LT((second->corrections[i].position - fit->corrections[i].position).norm(), 1e-7);
      EXPECT_LT((second->corrections[i].orientation - fit->corrections[i].orientation).norm(), 1e-7);
    }
  }
}

/// The sphere turns about the axes of the table, the ball about those of the head: as far away as it is from them.
TEST_P(OnEveryBuild, CirclesAreAsWideAsTheSphereIsAway) {
  Dice dice(42);
  const World world = planted(dice, GetParam(), 0.3, 0.05);
  const SphereSighting sighting{reaching(world.truth, world.sphere, {}), ball};
  for (const auto chain : {&MachineDescription::tableChain, &MachineDescription::spindleChain}) {
    for (const auto& link : world.truth.*chain) {
      if (!link.axis || world.truth.axes[*link.axis].kind != machine::AxisKind::Rotary) continue;
      const Vector3 place = chain == &MachineDescription::tableChain
                                ? world.sphere
                                : Vector3(machine::baseFromSpindle(world.truth, {}) * ball);
      EXPECT_NEAR(radiusAbout(world.truth, sighting, *link.axis),
                  link.direction.normalized().cross(place - link.point).norm(), 1e-9)
          << world.truth.axes[*link.axis].name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Machines, OnEveryBuild,
                         ::testing::Values("mill5-table-table", "mill5-head-table", "mill5-head-head", "mill4-table"));

/// A trunnion whose errors and readings were computed by hand: positions alone, and with directions.
TEST(ChainFit, FindsTheTrunnionOfTheWorkedExample) {
  MachineDescription built = *machine::readMachine("mill5-table-table");
  const std::size_t a = *built.axisIndex("A"), c = *built.axisIndex("C");
  built.tableChain[0].point = {0, 0, -50};
  constexpr double second = 1.0 / 3600;
  const std::vector<RotaryCorrection> planted = {{a, {0, 0.015, -0.025}, {0, 8 * second, -5 * second}},
                                                 {c, {0.020, -0.010, 0}, {6 * second, -10 * second, 0}}};
  const struct {
    double a, c;
    Vector3 reading;
  } rows[] = {{0, 0, {200, 30, 60}},
              {-90, 0, {199.993501, -110.022605, -20.042909}},
              {-30, 0, {199.998579, -29.034256, 60.253330}},
              {30, 0, {200.000083, 80.998501, 30.263482}},
              {90, 0, {199.996510, 110.042909, -80.022605}},
              {0, 90, {30.028837, -199.994654, 59.985069}},
              {0, 180, {-199.965817, -30.023490, 59.978863}},
              {0, 270, {-29.994654, 199.971164, 59.993794}}};
  std::vector<SphereSighting> found;
  for (const auto& row : rows) {
    AxisPositions axes;
    axes[a] = row.a;
    axes[c] = row.c;
    for (int i = 0; i < 3; ++i)
      axes[*built.axisIndex(std::array{"X", "Y", "Z"}[static_cast<std::size_t>(i)])] = row.reading[i];
    found.push_back({axes, Vector3::Zero()});
  }
  ChainFitTask task{.built = built,
                    .believed = {{.axis = a}, {.axis = c}},
                    .reference = {},
                    .free = {{.axis = a, .tilt = true}, {.axis = c, .tilt = true}},
                    .tipDeviation = {},
                    .sphere = {},
                    .shift = false,
                    .beforeShift = {}};
  const auto fit = fitChain(task, found);
  ASSERT_TRUE(fit);
  for (std::size_t i = 0; i < 2; ++i) {
    // Readings have six decimals.
    EXPECT_LT((fit->corrections[i].position - planted[i].position).norm(), 4e-6);
    EXPECT_LT((fit->corrections[i].orientation - planted[i].orientation).norm(), 2e-6);
  }
  const std::vector<std::vector<SphereSighting>> series = {{found[0], found[1], found[2], found[3], found[4]},
                                                           {found[0], found[5], found[6], found[7]}};
  const std::vector<double> quality = valuations(task, series);
  EXPECT_NEAR(quality[0], 2 * (2 - 2 * std::cos(std::numbers::pi / 2)) + 2 * (2 - std::sqrt(3)), 1e-3);
  EXPECT_NEAR(quality[1], 8, 1e-3);
}

/// Of a single axis the positions count from the first one, wherever that is: the sum of 2 - 2 cos of the angles
/// between.
TEST(ChainFit, ValuesASingleAxisByTheAnglesFromItsFirstPosition) {
  Dice dice(48);
  const World world = planted(dice, "mill4-table", 0, 0);
  std::vector<SphereSighting> series;
  for (const double angle : {40.0, 70.0, 130.0, 250.0}) {
    AxisPositions axes;
    axes[world.planted[0].axis] = angle;
    series.push_back({reaching(world.truth, world.sphere, axes), ball});
  }
  const auto apart = [](double degrees) { return 2 - 2 * std::cos(degrees * std::numbers::pi / 180); };
  EXPECT_NEAR(valuations(taskOf(world, false), {&series, 1}).at(0), apart(30) + apart(90) + apart(210), 1e-5);
}

/// Axes that turn together: an axis is worth what the less certain of the two coordinates of its place is, whatever
/// directions these have.
TEST(ChainFit, ValuesAnAxisByTheDirectionThatIsKnownLeast) {
  Dice dice(47);
  const World world = planted(dice, "mill5-table-table", 0, 0);
  const ChainFitTask task = taskOf(world, false);
  std::vector<SphereSighting> series;
  for (const auto& [first, second] : {std::pair(0.0, 0.0), {20.0, 10.0}, {50.0, 15.0}, {35.0, 60.0}, {10.0, 80.0}}) {
    AxisPositions axes;
    axes[world.planted[0].axis] = first;
    axes[world.planted[1].axis] = second;
    series.push_back({reaching(world.truth, world.sphere, axes), ball});
  }
  const auto apart = [&](const std::vector<RotaryCorrection>& corrections) {
    const MachineDescription machine = machine::corrected(world.built, corrections);
    Eigen::VectorXd values(3 * static_cast<Eigen::Index>(series.size() - 1));
    for (std::size_t i = 1; i < series.size(); ++i)
      values.segment<3>(3 * static_cast<Eigen::Index>(i - 1)) =
          seen(task, machine, series[i]) - seen(task, machine, series[0]);
    return values;
  };
  // Two directions across each axis, not along those of the machine.
  constexpr double step = 1e-3;
  Eigen::MatrixXd slopes(3 * static_cast<Eigen::Index>(series.size() - 1), 4);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    Vector3 along = Vector3::Zero();
    for (const auto& link : world.built.tableChain)
      if (link.axis == world.planted[axis].axis) along = link.direction;
    const Vector3 one = along.cross(Vector3(1, 2, 4)).normalized(), other = along.cross(one);
    for (const auto& [column, way] : {std::pair(0, one), {1, other}}) {
      std::vector<RotaryCorrection> further = {{.axis = world.planted[0].axis}, {.axis = world.planted[1].axis}};
      std::vector<RotaryCorrection> nearer = further;
      further[axis].position = step * way;
      nearer[axis].position = -step * way;
      slopes.col(2 * static_cast<Eigen::Index>(axis) + column) = (apart(further) - apart(nearer)) / (2 * step);
    }
  }
  const Eigen::Matrix4d inverse = Eigen::Matrix4d(slopes.transpose() * slopes).inverse();
  const std::vector<double> values = valuations(task, {&series, 1});
  ASSERT_EQ(values.size(), 2U);
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    const Eigen::Matrix2d block = inverse.block<2, 2>(2 * axis, 2 * axis);
    const Eigen::Vector2d variances = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(block).eigenvalues();
    EXPECT_GT(variances[1], 1.2 * variances[0]) << "the two coordinates are known unlike well";
    EXPECT_NEAR(values[static_cast<std::size_t>(axis)], 1 / variances[1], 1e-5 / variances[1]);
  }
}

/// A fork head whose outer axis was measured with the tool upright: the ball stands on its axis.
TEST(ChainFit, NamesADirectionThatThePositionsLeaveOpen) {
  Dice dice(43);
  const World world = planted(dice, "mill5-head-head", 0.1, 0);
  const auto fit = fitChain(taskOf(world, true), sightings(world, {-90, -30, 45, 80}, 0));
  ASSERT_TRUE(fit) << format(fit.error());
  ASSERT_EQ(fit->undetermined.size(), 1u);
  // C's own: where the other axis of the head turned, C stood still.
  EXPECT_TRUE(fit->undetermined.front().starts_with("5 positions over 170 degrees with the sphere "))
      << fit->undetermined.front();
  EXPECT_TRUE(fit->undetermined.front().ends_with("from the axis leave the direction of C open"))
      << fit->undetermined.front();
  EXPECT_LT(fit->rms, 1e-8);
}

TEST(ChainFit, RefusesPositionsThatLeaveThePlaceOpen) {
  Dice dice(44);
  const World world = planted(dice, "mill5-head-table", 0.1, 0);
  const auto fit = fitChain(taskOf(world, false), sightings(world, {0.01}, 0));
  ASSERT_FALSE(fit);
  EXPECT_NE(fit.error().message.find("leave the place of"), std::string::npos) << fit.error().message;
}

/// A head that hangs elsewhere on its interface: with the shift turning with C, the sphere stays where it was at every
/// angle of it.
TEST(ChainFit, FindsAShiftThatTurnsWithTheAxisBeforeIt) {
  Dice dice(45);
  for (int at = 0; at < 20; ++at) {
    const MachineDescription built = *machine::readMachine("mill5-head-head");
    const std::size_t a = *built.axisIndex("A"), c = *built.axisIndex("C");
    const Vector3 hangs = dice.within(0.4), pivot = Vector3(0, dice.between(-0.2, 0.2), dice.between(-0.2, 0.2));
    // The nose and A are elsewhere; that of a mill whose nose is at its place is C elsewhere, and a constant.
    const std::vector<RotaryCorrection> truth = {{.axis = a, .position = pivot}, {.axis = c, .position = -hangs}};
    const MachineDescription real = machine::corrected(built, truth);
    const Vector3 sphere(100, 50, -600);
    std::vector<SphereSighting> found;
    for (const double angle : {0.0, -90.0, -45.0, 60.0}) {
      AxisPositions axes;
      axes[a] = angle;
      found.push_back({reaching(real, sphere - hangs, axes), ball});
    }
    const ChainFitTask task{.built = built,
                            .believed = {{.axis = a}, {.axis = c}},
                            .reference = {},
                            .free = {{.axis = a}},
                            .tipDeviation = {},
                            .sphere = sphere,
                            .shift = true,
                            .beforeShift = {c}};
    const auto fit = fitChain(task, found);
    ASSERT_TRUE(fit) << format(fit.error());
    EXPECT_LT((fit->shift - hangs).norm(), 1e-7);
    for (const double turn : {0.0, 90.0, 200.0}) {
      AxisPositions axes;
      axes[c] = turn;
      axes[a] = 30;
      const SphereSighting other{reaching(real, sphere - hangs, axes), ball};
      EXPECT_LT((seen(task, fit->machine, other) + fit->shift - sphere).norm(), 1e-6);
    }
  }
}

}  // namespace
}  // namespace probewright::kinematics
