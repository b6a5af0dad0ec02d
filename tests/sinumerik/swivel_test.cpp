#include "execution/sinumerik/swivel.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <random>

#include "machine/rotary_solver.hpp"
#include "sinumerik/world.hpp"

/// CYCLE800 on machines of every build: the tool stands square to the plane, and the plane lies where it was asked for.
namespace probewright::language::sinumerik {

using namespace execution;
using namespace execution::sinumerik;
namespace {

TEST(Swivel, AnglesTurnAboutTheAxesInTheOrderOfTheMode) {
  // 57: X, then the new Y, then the new Z.
  const Matrix3 expected =
      (rotation(Vector3::UnitX(), 10) * rotation(Vector3::UnitY(), 20) * rotation(Vector3::UnitZ(), 30)).linear();
  EXPECT_LT((*swivelRotation(57, {10, 20, 30}) - expected).norm(), 1e-12);
  // 27: Z, then Y, then X.
  const Matrix3 other =
      (rotation(Vector3::UnitZ(), 10) * rotation(Vector3::UnitY(), 20) * rotation(Vector3::UnitX(), 30)).linear();
  EXPECT_LT((*swivelRotation(27, {10, 20, 30}) - other).norm(), 1e-12);
  EXPECT_FALSE(swivelRotation(192, {10, 20, 0}));
}

TEST(Swivel, TheToolStandsSquareToThePlane) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> angle(-25, 25);
  for (const char* name : {"mill5-table-table", "mill5-head-table", "mill5-head-head"}) {
    for (int i = 0; i < 20; ++i) {
      World world(name);
      world.control.data.load({"$P_UIFR", {1, "X", "TR"}}, 100.0);
      world.control.data.load({"$P_UIFR", {1, "Z", "TR"}}, -300.0);
      world.control.data.load({"$P_UIFR", {1, "Z", "RT"}}, angle(random));
      const double a = angle(random), b = angle(random);
      world.run(fmt::format("T2 M6\nG54\nCYCLE800(0,\"\",0,57,10,20,30,{},{},0,0,0,0,-1)\n", a, b));
      // Square: the tool axis is the plane's own Z.
      EXPECT_LT((world.control.channel.toolAxis() - ProgramWay(0, 0, 1)).norm(), 1e-9)
          << name << " A" << a << " B" << b;
      // The frame is the settable one, then the reference point, then the rotation.
      const Eigen::Affine3d expected = control::sinumerik::transform(world.control.data.frame("$P_UIFR", {1})) *
                                       Eigen::Translation3d(10, 20, 30) *
                                       Eigen::Affine3d(rotation(Vector3::UnitX(), a) * rotation(Vector3::UnitY(), b));
      EXPECT_LT((world.control.machineFromWorkpiece().matrix() - expected.matrix()).norm(), 1e-9) << name;
    }
  }
}

/// Mode 192: the angles are those of the rotary axes, counted from the zero offset as all that the program says.
TEST(Swivel, AnglesOfAxesCountFromTheZeroOffset) {
  World world("mill5-table-table");
  const machine::MachineDescription& machine = world.machine.description();
  world.control.data.load({"$P_UIFR", {1, "C", "TR"}}, 25.0);
  world.run("T2 M6\nG54\nCYCLE800(0,\"\",0,192,0,0,0,10,20,0,0,0,0,-1)\n");
  EXPECT_NEAR(world.machine.position()[*machine.axisIndex("A")], 10, 1e-9);
  EXPECT_NEAR(world.machine.position()[*machine.axisIndex("C")], 45, 1e-9);
  EXPECT_LT((world.control.channel.toolAxis() - ProgramWay(0, 0, 1)).norm(), 1e-9);
}

/// _FR = 1 retracts Z, 2 also X and Y, to where the data set says; without an entry to the end of Z and to where tools
/// are changed.
TEST(Swivel, RetractsToThePositionsOfTheDataSet) {
  const auto standsAfter = [](int retract, bool entered) {
    World world("mill5-table-table");
    if (entered) {
      world.control.data.load({"$TC_CARR38", {1}}, -111.0);
      world.control.data.load({"$TC_CARR39", {1}}, 77.0);
      world.control.data.load({"$TC_CARR40", {1}}, -42.5);
    }
    world.run(fmt::format("T2 M6\nG0 X-10 Y-20\nCYCLE800({},\"\",0,57,0,0,0,10,0,0,0,0,0,-1)\n", retract));
    const auto axes = world.control.channel.axes();
    const machine::MachineDescription& machine = world.control.channel.description();
    return std::array{axes[*machine.axisIndex("X")], axes[*machine.axisIndex("Y")], axes[*machine.axisIndex("Z")]};
  };
  const machine::MachineDescription machine = *machine::readMachine("mill5-table-table");
  const std::size_t x = *machine.axisIndex("X"), y = *machine.axisIndex("Y"), z = *machine.axisIndex("Z");
  const auto onlyZ = standsAfter(1, true), stayed = standsAfter(0, true);
  EXPECT_EQ(onlyZ, (std::array{stayed[0], stayed[1], -42.5}));
  EXPECT_EQ(standsAfter(2, true), (std::array{-111.0, 77.0, -42.5}));
  EXPECT_EQ(standsAfter(2, false), (std::array{machine.toolChange[x], machine.toolChange[y], machine.axes[z].maximum}));
  EXPECT_NE(stayed[2], -42.5);
}

/// A call without a name means the data set that was used last.
TEST(Swivel, KeepsToTheDataSetThatWasUsedLast) {
  World world("mill5-table-table");
  auto& data = world.control.data;
  for (int parameter = 1; parameter <= 65; ++parameter) {
    const std::string name = fmt::format("$TC_CARR{}", parameter);
    if (parameter == 23)
      data.load({name, {2}}, data.text(name, {1}));
    else if (parameter != 34)
      data.load({name, {2}}, data.number(name, {1}, 0));
  }
  data.load({"$TC_CARR34", {1}}, std::string("ONE"));
  data.load({"$TC_CARR34", {2}}, std::string("TWO"));
  data.load({"$TC_CARR40", {1}}, -42.5);
  data.load({"$TC_CARR40", {2}}, -33.0);
  const std::size_t z = *world.control.channel.description().axisIndex("Z");
  for (const auto& [name, height] : {std::pair("", -42.5), {"TWO", -33.0}, {"", -33.0}, {"ONE", -42.5}, {"", -42.5}}) {
    world.run(fmt::format("T2 M6\nG0 Z0\nCYCLE800(1,\"{}\",0,57,0,0,0,10,0,0,0,0,0,-1)\n", name));
    EXPECT_EQ(world.control.channel.axes()[z], height) << name;
  }
}

/// _FR = 4 and 5 retract along the tool, however the head has turned it: 5 by _FR_I, 4 until the first linear axis
/// ends.
TEST(Swivel, RetractsAlongTheToolOfATurnedHead) {
  for (const char* name : {"mill5-head-head", "mill5-head-table", "mill5-table-table"}) {
    for (const char* plane : {"", "CYCLE800(0,\"\",0,57,0,0,0,20,10,0,0,0,0,1)\n"}) {
      const auto wayOf = [&](const char* retraction) {
        World world(name);
        const std::string before = fmt::format("T2 M6\nSUPA G0 X0 Y0 Z-200 D0\nD1\n{}", plane);
        world.run(before);
        const machine::MachineDescription machine = world.control.channel.description();
        const machine::AxisPositions from = world.control.channel.axes();
        const Vector3 tool = machine::baseFromSpindle(machine, from).linear() * Vector3::UnitZ();
        world.run(fmt::format("CYCLE800({})\n", retraction));
        const machine::AxisPositions to = world.control.channel.axes();
        Vector3 way;
        double room = std::numeric_limits<double>::infinity();  // to the first end of a travel
        for (int i = 0; i < 3; ++i) {
          const std::size_t axis = *machine.axisIndex(std::string("XYZ").substr(static_cast<std::size_t>(i), 1));
          way[i] = to[axis] - from[axis];
          const double end = tool[i] > 0 ? machine.axes[axis].maximum : machine.axes[axis].minimum;
          if (std::abs(tool[i]) > 1e-9) room = std::min(room, (end - from[axis]) / tool[i]);
        }
        return std::tuple(way, tool, room);
      };
      const auto [by, tool, room] = wayOf("5,\"\",0,57,0,0,0,20,10,0,0,0,0,0,30");
      EXPECT_LT((by - 30 * tool).norm(), 1e-9) << name << plane << by.transpose();
      const auto [whole, toolOfWhole, roomOfWhole] = wayOf("4,\"\",0,57,0,0,0,20,10,0,0,0,0,0");
      EXPECT_LT((whole - roomOfWhole * toolOfWhole).norm(), 1e-9) << name << plane << whole.transpose();
      EXPECT_GT(roomOfWhole, 50);
    }
  }
}

/// Two rotary axes point the tool in a direction in two ways. That of which the direction was made is one; the other
/// mirrors the tilting axis about the position where both meet.
TEST(Swivel, BothPosturesOfADirectionAreFound) {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> tilt(1, 85), turn(-179, 179);
  for (const char* name : {"mill5-table-table", "mill5-head-table", "mill5-head-head"}) {
    const machine::MachineDescription machine = *machine::readMachine(name);
    const std::size_t tilting = machine::tiltingAxis(machine, Vector3::UnitZ())->axis;
    const std::size_t turning = *machine.axisIndex("C");
    for (int i = 0; i < 100; ++i) {
      machine::AxisPositions planted, reference, now;
      planted[tilting] = tilt(random) * (i % 2 == 0 ? 1 : -1);
      planted[turning] = turn(random);
      reference[turning] = turn(random);
      now[turning] = turn(random);
      const Vector3 direction = machine::toolOrientation(machine, reference, planted) * Vector3::UnitZ();
      const auto found = toolPostures(machine, reference, now, direction);
      ASSERT_EQ(found.size(), 2u) << name << direction.transpose();
      const std::size_t same = found[0][tilting] * planted[tilting] > 0 ? 0 : 1;
      EXPECT_NEAR(found[same][tilting], planted[tilting], 1e-9) << name;
      EXPECT_NEAR(normalizedDegrees(found[same][turning] - planted[turning]), 0, 1e-9) << name;
      EXPECT_NEAR(found[1 - same][tilting], -planted[tilting], 1e-9) << name;
      EXPECT_NEAR(std::abs(normalizedDegrees(found[1 - same][turning] - planted[turning])), 180, 1e-9) << name;
    }
  }
}

/// Along the axis that turns the workpiece or the head there is one posture, and that axis need not move.
TEST(Swivel, AnAxisThatDoesNotMatterStaysWhereItIs) {
  for (const char* name : {"mill5-table-table", "mill5-head-table", "mill5-head-head"}) {
    const machine::MachineDescription machine = *machine::readMachine(name);
    machine::AxisPositions now;
    now[*machine.axisIndex("C")] = 77;
    const auto found = toolPostures(machine, {}, now, Vector3::UnitZ());
    ASSERT_EQ(found.size(), 1u) << name;
    for (std::size_t axis = 0; axis < machine.axes.size(); ++axis)
      EXPECT_EQ(found[0][axis], now[axis]) << name;
  }
}

TEST(Swivel, DirectionPicksThePosture) {
  for (const char* name : {"mill5-table-table", "mill5-head-table", "mill5-head-head"}) {
    World smaller(name), larger(name);
    smaller.run("CYCLE800(0,\"\",0,57,0,0,0,20,0,0,0,0,0,-1)\n");
    larger.run("CYCLE800(0,\"\",0,57,0,0,0,20,0,0,0,0,0,1)\n");
    // The axis that tilts is not C, which turns half round from one posture to the other.
    const auto& axes = smaller.machine.description().axes;
    const auto tilting = static_cast<std::size_t>(
        std::ranges::find_if(
            axes,
            [](const machine::Axis& axis) { return axis.kind == machine::AxisKind::Rotary && axis.name != "C"; }) -
        axes.begin());
    ASSERT_LT(tilting, axes.size()) << name;
    const double a = smaller.machine.position()[tilting], b = larger.machine.position()[tilting];
    EXPECT_NEAR(std::abs(a), 20, 1e-9) << name;
    EXPECT_NEAR(std::abs(b), 20, 1e-9) << name;
    EXPECT_LT(a, b) << name;
  }
}

/// The axis that tilts need not be the first one of the machine, nor read 0 where the tool stands along the other: the
/// two postures lie on both sides of there, as far as the plane leans against the other axis, also where that turns by
/// the same amount in both.
TEST(Swivel, DirectionPicksByTheAxisThatTiltsWhereverItStandsInTheList) {
  const auto axis = [](const char* name, const char* kind, double from, double to) {
    return fmt::format("[[axis]]\nname = \"{}\"\nkind = \"{}\"\nminimum = {}\nmaximum = {}\n", name, kind, from, to);
  };
  const auto element = [](const char* chain, const char* name, const Vector3& along) {
    return fmt::format("[[{}_chain]]\naxis = \"{}\"\ndirection = [{:.17g}, {:.17g}, {:.17g}]\n", chain, name, along.x(),
                       along.y(), along.z());
  };
  for (const double symmetry : {0.0, 30.0}) {
    for (const bool tiltsFirst : {true, false}) {
      const std::string a = axis("A", "rotary", -120, 120), c = axis("C", "rotary", -360, 360);
      const Vector3 turning = -(rotation(Vector3::UnitX(), symmetry) * Vector3::UnitZ());
      const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "tilts.toml";
      std::ofstream(file) << "name = \"M\"\n"
                          << axis("X", "linear", -500, 500) << axis("Y", "linear", -500, 500)
                          << axis("Z", "linear", -500, 500) << (tiltsFirst ? a + c : c + a)
                          << element("table", "A", -Vector3::UnitX()) << element("table", "C", turning)
                          << element("spindle", "X", Vector3::UnitX()) << element("spindle", "Y", Vector3::UnitY())
                          << element("spindle", "Z", Vector3::UnitZ());
      for (const auto& [plane, about] : {std::pair("20,0", Vector3(Vector3::UnitX())), {"0,20", Vector3::UnitY()}}) {
        SCOPED_TRACE(fmt::format("symmetry {}, A first {}, plane {}", symmetry, tiltsFirst, plane));
        const Vector3 normal = rotation(about, 20) * Vector3::UnitZ();
        const double lean = degreesFromRadians(std::acos(-turning.dot(normal)));
        const auto standsAt = [&](int direction) {
          World world(file.string());
          const std::size_t tilting = *world.machine.description().axisIndex("A");
          world.run(fmt::format("CYCLE800(0,\"\",0,57,0,0,0,{},0,0,0,0,{})\n", plane, direction));
          return world.machine.position()[tilting];
        };
        EXPECT_NEAR(standsAt(-1), symmetry - lean, 1e-6);
        EXPECT_NEAR(standsAt(1), symmetry + lean, 1e-6);
      }
    }
  }
}

TEST(Swivel, WithoutArgumentsThePlaneIsBack) {
  World world("mill5-table-table");
  world.run("CYCLE800(0,\"\",0,57,0,0,0,20,0,0,0,0,0,-1)\nCYCLE800()\n");
  EXPECT_FALSE(world.control.swivelled);
  EXPECT_TRUE(world.control.machineFromWorkpiece().isApprox(Eigen::Affine3d::Identity()));
}

TEST(Swivel, AMachineWithoutRotaryAxesRefuses) {
  World world;
  EXPECT_EQ(world.alarm("CYCLE800(0,\"\",0,57,0,0,0,20,0,0,0,0,0,-1)\n"), "62181");
}

TEST(Swivel, AxesAreSetDirectly) {
  World world("mill5-table-table");
  world.run("CYCLE800(0,\"\",0,192,0,0,0,15,40,0,0,0,0,-1)\n");
  EXPECT_LT((world.control.channel.toolAxis() - ProgramWay(0, 0, 1)).norm(), 1e-9);
}

}  // namespace
}  // namespace probewright::language::sinumerik
