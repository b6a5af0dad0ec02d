#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "app/program.hpp"
#include "support/page_data.hpp"

/// What --language, --screens and --measuring-log do, as a user meets them.
namespace probewright::app::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string klartext = "examples/programs/housing.h", klartextSetup = "examples/setups/housing-tnc640.toml";

Answer run(const Folder& folder, const std::string& program, const std::string& setup,
           const std::vector<std::string>& more) {
  std::vector<std::string> words = {"run", program, "--setup", setup, "--out", (folder / "out").string()};
  words.insert(words.end(), more.begin(), more.end());
  return probewright(words);
}

TEST(Logs, SpeakTheLanguageThatIsAskedFor) {
  const Folder folder;
  EXPECT_EQ(run(folder, klartext, klartextSetup, {"--language", "sv", "--quiet"}).exit, 0);
  EXPECT_THAT(textOf(folder / "out/TCHPR421.TXT"), HasSubstr("Mätprotokoll avkännarcykel 421"));
  EXPECT_EQ(run(folder, klartext, klartextSetup, {"--language", "ru", "--quiet"}).exit, 0);
  EXPECT_THAT(textOf(folder / "out/TCHPR421.TXT"), HasSubstr("Протокол измерений цикла 421"));
  EXPECT_EQ(run(folder, klartext, klartextSetup, {"--language", "de", "--quiet"}).exit, 0);
  const std::string german = textOf(folder / "out/TCHPR421.TXT");
  EXPECT_THAT(german, HasSubstr("Messprotokoll Antastzyklus 421 Messen Bohrung"));
  for (const char* english : {"Center", "limit", "dimension", "values", "Measured", "Diameter:"})
    EXPECT_THAT(german, Not(HasSubstr(english)));
  const Answer unknown = run(folder, klartext, klartextSetup, {"--language", "xx"});
  EXPECT_EQ(unknown.exit, 2);
  EXPECT_THAT(unknown.errors, HasSubstr("--language"));
}

TEST(Screens, AreShownOnRequest) {
  const Folder folder;
  EXPECT_THAT(run(folder, klartext, klartextSetup, {}).output, Not(HasSubstr("| ******")));
  const Answer shown = run(folder, klartext, klartextSetup, {"--screens"});
  EXPECT_THAT(shown.output, HasSubstr("| ****** Measuring Log for Probing Cycle 421 Hole Measuring *****"));
  const json results = json::parse(textOf(folder / "out/results.json"));
  std::size_t screens = 0;
  for (const json& cycle : results.at("cycles"))
    screens += cycle.at("screens").size();
  EXPECT_GE(screens, 6U);
  EXPECT_THAT(testing_support::pageData(textOf(folder / "out/report.html")),
              HasSubstr("Measuring Log for Probing Cycle 421"));
}

TEST(MeasuringLogs, OfSinumerikAreTextAndTable) {
  const Folder folder;
  const Answer answer = run(folder, "examples/programs/housing.mpf", "examples/setups/housing-840dsl.toml",
                            {"--measuring-log", "all.txt", "--measuring-log", "all.csv", "--screens"});
  EXPECT_EQ(answer.exit, 0) << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("Setpoint    Measured  Difference"));
  const std::string table = textOf(folder / "out/all.csv"), text = textOf(folder / "out/all.txt");
  EXPECT_THAT(table, HasSubstr("No;Date;Time;Program;Line;Cycle;Variant;"));
  const json results = json::parse(textOf(folder / "out/results.json"));
  for (const json& cycle : results.at("cycles")) {
    EXPECT_THAT(table, HasSubstr(";" + cycle.at("name").get<std::string>() + ";"));
    EXPECT_THAT(text, HasSubstr("  " + cycle.at("name").get<std::string>() + "  "));
  }
  for (const char* name : {"../escape.csv", "report.html", "all", ".csv"}) {
    const Answer refused =
        run(folder, "examples/programs/housing.mpf", "examples/setups/housing-840dsl.toml", {"--measuring-log", name});
    EXPECT_EQ(refused.exit, 2) << name;
    EXPECT_THAT(refused.errors, HasSubstr("--measuring-log")) << name;
  }
}

}  // namespace
}  // namespace probewright::app::testing
