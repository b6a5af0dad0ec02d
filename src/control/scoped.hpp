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

/// Work that is done when this goes, also when a move ends in an alarm. Where a control knows by itself what the
/// channel is to follow, this hands it over again after something else was followed:
///
///     const AtEnd again([&] { control.applyCoordinates(); });
///     channel.setFollowing(Following::Kinematics, reference);
///     channel.moveTo(turned, feed);
template <class Work>
class AtEnd {
public:
  explicit AtEnd(Work work) : work_(std::move(work)) {}
  ~AtEnd() { work_(); }
  AtEnd(const AtEnd&) = delete;
  AtEnd& operator=(const AtEnd&) = delete;

private:
  Work work_;
};

}  // namespace probewright::control
