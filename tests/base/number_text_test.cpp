#include "base/number_text.hpp"

#include <gtest/gtest.h>

namespace probewright {
namespace {

TEST(ParseDecimal, ReadsTheFormsThatProgramsAndTablesUse) {
  EXPECT_EQ(parseDecimal("12.5"), 12.5);
  EXPECT_EQ(parseDecimal("+12.5"), 12.5);
  EXPECT_EQ(parseDecimal("-.5"), -0.5);
  EXPECT_EQ(parseDecimal("7."), 7.0);
  EXPECT_EQ(parseDecimal("+0"), 0.0);
}

TEST(ParseDecimal, RefusesEverythingElse) {
  for (const char* text : {"", "+", "-", ".", "1e3", "0x10", "inf", "nan", "1,5", "1.2.3", "+-1", "--1", " 1", "1 "}) {
    EXPECT_FALSE(parseDecimal(text)) << text;
  }
}

TEST(ParseInteger, TakesTheWholeTextOrNothing) {
  EXPECT_EQ(parseInteger("+42"), 42);
  EXPECT_EQ(parseInteger("-7"), -7);
  EXPECT_FALSE(parseInteger("4.0"));
  EXPECT_FALSE(parseInteger("+-4"));
  EXPECT_FALSE(parseInteger("99999999999999999999"));
}

TEST(FormatFixed, NeverWritesANegativeZero) {
  EXPECT_EQ(formatFixed(-0.0001, 3), "0.000");
  EXPECT_EQ(formatFixed(-0.0006, 3), "-0.001");
  EXPECT_EQ(formatSigned(-0.0001, 3), "+0.000");
  EXPECT_EQ(formatSigned(12.5, 3), "+12.500");
  EXPECT_EQ(formatSigned(-12.5, 1), "-12.5");
}

TEST(NumberText, NoTextHasANegativeZero) {
  EXPECT_EQ(formatShortest(-0.0), "0");
  EXPECT_EQ(formatFixed(-0.0, 3), "0.000");
  EXPECT_EQ(formatFixed(-0.0004, 3), "0.000");
  EXPECT_EQ(formatSigned(-0.0004, 3), "+0.000");
  EXPECT_EQ(formatSigned(-0.0, 0), "+0");
}

}  // namespace
}  // namespace probewright
