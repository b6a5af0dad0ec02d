#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "conversion/to_klartext.hpp"
#include "cycles/catalogue.hpp"

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
  return formulas_.value(quantity(block, operand));
}

void ToKlartext::jumpIf(const Block& block, const Operand& condition, bool wanted, const std::string& label) {
  const auto test = [&](const std::string& left, const Comparison& comparison, const std::string& right) {
    line(fmt::format("FN {}: IF {} {} {} GOTO LBL \"{}\"", comparison.function, left, comparison.name, right, label));
  };
  const Node* node = condition.node >= 0 ? &block.nodes[static_cast<std::size_t>(condition.node)] : nullptr;
  const Operation operation = node == nullptr ? Operation::Number : node->operation;
  switch (operation) {
    case Operation::Not:
      return jumpIf(block, node->left, !wanted, label);
    case Operation::And:
    case Operation::Or: {
      const bool either = (operation == Operation::Or) == wanted;
      if (either) {
        jumpIf(block, node->left, wanted, label);
        jumpIf(block, node->right, wanted, label);
        return;
      }
      const std::string past = fmt::format("AND_{}", nextLabel_++);
      jumpIf(block, node->left, !wanted, past);
      jumpIf(block, node->right, wanted, label);
      line(fmt::format("LBL \"{}\"", past));
      return;
    }
    case Operation::Equal:
    case Operation::NotEqual:
    case Operation::Less:
    case Operation::LessEqual:
    case Operation::Greater:
    case Operation::GreaterEqual: {
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

void ToKlartext::jump(const Block& block, const Jump& jump) {
  if (jump.direction == JumpDirection::ProgramStart || jump.label.length == 0) {
    throw NotCarriedOver("jumps to the program's start or to computed labels have no twin in Klartext");
  }
  const std::string target(block.at(jump.label));
  if (!jump.condition.present()) return goTo(target);
  jumpIf(block, jump.condition, true, target);
}

void ToKlartext::repeat(const Block& block, const RepeatSection& section) {
  const std::string from(block.at(section.from));
  const Quantity times = section.times.present() ? quantity(block, section.times) : Quantity(1);
  if (section.onlyBlock) throw NotCarriedOver("REPEATB has no twin in Klartext", "write REPEAT with two labels");
  if (section.to.length == 0) {
    return line(fmt::format("CALL LBL \"{}\" REP{}", from, formulas_.unsignedValue(times)));
  }
  if (!times.isNumber()) throw NotCarriedOver("how often the section is repeated is known only when the program runs");
  for (int i = 0; i < static_cast<int>(times.number()); ++i)
    line(fmt::format("CALL LBL \"{}\"", from));
  forgetPosition();
}

void ToKlartext::call(const Block& block, const CallProgram& call) {
  if (call.modal || call.from.length != 0)
    throw NotCarriedOver("modal calls and calls of a section of a program have no twin in Klartext",
                         "write each call out");
  if (call.maybeCycle && cycles::sinumerikCycle(block.at(call.name)) != nullptr) return cycle(block, call);
  if (block.at(call.name) == "CYCLE800") return swivel(block, call);
  if (call.name.length == 0) throw NotCarriedOver("a program whose name is computed has no twin in Klartext");
  const std::string name(block.at(call.name));
  const bool hasArguments =
      std::ranges::any_of(std::span<const Word>(block.words).subspan(call.arguments.first, call.arguments.count),
                          [](const Word& word) { return word.value.present(); });
  if (hasArguments) {
    throw NotCarriedOver(fmt::format("{} is called with arguments, which programs in Klartext do not take", name),
                         "hand values over in Q parameters");
  }
  const Quantity times = call.times.present() ? quantity(block, call.times) : Quantity(1);
  if (!times.isNumber()) throw NotCarriedOver("how often the program is called is known only when it runs");
  for (int i = 0; i < static_cast<int>(times.number()); ++i)
    line(fmt::format("CALL PGM {}", name));
  out_.list(block, fmt::format("program {} is called as it stands", name), "convert it too");
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
    if (opens && open_.size() == depth) open_.push_back({kind, {}, {}, {}, {}, false, true});
    throw;
  }
}

void ToKlartext::carryOver(const Block& block, const Structured& structured) {
  const auto named = [this](const char* what) { return fmt::format("{}_{}", what, nextLabel_++); };
  Open* top = open_.empty() ? nullptr : &open_.back();
  switch (structured.kind) {
    case Structure::If: {
      Open opened{structured.kind, {}, named("ENDIF"), named("ELSE"), {}, false};
      jumpIf(block, structured.condition, false, opened.other);
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
      Open opened{structured.kind, named("WHILE"), named("ENDWHILE"), {}, {}, false};
      label(opened.begin);
      jumpIf(block, structured.condition, false, opened.end);
      open_.push_back(opened);
      break;
    }
    case Structure::For: {
      Open opened{structured.kind, named("FOR"), named("ENDFOR"), {}, {}, false};
      opened.counter = formulas_.variable(block, block.variables[structured.variable]);
      line(fmt::format("{} = {}", opened.counter, formulas_.formula(block, structured.from)));
      label(opened.begin);
      const std::string last = comparable(block, structured.to);
      line(fmt::format("FN 11: IF +{} GT {} GOTO LBL \"{}\"", opened.counter, last, opened.end));
      open_.push_back(opened);
      break;
    }
    case Structure::Loop:
    case Structure::Repeat: {
      Open opened{structured.kind, named("LOOP"), named("ENDLOOP"), {}, {}, false};
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
      jumpIf(block, structured.condition, false, begin);
      break;
    }
  }
}

}  // namespace probewright::conversion
