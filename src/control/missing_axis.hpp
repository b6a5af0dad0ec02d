#pragma once

#include "control/alarm.hpp"

namespace probewright::control {

/// A position needs an axis that the machine has not. Without a code: the controls call it by different numbers.
class MissingAxis : public Alarm {
public:
  using Alarm::Alarm;
};

}  // namespace probewright::control
