#include "language/encoding.hpp"

#include <unicode/ucnv.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "base/utf8.hpp"

namespace probewright::language {

namespace {

using Byte = unsigned char;

bool isHigh(char c) { return static_cast<Byte>(c) >= 0x80; }

std::string convert(std::string_view bytes, const char* from, const char* to, bool& complete) {
  const auto open = [](const char* name) {
    UErrorCode status = U_ZERO_ERROR;
    return std::unique_ptr<UConverter, decltype(&ucnv_close)>(ucnv_open(name, &status), &ucnv_close);
  };
  const auto source = open(from);
  const auto target = open(to);
  std::string text;
  complete = source && target;
  if (!complete) return text;
  UErrorCode status = U_ZERO_ERROR;
  if (std::string_view(to) != "UTF-8") ucnv_setSubstChars(target.get(), "?", 1, &status);
  char buffer[4096];
  const char* in = bytes.data();
  const char* end = in + bytes.size();
  UChar pivot[1024];
  UChar *pivotSource = pivot, *pivotTarget = pivot;
  bool reset = true;
  do {
    status = U_ZERO_ERROR;
    char* out = buffer;
    ucnv_convertEx(target.get(), source.get(), &out, buffer + sizeof buffer, &in, end, pivot, &pivotSource,
                   &pivotTarget, pivot + std::size(pivot), reset, true, &status);
    reset = false;
    text.append(buffer, out);
  } while (status == U_BUFFER_OVERFLOW_ERROR);
  complete = U_SUCCESS(status);
  return text;
}

bool isCyrillic(Byte c) {
  constexpr std::string_view others = "\xa8\xb8\xaa\xba\xaf\xbf\xa5\xb4\xb2\xb3";  // Ё and the Ukrainian letters
  return c >= 0xc0 || others.find(static_cast<char>(c)) != std::string_view::npos;
}

bool isCyrillicVowel(Byte c) {
  constexpr std::string_view vowels =
      "\xc0\xc5\xc8\xce\xd3\xdb\xdd\xde\xdf\xe0\xe5\xe8\xee\xf3\xfb\xfd\xfe\xff\xa8\xb8\xaa\xba\xaf\xbf\xb2\xb3";
  return vowels.find(static_cast<char>(c)) != std::string_view::npos;
}

/// What speaks for the one or the other encoding, counted over all runs of bytes above ASCII.
struct Evidence {
  std::size_t single = 0;      ///< runs of one byte
  std::size_t cyrillic = 0;    ///< bytes in runs that look like a Cyrillic word
  std::size_t vowels = 0;      ///< of them
  std::size_t hanzi = 0;       ///< bytes that are common Chinese characters or punctuation
  std::size_t otherPairs = 0;  ///< bytes of other pairs
  bool pairs = true;           ///< everything can be read as pairs
};

void readAsWord(std::string_view run, Evidence& evidence) {
  if (run.size() < 2) return;
  const auto letter = [](char c) { return isCyrillic(static_cast<Byte>(c)); };
  if (!std::all_of(run.begin(), run.end(), letter)) return;
  // All capitals, or small letters after at most one capital.
  const auto small = [](char c) { return static_cast<Byte>(c) >= 0xe0; };
  const auto smallCount = std::count_if(run.begin() + 1, run.end(), small);
  if (smallCount != 0 && smallCount != static_cast<std::ptrdiff_t>(run.size()) - 1) return;
  evidence.cyrillic += run.size();
  evidence.vowels += static_cast<std::size_t>(
      std::count_if(run.begin(), run.end(), [](char c) { return isCyrillicVowel(static_cast<Byte>(c)); }));
}

/// Reads the run at the beginning of `text`; its last byte may be paired with an ASCII byte.
void readAsPairs(std::string_view text, Evidence& evidence) {
  std::size_t i = 0;
  while (i < text.size() && isHigh(text[i])) {
    const Byte lead = static_cast<Byte>(text[i]);
    const Byte trail = i + 1 < text.size() ? static_cast<Byte>(text[i + 1]) : Byte{0};
    if (lead == 0x80 || lead == 0xff || trail < 0x40 || trail == 0x7f || trail == 0xff) {
      evidence.pairs = false;
      return;
    }
    const bool common = trail >= 0xa1 && ((lead >= 0xb0 && lead <= 0xd7) || lead == 0xa1 || lead == 0xa3);
    (common ? evidence.hanzi : evidence.otherPairs) += 2;
    i += 2;
  }
}

}  // namespace

std::string_view encodingName(Encoding encoding) {
  switch (encoding) {
    case Encoding::Utf8:
      return "UTF-8";
    case Encoding::Windows1252:
      return "windows-1252";
    case Encoding::Windows1251:
      return "windows-1251";
    case Encoding::Gbk:
      return "GBK";
  }
  return "UTF-8";
}

Encoding detectEncoding(std::string_view bytes) {
  if (isUtf8(bytes)) return Encoding::Utf8;
  Evidence evidence;
  std::size_t high = 0;
  for (std::size_t i = 0; i < bytes.size();) {
    const auto first = std::find_if(bytes.begin() + static_cast<std::ptrdiff_t>(i), bytes.end(), isHigh);
    const auto last = std::find_if_not(first, bytes.end(), isHigh);
    const std::string_view run(first, last);
    high += run.size();
    if (run.size() == 1) ++evidence.single;
    readAsWord(run, evidence);
    const auto begin = static_cast<std::size_t>(first - bytes.begin());
    if (evidence.pairs) readAsPairs(bytes.substr(begin), evidence);
    i = begin + run.size();
  }
  const bool words = evidence.cyrillic * 4 >= high * 3 && evidence.vowels * 6 >= evidence.cyrillic &&
                     evidence.vowels * 4 <= evidence.cyrillic * 3;
  if (words) return Encoding::Windows1251;
  const bool chinese = evidence.pairs && evidence.hanzi >= 2 * evidence.otherPairs && evidence.single * 8 <= high;
  if (chinese) return Encoding::Gbk;
  return evidence.cyrillic > 2 * evidence.single ? Encoding::Windows1251 : Encoding::Windows1252;
}

std::string toUtf8(std::string_view bytes, Encoding encoding) {
  if (std::none_of(bytes.begin(), bytes.end(), isHigh)) return std::string(bytes);
  bool complete = false;
  std::string text = convert(bytes, encodingName(encoding).data(), "UTF-8", complete);
  if (complete) return text;
  text.clear();
  for (const char c : bytes)
    text += isHigh(c) ? std::string_view("\xef\xbf\xbd") : std::string_view(&c, 1);
  return text;
}

std::string fromUtf8(std::string_view text, Encoding encoding) {
  if (encoding == Encoding::Utf8 || std::none_of(text.begin(), text.end(), isHigh)) return std::string(text);
  bool complete = false;
  std::string bytes = convert(text, "UTF-8", encodingName(encoding).data(), complete);
  return complete ? bytes : std::string(text);
}

}  // namespace probewright::language
