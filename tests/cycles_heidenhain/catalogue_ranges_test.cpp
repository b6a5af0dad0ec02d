#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "cycles/catalogue.hpp"
#include "cycles/heidenhain/call_rules.hpp"

/// The catalogue names for each control what that control takes: what one refuses of a value alone, and the other does
/// not, is neither among its choices nor in its range.
namespace probewright::testing_support {
namespace {

using control::ControlKind;
using cycles::Argument;
using cycles::CycleDefinition;
using cycles::Parameter;
using cycles::ValueKind;

Argument number(double value) { return {.number = value, .text = {}, .isText = false, .given = true}; }

/// The values of the catalogue that lie at the ends: all choices, least and largest number, a text.
std::vector<Argument> outermost(const Parameter& parameter, ControlKind kind) {
  const Parameter here = parameter.on(kind);
  std::vector<Argument> values;
  if (here.kind == ValueKind::Option) {
    for (const cycles::Choice& choice : here.choices)
      if (choice.controls.contains(kind)) values.push_back(number(choice.value));
    return values;
  }
  if (here.kind != ValueKind::Text) {
    values.push_back(number(here.minimum));
    values.push_back(number(here.maximum));
  }
  if (here.kind == ValueKind::NumberOrText) values.push_back({.number = 0, .text = "A", .isText = true, .given = true});
  return values;
}

bool refused(const CycleDefinition& cycle, const Parameter& parameter, const Argument& value, ControlKind kind) {
  if (!cycles::complaint(parameter, value, kind).empty()) return true;
  const auto known = [&](std::uint32_t address) {
    return address == parameter.address ? std::optional(value) : std::nullopt;
  };
  for (const auto& mistake : cycles::heidenhain::callMistakes(cycle, kind, known))
    if (mistake.severity == Severity::Error) return true;
  return false;
}

TEST(CatalogueRanges, HoldOnEachControl) {
  const std::pair<ControlKind, ControlKind> both[] = {{ControlKind::TNC640, ControlKind::iTNC530},
                                                      {ControlKind::iTNC530, ControlKind::TNC640}};
  std::size_t values = 0, foreign = 0;
  for (const auto& [kind, other] : both) {
    for (const CycleDefinition* cycle : cycles::cyclesOf(kind)) {
      if (!cycle->controls.contains(other)) continue;
      for (const Parameter& parameter : cycle->parameters) {
        if (!parameter.controls.contains(kind) || !parameter.controls.contains(other)) continue;
        for (const Argument& value : outermost(parameter, kind)) {
          ++values;
          EXPECT_FALSE(refused(*cycle, parameter, value, kind) && !refused(*cycle, parameter, value, other))
              << fmt::format("{} {} = {} on {}", cycle->name, parameter.name, value.number, control::name(kind));
        }
        // And the other way round: what only the other control takes is refused here.
        for (const Argument& value : outermost(parameter, other)) {
          if (refused(*cycle, parameter, value, other)) continue;
          const Parameter here = parameter.on(kind);
          const bool listed = std::ranges::any_of(outermost(parameter, kind), [&](const Argument& own) {
            return own.isText == value.isText && own.number == value.number;
          });
          const bool inRange = here.kind != ValueKind::Option && !value.isText && value.number <= here.maximum;
          if (listed || inRange) continue;
          ++foreign;
          EXPECT_TRUE(refused(*cycle, parameter, value, kind))
              << fmt::format("{} {} = {} on {}", cycle->name, parameter.name, value.number, control::name(kind));
        }
      }
    }
  }
  EXPECT_GT(values, 500U);
  EXPECT_GE(foreign, 10U);  // 403, 450 (three), 451, 460, and the mode of 31 to 33 and 481 to 483
}

}  // namespace
}  // namespace probewright::testing_support
