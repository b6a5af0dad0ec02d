#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cycles/heidenhain/context.hpp"

/// What the inspection cycles 420 to 431 have in common: verdicts, status parameters, logs, tool monitoring.
namespace probewright::cycles::heidenhain {

/// One measured quantity of an inspection: a line of each section of the log.
struct Inspected {
  int parameter = 0;           ///< Qn that takes the actual value
  int deviationParameter = 0;  ///< Qn that takes actual - nominal; 0: none
  std::string label;           ///< "Center in reference axis"
  std::string maximumLabel, minimumLabel;
  double nominal = 0;
  double actual = 0;
  std::optional<double> maximum, minimum;  ///< nothing: not monitored
  Verdict verdict = Verdict::None;

  double deviation() const { return actual - nominal; }
};

/// A position that may deviate by `tolerance` to either side (0: not monitored); outside it the part is scrap.
Inspected inspectedPosition(int parameter, int deviationParameter, std::string label, double nominal, double actual,
                            double tolerance);

/// A dimension between `minimum` and `maximum` (0: not monitored on that side). Inside: too large is scrap, too small
/// rework; outside the other way round.
Inspected inspectedDimension(int parameter, int deviationParameter, std::string label, std::string limitLabel,
                             double nominal, double actual, double maximum, double minimum, Side side);

/// A coordinate, which may be limited by 0 too: only two zeros switch the monitoring off.
Inspected inspectedCoordinate(int parameter, std::string label, std::string limitLabel, double nominal, double actual,
                              double maximum, double minimum, Side side);

/// A line of the log without nominal value; mm or degrees.
struct LogLine {
  std::string label;
  double value = 0;
  ValueKind kind = ValueKind::Length;
};

struct Inspection {
  std::string title;  ///< "Hole Measuring"
  std::vector<Inspected> items;
  std::vector<LogLine> measured;  ///< actual values that have no nominal value
  std::vector<LogLine> further;   ///< further results
};

/// The worst verdict of the items; Good if nothing is monitored.
Verdict verdictOf(const Inspection& inspection);

struct ToolMonitoring;

/// Sets the result and status parameters Q180 to Q182, writes the log as Q281 says, monitors and corrects the tool as
/// Q330 says, and stops as Q309 says. In this order, results first.
void finishInspection(Context& context, const Inspection& inspection, const ToolMonitoring& tool);

/// Writes or shows the log as Q281 says.
void writeLog(Context& context, const Inspection& inspection);

/// The text (UTF-8) of a measuring log in the layout of the control and in its conversational language: all values end
/// in one column, with 4 decimals, in inch programs with 5.
std::string logText(Context& context, const Inspection& inspection);

}  // namespace probewright::cycles::heidenhain
