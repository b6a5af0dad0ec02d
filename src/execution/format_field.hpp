#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

/// Fields of formats such as %9.3F, which FN 16 and SPRINT have in common.
namespace probewright::execution {

/// What stands between the % and its letter.
struct FormatField {
  bool left = false;   ///< -: blanks after the text
  bool plus = false;   ///< +: a sign before positive numbers
  bool zeros = false;  ///< 0: zeros before the number
  std::size_t width = 0;
  std::optional<std::size_t> decimals;
};

/// Which fields a control takes.
struct FormatLimits {
  std::string_view flags;   ///< of "-+0 "; a blank says nothing
  std::size_t width = 200;  ///< what is larger counts as this
  std::size_t decimals = 15;
};

/// Reads the field at `at` and goes on to its letter.
FormatField readField(std::string_view text, std::size_t& at, const FormatLimits& limits);

/// `text` in its field; a number gets zeros after its sign.
enum class Content { Number, Text };
std::string filled(std::string text, const FormatField& field, Content content);

}  // namespace probewright::execution
