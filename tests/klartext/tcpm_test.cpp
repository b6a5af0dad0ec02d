#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "klartext/expectations.hpp"
#include "klartext/host_world.hpp"

/// FUNCTION TCPM: where the points of the tool run, from the axes of the machine and its kinematics alone.
namespace probewright::language::klartext::testing {
namespace {

constexpr double length = 50, rounding = 4;  ///< L and R2 of tool 5
constexpr double written = 2e-6;             ///< programmed coordinates, mm
constexpr double onPath = 2e-3;              ///< pieces of the path, mm

/// The point of the tool `above` its tip, in coordinates of the table as it lies when all axes read 0.
Vector3 onTable(const World& world, const machine::AxisPositions& axes, double above) {
  const auto& machine = world.machine->description();
  return machine::baseFromTable(machine, axes).inverse() *
         (machine::baseFromSpindle(machine, axes) * Vector3(0, 0, above - length));
}

Vector3 toolDirection(const World& world, const machine::AxisPositions& axes) {
  return (onTable(world, axes, 1) - onTable(world, axes, 0)).normalized();
}

/// All positions from step `first` on lie on the straight line from `from` to `to`.
void expectStraight(const World& world, std::size_t first, double above, const Vector3& from, const Vector3& to) {
  const Vector3 along = to - from;
  double last = 0;
  for (std::size_t i = first; i < world.machine->steps.size(); ++i) {
    const Vector3 point = onTable(world, world.machine->steps[i].axes, above);
    if (along.norm() < 1e-9) {
      EXPECT_NEAR((point - from).norm(), 0, 1e-9);
      continue;
    }
    const double fraction = (point - from).dot(along) / along.squaredNorm();
    EXPECT_NEAR((point - from - fraction * along).norm(), 0, onPath);
    EXPECT_GT(fraction, last - 1e-9);
    last = fraction;
  }
  EXPECT_NEAR((onTable(world, world.machine->position(), above) - to).norm(), 0, written);
}

struct Angles {
  double first, second;
};

/// A world in which tool 5 is a ball cutter in the spindle, standing at X+20 Y-30 Z-200.
World atStart(const std::string& machine) {
  World world(machine);
  EXPECT_TRUE(world.control->tables.tools.setNumber("5", "R2", rounding));
  return world;
}
const std::string toStart = "TOOL CALL 5 Z F2000\nL X+20 Y-30 Z-200 R0 FMAX\n";
const Vector3 start(20, -30, -200);

const std::string machines[] = {"mill5-table-table", "mill5-head-table", "mill5-head-head"};
/// The words of the two rotary axes of each machine.
std::string turnTo(const std::string& machine, const Angles& angles) {
  const char* first = machine == "mill5-head-table" ? "B" : "A";
  return fmt::format("{}{:+.4f} C{:+.4f}", first, angles.first, angles.second);
}

class Draw {
public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double operator()(double reach) { return std::uniform_real_distribution<double>(-reach, reach)(engine_); }

private:
  std::mt19937_64 engine_;
};

TEST(Tcpm, SpaceAnglesPointTheToolWhateverTheMachine) {
  Draw draw(1);
  for (const std::string& machine : machines) {
    for (int at = 0; at < 12; ++at) {
      SCOPED_TRACE(fmt::format("{} {}", machine, at));
      World world = atStart(machine);
      const double a = draw(40), b = draw(40), c = draw(90);
      const Vector3 to = start + Vector3(draw(30), draw(30), draw(30));
      expectFinished(world.run(toStart + "FUNCTION TCPM F TCP AXIS SPAT PATHCTRL AXIS\nFN 0: Q1 = +1\n"));
      const std::size_t before = world.machine->steps.size();
      expectFinished(
          world.run(fmt::format("FUNCTION TCPM F TCP AXIS SPAT PATHCTRL AXIS\n"
                                "L X{:+.6f} Y{:+.6f} Z{:+.6f} A{:+.6f} B{:+.6f} C{:+.6f} R0 F2000\n",
                                to.x(), to.y(), to.z(), a, b, c)));
      const auto about = [](double degrees, const Vector3& axis) {
        return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis).toRotationMatrix();
      };
      const Vector3 wanted =
          about(c, Vector3::UnitZ()) * about(b, Vector3::UnitY()) * about(a, Vector3::UnitX()) * Vector3::UnitZ();
      EXPECT_NEAR((toolDirection(world, world.machine->position()) - wanted).norm(), 0, 1e-7);
      expectStraight(world, before, 0, start, to);
      EXPECT_GT(world.machine->steps.size(), before + 3);
    }
  }
}

TEST(Tcpm, SpaceAnglesCountInTheTiltedPlaneAndKeepWhatABlockLeavesOut) {
  for (const std::string& machine : machines) {
    SCOPED_TRACE(machine);
    World world = atStart(machine);
    expectFinished(world.run(toStart +
                             "PLANE SPATIAL SPA+20 SPB+0 SPC+0 TURN FMAX\n"
                             "FUNCTION TCPM F TCP AXIS SPAT PATHCTRL AXIS\nL A+10 B+0 C+0 F2000\nL A+15\nL IA-5\n"));
    const double tilt = 30 * std::numbers::pi / 180;
    const Vector3 wanted(0, -std::sin(tilt), std::cos(tilt));
    EXPECT_NEAR((toolDirection(world, world.machine->position()) - wanted).norm(), 0, 1e-7);
  }
  // Angles of axes that a machine does not have: B of the table points the tool as A 0, C 0 want it.
  World table("mill4-table");
  expectFinished(table.run("TOOL CALL 5 Z F2000\nFUNCTION TCPM F TCP AXIS SPAT PATHCTRL AXIS\nL A+0 B+10 C+0 F2000\n"));
  const Vector3 wanted = Eigen::AngleAxisd(10 * std::numbers::pi / 180, Vector3::UnitY()) * Vector3::UnitZ();
  EXPECT_NEAR((toolDirection(table, table.machine->position()) - wanted).norm(), 0, 1e-7);
  // Where the preset turns C by 30 degrees the workpiece system lies on the table so that it is straight there.
  World turned = atStart("mill5-table-table");
  control::heidenhain::Control::PresetChange change;
  change.rotaryOffset[*turned.machine->description().axisIndex("C")] = 30;
  turned.control->writePreset(turned.control->coordinates.preset.row, change);
  expectFinished(turned.run(toStart + "FUNCTION TCPM F TCP AXIS SPAT PATHCTRL AXIS\nL A+20 B+10 C+0 F2000\n"));
  machine::AxisPositions straight;
  straight[*turned.machine->description().axisIndex("C")] = 30;
  const Vector3 leaning = Eigen::AngleAxisd(10 * std::numbers::pi / 180, Vector3::UnitY()) *
                          (Eigen::AngleAxisd(20 * std::numbers::pi / 180, Vector3::UnitX()) * Vector3::UnitZ());
  const Vector3 onTurnedTable =
      machine::baseFromTable(turned.machine->description(), straight).linear().transpose() * leaning;
  EXPECT_NEAR((toolDirection(turned, turned.machine->position()) - onTurnedTable).norm(), 0, 1e-7);
  // Axes that do not reach: A of the trunnion ends at 120 degrees.
  World world = atStart("mill5-table-table");
  const RunResult result = world.run(toStart + "FUNCTION TCPM F TCP AXIS SPAT PATHCTRL AXIS\nL A+130 B+0 C+0 F2000\n");
  ASSERT_EQ(result.end, RunEnd::Alarm);
  EXPECT_EQ(result.diagnostics.front().code, "Entered angle not permitted");
}

TEST(Tcpm, TurnsTheToolAboutTheReferencePoint) {
  struct Case {
    const char* point;
    double named, still;  ///< above the tip
  };
  Draw draw(2);
  for (const Case& one :
       {Case{"TIP-TIP", 0, 0}, Case{"TIP-CENTER", 0, rounding}, Case{"CENTER-CENTER", rounding, rounding}}) {
    for (const std::string& machine : machines) {
      for (int at = 0; at < 6; ++at) {
        SCOPED_TRACE(fmt::format("{} {} {}", one.point, machine, at));
        World world = atStart(machine);
        const std::string tcpm = fmt::format("FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS REFPNT {}\n", one.point);
        // The named point goes to the programmed place.
        expectFinished(world.run("TOOL CALL 5 Z F2000\n" + tcpm + "L X+20 Y-30 Z-200 R0 FMAX\n"));
        EXPECT_NEAR((onTable(world, world.machine->position(), one.named) - start).norm(), 0, 1e-9);

        // Rotary axes alone: the other point stays where it is.
        const Vector3 still = onTable(world, world.machine->position(), one.still);
        std::size_t before = world.machine->steps.size();
        expectFinished(world.run(tcpm + "L " + turnTo(machine, {draw(40), draw(90)}) + " R0 F2000\n"));
        EXPECT_GT(world.machine->steps.size(), before + 1);
        expectStraight(world, before, one.still, still, still);

        // All together: it runs straight to where the programmed place of the named point has it.
        before = world.machine->steps.size();
        const Vector3 to = start + Vector3(draw(30), draw(30), draw(30));
        expectFinished(world.run(tcpm + fmt::format("L X{:+.6f} Y{:+.6f} Z{:+.6f} {} R0 F2000\n", to.x(), to.y(),
                                                    to.z(), turnTo(machine, {draw(40), draw(90)}))));
        const machine::AxisPositions end = world.machine->position();
        EXPECT_NEAR((onTable(world, end, one.named) - to).norm(), 0, written);
        expectStraight(world, before, one.still, still, onTable(world, end, one.still));
      }
    }
  }
}

TEST(Tcpm, EndsWithM129AndFollowsTheOversizeOfTheToolCall) {
  World world = atStart("mill5-table-table");
  const std::string tcpm = "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS REFPNT CENTER-CENTER\n";
  expectFinished(world.run(tcpm + "TOOL CALL 5 Z F2000 DR2+0.5\nL X+20 Y-30 Z-200 R0 FMAX\n"));
  EXPECT_NEAR((onTable(world, world.machine->position(), rounding + 0.5) - start).norm(), 0, 1e-9);
  for (const char* end : {"M129\n", "FUNCTION RESET TCPM\n", "M128\n"}) {
    SCOPED_TRACE(end);
    expectFinished(world.run(tcpm + end + "L X+20 Y-30 Z-200 R0 FMAX\n"));
    EXPECT_NEAR((onTable(world, world.machine->position(), 0) - start).norm(), 0, 1e-9);
  }
}

}  // namespace
}  // namespace probewright::language::klartext::testing
