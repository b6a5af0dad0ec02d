#include "control/heidenhain/text_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace probewright::control::heidenhain {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string plainTable =
    "BEGIN TOOL    .T MM\n"
    "T     NAME        L           R         SPECIAL DOC\n"
    "0                 +0          +0        x\n"
    "1     PROBE_A     +120.5000   +3.0000   7777    first probe\n"
    "5     MILL_D10    -12.2500    +5.0000           \n"
    "5.1   MILL_D10    +14.0000    +5.0010\n"
    "[END]\n"
    "text after the end\n";

TextTable read(const std::string& text, Diagnostics* found = nullptr) {
  Diagnostics diagnostics;
  auto table = TextTable::parse(text, "TOOL.T", diagnostics);
  EXPECT_TRUE(table.has_value()) << (table ? "" : format(table.error()));
  if (found) *found = diagnostics;
  return std::move(*table);
}

/// Everything outside [begin, begin + size) is the same in both.
void expectOnlyBytesChanged(const std::string& before, const std::string& after, std::size_t begin, std::size_t size) {
  ASSERT_EQ(before.size(), after.size());
  EXPECT_EQ(before.substr(0, begin), after.substr(0, begin));
  EXPECT_EQ(before.substr(begin + size), after.substr(begin + size));
  EXPECT_NE(before, after);
}

TEST(TextTable, ReadsNameUnitColumnsAndCells) {
  Diagnostics diagnostics;
  const TextTable table = read(plainTable, &diagnostics);
  EXPECT_TRUE(diagnostics.empty());
  EXPECT_EQ(table.name(), "TOOL.T");
  EXPECT_EQ(table.unit(), TableUnit::Millimetre);
  EXPECT_THAT(table.keys(), ElementsAre("0", "1", "5", "5.1"));
  EXPECT_EQ(table.cell("1", "NAME"), "PROBE_A");
  EXPECT_EQ(table.cell("1", "L"), "+120.5000");
  EXPECT_EQ(table.cell("5.10", "R"), "+5.0010");
  EXPECT_EQ(table.cell("5", "DOC"), "");
  EXPECT_EQ(table.cell("0", "SPECIAL"), "x");
  EXPECT_EQ(table.cell("5", "NOWHERE"), std::nullopt);
  EXPECT_EQ(table.cell("6", "L"), std::nullopt);
  EXPECT_EQ(table.place("5", "L").line, 5U);
  EXPECT_EQ(table.place("5", "L").column, 19U);
}

TEST(TextTable, KeepsEveryByteOfWhatItDoesNotChange) {
  std::string windows = plainTable;
  for (std::size_t i = windows.find('\n'); i != std::string::npos; i = windows.find('\n', i + 2)) {
    windows.insert(i, 1, '\r');
  }
  const std::string withDefinition =
      "\xEF\xBB\xBF"
      "BEGIN USER.TAB INCH Version: 'x'\r\n#STRUCTBEGIN\r\nNR N 6 0\r\nX N 12 4\r\n#STRUCTEND\r\n"
      "NR    X           REMARK\r\n\r\n1     1.5\t\t\r\n   \r\n[END]";
  const std::string oneByteText = "BEGIN P.PR MM\nNO  DOC       X\n1   Fr\xE4se  \xB5  +1.25  \n[END]";
  const std::string utf8Text = "BEGIN P.PR MM\nNO  DOC       X\n1   Fr\xC3\xA4se \xE6\xB5\x8B   +1.25  \n[END]";
  for (const std::string& text : {plainTable, windows, withDefinition, oneByteText, utf8Text}) {
    EXPECT_EQ(read(text).bytes(), text);
  }
  EXPECT_EQ(read(withDefinition).unit(), TableUnit::Inch);
  EXPECT_EQ(read(withDefinition).cell("1", "X"), "1.5");
  EXPECT_FALSE(read(oneByteText).isUtf8());
  EXPECT_EQ(read(oneByteText).cell("1", "DOC"), "Fr\xE4se  \xB5");
  EXPECT_EQ(read(oneByteText).cell("1", "X"), "+1.25");
  EXPECT_TRUE(read(utf8Text).isUtf8());
  EXPECT_EQ(read(utf8Text).cell("1", "DOC"), "Fr\xC3\xA4se \xE6\xB5\x8B");
  EXPECT_EQ(read(utf8Text).cell("1", "X"), "+1.25");
}

