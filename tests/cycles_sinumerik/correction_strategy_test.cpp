#include "cycles/sinumerik/correction_strategy.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace probewright::cycles::sinumerik {
namespace {

/// Differences in micrometres, and after each the mean and whether it corrects, computed by hand with
/// new = old - (old - d) / k from 0, cleared after a correction; zero offset range 40.
struct Step {
  double difference, mean;
  bool corrects;
};

void expectSteps(double weight, const std::vector<Step>& steps) {
  double memory = 0;
  for (const Step& step : steps) {
    const CorrectionDecision decision =
        decideCorrection(step.difference, {.zeroOffsetRange = 40}, WeightedMean{memory, weight});
    EXPECT_EQ(decision.corrects, step.corrects) << step.difference;
    EXPECT_NEAR(decision.corrects ? decision.correction : *decision.mean, step.mean, 1e-3);
    memory = *decision.mean;
    if (decision.corrects) {
      EXPECT_EQ(memory, 0);
    }
  }
}

TEST(CorrectionStrategy, FollowsTheSlidingMean) {
  expectSteps(3, {{30, 10, false},
                  {50, 23.333, false},
                  {60, 35.556, false},
                  {20, 30.370, false},
                  {40, 33.580, false},
                  {50, 39.053, false},
                  {50, 42.702, true},
                  {30, 10, false},
                  {70, 30, false},
                  {70, 43.333, true}});
  expectSteps(2, {{30, 15, false},
                  {50, 32.5, false},
                  {60, 46.25, true},
                  {20, 10, false},
                  {40, 25, false},
                  {50, 37.5, false},
                  {50, 43.75, true},
                  {30, 15, false},
                  {70, 42.5, true},
                  {70, 35, false}});
}

TEST(CorrectionStrategy, WeightOneIsNoMean) {
  const auto decision = decideCorrection(0.02, {.zeroOffsetRange = 0.01}, WeightedMean{0, 1});
  EXPECT_TRUE(decision.corrects);
  EXPECT_DOUBLE_EQ(decision.correction, 0.02);
  EXPECT_EQ(decision.mean, 0);
}

TEST(CorrectionStrategy, LargeDifferencesCorrectAtOnceAndClearTheMean) {
  const auto decision = decideCorrection(0.12, {.zeroOffsetRange = 0.01, .meanRange = 0.1}, WeightedMean{0.05, 3});
  EXPECT_DOUBLE_EQ(decision.correction, 0.12);
  EXPECT_EQ(decision.mean, 0);
}

TEST(CorrectionStrategy, JudgesTheToleranceAboutItsMiddle) {
  const auto over = decideCorrection(0.03, {.tolerance = 0.02}, std::nullopt);
  EXPECT_EQ(over.size, CorrectionDecision::Size::Over);
  EXPECT_DOUBLE_EQ(over.correction, 0.03);
  EXPECT_EQ(decideCorrection(-0.03, {.tolerance = 0.02}, std::nullopt).size, CorrectionDecision::Size::Under);
  EXPECT_EQ(decideCorrection(0.1 + 0.2, {.tolerance = 0.3}, std::nullopt).size, CorrectionDecision::Size::Within);
}

TEST(CorrectionStrategy, AWornToolIsNotCorrected) {
  const auto decision = decideCorrection(0.3, {.dimensionalDifference = 0.2, .tolerance = 0.1}, WeightedMean{0.05, 3});
  EXPECT_TRUE(decision.toolWornOut);
  EXPECT_FALSE(decision.corrects);
  EXPECT_EQ(decision.mean, 0.05) << "the mean stays as it is";
}

}  // namespace
}  // namespace probewright::cycles::sinumerik
