#include "base/utf8.hpp"

#include <gtest/gtest.h>
#include <unicode/unistr.h>
#include <unicode/utf8.h>

#include <random>
#include <string>

namespace probewright {
namespace {

TEST(Utf8, CountsCharactersNotBytes) {
  EXPECT_EQ(characterCount(""), 0U);
  EXPECT_EQ(characterCount("Mess 1"), 6U);
  EXPECT_EQ(characterCount("Länge"), 5U);
  EXPECT_EQ(characterCount("длина"), 5U);
  EXPECT_EQ(characterCount("长度"), 2U);
  EXPECT_EQ(characterCount("\xF0\x9F\x94\xA7 M6"), 4U);
}

TEST(Utf8, KnowsWhatIsNone) {
  EXPECT_TRUE(isUtf8(""));
  EXPECT_TRUE(isUtf8("Länge 长度 \xF0\x9F\x94\xA7"));
  EXPECT_FALSE(isUtf8("L\xE4nge")) << "Windows-1252";
  EXPECT_FALSE(isUtf8("\xD0")) << "cut short";
  EXPECT_FALSE(isUtf8("\x80")) << "no beginning";
  EXPECT_FALSE(isUtf8("\xC0\xAF")) << "overlong";
  EXPECT_FALSE(isUtf8("\xE0\x80\xAF")) << "overlong";
  EXPECT_FALSE(isUtf8("\xED\xA0\x80")) << "a surrogate";
  EXPECT_FALSE(isUtf8("\xF4\x90\x80\x80")) << "above U+10FFFF";
  EXPECT_FALSE(isUtf8("\xF8\x88\x80\x80\x80")) << "five bytes";
}

/// ICU decides: random bytes of the kind that mistakes are made with.
TEST(Utf8, AgreesWithIcuOnRandomBytes) {
  std::mt19937_64 random(5);
  constexpr std::string_view bytes =
      "A\x7F\x80\x8F\x90\x9F\xA0\xBF\xC0\xC1\xC2\xDF\xE0\xE1\xED\xEF\xF0\xF1\xF4\xF5\xFF";
  int valid = 0;
  for (int i = 0; i < 200'000; ++i) {
    std::string text;
    for (std::size_t size = random() % 6; text.size() < size;)
      text += bytes[random() % bytes.size()];
    bool good = true;
    std::size_t characters = 0;
    for (std::int32_t at = 0; at < static_cast<std::int32_t>(text.size()); ++characters) {
      UChar32 character = 0;
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"  // within ICU's macro
      U8_NEXT(text.data(), at, static_cast<std::int32_t>(text.size()), character);
#pragma GCC diagnostic pop
      good = good && character >= 0;
    }
    ASSERT_EQ(isUtf8(text), good) << ::testing::PrintToString(text);
    if (!good) continue;
    ++valid;
    ASSERT_EQ(characterCount(text), characters) << ::testing::PrintToString(text);
  }
  EXPECT_GT(valid, 10'000);
}

}  // namespace
}  // namespace probewright
