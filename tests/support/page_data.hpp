#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <string>

/// What stands packed in a page that the program has written.
namespace probewright::testing_support {

/// What stands between the data element's tags: all that a browser would take as the data.
inline std::string dataText(const std::string& html) {
  const std::string start = "id=\"report-data\">";
  const auto from = html.find(start) + start.size();
  return html.substr(from, html.find("</script", from) - from);
}

inline int base64Value(char c) {
  static const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  return static_cast<int>(alphabet.find(c));
}

/// RFC 4648, written apart from the encoder.
inline std::string decoded(const std::string& base64) {
  EXPECT_EQ(base64.size() % 4, 0U);
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(base64Value(c));
    count += 6;
    if (count >= 8) bytes.push_back(static_cast<char>(bits >> (count -= 8) & 0xFF));
  }
  return bytes;
}

/// What stands in the page's data element, unpacked.
inline std::string pageData(const std::string& html) {
  const std::string packed = decoded(dataText(html));
  std::string text;
  z_stream stream{};
  EXPECT_EQ(inflateInit(&stream), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  int result = Z_OK;
  while (result == Z_OK) {
    std::array<char, 65536> piece{};
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = piece.size();
    result = inflate(&stream, Z_NO_FLUSH);
    text.append(piece.data(), piece.size() - stream.avail_out);
  }
  EXPECT_EQ(result, Z_STREAM_END);
  EXPECT_EQ(stream.avail_in, 0U);
  inflateEnd(&stream);
  return text;
}

}  // namespace probewright::testing_support