TEST(TextTable, SettingACellChangesItsBytesOnly) {
  TextTable table = read(plainTable);
  ASSERT_TRUE(table.setNumber("1", "L", 99.98765));
  const std::size_t at = plainTable.find("+120.5000");
  expectOnlyBytesChanged(plainTable, table.bytes(), at, std::string("+120.5000").size());
  EXPECT_EQ(table.bytes().substr(at, 12), "+99.9877    ");
}

TEST(TextTable, SettingACellKeepsLineEndsAndEncodings) {
  std::string text = "BEGIN P.PR MM\r\nNO  DOC       X      Y\r\n1   Fr\xC3\xA4se     +1.25  +2\r\n[END]\r\n";
  TextTable table = read(text);
  ASSERT_TRUE(table.setNumber("1", "Y", -3.5));
  EXPECT_EQ(table.bytes(),
            "BEGIN P.PR MM\r\nNO  DOC       X      Y\r\n1   Fr\xC3\xA4se     +1.25  -3.5000\r\n[END]\r\n");
  ASSERT_TRUE(table.setNumber("1", "X", 7.0));
  EXPECT_EQ(table.cell("1", "X"), "+7.00");
  EXPECT_EQ(table.cell("1", "DOC"), "Fr\xC3\xA4se");
  EXPECT_FALSE(table.setCell("1", "DOC", "\xE4"));
}

TEST(TextTable, WritesBehindTheEndOfAShortRow) {
  TextTable table = read(plainTable);
  ASSERT_TRUE(table.setCell("5.1", "SPECIAL", "12"));
  EXPECT_THAT(table.bytes(), HasSubstr("5.1   MILL_D10    +14.0000    +5.0010   12\n[END]"));
  ASSERT_TRUE(table.setCell("0", "DOC", "long text that reaches far beyond the header line"));
  EXPECT_EQ(table.cell("0", "DOC"), "long text that reaches far beyond the header line");
  ASSERT_TRUE(table.setCell("1", "DOC", ""));
  EXPECT_EQ(table.cell("1", "DOC"), "");
}

TEST(TextTable, KeepsRightAlignedNumbersRightAligned) {
  const std::string aligned =
      "BEGIN A.D MM\n"
      "D   X         Y         DOC\n"
      "1       12.50   -100.00 a\n"
      "2                       b\n"
      "[END]\n";
  TextTable right = read(aligned);
  ASSERT_TRUE(right.setNumber("1", "X", 3.0));
  ASSERT_TRUE(right.setNumber("2", "Y", 1234.5));
  EXPECT_EQ(right.bytes(),
            "BEGIN A.D MM\n"
            "D   X         Y         DOC\n"
            "1        3.00   -100.00 a\n"
            "2               1234.50 b\n"
            "[END]\n");
  // A blank is left behind a text, however long it is.
  TextTable full = read(aligned);
  EXPECT_FALSE(full.setCell("2", "Y", "-123456.78"));
  ASSERT_TRUE(full.setCell("2", "Y", "-12345.67"));
  EXPECT_THAT(full.bytes(), HasSubstr("2             -12345.67 b\n"));
}

/// Of the last column nothing says how wide it is; what stands in it does.
TEST(TextTable, KeepsRightAlignedNumbersOfTheLastColumnRightAligned) {
  const std::string aligned =
      "BEGIN A.D MM\n"
      "D   X         Y\n"
      "1       12.50   -100.00\n"
      "2       12.50   -100.00\n"
      "3       12.50 -100.00\n"
      "[END]\n";
  TextTable right = read(aligned);
  ASSERT_TRUE(right.setNumber("1", "Y", 1.5));
  ASSERT_TRUE(right.setNumber("2", "Y", -2000.5));
  EXPECT_EQ(right.bytes(),
            "BEGIN A.D MM\n"
            "D   X         Y\n"
            "1       12.50      1.50\n"
            "2       12.50  -2000.50\n"
            "3       12.50 -100.00\n"
            "[END]\n");
}

