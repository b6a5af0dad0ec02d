#pragma once

#include <optional>
#include <string>
#include <vector>

/// Where the results of measuring cycles are shown and logged.
namespace probewright::control::sinumerik {

struct MeasuringLog {
  enum class Form {
    Text,  ///< a paragraph a measurement, values in columns
    Table  ///< semicolon-separated values, one value a line, for spreadsheets
  };
  std::string file;  ///< name without folder
  Form form = Form::Text;
  int entries = 0;  ///< measurements in it so far
};

struct ResultOutput {
  std::optional<int> display;              ///< what CYCLE150 says instead of $SCS_MEA_RESULT_DISPLAY
  std::vector<MeasuringLog> logs;          ///< open from the start of the program
  std::optional<MeasuringLog> programLog;  ///< what CYCLE150 opened last
};

}  // namespace probewright::control::sinumerik
