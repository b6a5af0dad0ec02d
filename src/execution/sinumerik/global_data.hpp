#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "control/sinumerik/data_store.hpp"
#include "execution/names.hpp"
#include "execution/sinumerik/user_variables.hpp"
#include "language/sinumerik/check.hpp"
#include "language/sinumerik/program.hpp"

/// Global user data (GUD): variables of the whole control or of its channel, and macros, which definition files
/// declare.
///
///     DEF NCK REAL _CLEARANCE[3]=SET(2,2,5)
///     DEF CHAN INT PHU 0 LLI 0 ULI 99 _PARTS
///     DEFINE PROBE_ON AS M50 G4 F1
///     M17
namespace probewright::control::sinumerik {
class Control;
}

namespace probewright::execution::sinumerik {

struct GlobalDatum {
  std::string name;       ///< in capitals
  UserVariable variable;  ///< with its first values
  SourcePlace place;      ///< of its DEF
};

/// What definition files declare.
class GlobalUserData {
public:
  /// Reads a definition file: lines of DEF with NCK or CHAN and of DEFINE, up to M17 or M30. Of attributes the limits
  /// LLI and ULI count; unit, access rights and data class are read over. Variables of the measuring cycles are read
  /// over too: the control has them. Of a macro that is defined twice the last text counts. Mistakes go to
  /// `diagnostics`; what could be read is kept.
  void read(const std::string& file, std::string text, Diagnostics& diagnostics);

  const std::vector<GlobalDatum>& data() const { return data_; }
  /// Their names and types, for the check of programs.
  std::vector<DeclaredDatum> declarations() const;
  /// The datum called `name` (upper case), or null.
  const GlobalDatum* find(std::string_view name) const;

  /// The macros of all definition files: programs know them without DEFINE.
  const Macros& macros() const { return macros_; }
  /// Elements per dimension of the array called `name` (upper case); empty for everything else.
  std::vector<int> sizesOf(std::string_view name) const;

  /// The variables with the values that `store` has for them. Values that do not fit go to `diagnostics`.
  UserVariables::Scope variables(const control::sinumerik::DataStore& store, Diagnostics& diagnostics) const;

private:
  std::vector<GlobalDatum> data_;
  Macros macros_;
};

/// The control's name for a definition file ("UGUD.DEF" of "_N_UGUD_DEF", "ugud.def"): SGUD, MGUD, UGUD, GUD and GUD1
/// to GUD9 for global user data, SMAC, MMAC and UMAC for macros; empty for all other names.
std::string definitionFileName(std::string_view fileName);

/// Enters into the control's data, and notes in its journal, what `now` has other than `before`.
void storeChanges(const UserVariables::Scope& before, const UserVariables::Scope& now,
                  control::sinumerik::Control& control);

}  // namespace probewright::execution::sinumerik
