#include "study/first_order.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>

#include "metrology/fits.hpp"
#include "setup/simulated_run.hpp"
#include "study/program_bench.hpp"

namespace probewright::study::testing {
namespace {

struct Ran {
  std::map<std::string, std::optional<double>> uncertainties;  ///< by cycle and name
  std::map<std::string, bool> holds;
  std::string text;
  FirstOrder done;
};

/// With a scatter of its own, if one is given: that of the touches stays that of the setup.
Ran runWith(const std::string& setupText, const std::string& text, std::optional<double> scatter = {},
            const std::string& file = "p.h") {
  Diagnostics mistakes;
  const auto setup = setup::parseSetup(setupText, "setup.toml", mistakes);
  EXPECT_TRUE(setup);
  auto run = setup::runText(file, text, *setup, {});
  EXPECT_EQ(run.outcome.result.end, execution::RunEnd::Finished);
  EXPECT_FALSE(hasErrors(run.outcome.diagnostics)) << format(run.outcome.diagnostics.front());
  Ran ran;
  simulation::Truth truth = setup->world.truth;
  for (simulation::TrueTool& tool : truth.tools)
    if (scatter) tool.probe.repeatability = *scatter;
  ran.done = addUncertainties(run.outcome.journal, truth);
  ran.text = firstOrderText(run.outcome.journal, ran.done);
  const auto& cycles = run.outcome.journal.cycles;
  for (std::size_t c = 0; c < cycles.size(); ++c) {
    for (std::size_t i = 0; i < cycles[c].results.size(); ++i) {
      const auto& result = cycles[c].results[i];
      ran.uncertainties[cycles[c].name + " " + result.name] = result.uncertainty;
      ran.holds[cycles[c].name + " " + result.name] = !ran.done.doubtful.contains({c, i});
    }
  }
  return ran;
}

const std::string side =
    "5 TCH PROBE 427 SIDE ~\nQ263=+40 ~\nQ264=+0 ~\nQ261=-5 ~\nQ320=+2 ~\nQ272=+1 ~\nQ267=-1 ~\n"
    "Q260=+30 ~\nQ281=+0 ~\nQ288=+0 ~\nQ289=+0 ~\nQ309=+0 ~\nQ330=+0\n";
const std::string width =
    "6 TCH PROBE 426 WIDTH ~\nQ263=+20 ~\nQ264=-30 ~\nQ265=+20 ~\nQ266=+30 ~\nQ272=+2 ~\nQ261=-5 ~\n"
    "Q320=+2 ~\nQ260=+30 ~\nQ311=+60 ~\nQ288=+0 ~\nQ289=+0 ~\nQ281=+0 ~\nQ309=+0 ~\nQ330=+0\n";
const std::string edge =
    "7 TCH PROBE 420 EDGE ~\nQ263=-30 ~\nQ264=-30 ~\nQ265=+30 ~\nQ266=-30 ~\nQ272=+2 ~\nQ267=+1 ~\n"
    "Q261=-5 ~\nQ320=+2 ~\nQ260=+30 ~\nQ301=+0 ~\nQ281=+0\n";
const std::string plane =
    "8 TCH PROBE 431 PLANE ~\nQ263=-30 ~\nQ264=-25 ~\nQ294=+0 ~\nQ265=+30 ~\nQ266=-25 ~\nQ295=+0 ~\nQ296=-30 ~\n"
    "Q297=+25 ~\nQ298=+0 ~\nQ320=+2 ~\nQ260=+30 ~\nQ281=+0\n";

TEST(FirstOrder, IsTheClosedFormOfEachCycle) {
  const double s = 0.002, degree = 180 / std::numbers::pi;
  const Ran ran = runWith(plateSetup(), program(bore(3, 4) + side + width + edge + plane));
  const std::map<std::string, double> expected = {
      {"421 Q151", s / std::sqrt(2.0)},
      {"421 Q153", s},
      {"427 Q160", s},
      {"426 Q156", s * std::sqrt(2.0)},
      {"426 Q157", s / std::sqrt(2.0)},
      {"420 Q150", s * std::sqrt(2.0) / 60 * degree},
      {"431 Q159", s * std::sqrt(2.0) / 60 * degree},
      {"431 Q158", s * std::sqrt(2.0) / 50 * degree},
  };
  for (const auto& [key, u] : expected) {
    ASSERT_TRUE(ran.uncertainties.contains(key)) << key;
    ASSERT_TRUE(ran.uncertainties.at(key)) << key;
    // The scattered touches do not lie quite evenly.
    EXPECT_NEAR(*ran.uncertainties.at(key), 2 * u, 2 * u * 1e-3) << key;
  }
  EXPECT_FALSE(ran.uncertainties.at("431 Q170")) << "space angles are not known to first order";
  EXPECT_GT(ran.done.given, 8U);
  EXPECT_GT(ran.done.withheld, 0U);
  EXPECT_TRUE(ran.done.notHeld.empty());
}

/// Cycle 444 on the side of the part towards minus Y.
std::string alongNormal(double main, double minor) {
  return fmt::format(
      "9 TCH PROBE 444 IN 3-D ~\nQ263=-10 ~\nQ264=-30 ~\nQ294=-5 ~\nQ581={:+} ~\nQ582={:+} ~\nQ583=+0 ~\nQ320=+2 "
      "~\nQ260=+30 ~\nQ309=+0\n",
      main, minor);
}

TEST(FirstOrder, LetsASingleTouchScatterAlongItsWayOnly) {
  const double s = 0.002;
  const Ran askew = runWith(plateSetup(), program(alongNormal(0.6, -0.8)));
  for (const auto& [result, share] :
       {std::pair("Q151", 0.6), {"Q161", 0.6}, {"Q152", 0.8}, {"Q162", 0.8}, {"Q164", 1.0}}) {
    const auto u = askew.uncertainties.at(std::string("444 ") + result);
    ASSERT_TRUE(u) << result;
    EXPECT_NEAR(*u, 2 * share * s, 1e-12) << result;
  }
  EXPECT_FALSE(askew.uncertainties.at("444 Q153")) << "it is where the program has put the probe";
  const Ran square = runWith(plateSetup(), program(alongNormal(0, -1)));
  EXPECT_FALSE(square.uncertainties.at("444 Q151"));
  EXPECT_NEAR(*square.uncertainties.at("444 Q152"), 2 * s, 1e-12);
}

TEST(FirstOrder, CountsAxesInTheWorkingPlane) {
  const std::string setup = std::string(plateSetup()).replace(plateSetup().find("TNC640"), 6, "840Dsl") +
                            "[parameters]\n\"$SC_TOOL_LENGTH_CONST\" = 17\n";
  const auto from = setup.find("[[preset]]");
  const std::string world = setup.substr(0, from) + "[[zero_offset]]\nname = \"G54\"\n" + setup.substr(from + 19);
  // In G18 the 1st axis is Z, the 2nd X: the side towards minus X, then the width along X, from below the part.
  const std::string text =
      "G18 G90 G71 G54\nT=\"PROBE\" M6 D1\nG0 X-50 Y0\nZ20\nG1 Z-5 F3000\n"
      "CYCLE978(0,,,1,-40,8,4,2,1,1,\"\",,0,,0,0,,,,,,)\n"
      "G0 Z20\nX0 Y-45\nG1 Z-5\nCYCLE977(4,0,0,1,80,,,8,4,0,25,,,2,1,\"\",,0,,0,0,,,,,,)\nM30\n";
  const Ran ran = runWith(world, text, {}, "p.mpf");
  const double s = 0.002;
  for (const auto& [result, u] : {std::pair("CYCLE978 _OVR[4]", s),
                                  {"CYCLE978 _OVR[6]", s},
                                  {"CYCLE977 _OVR[4]", s * std::sqrt(2.0)},
                                  {"CYCLE977 _OVR[6]", s / std::sqrt(2.0)}}) {
    ASSERT_TRUE(ran.uncertainties.contains(result)) << result;
    ASSERT_TRUE(ran.uncertainties.at(result)) << result;
    EXPECT_NEAR(*ran.uncertainties.at(result), 2 * u, 1e-12) << result;
  }
  EXPECT_FALSE(ran.uncertainties.at("CYCLE977 _OVR[5]")) << "along Z nothing was touched";
}

TEST(FirstOrder, SaysWhatItDoesNotHold) {
  const Ran lobes =
      runWith(plateSetup("repeatability = 0.001\nlobing = 0.001\n", "[errors.axis.X]\nbacklash = 0.001\n"),
              program(bore(3, 4)));
  EXPECT_THAT(lobes.done.notHeld,
              ::testing::ElementsAre(::testing::HasSubstr("lobes"), ::testing::HasSubstr("machine")));
  // A preset of its own scatters, and what is measured from it scatters by that as well.
  const std::string preset =
      "3 TCH PROBE 417 REF. POINT TS.-AXIS ~\nQ263=+30 ~\nQ264=+20 ~\nQ294=+0 ~\nQ320=+2 ~\nQ260=+20 ~\nQ305=+1 "
      "~\nQ333=+0 ~\nQ303=+1\n";
  const auto earlier = ::testing::ElementsAre(::testing::HasSubstr("earlier cycles have set"));
  EXPECT_THAT(runWith(plateSetup(), program(preset + bore(11, 4))).done.notHeld, earlier);
  EXPECT_THAT(runWith(plateSetup(), program(bore(3, 4) + preset)).done.notHeld, ::testing::Not(earlier));
  const Ran none = runWith(plateSetup(""), program(bore(3, 4)));
  EXPECT_EQ(none.done.given, 0U);
  EXPECT_FALSE(none.uncertainties.at("421 Q151"));
  EXPECT_THAT(none.done.notHeld, ::testing::ElementsAre(::testing::HasSubstr("no repeatability")));
}

/// Cycle 421 by so many touches, the first at an angle and the others a step apart, degrees.
std::string arc(double start, double step, int points) {
  return fmt::format(
      "4 TCH PROBE 421 MEASURE HOLE ~\nQ273=+0 ~\nQ274=+0 ~\nQ262=+30 ~\nQ325={:+.3f} ~\nQ247={:+.3f} ~\nQ261=-5 ~\n"
      "Q320=+2 ~\nQ260=+20 ~\nQ301=+0 ~\nQ275=+0 ~\nQ276=+0 ~\nQ279=+0 ~\nQ280=+0 ~\nQ281=+0 ~\nQ309=+0 ~\n"
      "Q330=+0 ~\nQ423=+{} ~\nQ365=+1\n",
      start, step, points);
}

TEST(FirstOrder, SaysWhereItIsNotTrustworthy) {
  const Ran shortArc = runWith(plateSetup("repeatability = 0.02\n"), program(arc(20, 6, 4)));
  EXPECT_FALSE(shortArc.holds.at("421 Q153"));
  EXPECT_FALSE(shortArc.done.doubtful.empty());
  EXPECT_THAT(shortArc.text, ::testing::ContainsRegex("421 Q153: .*not trustworthy: first order"));
  EXPECT_THAT(shortArc.text, ::testing::HasSubstr("probewright study"));
  const Ran full = runWith(plateSetup("repeatability = 0.0005\n"), program(arc(0, 90, 4)));
  for (const char* result : {"421 Q151", "421 Q152", "421 Q153"})
    EXPECT_TRUE(full.holds.at(result)) << result;
  EXPECT_TRUE(full.done.doubtful.empty());
  EXPECT_THAT(full.text, ::testing::Not(::testing::HasSubstr("trustworthy")));
}

TEST(FirstOrder, IsTrustedWhereResultsFollowTheTouchesLinearly) {
  for (const double scatter : {1e-6, 0.001, 0.3}) {
    const Ran ran = runWith(plateSetup(""), program(side + width + edge + plane), scatter);
    for (const auto& [key, holds] : ran.holds)
      EXPECT_TRUE(holds) << key << " " << scatter;
    EXPECT_GT(ran.done.given, 5U);
  }
}

/// The fit of a bore of 30 mm by a ball of 6 mm whose touches scatter: how far centre and diameter are from the true
/// ones (root of the mean square) over what first order says, less 1. Infinite if some touches make no circle.
std::array<double, 3> wrongBy(double start, double step, int points, double scatter, std::mt19937_64& random) {
  const double radius = 12;
  std::vector<Vector2> outwards;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  for (int i = 0; i < points; ++i) {
    const double angle = (start + i * step) * std::numbers::pi / 180;
    outwards.emplace_back(std::cos(angle), std::sin(angle));
    const Vector3 row(outwards.back().x(), outwards.back().y(), 1);
    normal += row * row.transpose();
  }
  const Eigen::Matrix3d cofactors = normal.inverse();
  std::normal_distribution<double> error(0, scatter);
  std::array<double, 3> squares{};
  constexpr int trials = 6000;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<Vector2> touches;
    for (const Vector2& way : outwards)
      touches.emplace_back((radius + error(random)) * way);
    const auto fit = metrology::fitCircle(touches);
    const double none = std::numeric_limits<double>::infinity();
    if (!fit) return {none, none, none};
    squares[0] += std::pow(fit->shape.centre.x(), 2) / trials;
    squares[1] += std::pow(fit->shape.centre.y(), 2) / trials;
    squares[2] += std::pow(fit->shape.radius - radius, 2) / trials;
  }
  std::array<double, 3> wrong{};
  for (int i = 0; i < 3; ++i)
    wrong[static_cast<std::size_t>(i)] =
        std::abs(std::sqrt(squares[static_cast<std::size_t>(i)] / cofactors(i, i)) / scatter - 1);
  return wrong;
}

/// Random arcs: the mark says what many fits of scattered touches say, unless these are near to 5 % themselves.
TEST(FirstOrder, IsMarkedWhereManyFitsSayAnotherValue) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  int marked = 0, trusted = 0;
  for (int world = 0; world < 60; ++world) {
    const int points = 3 + world % 2;
    const double start = 360 * unit(random), step = 5 * std::pow(12, unit(random));
    const double scatter = 0.0005 * std::pow(60, unit(random));
    const Ran ran = runWith(plateSetup(""), program(arc(start, step, points)), scatter);
    const auto wrong = wrongBy(start, step, points, scatter, random);
    for (std::size_t i = 0; i < 3; ++i) {
      if (wrong[i] > 0.03 && wrong[i] < 0.08) continue;
      const std::string key = "421 Q15" + std::to_string(i + 1);
      EXPECT_EQ(ran.holds.at(key), wrong[i] < 0.05) << key << ": " << points << " touches from " << start << " by "
                                                    << step << ", s = " << scatter << ", wrong by " << wrong[i];
      ++(ran.holds.at(key) ? trusted : marked);
    }
  }
  EXPECT_GT(marked, 8);
  EXPECT_GT(trusted, 20);
}

