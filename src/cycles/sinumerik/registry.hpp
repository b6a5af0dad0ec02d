#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "cycles/catalogue.hpp"
#include "cycles/sinumerik/call_requirements.hpp"

/// The SINUMERIK measuring cycles. A cycle is one file, `cycle_NUMBER.cpp`, which ends with all that the house knows of
/// it:
///
///     extern const Entry cycle977 = {.definition = definition, .requirements = requirements, .run = run};
///
/// The build makes the list of the entries from the names of the files; nothing else has to be told of a new cycle.
namespace probewright::control::sinumerik {
class Control;
}

namespace probewright::cycles::sinumerik {

class Context;
class CallCombinations;
class OldCall;

/// A set size that stands in the title of a call: "Hole 40", "Rectangular pocket 60 x 40".
struct TitleSize {
  std::string_view parameter;
  std::uint16_t variants = 0;  ///< bit n: the variants with n in the units of S_MVAR; 0: all
};

/// How records and logs call the cycle.
struct CallTitle {
  bool byFeature = false;  ///< by the feature in the units of S_MVAR and the sizes; else by the definition's title
  std::span<const TitleSize> sizes = {};
};

struct AlarmText {
  int number;
  std::string_view text, advice;
};

struct Entry {
  CycleDefinition definition;
  CallTitle title = {};
  /// What a call must say, beyond what is so for every cycle.
  std::span<const Requirement> requirements = {};
  /// What a call says with several arguments together; null: nothing.
  void (*combinations)(CallCombinations& call) = nullptr;
  /// S_MVAR for a call of programs up to version 7.5, whose arguments it puts; null: there was no such call.
  int (*oldForm)(OldCall& call) = nullptr;
  /// Alarms that only this cycle raises; those of several cycles are in alarms.cpp.
  std::span<const AlarmText> alarms = {};
  /// The variants of S_MVAR that only compute: they touch nothing and need no measuring path; null: there are none.
  bool (*computes)(int variant) = nullptr;
  void (*run)(Context& context, const Arguments& arguments) = nullptr;
  /// A call that changes settings of the control and measures nothing has this instead of `run`.
  void (*set)(control::sinumerik::Control& control, const Arguments& arguments) = nullptr;
};

/// In the order of their numbers.
std::span<const Entry* const> entries();

/// The entry of the cycle called `name` (case does not matter), or null.
const Entry* findEntry(std::string_view name);

}  // namespace probewright::cycles::sinumerik
