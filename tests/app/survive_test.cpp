#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/program.hpp"

namespace probewright::app::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string example = PROBEWRIGHT_SOURCE_DIR "/examples/survive/clamped";

std::vector<std::string> words(const Folder& folder, const std::vector<std::string>& more) {
  std::vector<std::string> all = {"survive", example + ".h", "--setup", example + ".toml", "--out", folder / "out"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

json survivalIn(const Folder& folder) {
  std::ifstream stream(folder / "out/survive.json");
  return json::parse(stream);
}

TEST(SurviveCommand, LeavesTheMapAndSaysHowMuchIsProven) {
  const Folder folder;
  const auto run = probewright(words(folder, {"--tolerance", "part.pose.x=0.2", "--samples", "10", "--boxes", "50"}));
  EXPECT_EQ(run.exit, 0) << run.output << run.errors;
  EXPECT_THAT(run.output, HasSubstr("100.00 % is proven"));
  EXPECT_THAT(run.output, HasSubstr("+-0.2000 mm"));
  const json found = survivalIn(folder);
  EXPECT_EQ(found["format"], "probewright-survival");
  EXPECT_EQ(found["end"], "finished");
  EXPECT_EQ(found["proven"], 1);
  EXPECT_EQ(found["tolerances"][0]["proven"], 0.2);
  EXPECT_EQ(found["samples"]["run"], 12);
  const std::string page = textOf(folder / "out/survive.html");
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_THAT(page, HasSubstr("class=\"proven\""));
}

TEST(SurviveCommand, MarksTheWorstBlock) {
  const Folder folder;
  const auto run = probewright(words(folder, {"--tolerance", "part.pose.z=12", "--samples", "40", "--boxes", "8"}));
  EXPECT_EQ(run.exit, 1) << run.errors;
  const json found = survivalIn(folder);
  ASSERT_FALSE(found["blocks"].empty());
  EXPECT_EQ(found["blocks"][0]["line"], 5);
  EXPECT_FALSE(found["failures"].empty());
  const std::string page = textOf(folder / "out/survive.html");
  EXPECT_THAT(page, HasSubstr("id=\"worst\">    5  4  TCH PROBE 417"));
}

TEST(SurviveCommand, RefusesWhatIsNoTolerance) {
  for (const auto& [tolerance, why] :
       std::vector<std::pair<std::string, std::string>>{{"part.pose.x", "NUMBER=HALF"},
                                                        {"part.pose.w=1", "not a number of a clamping"},
                                                        {"fixture[nobody].pose.x=1", "nobody"},
                                                        {"part.pose.x=0", "above 0"}}) {
    const Folder folder;
    const auto run = probewright(words(folder, {"--tolerance", tolerance}));
    EXPECT_EQ(run.exit, 2) << tolerance;
    EXPECT_THAT(run.errors, HasSubstr(why)) << tolerance;
  }
  const Folder folder;
  const auto twice = probewright(words(folder, {"--tolerance", "part.pose.x=1", "--tolerance", "part.pose.x=2"}));
  EXPECT_EQ(twice.exit, 2);
  EXPECT_THAT(twice.errors, HasSubstr("two tolerances of part.pose.x"));
}

}  // namespace
}  // namespace probewright::app::testing
