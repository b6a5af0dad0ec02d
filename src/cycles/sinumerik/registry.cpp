#include "cycles/sinumerik/registry.hpp"

#include <algorithm>
#include <cctype>

namespace probewright::cycles::sinumerik {

const Entry* findEntry(std::string_view name) {
  const auto sameName = [name](const Entry* entry) {
    return std::ranges::equal(entry->definition.name, name, [](char a, char b) {
      return a == static_cast<char>(std::toupper(static_cast<unsigned char>(b)));
    });
  };
  const auto found = std::ranges::find_if(entries(), sameName);
  return found == entries().end() ? nullptr : *found;
}

}  // namespace probewright::cycles::sinumerik
