#include <gmock/gmock.h>

#include "conversion/twins.hpp"

/// Rows that touch probe cycles write: a control that lacks the row adds it as a copy of the preset in effect, while a
/// settable zero offset is always there and keeps what no cycle sets.
namespace probewright::testing_support {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Cycle 412 writes X and Y of the row.
std::string hole(const std::string& row) {
  std::string block = probe(
      412, {{321, 0}, {322, 0}, {262, 40}, {325, 0}, {247, 90}, {261, -8}, {320, 1}, {260, 30}, {301, 0}, {305, 77},
            {331, 0}, {332, 0}, {303, 1},  {381, 0}, {382, 0},  {383, 0},  {384, 0}, {333, 0},  {423, 4}, {365, 1}});
  const std::string rowOfBlock = "Q305=+77.000000";
  return block.replace(block.find(rowOfBlock), rowOfBlock.size(), "Q305=" + row);
}

std::string turned(int row) { return probe(404, {{307, 12}, {305, row}}); }
std::string select(int row) { return fmt::format("CYCL DEF 247 PRESET ~\n    Q339=+{}\n", row); }

/// The messages that name a row which may be missing.
std::vector<std::string> doubts(const std::string& blocks) {
  std::vector<std::string> found;
  const conversion::Conversion there = toSinumerik(klartextProgram(blocks));
  EXPECT_THAT(there.mistakes, IsEmpty()) << format(there.mistakes.front());
  for (const Diagnostic& each : there.notCarriedOver) {
    EXPECT_EQ(each.severity, Severity::Warning);
    EXPECT_FALSE(each.advice.empty());
    found.push_back(fmt::format("{}: {}", each.place.line, each.message));
  }
  return found;
}

TEST(ConvertLackingRows, AreNamedWhereALaterBlockSelectsThem) {
  const auto namesRow = [](const char* row) {
    return ElementsAre(HasSubstr("PRESET.PR may lack row " + std::string(row)));
  };
  EXPECT_THAT(doubts(hole("+5") + select(5)), namesRow("5"));
  EXPECT_THAT(doubts(hole("+5") + hole("+5") + select(5)), namesRow("5"));  // once
  EXPECT_THAT(doubts(select(1) + hole("+5") + select(5)), namesRow("5"));
  EXPECT_THAT(doubts(turned(5) + select(5)), namesRow("5"));
  EXPECT_THAT(doubts("Q9 = 5\n" + hole("+Q9") + select(5)), namesRow("5"));
  // In a subprogram, and on the second round of a repeated part.
  EXPECT_THAT(doubts("CALL LBL 7\n" + select(5) + "L Z+100 R0 FMAX M2\nLBL 7\n" + hole("+5") + "LBL 0\n"),
              namesRow("5"));
  EXPECT_THAT(doubts("FN 9: IF +Q1 EQU +0 GOTO LBL 1\n" + select(5) + "LBL 1\n" + hole("+5") + select(5)),
              namesRow("5"));
}

TEST(ConvertLackingRows, AreNotNamedWhereNothingCanBeLost) {
  EXPECT_THAT(doubts(hole("+5")), IsEmpty());                          // nobody selects it
  EXPECT_THAT(doubts(hole("+5") + select(6)), IsEmpty());              // another one
  EXPECT_THAT(doubts(select(5) + hole("+5") + select(5)), IsEmpty());  // it has been selected: it is there
  EXPECT_THAT(doubts(select(5) + select(1) + hole("+5") + select(5)), IsEmpty());
  EXPECT_THAT(doubts(hole("-1") + select(5)), IsEmpty());  // the one in effect
  EXPECT_THAT(doubts(select(5) + "Q9 = 5\n" + hole("+Q9") + select(5)), IsEmpty());
  // The cycle stands behind the selection, and no way leads back.
  EXPECT_THAT(doubts("FN 9: IF +Q1 EQU +0 GOTO LBL 1\n" + select(5) + "LBL 1\n" + hole("+5")), IsEmpty());
}

}  // namespace
}  // namespace probewright::testing_support
