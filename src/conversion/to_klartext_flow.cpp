#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "conversion/to_klartext.hpp"
#include "cycles/catalogue.hpp"
#include "language/sinumerik/check.hpp"

/// Jumps, loops and calls of SINUMERIK programs in Klartext.
namespace probewright::conversion {

using namespace language;

namespace {

/// FN 9 to 12.
struct Comparison {
  int function = 9;
  const char* name = "EQU";
};
constexpr Comparison equal{9, "EQU"}, unequal{10, "NE"}, greater{11, "GT"}, less{12, "LT"};

Operation opposite(Operation operation) {
  switch (operation) {
    case Operation::Equal:
      return Operation::NotEqual;
    case Operation::NotEqual:
      return Operation::Equal;
    case Operation::Less:
      return Operation::GreaterEqual;
    case Operation::GreaterEqual:
      return Operation::Less;
    case Operation::Greater:
      return Operation::LessEqual;
    default:
      return Operation::Greater;
  }
}

}  // namespace

void ToKlartext::label(const std::string& name) {
  line(fmt::format("LBL \"{}\"", name));
  forgetPosition();
  activeRow_.reset();
}

void ToKlartext::goTo(const std::string& label) { line(fmt::format("FN 9: IF +0 EQU +0 GOTO LBL \"{}\"", label)); }

std::string ToKlartext::comparable(const Block& block, const Operand& operand) {
  const Node* node = operand.node >= 0 ? &block.nodes[static_cast<std::size_t>(operand.node)] : nullptr;
  if (node != nullptr && (node->operation == Operation::Text || node->operation == Operation::Concatenate)) {
    const std::string text = formulas_.formula(block, operand);
    const std::string own = formulas_.define(fmt::format("compared {}", text), KlartextFormulas::Holds::Text);
    line(fmt::format("{} = {}", own, text));
    return fmt::format("+{}", own);
  }
  return formulas_.comparedValue(block, operand);
}

void ToKlartext::jumpWhen(When when, const Block& block, const Operand& condition, const std::string& label) {
  const bool wanted = when == When::Holds;
  const When otherwise = wanted ? When::Fails : When::Holds;
  const auto test = [&](const std::string& left, const Comparison& comparison, const std::string& right) {
    line(fmt::format("FN {}: IF {} {} {} GOTO LBL \"{}\"", comparison.function, left, comparison.name, right, label));
  };
  const Node* node = condition.node >= 0 ? &block.nodes[static_cast<std::size_t>(condition.node)] : nullptr;
  const Operation operation = node == nullptr ? Operation::Number : node->operation;
  switch (operation) {
    case Operation::Not:
      return jumpWhen(otherwise, block, node->left, label);
    case Operation::And:
    case Operation::Or: {
      const bool either = (operation == Operation::Or) == wanted;
      if (either) {
        jumpWhen(when, block, node->left, label);
        jumpWhen(when, block, node->right, label);
        return;
      }
      const std::string past = unusedLabel("AND");
      jumpWhen(otherwise, block, node->left, past);
      jumpWhen(when, block, node->right, label);
      line(fmt::format("LBL \"{}\"", past));
      return;
    }
    case Operation::Equal:
    case Operation::NotEqual:
    case Operation::Less:
    case Operation::LessEqual:
    case Operation::Greater:
    case Operation::GreaterEqual: {
      if (rounded_ && rounded_->decide(block, *node)) {
        out_.list(block,
                  "roundings decide this comparison: a SINUMERIK takes numbers for equal that differ by 1e-12 of their "
                  "size, a HEIDENHAIN control only those that are the same",
                  "count in whole numbers, or compare with a number that lies between two values");
      }
      const std::string left = comparable(block, node->left), right = comparable(block, node->right);
      switch (wanted ? operation : opposite(operation)) {
        case Operation::Equal:
          return test(left, equal, right);
        case Operation::NotEqual:
          return test(left, unequal, right);
        case Operation::Less:
          return test(left, less, right);
        case Operation::Greater:
          return test(left, greater, right);
        case Operation::LessEqual:
          test(left, less, right);
          return test(left, equal, right);
        default:
          test(left, greater, right);
          return test(left, equal, right);
      }
    }
    default:
      return test(comparable(block, condition), wanted ? unequal : equal, "+0");
  }
}

std::string ToKlartext::unusedLabel(std::string_view name) {
  std::string unused(name);
  // The numbers that a name has had already need no second look: programs may have thousands of one name.
  int& next = nextNumberOfLabel_.try_emplace(unused, 2).first->second;
  while (!usedLabels_.insert(unused).second)
    unused = fmt::format("{}_{}", name, next++);
  return unused;
}

void ToKlartext::surveyFlow() {
  const std::vector<FlowBlock>& blocks = graph_.blocks();
  Block block;
  Diagnostics ignored;
  const auto name = [&](std::size_t place) {
    if (labels_.contains(blocks[place].position.offset)) return;
    program_.parse(blocks[place].position, block, ignored);
    const std::string_view own = block.at(block.label);
    labels_.emplace(blocks[place].position.offset, unusedLabel(own.empty() ? "START" : own));
  };
  // A label may be in a SINUMERIK program more than once: each place gets a name of its own.
  for (const FlowBlock& each : blocks) {
    program_.parse(each.position, block, ignored);
    const bool jumps = std::ranges::any_of(block.instructions, [](const Instruction& instruction) {
      const auto* jump = std::get_if<Jump>(&instruction);
      return jump != nullptr && jump->direction != JumpDirection::ProgramStart;
    });
    const std::vector<std::size_t> targets = each.jumps;
    if (jumps) std::ranges::for_each(targets, name);
    if (each.section) name(each.section->first);
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (!blocks[i].section || blocks[i].section->second == i) continue;
    const auto [first, last] = *blocks[i].section;
    sectionEnds_[blocks[last].position.offset].push_back(i);
    bool stretch = graph_.isClosed(first, last);
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      // Its LBL 0 would end this one too early.
      if (!blocks[k].section || blocks[k].section->second == k) continue;
      stretch = stretch && (blocks[k].section->second < first || blocks[k].section->second >= last);
    }
    sectionsByNumber_ = sectionsByNumber_ || !stretch;
  }
}

