#include "language/encoding.hpp"

#include <gtest/gtest.h>
#include <unicode/ucnv.h>

#include <string>
#include <vector>

namespace probewright::language {
namespace {

/// `utf8` in another encoding, by ICU.
std::string encoded(const std::string& utf8, Encoding encoding) {
  UErrorCode status = U_ZERO_ERROR;
  std::string bytes(utf8.size() * 4 + 16, '\0');
  const int32_t length =
      ucnv_convert(encodingName(encoding).data(), "UTF-8", bytes.data(), static_cast<int32_t>(bytes.size()),
                   utf8.data(), static_cast<int32_t>(utf8.size()), &status);
  EXPECT_TRUE(U_SUCCESS(status));
  bytes.resize(static_cast<std::size_t>(length));
  return bytes;
}

struct Sample {
  Encoding encoding;
  const char* text;
};

const std::vector<Sample> samples = {
    {Encoding::Windows1252, "; Werkstück außen prüfen, Fläche Z = 0 °"},
    {Encoding::Windows1252, "; BOHRUNG GRÖßE Ø 20 ±0.05"},
    {Encoding::Windows1252, "; mesurer le côté extérieur de la pièce, déjà réglé"},
    {Encoding::Windows1252, "; pieza de medición: año, ángulo, posición"},
    {Encoding::Windows1252, "; mätning av hål, höjd på yta, större än måttet"},
    {Encoding::Windows1251, "; Измерение отверстия, базовая точка по оси Z"},
    {Encoding::Windows1251, "; ЦЕНТР ДЕТАЛИ, НАЧАЛО ОБРАБОТКИ"},
    {Encoding::Windows1251, "; вимірювання отвору, нульова точка її деталі"},
    {Encoding::Gbk, "; 测量孔的中心，设定工件零点"},
    {Encoding::Gbk, "; 第一道工序 X轴 对刀 Ø20"},
    {Encoding::Gbk, "; 工件坐标系找正"},
    {Encoding::Gbk, "; 中心"},
    {Encoding::Utf8, "; Werkstück prüfen, 测量, измерение"},
    {Encoding::Utf8, "L X+10 Y-5 R0 FMAX"},
};

TEST(Encoding, IsFoundFromTheBytes) {
  for (const Sample& sample : samples) {
    std::string text = sample.text;
    if (sample.encoding == Encoding::Gbk) {
      if (const auto at = text.find("Ø"); at != std::string::npos) text.erase(at, 2);
    }
    const std::string bytes = encoded(text, sample.encoding);
    EXPECT_EQ(encodingName(detectEncoding(bytes)), encodingName(sample.encoding)) << text;
    EXPECT_EQ(toUtf8(bytes, sample.encoding), text);
  }
}

TEST(Encoding, IsFoundFromWholeFilesWithFewComments) {
  std::string code;
  for (int i = 0; i < 200; ++i)
    code += "L X+" + std::to_string(i) + " R0 FMAX\n";
  for (const Sample& sample : samples) {
    if (sample.encoding == Encoding::Gbk && std::string(sample.text).find("Ø") != std::string::npos) continue;
    const std::string bytes = code + encoded(std::string(sample.text) + "\n", sample.encoding) + code;
    EXPECT_EQ(encodingName(detectEncoding(bytes)), encodingName(sample.encoding)) << sample.text;
  }
}

TEST(Encoding, NeverFailsOnGarbage) {
  std::string bytes;
  for (int i = 255; i >= 0; --i)
    bytes += static_cast<char>(i);
  for (const Encoding encoding : {Encoding::Utf8, Encoding::Windows1252, Encoding::Windows1251, Encoding::Gbk})
    EXPECT_EQ(detectEncoding(toUtf8(bytes, encoding)), Encoding::Utf8) << encodingName(encoding);
  EXPECT_EQ(toUtf8("a\xff"
                   "b",
                   Encoding::Utf8),
            "a\xef\xbf\xbd"
            "b");
  EXPECT_EQ(toUtf8(std::string(100000, '\xfc'), Encoding::Windows1252).size(), 200000U);
  for (const char* broken : {"\xc0\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe4\xb8", "\x80"})
    EXPECT_NE(detectEncoding(broken), Encoding::Utf8);
}

}  // namespace
}  // namespace probewright::language
