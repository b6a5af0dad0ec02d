#include "execution/format_field.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace probewright::execution {

namespace {

std::size_t digits(std::string_view text, std::size_t& at, std::size_t most) {
  std::size_t value = 0;
  for (; at < text.size() && isDigit(text[at]); ++at)
    value = std::min(value * 10 + static_cast<std::size_t>(text[at] - '0'), most);
  return value;
}

}  // namespace

FormatField readField(std::string_view text, std::size_t& at, const FormatLimits& limits) {
  FormatField field;
  for (; at < text.size() && limits.flags.find(text[at]) != std::string_view::npos; ++at) {
    field.left = field.left || text[at] == '-';
    field.plus = field.plus || text[at] == '+';
    field.zeros = field.zeros || text[at] == '0';
  }
  field.width = digits(text, at, limits.width);
  if (at < text.size() && text[at] == '.') field.decimals = digits(text, ++at, limits.decimals);
  return field;
}

std::string filled(std::string text, const FormatField& field, Content content) {
  const bool isNumber = content == Content::Number;
  if (isNumber && field.plus && text.front() != '-') text.insert(text.begin(), '+');
  if (text.size() >= field.width) return text;
  const std::size_t missing = field.width - text.size();
  if (field.left) return text.append(missing, ' ');
  const bool zeros = isNumber && field.zeros;
  const bool isSigned = zeros && (text.front() == '-' || text.front() == '+');
  return text.insert(isSigned ? 1 : 0, missing, zeros ? '0' : ' ');
}

}  // namespace probewright::execution
