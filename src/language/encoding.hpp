#pragma once

#include <string>
#include <string_view>

/// The text of programs is kept as the bytes it has in its file: only numbers, keywords and names decide what happens,
/// and they are ASCII. This is for showing the rest, comments and messages, to people.
namespace probewright::language {

enum class Encoding { Utf8, Windows1252, Windows1251, Gbk };

/// "UTF-8", "windows-1252", "windows-1251", "GBK".
std::string_view encodingName(Encoding encoding);

/// The encoding that `bytes` most likely have. Text that is valid UTF-8 is UTF-8, pure ASCII too. Otherwise single
/// letters among ASCII speak for windows-1252, words of Cyrillic letters in consistent case with vowels for
/// windows-1251, pairs of bytes that are Chinese characters for GBK. Sure for a few words; a text of one or two Chinese
/// characters or Cyrillic letters can be taken for another encoding, so ask for a whole file rather than for one
/// comment.
Encoding detectEncoding(std::string_view bytes);

/// `bytes` as UTF-8. What is not a character in `encoding` becomes U+FFFD.
std::string toUtf8(std::string_view bytes, Encoding encoding);

/// `text` (UTF-8) in `encoding`. What `encoding` has no character for becomes '?'.
std::string fromUtf8(std::string_view text, Encoding encoding);

}  // namespace probewright::language