std::string ToKlartext::labelAt(const BlockPosition& position) const {
  const auto found = labels_.find(position.offset);
  if (found == labels_.end()) throw NotCarriedOver("the label of this block is not known");
  return found->second;
}

void ToKlartext::jump(const Block& block, const Jump& jump) {
  if (jump.direction == JumpDirection::ProgramStart || jump.label.length == 0) {
    throw NotCarriedOver("jumps to the program's start or to computed labels have no twin in Klartext");
  }
  const auto found = program_.findLabel(block.at(jump.label), block.position, jump.direction);
  if (!found && jump.ignoreMissing) return;
  if (!found) throw NotCarriedOver(fmt::format("there is no label {}", block.at(jump.label)));
  const std::string target = labelAt(*found);
  if (!jump.condition.present()) return goTo(target);
  jumpWhen(When::Holds, block, jump.condition, target);
}

void ToKlartext::repeated(const Quantity& times, Rounds rounds, const std::function<void()>& body) {
  constexpr double fewRounds = 3;
  if (rounds == Rounds::Written && times.isNumber() && times.number() <= fewRounds) {
    for (int i = 0; i < static_cast<int>(times.number()); ++i)
      body();
    return;
  }
  const std::string begin = unusedLabel("AGAIN"), end = unusedLabel("ENDAGAIN");
  const std::string count = formulas_.define(begin);
  line(fmt::format("{} = {}", count, spacedExpressionText(times)));
  label(begin);
  line(fmt::format("FN 12: IF +{} LT +1 GOTO LBL \"{}\"", count, end));
  line(fmt::format("{0} = {0} - 1", count));
  body();
  goTo(begin);
  label(end);
}

