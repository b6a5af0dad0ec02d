#include <algorithm>
#include <array>

#include "control/sinumerik/control.hpp"
#include "cycles/sinumerik/cycles.hpp"
#include "cycles/sinumerik/measuring_log.hpp"
#include "cycles/sinumerik/parameters.hpp"

namespace probewright::cycles::sinumerik {

namespace {

constexpr Parameter parameters150[] = {
    parameters::code(0, "S_PICT",
                     "result screen; units: 0 off, 1 on; tens: 1 for 8 s, 3 until NC start, 4 with tolerance alarms",
                     0),
    parameters::code(1, "S_PROT",
                     "measuring log; units: 0 off, 1 on, 2 the last measurement only; hundreds: 0 text, 1 table; "
                     "thousands: 0 new file, 1 append",
                     0),
    {.name = "S_PATH",
     .address = 2,
     .meaning = "name of the log file",
     .kind = ValueKind::Text,
     .controls = control::onSinumerik},
};

int digitOf(int value, int place) {
  for (int i = 1; i < place; ++i)
    value /= 10;
  return value % 10;
}

/// The name without folders, with the ending of its form. Characters that file names do not take become '_'.
std::string fileNameOf(const std::string& path, MeasuringLog::Form form) {
  std::string name = path.substr(path.find_last_of("/\\") + 1);
  name = name.substr(0, name.find_last_of('.'));
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) == 0 && c != '_' && c != '-') c = '_';
  }
  if (name.empty()) name = "MEASPROT";
  return name + (form == MeasuringLog::Form::Text ? ".TXT" : ".CSV");
}

}  // namespace

const CycleDefinition cycle150Definition{
    .number = 150,
    .name = "CYCLE150",
    .title = "Result screen and measuring log",
    .family = CycleFamily::Special,
    .summary =
        "Says for the measuring cycles that follow whether their results are shown and logged, and how. "
        "Measures nothing.",
    .parameters = parameters150,
    .results = {},
    .controls = control::onSinumerik,
};

void setMeasuringLog(Control& control, const Arguments& arguments) {
  const int screen = arguments.integer(0), log = arguments.integer(1);
  control::sinumerik::ResultOutput& output = control.output;
  output.display = digitOf(screen, 1) == 0 ? 0 : std::max(digitOf(screen, 2), 1);
  const int state = digitOf(log, 1);
  if (state == 0) {
    output.programLog.reset();
    return;
  }
  MeasuringLog opened;
  opened.form = digitOf(log, 3) == 1 ? MeasuringLog::Form::Table : MeasuringLog::Form::Text;
  opened.file = fileNameOf(arguments.text(2), opened.form);
  const bool append = digitOf(log, 4) == 1;
  const bool exists = control.panel.files().contains(opened.file);
  if (append && output.programLog && output.programLog->file == opened.file) {
    opened.entries = output.programLog->entries;
  } else if (append && exists) {
    opened.entries = 1;  // the heading is there
  } else if (exists) {
    control.panel.file(opened.file, {});
  }
  output.programLog = opened;
  if (state != 2) return;
  auto& cycles = control.journal.cycles;
  if (!cycles.empty()) {
    addToLog(control, *output.programLog, cycles.back());
    cycles.back().logFiles.push_back(opened.file);
  }
  output.programLog.reset();
}

}  // namespace probewright::cycles::sinumerik
