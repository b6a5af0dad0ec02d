#include "base/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/text.hpp"

namespace probewright {

namespace {}  // namespace

std::optional<double> parseDecimal(std::string_view text) {
  const bool hasSign = !text.empty() && (text.front() == '+' || text.front() == '-');
  const std::string_view magnitude = text.substr(hasSign ? 1 : 0);
  const bool shaped = std::any_of(magnitude.begin(), magnitude.end(), isDigit) &&
                      std::count(magnitude.begin(), magnitude.end(), '.') <= 1 &&
                      std::all_of(magnitude.begin(), magnitude.end(), [](char c) { return isDigit(c) || c == '.'; });
  if (!shaped) return std::nullopt;
  double value = 0;
  const char* last = magnitude.data() + magnitude.size();
  const auto [end, error] = std::from_chars(magnitude.data(), last, value, std::chars_format::fixed);
  if (error != std::errc() || end != last) return std::nullopt;
  return text.front() == '-' ? -value : value;
}

std::optional<long long> parseInteger(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && isDigit(text[1])) text.remove_prefix(1);
  long long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string formatFixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

std::string formatSigned(double value, int decimals) {
  std::string text = formatFixed(value, decimals);
  return text.front() == '-' ? text : "+" + text;
}

std::string formatShortest(double value) { return fmt::format("{}", value == 0 ? 0.0 : value); }

}  // namespace probewright
