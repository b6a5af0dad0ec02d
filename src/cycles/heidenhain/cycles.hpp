#pragma once

#include "cycles/heidenhain/registry.hpp"

/// Every HEIDENHAIN cycle: its catalogue entry and its code, each in the file of its number.
namespace probewright::cycles::heidenhain {

extern const CycleDefinition cycle0Definition;
extern const CycleDefinition cycle1Definition;
extern const CycleDefinition cycle2Definition;
extern const CycleDefinition cycle3Definition;
extern const CycleDefinition cycle4Definition;
extern const CycleDefinition cycle9Definition;
extern const CycleDefinition cycle400Definition;
extern const CycleDefinition cycle401Definition;
extern const CycleDefinition cycle402Definition;
extern const CycleDefinition cycle403Definition;
extern const CycleDefinition cycle404Definition;
extern const CycleDefinition cycle405Definition;
extern const CycleDefinition cycle408Definition;
extern const CycleDefinition cycle409Definition;
extern const CycleDefinition cycle410Definition;
extern const CycleDefinition cycle411Definition;
extern const CycleDefinition cycle412Definition;
extern const CycleDefinition cycle413Definition;
extern const CycleDefinition cycle414Definition;
extern const CycleDefinition cycle415Definition;
extern const CycleDefinition cycle416Definition;
extern const CycleDefinition cycle417Definition;
extern const CycleDefinition cycle418Definition;
extern const CycleDefinition cycle419Definition;
extern const CycleDefinition cycle420Definition;
extern const CycleDefinition cycle421Definition;
extern const CycleDefinition cycle422Definition;
extern const CycleDefinition cycle423Definition;
extern const CycleDefinition cycle424Definition;
extern const CycleDefinition cycle425Definition;
extern const CycleDefinition cycle426Definition;
extern const CycleDefinition cycle427Definition;
extern const CycleDefinition cycle430Definition;
extern const CycleDefinition cycle431Definition;
extern const CycleDefinition cycle440Definition;
extern const CycleDefinition cycle441Definition;
extern const CycleDefinition cycle444Definition;
extern const CycleDefinition cycle460Definition;
extern const CycleDefinition cycle461Definition;
extern const CycleDefinition cycle462Definition;
extern const CycleDefinition cycle463Definition;
extern const CycleDefinition cycle1410Definition;
extern const CycleDefinition cycle1411Definition;
extern const CycleDefinition cycle1420Definition;

void cycle0(Context& context, const Arguments& arguments);
void cycle1(Context& context, const Arguments& arguments);
void cycle2(Context& context, const Arguments& arguments);
void cycle3(Context& context, const Arguments& arguments);
void cycle4(Context& context, const Arguments& arguments);
void cycle9(Context& context, const Arguments& arguments);
void cycle400(Context& context, const Arguments& arguments);
void cycle401(Context& context, const Arguments& arguments);
void cycle402(Context& context, const Arguments& arguments);
void cycle403(Context& context, const Arguments& arguments);
void cycle404(Context& context, const Arguments& arguments);
void cycle405(Context& context, const Arguments& arguments);
void cycle408(Context& context, const Arguments& arguments);
void cycle409(Context& context, const Arguments& arguments);
void cycle410(Context& context, const Arguments& arguments);
void cycle411(Context& context, const Arguments& arguments);
void cycle412(Context& context, const Arguments& arguments);
void cycle413(Context& context, const Arguments& arguments);
void cycle414(Context& context, const Arguments& arguments);
void cycle415(Context& context, const Arguments& arguments);
void cycle416(Context& context, const Arguments& arguments);
void cycle417(Context& context, const Arguments& arguments);
void cycle418(Context& context, const Arguments& arguments);
void cycle419(Context& context, const Arguments& arguments);
void cycle420(Context& context, const Arguments& arguments);
void cycle421(Context& context, const Arguments& arguments);
void cycle422(Context& context, const Arguments& arguments);
void cycle423(Context& context, const Arguments& arguments);
void cycle424(Context& context, const Arguments& arguments);
void cycle425(Context& context, const Arguments& arguments);
void cycle426(Context& context, const Arguments& arguments);
void cycle427(Context& context, const Arguments& arguments);
void cycle430(Context& context, const Arguments& arguments);
void cycle431(Context& context, const Arguments& arguments);
void cycle440(Context& context, const Arguments& arguments);
void cycle441(Context& context, const Arguments& arguments);
void cycle444(Context& context, const Arguments& arguments);
void cycle460(Context& context, const Arguments& arguments);
void cycle461(Context& context, const Arguments& arguments);
void cycle462(Context& context, const Arguments& arguments);
void cycle463(Context& context, const Arguments& arguments);
void cycle1410(Context& context, const Arguments& arguments);
void cycle1411(Context& context, const Arguments& arguments);
void cycle1420(Context& context, const Arguments& arguments);

}  // namespace probewright::cycles::heidenhain
