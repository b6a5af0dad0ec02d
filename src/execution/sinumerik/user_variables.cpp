#include "execution/sinumerik/user_variables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "control/alarm.hpp"
#include "execution/evaluation.hpp"

namespace probewright::execution::sinumerik {

using control::Alarm;

namespace {

Value initialValue(Type type) {
  if (type == Type::String || type == Type::Axis) return std::string();
  if (type == Type::Frame) return std::string("CTRANS()");
  return 0.0;
}

double wholeNumber(double value, double least, double most) {
  const double whole = std::floor(value + 0.5);
  if (!(whole >= least && whole <= most))
    throw Alarm("12160", fmt::format("the value {} lies outside {} to {}", value, least, most),
                "use a REAL variable or a smaller value");
  return whole;
}

}  // namespace

UserVariable::UserVariable(Type type, std::array<int, 3> sizes, int length)
    : type_(type), sizes_(sizes), length_(length) {
  std::size_t count = 1;
  for (const int size : sizes)
    count *= size > 0 ? static_cast<std::size_t>(size) : 1;
  values_.assign(count, initialValue(type));
}

std::size_t UserVariable::place(std::string_view name, std::span<const double> indices) const {
  std::size_t place = 0;
  for (std::size_t i = 0; i < sizes_.size(); ++i) {
    if (sizes_[i] == 0) {
      if (indices.size() > i)
        throw Alarm("12261",
                    i == 0 ? fmt::format("{} is not an array", name)
                           : fmt::format("{} has fewer than {} dimensions", name, indices.size()),
                    "compare the indices with the DEF of the variable");
      break;
    }
    // A name without indices means the first element.
    const double index = i < indices.size() ? indices[i] : 0;
    if (!(index >= 0 && index < sizes_[i]) || index != std::floor(index))
      throw Alarm(i == 0   ? "17020"
                  : i == 1 ? "17030"
                           : "17040",
                  fmt::format("illegal index {} for dimension {} of {}", index, i + 1, name),
                  fmt::format("the index runs from 0 to {}", sizes_[i] - 1));
    place = place * static_cast<std::size_t>(sizes_[i]) + static_cast<std::size_t>(index);
  }
  return place;
}

std::size_t UserVariable::dimensions() const {
  return static_cast<std::size_t>(std::ranges::count_if(sizes_, [](int size) { return size > 0; }));
}

double UserVariable::character(std::string_view name, std::span<const double> indices) const {
  const auto& text = std::get<std::string>(values_[place(name, indices.first(indices.size() - 1))]);
  const double index = indices.back();
  if (!(index >= 0 && index < static_cast<double>(text.size())) || index != std::floor(index))
    throw Alarm("17020", fmt::format("illegal index {} for a character of {}", index, name),
                fmt::format("its text has {} characters, counted from 0", text.size()));
  return static_cast<unsigned char>(text[static_cast<std::size_t>(index)]);
}

void UserVariable::setCharacter(std::string_view name, std::span<const double> indices, const Value& value) {
  auto& text = std::get<std::string>(values_[place(name, indices.first(indices.size() - 1))]);
  const double index = indices.back();
  const double room = std::min<double>(static_cast<double>(text.size()), length_ - 1);
  if (!(index >= 0 && index <= room) || index != std::floor(index))
    throw Alarm("17020", fmt::format("illegal index {} for a character of {}", index, name),
                fmt::format("its text has {} characters of {}, counted from 0", text.size(), length_));
  UserVariable character(Type::Char, {}, 0);
  character.set(0, value);
  const auto place = static_cast<std::size_t>(index);
  if (place == text.size()) text += ' ';
  text[place] = static_cast<char>(static_cast<unsigned char>(std::get<double>(character.at(0))));
}

void UserVariable::set(std::size_t place, const Value& value) {
  Value& target = values_[place];
  const auto* number = std::get_if<double>(&value);
  const auto* text = std::get_if<std::string>(&value);
  const auto refuse = [this]() -> const Alarm {
    return Alarm("12150", fmt::format("this value does not fit a variable of type {}", typeName(type_)),
                 "convert it: NUMBER(text), ROUND(number), \"\"<<number");
  };
  switch (type_) {
    case Type::Real:
      if (number == nullptr) throw refuse();
      target = withinLimits(*number);
      return;
    case Type::Int:
      if (number == nullptr) throw refuse();
      target = withinLimits(wholeNumber(*number, -2147483648.0, 2147483647.0));
      return;
    case Type::Bool:
      target = (number != nullptr ? *number != 0 : !text->empty()) ? 1.0 : 0.0;
      return;
    case Type::Char:
      if (number != nullptr) {
        target = wholeNumber(*number, 0, 255);
      } else if (text->size() == 1) {
        target = static_cast<double>(static_cast<unsigned char>(text->front()));
      } else {
        throw refuse();
      }
      return;
    case Type::String:
      if (text == nullptr) throw refuse();
      target = text->substr(0, static_cast<std::size_t>(length_));
      return;
    case Type::Axis:
    case Type::Frame:
      if (text == nullptr) throw refuse();
      target = *text;
      return;
  }
}

double UserVariable::withinLimits(double value) const {
  if (value < lower_)
    throw Alarm("17080", fmt::format("the value {} is below the lower limit {}", value, lower_),
                "the limits are those of its DEF: LLI, ULI");
  if (value > upper_)
    throw Alarm("17090", fmt::format("the value {} is above the upper limit {}", value, upper_),
                "the limits are those of its DEF: LLI, ULI");
  return value;
}

void UserVariable::limit(double lower, double upper) {
  lower_ = lower;
  upper_ = upper;
  if (type_ != Type::Real && type_ != Type::Int) return;
  if (lower > upper)
    throw Alarm("12160", fmt::format("the lower limit {} lies above the upper limit {}", lower, upper),
                "exchange LLI and ULI");
  for (Value& value : values_) {
    auto& number = std::get<double>(value);
    number = number == 0 ? std::clamp(number, lower, upper) : withinLimits(number);
  }
}

Value valueFor(Type type, const language::Operand& operand, Evaluation& evaluation) {
  if (type == Type::String) {
    if (auto text = evaluation.shownText(operand)) return std::move(*text);
  }
  return evaluation.value(operand);
}

UserVariable declaredVariable(const language::Command& command, Evaluation& evaluation) {
  const language::VariableRef& variable = evaluation.block().variables[static_cast<std::size_t>(command.variable)];
  const std::string_view name = evaluation.at(variable.name);
  Type type = Type::Real;
  typeOf(evaluation.at(command.text), type);
  std::array<int, 3> sizes{};
  std::size_t elements = 1;
  for (std::size_t i = 0; i < 3 && variable.index[i].present(); ++i) {
    const double size = evaluation.number(variable.index[i]);
    if (!(size >= 1 && size <= 1000000) || size != std::floor(size) || static_cast<double>(elements) * size > 65536)
      throw Alarm("12200", fmt::format("an array cannot have {} elements in dimension {}", size, i + 1),
                  "an array has 1 to 65536 elements");
    sizes[i] = static_cast<int>(size);
    elements *= static_cast<std::size_t>(size);
  }
  const auto words = evaluation.words(command.words);
  int length = 0;
  for (const language::Word& word : words)
    if (word.address == language::addressOf("LEN")) {
      const double wanted = evaluation.number(word.value);
      if (!(wanted >= 1 && wanted <= longestString) || wanted != std::floor(wanted))
        throw Alarm("12200", fmt::format("a STRING cannot have the length {}", wanted),
                    fmt::format("a STRING has 1 to {} characters", longestString));
      length = static_cast<int>(wanted);
    }
  UserVariable declared(type, sizes, length);
  std::size_t place = 0;
  for (const language::Word& word : words) {
    if (word.address == language::addressOf("LEN")) continue;
    if (word.address == language::addressOf("REP")) {
      const Value value = valueFor(type, word.value, evaluation);
      for (std::size_t i = 0; i < declared.count(); ++i)
        declared.set(i, value);
      break;
    }
    if (place >= declared.count())
      throw Alarm("17020", fmt::format("the list of first values of {} is longer than the array", name),
                  "shorten the list or give the array more elements");
    if (word.value.present()) declared.set(place, valueFor(type, word.value, evaluation));
    ++place;
  }
  return declared;
}

UserVariables::Scope UserVariables::leave() {
  if (levels_.empty()) return {};
  Scope scope = std::move(levels_.back());
  levels_.pop_back();
  return scope;
}

UserVariable& UserVariables::declare(std::string_view name, UserVariable variable) {
  Scope& scope = levels_.empty() ? global_ : levels_.back();
  return scope.insert_or_assign(std::string(name), std::move(variable)).first->second;
}

UserVariable* UserVariables::find(std::string_view name) {
  key_.assign(name);
  if (!levels_.empty()) {
    if (const auto found = levels_.back().find(key_); found != levels_.back().end()) return &found->second;
  }
  const auto found = global_.find(key_);
  return found == global_.end() ? nullptr : &found->second;
}

}  // namespace probewright::execution::sinumerik
