#pragma once

#include <bitset>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "language/program.hpp"
#include "language/sinumerik/program.hpp"

namespace probewright::language::sinumerik {

/// A global variable that a definition file declares.
struct DeclaredDatum {
  std::string name;  ///< in capitals
  Type type = Type::Real;
};

struct CheckOptions {
  /// Where called programs are looked for; null: calls of other programs are not checked.
  language::ProgramLibrary* library = nullptr;
  /// Names of data that the control has values for, upper case: global user data, system variables.
  std::set<std::string> globalVariables;
  /// Levels of block skip that are on: such blocks are not read.
  std::bitset<10> skipLevels = {};
  /// What definition files declare, in their order.
  std::vector<DeclaredDatum> globalData = {};
  /// The machine is known, and it is a mill: measuring cycles refuse mirrored systems there.
  bool onMill = false;
  /// Also what a run refuses when it gets there: it says so itself, and may never get there.
  bool foresees = true;
};

/// Reads the whole program, and those that it calls by name, without running them and names every mistake: those of
/// single blocks, structured statements that are not closed, missing and doubled labels, names that are not declared,
/// programs that do not exist, and arguments of measuring cycles that the catalogue refuses.
Diagnostics check(SinumerikProgram& program, const CheckOptions& options = {});

/// True if the measuring cycles or the control declare this global variable (upper case, without indices).
bool isGlobalUserData(std::string_view name);

/// True if `name` is a machining or service cycle of the control that Probewright reads but does not carry out.
bool isSkippedCycle(std::string_view name);

/// True for cycles that change nothing that measuring depends on: groups of the editor, settings of dynamics and
/// tolerances, hooks of the machine's builder that are empty as delivered.
bool isCycleWithoutEffect(std::string_view name);

/// What becomes of a G function or word that is not carried out as on the control ("is not carried out"); empty for
/// all others, among them those that say nothing about where the tool goes.
std::string_view skippedFunction(std::string_view name);

/// The word of a motion that has this address and is named, LEAD or A4; empty for all others.
std::string_view skippedMoveWord(std::uint32_t address);

/// What is unusual in TRAORI(number, x, y, z) and is not carried out: another transformation than the first, and a
/// direction of the tool that is not its Z axis. `arguments` are those that are known. Empty if nothing is.
std::string_view skippedTransformation(std::span<const std::optional<double>> arguments);

/// True for frames of the control that a program can write and that nothing here moves by.
bool isFrameWithoutEffect(std::string_view name);

/// True if a word that is not carried out only says what is so anyway: OFFN=0, SETMS(1), GEOAX(). `value` is its value
/// or first argument; nothing if it has none.
bool saysWhatIs(std::string_view name, std::optional<double> value);

/// True for M functions that are the machine builder's own: what they do is not known.
bool isSkippedMachineFunction(int number);

/// True if the G function `number` of `group`, G[group]=number, would change where the tool is and is not carried out.
bool isSkippedGroup(int group, int number);

/// True for functions of expressions that are known by name only: who needs their value gets alarm 12340.
bool isUnavailableFunction(std::string_view name);

/// True if `name` is one of the control's measuring cycles, whether the catalogue has it or not.
bool isMeasuringCycle(std::string_view name);

}  // namespace probewright::language::sinumerik
