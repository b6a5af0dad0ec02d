#include "survival/clamping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace probewright::survival {

namespace {

constexpr const char* examples =
    "Write for instance part.pose.x=0.5, part.pose.c=-1..1, part.feature[2].diameter=0.1 or "
    "tool[PROBE].stylus_length=1";

std::optional<double> numberOf(std::string_view text) {
  double value = 0;
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

template <std::size_t Count>
bool isOneOf(std::string_view word, const std::array<std::string_view, Count>& words) {
  return std::ranges::find(words, word) != words.end();
}

std::optional<NumberKind> kindOf(const std::vector<std::string>& keys) {
  static constexpr std::array<std::string_view, 3> shifts = {"x", "y", "z"}, turns = {"a", "b", "c"};
  static constexpr std::array<std::string_view, 6> sizes = {"diameter", "top_diameter", "tube_diameter",
                                                            "height",   "depth",        "size"};
  static constexpr std::array<std::string_view, 2> lengths = {"length", "stylus_length"};
  if (keys.size() < 2) return std::nullopt;
  const std::string &last = keys.back(), &before = keys[keys.size() - 2];
  if (keys.front() == "tool") {
    if (keys.size() == 2 && isOneOf(last, lengths)) return NumberKind::Length;
    return std::nullopt;
  }
  static constexpr std::array<std::string_view, 2> notClamped = {"machine", "control"};
  if (isOneOf(keys.front(), notClamped)) return std::nullopt;
  if (before == "pose" && isOneOf(last, shifts)) return NumberKind::Shift;
  if (before == "pose" && isOneOf(last, turns)) return NumberKind::Turn;
  if (before == "feature" && isOneOf(last, sizes)) return NumberKind::Size;
  return std::nullopt;
}

}  // namespace

Result<Tolerance> parseTolerance(std::string_view text, const toml::table& setup) {
  const auto refuse = [&](std::string why, std::string advice = examples) {
    return fail({}, fmt::format("tolerance \"{}\": {}", text, why), std::move(advice));
  };
  const std::size_t equals = text.rfind('=');
  if (equals == std::string_view::npos || equals == 0) return refuse("NUMBER=HALF or NUMBER=LOW..HIGH was expected");
  auto path = study::NumberPath::parse(text.substr(0, equals));
  if (!path) return refuse(path.error().message, path.error().advice);
  const auto kind = kindOf(path->keys());
  if (!kind)
    return refuse("this is not a number of a clamping",
                  "Poses (x, y, z, a, b, c), sizes of features (diameter, size[1], height, depth) and lengths of tools "
                  "(length, stylus_length) can vary; for others see probewright study");
  auto written = path->numberIn(setup);
  if (!written && (*kind == NumberKind::Shift || *kind == NumberKind::Turn)) {
    written = 0;
    toml::table changed = setup;
    if (const auto set = path->set(changed, 0); !set) return refuse(set.error().message, set.error().advice);
  }
  if (!written) return refuse("the setup does not write this number", "Write it in the setup, with the value it has");
  Tolerance tolerance{*std::move(path), *kind, 0, 0};
  const std::string_view range = text.substr(equals + 1);
  if (const std::size_t dots = range.find(".."); dots != std::string_view::npos) {
    const auto low = numberOf(range.substr(0, dots)), high = numberOf(range.substr(dots + 2));
    if (!low || !high) return refuse("LOW..HIGH are not two numbers");
    if (!(*low < *high)) return refuse("LOW must be below HIGH");
    if (*written < *low || *written > *high)
      return refuse(fmt::format("the setup has {}, which lies outside", *written),
                    "Choose a range about the value of the setup");
    tolerance.low = *low;
    tolerance.high = *high;
  } else {
    const auto half = numberOf(range);
    if (!half || !(*half > 0)) return refuse("a number above 0 was expected after =");
    tolerance.low = *written - *half;
    tolerance.high = *written + *half;
  }
  if ((*kind == NumberKind::Size || *kind == NumberKind::Length) && !(tolerance.low > 0))
    return refuse("sizes and lengths must stay above 0", "Choose a smaller tolerance");
  if (*kind == NumberKind::Turn && tolerance.half() > 90) return refuse("turns of more than 90 degrees to either side");
  return tolerance;
}

std::vector<double> Box::middle() const {
  std::vector<double> values(low.size());
  for (std::size_t i = 0; i < low.size(); ++i)
    values[i] = (low[i] + high[i]) / 2;
  return values;
}

bool Box::holds(std::span<const double> values) const {
  for (std::size_t i = 0; i < low.size(); ++i)
    if (values[i] < low[i] || values[i] > high[i]) return false;
  return true;
}

Box boxOf(std::span<const Tolerance> tolerances) {
  Box box;
  for (const Tolerance& tolerance : tolerances) {
    box.low.push_back(tolerance.low);
    box.high.push_back(tolerance.high);
  }
  return box;
}

}  // namespace probewright::survival
