#include "study/value_cells.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace probewright::study {

namespace {

constexpr int droppedBits = 52 - 11;  // of the fraction of a double: 2048 cells an octave

using Cells = std::vector<std::pair<std::int32_t, std::uint64_t>>;

Cells sumOf(const Cells& a, const Cells& b) {
  Cells sum;
  sum.reserve(a.size() + b.size());
  auto x = a.begin();
  auto y = b.begin();
  while (x != a.end() || y != b.end()) {
    if (y == b.end() || (x != a.end() && x->first < y->first)) {
      sum.push_back(*x++);
    } else if (x == a.end() || y->first < x->first) {
      sum.push_back(*y++);
    } else {
      sum.emplace_back(x->first, x->second + y->second);
      ++x;
      ++y;
    }
  }
  return sum;
}

}  // namespace

std::int32_t ValueCells::cellOf(double distance) {
  if (distance == 0) return 0;
  // The bits of positive doubles are in the order of the doubles.
  const auto cell = static_cast<std::int32_t>(std::bit_cast<std::uint64_t>(std::abs(distance)) >> droppedBits) + 1;
  return distance < 0 ? -cell : cell;
}

double ValueCells::middleOf(std::int32_t cell) {
  if (cell == 0) return 0;
  const auto bits = static_cast<std::uint64_t>(std::abs(cell) - 1);
  const double middle =
      (std::bit_cast<double>(bits << droppedBits) + std::bit_cast<double>((bits + 1) << droppedBits)) / 2;
  return cell < 0 ? -middle : middle;
}

void ValueCells::settle() const {
  if (pending_.empty()) return;
  std::ranges::sort(pending_);
  Cells fresh;
  for (const std::int32_t cell : pending_) {
    if (fresh.empty() || fresh.back().first != cell) fresh.emplace_back(cell, 0);
    ++fresh.back().second;
  }
  pending_.clear();
  cells_ = cells_.empty() ? std::move(fresh) : sumOf(cells_, fresh);
}

void ValueCells::merge(const ValueCells& other) {
  settle();
  other.settle();
  cells_ = sumOf(cells_, other.cells_);
}

std::vector<std::pair<double, std::uint64_t>> ValueCells::points() const {
  settle();
  std::vector<std::pair<double, std::uint64_t>> points;
  points.reserve(cells_.size());
  for (const auto& [cell, count] : cells_)
    points.emplace_back(middleOf(cell), count);
  return points;
}

std::uint64_t ValueCells::count() const {
  settle();
  std::uint64_t count = 0;
  for (const Cell& cell : cells_)
    count += cell.second;
  return count;
}

void ValueCells::put(std::string& message) const {
  settle();
  putCount(message, cells_.size());
  std::int64_t last = std::int64_t{-1} << 31U;
  for (const auto& [cell, count] : cells_) {
    putCount(message, static_cast<std::uint64_t>(cell - last));
    putCount(message, count);
    last = cell;
  }
}

ValueCells ValueCells::get(MessageReading& reading) {
  ValueCells read;
  const std::uint64_t size = reading.count();
  std::int64_t last = std::int64_t{-1} << 31U;
  for (std::uint64_t i = 0; i < size; ++i) {
    last += static_cast<std::int64_t>(reading.count());
    read.cells_.emplace_back(static_cast<std::int32_t>(last), reading.count());
  }
  return read;
}

}  // namespace probewright::study
