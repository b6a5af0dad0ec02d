#include "cycles/main_results.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "cycles/catalogue.hpp"
#include "records/sample_run.hpp"

namespace probewright::cycles {
namespace {

using control::CycleRecord;
using Names = std::vector<std::string>;

CycleRecord recordOf(const std::string& name, const Names& results) {
  CycleRecord record;
  record.name = name;
  for (const std::string& result : results)
    record.results.push_back(sample::plain(result, "", 1));
  return record;
}

Names mainOf(const CycleRecord& record) {
  Names names;
  const std::vector<bool> isMain = mainResults(record);
  EXPECT_EQ(isMain.size(), record.results.size());
  for (std::size_t i = 0; i < isMain.size(); ++i) {
    if (isMain[i]) names.push_back(record.results[i].name);
  }
  return names;
}

// What the manuals call the measurement of each cycle.
TEST(MainResults, AreWhatTheCycleWasCalledFor) {
  EXPECT_EQ(mainOf(recordOf("431", {"Q158", "Q159", "Q170", "Q171", "Q172", "Q173", "Q174", "Q175"})),
            (Names{"Q158", "Q159", "Q170", "Q171", "Q172"}));
  EXPECT_EQ(mainOf(recordOf("421", {"Q151", "Q152", "Q153", "Q161", "Q162", "Q163", "Q180", "Q181", "Q182"})),
            (Names{"Q151", "Q152", "Q153"}));
  EXPECT_EQ(mainOf(recordOf("425", {"Q156", "Q157", "Q166"})), (Names{"Q156", "Q157"}));
  EXPECT_EQ(mainOf(recordOf("1410", {"Q950", "Q980", "Q964", "Q965", "Q994"})), (Names{"Q964", "Q994"}));
  EXPECT_EQ(mainOf(recordOf("CYCLE961", {"_OVI[2]", "_OVR[4]", "_OVR[5]", "_OVR[6]", "_OVR[20]", "_OVR[21]"})),
            (Names{"_OVR[4]", "_OVR[5]", "_OVR[6]"}));
  EXPECT_EQ(mainOf(recordOf("CYCLE977", {"_OVR[0]", "_OVR[4]", "_OVR[16]", "_OVR[5]", "_OVR[28]"})),
            (Names{"_OVR[4]", "_OVR[5]"}));
  EXPECT_EQ(mainOf(recordOf("CYCLE976", {"_OVR[6]", "_OVR[7]", "_OVR[24]", "_OVR[10]", "_OVR[4]", "_OVR[5]", "_OVR[20]",
                                         "_OVR[21]", "_OVR[28]"})),
            (Names{"_OVR[4]", "_OVR[20]", "_OVR[21]"}));
}

TEST(MainResults, AreTheTriggerPointsWhereNothingElseWasCalibrated) {
  EXPECT_EQ(mainOf(recordOf("CYCLE976", {"_OVR[10]", "_OVR[11]", "_OVR[28]", "_OVI[2]", "_OVI[3]"})),
            Names{"_OVR[10]"});
  EXPECT_EQ(mainOf(recordOf("CYCLE976", {"_OVR[16]", "_OVR[17]", "_OVR[22]"})), Names{"_OVR[22]"});
}

TEST(MainResults, AreWhateverHasAVerdict) {
  CycleRecord record = recordOf("1410", {"Q950", "Q951", "Q964"});
  record.results[1].verdict = control::Verdict::Good;
  EXPECT_EQ(mainOf(record), (Names{"Q951", "Q964"}));
}

TEST(MainResults, AreWhereTheProgramWantsThem) {
  EXPECT_EQ(mainOf(recordOf("0", {"Q12", "Q115", "Q116", "Q117", "Q118", "Q119"})), Names{"Q12"});
  EXPECT_EQ(mainOf(recordOf("3", {"Q10", "Q11", "Q12", "Q13"})), (Names{"Q10", "Q11", "Q12", "Q13"}));
}

TEST(MainResults, AreTheFirstSixOfAnUnknownCycle) {
  Names names;
  for (int i = 0; i < 20; ++i)
    names.push_back(fmt::format("R{}", i));
  EXPECT_EQ(mainOf(recordOf("L9999", names)), Names(names.begin(), names.begin() + 6));
}

TEST(MainResults, AreNamedForEveryCycleThatLeavesAny) {
  int cycles = 0;
  for (const auto kind : control::allControlKinds) {
    for (const CycleDefinition* cycle : cyclesOf(kind)) {
      if (cycle->results.empty()) continue;
      ++cycles;
      CycleRecord record = recordOf(std::string(cycle->name), {});
      for (const ResultDefinition& result : cycle->results) {
        // "Qn" stands for whatever parameter the program chooses.
        const std::string name = result.name.starts_with("Qn") ? "Q100" : std::string(result.name);
        record.results.push_back(sample::plain(name, result.meaning.whole(), 1));
      }
      const std::vector<bool> isMain = mainResults(record);
      int found = 0;
      for (std::size_t i = 0; i < isMain.size(); ++i) {
        if (!isMain[i]) continue;
        ++found;
        for (const char* aside : {"set value", "tolerance limit", "safe area", "empirical", "zero offset"}) {
          EXPECT_EQ(record.results[i].meaning.find(aside), std::string::npos) << cycle->name;
        }
      }
      EXPECT_GT(found, 0) << cycle->name;
    }
  }
  EXPECT_GT(cycles, 50);
}

}  // namespace
}  // namespace probewright::cycles
