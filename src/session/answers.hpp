#pragma once

#include <map>
#include <string>
#include <string_view>

#include "base/diagnostic.hpp"

namespace probewright::session {

/// What the operator answers to the questions of a program, by question: `NAME = VALUE`, one a line; # begins a
/// comment, blanks around name and value do not count, a value may be empty. Errors, with their place in `file`: a line
/// without `=` or without a name, a question answered twice.
Result<std::map<std::string, std::string>> parseAnswers(std::string_view text, const std::string& file);

}  // namespace probewright::session
