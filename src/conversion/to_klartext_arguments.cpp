#include <fmt/format.h>

#include "conversion/to_klartext.hpp"

/// Parameters of subprograms (PROC): a caller hands their values over in Q parameters, which the subprogram takes into
/// its own first of all.
namespace probewright::conversion {

using namespace language;
using sinumerik::Type;
using Header = sinumerik::BlockParser::Header;
using Parameter = sinumerik::BlockParser::Parameter;

namespace {

KlartextFormulas::Holds holds(const Parameter& parameter) {
  return parameter.type == Type::String ? KlartextFormulas::Holds::Text : KlartextFormulas::Holds::Number;
}

/// Refuses what Q parameters cannot hold.
void requireTwins(const Header& header) {
  for (const Parameter& each : header.parameters) {
    const bool fits =
        each.type == Type::Real || each.type == Type::Int || each.type == Type::Bool || each.type == Type::String;
    if (!fits || !each.dimensions.empty()) {
      throw NotCarriedOver(fmt::format("the parameter {} of {} is an array, a character, an axis or a frame, which no "
                                       "Q parameter holds",
                                       each.name, header.name),
                           "pass values in Q parameters");
    }
  }
}

}  // namespace

const Header* ToKlartext::headerOf(std::string_view name) const {
  for (const auto& other : job_.others) {
    auto* program = dynamic_cast<sinumerik::SinumerikProgram*>(other.get());
    if (program == nullptr || upperCase(program->name()) != upperCase(name)) continue;
    const auto& header = program->structure().header();
    return header ? &*header : nullptr;
  }
  return nullptr;
}

void ToKlartext::callWithArguments(const Block& block, const CallProgram& call, const Header& header) {
  requireTwins(header);
  const auto given = std::span<const Word>(block.words).subspan(call.arguments.first, call.arguments.count);
  const auto operandOf = [&](std::size_t place) -> const Operand* {
    return place < given.size() && given[place].value.present() ? &given[place].value : nullptr;
  };
  const auto variableOf = [&](std::size_t place) {
    const Operand* operand = operandOf(place);
    const Node* node =
        operand != nullptr && operand->node >= 0 ? &block.nodes[static_cast<std::size_t>(operand->node)] : nullptr;
    if (node == nullptr || node->operation != Operation::Variable)
      throw NotCarriedOver(fmt::format("the VAR parameter {} needs a variable", header.parameters[place].name));
    const VariableRef& variable = block.variables[node->a];
    if (variable.space == VariableSpace::System)
      throw NotCarriedOver("a system variable is given to a VAR parameter, which no Q parameter stands for");
    return variable;
  };
  for (std::size_t i = 0; i < header.parameters.size(); ++i) {
    const Parameter& parameter = header.parameters[i];
    if (parameter.byReference) variableOf(i);
    const Operand* operand = operandOf(i);
    const std::string standard = parameter.type == Type::String ? fmt::format("\"{}\"", parameter.defaultText)
                                                                : exactText(parameter.defaultNumber);
    line(fmt::format("{} = {} ; {}", KlartextFormulas::argument(i, holds(parameter)),
                     operand != nullptr ? formulas_.formula(block, *operand) : standard, parameter.name));
  }
  line(fmt::format("CALL PGM {}", block.at(call.name)));
  for (std::size_t i = 0; i < header.parameters.size(); ++i) {
    if (!header.parameters[i].byReference) continue;
    const VariableRef variable = variableOf(i);
    const std::string target = formulas_.variable(block, variable);
    line(fmt::format("{} = {}", target,
                     formulas_.assigned(block, variable, KlartextFormulas::argument(i, holds(header.parameters[i])))));
  }
}

void ToKlartext::takeArguments() {
  const auto& header = program_.structure().header();
  if (!header || header->parameters.empty()) return;
  if (!job_.called) {
    throw NotCarriedOver(
        "this subprogram has parameters, and no program of its folder calls it: nothing would give "
        "them values",
        "put the programs that call it into the same folder");
  }
  requireTwins(*header);
  for (std::size_t i = 0; i < header->parameters.size(); ++i) {
    const Parameter& parameter = header->parameters[i];
    formulas_.declare(parameter.name, parameter.type);
    const bool known = KlartextFormulas::namesParameter(parameter.name);
    const std::string own = known ? parameter.name.substr(1) : formulas_.define(parameter.name, holds(parameter));
    const std::string handedOver = KlartextFormulas::argument(i, holds(parameter));
    line(fmt::format("{} = {} ; {}", own, formulas_.asType(parameter.type, handedOver), parameter.name));
    if (parameter.byReference) givenBack_.push_back(fmt::format("{} = {}", handedOver, own));
  }
}

}  // namespace probewright::conversion
