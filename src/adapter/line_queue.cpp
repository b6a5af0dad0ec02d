#include "adapter/line_queue.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace probewright::adapter {
namespace {

constexpr std::size_t mostLines = 1024;
/// Points on one line: each is looked at for every further one.
constexpr std::size_t mostPoints = 100;
/// Rotary axes that turn by less than this (degrees) stand.
constexpr double stands = 1e-7;

}  // namespace

LineQueue::LineQueue(const machine::MachineDescription& machine, double joins)
    : joins_(joins), axes_(machine.axes.size()) {
  for (std::size_t i = 0; i < axes_; ++i)
    (machine.axes[i].kind == machine::AxisKind::Linear ? linear_ : rotary_).push_back(i);
}

bool LineQueue::joinsOn(double feed, const machine::AxisPositions& to) const {
  if (joins_ <= 0 || points_.empty() || feed != feed_ || feed <= 0 || points_.size() >= mostPoints) return false;
  for (const std::size_t axis : rotary_)
    if (std::abs(to[axis] - begin_[axis]) > stands) return false;
  double length = 0;  // all squared
  for (const std::size_t axis : linear_)
    length += (to[axis] - begin_[axis]) * (to[axis] - begin_[axis]);
  if (length == 0) return false;
  return std::ranges::all_of(points_, [&](const machine::AxisPositions& point) {
    double along = 0, distance = 0;
    for (const std::size_t axis : linear_)
      along += (point[axis] - begin_[axis]) * (to[axis] - begin_[axis]);
    along = std::clamp(along / length, 0.0, 1.0);
    for (const std::size_t axis : linear_) {
      const double off = point[axis] - begin_[axis] - along * (to[axis] - begin_[axis]);
      distance += off * off;
    }
    return distance <= joins_ * joins_;
  });
}

void LineQueue::add(std::size_t line, double feed, const machine::AxisPositions& from, const machine::AxisPositions& to,
                    Clock::time_point now) {
  if (joinsOn(feed, to)) {
    numbers_.resize(numbers_.size() - axes_ - 2);
  } else {
    if (count_++ == 0) firstAt_ = now;
    begin_ = from;
    feed_ = feed;
    points_.clear();
  }
  // A line that turns rotary axes stays as it is.
  const bool turns =
      std::ranges::any_of(rotary_, [&](std::size_t axis) { return std::abs(to[axis] - from[axis]) > stands; });
  if (!turns) points_.push_back(to);
  numbers_.push_back(static_cast<double>(line));
  numbers_.push_back(feed);
  numbers_.insert(numbers_.end(), to.values.begin(), to.values.begin() + static_cast<std::ptrdiff_t>(axes_));
}

bool LineQueue::isDue(Clock::time_point now) const {
  return count_ >= mostLines || (count_ > 0 && now - firstAt_ > patience_);
}

std::vector<double> LineQueue::take(Next next) {
  patience_ = next == Next::MoreLines ? std::min(2 * patience_, late) : soon;
  count_ = 0;
  points_.clear();
  return std::exchange(numbers_, {});
}

}  // namespace probewright::adapter
