#pragma once

#include <string>
#include <vector>

/// Values of a program that is being converted.
namespace probewright::conversion {

/// A number plus terms, each a factor and an expression that the written program computes, in its language. Sums and
/// differences of what is known stay numbers; what only the running program knows stays an expression.
class Quantity {
public:
  struct Term {
    double factor = 1;
    std::string expression;
  };

  Quantity(double number = 0) : number_(number) {}  // NOLINT: numbers are quantities
  static Quantity of(std::string expression, double factor = 1);

  bool isNumber() const { return terms_.empty(); }
  /// The number, without the terms.
  double number() const { return number_; }
  const std::vector<Term>& terms() const { return terms_; }

  Quantity operator+(const Quantity& other) const;
  Quantity operator-(const Quantity& other) const { return *this + other * -1; }
  Quantity operator*(double factor) const;
  Quantity operator/(double divisor) const { return *this * (1 / divisor); }
  Quantity operator-() const { return *this * -1; }
  /// The same number and the same expressions.
  bool operator==(const Quantity& other) const;

private:
  double number_ = 0;
  std::vector<Term> terms_;  ///< no two with the same expression, none with factor 0
};

/// A position of a rotary axis that a HEIDENHAIN control drives to as it stands, while a SINUMERIK counts an axis that
/// turns endlessly within one turn.
bool isBeyondATurn(const Quantity& degrees);
inline constexpr const char* beyondATurn =
    "beyond a whole turn a HEIDENHAIN control counts on, a SINUMERIK counts a rotary axis that turns endlessly from 0 "
    "again";
inline constexpr const char* withinATurn = "give a position within one turn, or turn by incremental positions";

/// Text of the quantity as an expression that either language reads: "12.5", "R5-2", "0.5*(R1+R2)".
std::string expressionText(const Quantity& quantity);
/// The same with blanks around operators, as Klartext formulas are written.
std::string spacedExpressionText(const Quantity& quantity);

/// The number, rounded to what coordinates can tell (1e-9), without exponent.
std::string numberText(double number);
/// The shortest text that reads back as the same number, without exponent: for what a program computes with.
std::string exactText(double number);

}  // namespace probewright::conversion
