#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "control/journal.hpp"
#include "records/run_info.hpp"

/// What a run has measured as one table, the base of all files for other programs: a row for each value that answers
/// what a cycle was called for.
namespace probewright::exchange {

/// One measured characteristic. Texts are UTF-8. Lengths in mm, angles in degrees, whatever the program counts in.
struct Row {
  std::size_t cycle = 1;  ///< which call of a cycle, counted over the run
  std::string cycleName;  ///< "421", "CYCLE977"
  std::string title;      ///< of the cycle
  std::string program;    ///< file name of the program that calls it
  std::uint64_t line = 0;
  std::string feature;         ///< what the program calls it; empty if it says nothing
  std::string result;          ///< where the control left it: "Q151", "_OVR[4]"
  std::string characteristic;  ///< "centre, main axis"
  control::Characteristic of;
  std::string unit;  ///< "mm", "deg" or empty
  double actual = 0;
  std::optional<double> nominal, lowerLimit, upperLimit, deviation;
  control::Verdict verdict = control::Verdict::None;
  double seconds = 0;  ///< from the start of the run to the end of the cycle
};

/// A call that ended with an alarm.
struct Failure {
  std::size_t cycle = 1;
  std::string cycleName, title, program, feature, alarm;
  std::uint64_t line = 0;
};

struct Inspection {
  std::vector<Row> rows;  ///< in the order of the run
  std::vector<Failure> failures;
  records::RunInfo run;  ///< its texts are UTF-8; programs without their texts
  control::Verdict verdict = control::Verdict::None;
};

/// Values that are not numbers are left out. The name of a feature is the structure block (`* - TEXT`) or the message
/// (`MSG("TEXT")`) that stands nearest above the call in its program.
Inspection inspectionOf(const control::Journal& journal, const records::RunInfo& run);

/// "421-2 Bore A: diameter": unique in a run, for formats in which a characteristic needs a name.
std::string nameOf(const Row& row);

/// When the cycle of a row ended, as ISO 8601 in UTC without offset; empty if the run does not say when it began.
std::string timeOf(const Row& row, const records::RunInfo& run);

}  // namespace probewright::exchange
