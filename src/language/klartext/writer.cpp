#include "language/klartext/writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "language/klartext/block_extent.hpp"
#include "language/klartext/commands.hpp"
#include "language/klartext/cycle_writer.hpp"
#include "language/klartext/formula_writer.hpp"
#include "language/klartext/lexer.hpp"
#include "language/klartext/path_words.hpp"

namespace probewright::language::klartext {

namespace {

bool isNumberLabel(std::string_view label) { return !label.empty() && std::ranges::all_of(label, isDigit); }

/// Writes the instructions of a block one after the other: the block's own first, its M functions after it.
class BlockWriter {
public:
  explicit BlockWriter(const Block& block) : block_(block) {}

  std::string write() {
    const auto isMain = [this](const Instruction& instruction) { return givesKeyword(instruction); };
    const bool hasMain = std::ranges::any_of(block_.instructions, isMain);
    for (const Instruction& instruction : block_.instructions) {
      if (isMain(instruction)) std::visit([this](const auto& i) { add(i); }, instruction);
    }
    bool first = !hasMain;
    for (const Instruction& instruction : block_.instructions) {
      if (isMain(instruction)) continue;
      if (const auto* function = std::get_if<MachineFunction>(&instruction)) {
        machineFunction(*function);
      } else if (const auto* stop = std::get_if<Stop>(&instruction)) {
        word(stop->optional ? "M1" : first ? "STOP" : "M0");
      } else if (std::holds_alternative<EndProgram>(instruction)) {
        word("M30");
      } else {
        word(first ? "CYCL CALL" : "M99");
      }
      first = false;
    }
    return std::move(out_);
  }

private:
  /// True for what gives the block its keyword; M functions, stops, program ends and cycle calls stand after it.
  bool givesKeyword(const Instruction& instruction) const {
    return !std::holds_alternative<MachineFunction>(instruction) && !std::holds_alternative<Stop>(instruction) &&
           !std::holds_alternative<EndProgram>(instruction) && !isPlainCycleCall(instruction);
  }
  /// M99 leaves a command without words and text.
  bool isPlainCycleCall(const Instruction& instruction) const {
    const auto* command = std::get_if<Command>(&instruction);
    return command != nullptr && command->words.count == 0 && command->text.length == 0 &&
           kindOf(block_, *command) == CommandKind::CycleCall;
  }

  void word(std::string_view text) {
    if (!out_.empty()) out_ += ' ';
    out_ += text;
  }
  std::string value(const Operand& operand) const { return writeValue(block_, operand); }
  std::string_view at(TextRef ref) const { return block_.at(ref); }
  std::span<const Word> wordsOf(WordRange range) const {
    return std::span<const Word>(block_.words).subspan(range.first, range.count);
  }
  void valued(std::string_view name, const Operand& operand) {
    if (operand.present()) word(fmt::format("{}{}", name, value(operand)));
  }
  std::string label(TextRef text, const Operand& computed) const {
    if (computed.present()) return writeFormula(block_, computed);
    if (isNumberLabel(at(text)) || at(text).starts_with('"')) return std::string(at(text));
    return fmt::format("\"{}\"", at(text));
  }

  void machineFunction(const MachineFunction& function) {
    word(fmt::format("M{}", function.number));
    for (const Word& w : wordsOf(function.words)) {
      const bool isMax = !w.value.present() && w.address == addressOf("MB");
      word(isMax ? "MB MAX" : fmt::format("{}{}", addressName(w.address), value(w.value)));
    }
    valued("F", function.argument);
  }