TEST(TextTable, InsertsRowsInOrder) {
  TextTable table = read(plainTable);
  ASSERT_TRUE(table.addRow("5.2"));
  ASSERT_TRUE(table.addRow("3"));
  ASSERT_TRUE(table.setNumber("3", "R", 1.5));
  EXPECT_THAT(table.keys(), ElementsAre("0", "1", "3", "5", "5.1", "5.2"));
  EXPECT_EQ(table.cell("3", "R"), "+1.5000");
  EXPECT_EQ(table.cell("5", "L"), "-12.2500");
  EXPECT_EQ(table.cell("5.1", "L"), "+14.0000");
  EXPECT_FALSE(table.addRow("3.0")) << "3.0 is 3";
  EXPECT_FALSE(table.addRow("12345678"));
  EXPECT_FALSE(table.addRow("4 4"));
  EXPECT_TRUE(table.bytes().ends_with("[END]\ntext after the end\n"));
  Diagnostics diagnostics;
  const TextTable again = read(table.bytes(), &diagnostics);
  EXPECT_TRUE(diagnostics.empty());
  EXPECT_EQ(again.keys(), table.keys());
}

TEST(TextTable, GrowsAnEmptyTableWithoutALastLineEnd) {
  TextTable table = read("BEGIN A.D MM\nD   X");
  ASSERT_TRUE(table.addRow("2"));
  ASSERT_TRUE(table.addRow("1"));
  EXPECT_EQ(table.bytes(), "BEGIN A.D MM\nD   X\n1    \n2    \n");
  TextTable carriageReturn = read("BEGIN A.D MM\r\nD   X\r");
  ASSERT_TRUE(carriageReturn.addRow("2"));
  EXPECT_EQ(read(carriageReturn.bytes()).keys(), std::vector<std::string>{"2"});
}

/// Messages show the line as it stands; only control characters, which no terminal should get, are replaced.
TEST(TextTable, ShowsLinesAsTheyAre) {
  const std::string noUnit = "BEGIN TOOL T !~ \x1f\x01 #";
  Diagnostics diagnostics;
  read(noUnit + "\nT    L\n1    2\n[END]\n", &diagnostics);
  ASSERT_FALSE(diagnostics.empty());
  EXPECT_EQ(diagnostics.front().excerpt, "BEGIN TOOL T !~ ?? #");
  Diagnostics others;
  const auto none = TextTable::parse("no table here\tat all\n", "T.T", others);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().excerpt, "no table here?at all");
  EXPECT_EQ(none.error().place.line, 1U);
  const auto later = TextTable::parse("\n  \n no table here\n", "T.T", others);
  ASSERT_FALSE(later);
  EXPECT_EQ(later.error().place.line, 3U);
  const auto endless = TextTable::parse(std::string(500, 'x') + "\n", "T.T", others);
  ASSERT_FALSE(endless);
  EXPECT_EQ(endless.error().excerpt, std::string(120, 'x'));
}