/// 2,000 worlds whose part lies anyhow: the interval of +-1.96 u about each measured value holds the true one in 95 %
/// of them.
TEST(FirstOrder, CoversTheTruthAsOftenAsItSays) {
  const TestFolder folder;
  Diagnostics mistakes;
  auto document = setup::SetupDocument::parse(plateSetup(), "setup.toml", mistakes);
  ASSERT_TRUE(document);
  const auto study = parseStudy(R"(
seed = 5
trials = 1
[[source]]
quantity = "part.pose.x"
distribution = "uniform"
half_width = 0.8
[[source]]
quantity = "part.pose.y"
distribution = "uniform"
half_width = 0.8
)",
                                "study.toml", document->table(), mistakes);
  ASSERT_TRUE(study);
  const auto model = ProgramModel::make(folder.file("p.h", program(bore(3, 4) + side + width)), std::move(*document),
                                        *study, {}, mistakes);
  ASSERT_TRUE(model);
  const Sampler sampler(*study);
  std::vector<Draw> draws;
  for (std::uint64_t trial = 0; trial < 2000; ++trial)
    draws.push_back(sampler.draw(trial));
  const auto outcomes = runTrials([&](const Draw& draw) { return model->run(draw); }, draws, 0);
  std::map<std::string, int> covered;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const double x = draws[i].inputs[0], y = draws[i].inputs[1];
    const std::map<std::string, double> truths = {{"421@4 Q151", x},       {"421@4 Q152", y},   {"421@4 Q153", 30},
                                                  {"427@23 Q160", 40 + x}, {"426@36 Q156", 60}, {"426@36 Q157", y}};
    for (const Observation& observation : outcomes[i].observations) {
      const auto truth = truths.find(observation.of.key);
      if (truth == truths.end()) continue;
      ASSERT_TRUE(observation.of.firstOrder) << observation.of.key;
      const bool within = std::abs(observation.value - truth->second) <= 1.96 * *observation.of.firstOrder;
      covered[observation.of.key] += within ? 1 : 0;
    }
  }
  ASSERT_EQ(covered.size(), 6U);
  for (const auto& [key, count] : covered) {
    EXPECT_GE(count, 2000 * 0.94) << key;
    EXPECT_LE(count, 2000 * 0.96) << key;
  }
}

}  // namespace
}  // namespace probewright::study::testing
