#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/toml_table.hpp"
#include "study/program_bench.hpp"

namespace probewright::study::testing {
namespace {

const std::string setupText = R"(
[part]
pose = { x = 10, y = -4 }
[[part.feature]]
shape = "box"
size = [80, 60, 20]
[[part.feature]]
shape = "hole"
diameter = 30
[[tool]]
number = 1
name = "PROBE"
ball_radius = 3
[[tool]]
number = 7
name = "MILL"
radius = 5
[parameters]
"centerPos.0" = 4
)";

toml::table setup() {
  Diagnostics none;
  return parseToml(setupText, "setup.toml", none).value();
}

TEST(NumberPath, FindsNumbersByKeyPlaceAndName) {
  const toml::table table = setup();
  const std::vector<std::pair<std::string, double>> cases = {
      {"part.pose.x", 10},
      {"part.feature[2].diameter", 30},
      {"part.feature[1].size[3]", 20},
      {"tool[MILL].radius", 5},
      {"tool[number=7].radius", 5},
      {"tool[1].ball_radius", 3},
      {"part.feature[shape=hole].diameter", 30},
      {"parameters.\"centerPos.0\"", 4},
  };
  for (const auto& [text, value] : cases) {
    const auto path = NumberPath::parse(text);
    ASSERT_TRUE(path) << text;
    EXPECT_EQ(path->numberIn(table), value) << text;
    toml::table changed = table;
    ASSERT_TRUE(path->set(changed, 1.25)) << text;
    EXPECT_EQ(path->numberIn(changed), 1.25) << text;
  }
}

TEST(NumberPath, AddsKeysThatTheSetupLeavesOut) {
  toml::table table = setup();
  const auto path = NumberPath::parse("errors.axis.X.backlash").value();
  EXPECT_FALSE(path.numberIn(table));
  ASSERT_TRUE(path.set(table, 0.003));
  EXPECT_EQ(path.numberIn(table), 0.003);
}

TEST(NumberPath, RefusesWhatIsNoPlace) {
  toml::table table = setup();
  for (const char* text : {"part.feature[3].diameter", "tool.radius", "tool[NOBODY].radius", "part", "part.pose",
                           "tool[1].name", "part.pose.x.y", "errors.squareness[1].degrees"}) {
    const auto path = NumberPath::parse(text);
    ASSERT_TRUE(path) << text;
    EXPECT_FALSE(path->set(table, 1)) << text;
  }
  for (const char* text : {"", ".", "a..b", "a[", "a[]", "a[1", "[1]", "a b", "a.\"b", "a[0]"})
    EXPECT_FALSE(NumberPath::parse(text)) << text;
}

TEST(NumberPaths, DoNotLeadToWhatAllTrialsShare) {
  const auto body = NumberPath::parse("machine.body[HEAD].feature[1].size");
  ASSERT_FALSE(body);
  EXPECT_NE(body.error().message.find("cannot vary"), std::string::npos) << body.error().message;
  EXPECT_TRUE(NumberPath::parse("machine.clearance"));
}

std::optional<Study> parsed(const std::string& text, Diagnostics& mistakes) {
  return parseStudy(text, "study.toml", setup(), mistakes);
}

/// All messages of a study that cannot be, in one text.
std::string mistakesIn(const std::string& text) {
  Diagnostics mistakes;
  EXPECT_FALSE(parsed(text, mistakes)) << text;
  std::string all;
  for (const Diagnostic& mistake : mistakes)
    all += format(mistake) + "\n";
  return all;
}

TEST(StudyFile, TakesMeansFromTheSetup) {
  Diagnostics mistakes;
  const auto study = parsed(R"(
seed = 9
[[source]]
quantity = "part.pose.x"
distribution = "normal"
standard_deviation = 0.1
[[source]]
quantity = "part.pose.y"
distribution = "triangular"
half_width = 0.5
[[source]]
quantity = "part.pose.z"
distribution = "uniform"
minimum = -1
maximum = 1
between = [0, 1]
)",
                            mistakes);
  ASSERT_TRUE(study) << format(mistakes.front());
  EXPECT_EQ(study->seed, 9U);
  EXPECT_EQ(study->sources[0].distribution.mean(), 10);
  EXPECT_EQ(study->sources[0].name, "part.pose.x");
  EXPECT_NEAR(study->sources[1].distribution.mean(), -4, 1e-12);
  EXPECT_NEAR(study->sources[2].distribution.mean(), 0.5, 1e-9);
}

