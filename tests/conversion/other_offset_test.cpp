#include <gmock/gmock.h>

#include "conversion/sinumerik_cases.hpp"

/// Measuring cycles that correct a zero offset other than the one in effect.
namespace probewright::testing_support::sinumerik_programs {
namespace {

using ::testing::HasSubstr;

struct Task {
  std::string name;
  std::string start;  ///< drives there
  std::string cycle;
  Named words;
  double safe = 0;  ///< S_TSA that the feature keeps
};

/// A block of 100 mm with a hole of 40 mm, whose corner is at -50, -50.
std::vector<Task> tasks() {
  const Named angles = {{"S_MVAR", 105}, {"S_STA1", 0}, {"S_FA", 10}, {"S_RA", 0}};
  return {
      {"SurfaceInX",
       "G0 X-62 Y30\nG0 Z-10\n",
       "CYCLE978",
       {{"S_MVAR", 100}, {"S_SETV", -50}, {"S_FA", 6}, {"S_MA", 1}, {"S_MD", 1}},
       2},
      {"SurfaceInY",
       "G0 X30 Y-62\nG0 Z-10\n",
       "CYCLE978",
       {{"S_MVAR", 100}, {"S_SETV", -50}, {"S_FA", 6}, {"S_MA", 2}, {"S_MD", 1}},
       2},
      {"SurfaceInZ",
       "G0 X40 Y40\nG0 Z8\n",
       "CYCLE978",
       {{"S_MVAR", 100}, {"S_SETV", 0}, {"S_FA", 6}, {"S_MA", 3}, {"S_MD", 2}},
       2},
      {"EdgeAlongX", "G0 X-30 Y-62\nG0 Z-10\n", "CYCLE998", with(angles, {{"S_MA", 102}, {"S_MD", 1}, {"S_ID", 60}}),
       1.5},
      {"EdgeAlongY", "G0 X-62 Y-30\nG0 Z-10\n", "CYCLE998", with(angles, {{"S_MA", 201}, {"S_MD", 1}, {"S_ID", 60}}),
       1.5},
      {"Corner",
       "G0 X-62 Y-62\nG0 Z-10\n",
       "CYCLE961",
       {{"S_MVAR", 108},
        {"S_SETV0", 30},
        {"S_SETV1", 70},
        {"S_SETV2", 30},
        {"S_SETV3", 70},
        {"S_SETV4", -62},
        {"S_SETV5", -62},
        {"S_SETV8", -50},
        {"S_SETV9", -50},
        {"S_STA1", 0},
        {"S_INCA", 90},
        {"S_FA", 20}},
       1.5},
      {"Hole", "G0 X0 Y0\nG0 Z-10\n", "CYCLE977", {{"S_MVAR", 101}, {"S_SETV", 40}, {"S_STA1", 0}, {"S_FA", 5}}, 2},
      {"HoleSegment",
       "G0 X0 Y0\nG0 Z-10\n",
       "CYCLE979",
       {{"S_MVAR", 1101}, {"S_SETV", 40}, {"S_CPA", 0}, {"S_CPO", 0}, {"S_STA1", 10}, {"S_INCA", 80}, {"S_FA", 5}},
       2},
  };
}

/// Where the corrected offset is selected, the probe drives to its origin and stands there. It has been selected
/// before: its row is there.
std::string program(const Task& task, int offset, double safe, const char* code) {
  return "G17 G90 G710\nT1\nM6 D1\nG55\nG54\nG0 Z120\n" + task.start +
         sinumerikCall(task.cycle, with(with(always, task.words), {{"S_KNUM", offset}, {"S_TSA", safe}})) +
         fmt::format("G0 Z120\n{}\nG0 Z130\nG0 X0 Y0\nM30\n", code);
}

/// The offset that is corrected lies far from the one in effect and is turned.
PlantedPart world(Dice& dice, double turned) {
  PlantedPart part = plant(dice, ControlKind::TNC640, 0, 0);
  part.nominal = Vector3::Zero();
  part.machineFromPreset = pose(part.machineFromPreset.translation());
  part.bench.setup.beliefs.presets.front().rotation.setZero();
  const Vector3 off(dice.between(0.2, 1), dice.between(0.2, 1), dice.between(-1, -0.2));
  part.machineFromPart = part.machineFromPreset * pose(off, {0, 0, dice.between(0.2, 1)});
  part.bench.preset(2, part.machineFromPreset.translation() + Vector3(70, -60, 25), turned, false);
  return part;
}

class OtherOffset : public ::testing::TestWithParam<Task> {};

TEST_P(OtherOffset, GetsWhatTheOriginalGivesIt) {
  const Task& task = GetParam();
  const bool hole = task.name.starts_with("Hole");
  Dice dice(static_cast<unsigned>(std::hash<std::string>()(task.name)));
  for (const int offset : {10002, 2}) {
    for (const double turned : {0.0, 25.0, -70.0}) {
      // What the feature deviates is within the safe area, or not: the distance of the two offsets is no deviation.
      for (const double safe : {task.safe, 0.005, 0.0}) {
        PlantedPart part = world(dice, turned);
        if (hole)
          layRound(part, true, 40);
        else
          layBlock(part);
        SCOPED_TRACE(fmt::format("S_KNUM = {}, turned by {}, S_TSA = {}", offset, turned, safe));
        const Twin original = runSinumerik(program(task, offset, safe, "G55"), part);
        const bool exceeded = safe < task.safe;
        ASSERT_EQ(original.finished, !exceeded) << original.why;
        const Twin there = runConverted(original, part);
        EXPECT_TRUE(there.lost.empty()) << format(there.lost.front());
        EXPECT_EQ(there.finished, !exceeded) << there.why << "\n" << original.text << there.text;
        if (exceeded) {
          EXPECT_THAT(there.why, HasSubstr("FN 14"));
          continue;
        }
        EXPECT_TRUE(sameEnd(original, there));
        EXPECT_TRUE(sameOrigin(original, there));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(ConvertOffsets, OtherOffset, ::testing::ValuesIn(tasks()),
                         [](const auto& each) { return each.param.name; });

/// G599 is row 0 of the preset table, which touch probe cycles select as soon as they correct it.
TEST(ConvertOffsets, TheLastOneIsCorrectedWhileItIsInEffectOnly) {
  const Task hole = tasks()[6];
  const auto lost = [&](const std::string& before) {
    return warningsOf(
        toKlartext("G17 G90 G710\nT1\nM6 D1\nG54\nG0 Z120\n" + before + hole.start +
                   sinumerikCall("CYCLE977", with(with(always, hole.words), {{"S_KNUM", 10099}, {"S_TSA", 2}})) +
                   "G0 Z120\nM30\n"));
  };
  ASSERT_EQ(lost("").size(), 1U);
  EXPECT_THAT(lost("").front().message, HasSubstr("G599 is row 0"));
  EXPECT_FALSE(lost("").front().advice.empty());
  EXPECT_TRUE(lost("G599\n").empty());
}

}  // namespace
}  // namespace probewright::testing_support::sinumerik_programs
