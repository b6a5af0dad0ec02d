#include "records/results.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <fstream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "records/sample_run.hpp"

namespace probewright::records {
namespace {

using nlohmann::json;

json schemaFile() { return json::parse(std::ifstream(PROBEWRIGHT_SOURCE_DIR "/docs/results.schema.json")); }

/// Everything the schema has against `document`; empty if it is valid.
std::string complaints(const json& document) {
  static const std::unique_ptr<const valijson::Schema> schema = [] {
    auto parsed = std::make_unique<valijson::Schema>();
    const json file = schemaFile();
    valijson::SchemaParser(valijson::SchemaParser::kDraft7)
        .populateSchema(valijson::adapters::NlohmannJsonAdapter(file), *parsed);
    return parsed;
  }();
  valijson::Validator validator;
  valijson::ValidationResults results;
  validator.validate(*schema, valijson::adapters::NlohmannJsonAdapter(document), &results);
  std::string text;
  for (const auto& error : results) {
    for (const auto& part : error.context)
      text += part;
    text += ": " + error.description + "\n";
  }
  return text;
}

json sampleResults() { return json::parse(resultsText(sample::journal(), sample::runInfo())); }

TEST(ResultsSchema, AcceptsARunWithEverything) { EXPECT_EQ(complaints(sampleResults()), ""); }

TEST(ResultsSchema, AcceptsAnAlarmAndAnEmptyRun) {
  EXPECT_EQ(complaints(json::parse(resultsText(sample::alarmJournal(), sample::alarmRunInfo()))), "");
  EXPECT_EQ(complaints(json::parse(resultsText({}, {}))), "");
}

// Walks through the document and spoils one thing at a time: each must be noticed.
void expectEveryLossNoticed(const json& document, const json::json_pointer& at, int& count) {
  static const std::set<std::string> mayBeMissing = {"startedAt",  "text",       "alarm",       "nominal", "deviation",
                                                     "lowerLimit", "upperLimit", "uncertainty", "feature"};
  const json& value = document[at];
  if (value.is_object() && at.back() != "axes") {
    json spoiled = document;
    spoiled[at]["surprise"] = 1;
    EXPECT_NE(complaints(spoiled), "") << "an unknown key in " << at.to_string();
    for (const auto& [key, child] : value.items()) {
      ++count;
      if (!mayBeMissing.contains(key)) {
        spoiled = document;
        spoiled[at].erase(key);
        EXPECT_NE(complaints(spoiled), "") << "without " << (at / key).to_string();
      }
      spoiled = document;
      spoiled[at / key] = json::array({json::array()});
      EXPECT_NE(complaints(spoiled), "") << "wrong type of " << (at / key).to_string();
      expectEveryLossNoticed(document, at / key, count);
    }
  } else if (value.is_array() && !value.empty()) {
    expectEveryLossNoticed(document, at / 0, count);
  }
}

TEST(ResultsSchema, NoticesAnythingMissingUnknownOrOfTheWrongType) {
  // One of each list is enough.
  json document = sampleResults();
  document["cycles"] = json::array({document["cycles"][4]});
  document["cycles"][0]["writes"] = sampleResults()["cycles"][0]["writes"];
  int count = 0;
  for (const auto& [key, child] : document.items())
    if (key != "schema") expectEveryLossNoticed(document, json::json_pointer("/" + key), count);
  EXPECT_GT(count, 40);
}

TEST(ResultsSchema, DescribesEveryPropertyOfTheResults) {
  const json file = schemaFile();
  for (const char* name : {"cycle", "result", "touch", "write", "event", "run"})
    EXPECT_FALSE(file["definitions"][name].value("description", "").empty()) << name;
}

TEST(Results, MarkUncertaintiesThatDoNotHold) {
  RunInfo info = sample::runInfo();
  info.doubtfulUncertainties = {{3, 2}};
  const json results = json::parse(resultsText(sample::journal(), info));
  EXPECT_EQ(complaints(results), "");
  EXPECT_EQ(results["cycles"][3]["results"][2]["uncertaintyHolds"], false);
  for (const std::size_t other : {0, 1})
    EXPECT_FALSE(results["cycles"][3]["results"][other].contains("uncertaintyHolds"));
}

TEST(Results, KeepEveryNumberOfTheRun) {
  const json results = sampleResults();
  const json& hole = results["cycles"][3];
  EXPECT_EQ(hole["name"], "421");
  EXPECT_EQ(hole["place"]["file"], sample::programPath);
  EXPECT_EQ(hole["place"]["line"], sample::lineOf("12 TCH PROBE 421"));
  EXPECT_EQ(hole["parameters"][1],
            (json{{"name", "Q275"}, {"value", "30.021"}, {"meaning", "maximum limit of size"}, {"default", false}}));
  EXPECT_EQ(hole["parameters"][3]["default"], true);
  EXPECT_EQ(hole["results"][2]["value"].get<double>(), 30.0119);
  EXPECT_EQ(hole["results"][2]["upperLimit"].get<double>(), 30.021);
  EXPECT_EQ(hole["results"][2]["deviation"].get<double>(), 30.0119 - 30);
  EXPECT_EQ(hole["results"][2]["uncertainty"].get<double>(), 0.0017);
  EXPECT_FALSE(results["cycles"][0]["results"][0].contains("nominal"));
  EXPECT_EQ(hole["touches"][1]["ballCentre"], (json{20.0, 30.0119 / 2 - 3, -15.0}));
  EXPECT_EQ(hole["touches"][1]["direction"], (json{0.0, 1.0, 0.0}));
  EXPECT_EQ(hole["touches"][1]["axes"]["Z"].get<double>(), 285);
  EXPECT_EQ(hole["touches"][1]["axes"].size(), 3U);
  EXPECT_EQ(hole["logFiles"], json{"TCHPR421.TXT"});
  EXPECT_TRUE(hole["screens"].empty());
  EXPECT_EQ(results["cycles"][4]["screens"], json{"Measuring log 424\nSide length in minor axis:   80.0541\n"});
  EXPECT_EQ(results["cycles"][2]["writes"][1],
            (json{{"table", "PRESET.PR"}, {"entry", "row 5, column Y"}, {"before", "-98.500"}, {"after", "-98.682"}}));
  EXPECT_EQ(results["totals"],
            (json{{"cycles", 5}, {"touches", 15}, {"failedTouches", 0}, {"pathLength", 2311.8}, {"time", 95.2}}));
  EXPECT_EQ(results["verdict"], "rework");
  EXPECT_EQ(results["run"]["exit"]["code"], 1);
  EXPECT_EQ(results["run"]["seed"], 20260707);
  EXPECT_EQ(results["events"][1]["text"], "BORE 30.012 / WIDTH 80.054");
}

TEST(Results, NameTheAlarmOfACycle) {
  const json results = resultsJson(sample::alarmJournal(), sample::alarmRunInfo());
  EXPECT_FALSE(results["cycles"][0].contains("alarm"));
  EXPECT_EQ(results["cycles"][2]["alarm"], "Touch point inaccessible");
  const json& missed = results["cycles"][2]["touches"][1];
  EXPECT_EQ(missed["outcome"], "no contact");
  EXPECT_FALSE(missed.contains("ballCentre") || missed.contains("surface") || missed.contains("axes"))
      << "nothing was measured";
  EXPECT_EQ(results["events"][1]["kind"], "alarm");
  EXPECT_EQ(results["run"]["exit"]["state"], "stopped");
}

TEST(Results, ReadBackToTheSameBits) {
  std::mt19937_64 random(7);
  control::Journal journal;
  journal.cycles.emplace_back();
  std::vector<double> values = {0.1, 1.0 / 3, -1e-300, 5e-324, 1.7976931348623157e308, 123456789.123456789};
  while (values.size() < 5000) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value)) values.push_back(value);
  }
  for (const double value : values)
    journal.cycles[0].results.push_back(sample::plain("Q1", "", value));
  const json results = json::parse(resultsText(journal, {}));
  for (std::size_t i = 0; i < values.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint64_t>(results["cycles"][0]["results"][i]["value"].get<double>()),
              std::bit_cast<std::uint64_t>(values[i]));
}

