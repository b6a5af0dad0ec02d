#pragma once

#include <string_view>

#include "execution/names.hpp"
#include "language/block.hpp"

namespace probewright::execution::klartext {

/// The single letter of an axis word, or 0.
inline char axisLetter(const Word& word) {
  const bool single = word.address < 256;
  const char letter = single ? static_cast<char>(word.address) : '\0';
  return std::string_view("XYZABCUVW").find(letter) != std::string_view::npos ? letter : '\0';
}

inline bool isLinearAxis(char letter) { return letter >= 'X' && letter <= 'Z'; }

}  // namespace probewright::execution::klartext
