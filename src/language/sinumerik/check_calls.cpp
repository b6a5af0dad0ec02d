#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/text.hpp"
#include "cycles/catalogue.hpp"
#include "cycles/sinumerik/old_parameters.hpp"
#include "language/sinumerik/checker.hpp"
#include "language/sinumerik/keywords.hpp"

/// Calls of subprograms and cycles: what is called exists, and its arguments are those that it takes.
namespace probewright::language::sinumerik {

namespace {

constexpr control::ControlKind controlKind = control::ControlKind::Sinumerik840Dsl;

/// "/_N_WKS_DIR/_N_PART_WPD/_N_SUB_SPF" -> "SUB".
std::string plainName(std::string_view path) {
  path = path.substr(path.find_last_of("/\\") + 1);
  if (!path.starts_with("_N_")) return std::string(path);
  path.remove_prefix(3);
  const bool ending = path.size() > 4 && path[path.size() - 4] == '_';
  return std::string(path.substr(0, path.size() - (ending ? 4 : 0)));
}

}  // namespace

void Checker::checkArguments(const std::vector<ArgumentMistake>& mistakes) {
  for (const ArgumentMistake& each : mistakes)
    report(each.column, each.message, each.advice, each.severity);
}

void Checker::checkParameters(const CallProgram& call, const BlockParser::Header& header) {
  const Word* words = block_.words.data() + call.arguments.first;
  if (call.arguments.count > header.parameters.size()) {
    report(words[header.parameters.size()].column,
           fmt::format("{} has {} parameter{}, but the call has {} arguments", header.name, header.parameters.size(),
                       header.parameters.size() == 1 ? "" : "s", call.arguments.count),
           "Compare the call with the PROC line of the subprogram.");
    return;
  }
  for (std::size_t i = 0; i < header.parameters.size(); ++i) {
    const BlockParser::Parameter& parameter = header.parameters[i];
    if (!parameter.byReference) {
      checkType(call, header, i);
      continue;
    }
    if (i >= call.arguments.count || !words[i].value.present()) {
      report(columnOf(header.name),
             fmt::format("argument {} of {} is missing: the VAR parameter {} needs a variable", i + 1, header.name,
                         parameter.name),
             "Write the name of the variable that takes the result.");
      continue;
    }
    const Operand& value = words[i].value;
    const bool isVariable =
        value.node >= 0 && block_.nodes[static_cast<std::size_t>(value.node)].operation == Operation::Variable;
    if (!isVariable)
      report(
          words[i].column,
          fmt::format("argument {} of {}: the VAR parameter {} needs a variable", i + 1, header.name, parameter.name),
          "Write the name of the variable that takes the result.");
  }
}

/// An argument whose type the parameter cannot take.
void Checker::checkType(const CallProgram& call, const BlockParser::Header& header, std::size_t place) {
  if (place >= call.arguments.count) return;
  const BlockParser::Parameter& parameter = header.parameters[place];
  const Word& word = block_.words[call.arguments.first + place];
  const std::string wrong = argumentOfWrongType(block_, word.value, parameter.type, types_);
  if (wrong.empty()) return;
  report(word.column,
         fmt::format("argument {} of {} is {}, and the parameter {} has the type {}", place + 1, header.name, wrong,
                     parameter.name, typeName(parameter.type)),
         "Compare the call with the PROC line of the subprogram.");
}

void Checker::checkSection(const CallProgram& call, Program& other) {
  const std::string_view from = block_.at(call.from), to = block_.at(call.to);
  const auto first = other.findLabel(from, other.begin(), JumpDirection::Any);
  const bool last = first && (from == to || other.findLabel(to, *first, JumpDirection::Forward));
  if (!last)
    report(columnOf(first ? to : from),
           fmt::format("the program {} has no section from {} to {}", other.name(), from, to),
           fmt::format("The label {} is missing there, or comes before {}.", first ? to : from, from));
}

/// A cycle of the control, not a program or a macro of that name.
bool Checker::callsCycle(const CallProgram& call) const {
  if (call.nameValue.present() || call.name.length == 0 || !call.maybeCycle) return false;
  const std::string path = upperCase(block_.at(call.name)), name = plainName(path);
  const bool beside = options_.library != nullptr && options_.library->exists(path, &program_);
  return !beside && !macros_.contains(name) && cycles::sinumerikCycle(name) != nullptr;
}

void Checker::checkCall(const CallProgram& call) {
  if (call.nameValue.present() || call.name.length == 0) return;
  const std::string path = upperCase(block_.at(call.name)), name = plainName(path);
  if (macros_.contains(name)) return;
  if (options_.library != nullptr && options_.library->exists(path, &program_)) {
    const auto found = options_.library->open(path, &program_);
    if (!found) {
      const Diagnostic& why = found.error();
      return report(columnOf(path), fmt::format("the program {} cannot be read: {}", name, why.message), why.advice);
    }
    this->called.push_back(*found);
    callsPrograms_ = true;
    if (call.from.length != 0) return checkSection(call, **found);
    if (auto* subprogram = dynamic_cast<SinumerikProgram*>(found->get());
        subprogram != nullptr && subprogram->structure().header())
      checkParameters(call, *subprogram->structure().header());
    return;
  }
  const std::size_t column = columnOf(path);
  if (call.maybeCycle) {
    if (const cycles::CycleDefinition* cycle = cycles::sinumerikCycle(name)) {
      callsHook_ = true;
      checkState(cycle->name);
      // A subprogram and a program that calls others may find the variables written.
      const bool oldForm = call.arguments.count == 0 && cycles::sinumerik::hasOldForm(*cycle);
      if (oldForm && (oldParameters_ || callsPrograms_ || upperCase(program_.file()).ends_with(".SPF"))) return;
      return checkArguments(argumentMistakes(block_, call, *cycle, types_));
    }
    if (name == "CYCLE800" || name == "CYCLE116") return checkArguments(serviceMistakes(block_, call, name, types_));
    if (isCycleWithoutEffect(name)) return;
    if (isMeasuringCycle(name))
      return report(column, fmt::format("the measuring cycle {} is not available", name),
                    "'probewright cycles --control 840Dsl' lists the cycles that are.");
    if (isSkippedCycle(name))
      return report(column, name + " is not carried out", "The run continues after it; no material is removed.",
                    Severity::Warning);
  }
  if (options_.library == nullptr && !call.maybeCycle) return;
  if (name.empty())
    return report(column, fmt::format("\"{}\" names a folder, not a program", block_.at(call.name)),
                  "Write the name of the program: CALL \"NAME\".");
  // CALL names programs only: a word of the language is never meant.
  std::vector<std::string_view> names;
  for (const cycles::CycleDefinition* cycle : cycles::cyclesOf(controlKind))
    if (call.maybeCycle) names.push_back(cycle->name);
  for (const KeywordEntry& keyword : keywords())
    if (call.maybeCycle) names.push_back(keyword.name);
  const std::string_view close = closestName(name, names);
  const std::string message = (call.maybeCycle ? "there is no program and no cycle " : "there is no program ") + name;
  const std::string file = name.find('.') == std::string::npos ? name + ".SPF" : name;
  const std::string advice = close.empty() ? "Put " + file + " beside the program, or check the spelling."
                                           : "Did you mean " + std::string(close) + "?";
  if (options_.library == nullptr && close.empty()) return;
  report(column, message, advice);
}

}  // namespace probewright::language::sinumerik
