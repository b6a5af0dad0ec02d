#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "control/alarm.hpp"
#include "control/sinumerik/master_spindle.hpp"
#include "control/sinumerik/text.hpp"
#include "control/tool_spindle.hpp"
#include "execution/sinumerik/functions.hpp"
#include "execution/sinumerik/host.hpp"
#include "execution/sinumerik/spindle_speed.hpp"
#include "language/sinumerik/check.hpp"
#include "language/sinumerik/commands.hpp"

/// What SINUMERIK blocks order besides motions and G functions: tools, M functions, frames, messages.
namespace probewright::execution::sinumerik {

using control::Alarm;
using control::EventKind;
using control::sinumerik::AxisValue;
using control::sinumerik::Frame;

// ---- tools ----

void SinumerikHost::carryOut(const ToolCall& call, Evaluation& evaluation) {
  motion_.flush();
  int number = 0;
  const Operand& operand = call.name.present() ? call.name : call.number;
  const Value value = evaluation.value(operand);
  if (const auto* text = std::get_if<std::string>(&value)) {
    number = text->empty() || *text == "0" ? 0 : control_.toolNumbered(*text);
  } else {
    number = wholeNumber(std::get<double>(value));
  }
  if (number < 0)
    throw Alarm("17190", fmt::format("T{}: the number of a tool is 0 or more", number), "correct the number");
  if (call.index.present() && wholeNumber(evaluation.number(call.index)) != 1)
    return skip(fmt::format("T{}=", wholeNumber(evaluation.number(call.index))));
  preparedTool_ = number;
  // Turrets (machines without Y) change with T, magazines with M6.
  const bool turret = !control_.channel.description().axisIndex("Y");
  const bool changesWithM6 = control_.machineData("$MC_TOOL_CHANGE_MODE", turret ? 0 : 1) != 0;
  if (!changesWithM6) changeTool();
}

void SinumerikHost::changeTool() {
  if (preparedTool_ < 0) return;
  control_.loadTool(preparedTool_);
  preparedTool_ = -1;
  if (edgeAfterChange_) control_.selectEdge(*edgeAfterChange_);
  edgeAfterChange_.reset();
  control_.handOverFrames();
}

void SinumerikHost::carryOut(const MachineFunction& function, Evaluation& evaluation) {
  int number = function.number;
  int spindle = masterSpindle(control_);
  if (number < 0) {
    number = wholeNumber(evaluation.number(function.argument));
    const auto index = evaluation.words(function.words);
    if (!index.empty()) spindle = wholeNumber(evaluation.number(index[0].value));
  } else if (function.argument.present()) {
    spindle = wholeNumber(evaluation.number(function.argument));
  }
  const bool main = spindle == control::sinumerik::mainSpindle;
  switch (number) {
    case 3:
    case 4:
    case 5:
      if (!main) return turnTool(spindle, number);
      state_.spindleDirection = number;
      takeSpeedOfBlock(evaluation);
      return turnSpindle();
    case 6:
      motion_.flush();
      return changeTool();
    case 19:
      return orientSpindle(spindle, control_.machineData("$SA_M19_SPOS"), WordMode::Absolute);
    default:
      if (main && handToMachine(number)) return;
      if (isSkippedMachineFunction(number)) skip(fmt::format("M{}", number));
      return;
  }
}

/// S acts together with M3 and M4 of its block, wherever it stands: the spindle never starts with the speed before.
void SinumerikHost::takeSpeedOfBlock(Evaluation& evaluation) {
  if (block_ == nullptr) return;
  for (const auto& instruction : block_->instructions) {
    const auto* modal = std::get_if<Modal>(&instruction);
    if (modal == nullptr || block_->at(modal->name) != "S") continue;
    const auto words = evaluation.words(modal->words);
    const bool ofMaster = !words.empty() && words[0].address == addressOf("S") &&
                          masterSpindle(control_) == control::sinumerik::mainSpindle;
    const bool ofMain = !words.empty() && words[0].address == addressOf("S1");
    if (words.size() == 1 && (ofMaster || ofMain)) state_.spindleSpeed = evaluation.number(words[0].value);
  }
}

/// M3, M4 and M5 of the spindle that drives tools; nothing of a spindle that the machine does not have.
void SinumerikHost::turnTool(int spindle, int function) {
  using machine::Rotation;
  auto* driven = control::toolSpindleOf(control_.channel);
  if (driven == nullptr || spindle != control::sinumerik::drivenTools) return;
  motion_.flush();
  const Rotation rotation = function == 5   ? Rotation::None
                            : function == 3 ? Rotation::Clockwise
                                            : Rotation::CounterClockwise;
  control::turnTool(control_.channel, *driven, rotation, std::max(0.0, toolSpeed_));
}

/// SPOS, M19.
void SinumerikHost::orientSpindle(int spindle, double degrees, WordMode mode) {
  const bool incremental = mode == WordMode::Incremental;
  motion_.flush();
  if (spindle == control::sinumerik::mainSpindle)
    return control_.channel.orientSpindle(incremental ? control_.channel.spindleAngle() + degrees : degrees);
  auto* driven = control::toolSpindleOf(control_.channel);
  if (driven == nullptr || spindle != control::sinumerik::drivenTools) return;
  control::orientTool(control_.channel, *driven, incremental ? driven->toolSpindle().angle + degrees : degrees);
}

/// S of the spindle that drives tools: one that turns follows it.
void SinumerikHost::setToolSpeed(int spindle, double speed) {
  if (spindle != control::sinumerik::drivenTools) return;
  toolSpeed_ = speed;
  auto* driven = control::toolSpindleOf(control_.channel);
  if (driven != nullptr && driven->toolSpindle().rotation != machine::Rotation::None)
    control::turnTool(control_.channel, *driven, driven->toolSpindle().rotation, std::max(0.0, speed));
}

/// True if the machine has carried out the M function.
bool SinumerikHost::handToMachine(int number) {
  if (!control_.channel.machine().hasFunction(number)) return false;
  const bool coolant = number >= 7 && number <= 9;  // which does not wait for what tool radius compensation holds back
  if (!coolant) motion_.flush();
  return control_.channel.function(number);
}

/// What M3, M4, M5, S, G96 and LIMS amount to where the tool is.
void SinumerikHost::turnSpindle() {
  using machine::Rotation;
  if (state_.spindleDirection == 5) return control_.channel.turnSpindle(Rotation::None, 0);
  control_.channel.turnSpindle(state_.spindleDirection == 3 ? Rotation::Clockwise : Rotation::CounterClockwise,
                               std::max(0.0, spindleSpeedAt(state_, control_.channel.position())));
}

/// A spindle that turns follows its speed; one that was oriented, or stopped by a tool change, waits for M3 or M4.
void SinumerikHost::followSpeed() {
  if (control_.channel.spindleRotation() != machine::Rotation::None) turnSpindle();
}

void SinumerikHost::carryOut(const Stop& stop, Evaluation&) {
  motion_.flush();
  control_.panel.stop(stop.optional ? "M1" : "M0", control_.channel.seconds());
}

// ---- frames ----

namespace {

/// The frame function that makes what the word stands for.
const char* functionOf(FrameChange change) {
  switch (change) {
    case FrameChange::Shift:
      return "CTRANS";
    case FrameChange::Turn:
      return "CROT";
    case FrameChange::TurnInSpace:
      return "CROTS";
    case FrameChange::Scale:
      return "CSCALE";
    case FrameChange::Mirror:
      return "CMIRROR";
    case FrameChange::PoleFromLastPosition:
    case FrameChange::PoleFromZero:
    case FrameChange::PoleFromPole:
    case FrameChange::CoarseShift:
    case FrameChange::FineShift:
      break;
  }
  throw std::logic_error("no frame function");
}

}  // namespace

/// From where G110, G111 and G112 count the pole; nothing of other words.
std::optional<Vector3> SinumerikHost::poleOrigin(FrameChange change) const {
  switch (change) {
    case FrameChange::PoleFromLastPosition:
      return motion_.lastPosition();
    case FrameChange::PoleFromZero:
      return Vector3(Vector3::Zero());
    case FrameChange::PoleFromPole:
      return state_.pole;
    default:
      return std::nullopt;
  }
}

/// Frames shift, scale and mirror axes that the machine has; those that leave an axis alone are let pass.
void SinumerikHost::requireAxisOfFrame(FrameChange change, const AxisValue& axis) const {
  const bool turns = change == FrameChange::Turn || change == FrameChange::TurnInSpace;  // these name their own mistake
  const bool neutral = change != FrameChange::Mirror && axis.value == (change == FrameChange::Scale ? 1 : 0);
  if (turns || neutral || control::sinumerik::geometryAxisOf(axis.axis)) return;
  if (control_.channel.description().axisIndex(axis.axis)) return;
  throw Alarm("12080", fmt::format("the machine has no axis {}", axis.axis),
              "the machine's description names its axes");
}

void SinumerikHost::carryOut(const Transform& transform, Evaluation& evaluation) {
  motion_.flush();
  const std::string_view name = evaluation.at(transform.name);
  const FrameChange change = language::sinumerik::frameChange(name);
  if (const auto from = poleOrigin(change)) return motion_.setPole(*from, transform.words, evaluation);
  std::vector<AxisValue> axes;
  std::optional<double> inPlane;
  std::string computed;
  for (const Word& word : evaluation.words(transform.words)) {
    if (word.address == addressOf("AX[]")) {
      computed = upperCase(evaluation.text(word.value));
      continue;
    }
    if (word.address == addressOf("IP[]"))
      throw Alarm("12080", fmt::format("{} takes axes, and IP is a parameter of arcs", name), "write AX[axis]=value");
    const double value = evaluation.number(word.value);
    if (word.address == addressOf("RPL")) {
      inPlane = value;
    } else {
      axes.push_back({word.address == addressOf("=AX") ? computed : addressName(word.address), value});
    }
  }
  for (const AxisValue& axis : axes)
    requireAxisOfFrame(change, axis);
  Frame& programmed = control_.frames.programmed;
  const auto scaleLengths = [&] {
    for (AxisValue& axis : axes)
      if (control::sinumerik::geometryAxisOf(axis.axis)) axis.value *= control_.unit;
  };
  if (change == FrameChange::CoarseShift || change == FrameChange::FineShift) {
    scaleLengths();
    for (const AxisValue& axis : axes)
      programmed.set(axis.axis,
                     change == FrameChange::CoarseShift ? control::sinumerik::FramePart::Translation
                                                        : control::sinumerik::FramePart::Fine,
                     axis.value);
    return control_.handOverFrames();
  }
  const bool additive = name.front() == 'A';
  if (change == FrameChange::Shift) scaleLengths();
  if (inPlane) axes.assign(1, {control_.plane == 18 ? "Y" : control_.plane == 19 ? "X" : "Z", *inPlane});
  const auto frame = control::sinumerik::frameFunction(functionOf(change), axes);
  if (!frame) throw Alarm("14020", fmt::format("{}: {}", name, frame.error().message), frame.error().advice);
  if (additive) {
    const auto chained = control::sinumerik::chain(programmed, *frame);
    if (!chained) throw Alarm("18314", chained.error().message, chained.error().advice);
    programmed = *chained;
  } else {
    programmed = *frame;
  }
  control_.handOverFrames();
}

// ---- commands ----

void SinumerikHost::skip(std::string_view what, std::string_view how) {
  if (options_.strict) throw Alarm("12550", fmt::format("{} {}", what, how), "run without --strict to skip it");
  if (!skipped_.insert(std::string(what)).second) return;
  control_.panel.message(EventKind::Skipped, fmt::format("{} {}", what, how), control_.channel.seconds());
}

/// Words that say nothing about where the tool goes, and those that do and are not carried out, which are named.
void SinumerikHost::leaveOut(const Command& command, Evaluation& evaluation) {
  const std::string_view name = evaluation.at(command.name);
  if (name == "SETMS") return selectMasterSpindle(command, evaluation);
  const KeywordEntry* entry = keywordEntry(name);
  if (entry != nullptr && entry->effect == Effect::Harmless) return;
  const std::string_view how = skippedFunction(name);
  if (entry == nullptr || entry->effect == Effect::CarriedOut) {
    if (!how.empty()) skip(name, how);  // G74
    return;
  }
  const auto words = evaluation.words(command.words);
  std::optional<double> value;
  if (!words.empty() && words[0].value.present()) {
    const Value first = evaluation.value(words[0].value);
    value = isText(first) ? 1 : std::get<double>(first);
  }
  if (!saysWhatIs(name, value)) skip(name, how);
}

/// SETMS(2), SETMS: the spindle that M3, S and SPOS mean from now on.
void SinumerikHost::selectMasterSpindle(const Command& command, Evaluation& evaluation) {
  const auto words = evaluation.words(command.words);
  const bool named = !words.empty() && words[0].value.present();
  const int number = named ? wholeNumber(evaluation.number(words[0].value)) : control::sinumerik::mainSpindle;
  const bool drives = number == control::sinumerik::drivenTools && control::toolSpindleOf(control_.channel) != nullptr;
  if (number != control::sinumerik::mainSpindle && !drives) return skip("SETMS");
  motion_.flush();
  control::sinumerik::setMasterSpindle(control_, number);
}

/// GETSELT(NUMBER): the tool that T has selected; GETEXET(NUMBER): the one that D belongs to.
void SinumerikHost::findTool(const Command& command, Evaluation& evaluation) {
  const auto words = evaluation.words(command.words);
  if (words.empty() || !words[0].value.present())
    throw Alarm("14020", fmt::format("{} needs a variable", evaluation.at(command.name)), "write an INT variable");
  const int selected = preparedTool_ >= 0 ? preparedTool_ : control_.tool.number;
  setVariable(words[0].value, static_cast<double>(selected), evaluation);
}

void SinumerikHost::carryOut(const Move& move, Evaluation& evaluation) {
  if (recording_) return;
  motion_.carryOut(move, evaluation);
  if (state_.constantCuttingSpeed) followSpeed();
}

void SinumerikHost::carryOut(const Command& command, Evaluation& evaluation) {
  const std::string_view name = evaluation.at(command.name);
  const auto words = evaluation.words(command.words);
  /// Of what may have the number of a spindle in brackets.
  const auto spindle = [&] {
    return words.size() < 2 ? masterSpindle(control_) : wholeNumber(evaluation.number(words[1].value));
  };
  const CommandKind kind = commandKind(name);
  switch (kind) {
    case CommandKind::Declare:
      return declare(command, evaluation);
    case CommandKind::Define:
      return;
    case CommandKind::Fill:
      return fill(command, evaluation);
    case CommandKind::Message: {
      const std::string text = words.empty() || !words[0].value.present() ? "" : evaluation.text(words[0].value);
      if (!text.empty()) control_.panel.message(EventKind::Message, text, control_.channel.seconds());
      return;
    }
    case CommandKind::StopPreprocessing:
      return motion_.flush();
    case CommandKind::GroupFunction:
      if (words.size() != 2) return;
      return carryOutGroup(wholeNumber(evaluation.number(words[1].value)),
                           wholeNumber(evaluation.number(words[0].value)));
    case CommandKind::RaiseAlarm:
      return raiseAlarm(command, evaluation);
    case CommandKind::Dwell:
      return dwell(command, evaluation);
    case CommandKind::FixedPoint:
      return motion_.approachFixedPoint(command, evaluation);
    case CommandKind::Measure:
      return motion_.measure(command, evaluation);
    case CommandKind::OrientSpindle:
      return orientSpindle(spindle(), evaluation.number(words[0].value), words[0].mode);
    case CommandKind::PositionAxis: {
      if (words.size() < 2) throw Alarm("12080", fmt::format("{} needs the axis in brackets", name), "write POS[X]=10");
      const std::string axis = upperCase(evaluation.text(words[1].value));
      return motion_.position(axis, words[0].mode, evaluation.number(words[0].value));
    }
    case CommandKind::SpeedLimit:
      if (spindle() != control::sinumerik::mainSpindle) return;
      state_.speedLimit = evaluation.number(words[0].value);
      return followSpeed();
    case CommandKind::AxisFeed:
      if (words.size() > 1)
        state_.axisFeed[upperCase(evaluation.text(words[1].value))] = evaluation.number(words[0].value);
      return;
    case CommandKind::WriteFile:
      return writeFile(command, evaluation);
    case CommandKind::ReadFile:
      return readFile(command, evaluation);
    case CommandKind::DeleteFile:
      return deleteFile(command, evaluation);
    case CommandKind::ExecuteText:
      return executeText(command, evaluation);
    case CommandKind::FindTool:
      return findTool(command, evaluation);
    case CommandKind::CircleThroughPoints:
      return circleThroughPoints(command, evaluation);
    case CommandKind::CallIsoProgram:
      throw Alarm("14011",
                  fmt::format("ISOCALL {}: programs of the ISO dialect are not available", evaluation.at(command.text)),
                  "write the program in the language of the control");
    case CommandKind::ToolLengthOffset:
    case CommandKind::ToolRadiusOffset: {
      if (words.size() > 1 && wholeNumber(evaluation.number(words[1].value)) != 1) return skip("TOFFL[2], TOFFL[3]");
      motion_.flush();
      control::sinumerik::ActiveTool& tool = control_.tool;
      (kind == CommandKind::ToolLengthOffset ? tool.programmedLength : tool.programmedRadius) =
          evaluation.number(words[0].value) * control_.unit;
      return control_.handOverFrames();
    }
    case CommandKind::OffsetNumber:
      motion_.flush();
      return control_.selectAdditiveOffset(evaluation.number(words[0].value));
    case CommandKind::BeginRecording:
      recording_ = true;
      return leaveOut(command, evaluation);
    case CommandKind::EndRecording:
      recording_ = false;
      return;
    case CommandKind::SynchronizedAction:
      return skip(fmt::format("the {} {}", name == "SETINT" ? "interrupt" : "synchronized action", name));
    case CommandKind::ReferencePoint:
    case CommandKind::Other:
      return leaveOut(command, evaluation);
  }
}

/// SETAL(number[, text]): 62000 to 63999 and 67000 to 69999 are shown and the program goes on; the others stop it.
void SinumerikHost::raiseAlarm(const Command& command, Evaluation& evaluation) {
  motion_.flush();
  const auto words = evaluation.words(command.words);
  if (words.empty() || !words[0].value.present()) throw Alarm("14020", "SETAL needs the number of an alarm");
  const int number = wholeNumber(evaluation.number(words[0].value));
  if (number < 60000 || number > 69999)
    throw Alarm("14020", fmt::format("SETAL({}): alarms of programs have the numbers 60000 to 69999", number));
  const std::string given = words.size() > 1 && words[1].value.present() ? evaluation.text(words[1].value) : "";
  const std::string text = given.empty() ? "alarm of the program" : given;
  const bool goesOn = (number >= 62000 && number < 64000) || number >= 67000;
  if (!goesOn) throw Alarm(std::to_string(number), text);
  control_.panel.message(EventKind::Warning, text, control_.channel.seconds(), std::to_string(number));
}

void SinumerikHost::dwell(const Command& command, Evaluation& evaluation) {
  motion_.flush();
  for (const Word& word : evaluation.words(command.words)) {
    const double value = evaluation.number(word.value);
    if (!(value >= 0)) throw Alarm("14020", "G4 cannot wait for a negative time");
    if (word.address == addressOf("F")) control_.channel.dwell(value);
    const double speed = spindleSpeedAt(state_, control_.channel.position());
    if (word.address == addressOf("S") && speed > 0) control_.channel.dwell(value / speed * 60);
  }
}

/// EXECSTRING(text): carries the text out as a block of the program.
void SinumerikHost::executeText(const Command& command, Evaluation& evaluation) {
  const auto words = evaluation.words(command.words);
  if (words.empty() || !words[0].value.present())
    throw Alarm("14020", "EXECSTRING needs the text of a block", "write EXECSTRING(\"R1=5\")");
  const std::string text = evaluation.text(words[0].value);
  const auto refuse = [&](const std::string& why, const std::string& advice) {
    throw Alarm("12080", fmt::format("EXECSTRING(\"{}\"): {}", text, why), advice);
  };
  BlockParser parser;
  Block block;
  block.position = evaluation.block().position;
  Diagnostics mistakes;
  parser.parse(text, evaluation.place(), block, mistakes);
  if (!mistakes.empty()) refuse(mistakes.front().message, mistakes.front().advice);
  Evaluation inner(evaluation.program(), block, *this);
  for (const Instruction& instruction : block.instructions) {
    const auto* statement = std::get_if<Command>(&instruction);
    const std::string_view name = statement == nullptr ? std::string_view() : block.at(statement->name);
    const bool belongsToProgram = name == "DEF" || name == "DEFINE" || name == "PROC" || name == "EXTERN";
    const auto* call = std::get_if<CallProgram>(&instruction);
    const bool flow = std::holds_alternative<Jump>(instruction) || std::holds_alternative<RepeatSection>(instruction) ||
                      std::holds_alternative<Return>(instruction) || std::holds_alternative<EndProgram>(instruction) ||
                      std::holds_alternative<Structured>(instruction) ||
                      (call != nullptr && (call->modal || call->from.length != 0));
    if (flow || belongsToProgram || name == "EXECSTRING")
      refuse("jumps, loops, definitions and ends of programs cannot be carried out from a text",
             "write the block into the program");
    if (call != nullptr) {
      callFromText(*call, inner);
    } else {
      execute(instruction, inner);
    }
  }
}

/// A program beside the caller comes before a cycle of its name, as where the call is in the program itself.
void SinumerikHost::callFromText(const CallProgram& call, Evaluation& evaluation) {
  const std::string name(call.nameValue.present() ? evaluation.text(call.nameValue)
                                                  : std::string(evaluation.at(call.name)));
  if (!options_.callProgram || !options_.fileExists || !options_.fileExists(name)) return carryOut(call, evaluation);
  if (call.arguments.count != 0)
    throw Alarm("12080", fmt::format("EXECSTRING calls the program {} with arguments, which is not available", name),
                "write the call into the program");
  motion_.flush();
  callAside(name);
}

/// Runs a program that no block calls and comes back to the block that is under way; false if there is none.
bool SinumerikHost::callAside(std::string_view name) {
  const Block* const block = block_;
  const SourcePlace place = control_.panel.place;
  const bool called = options_.callProgram(name, levels_.back().program);
  block_ = block;
  control_.panel.place = place;
  if (!called) return false;
  lastProgram_ = levels_.back().program;
  motion_.flush();
  return true;
}

}  // namespace probewright::execution::sinumerik
