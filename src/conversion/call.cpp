#include "conversion/call.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace probewright::conversion {

Quantity Call::number(std::string_view name) const {
  const auto found = numbers.find(name);
  return found == numbers.end() ? Quantity() : found->second;
}

int Call::integer(std::string_view name) const {
  const Quantity value = number(name);
  if (!value.isNumber()) {
    throw NotCarriedOver(fmt::format("{} of {} is known only when the program runs", name, cycle),
                         "write a number there, or convert this call by hand");
  }
  return static_cast<int>(std::lround(value.number()));
}

std::string Call::text(std::string_view name) const {
  const auto found = texts.find(name);
  return found == texts.end() ? std::string() : found->second;
}

int Call::digit(std::string_view name, int place) const {
  int value = std::abs(integer(name));
  for (int i = 1; i < place; ++i)
    value /= 10;
  return value % 10;
}

}  // namespace probewright::conversion
