#pragma once

#include <charconv>
#include <string>
#include <string_view>

#include "base/text.hpp"

/// Letters and numbers as SINUMERIK texts have them.
namespace probewright::control::sinumerik {

using probewright::upperCase;

/// The shortest decimal text without exponent that reads back as the same finite double; "0" for both zeros.
inline std::string numberText(double value) {
  if (value == 0) return "0";
  char text[400];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed);
  return error == std::errc() ? std::string(text, end) : std::string("0");
}

}  // namespace probewright::control::sinumerik
