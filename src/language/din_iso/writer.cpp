#include "language/din_iso/writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>

#include "cycles/heidenhain/probe_words.hpp"
#include "language/klartext/commands.hpp"
#include "language/klartext/cycle_writer.hpp"
#include "language/klartext/formula_writer.hpp"
#include "language/klartext/lexer.hpp"
#include "language/klartext/writer.hpp"

namespace probewright::language::din_iso {

using klartext::CommandKind;
using klartext::nameOf;
using klartext::TransformKind;
using klartext::writeFormula;
using klartext::writeValue;
using klartext::writeVariable;

namespace {

constexpr std::string_view axisLetters = "XYZABCUVW";

class BlockWriter {
public:
  explicit BlockWriter(const Block& block) : block_(block) {}

  Result<std::string> write() {
    bool hasMain = false;
    for (const Instruction& instruction : block_.instructions) {
      if (!isMain(instruction)) continue;
      hasMain = true;
      std::visit([this](const auto& i) { add(i); }, instruction);
    }
    bool first = !hasMain;
    for (const Instruction& instruction : block_.instructions) {
      if (isMain(instruction)) continue;
      if (const auto* function = std::get_if<MachineFunction>(&instruction)) {
        machineFunction(*function);
      } else if (const auto* stop = std::get_if<Stop>(&instruction)) {
        word(stop->optional ? "M1" : first ? "G38" : "M0");
      } else if (std::holds_alternative<EndProgram>(instruction)) {
        word("M30");
      } else {
        word(first ? "G79" : "M99");
      }
      first = false;
    }
    if (out_.empty()) word("G00");  // a path without an axis moves nothing
    if (!reason_.empty()) return fail(reason_, "write the block anew in the other language");
    return std::move(out_);
  }

private:
  bool isMain(const Instruction& instruction) const {
    const auto* command = std::get_if<Command>(&instruction);
    const bool plainCall = command != nullptr && command->words.count == 0 && command->text.length == 0 &&
                           klartext::kindOf(block_, *command) == CommandKind::CycleCall;
    return !std::holds_alternative<MachineFunction>(instruction) && !std::holds_alternative<Stop>(instruction) &&
           !std::holds_alternative<EndProgram>(instruction) && !plainCall;
  }

  void refuse(std::string reason) {
    if (reason_.empty()) reason_ = std::move(reason);
  }
  void word(std::string_view text) {
    if (!out_.empty()) out_ += ' ';
    out_ += text;
  }
  std::string_view at(TextRef ref) const { return block_.at(ref); }
  std::string value(const Operand& operand) const { return writeValue(block_, operand); }
  std::string unsignedValue(const Operand& operand) const {
    const std::string text = value(operand);
    return text.starts_with('+') ? text.substr(1) : text;
  }
  std::span<const Word> wordsOf(WordRange range) const {
    return std::span<const Word>(block_.words).subspan(range.first, range.count);
  }
  std::string label(TextRef text, const Operand& computed) const {
    if (computed.present()) return writeFormula(block_, computed);
    const std::string_view name = at(text);
    const bool number = !name.empty() && std::ranges::all_of(name, isDigit);
    return number || name.starts_with('"') ? std::string(name) : fmt::format("\"{}\"", name);
  }

  /// Writes G90 or G91 where it changes within the block, and always before the block's first coordinate.
  void mode(WordMode wanted) {
    const bool incremental = wanted == WordMode::Incremental;
    if (incremental_ == incremental) return;
    incremental_ = incremental;
    word(incremental ? "G91" : "G90");
  }
  void coordinate(std::string_view address, const Word& from) {
    mode(from.mode);
    word(fmt::format("{}{}", address, value(from.value)));
  }

  void machineFunction(const MachineFunction& function) {
    word(fmt::format("M{}", function.number));
    for (const Word& w : wordsOf(function.words)) {
      const bool isMax = !w.value.present() && w.address == addressOf("MB");
      word(isMax ? "MB MAX" : fmt::format("{}{}", addressName(w.address), value(w.value)));
    }
    if (function.argument.present()) word(fmt::format("F{}", value(function.argument)));
  }

