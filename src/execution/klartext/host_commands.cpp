#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "execution/klartext/excerpt.hpp"
#include "execution/klartext/host.hpp"
#include "language/klartext/global_groups.hpp"
#include "language/klartext/lexer.hpp"

/// FN functions and all blocks that are neither motion nor transformation nor cycle.
namespace probewright::language::klartext {

using control::Alarm;
using namespace std::string_view_literals;

void KlartextHost::leaveOut(const std::string& what) {
  if (options_.strict) {
    throw Alarm("Function not available", fmt::format("{} is not simulated", what), "run without --strict to skip it");
  }
  if (!leftOut_.insert(what).second) return;
  control_.panel.message(control::EventKind::Skipped, fmt::format("{} is not simulated and was skipped", what),
                         control_.channel.seconds());
}

void KlartextHost::warn(std::string text) {
  control_.panel.message(control::EventKind::Warning, std::move(text), control_.channel.seconds());
}

void KlartextHost::message(std::string text) {
  control_.panel.message(control::EventKind::Message, std::move(text), control_.channel.seconds());
}

/// FUNCTION blocks other than TCPM. Feed, spindle, collision monitoring, counters and lift off leave alone where the
/// tool is, but COUNT REPEAT jumps. MODE MILL is what a run has anyway; all other modes change coordinates or
/// kinematics. What was never switched on need not be switched off.
void KlartextHost::functionBlock(std::string_view text, Evaluation& evaluation) {
  static constexpr std::array<std::string_view, 9> harmless = {"TURNDATA SPIN", "FEED",    "S-PULSE", "SPINDLE", "AFC",
                                                               "DCM",           "LIFTOFF", "COUNT",   "ACC"};
  const auto begins = [&](std::string_view word) {
    return text.size() >= word.size() && std::ranges::equal(text.substr(0, word.size()), word, {}, upper);
  };
  if (begins("MODE")) {
    std::string_view mode = text.substr(4);
    while (!mode.empty() && isBlank(mode.front()))
      mode.remove_prefix(1);
    while (!mode.empty() && isBlank(mode.back()))
      mode.remove_suffix(1);
    const auto is = [&](std::string_view name) { return std::ranges::equal(mode, name, {}, upper); };
    control_.turningMode =
        is("TURN") || (mode.size() > 4 && std::ranges::equal(mode.substr(0, 4), "TURN"sv, {}, upper));
    if (!is("MILL")) leaveOut(fmt::format("FUNCTION MODE {}", mode));
  } else if (begins("DWELL TIME") || begins("DWELL REV")) {
    contour_.flush();
    const bool revolutions = begins("DWELL REV");
    std::string_view time = text.substr(revolutions ? 9 : 10);
    while (time.starts_with(' '))
      time.remove_prefix(1);
    const auto written = parseDecimal(time);
    const double value = written ? *written : numberNamed(time, evaluation);
    const double speed = control_.tool.spindleSpeed;
    const bool turns = control_.channel.spindleRotation() != machine::Rotation::None;
    if (revolutions && !(turns && speed > 0)) {
      throw Alarm("Dwell time wrong", "FUNCTION DWELL REV counts revolutions, and the spindle stands",
                  "switch the spindle on before this block, or program FUNCTION DWELL TIME");
    }
    dwell(revolutions ? 60 * value / speed : value);
  } else if (begins("COUNT REPEAT") || (std::ranges::none_of(harmless, begins) && !endsWithWord(text, "OFF"))) {
    leaveOut(fmt::format("FUNCTION {}", text));
  }
}

/// An hour is the longest time that the control waits.
void KlartextHost::dwell(double seconds) {
  constexpr double longest = 3600;
  if (!(seconds >= 0 && seconds <= longest)) {
    throw Alarm("Dwell time wrong", fmt::format("A dwell time of {} s is not possible", formatShortest(seconds)),
                "program a time from 0 to 3600 seconds");
  }
  control_.channel.dwell(seconds);
}

/// FN 15: PRINT 12/Q5/QS1 adds a line to %FN15RUN.A: numbers with their sign, a decimal comma and up to four decimals.
void KlartextHost::print(std::string_view text, Evaluation& evaluation) {
  if (control_.isTNC640()) {
    message(fmt::format("FN 15: {}", text));
    return;
  }
  const auto numberText = [](double number) {
    std::string written = formatSigned(number, 4);
    written.erase(written.find_last_not_of('0') + 1);
    if (written.ends_with('.')) written.pop_back();
    std::ranges::replace(written, '.', ',');
    return written;
  };
  std::string line;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = std::min(rest.find('/'), rest.size());
    std::string_view item = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    while (!item.empty() && isBlank(item.front()))
      item.remove_prefix(1);
    while (!item.empty() && isBlank(item.back()))
      item.remove_suffix(1);
    if (item.empty()) continue;
    const auto number = parseDecimal(item.starts_with('+') ? item.substr(1) : item);
    if (!number && upper(item.front()) != 'Q' && !item.starts_with("+Q")) {
      throw Alarm("FN 15: value wrong", fmt::format("{} is neither a number nor a Q parameter", excerptOf(item)),
                  "write FN 15: PRINT Q5/Q6");
    }
    const Value value = number ? Value(*number) : readNamed(item, evaluation);
    line.append(line.empty() ? "" : "  ");
    line += isText(value) ? std::get<std::string>(value) : numberText(std::get<double>(value));
  }
  control_.panel.appendToFile("%FN15RUN.A", line + "\n");
}

