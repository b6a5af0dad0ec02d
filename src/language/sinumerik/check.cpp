#include "language/sinumerik/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "base/text.hpp"
#include "cycles/sinumerik/rotation_offset.hpp"
#include "language/constant_division.hpp"
#include "language/sinumerik/checker.hpp"
#include "language/sinumerik/cursor.hpp"
#include "language/sinumerik/keywords.hpp"
#include "language/sinumerik/known_system_variables.hpp"
#include "language/sinumerik/operators.hpp"
#include "language/sinumerik/writer.hpp"
#include "language/word_column.hpp"

namespace probewright::language::sinumerik {

using namespace language;

std::size_t Checker::columnOf(std::string_view name) const {
  const std::size_t at = upperCase(block_.at(block_.source)).find(name);
  return at == std::string::npos ? 0 : at + 1;
}

Diagnostic Checker::complaint(std::size_t column, std::string message, std::string advice) const {
  Diagnostic mistake;
  const std::uint32_t place =
      column > 0 ? static_cast<std::uint32_t>(column) : columnOfFirstWord(block_.at(block_.source));
  mistake.place = {program_.file(), block_.position.line, place};
  mistake.message = std::move(message);
  mistake.excerpt = std::string(block_.at(block_.source));
  mistake.advice = std::move(advice);
  return mistake;
}

void Checker::report(std::size_t column, std::string message, std::string advice, Severity severity) {
  Diagnostic mistake = complaint(column, std::move(message), std::move(advice));
  mistake.severity = severity;
  found_.push_back(std::move(mistake));
}

void Checker::declare(const Instruction& instruction) {
  const Command* command = std::get_if<Command>(&instruction);
  const std::string_view what = command == nullptr ? std::string_view() : block_.at(command->name);
  begun_ = begun_ || (what != "DEF" && what != "DEFINE" && what != "PROC" && what != "EXTERN");
  if (command == nullptr) return;
  if (what == "DEF") {
    std::string name(block_.at(block_.variables[static_cast<std::size_t>(command->variable)].name));
    if (begun_ && !toldOrder_) {
      toldOrder_ = true;
      report(columnOf("DEF"), "this DEF comes after the first block that is executed",
             "The control refuses it with alarm 14500: put all DEF at the beginning of the program.");
    }
    if (!declared_.insert(name).second)
      report(columnOf(name), "the variable " + name + " is declared twice", "Remove one of the two DEF.");
    if (Type type = Type::Real; typeOf(block_.at(command->text), type)) types_.insert_or_assign(name, type);
  } else if (what == "DEFINE") {
    const std::string text = upperCase(block_.at(command->text));
    macros_.insert(text.substr(0, text.find(' ')));
  }
}

/// A DEF or PROC with a mistake has been reported; that its variables are missing then need not be said again.
void Checker::declareFromBrokenBlock() {
  const std::string line = upperCase(block_.at(block_.source));
  Cursor cursor(line);
  std::string_view word;
  while (!cursor.atEnd() && word != "DEF" && word != "PROC") {
    word = cursor.name();
    if (word.empty()) cursor.advance();
  }
  if (word != "DEF" && word != "PROC") return;
  for (bool inText = false; !cursor.atEnd();) {
    const char c = cursor.peek();
    if (c == '"') inText = !inText;
    if (c == ';' && !inText) return;
    word = inText ? std::string_view() : cursor.name();
    if (word.empty())
      cursor.advance();
    else
      declared_.insert(std::string(word));
  }
}

/// An archive holds several programs, each below the line with its name.
void Checker::checkHeader() {
  const std::string_view line = trimmed(block_.at(block_.source), lineBlanks);
  const bool isHeader = upperCase(line.substr(0, 4)) == "%_N_";
  if (isHeader && begun_) {
    report(0, fmt::format("{} begins another program in the middle of this one", line.substr(0, 60)),
           "A file holds one program: write the other into its own file.", Severity::Error);
  }
}

/// Variables that are not declared, system variables that the control cannot have.
void Checker::checkNames() {
  for (const VariableRef& variable : block_.variables) {
    if (variable.space == VariableSpace::R) continue;
    const std::string name(block_.at(variable.name));
    if (variable.space == VariableSpace::User) {
      oldParameters_ = oldParameters_ || name == "_MVAR";
      const bool defined =
          std::ranges::find(options_.globalData, name, &DeclaredDatum::name) != options_.globalData.end();
      const bool known = declared_.contains(name) || isGlobalUserData(name) || defined ||
                         options_.globalVariables.contains(name) || macros_.contains(name);
      if (known || unknown_.contains(name)) continue;
      unknown_.emplace(name, complaint(columnOf(name), name + " is not declared",
                                       "Declare it at the beginning of the program: DEF REAL " + name +
                                           ", or as global user data in a definition file beside it (UGUD.DEF)."));
      continue;
    }
    const std::string bare = name.starts_with("$$") ? name.substr(1) : name;
    const SystemName known = options_.globalVariables.contains(bare) ? SystemName::Simulated : systemName(bare);
    if (known == SystemName::Simulated || isFrameWithoutEffect(bare) || !told_.insert(bare).second) continue;
    if (known == SystemName::Elsewhere) {
      report(columnOf(name), name + " has no meaning here",
             "It reads as 0 unless a value is given; nothing follows it.", Severity::Warning);
      continue;
    }
    const std::string meant = meantSystemName(bare);
    report(columnOf(name), "the control has no system variable " + name,
           meant.empty() ? "Compare the name with the control's list of system variables."
                         : "Did you mean " + meant + "?");
  }
}

/// "A==1 AND B==2" compares A with (1 AND B): hardly ever meant.
void Checker::checkPriorities() {
  const auto isLogic = [this](const Operand& operand) {
    if (operand.node < 0) return false;
    const Node& node = block_.nodes[static_cast<std::size_t>(operand.node)];
    const bool logic =
        node.operation == Operation::And || node.operation == Operation::Or || node.operation == Operation::ExclusiveOr;
    return logic && node.b != inParentheses;
  };
  for (const Node& node : block_.nodes) {
    const BinaryOperator* op = operatorOf(node.operation);
    if (op == nullptr || op->priority != Priority::Comparison || (!isLogic(node.left) && !isLogic(node.right)))
      continue;
    return report(columnOf(op->symbol), "AND, OR and XOR bind tighter than the comparison beside them",
                  "Put each comparison into parentheses: (R1==1) AND (R2==2).", Severity::Warning);
  }
}

void Checker::checkTarget(TextRef label, JumpDirection direction) {
  const std::string name(block_.at(label));
  if (program_.findLabel(name, block_.position, direction)) return;
  const std::size_t column = columnOf(name);
  const bool elsewhere = program_.findLabel(name, block_.position, JumpDirection::ForwardThenBackward).has_value();
  if (elsewhere) {
    const bool forward = direction == JumpDirection::Forward;
    return report(column,
                  fmt::format("the destination {} exists only {} this block", name, forward ? "before" : "after"),
                  fmt::format("Write {} or GOTO.", forward ? "GOTOB" : "GOTOF"));
  }
  std::vector<std::string_view> labels;
  for (const ProgramStructure::Label& known : program_.structure().labels())
    labels.push_back(known.name);
  const std::string_view close = closestName(name, labels);
  report(column, "the destination " + name + " is missing",
         close.empty() ? "Write " + name + (name[0] == 'N' || name[0] == ':' ? "" : ":") + " before the block to go to."
                       : "Did you mean " + std::string(close) + "?");
}

void Checker::checkInstruction(const Instruction& instruction) {
  if (const auto* jump = std::get_if<Jump>(&instruction)) {
    if (jump->label.length != 0 && !jump->ignoreMissing) checkTarget(jump->label, jump->direction);
  } else if (const auto* section = std::get_if<RepeatSection>(&instruction)) {
    checkTarget(section->from, JumpDirection::ForwardThenBackward);
    if (section->to.length != 0) checkTarget(section->to, JumpDirection::ForwardThenBackward);
  } else if (const auto* call = std::get_if<CallProgram>(&instruction)) {
    checkCall(*call);
  } else if (const auto* command = std::get_if<Command>(&instruction)) {
    const std::string name(block_.at(command->name));
    checkEffect(*command, name);
    if (keywordOf(name) == Keyword::SynchronizedAction)
      report(columnOf(name),
             (name == "SETINT" ? "the interrupt " : "the synchronized action ") + name + " is not carried out",
             "The run continues after it.", Severity::Warning);
    if (name == "G" && command->words.count == 2) {
      const Operand& number = block_.words[command->words.first].value;
      const Operand& group = block_.words[command->words.first + 1].value;
      const bool known = number.isLiteral() && group.isLiteral();
      if (known && isSkippedGroup(static_cast<int>(group.number), static_cast<int>(number.number)))
        tell(fmt::format("G[{}]={}", group.number, number.number), "is not carried out");
    }
    for (std::uint32_t i = 0; name == "G75" && i < command->words.count; ++i) {
      const Word& word = block_.words[command->words.first + i];
      if (word.address == addressOf("FP") && word.value.isLiteral() && word.value.number != 1)
        tell(fmt::format("FP={}", word.value.number), "is not carried out");
    }
    if (name == "ISOCALL")
      report(columnOf(name),
             fmt::format("ISOCALL {}: programs of the ISO dialect are not available", block_.at(command->text)),
             "Write the program in the language of the control.");
  } else if (const auto* modal = std::get_if<Modal>(&instruction)) {
    const std::string name(block_.at(modal->name));
    const bool ofSpindle = (name == "G25" || name == "G26") && modal->words.count > 0 &&
                           (block_.words[modal->words.first].address & 0xff) == 'S';
    const std::string_view how = skippedFunction(name);
    if (!how.empty() && !ofSpindle) tell(name, how);
    if (name == "TRAORI") {
      std::vector<std::optional<double>> arguments;
      for (std::uint32_t i = 0; i < modal->words.count; ++i) {
        const Operand& value = block_.words[modal->words.first + i].value;
        arguments.push_back(value.present() && value.isLiteral() ? std::optional(value.number) : std::nullopt);
      }
      if (const std::string_view what = skippedTransformation(arguments); !what.empty())
        tell(std::string(what), "is not carried out");
    }
    if (name == "H") {
      const std::size_t column = modal->words.count > 0 ? block_.words[modal->words.first].column : 0;
      tell("the auxiliary function H", "is not carried out", column);
    }
    if (name == "G291")
      report(columnOf(name), "G291: programs of the ISO dialect are not available",
             "Write the program in the language of the control.");
  } else if (const auto* tool = std::get_if<ToolCall>(&instruction)) {
    if (tool->index.isLiteral() && tool->index.present() && tool->index.number != 1)
      tell(fmt::format("T{}=", tool->index.number), "is not carried out");
  } else if (const auto* assign = std::get_if<Assign>(&instruction)) {
    const std::string name(block_.at(block_.variables[assign->variable].name));
    if (isFrameWithoutEffect(name)) tell(name, "is not carried out");
    if (name == "$SNS_MEA_T_PROBE_OFFSET" && assign->value.isLiteral())
      if (const std::string wrong = cycles::sinumerik::rotationOffsetComplaint(assign->value.number); !wrong.empty())
        report(columnOf(name), wrong, std::string(cycles::sinumerik::rotationOffsetAdvice), Severity::Warning);
  } else if (const auto* function = std::get_if<MachineFunction>(&instruction)) {
    if (isSkippedMachineFunction(function->number))
      tell(fmt::format("M{}", function->number), "is carried out only by a machine that has it",
           columnOf(fmt::format("M{}", function->number)) > 0 ? 0 : columnOf("M"));
  } else if (const auto* move = std::get_if<Move>(&instruction)) {
    for (std::uint32_t i = 0; i < move->words.count; ++i) {
      const std::string_view name = skippedMoveWord(block_.words[move->words.first + i].address);
      if (!name.empty()) tell(std::string(name), "is not carried out");
    }
  }
  if (const auto* order = std::get_if<Return>(&instruction); order != nullptr && order->start.present())
    tell("the fourth argument of RET", "has a meaning for programs of the ISO dialect only");
}

/// A word that is not carried out is named once in a program.
void Checker::tell(const std::string& name, std::string_view how, std::size_t column) {
  if (!told_.insert(name).second) return;
  report(column > 0 ? column : columnOf(name), fmt::format("{} {}", name, how),
         "The run continues; --strict refuses it.", Severity::Warning);
}

void Checker::checkEffect(const Command& command, const std::string& name) {
  const std::string_view how = skippedFunction(name);
  if (how.empty()) return;
  const Operand first = command.words.count > 0 ? block_.words[command.words.first].value : Operand{};
  std::optional<double> value;
  if (first.present()) value = first.isLiteral() ? first.number : 1;
  if (!saysWhatIs(name, value)) tell(name, how);
}

/// Functions whose value is not known here.
void Checker::checkFunctions() {
  for (const Node& node : block_.nodes) {
    if (node.operation != Operation::Call || node.function != Function::Host) continue;
    const std::string name(block_.at(node.text));
    if (!isUnavailableFunction(name) || !told_.insert(name).second) continue;
    report(columnOf(name), fmt::format("the function {} is not available here", name),
           "The run stops with alarm 12340 where its value is needed.", Severity::Warning);
  }
}

void Checker::checkLabels() {
  std::map<std::string_view, std::uint64_t> first;
  for (const ProgramStructure::Label& label : program_.structure().labels()) {
    const auto [known, isNew] = first.emplace(label.name, label.position.line);
    if (isNew) continue;
    Diagnostic mistake;
    mistake.severity = Severity::Warning;
    mistake.place = {program_.file(), label.position.line, 1};
    mistake.message = fmt::format("the label {} is also defined in line {}", label.name, known->second);
    mistake.excerpt = std::string(program_.text().line(label.position.offset).text);
    mistake.advice = "Jumps take the nearest in their direction; give each label a name of its own.";
    found_.push_back(std::move(mistake));
  }
}

Diagnostics Checker::run() {
  for (const DeclaredDatum& datum : options_.globalData)
    types_.emplace(datum.name, datum.type);
  if (const auto& header = program_.structure().header())
    for (const BlockParser::Parameter& parameter : header->parameters) {
      declared_.insert(parameter.name);
      types_.insert_or_assign(parameter.name, parameter.type);
    }
  for (BlockPosition at = program_.begin();; at = block_.next) {
    const std::size_t before = found_.size();
    if (!program_.parse(at, block_, found_)) break;
    if (block_.skippable && options_.skipLevels[block_.skipLevel]) {
      found_.resize(before);
      continue;
    }
    if (found_.size() > before) declareFromBrokenBlock();
    if (block_.skippable || block_.label.length > 0) state_ = {};
    checkHeader();
    for (const Instruction& instruction : block_.instructions)
      declare(instruction);
    checkNames();
    checkPriorities();
    if (options_.foresees && dividesByZero(block_)) {
      report(1, "this divides by 0: the run stops at this block", "Correct the divisor.", Severity::Warning);
    }
    checkFunctions();
    for (const Instruction& instruction : block_.instructions) {
      checkInstruction(instruction);
      followState(instruction);
      noteForModalWords(instruction);
    }
  }
  if (constexpr const char* hook = "CUST_MEACYC";
      callsHook_ && options_.library != nullptr && options_.library->exists(hook, &program_)) {
    if (const auto found = options_.library->open(hook, &program_)) called.push_back(*found);
  }
  for (auto& [name, mistake] : unknown_) {
    std::vector<std::string_view> names(declared_.begin(), declared_.end());
    for (const DeclaredDatum& datum : options_.globalData)
      names.push_back(datum.name);
    const std::string_view close = closestName(name, names);
    if (declared_.contains(name)) {
      mistake.message = name + " is used before its DEF";
      mistake.advice = "Move the DEF to the beginning of the program.";
    } else if (!close.empty()) {
      mistake.advice = "Did you mean " + std::string(close) + "?";
    }
    found_.push_back(std::move(mistake));
  }
  const Diagnostics& structure = program_.structure().mistakes();
  found_.insert(found_.end(), structure.begin(), structure.end());
  checkLabels();
  checkModalWords();
  std::stable_sort(found_.begin(), found_.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  });
  return std::move(found_);
}

Diagnostics check(SinumerikProgram& program, const CheckOptions& options) {
  constexpr std::size_t mostPrograms = 500;
  Checker main(program, options);
  Diagnostics found = main.run();
  std::set<std::string> known = {program.file()};
  std::vector<std::shared_ptr<Program>> open = std::move(main.called);
  for (std::size_t i = 0; i < open.size(); ++i) {
    const std::shared_ptr<Program> each = open[i];
    auto* subprogram = dynamic_cast<SinumerikProgram*>(each.get());
    if (subprogram == nullptr || known.size() >= mostPrograms || !known.insert(each->file()).second) continue;
    Checker checker(*subprogram, options);
    const Diagnostics more = checker.run();
    found.insert(found.end(), more.begin(), more.end());
    open.insert(open.end(), checker.called.begin(), checker.called.end());
  }
  return found;
}

}  // namespace probewright::language::sinumerik