TEST(Results, SayNullForWhatIsNoNumber) {
  control::Journal journal;
  journal.cycles.emplace_back();
  journal.cycles[0].results = {sample::plain("Q1", "", std::numeric_limits<double>::quiet_NaN()),
                               sample::plain("Q2", "", -std::numeric_limits<double>::infinity())};
  const json results = json::parse(resultsText(journal, {}));
  EXPECT_TRUE(results["cycles"][0]["results"][0]["value"].is_null());
  EXPECT_TRUE(results["cycles"][0]["results"][1]["value"].is_null());
  EXPECT_EQ(complaints(results), "");
}

TEST(Results, AreUtf8WhateverTheProgramHolds) {
  control::Journal journal;
  journal.events = {{control::EventKind::Message,
                     {},
                     "",
                     "Stra\xDF"
                     "e \"</script>\" \x01",
                     0}};
  const json results = json::parse(resultsText(journal, {}));
  EXPECT_EQ(results["events"][0]["text"],
            "Stra\xC3\x9F"
            "e \"</script>\" \x01");
}

TEST(Results, TakeTheWorstVerdictOfAllCycles) {
  EXPECT_EQ(worstVerdict({}), control::Verdict::None);
  control::Journal journal = sample::journal();
  EXPECT_EQ(worstVerdict(journal), control::Verdict::Rework);
  journal.cycles[3].results[0].verdict = control::Verdict::Scrap;
  EXPECT_EQ(worstVerdict(journal), control::Verdict::Scrap);
}

}  // namespace
}  // namespace probewright::records
