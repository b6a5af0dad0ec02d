#include "execution/sinumerik/global_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "control/alarm.hpp"
#include "control/sinumerik/control.hpp"
#include "control/sinumerik/text.hpp"
#include "execution/evaluation.hpp"
#include "execution/sinumerik/functions.hpp"
#include "language/sinumerik/check.hpp"
#include "language/sinumerik/cursor.hpp"
#include "language/sinumerik/program.hpp"

namespace probewright::execution::sinumerik {

using control::Alarm;
using control::sinumerik::Control;
using control::sinumerik::DataKey;
using control::sinumerik::DataStore;
using control::sinumerik::DataValue;
using control::sinumerik::Frame;

namespace {

/// Where definition files are evaluated no program runs: there are constants and functions of them.
class DefinitionHost : public Host {
public:
  Value read(const VariableRef& variable, Evaluation& evaluation) override { refuse(evaluation.at(variable.name)); }
  void write(const VariableRef& variable, const Value&, Evaluation& evaluation) override {
    refuse(evaluation.at(variable.name));
  }
  bool isDefined(const VariableRef&, Evaluation&) override { return false; }
  Value call(std::string_view name, std::span<const Value> arguments) override {
    if (auto value = callFunction(name, arguments, questions_)) return *value;
    refuse(name);
  }
  void execute(const Instruction&, Evaluation&) override {}
  bool beginBlock(const Program&, const Block&) override { return true; }
  void enter(const Program&, const CallProgram*, Evaluation*) override {}
  void leave(const Program&) override {}

private:
  [[noreturn]] static void refuse(std::string_view name) {
    throw Alarm("12550", fmt::format("{} has no value in a definition file", name),
                "write numbers and texts there, or give the first value in an initialization text");
  }
  FunctionQuestions questions_ = {[](std::string_view) { return false; }, [](std::string_view) { return true; },
                                  [](std::string_view) { return false; }, [](std::string_view) { return -1; }};
};

struct Attributes {
  bool hasScope = false;  ///< NCK or CHAN
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

/// What stands between DEF and the first name, of which the instruction keeps nothing. `line` in capitals.
Attributes attributesOf(std::string_view line) {
  Attributes attributes;
  Cursor cursor(line);
  while (!cursor.atEnd() && cursor.peek() != '=' && cursor.peek() != ';') {
    const std::string_view word = cursor.name();
    if (word.empty()) {
      cursor.advance();
      continue;
    }
    if (word == "NCK" || word == "CHAN") attributes.hasScope = true;
    if (word != "LLI" && word != "ULI") continue;
    cursor.skipBlanks();
    const bool negative = cursor.peek() == '-';
    if (negative || cursor.peek() == '+') cursor.advance();
    cursor.skipBlanks();
    double value = 0;
    if (cursor.number(value)) (word == "LLI" ? attributes.lower : attributes.upper) = negative ? -value : value;
  }
  return attributes;
}

/// The first word of a line in capitals, after its block number.
std::string_view firstWord(std::string_view line) {
  Cursor cursor(line);
  cursor.skipBlanks();
  if (cursor.peek() == 'N' && isDigit(cursor.peek(1))) {
    cursor.advance();
    cursor.digits();
    cursor.skipBlanks();
  }
  return cursor.name();
}

class DefinitionReader {
public:
  DefinitionReader(std::string file, std::string text, std::vector<GlobalDatum>& data, Diagnostics& diagnostics)
      : program_(SinumerikProgram::fromText(std::move(file), std::move(text))),
        data_(data),
        diagnostics_(diagnostics) {}

