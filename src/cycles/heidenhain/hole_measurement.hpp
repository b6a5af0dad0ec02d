#pragma once

#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/context.hpp"

/// What cycles 401, 402, 405, 416, 418 and 430 have in common: centres of holes and studs as points of a pattern.
namespace probewright::cycles::heidenhain {

/// The centre of a hole that is entered without its diameter: from `centre` at the measuring height Q261 a touch along
/// the main axis to either side, then from half way between them along the minor axis. Exact on a round hole wherever
/// in it the probe starts. Ends at the clearance height Q260.
PartPoint measureHoleCentre(Context& context, const Vector2& centre, double measuringHeight);

/// The centre of a stud by four touches at 0, 90, 180 and 270 degrees, fitted by least squares.
PartPoint measureStudCentre(Context& context, const Vector2& centre, double diameter, double measuringHeight);

/// The angle from the main axis to the line from `first` to `second`, in (-180, 180].
double angleOf(const Vector2& first, const Vector2& second);

/// Refuses centres of 401 and 402 that coincide.
void twoHoleRules(CallRules& call);

/// Refuses, before anything is touched, what 401 and 402 cannot carry out: no rotary table, a locked row.
void requireCompensation(Context& context);

/// What 401 and 402 do with a misalignment: a basic rotation (Q402 = 0) or an alignment of the rotary table.
void compensateByRotationOrTable(Context& context, double angle);

}  // namespace probewright::cycles::heidenhain
