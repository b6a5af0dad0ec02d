#include "cycles/sinumerik/registry.hpp"

#include <algorithm>
#include <cctype>

#include "cycles/sinumerik/cycles.hpp"

namespace probewright::cycles::sinumerik {

std::span<const Entry> entries() {
  static constexpr Entry all[] = {
      {&cycle150Definition, nullptr, setMeasuringLog},
      {&cycle961Definition, cycle961},
      {&cycle973Definition, cycle973},
      {&cycle974Definition, cycle974},
      {&cycle976Definition, cycle976},
      {&cycle977Definition, cycle977},
      {&cycle978Definition, cycle978},
      {&cycle979Definition, cycle979},
      {&cycle994Definition, cycle994},
      {&cycle995Definition, cycle995},
      {&cycle997Definition, cycle997},
      {&cycle998Definition, cycle998},
  };
  return all;
}

const Entry* findEntry(std::string_view name) {
  const auto sameName = [name](const Entry& entry) {
    return std::ranges::equal(entry.definition->name, name, [](char a, char b) {
      return a == static_cast<char>(std::toupper(static_cast<unsigned char>(b)));
    });
  };
  const auto found = std::ranges::find_if(entries(), sameName);
  return found == entries().end() ? nullptr : &*found;
}

}  // namespace probewright::cycles::sinumerik
