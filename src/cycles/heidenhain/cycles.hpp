#pragma once

#include "cycles/heidenhain/registry.hpp"

/// Every HEIDENHAIN cycle: its catalogue entry and its code, each in the file of its number.
namespace probewright::cycles::heidenhain {

extern const CycleDefinition cycle412Definition, cycle421Definition;

void cycle412(Context& context, const Arguments& arguments);
void cycle421(Context& context, const Arguments& arguments);

}  // namespace probewright::cycles::heidenhain
