#pragma once

#include <optional>
#include <string>
#include <vector>

#include "control/sinumerik/control.hpp"

/// Result screens and measuring logs: what a measurement gave, in the order a reader compares it.
namespace probewright::cycles::sinumerik {

using control::sinumerik::Control;
using control::sinumerik::MeasuringLog;

/// One measured quantity; mm and degrees.
struct MeasuredRow {
  std::string label;
  std::string unit;
  std::optional<double> setpoint, measured, difference, lower, upper;
  control::Verdict verdict = control::Verdict::None;
};

/// The rows of a record: set value, actual value and difference that belong together in one, other results each in its
/// own.
std::vector<MeasuredRow> measuredRows(const control::CycleRecord& record);

/// The result screen of a measurement: cycle and variant, set values, actual values and differences, tolerance limits,
/// correction, probe, safe area, tool or zero offset.
std::string resultScreen(const Control& control, const control::CycleRecord& record);

/// Adds the measurement to the log.
void addToLog(Control& control, MeasuringLog& log, const control::CycleRecord& record);

/// Shows and logs the measurement as setting data and CYCLE150 ask: on the screen for some time (1), until NC start
/// (3), or until NC start if alarm or message 61303 to 61306 came (4). `alarm`: the last alarm or message number, 0 if
/// none.
void outputResults(Control& control, control::CycleRecord& record, int alarm);

}  // namespace probewright::cycles::sinumerik
