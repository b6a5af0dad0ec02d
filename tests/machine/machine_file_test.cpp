#include "machine/machine_file.hpp"
#include "support/test_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace probewright::machine {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

AxisPositions at(std::initializer_list<double> values) {
  AxisPositions positions;
  std::copy(values.begin(), values.end(), positions.values.begin());
  return positions;
}

/// Where a tool tip at `tip` (spindle frame) stands on the table.
Vector3 onTable(const MachineDescription& machine, const AxisPositions& q, const Vector3& tip) {
  return baseFromTable(machine, q).inverse() * (baseFromSpindle(machine, q) * tip);
}

MachineDescription ready(const std::string& name) {
  auto machine = readMachine(name);
  EXPECT_TRUE(machine) << format(machine.error());
  return machine.value_or(MachineDescription{});
}

TEST(ReadyMadeMachines, AreTheFiveOfTheManual) {
  EXPECT_THAT(readyMadeMachines(), ElementsAre("lathe2c", "mill3", "mill4-table", "mill5-head-head", "mill5-head-table",
                                               "mill5-table-table"));
}

TEST(ReadyMadeMachines, MoveTheToolRelativeToTheWorkpieceAlongTheAxesOfIso841) {
  for (const std::string& name : readyMadeMachines()) {
    const MachineDescription machine = ready(name);
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
      if (machine.axes[i].kind != AxisKind::Linear) continue;
      AxisPositions q;
      q[i] = 10;
      const Vector3 expected = machine.axes[i].name == "X"   ? Vector3(10, 0, -100)
                               : machine.axes[i].name == "Y" ? Vector3(0, 10, -100)
                                                             : Vector3(0, 0, -90);
      EXPECT_LT((onTable(machine, q, {0, 0, -100}) - expected).norm(), 1e-12) << name << " " << machine.axes[i].name;
    }
  }
}

TEST(ReadyMadeMachines, TurnTheToolRelativeToTheWorkpieceRightHanded) {
  for (const std::string& name : readyMadeMachines()) {
    const MachineDescription machine = ready(name);
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
      if (machine.axes[i].kind != AxisKind::Rotary) continue;
      AxisPositions q;
      q[i] = 30;
      const Vector3 axis = machine.axes[i].name == "A"   ? Vector3::UnitX()
                           : machine.axes[i].name == "B" ? Vector3::UnitY()
                                                         : Vector3::UnitZ();
      const Matrix3 turned = (baseFromTable(machine, q).inverse() * baseFromSpindle(machine, q)).linear();
      EXPECT_LT((turned - rotation(axis, 30).linear()).norm(), 1e-12) << name << " " << machine.axes[i].name;
    }
  }
}

TEST(ReadyMadeMachines, TrunnionCarriesTheTableAboutItsAxis) {
  // A90: the table has turned by -90 degrees about the line y = 0, z = -550. The point 50 mm below that line at the
  // table's middle comes to y = -50, z = -550 of the base.
  const MachineDescription machine = ready("mill5-table-table");
  const Vector3 inBase = baseFromTable(machine, at({0, 0, 0, 90, 0})) * Vector3(0, 0, -600);
  EXPECT_LT((inBase - Vector3(0, -50, -550)).norm(), 1e-12);
}

TEST(ReadyMadeMachines, StandWithinTheirTravelWhereToolsAreChanged) {
  for (const std::string& name : readyMadeMachines()) {
    const MachineDescription machine = ready(name);
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
      EXPECT_GE(machine.toolChange[i], machine.axes[i].minimum) << name;
      EXPECT_LE(machine.toolChange[i], machine.axes[i].maximum) << name;
    }
  }
}

constexpr const char* smallMachine = R"(name = "small"
[[axis]]
name = "X"
kind = "linear"
minimum = 0
maximum = 100
[[spindle_chain]]
axis = "X"
direction = [2, 0, 0]
)";