void ToKlartext::repeat(const Block& block, const RepeatSection& section) {
  const auto own = graph_.at(block.position);
  const auto stretch = own ? graph_.blocks()[*own].section : std::nullopt;
  if (!stretch) throw NotCarriedOver("the section to repeat is not known");
  const std::string from = labelAt(graph_.blocks()[stretch->first].position);
  const Quantity times = section.times.present() ? quantity(block, section.times) : Quantity(1);
  if (!graph_.isClosed(stretch->first, stretch->second)) {
    out_.list(block,
              "jumps leave the repeated section: a SINUMERIK ends its repetition then, and the section here does not",
              "let the jumps lead to the end of the section");
  }
  const bool never = times.isNumber() && times.number() < 1;  // REP 0 calls the label as a subprogram
  if (never && stretch->second == *own) return;
  if (stretch->second == *own) {
    line(fmt::format("CALL LBL \"{}\" REP{}", from, formulas_.unsignedValue(times)));
  } else if (!sectionsByNumber_) {
    repeated(times, Rounds::Written, [&] { line(fmt::format("CALL LBL \"{}\"", from)); });
  } else {
    const std::string current = formulas_.define("section under way");
    const std::string before = formulas_.define(fmt::format("section before {}", *own));
    repeated(times, Rounds::Counted, [&] {
      line(fmt::format("{} = {}", before, current));
      line(fmt::format("{} = {}", current, *own + 1));
      goTo(from);
      label(backFrom(*own));
      line(fmt::format("{} = {}", current, before));
    });
  }
  forgetPosition();
  activeRow_.reset();
}

std::string ToKlartext::backFrom(std::size_t repetition) {
  auto& label = backLabels_[repetition];
  if (label.empty()) label = unusedLabel(fmt::format("BACK_{}", repetition));
  return label;
}

void ToKlartext::endSections(const Block& block) {
  const auto found = sectionEnds_.find(block.position.offset);
  if (found == sectionEnds_.end()) return;
  if (!sectionsByNumber_) return line("LBL 0");
  const std::string current = formulas_.define("section under way");
  for (const std::size_t each : found->second)
    line(fmt::format("FN 9: IF +{} EQU +{} GOTO LBL \"{}\"", current, each + 1, backFrom(each)));
}

/// Whether the block after this one selects the unit of this program again.
bool ToKlartext::selectsUnitNext(const Block& block) {
  Block next;
  Diagnostics ignored;
  if (!program_.parse(block.next, next, ignored)) return true;  // the program ends
  const SelectedUnit own = millimetre_ == 1 ? SelectedUnit::Millimetre : SelectedUnit::Inch;
  return std::ranges::any_of(next.instructions, [&](const Instruction& each) { return unitOf(next, each) == own; });
}

void ToKlartext::call(const Block& block, const CallProgram& call) {
  if (call.modal || call.from.length != 0)
    throw NotCarriedOver("modal calls and calls of a section of a program have no twin in Klartext",
                         "write each call out");
  if (call.maybeCycle && cycles::sinumerikCycle(block.at(call.name)) != nullptr) return cycle(block, call);
  if (block.at(call.name) == "CYCLE800") return swivel(block, call);
  if (call.name.length == 0) throw NotCarriedOver("a program whose name is computed has no twin in Klartext");
  const std::string name(block.at(call.name));
  if (leavesOut(block, name)) return;
  if (language::sinumerik::isMeasuringCycle(name) || language::sinumerik::isSkippedCycle(name) ||
      language::sinumerik::isCycleWithoutEffect(name)) {
    throw NotCarriedOver(fmt::format("{} has no twin on a HEIDENHAIN control", name),
                         "docs/conversion.md lists the cycles that both controls have");
  }
  const bool hasArguments =
      std::ranges::any_of(std::span<const Word>(block.words).subspan(call.arguments.first, call.arguments.count),
                          [](const Word& word) { return word.value.present(); });
  const auto* header = headerOf(name);
  if (hasArguments && header == nullptr) {
    throw NotCarriedOver(fmt::format("{} is called with arguments, and its PROC line was not found", name),
                         "put it into the folder of this program, or pass values in Q parameters");
  }
  const auto units = unitsOf_.find(upperCase(name));
  const bool inch = millimetre_ != 1;
  if (units != unitsOf_.end() && (inch ? units->second.metric : units->second.inch) && !selectsUnitNext(block)) {
    out_.list(block,
              fmt::format("{} leaves this program in {}, and a HEIDENHAIN program has its own unit all the time", name,
                          inch ? "mm" : "inches"),
              fmt::format("program {} after the call", inch ? "G700" : "G710"));
  }
  const Quantity times = call.times.present() ? quantity(block, call.times) : Quantity(1);
  repeated(times, Rounds::Written, [&] {
    if (header != nullptr) return callWithArguments(block, call, *header);
    line(fmt::format("CALL PGM {}", name));
  });
  out_.list(block, fmt::format("program {} is called as it stands", name), "convert it too",
            job_.programs.contains(name) ? Severity::Note : Severity::Warning);
  if (!frame_.known || std::ranges::any_of(frame_.shift, [](const Quantity& each) { return !(each == 0); }) ||
      !frame_.rotation || !(*frame_.rotation == 0)) {
    out_.list(block, fmt::format("{} is called with a frame: touch probe cycles in it permit none", name),
              "cancel the frame before the call if it measures");
  }
  forgetPosition();
}

