#pragma once

#include <string>
#include <variant>

namespace probewright::language {

/// What a variable or an expression can be: a number (booleans are 0 and 1) or a text.
using Value = std::variant<double, std::string>;

inline bool isText(const Value& value) { return std::holds_alternative<std::string>(value); }

}  // namespace probewright::language
