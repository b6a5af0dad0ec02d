#include <gtest/gtest.h>

#include "control/sinumerik/measuring_data.hpp"
#include "sinumerik/world.hpp"

namespace probewright::language::sinumerik {
namespace {

std::string codeOf(const std::string& block) {
  const execution::RunResult result = World().tryRun(block + "\nM30");
  return result.diagnostics.empty() ? "" : result.diagnostics.front().code;
}

TEST(DatumCheck, IndicesThatTheControlHasNotAreRefused) {
  EXPECT_EQ(codeOf("$TC_DP3[0,1]=5"), "17020");
  EXPECT_EQ(codeOf("$TC_DP6[-1,1]=5"), "17020");
  EXPECT_EQ(codeOf("$TC_DP3[1,0]=5"), "17030");
  EXPECT_EQ(codeOf("$TC_DP3[1]=5"), "12400");
  EXPECT_EQ(codeOf("$TC_DP3=5"), "12400");
  EXPECT_EQ(codeOf("$TC_DP3[X,1]=5"), "12150");
  EXPECT_EQ(codeOf("R1=$TC_DP3[1,0]"), "17030");
  EXPECT_EQ(codeOf("$P_UIFR[100,X,TR]=1"), "17020");
  EXPECT_EQ(codeOf("$P_UIFR[-1,X,TR]=1"), "17020");
  EXPECT_EQ(codeOf("R1=$P_UIFR[100,X,TR]"), "17020");
  EXPECT_EQ(codeOf("$P_UIFR[1,V,TR]=1"), "17030");
  EXPECT_EQ(codeOf("$P_CHBFR[16,X,TR]=1"), "17020");
  EXPECT_EQ(codeOf("$SNS_MEA_WP_BALL_DIAM[12]=5"), "17020");
  EXPECT_EQ(codeOf("$SCS_MEA_EMPIRIC_VALUE[20]=0.1"), "17020");
}

TEST(DatumCheck, ValuesHaveTheKindOfTheirDatum) {
  EXPECT_EQ(codeOf("$TC_DP3[1,1]=\"x\""), "12150");
  EXPECT_EQ(codeOf("$TC_TP2[1]=5"), "12150");
  EXPECT_EQ(codeOf("$SNS_MEA_WP_BALL_DIAM[0]=\"x\""), "12150");
}

TEST(DatumCheck, WhatTheControlHasIsTaken) {
  for (const char* block :
       {"$TC_DP3[1,1]=5", "$TC_DP3[30,2]=5", "$TC_SCP13[1,1]=0.1", "$TC_TP2[7]=\"DRILL\"", "$P_UIFR[99,X,TR]=1",
        "$P_UIFR[0,Z,FI]=1", "$P_CHBFR[0,X,TR]=1", "$P_UIFR[1]=CTRANS(X,1)", "$SNS_MEA_WP_BALL_DIAM[11]=5",
        "$SCS_MEA_EMPIRIC_VALUE[19]=0.1", "R1=$P_UBFR[X,TR]", "$SCS_MEA_FEED_MEASURE=200"})
    EXPECT_EQ(codeOf(block), "") << block;
}

TEST(DatumCheck, AnArrayWithoutIndexIsItsFirstElement) {
  int arrays = 0;
  for (const control::sinumerik::MeasuringDatum& datum : control::sinumerik::measuringData()) {
    if (datum.elements == 0) continue;
    ++arrays;
    const std::string name(datum.identifier);
    World world;
    world.run(name + "=77\nR1=" + name + "[0] R2=" + name + "\n" + name + "[0]=78\nR3=" + name + "\nM30");
    EXPECT_EQ(world.r(1), 77) << name;
    EXPECT_EQ(world.r(2), 77) << name;
    EXPECT_EQ(world.r(3), 78) << name;
    EXPECT_EQ(world.control.data.keys(name).size(), 1U) << name;
    if (datum.elements > 1) {
      EXPECT_EQ(world.value(name + "[1]"), datum.initial) << name;
    }
  }
  EXPECT_GT(arrays, 50);
}

TEST(DatumCheck, ADatumThatIsNoArrayHasNoIndex) {
  int single = 0;
  for (const control::sinumerik::MeasuringDatum& datum : control::sinumerik::measuringData()) {
    if (datum.elements > 0) continue;
    ++single;
    const std::string name(datum.identifier);
    EXPECT_EQ(codeOf("R1=" + name + "[0]"), "12400") << name;
    EXPECT_EQ(codeOf(name + "[0]=1"), "12400") << name;
    EXPECT_EQ(codeOf("R1=" + name), "") << name;
  }
  EXPECT_GT(single, 20);
}

/// SET and REP without an index begin with the first element, as any array without one is its first element.
TEST(DatumCheck, SetAndRepFillArraysFromTheirFirstElement) {
  World world;
  world.run(
      "$SCS_MEA_EMPIRIC_VALUE=SET(0.1,0.2,0.3)\n$SNS_MEA_TP_EDGE_DISK_SIZE=REP(20)\n$SNS_MEA_TP_TYPE[4]=REP(101)\n"
      "DEF REAL MINE[3]\nMINE=SET(7,8,9)\nM30");
  EXPECT_EQ(world.value("$SCS_MEA_EMPIRIC_VALUE[0]"), 0.1);
  EXPECT_EQ(world.value("$SCS_MEA_EMPIRIC_VALUE[2]"), 0.3);
  for (const char* element : {"0", "5"})
    EXPECT_EQ(world.value(std::string("$SNS_MEA_TP_EDGE_DISK_SIZE[") + element + "]"), 20);
  EXPECT_EQ(world.value("$SNS_MEA_TP_TYPE[3]"), 0);
  EXPECT_EQ(world.value("$SNS_MEA_TP_TYPE[5]"), 101);
  EXPECT_EQ(codeOf("$SCS_MEA_FEED_MEASURE=SET(1,2)"), "12400");
  EXPECT_EQ(codeOf("$SNS_MEA_TP_TYPE[4]=SET(1,2,3)"), "17020");
}

TEST(DatumCheck, ArraysOfTheNcAndFormerNamesAreAddressedSo) {
  World world;
  world.run(
      "$MC_GCODE_RESET_VALUES=3\nR1=$MC_GCODE_RESET_VALUES[0]\n"
      "$MNS_J_MEA_T_PROBE_DIAM_LENGTH=25\nR2=$SNS_MEA_TP_EDGE_DISK_SIZE[0]\n"
      "$MNS_MEA_INPUT_PIECE_PROBE=1\nR3=$MNS_MEA_INPUT_PIECE_PROBE[0] R4=$MCS_MEA_FUNCTION_MASK B_AND 1\nM30");
  EXPECT_EQ(world.r(1), 3);
  EXPECT_EQ(world.r(2), 25);
  EXPECT_EQ(world.r(3), 1);
  EXPECT_EQ(world.r(4), 1);
}

}  // namespace
}  // namespace probewright::language::sinumerik
