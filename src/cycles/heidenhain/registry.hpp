#pragma once

#include <span>

#include "cycles/catalogue.hpp"

/// The HEIDENHAIN measuring cycles: catalogue entry and code, side by side.
namespace probewright::cycles::heidenhain {

class Context;

struct Entry {
  const CycleDefinition* definition = nullptr;
  void (*run)(Context& context, const Arguments& arguments) = nullptr;
};

/// In the order of their numbers.
std::span<const Entry> entries();

/// The entry of the cycle with this number, or null.
const Entry* findEntry(int number);

}  // namespace probewright::cycles::heidenhain
