#pragma once

#include <cctype>
#include <string>
#include <string_view>

/// What the list of tests shows of a parameter: PrintTo of each parameter's type, as its bytes are others in each run.
namespace probewright::testing_support {

/// Letters and digits of the beginning of a text: other signs mean something to CMake.
inline std::string plainWords(std::string_view text) {
  std::string words;
  for (const char c : text.substr(0, 60)) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (plain || (!words.empty() && words.back() != ' ')) words += plain ? c : ' ';
  }
  return words.substr(0, words.find_last_not_of(' ') + 1);
}

}  // namespace probewright::testing_support
