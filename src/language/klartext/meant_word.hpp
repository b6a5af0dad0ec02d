#pragma once

#include <string>
#include <vector>

#include "language/klartext/lexer.hpp"

namespace probewright::language::klartext {

/// Advice for a word that comes next and is none of `words`: the one that is nearly the same; nothing if none is.
std::string meantWord(Lexer& lexer, const std::vector<std::string>& words);

}  // namespace probewright::language::klartext
