#include "cycles/sinumerik/call_requirements.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/number_text.hpp"

namespace probewright::cycles::sinumerik {

namespace {

using AsksFor = bool (*)(int variant);

enum class Need {
  Positive,    ///< 0 and negative values are refused
  NotZero,     ///< 0 is refused
  SafeArea,    ///< 0 stops at the smallest difference
  Correction,  ///< 0 corrects nothing
};

struct Requirement {
  int cycle = 0;  ///< 0: every cycle that has the parameter
  std::string_view parameter;
  Need need = Need::NotZero;
  AsksFor asks = nullptr;  ///< null: every variant
};

constexpr int digit(int variant, int place) {
  for (int i = 1; i < place; ++i)
    variant /= 10;
  return variant % 10;
}

template <int... Units>
constexpr bool units(int variant) {
  return ((digit(variant, 1) == Units) || ...);
}

template <int Value>
constexpr bool hundreds(int variant) {
  return digit(variant, 3) == Value;
}

/// CYCLE961 with points by distances from the pole.
constexpr bool cornerOfAnyAngle(int variant) { return units<7, 8>(variant) && digit(variant, 2) == 0; }

/// CYCLE997.
constexpr bool roundTheEquator(int variant) { return digit(variant, 4) > 0; }

/// Of S_KNUM, S_KNUM1: the digits of the number are 0. The base reference and the active zero offset have none.
bool namesNothing(const Parameter& parameter, long value) {
  if (parameter.name == "S_KNUM") return value % 100 == 0 && (value / 1000 % 10 != 2 && value / 1000 % 10 != 9);
  // D numbers have three digits on lathes, five on mills.
  long most = 1;
  for (int i = 0; i < parameter.digits.front().width; ++i)
    most *= 10;
  return value % most == 0;
}

constexpr Requirement requirements[] = {
    {0, "S_FA", Need::Positive},
    {0, "S_TSA", Need::SafeArea},
    {0, "S_KNUM", Need::Correction, hundreds<1>},
    {0, "S_KNUM1", Need::Correction, hundreds<2>},
    {961, "S_INCA", Need::NotZero, cornerOfAnyAngle},
    {973, "S_MA", Need::NotZero, units<0, 1, 3>},
    {973, "S_CALNUM", Need::NotZero, units<2, 3>},
    {974, "S_MA", Need::NotZero},
    {976, "S_SETV", Need::Positive, units<1, 2, 3>},
    {976, "S_MA", Need::NotZero, units<0, 4>},
    {977, "S_SETV", Need::Positive, units<1, 2, 3, 4>},
    {977, "S_SETV0", Need::Positive, units<5, 6>},
    {977, "S_SETV1", Need::Positive, units<5, 6>},
    {977, "S_MA", Need::NotZero, units<3, 4>},
    {978, "S_MA", Need::NotZero},
    {978, "S_MD", Need::NotZero},
    {979, "S_SETV", Need::Positive},
    {979, "S_INCA", Need::NotZero},
    {994, "S_SETV", Need::Positive},
    {994, "S_MA", Need::NotZero},
    {994, "S_SZO", Need::Positive, units<2>},
    {995, "S_SETV", Need::Positive},
    {995, "S_DZ", Need::Positive},
    {997, "S_SETV", Need::Positive},
    {997, "S_INCA", Need::NotZero, roundTheEquator},
    {998, "S_ID", Need::Positive, units<5>},
    {998, "S_SETV0", Need::Positive, units<6>},
    {998, "S_SETV3", Need::Positive, units<6>},
};

}  // namespace

std::optional<CallComplaint> requirementComplaint(const CycleDefinition& cycle, const Parameter& parameter,
                                                  const Argument& argument, std::optional<int> variant) {
  for (const Requirement& each : requirements) {
    if (each.parameter != parameter.name || (each.cycle != 0 && each.cycle != cycle.number)) continue;
    if (each.asks != nullptr && (!variant || !each.asks(*variant))) continue;
    const double value = argument.given ? argument.number : parameter.standard.value_or(0);
    const std::string name = fmt::format("{} ({})", parameter.name, parameter.meaning);
    if (each.need == Need::Correction && value > 0 && namesNothing(parameter, static_cast<long>(value))) {
      return CallComplaint{
          fmt::format("{} = {} names no number: S_MVAR asks for a correction, and nothing is corrected", name,
                      formatShortest(value)),
          false};
    }
    if (value > 0 || (value < 0 && each.need != Need::Positive)) continue;
    std::string text = value < 0        ? fmt::format("{} must be greater than 0, not {}", name, formatShortest(value))
                       : argument.given ? name + " cannot be 0 here"
                                        : name + " is missing";
    if (each.need == Need::SafeArea) text += ": the smallest difference stops the program";
    if (each.need == Need::Correction) text += ": S_MVAR asks for a correction, and nothing is corrected";
    return CallComplaint{std::move(text), each.need == Need::Positive || each.need == Need::NotZero};
  }
  return std::nullopt;
}

}  // namespace probewright::cycles::sinumerik
