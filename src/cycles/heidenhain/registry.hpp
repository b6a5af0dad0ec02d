#pragma once

#include <span>
#include <string_view>

#include "cycles/catalogue.hpp"

/// The HEIDENHAIN touch probe cycles. A cycle is one file, `cycle_NUMBER.cpp`, which ends with all that the house knows
/// of it:
///
///     extern const Entry cycle412 = {.definition = definition, .conditions = {...}, .run = run};
///
/// The build makes the list of the entries from the names of the files; nothing else has to be told of a new cycle.
namespace probewright::cycles::heidenhain {

class Context;
class CallRules;

/// What a cycle is made with.
enum class Uses {
  TouchProbe,
  ToolTouchProbe,  ///< the tool in the spindle has its own length and radius
  Nothing,         ///< it sets values only, without a tool and wherever axes stand
};

/// Under which coordinate transformations (cycles 7, 8, 10, 11 and 26) a cycle runs, unless the machine permits all.
enum class Transformed { No, ByRotation, ByShiftOrRotation, Any };

/// What must be so before a cycle begins. A control that finds it otherwise refuses the cycle.
struct Conditions {
  Uses uses = Uses::TouchProbe;
  Transformed under = Transformed::No;
  ControlSet tilted = control::onBothTNC;  ///< controls on which the working plane may be tilted
  bool turningMode = false;                ///< also after FUNCTION MODE TURN
  bool mismatchWithTcpm = false;           ///< with TCPM, rotary axes need not agree with the tilt
  int featureLevel = 0;                    ///< FCL of the iTNC 530 that the cycle belongs to
};

/// A label, heading or title of a log in other languages.
struct LogTerm {
  std::string_view english, russian, swedish;
};

/// The words of a log in capitals, where they are not the capitals of the usual term.
struct CapitalTerm {
  std::string_view usual, capitals;
};

struct Entry {
  CycleDefinition definition;
  Conditions conditions = {};
  /// What of its log no other cycle says; words of several cycles are in log_texts.cpp.
  std::span<const LogTerm> logTerms = {};
  /// A cycle that has some writes its English log in capitals on the iTNC 530.
  std::span<const CapitalTerm> capitalTerms = {};
  /// What does not go together in a call, beyond what is so in every cycle; null: nothing.
  void (*rules)(CallRules& call) = nullptr;
  void (*run)(Context& context, const Arguments& arguments) = nullptr;
};

/// In the order of their numbers.
std::span<const Entry* const> entries();

/// The entry of the cycle with this number, or null.
const Entry* findEntry(int number);

}  // namespace probewright::cycles::heidenhain
