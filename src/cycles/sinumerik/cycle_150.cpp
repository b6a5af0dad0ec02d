#include <algorithm>
#include <array>
#include <charconv>

#include "base/text.hpp"
#include "control/alarm.hpp"
#include "control/sinumerik/control.hpp"
#include "cycles/sinumerik/context.hpp"
#include "cycles/sinumerik/measuring_log.hpp"
#include "cycles/sinumerik/parameters.hpp"

namespace probewright::cycles::sinumerik {

namespace {

constexpr Choice screens150[] = {{0, "result screen off"}, {1, "result screen on"}};
constexpr Choice waits150[] = {{0, "for 8 s"}, {1, "for 8 s"}, {3, "until NC start"}, {4, "with tolerance alarms"}};
constexpr CodeDigit screen150[] = {{1, 1, "screen", screens150}, {2, 1, "shown", waits150}};
constexpr Choice logs150[] = {{0, "log off"}, {1, "log on"}, {2, "log of the last measurement"}};
constexpr Choice kinds150[] = {{0, "standard log"}, {1, "user log, written as the standard one"}};
constexpr Choice forms150[] = {{0, "text"}, {1, "table"}};
constexpr Choice files150[] = {{0, "new file"}, {1, "append"}};
constexpr CodeDigit log150[] = {
    {1, 1, "log", logs150}, {2, 1, "kind", kinds150}, {3, 1, "form", forms150}, {4, 1, "file", files150}};

constexpr Parameter parameters150[] = {
    parameters::coded(0, "S_PICT", "result screen", screen150),
    parameters::coded(1, "S_PROT", "measuring log", log150),
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
    if (!isLetter(c) && !isDigit(c) && c != '_' && c != '-') c = '_';
  }
  if (name.empty()) name = "MEASPROT";
  return name + (form == MeasuringLog::Form::Text ? ".TXT" : ".CSV");
}

/// How many measurements a log holds: the number of the last one.
int entriesIn(const std::string& log, MeasuringLog::Form form) {
  const std::string_view behind = form == MeasuringLog::Form::Text ? "  " : ";";
  int entries = 0;
  for (std::size_t at = 0; at < log.size(); at = std::min(log.find('\n', at), log.size()) + 1) {
    int number = 0;
    const auto [end, error] = std::from_chars(log.data() + at, log.data() + log.size(), number);
    if (error != std::errc() || !std::string_view(end, log.data() + log.size()).starts_with(behind)) continue;
    entries = std::max(entries, number);
  }
  return entries;
}

constexpr CycleDefinition definition = {
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

void set(Control& control, const Arguments& arguments) {
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string mistake = codeComplaint(parameters150[i], arguments.values()[i]);
    if (!mistake.empty()) throw control::Alarm("12150", mistake, "see 'probewright cycles CYCLE150'");
  }
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
  const auto written = control.panel.files().find(opened.file);
  const bool exists = written != control.panel.files().end();
  if (append && exists) {
    opened.entries = entriesIn(written->second, opened.form);
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

}  // namespace

extern const Entry cycle150 = {.definition = definition, .set = set};

}  // namespace probewright::cycles::sinumerik
