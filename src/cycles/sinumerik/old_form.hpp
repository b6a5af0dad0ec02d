#pragma once

#include <string_view>

#include "control/sinumerik/control.hpp"
#include "cycles/catalogue.hpp"

/// Calls as programs of the measuring cycles up to version 7.5 have them: the parameters are global user data, and the
/// cycle is called without arguments.
///
///     _MVAR=101 _SETVAL=40 _FA=8 _TSA=4 _PRNUM=1 _KNUM=1
///     CYCLE977
///
/// What a program never wrote is 0 or empty; _PRNUM, _NMSP and _K are 1.
namespace probewright::cycles::sinumerik {

/// True for the cycles that can be called so.
bool hasOldForm(const CycleDefinition& cycle);

/// True for _MVAR, _SETVAL and the other variables that are parameters of such calls.
bool isOldParameter(std::string_view name);

/// True if a program has written the variables: a call without arguments means them.
bool hasOldParameters(const control::sinumerik::DataStore& data);

/// Today's arguments for such a call. Throws Alarm 61307, or the one of the parameter, for what has no counterpart.
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
