#include "language/block.hpp"

namespace probewright::language {

std::string addressName(std::uint32_t address) {
  std::string name;
  for (; address != 0; address >>= 8)
    name += static_cast<char>(address & 0xff);
  return name;
}

TextRef Block::add(std::string_view added) {
  const TextRef ref{static_cast<std::uint32_t>(text.size()), static_cast<std::uint32_t>(added.size())};
  text += added;
  return ref;
}

void Block::clear() {
  position = next = {};
  source = label = {};
  skippable = false;
  skipLevel = 0;
  instructions.clear();
  nodes.clear();
  operands.clear();
  variables.clear();
  words.clear();
  text.clear();
}

}  // namespace probewright::language
