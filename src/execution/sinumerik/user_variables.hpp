#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "execution/names.hpp"
#include "language/sinumerik/keywords.hpp"
#include "language/value.hpp"

namespace probewright::language {
struct Operand;
struct Command;
}  // namespace probewright::language

namespace probewright::execution {
class Evaluation;
}

namespace probewright::execution::sinumerik {

/// One variable of DEF or one parameter of a program: a single value or an array of up to three dimensions.
class UserVariable {
public:
  UserVariable() = default;
  /// `sizes`: elements per dimension, 0 for dimensions that it has not. `length`: of a STRING.
  UserVariable(Type type, std::array<int, 3> sizes, int length);

  Type type() const { return type_; }
  bool isArray() const { return sizes_[0] > 0; }
  std::size_t count() const { return values_.size(); }
  const std::array<int, 3>& sizes() const { return sizes_; }

  /// The place of an element. Throws Alarm 17020, 17030 or 17040 for an index out of range, 12261 for missing indices.
  std::size_t place(std::string_view name, std::span<const double> indices) const;

  /// True if so many indices name a single character of a STRING: one more than it has dimensions.
  bool isCharacter(std::size_t indices) const { return type_ == Type::String && indices == dimensions() + 1; }
  /// The code of a character; the last of `indices` counts from 0. Throws what place() throws, and Alarm 17020 after
  /// the end of the text.
  double character(std::string_view name, std::span<const double> indices) const;
  /// Replaces a character, or writes one after the last if there is room. `value`: its code or a text of one
  /// character.
  void setCharacter(std::string_view name, std::span<const double> indices, const Value& value);

  const Value& at(std::size_t place) const { return values_[place]; }
  /// Converts to the variable's type as the control does: REAL to INT rounds, everything but 0 is TRUE. Throws Alarm
  /// 12150 if the type does not fit, 12160 if the value is out of range, 17080 and 17090 if it is beyond its limits.
  void set(std::size_t place, const Value& value);
  /// Least and greatest value of its numbers from now on (LLI, ULI). Elements at 0, as they began, move to the nearer
  /// limit; others that lie beyond are refused, as by set().
  void limit(double lower, double upper);

private:
  double withinLimits(double value) const;
  std::size_t dimensions() const;

  Type type_ = Type::Real;
  std::array<int, 3> sizes_{};
  int length_ = 0;
  double lower_ = -std::numeric_limits<double>::infinity(), upper_ = std::numeric_limits<double>::infinity();
  std::vector<Value> values_;
};

/// The value of `operand` for a variable of `type`: for a STRING, CHAR becomes a text of one character, BOOL "1" or
/// "0".
Value valueFor(Type type, const language::Operand& operand, Evaluation& evaluation);

/// The variable that a DEF declares, with its first values. Throws Alarm 12200 for impossible sizes, 17020 for too many
/// values, and what set() throws.
UserVariable declaredVariable(const language::Command& command, Evaluation& evaluation);

/// The user variables of all program levels. A level sees its own variables and the global ones.
class UserVariables {
public:
  using Scope = std::unordered_map<std::string, UserVariable>;

  void enter() { levels_.emplace_back(); }
  /// Leaves the innermost level and hands out its variables.
  Scope leave();
  std::size_t depth() const { return levels_.size(); }

  /// Declares a variable of the innermost level. Declaring again, as a loop around DEF does, resets it.
  UserVariable& declare(std::string_view name, UserVariable variable);
  /// The variable that the innermost level sees, or null.
  UserVariable* find(std::string_view name);

  Scope& global() { return global_; }

private:
  Scope global_;
  std::vector<Scope> levels_;
  std::string key_;
};

}  // namespace probewright::execution::sinumerik
