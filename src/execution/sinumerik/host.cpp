#include "execution/sinumerik/host.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "control/alarm.hpp"
#include "control/missing_axis.hpp"
#include "control/tool_spindle.hpp"
#include "execution/sinumerik/functions.hpp"
#include "language/sinumerik/program.hpp"
#include "language/word_column.hpp"

namespace probewright::execution::sinumerik {

using control::Alarm;

SinumerikHost::SinumerikHost(Control& control, HostOptions options)
    : control_(control), options_(std::move(options)), motion_(control, state_), system_(control, state_, motion_) {
  for (const control::sinumerik::DataKey& key : control.data.keys("R")) {
    if (key.indices.size() == 1) rParameter(std::stod(key.indices.front())) = control.data.number(key);
  }
  rChanged_.assign(rChanged_.size(), false);
  state_.gGroup[6] = control.plane - 16;
  state_.gGroup[1] = 2;
  state_.gGroup[8] = control.frames.settable + 1;
  state_.gGroup[7] = state_.gGroup[14] = 1;
  state_.gGroup[13] = state_.gGroup[15] = 2;
  if (const int units = control.initialFunction(13); units >= 1 && units <= 4) {
    state_.gGroup[13] = units;
    state_.feedInInch = units == 3;
  }
  if (control.initialFunction(14) == 2) {
    state_.gGroup[14] = 2;
    state_.incremental = true;
  }
  variables_.global() = options_.globalData;
  state_.gGroup[29] = control.initialFunction(29) == 3 ? 3 : control.diameter ? 2 : 1;
  motion_.onIgnoredWord = [this](std::string_view word) { skip(word); };
}

SinumerikHost::~SinumerikHost() {
  storeParameters();
  storeGlobalData();
}

std::string SinumerikHost::code(Refusal refusal) const {
  switch (refusal) {
    case Refusal::DivisionByZero:
    case Refusal::Domain:
    case Refusal::Overflow:
      return "14051";
    case Refusal::TypeMismatch:
      return "12150";
    case Refusal::MissingValue:
      return "12080";
    case Refusal::TooComplex:
      return "12070";
    case Refusal::MissingLabel:
      return "14080";
    case Refusal::MissingProgram:
      return "14011";
    case Refusal::NestingDepth:
      return "14000";
    case Refusal::Structure:
      return "12640";
  }
  return {};
}

std::string SinumerikHost::numberText(double value) const { return sinumerik::numberText(value); }

bool SinumerikHost::beginBlock(const Program& program, const Block& block) {
  if (&program != lastProgram_) {
    control_.panel.place.file = program.file();
    lastProgram_ = &program;
  }
  control_.panel.place.line = block.position.line;
  control_.panel.place.column = columnOfFirstWord(block.at(block.source));
  block_ = &block;
  if (control_.blockSearch && levels_.size() == 1 && block.position.line >= options_.searchLine) {
    motion_.flush();
    control_.blockSearch = false;
    if (options_.searchEnds) options_.searchEnds();
  }
  return true;
}

/// Motions, also those without a way: G0 or G1 alone, F and S while G0 or G1 is active.
bool SinumerikHost::drivesModalCall(const Block& block) const {
  const bool straight = state_.group1 == MoveKind::Rapid || state_.group1 == MoveKind::Linear;
  return std::ranges::any_of(block.instructions, [&](const Instruction& each) {
    if (std::holds_alternative<Move>(each)) return true;
    const auto* modal = std::get_if<Modal>(&each);
    if (modal == nullptr) return false;
    const ModalKind kind = kindOf(block, *modal);
    const int number = language::sinumerik::gFunction(block.at(modal->name)).value_or(-1);
    return number == 0 || number == 1 || (straight && (kind == ModalKind::Feed || kind == ModalKind::SpindleSpeed));
  });
}

void SinumerikHost::execute(const Instruction& instruction, Evaluation& evaluation) {
  try {
    std::visit(
        [&](const auto& each) {
          using Kind = std::remove_cvref_t<decltype(each)>;
          constexpr bool ofHost = std::is_same_v<Kind, Assign> || std::is_same_v<Kind, CallProgram> || !isFlow<Kind>;
          if constexpr (ofHost) {
            carryOut(each, evaluation);
          } else {
            throw std::logic_error("flow is the interpreter's");
          }
        },
        instruction);
  } catch (const control::MissingAxis& alarm) {
    // A frame has turned the programmed axes.
    throw Alarm("18310", alarm.text(), alarm.advice());
  }
}

void SinumerikHost::carryOut(const Assign& assign, Evaluation& evaluation) {
  const VariableRef& variable = evaluation.block().variables[assign.variable];
  // The common case, R parameters, goes without a detour through values of any type.
  if (variable.space == VariableSpace::R) {
    const double value = evaluation.number(assign.value);
    const double number = evaluation.number(variable.index[0]);
    rParameter(number) = value;
    rChanged_[static_cast<std::size_t>(number)] = true;
    return;
  }
  write(variable, evaluation.value(assign.value), evaluation);
}

Value SinumerikHost::call(std::string_view name, std::span<const Value> arguments) {
  if (isDimensionFunction(name) && arguments.size() == 1) {
    const auto* number = std::get_if<double>(&arguments[0]);
    if (number == nullptr) throw Alarm("12150", fmt::format("{} takes a number, not a text", name));
    // DIAM90 counts incremental values as radii.
    const bool countsDiameters = control_.diameter && !(name[1] == 'I' && state_.gGroup[29] == 3);
    return name[0] == 'D' ? *number / (countsDiameters ? 1 : 2) : *number * (countsDiameters ? 2 : 1);
  }
  FunctionQuestions questions;
  questions.isVariable = [this](std::string_view text) { return isVariableNamed(text); };
  questions.isAxis = [this](std::string_view axis) {
    return motion_.machineAxis(addressOf(axis)).has_value() || PathMotion::linearAxis(addressOf(axis)).has_value();
  };
  questions.isFile = [this](std::string_view path) { return isFile(std::string(path)); };
  questions.toolNumber = [this](std::string_view tool) {
    try {
      return control_.toolNumbered(std::string(tool));
    } catch (const Alarm&) {
      return -1;
    }
  };
  questions.frameUnit = state_.variableUnit(control_.unit);
  if (auto value = callFunction(name, arguments, questions)) return *value;
  throw Alarm("12340", fmt::format("the function {} is not available here", name));
}

void SinumerikHost::enter(const Program& program, const CallProgram* call, Evaluation* caller) {
  Level level;
  level.program = &program;
  level.call = control_.panel.place;
  const auto* own = dynamic_cast<const SinumerikProgram*>(&program);
  const BlockParser::Header* header = nullptr;
  if (own != nullptr) {
    ProgramStructure& structure = const_cast<SinumerikProgram*>(own)->structure();
    if (structure.header()) header = &*structure.header();
    if (!structure.headerMistake().empty())
      throw Alarm("14020",
                  fmt::format("the PROC line of {} cannot be read: {}", program.name(), structure.headerMistake()),
                  "correct it in " + program.file());
  }
  UserVariables::Scope parameters;
  const std::uint32_t given = call != nullptr ? call->arguments.count : 0;
  if (given > (header != nullptr ? header->parameters.size() : 0))
    throw Alarm("14020",
                fmt::format("{} is called with {} arguments and has {} parameters", program.name(), given,
                            header != nullptr ? header->parameters.size() : 0),
                "compare the call with the PROC line");
  if (header != nullptr && call != nullptr) {
    const auto words = caller->words(call->arguments);
    for (std::size_t i = 0; i < header->parameters.size(); ++i) {
      const BlockParser::Parameter& parameter = header->parameters[i];
      const bool present = i < words.size() && words[i].value.present();
      std::array<int, 3> sizes{};
      for (std::size_t k = 0; k < parameter.dimensions.size() && k < 3; ++k)
        sizes[k] = std::max(parameter.dimensions[k], 1);
      UserVariable variable(parameter.type, sizes, parameter.length);
      if (!present) {
        if (parameter.byReference && call->from.length == 0)
          throw Alarm("14020",
                      fmt::format("the VAR parameter {} of {} has no argument", parameter.name, program.name()));
        const bool text = parameter.type == Type::String || parameter.type == Type::Axis;
        if (parameter.type != Type::Frame)
          variable.set(0, text ? Value(parameter.defaultText) : Value(parameter.defaultNumber));
      } else if (!parameter.byReference) {
        variable.set(0, sinumerik::valueFor(parameter.type, words[i].value, *caller));
      } else {
        const Operand& operand = words[i].value;
        const Node* node = operand.node >= 0 ? &caller->block().nodes[static_cast<std::size_t>(operand.node)] : nullptr;
        if (node == nullptr || node->operation != Operation::Variable)
          throw Alarm("14020",
                      fmt::format("the VAR parameter {} of {} needs a variable", parameter.name, program.name()));
        ResolvedVariable source = resolve(caller->block().variables[node->a], *caller);
        UserVariable* whole =
            source.space == VariableSpace::User && source.indices.empty() ? variables_.find(source.name) : nullptr;
        if (whole != nullptr && whole->isArray()) {
          variable = *whole;
          work_ += 2 * variable.count();  // in, and out again
        } else {
          variable.set(0, read(source));
        }
        level.references.emplace_back(parameter.name, std::move(source));
      }
      parameters.emplace(parameter.name, std::move(variable));
    }
  } else if (header != nullptr) {
    for (const BlockParser::Parameter& parameter : header->parameters)
      parameters.emplace(parameter.name, UserVariable(parameter.type, {}, parameter.length));
    if (notice_) {
      const auto tell = [&](std::size_t place, int number) {
        if (header->parameters.size() <= place || header->parameters[place].type != Type::Int) return false;
        parameters.at(header->parameters[place].name).set(0, static_cast<double>(number));
        return true;
      };
      tell(0, notice_->cycle);
      builderTellsOccasions_ = tell(1, static_cast<int>(notice_->occasion));
    }
  }
  if (header != nullptr &&
      std::find(header->attributes.begin(), header->attributes.end(), "SAVE") != header->attributes.end())
    level.saved = SavedState{
        state_, control_.plane, control_.unit, control_.diameter, control_.frames.settable, control_.frames.programmed};
  variables_.enter();
  for (auto& [name, variable] : parameters)
    variables_.declare(name, std::move(variable));
  levels_.push_back(std::move(level));
  control_.level = static_cast<int>(levels_.size());
}

/// SAVE brings modal G functions and the programmed frame back. F and S stay as they are. The active settable frame and
/// basic frames stay too, so that measuring in a subprogram lasts (MD 10617 as delivered), but G54 to G599 is selected
/// as before.
void SinumerikHost::restore(const SavedState& saved) {
  const MotionState left = state_;
  state_ = saved.motion;
  if (left.constantCuttingSpeed == state_.constantCuttingSpeed) state_.spindleSpeed = left.spindleSpeed;
  state_.spindleDirection = left.spindleDirection;
  if (left.feedType == state_.feedType) state_.feed = left.feed;
  control_.plane = saved.plane;
  control_.unit = saved.unit;
  control_.diameter = saved.diameter;
  control_.frames.programmed = saved.programmed;
  if (control_.frames.settable != saved.settable) {
    control_.activateSettable(saved.settable);
  } else {
    control_.handOverFrames();
  }
  followSpeed();
}

void SinumerikHost::leave(const Program&) {
  if (levels_.empty()) return;
  try {
    motion_.flush();
  } catch (...) {
    leaveLevel();
    throw;
  }
  leaveLevel();
}

void SinumerikHost::leaveLevel() {
  Level level = std::move(levels_.back());
  levels_.pop_back();
  if (!levels_.empty()) control_.panel.place = level.call;
  control_.level = std::max(1, static_cast<int>(levels_.size()));
  UserVariables::Scope left = variables_.leave();
  for (const auto& [parameter, source] : level.references) {
    const auto found = left.find(parameter);
    if (found == left.end()) continue;
    UserVariable* whole =
        source.space == VariableSpace::User && source.indices.empty() ? variables_.find(source.name) : nullptr;
    if (whole != nullptr && whole->isArray()) {
      *whole = std::move(found->second);
    } else {
      write(source, found->second.at(0));
    }
  }
  if (level.saved) restore(*level.saved);
  lastProgram_ = nullptr;
  if (!levels_.empty()) return;
  storeParameters();
  storeGlobalData();
  if (control_.channel.spindleRotation() != machine::Rotation::None)
    control_.channel.turnSpindle(machine::Rotation::None, 0);
  auto* driven = control::toolSpindleOf(control_.channel);
  if (driven != nullptr && driven->toolSpindle().rotation != machine::Rotation::None)
    control::turnTool(control_.channel, *driven, machine::Rotation::None, 0);
}

}  // namespace probewright::execution::sinumerik
