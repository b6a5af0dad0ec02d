#include "conversion/to_klartext.hpp"

#include "conversion/sinumerik_formulas.hpp"
#include "cycles/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace probewright::conversion {

using namespace language;

namespace {

constexpr int firstSettableCode = 54;
constexpr int furtherSettableCodes = 505;

/// The number of the settable zero offset that a G function selects: 1 for G54; 0 for G500.
std::optional<int> settableOf(std::string_view code) {
  if (code.size() < 3 || code.front() != 'G') return std::nullopt;
  int number = 0;
  for (const char c : code.substr(1)) {
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) return std::nullopt;
    number = number * 10 + (c - '0');
  }
  if (number >= firstSettableCode && number <= 57) return number - 53;
  if (number >= furtherSettableCodes && number <= 599) return number - 500;
  return number == 500 ? std::optional(0) : std::nullopt;
}

std::string_view commentOf(std::string_view source) {
  bool inText = false;
  for (std::size_t i = 0; i < source.size(); ++i) {
    if (source[i] == '"') inText = !inText;
    if (source[i] == ';' && !inText) return source.substr(i);
  }
  return {};
}

}  // namespace

ToKlartext::ToKlartext(sinumerik::SinumerikProgram& program, const GlobalData* globalData, control::ControlKind control)
    : program_(program), control_(control), out_(program.file()), formulas_(globalData) {}

std::string ToKlartext::axis(std::size_t index) const {
  static constexpr const char* names[] = {"X", "Y", "Z"};
  const std::size_t tool = toolAxis_ == 'X' ? 0 : toolAxis_ == 'Y' ? 1 : 2;
  return names[(tool + 1 + index) % 3];
}

std::optional<std::size_t> ToKlartext::planeIndex(std::uint32_t address) const {
  for (std::size_t i = 0; i < 3; ++i)
    if (addressOf(axis(i)) == address) return i;
  return std::nullopt;
}

void ToKlartext::survey() {
  wantedAfter_.emplace_back();
  Block block;
  for (BlockPosition at = program_.begin(); program_.parse(at, block, result_.mistakes); at = block.next) {
    for (const VariableRef& variable : block.variables) {
      const bool result = variable.space == VariableSpace::User && block.at(variable.name) == "_OVR";
      if (!result || !variable.index[0].isLiteral()) continue;
      usedResults_.insert(static_cast<int>(variable.index[0].number));
      wantedAfter_.back().insert(static_cast<int>(variable.index[0].number));
    }
    for (const Instruction& instruction : block.instructions) {
      if (const auto* jump = std::get_if<Jump>(&instruction)) targets_.insert(std::string(block.at(jump->label)));
      if (const auto* section = std::get_if<RepeatSection>(&instruction)) {
        targets_.insert(std::string(block.at(section->from)));
        if (section->to.length != 0) {
          targets_.insert(std::string(block.at(section->to)));
          sections_.insert(std::string(block.at(section->to)));
        }
      }
      const auto* called = std::get_if<CallProgram>(&instruction);
      if (called != nullptr && cycles::sinumerikCycle(block.at(called->name)) != nullptr) wantedAfter_.emplace_back();
      const auto* function = std::get_if<MachineFunction>(&instruction);
      changesTool_ = changesTool_ || (function != nullptr && function->number == 6);
      const auto* modal = std::get_if<Modal>(&instruction);
      const std::string_view name = modal == nullptr ? std::string_view() : block.at(modal->name);
      if (name == "G70" || name == "G700") millimetre_ = 1 / millimetresOfInch;
    }
  }
}

Conversion ToKlartext::run() {
  survey();
  if (hasErrors(result_.mistakes)) return std::move(result_);
  if (millimetre_ != 1) formulas_.countInches();
  Diagnostics ignored;
  Block block;
  for (BlockPosition at = program_.begin(); program_.parse(at, block, ignored); at = block.next)
    write(block);
  out_.insert(0, formulas_.globalValues());
  result_.text = numbered();
  result_.notCarriedOver = std::move(out_.listed());
  return std::move(result_);
}

