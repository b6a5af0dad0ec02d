#include "cycles/heidenhain/registry.hpp"

#include <algorithm>

namespace probewright::cycles::heidenhain {

const Entry* findEntry(int number) {
  const auto found =
      std::ranges::find_if(entries(), [number](const Entry* entry) { return entry->definition.number == number; });
  return found == entries().end() ? nullptr : *found;
}

}  // namespace probewright::cycles::heidenhain
