#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "cycles/catalogue.hpp"
#include "language/block.hpp"
#include "language/sinumerik/keywords.hpp"

namespace probewright::language::sinumerik {

/// What is wrong with one argument of a call.
struct ArgumentMistake {
  std::uint32_t column = 0;  ///< from 1; of the argument, or of the place where it is missing
  std::string message;       ///< "argument 6 of CYCLE978: S_FA (measuring path) is missing"
  std::string advice;
  Severity severity = Severity::Error;
};

/// Holds the call of a measuring cycle in `block` against the catalogue: too many arguments, missing ones, texts in
/// place of numbers, digits and values that the cycle refuses. `types` are those of the variables that are declared;
/// values that only the run computes are left to it.
std::vector<ArgumentMistake> argumentMistakes(const language::Block& block, const language::CallProgram& call,
                                              const cycles::CycleDefinition& cycle,
                                              const std::map<std::string, Type>& types);

/// The same for the cycles that have no entry there: CYCLE800 and CYCLE116.
std::vector<ArgumentMistake> serviceMistakes(const language::Block& block, const language::CallProgram& call,
                                             std::string_view name, const std::map<std::string, Type>& types);

/// What `value` is ("a text"), if a variable of `type` cannot take it; empty if it can, or if only the run knows.
std::string argumentOfWrongType(const language::Block& block, const language::Operand& value, Type type,
                                const std::map<std::string, Type>& types);

}  // namespace probewright::language::sinumerik