std::string ToKlartext::numbered() const {
  const std::string frame = fmt::format("PGM {} {}", program_.name(), millimetre_ == 1 ? "MM" : "INCH");
  std::string text = fmt::format("0 BEGIN {}\n", frame);
  int number = 1;
  bool continued = false;
  for (const std::string& line : out_.lines()) {
    text += continued ? fmt::format("{}\n", line) : fmt::format("{} {}\n", number++, line);
    continued = line.ends_with('~');
  }
  return text + fmt::format("{} END {}\n", number, frame);
}

void ToKlartext::line(std::string text) {
  for (std::string& each : formulas_.takePrelude())
    out_.line(std::move(each));
  out_.line(std::move(text));
}

void ToKlartext::write(const Block& block) {
  const std::string_view source = block.at(block.source);
  const std::string_view remark = trimmed(commentOf(source));
  const std::size_t before = out_.size();
  if (trimmed(source).starts_with('%')) return;
  try {
    const std::string name(block.at(block.label));
    if (!name.empty() && targets_.contains(name)) label(name);
    const std::size_t first = out_.size();
    statements(block);
    if (block.instructions.empty() && remark.empty()) {
      if (trimmed(source).empty()) line(";");
    } else if (!remark.empty()) {
      const bool fits = out_.size() == first + 1 && !out_.at(first).starts_with(';');
      if (fits) {
        out_.at(first) += fmt::format(" {}", remark);
      } else {
        out_.insert(first, {std::string(remark)});
      }
    }
    for (std::size_t i = before; block.skippable && i < out_.size(); ++i)
      if (i == before || !out_.at(i - 1).ends_with('~')) out_.at(i) = fmt::format("/{}", out_.at(i));
    if (!name.empty() && sections_.contains(name)) line("LBL 0");
  } catch (const NotCarriedOver& reason) {
    out_.shorten(before);
    formulas_.takePrelude();
    out_.keepAsComment(block, reason.what(), reason.advice());
  }
}

void ToKlartext::statements(const Block& block) {
  // A tool change stands in one block with its M6; suppression of the tool length belongs to a motion on the machine.
  for (const Instruction& each : block.instructions)
    instruction(block, each);
}

void ToKlartext::instruction(const Block& block, const Instruction& instruction) {
  if (const auto* assigned = std::get_if<Assign>(&instruction)) {
    assign(block, *assigned);
  } else if (const auto* each = std::get_if<Jump>(&instruction)) {
    jump(block, *each);
  } else if (const auto* section = std::get_if<RepeatSection>(&instruction)) {
    repeat(block, *section);
  } else if (const auto* called = std::get_if<CallProgram>(&instruction)) {
    call(block, *called);
  } else if (const auto* structure = std::get_if<Structured>(&instruction)) {
    structured(block, *structure);
  } else if (std::holds_alternative<EndProgram>(instruction)) {
    line("M30");
  } else if (std::holds_alternative<Return>(instruction)) {
    if (program_.parse(block.next, *std::make_unique<Block>(), result_.mistakes)) {
      throw NotCarriedOver("a return in the middle of a program has no twin in Klartext", "jump to its end");
    }
  } else if (const auto* stop = std::get_if<Stop>(&instruction)) {
    line(stop->optional ? "M1" : "STOP");
  } else if (const auto* travel = std::get_if<Move>(&instruction)) {
    move(block, *travel);
  } else if (const auto* tool = std::get_if<ToolCall>(&instruction)) {
    toolCall(block, *tool);
  } else if (const auto* function = std::get_if<Modal>(&instruction)) {
    modal(block, *function);
  } else if (const auto* auxiliary = std::get_if<MachineFunction>(&instruction)) {
    machineFunction(block, *auxiliary);
  } else if (const auto* change = std::get_if<Transform>(&instruction)) {
    transform(block, *change);
  } else if (const auto* other = std::get_if<Command>(&instruction)) {
    command(block, *other);
  } else {
    throw NotCarriedOver("this block has no twin in Klartext", "write it by hand");
  }
}

