#include "language/sinumerik/cursor.hpp"

#include <charconv>
#include <cstdlib>
#include <string>

namespace probewright::language::sinumerik {

namespace {

// Powers of ten that a double holds exactly.
constexpr double exactPowers[] = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
constexpr std::ptrdiff_t exactDigits = 15;

double numberFromText(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  // Too large becomes infinite, too small 0: from_chars says for both only that there is no such double.
  return error == std::errc::result_out_of_range ? std::strtod(text.c_str(), nullptr) : value;
}

}  // namespace

bool Cursor::number(double& value) {
  const char* first = at_;
  const char* p = at_;
  std::uint64_t mantissa = 0;
  std::ptrdiff_t digitCount = 0, fractionDigits = 0;
  for (; p < end_ && isDigit(*p); ++p, ++digitCount)
    mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p - '0');
  if (p < end_ && *p == '.') {
    const char* fraction = ++p;
    for (; p < end_ && isDigit(*p); ++p, ++digitCount)
      mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p - '0');
    fractionDigits = p - fraction;
  }
  if (digitCount == 0) return false;
  if (digitCount <= exactDigits) {
    // Both are exact, so the one division rounds correctly.
    value = static_cast<double>(mantissa) / exactPowers[fractionDigits];
  } else {
    value = numberFromText(std::string(first, p));
  }
  at_ = p;
  const bool exponent = end_ - p >= 3 && p[0] == 'E' && p[1] == 'X' &&
                        (isDigit(p[2]) || ((p[2] == '-' || p[2] == '+') && end_ - p >= 4 && isDigit(p[3])));
  if (exponent) {
    // "1.5EX-3" is read as "1.5e-3", so that it rounds as other numbers do.
    std::string text(first, p);
    at_ = p + (p[2] == '+' ? 3 : 2);
    const char* power = at_;
    if (peek() == '-') advance();
    digits();
    text.append("e").append(power, at_);
    value = numberFromText(text);
  }
  return true;
}

}  // namespace probewright::language::sinumerik
