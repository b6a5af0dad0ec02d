#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "conversion/call.hpp"
#include "conversion/quantity.hpp"
#include "conversion/rounded_values.hpp"
#include "language/block.hpp"

/// Formulas and parameters of a HEIDENHAIN program as a SINUMERIK writes them.
namespace probewright::conversion {

/// The radius of the ball in the spindle.
inline const Quantity sinumerikBallRadius = Quantity::of("$P_TOOLR");
/// The same as the last calibration has found it.
inline const Quantity calibratedBallRadius = Quantity::of("$SNS_MEA_WP_BALL_DIAM[0]", 0.5);

/// Of programs that share their parameters: Qn from Q100 on is R(n+400), QRn is R(n+2400).
inline constexpr int sharedQ = 400, sharedQR = 2400, firstShared = 500;
inline constexpr std::string_view sharedParametersRemark = "; R500 AND ON: Q100 AND ON, R2400 AND ON: QR0 AND ON";

/// Q0 to Q99 are R0 to R99; other parameters become variables of their own, _Q150, _QL1, _QS3, which have to be
/// declared.
class SinumerikFormulas {
public:
  /// From here on the program counts in inches.
  void countInches() { inch_ = true; }
  /// Q and QR parameters are those of several programs: R parameters have them all.
  void shareParameters() { shared_ = true; }
  /// Comparisons that roundings decide are written so that they decide as on a HEIDENHAIN control.
  void heedRoundings(RoundedValues values) { rounded_ = std::move(values); }
  /// Throws NotCarriedOver for parameters that only the HEIDENHAIN control fills.
  std::string variable(const language::VariableRef& variable);
  /// All of these throw NotCarriedOver for functions without a twin.
  std::string formula(const language::Block& block, const language::Operand& operand);
  Quantity quantity(const language::Block& block, const language::Operand& operand);

  /// Variables named so far that the program must declare, "_Q150".
  /// A variable of the converter's own, declared at the beginning.
  const std::string& declare(const std::string& name) { return *declared_.insert(name).first; }
  const std::set<std::string>& declared() const { return declared_; }

  /// Of what was written since the last call: what holds only under a condition.
  std::vector<NotCarriedOver> takeDoubts() { return std::exchange(doubts_, {}); }

private:
  std::string call(const language::Block& block, const language::Node& node);
  std::string power(const language::Block& block, const language::Node& node);
  /// A side of an operator that binds tightly.
  std::string factor(const language::Block& block, const language::Operand& side);

  bool inch_ = false;
  bool shared_ = false;
  std::set<std::string> declared_;
  std::optional<RoundedValues> rounded_;
  std::vector<NotCarriedOver> doubts_;
};

/// The expression, in parentheses unless it binds as tightly as a factor.
std::string factorText(const std::string& expression);

/// The expression of the quantity without blanks.
std::string sinumerikText(const Quantity& quantity);

/// "X10", "X=R5", "CR=4".
std::string addressWord(std::string_view address, const Quantity& value);

/// "G54" for 1 to "G599" for 99. Row 0 of a preset table has the last one.
std::string settableCode(int number);

/// The number of the settable zero offset that a G function selects: 1 for G54; 0 for G500.
std::optional<int> settableOf(std::string_view code);

/// Selects the settable zero offset that is in effect again: the function of group 8 by its number, 1 is G500, 2 is
/// G54.
inline constexpr std::string_view selectedAgain = "G[8]=$P_UIFRNUM+1";

}  // namespace probewright::conversion
