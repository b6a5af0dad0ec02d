#pragma once

#include "cycles/sinumerik/registry.hpp"

/// Every SINUMERIK measuring cycle: its catalogue entry and its code, each in the file of its number.
namespace probewright::cycles::sinumerik {

extern const CycleDefinition cycle150Definition;
extern const CycleDefinition cycle961Definition;
extern const CycleDefinition cycle973Definition;
extern const CycleDefinition cycle974Definition;
extern const CycleDefinition cycle976Definition;
extern const CycleDefinition cycle977Definition;
extern const CycleDefinition cycle978Definition;
extern const CycleDefinition cycle979Definition;
extern const CycleDefinition cycle994Definition;
extern const CycleDefinition cycle995Definition;
extern const CycleDefinition cycle997Definition;
extern const CycleDefinition cycle998Definition;

void setMeasuringLog(control::sinumerik::Control& control, const Arguments& arguments);
void cycle961(Context& context, const Arguments& arguments);
void cycle973(Context& context, const Arguments& arguments);
void cycle974(Context& context, const Arguments& arguments);
void cycle976(Context& context, const Arguments& arguments);
void cycle977(Context& context, const Arguments& arguments);
void cycle978(Context& context, const Arguments& arguments);
void cycle979(Context& context, const Arguments& arguments);
void cycle994(Context& context, const Arguments& arguments);
void cycle995(Context& context, const Arguments& arguments);
void cycle997(Context& context, const Arguments& arguments);
void cycle998(Context& context, const Arguments& arguments);

}  // namespace probewright::cycles::sinumerik
