#include "language/word_column.hpp"

#include <gtest/gtest.h>

namespace probewright::language {
namespace {

TEST(WordColumn, StandsBehindTheNumberOfTheBlock) {
  EXPECT_EQ(columnOfFirstWord("TCH PROBE 421"), 1U);
  EXPECT_EQ(columnOfFirstWord("7 TCH PROBE 421 ~"), 3U);
  EXPECT_EQ(columnOfFirstWord("  12   TCH PROBE 421"), 8U);
  EXPECT_EQ(columnOfFirstWord("N320 CYCLE977(1)"), 6U);
  EXPECT_EQ(columnOfFirstWord("N320CYCLE977(1)"), 5U);
  EXPECT_EQ(columnOfFirstWord("/2 N10 G0 X1"), 8U);
  EXPECT_EQ(columnOfFirstWord("/N10 G0 X1"), 6U);
  EXPECT_EQ(columnOfFirstWord("\tG0 X1"), 2U);
  EXPECT_EQ(columnOfFirstWord("NORM"), 1U);
  EXPECT_EQ(columnOfFirstWord(""), 1U);
  EXPECT_EQ(columnOfFirstWord("N10 "), 5U);
}

TEST(WordColumn, IsThatOfTheWordItselfWhereverItStands) {
  EXPECT_EQ(columnOf("CYCLE977", "N10 IF R1>0 cycle977(1)"), 13U);
  EXPECT_EQ(columnOf("MEAS", "N10 MEAS=1 G1 X5"), 5U);
  EXPECT_EQ(columnOf("MEAS", "N10 R_MEAS=1 MEAS=1"), 14U) << "not within another word";
  EXPECT_EQ(columnOf("CYCLE977", "N10 CALL R1"), 5U) << "called by another name";
}

}  // namespace
}  // namespace probewright::language