TEST(TextTable, RefusesWhatDoesNotFit) {
  TextTable table = read(plainTable);
  const auto wide = table.setNumber("1", "R", 123456.7);
  ASSERT_FALSE(wide);
  EXPECT_EQ(wide.error().place.line, 4U);
  EXPECT_EQ(wide.error().place.column, 31U);
  EXPECT_THAT(wide.error().message, HasSubstr("\"+123456.7000\" is too wide for column R, which holds 9 characters"));
  EXPECT_THAT(wide.error().excerpt, HasSubstr("PROBE_A"));
  EXPECT_FALSE(wide.error().advice.empty());
  EXPECT_FALSE(table.setNumber("1", "R", std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(table.setNumber("1", "R", 1e300));
  EXPECT_FALSE(table.setCell("1", "NAME", "two\nlines"));
  EXPECT_THAT(table.setCell("1", "Q", "1").error().message, HasSubstr("no column Q"));
  EXPECT_THAT(table.setCell("99", "L", "1").error().message, HasSubstr("no row 99"));
  EXPECT_THAT(table.setCell("1", "T", "2").error().message, HasSubstr("cannot be changed"));
  EXPECT_EQ(table.bytes(), plainTable) << "a refused entry leaves the table as it was";
}

std::string errorOf(std::string_view text) {
  Diagnostics diagnostics;
  const auto table = TextTable::parse(text, "BAD.T", diagnostics);
  return table ? "" : format(table.error());
}

std::string warningOf(std::string_view text) {
  Diagnostics diagnostics;
  const auto table = TextTable::parse(text, "BAD.T", diagnostics);
  return table && !diagnostics.empty() ? format(diagnostics.front()) : "";
}

TEST(TextTable, SaysWhatIsWrongWithAFile) {
  EXPECT_THAT(errorOf(""), HasSubstr("BAD.T:1:1: error: a table begins with a line such as"));
  EXPECT_THAT(errorOf("\n\nT  NAME\n1  A\n"), HasSubstr("BAD.T:3:1: error: a table begins"));
  EXPECT_THAT(errorOf("BEGIN TOOL.T MM\n"), HasSubstr("BAD.T:2:1: error: the header line"));
  EXPECT_THAT(errorOf("BEGIN TOOL.T MM\n[END]\n"), HasSubstr("header line"));
  EXPECT_THAT(errorOf("BEGIN A.TAB MM\n#STRUCTBEGIN\nNR\n"), HasSubstr("header line"));
  EXPECT_THAT(errorOf(std::string_view("BEGIN TOOL.T MM\nT  L\n1\0 2\n", 25)),
              HasSubstr("BAD.T:3: error: this is not"));
  EXPECT_THAT(warningOf("BEGIN TOOL.T\nT  L\n[END]"), HasSubstr("names no unit"));
  EXPECT_THAT(warningOf("BEGIN TOOL.T MM\nT  L  L\n[END]"), HasSubstr("BAD.T:2:7: warning: column L appears twice"));
  EXPECT_THAT(warningOf("BEGIN TOOL.T MM\nT  L\n1  2\n1  3\n[END]"),
              HasSubstr("BAD.T:4:1: warning: row 1 appears twice"));
  EXPECT_THAT(warningOf("BEGIN TOOL.T MM\nT  L\n   3\n[END]"),
              HasSubstr("BAD.T:3:1: warning: this line has no entry in column T"));
  EXPECT_THAT(warningOf("BEGIN TOOL.T MM\nT    L\n1   +12.5\n[END]"),
              HasSubstr("BAD.T:3:6: warning: an entry reaches across the beginning of column L"));
  EXPECT_THAT(warningOf("BEGIN TOOL.T MM\nT  L\n1  3\n"), HasSubstr("without the line [END]"));
}

TEST(TextTable, SurvivesAnyBytes) {
  std::mt19937_64 random(20);
  const std::string alphabet = "BEGIN TOOL.T MM\n\r\tT NAME L [END]#STRUCT+-.0123456789 \xC3\xA4\xFF\xE4\"";
  for (int i = 0; i < 3000; ++i) {
    std::string text = i % 2 == 0 ? plainTable : std::string();
    const auto edits = random() % 60;
    for (std::uint64_t k = 0; k < edits; ++k) {
      const char c = alphabet[random() % alphabet.size()];
      const std::size_t at = text.empty() ? 0 : random() % text.size();
      if (random() % 3 == 0 && !text.empty()) {
        text.erase(at, 1);
      } else {
        text.insert(at, 1, c);
      }
    }
    Diagnostics diagnostics;
    auto table = TextTable::parse(text, "x", diagnostics);
    if (!table) continue;
    ASSERT_EQ(table->bytes(), text);
    for (const std::string& key : table->keys()) {
      for (const TableColumn& column : table->columns()) {
        if (!table->setCell(key, column.name, "7")) continue;
        ASSERT_EQ(table->cell(key, column.name), "7");
      }
    }
  }
}

}  // namespace
}  // namespace probewright::control::heidenhain