  void add(const Move& move) {
    const std::span<const Word> words = wordsOf(move.words);
    switch (move.kind) {
      case MoveKind::SetCentre:
        centre(words);
        return;
      case MoveKind::Chamfer:
      case MoveKind::Rounding:
        if (words.size() != 1) return refuse("this form of a corner has no twin in DIN/ISO");
        word(fmt::format("{} R{}", move.kind == MoveKind::Chamfer ? "G24" : "G25", unsignedValue(words[0].value)));
        if (move.feed.present()) word(fmt::format("F{}", unsignedValue(move.feed)));
        return;
      case MoveKind::Approach:
        return refuse("APPR has no twin in DIN/ISO");
      case MoveKind::Depart:
        return refuse("DEP has no twin in DIN/ISO");
      default:
        path(move, words);
        return;
    }
  }

  void centre(std::span<const Word> words) {
    if (words.empty()) return word("G29");
    for (const Word& w : words) {
      if (w.address < 'X' || w.address > 'Z') return refuse("a circle centre in this axis has no twin in DIN/ISO");
      coordinate(std::string_view("IJK").substr(w.address - 'X', 1), w);
    }
  }

  std::string_view pathFunction(const Move& move, bool paraxial) {
    const bool polar = move.polar;
    switch (move.kind) {
      case MoveKind::ArcClockwise:
        return polar ? "G12" : "G02";
      case MoveKind::ArcCounterclockwise:
        return polar ? "G13" : "G03";
      case MoveKind::ArcTangential:
        return polar ? "G16" : "G06";
      case MoveKind::Modal:
        return polar ? "G15" : "G05";
      case MoveKind::Linear:
        if (paraxial) return "G07";
        if (move.rapid) return polar ? "G10" : "G00";
        return polar ? "G11" : "G01";
      default:
        refuse("this path function has no twin in DIN/ISO");
        return {};
    }
  }

  void path(const Move& move, std::span<const Word> words) {
    const bool paraxial = std::ranges::any_of(
        words, [](const Word& w) { return w.address == 'R' && w.mode == WordMode::DirectShortest; });
    const bool travels = std::ranges::any_of(words, [](const Word& w) { return w.address != addressOf("DR"); });
    const bool linear = move.kind == MoveKind::Linear;
    if (travels || !linear) word(pathFunction(move, paraxial));
    if (!linear && move.rapid) refuse("an arc at rapid traverse has no twin in DIN/ISO");
    if (paraxial && move.rapid) refuse("a paraxial compensation at rapid traverse has no twin in DIN/ISO");
    switch (move.compensation) {
      case RadiusCompensation::Off:
        word("G40");
        break;
      case RadiusCompensation::Left:
        word("G41");
        break;
      case RadiusCompensation::Right:
        word("G42");
        break;
      case RadiusCompensation::Unchanged:
        break;
    }
    for (const Word& w : words)
      pathWord(move, w);
    if (move.feed.present()) word(fmt::format("F{}", unsignedValue(move.feed)));
    if (move.autoFeed) word("FAUTO");
    if (move.machineCoordinates) word("M91");
    if (move.machineReference2) word("M92");
  }

  void pathWord(const Move& move, const Word& w) {
    const std::string name = addressName(w.address);
    if (name == "DR") return;
    if (name == "R") {
      if (w.mode == WordMode::DirectShortest) return word(w.value.number > 0 ? "G43" : "G44");
      return word(fmt::format("R{}", value(w.value)));
    }
    if (name == "PR" && move.polar) return coordinate("R", w);
    if (name == "PA" && move.polar) return coordinate("H", w);
    if (name == "FU" || name == "FZ") return word(fmt::format("{}{}", name, unsignedValue(w.value)));
    if (name.size() == 1 && axisLetters.find(name[0]) != std::string_view::npos) return coordinate(name, w);
    refuse(fmt::format("the word {} has no twin in DIN/ISO", name));
  }

  void add(const ToolCall& call) {
    const bool tool = call.number.present() || call.name.present();
    if (call.name.present()) {
      word(fmt::format("T{}", writeFormula(block_, call.name)));
    } else if (call.number.present()) {
      word(fmt::format("T{}", unsignedValue(call.number)));
      if (call.index.present()) out_ += fmt::format(".{}", unsignedValue(call.index));
    }
    if (call.axis == 'Z' || call.axis == 'Y' || call.axis == 'X') {
      word(call.axis == 'Z' ? "G17" : call.axis == 'Y' ? "G18" : "G19");
    } else if (call.axis != 0) {
      refuse(fmt::format("the tool axis {} has no twin in DIN/ISO", call.axis));
    }
    if (call.spindleSpeed.present()) word(fmt::format("S{}", unsignedValue(call.spindleSpeed)));
    if (call.cuttingSpeed.present()) word(fmt::format("S(VC={})", unsignedValue(call.cuttingSpeed)));
    if (call.feed.present()) word(fmt::format("F{}", unsignedValue(call.feed)));
    if (call.feed.present() && !tool) refuse("the feed of TOOL CALL has no twin in DIN/ISO without its tool");
    if (call.deltaLength.present()) word(fmt::format("DL{}", value(call.deltaLength)));
    if (call.deltaRadius.present()) word(fmt::format("DR{}", value(call.deltaRadius)));
    if (call.deltaRadius2.present()) word(fmt::format("DR2{}", value(call.deltaRadius2)));
    if (out_.empty()) refuse("TOOL CALL without tool has no twin in DIN/ISO");
  }

