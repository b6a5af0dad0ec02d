#pragma once

#include <optional>
#include <string>

#include "cycles/catalogue.hpp"

/// What a call of a measuring cycle must say: the language takes left-out arguments as 0, and not every cycle can.
namespace probewright::cycles::sinumerik {

enum class Need {
  Positive,    ///< 0 and negative values are refused
  NotZero,     ///< 0 is refused
  SafeArea,    ///< 0 stops at the smallest difference
  Correction,  ///< 0 corrects nothing
  Within,      ///< what is given lies between `least` and `most`
  TwoAxes,     ///< units and hundreds are different axes, 1 to 3
  Memories,    ///< numbers of an empirical and of a mean value, up to 20
};

struct Requirement {
  std::string_view parameter;
  Need need = Need::NotZero;
  bool (*asks)(int variant) = nullptr;  ///< null: every variant
  double least = 0, most = 0;
};

/// Which variants ask: by the digits of S_MVAR, counted from the right from 1.
namespace variant {

constexpr int digit(int code, int place) {
  for (int i = 1; i < place; ++i)
    code /= 10;
  return code % 10;
}

template <int... Units>
constexpr bool units(int code) {
  return ((digit(code, 1) == Units) || ...);
}

template <int Place, int Value>
constexpr bool has(int code) {
  return digit(code, Place) == Value;
}

}  // namespace variant

struct CallComplaint {
  std::string text;     ///< "S_FA (measuring path) is missing"
  bool refused = true;  ///< false: the cycle runs, though hardly as meant
};

/// What to add to a complaint of digits that version 4.4 of the measuring cycles does not have; empty if they are
/// none of those that newer versions added.
std::string_view versionNote(const Parameter& parameter, double value);

/// What is wrong with 0 or a negative value in this place; nothing if the variant can do with it. `variant` is S_MVAR,
/// if it is known before the run; without it, only what all variants need is asked for.
std::optional<CallComplaint> requirementComplaint(const CycleDefinition& cycle, const Parameter& parameter,
                                                  const Argument& argument, std::optional<int> variant);

}  // namespace probewright::cycles::sinumerik
