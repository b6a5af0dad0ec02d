#pragma once

#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "conversion/measuring_task.hpp"

/// Calls of measuring cycles, as both vendors' readers take and as their writers give them.
namespace probewright::conversion {

/// What the other language cannot say. Thrown inside a conversion; the statement then stays as a comment.
class NotCarriedOver : public std::runtime_error {
public:
  explicit NotCarriedOver(const std::string& message, std::string advice = {})
      : std::runtime_error(message), advice_(std::move(advice)) {}
  const std::string& advice() const { return advice_; }

private:
  std::string advice_;
};

/// What the touch probe table of a HEIDENHAIN control has for the probe, mm: no program tells it.
struct TouchProbe {
  double setUp = 2;    ///< SET_UP, on the iTNC 530 MP6140
  double travel = 10;  ///< DIST, on the iTNC 530 MP6130
};

/// A call: the cycle ("412", "CYCLE977") and its parameters by name ("Q321", "S_FA").
struct Call {
  std::string cycle;
  std::map<std::string, Quantity, std::less<>> numbers;
  std::map<std::string, std::string, std::less<>> texts;
  double millimetre = 1;  ///< in the unit of the program
  TouchProbe probe;

  bool has(std::string_view name) const { return numbers.contains(name); }
  /// 0 if the parameter is not given.
  Quantity number(std::string_view name) const;
  /// The whole number; throws NotCarriedOver if only the running program knows it.
  int integer(std::string_view name) const;
  std::string text(std::string_view name) const;
  /// Decimal digit of a coded parameter, counted from 1 at the units.
  int digit(std::string_view name, int place) const;
};

/// Where a cycle leaves what it has measured: names by meaning ("Q151", "_OVR[5]").
using Results = std::map<Meaning, std::string>;

/// What a reader reports of a call besides its task: each entry is lost and says how.
using Losses = std::vector<std::string>;

inline constexpr double millimetresOfInch = 25.4;

}  // namespace probewright::conversion
