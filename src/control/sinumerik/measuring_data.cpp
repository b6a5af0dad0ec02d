#include "control/sinumerik/measuring_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "base/number_text.hpp"

namespace probewright::control::sinumerik {

namespace {

constexpr std::array data = {
    MeasuringDatum{51618, "$MNS_MEA_CM_ROT_AX_POS_TOL", 1, 0, "deg", "position tolerance of rotary axes", "_CM", 8},
    MeasuringDatum{51740, "$MNS_MEA_FUNCTION_MASK", 0, 11, "", "function mask of the measuring cycles"},
    MeasuringDatum{51750, "$MNS_J_MEA_M_DIST", 0, 0, "mm", "measuring distance in JOG", "E_MESS_D"},
    MeasuringDatum{51751, "$MNS_J_MEA_M_DIST_MANUELL", 0, 0, "mm", "measuring distance in JOG, started by hand",
                   "E_MESS_D_M"},
    MeasuringDatum{51752, "$MNS_J_MEA_M_DIST_TOOL_LENGTH", 0, 0, "mm", "measuring distance in JOG, tool length",
                   "E_MESS_D_L"},
    MeasuringDatum{51753, "$MNS_J_MEA_M_DIST_TOOL_RADIUS", 0, 0, "mm", "measuring distance in JOG, tool radius",
                   "E_MESS_D_R"},
    MeasuringDatum{51757, "$MNS_J_MEA_COLL_MONIT_FEED", 0, 0, "mm/min", "feed in JOG with collision monitoring, plane",
                   "E_MESS_F"},
    MeasuringDatum{51758, "$MNS_J_MEA_COLL_MONIT_POS_FEED", 0, 0, "mm/min",
                   "feed in JOG with collision monitoring, infeed axis", "E_MESS_FZ"},
    MeasuringDatum{51770, "$MNS_J_MEA_CAL_RING_DIAM", 12, 0, "mm", "diameter of the calibration ring", "E_MESS_CAL_D"},
    MeasuringDatum{51772, "$MNS_J_MEA_CAL_HEIGHT_FEEDAX", 12, 0, "mm",
                   "height of the calibration ring in the infeed axis", "E_MESS_CAL_L"},
    MeasuringDatum{51780, "$MNS_J_MEA_T_PROBE_DIAM_RAD", 6, 0, "mm",
                   "diameter of the tool probe for radius measurement", "E_MESS_MT_DR"},
    MeasuringDatum{51784, "$MNS_J_MEA_T_PROBE_APPR_AX_DIR", 6, 0, "", "approach direction to the tool probe",
                   "E_MESS_MT_DIR"},
    MeasuringDatum{52740, "$MCS_MEA_FUNCTION_MASK", 0, 65536, "", "function mask of the measuring cycles, channel"},
    MeasuringDatum{52751, "$MCS_J_MEA_MAGN_GLAS_POS", 2, 0, "", "position of the magnifying glass in JOG"},
    MeasuringDatum{54600, "$SNS_MEA_WP_BALL_DIAM", 12, 0, "mm", "effective diameter of the probe ball", "_WP", 0},
    MeasuringDatum{54601, "$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", 12, 0, "mm",
                   "trigger point of the workpiece probe, minus direction, first axis", "_WP", 1},
    MeasuringDatum{54602, "$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", 12, 0, "mm",
                   "trigger point of the workpiece probe, plus direction, first axis", "_WP", 2},
    MeasuringDatum{54603, "$SNS_MEA_WP_TRIG_MINUS_DIR_AX2", 12, 0, "mm",
                   "trigger point of the workpiece probe, minus direction, second axis", "_WP", 3},
    MeasuringDatum{54604, "$SNS_MEA_WP_TRIG_PLUS_DIR_AX2", 12, 0, "mm",
                   "trigger point of the workpiece probe, plus direction, second axis", "_WP", 4},
    MeasuringDatum{54605, "$SNS_MEA_WP_TRIG_MINUS_DIR_AX3", 12, 0, "mm",
                   "trigger point of the workpiece probe, minus direction, third axis", "_WP", 5},
    MeasuringDatum{54606, "$SNS_MEA_WP_TRIG_PLUS_DIR_AX3", 12, 0, "mm",
                   "trigger point of the workpiece probe, plus direction, third axis", "_WP", 6},
    MeasuringDatum{54607, "$SNS_MEA_WP_POS_DEV_AX1", 12, 0, "mm", "positional deviation of the probe ball, first axis",
                   "_WP", 7},
    MeasuringDatum{54608, "$SNS_MEA_WP_POS_DEV_AX2", 12, 0, "mm", "positional deviation of the probe ball, second axis",
                   "_WP", 8},
    MeasuringDatum{54609, "$SNS_MEA_WP_STATUS_RT", 12, 0, "",
                   "calibration status: a digit for each axis from the units on, 1 minus, 2 plus, 3 both directions",
                   "_WP", 9},
    MeasuringDatum{54610, "$SNS_MEA_WP_STATUS_GEN", 12, 0, "",
                   "calibration status: units plane (1 G17), tens 1 with position deviation, hundreds 1 with length"},
    MeasuringDatum{54611, "$SNS_MEA_WP_FEED", 12, 0, "mm/min", "feed at which the workpiece probe was calibrated"},
    MeasuringDatum{54615, "$SNS_MEA_CAL_EDGE_BASE_AX1", 3, 0, "mm",
                   "calibration groove: base, first axis, machine coordinates", "_KB", 2},
    MeasuringDatum{54616, "$SNS_MEA_CAL_EDGE_UPPER_AX1", 3, 0, "mm",
                   "calibration groove: upper edge, first axis, machine coordinates"},
    MeasuringDatum{54617, "$SNS_MEA_CAL_EDGE_PLUS_DIR_AX1", 3, 0, "mm",
                   "calibration groove: wall in plus direction, first axis, machine coordinates", "_KB", 3},
    MeasuringDatum{54618, "$SNS_MEA_CAL_EDGE_MINUS_DIR_AX1", 3, 0, "mm",
                   "calibration groove: wall in minus direction, first axis, machine coordinates", "_KB", 4},
    MeasuringDatum{54619, "$SNS_MEA_CAL_EDGE_BASE_AX2", 3, 0, "mm",
                   "calibration groove: base, second axis, machine coordinates", "_KB", 6},
    MeasuringDatum{54620, "$SNS_MEA_CAL_EDGE_UPPER_AX2", 3, 0, "mm",
                   "calibration groove: upper edge, second axis, machine coordinates", "_KB", 5},
    MeasuringDatum{54621, "$SNS_MEA_CAL_EDGE_PLUS_DIR_AX2", 3, 0, "mm",
                   "calibration groove: wall in plus direction, second axis, machine coordinates", "_KB", 0},
    MeasuringDatum{54622, "$SNS_MEA_CAL_EDGE_MINUS_DIR_AX2", 3, 0, "mm",
                   "calibration groove: wall in minus direction, second axis, machine coordinates", "_KB", 1},
    MeasuringDatum{54625, "$SNS_MEA_TP_TRIG_MINUS_DIR_AX1", 6, 0, "mm",
                   "trigger point of the tool probe, minus direction, first axis, machine coordinates", "_TP", 0},
    MeasuringDatum{54626, "$SNS_MEA_TP_TRIG_PLUS_DIR_AX1", 6, 0, "mm",
                   "trigger point of the tool probe, plus direction, first axis, machine coordinates", "_TP", 1},
    MeasuringDatum{54627, "$SNS_MEA_TP_TRIG_MINUS_DIR_AX2", 6, 0, "mm",
                   "trigger point of the tool probe, minus direction, second axis, machine coordinates", "_TP", 2},
    MeasuringDatum{54628, "$SNS_MEA_TP_TRIG_PLUS_DIR_AX2", 6, 0, "mm",
                   "trigger point of the tool probe, plus direction, second axis, machine coordinates", "_TP", 3},
    MeasuringDatum{54629, "$SNS_MEA_TP_TRIG_MINUS_DIR_AX3", 6, 0, "mm",
                   "trigger point of the tool probe, minus direction, third axis, machine coordinates", "_TP", 4},
    MeasuringDatum{54630, "$SNS_MEA_TP_TRIG_PLUS_DIR_AX3", 6, 0, "mm",
                   "trigger point of the tool probe, plus direction, third axis, machine coordinates", "_TP", 5},
    MeasuringDatum{54631, "$SNS_MEA_TP_EDGE_DISK_SIZE", 6, 0, "mm", "edge length or disc diameter of the tool probe",
                   "_TP", 6},
    MeasuringDatum{54632, "$SNS_MEA_TP_AX_DIR_AUTO_CAL", 6, 133, "",
                   "axes and directions of automatic calibration of the tool probe: a digit for each axis from the "
                   "units on, 0 none, 1 minus, 2 plus, 3 both",
                   "_TP", 7},
    MeasuringDatum{54633, "$SNS_MEA_TP_TYPE", 6, 0, "",
                   "type of the tool probe: 0 cube, 101, 201, 301 a disc across Z, Y, X", "_TP", 8},
    MeasuringDatum{54634, "$SNS_MEA_TP_CAL_MEASURE_DEPTH", 6, 2, "mm",
                   "depth of calibrating and measuring below the upper edge of the tool probe", "_TP", 9},
    MeasuringDatum{54636, "$SNS_MEA_TP_FEED", 6, 0, "mm/min", "feed at which the tool probe was calibrated"},
    MeasuringDatum{54640, "$SNS_MEA_TPW_TRIG_MINUS_DIR_AX1", 6, 0, "mm",
                   "trigger point of the tool probe, minus direction, first axis, workpiece coordinates", "_TPW", 0},
    MeasuringDatum{54641, "$SNS_MEA_TPW_TRIG_PLUS_DIR_AX1", 6, 0, "mm",
                   "trigger point of the tool probe, plus direction, first axis, workpiece coordinates", "_TPW", 1},
    MeasuringDatum{54642, "$SNS_MEA_TPW_TRIG_MINUS_DIR_AX2", 6, 0, "mm",
                   "trigger point of the tool probe, minus direction, second axis, workpiece coordinates", "_TPW", 2},
    MeasuringDatum{54643, "$SNS_MEA_TPW_TRIG_PLUS_DIR_AX2", 6, 0, "mm",
                   "trigger point of the tool probe, plus direction, second axis, workpiece coordinates", "_TPW", 3},
    MeasuringDatum{54644, "$SNS_MEA_TPW_TRIG_MINUS_DIR_AX3", 6, 0, "mm",
                   "trigger point of the tool probe, minus direction, third axis, workpiece coordinates", "_TPW", 4},
    MeasuringDatum{54645, "$SNS_MEA_TPW_TRIG_PLUS_DIR_AX3", 6, 0, "mm",
                   "trigger point of the tool probe, plus direction, third axis, workpiece coordinates", "_TPW", 5},
    MeasuringDatum{54646, "$SNS_MEA_TPW_EDGE_DISK_SIZE", 6, 0, "mm",
                   "edge length or disc diameter of the tool probe, workpiece coordinates", "_TPW", 6},
    MeasuringDatum{54647, "$SNS_MEA_TPW_AX_DIR_AUTO_CAL", 6, 133, "",
                   "axes and directions of automatic calibration of the tool probe, workpiece coordinates: digits as "
                   "of SD 54632",
                   "_TPW", 7},
    MeasuringDatum{54648, "$SNS_MEA_TPW_TYPE", 6, 0, "", "type of the tool probe: disc or cube, workpiece coordinates",
                   "_TPW", 8},
    MeasuringDatum{54649, "$SNS_MEA_TPW_CAL_MEASURE_DEPTH", 6, 2, "mm",
                   "depth of calibrating and measuring below the upper edge of the tool probe, workpiece coordinates",
                   "_TPW", 9},
    MeasuringDatum{54651, "$SNS_MEA_TPW_FEED", 6, 0, "mm/min",
                   "feed at which the tool probe was calibrated, workpiece coordinates"},
    MeasuringDatum{54652, "$SNS_MEA_INPUT_TOOL_PROBE_SUB", 6, 0, "",
                   "measuring input of the tool probe on the counter spindle"},
    MeasuringDatum{54670, "$SNS_MEA_CM_MAX_PERI_SPEED", 1, 100, "m/min",
                   "largest peripheral speed of a tool being measured", "_CM", 0},
    MeasuringDatum{54671, "$SNS_MEA_CM_MAX_REVOLUTIONS", 1, 1000, "rev/min",
                   "largest speed of a tool being measured; 0: no limit", "_CM", 1},
    MeasuringDatum{54672, "$SNS_MEA_CM_MAX_FEEDRATE", 1, 20, "mm/min",
                   "largest feed towards a rotating tool; 0: no limit", "_CM", 4},
    MeasuringDatum{54673, "$SNS_MEA_CM_MIN_FEEDRATE", 1, 1, "mm/min", "smallest feed towards a rotating tool", "_CM",
                   2},
    MeasuringDatum{54674, "$SNS_MEA_CM_SPIND_ROT_DIR", 1, 4, "", "direction of rotation when measuring: 3 M3, 4 M4",
                   "_CM", 5},
    MeasuringDatum{54675, "$SNS_MEA_CM_FEEDFACTOR_1", 1, 10, "",
                   "feed of the first of several touches of rotating tools, as a factor; 0: one touch", "_CM", 6},
    MeasuringDatum{54676, "$SNS_MEA_CM_FEEDFACTOR_2", 1, 0, "",
                   "feed of the second of three touches of rotating tools, as a factor; 0: two touches", "_CM", 7},
    MeasuringDatum{54677, "$SNS_MEA_CM_MEASURING_ACCURACY", 1, 0.005, "mm", "accuracy wanted with rotating tools",
                   "_CM", 3},
    MeasuringDatum{54690, "$SNS_MEA_T_PROBE_MANUFACTURER", 0, 0, "", "maker of the tool probe", "_TP_CF"},
    MeasuringDatum{54691, "$SNS_MEA_T_PROBE_OFFSET", 0, 0, "", "result offset of the tool probe", "_MT_COMP"},
    MeasuringDatum{54695, "$SNS_MEA_RESULT_OFFSET_TAB_RAD1", 5, 0, "mm",
                   "correction table of rotating tools, radius, row 1", "_MT_EC_R", -1, 1},
    MeasuringDatum{54696, "$SNS_MEA_RESULT_OFFSET_TAB_RAD2", 5, 0, "mm",
                   "correction table of rotating tools, radius, row 2", "_MT_EC_R", -1, 2},
    MeasuringDatum{54697, "$SNS_MEA_RESULT_OFFSET_TAB_RAD3", 5, 0, "mm",
                   "correction table of rotating tools, radius, row 3", "_MT_EC_R", -1, 3},
    MeasuringDatum{54698, "$SNS_MEA_RESULT_OFFSET_TAB_RAD4", 5, 0, "mm",
                   "correction table of rotating tools, radius, row 4", "_MT_EC_R", -1, 4},
    MeasuringDatum{54699, "$SNS_MEA_RESULT_OFFSET_TAB_RAD5", 5, 0, "mm",
                   "correction table of rotating tools, radius, row 5", "_MT_EC_R", -1, 5},
    MeasuringDatum{54700, "$SNS_MEA_RESULT_OFFSET_TAB_RAD6", 5, 0, "mm",
                   "correction table of rotating tools, radius, row 6", "_MT_EC_R", -1, 6},
    MeasuringDatum{54705, "$SNS_MEA_RESULT_OFFSET_TAB_LEN1", 5, 0, "mm",
                   "correction table of rotating tools, length, row 1", "_MT_EC_L", -1, 1},
    MeasuringDatum{54706, "$SNS_MEA_RESULT_OFFSET_TAB_LEN2", 5, 0, "mm",
                   "correction table of rotating tools, length, row 2", "_MT_EC_L", -1, 2},
    MeasuringDatum{54707, "$SNS_MEA_RESULT_OFFSET_TAB_LEN3", 5, 0, "mm",
                   "correction table of rotating tools, length, row 3", "_MT_EC_L", -1, 3},
    MeasuringDatum{54708, "$SNS_MEA_RESULT_OFFSET_TAB_LEN4", 5, 0, "mm",
                   "correction table of rotating tools, length, row 4", "_MT_EC_L", -1, 4},
    MeasuringDatum{54709, "$SNS_MEA_RESULT_OFFSET_TAB_LEN5", 5, 0, "mm",
                   "correction table of rotating tools, length, row 5", "_MT_EC_L", -1, 5},
    MeasuringDatum{54710, "$SNS_MEA_RESULT_OFFSET_TAB_LEN6", 5, 0, "mm",
                   "correction table of rotating tools, length, row 6", "_MT_EC_L", -1, 6},
    MeasuringDatum{54740, "$SNS_MEA_FUNCTION_MASK", 0, 8, "", "function mask of measuring"},
    MeasuringDatum{54760, "$SNS_MEA_FUNCTION_MASK_PIECE", 0, 0, "", "fields of the screens of workpiece measurement"},
    MeasuringDatum{54762, "$SNS_MEA_FUNCTION_MASK_TOOL", 0, 0, "", "fields of the screens of tool measurement"},
    MeasuringDatum{54764, "$SNS_MEA_FUNCTION_MASK_TURN", 0, 0, "", "fields of the screens of measuring on lathes"},
    MeasuringDatum{54780, "$SNS_J_MEA_FUNCTION_MASK_PIECE", 0, 0, "",
                   "fields of the JOG screens of workpiece measurement"},
    MeasuringDatum{54782, "$SNS_J_MEA_FUNCTION_MASK_TOOL", 0, 0, "", "fields of the JOG screens of tool measurement"},
    MeasuringDatum{55613, "$SCS_MEA_RESULT_DISPLAY", 0, 0, "",
                   "result screen: 0 off, 1 for 8 s, 3 until NC start, 4 with tolerance alarms", "_CHBIT", 10},
    MeasuringDatum{55618, "$SCS_MEA_SIM_ENABLE", 0, 0, "",
                   "simulation: 0 skips measuring cycles, 1 runs them without measuring"},
    MeasuringDatum{55622, "$SCS_MEA_EMPIRIC_VALUE_NUM", 0, 20, "", "number of empirical values", "_EVMVNUM", 0},
    MeasuringDatum{55623, "$SCS_MEA_EMPIRIC_VALUE", 20, 0, "mm", "empirical values", "_EV"},
    MeasuringDatum{55624, "$SCS_MEA_AVERAGE_VALUE_NUM", 0, 20, "", "number of mean values", "_EVMVNUM", 1},
    MeasuringDatum{55625, "$SCS_MEA_AVERAGE_VALUE", 20, 0, "mm", "mean values", "_MV"},
    MeasuringDatum{55628, "$SCS_MEA_TP_FEED_MEASURE", 0, 300, "mm/min",
                   "measuring feed when calibrating the tool probe"},
    MeasuringDatum{55630, "$SCS_MEA_FEED_MEASURE", 0, 300, "mm/min",
                   "measuring feed when calibrating the workpiece probe", "E_MESS_FM"},
    MeasuringDatum{55632, "$SCS_MEA_FEED_RAPID_IN_PERCENT", 0, 50, "%",
                   "rapid positioning within cycles, percent of rapid traverse", "_SPEED", 0},
    MeasuringDatum{55634, "$SCS_MEA_FEED_PLANE_VALUE", 0, 1000, "mm/min", "positioning feed within cycles, plane",
                   "_SPEED", 1},
    MeasuringDatum{55636, "$SCS_MEA_FEED_FEEDAX_VALUE", 0, 1000, "mm/min",
                   "positioning feed within cycles, infeed axis", "_SPEED", 2},
    MeasuringDatum{55638, "$SCS_MEA_FEED_FAST_MEASURE", 0, 900, "mm/min", "fast measuring feed", "_SPEED", 3},
    MeasuringDatum{55640, "$SCS_MEA_FEED_CIRCLE", 0, 0, "mm/min", "feed on circular paths"},
    MeasuringDatum{55642, "$SCS_MEA_EDGE_SAVE_ANG", 0, 0, "deg",
                   "angle beside a single cutting edge at which it is touched too; 0: 2 degrees"},
    MeasuringDatum{55740, "$SCS_MEA_FUNCTION_MASK", 0, 81921, "", "function mask of measuring, channel"},
};

constexpr std::array bits = {
    MaskBit{"$MNS_MEA_FUNCTION_MASK", 0, true, "workpiece: calibration is monitored", "_CBIT", 16},
    MaskBit{"$MNS_MEA_FUNCTION_MASK", 1, true,
            "workpiece: probe length refers to the circumference of the ball, not to its centre", "_CBIT", 14},
    MaskBit{"$MNS_MEA_FUNCTION_MASK", 2, false, "workpiece: tool correction observes orientable tool carriers", "_CBIT",
            7},
    MaskBit{"$MNS_MEA_FUNCTION_MASK", 3, true, "workpiece: correction angle of mono probes acts", "_CBIT", 8},
    MaskBit{"$MNS_MEA_FUNCTION_MASK", 16, false, "tool: orientable tool carriers are observed", "_CBIT", 7},
    MaskBit{"$MCS_MEA_FUNCTION_MASK", 0, false, "workpiece probe at measuring input 2, not 1", "_CHBIT", 0},
    MaskBit{"$MCS_MEA_FUNCTION_MASK", 1, false, "turning: Y is a measuring axis", "_CHBIT", 19},
    MaskBit{"$MCS_MEA_FUNCTION_MASK", 2, false, "turning: measuring under the turning centre without calibration"},
    MaskBit{"$MCS_MEA_FUNCTION_MASK", 16, true, "tool probe at measuring input 2, not 1", "_CHBIT", 1},
    MaskBit{"$SNS_MEA_FUNCTION_MASK", 0, false,
            "workpiece: repeat when the dimensional difference or the safe area is exceeded", "_CBIT", 0},
    MaskBit{"$SNS_MEA_FUNCTION_MASK", 1, false, "workpiece: repeat with alarm and stop", "_CBIT", 1},
    MaskBit{"$SNS_MEA_FUNCTION_MASK", 2, false, "workpiece: stop at M0 when a tolerance is exceeded", "_CBIT", 2},
    MaskBit{"$SNS_MEA_FUNCTION_MASK", 3, true, "workpiece: the calibrated ball radius goes to the tool data", "_CBIT",
            15},
    MaskBit{"$SNS_MEA_FUNCTION_MASK", 16, false,
            "tool: repeat when the dimensional difference or the safe area is exceeded", "_CBIT", 0},
    MaskBit{"$SNS_MEA_FUNCTION_MASK", 17, false, "tool: repeat with alarm and stop", "_CBIT", 1},
    MaskBit{"$SNS_MEA_FUNCTION_MASK", 18, false, "tool: stop at M0 when the dimensional difference is exceeded",
            "_CBIT", 2},
    MaskBit{"$SNS_MEA_FUNCTION_MASK", 19, false,
            "tool: the spindle speed is not reduced for the last touch of a milling tool", "_CHBIT", 22},
    MaskBit{"$SCS_MEA_FUNCTION_MASK", 0, true, "workpiece: positioning within cycles is watched for collisions",
            "_CHBIT", 2},
    MaskBit{"$SCS_MEA_FUNCTION_MASK", 1, false, "workpiece: the spindle follows the rotation about the infeed axis",
            "_CHBIT", 13},
    MaskBit{"$SCS_MEA_FUNCTION_MASK", 2, false, "workpiece: the spindle follows clockwise", "_CHBIT", 14},
    MaskBit{"$SCS_MEA_FUNCTION_MASK", 3, false, "workpiece: one attempt to touch, not five", "_CHBIT", 15},
    MaskBit{"$SCS_MEA_FUNCTION_MASK", 4, false, "workpiece: approach with the fast measuring feed", "_CHBIT", 17},
    MaskBit{"$SCS_MEA_FUNCTION_MASK", 5, false, "workpiece: retract at rapid, not with the plane feed", "_CHBIT", 16},
    MaskBit{"$SCS_MEA_FUNCTION_MASK", 6, false, "workpiece: CUST_MEACYC is called after the spindle was positioned"},
    MaskBit{"$SCS_MEA_FUNCTION_MASK", 14, true, "JOG: the spindle follows the rotation about the infeed axis",
            "E_MESS_SETT", 0},
    MaskBit{"$SCS_MEA_FUNCTION_MASK", 15, false, "JOG: the centre of the calibration ring is known", "E_MESS_SETT", 1},
    MaskBit{"$SCS_MEA_FUNCTION_MASK", 16, true, "tool: positioning within cycles is watched for collisions", "_CHBIT",
            2},
    MaskBit{"$SCS_MEA_FUNCTION_MASK", 17, false, "tool: one attempt to touch, not five", "_CHBIT", 15},
    MaskBit{"$SCS_MEA_FUNCTION_MASK", 18, false, "tool: approach with the fast measuring feed", "_CHBIT", 17},
    MaskBit{"$SCS_MEA_FUNCTION_MASK", 19, false, "tool: retract at rapid, not with the plane feed", "_CHBIT", 16},
};

std::uint32_t maskOf(double value) {
  return value >= 0 && value < 4294967296.0 ? static_cast<std::uint32_t>(value) : 0;
}

std::optional<long long> lastIndex(const DataKey& key) {
  return key.indices.empty() ? std::nullopt : parseInteger(key.indices.back());
}

/// The datum that an old name with these indices stands for, if it is this one.
std::optional<DataKey> targetIn(const MeasuringDatum& datum, const DataKey& key) {
  if (datum.gud.empty() || datum.gud != key.name) return std::nullopt;
  DataKey target;
  target.name = datum.identifier;
  std::vector<std::string> indices = key.indices;
  if (datum.gudRow >= 0) {
    if (indices.size() != 2 || parseInteger(indices.front()) != datum.gudRow) return std::nullopt;
    indices.erase(indices.begin());
  }
  if (datum.gudElement >= 0) {
    if (lastIndex(key) != datum.gudElement) return std::nullopt;
    indices.pop_back();
    if (datum.elements == 1) indices.emplace_back("0");
  }
  if (datum.elements > 0) {
    if (indices.size() != 1) return std::nullopt;
    const auto index = parseInteger(indices[0]);
    if (!index || *index < 0 || *index >= datum.elements) return std::nullopt;
  } else if (!indices.empty()) {
    return std::nullopt;
  }
  target.indices = std::move(indices);
  return target;
}

}  // namespace

std::span<const MeasuringDatum> measuringData() { return data; }
std::span<const MaskBit> maskBits() { return bits; }

const MeasuringDatum* findMeasuringDatum(std::string_view identifier) {
  const auto* const found = std::find_if(data.begin(), data.end(),
                                         [&](const MeasuringDatum& datum) { return datum.identifier == identifier; });
  return found == data.end() ? nullptr : found;
}

const MeasuringDatum* findMeasuringDatum(int number) {
  const auto* const found =
      std::find_if(data.begin(), data.end(), [&](const MeasuringDatum& datum) { return datum.number == number; });
  return found == data.end() ? nullptr : found;
}

std::string measuringDataPage() {
  std::string page =
      "# Data of the SINUMERIK measuring cycles\n\n"
      "Machine data (51xxx general, 52xxx channel) and setting data (54xxx general, 55xxx channel) that Probewright "
      "knows,\n"
      "with their initial values. Data of a control are read from its initialization text, see [tables](tables.md).\n\n"
      "| number | identifier | initial | unit | meaning | name in older programs |\n|---|---|---|---|---|---|\n";
  for (const MeasuringDatum& datum : data) {
    const std::string index = datum.elements == 0   ? ""
                              : datum.elements == 1 ? "[0]"
                                                    : fmt::format("[0..{}]", datum.elements - 1);
    std::string gud;
    if (!datum.gud.empty()) {
      const std::string_view element = datum.elements > 1 ? "n" : "";
      gud = datum.gudRow >= 0 ? fmt::format("`{}[{},n]`", datum.gud, datum.gudRow)
            : datum.gudElement < 0
                ? (element.empty() ? fmt::format("`{}`", datum.gud) : fmt::format("`{}[n]`", datum.gud))
            : element.empty() ? fmt::format("`{}[{}]`", datum.gud, datum.gudElement)
                              : fmt::format("`{}[n,{}]`", datum.gud, datum.gudElement);
    }
    page += fmt::format("| {} | `{}{}` | {} | {} | {} | {} |\n", datum.number, datum.identifier, index, datum.initial,
                        datum.unit, datum.meaning, gud);
  }
  page +=
      "\n## Data of the NC that the cycles observe\n\n"
      "| number | identifier | if absent | effect |\n|---|---|---|---|\n"
      "| 18080 | `$MN_MM_TOOL_MANAGEMENT_MASK` | bit 8 on | bit 8: additive and setup offsets exist |\n"
      "| 18102 | `$MN_MM_TYPE_CUTTING_EDGE` | 0 | 1: D numbers are unique, tools to be corrected need no name |\n"
      "| 18108 | `$MN_MM_NUM_SUMCORR` | 6 | number of additive and setup offsets, DL |\n"
      "| 18600 | `$MN_MM_FRAME_FINE_TRANS` | 1 | 0: no fine offsets, corrections are coarse |\n"
      "| 20360 | `$MC_TOOL_PARAMETER_DEF_MASK` | 0 | length 1 of turning tools counts as a diameter: bit 0 wear, bit 1 "
      "geometry |\n"
      "| 28080 | `$MC_MM_NUM_USER_FRAMES` | 100 | number of settable zero offsets |\n"
      "| 42940 | `$SC_TOOL_LENGTH_CONST` | 0 | 17, 18, 19: tool lengths act as in this plane, whichever is active |\n"
      "| 42950 | `$SC_TOOL_LENGTH_TYPE` | 0 | 2: lengths of all tools as of turning tools |\n"
      "| 52207 | `$MCS_AXIS_USAGE_ATTRIB[n]` | bit 6 on | rotary axis n, from 0; without bit 6 CYCLE998 corrects it "
      "coarse |\n";
  page +=
      "\n## Bits of the function masks\n\n| mask | bit | initial | meaning if 1 | name in older programs "
      "|\n|---|---|---|---|---|\n";
  for (const MaskBit& bit : bits) {
    const std::string gud = bit.gud.empty() ? "" : fmt::format("`{}[{}]`", bit.gud, bit.gudElement);
    page +=
        fmt::format("| `{}` | {} | {} | {} | {} |\n", bit.identifier, bit.bit, bit.initial ? 1 : 0, bit.meaning, gud);
  }
  return page;
}

void setMeasuringDefaults(DataStore& store) {
  for (const MeasuringDatum& datum : data)
    store.setDefault(datum.identifier, datum.initial);
  store.setDefault("R", 0.0);
  // Data of the NC that act with these values where a control's file has none; programs read what acts.
  constexpr std::pair<const char*, double> acting[] = {
      {"$MN_MM_TOOL_MANAGEMENT_MASK", 256}, {"$MN_MM_TYPE_CUTTING_EDGE", 0}, {"$MN_MM_NUM_SUMCORR", 6},
      {"$MN_MM_FRAME_FINE_TRANS", 1},       {"$MC_MM_NUM_USER_FRAMES", 100}, {"$MC_TOOL_PARAMETER_DEF_MASK", 0},
      {"$SC_TOOL_LENGTH_CONST", 0},         {"$SC_TOOL_LENGTH_TYPE", 0},     {"$SC_DRY_RUN_FEED", 5000}};
  for (const auto& [name, value] : acting)
    store.setDefault(name, value);
  for (const char* text : {"_OVS_TNAME", "_TNAME", "_TENV"})
    store.setDefault(text, std::string());
}

bool maskBit(const DataStore& store, std::string_view identifier, int bit) {
  if (bit < 0 || bit > 31) return false;
  return (maskOf(store.number(identifier, {})) >> static_cast<unsigned>(bit) & 1U) != 0;
}

void setMaskBit(DataStore& store, std::string_view identifier, int bit, bool value) {
  if (bit < 0 || bit > 31) return;
  const std::uint32_t mask = maskOf(store.number(identifier, {}));
  const std::uint32_t flag = 1U << static_cast<unsigned>(bit);
  store.set(identifier, {}, static_cast<double>(value ? mask | flag : mask & ~flag));
}

std::vector<GudTarget> gudTargets(const DataKey& key) {
  std::vector<GudTarget> targets;
  for (const MeasuringDatum& datum : data) {
    if (auto target = targetIn(datum, key)) targets.push_back({std::move(*target), -1});
  }
  for (const MaskBit& bit : bits) {
    if (bit.gud.empty() || bit.gud != key.name || key.indices.size() != 1 || lastIndex(key) != bit.gudElement) continue;
    targets.push_back({DataKey(bit.identifier, {}), bit.bit});
  }
  return targets;
}

std::optional<double> readGud(const DataStore& store, const DataKey& key) {
  const auto targets = gudTargets(key);
  if (targets.empty()) return std::nullopt;
  const GudTarget& first = targets.front();
  if (first.bit < 0) return store.number(first.key);
  return maskBit(store, first.key.name, first.bit) ? 1.0 : 0.0;
}

bool writeGud(DataStore& store, const DataKey& key, double value) {
  const auto targets = gudTargets(key);
  for (const GudTarget& target : targets) {
    if (target.bit < 0) {
      store.set(target.key, value);
    } else {
      setMaskBit(store, target.key.name, target.bit, value != 0);
    }
  }
  return !targets.empty();
}

}  // namespace probewright::control::sinumerik
