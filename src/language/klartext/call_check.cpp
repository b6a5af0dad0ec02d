#include "language/klartext/call_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "cycles/catalogue.hpp"
#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/probe_words.hpp"
#include "language/klartext/commands.hpp"
#include "language/klartext/cycle_writer.hpp"
#include "metrology/tolerance.hpp"

namespace probewright::language::klartext {

namespace {

/// Parts of the old block form have words of their own in place of Q parameters.
constexpr std::uint32_t firstProbeWord = cycles::heidenhain::probe_word::result;

/// Q247 of the cycles that touch a circle.
constexpr std::uint32_t steppingAngle = 247;
constexpr double smallestStep = 5;  // degrees

/// Nominal positions and diameters of cycles 1410, 1411 and 1420, which may be texts such as "?30" and "10+0.02".
bool isDimension(std::uint32_t parameter) { return parameter >= 1100 && parameter <= 1117; }

/// Touch probe cycles that the controls have, whether Probewright runs them or not; 500 to 599 belong to machine tool
/// builders.
bool existsOnControls(int number) {
  constexpr std::pair<int, int> ranges[] = {{0, 4},     {9, 9},     {30, 33},   {400, 405}, {408, 427},  {430, 431},
                                            {440, 444}, {450, 463}, {480, 485}, {500, 601}, {1400, 1499}};
  return std::ranges::any_of(ranges, [&](const auto& r) { return number >= r.first && number <= r.second; });
}

std::string described(const cycles::Parameter& parameter) {
  return fmt::format("{} ({})", parameter.name, parameter.meaning);
}

}  // namespace

void CallCheck::remark(std::string message, std::string advice, Severity severity) {
  remarks_.push_back({nullptr, std::move(message), std::move(advice), severity, std::nullopt});
}

void CallCheck::remarkAt(const Word& word, std::string message, std::string advice, Severity severity) {
  remarks_.push_back({&word, std::move(message), std::move(advice), severity, std::nullopt});
}

std::vector<CallCheck::Remark> CallCheck::of(const Block& block, const CycleCall& call) {
  block_ = &block;
  remarks_.clear();
  const cycles::CycleDefinition* cycle = cycles::heidenhainCycle(call.number);
  if (cycle == nullptr && !existsOnControls(call.number)) {
    remark(fmt::format("there is no touch probe cycle {}", call.number),
           "check its number; list the available cycles with: probewright cycles");
    return std::exchange(remarks_, {});
  }
  if (cycle == nullptr) {
    remark(fmt::format("touch probe cycle {} is not available; its parameters are not checked", call.number),
           "list the available cycles with: probewright cycles", Severity::Warning);
    return std::exchange(remarks_, {});
  }
  if (!cycle->controls.contains(kind_)) {
    remark(fmt::format("cycle {} does not exist on the {}", cycle->name, control::name(kind_)),
           "use another cycle, or choose the other control");
    return std::exchange(remarks_, {});
  }
  const std::span<const Word> words =
      std::span<const Word>(block_->words).subspan(call.parameters.first, call.parameters.count);
  for (const Word& word : words)
    checkWord(*cycle, word);
  if (foresees_) {
    checkTogether(*cycle, words);
    checkState(*cycle);
  }
  for (const cycles::Parameter& parameter : cycle->parameters) {
    const bool needed = parameter.required() && parameter.controls.contains(kind_);
    if (!needed || std::ranges::find(words, parameter.address, &Word::address) != words.end()) continue;
    remark(fmt::format("cycle {} lacks {}", cycle->name, described(parameter)),
           fmt::format("add {} with its value", parameter.name));
    remarks_.back().lacking = parameter.address;
  }
  return std::exchange(remarks_, {});
}

const Node* CallCheck::nodeOf(const Word& word) const {
  return word.value.node >= 0 ? &block_->nodes[static_cast<std::size_t>(word.value.node)] : nullptr;
}

/// What a word says without the program running.
std::optional<cycles::Argument> CallCheck::literal(const Word& word) const {
  cycles::Argument argument;
  argument.given = true;
  if (word.value.isLiteral()) {
    argument.number = word.value.number;
    return argument;
  }
  const Node* node = nodeOf(word);
  if (node == nullptr || node->operation != Operation::Text) return std::nullopt;
  argument.isText = true;
  argument.text = block_->at(node->text);
  return argument;
}

void CallCheck::checkTogether(const cycles::CycleDefinition& cycle, std::span<const Word> words) {
  const auto wordOf = [&](std::uint32_t address) { return std::ranges::find(words, address, &Word::address); };
  const cycles::heidenhain::KnownValue known = [&](std::uint32_t address) -> std::optional<cycles::Argument> {
    if (const auto word = wordOf(address); word != words.end()) return literal(*word);
    const cycles::Parameter* parameter = cycle.parameter(address);
    if (parameter == nullptr || !parameter->standard) return std::nullopt;
    cycles::Argument standard;
    standard.number = *parameter->standard;
    return standard;
  };
  for (cycles::heidenhain::CallMistake& mistake : cycles::heidenhain::callMistakes(cycle, kind_, known)) {
    if (mistake.isBlank) continue;
    const auto word = wordOf(mistake.parameter);
    if (word == words.end()) {
      remark(std::move(mistake.message), std::move(mistake.advice), mistake.severity);
    } else {
      remarkAt(*word, std::move(mistake.message), std::move(mistake.advice), mistake.severity);
    }
  }
}

/// What the blocks before the cycle have left, as far as the way to it is plain.
void CallCheck::checkState(const cycles::CycleDefinition& cycle) {
  if (!plainWay_) return;
  const auto& conditions = cycles::heidenhain::findEntry(cycle.number)->conditions;
  if (!toolCalled_ && conditions.uses != cycles::heidenhain::Uses::Nothing) {
    const bool ofTool = conditions.uses == cycles::heidenhain::Uses::ToolTouchProbe;
    remark("there is no TOOL CALL before this cycle",
           fmt::format("call the {} first, unless it is in the spindle already or another program calls this one",
                       ofTool ? "tool to be measured" : "touch probe"),
           Severity::Warning);
    toolCalled_ = true;
  }
  const auto refused = [&](const std::string& active, std::string advice) {
    remark(fmt::format("cycle {} is refused here: {} is active", cycle.name, active), std::move(advice),
           Severity::Warning);
  };
  if (mode_ == "GRIND" || (mode_ == "TURN" && !conditions.turningMode))
    refused("FUNCTION MODE " + mode_, "program FUNCTION MODE MILL before it");
  if (!tilt_.empty() && !conditions.tilted.contains(kind_)) {
    const std::string end = tilt_.starts_with("PLANE") ? "PLANE RESET" : "cycle 19 with 0 degrees";
    refused(tilt_, fmt::format("program {} before it", end));
  }
  if (kind_ != control::ControlKind::TNC640) return;
  const auto forbidden = cycles::heidenhain::forbiddenTransformations(conditions);
  for (const auto& [number, active] : transforms_) {
    if (active.empty() || !(number == 7 ? forbidden.shift : number == 10 ? forbidden.rotation : forbidden.other))
      continue;
    refused(active, active.starts_with("TRANS") ? fmt::format("program {} RESET before it", active)
                                                : fmt::format("end {} before it", active));
  }
}

void CallCheck::follow(const ToolCall& call) {
  if (call.number.present() || call.name.present()) toolCalled_ = true;
}

void CallCheck::follow(const Block& block, const Command& command) {
  constexpr std::string_view mode = "MODE ";
  const CommandKind kind = kindOf(block, command);
  // CYCL CALL then calls a program.
  if (kind == CommandKind::ProgramCall || kind == CommandKind::SelectCycle) wayBranches();
  if (kind == CommandKind::GlobalDefinition) {
    for (std::uint32_t i = 0; i < command.words.count; ++i)
      globallyDefined_.insert(block.words[command.words.first + i].address);
  }
  if (kind != CommandKind::Function) return;
  const std::string text = upperCase(block.at(command.text));
  if (!text.starts_with(mode)) return;
  const std::string_view named = std::string_view(text).substr(mode.size());
  mode_ = named.starts_with("TURN") ? "TURN" : named.starts_with("GRIND") ? "GRIND" : "";
}

/// Cycles 7, 8, 10, 11 and 26, and TRANS, which changes what they have set: active, ended, or unknown because the
/// program computes their values.
void CallCheck::follow(const Block& block, const Transform& transform) {
  block_ = &block;
  int number = 0;
  std::string name;
  switch (kindOf(*block_, transform)) {
    case TransformKind::DatumShift:
      number = 7;
      break;
    case TransformKind::Mirror:
      number = 8;
      break;
    case TransformKind::Rotation:
      number = 10;
      break;
    case TransformKind::Scaling:
      number = 11;
      break;
    case TransformKind::AxisScaling:
      number = 26;
      break;
    case TransformKind::PresetByCycle:
      transforms_.clear();
      return;
    case TransformKind::TransDatumAxis:
      number = 7, name = "TRANS DATUM";
      break;
    case TransformKind::TransMirror:
      number = 8, name = "TRANS MIRROR";
      break;
    case TransformKind::TransRotation:
      number = 10, name = "TRANS ROTATION";
      break;
    case TransformKind::TransScale:
      transforms_.erase(26);
      number = 11, name = "TRANS SCALE";
      break;
    case TransformKind::TransDatumTable:
    case TransformKind::TransDatumReset:
      transforms_.erase(7);
      return;
    case TransformKind::TransMirrorReset:
      transforms_.erase(8);
      return;
    case TransformKind::TransRotationReset:
      transforms_.erase(10);
      return;
    case TransformKind::TransScaleReset:
      transforms_.erase(11);
      transforms_.erase(26);
      return;
    case TransformKind::Tilting:
    case TransformKind::PlaneSpatial:
    case TransformKind::PlaneProjected:
    case TransformKind::PlaneEuler:
    case TransformKind::PlaneVector:
    case TransformKind::PlanePoints:
    case TransformKind::PlaneRelative:
    case TransformKind::PlaneAxial:
    case TransformKind::PlaneReset:
      followTilt(transform);
      return;
  }
  if (name.empty()) name = fmt::format("cycle {}", number);
  const std::span<const Word> words =
      std::span<const Word>(block_->words).subspan(transform.words.first, transform.words.count);
  if (number == 8) {
    transforms_[8] = words.empty() ? "" : name;
    return;
  }
  const double neutral = number == 7 || number == 10 ? 0 : 1;
  bool active = false;
  for (const Word& word : words) {
    const auto value = literal(word);
    const bool centre = number == 26 && word.address >= 256;
    if (centre) continue;
    if (!value || value->isText || word.mode == WordMode::Incremental || word.address == '#') {
      transforms_.erase(number);
      return;
    }
    active = active || value->number != neutral;
  }
  // A shift keeps the axes that it does not name.
  if (!active && number == 7 && words.size() < 3) {
    transforms_.erase(number);
  } else {
    transforms_[number] = active ? name : "";
  }
}

/// Angles that lean the tool axis, written as numbers; of other descriptions only the run knows.
void CallCheck::followTilt(const Transform& transform) {
  tilt_.clear();
  const TransformKind kind = kindOf(*block_, transform);
  const bool cycle = kind == TransformKind::Tilting;
  const auto leans = [&](std::uint32_t address) {
    const std::string name = addressName(address);
    switch (kind) {
      case TransformKind::Tilting:
        return name == "A" || name == "B";
      case TransformKind::PlaneSpatial:
        return name == "SPA" || name == "SPB";
      case TransformKind::PlaneProjected:
        return name == "PROPR" || name == "PROMIN";
      case TransformKind::PlaneEuler:
        return name == "EULNU";
      default:
        return false;
    }
  };
  for (std::uint32_t i = 0; i < transform.words.count; ++i) {
    const Word& word = block_->words[transform.words.first + i];
    if (!leans(word.address) || word.mode == WordMode::Incremental) continue;
    const auto value = literal(word);
    if (value && !value->isText && value->number != 0) tilt_ = cycle ? "cycle 19" : nameOf(kind);
  }
}

void CallCheck::checkWord(const cycles::CycleDefinition& cycle, const Word& word) {
  const cycles::Parameter* parameter = cycle.parameter(word.address);
  if (parameter == nullptr) {
    if (word.address >= firstProbeWord) return;
    remarkAt(word, fmt::format("cycle {} has no parameter Q{}", cycle.name, word.address),
             "take it out, or check the number of the cycle");
    return;
  }
  if (!parameter->controls.contains(kind_)) {
    remarkAt(
        word,
        fmt::format("{} does not exist in cycle {} of the {}", described(*parameter), cycle.name, control::name(kind_)),
        "take it out");
    return;
  }
  cycles::Argument argument;
  argument.given = true;
  if (word.value.isLiteral()) {
    argument.number = word.value.number;
  } else {
    const Node* node = nodeOf(word);
    if (node == nullptr) return;
    if (node->operation == Operation::Call && node->function == Function::Host && block_->at(node->text) == "PREDEF") {
      if (!parameter->predefinable) {
        remarkAt(word, fmt::format("{} cannot be PREDEF", described(*parameter)), "write its value");
      } else if (foresees_ && plainWay_ && !globallyDefined_.contains(word.address)) {
        remarkAt(
            word, fmt::format("{} is PREDEF, but no GLOBAL DEF before it gives it a value", described(*parameter)),
            "program GLOBAL DEF before the cycle, unless another program that calls this one does, or write the value",
            Severity::Warning);
      }
      return;
    }
    const std::string_view perTurn = feedPerTurn(*block_, word);
    if (node->operation != Operation::Text && perTurn.empty()) return;  // computed while the program runs
    argument.isText = true;
    argument.text = perTurn.empty() ? block_->at(node->text) : perTurn;
  }
  std::string text = cycles::complaint(*parameter, argument, kind_);
  if (text.empty() && parameter->address == steppingAngle && std::abs(argument.number) < smallestStep) {
    text = fmt::format("{} cannot be {}", described(*parameter), formatShortest(argument.number));
  }
  if (text.empty() && argument.isText && isDimension(word.address)) {
    const auto dimension = metrology::parseDimension(argument.text);
    if (dimension) return;
    remarkAt(word, fmt::format("{} = \"{}\": {}", described(*parameter), argument.text, dimension.error().message),
             dimension.error().advice);
    return;
  }
  if (!text.empty()) remarkAt(word, std::move(text), "correct the value");
}

}  // namespace probewright::language::klartext
