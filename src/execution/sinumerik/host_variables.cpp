#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.hpp"
#include "control/alarm.hpp"
#include "control/sinumerik/array_data.hpp"
#include "control/sinumerik/measuring_data.hpp"
#include "control/sinumerik/text.hpp"
#include "cycles/sinumerik/old_form.hpp"
#include "execution/sinumerik/functions.hpp"
#include "execution/sinumerik/global_data.hpp"
#include "execution/sinumerik/host.hpp"
#include "language/sinumerik/check.hpp"

/// Variables of SINUMERIK programs: R parameters, user variables, global user data, system variables.
namespace probewright::execution::sinumerik {

using control::Alarm;
using control::sinumerik::DataKey;

namespace {

constexpr double mostRParameters = 10000;

double numberOf(const Value& value, std::string_view name) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  throw Alarm("12150", fmt::format("{} takes a number, not a text", name));
}

/// FRAME_1[X,TR] and FRAMES_1[2,X,TR]: a component of a frame of the program.
struct FrameComponent {
  std::size_t place = 0;  ///< of the frame in its variable
  std::string axis;
  control::sinumerik::FramePart part = control::sinumerik::FramePart::Translation;

  bool isLength() const {
    using control::sinumerik::FramePart;
    return (part == FramePart::Translation || part == FramePart::Fine) && control::sinumerik::geometryAxisOf(axis);
  }
};

/// Nothing if `indices` name a whole frame.
std::optional<FrameComponent> frameComponent(const UserVariable& user, std::string_view name,
                                             std::span<const Value> indices) {
  const std::size_t own = user.isArray() ? 1 : 0;
  if (user.type() != Type::Frame || indices.size() <= own) return std::nullopt;
  const auto text = [&](std::size_t i) {
    const auto* word = i < indices.size() ? std::get_if<std::string>(&indices[i]) : nullptr;
    if (word == nullptr)
      throw Alarm("17020", fmt::format("{}: a component of a frame is named by axis and kind", name),
                  "write for instance [X,TR]");
    return upperCase(*word);
  };
  FrameComponent component;
  if (own == 1) component.place = user.place(name, std::array{numberOf(indices[0], "an index")});
  component.axis = text(own);
  const auto part = control::sinumerik::framePartOf(text(own + 1));
  if (!part) throw Alarm("17030", fmt::format("{} has the components TR, FI, RT, SC and MI", name));
  component.part = *part;
  return component;
}

Value readUser(const UserVariable& user, std::string_view name, std::span<const double> indices) {
  if (user.isCharacter(indices.size())) return user.character(name, indices);
  return user.at(user.place(name, indices));
}

void writeUser(UserVariable& user, std::string_view name, std::span<const double> indices, const Value& value) {
  if (user.isCharacter(indices.size())) return user.setCharacter(name, indices, value);
  user.set(user.place(name, indices), value);
}

}  // namespace

/// CHAR and a character of a STRING show as the character, BOOL as 1 or 0.
std::optional<std::string> SinumerikHost::shownText(const VariableRef& variable, Evaluation& evaluation) {
  if (variable.space != VariableSpace::User) return std::nullopt;
  const UserVariable* user = variables_.find(evaluation.at(variable.name));
  if (user == nullptr) return std::nullopt;
  const auto given = static_cast<std::size_t>(
      std::ranges::count_if(variable.index, [](const Operand& index) { return index.present(); }));
  const bool truth = user->type() == Type::Bool;
  if (!truth && user->type() != Type::Char && !user->isCharacter(given)) return std::nullopt;
  const Value code = read(variable, evaluation);
  if (truth) return numberText(std::get<double>(code));
  return std::string(1, static_cast<char>(static_cast<unsigned char>(std::get<double>(code))));
}

Value SinumerikHost::valueFor(const VariableRef& variable, const Operand& operand, Evaluation& evaluation) {
  if (variable.space != VariableSpace::User || operand.node < 0) return evaluation.value(operand);
  const UserVariable* user = variables_.find(evaluation.at(variable.name));
  return user == nullptr ? evaluation.value(operand) : sinumerik::valueFor(user->type(), operand, evaluation);
}