void ToKlartext::structured(const Block& block, const Structured& structured) {
  const Structure kind = structured.kind;
  const bool opens = kind == Structure::If || kind == Structure::While || kind == Structure::For ||
                     kind == Structure::Loop || kind == Structure::Repeat;
  const std::size_t depth = open_.size();
  if (!opens && (open_.empty() || open_.back().lost)) {
    if (!open_.empty() && kind != Structure::Else) open_.pop_back();
    throw NotCarriedOver("the statement that this one belongs to is not carried over");
  }
  try {
    carryOver(block, structured);
  } catch (const NotCarriedOver&) {
    // What closes it must find it all the same.
    if (opens && open_.size() == depth) {
      Open& opened = open_.emplace_back();
      opened.kind = kind;
      opened.lost = true;
    }
    throw;
  }
}

void ToKlartext::carryOver(const Block& block, const Structured& structured) {
  const auto named = [this](const char* what) { return unusedLabel(what); };
  Open* top = open_.empty() ? nullptr : &open_.back();
  switch (structured.kind) {
    case Structure::If: {
      Open opened{.kind = structured.kind, .end = named("ENDIF"), .other = named("ELSE")};
      jumpWhen(When::Fails, block, structured.condition, opened.other);
      open_.push_back(opened);
      break;
    }
    case Structure::Else:
      goTo(top->end);
      label(top->other);
      top->hasElse = true;
      break;
    case Structure::EndIf:
      label(top->hasElse ? top->end : top->other);
      open_.pop_back();
      break;
    case Structure::While: {
      Open opened{.kind = structured.kind, .begin = named("WHILE"), .end = named("ENDWHILE")};
      label(opened.begin);
      jumpWhen(When::Fails, block, structured.condition, opened.end);
      open_.push_back(opened);
      break;
    }
    case Structure::For: {
      Open opened{.kind = structured.kind, .begin = named("FOR"), .end = named("ENDFOR")};
      const VariableRef& counter = block.variables[structured.variable];
      opened.counter = formulas_.variable(block, counter);
      line(fmt::format("{} = {}", opened.counter, formulas_.assigned(block, counter, structured.from)));
      label(opened.begin);
      const std::string last = comparable(block, structured.to);
      line(fmt::format("FN 11: IF +{} GT {} GOTO LBL \"{}\"", opened.counter, last, opened.end));
      open_.push_back(opened);
      break;
    }
    case Structure::Loop:
    case Structure::Repeat: {
      Open opened{.kind = structured.kind, .begin = named("LOOP"), .end = named("ENDLOOP")};
      label(opened.begin);
      open_.push_back(opened);
      break;
    }
    case Structure::EndFor:
      line(fmt::format("{0} = {0} + 1", top->counter));
      [[fallthrough]];
    case Structure::EndWhile:
    case Structure::EndLoop:
      goTo(top->begin);
      label(top->end);
      open_.pop_back();
      break;
    case Structure::Until: {
      const std::string begin = top->begin;
      open_.pop_back();
      jumpWhen(When::Fails, block, structured.condition, begin);
      break;
    }
  }
}

}  // namespace probewright::conversion
