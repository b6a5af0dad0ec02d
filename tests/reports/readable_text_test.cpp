#include "reports/readable_text.hpp"

#include <gtest/gtest.h>

namespace probewright::reports {
namespace {

TEST(ReadableText, KeepsUtf8) {
  EXPECT_EQ(readableText(""), "");
  EXPECT_EQ(readableText("L X+10 ;M\xC3\xBCller \xE6\xB5\x8B"), "L X+10 ;M\xC3\xBCller \xE6\xB5\x8B");
}

TEST(ReadableText, ReadsWesternComments) {
  const std::string program =
      "1 ;DURCHMESSER DER BOHRUNG PR\xDC"
      "FEN UND NULLPUNKT SETZEN\r\n"
      "2 ;TASTKUGEL M\xDCSSEN WIR F\xDCR DIE H\xD6HE KALIBRIEREN\r\n"
      "3 ;Tastsystem f\xFCr die Gr\xF6\xDF"
      "e und die L\xE4nge des Werkst\xFC"
      "cks\r\n";
  EXPECT_NE(readableText(program).find("f\xC3\xBCr die Gr\xC3\xB6\xC3\x9F"
                                       "e"),
            std::string::npos);
}

TEST(ReadableText, ReadsCyrillicComments) {
  // "измерение диаметра отверстия и установка нулевой точки" in CP1251.
  const std::string text =
      "; \xE8\xE7\xEC\xE5\xF0\xE5\xED\xE8\xE5 \xE4\xE8\xE0\xEC\xE5\xF2\xF0\xE0 \xEE\xF2\xE2\xE5\xF0\xF1\xF2\xE8\xFF "
      "\xE8 "
      "\xF3\xF1\xF2\xE0\xED\xEE\xE2\xEA\xE0 \xED\xF3\xEB\xE5\xE2\xEE\xE9 \xF2\xEE\xF7\xEA\xE8\n";
  EXPECT_NE(readableText("1 TOOL CALL 5 Z\n" + text)
                .find("\xD0\xB8\xD0\xB7\xD0\xBC\xD0\xB5\xD1\x80\xD0\xB5\xD0\xBD\xD0\xB8\xD0\xB5"),
            std::string::npos);
}

TEST(ReadableText, ReadsChineseComments) {
  // "测量孔的直径并设定工件零点" in GBK.
  const std::string text =
      "; \xB2\xE2\xC1\xBF\xBF\xD7\xB5\xC4\xD6\xB1\xBE\xB6\xB2\xA2\xC9\xE8\xB6\xA8\xB9\xA4\xBC\xFE\xC1\xE3\xB5\xE3\n";
  EXPECT_NE(readableText(text).find("\xE6\xB5\x8B\xE9\x87\x8F"), std::string::npos);
}

TEST(ReadableText, SurvivesAnyBytes) {
  std::string bytes;
  for (int i = 0; i < 4096; ++i)
    bytes.push_back(static_cast<char>((i * 7919) >> 3));
  EXPECT_FALSE(readableText(bytes).empty());
  EXPECT_FALSE(readableText("\xFF").empty());
}

}  // namespace
}  // namespace probewright::reports
