#pragma once

#include <utility>

namespace probewright::control {

/// A mode that is another one for as long as this lives, a mode of the channel for instance. What it was before comes
/// back then, also when a move ends in an alarm:
///
///     const Scoped held(channel.holdTip, true);
///     channel.moveTo(turned, feed);
template <class Value>
class Scoped {
public:
  Scoped(Value& mode, Value meanwhile) : mode_(mode), before_(std::exchange(mode, std::move(meanwhile))) {}
  ~Scoped() { mode_ = before_; }
  Scoped(const Scoped&) = delete;
  Scoped& operator=(const Scoped&) = delete;

private:
  Value& mode_;
  Value before_;
};

}  // namespace probewright::control