void ToKlartext::assign(const Block& block, const Assign& assign) {
  const VariableRef& variable = block.variables[assign.variable];
  const bool frame = variable.space == VariableSpace::System && block.at(variable.name) == "$P_UIFR";
  if (frame && variable.index[2].present()) return assignFrameComponent(block, assign);
  // A HEIDENHAIN cycle with Q305 = 0 copies the active preset to row 0 and selects it by itself.
  if (frame && trimmed(block.at(block.source)).starts_with("$P_UIFR[99]=$P_UIFR[$P_UIFRNUM]")) {
    copiesToRow0_ = true;
    return;
  }
  if (variable.space == VariableSpace::System) {
    const std::string value = formulas_.value(quantity(block, assign.value));
    if (const std::string datum = formulas_.toolDatum(block, variable); !datum.empty()) {
      return line(fmt::format("FN 17: SYSWRITE {} = {}", datum, value));
    }
    throw NotCarriedOver(fmt::format("{} cannot be written in Klartext", block.at(variable.name)));
  }
  const std::string name = formulas_.variable(block, variable);
  const std::string formula = formulas_.formula(block, assign.value);
  line(fmt::format("{} = {}", name, formula));
  const std::string own(variable.space == VariableSpace::User ? block.at(variable.name) : std::string_view());
  if (formulas_.isGlobal(own) && changedGlobals_.insert(own).second) {
    out_.list(block, fmt::format("{} is global user data: other programs do not see what it is set to here", own),
              "use a QR parameter if they shall");
  }
  for (auto& coordinate : position_)
    if (coordinate && !coordinate->isNumber()) coordinate.reset();
}

void ToKlartext::assignFrameComponent(const Block& block, const Assign& assign) {
  const VariableRef& variable = block.variables[assign.variable];
  const auto word = [&](std::size_t i) {
    const std::int32_t node = variable.index[i].node;
    return node < 0 ? std::string_view() : block.at(block.nodes[static_cast<std::size_t>(node)].text);
  };
  const bool active = word(0) == "$P_UIFRNUM" || block.at(block.source).find("[$P_UIFRNUM,") != std::string_view::npos;
  const Quantity value = quantity(block, assign.value);
  const Quantity number = active ? Quantity(-1) : quantity(block, variable.index[0]);
  const Quantity row = number == 99 ? Quantity(0) : number;
  forgetPosition();
  if (word(2) == "RT" && word(1) == axis(2)) {
    const bool ofTables = control_ != control::ControlKind::iTNC530;
    const bool inEffect = active || (activeRow_ && number == *activeRow_);
    if (!ofTables && !inEffect) {
      throw NotCarriedOver("cycle 404 of the iTNC530 turns the active preset only",
                           "select the zero offset in front of this block");
    }
    unturned_ = value == 0;
    const std::string angle = formulas_.value(value), rowText = formulas_.value(row);
    line("TCH PROBE 404 SET BASIC ROTATION ~");
    out_.line(fmt::format("    Q307={} ;PRESET ROTATION ANG.{}", angle, ofTables ? " ~" : ""));
    if (ofTables) out_.line(fmt::format("    Q305={} ;NUMBER IN TABLE", rowText));
    return;
  }
  const std::size_t place = word(1).size() == 1 ? std::string_view("XYZ").find(word(1)[0]) : std::string_view::npos;
  if (word(2) != "TR" || place == std::string_view::npos) {
    throw NotCarriedOver(fmt::format("$P_UIFR[..,{},{}] cannot be written in Klartext", word(1), word(2)));
  }
  if (control_ == control::ControlKind::iTNC530) {
    throw NotCarriedOver("the iTNC530 has no PRESET CORR",
                         "let the measuring cycle in front correct the offset itself");
  }
  // A preset moves by an amount, and only while it is in effect.
  const Quantity present = active ? quantity(block, variable.index[0]) : row;
  const Quantity shift = value - Quantity::of(formulas_.presetDatum(present, static_cast<int>(place) + 1));
  const std::string amount = formulas_.value(shift);
  const bool selected = active || (activeRow_ && number == *activeRow_);
  const std::string before = formulas_.define("preset in effect", false);
  if (!selected) {
    line(fmt::format("FN 18: SYSREAD {} = ID530 NR1", before));
    out_.line(fmt::format("PRESET SELECT #{} KEEP TRANS", formulas_.unsignedValue(row)));
  }
  line(fmt::format("PRESET CORR {}{}", word(1), amount));
  if (!selected) line(fmt::format("PRESET SELECT #{} KEEP TRANS", before));
}

