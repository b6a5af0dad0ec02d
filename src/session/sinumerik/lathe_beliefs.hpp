#pragma once

#include "control/beliefs.hpp"
#include "control/sinumerik/data_store.hpp"

/// Tools as the SINUMERIK control of a lathe keeps them.
namespace probewright::session::sinumerik {

/// Enters `tool` as edge 1: length 1 in X, length 2 in Z, whatever its type. A probe becomes type 580 with the cutting
/// edge position its stylus points to (5 +Z, 6 +X, 7 -Z, 8 -X), lengths to the centre of its ball, and a calibration
/// data set with the axes of G18: Z, X, Y.
void enterLatheTool(control::sinumerik::DataStore& store, const control::BelievedTool& tool);

}  // namespace probewright::session::sinumerik