double& SinumerikHost::rParameter(double number) {
  if (!(number >= 0 && number < mostRParameters) || number != std::floor(number))
    throw Alarm("17020", fmt::format("there is no R parameter {}", number),
                fmt::format("R parameters have the numbers 0 to {}", mostRParameters - 1));
  const auto place = static_cast<std::size_t>(number);
  if (place >= r_.size()) {
    r_.resize(std::max<std::size_t>(place + 1, 100));
    rChanged_.resize(r_.size());
  }
  return r_[place];
}

void SinumerikHost::storeParameters() {
  for (std::size_t i = 0; i < r_.size(); ++i) {
    if (rChanged_[i]) control_.data.set("R", {static_cast<int>(i)}, r_[i]);
    rChanged_[i] = false;
  }
}

void SinumerikHost::storeGlobalData() {
  storeChanges(options_.globalData, variables_.global(), control_);
  options_.globalData = variables_.global();
}

SinumerikHost::ResolvedVariable SinumerikHost::resolve(const VariableRef& variable, Evaluation& evaluation) const {
  ResolvedVariable resolved;
  resolved.space = variable.space;
  resolved.name = evaluation.at(variable.name);
  for (const Operand& index : variable.index) {
    if (!index.present()) break;
    resolved.indices.push_back(evaluation.value(index));
  }
  return resolved;
}

Value SinumerikHost::read(const VariableRef& variable, Evaluation& evaluation) {
  if (variable.space == VariableSpace::R) return rParameter(evaluation.number(variable.index[0]));
  if (variable.space == VariableSpace::User) {
    if (UserVariable* user = variables_.find(evaluation.at(variable.name));
        user != nullptr && user->type() != Type::Frame) {
      double indices[3];
      std::size_t count = 0;
      for (const Operand& index : variable.index)
        if (index.present()) indices[count++] = evaluation.number(index);
      return readUser(*user, evaluation.at(variable.name), {indices, count});
    }
  }
  return read(resolve(variable, evaluation));
}

void SinumerikHost::write(const VariableRef& variable, const Value& value, Evaluation& evaluation) {
  if (variable.space == VariableSpace::User) {
    if (UserVariable* user = variables_.find(evaluation.at(variable.name));
        user != nullptr && user->type() != Type::Frame) {
      double indices[3];
      std::size_t count = 0;
      for (const Operand& index : variable.index)
        if (index.present()) indices[count++] = evaluation.number(index);
      return writeUser(*user, evaluation.at(variable.name), {indices, count}, value);
    }
  }
  write(resolve(variable, evaluation), value);
}

Value SinumerikHost::read(const ResolvedVariable& variable) {
  switch (variable.space) {
    case VariableSpace::R:
      return rParameter(numberOf(variable.indices.at(0), "R[]"));
    case VariableSpace::System:
      if (variable.name == "$R" && !variable.indices.empty()) return rParameter(numberOf(variable.indices[0], "$R"));
      return system_.read(variable.name, variable.indices);
    default:
      break;
  }
  if (const UserVariable* user = variables_.find(variable.name)) {
    if (const auto component = frameComponent(*user, variable.name, variable.indices))
      return frameOf(user->at(component->place)).get(component->axis, component->part) /
             (component->isLength() ? state_.variableUnit(control_.unit) : 1);
    std::vector<double> indices;
    for (const Value& index : variable.indices)
      indices.push_back(numberOf(index, "an index"));
    return readUser(*user, variable.name, indices);
  }
  if (auto global = readGlobal(variable.name, variable.indices)) return *global;
  throw Alarm("12550", fmt::format("the name {} is not defined", variable.name),
              fmt::format("declare it at the beginning of the program: DEF REAL {}", variable.name));
}

