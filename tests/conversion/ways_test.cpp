#include <gtest/gtest.h>

#include "conversion/convert.hpp"

/// From which language into which programs can be converted, directly or over a third one.
namespace probewright {
namespace {

using language::ProgramLanguage;

constexpr ProgramLanguage languages[] = {ProgramLanguage::Klartext, ProgramLanguage::DinIso,
                                         ProgramLanguage::Sinumerik};

TEST(ConversionWays, LeadFromEachLanguageToEachOther) {
  for (const ProgramLanguage from : languages)
    for (const ProgramLanguage to : languages) {
      const bool itself = from == ProgramLanguage::Sinumerik && to == from;
      EXPECT_EQ(conversion::convertible(from, to), !itself) << int(from) << int(to);
    }
}

/// What cannot be carried over is named at its line in the program, also where it is the second step that cannot.
TEST(ConversionWays, NameTheLinesOfTheProgramWhereTheyLeadOverAThirdLanguage) {
  const auto program = language::programFromText(
      "a.i", "%A G71 *\nN10 T1 G17 *\nN20 G01 X+1 Y+2 F500 *\nN30 D18 Q1 ID350 NR50 IDX1 *\nN99999999 %A G71 *\n",
      ProgramLanguage::DinIso);
  const auto conversion = conversion::convert(*program, ProgramLanguage::DinIso, ProgramLanguage::Sinumerik);
  ASSERT_TRUE(conversion.mistakes.empty()) << format(conversion.mistakes.front());
  ASSERT_FALSE(conversion.notCarriedOver.empty());
  EXPECT_EQ(conversion.notCarriedOver.front().place.line, 4U) << format(conversion.notCarriedOver.front());
  EXPECT_NE(conversion.text.find("X1 Y2"), std::string::npos) << conversion.text;
}

/// So is what stands in the first line after the beginning, or in the last one of a program without an end.
TEST(ConversionWays, NameTheFirstLineAndTheLastOne) {
  const std::string begin = "%A G71 *\n", lost = "N30 D18 Q1 ID350 NR50 IDX1 *\n", fine = "N20 G01 X+1 F500 *\n";
  const std::pair<std::string, std::uint64_t> programs[] = {
      {begin + lost + fine, 2}, {begin + fine + fine + lost, 4}, {begin + lost, 2}};
  for (const auto& [text, line] : programs) {
    const auto program = language::programFromText("a.i", text, ProgramLanguage::DinIso);
    const auto conversion = conversion::convert(*program, ProgramLanguage::DinIso, ProgramLanguage::Sinumerik);
    ASSERT_TRUE(conversion.mistakes.empty()) << format(conversion.mistakes.front());
    ASSERT_EQ(conversion.notCarriedOver.size(), 1U) << text;
    EXPECT_EQ(conversion.notCarriedOver.front().place.line, line) << text;
    EXPECT_EQ(conversion.notCarriedOver.front().excerpt + "\n", lost) << text;
  }
}

}  // namespace
}  // namespace probewright
