#include "cycles/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "base/number_text.hpp"
#include "cycles/heidenhain/registry.hpp"
#include "cycles/sinumerik/registry.hpp"

namespace probewright::cycles {
namespace {

std::string choicesText(std::span<const Choice> choices, std::optional<ControlKind> kind = std::nullopt) {
  std::string text;
  for (const Choice& choice : choices) {
    if (kind && !choice.controls.contains(*kind)) continue;
    if (!text.empty()) text += ", ";
    text += fmt::format("{} ({})", choice.value, choice.meaning);
  }
  return text;
}

/// The number in `digit` of `value`, which is not negative.
int digitOf(std::int64_t value, const CodeDigit& digit) {
  for (int i = 1; i < digit.place; ++i)
    value /= 10;
  std::int64_t size = 1;
  for (int i = 0; i < digit.width; ++i)
    size *= 10;
  return static_cast<int>(value % size);
}

}  // namespace

std::string_view unitOf(ValueKind kind) {
  switch (kind) {
    case ValueKind::Length:
      return "mm";
    case ValueKind::Angle:
      return "deg";
    case ValueKind::Feed:
      return "mm/min";
    default:
      return "";
  }
}

std::string_view nameOf(CycleFamily family) {
  switch (family) {
    case CycleFamily::Misalignment:
      return "workpiece misalignment";
    case CycleFamily::Preset:
      return "presetting";
    case CycleFamily::Inspection:
      return "workpiece inspection";
    case CycleFamily::Special:
      return "special";
    case CycleFamily::Calibration:
      return "calibration";
    case CycleFamily::Kinematics:
      return "kinematics";
    case CycleFamily::Tool:
      return "tool measurement";
  }
  return "";
}

ValueKind ResultDefinition::valueKind() const {
  using control::Quantity;
  switch (kind.of.quantity) {
    case Quantity::None:
      return ValueKind::Integer;
    case Quantity::Angle:
    case Quantity::Projection:
      return ValueKind::Angle;
    case Quantity::Name:
      return ValueKind::Text;
    default:
      return ValueKind::Length;
  }
}

void describe(control::ResultRecord& record, const ResultDefinition& definition) {
  record.meaning = definition.meaning.whole();
  record.label = definition.meaning.label;
  record.kind = definition.kind;
}

namespace {

/// "_OVR[100..199]" stands for all elements from 100 to 199.
bool standsFor(std::string_view defined, std::string_view name) {
  const std::size_t dots = defined.find("..");
  if (dots == std::string_view::npos) return defined == name;
  const std::size_t bracket = defined.find('[') + 1;
  if (!name.starts_with(defined.substr(0, bracket)) || !name.ends_with(']')) return false;
  const auto number = [](std::string_view text) { return parseInteger(text).value_or(-1); };
  const auto element = number(name.substr(bracket, name.size() - bracket - 1));
  return element >= number(defined.substr(bracket, dots - bracket)) &&
         element <= number(defined.substr(dots + 2, defined.size() - dots - 3));
}

}  // namespace

const ResultDefinition* CycleDefinition::result(std::string_view resultName, int units) const {
  const auto found = std::ranges::find_if(
      results, [&](const ResultDefinition& each) { return standsFor(each.name, resultName) && each.belongsTo(units); });
  return found == results.end() ? nullptr : &*found;
}

const Parameter* CycleDefinition::parameter(std::uint32_t address) const {
  const auto found = std::ranges::find(parameters, address, &Parameter::address);
  return found == parameters.end() ? nullptr : &*found;
}

std::vector<const CycleDefinition*> cyclesOf(ControlKind kind) {
  std::vector<const CycleDefinition*> found;
  const auto add = [&](const auto& entries) {
    for (const auto& entry : entries) {
      if (entry->definition.controls.contains(kind)) found.push_back(&entry->definition);
    }
  };
  add(heidenhain::entries());
  add(sinumerik::entries());
  std::ranges::sort(found, {}, &CycleDefinition::number);
  return found;
}

const CycleDefinition* heidenhainCycle(int number) {
  const heidenhain::Entry* entry = heidenhain::findEntry(number);
  return entry == nullptr ? nullptr : &entry->definition;
}

const CycleDefinition* sinumerikCycle(std::string_view name) {
  const sinumerik::Entry* entry = sinumerik::findEntry(name);
  return entry == nullptr ? nullptr : &entry->definition;
}

double inMillimetres(const Parameter& parameter, const Argument& argument, double unit, double feedUnit) {
  if (!argument.given) return argument.number;
  if (parameter.kind == ValueKind::Feed) return argument.number * feedUnit;
  return parameter.kind == ValueKind::Length ? argument.number * unit : argument.number;
}

control::ResultRecord resultRecord(std::string name, const ResultDefinition* definition, ValueKind kind, double value,
                                   const Compared& compared) {
  control::ResultRecord record;
  record.name = std::move(name);
  if (definition != nullptr) describe(record, *definition);
  record.value = value;
  record.unit = unitOf(kind);
  record.nominal = compared.nominal;
  if (compared.nominal) record.deviation = value - *compared.nominal;
  record.lowerLimit = compared.lower;
  record.upperLimit = compared.upper;
  record.verdict = compared.verdict;
  return record;
}

const CycleDefinition* cycleNamed(std::string_view name) {
  if (const auto number = parseInteger(name)) return heidenhainCycle(static_cast<int>(*number));
  return sinumerikCycle(name);
}

Arguments::Arguments(const CycleDefinition& definition) : definition_(&definition) {
  values_.resize(definition.parameters.size());
  for (std::size_t i = 0; i < values_.size(); ++i) {
    values_[i].number = definition.parameters[i].standard.value_or(0);
    values_[i].isText = definition.parameters[i].kind == ValueKind::Text;
  }
}

bool Arguments::set(std::uint32_t address, double number) {
  const Parameter* parameter = definition_->parameter(address);
  if (parameter == nullptr) return false;
  Argument& value = values_[static_cast<std::size_t>(parameter - definition_->parameters.data())];
  value.number = number;
  value.isText = false;
  value.given = true;
  return true;
}

bool Arguments::set(std::uint32_t address, std::string text) {
  const Parameter* parameter = definition_->parameter(address);
  if (parameter == nullptr) return false;
  Argument& value = values_[static_cast<std::size_t>(parameter - definition_->parameters.data())];
  value.text = std::move(text);
  value.isText = true;
  value.given = true;
  return true;
}

int Arguments::integer(std::uint32_t address) const { return static_cast<int>(std::lround(number(address))); }

const Argument& Arguments::at(std::uint32_t address) const {
  const Parameter* parameter = definition_->parameter(address);
  if (parameter == nullptr) {
    throw std::logic_error(fmt::format("cycle {} has no parameter {}", definition_->name, address));
  }
  return values_[static_cast<std::size_t>(parameter - definition_->parameters.data())];
}

Parameter Parameter::on(ControlKind control) const {
  Parameter here = *this;
  here.controls = ControlSet::of(control);
  if (!withSoftware.contains(control)) here.iTNC530Software = 0;
  if (!narrower.controls.contains(control)) return here;
  here.maximum = narrower.maximum;
  if (!narrower.text && kind == ValueKind::NumberOrText) here.kind = ValueKind::Integer;
  return here;
}

std::string complaint(const Parameter& parameter, const Argument& argument, ControlKind kind) {
  const auto head = [&] { return fmt::format("{} ({})", parameter.name, parameter.meaning); };
  if (argument.isText && parameter.kind == ValueKind::Feed) {
    const bool words = parameter.feedWords.contains(kind);
    if (words && (argument.text == "FMAX" || argument.text == "FAUTO")) return {};
    return fmt::format("{} cannot be {}; its range is {} to {} mm/min{}", head(), argument.text,
                       formatShortest(parameter.minimum), formatShortest(parameter.on(kind).maximum),
                       words ? ", or FMAX, FAUTO" : "");
  }
  if (argument.isText) {
    if (parameter.kind == ValueKind::Text || parameter.kind == ValueKind::NumberOrText) return {};
    return fmt::format("{} takes a number, not a text", head());
  }
  if (parameter.kind == ValueKind::Text) {
    return fmt::format("{} takes a text, not a number", head());
  }
  const double value = argument.number;
  if (!std::isfinite(value)) return fmt::format("{} is not a finite number", head());
  const bool whole = parameter.kind == ValueKind::Integer || parameter.kind == ValueKind::Option;
  if (whole && value != std::floor(value)) {
    return fmt::format("{} takes a whole number, not {}", head(), formatShortest(value));
  }
  if (parameter.kind == ValueKind::Option) {
    const auto chosen = [&](const Choice& choice) { return choice.value == value; };
    if (std::ranges::any_of(parameter.choices, chosen)) return {};
    return fmt::format("{} cannot be {}; it can be {}", head(), formatShortest(value),
                       choicesText(parameter.choices, kind));
  }
  if (value < parameter.minimum || value > parameter.maximum) {
    return fmt::format("{} cannot be {}; its range is {} to {}{}{}", head(), formatShortest(value),
                       formatShortest(parameter.minimum), formatShortest(parameter.on(kind).maximum),
                       unitOf(parameter.kind).empty() ? "" : " ", unitOf(parameter.kind));
  }
  return {};
}

std::string_view placeName(int place) {
  constexpr std::string_view names[] = {
      "units", "tens", "hundreds", "thousands", "ten thousands", "hundred thousands", "millions", "ten millions"};
  return names[static_cast<std::size_t>(std::clamp(place, 1, 8) - 1)];
}

std::string codeComplaint(const Parameter& parameter, const Argument& argument) {
  if (parameter.digits.empty() || argument.isText || !std::isfinite(argument.number)) return {};
  const auto wrong = [&](const std::string& why) {
    return fmt::format("{} ({}) cannot be {}: {}", parameter.name, parameter.meaning, formatShortest(argument.number),
                       why);
  };
  if (argument.number < 0) return wrong("a coded number is not negative");
  if (argument.number > parameter.maximum) return wrong("it has too many digits");
  const auto value = static_cast<std::int64_t>(argument.number);
  std::array<bool, 8> listed = {};
  for (const CodeDigit& digit : parameter.digits) {
    for (int place = digit.place; place < digit.place + digit.width; ++place)
      listed.at(static_cast<std::size_t>(place) - 1) = true;
    const int found = digitOf(value, digit);
    if (digit.choices.empty() ? found <= digit.most
                              : std::ranges::find(digit.choices, found, &Choice::value) != digit.choices.end()) {
      continue;
    }
    if (digit.choices.empty()) return wrong(fmt::format("the largest is {}", digit.most));
    return wrong(fmt::format("its {} ({}) can be {}; not {}", placeName(digit.place), digit.meaning,
                             choicesText(digit.choices), found));
  }
  for (int place = 1; place <= 8; ++place) {
    const int found = digitOf(value, {.place = place});
    if (found != 0 && !listed.at(static_cast<std::size_t>(place - 1))) {
      return wrong(fmt::format("its {} have no meaning and must be 0, not {}", placeName(place), found));
    }
  }
  return {};
}

std::string codeText(const Parameter& parameter, double value) {
  std::string text;
  if (parameter.digits.empty() || value < 0 || value > parameter.maximum) return text;
  // A number of which nothing is chosen asks for nothing, whatever its other digits say.
  if (value == 0 && parameter.digits.front().choices.empty()) return text;
  for (const CodeDigit& digit : parameter.digits) {
    const int found = digitOf(static_cast<std::int64_t>(value), digit);
    const auto choice = std::ranges::find(digit.choices, found, &Choice::value);
    std::string part;
    if (choice != digit.choices.end()) {
      part = choice->meaning;
    } else if (found != 0 && !digit.meaning.empty()) {
      part = fmt::format("{} {}", digit.meaning, found);
    }
    if (!part.empty()) text += fmt::format("{}{}", text.empty() ? "" : ", ", part);
  }
  return text;
}

Diagnostics check(const Arguments& arguments, ControlKind kind) {
  Diagnostics found;
  const CycleDefinition& definition = arguments.definition();
  const auto report = [&](std::string message, std::string advice = {}) {
    found.push_back({Severity::Error, {}, std::move(message), {}, std::move(advice), {}});
  };
  if (!definition.controls.contains(kind)) {
    report(fmt::format("cycle {} does not exist on the {}", definition.name, control::name(kind)));
    return found;
  }
  for (std::size_t i = 0; i < definition.parameters.size(); ++i) {
    const Parameter& parameter = definition.parameters[i];
    const Argument& argument = arguments.values()[i];
    if (!argument.given) {
      if (parameter.required() && parameter.controls.contains(kind)) {
        report(fmt::format("cycle {} lacks {} ({})", definition.name, parameter.name, parameter.meaning),
               fmt::format("add {} with its value", parameter.name));
      }
      continue;
    }
    if (!parameter.controls.contains(kind)) {
      report(fmt::format("{} ({}) does not exist in cycle {} of the {}", parameter.name, parameter.meaning,
                         definition.name, control::name(kind)));
      continue;
    }
    std::string text = complaint(parameter, argument, kind);
    if (!text.empty()) report(std::move(text));
  }
  return found;
}

}  // namespace probewright::cycles
