#include "control/sinumerik/array_data.hpp"

#include <algorithm>

#include "control/sinumerik/measuring_data.hpp"

namespace probewright::control::sinumerik {
namespace {

/// Those that the table of measuring data has not: data of the NC and former names.
constexpr std::string_view others[] = {
    "$MCS_AXIS_USAGE_ATTRIB",
    "$MC_GCODE_RESET_VALUES",
    "$MC_TRAFO5_PART_OFFSET_1",
    "$MC_TRAFO5_JOINT_OFFSET_1",
    "$MC_TRAFO5_JOINT_OFFSET_PART_1",
    "$MC_TRAFO5_BASE_TOOL_1",
    "$MC_TRAFO5_AXIS1_1",
    "$MC_TRAFO5_AXIS2_1",
    "$MNS_MEA_INPUT_PIECE_PROBE",
    "$MNS_MEA_INPUT_TOOL_PROBE",
    "$MNS_MEA_INPUT_TOOL_PROBE_SUB",
    "$MNS_J_MEA_T_PROBE_TYPE",
    "$MNS_J_MEA_T_PROBE_ALLOW_AX_DIR",
    "$MNS_J_MEA_T_PROBE_DIAM_LENGTH",
    "$MNS_J_MEA_T_PROBE_T_EDGE_DIST",
};

}  // namespace

bool isArrayDatum(std::string_view name) {
  if (!name.starts_with("$M") && !name.starts_with("$S")) return false;
  if (const MeasuringDatum* datum = findMeasuringDatum(name)) return datum->elements > 0;
  return std::ranges::find(others, name) != std::end(others);
}

}  // namespace probewright::control::sinumerik
