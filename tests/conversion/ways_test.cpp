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

}  // namespace
}  // namespace probewright