TEST(ParseMachine, ReadsASmallMachine) {
  Diagnostics diagnostics;
  const auto machine = parseMachine(smallMachine, "small.toml", diagnostics);
  ASSERT_TRUE(machine) << format(diagnostics.front());
  EXPECT_EQ(machine->axes[0].maximum, 100);
  EXPECT_EQ(machine->spindleChain[0].direction, Vector3(1, 0, 0));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto place = text.find(from);
  EXPECT_NE(place, std::string::npos);
  return text.replace(place, from.size(), to);
}

struct Mistake {
  const char *from, *to, *message;
};
void PrintTo(const Mistake& mistake, std::ostream* out) { *out << testing_support::plainWords(mistake.message); }

class MachineMistake : public testing::TestWithParam<Mistake> {};

TEST_P(MachineMistake, IsReportedWithItsPlaceAndReason) {
  Diagnostics diagnostics;
  EXPECT_FALSE(parseMachine(replaced(smallMachine, GetParam().from, GetParam().to), "small.toml", diagnostics));
  ASSERT_FALSE(diagnostics.empty());
  EXPECT_THAT(format(diagnostics.front()), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    All, MachineMistake,
    testing::Values(
        Mistake{"maximum = 100", "maximum = 100\nrapit = 5",
                "small.toml:7:1: error: unknown key \"rapit\" in [[axis]]\n    Did you mean \"rapid\"?"},
        Mistake{"maximum = 100", "maximum = -100", "small.toml:5:11: error: the travel of axis X ends before"},
        Mistake{"maximum = 100", "maximum = \"100\"",
                "small.toml:6:11: error: \"maximum\" in [[axis]] must be a number"},
        Mistake{"kind = \"linear\"", "kind = \"linera\"",
                "small.toml:4:8: error: \"kind\" cannot be \"linera\"; it must be one of linear, rotary\n    Did you "
                "mean \"linear\"?"},
        Mistake{"direction = [2, 0, 0]", "direction = [2, 0]",
                "small.toml:9:13: error: \"direction\" in [[spindle_chain]] must be a list of 3 numbers"},
        Mistake{"direction = [2, 0, 0]", "direction = [0, 0, 0]", "a direction cannot be [0, 0, 0]"},
        Mistake{"axis = \"X\"", "axis = \"Y\"", "small.toml:8:8: error: there is no axis called Y"},
        Mistake{"maximum = 100\n", "", "small.toml:2:1: error: \"maximum\" is missing in [[axis]]"},
        Mistake{"maximum = 100", "maximum = nan",
                "\"maximum\" in [[axis]] must be at least -1000000 and at most 1000000"},
        Mistake{"maximum = 100", "maximum = 1 2", "small.toml:6:13: error: this is not valid TOML"},
        Mistake{"maximum = 100", "maximum = 100\nacceleration = 0",
                "\"acceleration\" in [[axis]] must be at least 1 and at most 1000000"}));

TEST(ReadMachine, NamesEveryMistakeOfAFile) {
  Diagnostics found;
  const std::string text =
      "name = \"m\"\n[[axis]]\nname = \"X\"\nkind = \"linear\"\nmin = -400\nmax = 400\nrapid = 1e-300\n";
  EXPECT_FALSE(parseMachine(text, "m.toml", found));
  std::string all;
  for (const Diagnostic& each : found)
    all += format(each) + "\n";
  EXPECT_THAT(all, HasSubstr("m.toml:5:1: error: unknown key \"min\" in [[axis]]\n    Did you mean \"minimum\"?"))
      << all;
  EXPECT_THAT(all, HasSubstr("m.toml:6:1: error: unknown key \"max\" in [[axis]]\n    Did you mean \"maximum\"?"))
      << all;
  EXPECT_THAT(all, HasSubstr("\"rapid\" in [[axis]] must be at least 1 and at most 1000000")) << all;
}

TEST(ReadMachine, SuggestsTheNearestName) {
  const auto machine = readMachine("mill4");
  ASSERT_FALSE(machine);
  EXPECT_THAT(format(machine.error()), HasSubstr("Did you mean \"mill3\"?"));
}

}  // namespace
}  // namespace probewright::machine
