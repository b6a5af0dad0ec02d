#pragma once

#include <span>
#include <string_view>

#include "language/block.hpp"

/// The operators of expressions in the language's own order of priority: arithmetic binds tightest, then bits, then
/// logic, then the concatenation of texts, and comparison last.
namespace probewright::language::sinumerik {

enum class Priority : int {
  None,
  Comparison,
  Concatenation,
  Or,
  ExclusiveOr,
  And,
  BitOr,
  BitExclusiveOr,
  BitAnd,
  Sum,
  Product,
  Chain,   ///< frames: CTRANS(..):CROT(..)
  Sign,    ///< unary operators
  Single,  ///< a number, a variable, a call
};

struct BinaryOperator {
  std::string_view symbol;
  language::Operation operation = language::Operation::Add;
  Priority priority = Priority::None;
};

/// Node::b of an operation that is in parentheses; calls need b for themselves.
inline constexpr std::uint32_t inParentheses = 1;

/// All binary operators but ':'; longer symbols before their beginnings.
std::span<const BinaryOperator> binaryOperators();

/// The binary operator that writes `operation`, or null.
const BinaryOperator* operatorOf(language::Operation operation);

}  // namespace probewright::language::sinumerik