  void readAll() {
    for (BlockPosition at = program_->begin();; at = block_.next) {
      const SourceLine line = program_->text().line(at.offset);
      if (!line) return;
      upper_ = upperCase(line.text);
      // What REDEF changes of a variable, its rights and limits at the panel, has no meaning here.
      if (firstWord(upper_) == "REDEF") {
        block_.next = {line.next, at.line + 1};
        continue;
      }
      const std::size_t before = diagnostics_.size();
      if (!program_->parse(at, block_, diagnostics_)) return;
      if (diagnostics_.size() > before) continue;
      attributes_ = attributesOf(upper_);
      for (const Instruction& instruction : block_.instructions) {
        if (std::holds_alternative<EndProgram>(instruction) || std::holds_alternative<Return>(instruction)) return;
        const Command* command = std::get_if<Command>(&instruction);
        const std::string_view what = command == nullptr ? std::string_view() : block_.at(command->name);
        if (what == "DEFINE") continue;
        if (what != "DEF") {
          complain(1, "a definition file holds lines of DEF and DEFINE only",
                   "write DEF NCK REAL NAME or DEFINE NAME AS text, and M17 after the last");
          break;
        }
        if (!attributes_.hasScope) {
          complain(columnOf("DEF"), "NCK or CHAN is missing after DEF",
                   "write DEF NCK for a variable of the whole control, DEF CHAN for one of the channel");
          break;
        }
        declare(*command);
      }
    }
  }

  const Macros& macros() const { return program_->macros(); }

private:
  std::size_t columnOf(std::string_view name) const {
    const std::size_t at = upper_.find(name);
    return at == std::string::npos ? 1 : at + 1;
  }

  void complain(std::size_t column, std::string message, std::string advice, std::string code = {}) {
    diagnostics_.push_back({Severity::Error,
                            {program_->file(), block_.position.line, static_cast<std::uint32_t>(column)},
                            std::move(message),
                            std::string(block_.at(block_.source)),
                            std::move(advice),
                            std::move(code)});
  }

  void declare(const Command& command) {
    const std::string name(block_.at(block_.variables[static_cast<std::size_t>(command.variable)].name));
    if (isGlobalUserData(name)) return;
    const auto known = std::ranges::find(data_, name, &GlobalDatum::name);
    if (known != data_.end()) {
      return complain(
          columnOf(name), fmt::format("{} is declared already", name),
          fmt::format("the first DEF is in {}, line {}; remove one of the two", known->place.file, known->place.line));
    }
    try {
      DefinitionHost host;
      Evaluation evaluation(*program_, block_, host);
      GlobalDatum datum{name, declaredVariable(command, evaluation), {}};
      datum.variable.limit(attributes_.lower, attributes_.upper);
      datum.place = {program_->file(), block_.position.line, static_cast<std::uint32_t>(columnOf(name))};
      data_.push_back(std::move(datum));
    } catch (const Alarm& alarm) {
      complain(columnOf(name), alarm.text(), alarm.advice(), alarm.code());
    }
  }

