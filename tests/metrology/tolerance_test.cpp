#include "metrology/tolerance.hpp"

#include <gtest/gtest.h>

namespace probewright::metrology {
namespace {

void expectLimits(const char* text, double nominal, double lower, double upper) {
  const auto dimension = parseDimension(text);
  ASSERT_TRUE(dimension) << text << ": " << dimension.error().message;
  EXPECT_NEAR(*dimension->nominal, nominal, 1e-15) << text;
  const auto bounds = dimension->limits();
  ASSERT_TRUE(bounds) << text;
  EXPECT_NEAR(bounds->lower, lower, 1e-12) << text;
  EXPECT_NEAR(bounds->upper, upper, 1e-12) << text;
}

TEST(DimensionText, DeviationsInAnyOrder) {
  expectLimits("10+0.02-0.01", 10, 9.99, 10.02);
  expectLimits("10-0.01+0.02", 10, 9.99, 10.02);
  expectLimits("+10-1-0.5", 10, 9, 9.5);
  expectLimits("10+0.01+0.03", 10, 10.01, 10.03);
  expectLimits("-10-0.2+0.02", -10, -10.2, -9.98);
  expectLimits(" 10 +0,02 -0,01 ", 10, 9.99, 10.02);
}

TEST(DimensionText, OneDeviationLeavesTheOtherAtZero) {
  expectLimits("10+0.02", 10, 10, 10.02);
  expectLimits("10-0.02", 10, 9.98, 10);
}

TEST(DimensionText, PlusMinus) {
  expectLimits("10+-0.02", 10, 9.98, 10.02);
  expectLimits("10-+0.02", 10, 9.98, 10.02);
  expectLimits(
      "10\xC2\xB1"
      "0.02",
      10, 9.98, 10.02);
  expectLimits(
      "10\xB1"
      "0,02",
      10, 9.98, 10.02);
}

TEST(DimensionText, Classes) {
  expectLimits("10H7", 10, 10, 10.015);
  expectLimits("8m7", 8, 8.006, 8.021);
  expectLimits("10m", 10, 9.8, 10.2);
  expectLimits("-50m", -50, -50.3, -49.7);
  EXPECT_EQ(parseDimension("10H7")->toleranceClass, "H7");
  for (const auto& [text, name] : {std::pair("10H7@10.01", "H7"), {"10m@Q5", "m"}, {"10 m @ Q5 ", "m"}}) {
    const auto dimension = parseDimension(text);
    ASSERT_TRUE(dimension) << text << format(dimension.error());
    EXPECT_EQ(dimension->toleranceClass, name) << text;
    EXPECT_EQ(dimension->actualParameter, name[0] == 'm' ? "Q5" : "") << text;
  }
}

TEST(DimensionText, UnknownAndActualPositions) {
  const auto unknown = parseDimension("?");
  ASSERT_TRUE(unknown);
  EXPECT_TRUE(unknown->unknownPosition);
  EXPECT_FALSE(unknown->nominal);
  EXPECT_FALSE(unknown->limits());

  const auto known = parseDimension("?30");
  ASSERT_TRUE(known);
  EXPECT_TRUE(known->unknownPosition);
  EXPECT_EQ(known->nominal, 30);
  EXPECT_FALSE(known->tolerance);

  EXPECT_TRUE(parseDimension("?10+0.02")->tolerance);
  const auto actual = parseDimension("10+0.02@10.0123");
  ASSERT_TRUE(actual);
  EXPECT_EQ(actual->actual, 10.0123);
  const auto bare = parseDimension("50@50.0321");
  ASSERT_TRUE(bare);
  EXPECT_EQ(bare->actual, 50.0321);
  EXPECT_FALSE(bare->limits());
  const auto parameter = parseDimension("-10-0.2+0.02@Q1900");
  ASSERT_TRUE(parameter);
  EXPECT_EQ(parameter->actualParameter, "Q1900");
  EXPECT_EQ(parameter->nominal, -10);
}

TEST(DimensionText, EqualLimitsMonitorNothing) { EXPECT_FALSE(parseDimension("10+0.1+0.1")->limits()); }

TEST(DimensionText, MistakesHaveAColumnAndAReason) {
  struct Mistake {
    const char* text;
    std::uint32_t column;
    const char* message;
  };
  for (const Mistake& mistake : {Mistake{"", 1, "a nominal dimension was expected"},
                                 {"H7", 1, "a nominal dimension was expected"},
                                 {"10+", 3, "a tolerance was expected"},
                                 {"10+0.02-", 8, "a second tolerance was expected"},
                                 {"10+0.02-0.01-0.3", 13, "unexpected text after the dimension"},
                                 {"10 0.02", 4, "a tolerance starts with a sign"},
                                 {"10+-", 5, "a tolerance without sign was expected after plus-minus"},
                                 {"10@", 4, "an actual value or a Q parameter was expected after '@'"},
                                 {"10@Q", 5, "a parameter number was expected after Q"},
                                 {"?10@10", 5, "a position marked unknown with '?' cannot have an actual value"},
                                 {"10H27", 3, "'H27' is not a tolerance class of ISO 286"},
                                 {"10x", 3, "'x' is not a tolerance class"},
                                 {"0.2m", 4, "ISO 2768-1 has no tolerance of class m for 0.2 mm"},
                                 {"10@Q5+", 6, "unexpected text after the dimension"},
                                 {"1.2.3", 1, "a nominal dimension was expected"}}) {
    const auto result = parseDimension(mistake.text);
    ASSERT_FALSE(result) << mistake.text;
    EXPECT_EQ(result.error().message, mistake.message) << mistake.text;
    EXPECT_EQ(result.error().place.column, mistake.column) << mistake.text;
    EXPECT_EQ(result.error().excerpt, mistake.text);
    EXPECT_FALSE(result.error().advice.empty()) << mistake.text;
  }
}

// ISO 2768-1:1989 table 1.
TEST(GeneralTolerance, AsTabulated) {
  EXPECT_EQ(generalTolerance(3, "f")->upper, 0.05);
  EXPECT_EQ(generalTolerance(3.1, "c")->upper, 0.3);
  EXPECT_EQ(generalTolerance(30, "m")->lower, -0.2);
  EXPECT_EQ(generalTolerance(120, "v")->upper, 1.5);
  EXPECT_EQ(generalTolerance(121, "m")->upper, 0.5);
  EXPECT_EQ(generalTolerance(1000, "c")->upper, 2);
  EXPECT_EQ(generalTolerance(4000, "m")->upper, 2);
  EXPECT_EQ(generalTolerance(0.5, "m")->upper, 0.1) << "sizes from 0.5 mm on";
  EXPECT_FALSE(generalTolerance(0.499, "m"));
  EXPECT_FALSE(generalTolerance(4000, "f"));
  EXPECT_FALSE(generalTolerance(2, "v"));
  EXPECT_FALSE(generalTolerance(4001, "m"));
}

TEST(Verdicts, MaterialLeftIsReworkMaterialMissingIsScrap) {
  const Limits bounds{9.99, 10.02};
  EXPECT_EQ(boreVerdict(9.98, bounds), Verdict::Rework);
  EXPECT_EQ(boreVerdict(10.03, bounds), Verdict::Scrap);
  EXPECT_EQ(studVerdict(9.98, bounds), Verdict::Scrap);
  EXPECT_EQ(studVerdict(10.03, bounds), Verdict::Rework);
  EXPECT_EQ(positionVerdict(9.98, bounds), Verdict::Scrap);
  EXPECT_EQ(positionVerdict(10.03, bounds), Verdict::Scrap);
  for (const double within : {9.99, 10.0, 10.02}) {
    EXPECT_EQ(boreVerdict(within, bounds), Verdict::Good);
    EXPECT_EQ(studVerdict(within, bounds), Verdict::Good);
    EXPECT_EQ(positionVerdict(within, bounds), Verdict::Good);
  }
  EXPECT_EQ(worst(Verdict::Rework, Verdict::Scrap), Verdict::Scrap);
  EXPECT_EQ(worst(Verdict::Good, Verdict::None), Verdict::Good);
}

TEST(Verdicts, RoundingOfDecimalNumbersDecidesNothing) {
  const Limits bounds = limits(0.1, Tolerance{0, 0.2});
  EXPECT_EQ(conformance(0.3, bounds), Conformance::Within);
  EXPECT_EQ(conformance(0.30001, bounds), Conformance::Above);
  EXPECT_DOUBLE_EQ(limits(10, Tolerance{-1, -0.5}).middle(), 9.25);
}

TEST(Statements, NeedTheUncertaintyInsideTheLimits) {
  const Limits bounds{9.9, 10.1};
  EXPECT_EQ(statement(10.0, 0.05, bounds), Statement::Conforms);
  EXPECT_EQ(statement(10.05, 0.05, bounds), Statement::Conforms);
  EXPECT_EQ(statement(10.08, 0.05, bounds), Statement::Undecided);
  EXPECT_EQ(statement(9.92, 0.05, bounds), Statement::Undecided);
  EXPECT_EQ(statement(9.88, 0.05, bounds), Statement::Undecided);
  EXPECT_EQ(statement(10.12, 0.05, bounds), Statement::Undecided);
  EXPECT_EQ(statement(10.2, 0.05, bounds), Statement::DoesNotConform);
  EXPECT_EQ(statement(9.8, 0.05, bounds), Statement::DoesNotConform);
  EXPECT_EQ(statement(10.0, 0.5, bounds), Statement::Undecided);
}

}  // namespace
}  // namespace probewright::metrology
