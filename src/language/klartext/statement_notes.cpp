#include "language/klartext/statement_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "base/number_text.hpp"
#include "language/klartext/commands.hpp"
#include "language/klartext/control_blocks.hpp"
#include "language/klartext/global_groups.hpp"
#include "language/klartext/lexer.hpp"
#include "language/klartext/m_functions.hpp"
#include "language/klartext/system_data_numbers.hpp"

namespace probewright::language::klartext {

namespace {

/// Cycles of CYCL DEF and G that the controls have; 300 to 399 and 500 to 599 belong to machine tool builders.
bool isCycle(int number) {
  constexpr std::array<std::pair<int, int>, 8> ranges = {
      {{0, 39}, {200, 599}, {600, 601}, {800, 899}, {1000, 1099}, {1200, 1299}, {1400, 1499}, {1500, 1599}}};
  return std::ranges::any_of(ranges, [&](const auto& r) { return number >= r.first && number <= r.second; });
}

std::span<const Word> wordsOf(const Block& block, WordRange range) {
  return std::span<const Word>(block.words).subspan(range.first, range.count);
}

}  // namespace

std::vector<StatementNotes::Note> StatementNotes::of(const Block& block) {
  notes_.clear();
  for (const Instruction& instruction : block.instructions) {
    std::visit([&](const auto& each) { look(block, each); }, instruction);
    if (const auto lacked = lackedBlock(kind_, block, instruction)) {
      note(Severity::Error, fmt::format("the {} does not have {}", control::name(kind_), lacked->name),
           std::string(lacked->advice));
    }
  }
  return std::exchange(notes_, {});
}

void StatementNotes::look(const Block&, const CallLabel&) { toolAxis_ = poleAxis_ = 0; }

void StatementNotes::look(const Block&, const CallProgram&) { toolAxis_ = poleAxis_ = 0; }

void StatementNotes::look(const Block&, const ToolCall& call) {
  if (call.cuttingSpeed.present() && !std::exchange(namedCuttingSpeed_, true)) {
    note(Severity::Warning, "the cutting speed VC of TOOL CALL is not carried out",
         "the run continues without it; --strict refuses it; write S with the spindle speed");
  }
  if (call.axis == 0 || call.axis == toolAxis_) return;
  toolAxis_ = call.axis;
  poleAxis_ = 0;
}

/// Each M function that the run names, once; whether a machine has those of its builder is not known here.
void StatementNotes::look(const Block&, const MachineFunction& function) {
  const FunctionEffect effect = effectOf(function.number, kind_);
  if (effect != FunctionEffect::NotCarriedOut && effect != FunctionEffect::OfOtherOne) return;
  if (!named_.insert(function.number).second) return;
  if (effect == FunctionEffect::NotCarriedOut) {
    note(Severity::Warning, fmt::format("M{} is not carried out", function.number),
         "the run continues without it; --strict refuses it");
  } else {
    note(Severity::Warning, fmt::format("the {} does not have M{}", control::name(kind_), function.number),
         "the run continues without it unless the machine has it; --strict refuses it");
  }
}

/// CC with two axes has their plane, CC without any the one of the tool axis.
void StatementNotes::followPole(const Block& block, const Move& move) {
  std::string missing = "XYZ";
  for (const Word& word : wordsOf(block, move.words))
    std::erase(missing, static_cast<char>(word.address));
  if (missing.size() == 3) poleAxis_ = toolAxis_;
  if (missing.size() == 2) poleAxis_ = 0;
  if (missing.size() == 1) poleAxis_ = missing.front();
}

/// An axis of the pole's plane beside PR and PA.
void StatementNotes::mixture(const Block& block, const Move& move) {
  for (const Word& word : wordsOf(block, move.words)) {
    if (word.address < 'X' || word.address > 'Z' || static_cast<char>(word.address) == poleAxis_) continue;
    note(Severity::Error,
         fmt::format("beside polar coordinates only {} may stand, not {}, which lies in their plane", poleAxis_,
                     addressName(word.address)),
         fmt::format("take {} away, or write the end point in X, Y, Z", addressName(word.address)));
  }
}

void StatementNotes::look(const Block& block, const LabelMark& mark) {
  toolAxis_ = poleAxis_ = 0;
  const std::string_view label = block.at(mark.label);
  if (!std::ranges::all_of(label, isDigit)) return;
  const int highest = kind_ == control::ControlKind::TNC640 ? 65535 : 999;
  const auto number = parseInteger(label);
  if (number && *number <= highest) return;
  note(Severity::Error, fmt::format("there is no label number {}", label.substr(0, 20)),
       fmt::format("label numbers go up to {} on the {}", highest, control::name(kind_)));
}

void StatementNotes::systemDatum(const Block& block, const Command& command) {
  const bool reads = kindOf(block, command) == CommandKind::Fn18;
  const std::span<const Word> words = wordsOf(block, command.words);
  /// The number of a word, 0 where it does not stand; nothing if it is computed.
  const auto numberOf = [&](std::string_view address) -> std::optional<double> {
    const auto word = std::ranges::find(words, addressOf(address), &Word::address);
    if (word == words.end()) return 0;
    const bool known = word->value.isLiteral() && std::abs(word->value.number) <= 1e6;
    return known ? std::optional(word->value.number) : std::nullopt;
  };
  const auto id = numberOf("ID"), number = numberOf("NR"), index = numberOf("IDX"), value = numberOf("VAL");
  if (!id || !number) return;
  const auto whole = [](double from) { return static_cast<int>(std::lround(from)); };
  const auto known = [&](std::optional<int> place) {
    return reads ? canRead(whole(*id), whole(*number), place, kind_)
                 : canWrite(whole(*id), whole(*number), place, kind_);
  };
  const std::string datum = fmt::format("ID{} NR{}", whole(*id), whole(*number));
  const auto stops = [&](const std::string& what, std::string_view condition, std::string advice) {
    note(Severity::Warning,
         fmt::format("FN {} {}: the run stops at this block{}", reads ? "18 cannot read" : "17 cannot write", what,
                     condition),
         std::move(advice));
  };
  if (!known(std::nullopt)) {
    stops(datum + " here", "", "use another system datum, or set the parameter to a fixed value");
  } else if (index && !known(whole(*index))) {
    stops(fmt::format("{} IDX{} here", datum, whole(*index)), "",
          "give the IDX of an axis, row or parameter that the datum has");
  } else if (!reads && (whole(*id) == 50 || whole(*id) == 950) && whole(*number) == 36 && value &&
             !isToolType(*value)) {
    // The newer control has the column always.
    stops(fmt::format("{} = {}", datum, formatShortest(*value)),
          kind_ == control::ControlKind::TNC640 ? "" : " if TOOL.T has a column TYP",
          "write 0, a mill, or 21, a touch probe; enter other types in the column TYP of TOOL.T");
  }
}

void StatementNotes::globalDefinition(const Block& block, const Command& command) {
  const std::span<const Word> words = wordsOf(block, command.words);
  if (words.empty()) return;
  auto mistake = mistakeInGlobalDefinition(static_cast<int>(words.front().value.number), words.subspan(1));
  if (mistake) note(Severity::Warning, mistake->message + ": the run stops at this block", std::move(mistake->advice));
}

/// Values of FN 15: PRINT are numbers and parameters, separated by /.
void StatementNotes::printed(std::string_view text) {
  while (!text.empty()) {
    std::string_view item = text.substr(0, text.find('/'));
    text.remove_prefix(std::min(item.size() + 1, text.size()));
    item = trimmed(item, blanksAndReturn);
    if (item.starts_with('+')) item.remove_prefix(1);
    if (item.empty() || upper(item.front()) == 'Q' || parseDecimal(item)) continue;
    note(Severity::Warning,
         fmt::format("{} is neither a number nor a Q parameter: the run stops at this block", item.substr(0, 40)),
         "write FN 15: PRINT Q5/Q6");
  }
}

void StatementNotes::look(const Block& block, const Command& command) {
  const CommandKind kind = kindOf(block, command);
  if (kind == CommandKind::Fn17 || kind == CommandKind::Fn18) systemDatum(block, command);
  if (kind == CommandKind::Fn15 && kind_ == control::ControlKind::TNC640) {
    note(Severity::Warning, "the TNC 640 has no FN 15", "write texts and values with FN 16: F-PRINT");
  } else if (kind == CommandKind::Fn15) {
    printed(block.at(command.text));
  }
  if (kind == CommandKind::GlobalDefinition) globalDefinition(block, command);
  if (kind == CommandKind::Fn21 || kind == CommandKind::Fn22) {
    note(Severity::Warning, fmt::format("the control has no FN {}", nameOf(kind).substr(2)), "take the block out");
  }
  if (kind == CommandKind::CycleCall) toolAxis_ = poleAxis_ = 0;  // it may call a program
  if (kind == CommandKind::CycleCall || kind == CommandKind::PatternDefinition || kind == CommandKind::DwellTime ||
      kind == CommandKind::ProgramCall || kind == CommandKind::SpindleOrientation || kind == CommandKind::Tolerance)
    endContour();
}

void StatementNotes::look(const Block& block, const CycleCall& call) {
  endContour();
  if (block.at(call.name) != "CYCL DEF" || isCycle(call.number)) return;
  note(Severity::Error, fmt::format("there is no cycle {}", call.number), "check its number");
}

void StatementNotes::look(const Block& block, const Transform& transform) {
  endContour();
  if (kindOf(block, transform) != TransformKind::PlaneAxial) return;
  for (const Word& word : wordsOf(block, transform.words)) {
    for (const std::string_view option : {"SEQ", "SYM", "TABL", "COOR"}) {
      if (word.address != addressOf(option)) continue;
      note(Severity::Warning,
           fmt::format("{} has no effect in PLANE AXIAL", option == "TABL"   ? "TABLE ROT"
                                                          : option == "COOR" ? "COORD ROT"
                                                                             : option),
           "the axis angles already say where the axes are");
    }
  }
}

namespace {

constexpr std::array<std::string_view, 3> textFunctions = {"TOCHAR", "SUBSTR", "SYSSTR"};

/// Whether a value is a text, as far as its block tells.
std::optional<bool> isTextual(const Block& block, const Operand& operand) {
  if (operand.isLiteral()) return false;
  if (!operand.present()) return std::nullopt;
  const Node& node = block.nodes[static_cast<std::size_t>(operand.node)];
  switch (node.operation) {
    case Operation::Text:
    case Operation::Concatenate:
      return true;
    case Operation::Variable:
      return block.variables[node.a].space == VariableSpace::QS;
    case Operation::Call:
      if (node.function != Function::Host) return false;
      if (std::ranges::find(textFunctions, block.at(node.text)) != textFunctions.end()) return true;
      return std::nullopt;
    default:
      return false;
  }
}

}  // namespace

void StatementNotes::look(const Block& block, const Assign& assign) {
  const bool takesText = block.variables[assign.variable].space == VariableSpace::QS;
  if (isTextual(block, assign.value) == !takesText) {
    note(Severity::Warning,
         fmt::format("a {} takes a {}: the run stops at this block", takesText ? "QS parameter" : "Q parameter",
                     takesText ? "text, not a number" : "number, not a text"),
         takesText ? "convert the number with TOCHAR" : "use a QS parameter, or TONUMB");
  }
  constexpr double largest = 999'999'999;
  double value = 0;
  if (assign.value.isLiteral()) value = assign.value.number;
  for (const Node& node : block.nodes) {
    for (const Operand& operand : {node.left, node.right}) {
      if (operand.isLiteral() && std::abs(operand.number) > std::abs(value)) value = operand.number;
    }
  }
  if (std::abs(value) <= largest) return;
  note(Severity::Warning, fmt::format("the control takes no number as large as {}", formatShortest(value)),
       "numbers of programs go up to 999 999 999");
}

void StatementNotes::look(const Block& block, const Move& move) {
  if (move.kind == MoveKind::SetCentre) followPole(block, move);
  if (move.polar && poleAxis_ != 0 && block.at(move.variant) != "G") mixture(block, move);
  if (move.kind == MoveKind::Rounding || move.kind == MoveKind::Chamfer) {
    corner_ = move.kind == MoveKind::Rounding ? "RND" : "CHF";
    return;
  }
  const bool path = std::ranges::any_of(wordsOf(block, move.words), [](const Word& word) {
    return word.address != addressOf("FU") && word.address != addressOf("FZ");
  });
  if (path) corner_.clear();
}

/// What ends a contour while a corner still waits.
void StatementNotes::endContour() {
  if (corner_.empty()) return;
  note(Severity::Warning, fmt::format("no contour element follows the last {}", corner_),
       "program the element that the corner leads to before this block");
  corner_.clear();
}

}  // namespace probewright::language::klartext
