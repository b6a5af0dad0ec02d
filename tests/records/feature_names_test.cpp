#include "records/feature_names.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "records/results.hpp"

namespace probewright::records {
namespace {

std::string nameAt(const std::string& program, std::uint64_t line) {
  RunInfo run;
  run.programs = {{"A", program}};
  return FeatureNames(run, ReadableText(run)).at({"A", line, 1});
}

/// Four letters of a file beside a program in UTF-8 tell Cyrillic; fewer are taken as Western.
TEST(ReadableText, TellsCyrillicByFourLetters) {
  RunInfo run;
  run.programs = {{"A", "0 BEGIN PGM A MM\n"}};
  const ReadableText readable(run);
  EXPECT_EQ(readable("\xCF\xF3\xF1\xEA 1"), "\u041F\u0443\u0441\u043A 1");
  EXPECT_EQ(readable("\xCF\xF3\xF1\xEA\xE0 1"), "\u041F\u0443\u0441\u043A\u0430 1");
  EXPECT_EQ(readable("m\xE4tt \xE5\xF6"), "m\u00E4tt \u00E5\u00F6");
  EXPECT_EQ(readable("plain"), "plain");
}

TEST(FeatureNames, AreTheStructureBlockNearestAbove) {
  const std::string program =
      "0 BEGIN PGM A MM\n5 * - BORE 40 H7\r\n6 TCH PROBE 421 ~\n* -  Edge  \n8 L X+1\n* -\n9 L X+2\n";
  EXPECT_EQ(nameAt(program, 1), "");
  EXPECT_EQ(nameAt(program, 3), "BORE 40 H7");
  EXPECT_EQ(nameAt(program, 5), "Edge");
  EXPECT_EQ(nameAt(program, 7), "") << "an empty block ends the name";
}

TEST(FeatureNames, AreTheMessageNearestAbove) {
  const std::string program =
      "N10 MSG(\"BORE \x41\")\nN20 CYCLE977(1)\nmsg ( \"slot\" , 1)\nX1\nN30MSG()\nX2\nMSG(\"open\n";
  EXPECT_EQ(nameAt(program, 2), "BORE A");
  EXPECT_EQ(nameAt(program, 4), "slot");
  EXPECT_EQ(nameAt(program, 6), "");
  EXPECT_EQ(nameAt(program, 7), "") << "a text without an end is no name";
}

TEST(FeatureNames, AreReadableAndInOneLine) {
  EXPECT_EQ(nameAt("1 * - L\xE4nge\tA\n2 ;H\xF6he \xFC"
                   "ber alles\n",
                   2),
            "L\xC3\xA4nge A");
}

TEST(FeatureNames, LeaveOtherLinesAlone) {
  for (const char* line : {"7 *- ", "MSGX(\"no\")", "Q1 = 2 * - 3", "", "R1=MSG(\"no\")", "* + no", "N", "5"})
    EXPECT_EQ(nameAt(std::string("* - kept\n") + line + "\n", 2), std::string(line) == "7 *- " ? "" : "kept") << line;
}

TEST(FeatureNames, StandWithTheirCyclesAndTheJobWithTheRun) {
  RunInfo run;
  run.programs = {{"A", "* - BORE\nTCH PROBE 421\nTCH PROBE 427\n"}};
  run.job.serial = "0017";
  run.job.operator_ = "M\xC3\xBCller";
  control::Journal journal;
  journal.cycles.resize(2);
  journal.cycles[0].place = {"A", 2, 1};
  journal.cycles[1].place = {"B", 3, 1};
  const nlohmann::json results = resultsJson(journal, run);
  EXPECT_EQ(results["cycles"][0]["feature"], "BORE");
  EXPECT_FALSE(results["cycles"][1].contains("feature")) << "of a program whose text is not known";
  EXPECT_EQ(results["run"]["job"], (nlohmann::json{{"serial", "0017"}, {"operator", "M\xC3\xBCller"}}));
  EXPECT_FALSE(resultsJson(journal, {})["run"].contains("job"));
}

}  // namespace
}  // namespace probewright::records
