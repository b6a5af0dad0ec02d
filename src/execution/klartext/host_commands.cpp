#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/number_text.hpp"
#include "base/truncated.hpp"
#include "control/alarm.hpp"
#include "execution/klartext/excerpt.hpp"
#include "execution/klartext/host.hpp"
#include "language/klartext/commands.hpp"
#include "language/klartext/global_groups.hpp"
#include "language/klartext/lexer.hpp"

/// FN functions and all blocks that are neither motion nor transformation nor cycle.
namespace probewright::execution::klartext {

using control::Alarm;
using namespace std::string_view_literals;

/// FUNCTION blocks other than TCPM. Feed, spindle, collision monitoring, counters and lift off leave alone where the
/// tool is, but COUNT REPEAT jumps. MODE MILL is what a run has anyway; all other modes change coordinates or
/// kinematics. What was never switched on need not be switched off.
void KlartextHost::functionBlock(std::string_view text) {
  static constexpr std::array<std::string_view, 9> harmless = {"TURNDATA SPIN", "FEED",    "S-PULSE", "SPINDLE", "AFC",
                                                               "DCM",           "LIFTOFF", "COUNT",   "ACC"};
  const auto begins = [&](std::string_view word) {
    return text.size() >= word.size() && std::ranges::equal(text.substr(0, word.size()), word, {}, upper);
  };
  if (begins("MODE")) {
    std::string_view mode = text.substr(4);
    mode = trimmed(mode, blanksAndReturn);
    const auto is = [&](std::string_view name) { return std::ranges::equal(mode, name, {}, upper); };
    control_.turningMode =
        is("TURN") || (mode.size() > 4 && std::ranges::equal(mode.substr(0, 4), "TURN"sv, {}, upper));
    control_.grindingMode = is("GRIND") || is("DRESS");
    if (!is("MILL")) run_.leaveOut(fmt::format("FUNCTION MODE {}", mode));
  } else if (begins("DWELL TIME") || begins("DWELL REV")) {
    motion_.flush();
    const bool revolutions = begins("DWELL REV");
    std::string_view time = text.substr(revolutions ? 9 : 10);
    while (time.starts_with(' '))
      time.remove_prefix(1);
    const auto written = parseDecimal(time);
    const double value = written ? *written : parameters_.numberNamed(time);
    const double speed = control_.tool.spindleSpeed;
    const bool turns = control_.channel.spindleRotation() != machine::Rotation::None;
    if (revolutions && !(turns && speed > 0)) {
      throw Alarm("Dwell time wrong", "FUNCTION DWELL REV counts revolutions, and the spindle stands",
                  "switch the spindle on before this block, or program FUNCTION DWELL TIME");
    }
    dwell(revolutions ? 60 * value / speed : value);
  } else if (begins("DRESS")) {
    control_.grindingMode = !endsWithWord(text, "END");
    run_.leaveOut(fmt::format("FUNCTION {}", text));
  } else if (begins("COUNT REPEAT") || (std::ranges::none_of(harmless, begins) && !endsWithWord(text, "OFF"))) {
    run_.leaveOut(fmt::format("FUNCTION {}", text));
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

void KlartextHost::defineGlobally(const Command& command, Evaluation& evaluation) {
  const std::span<const Word> words = evaluation.words(command.words);
  if (!words.empty()) {
    const int group = truncated(evaluation.number(words[0].value));
    if (auto mistake = mistakeInGlobalDefinition(group, words.subspan(1)))
      throw Alarm("GLOBAL DEF wrong", std::move(mistake->message), std::move(mistake->advice));
  }
  for (std::size_t i = 1; i < words.size(); ++i) {
    const Value value = evaluation.value(words[i].value);
    auto& defined = control_.globalDefinitions[static_cast<int>(words[i].address)];
    defined = {isText(value) ? 0 : std::get<double>(value), control_.unit,
               isText(value) ? std::get<std::string>(value) : std::string()};
  }
}

void KlartextHost::carryOut(const Command& command, Evaluation& evaluation) {
  const CommandKind kind = kindOf(evaluation.block(), command);
  const std::string_view text = evaluation.at(command.text);
  const Word* first = command.words.count == 0 ? nullptr : &evaluation.words(command.words).front();
  const auto path = [&] { return first != nullptr ? evaluation.text(first->value) : std::string(text); };
  switch (kind) {
    case CommandKind::Fn18:
      motion_.flush();
      systemData_.read(command, evaluation);
      break;
    case CommandKind::Fn17:
      motion_.flush();
      systemData_.write(command, evaluation);
      break;
    case CommandKind::Fn16:
      motion_.flush();
      protocol_.write(command, evaluation);
      break;
    case CommandKind::Fn14: {
      motion_.flush();
      const long number = std::lround(evaluation.number(first->value));
      throw Alarm(fmt::format("FN 14: ERROR = {}", number),
                  fmt::format("The program stops with its own error message {}", number),
                  "look in the program why it jumps to this FN 14");
    }
    case CommandKind::Fn15:
      protocol_.print(text);
      break;
    case CommandKind::Fn38:
      protocol_.send(text);
      break;
    case CommandKind::SetUndefined:
      parameters_.setUndefined(evaluation.block().variables[static_cast<std::size_t>(command.variable)]);
      break;
    case CommandKind::Fn23:
      circleThroughPoints(command, 3, evaluation);
      break;
    case CommandKind::Fn24:
      circleThroughPoints(command, 4, evaluation);
      break;
    case CommandKind::Fn25:
      motion_.settle();
      coordinateChanges_.setPresetInAxis(command, evaluation);
      break;
    case CommandKind::Fn26:
      tables_.open(text);
      break;
    case CommandKind::Fn27:
      tables_.write(command, evaluation);
      break;
    case CommandKind::Fn28:
      tables_.read(command, evaluation);
      break;
    case CommandKind::TabdataRead:
    case CommandKind::TabdataWrite:
    case CommandKind::TabdataAdd:
      motion_.settle();
      tables_.tableData(command, evaluation);
      break;
    case CommandKind::DwellTime:
      motion_.flush();
      if (first != nullptr) dwell(evaluation.number(first->value));
      break;
    case CommandKind::SpindleOrientation:
      if (first != nullptr) spindle_.setOrientation(evaluation.number(first->value));
      break;
    case CommandKind::ProgramCall:
    case CommandKind::SelectCycle:
      motion_.settle();
      cycles_.defineProgramCycle(path());
      break;
    case CommandKind::CycleCall:
      motion_.flush();
      cycles_.callCycle(command, evaluation);
      break;
    case CommandKind::GlobalDefinition:
      defineGlobally(command, evaluation);
      break;
    case CommandKind::ToolDefinition:
      tools_.defineTool(command, evaluation);
      break;
    case CommandKind::SelectProgram:
      run_.selectedProgram = path();
      break;
    case CommandKind::SelectTable:
      coordinateChanges_.selectDatumTable(path());
      break;
    case CommandKind::PatternDefinition:
      cycles_.definePattern(text);
      break;
    case CommandKind::SelectPattern:
      cycles_.selectPattern(path());
      break;
    case CommandKind::PresetSelect:
    case CommandKind::PresetCopy:
    case CommandKind::PresetCorrection:
      motion_.settle();
      coordinateChanges_.presetCommand(command, evaluation);
      break;
    case CommandKind::Function:
      functionBlock(text);
      break;
    case CommandKind::Sql:
    case CommandKind::FunctionReset:
    case CommandKind::SelectCorrectionTable:
    case CommandKind::SelectToolCorrectionTable:
    case CommandKind::SelectWorkpieceCorrectionTable:
      run_.leaveOut(text.empty() ? std::string(nameOf(kind)) : fmt::format("{} {}", nameOf(kind), text));
      break;
    case CommandKind::Fn37:
      run_.leaveOut("FN 37: EXPORT");
      break;
    case CommandKind::Error:
      throw Alarm("Block marked as wrong", "The control marked this block as wrong when it read it (ERROR =)",
                  "correct the block and take ERROR = away");
    case CommandKind::FreeLine:
    case CommandKind::FreeLineTangential:
    case CommandKind::FreeArc:
    case CommandKind::FreeArcTangential:
    case CommandKind::FreePole:
    case CommandKind::FreeSelection:
      throw Alarm("Function not available", fmt::format("Free contour programming ({}) is not available", nameOf(kind)),
                  "write the contour with L, C, CR and CT");
    // What these say leaves alone where the tool is and what is measured: graphics, headings, contours of machining
    // cycles, tolerance of milling, signals of the machine's PLC, files that are opened on the screen.
    case CommandKind::BeginProgram:
    case CommandKind::BlankForm:
    case CommandKind::Section:
    case CommandKind::Declare:
    case CommandKind::OpenFile:
    case CommandKind::Monitoring:
    case CommandKind::Tolerance:
    case CommandKind::Contour:
    case CommandKind::SelectContour:
    case CommandKind::Fn19:
    case CommandKind::Fn20:
    case CommandKind::Fn21:
    case CommandKind::Fn22:
    case CommandKind::Fn29:
      break;
  }
}

/// Points from Qn on: main and minor axis of each; centre and radius into three parameters from the result on. Four
/// points: the circle of least squares.
void KlartextHost::circleThroughPoints(const Command& command, int points, Evaluation& evaluation) {
  const int source = truncated(evaluation.number(evaluation.words(command.words).front().value));
  const int result =
      static_cast<int>(evaluation.block().variables[static_cast<std::size_t>(command.variable)].index[0].number);
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

}  // namespace probewright::execution::klartext
