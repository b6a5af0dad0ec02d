#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "control/heidenhain/datum_table.hpp"
#include "control/heidenhain/preset_table.hpp"
#include "control/heidenhain/probe_table.hpp"
#include "control/heidenhain/tool_table.hpp"

namespace probewright::control::heidenhain {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(ToolTable, ReadsToolsAndSteps) {
  Diagnostics diagnostics;
  const auto table = TypedTable::parse(
      "BEGIN TOOL.T MM\n"
      "T     NAME        L           R         DL       DR       TL LTOL    RBREAK  TT:R-OFFS CUR_TIME TP_NO CUT\n"
      "1     PROBE_A     +120.5000   +3.0000   +0       +0          0       0                 0.00     2\n"
      "5     MILL_D10    +90.2500    +5.0000   -0.0120  +0.0030  L  0.0500  0.1     2.5       12.25          4\n"
      "5.1   MILL_D10    +85.0000    +5.0010\n"
      "[END]\n",
      "TOOL.T", toolColumns(), diagnostics);
  ASSERT_TRUE(table);
  EXPECT_TRUE(diagnostics.empty());
  EXPECT_EQ(table->text("5", "NAME"), "MILL_D10");
  EXPECT_EQ(table->number("5", "L"), 90.25);
  EXPECT_EQ(table->number("5", "DL"), -0.012);
  EXPECT_EQ(table->text("5", "TL"), "L");
  EXPECT_EQ(table->number("5", "LTOL"), 0.05);
  EXPECT_EQ(table->number("5", "RBREAK"), 0.1);
  EXPECT_EQ(table->number("5", "R-OFFS"), 2.5);
  EXPECT_EQ(table->number("5", "CUT"), 4);
  EXPECT_EQ(table->number("5", "TP_NO"), std::nullopt);
  EXPECT_EQ(table->text("1", "TL"), "");
  EXPECT_EQ(table->number("1", "TP_NO"), 2);
  EXPECT_EQ(table->number("1", "R-OFFS"), std::nullopt);
  EXPECT_EQ(table->number(toolKey(5, 1), "R"), 5.001);
  EXPECT_FALSE(table->hasRow(toolKey(7)));
  EXPECT_EQ(findToolNamed(*table, "MILL_D10"), "5");
  EXPECT_EQ(findToolNamed(*table, "mill_d10"), std::nullopt);
  EXPECT_EQ(table->number("5", "CUR.TIME"), 12.25);
}

TEST(ToolTable, NamesAnEntryThatIsNoNumber) {
  Diagnostics diagnostics;
  const auto table = TypedTable::parse("BEGIN TOOL.T MM\nT  L      R\n1  12,5   3\n2  1e3    3\n[END]\n", "TOOL.T",
                                       toolColumns(), diagnostics);
  ASSERT_TRUE(table);
  ASSERT_EQ(diagnostics.size(), 2U);
  EXPECT_THAT(format(diagnostics[0]), HasSubstr("TOOL.T:3:4: error: column L takes a number"));
  EXPECT_EQ(diagnostics[0].excerpt, "12,5");
  EXPECT_THAT(format(diagnostics[1]), HasSubstr("TOOL.T:4:4"));
  EXPECT_EQ(table->number("1", "L"), std::nullopt);
}

TEST(ToolTable, NamesANumberOfTeethThatIsNotWhole) {
  Diagnostics diagnostics;
  ASSERT_TRUE(TypedTable::parse("BEGIN TOOL.T MM\nT  L      CUT\n1  12.5   2.0\n2  12.5   2.5\n[END]\n", "TOOL.T",
                                toolColumns(), diagnostics));
  ASSERT_EQ(diagnostics.size(), 1U);
  EXPECT_THAT(format(diagnostics[0]), HasSubstr("TOOL.T:4:11: error: column CUT takes a whole number"));
}

TEST(ToolTable, TakesTheSignsOfTheCuttingDirectionOnly) {
  Diagnostics diagnostics;
  ASSERT_TRUE(
      TypedTable::parse("BEGIN TOOL.T MM\nT  L     DIRECT\n1  12.5  -\n2  12.5  +\n3  12.5\n4  12.5  M4\n[END]\n",
                        "TOOL.T", toolColumns(), diagnostics));
  ASSERT_EQ(diagnostics.size(), 1U);
  EXPECT_THAT(format(diagnostics[0]), HasSubstr("TOOL.T:6:10: error: column DIRECT takes - or +"));
  EXPECT_THAT(format(diagnostics[0]), HasSubstr("+ is M4; an empty entry is -"));
}

TEST(ToolTable, InchTablesConvertAtTheBorder) {
  Diagnostics diagnostics;
  auto table = TypedTable::parse("BEGIN TOOL.T INCH\nT  L          ANGLE\n1  +2.00000   +30.000\n[END]\n", "T",
                                 toolColumns(), diagnostics);
  ASSERT_TRUE(table);
  EXPECT_DOUBLE_EQ(table->numberOr("1", "L", 0), 50.8);
  EXPECT_EQ(table->number("1", "ANGLE"), 30.0);
  ASSERT_TRUE(table->setNumber("1", "L", 25.4 * 1.5));
  EXPECT_EQ(table->text("1", "L"), "+1.50000");
}

TEST(ToolTable, NewTablesHaveTheColumnsOfTheirControl) {
  TypedTable tnc = defaultToolTable(ControlKind::TNC640);
  EXPECT_TRUE(tnc.hasColumn("TP_NO"));
  EXPECT_FALSE(tnc.hasColumn("CAL-OF1"));
  TypedTable itnc = defaultToolTable(ControlKind::iTNC530);
  EXPECT_FALSE(itnc.hasColumn("TP_NO"));
  EXPECT_TRUE(itnc.hasColumn("CAL-OF1"));
  ASSERT_TRUE(tnc.setText("3", "NAME", "TS_640"));
  ASSERT_TRUE(tnc.setNumber("3", "L", 150.12344));
  ASSERT_TRUE(tnc.setNumber("3", "TP_NO", 1));
  Diagnostics diagnostics;
  const auto again = TypedTable::parse(tnc.table().bytes(), "TOOL.T", toolColumns(), diagnostics);
  ASSERT_TRUE(again);
  EXPECT_TRUE(diagnostics.empty());
  EXPECT_EQ(again->number("3", "L"), 150.1234);
  EXPECT_EQ(again->number("3", "TP_NO"), 1);
  EXPECT_EQ(again->text("3", "L"), "+150.1234");
  EXPECT_EQ(again->text("3", "DL"), "+0.0000");
}

TEST(ProbeTable, DefaultsAndEntries) {
  TypedTable table = defaultProbeTable(ControlKind::TNC640);
  const TouchProbe plain = findProbe(table, 1).value();
  EXPECT_EQ(plain.feed, 300);
  EXPECT_EQ(plain.rapid, 2000);
  EXPECT_EQ(plain.maximumTravel, 10);
  EXPECT_EQ(plain.setUpClearance, 2);
  EXPECT_FALSE(plain.prepositionAtMachineRapid);
  EXPECT_FALSE(plain.track);
  ASSERT_TRUE(table.setText("1", "F_PREPOS", "FMAX_MACHINE"));
  ASSERT_TRUE(table.setText("1", "TRACK", "ON"));
  ASSERT_TRUE(table.setNumber("1", "CAL_OF1", -0.01234));
  const TouchProbe changed = findProbe(table, 1).value();
  EXPECT_TRUE(changed.prepositionAtMachineRapid);
  EXPECT_TRUE(changed.track);
  EXPECT_EQ(changed.centreOffset1, -0.0123);
  EXPECT_EQ(findProbe(table, 5), std::nullopt);
}

TEST(PresetTable, TheTNCHasSpatialAnglesAndOffsets) {
  TypedTable table = defaultPresetTable(ControlKind::TNC640);
  ASSERT_TRUE(table.setNumber("1", "SPC", 1.2345));
  ASSERT_TRUE(table.setNumber("12", "C_OFFS", -7.5));
  EXPECT_EQ(table.text("1", "SPC"), "+1.2345");
  EXPECT_EQ(table.text("12", "C_OFFS"), "-7.5000");
  EXPECT_EQ(table.number("12", "SPC"), 0) << "a new row begins with zeros";
  EXPECT_FALSE(table.hasColumn("ROT"));
}

TEST(PresetTable, RotationOfTheITNCIsTheColumnRot) {
  TypedTable table = defaultPresetTable(ControlKind::iTNC530);
  EXPECT_FALSE(table.hasColumn("SPC"));
  EXPECT_FALSE(table.hasColumn("C_OFFS"));
  ASSERT_TRUE(table.setNumber("3", "ROT", -3.5));
  ASSERT_TRUE(table.setNumber("3", "C", 90));
  EXPECT_EQ(table.text("3", "ROT"), "-3.5000");
  EXPECT_EQ(table.number("3", "C"), 90);
}

/// Names that come from programs are taken as they are; what no table has reads as nothing.
TEST(TypedTable, ColumnsNamedWhileRunningMayBeMissing) {
  TypedTable table = defaultPresetTable(ControlKind::TNC640);
  EXPECT_TRUE(table.hasColumn(Column::named("SPC")));
  EXPECT_FALSE(table.hasColumn(Column::named("SPD")));
  EXPECT_EQ(table.number("1", NumberColumn::named("SPD")), std::nullopt);
  EXPECT_FALSE(table.setNumber("1", NumberColumn::named("SPD"), 1));
}

TEST(DatumTable, ReadsShiftsByNumber) {
  Diagnostics diagnostics;
  const auto table = TypedTable::parse(
      "BEGIN ZERO.D MM\nD     X         Y         Z      C       DOC\n"
      "0     +0        +0        +0     +0\n7     +12.5     -3.25            +90     left vice\n[END]\n",
      "ZERO.D", datumColumns(), diagnostics);
  ASSERT_TRUE(table);
  const Datum datum = findDatum(*table, 7).value();
  EXPECT_EQ(datum.shift, Vector3(12.5, -3.25, 0));
  EXPECT_EQ(datum.rotary[2], 90);
  EXPECT_EQ(datum.comment, "left vice");
  EXPECT_EQ(findDatum(*table, 1), std::nullopt);
  EXPECT_TRUE(findDatum(defaultDatumTable(ControlKind::TNC640), 0));
}

TEST(TypedTable, RefusesTheWrongKindOfTable) {
  Diagnostics diagnostics;
  const auto table =
      TypedTable::parse("BEGIN ZERO.D MM\nD     X\n0     +0\n[END]\n", "ZERO.D", toolColumns(), diagnostics);
  ASSERT_TRUE(table);
  ASSERT_EQ(diagnostics.size(), 1U);
  EXPECT_THAT(diagnostics[0].message, HasSubstr("no column T"));
  // Touch probes and presets have the same key.
  diagnostics.clear();
  const auto presets = TypedTable::parse("BEGIN TCHPROBE.TP MM\nNO   CAL_OF1\n1    +0.5\n[END]\n", "PRESET.PR",
                                         presetColumns(), diagnostics);
  ASSERT_EQ(diagnostics.size(), 1U);
  EXPECT_THAT(diagnostics[0].message, HasSubstr("none of the columns"));
}

/// Random values of a table that is written, saved and read again: equal to the last digit the columns have.
/// Entries that somebody has typed in short do not cut what the control writes below or over them.
TEST(TypedTable, WritesTheDecimalsOfTheControlUnderShortEntries) {
  const auto written = [](std::string_view unit, std::string_view entry, double value, std::string_view head) {
    Diagnostics diagnostics;
    auto table = TypedTable::parse(fmt::format("BEGIN TOOL.T {}\n{}\n1     {}\n[END]\n", unit, head, entry), "TOOL.T",
                                   toolColumns(), diagnostics);
    EXPECT_TRUE(table);
    EXPECT_TRUE(table->setNumber("1", NumberColumn("DL"), value));
    return table->text("1", Column("DL"));
  };
  const std::string_view wide = "T     DL          CUT";
  EXPECT_EQ(written("MM", "+0.1", 0.05, wide), "+0.0500");
  EXPECT_EQ(written("MM", "0", 0.05, wide), "0.0500");
  EXPECT_EQ(written("INCH", "+0.1", 0.0254, wide), "+0.00100");
  EXPECT_EQ(written("MM", "+0.123456", 0.05, wide), "+0.050000");
  // As many as a column has room for that somebody made too narrow, and never fewer than it shows.
  EXPECT_EQ(written("MM", "+0.1", 0.056, "T     DL    CUT"), "+0.06");
}

TEST(TypedTable, ValuesSurviveTheFile) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<long long> ticks(-999999999, 999999999);
  TypedTable table = defaultPresetTable(ControlKind::TNC640);
  constexpr std::array<NumberColumn, 12> columns = {"X",      "Y",      "Z",      "X_OFFS", "Y_OFFS", "Z_OFFS",
                                                    "A_OFFS", "B_OFFS", "C_OFFS", "U_OFFS", "V_OFFS", "W_OFFS"};
  std::array<std::array<double, columns.size()>, 60> rows{};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t column = 0; column < columns.size(); ++column) {
      rows[i][column] = static_cast<double>(ticks(random) / (column < 3 ? 1 : 1000)) / 1e4;
      // A cell may be written before, and rows may be added in any order.
      const std::string row = std::to_string(random() % 2 == 0 ? i : rows.size() - 1 - i);
      ASSERT_TRUE(table.setNumber(row, columns[column], rows[i][column]));
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t column = 0; column < columns.size(); ++column)
      ASSERT_TRUE(table.setNumber(std::to_string(i), columns[column], rows[i][column]));
  }
  Diagnostics diagnostics;
  const auto again = TypedTable::parse(table.table().bytes(), "PRESET.PR", presetColumns(), diagnostics);
  ASSERT_TRUE(again);
  EXPECT_TRUE(diagnostics.empty());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t column = 0; column < columns.size(); ++column)
      EXPECT_EQ(again->number(std::to_string(i), columns[column]), rows[i][column]);
  }
}

}  // namespace
}  // namespace probewright::control::heidenhain
