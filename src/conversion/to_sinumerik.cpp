#include "conversion/to_sinumerik.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "conversion/modes.hpp"
#include "language/klartext/block_extent.hpp"
#include "language/klartext/commands.hpp"
#include "language/klartext/cycle_writer.hpp"

namespace probewright::conversion {

using namespace language;
using klartext::FramePart;

ToSinumerik::ToSinumerik(klartext::HeidenhainProgram& program, const Job* job, const TouchProbe& probe)
    : program_(program),
      job_(job == nullptr ? Job() : *job),
      out_(program.file()),
      graph_(program),
      probe_(probe),
      lackingRows_(program, graph_, job_, selectedRow) {
  if (job_.shares) formulas_.shareParameters();
}

std::string ToSinumerik::axis(std::size_t index) const {
  static constexpr const char* names[] = {"X", "Y", "Z"};
  const std::size_t tool = toolAxis_ == 'X' ? 0 : toolAxis_ == 'Y' ? 1 : 2;
  return names[(tool + 1 + index) % 3];
}

std::optional<std::size_t> ToSinumerik::planeIndex(std::uint32_t address) const {
  for (std::size_t i = 0; i < 3; ++i)
    if (addressOf(axis(i)) == address) return i;
  return std::nullopt;
}

void ToSinumerik::survey() {
  usedQ_ = job_.parameters;
  Block block;
  Diagnostics ignored;
  for (const auto& other : job_.others)
    for (BlockPosition at = other->begin(); other->parse(at, block, ignored); at = block.next)
      surveyOther(block);
  for (BlockPosition at = program_.begin(); program_.parse(at, block, result_.mistakes); at = block.next) {
    surveyRows(block);
    for (const VariableRef& variable : block.variables) {
      if (variable.space != VariableSpace::Q || !variable.index[0].isLiteral()) continue;
      usedQ_.insert(static_cast<int>(variable.index[0].number));
    }
    for (const Instruction& instruction : block.instructions) {
      callsTools_ = callsTools_ || std::holds_alternative<ToolCall>(instruction);
      if (const auto* call = std::get_if<CallLabel>(&instruction); call != nullptr && !call->repeats.present())
        calledLabels_.insert(std::string(block.at(call->label)));
      if (const auto* move = std::get_if<Move>(&instruction)) {
        if (move->kind == MoveKind::SetCentre) surveyCentre(block, *move);
        compensates_ = compensates_ || move->compensation == RadiusCompensation::Left ||
                       move->compensation == RadiusCompensation::Right;
      }
    }
  }
}

namespace {

/// The rows of the preset table that a block names by number: Q305 of cycles, Q339 of cycle 247.
std::vector<int> rowsOf(const Block& block) {
  std::vector<int> rows;
  const auto add = [&](const Word& word) {
    if (const auto row = literalOf(block, word.value)) rows.push_back(static_cast<int>(*row));
  };
  for (const Instruction& instruction : block.instructions) {
    if (const auto* cycle = std::get_if<CycleCall>(&instruction)) {
      constexpr std::uint32_t numberInTable = 305;
      for (std::uint32_t i = 0; i < cycle->parameters.count; ++i) {
        const Word& word = block.words[cycle->parameters.first + i];
        if (word.address == numberInTable) add(word);
      }
    } else if (const auto* change = std::get_if<Transform>(&instruction)) {
      if (klartext::kindOf(block, *change) == klartext::TransformKind::PresetByCycle && change->words.count > 0)
        add(block.words[change->words.first]);
    }
  }
  return rows;
}

bool namesRow99(const Block& block) {
  const std::vector<int> rows = rowsOf(block);
  return std::ranges::find(rows, 99) != rows.end();
}

}  // namespace

void ToSinumerik::surveyRows(const Block& block) {
  const std::vector<int> rows = rowsOf(block);
  if (std::ranges::find(rows, 0) == rows.end()) return;
  selectsRow0_ = true;
  cyclesSetRow0_ = cyclesSetRow0_ || std::holds_alternative<CycleCall>(block.instructions.front());
}

/// Whether this CC names the point that all others name.
void ToSinumerik::surveyCentre(const Block& block, const Move& move) {
  std::array<std::optional<double>, 2> point;
  for (std::uint32_t i = 0; i < move.words.count; ++i) {
    const Word& word = block.words[move.words.first + i];
    const auto index = planeIndex(word.address);
    if (index && *index < 2 && word.mode != WordMode::Incremental && word.value.isLiteral())
      point[*index] = word.value.number;
  }
  const bool whole = point[0] && point[1];
  if (!surveyedCentre_) surveyedCentre_ = point;
  oneCentre_ = oneCentre_ && whole && *surveyedCentre_ == point;
}

void ToSinumerik::surveyOther(const Block& block) {
  surveyRows(block);
  for (const Instruction& instruction : block.instructions) {
    constexpr int feedPerRevolution = 136;
    const auto* function = std::get_if<MachineFunction>(&instruction);
    const auto* move = std::get_if<Move>(&instruction);
    othersFeedPerRevolution_ =
        othersFeedPerRevolution_ || (function != nullptr && function->number == feedPerRevolution);
    othersCompensate_ = othersCompensate_ || (move != nullptr && (move->compensation == RadiusCompensation::Left ||
                                                                  move->compensation == RadiusCompensation::Right));
    if (move != nullptr && move->kind == MoveKind::SetCentre) oneCentre_ = false;  // in its own unit
  }
  compensates_ = compensates_ || othersCompensate_;
}

Conversion ToSinumerik::run() {
  survey();
  if (!hasErrors(result_.mistakes)) {
    surveyFlow();
    surveyModes();
    surveyPlaces();
    fromBeyondATurn_ = positionsFromBeyondATurn(program_, graph_, job_);
    if (program_.unit() == klartext::Unit::Inch) {
      millimetre_ = 1 / millimetresOfInch;
      ballRadius_ = ballRadius_ * millimetre_;
      formulas_.countInches();
    }
    formulas_.heedRoundings(RoundedValues(program_, job_));
    Diagnostics ignored;
    Block block;
    for (BlockPosition at = program_.begin(); program_.parse(at, block, ignored); at = block.next)
      write(block);
    if (!ended_) out_.line("M30");
    for (const std::string& line : head())
      result_.text += line + '\n';
    for (const std::string& line : out_.lines())
      result_.text += line + '\n';
    result_.notCarriedOver = std::move(out_.listed());
  }
  return std::move(result_);
}

std::vector<std::string> ToSinumerik::head() const {
  std::vector<std::string> lines = {fmt::format("; {}", program_.name())};
  for (const std::string& name : formulas_.declared()) {
    const bool text = name.starts_with("_QS");
    lines.push_back(fmt::format("DEF {} {}", text ? "STRING[254]" : "REAL", name));
  }
  lines.insert(lines.end(), callStack_.begin(), callStack_.end());
  if (job_.shares) lines.insert(lines.begin() + 1, std::string(sharedParametersRemark));
  const bool ofCaller = job_.called && !callsTools_;
  // What the caller has left in effect holds in a program that it calls.
  const bool keepsCompensation = job_.called && othersCompensate_, keepsFeed = job_.called && othersFeedPerRevolution_;
  lines.push_back(fmt::format("{}G90{} {}{}", ofCaller ? "" : "G17 ", keepsCompensation ? "" : " G40", unitWord(),
                              keepsFeed ? "" : " G94"));
  return lines;
}

void ToSinumerik::write(const Block& block) {
  const FramePart part = program_.framePart(block);
  if (part == FramePart::Begin || part == FramePart::End) return;
  if (block.instructions.empty()) return comment(block);
  adopt(block);
  const std::size_t before = out_.size();
  const Frame frame = frame_;
  const auto sharesText = [this](const VariableRef& variable) {
    return variable.space == VariableSpace::QS && variable.index[0].isLiteral() &&
           job_.texts.contains(static_cast<int>(variable.index[0].number));
  };
  if (!sharesText_ && std::ranges::any_of(block.variables, sharesText)) {
    sharesText_ = true;
    out_.list(
        block,
        "QS parameters are variables of this program alone: the programs that it calls or that call it have their own",
        "declare them as global user data, in a definition file");
  }
  if (selectsRow0_ && !listedRow99_ && namesRow99(block)) {
    listedRow99_ = true;
    out_.list(block, "row 99 becomes G599, which also stands for row 0 of this job", "use another row than 99");
  }
  try {
    for (const Instruction& each : block.instructions) {
      listCompensation(block, each);
      instruction(block, each);
    }
    const bool isCycle = std::ranges::any_of(
        block.instructions, [](const Instruction& each) { return std::holds_alternative<CycleCall>(each); });
    std::string remark = isCycle ? std::string() : klartext::commentOf(block);
    if (const std::size_t more = remark.find(" ~\n"); more != std::string::npos) {  // goes on in the next lines
      std::istringstream lines(remark.substr(more + 3));
      for (std::string line; std::getline(lines, line);) {
        if (line.ends_with(" ~")) line.resize(line.size() - 2);
        out_.line(fmt::format("; {}", trimmed(line, lineBlanks)));
      }
      remark.resize(more);
    }
    if (!remark.empty()) {
      if (out_.size() > before) {
        out_.at(before) += fmt::format(" {}", remark);
      } else {
        out_.line(std::string(remark));
      }
    }
    for (std::size_t i = before; block.skippable && i < out_.size(); ++i)
      out_.at(i) = fmt::format("/{}", out_.at(i));
    for (const NotCarriedOver& doubt : formulas_.takeDoubts())
      out_.list(block, doubt.what(), doubt.advice());
  } catch (const NotCarriedOver& reason) {
    formulas_.takeDoubts();
    out_.shorten(before);
    frame_ = frame;
    lastMove_ = std::min(lastMove_, before);
    out_.keepAsComment(block, reason.what(), reason.advice());
  }
}

void ToSinumerik::comment(const Block& block) {
  const std::string_view text = trimmed(klartext::withoutBlockNumber(block.at(block.source)), lineBlanks);
  if (text.empty()) return out_.line("");
  constexpr std::string_view message = "; MSG: ";
  if (text.starts_with(message)) {
    const std::string_view said = trimmed(text.substr(message.size()), lineBlanks);
    const bool quoted = said.size() > 1 && said.front() == '"' && said.find('"', 1) == said.size() - 1;
    if (quoted) return out_.line(fmt::format("MSG({})", said));
  }
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = trimmed(rest.substr(0, end), lineBlanks);
    if (line.ends_with('~')) line = trimmed(line.substr(0, line.size() - 1), lineBlanks);
    if (!line.empty()) out_.line(fmt::format("{}{}", line.front() == ';' ? "" : "; ", line));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
}

void ToSinumerik::instruction(const Block& block, const Instruction& instruction) {
  const auto join = [this](const std::string& word) { out_.line(word); };
  if (const auto* assign = std::get_if<Assign>(&instruction)) {
    const std::string name = formulas_.variable(block.variables[assign->variable]);
    if (name.front() == '$' || name.front() == '(')
      throw NotCarriedOver(fmt::format("{} cannot be set by a program", name));
    for (auto& coordinate : position_)
      if (coordinate && !coordinate->isNumber()) coordinate.reset();
    out_.line(fmt::format("{}={}", name, formulas_.formula(block, assign->value)));
  } else if (const auto* each = std::get_if<Jump>(&instruction)) {
    jump(block, *each);
  } else if (const auto* label = std::get_if<LabelMark>(&instruction)) {
    mark(block, *label);
  } else if (const auto* called = std::get_if<CallLabel>(&instruction)) {
    callLabel(block, *called);
  } else if (const auto* program = std::get_if<CallProgram>(&instruction)) {
    callProgram(block, *program);
  } else if (std::holds_alternative<EndProgram>(instruction)) {
    ended_ = true;
    join("M30");
  } else if (const auto* stop = std::get_if<Stop>(&instruction)) {
    join(stop->optional ? "M1" : "M0");
  } else if (const auto* travel = std::get_if<Move>(&instruction)) {
    move(block, *travel);
  } else if (const auto* tool = std::get_if<ToolCall>(&instruction)) {
    toolCall(block, *tool);
  } else if (const auto* function = std::get_if<MachineFunction>(&instruction)) {
    machineFunction(block, *function);
  } else if (const auto* change = std::get_if<Transform>(&instruction)) {
    transform(block, *change);
  } else if (const auto* measure = std::get_if<CycleCall>(&instruction)) {
    cycle(block, *measure);
  } else if (const auto* other = std::get_if<Command>(&instruction)) {
    command(block, *other);
  } else {
    throw NotCarriedOver("this block has no twin on a SINUMERIK", "write it by hand");
  }
}

void ToSinumerik::toolCall(const Block& block, const ToolCall& call) {
  for (const auto& [operand, name] :
       {std::pair(&call.deltaLength, "DL"), std::pair(&call.deltaRadius, "DR"), std::pair(&call.deltaRadius2, "DR2")}) {
    const bool none = !operand->present() || (operand->isLiteral() && operand->number == 0);
    if (!none) out_.lose(block, fmt::format("{} of the tool call", name));
  }
  if (call.index.present()) out_.lose(block, "the step index of the tool");
  if (call.cuttingSpeed.present()) out_.lose(block, "the cutting speed VC of the tool call");
  if (call.axis != 0) {
    toolAxis_ = call.axis;
    axisDoubtful_ = false;
    if (toolAxis_ != 'X' && toolAxis_ != 'Y' && toolAxis_ != 'Z')
      throw NotCarriedOver("tool axes other than X, Y and Z have no twin on a SINUMERIK");
  }
  if (call.axis != 0) out_.line(toolAxis_ == 'Z' ? "G17" : toolAxis_ == 'Y' ? "G18" : "G19");
  const bool named = call.name.present();
  if (named || call.number.present()) {
    const std::string tool = formulas_.formula(block, named ? call.name : call.number);
    out_.line(named || !call.number.isLiteral() ? fmt::format("T={}", tool) : fmt::format("T{}", tool));
    spindle_ = calledBy(block, call);
    if (spindle_) {
      out_.line(spindle_ == Spindle::Empty ? "M6 D0" : "M6 D1");
    } else {  // tool 0 has no cutting edge
      out_.line("M6 D0");
      callEdgeAgain();
    }
  }
  std::string technology;
  if (call.spindleSpeed.present()) {
    const Quantity speed = quantity(block, call.spindleSpeed);
    technology += fmt::format("S{}{}", speed.isNumber() ? "" : "=", sinumerikText(speed));
  }
  if (call.feed.present()) {
    feedOfOtherKind_ = false;
    const Quantity path = feed(block, call.feed);
    technology +=
        fmt::format("{}F{}{}", technology.empty() ? "" : " ", path.isNumber() ? "" : "=", sinumerikText(path));
  }
  if (!technology.empty()) out_.line(technology);
  forgetPosition();
}

void ToSinumerik::machineFunction(const Block& block, const MachineFunction& function) {
  switch (function.number) {
    case 3:
    case 4:
    case 5:
    case 6:
    case 7:
    case 8:
    case 9:
      return out_.line(fmt::format("M{}", function.number));
    case 19:
    case 20:
      return out_.line(orientation_.empty() ? "M19" : "SPOS=" + orientation_);
    case 13:
      return out_.line("M3 M8");
    case 14:
      return out_.line("M4 M8");
    case 126:
    case 127:
      return out_.lose(block,
                       fmt::format("M{}: rotary axes of a SINUMERIK move in the direction that each position programs",
                                   function.number));
    case 128:
      return out_.line("TRAORI");
    case 129:
      return out_.line("TRAFOOF");
    case 136:
    case 137:
      feedOfOtherKind_ = true;
      return out_.line(function.number == 136 ? "G95" : "G94");
    default:
      throw NotCarriedOver(fmt::format("M{} means something else on a SINUMERIK, or nothing", function.number),
                           "see the machine's own list of M functions");
  }
}

void ToSinumerik::blank(std::string_view text) {
  // "0.1 Z X+0 Y+0 Z-40", "0.2 X+120 IY+80 Z+12"
  const std::string corner = upperCase(text);
  const bool first = corner.starts_with("0.1"), second = corner.starts_with("0.2") && blank_.has_value();
  std::array<double, 3> coordinates = {};
  bool complete = first || second;
  for (std::size_t i = 0; i < 3 && complete; ++i) {
    const std::size_t at = corner.rfind("XYZ"[i]);
    const std::size_t end = at == std::string::npos ? at : corner.find_first_not_of("+-.,0123456789", at + 1);
    std::string digits = at == std::string::npos ? std::string() : corner.substr(at + 1, end - at - 1);
    std::ranges::replace(digits, ',', '.');
    const auto value = parseDecimal(digits);
    const bool incremental = value && at > 0 && corner[at - 1] == 'I';
    complete = value && !(incremental && first);
    if (complete) coordinates[i] = *value + (incremental ? (*blank_)[i] : 0);
  }
  if (!complete) throw NotCarriedOver("this blank form has no twin on a SINUMERIK", "it is a picture only");
  if (first) {
    blank_ = coordinates;
    return;
  }
  const auto& [x, y, z] = *blank_;
  out_.line(fmt::format("WORKPIECE(,\"\",,\"BOX\",112,{},{},-80,{},{},{},{})", numberText(coordinates[2]),
                        numberText(z), numberText(x), numberText(y), numberText(coordinates[0]),
                        numberText(coordinates[1])));
}

std::string ToSinumerik::toolDatum(const Quantity& number, const Quantity& tool) const {
  static constexpr std::array<int, 6> parameters = {3, 6, 7, 12, 15, 16};  // L, R, R2, DL, DR, DR2
  const bool known = number.isNumber() && number.number() >= 1 && number.number() <= 6;
  if (!known || (tool.isNumber() && tool.number() != std::round(tool.number()))) {
    throw NotCarriedOver("this entry of the tool table has no twin on a SINUMERIK", "write it by hand");
  }
  const bool active = tool.isNumber() && tool.number() <= 0;
  return fmt::format("$TC_DP{}[{},1]", parameters[static_cast<std::size_t>(number.number()) - 1],
                     active ? "$P_TOOLNO" : sinumerikText(tool));
}

bool ToSinumerik::leavesOut(const Block& block, const Command& command) {
  using enum klartext::CommandKind;
  const klartext::CommandKind kind = klartext::kindOf(block, command);
  std::string name(nameOf(kind));
  bool leaves = kind == Tolerance || kind == Monitoring || kind == OpenFile;
  if (kind == Function) {
    const std::string text = upperCase(block.at(command.text));
    const std::string word = text.substr(0, text.find_first_of(" \r\n"));
    leaves = word == "FEED" || word == "S-PULSE" || word == "ACC";
    name += fmt::format(" {}", word);
  }
  if (kind == ToolDefinition && command.words.count == 1) {
    out_.listOnce(
        block, "TOOL DEF prepares the tool that comes next, which changes no measurement: it is left out",
        "program T ahead of M6 if the magazine needs it, or if the program shall stop here for want of the tool",
        Severity::Note);
    return true;
  }
  if (!leaves) return false;
  out_.leaveOut(block, name, "SINUMERIK");
  return true;
}

void ToSinumerik::command(const Block& block, const Command& command) {
  const klartext::CommandKind kind = klartext::kindOf(block, command);
  const std::string_view name = nameOf(kind);
  const auto words = std::span<const Word>(block.words).subspan(command.words.first, command.words.count);
  if (kind == klartext::CommandKind::GlobalDefinition) return globalDefinition(block, command);
  if (kind == klartext::CommandKind::BlankForm) return blank(block.at(command.text));
  if (leavesOut(block, command)) return;
  if (kind == klartext::CommandKind::Fn14) {
    const Quantity number = words.empty() ? Quantity() : quantity(block, words.front().value);
    if (!number.isNumber()) throw NotCarriedOver("the number of the error is known only when the program runs");
    const int error = static_cast<int>(number.number());
    return out_.line(fmt::format("SETAL({})", error >= 1000 && error < 6000 ? error + 64000 : error + 65000));
  }
  if (kind == klartext::CommandKind::DwellTime && !words.empty()) {
    return out_.line(fmt::format("G4 {}", addressWord("F", quantity(block, words.front().value))));
  }
  if (kind == klartext::CommandKind::SpindleOrientation && !words.empty()) {
    orientation_ = sinumerikText(quantity(block, words.front().value));
    return;
  }
  const auto wordOr = [&](std::string_view address, double otherwise) {
    const auto found = std::ranges::find(words, addressOf(address), &Word::address);
    return found == words.end() ? Quantity(otherwise) : quantity(block, found->value);
  };
  if (kind == klartext::CommandKind::Fn17 && wordOr("ID", 0) == 50) {
    out_.line(fmt::format("{}={}", toolDatum(wordOr("NR", 0), wordOr("IDX", 0)), sinumerikText(wordOr("VAL", 0))));
    return callEdgeAgain();  // with it the datum takes effect
  }
  if (kind == klartext::CommandKind::Fn18 && command.variable >= 0) {
    const Quantity id = wordOr("ID", 0), index = wordOr("IDX", 0);
    const std::string target = formulas_.variable(block.variables[static_cast<std::size_t>(command.variable)]);
    const bool position = id == 270 && index.isNumber() && index.number() >= 1 && index.number() <= 3;
    if (position) {
      if (besidePath_ && planeIndex(addressOf(std::string_view("XYZ").substr(
                             static_cast<std::size_t>(index.number()) - 1, 1))) != std::optional<std::size_t>(2)) {
        out_.list(block, "the position is where the measuring cycle has left the probe",
                  "move to a place in the plane before reading it");
      }
      // FN 18 answers in millimetres, $AA_IW in the unit of the program.
      return out_.line(fmt::format("{}=$AA_IW[{}]{}", target, "XYZ"[static_cast<std::size_t>(index.number()) - 1],
                                   millimetre_ == 1 ? std::string() : fmt::format("*{}", numberText(1 / millimetre_))));
    }
    if (id == 50) return out_.line(fmt::format("{}={}", target, toolDatum(wordOr("NR", 0), index)));
    if (id == 530 && wordOr("NR", 0) == 1) return out_.line(fmt::format("{}=$P_UIFRNUM", target));
  }
  throw NotCarriedOver(fmt::format("{} has no twin on a SINUMERIK", name), "write it by hand");
}

Conversion toSinumerik(klartext::HeidenhainProgram& program, const Job* job, const TouchProbe& probe) {
  return ToSinumerik(program, job, probe).run();
}

}  // namespace probewright::conversion
