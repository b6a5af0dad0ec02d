#include "language/sinumerik/operators.hpp"

#include <algorithm>
#include <iterator>

namespace probewright::language::sinumerik {

using language::Operation;

namespace {

constexpr BinaryOperator table[] = {
    {"==", Operation::Equal, Priority::Comparison},
    {"<<", Operation::Concatenate, Priority::Concatenation},
    {"<>", Operation::NotEqual, Priority::Comparison},
    {"<=", Operation::LessEqual, Priority::Comparison},
    {"<", Operation::Less, Priority::Comparison},
    {">=", Operation::GreaterEqual, Priority::Comparison},
    {">", Operation::Greater, Priority::Comparison},
    {"+", Operation::Add, Priority::Sum},
    {"-", Operation::Subtract, Priority::Sum},
    {"*", Operation::Multiply, Priority::Product},
    {"/", Operation::Divide, Priority::Product},
    {"DIV", Operation::IntegerDivide, Priority::Product},
    {"MOD", Operation::Modulo, Priority::Product},
    {"B_AND", Operation::BitAnd, Priority::BitAnd},
    {"B_XOR", Operation::BitExclusiveOr, Priority::BitExclusiveOr},
    {"B_OR", Operation::BitOr, Priority::BitOr},
    {"AND", Operation::And, Priority::And},
    {"XOR", Operation::ExclusiveOr, Priority::ExclusiveOr},
    {"OR", Operation::Or, Priority::Or},
};

}  // namespace

std::span<const BinaryOperator> binaryOperators() { return table; }

const BinaryOperator* operatorOf(Operation operation) {
  const auto* found = std::find_if(std::begin(table), std::end(table),
                                   [operation](const BinaryOperator& entry) { return entry.operation == operation; });
  return found == std::end(table) ? nullptr : found;
}

}  // namespace probewright::language::sinumerik
