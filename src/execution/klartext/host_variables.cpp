#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "execution/klartext/excerpt.hpp"
#include "execution/klartext/host.hpp"

/// Q, QL, QR and QS parameters, and the functions that formulas call.
namespace probewright::language::klartext {

using control::Alarm;
using control::heidenhain::QParameters;

namespace {

int numberOf(const VariableRef& variable, std::size_t count, std::string_view space) {
  const double number = variable.index[0].number;
  if (number >= static_cast<double>(count)) {
    throw Alarm("Parameter number wrong",
                fmt::format("{}{} does not exist; the highest number is {}", space, number, count - 1));
  }
  return static_cast<int>(number);
}

double numberArgument(std::span<const Value> arguments, std::size_t index) {
  if (const auto* number = std::get_if<double>(&arguments[index])) return *number;
  throw Alarm("Wrong data type", "A number is needed here, not a text", "convert the text with TONUMB");
}

const std::string& textArgument(std::span<const Value> arguments, std::size_t index) {
  if (const auto* text = std::get_if<std::string>(&arguments[index])) return *text;
  throw Alarm("Wrong data type", "A text is needed here, not a number", "convert the number with TOCHAR");
}

/// Letters beyond ASCII are several bytes of UTF-8 and one character.
std::size_t charactersOf(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
    text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t'))
    text.remove_suffix(1);
  return std::string(text);
}

}  // namespace

Value KlartextHost::read(const VariableRef& variable, Evaluation&) {
  switch (variable.space) {
    case VariableSpace::QL:
      return levels_.back()
          .local[static_cast<std::size_t>(numberOf(variable, levels_.back().local.size(), "QL"))]
          .value_or(0);
    case VariableSpace::QR:
      return control_.q.qr(numberOf(variable, QParameters::remanentCount, "QR"));
    case VariableSpace::QS:
      return control_.q.qs(numberOf(variable, QParameters::count, "QS"));
    default:
      return control_.q.q(numberOf(variable, QParameters::count, "Q"));
  }
}

void KlartextHost::write(const VariableRef& variable, const Value& value, Evaluation&) {
  if (variable.space == VariableSpace::QS) {
    const int number = numberOf(variable, QParameters::count, "QS");
    if (!isText(value)) {
      throw Alarm("Wrong data type", fmt::format("QS{} takes a text, not a number", number),
                  "convert the number with TOCHAR");
    }
    const std::string& text = std::get<std::string>(value);
    if (charactersOf(text) > QParameters::longestText) {
      throw Alarm("String too long",
                  fmt::format("QS{} takes at most {} characters, these are {}", number, QParameters::longestText,
                              charactersOf(text)),
                  "shorten the text, or spread it over several parameters");
    }
    control_.q.setQs(number, text);
    return;
  }
  if (isText(value)) {
    throw Alarm("Wrong data type", "A Q parameter takes a number, not a text", "use a QS parameter or TONUMB");
  }
  const double number = std::get<double>(value);
  switch (variable.space) {
    case VariableSpace::QL:
      levels_.back().local[static_cast<std::size_t>(numberOf(variable, levels_.back().local.size(), "QL"))] = number;
      break;
    case VariableSpace::QR:
      control_.q.setQr(numberOf(variable, QParameters::remanentCount, "QR"), number);
      break;
    default:
      control_.q.setQ(numberOf(variable, QParameters::count, "Q"), number);
      break;
  }
}

bool KlartextHost::isDefined(const VariableRef& variable, Evaluation&) {
  switch (variable.space) {
    case VariableSpace::QL:
      return levels_.back()
          .local[static_cast<std::size_t>(numberOf(variable, levels_.back().local.size(), "QL"))]
          .has_value();
    case VariableSpace::QR:
      return !control_.q.isQrUndefined(numberOf(variable, QParameters::remanentCount, "QR"));
    case VariableSpace::QS:
      return !control_.q.isQsUndefined(numberOf(variable, QParameters::count, "QS"));
    default:
      return !control_.q.isUndefined(numberOf(variable, QParameters::count, "Q"));
  }
}

/// FN 0: Q5 SET UNDEFINED.
void KlartextHost::setUndefined(const VariableRef& variable) {
  switch (variable.space) {
    case VariableSpace::QL:
      levels_.back().local[static_cast<std::size_t>(numberOf(variable, levels_.back().local.size(), "QL"))].reset();
      break;
    case VariableSpace::QR:
      control_.q.setQr(numberOf(variable, QParameters::remanentCount, "QR"), std::nullopt);
      break;
    case VariableSpace::QS:
      control_.q.setQs(numberOf(variable, QParameters::count, "QS"), std::nullopt);
      break;
    default:
      control_.q.setUndefined(numberOf(variable, QParameters::count, "Q"));
      break;
  }
}

Value KlartextHost::call(std::string_view name, std::span<const Value> arguments) {
  if (name == "ANG") {
    const double angle = degreesFromRadians(std::atan2(numberArgument(arguments, 0), numberArgument(arguments, 1)));
    return angle < 0 ? angle + 360 : angle;
  }
  if (name == "PREDEF") {
    const int number = static_cast<int>(numberArgument(arguments, 0));
    const auto found = control_.globalDefinitions.find(number);
    if (found == control_.globalDefinitions.end()) {
      throw Alarm("GLOBAL DEF missing", fmt::format("Q{} is PREDEF, but no GLOBAL DEF gives it a value", number),
                  "program GLOBAL DEF before the cycle, or write the value into the cycle");
    }
    // Q301 is a choice; all others are lengths and feeds.
    const auto& [value, unit] = found->second;
    return number == 301 || unit == control_.unit ? value : value * unit / control_.unit;
  }
  if (name == "FU") return numberArgument(arguments, 0) * control_.tool.spindleSpeed;
  if (name == "FZ") return numberArgument(arguments, 0) * control_.tool.spindleSpeed * teeth();
  if (name == "SELECTED PGM") {
    if (selectedProgram_.empty()) {
      throw Alarm("Program not selected", "CALL SELECTED PGM finds no program selected", "program SEL PGM before it");
    }
    return selectedProgram_;
  }
  if (name == "TOCHAR") {
    const double decimals = numberArgument(arguments, 1);
    const double value = numberArgument(arguments, 0);
    return decimals < 0 ? formatShortest(value) : formatFixed(value, std::min(static_cast<int>(decimals), 15));
  }
  if (name == "TONUMB") {
    const std::string text = trimmed(textArgument(arguments, 0));
    if (const auto number = parseDecimal(text)) return *number;
    throw Alarm("String is not a number", fmt::format("TONUMB cannot read \"{}\" as a number", excerptOf(text)));
  }
  // The second argument tells whether the parameter has no text at all.
  if (name == "STRLEN") {
    if (arguments.size() > 1 && numberArgument(arguments, 1) != 0) return -1.0;
    return static_cast<double>(textArgument(arguments, 0).size());
  }
  if (name == "SUBSTR") {
    const std::string& text = textArgument(arguments, 0);
    const double begin = numberArgument(arguments, 1);
    if (begin < 0) {
      throw Alarm("Argument out of range", fmt::format("SUBSTR cannot begin at BEG{}", formatShortest(begin)),
                  "characters are counted from BEG0");
    }
    const double count = numberArgument(arguments, 2);  // -1: all that follows
    if (count < -1) {
      throw Alarm("Argument out of range", fmt::format("SUBSTR cannot take LEN{} characters", formatShortest(count)),
                  "give a length of 0 or more");
    }
    if (begin >= static_cast<double>(text.size())) return std::string();
    return text.substr(static_cast<std::size_t>(begin),
                       count < 0 ? std::string::npos : static_cast<std::size_t>(count));
  }
  if (name == "INSTR") {
    const std::string& text = textArgument(arguments, 0);
    const double begin = std::max(0.0, numberArgument(arguments, 2));
    const std::size_t found = text.find(textArgument(arguments, 1), static_cast<std::size_t>(begin));
    return static_cast<double>(found == std::string::npos ? text.size() : found);
  }
  if (name == "STRCOMP") {
    const int order = textArgument(arguments, 0).compare(textArgument(arguments, 1));
    return order < 0 ? -1.0 : order > 0 ? 1.0 : 0.0;
  }
  if (name == "SYSSTR") {
    const Value text =
        systemText(static_cast<int>(numberArgument(arguments, 0)), static_cast<int>(numberArgument(arguments, 1)),
                   static_cast<int>(numberArgument(arguments, 2)));
    const double most = numberArgument(arguments, 3);
    return most < 0 ? text : Value(std::get<std::string>(text).substr(0, static_cast<std::size_t>(most)));
  }
  if (name == "CFGREAD") {
    return configuration(textArgument(arguments, 1), textArgument(arguments, 2),
                         static_cast<int>(numberArgument(arguments, 3)));
  }
  throw Alarm("Function not available",
              fmt::format("{} reads data of the control that a virtual one does not have", name),
              "leave the function out, or set the parameter to a fixed value");
}

}  // namespace probewright::language::klartext
