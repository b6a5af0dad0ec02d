#include "session/first_value.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace probewright::session {

namespace {

/// Where `check` would complain of the default, or of 0, or where the least value that it takes helps nobody.
struct Example {
  std::string_view cycle;  ///< empty: every cycle that has the parameter and no example of its own
  std::string_view parameter;
  double number = 0;
  std::string_view text = {};
};
constexpr Example examples[] = {
    {"403", "Q312", 6},  // the C axis
    {"451", "Q419", -90},
    {"451", "Q420", 90},
    {"451", "Q422", 4},
    {"", "Q247", 90},
    {"", "Q253", 750},
    {"", "Q303", 1},
    {"", "Q407", 12.5},
    {"", "Q616", 1000},
    {"", "QS600", 0, "POINT"},
    {"CYCLE961", "S_SETV0", 10},
    {"CYCLE961", "S_SETV1", 40},
    {"CYCLE961", "S_SETV2", 10},
    {"CYCLE961", "S_SETV3", 40},
    {"CYCLE961", "S_TSA", 5},   // degrees
    {"CYCLE971", "S_MVAR", 1},  // a tool, the spindle standing
    {"CYCLE971", "S_MA", 3},    // its length
    {"CYCLE977", "S_MVAR", 1},  // a hole
    {"CYCLE977", "S_SETV", 30},
    {"CYCLE978", "S_MA", 1},
    {"CYCLE979", "S_MVAR", 1},  // a hole
    {"CYCLE979", "S_SETV", 30},
    {"CYCLE979", "S_INCA", 90},
    {"CYCLE982", "S_MVAR", 1},  // along one axis
    {"CYCLE982", "S_MA", 1},
    {"CYCLE994", "S_SETV", 30},
    {"CYCLE995", "S_MVAR", 102015},  // the only one, the diameter as set
    {"CYCLE995", "S_SETV", 25},
    {"CYCLE995", "S_DZ", 30},
    {"CYCLE996", "S_MVAR", 10001},  // 1st measurement of rotary axis 1
    {"CYCLE996", "S_TC", 1},
    {"CYCLE996", "S_SETV", 25},
    {"CYCLE997", "S_SETV", 25},
    {"CYCLE998", "S_TSA", 5},  // degrees
    {"CYCLE998", "S_ID", 30},
    {"", "S_FA", 10},
    {"", "S_TSA", 1},
};

}  // namespace

FirstValue firstValue(const cycles::CycleDefinition& cycle, const cycles::Parameter& parameter) {
  const auto* example = std::ranges::find_if(examples, [&](const Example& each) {
    return each.parameter == parameter.name && (each.cycle.empty() || each.cycle == cycle.name);
  });
  if (example != std::end(examples)) return {example->number, std::string(example->text), true};
  if (parameter.standard) return {*parameter.standard, {}};
  if (!parameter.choices.empty()) return {static_cast<double>(parameter.choices.front().value), {}};
  return {std::clamp(0.0, parameter.minimum, parameter.maximum), {}};
}

}  // namespace probewright::session
