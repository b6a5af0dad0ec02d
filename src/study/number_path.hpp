#pragma once

#define TOML_HEADER_ONLY 0
#include <toml++/toml.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/diagnostic.hpp"

namespace probewright::study {

/// Names a number of a setup file by the way to it: "part.pose.x", "tool[PROBE].pretravel",
/// "tool[number=2].tip_offset[1]", "part.feature[2].diameter", `parameters."centerPos.0"`. In brackets stands which one
/// of several: its place, counted from 1, its name, or the value of another key. Without brackets there is only one.
class NumberPath {
public:
  static Result<NumberPath> parse(std::string_view text);

  const std::string& text() const { return text_; }
  /// The keys on the way, without brackets.
  std::vector<std::string> keys() const;

  /// The number that stands there; nothing if the file does not write it.
  std::optional<double> numberIn(const toml::table& root) const;

  /// Writes `value` there. Keys that are missing are added to their tables; entries of lists must be there.
  Result<void> set(toml::table& root, double value) const;

private:
  struct Entry {
    std::string key, value;  ///< the one whose `key` is `value`
  };
  /// A key of a table, the place of an entry of a list (from 1), or which entry.
  using Step = std::variant<std::string, std::size_t, Entry>;

  /// The entry of `list` that `step` names.
  static std::optional<std::size_t> placeIn(const toml::array& list, const Step& step);

  std::string text_;
  std::vector<Step> steps_;
};

}  // namespace probewright::study
