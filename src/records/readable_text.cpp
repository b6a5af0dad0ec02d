#include "records/readable_text.hpp"

#include <algorithm>

namespace probewright::records {

using language::Encoding;

ReadableText::ReadableText(const RunInfo& run)
    : encoding_(run.programs.empty() ? Encoding::Utf8 : language::detectEncoding(run.programs.front().text)) {}

std::string ReadableText::operator()(const std::string& bytes) const {
  if (std::all_of(bytes.begin(), bytes.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; }))
    return bytes;
  const Encoding own = language::detectEncoding(bytes);
  if (own == Encoding::Utf8 || encoding_ != Encoding::Utf8)
    return language::toUtf8(bytes, own == Encoding::Utf8 ? own : encoding_);
  // Two or three letters cannot tell Cyrillic from umlauts.
  const auto high =
      std::count_if(bytes.begin(), bytes.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
  return language::toUtf8(bytes, high < 4 ? Encoding::Windows1252 : own);
}

}  // namespace probewright::records