void KlartextHost::command(const Command& command, Evaluation& evaluation) {
  const std::string_view name = evaluation.at(command.name);
  const std::string_view text = evaluation.at(command.text);
  const auto first = [&]() -> const Word* {
    return command.words.count == 0 ? nullptr : &evaluation.words(command.words).front();
  };
  if (name == "FN18") {
    contour_.flush();
    systemRead(command, evaluation);
  } else if (name == "FN17") {
    contour_.flush();
    systemWrite(command, evaluation);
  } else if (name == "FN16") {
    contour_.flush();
    protocol(command, evaluation);
  } else if (name == "FN14") {
    contour_.flush();
    const long number = std::lround(evaluation.number(first()->value));
    throw Alarm(fmt::format("FN 14: ERROR = {}", number),
                fmt::format("The program stops with its own error message {}", number),
                "look in the program why it jumps to this FN 14");
  } else if (name == "FN15") {
    print(text, evaluation);
  } else if (name == "SET UNDEFINED") {
    setUndefined(evaluation.block().variables[static_cast<std::size_t>(command.variable)]);
  } else if (name == "FN38") {
    send(text, evaluation);
  } else if (name == "FN23" || name == "FN24") {
    circleThroughPoints(command, evaluation);
  } else if (name == "FN25") {
    settle();
    setPresetInAxis(command, evaluation);
  } else if (name == "FN26") {
    openTable(text);
  } else if (name == "FN27") {
    writeTable(command, evaluation);
  } else if (name == "FN28") {
    readTable(command, evaluation);
  } else if (name == "CYCL DEF 9") {
    contour_.flush();
    if (const Word* time = first()) dwell(evaluation.number(time->value));
  } else if (name == "CYCL DEF 13") {
    contour_.flush();
    if (const Word* angle = first()) control_.channel.orientSpindle(evaluation.number(angle->value));
  } else if (name == "CYCL DEF 12" || name == "SEL CYCLE") {
    settle();
    defineCycle(12);
    cycleProgram_ = command.words.count > 0 ? evaluation.text(first()->value) : std::string(text);
  } else if (name == "CYCL CALL") {
    contour_.flush();
    callCycle(command, evaluation);
  } else if (name == "GLOBAL DEF") {
    const std::span<const Word> words = evaluation.words(command.words);
    if (!words.empty()) {
      const int group = static_cast<int>(evaluation.number(words[0].value));
      if (auto mistake = mistakeInGlobalDefinition(group, words.subspan(1)))
        throw Alarm("GLOBAL DEF wrong", std::move(mistake->message), std::move(mistake->advice));
    }
    for (std::size_t i = 1; i < words.size(); ++i) {
      const Value value = evaluation.value(words[i].value);
      if (isText(value)) continue;
      control_.globalDefinitions[static_cast<int>(words[i].address)] = {std::get<double>(value), control_.unit};
    }
  } else if (name == "TOOL DEF") {
    defineTool(command, evaluation);
  } else if (name == "SEL PGM") {
    selectedProgram_ = command.words.count > 0 ? evaluation.text(first()->value) : std::string(text);
  } else if (name == "SEL TABLE") {
    selectDatumTable(command.words.count > 0 ? evaluation.text(first()->value) : std::string(text));
  } else if (name == "PATTERN DEF") {
    definePattern(text, evaluation);
  } else if (name == "SEL PATTERN") {
    selectPattern(command.words.count > 0 ? evaluation.text(first()->value) : std::string(text));
  } else if (name == "FUNCTION") {
    functionBlock(text, evaluation);
  } else if (name.starts_with("TABDATA")) {
    tableData(command, evaluation);
  } else if (name == "SQL" || name == "FUNCTION RESET" || name.starts_with("SEL CORR-TABLE")) {
    leaveOut(text.empty() ? std::string(name) : fmt::format("{} {}", name, text));
  } else if (name == "FN37") {
    leaveOut("FN 37: EXPORT");
  } else if (name == "ERROR") {
    throw Alarm("Block marked as wrong", "The control marked this block as wrong when it read it (ERROR =)",
                "correct the block and take ERROR = away");
  } else if (name.starts_with("PRESET")) {
    presetCommand(name, command, evaluation);
  } else if (name.starts_with("F") && !name.starts_with("FN")) {
    throw Alarm("Function not available", fmt::format("Free contour programming ({}) is not available", name),
                "write the contour with L, C, CR and CT");
  }
}

