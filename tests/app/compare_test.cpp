#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/program.hpp"

/// Two runs side by side.
namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string root = PROBEWRIGHT_SOURCE_DIR;

std::string with(std::string text, const std::string& before, const std::string& after) {
  const std::size_t at = text.find(before);
  if (at == std::string::npos) throw std::runtime_error("no " + before);
  return text.replace(at, before.size(), after);
}

/// Runs the recipe "inspect" with a changed setup or program; returns the folder of the run.
std::string inspect(const Folder& folder, const std::string& name, const std::string& setup,
                    const std::string& program) {
  const std::string out = (folder / name).string();
  const Answer answer = probewright(
      {"run", folder.file("INSPECT.H", program), "--setup", folder.file(name + ".toml", setup), "--out", out});
  EXPECT_LE(answer.exit, 1) << answer.errors;
  return out;
}

const std::string setup = textOf(root + "/examples/cookbook/inspect.toml");
const std::string program = textOf(root + "/examples/cookbook/inspect.h");

TEST(Compare, FindsTwoRunsOfTheSameProgramAlike) {
  const Folder folder;
  const std::string first = inspect(folder, "a", setup, program), second = inspect(folder, "b", setup, program);
  const Answer answer = probewright({"compare", first, second});
  EXPECT_EQ(answer.exit, 0) << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("0 of "));
  EXPECT_THAT(answer.output, Not(HasSubstr("Q153")));
  EXPECT_THAT(probewright({"compare", first, second, "--all"}).output, HasSubstr("Q153"));
}

TEST(Compare, ShowsWhatAPartOfAnotherSizeChanges) {
  // The bore of the second part is 0.05 mm larger: it is good, and the tool is not corrected.
  const Folder folder;
  const std::string first = inspect(folder, "a", setup, program);
  const std::string second = inspect(folder, "b", with(setup, "39.96", "40.01"), program);
  const Answer answer = probewright({"compare", first, second});
  EXPECT_EQ(answer.exit, 1);
  EXPECT_THAT(answer.output, HasSubstr("39.9600 mm       40.0100 mm     +0.0500 mm  rework -> good\n"));
  EXPECT_THAT(answer.output, HasSubstr("TOOL.T row 5, column DR: -0.0263 -> "));
  EXPECT_THAT(answer.output, Not(HasSubstr("Q151")));
  EXPECT_THAT(answer.output, HasSubstr("end: out of tolerance"));

  const auto document = nlohmann::json::parse(probewright({"compare", first, second, "--json"}).output);
  EXPECT_FALSE(document["alike"].get<bool>());
  double difference = 0;
  for (const auto& value : document["cycles"][0]["values"])
    if (value["name"] == "Q153") difference = value["difference"];
  EXPECT_NEAR(difference, 0.05, 1e-9);
  EXPECT_NEAR(document["largestDifference"].get<double>(), 0.05, 1e-9);

  // What is within the tolerance does not count, but a verdict does.
  EXPECT_THAT(probewright({"compare", first, second, "--tolerance", "0.1"}).output, HasSubstr("rework -> good"));
}

TEST(Compare, NamesCallsThatOneRunDoesNotHave) {
  const Folder folder;
  const std::size_t begin = program.find("\n4 TCH PROBE") + 1, end = program.find("\n5 ;") + 1;
  const std::string extra =
      "TCH PROBE 427 MEASURE COORDINATE ~\nQ263=+60 ~\nQ264=+8 ~\nQ261=+0 ~\nQ320=+3 ~\n"
      "Q272=+3 ~\nQ267=-1 ~\nQ260=+20 ~\nQ281=+0 ~\nQ288=+0 ~\nQ289=+0 ~\nQ309=+0 ~\nQ330=+0\n";
  const std::string hole = program.substr(begin, end - begin);
  std::string both = program, more = program;
  both.insert(end, hole);
  more.insert(end, extra + hole);
  const Answer answer = probewright({"compare", inspect(folder, "a", setup, both), inspect(folder, "b", setup, more)});
  EXPECT_EQ(answer.exit, 1);
  EXPECT_THAT(answer.output, HasSubstr("  2  427 MEASURE COORDINATE  (INSPECT.H:22, in the second run only)\n"));
  EXPECT_THAT(answer.output, Not(HasSubstr("421 MEASURE HOLE")));
}

TEST(Compare, NeedsTwoRuns) {
  const Folder folder;
  const std::string run = inspect(folder, "a", setup, program);
  const Answer none = probewright({"compare", run, (folder / "nothing").string()});
  EXPECT_EQ(none.exit, 2);
  EXPECT_THAT(none.errors, HasSubstr("nothing"));
  const Answer other = probewright({"compare", run, folder.file("other.json", "{\"schema\": \"something\"}")});
  EXPECT_EQ(other.exit, 2);
  EXPECT_THAT(other.errors, HasSubstr("the second is not a results.json"));
  const Answer broken = probewright({"compare", folder.file("broken.json", "{\"schema\": "), run});
  EXPECT_EQ(broken.exit, 2);
  EXPECT_THAT(broken.errors, HasSubstr("this is not JSON"));
  const Answer poor = probewright(
      {"compare", run, folder.file("poor.json", R"({"schema": "probewright results", "schemaVersion": 1})")});
  EXPECT_EQ(poor.exit, 2);
  EXPECT_THAT(poor.errors, HasSubstr("does not follow the layout"));
}

}  // namespace
}  // namespace probewright::app::testing
