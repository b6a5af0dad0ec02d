#include "cycles/heidenhain/registry.hpp"

#include <algorithm>

#include "cycles/heidenhain/cycles.hpp"

namespace probewright::cycles::heidenhain {

std::span<const Entry> entries() {
  static constexpr Entry all[] = {
      {&cycle412Definition, cycle412},
      {&cycle421Definition, cycle421},
  };
  return all;
}

const Entry* findEntry(int number) {
  const auto found =
      std::ranges::find_if(entries(), [number](const Entry& entry) { return entry.definition->number == number; });
  return found == entries().end() ? nullptr : &*found;
}

}  // namespace probewright::cycles::heidenhain