/// Points from Qn on: main and minor axis of each; centre and radius into three parameters from the result on. Four
/// points: the circle of least squares.
void KlartextHost::circleThroughPoints(const Command& command, Evaluation& evaluation) {
  const int source = static_cast<int>(evaluation.number(evaluation.words(command.words).front().value));
  const int result =
      static_cast<int>(evaluation.block().variables[static_cast<std::size_t>(command.variable)].index[0].number);
  const int points = evaluation.at(command.name) == "FN23" ? 3 : 4;
  if (source + 2 * points > control::heidenhain::QParameters::count ||
      result + 3 > control::heidenhain::QParameters::count) {
    throw Alarm("Parameter number wrong", "CDATA needs more Q parameters than there are after its first one");
  }
  Eigen::MatrixXd equations(points, 3);
  Eigen::VectorXd squares(points);
  for (int i = 0; i < points; ++i) {
    const double x = control_.q.q(source + 2 * i);
    const double y = control_.q.q(source + 2 * i + 1);
    equations.row(i) << 2 * x, 2 * y, 1;
    squares[i] = x * x + y * y;
  }
  const auto factors = equations.colPivHouseholderQr();
  if (factors.rank() < 3) {
    throw Alarm("Circle not defined", "The points of CDATA lie on a line", "measure points that lie on a circle");
  }
  const Eigen::Vector3d solution = factors.solve(squares);
  control_.q.setQ(result, solution.x());
  control_.q.setQ(result + 1, solution.y());
  control_.q.setQ(result + 2, std::sqrt(solution.z() + solution.x() * solution.x() + solution.y() * solution.y()));
}

/// FN 25: the position with the coordinate given gets the new value.
void KlartextHost::setPresetInAxis(const Command& command, Evaluation& evaluation) {
  const std::span<const Word> words = evaluation.words(command.words);
  const char letter = static_cast<char>(words[0].address);
  if (letter < 'X' || letter > 'Z') {
    throw Alarm("Axis not permitted", fmt::format("FN 25 sets presets of X, Y and Z, not of {}", letter));
  }
  const double shift = length(words[0].value, evaluation) - length(words[1].value, evaluation);
  Vector3 along = Vector3::Zero();
  along[letter - 'X'] = shift;
  auto preset = control_.coordinates.preset;
  preset.origin += control_.coordinates.machineFromPreset().linear() * along;
  control::heidenhain::Control::PresetChange change;
  for (std::size_t i = 0; i < 3; ++i)
    change.origin[i] = preset.origin[static_cast<Eigen::Index>(i)];
  control_.writePreset(preset.row, change);
}

}  // namespace probewright::language::klartext
