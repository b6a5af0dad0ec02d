#include "conversion/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/number_text.hpp"

namespace probewright::conversion {

namespace {

constexpr double negligible = 1e-12;

}  // namespace

Quantity Quantity::of(std::string expression, double factor) {
  Quantity quantity;
  quantity.terms_.push_back({factor, std::move(expression)});
  return quantity;
}

Quantity Quantity::operator+(const Quantity& other) const {
  Quantity sum = *this;
  sum.number_ += other.number_;
  for (const Term& term : other.terms_) {
    const auto found = std::ranges::find(sum.terms_, term.expression, &Term::expression);
    if (found == sum.terms_.end()) {
      sum.terms_.push_back(term);
    } else {
      found->factor += term.factor;
    }
  }
  std::erase_if(sum.terms_, [](const Term& term) { return std::abs(term.factor) < negligible; });
  return sum;
}

Quantity Quantity::operator*(double factor) const {
  Quantity product = *this;
  product.number_ *= factor;
  for (Term& term : product.terms_)
    term.factor *= factor;
  if (factor == 0) product.terms_.clear();
  return product;
}

bool Quantity::operator==(const Quantity& other) const {
  const Quantity difference = *this - other;
  return difference.isNumber() && std::abs(difference.number()) < 1e-9;
}

bool isBeyondATurn(const Quantity& degrees) {
  constexpr double turn = 360;
  return degrees.isNumber() && std::abs(degrees.number()) >= turn;
}

std::string numberText(double number) {
  const double rounded = std::round(number * 1e9) / 1e9;
  if (std::abs(rounded) < 1e-4) {  // the shortest text would have an exponent
    std::string text = formatFixed(rounded, 9);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
  }
  return formatShortest(rounded);
}

std::string exactText(double number) {
  constexpr std::size_t longest = 400;  // of a number of the type double without exponent
  std::array<char, longest> digits{};
  const auto [end, error] =
      std::to_chars(digits.data(), digits.data() + digits.size(), number == 0 ? 0 : number, std::chars_format::fixed);
  return error == std::errc() ? std::string(digits.data(), end) : numberText(number);
}

namespace {

struct Signs {
  const char *plus, *minus, *times, *over;
};

std::string textWith(const Signs& signs, const Quantity& quantity) {
  std::string text;
  const auto add = [&](double sign, const std::string& what) {
    if (text.empty()) {
      text = sign < 0 ? "-" + what : what;
    } else {
      text += (sign < 0 ? signs.minus : signs.plus) + what;
    }
  };
  const bool numberLast = !quantity.terms().empty() && quantity.terms().front().factor > 0;
  const auto addNumber = [&] {
    if (quantity.isNumber() || std::abs(quantity.number()) > negligible)
      add(quantity.number(), numberText(std::abs(quantity.number())));
  };
  if (!numberLast) addNumber();
  for (const Quantity::Term& term : quantity.terms()) {
    const double amount = std::abs(term.factor);
    const auto isShort = [](double number) { return std::abs(number - std::round(number * 1e6) / 1e6) < negligible; };
    if (std::abs(amount - 1) < negligible) {
      add(term.factor, term.expression);
    } else if (!isShort(amount) && isShort(1 / amount)) {  // one in 25.4 has no short number
      add(term.factor, term.expression + signs.over + numberText(1 / amount));
    } else {
      add(term.factor, numberText(amount) + signs.times + term.expression);
    }
  }
  if (numberLast) addNumber();
  return text;
}

}  // namespace

std::string expressionText(const Quantity& quantity) { return textWith({"+", "-", "*", "/"}, quantity); }

std::string spacedExpressionText(const Quantity& quantity) { return textWith({" + ", " - ", " * ", " / "}, quantity); }

}  // namespace probewright::conversion
