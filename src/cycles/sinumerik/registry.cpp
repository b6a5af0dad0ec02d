#include "cycles/sinumerik/registry.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace probewright::cycles::sinumerik {

const Entry* findEntry(std::string_view name) {
  const auto sameName = [name](const Entry* entry) {
    return std::ranges::equal(entry->definition.name, name, {}, {}, upper);
  };
  const auto found = std::ranges::find_if(entries(), sameName);
  return found == entries().end() ? nullptr : *found;
}

}  // namespace probewright::cycles::sinumerik
