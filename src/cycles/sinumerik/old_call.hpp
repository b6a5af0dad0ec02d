#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "control/sinumerik/control.hpp"
#include "cycles/catalogue.hpp"

namespace probewright::cycles::sinumerik {

/// A call of programs up to version 7.5, as a cycle's file turns it into one of today (Entry::oldForm): reads _MVAR and
/// the other variables, puts today's arguments. What all cycles have in common is put already.
class OldCall {
public:
  using DataKey = control::sinumerik::DataKey;

  OldCall(const CycleDefinition& cycle, const control::sinumerik::Control& control)
      : name_(cycle.name), cycle_(&cycle), control_(control), arguments_(cycle), variant_(whole("_MVAR")) {}

  /// Today's arguments; `oldForm` puts the cycle's own and returns S_MVAR.
  Arguments read(int (*oldForm)(OldCall&));
  /// Another cycle does today what this call asks for.
  void isNow(std::string_view cycle);

  const control::sinumerik::Control& control() const { return control_; }
  /// _MVAR.
  int variant() const { return variant_; }
  double number(std::string_view name, double absent = 0) const { return control_.data.number(name, {}, absent); }
  /// A length, in mm whatever the program's unit is.
  double length(std::string_view name) const { return number(name) * control_.unit; }
  double element(int index) const { return control_.data.number("_SETV", {index}, index == 0 ? number("_SETV") : 0); }
  int whole(std::string_view name, double absent = 0) const {
    const double value = number(name, absent);
    return std::abs(value) < 1e9 ? static_cast<int>(std::lround(value)) : -1;
  }
  std::string text(const char* name) const {
    const auto value = control_.data.get(DataKey(name, {}));
    const auto* found = value ? std::get_if<std::string>(&*value) : nullptr;
    return found == nullptr ? std::string() : *found;
  }
  /// A decimal digit of _MVAR, from the right from 1.
  int digit(int place) const {
    int value = variant_;
    for (int i = 1; i < place; ++i)
      value /= 10;
    return value % 10;
  }
  void put(std::string_view parameter, double value) {
    const auto found = std::ranges::find(cycle_->parameters, parameter, &Parameter::name);
    if (found != cycle_->parameters.end()) arguments_.set(found->address, value);
  }
  void put(std::string_view parameter, std::string value) {
    const auto found = std::ranges::find(cycle_->parameters, parameter, &Parameter::name);
    if (found != cycle_->parameters.end()) arguments_.set(found->address, std::move(value));
  }
  [[noreturn]] void refuse(const char* code, const std::string& what) const;
  [[noreturn]] void refuseVariant(std::string_view why = {}) const;
  /// Refuses digits of _MVAR from `place` on.
  void nothingFrom(int place) const {
    int value = variant_;
    for (int i = 1; i < place; ++i)
      value /= 10;
    if (value != 0) refuseVariant();
  }

  enum class Corrects { ZeroOffsetOnly, AlsoTools };
  /// The hundreds of S_MVAR for those of _MVAR, with what they correct.
  int task(Corrects corrects);
  /// The first `count` elements of _SETV as S_SETV0, S_SETV1 ...
  void setValues(int count) {
    for (int i = 0; i < count; ++i)
      put("S_SETV" + std::to_string(i), element(i));
  }

private:
  void common();
  int zeroOffset() const;
  int toolOffset() const;

  std::string_view name_;  ///< as the program calls it
  const CycleDefinition* cycle_;
  const control::sinumerik::Control& control_;
  Arguments arguments_;
  int variant_;
};

}  // namespace probewright::cycles::sinumerik
