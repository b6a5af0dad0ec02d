#pragma once

#include "control/sinumerik/control.hpp"
#include "cycles/sinumerik/old_parameters.hpp"

namespace probewright::cycles::sinumerik {

/// True if a program has written the variables: a call without arguments means them.
bool hasOldParameters(const control::sinumerik::DataStore& data);

/// Today's arguments for such a call, and by their definition today's cycle. Throws Alarm 61307, or the one of the
/// parameter, for what has no counterpart.
Arguments argumentsOfOldForm(const CycleDefinition& cycle, const control::sinumerik::Control& control);

/// The measuring feed of such a call, _VMS, for as long as this lives; 0: that of the data set.
class OldFeed {
public:
  explicit OldFeed(control::sinumerik::Control& control);
  ~OldFeed();
  OldFeed(const OldFeed&) = delete;
  OldFeed& operator=(const OldFeed&) = delete;

private:
  control::sinumerik::Control& control_;
  control::sinumerik::DataKey key_;
  double before_ = 0;
  bool changed_ = false;
};

}  // namespace probewright::cycles::sinumerik
