#include "machine/rotary_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "machine/machine_file.hpp"

/// Which of the turns of a rotary axis is taken.
namespace probewright::machine {
namespace {

TEST(RotarySolver, TakesTheTurnThatIsNearestToWhereTheAxisStands) {
  const auto machine = readMachine("mill5-head-table");
  ASSERT_TRUE(machine) << format(machine.error());
  const auto c = machine->axisIndex("C");
  ASSERT_TRUE(c && machine->axes[*c].modulo) << "C turns without an end";
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> turns(-12, 12), angles(-180, 180);
  AxisPositions zero{};
  int tilted = 0;
  for (int i = 0; i < 200; ++i) {
    AxisPositions now{};
    now[*c] = 360 * turns(random);
    const double angle = angles(random), lean = radiansFromDegrees(30);
    const Vector3 direction(std::sin(lean) * std::cos(angle), std::sin(lean) * std::sin(angle), std::cos(lean));
    const auto fromZero = solveRotaryAxes(*machine, direction, Vector3::UnitZ(), zero, zero);
    const auto fromNow = solveRotaryAxes(*machine, direction, Vector3::UnitZ(), zero, now);
    ASSERT_EQ(fromZero.size(), fromNow.size());
    for (std::size_t k = 0; k < fromNow.size(); ++k, ++tilted) {
      EXPECT_LE(std::abs(fromNow[k][*c] - now[*c]), 180 + 1e-9) << "from " << now[*c];
      EXPECT_NEAR(std::remainder(fromNow[k][*c] - fromZero[k][*c], 360), 0, 1e-9);
    }
    const auto aligned = alignedAngle(*machine, *c, Vector3::UnitX(), direction, zero, now);
    ASSERT_TRUE(aligned);
    EXPECT_LE(std::abs(*aligned - now[*c]), 180 + 1e-9) << "from " << now[*c];
  }
  EXPECT_GT(tilted, 200);
}

}  // namespace
}  // namespace probewright::machine
