#pragma once

#include <cstddef>
#include <string_view>

/// Texts in UTF-8. A character is a code point here.
namespace probewright {

/// True for the second to the fourth byte of a character.
constexpr bool continuesCharacter(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// How many characters begin in the text; bytes that are not UTF-8 count as they look.
std::size_t characterCount(std::string_view utf8);

/// True if the bytes are characters as RFC 3629 writes them: none cut short, none longer than it must be, no
/// surrogates, none above U+10FFFF.
bool isUtf8(std::string_view bytes);

}  // namespace probewright
