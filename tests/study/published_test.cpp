#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "study/model_bench.hpp"

/// The examples of JCGM 101:2008, chapter 9, and other published cases: the figures are those printed there.
namespace probewright::study::testing {
namespace {

double sum(const std::vector<double>& x) {
  double total = 0;
  for (const double each : x)
    total += each;
  return total;
}

TEST(Jcgm101, AdditiveModelOfNormalQuantities) {
  Study study = studyOf(
      {source("a", Normal{0, 1}), source("b", Normal{0, 1}), source("c", Normal{0, 1}), source("d", Normal{0, 1})},
      200'000);
  const Answer y = answerOf(study, sum);
  EXPECT_NEAR(y.values.mean, 0, 0.02);
  EXPECT_NEAR(y.values.deviation, 2.00, 0.015);
  EXPECT_NEAR(y.values.symmetric->low, -3.92, 0.05);
  EXPECT_NEAR(y.values.symmetric->high, 3.92, 0.05);
}

TEST(Jcgm101, AdditiveModelOfRectangularQuantities) {
  const double half = std::sqrt(3.0);
  std::vector<Source> sources;
  for (const char* name : {"a", "b", "c", "d"})
    sources.push_back(source(name, Uniform{-half, half}));
  const Answer y = answerOf(studyOf(sources, 200'000), sum);
  EXPECT_NEAR(y.values.deviation, 2.00, 0.015);
  EXPECT_NEAR(y.values.symmetric->low, -3.88, 0.04);
  EXPECT_NEAR(y.values.symmetric->high, 3.88, 0.04);
}

TEST(Jcgm101, AdditiveModelWithOneLargeRectangle) {
  const double half = std::sqrt(3.0);
  std::vector<Source> sources;
  for (const char* name : {"a", "b", "c"})
    sources.push_back(source(name, Uniform{-half, half}));
  sources.push_back(source("d", Uniform{-10 * half, 10 * half}));
  const Answer y = answerOf(studyOf(sources, 200'000), sum);
  EXPECT_NEAR(y.values.deviation, 10.1, 0.06);
  EXPECT_NEAR(y.values.symmetric->low, -17.0, 0.1);
  EXPECT_NEAR(y.values.symmetric->high, 17.0, 0.1);
}

TEST(Jcgm101, MassCalibration) {
  const Study study = studyOf({source("reference", Normal{100'000.000, 0.050}), source("added", Normal{1.234, 0.020}),
                               source("air", Uniform{1.10, 1.30}), source("weight", Uniform{7000, 9000}),
                               source("standard", Uniform{7950, 8050})},
                              200'000);
  const Answer y = answerOf(study, [](const std::vector<double>& x) {
    return (x[0] + x[1]) * (1 + (x[2] - 1.2) * (1 / x[3] - 1 / x[4])) - 100'000;
  });
  EXPECT_NEAR(y.values.mean, 1.2341, 0.0008);
  EXPECT_NEAR(y.values.deviation, 0.0754, 0.0006);
  EXPECT_NEAR(y.values.shortest->low, 1.0834, 0.004);
  EXPECT_NEAR(y.values.shortest->high, 1.3825, 0.004);
}

TEST(Jcgm101, GaugeBlockCalibration) {
  Study study = studyOf({source("standard", Student{50'000'623, 25, 18}), source("difference", Student{215, 6, 24}),
                         source("random", Student{0, 4, 5}), source("systematic", Student{0, 7, 8}),
                         source("expansion", Uniform{9.5e-6, 13.5e-6}), source("temperature", Normal{-0.1, 0.2}),
                         source("cycle", UShaped{-0.5, 0.5}), source("expansions", InexactLimits{-1e-6, 1e-6, 0.1e-6}),
                         source("temperatures", InexactLimits{-0.050, 0.050, 0.025})},
                        60'000);
  study.coverage = 0.99;
  const Answer y = answerOf(study, [](const std::vector<double>& x) {
    return x[0] + x[1] + x[2] + x[3] - x[0] * (x[7] * (x[5] + x[6]) + x[4] * x[8]) - 50'000'000;
  });
  EXPECT_NEAR(y.values.mean, 838, 0.5);
  EXPECT_NEAR(y.values.deviation, 36, 0.7);
  EXPECT_NEAR(y.values.shortest->low, 745, 4);
  EXPECT_NEAR(y.values.shortest->high, 932, 4);
}

TEST(Jcgm101, AdaptiveProcedureEndsWhenTwoDigitsAreStable) {
  Study study = studyOf(
      {source("a", Normal{0, 1}), source("b", Normal{0, 1}), source("c", Normal{0, 1}), source("d", Normal{0, 1})}, 1);
  study.trials.reset();
  study.digits = 2;
  const StudyResult result = runStudy(study, {}, modelOf(sum), {});
  EXPECT_EQ(result.end, StudyEnd::Stable);
  EXPECT_EQ(result.trials % study.block, 0U);
  EXPECT_GT(result.trials, study.block);
  // u = 2.0 and an interval of -3.9 to 3.9, each to half a unit of the last digit.
  EXPECT_NEAR(result.answers.front().values.deviation, 2.0, 0.05);
  EXPECT_NEAR(result.answers.front().values.symmetric->high, 3.92, 0.05);
}

/// The user's manual of the NIST Uncertainty Machine: a copper bar whose length is measured at two temperatures. Mean
/// and standard uncertainty as printed there; to first order they are 1.727e-5 and 0.176e-5.
TEST(NistUncertaintyMachine, CoefficientOfThermalExpansion) {
  const Study study = studyOf({source("cold", Normal{1.4999, 0.0001}), source("warm", Normal{1.5021, 0.0002}),
                               source("from", Normal{288.15, 0.02}), source("to", Normal{373.10, 0.05})},
                              200'000);
  const Answer y =
      answerOf(study, [](const std::vector<double>& x) { return 1e5 * (x[1] - x[0]) / (x[0] * (x[3] - x[2])); });
  EXPECT_NEAR(y.values.mean, 1.73, 0.005);
  EXPECT_NEAR(y.values.deviation, 0.18, 0.005);
}

/// The same manual, and example E3 of NIST Technical Note 1900: a falling ball in sodium hydroxide and in a liquid of
/// known viscosity. The times are so uncertain that the mean is not the value at the means.
TEST(NistUncertaintyMachine, DynamicViscosity) {
  const Study study = studyOf({source("knownViscosity", Normal{4.63, 0.01 * 4.63}), source("ball", Normal{2217, 0.5}),
                               source("knownLiquid", Normal{810, 0.5}), source("liquid", Normal{1180, 0.5}),
                               source("knownTime", Normal{36.6, 0.15 * 36.6}), source("time", Normal{61, 0.1 * 61})},
                              200'000);
  const auto viscosity = [](const std::vector<double>& x) {
    return x[0] * (x[1] - x[3]) / (x[1] - x[2]) * x[5] / x[4];
  };
  const Answer y = answerOf(study, viscosity);
  EXPECT_NEAR(*y.estimate, 5.69, 0.005);
  // As printed, and three standard deviations of what 200,000 trials find.
  EXPECT_NEAR(y.values.mean, 5.82, 0.005 + 0.0075);
  EXPECT_NEAR(y.values.deviation, 1.11, 0.005 + 0.01);
  // The moments of the quotient by quadrature (of 1 / t within six standard deviations): 5.8252 and 1.1154.
  EXPECT_NEAR(y.values.mean, 5.8252, 0.0075);
  EXPECT_NEAR(y.values.deviation, 1.1154, 0.01);
  // The printed interval of 95 %, and three standard deviations of the two quantiles of 200,000 trials.
  EXPECT_NEAR(y.values.symmetric->low, 4.05, 0.005 + 0.015);
  EXPECT_NEAR(y.values.symmetric->high, 8.39, 0.005 + 0.05);
}

/// Example 10 of the manual: the Stefan-Boltzmann constant from five constants of CODATA 2010, with three intervals.
TEST(NistUncertaintyMachine, StefanBoltzmannConstant) {
  Study study =
      studyOf({source("planck", Normal{6.62606957e-34, 0.00000029e-34}), source("gas", Normal{8.3144621, 0.0000075}),
               source("rydberg", Normal{10973731.568539, 0.000055}),
               source("electron", Normal{5.4857990946e-4, 0.0000000022e-4}),
               source("fineStructure", Normal{7.2973525698e-3, 0.0000000024e-3})},
              200'000);
  const auto constant = [](const std::vector<double>& x) {
    const double molarMass = 0.001;
    const double light = 299'792'458;
    return 1e8 * 32 * std::pow(std::numbers::pi, 5) * x[0] * std::pow(x[1] * x[2], 4) /
           (15 * std::pow(x[3] * molarMass, 4) * std::pow(light, 6) * std::pow(x[4], 8));
  };
  const double lastDigit = 0.5e-5;
  for (const auto& [coverage, low, high] : {std::tuple{0.99, 5.67032, 5.67043}, std::tuple{0.68, 5.67035, 5.67039}}) {
    study.coverage = coverage;
    const Answer y = answerOf(study, constant);
    EXPECT_NEAR(y.values.mean, 5.67037, lastDigit);
    EXPECT_NEAR(y.values.deviation, 2.05e-5, 0.01e-5);
    EXPECT_NEAR(y.values.symmetric->low, low, lastDigit) << coverage;
    EXPECT_NEAR(y.values.symmetric->high, high, lastDigit) << coverage;
  }
}

double ishigami(const std::vector<double>& x) {
  return std::sin(x[0]) + 7 * std::pow(std::sin(x[1]), 2) + 0.1 * std::pow(x[2], 4) * std::sin(x[0]);
}

TEST(Sobol, FindsTheIndicesOfIshigamisFunction) {
  const double pi = std::numbers::pi;
  Study study =
      studyOf({source("a", Uniform{-pi, pi}), source("b", Uniform{-pi, pi}), source("c", Uniform{-pi, pi})}, 100);
  study.sensitivity = Sensitivity::Sobol;
  study.sensitivityTrials = 20'000;
  const Answer y = answerOf(study, ishigami);
  const double variance = 49.0 / 8 + 0.1 * std::pow(pi, 4) / 5 + 0.01 * std::pow(pi, 8) / 18 + 0.5;
  const double first[] = {std::pow(1 + 0.1 * std::pow(pi, 4) / 5, 2) / 2 / variance, 49.0 / 8 / variance, 0};
  const double third = 0.01 * std::pow(pi, 8) * (1.0 / 18 - 1.0 / 50) / variance;  // of a and c together
  const double total[] = {first[0] + third, first[1], third};
  ASSERT_EQ(y.indices.size(), 4U) << "three sources and the noise, which this function does not have";
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_TRUE(y.indices[i]);
    // Twice the half-width: four standard deviations.
    EXPECT_NEAR(y.indices[i]->first, first[i], 2 * y.indices[i]->firstHalfWidth + 1e-9) << i;
    EXPECT_NEAR(y.indices[i]->total, total[i], 2 * y.indices[i]->totalHalfWidth + 1e-9) << i;
    EXPECT_LT(y.indices[i]->firstHalfWidth, 0.04);
  }
  EXPECT_EQ(y.indices[3]->total, 0);
}

/// Of an interrupted study nobody knows how much is left unless what is announced is what is done.
TEST(Sobol, AnnouncesAsManyRunsAsItMakes) {
  Study study = studyOf({source("a", Normal{0, 1}), source("b", Normal{0, 2})}, 100);
  study.sensitivity = Sensitivity::Sobol;
  study.sensitivityTrials = 64;
  std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> last;
  StudyRun run;
  run.report = [&](const std::string& phase, std::uint64_t done, std::uint64_t of) {
    EXPECT_LE(done, of) << phase;
    last[phase] = {done, of};
  };
  runStudy(study, {}, modelOf(sum), run);
  // Two sources and the noise: 64 * (3 + 2) runs, beside the 100 trials.
  std::vector<std::uint64_t> made;
  for (const auto& [phase, progress] : last) {
    EXPECT_EQ(progress.first, progress.second) << phase;
    made.push_back(progress.second);
  }
  EXPECT_NE(std::ranges::find(made, 320U), made.end());
}

/// A constant adds nothing to the variance, however large it is beside it.
TEST(Sobol, DoesNotDependOnAConstant) {
  Study study = studyOf({source("a", Normal{0, 1}), source("b", Normal{0, 2})}, 100);
  study.sensitivity = Sensitivity::Sobol;
  study.sensitivityTrials = 64;
  const auto indicesOf = [&](double constant) {
    const Answer y =
        answerOf(study, [constant](const std::vector<double>& x) { return constant + x[0] + x[0] * x[1]; });
    return std::array{y.indices[0]->first, y.indices[0]->total, y.indices[1]->first, y.indices[1]->total};
  };
  const auto without = indicesOf(0), with = indicesOf(1000);
  for (std::size_t i = 0; i < without.size(); ++i)
    EXPECT_NEAR(with[i], without[i], 1e-9) << i;
}

TEST(OneAtATime, GivesTheBudgetOfALinearModel) {
  Study study = studyOf({source("a", Normal{5, 0.3}), source("b", Uniform{-1, 1})}, 100);
  study.sensitivity = Sensitivity::OneAtATime;
  study.sensitivityTrials = 20'000;
  const Answer y = answerOf(study, [](const std::vector<double>& x) { return 2 * x[0] - 4 * x[1]; });
  ASSERT_EQ(y.contributions.size(), 3U);
  EXPECT_NEAR(*y.contributions[0].sensitivity, 2, 1e-9);
  EXPECT_NEAR(*y.contributions[1].sensitivity, -4, 1e-9);
  EXPECT_NEAR(*y.contributions[0].uncertainty, 0.6, 0.6 * 0.03);
  EXPECT_NEAR(*y.contributions[1].uncertainty, 4 / std::sqrt(3.0), 2.4 * 0.03);
  EXPECT_EQ(*y.contributions[2].uncertainty, 0);
}

TEST(Groups, HaveTheCovarianceThatIsAskedFor) {
  Study study = studyOf({source("a", Normal{1, 2}), source("b", Normal{0, 3})}, 100'000);
  Group group{"both", {0, 1}, Eigen::MatrixXd(2, 2)};
  // Cholesky's factor of the correlation 0.6.
  group.factor << 1, 0, 0.6, 0.8;
  study.groups.push_back(group);
  const Answer y = answerOf(study, [](const std::vector<double>& x) { return x[0] + x[1]; });
  // 4 + 9 + 2 * 0.6 * 2 * 3
  EXPECT_NEAR(y.values.deviation, std::sqrt(20.2), 0.045);
  EXPECT_NEAR(y.values.mean, 1, 0.06);
}

/// The study of AIAG's manual on measurement systems analysis (4th edition, III-B), by analysis of variance.
TEST(GaugeRR, GivesThePublishedTable) {
  const double a[3][10] = {{0.29, -0.56, 1.34, 0.47, -0.80, 0.02, 0.59, -0.31, 2.26, -1.36},
                           {0.41, -0.68, 1.17, 0.50, -0.92, -0.11, 0.75, -0.20, 1.99, -1.25},
                           {0.64, -0.58, 1.27, 0.64, -0.84, -0.21, 0.66, -0.17, 2.01, -1.31}};
  const double b[3][10] = {{0.08, -0.47, 1.19, 0.01, -0.56, -0.20, 0.47, -0.63, 1.80, -1.68},
                           {0.25, -1.22, 0.94, 1.03, -1.20, 0.22, 0.55, 0.08, 2.12, -1.62},
                           {0.07, -0.68, 1.34, 0.20, -1.28, 0.06, 0.83, -0.34, 2.19, -1.50}};
  const double c[3][10] = {{0.04, -1.38, 0.88, 0.14, -1.46, -0.29, 0.02, -0.46, 1.77, -1.49},
                           {-0.11, -1.13, 1.09, 0.20, -1.07, -0.67, 0.01, -0.56, 1.45, -1.77},
                           {-0.15, -0.96, 0.67, 0.11, -1.45, -0.49, 0.21, -0.49, 1.87, -2.16}};
  std::vector<double> values;
  for (int part = 0; part < 10; ++part) {
    for (const auto& appraiser : {a, b, c})
      for (int repeat = 0; repeat < 3; ++repeat)
        values.push_back(appraiser[repeat][part]);
  }
  const auto study = gaugeRR(values, 10, 3, 3, std::nullopt);
  ASSERT_TRUE(study);
  EXPECT_NEAR(study->part.sumOfSquares, 88.3619, 5e-4);
  EXPECT_NEAR(study->appraiser.sumOfSquares, 3.1673, 5e-4);
  EXPECT_NEAR(study->interaction.sumOfSquares, 0.3590, 5e-4);
  EXPECT_NEAR(study->repeat.sumOfSquares, 2.7589, 5e-4);
  EXPECT_NEAR(study->total.sumOfSquares, 94.6471, 5e-4);
  EXPECT_EQ(study->part.degreesOfFreedom, 9);
  EXPECT_EQ(study->appraiser.degreesOfFreedom, 2);
  EXPECT_EQ(study->interaction.degreesOfFreedom, 18);
  EXPECT_EQ(study->repeat.degreesOfFreedom, 60);
  EXPECT_EQ(study->total.degreesOfFreedom, 89);
  EXPECT_TRUE(study->pooled);
  EXPECT_NEAR(study->repeatability, 0.199933, 5e-5);
  EXPECT_NEAR(study->reproducibility, 0.226838, 5e-5);
  EXPECT_NEAR(study->gauge, 0.302373, 5e-5);
  EXPECT_NEAR(study->partVariation, 1.042327, 5e-5);
  EXPECT_NEAR(study->totalVariation, 1.085, 5e-3);
  EXPECT_EQ(study->distinctCategories, 4);
}

/// Two appraisers who differ by part: cells of 0, 2, 2 and 0, each repeated 0.1 above and below. MS of the interaction
/// is 2 * 4 * 1 / 1, of the repetitions 8 * 0.01 / 4; the interaction's variance is (8 - 0.02) / 2.
TEST(GaugeRR, CountsTheInteractionToTheAppraisers) {
  std::vector<double> values;
  for (const double cell : {0.0, 2.0, 2.0, 0.0})
    for (const double apart : {-0.1, 0.1})
      values.push_back(cell + apart);
  const auto study = gaugeRR(values, 2, 2, 2, std::nullopt);
  ASSERT_TRUE(study);
  EXPECT_FALSE(study->pooled);
  EXPECT_NEAR(study->repeatability, std::sqrt(0.02), 1e-12);
  EXPECT_NEAR(study->reproducibility, std::sqrt(3.99), 1e-12);
}

}  // namespace
}  // namespace probewright::study::testing
