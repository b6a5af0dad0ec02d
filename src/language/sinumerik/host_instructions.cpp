#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "control/alarm.hpp"
#include "control/sinumerik/text.hpp"
#include "language/sinumerik/check.hpp"
#include "language/sinumerik/functions.hpp"
#include "language/sinumerik/host.hpp"

/// What SINUMERIK blocks order besides motions: G and M functions, tools, frames, messages.
namespace probewright::sinumerik {

using namespace language;
using control::Alarm;
using control::EventKind;
using control::sinumerik::AxisValue;
using control::sinumerik::Frame;

namespace {

int wholeNumber(double value) { return static_cast<int>(std::lround(std::clamp(value, -2e9, 2e9))); }

std::optional<int> gNumber(std::string_view name) {
  int number = 0;
  if (name.size() < 2 || name[0] != 'G') return std::nullopt;
  const auto [end, error] = std::from_chars(name.data() + 1, name.data() + name.size(), number);
  if (error != std::errc() || end != name.data() + name.size()) return std::nullopt;
  return number;
}

}  // namespace

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

// ---- G functions ----

void SinumerikHost::carryOut(const Modal& modal, Evaluation& evaluation) {
  const std::string_view name = evaluation.at(modal.name);
  if (const std::string_view how = skippedFunction(name); !how.empty()) skip(name, how);
  if (const auto number = gNumber(name)) return carryOutG(*number);
  const auto words = evaluation.words(modal.words);
  if (name.size() == 1 && words.size() == 1) {
    const double value = evaluation.number(words[0].value);
    switch (name[0]) {
      case 'F':
        state_.feed = value;
        return;
      case 'S':
        state_.spindleSpeed = value;
        return;
      case 'D': {
        motion_.flush();
        const bool changesLater =
            preparedTool_ >= 0 && block_ != nullptr &&
            std::any_of(block_->instructions.begin(), block_->instructions.end(), [](const Instruction& each) {
              const auto* function = std::get_if<MachineFunction>(&each);
              return function != nullptr && function->number == 6;
            });
        if (changesLater) {
          edgeAfterChange_ = wholeNumber(value);
          return;
        }
        if (control_.tool.number == 0 && preparedTool_ > 0 && wholeNumber(value) > 0)
          throw Alarm("17180",
                      fmt::format("Illegal D number {}: tool {} is not yet in the spindle", value, preparedTool_),
                      "write D behind M6, or into its block");
        control_.selectEdge(wholeNumber(value));
        control_.handOverFrames();
        return;
      }
      default:
        return;
    }
  }
  carryOutNamedFunction(name, modal, evaluation);
}

void SinumerikHost::carryOutG(int number) {
  auto& groups = state_.gGroup;
  const auto settable = [&](int frame) {
    motion_.flush();
    control_.activateSettable(frame);
  };
  if (number >= 54 && number <= 57) {
    groups[8] = number - 52;
    return settable(number - 53);
  }
  if (number >= 505 && number <= 599) {
    groups[8] = number - 499;
    return settable(number - 500);
  }
  switch (number) {
    case 0:
    case 1:
    case 2:
    case 3: {
      static constexpr MoveKind kinds[] = {MoveKind::Rapid, MoveKind::Linear, MoveKind::ArcClockwise,
                                           MoveKind::ArcCounterclockwise};
      state_.group1 = kinds[number];
      groups[1] = number + 1;
      return;
    }
    case 33:
    case 34:
    case 35:
    case 63:
    case 331:
    case 332:
      state_.group1 = MoveKind::Linear;
      return;
    case 17:
    case 18:
    case 19:
      groups[6] = number - 16;
      motion_.flush();
      control_.plane = number;
      return control_.handOverFrames();
    case 40:
      return motion_.setCompensation(RadiusCompensation::Off);
    case 41:
      return motion_.setCompensation(RadiusCompensation::Left);
    case 42:
      return motion_.setCompensation(RadiusCompensation::Right);
    case 450:
    case 451:
      state_.cornerArc = number == 450;
      groups[18] = number - 449;
      return;
    case 70:
    case 700:
    case 71:
    case 710: {
      const bool inch = number == 70 || number == 700;
      control_.unit = inch ? 25.4 : 1;
      state_.feedInInch = number == 700;
      groups[13] = number == 70 ? 1 : number == 71 ? 2 : number == 700 ? 3 : 4;
      return;
    }
    case 90:
    case 91:
      state_.incremental = number == 91;
      groups[14] = number - 89;
      return;
    case 93:
    case 94:
    case 95:
    case 96:
    case 97:
      // A feed of one kind means nothing to another.
      if ((state_.feedType >= 95) != (number >= 95) || (state_.feedType == 93) != (number == 93)) state_.feed = 0;
      state_.feedType = number;
      groups[15] = number - 92;
      return;
    case 500:
      groups[8] = 1;
      return settable(0);
    default:
      return;
  }
}

void SinumerikHost::carryOutNamedFunction(std::string_view name, const Modal& modal, Evaluation& evaluation) {
  (void)modal;
  (void)evaluation;
  if (name == "DIAMON" || name == "DIAM90" || name == "DIAMOF" || name == "DIAMCYCOF") {
    control_.diameter = name == "DIAMON" || name == "DIAM90";
    state_.gGroup[29] = name == "DIAMON" ? 2 : name == "DIAM90" ? 3 : 1;
    return;
  }
  if (name == "TRAORI" || name == "TRAFOOF") {
    motion_.flush();
    control_.transformation = name == "TRAORI";
    control_.handOverFrames();
    return;
  }
  const bool withOrigin = name == "TOFRAME" || name == "TOFRAMEZ";
  if (withOrigin || name == "TOROT" || name == "TOROTZ") {
    motion_.flush();
    return alignFrameWithTool(withOrigin);
  }
  if (name == "TOROTOF") {
    motion_.flush();
    control_.frames.toolOriented = {};
    return control_.handOverFrames();
  }
}

/// TOROT: Z of the program lies along the tool, turned the shortest way; TOFRAME: and the tool tip is its origin.
void SinumerikHost::alignFrameWithTool(bool withOrigin) {
  Frame& frame = control_.frames.toolOriented;
  const Eigen::Affine3d program = control_.machineFromWorkpiece();
  const Vector3 along = program.linear() * control_.channel.toolAxis();
  const Vector3 tip = program * control_.channel.position();
  const Eigen::Affine3d outer =
      control_.machineFromBase() * control::sinumerik::transform(control_.frames.settableFrame);
  const Vector3 direction = (outer.linear().inverse() * along).normalized();
  Eigen::Affine3d turned = Eigen::Affine3d::Identity();
  turned.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), direction).toRotationMatrix();
  if (withOrigin) turned.translation() = outer.inverse() * tip;
  const auto aligned = control::sinumerik::frameFromTransform(turned);
  if (!aligned) throw Alarm("18314", aligned.error().message, aligned.error().advice);
  frame = *aligned;
  if (withOrigin) control_.frames.programmed = {};
  control_.handOverFrames();
}

