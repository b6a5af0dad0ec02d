#pragma once

#include <string_view>

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

}  // namespace probewright::cycles::sinumerik