  std::shared_ptr<SinumerikProgram> program_;
  std::vector<GlobalDatum>& data_;
  Diagnostics& diagnostics_;
  Block block_;
  Attributes attributes_;
  std::string upper_;
};

Value valueOf(const DataValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? 1.0 : 0.0;
  return std::get<std::string>(value);
}

DataValue datumOf(const UserVariable& variable, std::size_t place) {
  const Value& value = variable.at(place);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  const double number = std::get<double>(value);
  return variable.type() == Type::Bool ? DataValue(number != 0) : DataValue(number);
}

template <class Store>
void storeFrame(const DataKey& key, const Frame& before, const Frame& after, const Store& store) {
  std::set<std::string> axes = {"X", "Y", "Z"};
  for (const Frame* each : {&before, &after})
    for (const auto& [axis, parts] : each->others)
      axes.insert(axis);
  for (const std::string& axis : axes) {
    for (const control::sinumerik::FramePart part : control::sinumerik::allFrameParts) {
      if (before.get(axis, part) == after.get(axis, part)) continue;
      DataKey component = key;
      component.indices.push_back(axis);
      component.indices.emplace_back(control::sinumerik::name(part));
      store(component, after.get(axis, part), before.get(axis, part));
    }
  }
}

/// The data of the control under which the element `place` of a variable is kept.
DataKey elementKey(std::string_view name, const UserVariable& variable, std::size_t place) {
  DataKey key(name, {});
  std::size_t stride = variable.count();
  for (const int size : variable.sizes()) {
    if (size == 0) break;
    stride /= static_cast<std::size_t>(size);
    key.indices.push_back(std::to_string(place / stride));
    place %= stride;
  }
  return key;
}

}  // namespace

void GlobalUserData::read(const std::string& file, std::string text, Diagnostics& diagnostics) {
  DefinitionReader reader(file, std::move(text), data_, diagnostics);
  reader.readAll();
  for (const auto& [name, macro] : reader.macros())
    macros_.insert_or_assign(name, macro);
}

std::vector<DeclaredDatum> GlobalUserData::declarations() const {
  std::vector<DeclaredDatum> all;
  for (const GlobalDatum& datum : data_)
    all.push_back({datum.name, datum.variable.type()});
  return all;
}

std::vector<int> GlobalUserData::sizesOf(std::string_view name) const {
  const GlobalDatum* datum = find(name);
  std::vector<int> sizes;
  if (datum == nullptr) return sizes;
  for (const int size : datum->variable.sizes())
    if (size > 0) sizes.push_back(size);
  return sizes;
}

const GlobalDatum* GlobalUserData::find(std::string_view name) const {
  const auto found = std::ranges::find(data_, name, &GlobalDatum::name);
  return found == data_.end() ? nullptr : &*found;
}

UserVariables::Scope GlobalUserData::variables(const DataStore& store, Diagnostics& diagnostics) const {
  UserVariables::Scope scope;
  for (const GlobalDatum& datum : data_) {
    UserVariable variable = datum.variable;
    for (const DataKey& key : store.keys(datum.name)) {
      try {
        std::vector<double> indices;
        for (const std::string& index : key.indices) {
          double number = 0;
          Cursor cursor(index);
          if (!cursor.number(number)) break;  // the components of a frame
          indices.push_back(number);
        }
        const std::size_t place = variable.place(datum.name, indices);
        if (variable.type() == Type::Frame) {
          variable.set(place, frameValue(store.frame(elementKey(datum.name, variable, place))));
        } else {
          variable.set(place, valueOf(*store.get(key)));
        }
      } catch (const Alarm& alarm) {
        diagnostics.push_back(
            {Severity::Error,
             datum.place,
             fmt::format("the value that an initialization text has for {} does not fit: {}", key.text(), alarm.text()),
             {},
             alarm.advice(),
             alarm.code()});
      }
    }
    scope.emplace(datum.name, std::move(variable));
  }
  return scope;
}

std::string definitionFileName(std::string_view fileName) {
  std::string name = upperCase(fileName);
  if (name.starts_with("_N_")) name.erase(0, 3);
  if (!name.ends_with(".DEF") && !name.ends_with("_DEF")) return {};
  name.resize(name.size() - 4);
  const bool numbered = name.size() == 4 && name.starts_with("GUD") && name[3] >= '1' && name[3] <= '9';
  static constexpr std::string_view names[] = {"SGUD", "MGUD", "UGUD", "GUD", "SMAC", "MMAC", "UMAC"};
  if (!numbered && std::ranges::find(names, name) == std::end(names)) return {};
  return name + ".DEF";
}

void storeChanges(const UserVariables::Scope& before, const UserVariables::Scope& now, Control& control) {
  const auto store = [&control](const DataKey& key, const DataValue& value, const DataValue& old) {
    control.data.set(key, value);
    const std::string text = key.text();
    const std::size_t bracket = text.find('[');
    control.journal.write({text.substr(0, bracket), bracket == std::string::npos ? "" : text.substr(bracket),
                           control::sinumerik::valueText(old), control::sinumerik::valueText(value)});
  };
  // In the order of their names, so that every run tells the same.
  const std::map<std::string, UserVariable> sorted(before.begin(), before.end());
  for (const auto& [name, old] : sorted) {
    const UserVariable& variable = now.at(name);
    for (std::size_t place = 0; place < variable.count(); ++place) {
      if (variable.at(place) == old.at(place)) continue;
      const DataKey key = elementKey(name, variable, place);
      if (variable.type() == Type::Frame) {
        storeFrame(key, frameOf(old.at(place)), frameOf(variable.at(place)), store);
      } else {
        store(key, datumOf(variable, place), datumOf(old, place));
      }
    }
  }
}

}  // namespace probewright::execution::sinumerik