  void add(const Assign& assign) {
    const std::string target = writeVariable(block_.variables[assign.variable]);
    if (assign.value.node >= 0) {
      const Node& node = block_.nodes[static_cast<std::size_t>(assign.value.node)];
      const bool angle = node.operation == Operation::Call && node.function == Function::Host && at(node.text) == "ANG";
      const bool distance = node.operation == Operation::Call && node.function == Function::RootSumOfSquares;
      if (angle || distance) {
        word(fmt::format("D{} {} P01 {} P02 {}", angle ? "13" : "08", target, value(block_.operands[node.a]),
                         value(block_.operands[node.a + 1])));
        return;
      }
    }
    word(fmt::format("{} = {}", target, writeFormula(block_, assign.value)));
  }

  void add(const Jump& jump) {
    if (jump.condition.node < 0) return refuse("a jump without condition has no twin in DIN/ISO");
    const Node* node = &block_.nodes[static_cast<std::size_t>(jump.condition.node)];
    const bool inverted = node->operation == Operation::Not;
    if (inverted) node = &block_.nodes[static_cast<std::size_t>(node->left.node)];
    const std::string target = label(jump.label, jump.labelValue);
    if (node->operation == Operation::Undefined) {
      word(fmt::format("D09 P01 +{} IS {} P03 {}", writeVariable(block_.variables[node->a]),
                       inverted ? "DEFINED" : "UNDEFINED", target));
      return;
    }
    const std::string_view number = node->operation == Operation::Equal      ? "09"
                                    : node->operation == Operation::NotEqual ? "10"
                                    : node->operation == Operation::Greater  ? "11"
                                                                             : "12";
    word(fmt::format("D{} P01 {} P02 {} P03 {}", number, value(node->left), value(node->right), target));
  }

  void add(const LabelMark& mark) { word(fmt::format("G98 L{}", label(mark.label, {}))); }
  void add(const CallLabel& call) {
    word(fmt::format("L{}", label(call.label, call.labelValue)));
    if (call.repeats.present()) out_ += fmt::format(",{}", unsignedValue(call.repeats));
  }
  void add(const CallProgram& call) {
    if (!call.nameValue.present()) {
      return word(fmt::format("%{}", klartext::writePath(at(call.name))));
    }
    const Node& node = block_.nodes[static_cast<std::size_t>(call.nameValue.node)];
    word(node.operation == Operation::Call ? std::string("%<>%")
                                           : fmt::format("%{}", writeFormula(block_, call.nameValue)));
  }

  /// The text of a Klartext cycle with its head in DIN/ISO.
  void parameterCycle(const std::string& text, std::string_view head) {
    if (!text.starts_with(head)) return refuse("this cycle has no twin in DIN/ISO");
    word(fmt::format("G{}", std::string_view(text).substr(head.size())));
  }

  void add(const CycleCall& call) {
    if (at(call.name).starts_with('G')) {
      word(at(call.name));
      for (const Word& w : wordsOf(call.parameters)) {
        const char axis = static_cast<char>(w.address >> 8);
        word(fmt::format("P{:02} {}{}", w.address & 0xFF, axis == 0 ? "" : std::string(1, axis), value(w.value)));
      }
      return;
    }
    if (call.number >= 200) {
      if (call.parameters.count == 0) return refuse("this form of a cycle has no twin in DIN/ISO");
      return parameterCycle(klartext::writeCycle(block_, call), fmt::format("{} ", at(call.name)));
    }
    if (call.number != 0 || at(call.name) != "TCH PROBE") {
      return refuse(fmt::format("cycle {} has no twin in DIN/ISO", call.number));
    }
    namespace probe_word = cycles::heidenhain::probe_word;
    std::string axes;
    double result = 0, axis = 0, direction = 0;
    for (const Word& w : wordsOf(call.parameters)) {
      if (w.address == probe_word::result) result = w.value.number;
      if (w.address == probe_word::axis) axis = w.value.number;
      if (w.address == probe_word::direction) direction = w.value.number;
      if (w.address < probe_word::coordinate) continue;
      if (w.mode == WordMode::Incremental) return refuse("incremental positions of cycle 0 have no twin in DIN/ISO");
      axes += fmt::format(" {}{}", axisLetters[w.address - probe_word::coordinate], value(w.value));
    }
    word(fmt::format("G55 P01 {} P02 {}{}{}", static_cast<int>(result), axisLetters[static_cast<std::size_t>(axis)],
                     direction > 0 ? '+' : '-', axes));
  }

