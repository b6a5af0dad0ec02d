#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

/// Texts as wide as the terminal they go to.
namespace probewright::app {

/// How many columns the terminal of `stream` has; 0 if it is a file or a pipe, or does not say.
std::size_t columnsOf(std::FILE* stream);

/// The text with each line broken at blanks so that it fits into `columns`; 0 leaves it as it is. A line that goes on
/// begins below the second column of its text (the first gap of two blanks in its left half), otherwise four blanks
/// further in. Gaps are preferred to single blanks; a word that is too long stays whole. Colours take no room.
std::string fitted(std::string_view text, std::size_t columns);

/// Writes the text, fitted if `stream` is a terminal.
void put(std::string_view text, std::FILE* stream);

}  // namespace probewright::app