void ToKlartext::toolCall(const Block& block, const ToolCall& call) {
  pendingTool_ =
      call.name.present() ? formulas_.formula(block, call.name) : formulas_.unsignedValue(quantity(block, call.number));
  if (!changesTool_) changeTool();
}

void ToKlartext::changeTool() {
  if (pendingTool_.empty()) return;
  line(fmt::format("TOOL CALL {} {}", pendingTool_, toolAxis_));
  pendingTool_.clear();
  forgetPosition();
}

void ToKlartext::modal(const Block& block, const Modal& modal) {
  const std::string_view name = block.at(modal.name);
  const auto words = std::span<const Word>(block.words).subspan(modal.words.first, modal.words.count);
  if (const auto settable = settableOf(name)) {
    if (*settable == 0) throw NotCarriedOver("G500 takes all settable zero offsets back; a preset is always in effect");
    const int row = *settable == 99 ? 0 : *settable;
    activeRow_ = *settable;
    forgetPosition();
    if (row == 0 && std::exchange(copiesToRow0_, false)) return;
    line("CYCL DEF 247 PRESETTING ~");
    out_.line(fmt::format("    Q339=+{} ;PRESET NUMBER", row));
    return;
  }
  if ((name == "G71" || name == "G710") && millimetre_ != 1) {
    throw NotCarriedOver("this program counts in inches as well, and a HEIDENHAIN program has one unit",
                         "measure in one unit throughout");
  }
  if (name == "G70") {
    out_.list(block, "G70 leaves feeds and system variables in millimetres; in an INCH program they are inches",
              "use G700, or convert the feeds by hand");
  }
  static constexpr std::array<std::string_view, 12> silent = {"G60", "G64",    "G71", "G710",  "G70", "G700",
                                                              "G94", "DIAMOF", "CFC", "CFTCP", "G9",  "G601"};
  if (std::ranges::find(silent, name) != silent.end()) return;
  if (name == "G90" || name == "G91") {
    incremental_ = name == "G91";
  } else if (name == "G17" || name == "G18" || name == "G19") {
    toolAxis_ = name == "G17" ? 'Z' : name == "G18" ? 'Y' : 'X';
    forgetPosition();
  } else if (name == "G0" || name == "G1" || name == "G2" || name == "G3") {
    motion_ = name == "G0"   ? MoveKind::Rapid
              : name == "G1" ? MoveKind::Linear
              : name == "G2" ? MoveKind::ArcClockwise
                             : MoveKind::ArcCounterclockwise;
  } else if (name == "G40" || name == "G41" || name == "G42") {
    compensation_ = name == "G40" ? "R0" : name == "G41" ? "RL" : "RR";
  } else if (name == "G95") {
    line("M136");
  } else if (name == "TRAORI") {
    line("M128");
  } else if (name == "TRAFOOF") {
    line("M129");
  } else if (name == "F" && words.size() == 1) {
    line(fmt::format("L {} F{}", compensation_, formulas_.unsignedValue(quantity(block, words[0].value))));
  } else if (name == "S" && words.size() == 1 && addressName(words[0].address) == "S") {
    line(fmt::format("TOOL CALL S{}", formulas_.unsignedValue(quantity(block, words[0].value))));
  } else if (name == "D" && words.size() == 1) {
    const Quantity edge = quantity(block, words[0].value);
    if (!(edge == 1 || edge == 0)) out_.lose(block, fmt::format("D{}", sinumerikText(edge)));
  } else {
    throw NotCarriedOver(fmt::format("{} has no twin in Klartext", name), "write it by hand");
  }
}

