#pragma once

#include <array>
#include <cstddef>

namespace probewright::cycles {

/// Several lists one after the other, of parameters or results.
template <class T, std::size_t... Sizes>
constexpr std::array<T, (Sizes + ...)> joined(const std::array<T, Sizes>&... lists) {
  std::array<T, (Sizes + ...)> all{};
  std::size_t at = 0;
  const auto append = [&](const auto& list) {
    for (const T& each : list)
      all[at++] = each;
  };
  (append(lists), ...);
  return all;
}

}  // namespace probewright::cycles
