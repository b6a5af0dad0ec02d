#include "reports/readable_text.hpp"

#include <unicode/ucsdet.h>
#include <unicode/unistr.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string_view>

namespace probewright::reports {

namespace {

bool isUtf8(const std::string& bytes) {
  // Malformed bytes come back as U+FFFD.
  std::string again;
  icu::UnicodeString::fromUTF8(bytes).toUTF8String(again);
  return again == bytes;
}

struct Encoding {
  std::string_view detected;  ///< the detector's name
  const char* converter;      ///< the superset that control panels and editors really use
};

constexpr std::array<Encoding, 8> programEncodings = {{{"ISO-8859-1", "windows-1252"},
                                                       {"windows-1252", "windows-1252"},
                                                       {"ISO-8859-2", "windows-1250"},
                                                       {"windows-1250", "windows-1250"},
                                                       {"ISO-8859-5", "windows-1251"},
                                                       {"windows-1251", "windows-1251"},
                                                       {"KOI8-R", "KOI8-R"},
                                                       {"GB18030", "GB18030"}}};

const char* guessEncoding(const std::string& bytes) {
  constexpr const char* fallback = "windows-1252";
  UErrorCode status = U_ZERO_ERROR;
  const std::unique_ptr<UCharsetDetector, decltype(&ucsdet_close)> detector(ucsdet_open(&status), ucsdet_close);
  // Only what stands outside ASCII tells encodings apart; lines without it would drown it.
  std::string sample;
  for (std::size_t start = 0; start < bytes.size() && sample.size() < 65536;) {
    const std::size_t end = std::min(bytes.find('\n', start), bytes.size());
    const std::string_view line(bytes.data() + start, end - start);
    if (std::any_of(line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; }))
      sample.append(line).push_back('\n');
    start = end + 1;
  }
  ucsdet_setText(detector.get(), sample.data(), static_cast<std::int32_t>(sample.size()), &status);
  std::int32_t count = 0;
  const UCharsetMatch** matches = ucsdet_detectAll(detector.get(), &count, &status);
  if (U_FAILURE(status)) return fallback;
  for (std::int32_t i = 0; i < count; ++i) {
    const std::string_view name = ucsdet_getName(matches[i], &status);
    for (const Encoding& encoding : programEncodings)
      if (name == encoding.detected) return encoding.converter;
  }
  return fallback;
}

}  // namespace

std::string readableText(const std::string& bytes) {
  if (isUtf8(bytes)) return bytes;
  std::string utf8;
  icu::UnicodeString(bytes.data(), static_cast<std::int32_t>(bytes.size()), guessEncoding(bytes)).toUTF8String(utf8);
  return utf8;
}

}  // namespace probewright::reports
