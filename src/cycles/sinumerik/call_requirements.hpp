#pragma once

#include <optional>
#include <string>

#include "cycles/catalogue.hpp"

/// What a call of a measuring cycle must say: the language takes left-out arguments as 0, and not every cycle can.
namespace probewright::cycles::sinumerik {

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
