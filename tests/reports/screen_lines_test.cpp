#include "reports/screen_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/utf8.hpp"

namespace probewright::reports {
namespace {

using control::DialogLanguage;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::array others = {DialogLanguage::German, DialogLanguage::Russian, DialogLanguage::Swedish,
                               DialogLanguage::Chinese, DialogLanguage::Polish};

/// What tool measuring shows on HEIDENHAIN controls.
TEST(ScreenLines, OfToolMeasuringAreInEachLanguage) {
  const control::CycleRecord cycle;
  for (const DialogLanguage language : others) {
    SCOPED_TRACE(code(language));
    const auto shown = [&](const char* line) { return screenLine(line, cycle, language); };
    EXPECT_THAT(shown("TOOL 12 MILL D16"), AllOf(Not(HasSubstr("TOOL")), HasSubstr(" 12 MILL D16")));
    EXPECT_THAT(shown("LENGTH"), Not(HasSubstr("LENGTH")));
    EXPECT_EQ(shown("  +92.4184 *"), "  +92.4184 *");
    EXPECT_THAT(shown("TT CALIBRATED WITH TOOL 9"), AllOf(Not(HasSubstr("CALIBRATED")), HasSubstr("9")));
    EXPECT_THAT(shown("  RUN-OUT OF THE TOOL +0.0080 -0.0000"),
                AllOf(Not(HasSubstr("RUN-OUT")), HasSubstr(" +0.0080 -0.0000")));
  }
  EXPECT_EQ(screenLine("  MIN +1.0000  MAX +2.0000", cycle, DialogLanguage::Russian), "  МИН +1.0000  МАКС +2.0000");
  EXPECT_EQ(screenLine("TOOL 12", cycle, DialogLanguage::English), "TOOL 12");
}

/// The result screen of a SINUMERIK cycle: labels of results by what they are of, numbers where they stood.
TEST(ScreenLines, OfResultScreensKeepTheirColumns) {
  control::CycleRecord cycle;
  control::ResultRecord& length = cycle.results.emplace_back();
  length.label = "length 1";
  length.kind = {control::Role::Actual, {control::Quantity::Length, control::Along::First}};
  const std::string head = "                    Setpoint    Measured  Difference";
  const std::string row = "length 1 [mm]                   112.4000      0.0100";
  for (const DialogLanguage language : others) {
    SCOPED_TRACE(code(language));
    const std::string shownHead = screenLine(head, cycle, language), shownRow = screenLine(row, cycle, language);
    EXPECT_THAT(shownHead, AllOf(Not(HasSubstr("Setpoint")), Not(HasSubstr("Measured"))));
    EXPECT_EQ(characterCount(shownHead), characterCount(head));
    EXPECT_THAT(shownRow, AllOf(Not(HasSubstr("length 1")), HasSubstr(" [mm] ")));
    EXPECT_EQ(characterCount(shownRow), characterCount(row));
  }
}

}  // namespace
}  // namespace probewright::reports
