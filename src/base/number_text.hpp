#pragma once

#include <optional>
#include <string>
#include <string_view>

/// Numbers as text, the same in every locale: the decimal separator is a point.
namespace probewright {

/// The number that the whole of `text` writes ("+12.5", "-.5", "7."), or nothing. No exponent, no hexadecimal, no
/// infinities: programs and tables know none. Correctly rounded.
std::optional<double> parseDecimal(std::string_view text);

/// The integer that the whole of `text` writes, with an optional sign, or nothing.
std::optional<long long> parseInteger(std::string_view text);

/// `value` with exactly `decimals` digits after the point; never "-0.000".
std::string formatFixed(double value, int decimals);

/// Like formatFixed, with the sign always written as HEIDENHAIN controls do: "+12.500", "+0.000", "-3.000".
std::string formatSigned(double value, int decimals);

/// The shortest text that reads back as the same double.
std::string formatShortest(double value);

}  // namespace probewright