void ToKlartext::machineFunction(const Block&, const MachineFunction& function) {
  if (function.argument.present() || function.number < 0) {
    throw NotCarriedOver("M functions of further spindles have no twin in Klartext");
  }
  switch (function.number) {
    case 6:
      return changeTool();
    case 3:
    case 4:
    case 5:
    case 7:
    case 8:
    case 9:
    case 19:
      return line(fmt::format("M{}", function.number));
    default:
      throw NotCarriedOver(fmt::format("M{} means something else on a HEIDENHAIN control, or nothing", function.number),
                           "see the machine's own list of M functions");
  }
}

void ToKlartext::transform(const Block& block, const Transform& transform) {
  const std::string_view name = block.at(transform.name);
  const auto words = std::span<const Word>(block.words).subspan(transform.words.first, transform.words.count);
  const bool adds = name == "ATRANS" || name == "AROT";
  if (name == "TRANS" || name == "ATRANS") {
    if (adds && rotated_) throw NotCarriedOver("a shift along turned axes has no twin in Klartext");
    std::array<std::optional<Quantity>, 3> shift = adds ? shift_ : std::array<std::optional<Quantity>, 3>{};
    for (const Word& word : words) {
      const auto index = planeIndex(word.address);
      if (!index) throw NotCarriedOver("shifts of rotary axes are not converted");
      shift[*index] = shift[*index].value_or(0) + quantity(block, word.value);
    }
    if (rotated_) {
      line("CYCL DEF 10.0 ROTATION");
      out_.line("CYCL DEF 10.1 ROT+0");
      rotated_ = false;
    }
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!shift[i] && !shift_[i]) continue;
      parts.push_back(
          fmt::format("CYCL DEF 7.{} {}{}", parts.size() + 1, axis(i), formulas_.value(shift[i].value_or(0))));
    }
    shift_ = shift;
    if (!parts.empty()) {
      line("CYCL DEF 7.0 DATUM SHIFT");
      for (const std::string& part : parts)
        out_.line(part);
    }
  } else if (name == "ROT" || name == "AROT") {
    const bool plain =
        words.size() == 1 && (words[0].address == addressOf(axis(2)) || words[0].address == addressOf("RPL"));
    if (!plain && !words.empty()) throw NotCarriedOver("rotations out of the working plane are not converted");
    if (!adds && std::ranges::any_of(shift_, [](const auto& each) { return each.has_value(); })) {
      throw NotCarriedOver("ROT takes a shift back that Klartext would keep", "write TRANS in front of it, or AROT");
    }
    const std::string angle = words.empty() ? "+0" : formulas_.value(quantity(block, words[0].value));
    line("CYCL DEF 10.0 ROTATION");
    out_.line(fmt::format("CYCL DEF 10.1 {}ROT{}", adds && rotated_ ? "I" : "", angle));
    rotated_ = !words.empty();
  } else {
    throw NotCarriedOver(fmt::format("{} has no twin in Klartext", name), "write it by hand");
  }
  forgetPosition();
}

void ToKlartext::blank(const Block& block, const Command& command) {
  const auto words = std::span<const Word>(block.words).subspan(command.words.first, command.words.count);
  const auto number = [&](std::uint32_t place) {
    const auto found = std::ranges::find(words, place, &Word::address);
    if (found == words.end() || !found->value.isLiteral()) throw NotCarriedOver("this blank has no twin in Klartext");
    return formulas_.value(found->value.number);
  };
  const bool box = block.at(block.source).find("\"BOX\"") != std::string_view::npos && number(4) == "+112";
  if (!box) throw NotCarriedOver("this blank has no twin in Klartext", "it is a picture only");
  line(fmt::format("BLK FORM 0.1 Z X{} Y{} Z{}", number(8), number(9), number(6)));
  line(fmt::format("BLK FORM 0.2 X{} Y{} Z{}", number(10), number(11), number(5)));
}

