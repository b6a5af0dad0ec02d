#include "conversion/corner_room.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace probewright::conversion {

namespace {

/// Nothing where the program does not tell it, or where the path has no length.
std::optional<std::array<double, 2>> wayBetween(const PlanePoint& begin, const PlanePoint& end) {
  std::array<double, 2> way{};
  for (std::size_t i = 0; i < 2; ++i) {
    if (!begin[i] || !end[i] || !(*end[i] - *begin[i]).isNumber()) return std::nullopt;
    way[i] = (*end[i] - *begin[i]).number();
  }
  return std::hypot(way[0], way[1]) > 0 ? std::optional(way) : std::nullopt;
}

}  // namespace

CornerRoom::Fit CornerRoom::fitOf(Corner corner, const std::optional<Quantity>& size, const PlanePoint& from,
                                  const PlanePoint& at, const PlanePoint& to) {
  const std::optional<double> takenBefore = std::exchange(taken_, std::nullopt);
  const auto first = wayBetween(from, at), second = wayBetween(at, to);
  if (!first || !second || !size || !size->isNumber()) return Fit::Unknown;
  const auto& [x, y] = *first;
  const auto& [nextX, nextY] = *second;
  const double turn = std::atan2(x * nextY - y * nextX, x * nextX + y * nextY);
  taken_ = corner == Corner::Rounding ? size->number() * std::tan(std::abs(turn) / 2) : size->number();
  const double least = std::min(std::hypot(x, y) - takenBefore.value_or(0), std::hypot(nextX, nextY));
  constexpr double rounding = 1e-6;
  if (*taken_ > least + rounding) return Fit::TooLarge;
  return takenBefore ? Fit::Fits : Fit::Unknown;
}

}  // namespace probewright::conversion
