#include "records/readable_text.hpp"

#include <algorithm>

namespace probewright::records {

using language::Encoding;

ReadableText::ReadableText(const RunInfo& run)
    : encoding_(run.programs.empty() ? Encoding::Utf8 : language::detectEncoding(run.programs.front().text)) {}

std::string ReadableText::operator()(const std::string& bytes) const {
  if (std::all_of(bytes.begin(), bytes.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; }))
    return bytes;
  const bool isUtf8 = language::detectEncoding(bytes) == Encoding::Utf8;
  return language::toUtf8(bytes, isUtf8 ? Encoding::Utf8 : encoding_);
}

}  // namespace probewright::records
