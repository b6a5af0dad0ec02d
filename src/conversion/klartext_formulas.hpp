#pragma once

#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "conversion/quantity.hpp"
#include "execution/sinumerik/user_variables.hpp"
#include "language/block.hpp"

/// Expressions and variables of a SINUMERIK program as Klartext writes them.
namespace probewright::conversion {

/// The radius of the ball in the spindle.
inline const Quantity klartextBallRadius = Quantity::of("Q108");

/// R0 to R99 are Q0 to Q99, R100 to R499 are Q1200 to Q1599, _OVR[0] to _OVR[31] are Q1700 to Q1731; variables that the
/// program defines get numbers from Q1600 on, each element of an array its own. What a formula needs beforehand goes
/// into `prelude`.
class KlartextFormulas {
public:
  using GlobalData = execution::sinumerik::UserVariables::Scope;

  /// `globalData`: global user data with their values, null if none are known; must outlive the formulas.
  explicit KlartextFormulas(const GlobalData* globalData) : globalData_(globalData) {}

  /// From here on the program counts in inches; FN 18 answers in millimetres.
  void countInches() { inch_ = true; }

  /// The program is one of several that call each other: its own variables are QL parameters.
  void keepLocal() { local_ = true; }
  /// It was converted from a HEIDENHAIN program that shares parameters with others, see sharedParametersRemark.
  void knowSharedParameters() { shared_ = true; }

  std::string variable(const language::Block& block, const language::VariableRef& variable);
  std::string formula(const language::Block& block, const language::Operand& operand);
  Quantity quantity(const language::Block& block, const language::Operand& operand);
  /// The formula of what the variable has after `operand` was assigned to it: an INT rounds, a BOOL is 0 or 1.
  std::string assigned(const language::Block& block, const language::VariableRef& variable,
                       const language::Operand& operand);
  /// The same of a parameter's value.
  std::string assigned(const language::Block& block, const language::VariableRef& variable,
                       const std::string& parameter);
  /// A parameter's value as a variable of the type takes it.
  std::string asType(language::sinumerik::Type type, const std::string& parameter);
  /// The program defines a variable, or an array, of this type: "INT".
  void declare(std::string_view name, std::string_view type);
  void declare(std::string_view name, language::sinumerik::Type type) {
    types_.insert_or_assign(std::string(name), type);
  }

  /// A number or a parameter with its sign, as coordinates are written: "+5", "-Q3". Everything else is computed in
  /// front of the block into a parameter of the converter's own.
  std::string value(const Quantity& quantity);
  /// A side of a comparison: the same, with every digit of the program.
  std::string comparedValue(const language::Block& block, const language::Operand& operand);
  /// The value without "+".
  std::string unsignedValue(const Quantity& quantity);

  /// The entry of the tool table, as FN 17 and FN 18 name it, that $TC_DPx[t,1] has; empty for other variables.
  std::string toolDatum(const language::Block& block, const language::VariableRef& variable);

  /// What a component of $P_UIFR holds now, read from the preset table. `row`: its number, which is that of the preset
  /// but for the last, 99, whose twin is row 0. `index`: 1 to 3 for the translation, 4 to 6 for the rotation.
  std::string presetDatum(const Quantity& row, int index);

  /// Blocks that give the global user data named so far their values.
  const std::vector<std::string>& globalValues() const { return globalValues_; }
  bool isGlobal(std::string_view name) const;

  /// The parameter of a variable that the program defines.
  enum class Holds { Number, Text };
  std::string define(std::string_view name, Holds holds = Holds::Number);

  /// The parameter in which a caller hands over an argument, 0 being the first, and gets one by reference back.
  static std::string argument(std::size_t place, Holds holds);

  /// A variable that a conversion to SINUMERIK has named after the parameter it stands for: "_Q600", "_QL1".
  /// Not those that a control or a touch probe cycle fills: "_Q150" holds its value while cycles run.
  static bool namesParameter(std::string_view variable);
  /// The program uses that parameter itself: no variable that is defined gets it.
  void reserve(std::string_view parameter) { reserved_.emplace(parameter); }

  /// The first of the four parameters that measuring blocks fill: ball centre X, Y, Z and whether it was touched.
  /// `toolAxis`: 0 to 2; $AA_MW, which reads them, counts in it to the tip.
  std::string measuringBlock(int toolAxis);

  /// Blocks that must come before what was asked for since the last call.
  std::vector<std::string> takePrelude();

private:
  /// The parameter of a user variable, or of an element of an array by numbers.
  std::string userVariable(const language::Block& block, const language::VariableRef& variable);
  std::string call(const language::Block& block, const language::Node& node);
  /// REAL of all that is not a variable of a type.
  language::sinumerik::Type typeOf(const language::Block& block, const language::VariableRef& variable) const;
  /// The value is whole whatever the program computes.
  bool isWhole(const language::Block& block, const language::Operand& operand) const;
  /// The value is 0 or 1.
  bool isTruth(const language::Block& block, const language::Operand& operand) const;
  std::string systemDatum(const language::Block& block, const language::VariableRef& variable);
  std::string helper(const std::string& formula);
  /// A system datum in a parameter; the same one again if it was just read.
  std::string read(const std::string& datum);
  /// The same for a length, in the unit of the program.
  std::string readLength(const std::string& datum);

  bool inch_ = false;
  bool local_ = false, shared_ = false;
  int nextLocal_ = 0;
  const GlobalData* globalData_;
  std::vector<std::string> globalValues_;
  std::map<std::string, std::string, std::less<>> names_;
  std::map<std::string, language::sinumerik::Type, std::less<>> types_;  ///< of variables that the program defines
  std::set<std::string, std::less<>> reserved_;
  int nextNumber_ = 1600;
  int nextText_ = 1600;
  int nextHelper_ = 0;
  std::array<std::string, 4> measured_;  ///< empty before the first measuring block
  std::size_t measuredToolAxis_ = 2;
  std::vector<std::string> prelude_;
};

}  // namespace probewright::conversion
