#include "conversion/klartext_formulas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "base/truncated.hpp"
#include "control/alarm.hpp"
#include "conversion/call.hpp"
#include "conversion/sinumerik_formulas.hpp"
#include "cycles/catalogue.hpp"
#include "language/klartext/formula_writer.hpp"
#include "language/sinumerik/check.hpp"

namespace probewright::conversion {

using namespace language;

namespace {

constexpr int firstHelper = 1900;
constexpr int lastHelper = 1979;
constexpr int firstArgument = lastHelper + 1;
constexpr int lastArgument = 1999;
constexpr int firstResult = 1700;

bool isParameter(std::string_view text) {
  std::size_t i = 1;
  while (i < text.size() && std::string_view("LRS").find(text[i]) != std::string_view::npos)
    ++i;
  return text.starts_with('Q') && i < text.size() &&
         std::all_of(text.begin() + static_cast<std::ptrdiff_t>(i), text.end(),
                     [](char c) { return c >= '0' && c <= '9'; });
}

constexpr int results = 32;  ///< _OVR[0] to _OVR[31]

/// What the measuring cycles of a SINUMERIK leave in `element`, such as "_OVI[9]": its English text, empty where
/// several leave different things there. Nothing if it is a result of none.
std::optional<std::string> leftByCycles(std::string_view element) {
  std::optional<std::string> found;
  for (const cycles::CycleDefinition* cycle : cycles::cyclesOf(control::ControlKind::Sinumerik840Dsl)) {
    const cycles::ResultDefinition* result = cycle->result(element);
    if (result == nullptr) continue;
    const std::string meaning = result->meaning.whole();
    found = !found || *found == meaning ? meaning : std::string();
  }
  return found;
}

/// Q100 to Q199, which the control and its cycles fill, and what touch probe cycles take and leave beyond.
const std::set<int>& parametersOfCycles() {
  static const std::set<int> taken = [] {
    std::set<int> all;
    constexpr int firstFilled = 100, lastFilled = 199;
    for (int number = firstFilled; number <= lastFilled; ++number)
      all.insert(number);
    const auto add = [&](std::string_view name) {
      if (isParameter(name) && isDigit(name[1])) all.insert(truncated(parseDecimal(name.substr(1)).value_or(0)));
    };
    for (const auto kind : {control::ControlKind::TNC640, control::ControlKind::iTNC530}) {
      for (const cycles::CycleDefinition* cycle : cycles::cyclesOf(kind)) {
        for (const cycles::Parameter& each : cycle->parameters)
          add(each.name);
        for (const cycles::ResultDefinition& each : cycle->results)
          add(each.name);
      }
    }
    return all;
  }();
  return taken;
}

/// Of an R parameter that stands for Q100 and on of several programs. Those that cycles or the converter's own values
/// would overwrite follow each other from Q1200 on, in every program of the job: Q150 becomes Q1250.
int sharedParameter(int index) {
  constexpr int firstMoved = 1200, lastMoved = 1599;
  static const std::map<int, int> moved = [] {
    std::map<int, int> all;
    const auto move = [&](int number) { all.emplace(number, firstMoved + static_cast<int>(all.size())); };
    for (const int number : parametersOfCycles())
      move(number);
    for (int number = firstResult; number < firstResult + results; ++number)
      move(number);
    for (int number = firstHelper; number <= lastArgument; ++number)
      move(number);
    return all;
  }();
  const int number = index - sharedQ;
  const auto other = moved.find(number);
  const bool taken = index < firstShared || index >= sharedQR || (number >= firstMoved && number <= lastMoved);
  if (taken || (other != moved.end() && other->second > lastMoved)) {
    throw NotCarriedOver(fmt::format("R{} has no twin beside parameters of several programs", index),
                         fmt::format("take another one: R0 to R99, R{} to R{} or R{} to R{}", firstShared,
                                     firstMoved + sharedQ - 1, lastMoved + sharedQ + 1, sharedQR + 499));
  }
  return other == moved.end() ? number : other->second;
}

}  // namespace

bool KlartextFormulas::namesParameter(std::string_view variable) {
  if (!variable.starts_with("_Q") || !isParameter(variable.substr(1))) return false;
  if (!isDigit(variable[2])) return true;  // QL, QR, QS
  // The others stand for R parameters, results and intermediate values.
  const int number = truncated(parseDecimal(variable.substr(2)).value_or(0));
  const auto within = [&](int first, int last) { return number >= first && number <= last; };
  // A cycle would overwrite the variable.
  return (within(100, 1199) && !parametersOfCycles().contains(number)) ||
         (within(1600, 1999) && !within(firstResult, firstResult + results - 1) && !within(firstHelper, lastArgument));
}

std::string KlartextFormulas::define(std::string_view name, Holds holds) {
  const bool text = holds == Holds::Text;
  const auto found = names_.find(name);
  if (found != names_.end()) return found->second;
  if (local_ && !text && !name.starts_with("measuring block")) {
    constexpr int localParameters = 500;
    if (nextLocal_ == localParameters) {
      throw NotCarriedOver("the program defines more variables than there are QL parameters");
    }
    while (reserved_.contains(fmt::format("QL{}", nextLocal_)))
      ++nextLocal_;
    return names_.emplace(name, fmt::format("QL{}", nextLocal_++)).first->second;
  }
  std::string number;
  do {
    number = text ? fmt::format("QS{}", nextText_++) : fmt::format("Q{}", nextNumber_++);
  } while (reserved_.contains(number));
  if (nextNumber_ > firstResult || nextText_ > firstResult) {
    throw NotCarriedOver("the program defines more variables than there are free Q parameters");
  }
  names_.emplace(name, number);
  return number;
}

std::string KlartextFormulas::argument(std::size_t place, Holds holds) {
  if (place > lastArgument - firstArgument)
    throw NotCarriedOver("the subprogram has more parameters than there are free Q parameters");
  return fmt::format("{}{}", holds == Holds::Text ? "QS" : "Q", static_cast<std::size_t>(firstArgument) + place);
}

std::string KlartextFormulas::variable(const Block& block, const VariableRef& variable) {
  const bool indexed = variable.index[0].present();
  const int index = static_cast<int>(variable.index[0].number);
  switch (variable.space) {
    case VariableSpace::R:
      if (!variable.index[0].isLiteral()) {
        throw NotCarriedOver("an R parameter whose number is computed has no twin in Klartext");
      }
      if (index < 100) return fmt::format("Q{}", index);
      if (shared_ && index >= sharedQR && index < sharedQR + 500) return fmt::format("QR{}", index - sharedQR);
      if (shared_) return fmt::format("Q{}", sharedParameter(index));
      if (index < 500) return fmt::format("Q{}", index + 1100);
      throw NotCarriedOver(fmt::format("R{} has no twin: R0 to R499 have", index));
    case VariableSpace::User: {
      const std::string_view name = block.at(variable.name);
      if (name == "_OVR" && variable.index[0].isLiteral() && index >= 0 && index < results) {
        return fmt::format("Q{}", firstResult + index);
      }
      if (!indexed && namesParameter(name)) return std::string(name.substr(1));
      return userVariable(block, variable);
    }
    case VariableSpace::System:
      return systemDatum(block, variable);
    default:
      throw NotCarriedOver("this variable has no twin in Klartext");
  }
}

bool KlartextFormulas::isGlobal(std::string_view name) const {
  return globalData_ != nullptr && globalData_->contains(std::string(name));
}

std::string KlartextFormulas::userVariable(const Block& block, const VariableRef& variable) {
  const std::string name(block.at(variable.name));
  std::vector<double> indices;
  std::string element = name;
  for (const Operand& index : variable.index) {
    if (!index.present()) break;
    if (!index.isLiteral()) {
      throw NotCarriedOver(fmt::format("which element of {} is meant is known only when the program runs", name),
                           "Q parameters have no indices: write numbers there, or convert this block by hand");
    }
    element += fmt::format("{}{}", indices.empty() ? "[" : ",", static_cast<int>(index.number));
    indices.push_back(index.number);
  }
  if (!indices.empty()) element += ']';
  if (const auto found = names_.find(element); found != names_.end()) return found->second;
  if (!isGlobal(name)) {
    const bool ofControl = language::sinumerik::isGlobalUserData(name);
    if (const auto left = ofControl ? leftByCycles(element) : std::nullopt) {
      throw NotCarriedOver(
          fmt::format("{}, a result of measuring cycles{}, has no counterpart: touch probe cycles of the "
                      "other control do not tell it",
                      element, left->empty() ? "" : fmt::format(" ({})", *left)),
          "take the statement out, or write by hand what it is to decide");
    }
    if (ofControl) {
      throw NotCarriedOver(
          fmt::format("{} belongs to the measuring cycles of the control and has no counterpart in Klartext", element),
          "take the statement out, or write by hand what it is to do");
    }
    throw NotCarriedOver(
        fmt::format("{} is not defined in this program", element),
        "define it in the program, use an R parameter, or name with --setup the setup whose definition "
        "files declare it");
  }
  const execution::sinumerik::UserVariable& datum = globalData_->at(name);
  const bool inRange = datum.isArray() && !indices.empty() && indices[0] >= 0;
  if (datum.isArray() ? !inRange : !indices.empty()) {
    throw NotCarriedOver(fmt::format("{} is not an element of {}", element, name));
  }
  try {
    const language::Value& value = datum.at(datum.isArray() ? datum.place(name, indices) : 0);
    std::string parameter = define(element, isText(value) ? Holds::Text : Holds::Number);
    globalValues_.push_back(fmt::format(
        "{} = {} ; {}", parameter,
        isText(value) ? fmt::format("\"{}\"", std::get<std::string>(value)) : exactText(std::get<double>(value)),
        element));
    return parameter;
  } catch (const control::Alarm&) {
    throw NotCarriedOver(fmt::format("{} has no element {}", name, element));
  }
}

std::string KlartextFormulas::systemDatum(const Block& block, const VariableRef& variable) {
  const std::string_view name = block.at(variable.name);
  const auto word = [&](std::size_t i) {
    const std::int32_t node = variable.index[i].node;
    return node < 0 ? std::string_view() : block.at(block.nodes[static_cast<std::size_t>(node)].text);
  };
  const auto axisNumber = [](std::string_view axis) {
    return axis.size() == 1 && axis[0] >= 'X' && axis[0] <= 'Z' ? axis[0] - 'X' + 1 : 0;
  };
  const char* toMillimetres = inch_ ? " * 25.4" : "";
  const auto toolLength = [&](const char* parameter) {
    return inch_ ? fmt::format("({}{})", parameter, toMillimetres) : std::string(parameter);
  };
  if (name == "$P_TOOLR") return toolLength("Q108");
  if (name == "$P_TOOLL" && variable.index[0].isLiteral() && variable.index[0].number == 1) return toolLength("Q114");
  const bool first = variable.index[0].isLiteral() && variable.index[0].number == 0;
  if (name == "$PI") return "PI";
  if (name == "$SNS_MEA_WP_BALL_DIAM" && first) return fmt::format("(2 * {})", read("ID350 NR52 IDX1"));
  if (name == "$P_UIFRNUM") return read("ID530 NR1");
  if ((name == "$AA_IW" || name == "$P_EP") && axisNumber(word(0)) != 0) {
    return readLength(fmt::format("ID270 NR1 IDX{}", axisNumber(word(0))));
  }
  if (!measured_[0].empty() && name == "$AC_MEA") return fmt::format("((1 + {}) / 2)", measured_[3]);
  if (!measured_[0].empty() && name == "$AA_MW" && axisNumber(word(0)) != 0) {
    const auto axis = static_cast<std::size_t>(axisNumber(word(0)) - 1);
    return axis == measuredToolAxis_ ? fmt::format("({} - Q108)", measured_[axis]) : measured_[axis];
  }
  if (const std::string datum = toolDatum(block, variable); !datum.empty()) return read(datum);
  const bool component = word(2) == "TR" || word(2) == "RT";
  if (name == "$P_UIFR" && component && axisNumber(word(1)) != 0) {
    return presetDatum(quantity(block, variable.index[0]), axisNumber(word(1)) + (word(2) == "RT" ? 3 : 0));
  }
  throw NotCarriedOver(fmt::format("{} has no twin in Klartext", name));
}

std::string KlartextFormulas::toolDatum(const Block& block, const VariableRef& variable) {
  static constexpr std::array<std::string_view, 6> names = {"$TC_DP3",  "$TC_DP6",  "$TC_DP7",
                                                            "$TC_DP12", "$TC_DP15", "$TC_DP16"};
  const auto found = std::ranges::find(names, block.at(variable.name));
  if (found == names.end()) return {};
  if (!variable.index[1].isLiteral() || variable.index[1].number != 1) {
    throw NotCarriedOver("the tool table holds only the first edge of a tool");
  }
  // L, R, R2, DL, DR, DR2.
  return fmt::format("ID50 NR{} IDX{}", found - names.begin() + 1, unsignedValue(quantity(block, variable.index[0])));
}

std::string KlartextFormulas::presetDatum(const Quantity& row, int index) {
  const std::string datum = fmt::format("ID507 NR{} IDX{}", unsignedValue(row == 99 ? Quantity(0) : row), index);
  return index <= 3 ? readLength(datum) : read(datum);
}

std::string KlartextFormulas::readLength(const std::string& datum) {
  const std::string millimetres = read(datum);
  return inch_ ? fmt::format("({} / 25.4)", millimetres) : millimetres;
}

std::string KlartextFormulas::read(const std::string& datum) {
  for (const std::string& line : prelude_) {
    const std::size_t equals = line.find(" = ");
    const std::string_view start = "FN 18: SYSREAD ";
    if (line.starts_with(start) && line.substr(equals + 3) == datum)
      return line.substr(start.size(), equals - start.size());
  }
  std::string result = helper("");
  prelude_.back() = fmt::format("FN 18: SYSREAD {} = {}", result, datum);
  return result;
}

std::string KlartextFormulas::measuringBlock(int toolAxis) {
  measuredToolAxis_ = static_cast<std::size_t>(toolAxis);
  for (std::size_t i = 0; measured_[3].empty() && i < 4; ++i)
    measured_[i] = define(fmt::format("measuring block {}", i + 1));
  return measured_[0];
}

std::string KlartextFormulas::helper(const std::string& formula) {
  std::string name = fmt::format("Q{}", firstHelper + nextHelper_);
  nextHelper_ = (nextHelper_ + 1) % (lastHelper - firstHelper + 1);
  prelude_.push_back(fmt::format("{} = {}", name, formula));
  return name;
}

std::vector<std::string> KlartextFormulas::takePrelude() {
  std::vector<std::string> taken;
  taken.swap(prelude_);
  return taken;
}

std::string KlartextFormulas::value(const Quantity& quantity) {
  if (quantity.isNumber()) {
    const std::string text = numberText(quantity.number());
    return text.front() == '-' ? text : fmt::format("+{}", text);
  }
  const bool single = quantity.terms().size() == 1 && std::abs(quantity.number()) < 1e-12;
  if (single && std::abs(std::abs(quantity.terms()[0].factor) - 1) < 1e-12 &&
      isParameter(quantity.terms()[0].expression)) {
    return fmt::format("{}{}", quantity.terms()[0].factor < 0 ? '-' : '+', quantity.terms()[0].expression);
  }
  return fmt::format("+{}", helper(spacedExpressionText(quantity)));
}

std::string KlartextFormulas::unsignedValue(const Quantity& quantity) {
  const std::string text = value(quantity);
  return text.front() == '+' ? text.substr(1) : text;
}

std::string KlartextFormulas::comparedValue(const Block& block, const Operand& operand) {
  const std::string text = formula(block, operand);
  const bool negative = text.starts_with('-');
  const std::string_view amount = std::string_view(text).substr(negative ? 1 : 0);
  if (!isParameter(amount) && !parseDecimal(amount)) return fmt::format("+{}", helper(text));
  return negative ? text : fmt::format("+{}", text);
}

std::string KlartextFormulas::formula(const Block& block, const Operand& operand) {
  if (operand.isLiteral()) return exactText(operand.number);
  if (!operand.present()) return {};
  const Node& node = block.nodes[static_cast<std::size_t>(operand.node)];
  const auto factor = [&](const Operand& side) {
    if (side.isLiteral() && side.number < 0) return fmt::format("({})", exactText(side.number));
    return factorText(formula(block, side));
  };
  switch (node.operation) {
    case Operation::Number:
      return exactText(node.number);
    case Operation::Text:
      return fmt::format("\"{}\"", block.at(node.text));
    case Operation::Variable:
      return variable(block, block.variables[node.a]);
    case Operation::Negate:
      return fmt::format("-{}", factor(node.left));
    case Operation::IntegerDivide:
      return fmt::format("INT ({} / {})", factor(node.left), factor(node.right));
    case Operation::Call:
      return call(block, node);
    default:
      break;
  }
  if (node.operation == Operation::Subtract) {  // (x>0)-(x<0)
    const auto compares = [&](const Operand& side, Operation operation) {
      const Node* each = side.node < 0 ? nullptr : &block.nodes[static_cast<std::size_t>(side.node)];
      return each != nullptr && each->operation == operation && each->right.isLiteral() && each->right.number == 0;
    };
    if (compares(node.left, Operation::Greater) && compares(node.right, Operation::Less)) {
      const auto compared = [&](const Operand& side) {
        return formula(block, block.nodes[static_cast<std::size_t>(side.node)].left);
      };
      const std::string first = compared(node.left);
      if (first == compared(node.right)) return fmt::format("SGN ({})", first);
    }
  }
  const std::string_view sign = klartext::operatorText(node.operation);
  if (sign.empty()) throw NotCarriedOver("formulas in Klartext have no comparisons and no logic");
  // Sums are computed from left to right anyway.
  const bool sum = node.operation == Operation::Add || node.operation == Operation::Subtract;
  return fmt::format("{}{}{}", sum ? formula(block, node.left) : factor(node.left), sign, factor(node.right));
}

std::string KlartextFormulas::call(const Block& block, const Node& node) {
  const auto argument = [&](std::uint32_t i) { return formula(block, block.operands[node.a + i]); };
  const bool truncates = node.function == Function::Truncate;  // INT leaves the decimals off, too
  const std::string_view name = klartext::functionName(truncates ? Function::Integer : node.function);
  if (!name.empty()) return fmt::format("{} ({})", name, argument(0));
  switch (node.function) {
    case Function::Atan2: {
      const std::string result = helper("");
      std::string first = argument(0), second = argument(1);
      const auto asValue = [&](const std::string& text) {
        return fmt::format("+{}", isParameter(text) ? text : helper(text));
      };
      // FN 13 takes parameters only; the helper of its result comes last.
      const auto own = std::ranges::find(prelude_, fmt::format("{} = ", result));
      prelude_.erase(own);
      first = asValue(first);
      second = asValue(second);
      prelude_.push_back(fmt::format("FN 13: {} = {} ANG {}", result, first, second));
      // FN 13 counts from 0 to 360 degrees, ATAN2 from -180 to 180.
      return fmt::format("({0} - 360 * INT (({0} + 179.999999999) / 360))", result);
    }
    case Function::Maximum:
    case Function::Minimum:
      // One of the two, times 1 and not rounded; the other times 0.
      return fmt::format("({0} * ((1 {2} SGN ({0} - {1})) / 2) + {1} * ((1 {3} SGN ({0} - {1})) / 2))",
                         factorText(argument(0)), factorText(argument(1)),
                         node.function == Function::Maximum ? '+' : '-',
                         node.function == Function::Maximum ? '-' : '+');
    case Function::Round:
      // Halves go away from 0. A sum with 0.5 would round by itself, just below a half.
      return fmt::format("(INT (2 * {0}) - INT {0})", factorText(argument(0)));
    case Function::Host:
      if (block.at(node.text) == "GETT") {
        const std::string tool = define("name of a tool", Holds::Text);
        prelude_.push_back(fmt::format("{} = {}", tool, argument(0)));
        return read(fmt::format("ID990 NR10 IDX{}", tool.substr(2)));
      }
      [[fallthrough]];
    default:
      throw NotCarriedOver(fmt::format("the function {} has no twin in Klartext", block.at(node.text)));
  }
}

Quantity KlartextFormulas::quantity(const Block& block, const Operand& operand) {
  if (operand.isLiteral()) return operand.number;
  if (!operand.present()) return {};
  const Node& node = block.nodes[static_cast<std::size_t>(operand.node)];
  switch (node.operation) {
    case Operation::Number:
      return node.number;
    case Operation::Variable:
      if (inch_ && block.at(block.variables[node.a].name) == "$P_TOOLR") return Quantity::of("Q108", millimetresOfInch);
      break;
    case Operation::Negate:
      return -quantity(block, node.left);
    case Operation::Add:
      return quantity(block, node.left) + quantity(block, node.right);
    case Operation::Subtract:
      return quantity(block, node.left) - quantity(block, node.right);
    case Operation::Multiply:
      if (node.left.isLiteral()) return quantity(block, node.right) * node.left.number;
      if (node.right.isLiteral()) return quantity(block, node.left) * node.right.number;
      break;
    case Operation::Divide:
      if (node.right.isLiteral() && node.right.number != 0) return quantity(block, node.left) / node.right.number;
      break;
    case Operation::Call:
      if (node.function == Function::Maximum || node.function == Function::Minimum) {
        const Quantity a = quantity(block, block.operands[node.a]), b = quantity(block, block.operands[node.a + 1]);
        const Quantity half = (a - b) / 2;
        const Quantity spread = Quantity::of(fmt::format("ABS ({})", spacedExpressionText(half)));
        return (a + b) / 2 + spread * (node.function == Function::Maximum ? 1 : -1);
      }
      break;
    default:
      break;
  }
  return Quantity::of(factorText(formula(block, operand)));
}

}  // namespace probewright::conversion