void SinumerikHost::write(const ResolvedVariable& variable, const Value& value) {
  switch (variable.space) {
    case VariableSpace::R: {
      const double number = numberOf(variable.indices.at(0), "R[]");
      rParameter(number) = numberOf(value, "an R parameter");
      rChanged_[static_cast<std::size_t>(number)] = true;
      return;
    }
    case VariableSpace::System:
      if (variable.name == "$R" && !variable.indices.empty())
        return write({VariableSpace::R, {}, variable.indices}, value);
      if (isFrameWithoutEffect(variable.name)) skip(variable.name);
      return system_.write(variable.name, variable.indices, value);
    default:
      break;
  }
  if (UserVariable* user = variables_.find(variable.name)) {
    if (const auto component = frameComponent(*user, variable.name, variable.indices)) {
      control::sinumerik::Frame frame = frameOf(user->at(component->place));
      frame.set(component->axis, component->part,
                numberOf(value, variable.name) * (component->isLength() ? state_.variableUnit(control_.unit) : 1));
      return user->set(component->place, frameValue(frame));
    }
    std::vector<double> indices;
    for (const Value& index : variable.indices)
      indices.push_back(numberOf(index, "an index"));
    return writeUser(*user, variable.name, indices, value);
  }
  if (writeGlobal(variable.name, variable.indices, value)) return;
  throw Alarm("12550", fmt::format("the name {} is not defined", variable.name),
              fmt::format("declare it at the beginning of the program: DEF REAL {}", variable.name));
}

/// Results of measuring cycles, names of older cycles, data of the control's GUD files.
std::optional<Value> SinumerikHost::readGlobal(std::string_view name, std::span<const Value> indices) {
  if (name == "_OVR" || name == "_OVI") {
    const double index = indices.empty() ? 0 : numberOf(indices[0], name);
    const auto size = static_cast<double>(name == "_OVR" ? control_.ovr.size() : control_.ovi.size());
    if (!(index >= 0 && index < size)) throw Alarm("17020", fmt::format("illegal index {} of {}", index, name));
    const auto place = static_cast<std::size_t>(index);
    return name == "_OVR" ? control_.ovr[place] : static_cast<double>(control_.ovi[place]);
  }
  const DataKey key = dataKey(name, indices);
  if (const auto old = control::sinumerik::readGud(control_.data, key)) return *old;
  if (const auto value = control_.data.get(key)) {
    if (const auto* text = std::get_if<std::string>(&*value)) return *text;
    return control_.data.number(key);
  }
  if (isGlobalUserData(name) || !control_.data.keys(name).empty()) return 0.0;
  return std::nullopt;
}

bool SinumerikHost::writeGlobal(std::string_view name, std::span<const Value> indices, const Value& value) {
  if (name == "_OVR" || name == "_OVI") {
    readGlobal(name, indices);  // refuses an index out of range
    const auto place = static_cast<std::size_t>(indices.empty() ? 0 : numberOf(indices[0], name));
    const double number = numberOf(value, name);
    if (name == "_OVR") {
      control_.ovr[place] = number;
    } else {
      control_.ovi[place] = static_cast<int>(std::lround(number));
    }
    return true;
  }
  const DataKey key = dataKey(name, indices);
  const auto* number = std::get_if<double>(&value);
  if (number != nullptr && control::sinumerik::writeGud(control_.data, key, *number)) return true;
  if (!isGlobalUserData(name) && !control_.data.get(key) && control_.data.keys(name).empty()) return false;
  if (number != nullptr) {
    // Parameters of a call are not corrections of the control's data.
    if (cycles::sinumerik::isOldParameter(name)) {
      control_.data.set(key, *number);
    } else {
      control_.write(key, *number);
    }
  } else {
    control_.data.set(key, std::get<std::string>(value));
  }
  return true;
}

bool SinumerikHost::isDefined(const VariableRef& variable, Evaluation& evaluation) {
  return variable.space == VariableSpace::R || isVariableNamed(evaluation.at(variable.name));
}

