#include "language/klartext/global_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace probewright::language::klartext {

std::optional<GlobalMistake> mistakeInGlobalDefinition(int group, std::span<const Word> parameters) {
  static constexpr std::array<int, 6> groups = {100, 105, 110, 111, 120, 125};
  if (std::ranges::find(groups, group) == groups.end()) {
    return GlobalMistake{fmt::format("there is no group {} of global definitions", group),
                         "the groups are 100, 105, 110, 111, 120 and 125"};
  }
  static constexpr std::array<std::uint32_t, 4> general = {200, 204, 253, 208};
  static constexpr std::array<std::uint32_t, 3> probing = {320, 260, 301};
  const std::span<const std::uint32_t> known = group == 100   ? std::span<const std::uint32_t>(general)
                                               : group == 120 ? std::span<const std::uint32_t>(probing)
                                                              : std::span<const std::uint32_t>();
  for (const Word& word : parameters) {
    if (known.empty() || std::ranges::find(known, word.address) != known.end()) continue;
    return GlobalMistake{fmt::format("GLOBAL DEF {} has no parameter Q{}", group, word.address),
                         group == 120 ? "it has Q320, Q260 and Q301" : "it has Q200, Q204, Q253 and Q208"};
  }
  return std::nullopt;
}

}  // namespace probewright::language::klartext
