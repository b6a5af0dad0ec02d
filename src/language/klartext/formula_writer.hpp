#pragma once

#include <string>
#include <string_view>

#include "language/block.hpp"

namespace probewright::language::klartext {

/// A number as programs write it: no exponent, shortest text that reads back as the same number.
std::string writeNumber(double number);
/// With its sign: "+50", "-0.5".
std::string writeSigned(double number);

/// "SIN"; empty if formulas have no such function.
std::string_view functionName(Function function);
/// " + "; empty if formulas have no such operator.
std::string_view operatorText(Operation operation);

/// "Q5", "QS3".
std::string writeVariable(const VariableRef& variable);

/// The value of a word: a signed number or a parameter with an optional minus.
std::string writeValue(const Block& block, const Operand& operand);

/// The name of a file, in quotation marks where it would be read as something else without them.
std::string writePath(std::string_view path);

/// A formula, as it stands on the right of an assignment.
std::string writeFormula(const Block& block, const Operand& operand);

}  // namespace probewright::language::klartext
