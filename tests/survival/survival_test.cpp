#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "survival/survival_bench.hpp"
#include "survival/survival_records.hpp"

namespace probewright::survival::testing {
namespace {

using ::testing::HasSubstr;

/// How far one number may go before a run fails, found by runs alone.
double limitByRuns(const ClampedProgram& program, double survives, double fails) {
  for (int i = 0; i < 14; ++i) {
    const double middle = (survives + fails) / 2;
    (program.run(std::vector<double>{middle}, 1).failure ? fails : survives) = middle;
  }
  return survives;
}

TEST(Survive, ProvesNoMoreThanWhatRunsSurviveAndMostOfIt) {
  // What a cycle corrects bends what comes later: such a program needs more boxes, each of them small.
  for (const auto& [blocks, boxes] : {std::pair{inspectBore, std::uint64_t{60}}, {presetInBore + inspectBore, 200}}) {
    const auto program = clamped(plateSetup(), klartext(blocks), {"part.pose.x=8"});
    const double right = limitByRuns(*program, 0, 8), left = -limitByRuns(*program, 0, -8);
    const double limit = std::min(left, right);
    ASSERT_GT(limit, 0.5);
    ASSERT_LT(limit, 7.9);
    const Survival survival = survive(*program, {.samples = 10, .boxes = boxes});
    EXPECT_EQ(survival.end, SurvivalEnd::Finished);
    EXPECT_LE(8 * survival.symmetric, limit + 1e-3);
    EXPECT_GE(8 * survival.symmetric, 0.75 * limit);
    EXPECT_LE(survival.proven, (left + right) / 16 + 1e-3);
  }
}

/// A corner that is measured turns what comes later, the more the farther it is.
TEST(Survive, ProvesSmallBoxesAfterACorner) {
  const std::string corner =
      "TCH PROBE 414 CORNER ~\nQ263=-30 ~\nQ264=-30 ~\nQ326=+20 ~\nQ296=-40 ~\nQ297=-20 ~\nQ327=+20 ~\nQ261=-8 ~\n"
      "Q320=+3 ~\nQ260=+20 ~\nQ301=+1 ~\nQ304=+0 ~\nQ305=+1 ~\nQ331=-40 ~\nQ332=-30 ~\nQ303=+1 ~\nQ381=+0 ~\n"
      "Q382=+0 ~\nQ383=+0 ~\nQ384=+0 ~\nQ333=+0\n";
  const Survival survival = survivalOf(plateSetup(), klartext(corner + inspectBore), {"part.pose.x=0.1"},
                                       {.samples = 10, .boxes = 24, .checks = 20});
  EXPECT_EQ(survival.end, SurvivalEnd::Finished);
  EXPECT_EQ(survival.failed, 0U);
  EXPECT_GT(survival.proven, 0.25) << survivalText(survival);
}

/// The program sets Z on the top face first: the height of the part matters only as far as this touch reaches.
TEST(Survive, FollowsWhatIsMeasured) {
  const std::string setup = plateSetup();
  const Survival closed = survivalOf(setup, klartext(presetOnTop + inspectBore), {"part.pose.z=1.5"});
  EXPECT_EQ(closed.symmetric, 1) << survivalText(closed);
}

/// Where the face is higher than believed, the control goes up first and then across; where it is lower, it does not.
TEST(Survive, ProvesBoxesInWhichAMoveComesAndGoes) {
  const Survival survival = survivalOf(plateSetup(), klartext(presetOnTop + inspectBore),
                                       {"part.pose.z=-500.12..-499.97"}, {.samples = 4, .boxes = 1});
  EXPECT_EQ(survival.proven, 1) << survivalText(survival);
}

TEST(Survive, NamesTheBlockThatFails) {
  const Survival survival = survivalOf(plateSetup(), klartext(inspectBore), {"part.pose.x=20"});
  EXPECT_GT(survival.failed, 0U);
  ASSERT_FALSE(survival.blocks.empty());
  EXPECT_EQ(survival.blocks.front().place.line, 4U);
  EXPECT_EQ(survival.blocks.front().place.file, "p.h");
  ASSERT_TRUE(survival.nearestFailure);
  EXPECT_LT(survival.symmetric, *survival.nearestFailure);
  ASSERT_TRUE(survival.openProbability);
  EXPECT_LT(survival.openProbability->low, 1);
  EXPECT_GT(survival.openProbability->high, survival.openProbability->low);
}

TEST(Survive, EveryFailureFailsWhenItIsRun) {
  const auto program = clamped(plateSetup(), klartext(inspectBore), {"part.pose.x=12", "part.pose.z=12"});
  const Survival survival = survive(*program, {.samples = 60, .boxes = 10});
  ASSERT_FALSE(survival.failures.empty());
  for (const Failure& failure : survival.failures)
    EXPECT_TRUE(program->run(failure.values, failure.noise).failure);
}

TEST(Survive, CoversTurnsSizesAndLengths) {
  const Survival survival =
      survivalOf(plateSetup(), klartext(inspectBore),
                 {"part.pose.c=1", "part.pose.a=0.2", "part.feature[2].diameter=0.4", "part.feature[1].size[1]=0.3",
                  "tool[PROBE].stylus_length=2", "tool[PROBE].length=0.3"},
                 {.samples = 10, .boxes = 20});
  EXPECT_GT(survival.symmetric, 0.1) << survivalText(survival);
  EXPECT_EQ(survival.end, SurvivalEnd::Finished);
  EXPECT_GE(survival.samples, 64U + 10U);
}

/// The bore may be too narrow for the ball on its way down.
TEST(Survive, SeesSizesThatAreTooSmall) {
  const Survival survival = survivalOf(plateSetup(), klartext(inspectBore), {"part.feature[2].diameter=12..32"});
  EXPECT_GT(survival.failed, 0U);
  EXPECT_LT(survival.proven, 0.6);
}

/// A step of 2 mm at X-20: beyond it the ball touches another face than the one that is meant.
TEST(Survive, SeesTouchesOfAnotherFace) {
  const std::string setup = plateSetup("TNC640", "",
                                       "[[part.feature]]\nshape = \"box\"\nmode = \"cut\"\n"
                                       "centre = [-35, 0, 18]\nsize = [30, 60, 2]\n");
  const std::string program = klartext(
      "TCH PROBE 427 MEASURE COORDINATE ~\nQ263=-17 ~\nQ264=-20 ~\nQ261=+0 ~\nQ320=+2 ~\nQ272=+3 ~\nQ267=-1 "
      "~\nQ260=+20 "
      "~\nQ281=+0 ~\nQ288=+0 ~\nQ289=+0 ~\nQ309=+0 ~\nQ330=+0\n");
  const auto made = clamped(setup, program, {"part.pose.x=10"});
  ASSERT_FALSE(made->failureAsWritten());
  EXPECT_FALSE(made->run(std::vector<double>{2.0}, 1).failure);
  const auto beyond = made->run(std::vector<double>{8.0}, 1);
  ASSERT_TRUE(beyond.failure);
  EXPECT_THAT(beyond.failure->why, HasSubstr("another face"));
  const Survival survival = survive(*made, {.samples = 20, .boxes = 40});
  EXPECT_EQ(survival.end, SurvivalEnd::Finished);
  // The edge is 3 mm away; the ball, 3 mm too, touches it sooner or later, but its lowest point is over the face.
  EXPECT_LE(10 * survival.symmetric, 3 + 1e-3);
  EXPECT_GE(10 * survival.symmetric, 1);
}

/// A clamp stands 5 mm beside the way to the bore.
TEST(Survive, SeesFixturesThatMoveAlone) {
  const std::string setup = plateSetup("TNC640", "", R"(
[[fixture]]
name = "clamp"
pose = { x = 60, y = 0, z = -500 }
[[fixture.feature]]
shape = "box"
size = [20, 20, 120]
)");
  const auto made = clamped(setup, klartext(inspectBore), {"fixture[clamp].pose.x=50"});
  ASSERT_TRUE(made);
  const Survival survival = survive(*made, {.samples = 40, .boxes = 30});
  EXPECT_GT(survival.failed, 0U);
  EXPECT_GT(survival.proven, 0.3) << survivalText(survival);
  EXPECT_EQ(survival.end, SurvivalEnd::Finished);
}

TEST(Survive, ProvesNothingOfProgramsThatComputeWithResults) {
  for (const char* block : {"Q1 = Q153 - 30\nL X+Q1 R0 FMAX\n", "FN 9: IF +Q153 EQU +30 GOTO LBL 7\nLBL 7\n",
                            "FN 18: SYSREAD Q2 = ID270 NR1 IDX1\nL X+Q2 R0 FMAX\n"}) {
    const Survival survival =
        survivalOf(plateSetup(), klartext(inspectBore + block), {"part.pose.x=0.1"}, {.samples = 3, .boxes = 5});
    EXPECT_EQ(survival.proven, 0) << block;
    ASSERT_TRUE(survival.obstacle) << block;
    EXPECT_THAT(survival.obstacle->why, HasSubstr("may be a measured value"));
    EXPECT_GT(survival.obstacle->place.line, 4U);
    EXPECT_EQ(survival.openSamples, 3U);
  }
  // What the program sets itself is its own.
  const Survival own = survivalOf(plateSetup(), klartext("Q1 = 10 * 2\nL X+Q1 R0 FMAX\n" + inspectBore),
                                  {"part.pose.x=0.1"}, {.samples = 3, .boxes = 5});
  EXPECT_EQ(own.proven, 1) << survivalText(own);
}

/// Cycles write Q100 to Q199, Q600 to Q699 and Q900 to Q999; all others are the program's.
TEST(Survive, KnowsWhichParametersCyclesWrite) {
  const auto obstacle = [](int number) {
    const std::string blocks = fmt::format("Q{0} = 20\nQ1 = Q{0} - 10\nL X+Q1 R0 FMAX\n", number);
    const auto made = clamped(plateSetup(), klartext(blocks), {"part.pose.x=0.1"});
    return made && made->obstacle().has_value();
  };
  for (const int number : {100, 199, 600, 699, 900, 999})
    EXPECT_TRUE(obstacle(number)) << number;
  for (const int number : {99, 200, 599, 700, 899, 1000})
    EXPECT_FALSE(obstacle(number)) << number;
}

TEST(Survive, SaysThatTheSetupAsWrittenFails) {
  std::string setup = plateSetup();
  setup.replace(setup.find("x = 0, y"), 5, "x = 25");
  const Survival survival = survivalOf(setup, klartext(inspectBore), {"part.pose.y=0.1"});
  EXPECT_EQ(survival.end, SurvivalEnd::FailsAsWritten);
  ASSERT_TRUE(survival.asWritten);
  EXPECT_EQ(survival.asWritten->place.line, 4U);
  EXPECT_EQ(survival.proven, 0);
}

/// Half of them are on the borders, where a proof that is too bold would fail first.
TEST(Survive, ChecksWhatIsProvenAsOftenAsAsked) {
  const auto program = clamped(plateSetup(), klartext(inspectBore), {"part.pose.x=8", "part.pose.c=0.5"});
  const Survival few = survive(*program, {.samples = 10, .boxes = 30});
  const Survival many = survive(*program, {.samples = 10, .boxes = 30, .checks = 300});
  EXPECT_EQ(many.end, SurvivalEnd::Finished);
  EXPECT_GT(many.proven, 0);
  EXPECT_EQ(many.samplesInProven, few.samplesInProven + 300);
  EXPECT_EQ(many.samples, few.samples + 300);
  EXPECT_EQ(many.proven, few.proven);
}

TEST(Survive, SaysTheSameOnAnyNumberOfThreads) {
  const auto json = [](int threads) {
    Options options{.samples = 20, .boxes = 20};
    options.threads = threads;
    const Survival survival = survivalOf(plateSetup("TNC640", "repeatability = 0.001\n"), klartext(inspectBore),
                                         {"part.pose.x=6", "part.pose.y=6"}, options);
    return survivalJson(survival, {"p.h", "setup.toml", "test", ""}).dump();
  };
  const std::string one = json(1);
  EXPECT_TRUE(json(2) == one);
  EXPECT_TRUE(json(3) == one);
}

TEST(Survive, TriesNoMoreBoxesThanItMay) {
  const auto program = clamped(plateSetup(), klartext(inspectBore), {"part.pose.x=8", "part.pose.c=0.5"});
  for (const std::uint64_t boxes : {0, 1, 2, 5, 9, 10, 11, 16, 17, 18, 19, 20, 21, 22, 23}) {
    const Survival survival = survive(*program, {.samples = 10, .boxes = boxes});
    EXPECT_LE(survival.boxes, boxes);
    EXPECT_NEAR(survival.proven + survival.fails + survival.undecided, 1, 1e-9) << boxes;
    if (boxes == 0) {
      EXPECT_EQ(survival.proven, 0);
    }
  }
}

TEST(Survive, MakesItsPartsTheWholeBox) {
  const Survival survival =
      survivalOf(plateSetup(), klartext(inspectBore), {"part.pose.x=7", "part.pose.y=7"}, {.samples = 20, .boxes = 60});
  EXPECT_NEAR(survival.proven + survival.fails + survival.undecided, 1, 1e-9);
  for (const Part& a : survival.parts)
    for (const Part& b : survival.parts) {
      if (&a == &b) continue;
      bool apart = false;
      for (std::size_t i = 0; i < 2; ++i)
        apart = apart || a.box.high[i] <= b.box.low[i] + 1e-12 || b.box.high[i] <= a.box.low[i] + 1e-12;
      EXPECT_TRUE(apart);
    }
}

TEST(Tolerances, AreReadAndRefused) {
  const std::string setup = plateSetup();
  const Tolerance half = tolerance("part.pose.z=0.5", setup);
  EXPECT_EQ(half.low, -500.5);
  EXPECT_EQ(half.high, -499.5);
  const Tolerance range = tolerance("part.feature[2].diameter=29..31.5", setup);
  EXPECT_EQ(range.low, 29);
  EXPECT_EQ(range.high, 31.5);
  EXPECT_EQ(tolerance("part.pose.b=0.5", setup).low, -0.5);  // a number that the setup leaves out is 0
  const toml::table table = toml::parse(setup);
  for (const auto& [text, why] :
       std::vector<std::pair<std::string, std::string>>{{"part.pose.x", "NUMBER=HALF"},
                                                        {"part.pose.x=", "above 0"},
                                                        {"part.pose.x=-1", "above 0"},
                                                        {"part.pose.x=2..1", "below"},
                                                        {"part.pose.x=1..2", "lies outside"},
                                                        {"part.pose.x=a..2", "not two numbers"},
                                                        {"part.pose.c=120", "90 degrees"},
                                                        {"part.feature[9].diameter=1", ""},
                                                        {"part.feature[2].diameter=40", "above 0"},
                                                        {"tool[PROBE].pretravel=0.1", "not a number of a clamping"},
                                                        {"errors.axis.X.backlash=0.1", "not a number of a clamping"},
                                                        {"tool[PROBE].mount[1]=1", "not a number of a clamping"}}) {
    const auto refused = parseTolerance(text, table);
    ASSERT_FALSE(refused) << text;
    EXPECT_THAT(refused.error().message, HasSubstr(why)) << text;
    EXPECT_FALSE(refused.error().message.empty());
  }
}

}  // namespace
}  // namespace probewright::survival::testing
