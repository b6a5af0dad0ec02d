#include "language/sinumerik/argument_check.hpp"

#include <fmt/format.h>
#include <algorithm>

#include <array>
#include <optional>
#include <string_view>

#include "cycles/sinumerik/call_combinations.hpp"
#include "cycles/sinumerik/call_requirements.hpp"
#include "language/sinumerik/cursor.hpp"

namespace probewright::language::sinumerik {

using namespace language;

namespace {

/// What an argument is, as far as it can be told before the run.
enum class Kind { Absent, Number, Text, Axis, Computed };

struct Given {
  Kind kind = Kind::Absent;
  std::optional<double> number;  ///< written as a number
  std::string text;              ///< written as a text
  bool isWritten = false;        ///< the text stands in the call
};

class Reader {
public:
  Reader(const Block& block, const CallProgram& call, const std::map<std::string, Type>& types)
      : block_(block), call_(call), types_(types) {}

  Given at(std::uint32_t place) const { return place >= call_.arguments.count ? Given{} : of(word(place).value); }

  Given of(const Operand& value) const {
    if (!value.present()) return {};
    if (value.isLiteral()) return {Kind::Number, value.number, {}};
    return given(block_.nodes[static_cast<std::size_t>(value.node)]);
  }

  /// Where the argument stands; where it would stand, if it is left out.
  std::uint32_t columnOf(std::uint32_t place) const {
    return place < call_.arguments.count ? word(place).column : endOfCall();
  }

private:
  const Word& word(std::uint32_t place) const { return block_.words[call_.arguments.first + place]; }

  Given given(const Node& node) const {
    switch (node.operation) {
      case Operation::Text:
        return {Kind::Text, std::nullopt, std::string(block_.at(node.text)), true};
      case Operation::Concatenate:
        return {Kind::Text, std::nullopt, {}};
      case Operation::AxisName:
        return {Kind::Axis, std::nullopt, {}};
      case Operation::Variable: {
        const VariableRef& variable = block_.variables[node.a];
        if (variable.space == VariableSpace::R) return {Kind::Number, std::nullopt, {}};
        const auto known = types_.find(std::string(block_.at(variable.name)));
        if (variable.space != VariableSpace::User || known == types_.end()) break;
        if (known->second == Type::String) return {Kind::Text, std::nullopt, {}};
        if (known->second == Type::Axis) return {Kind::Axis, std::nullopt, {}};
        if (known->second != Type::Frame && known->second != Type::Char) return {Kind::Number, std::nullopt, {}};
        break;
      }
      default:
        break;
    }
    return {Kind::Computed, std::nullopt, {}};
  }

  /// The column of the parenthesis that closes the call; of its name, where there is none.
  std::uint32_t endOfCall() const {
    const std::string_view source = block_.at(block_.source);
    std::size_t at = 0;
    if (call_.arguments.count > 0) {
      at = word(call_.arguments.count - 1).column - 1;
    } else {
      std::string line(source);
      for (char& c : line)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 32);
      const std::string_view name = block_.at(call_.name);
      at = line.find(name);
      if (at == std::string::npos) return 1;
      std::size_t behind = at + name.size();
      while (behind < line.size() && isBlank(line[behind]))
        ++behind;
      if (behind >= line.size() || line[behind] != '(') return static_cast<std::uint32_t>(at) + 1;
      at = behind + 1;
    }
    bool inText = false;
    for (int open = 0; at < source.size(); ++at) {
      if (source[at] == '"') inText = !inText;
      if (inText) continue;
      if (source[at] == '(') ++open;
      if (source[at] == ')' && open-- == 0) break;
    }
    return static_cast<std::uint32_t>(at) + 1;
  }