  void add(const Transform& transform) {
    const TransformKind kind = klartext::kindOf(block_, transform);
    const std::string_view name = nameOf(kind);
    const std::span<const Word> words = wordsOf(transform.words);
    if (isPlane(kind) || isTrans(kind)) return word(klartext::writeTransform(block_, transform));
    if (kind == TransformKind::PresetByCycle)
      return parameterCycle(klartext::writeTransform(block_, transform), "CYCL DEF ");
    if (kind == TransformKind::DatumShift) return datumShift(words);
    if (kind == TransformKind::Mirror) {
      word("G28");
      for (const Word& w : words)
        word(addressName(w.address));
    } else if (kind == TransformKind::Rotation && words.size() == 1) {
      word("G73");
      coordinate("H", words[0]);
    } else if (kind == TransformKind::Scaling && words.size() == 1) {
      word(fmt::format("G72 F{}", unsignedValue(words[0].value)));
    } else if (kind == TransformKind::Tilting) {
      word("G80");
      for (const Word& w : words) {
        if (w.mode == WordMode::Incremental) return refuse("incremental angles of cycle 19 have no twin in DIN/ISO");
        const bool distance = w.address == addressOf("DIST");
        word(fmt::format("{}{}", distance ? std::string("S") : addressName(w.address), value(w.value)));
      }
    } else {
      refuse(fmt::format("{} has no twin in DIN/ISO", name));
    }
  }

  void datumShift(std::span<const Word> words) {
    const bool row = words.size() == 1 && words[0].address == '#';
    if (row) return word(fmt::format("G53 P01 {}", unsignedValue(words[0].value)));
    word("G54");
    for (const Word& w : words) {
      if (w.address == '#') return refuse("a row together with coordinates has no twin in DIN/ISO");
      coordinate(addressName(w.address), w);
    }
  }

