#include "cycles/sinumerik/call_requirements.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/number_text.hpp"
#include "base/truncated.hpp"
#include "cycles/sinumerik/parameters.hpp"
#include "cycles/sinumerik/registry.hpp"

namespace probewright::cycles::sinumerik {

namespace {

constexpr bool corrects(int code) { return variant::digit(code, 3) != 0; }

/// Of S_KNUM, S_KNUM1: the digits of the number are 0. The base reference and the active zero offset have none.
bool namesNothing(const Parameter& parameter, long value) {
  if (parameter.name == "S_KNUM") return value % 100 == 0 && (value / 1000 % 10 != 2 && value / 1000 % 10 != 9);
  // D numbers have three digits on lathes, five on mills.
  long most = 1;
  for (int i = 0; i < parameter.digits.front().width; ++i)
    most *= 10;
  return value % most == 0;
}

/// Of every cycle that has the parameter.
constexpr Requirement requirements[] = {
    {"S_FA", Need::Positive},
    {"S_TSA", Need::SafeArea},
    {"S_KNUM", Need::Correction, variant::has<3, 1>},
    {"S_KNUM1", Need::Correction, variant::has<3, 2>},
    {"S_EVNUM", Need::Memories, corrects},
};

/// What is wrong with a given value of these kinds; empty if nothing is.
std::string outside(const Requirement& requirement, double value) {
  const int code = truncated(value);
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

std::optional<CallComplaint> complaintOf(const Requirement& each, const Parameter& parameter,
                                         const Argument& argument) {
  if (each.need >= Need::Within) {
    const std::string wrong = argument.given ? outside(each, argument.number) : std::string();
    if (wrong.empty()) return std::nullopt;
    return CallComplaint{fmt::format("{} ({}) cannot be {}: {}", parameter.name, parameter.meaning,
                                     formatShortest(argument.number), wrong)};
  }
  const double value = argument.given ? argument.number : parameter.standard.value_or(0);
  const std::string name = fmt::format("{} ({})", parameter.name, parameter.meaning);
  if (each.need == Need::Correction && value > 0 && namesNothing(parameter, truncated<long>(value))) {
    return CallComplaint{fmt::format("{} = {} names no number: S_MVAR asks for a correction, and nothing is corrected",
                                     name, formatShortest(value)),
                         false};
  }
  if (value > 0 || (value < 0 && each.need != Need::Positive)) return std::nullopt;
  std::string text = value < 0        ? fmt::format("{} must be greater than 0, not {}", name, formatShortest(value))
                     : argument.given ? name + " cannot be 0 here"
                                      : name + " is missing";
  if (each.need == Need::SafeArea) text += ": the smallest difference stops the program";
  if (each.need == Need::Correction) text += ": S_MVAR asks for a correction, and nothing is corrected";
  return CallComplaint{std::move(text), each.need == Need::Positive || each.need == Need::NotZero};
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
  const Entry* entry = findEntry(cycle.name);
  const auto own = entry == nullptr ? std::span<const Requirement>() : entry->requirements;
  const bool computes = entry != nullptr && entry->computes != nullptr && variant && entry->computes(*variant);
  const auto common = computes ? std::span<const Requirement>() : std::span<const Requirement>(requirements);
  for (const std::span<const Requirement> list : {common, own}) {
    for (const Requirement& each : list) {
      if (each.parameter != parameter.name) continue;
      // S_KNUM of a tool that is measured says where its correction goes, not what is corrected.
      if (each.need == Need::Correction && cycle.family == CycleFamily::Tool) continue;
      if (each.asks != nullptr && (!variant || !each.asks(*variant))) continue;
      if (auto complaint = complaintOf(each, parameter, argument)) return complaint;
    }
  }
  return std::nullopt;
}

}  // namespace probewright::cycles::sinumerik