/// ISVAR("NAME"), ISVAR("NAME[1]"), ISVAR("$TC_DP1[1,1]"), ISVAR("R5").
bool SinumerikHost::isVariableNamed(std::string_view text) {
  std::string name = upperCase(text.substr(0, text.find('[')));
  std::vector<Value> indices;
  if (const std::size_t open = text.find('['); open != std::string_view::npos) {
    Cursor cursor(text.substr(open + 1));
    while (!cursor.atEnd() && cursor.peek() != ']') {
      double number = 0;
      cursor.skipBlanks();
      const double sign = cursor.take('-') ? -1 : 1;
      if (cursor.number(number)) {
        indices.emplace_back(sign * number);
      } else {
        const std::string word = upperCase(cursor.name());
        if (word.empty()) return false;
        indices.emplace_back(word);
      }
      cursor.take(',');
    }
  }
  if (name.empty()) return false;
  if (name[0] == '$') return system_.exists(name, indices);
  const bool rNumber = name[0] == 'R' && name.size() > 1 && std::all_of(name.begin() + 1, name.end(), isDigit);
  if (rNumber || name == "R") return true;
  if (const UserVariable* user = variables_.find(name)) {
    try {
      std::vector<double> numbers;
      for (const Value& index : indices)
        numbers.push_back(numberOf(index, name));
      user->place(name, numbers);
      return true;
    } catch (const Alarm&) {
      return false;
    }
  }
  return name == "_OVR" || name == "_OVI" || isGlobalUserData(name) ||
         control_.data.get(dataKey(name, indices)).has_value();
}

void SinumerikHost::declare(const Command& command, Evaluation& evaluation) {
  const VariableRef& variable = evaluation.block().variables[static_cast<std::size_t>(command.variable)];
  UserVariable declared = declaredVariable(command, evaluation);
  work_ += declared.count() - 1;
  variables_.declare(evaluation.at(variable.name), std::move(declared));
}

/// NAME[i]=SET(...) from that element on, NAME[i]=REP(value) to the end of the array, REP(value, count).
void SinumerikHost::fill(const Command& command, Evaluation& evaluation) {
  const VariableRef& variable = evaluation.block().variables[static_cast<std::size_t>(command.variable)];
  const auto words = evaluation.words(command.words);
  const bool repeat = evaluation.at(command.name) == "REP";
  UserVariable* user = variable.space == VariableSpace::User ? variables_.find(evaluation.at(variable.name)) : nullptr;
  if (user == nullptr) {
    // R parameters and data of the store: consecutive numbers of the last index.
    ResolvedVariable target = resolve(variable, evaluation);
    const std::string name = upperCase(target.name);
    const control::sinumerik::MeasuringDatum* datum = control::sinumerik::findMeasuringDatum(name);
    if (target.indices.empty()) {
      // A name without an index means the first element.
      if (!control::sinumerik::isArrayDatum(name) && name != "_OVR" && name != "_OVI")
        throw Alarm("12400", fmt::format("{} is not an array: SET and REP fill arrays", target.name),
                    fmt::format("write {}= and one value", target.name));
      target.indices.emplace_back(0.0);
    }
    const double first = numberOf(target.indices.back(), "an index");
    const double toTheEnd = datum != nullptr ? std::max(1.0, datum->elements - first) : 1;
    const double count =
        repeat ? (words.size() > 1 ? evaluation.number(words[1].value) : toTheEnd) : static_cast<double>(words.size());
    for (double i = 0; i < count && i < mostRParameters; ++i) {
      const Word& word = words[repeat ? 0 : static_cast<std::size_t>(i)];
      target.indices.back() = first + i;
      ++work_;
      if (word.value.present()) write(target, evaluation.value(word.value));
    }
    return;
  }
  double indices[3];
  std::size_t count = 0;
  for (const Operand& index : variable.index)
    if (index.present()) indices[count++] = evaluation.number(index);
  std::size_t place = user->place(evaluation.at(variable.name), {indices, count});
  if (repeat) {
    if (words.empty()) throw Alarm("14020", "REP needs a value");
    const Value value = sinumerik::valueFor(user->type(), words[0].value, evaluation);
    const double most = words.size() > 1 ? evaluation.number(words[1].value) : 1e9;
    for (double i = 0; i < most && place < user->count(); ++i, ++work_)
      user->set(place++, value);
    return;
  }
  for (const Word& word : words) {
    if (place >= user->count())
      throw Alarm("17020", fmt::format("SET has more values than {} has elements", evaluation.at(variable.name)));
    if (word.value.present()) user->set(place, sinumerik::valueFor(user->type(), word.value, evaluation));
    ++place;
  }
}

}  // namespace probewright::execution::sinumerik
