#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "control/heidenhain/kinematic_tables.hpp"
#include "control/heidenhain/kinematics.hpp"
#include "machine/machine_file.hpp"
#include "truth/told.hpp"

/// Rotary axes that wander with their angle: the grid of cycle 453 against where the tip truly goes.
namespace probewright::truth::testing {
namespace {

namespace hh = control::heidenhain;

const std::string stand = "[sphere]\ndiameter = 25\nstem_diameter = 8\npose = { x = 150, y = 60, z = -420 }\n";
constexpr std::array<double, 3> b = {-60, 0, 60};
constexpr std::array<double, 4> c = {0, 90, 180, 270};

/// A control that has a compensation table for these angles, empty as yet.
class GridWorld {
public:
  GridWorld() {
    folder.put("MACHINE.KCO", [&] {
      auto table = hh::TypedTable::create("MACHINE.KCO", hh::TableUnit::Millimetre, hh::gridColumns(),
                                          control::ControlKind::TNC640, 0);
      int row = 0;
      for (const double first : b) {
        for (const double second : c) {
          const std::string key = std::to_string(row++);
          EXPECT_TRUE(table.setNumber(key, "B", first) && table.setNumber(key, "C", second));
          for (const hh::NumberColumn column : {hh::NumberColumn("DX"), hh::NumberColumn("DY"), hh::NumberColumn("DZ")})
            EXPECT_TRUE(table.setNumber(key, column, 0));
        }
      }
      return std::string(table.table().bytes());
    }());
  }

  /// Cycle 453 in a mode, with a probe that scatters, on a sphere.
  Told measured(double repeatability, const std::string& sphere, int mode = 1) const {
    folder.put("mill.toml", fmt::format(R"(seed = 453
[machine]
name = "mill5-head-table"
[control]
type = "TNC640"
tables = "."
[[preset]]
row = 1
origin = [150, 60, -420]
active = true
{}
[[tool]]
number = 2
kind = "mill"
length = 80
radius = 5
[[tool]]
number = 1
kind = "probe"
length = 150
ball_radius = 3
in_spindle = true
repeatability = {}
[[errors.axis.C.deviation]]
amplitude = 0.004
wavelength = 120
phase = 20
[[errors.axis.B.deviation]]
amplitude = 0.003
wavelength = 90
phase = 50
)",
                                        sphere, repeatability));
    Diagnostics diagnostics;
    const auto setup = setup::readSetup((folder.path() / "mill.toml").string(), diagnostics);
    EXPECT_TRUE(setup) << format(diagnostics.front());
    // Another tool comes into the spindle afterwards.
    return Told{
        setup::runText("T.H",
                       fmt::format("BEGIN PGM T MM\nTOOL CALL 1 Z\nL Z+80 R0 FMAX\nTCH PROBE 453 KINEMATICS GRID "
                                   "~\nQ406=+{} ~\nQ407=+12.5 ~\nQ320=+0 ~\nQ408=+0 ~\nQ253=+5000 ~\nQ380=+45 ~\n"
                                   "Q423=+4 ~\nQ431=+0\nL Z+100 R0 FMAX\nTOOL CALL 2 Z\nL Z+100 R0 FMAX\n"
                                   "END PGM T MM\n",
                                   mode),
                       *setup, session::RunOptions())
            .outcome};
  }

  const TableFolder folder;
};

const records::EntryTruth& gridOf(const Told& told) { return entry(told, "MACHINE.KCO"); }

TEST(CompensationGrid, IsToldByItsPositions) {
  const GridWorld world;
  const Told exact = world.measured(0, stand);
  ASSERT_TRUE(exact.finished()) << exact.why();
  const records::EntryTruth& grid = gridOf(exact);
  EXPECT_EQ(grid.kind, records::EntryKind::Kinematics);
  ASSERT_EQ(grid.values.size(), 3 * b.size() * c.size());
  EXPECT_LT(*grid.distance, 2e-5);
  // 0.004 degrees at 160 mm from the axis are 0.011 mm.
  EXPECT_GT(std::ranges::max(grid.values, {}, &records::EntryValue::value).value, 0.005);
  const Told rough = world.measured(0.003, stand);
  ASSERT_TRUE(rough.finished()) << rough.why();
  EXPECT_GT(*gridOf(rough).distance, 0.0015);
  EXPECT_LT(*gridOf(rough).distance, 0.02);
  // What all positions have in common is left out: on the table, which C turns, what is left has no mean.
  const records::EntryTruth& left = gridOf(rough);
  Vector3 sum = Vector3::Zero();
  double first = 0;
  ASSERT_EQ(left.values.size(), 3 * b.size() * c.size());
  for (std::size_t row = 0; row < b.size() * c.size(); ++row) {
    Vector3 off;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const records::EntryValue& value = left.values[3 * row + axis];
      off[static_cast<Eigen::Index>(axis)] = value.truth - value.value;
    }
    if (row == 0) first = off.norm();
    sum += rotation(-Vector3::UnitZ(), c[row % c.size()]).inverse() * off;
  }
  // What is told as true is nearer to what a perfect probe measures than what was measured.
  double told = 0, seen = 0;
  for (std::size_t i = 0; i < left.values.size(); ++i) {
    told += std::pow(left.values[i].truth - grid.values[i].value, 2);
    seen += std::pow(left.values[i].value - grid.values[i].value, 2);
  }
  EXPECT_LT(told, 0.5 * seen);
  EXPECT_GT(first, 1e-4);
  EXPECT_LT(sum.norm(), 0.01 * first) << sum.transpose();
}

/// A sphere of the part serves as well; nothing is told where nothing was written.
TEST(CompensationGrid, IsToldWhereItWasWritten) {
  const GridWorld world;
  const Told part = world.measured(
      0, "[part]\npose = { x = 150, y = 60, z = -420 }\n[[part.feature]]\nshape = \"sphere\"\ndiameter = 25\n");
  ASSERT_TRUE(part.finished()) << part.why();
  EXPECT_LT(*gridOf(part).distance, 2e-5);
  EXPECT_TRUE(world.measured(0, stand, 0).truth().entries.empty());
}

/// What the control believes beside that, of the tool's way to the axes, is part of what it sees.
TEST(CompensationGrid, CountsTheBaseOfTheKinematics) {
  const GridWorld world;
  const auto machine = machine::readMachine("mill5-head-table");
  ASSERT_TRUE(machine);
  hh::Kinematics kinematics(*machine);
  hh::KinematicData data = kinematics.data();
  data.base = {0.05, -0.03, 0.02};
  kinematics.set(data);
  world.folder.put("KINEMATIC.TAB",
                   std::string(hh::kinematicTable(kinematics, control::ControlKind::TNC640).table().bytes()));
  const Told told = world.measured(0, stand);
  ASSERT_TRUE(told.finished()) << told.why();
  EXPECT_LT(*gridOf(told).distance, 2e-5);
}

}  // namespace
}  // namespace probewright::truth::testing