TEST(StudyFile, GroupsTakeTheirDeviationsFromTheCovariance) {
  Diagnostics mistakes;
  const auto study = parsed(R"(
[[source]]
name = "x"
quantity = "part.pose.x"
distribution = "normal"
[[source]]
name = "y"
quantity = "part.pose.y"
distribution = "normal"
[[group]]
sources = "x, y"
covariance = [0.04, 0.03, 0.03, 0.09]
)",
                            mistakes);
  ASSERT_TRUE(study) << format(mistakes.front());
  EXPECT_NEAR(study->sources[0].distribution.standardDeviation(), 0.2, 1e-12);
  EXPECT_NEAR(study->sources[1].distribution.standardDeviation(), 0.3, 1e-12);
  const Eigen::MatrixXd correlation = study->groups.front().factor * study->groups.front().factor.transpose();
  EXPECT_NEAR(correlation(0, 1), 0.5, 1e-12);
  EXPECT_NEAR(correlation(0, 0), 1, 1e-12);
}

TEST(StudyFile, ReadsSamplesFromAColumn) {
  const TestFolder folder;
  folder.file("shop.csv", "day,length\n1,100.01\n2,100.03\n");
  Diagnostics mistakes;
  const auto study = parseStudy(R"(
[[source]]
quantity = "part.pose.x"
distribution = "samples"
file = "shop.csv"
column = "length"
)",
                                (folder.path() / "study.toml").string(), setup(), mistakes);
  ASSERT_TRUE(study) << format(mistakes.front());
  EXPECT_NEAR(study->sources.front().distribution.mean(), 100.02, 1e-9);
}

