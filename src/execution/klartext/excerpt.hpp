#pragma once

#include <string>
#include <string_view>

namespace probewright::execution::klartext {

/// What messages quote of a text from a program or a file: one line, shortened.
inline std::string excerptOf(std::string_view text) {
  constexpr std::size_t longest = 80;
  text = text.substr(0, text.find('\n'));
  return text.size() <= longest ? std::string(text) : std::string(text.substr(0, longest)) + "...";
}

}  // namespace probewright::execution::klartext
