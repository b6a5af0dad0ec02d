#pragma once

#include <string>

#include "base/diagnostic.hpp"
#include "language/block.hpp"

namespace probewright::language::sinumerik {

class SinumerikProgram;

/// The block in the SINUMERIK language, without line end: block number or label, block skip, statements and the comment
/// of its source. Reading it again gives a block of the same meaning; layout, leading zeros and letter case become
/// uniform. Fails for instructions that only other languages have.
Result<std::string> writeBlock(const language::Block& block);

/// The whole program, one block a line. Fails at the first block that cannot be read or written.
Result<std::string> writeProgram(SinumerikProgram& program);

/// One expression of the block.
std::string writeExpression(const language::Block& block, const language::Operand& operand);

/// A variable with its indices.
std::string writeVariable(const language::Block& block, const language::VariableRef& variable);

/// The number as the language writes it: shortest decimal that reads back as the same double, with EX as exponent.
std::string writeNumber(double value);

}  // namespace probewright::language::sinumerik