TEST(StudyFile, NamesMistakesWithPlaceAndWayOut) {
  const std::string source = "[[source]]\nquantity = \"part.pose.x\"\ndistribution = \"normal\"\n";
  EXPECT_THAT(mistakesIn("trials = 5\n"), ::testing::HasSubstr("at least one [[source]]"));
  EXPECT_THAT(mistakesIn(source), ::testing::HasSubstr("standard deviation of this source is missing"));
  EXPECT_THAT(mistakesIn(source + "standard_deviation = 0\n"), ::testing::HasSubstr("study.toml:4"));
  EXPECT_THAT(mistakesIn(source + "standard_deviation = 1\nhalf_width = 2\n"),
              ::testing::HasSubstr("unknown key \"half_width\""));
  EXPECT_THAT(mistakesIn("[[source]]\nquantity = \"part.pose.c\"\ndistribution = \"normal\"\nstandard_deviation = 1\n"),
              ::testing::HasSubstr("the setup does not write part.pose.c"));
  // A key that is misspelt is told before the one that is missing because of it.
  Diagnostics both;
  EXPECT_FALSE(parsed(
      "[[source]]\nquantity = \"part.pose.c\"\ndistribution = \"normal\"\nstandard_deviation = 1\nmeen = 3\n", both));
  ASSERT_EQ(both.size(), 2U);
  EXPECT_THAT(both[0].message, ::testing::HasSubstr("unknown key \"meen\""));
  EXPECT_THAT(both[1].message, ::testing::HasSubstr("the setup does not write part.pose.c"));
  // So in each source.
  const std::string misspelt =
      "[[source]]\nquantity = \"part.pose.c\"\ndistribution = \"normal\"\nstandard_deviation = 1\nmeen = 3\n";
  Diagnostics many;
  EXPECT_FALSE(parsed(misspelt + misspelt, many));
  for (std::size_t i = 0; i < many.size(); ++i)
    if (many[i].message.find("the setup does not write part.pose.c") != std::string::npos) {
      ASSERT_GT(i, 0U);
      EXPECT_THAT(many[i - 1].message, ::testing::HasSubstr("unknown key \"meen\""));
    }
  EXPECT_THAT(mistakesIn("[[source]]\nquantity = \"tool[PROB].ball_radius\"\ndistribution = \"normal\"\nmean = 3\n"
                         "standard_deviation = 1\n"),
              ::testing::HasSubstr("no entry of a list is meant"));
  EXPECT_THAT(
      mistakesIn("[[source]]\nquantity = \"tool[1].name\"\ndistribution = \"normal\"\nstandard_deviation = 1\n"),
      ::testing::Not(::testing::HasSubstr("the setup does not write")))
      << "the setup writes it, but no number";
  EXPECT_THAT(mistakesIn(source + "standard_deviation = 1\n" + source + "standard_deviation = 1\n"),
              ::testing::HasSubstr("distributed twice"));
  EXPECT_THAT(mistakesIn(source + "standard_deviation = 1\n[[measurand]]\nresult = \"Q1\"\ntruth = \"part.pose.q\"\n"),
              ::testing::HasSubstr("has the number part.pose.q"));
  EXPECT_THAT(mistakesIn("trials = 10\ndigits = 1\n" + source + "standard_deviation = 1\n"),
              ::testing::HasSubstr("either a number of trials or digits"));
  EXPECT_THAT(
      mistakesIn(source + "standard_deviation = 1\n[[measurand]]\nresult = \"Q1\"\nlower = 1\n[[measurand]]\nresult = "
                          "\"Q1\"\nupper = 2\n"),
      ::testing::HasSubstr("two measurands called \"Q1\""));
  // A source that is wrong is one all the same.
  EXPECT_THAT(mistakesIn("[[source]]\nquantity = \"part.pose.x\"\ndistribution = \"samples\"\nfile = \"none.csv\"\n"),
              ::testing::Not(::testing::HasSubstr("at least one")));
  const std::string two =
      "[[source]]\nname=\"x\"\nquantity = \"part.pose.x\"\ndistribution = \"normal\"\nstandard_deviation = 1\n"
      "[[source]]\nname=\"y\"\nquantity = \"part.pose.y\"\ndistribution = \"normal\"\nstandard_deviation = 1\n"
      "[[group]]\nsources = \"x, y\"\n";
  EXPECT_THAT(mistakesIn(two + "correlation = [1, 2, 2, 1]\n"), ::testing::HasSubstr("numbers from -1 to 1"));
  EXPECT_THAT(mistakesIn(two + "correlation = [1, 0.5, 0.4, 1]\n"), ::testing::HasSubstr("symmetric"));
  EXPECT_THAT(mistakesIn(two + "covariance = [1, 0, 0, 1]\n"), ::testing::HasSubstr("of its own"));
  EXPECT_THAT(mistakesIn(two), ::testing::HasSubstr("either a covariance or a correlation"));
  // What is wrong with a covariance is said of it and nothing else.
  const std::string normals =
      "[[source]]\nname=\"x\"\nquantity = \"part.pose.x\"\ndistribution = \"normal\"\n"
      "[[source]]\nname=\"y\"\nquantity = \"part.pose.y\"\ndistribution = \"normal\"\n"
      "[[group]]\nsources = \"x, y\"\n";
  for (const auto& [matrix, why] : std::vector<std::pair<std::string, std::string>>{
           {"[1, 2, 2, 1]", "this covariance is not positive semidefinite: that of \"x\" and \"y\""},
           {"[4, -2.1, -2.1, 1]", "this covariance is not positive semidefinite: that of \"x\" and \"y\""},
           {"[1, 0.2, 0.3, 1]", "\"covariance\" must be symmetric"},
           {"[1, 0.2, 1]", "covariance"},
           {"[1, 0, 0, -1]", "must be above 0"}}) {
    Diagnostics mistakes;
    EXPECT_FALSE(parsed(normals + "covariance = " + matrix + "\n", mistakes)) << matrix;
    ASSERT_EQ(mistakes.size(), 1U) << matrix << format(mistakes.back());
    EXPECT_THAT(mistakes.front().message, ::testing::HasSubstr(why));
    EXPECT_EQ(mistakes.front().place.line, 11U) << "the key";
  }
  EXPECT_THAT(mistakesIn(two + "correlation = [1, 0.9, 0.9]\n"), ::testing::Not(::testing::HasSubstr("missing")));
  // A group of sources that there are not has no matrix to look at.
  const std::string of = source + "standard_deviation = 1\n[[group]]\nsources = ";
  for (const char* matrix : {"covariance = [1, 2, 3]\n", "correlation = [1, 2, 3]\n", "correlation = [1]\n"})
    for (const char* sources : {"\"z\"\n", "\"\"\n"})
      EXPECT_THAT(mistakesIn(of + sources + matrix), ::testing::HasSubstr("at least two sources"));
  EXPECT_THAT(mistakesIn(of + "\"z\"\ncorrelation = [1]\n"), ::testing::HasSubstr("no source is called \"z\""));
}

}  // namespace
}  // namespace probewright::study::testing
