#pragma once

#include <span>
#include <string_view>

#include "cycles/catalogue.hpp"

/// The SINUMERIK measuring cycles: catalogue entry and code, side by side.
namespace probewright::cycles::sinumerik {

class Context;
}  // namespace probewright::cycles::sinumerik

namespace probewright::control::sinumerik {
class Control;
}

namespace probewright::cycles::sinumerik {

struct Entry {
  const CycleDefinition* definition = nullptr;
  void (*run)(Context& context, const Arguments& arguments) = nullptr;
  /// A call that changes settings of the control and measures nothing has this instead of `run`.
  void (*set)(control::sinumerik::Control& control, const Arguments& arguments) = nullptr;
};

/// In the order of their numbers.
std::span<const Entry> entries();

/// The entry of the cycle called `name` (case does not matter), or null.
const Entry* findEntry(std::string_view name);

}  // namespace probewright::cycles::sinumerik
