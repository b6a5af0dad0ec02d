#include <gmock/gmock.h>

#include "control/heidenhain/compensation_grid.hpp"
#include "cycles_kinematics/sphere_worlds.hpp"

/// What cycles 452 and 453 refuse, each refusal once; and what 451 measures all the same. (451 itself: see
/// measuring_habits_test.cpp, 450: saved_kinematics_test.cpp.)
namespace probewright::testing_support {
namespace {

using testing::HasSubstr;

using Parameters = std::map<std::string, double>;

std::string cycle(int number, const Build& build, const Words& changes = {}) {
  Words words = words451(build, number == 453 ? 0 : 1);
  std::erase_if(words, [&](const auto& word) {
    const bool angles = word.first >= 411 && word.first <= 422;
    if (number == 453) return angles || word.first == 432;
    return number == 452 && (word.first == 406 || word.first == 431);
  });
  return probe(number, with(words, changes));
}

/// A table of two positions of B, for 453.
constexpr const char* twoPositions =
    "BEGIN GRID.KCO MM\n"
    "NR    B         DX        DY        DZ\n"
    "0     -45       0         0         0\n"
    "1     45        0         0         0\n"
    "[END]\n";

struct Refusing {
  explicit Refusing(std::size_t build = 1, ControlKind kind = ControlKind::TNC640)
      : world(builds()[build], kind), folder(world.bench) {
    if (kind == ControlKind::TNC640 && build == 1) folder.put("GRID.KCO", twoPositions);
  }
  Ran run(int number, const Words& changes = {}, const std::string& before = {}, const Parameters& parameters = {}) {
    Bench bench = world.bench;
    for (const auto& [name, value] : parameters)
      bench.setup.beliefs.parameters[name] = {value, {}};
    return bench.run(before + cycle(number, world.build, changes));
  }
  std::string alarm(int number, const Words& changes = {}, const std::string& before = {},
                    const Parameters& parameters = {}) {
    const Ran ran = run(number, changes, before, parameters);
    return ran.alarm();
  }
  SphereWorld world;
  TableFolder folder;
};

TEST(KinematicsRefusals, OfCycles452And453) {
  for (const int number : {452, 453}) {
    SCOPED_TRACE(number);
    Refusing refusing;
    EXPECT_EQ(refusing.alarm(number), "");
    EXPECT_EQ(refusing.alarm(number, {{407, 12.6}}), "Calibration sphere radius wrong");
    EXPECT_EQ(refusing.alarm(number, {{407, 12.55}}, "", {{"maxDevCalBall", 0.1}}), "");
    EXPECT_EQ(refusing.alarm(number, {}, "", {{"option48", 0}}), "Function not enabled");
    EXPECT_EQ(refusing.alarm(number, {}, "M128\n"), "TCPM not permitted");
    EXPECT_EQ(refusing.alarm(number, {}, "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS\n"), "TCPM not permitted");
    EXPECT_EQ(refusing.alarm(number, {}, "", {{"toolCentreOption", 0}}), "Cycle parameter wrong");
    EXPECT_EQ(refusing.alarm(number, {{408, 120}}, "", {{"toolCentreOption", 0}}), "");
    EXPECT_EQ(refusing.alarm(number, {}, "TOOL CALL 1 Y\n"), "Tool axis not permitted");
    EXPECT_EQ(refusing.alarm(number, {}, "FUNCTION MODE TURN\n"), "Function not permitted");
    EXPECT_EQ(refusing.alarm(number, {}, "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+5\n"),
              "Coordinate transformation not permitted");
    EXPECT_EQ(refusing.alarm(number, {}, "L C+10 R0 FMAX\n", {{"mStrobeRotAxPos", 40}}), "Rotary axes not at 0");
    for (const double function : {0, 940})
      EXPECT_EQ(refusing.alarm(number, {}, "", {{"mStrobeRotAxPos", function}}), "M function missing") << function;
    refusing.world.bench.setup.beliefs.kinematics["B"].hirthGrid = 3;
    const Ran hirth = refusing.run(number);
    EXPECT_EQ(hirth.alarm(), "Cycle parameter wrong");
    EXPECT_THAT(hirth.why(), HasSubstr("Hirth"));
  }
  Refusing without;
  EXPECT_EQ(without.alarm(453, {}, "", {{"option52", 0}}), "Function not enabled");
  EXPECT_EQ(without.alarm(452, {}, "", {{"option52", 0}}), "");
}

TEST(KinematicsRefusals, OfCycle452OnTheOlderControl) {
  Refusing older(1, ControlKind::iTNC530);
  EXPECT_EQ(older.alarm(452), "");
  EXPECT_EQ(older.alarm(452, {{407, 12.6}}), "Calibration sphere radius wrong");
  EXPECT_EQ(older.alarm(452, {{407, 12.55}}, "", {{"MP6601", 0.1}}), "");
  EXPECT_EQ(older.alarm(452, {}, "", {{"FCL", 2}}), "Function not enabled");
  EXPECT_EQ(older.alarm(452, {}, "L C+10 R0 FMAX\n", {{"MP6602", 40}}), "Rotary axes not at 0");
  EXPECT_EQ(older.alarm(452, {{415, -90}, {416, 90}, {418, 3}}), "Measuring position not permitted");
  EXPECT_THAT(older.run(452, {{419, 360}, {420, 90}}).why(), HasSubstr("Q419"));
  // M128 is switched off, not refused.
  for (const int number : {451, 452})
    EXPECT_EQ(older.alarm(number, {}, "M128\n"), "");
}

/// More than maxModification: a stop leaves the kinematics as it is.
TEST(KinematicsRefusals, AskBefore452WritesMuch) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Refusing refusing(1, kind);
    refusing.world.bench.setup.world.truth.errors.thermal.push_back({{0.3, 0, 0}, 1});
    const Ran taken = refusing.run(452);
    ASSERT_TRUE(ended(taken)) << taken.why();
    ASSERT_FALSE(taken.screens().empty());
    EXPECT_THAT(taken.screens()[0], HasSubstr("by up to 0.3"));
    EXPECT_THAT(taken.screens()[0], HasSubstr(kind == ControlKind::TNC640 ? "maxModification" : "MP6600"));
    refusing.world.bench.onStop = control::OnStop::Abort;
    EXPECT_FALSE(refusing.run(452).outcome.files.contains("KINEMATIC.TAB"));
    const char* name = kind == ControlKind::TNC640 ? "maxModification" : "MP6600";
    EXPECT_TRUE(refusing.run(452, {}, "", {{name, 0.4}}).screens().empty());
  }
}

/// Where the preset is set first the sphere is measured twice, and its radius counts the second time.
TEST(KinematicsPreset, MeasuresTheSphereTwice) {
  for (const int number : {451, 453}) {
    Refusing refusing;
    const std::string above = "L X+0.7 Y-0.6 R0 FMAX\nL Z+14.8 R0 FMAX\n";
    const Ran plain = refusing.run(number, {{431, 0}}, above), preset = refusing.run(number, {{431, 1}}, above);
    ASSERT_TRUE(ended(preset)) << preset.why();
    EXPECT_EQ(preset.touches(), plain.touches() + 10);
    const Ran wrong = refusing.run(number, {{431, 1}, {407, 12.6}}, above);
    EXPECT_EQ(wrong.alarm(), "Calibration sphere radius wrong");
    EXPECT_EQ(wrong.touches(), 10U);
  }
}

}  // namespace
}  // namespace probewright::testing_support