void SinumerikHost::carryOut(const MachineFunction& function, Evaluation& evaluation) {
  int number = function.number;
  bool mainSpindle = true;
  if (number < 0) {
    number = wholeNumber(evaluation.number(function.argument));
  } else if (function.argument.present()) {
    mainSpindle = wholeNumber(evaluation.number(function.argument)) == 1;
  }
  switch (number) {
    case 3:
    case 4:
    case 5:
      if (mainSpindle) state_.spindleDirection = number;
      return;
    case 6:
      motion_.flush();
      return changeTool();
    case 19:
      motion_.flush();
      if (mainSpindle) control_.channel.orientSpindle(control_.machineData("$SA_M19_SPOS"));
      return;
    default:
      return;
  }
}

void SinumerikHost::carryOut(const Stop& stop, Evaluation&) {
  motion_.flush();
  control_.panel.stop(stop.optional ? "M1" : "M0", control_.channel.seconds());
}

// ---- frames ----

void SinumerikHost::carryOut(const Transform& transform, Evaluation& evaluation) {
  motion_.flush();
  const std::string_view name = evaluation.at(transform.name);
  if (name == "G110" || name == "G111" || name == "G112") return motion_.setPole(name, transform.words, evaluation);
  std::vector<AxisValue> axes;
  std::optional<double> inPlane;
  for (const Word& word : evaluation.words(transform.words)) {
    const double value = evaluation.number(word.value);
    if (word.address == addressOf("RPL")) {
      inPlane = value;
    } else {
      axes.push_back({addressName(word.address), value});
    }
  }
  Frame& programmed = control_.frames.programmed;
  const auto scaleLengths = [&] {
    for (AxisValue& axis : axes)
      if (control::sinumerik::geometryAxisOf(axis.axis)) axis.value *= control_.unit;
  };
  if (name == "G58" || name == "G59") {
    scaleLengths();
    for (const AxisValue& axis : axes)
      programmed.set(axis.axis,
                     name == "G58" ? control::sinumerik::FramePart::Translation : control::sinumerik::FramePart::Fine,
                     axis.value);
    return control_.handOverFrames();
  }
  const bool additive = name.front() == 'A';
  const std::string_view kind = additive ? name.substr(1) : name;
  const char* function = kind == "TRANS"    ? "CTRANS"
                         : kind == "ROT"    ? "CROT"
                         : kind == "SCALE"  ? "CSCALE"
                         : kind == "MIRROR" ? "CMIRROR"
                                            : "CROTS";
  if (kind == "TRANS") scaleLengths();
  if (inPlane) axes.assign(1, {control_.plane == 18 ? "Y" : control_.plane == 19 ? "X" : "Z", *inPlane});
  const auto frame = control::sinumerik::frameFunction(function, axes);
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

void SinumerikHost::carryOut(const Command& command, Evaluation& evaluation) {
  const std::string_view name = evaluation.at(command.name);
  const auto words = evaluation.words(command.words);
  if (name == "DEF") return declare(command, evaluation);
  if (name == "SET" || name == "REP") return fill(command, evaluation);
  if (name == "MSG") {
    const std::string text = words.empty() || !words[0].value.present() ? "" : evaluation.text(words[0].value);
    if (!text.empty()) control_.panel.message(EventKind::Message, text, control_.channel.seconds());
    return;
  }
  if (name == "STOPRE") return motion_.flush();
  if (name == "SETAL") return raiseAlarm(command, evaluation);
  if (name == "G4") return dwell(command, evaluation);
  if (name.starts_with("MEAS") || name.starts_with("MEAW")) return motion_.measure(command, evaluation);
  if (name == "SPOS" || name == "SPOSA") {
    motion_.flush();
    const bool main = words.size() < 2 || wholeNumber(evaluation.number(words[1].value)) == 1;
    const double angle = evaluation.number(words[0].value);
    const bool incremental = words[0].mode == WordMode::Incremental;
    if (main) control_.channel.orientSpindle(incremental ? control_.channel.spindleAngle() + angle : angle);
    return;
  }
  if (name == "POS" || name == "POSA") {
    if (words.size() < 2) throw Alarm("12080", "POS needs the axis in brackets", "write POS[X]=10");
    const std::string axis = control::sinumerik::upperCase(evaluation.text(words[1].value));
    return motion_.position(axis, words[0].mode, evaluation.number(words[0].value));
  }
  if (name == "FA" && words.size() > 1) {
    state_.axisFeed[control::sinumerik::upperCase(evaluation.text(words[1].value))] = evaluation.number(words[0].value);
    return;
  }
  if (name == "G75") return motion_.approachFixedPoint(command, evaluation);
  if (name == "WRITE") return writeFile(command, evaluation);
  if (name == "TOFFL" || name == "TOFFR") {
    const bool length = name == "TOFFL";
    if (words.size() > 1 && wholeNumber(evaluation.number(words[1].value)) != 1) return skip("TOFFL[2], TOFFL[3]");
    motion_.flush();
    (length ? control_.tool.programmedLength : control_.tool.programmedRadius) =
        evaluation.number(words[0].value) * control_.unit;
    return control_.handOverFrames();
  }
  if (name == "DL") {
    motion_.flush();
    control_.tool.dl = wholeNumber(evaluation.number(words[0].value));
    control_.refreshTool();
    return control_.handOverFrames();
  }
  if (keywordOf(name) == Keyword::SynchronizedAction) return skip(fmt::format("the synchronized action {}", name));
  static constexpr std::string_view noticed[] = {"G74",    "PRESETON", "READ",      "DELETE",   "EXECSTRING",
                                                 "REPOSA", "REPOSL",   "MMC",       "FTOCON",   "CONTPRON",
                                                 "NEWT",   "DELT",     "PRESETONS", "WORKPIECE"};
  if (name == "WORKPIECE") return;  // the blank of the simulation screen
  if (std::find(std::begin(noticed), std::end(noticed), name) != std::end(noticed)) return skip(name);
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
    if (word.address == addressOf("S") && state_.spindleSpeed > 0)
      control_.channel.dwell(value / state_.spindleSpeed * 60);
  }
}

/// WRITE(ERROR, "FILE", "text"): appends a line.
void SinumerikHost::writeFile(const Command& command, Evaluation& evaluation) {
  const auto words = evaluation.words(command.words);
  if (words.size() < 3 || !words[2].value.present() || words[0].value.node < 0)
    throw Alarm("14020", "WRITE takes a variable for the error, a file and a text",
                "write WRITE(ERR,\"FILE\",\"text\")");
  std::string file = evaluation.text(words[1].value);
  if (const std::size_t folder = file.find_last_of("/\\"); folder != std::string::npos) file.erase(0, folder + 1);
  if (file.empty() || file == "." || file == "..") throw Alarm("14020", "WRITE needs the name of a file");
  control_.panel.appendToFile(file, evaluation.text(words[2].value) + "\n");
  const Node& node = evaluation.block().nodes[static_cast<std::size_t>(words[0].value.node)];
  if (node.operation == Operation::Variable) write(evaluation.block().variables[node.a], 0.0, evaluation);
}

}  // namespace probewright::sinumerik
