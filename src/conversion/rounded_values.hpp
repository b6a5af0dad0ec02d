#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "conversion/job.hpp"
#include "language/block.hpp"
#include "language/program.hpp"

/// Which values of a program may differ by roundings from what they are meant to be: a counter to which 0.1 is added
/// ten times is not 1. A SINUMERIK takes numbers for equal that differ by 1e-12 of their size, a HEIDENHAIN control
/// only those that are the same, so a comparison of such values may decide differently.
namespace probewright::conversion {

class RoundedValues {
public:
  /// Of the variables of a program and of those of its job, which may share them.
  RoundedValues(language::Program& program, const Job& job);

  /// True if the comparison decides between values that may be equal but for roundings: one of them is computed from
  /// fractions, and the other one is not 0, from which both controls tell every other number. Measured values, and what
  /// is computed of them, meet a number by chance only and do not count.
  bool decide(const language::Block& block, const language::Node& comparison) const;

private:
  enum class Kind : std::uint8_t {
    Whole,    ///< a whole number
    Written,  ///< as it is written somewhere
    Rounded,  ///< computed from fractions
    Measured  ///< measured, or computed of what is measured
  };

  Kind kindOf(const language::Block& block, const language::Operand& operand) const;
  static Kind kindOf(double written);
  Kind kindOf(const language::Block& block, const language::VariableRef& variable) const;

  std::map<std::string, Kind, std::less<>> kinds_;  ///< of variables that are assigned
};

}  // namespace probewright::conversion