  const Block& block_;
  const CallProgram& call_;
  const std::map<std::string, Type>& types_;
};

/// Empty if the value fits the parameter.
std::string wrongValue(const cycles::Parameter& parameter, const Given& given) {
  if (given.kind == Kind::Computed || given.kind == Kind::Absent) return {};
  if (given.kind == Kind::Axis) {
    return fmt::format("{} ({}) takes a {}, not the name of an axis", parameter.name, parameter.meaning,
                       parameter.kind == cycles::ValueKind::Text ? "text" : "number");
  }
  cycles::Argument argument;
  argument.given = true;
  argument.isText = given.kind == Kind::Text;
  argument.number = given.number.value_or(parameter.standard.value_or(0));
  argument.text = given.text;
  std::string wrong = cycles::complaint(parameter, argument, cycles::ControlKind::Sinumerik840Dsl);
  if (wrong.empty() && given.number) {
    wrong = cycles::codeComplaint(parameter, argument);
    if (!wrong.empty()) wrong += cycles::sinumerik::versionNote(parameter, argument.number);
  }
  return wrong;
}

}  // namespace

std::vector<ArgumentMistake> argumentMistakes(const Block& block, const CallProgram& call,
                                              const cycles::CycleDefinition& cycle,
                                              const std::map<std::string, Type>& types) {
  const Reader reader(block, call, types);
  const std::string advice = fmt::format("See 'probewright cycles {}'.", cycle.name);
  std::vector<ArgumentMistake> found;
  const auto report = [&](const cycles::Parameter& parameter, const std::string& what, Severity severity) {
    found.push_back({reader.columnOf(parameter.address),
                     fmt::format("argument {} of {}: {}", parameter.address + 1, cycle.name, what), advice, severity});
  };

  const auto mode = std::ranges::find(cycle.parameters, "_AMODE", &cycles::Parameter::name);
  const bool compares =
      mode != cycle.parameters.end() && static_cast<long>(reader.at(mode->address).number.value_or(0)) % 10 == 1;
  // What the other arguments have to say depends on the measuring variant.
  std::optional<int> variant;
  for (const cycles::Parameter& parameter : cycle.parameters) {
    const Given given = reader.at(parameter.address);
    std::string wrong = wrongValue(parameter, given);
    if (parameter.name == "S_MVAR" && wrong.empty()) {
      cycles::Argument argument;
      argument.number = given.number.value_or(parameter.standard.value_or(0));
      if (given.kind == Kind::Absent) {
        wrong = cycles::codeComplaint(parameter, argument);
        if (!wrong.empty()) wrong = fmt::format("{} ({}) is missing", parameter.name, parameter.meaning);
      }
      if (wrong.empty() && (given.number || given.kind == Kind::Absent)) variant = static_cast<int>(argument.number);
    }
    if (!wrong.empty()) {
      report(parameter, wrong, Severity::Error);
      if (parameter.name == "S_MVAR") break;
      continue;
    }
    if (given.kind != Kind::Absent && !given.number) continue;
    cycles::Argument argument;
    argument.given = given.kind != Kind::Absent;
    argument.number = given.number.value_or(0);
    if (!argument.given && parameter.required()) {
      report(parameter, fmt::format("{} ({}) is missing", parameter.name, parameter.meaning), Severity::Error);
    } else if (parameter.name == "S_KNUM1" && argument.given && argument.number == 0 && compares) {
      continue;  // judged by the tolerance, and meant to correct nothing
    } else if (const auto lacks = cycles::sinumerik::requirementComplaint(cycle, parameter, argument, variant)) {
      report(parameter, lacks->text, lacks->refused ? Severity::Error : Severity::Warning);
    }
  }

  const bool mistaken =
      std::ranges::any_of(found, [](const ArgumentMistake& each) { return each.severity == Severity::Error; });
  if (variant && !mistaken) {
    const auto known = [&](std::string_view name) {
      cycles::sinumerik::KnownArgument argument;
      const auto parameter = std::ranges::find(cycle.parameters, name, &cycles::Parameter::name);
      if (parameter == cycle.parameters.end()) return argument;
      const Given given = reader.at(parameter->address);
      argument.given = given.kind != Kind::Absent;
      argument.number = argument.given ? given.number : std::optional(parameter->standard.value_or(0));
      if (given.isWritten) argument.text = given.text;
      return argument;
    };
    for (const auto& [name, complaint] : cycles::sinumerik::combinationComplaints(cycle, *variant, known))
      report(*std::ranges::find(cycle.parameters, name, &cycles::Parameter::name), complaint.text,
             complaint.refused ? Severity::Error : Severity::Warning);
  }

  const auto most = static_cast<std::uint32_t>(cycle.parameters.size());
  // Newer versions of the cycles have more arguments; one that is empty or 0 asks for nothing.
  bool asksForMore = false;
  for (std::uint32_t place = most; place < call.arguments.count; ++place) {
    const Given given = reader.at(place);
    asksForMore = asksForMore || (given.kind != Kind::Absent && given.number != 0 &&
                                  !(given.kind == Kind::Text && given.text.empty()));
  }
  if (asksForMore) {
    found.push_back(
        {reader.columnOf(most),
         fmt::format("{} takes at most {} arguments, but {} are given: those after argument {}, {} ({}), belong to a "
                     "version of the measuring cycles newer than 4.4, and what they mean is not published",
                     cycle.name, most, call.arguments.count, most, cycle.parameters.back().name,
                     cycle.parameters.back().meaning),
         advice});
  }
  return found;
}

