#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "machine/machine.hpp"

namespace probewright::adapter {

/// Lines of a program that wait to be sent to an adapter many at a time, as each message costs both programs a change
/// of turns. Short lines are joined for an adapter that wants it, so that its control is asked for fewer of them.
class LineQueue {
public:
  using Clock = std::chrono::steady_clock;

  LineQueue() = default;
  /// `joins`: mm. Points are left out if none of them lies farther from the line between those that stay. 0: none are.
  LineQueue(const machine::MachineDescription& machine, double joins);

  /// A line of the program (0: of none) from `from`, which is where the line before it ends. `feed` 0: rapid.
  void add(std::size_t line, double feed, const machine::AxisPositions& from, const machine::AxisPositions& to,
           Clock::time_point now);
  bool empty() const { return count_ == 0; }
  /// Enough of them, or the first one has waited long enough.
  bool isDue(Clock::time_point now) const;
  /// What comes after the lines that are taken.
  enum class Next : std::uint8_t {
    MoreLines,     ///< at once; there is more time for them
    AnotherOrder,  ///< the axes wait for whatever comes after it
  };
  /// For each line its number, its feed, its target.
  std::vector<double> take(Next next);

private:
  bool joinsOn(double feed, const machine::AxisPositions& to) const;

  std::vector<std::size_t> linear_, rotary_;
  double joins_ = 0;
  std::size_t axes_ = 0, count_ = 0;
  std::vector<double> numbers_;
  Clock::time_point firstAt_;
  std::chrono::milliseconds patience_ = soon;
  // The line that may be joined with what comes: where it begins, the points of the program on it.
  machine::AxisPositions begin_;
  std::vector<machine::AxisPositions> points_;
  double feed_ = 0;

  /// The axes are not to wait for the first lines; later ones they have already.
  static constexpr std::chrono::milliseconds soon{2}, late{50};
};

}  // namespace probewright::adapter
