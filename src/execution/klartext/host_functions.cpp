#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "base/truncated.hpp"
#include "control/alarm.hpp"
#include "execution/klartext/excerpt.hpp"
#include "execution/klartext/host.hpp"
#include "execution/klartext/system_texts.hpp"

/// The functions that formulas call.
namespace probewright::execution::klartext {

using control::Alarm;

namespace {

double numberArgument(std::span<const Value> arguments, std::size_t index) {
  if (const auto* number = std::get_if<double>(&arguments[index])) return *number;
  throw Alarm("Wrong data type", "A number is needed here, not a text", "convert the text with TONUMB");
}

const std::string& textArgument(std::span<const Value> arguments, std::size_t index) {
  if (const auto* text = std::get_if<std::string>(&arguments[index])) return *text;
  throw Alarm("Wrong data type", "A text is needed here, not a number", "convert the number with TOCHAR");
}

/// The place in a text where SUBSTR and INSTR begin.
double beginArgument(std::string_view function, std::span<const Value> arguments, std::size_t index) {
  const double begin = numberArgument(arguments, index);
  if (begin >= 0) return begin;
  throw Alarm("Argument out of range", fmt::format("{} cannot begin at BEG{}", function, formatShortest(begin)),
              "characters are counted from BEG0");
}

}  // namespace

Value KlartextHost::call(std::string_view name, std::span<const Value> arguments) {
  if (name == "ANG") {
    const double angle = degreesFromRadians(std::atan2(numberArgument(arguments, 0), numberArgument(arguments, 1)));
    return angle < 0 ? angle + 360 : angle;
  }
  if (name == "PREDEF") {
    const int number = truncated(numberArgument(arguments, 0));
    const auto found = control_.globalDefinitions.find(number);
    if (found == control_.globalDefinitions.end()) {
      throw Alarm("GLOBAL DEF missing", fmt::format("Q{} is PREDEF, but no GLOBAL DEF gives it a value", number),
                  "program GLOBAL DEF before the cycle, or write the value into the cycle");
    }
    const auto& [value, unit, text] = found->second;
    if (!text.empty()) return text;                            // FMAX, FAUTO
    if (number == 301 || unit == control_.unit) return value;  // Q301 is a choice
    const bool isFeed = number == 208 || number == 253;        // all others are lengths
    return value * (isFeed ? control::heidenhain::feedUnit(unit) / control_.feedUnit() : unit / control_.unit);
  }
  // Inches per revolution make tenths of an inch per minute in an INCH program.
  const double feedUnits = control_.unit / control_.feedUnit();
  if (name == "FU") return numberArgument(arguments, 0) * control_.tool.spindleSpeed * feedUnits;
  if (name == "FZ") return numberArgument(arguments, 0) * control_.tool.spindleSpeed * tools_.teeth() * feedUnits;
  if (name == "SELECTED PGM") {
    if (run_.selectedProgram.empty()) {
      throw Alarm("Program not selected", "CALL SELECTED PGM finds no program selected", "program SEL PGM before it");
    }
    return run_.selectedProgram;
  }
  if (name == "TOCHAR") {
    const double decimals = numberArgument(arguments, 1);
    const double value = numberArgument(arguments, 0);
    return decimals < 0 ? formatShortest(value) : formatFixed(value, std::min(truncated(decimals), 15));
  }
  if (name == "TONUMB") {
    const std::string text(trimmed(textArgument(arguments, 0)));
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
    const double begin = beginArgument(name, arguments, 1);
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
    const double begin = beginArgument(name, arguments, 2);
    const std::size_t found = text.find(textArgument(arguments, 1), static_cast<std::size_t>(begin));
    return static_cast<double>(found == std::string::npos ? text.size() : found);
  }
  if (name == "STRCOMP") {
    const int order = textArgument(arguments, 0).compare(textArgument(arguments, 1));
    return order < 0 ? -1.0 : order > 0 ? 1.0 : 0.0;
  }
  if (name == "SYSSTR") {
    const Value text = systemText(run_, truncated(numberArgument(arguments, 0)),
                                  truncated(numberArgument(arguments, 1)), truncated(numberArgument(arguments, 2)));
    const double most = numberArgument(arguments, 3);
    return most < 0 ? text : Value(std::get<std::string>(text).substr(0, static_cast<std::size_t>(most)));
  }
  if (name == "CFGREAD") {
    return configuration(run_, textArgument(arguments, 1), textArgument(arguments, 2),
                         truncated(numberArgument(arguments, 3)));
  }
  throw Alarm("Function not available",
              fmt::format("{} reads data of the control that a virtual one does not have", name),
              "leave the function out, or set the parameter to a fixed value");
}

}  // namespace probewright::execution::klartext
