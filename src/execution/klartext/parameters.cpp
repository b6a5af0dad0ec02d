#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "base/utf8.hpp"
#include "control/alarm.hpp"
#include "execution/klartext/excerpt.hpp"
#include "execution/klartext/parameters.hpp"
#include "language/klartext/lexer.hpp"

namespace probewright::execution::klartext {

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

}  // namespace

std::optional<double>& Parameters::local(const VariableRef& variable) const {
  std::vector<std::optional<double>>& all = run_.levels.back().local;
  return all[static_cast<std::size_t>(numberOf(variable, all.size(), "QL"))];
}

Value Parameters::read(const VariableRef& variable) const {
  switch (variable.space) {
    case VariableSpace::QL:
      return local(variable).value_or(0);
    case VariableSpace::QR:
      return control_.q.qr(numberOf(variable, QParameters::remanentCount, "QR"));
    case VariableSpace::QS:
      return control_.q.qs(numberOf(variable, QParameters::count, "QS"));
    default:
      return control_.q.q(numberOf(variable, QParameters::count, "Q"));
  }
}

void Parameters::write(const VariableRef& variable, const Value& value) {
  if (variable.space == VariableSpace::QS) {
    const int number = numberOf(variable, QParameters::count, "QS");
    if (!isText(value)) {
      throw Alarm("Wrong data type", fmt::format("QS{} takes a text, not a number", number),
                  "convert the number with TOCHAR");
    }
    const std::string& text = std::get<std::string>(value);
    if (characterCount(text) > QParameters::longestText) {
      throw Alarm("String too long",
                  fmt::format("QS{} takes at most {} characters, these are {}", number, QParameters::longestText,
                              characterCount(text)),
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
      local(variable) = number;
      break;
    case VariableSpace::QR:
      control_.q.setQr(numberOf(variable, QParameters::remanentCount, "QR"), number);
      break;
    default:
      control_.q.setQ(numberOf(variable, QParameters::count, "Q"), number);
      break;
  }
}

bool Parameters::isDefined(const VariableRef& variable) const {
  switch (variable.space) {
    case VariableSpace::QL:
      return local(variable).has_value();
    case VariableSpace::QR:
      return !control_.q.isQrUndefined(numberOf(variable, QParameters::remanentCount, "QR"));
    case VariableSpace::QS:
      return !control_.q.isQsUndefined(numberOf(variable, QParameters::count, "QS"));
    default:
      return !control_.q.isUndefined(numberOf(variable, QParameters::count, "Q"));
  }
}

void Parameters::setUndefined(const VariableRef& variable) {
  switch (variable.space) {
    case VariableSpace::QL:
      local(variable).reset();
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

Value Parameters::readNamed(std::string_view name) const {
  if (name.starts_with('+')) name.remove_prefix(1);
  VariableRef variable;
  std::size_t letters = 1;
  const char kind = name.size() > 1 ? upper(name[1]) : '\0';
  if (kind == 'S') variable.space = VariableSpace::QS;
  if (kind == 'L') variable.space = VariableSpace::QL;
  if (kind == 'R') variable.space = VariableSpace::QR;
  if (variable.space != VariableSpace::Q) ++letters;
  const auto number = parseInteger(name.substr(std::min(letters, name.size())));
  if (name.empty() || upper(name[0]) != 'Q' || !number || *number < 0) {
    throw Alarm("FN 16: mask wrong", fmt::format("{} is not a Q parameter", excerptOf(name)),
                "correct the mask file of FN 16");
  }
  variable.index[0] = Operand::of(static_cast<double>(*number));
  return read(variable);
}

double Parameters::numberNamed(std::string_view name) const {
  const Value value = readNamed(name);
  if (isText(value)) throw Alarm("Wrong data type", fmt::format("{} is a text, not a number", name));
  return std::get<double>(value);
}

}  // namespace probewright::execution::klartext
