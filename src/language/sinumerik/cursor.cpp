#include "language/sinumerik/cursor.hpp"

#include <charconv>
#include <cmath>

namespace probewright::sinumerik {

namespace {

// Powers of ten that a double holds exactly.
constexpr double exactPowers[] = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
constexpr std::ptrdiff_t exactDigits = 15;

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
    std::from_chars(first, p, value, std::chars_format::fixed);
  }
  at_ = p;
  const bool exponent = end_ - p >= 3 && p[0] == 'E' && p[1] == 'X' &&
                        (isDigit(p[2]) || ((p[2] == '-' || p[2] == '+') && end_ - p >= 4 && isDigit(p[3])));
  if (exponent) {
    const bool negative = p[2] == '-';
    at_ = p + (isDigit(p[2]) ? 2 : 3);
    int power = 0;
    for (const char c : digits())
      power = power < 1000 ? power * 10 + (c - '0') : power;
    value *= std::pow(10.0, negative ? -power : power);
  }
  return true;
}

}  // namespace probewright::sinumerik
