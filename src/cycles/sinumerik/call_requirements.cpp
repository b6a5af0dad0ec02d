#include "cycles/sinumerik/call_requirements.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/number_text.hpp"
#include "cycles/sinumerik/parameters.hpp"

namespace probewright::cycles::sinumerik {

namespace {

using AsksFor = bool (*)(int variant);

enum class Need {
  Positive,    ///< 0 and negative values are refused
  NotZero,     ///< 0 is refused
  SafeArea,    ///< 0 stops at the smallest difference
  Correction,  ///< 0 corrects nothing
  Within,      ///< what is given lies between `least` and `most`
  TwoAxes,     ///< units and hundreds are different axes, 1 to 3
  Memories,    ///< numbers of an empirical and of a mean value, up to 20
};

struct Requirement {
  int cycle = 0;  ///< 0: every cycle that has the parameter
  std::string_view parameter;
  Need need = Need::NotZero;
  AsksFor asks = nullptr;  ///< null: every variant
  double least = 0, most = 0;
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

/// CYCLE979, CYCLE997: three or four points.
template <int Place, int Value>
constexpr bool has(int variant) {
  return digit(variant, Place) == Value;
}

constexpr bool threeRound(int variant) { return digit(variant, 4) > 0 && digit(variant, 6) == 0; }
constexpr bool fourRound(int variant) { return digit(variant, 4) > 0 && digit(variant, 6) == 1; }

/// CYCLE961.
constexpr bool byDistances(int variant) { return digit(variant, 2) == 0; }

/// CYCLE976.
constexpr bool alongOneAxis(int variant) {
  return digit(variant, 1) == 4 || (digit(variant, 1) == 1 && digit(variant, 4) > 0);
}

constexpr bool corrects(int variant) { return digit(variant, 3) != 0; }

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
    {961, "S_SETV2", Need::NotZero, cornerOfAnyAngle},
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
    {0, "S_EVNUM", Need::Memories, corrects},
    {961, "S_STA1", Need::Within, byDistances, -270, 270},
    {961, "S_INCA", Need::Within, cornerOfAnyAngle, -180, 180},
    {976, "S_MA", Need::Within, alongOneAxis, 1, 2},
    {977, "S_MA", Need::Within, units<3, 4>, 1, 2},
    {979, "S_STA1", Need::Within, nullptr, -360, 360},
    {979, "S_INCA", Need::Within, has<4, 0>, -120, 120},
    {979, "S_INCA", Need::Within, has<4, 1>, -90, 90},
    {997, "S_STA1", Need::Within, roundTheEquator, -360, 360},
    {997, "S_INCA", Need::Within, threeRound, -120, 120},
    {997, "S_INCA", Need::Within, fourRound, -90, 90},
    {998, "S_STA1", Need::Within, units<5>, -45, 45},
    {998, "S_STA1", Need::Within, units<6>, -60, 60},
    {998, "S_INCA", Need::Within, units<6>, -30, 30},
    {998, "S_MA", Need::TwoAxes, units<5>},
};

/// What is wrong with a given value of these kinds; empty if nothing is.
std::string outside(const Requirement& requirement, double value) {
  const int code = static_cast<int>(value);
  switch (requirement.need) {
    case Need::Within:
      if (value >= requirement.least && value <= requirement.most) return {};
      return fmt::format("its range here is {} to {}", formatShortest(requirement.least),
                         formatShortest(requirement.most));
    case Need::TwoAxes: {
      const int measuring = code % 10, offset = code / 100;
      const bool axes = measuring >= 1 && measuring <= 3 && offset >= 1 && offset <= 3 && code / 10 % 10 == 0;
      if (axes && measuring != offset) return {};
      return "its units are the measuring axis, its hundreds another axis, 1 to 3 each, and its tens 0";
    }
    case Need::Memories:
      if (code >= 0 && code % 10000 <= 20 && code / 10000 <= 20) return {};
      return "there are 20 empirical and 20 mean values";
    default:
      return {};
  }
}

}  // namespace

std::string_view versionNote(const Parameter& parameter, double value) {
  if (value < 10 || (parameter.name != "_AMODE" && parameter.name != "_DMODE")) return {};
  return "; such digits belong to versions of the measuring cycles newer than 4.4, and what they mean is not published";
}

std::optional<CallComplaint> requirementComplaint(const CycleDefinition& cycle, const Parameter& parameter,
                                                  const Argument& argument, std::optional<int> variant) {
  if (parameter.name == "_AMODE" && parameter.meaning == parameters::reservedMeaning && argument.given &&
      argument.number != 0) {
    return CallComplaint{fmt::format("{} = {} is not observed: version 4.4 of the measuring cycles reserves it",
                                     parameter.name, formatShortest(argument.number)),
                         false};
  }
  for (const Requirement& each : requirements) {
    if (each.parameter != parameter.name || (each.cycle != 0 && each.cycle != cycle.number)) continue;
    if (each.asks != nullptr && (!variant || !each.asks(*variant))) continue;
    if (each.need >= Need::Within) {
      const std::string wrong = argument.given ? outside(each, argument.number) : std::string();
      if (wrong.empty()) continue;
      return CallComplaint{fmt::format("{} ({}) cannot be {}: {}", parameter.name, parameter.meaning,
                                       formatShortest(argument.number), wrong)};
    }
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
