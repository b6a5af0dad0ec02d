#include "language/klartext/meant_word.hpp"

#include <fmt/format.h>

#include "base/nearest_name.hpp"

namespace probewright::language::klartext {

std::string meantWord(Lexer& lexer, const std::vector<std::string>& words) {
  std::string written;
  lexer.peek();
  for (std::size_t i = 0; isLetter(lexer.here(i)) || lexer.here(i) == '-'; ++i)
    written += upper(lexer.here(i));
  if (written.size() < 3) return {};
  const auto near = nearestName(written, words);
  return near ? fmt::format("Did you mean {}?", *near) : std::string();
}

}  // namespace probewright::language::klartext
