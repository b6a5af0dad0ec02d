#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "metrology/fits.hpp"
#include "study/model_bench.hpp"
#include "study/program_bench.hpp"

/// Programs whose uncertainty is known in closed form: the scatter of the probe, lobing, a tilted part.
namespace probewright::study::testing {
namespace {

constexpr double degree = 180 / std::numbers::pi;

/// Standard deviations of 1,500 trials are known to 1 / root(3000) = 1.8 %; five times that.
void expectUncertainty(const StudyResult& result, const std::string& key, double expected) {
  EXPECT_NEAR(answer(result, key).values.deviation, expected, 0.09 * expected) << key;
}

TEST(ClosedForm, ScatterOfTheProbeBecomesThatOfTheResults) {
  const double s = 0.002;
  const std::string side =
      "5 TCH PROBE 427 SIDE ~\nQ263=+40 ~\nQ264=+0 ~\nQ261=-5 ~\nQ320=+2 ~\nQ272=+1 ~\nQ267=-1 ~\n"
      "Q260=+30 ~\nQ281=+0 ~\nQ288=+0 ~\nQ289=+0 ~\nQ309=+0 ~\nQ330=+0\n";
  const std::string width =
      "6 TCH PROBE 426 WIDTH ~\nQ263=+20 ~\nQ264=-30 ~\nQ265=+20 ~\nQ266=+30 ~\nQ272=+2 ~\nQ261=-5 "
      "~\nQ320=+2 ~\nQ260=+30 ~\nQ311=+60 ~\nQ288=+0 ~\nQ289=+0 ~\nQ281=+0 ~\nQ309=+0 ~\nQ330=+0\n";
  const std::string edge =
      "7 TCH PROBE 420 EDGE ~\nQ263=-30 ~\nQ264=-30 ~\nQ265=+30 ~\nQ266=-30 ~\nQ272=+2 ~\nQ267=+1 ~\n"
      "Q261=-5 ~\nQ320=+2 ~\nQ260=+30 ~\nQ301=+0 ~\nQ281=+0\n";
  const std::string plane =
      "8 TCH PROBE 431 PLANE ~\nQ263=-30 ~\nQ264=-25 ~\nQ294=+0 ~\nQ265=+30 ~\nQ266=-25 ~\nQ295=+0 ~\nQ296=-30 ~\n"
      "Q297=+25 ~\nQ298=+0 ~\nQ320=+2 ~\nQ260=+30 ~\nQ281=+0\n";
  const StudyResult result =
      studyOfProgram(plateSetup(), program(bore(3, 4) + bore(4, 3) + side + width + edge + plane),
                     R"(
trials = 1500
sensitivity = "none"
[[source]]
quantity = "part.pose.x"
distribution = "uniform"
half_width = 0.000001
)");
  EXPECT_EQ(result.finished, 1500U);
  // Circles through n touches: s * root(2 / n) in each coordinate of the centre, 2 s / root(n) in the diameter.
  for (const auto& [line, n] : {std::pair("421@4", 4.0), std::pair("421@23", 3.0)}) {
    expectUncertainty(result, std::string(line) + " Q151", s * std::sqrt(2 / n));
    expectUncertainty(result, std::string(line) + " Q152", s * std::sqrt(2 / n));
    expectUncertainty(result, std::string(line) + " Q153", 2 * s / std::sqrt(n));
  }
  expectUncertainty(result, "427@42 Q160", s);
  expectUncertainty(result, "426@55 Q156", s * std::sqrt(2.0));
  expectUncertainty(result, "426@55 Q157", s / std::sqrt(2.0));
  // Two touches 60 mm apart, and three in a right angle of 60 mm and 50 mm.
  expectUncertainty(result, "420@70 Q150", s * std::sqrt(2.0) / 60 * degree);
  expectUncertainty(result, "431@82 Q159", s * std::sqrt(2.0) / 60 * degree);
  expectUncertainty(result, "431@82 Q158", s * std::sqrt(2.0) / 50 * degree);
}

/// Three lobes of amplitude l, turned anyhow. Four touches meet them at 0, 270, 180 and 90 degrees of a lobe: the
/// diameter does not see them, the centre moves by l on a circle. Three touches meet each lobe alike: the diameter is
/// wrong by up to 2 l, the centre is right. A value that swings by a has the standard deviation a / root(2).
TEST(ClosedForm, LobesAliasDifferentlyWithThreeAndFourTouches) {
  const StudyResult result =
      studyOfProgram(plateSetup("lobing = 0.003\nlobing_phase = 0\n"), program(bore(3, 4) + bore(4, 3)), R"(
trials = 1000
sensitivity = "none"
[[source]]
quantity = "tool[PROBE].lobing_phase"
distribution = "uniform"
minimum = 0
maximum = 360
)");
  expectUncertainty(result, "421@4 Q151", 0.003 / std::sqrt(2.0));
  expectUncertainty(result, "421@4 Q152", 0.003 / std::sqrt(2.0));
  EXPECT_LT(answer(result, "421@4 Q153").values.deviation, 1e-5);
  EXPECT_LT(answer(result, "421@23 Q151").values.deviation, 1e-5);
  expectUncertainty(result, "421@23 Q153", 2 * 0.003 / std::sqrt(2.0));
  EXPECT_NEAR(answer(result, "421@23 Q153").values.maximum, 30 + 0.006, 1e-4);
}

/// What a measurand should be is a number of the setup times a factor plus an offset.
TEST(ClosedForm, TheTruthOfAMeasurandHasAFactorAndAnOffset) {
  const std::string width =
      "3 TCH PROBE 426 WIDTH ~\nQ263=-40 ~\nQ264=+20 ~\nQ265=+40 ~\nQ266=+20 ~\nQ272=+1 ~\nQ261=-8 ~\n"
      "Q320=+2 ~\nQ260=+30 ~\nQ311=+80 ~\nQ288=+80.1 ~\nQ289=+79.9 ~\nQ281=+0 ~\nQ309=+0 ~\nQ330=+0\n";
  for (const auto& [factor, offset] : {std::pair(1.0, 0.0), {1.0, 0.25}, {0.5, 0.0}, {-2.0, 240.5}, {0.5, -3.0}}) {
    const StudyResult result = studyOfProgram(plateSetup(""), program(width),
                                              fmt::format(R"(
trials = 10
sensitivity = "none"
[[source]]
quantity = "part.pose.b"
distribution = "normal"
standard_deviation = 0.01
[[measurand]]
result = "Q156"
truth = "part.feature[1].size[1]"
factor = {}
offset = {}
)",
                                                          factor, offset));
    const Answer& found = answer(result, "426@4 Q156");
    ASSERT_TRUE(found.error);
    ASSERT_TRUE(found.truths);
    EXPECT_NEAR(found.truths->mean, 80 * factor + offset, 1e-9);
    EXPECT_NEAR(found.error->mean, found.values.mean - (80 * factor + offset), 1e-9);
  }
}

/// A wall that leans by b makes its thickness w look like w / cos b: with b normal about 0 too large by w sigma^2 / 2.
TEST(ClosedForm, ATiltedPartLooksTooWide) {
  const std::string width =
      "3 TCH PROBE 426 WIDTH ~\nQ263=-40 ~\nQ264=+20 ~\nQ265=+40 ~\nQ266=+20 ~\nQ272=+1 ~\nQ261=-8 ~\n"
      "Q320=+2 ~\nQ260=+30 ~\nQ311=+80 ~\nQ288=+80.1 ~\nQ289=+79.9 ~\nQ281=+0 ~\nQ309=+0 ~\nQ330=+0\n";
  const StudyResult result = studyOfProgram(plateSetup(""), program(width), R"(
trials = 2000
sensitivity = "none"
[[source]]
quantity = "part.pose.b"
distribution = "normal"
standard_deviation = 0.5
[[measurand]]
result = "Q156"
truth = "part.feature[1].size[1]"
)");
  const Answer& found = answer(result, "426@4 Q156");
  ASSERT_TRUE(found.error);
  ASSERT_TRUE(found.truths);
  EXPECT_FALSE(found.truths->vary());
  EXPECT_EQ(found.truths->mean, 80);
  // The ball touches a leaning wall beside its equator, on both sides alike: (w + 2 r) / cos b - 2 r.
  const double sigma = 0.5 / degree;
  const double bias = (80 + 6) * sigma * sigma / 2;
  EXPECT_NEAR(found.error->mean, bias, 5 * bias * std::sqrt(2.0 / 2000));
  // The square of a normal number has root(2) times its mean as standard deviation; the fourth moment scatters more.
  EXPECT_NEAR(found.error->deviation, bias * std::sqrt(2.0), 0.2 * bias);
  EXPECT_GT(found.error->minimum, -1e-6);
}

/// A face that leans by b is met beside the pole of the ball: r / cos b - r too high. 20 mm above the point about which
/// the part leans it is itself 20 / cos b - 20 higher.
TEST(ClosedForm, ATiltedPlaneLooksTooHigh) {
  const std::string height =
      "3 TCH PROBE 427 HEIGHT ~\nQ263=+0 ~\nQ264=+25 ~\nQ261=+0 ~\nQ320=+2 ~\nQ272=+3 ~\nQ267=-1 ~\n"
      "Q260=+30 ~\nQ281=+0 ~\nQ288=+0 ~\nQ289=+0 ~\nQ309=+0 ~\nQ330=+0\n";
  const StudyResult result = studyOfProgram(plateSetup(""), program(height), R"(
trials = 2000
sensitivity = "none"
[[source]]
quantity = "part.pose.b"
distribution = "normal"
standard_deviation = 0.5
)");
  const Summary& found = answer(result, "427@4 Q160").values;
  const double sigma = 0.5 / degree;
  const double bias = (20 + 3) * sigma * sigma / 2;
  EXPECT_NEAR(found.mean, bias, 5 * bias * std::sqrt(2.0 / 2000));
  EXPECT_NEAR(found.deviation, bias * std::sqrt(2.0), 0.2 * bias);
  EXPECT_GT(found.minimum, -1e-6);
}

/// A line through n touches spread evenly over the length L: s / root(n) where their middle is, and
/// s root(12 (n - 1) / (n (n + 1))) / L in its direction.
TEST(ClosedForm, ScatterOfTheProbeBecomesThatOfALine) {
  const int n = 7;
  const double s = 0.002, length = 60;
  std::vector<Source> touches;
  for (int i = 0; i < n; ++i)
    touches.push_back(source("touch" + std::to_string(i), Normal{0, s}));
  const auto line = [&](const std::vector<double>& heights) {
    std::vector<Vector2> points;
    for (int i = 0; i < n; ++i)
      points.emplace_back(length * (static_cast<double>(i) / (n - 1) - 0.5), heights[static_cast<std::size_t>(i)]);
    return metrology::fitLine(points).value().shape;
  };
  const Study study = studyOf(touches, 5000);
  const Answer position = answerOf(study, [&](const std::vector<double>& heights) {
    const metrology::Line2 found = line(heights);
    return found.point.y() - found.direction.y() / found.direction.x() * found.point.x();
  });
  EXPECT_NEAR(position.values.deviation, s / std::sqrt(7.0), 0.05 * s / std::sqrt(7.0));
  const Answer direction = answerOf(study, [&](const std::vector<double>& heights) {
    const metrology::Line2 found = line(heights);
    return std::atan2(found.direction.y(), found.direction.x());
  });
  const double expected = s * std::sqrt(12.0 * (n - 1) / (n * (n + 1))) / length;
  EXPECT_NEAR(direction.values.deviation, expected, 0.05 * expected);
}

}  // namespace
}  // namespace probewright::study::testing
