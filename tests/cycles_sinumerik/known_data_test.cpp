#include <algorithm>
#include <utility>

#include "support/sinumerik_bench.hpp"

/// What programs read of the control around the cycles, and what the record of a cycle says.
namespace probewright {
namespace {

using namespace testing_support;

simulation::Truth bored() {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Ring(20.02, 60, -60), translation({0, 0, -350}));
  return truth;
}

/// A program with CYCLE977 in a bore.
void measureBore(SinumerikBench& bench, const NamedNumbers& more = {}, const std::string& before = {},
                 const char* tool = "") {
  plantFrame(bench, "$P_UIFR", 1, {0, 0, -350});
  bench.start({0, 0, -10});
  bench.run("CYCLE977", with({{"S_MVAR", 1}, {"S_SETV", 40}, {"S_FA", 6}, {"S_TSA", 2}}, more), {{"S_TNAME", tool}},
            before);
}

TEST(KnownData, DataThatActReadAsTheyAct) {
  SinumerikBench bench(bored());
  measureBore(bench, {},
              "R1=$MN_MM_FRAME_FINE_TRANS R2=$MN_MM_NUM_SUMCORR R3=$MN_MM_TOOL_MANAGEMENT_MASK\n"
              "R4=$MC_MM_NUM_USER_FRAMES R5=$MC_TOOL_CHANGE_MODE R6=$SC_DRY_RUN_FEED\n"
              "R7=$MC_GCODE_RESET_VALUES[5] R8=$MC_GCODE_RESET_VALUES[12] R9=$MC_GCODE_RESET_VALUES[28]\n");
  // Fine offsets, six additive offsets, they exist (bit 8), 100 zero offsets, M6 changes, 5000 mm/min; G17, G71,
  // DIAMOF.
  const double expected[] = {1, 6, 256, 100, 1, 5000, 1, 2, 1};
  for (int i = 0; i < 9; ++i)
    EXPECT_EQ(bench.data("R", {i + 1}), expected[i]) << "R" << i + 1;
  const auto warned = [](const control::EventRecord& event) {
    return event.text.find("reads as 0") != std::string::npos;
  };
  EXPECT_TRUE(std::ranges::none_of(bench.control.journal.events, warned));
  measureBore(bench, {}, "R1=$TC_DP3[1,1] R2=$TC_DP13[1,1]\n");
  EXPECT_TRUE(std::ranges::none_of(bench.control.journal.events, warned));
  measureBore(bench, {}, "R1=$TC_DP3[9,1]\n");
  EXPECT_TRUE(std::ranges::any_of(bench.control.journal.events, warned)) << "there is no tool 9";
}

TEST(KnownData, NamesOfVersion26ReachTheDataOfToday) {
  SinumerikBench bench(bored());
  measureBore(bench, {},
              "R1=$SCS_MEA_COLLISION_MONITORING R2=$MNS_MEA_CAL_MONITORING R3=$SNS_MEA_REPEAT_ACTIVE\n"
              "$SCS_MEA_NUM_OF_MEASURE=1 $SNS_MEA_REPEATE_WITH_M0=1 $MNS_MEA_INPUT_TOOL_PROBE[0]=0\n"
              "$MNS_J_MEA_MEASURING_FEED=250 $MNS_J_MEA_T_PROBE_TYPE[2]=1\n"
              "R4=$SCS_MEA_NUM_OF_MEASURE R5=$MNS_J_MEA_MEASURING_FEED\n");
  const double expected[] = {1, 1, 0, 1, 250};
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(bench.data("R", {i + 1}), expected[i]) << "R" << i + 1;
  using control::sinumerik::maskBit;
  const auto& data = bench.control.data;
  EXPECT_TRUE(maskBit(data, "$SCS_MEA_FUNCTION_MASK", 3));
  EXPECT_TRUE(maskBit(data, "$SCS_MEA_FUNCTION_MASK", 17)) << "one datum was for workpieces and tools";
  EXPECT_TRUE(maskBit(data, "$SNS_MEA_FUNCTION_MASK", 1));
  EXPECT_FALSE(maskBit(data, "$MCS_MEA_FUNCTION_MASK", 16));
  EXPECT_EQ(bench.data("$SCS_MEA_FEED_MEASURE", {}), 250);
  EXPECT_EQ(bench.data("$SNS_MEA_TP_TYPE", {2}), 1);
}

TEST(KnownData, TheClockHasMilliseconds) {
  SinumerikBench bench(bored());
  measureBore(bench, {}, "R1=$A_MSECOND\nG4 F0.25\nR2=$A_MSECOND\n");
  const double passed = bench.data("R", {2}) - bench.data("R", {1});
  EXPECT_NEAR(passed < 0 ? passed + 1000 : passed, 250, 1.001);
}

TEST(KnownData, TheNameOfTheCorrectedToolIsAText) {
  SinumerikBench bench(bored());
  bench.control.data.set("$TC_TP2", {7}, std::string("MILL"));
  bench.set("$TC_DP1", {7, 1}, 120);
  bench.set("$TC_DP6", {7, 1}, 10);
  measureBore(bench, {{"S_MVAR", 201}, {"S_KNUM1", 1}}, "R1=0\nIF _OVS_TNAME==\"\"\nR1=1\nENDIF\n", "MILL");
  EXPECT_EQ(bench.data("R", {1}), 1) << "empty before the first correction";
  measureBore(bench, {}, "R1=0\nIF _OVS_TNAME==\"MILL\"\nR1=1\nENDIF\n_OVS_TNAME=\"\"\n");
  EXPECT_EQ(bench.data("R", {1}), 1);
  measureBore(bench, {{"S_MVAR", 201}, {"S_KNUM1", 1}}, {}, "MILL");
  measureBore(bench, {}, "R1=0\nIF _OVS_TNAME==\"MILL\"\nR1=1\nENDIF\n");
  EXPECT_EQ(bench.data("R", {1}), 1) << "also after the program has written it";
}

TEST(KnownData, AResultScreenThatTheControlHasNotIsNamed) {
  for (const double display : {2.0, 5.0, 0.0, 1.0}) {
    SinumerikBench bench(bored());
    bench.set("$SCS_MEA_RESULT_DISPLAY", {}, display);
    measureBore(bench);
    measureBore(bench);
    const auto named = std::ranges::count_if(bench.control.journal.events, [](const control::EventRecord& event) {
      return event.text.find("$SCS_MEA_RESULT_DISPLAY") != std::string::npos;
    });
    EXPECT_EQ(named, display == 2 || display == 5 ? 1 : 0) << display;
  }
}

TEST(KnownData, TheRecordIsTitledByWhatIsMeasured) {
  SinumerikBench bench(bored());
  measureBore(bench);
  EXPECT_EQ(bench.control.journal.cycles.back().title, "Hole 40");
  bench.start({0, 0, -10});
  bench.run("CYCLE979", {{"S_MVAR", 1}, {"S_SETV", 40.05}, {"S_INCA", 90}, {"S_FA", 6}, {"S_TSA", 2}});
  EXPECT_EQ(bench.control.journal.cycles.back().title, "Hole 40.05");
  bench.start({0, 0, -10});
  bench.tryRun("CYCLE977", {{"S_MVAR", 5}, {"S_SETV0", 40}, {"S_SETV1", 41}, {"S_FA", 6}, {"S_TSA", 2}});
  EXPECT_EQ(bench.control.journal.cycles.back().title, "Rectangular pocket 40 x 41");
  // A size that the call leaves out is not told.
  for (const auto& [numbers, title] : std::vector<std::pair<NamedNumbers, std::string>>{
           {{{"S_MVAR", 1}}, "Hole"},
           {{{"S_MVAR", 2}}, "Circular spigot"},
           {{{"S_MVAR", 5}}, "Rectangular pocket"},
           {{{"S_MVAR", 5}, {"S_SETV0", 40}}, "Rectangular pocket 40"},
           {{{"S_MVAR", 6}, {"S_SETV0", 40}, {"S_SETV1", 0.5}}, "Rectangular spigot 40 x 0.5"}}) {
    NamedNumbers call = numbers;
    call.insert(call.end(), {{"S_FA", 6}, {"S_TSA", 2}});
    bench.start({0, 0, -10});
    bench.tryRun("CYCLE977", call);
    EXPECT_EQ(bench.control.journal.cycles.back().title, title);
  }
  // Tables and logs beside it are in millimetres.
  for (const auto& [diameter, title] :
       {std::pair{1.574803, "Hole 1.5748 inch"}, std::pair{1.581234, "Hole 1.58123 inch"}}) {
    bench.start({0, 0, -10});
    bench.run("CYCLE977", {{"S_MVAR", 1}, {"S_SETV", diameter}, {"S_FA", 0.25}, {"S_TSA", 0.1}}, {}, "G70\n");
    EXPECT_EQ(bench.control.journal.cycles.back().title, title);
  }
}

TEST(KnownData, WhatStaysAsItWasIsNoCorrection) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Ring(20, 60, -60), translation({0, 0, -350}));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, -350});
  for (int pass = 0; pass < 2; ++pass) {
    bench.start({0, 0, -10});
    bench.run("CYCLE976", {{"S_MVAR", 1}, {"S_SETV", 40}, {"S_FA", 6}, {"S_TSA", 2}, {"S_VMS", 250}});
    EXPECT_EQ(bench.data("$SNS_MEA_WP_FEED", {0}), 250);
    const auto& writes = bench.control.journal.cycles.back().writes;
    for (const auto& write : writes)
      EXPECT_NE(write.before, write.after) << write.table;
    const bool feed = std::ranges::any_of(writes, [](const auto& write) { return write.table == "$SNS_MEA_WP_FEED"; });
    EXPECT_EQ(feed, pass == 0);
  }
}

}  // namespace
}  // namespace probewright
