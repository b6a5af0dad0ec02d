#pragma once

#include <string>

#include "cycles/catalogue.hpp"

namespace probewright::session {

/// What a template of a call has for a parameter before somebody fills it in.
struct FirstValue {
  double number = 0;
  std::string text;        ///< of a parameter that takes a text
  bool isExample = false;  ///< stands for what only the user knows, as a set diameter, or for a choice
};

/// The example of the cycle; where there is none the default, the first choice, or the number nearest to 0 that may
/// stand there. `check` has nothing to say of a call with these values.
FirstValue firstValue(const cycles::CycleDefinition& cycle, const cycles::Parameter& parameter);

}  // namespace probewright::session