void ToKlartext::define(const Block& block, const Command& command) {
  const VariableRef& variable = block.variables[static_cast<std::size_t>(command.variable)];
  const auto words = std::span<const Word>(block.words).subspan(command.words.first, command.words.count);
  const std::string own(block.at(variable.name));
  const std::string_view type = block.at(command.text);
  if (type == "FRAME" || type == "AXIS") throw NotCarriedOver("variables for frames and axes have no twin in Klartext");
  const bool isText = type == "STRING" || type == "CHAR";
  std::vector<std::string> elements = {own};
  for (std::size_t i = 0; i < 3 && variable.index[i].present(); ++i) {
    constexpr double most = 100;  // there are no more free parameters
    const double count = variable.index[i].number;
    if (!variable.index[i].isLiteral() || count * static_cast<double>(elements.size()) > most) {
      throw NotCarriedOver(fmt::format("array {} has more elements than there are free Q parameters", own));
    }
    std::vector<std::string> deeper;
    for (const std::string& each : elements)
      for (int k = 0; k < count; ++k)
        deeper.push_back(fmt::format("{}{}{}", each, i == 0 ? "[" : ",", k));
    elements = std::move(deeper);
  }
  std::vector<std::string> values;
  for (const Word& word : words) {
    if (word.address == addressOf("LEN")) continue;
    values.push_back(word.value.present() ? formulas_.formula(block, word.value) : std::string());
    if (word.address == addressOf("REP")) values.resize(elements.size(), values.back());
  }
  values.resize(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (variable.index[0].present()) elements[i] += ']';
    const bool known = elements.size() == 1 && own.starts_with("_Q");
    const std::string target = known ? own.substr(1) : formulas_.define(elements[i], isText);
    if (values[i].empty()) values[i] = target.starts_with("QS") ? "\"\"" : "0";
    line(fmt::format("{} = {}{}", target, values[i], known ? "" : fmt::format(" ; {}", elements[i])));
  }
}

void ToKlartext::command(const Block& block, const Command& command) {
  const std::string_view name = block.at(command.name);
  const auto words = std::span<const Word>(block.words).subspan(command.words.first, command.words.count);
  if (name == "DEF") return define(block, command);
  if (name == "MSG") {
    if (words.empty()) return;
    return line(fmt::format("; MSG: {}", formulas_.formula(block, words[0].value)));
  }
  if (name == "SETAL" && !words.empty() && words[0].value.isLiteral()) {
    const int number = static_cast<int>(words[0].value.number);
    return line(fmt::format("FN 14: ERROR = {}", number >= 65000 ? number - 64000 : number));
  }
  if (name == "WORKPIECE") return blank(block, command);
  if (name == "MEAS") return measuringBlock(block, command);
  if (name == "STOPRE") return line("FN 20: WAIT FOR SYNC");
  if (name == "G4" && !words.empty() && words[0].address == 'F') {
    line("CYCL DEF 9.0 DWELL TIME");
    return out_.line(fmt::format("CYCL DEF 9.1 DWELL {}", formulas_.unsignedValue(quantity(block, words[0].value))));
  }
  if (name == "SPOS" && !words.empty()) {
    const std::string angle = formulas_.value(quantity(block, words[0].value));
    line("CYCL DEF 13.0 ORIENTATION");
    return out_.line(fmt::format("CYCL DEF 13.1 ANGLE {}", angle));
  }
  if (name == "PROC") {
    if (block.at(command.text).find("REAL") == std::string_view::npos &&
        block.at(command.text).find("INT") == std::string_view::npos)
      return;
    throw NotCarriedOver("parameters of subprograms have no twin in Klartext", "hand values over in Q parameters");
  }
  throw NotCarriedOver(fmt::format("{} has no twin in Klartext", name), "write it by hand");
}

Conversion toKlartext(sinumerik::SinumerikProgram& program, const GlobalData* globalData,
                      control::ControlKind control) {
  return ToKlartext(program, globalData, control).run();
}

}  // namespace probewright::conversion
