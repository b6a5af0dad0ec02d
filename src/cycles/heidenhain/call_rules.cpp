#include "cycles/heidenhain/call_rules.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "metrology/tolerance.hpp"

namespace probewright::cycles::heidenhain {

std::optional<Argument> CallRules::value(std::uint32_t address) const {
  return has(address) ? known_(address) : std::nullopt;
}

std::optional<double> CallRules::number(std::uint32_t address) const {
  const std::optional<Argument> found = value(address);
  return found && !found->isText ? std::optional(found->number) : std::nullopt;
}

std::optional<Eigen::VectorXd> CallRules::numbers(std::initializer_list<std::uint32_t> addresses) const {
  Eigen::VectorXd all(static_cast<Eigen::Index>(addresses.size()));
  Eigen::Index at = 0;
  for (const std::uint32_t address : addresses) {
    const auto one = number(address);
    if (!one) return std::nullopt;
    all[at++] = *one;
  }
  return all;
}

void CallRules::add(std::uint32_t parameter, std::string message, std::string advice, Severity severity) {
  mistakes_.push_back({parameter, severity, std::move(message), std::move(advice), false, {}});
}

void CallRules::refuse(std::string alarm, std::uint32_t parameter, std::string message, std::string advice) {
  add(parameter, std::move(message), std::move(advice));
  mistakes_.back().alarm = std::move(alarm);
}

void CallRules::refuseUnlessBlank(std::string alarm, std::initializer_list<std::uint32_t> parameters,
                                  std::string message, std::string advice) {
  refuse(std::move(alarm), *(parameters.end() - 1), std::move(message), std::move(advice));
  const auto values = numbers(parameters);
  mistakes_.back().isBlank = values && values->isZero(0);
}

namespace {

/// Row 0 is the preset set at once; for a row the control must know which table is meant.
void transfer(CallRules& call) {
  const auto row = call.number(305), target = call.number(303);
  if (!row || *row == 0 || target != -1) return;
  call.add(303, fmt::format("Q303 = -1 does not say where row {} is: the cycle is refused", *row),
           "set Q303 to 0 (datum table) or 1 (preset table)");
}

void alignment(CallRules& call) {
  const auto aligns = call.number(1126), takesOver = call.number(1121);
  if (!aligns || *aligns == 0 || takesOver != 0) return;
  call.add(1126, "Q1126 aligns rotary axes, but Q1121 takes over no rotation", "set Q1121, or Q1126 = 0");
}

/// Q1100 to Q1102 and so on: an actual position (@) is in all three axes or in none.
void actualPosition(CallRules& call, std::uint32_t first) {
  int given = 0;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const auto value = call.value(first + i);
    if (!value) return;
    if (!value->isText) continue;
    const auto text = metrology::parseDimension(value->text);
    if (!text) return;
    given += text->actual || !text->actualParameter.empty() ? 1 : 0;
  }
  if (given == 0 || given == 3) return;
  call.add(first, fmt::format("Q{} to Q{} have an actual position (@) in {} of three axes", first, first + 2, given),
           "give it in all three axes or in none");
}

void limits(CallRules& call) {
  if (call.crossedLimitsAllowed()) return;
  static constexpr std::array<std::pair<std::uint32_t, std::uint32_t>, 5> pairs = {
      {{275, 276}, {277, 278}, {284, 285}, {286, 287}, {288, 289}}};
  for (const auto& [largest, smallest] : pairs) {
    const auto most = call.number(largest), least = call.number(smallest);
    if (!most || !least || *most == 0 || *least <= *most) continue;
    call.add(
        largest,
        fmt::format("Q{} ({}) is less than Q{} ({}): no part can meet these limits", largest, *most, smallest, *least),
        "exchange them", Severity::Warning);
  }
}

}  // namespace

std::vector<CallMistake> callMistakes(const CycleDefinition& cycle, ControlKind kind, const KnownValue& known) {
  CallRules call(cycle, kind, known);
  transfer(call);
  alignment(call);
  if (const Entry* entry = findEntry(cycle.number); entry != nullptr && entry->rules != nullptr) entry->rules(call);
  for (const std::uint32_t first : {1100U, 1103U, 1106U})
    actualPosition(call, first);
  limits(call);
  return call.take();
}

ForbiddenTransformations forbiddenTransformations(const Conditions& conditions) {
  switch (conditions.under) {
    case Transformed::Any:
      return {};
    case Transformed::ByShiftOrRotation:
      return {.other = true};
    case Transformed::ByRotation:
      return {.shift = true, .other = true};
    case Transformed::No:
      break;
  }
  return {.shift = true, .rotation = true, .other = true};
}

std::string transformationsText(const ForbiddenTransformations& forbidden) {
  if (!forbidden.shift) return "mirror image or scaling is active (cycle 8, 11 or 26)";
  if (!forbidden.rotation) return "datum shift, mirror image or scaling is active (cycle 7, 8, 11 or 26)";
  return "datum shift, mirror image, rotation or scaling is active (cycle 7, 8, 10, 11 or 26)";
}

}  // namespace probewright::cycles::heidenhain