std::vector<ArgumentMistake> serviceMistakes(const Block& block, const CallProgram& call, std::string_view name,
                                             const std::map<std::string, Type>& types) {
  const Reader reader(block, call, types);
  std::vector<ArgumentMistake> found;
  const auto report = [&](std::uint32_t place, const std::string& what, const char* advice) {
    found.push_back({reader.columnOf(place), what, advice});
  };
  if (name == "CYCLE116") {
    if (call.arguments.count != 2 || reader.at(0).kind == Kind::Absent || reader.at(1).kind == Kind::Absent)
      report(0, "CYCLE116 takes two arguments: an array of 13 REAL and an INT",
             "Define DEF REAL _CAL[13] and DEF INT _MODE, and call CYCLE116(_CAL[], _MODE).");
    return found;
  }
  if (name != "CYCLE800") return found;
  constexpr std::array<std::string_view, 16> parameters = {
      "_FR (retraction)",
      "_TC (name of the swivel data set)",
      "_ST (status of the transformation)",
      "_MODE (kind and order of the angles)",
      "_X0 (reference point before the rotation)",
      "_Y0 (reference point before the rotation)",
      "_Z0 (reference point before the rotation)",
      "_A (first angle)",
      "_B (second angle)",
      "_C (third angle)",
      "_X1 (zero point after the rotation)",
      "_Y1 (zero point after the rotation)",
      "_Z1 (zero point after the rotation)",
      "_DIR (direction of the rotary axes)",
      "_FR_I (retraction distance)",
      "_DMODE (display mode)",
  };
  constexpr const char* advice =
      "Write CYCLE800(_FR,_TC,_ST,_MODE,_X0,_Y0,_Z0,_A,_B,_C,_X1,_Y1,_Z1,_DIR,_FR_I,_DMODE).";
  for (std::uint32_t place = 0; place < call.arguments.count; ++place) {
    if (place == parameters.size()) {
      report(place, fmt::format("CYCLE800 takes at most {} arguments, but {} are given", place, call.arguments.count),
             advice);
      break;
    }
    const Kind kind = reader.at(place).kind;
    const bool wantsText = place == 1;
    if (kind == Kind::Absent || kind == Kind::Computed || (kind == Kind::Text) == wantsText) continue;
    report(place,
           fmt::format("argument {} of CYCLE800: {} takes a {}", place + 1, parameters[place],
                       wantsText ? "text" : "number"),
           advice);
  }
  return found;
}

std::string argumentOfWrongType(const Block& block, const Operand& value, Type type,
                                const std::map<std::string, Type>& types) {
  static const CallProgram none;
  const Given given = Reader(block, none, types).of(value);
  const bool wantsText = type == Type::String || type == Type::Char,
             wantsNumber = type == Type::Real || type == Type::Int;
  switch (given.kind) {
    case Kind::Number:
      if (type == Type::Axis || type == Type::Frame || (type == Type::String && given.number)) return "a number";
      return {};
    case Kind::Text:
      return wantsNumber || type == Type::Axis || type == Type::Frame ? "a text" : "";
    case Kind::Axis:
      return wantsText || wantsNumber || type == Type::Bool || type == Type::Frame ? "the name of an axis" : "";
    case Kind::Absent:
    case Kind::Computed:
      break;
  }
  return {};
}

}  // namespace probewright::language::sinumerik