  void add(const Command& command) {
    const CommandKind kind = klartext::kindOf(block_, command);
    const std::string_view name = nameOf(kind);
    const std::string_view text = at(command.text);
    const std::span<const Word> words = wordsOf(command.words);
    if (kind == CommandKind::BlankForm) return blankForm(text);
    if (kind == CommandKind::Fn14) return word(fmt::format("D14 P01 {}", value(words[0].value)));
    if (kind == CommandKind::Fn19 || kind == CommandKind::Fn29) {
      word(fmt::format("D{}", name.substr(2)));
      for (const Word& w : words)
        word(fmt::format("P{:02} {}", w.address, value(w.value)));
      return;
    }
    if (kind == CommandKind::Fn16) return word(fmt::format("D16 P01 F-PRINT {}", text));
    if (kind == CommandKind::SetUndefined) {
      return word(fmt::format("D00 {} SET UNDEFINED",
                              writeVariable(block_.variables[static_cast<std::size_t>(command.variable)])));
    }
    if (isFunction(kind)) {
      const std::string written = klartext::writeCommand(block_, command);  // "FN 18: ..."
      return word(fmt::format("D{}", written.substr(3)));
    }
    if (kind == CommandKind::ToolDefinition) {
      const std::string tool =
          words[0].value.isLiteral() ? unsignedValue(words[0].value) : writeFormula(block_, words[0].value);
      word(fmt::format("{} T{}", words.size() > 1 ? "G99" : "G51", tool));
      for (const Word& w : words.subspan(1))
        word(fmt::format("{}{}", addressName(w.address), value(w.value)));
      return;
    }
    const auto setting = [&](std::string_view form) {
      if (words.empty()) return refuse(fmt::format("{} without its value has no twin in DIN/ISO", name));
      word(fmt::format("{}{}", form, unsignedValue(words[0].value)));
    };
    if (kind == CommandKind::DwellTime) return setting("G04 F");
    if (kind == CommandKind::SpindleOrientation) return setting("G36 S");
    if (kind == CommandKind::ProgramCall) return word(fmt::format("G39 P01 {}", klartext::writePath(text)));
    if (kind == CommandKind::Tolerance) {
      word("G62");
      constexpr std::string_view forms[] = {"T", "P01 ", "P02 "};
      for (std::size_t i = 0; i < words.size() && i < 3; ++i)
        word(fmt::format("{}{}", forms[i], unsignedValue(words[i].value)));
      return;
    }
    if (kind == CommandKind::SelectProgram || kind == CommandKind::SelectTable || kind == CommandKind::SelectPattern ||
        kind == CommandKind::SelectContour) {
      const std::string_view sign = kind == CommandKind::SelectProgram   ? "PGM"
                                    : kind == CommandKind::SelectTable   ? "TAB"
                                    : kind == CommandKind::SelectPattern ? "PAT"
                                                                         : "CNT";
      word(words.empty() ? fmt::format("%:{}: \"{}\"", sign, text)
                         : fmt::format("%:{}: {}", sign, writeFormula(block_, words[0].value)));
      return;
    }
    const bool sameInBoth =
        kind == CommandKind::PresetSelect || kind == CommandKind::PresetCopy || kind == CommandKind::PresetCorrection ||
        kind == CommandKind::Function || kind == CommandKind::FunctionReset || kind == CommandKind::Sql ||
        kind == CommandKind::Declare || kind == CommandKind::Error || kind == CommandKind::TabdataRead ||
        kind == CommandKind::TabdataWrite || kind == CommandKind::TabdataAdd || kind == CommandKind::OpenFile ||
        kind == CommandKind::SelectCycle;
    if (!sameInBoth) return refuse(fmt::format("{} has no twin in DIN/ISO", name));
    word(klartext::writeCommand(block_, command));
  }

  /// "0.1 Z X+0 Y+0 Z-40" and "0.2 X+100 IY+50".
  void blankForm(std::string_view text) {
    const bool first = text.starts_with("0.1 ");
    if (!first && !text.starts_with("0.2 ")) return refuse("this form of BLK FORM has no twin in DIN/ISO");
    klartext::Lexer lexer(text.substr(4));
    std::string out = first ? "G30" : "G31";
    if (first) {
      const char axis = lexer.peek();
      if (axis < 'X' || axis > 'Z') return refuse("this form of BLK FORM has no twin in DIN/ISO");
      lexer.advance();
      out += axis == 'Z' ? " G17" : axis == 'Y' ? " G18" : " G19";
    }
    std::optional<bool> incremental;
    while (!lexer.atEnd()) {
      const bool isIncremental = lexer.accept('I');
      const char axis = lexer.peek();
      if (axis < 'X' || axis > 'Z') return refuse("this form of BLK FORM has no twin in DIN/ISO");
      lexer.advance();
      const std::string_view coordinateText = lexer.chunk();
      if (incremental != isIncremental) out += isIncremental ? " G91" : " G90";
      incremental = isIncremental;
      out += fmt::format(" {}{}", axis, coordinateText);
    }
    word(out);
  }

  void add(const Modal& modal) {
    const std::string_view name = at(modal.name);
    if (!name.starts_with("FUNCTION")) return refuse(fmt::format("{} has no twin in DIN/ISO", name));
    Block alone = block_;
    alone.instructions = {modal};
    alone.source.length = 0;
    alone.skippable = false;
    // Without its own text the block has no comment; words of REFPNT are not kept by Klartext either.
    word(klartext::writeBlock(alone));
  }

  template <class Other>
  void add(const Other&) {
    refuse("this block has no twin in DIN/ISO");
  }

  const Block& block_;
  std::string out_;
  std::string reason_;
  std::optional<bool> incremental_;
};

}  // namespace

Result<std::string> writeBlock(const Block& block) {
  Result<std::string> written = BlockWriter(block).write();
  if (!written) return written;
  if (written->find('\n') == std::string::npos) {
    const std::string comment = klartext::commentOf(block);
    if (!comment.empty()) *written += fmt::format(" {}", comment);
  }
  *written += " *";
  if (block.skippable) return fmt::format("/{}", *written);
  return written;
}

}  // namespace probewright::language::din_iso