  void add(const Move& move) {
    const bool isArc = move.kind == MoveKind::ArcClockwise || move.kind == MoveKind::ArcCounterclockwise ||
                       move.kind == MoveKind::Modal;
    // R+ and R- are radius compensations.
    const bool hasRadius = std::ranges::any_of(
        wordsOf(move.words), [](const Word& w) { return w.address == 'R' && w.mode != WordMode::DirectShortest; });
    const bool directed = std::ranges::any_of(
        wordsOf(move.words), [](const Word& w) { return takes(pathWords("LN"), w) && !takes(pathWords("L"), w); });
    switch (move.kind) {
      case MoveKind::SetCentre:
        word("CC");
        break;
      case MoveKind::Chamfer:
        word("CHF");
        break;
      case MoveKind::Rounding:
        word("RND");
        break;
      case MoveKind::ArcTangential:
        word(move.polar ? "CTP" : "CT");
        break;
      case MoveKind::Approach:
        word(fmt::format("APPR {}{}", move.polar ? "P" : "", at(move.variant)));
        break;
      case MoveKind::Depart:
        word(fmt::format("DEP {}{}", move.polar ? "P" : "", at(move.variant)));
        break;
      default:
        word(isArc ? (move.polar ? "CP" : hasRadius ? "CR" : "C") : move.polar ? "LP" : directed ? "LN" : "L");
        break;
    }
    for (const Word& w : wordsOf(move.words)) {
      if (w.address == addressOf("DR")) {
        word(w.value.number > 0 ? "DR+" : "DR-");
      } else if (w.address == 'R' && w.mode == WordMode::DirectShortest) {
        word(w.value.number > 0 ? "R+" : "R-");
      } else if (w.address == 'R' && move.kind == MoveKind::Chamfer) {
        word(value(w.value));
      } else {
        const char* incremental = w.mode == WordMode::Incremental ? "I" : "";
        word(fmt::format("{}{}{}", incremental, addressName(w.address), value(w.value)));
      }
    }
    switch (move.compensation) {
      case RadiusCompensation::Off:
        word("R0");
        break;
      case RadiusCompensation::Left:
        word("RL");
        break;
      case RadiusCompensation::Right:
        word("RR");
        break;
      case RadiusCompensation::Unchanged:
        break;
    }
    if (move.feed.present()) word(fmt::format("F{}", unsignedValue(move.feed)));
    if (move.rapid) word("FMAX");
    if (move.autoFeed) word("FAUTO");
    if (move.machineCoordinates) word("M91");
    if (move.machineReference2) word("M92");
  }

  std::string unsignedValue(const Operand& operand) const {
    const std::string text = value(operand);
    return text.starts_with('+') ? text.substr(1) : text;
  }

  void add(const ToolCall& call) {
    word("TOOL CALL");
    if (call.name.present()) {
      word(writeFormula(block_, call.name));
    } else if (call.number.present()) {
      std::string number = unsignedValue(call.number);
      if (call.index.present()) number += fmt::format(".{}", unsignedValue(call.index));
      word(number);
    }
    if (call.axis != 0) word(std::string_view(&call.axis, 1));
    if (call.spindleSpeed.present()) word(fmt::format("S{}", unsignedValue(call.spindleSpeed)));
    if (call.cuttingSpeed.present()) word(fmt::format("S(VC={})", unsignedValue(call.cuttingSpeed)));
    if (call.feed.present()) word(fmt::format("F{}", unsignedValue(call.feed)));
    valued("DL", call.deltaLength);
    valued("DR", call.deltaRadius);
    if (call.deltaRadius2.present()) word(fmt::format("DR2{}", value(call.deltaRadius2)));
  }

  void add(const Assign& assign) {
    const std::string target = writeVariable(block_.variables[assign.variable]);
    if (assign.value.node >= 0) {
      const Node& node = block_.nodes[static_cast<std::size_t>(assign.value.node)];
      const bool angle = node.operation == Operation::Call && node.function == Function::Host && at(node.text) == "ANG";
      const bool distance = node.operation == Operation::Call && node.function == Function::RootSumOfSquares;
      if (angle || distance) {
        word(fmt::format("FN {}: {} = {} {} {}", angle ? 13 : 8, target, value(block_.operands[node.a]),
                         angle ? "ANG" : "LEN", value(block_.operands[node.a + 1])));
        return;
      }
    }
    word(fmt::format("{} = {}", target, writeFormula(block_, assign.value)));
  }

