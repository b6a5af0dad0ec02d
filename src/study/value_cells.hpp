#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "study/message.hpp"

namespace probewright::study {

/// A sketch of many values: how many lie in which cell, by their distance from a reference that is near all of them. A
/// cell is one of 2048 equal parts of an octave of the distance (that of 0 is a point), so the middle of its cell tells
/// a value to within 1/4096 of its distance from the reference: 0.0005 standard deviations, where it is two of them
/// away. Counts are whole numbers: sketches of parts of the trials give the same sketch in whatever order they come
/// together. (The cells are those of HdrHistogram and DDSketch, cut from the binary form of the distance.)
class ValueCells {
public:
  static constexpr double relativeError = 1.0 / 4096;

  /// `distance` must be finite.
  void add(double distance) {
    pending_.push_back(cellOf(distance));
    if (pending_.size() >= mostPending) settle();
  }
  void merge(const ValueCells& other);

  /// Middles of the cells in ascending order, with how many values lie in each.
  std::vector<std::pair<double, std::uint64_t>> points() const;
  std::uint64_t count() const;

  void put(std::string& message) const;
  static ValueCells get(MessageReading& reading);

private:
  using Cell = std::pair<std::int32_t, std::uint64_t>;
  static constexpr std::size_t mostPending = 1024;

  static std::int32_t cellOf(double distance);
  static double middleOf(std::int32_t cell);
  /// Counts what is pending.
  void settle() const;

  mutable std::vector<Cell> cells_;  ///< in ascending order
  mutable std::vector<std::int32_t> pending_;
};

}  // namespace probewright::study
