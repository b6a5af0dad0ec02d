#include <gmock/gmock.h>

#include <cmath>

#include "reports/summary.hpp"
#include "truth/told.hpp"

/// What was written into tables, against what was planted.
namespace probewright::truth::testing {
namespace {

using ::testing::HasSubstr;

const records::EntryTruth& entry(const Told& told, const std::string& name) {
  static const records::EntryTruth none;
  const auto& entries = told.truth().entries;
  const auto found = std::ranges::find(entries, name, &records::EntryTruth::name);
  EXPECT_NE(found, entries.end()) << "no entry " << name;
  return found == entries.end() ? none : *found;
}

const records::EntryValue& value(const records::EntryTruth& entry, const std::string& name) {
  static const records::EntryValue none;
  const auto found = std::ranges::find(entry.values, name, &records::EntryValue::name);
  EXPECT_NE(found, entry.values.end()) << "no value " << name;
  return found == entry.values.end() ? none : *found;
}

constexpr double cell = 1e-4;  // mm: what a table can show

TEST(Entries, OfAPresetAreAsWrongAsTheFeatureThatWasMeasured) {
  World world;
  world.origin = {0, 0, -480};
  // A probe whose ball is believed to stand beside the spindle axis: every hole is measured there.
  world.probe = "believed_tip_offset = [0.02, -0.01]\n";
  world.part = plate("{ x = 0.6, y = -0.4, z = -480 }");
  const Told told = run(world,
                        "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 412 PRESET ~\nQ321=+0 ~\nQ322=+0 ~\nQ262=+30 ~\n"
                        "Q325=+0 ~\nQ247=+90 ~\nQ261=-5 ~\nQ320=+2 ~\nQ260=+20 ~\nQ301=+0 ~\nQ305=+1 ~\nQ331=+10 ~\n"
                        "Q332=+20 ~\nQ303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\nQ383=+0 ~\nQ384=+0 ~\nQ333=+0\n");
  ASSERT_TRUE(told.finished()) << told.why();
  const records::EntryTruth& preset = entry(told, "preset 1");
  EXPECT_EQ(preset.kind, records::EntryKind::Preset);
  // The hole gets X10 Y20: its preset is that much before it.
  EXPECT_NEAR(value(preset, "X").truth, 0.6 - 10, cell);
  EXPECT_NEAR(value(preset, "Y").truth, -0.4 - 20, cell);
  EXPECT_NEAR(value(preset, "X").value, 0.6 - 10 + 0.02, cell);
  ASSERT_TRUE(preset.distance);
  EXPECT_NEAR(*preset.distance, std::hypot(0.02, 0.01), 2 * cell);
  EXPECT_FALSE(preset.angle);
  EXPECT_EQ(preset.values.size(), 2U) << "Z was not measured";
  EXPECT_THAT(reports::summaryText(told.outcome.journal, told.outcome.info),
              HasSubstr("  preset 1: 0.022 mm from the truth (X "));
}

TEST(Entries, OfARotationTellItsAngle) {
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480, c = 0.8 }");
  // The machine's X and Y are not square: what lies along X is right, what lies along Y is not.
  world.more = "[[errors.squareness]]\naxis = \"X\"\ntowards = \"Y\"\ndegrees = 0.01\n";
  const Told told = run(world,
                        "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 400 ROTATION ~\nQ263=-30 ~\nQ264=-30 ~\nQ265=+30 ~\n"
                        "Q266=-30 ~\nQ272=+2 ~\nQ267=+1 ~\nQ261=-8 ~\nQ320=+2 ~\nQ260=+20 ~\nQ301=+1 ~\nQ307=+0 ~\n"
                        "Q305=+1\n");
  ASSERT_TRUE(told.finished()) << told.why();
  const records::EntryTruth& preset = entry(told, "preset 1");
  EXPECT_NEAR(value(preset, "SPC").truth, 0.8, cell);
  ASSERT_TRUE(preset.angle);
  EXPECT_NEAR(*preset.angle, 0.01, 2 * cell);
  EXPECT_FALSE(preset.distance);
}

TEST(Entries, OfAZeroOffsetAreComparedOnASinumerik) {
  World world;
  world.control = "840Dsl";
  world.origin = {0, 0, -480};
  world.believedRadius = 3.005;
  world.part = plate("{ z = -479.7 }");
  const Told told =
      run(world, "T1 D1\nM6\nG54 G17 G0 X10 Y20 Z6\nCYCLE978(100,10001,,1,0,6,3,3,2,1,\"\",,0,,0,0,,,,,1,)\n");
  ASSERT_TRUE(told.finished()) << told.why();
  const records::EntryTruth& offset = entry(told, "G54");
  EXPECT_EQ(offset.kind, records::EntryKind::ZeroOffset);
  EXPECT_NEAR(value(offset, "Z").truth, -479.7, 1e-5);
}

TEST(Entries, OfAnAxisOfRotationAreItsDistanceFromTheTrueOne) {
  World world;
  Diagnostics diagnostics;
  const std::string examples = PROBEWRIGHT_EXAMPLES;
  const auto setup = setup::readSetup(examples + "/setups/kinematics-tnc640.toml", diagnostics);
  ASSERT_TRUE(setup);
  auto simulated = setup::runProgram(examples + "/programs/kinematics.h", *setup, session::RunOptions());
  const Told told{std::move(simulated.outcome)};
  ASSERT_TRUE(told.finished()) << told.why();
  for (const char* name : {"axis A", "axis C"}) {
    const records::EntryTruth& axis = entry(told, name);
    EXPECT_EQ(axis.kind, records::EntryKind::Kinematics);
    ASSERT_TRUE(axis.distance && axis.angle);
    // Planted by hundredths of a millimetre, found to about a micrometre.
    EXPECT_LT(*axis.distance, 0.003) << name;
    EXPECT_GT(*axis.distance, 0) << name;
  }
}

TEST(Entries, OfAToolCountItsWear) {
  Diagnostics diagnostics;
  const std::string examples = PROBEWRIGHT_EXAMPLES;
  for (const char* control : {"tnc640", "840dsl"}) {
    const auto setup = setup::readSetup(examples + "/setups/tool-" + control + ".toml", diagnostics);
    ASSERT_TRUE(setup);
    const bool heidenhain = std::string(control) == "tnc640";
    auto simulated = setup::runProgram(examples + (heidenhain ? "/programs/tool.h" : "/programs/tool.mpf"), *setup,
                                       session::RunOptions());
    const Told told{std::move(simulated.outcome)};
    ASSERT_TRUE(told.finished()) << told.why();
    const records::EntryTruth& tool = entry(told, "tool 12");
    // The setup plants 92.417 and 7.994; the longest tooth stands out by 0.002, the widest by 0.006.
    EXPECT_NEAR(value(tool, heidenhain ? "L" : "length 1").truth, 92.419, 1e-9);
    EXPECT_NEAR(value(tool, heidenhain ? "R" : "radius").truth, 8.000, 1e-9);
    EXPECT_LT(*tool.distance, 0.01) << control;
  }
}

}  // namespace
}  // namespace probewright::truth::testing