  void add(const Jump& jump) {
    const Node* node = &block_.nodes[static_cast<std::size_t>(std::max(jump.condition.node, 0))];
    const bool inverted = node->operation == Operation::Not;
    if (inverted) node = &block_.nodes[static_cast<std::size_t>(node->left.node)];
    if (node->operation == Operation::Undefined) {
      word(fmt::format("FN 9: IF +{} IS {} GOTO LBL {}", writeVariable(block_.variables[node->a]),
                       inverted ? "DEFINED" : "UNDEFINED", label(jump.label, jump.labelValue)));
      return;
    }
    const auto [number, name] = node->operation == Operation::Equal      ? std::pair(9, "EQU")
                                : node->operation == Operation::NotEqual ? std::pair(10, "NE")
                                : node->operation == Operation::Greater  ? std::pair(11, "GT")
                                                                         : std::pair(12, "LT");
    word(fmt::format("FN {}: IF {} {} {} GOTO LBL {}", number, value(node->left), name, value(node->right),
                     label(jump.label, jump.labelValue)));
  }

  void add(const LabelMark& mark) { word(fmt::format("LBL {}", label(mark.label, {}))); }
  void add(const CallLabel& call) {
    word(fmt::format("CALL LBL {}", label(call.label, call.labelValue)));
    if (call.repeats.present()) word(fmt::format("REP{}", unsignedValue(call.repeats)));
  }
  void add(const CallProgram& call) {
    if (call.nameValue.present()) {
      const Node& node = block_.nodes[static_cast<std::size_t>(call.nameValue.node)];
      const bool selected = node.operation == Operation::Call;
      word(selected ? std::string("CALL SELECTED PGM")
                    : fmt::format("CALL PGM {}", writeFormula(block_, call.nameValue)));
      return;
    }
    word(fmt::format("CALL PGM {}", writePath(at(call.name))));
  }
  void add(const Transform& transform) { word(writeTransform(block_, transform)); }
  void add(const CycleCall& call) { word(writeCycle(block_, call)); }
  void add(const Modal& modal) {
    word(at(modal.name));
    for (const Word& w : wordsOf(modal.words)) {
      const bool one = w.value.number != 0;
      const std::string address = addressName(w.address);
      if (address == "FLIM") {
        word(w.value.present() ? fmt::format("F{}", unsignedValue(w.value)) : std::string("FMAX"));
        continue;
      }
      if (address == "F") word(one ? "F TCP" : "F CONT");
      if (address == "AXIS") word(one ? "AXIS POS" : "AXIS SPAT");
      if (address == "PATH") word(one ? "PATHCTRL AXIS" : "PATHCTRL VECTOR");
      if (address == "REFP") {
        word(!one ? "REFPNT TIP-TIP" : w.value.number == 1 ? "REFPNT TIP-CENTER" : "REFPNT CENTER-CENTER");
      }
    }
  }
  void add(const Command& command) { word(writeCommand(block_, command)); }

  template <class Other>
  void add(const Other&) {
    word("ERROR = this block has no form in Klartext");
  }

  const Block& block_;
  std::string out_;
};

}  // namespace

std::string writeBlock(const Block& block) {
  const std::string_view source = withoutBlockNumber(block.at(block.source));
  Lexer lexer(source);
  std::string text;
  if (block.instructions.empty() || lexer.acceptKeyword("END")) {
    text = source;  // comments, structure, the end of the program
    while (!text.empty() && (isBlankOrReturn(text.back()) || text.back() == '\n'))
      text.pop_back();
    return block.skippable ? fmt::format("/{}", text) : text;
  }
  text = BlockWriter(block).write();
  if (text.find('\n') == std::string::npos) {
    const std::string comment = commentOf(block);
    if (!comment.empty()) text += fmt::format(" {}", comment);
  }
  return block.skippable ? fmt::format("/{}", text) : text;
}

std::string writeProgram(KlartextProgram& program) {
  std::string out;
  Block block;
  Diagnostics mistakes;
  std::uint64_t number = 0;
  for (BlockPosition position = program.begin(); program.parse(position, block, mistakes); position = block.next) {
    const std::string text = writeBlock(block);
    std::string_view rest = text;
    // The parts of an old-form cycle are blocks of their own; continuation lines are not.
    bool continued = false;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      const std::string_view line = rest.substr(0, end);
      out += continued ? fmt::format("{}\n", line) : fmt::format("{} {}\n", number++, line);
      continued = endsWithContinuation(line);
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }
  return out;
}

}  // namespace probewright::language::klartext
