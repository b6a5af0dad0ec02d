#pragma once

#include <cstdint>
#include <string_view>

namespace probewright::language {

/// The column, from 1, of the first word of a block after skip sign, block number and blanks: "N320 CYCLE977(...)"
/// gives 6, "  7 TCH PROBE 421" gives 5. The column after the last character if there is no word.
std::uint32_t columnOfFirstWord(std::string_view source);

/// The column of `word`, whatever its case, where it stands as a word of its own; that of the first word if it does
/// not.
std::uint32_t columnOf(std::string_view word, std::string_view source);

}  // namespace probewright::language
