#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/text.hpp"
#include "execution/interpreter.hpp"

/// Programs that call each other: with arguments, repeatedly, in sections, after each motion.
namespace probewright::execution {

namespace {

constexpr std::size_t mostCalls = 256;

}  // namespace

Interpreter::Loaded* Interpreter::load(std::shared_ptr<Program> program) {
  for (const auto& loaded : programs_) {
    if (loaded->program == program || loaded->program->file() == program->file()) return loaded.get();
  }
  auto loaded = std::make_unique<Loaded>();
  loaded->id = static_cast<std::uint32_t>(programs_.size());
  loaded->program = std::move(program);
  programs_.push_back(std::move(loaded));
  return programs_.back().get();
}

Interpreter::Loaded* Interpreter::called(std::string_view name, Missing missing) {
  const bool maybeNone = missing == Missing::Fine;
  const Program* caller = current_->program.get();
  for (const Call& call : calls_) {
    if (call.caller == caller && call.name == name && (call.called != nullptr || maybeNone)) return call.called;
  }
  Loaded* loaded = nullptr;
  if (!maybeNone || library_.exists(name, caller)) {
    auto opened = library_.open(name, caller);
    if (!opened) {
      const Diagnostic& reason = opened.error();
      const std::string file = reason.place.file.empty() ? std::string() : reason.place.file + ": ";
      refuse(Refusal::MissingProgram, file + reason.message, reason.advice);
    }
    loaded = load(std::move(*opened));
  }
  if (calls_.size() >= mostCalls) calls_.clear();
  calls_.push_back({caller, std::string(name), loaded});
  return loaded;
}

Interpreter::Flow Interpreter::callProgram(const CallProgram& call, const Instruction& instruction,
                                           Evaluation& evaluation) {
  if (call.modal) {
    setModalCall(call, evaluation);
    return Flow::Next;
  }
  std::string computed;
  if (call.nameValue.present()) computed = evaluation.text(call.nameValue);
  const std::string_view name = call.nameValue.present() ? std::string_view(computed) : evaluation.at(call.name);
  Loaded* program = called(name, call.maybeCycle ? Missing::Fine : Missing::Refused);
  if (program == nullptr) {
    host_.execute(instruction, evaluation);
    return Flow::Next;
  }
  const double times = evaluation.numberOr(call.times, 1);
  if (times < 1) return Flow::Next;
  enter(*program, call, evaluation, times - 1);
  return Flow::Moved;
}

Interpreter::Flow Interpreter::followRequest(Evaluation& evaluation) {
  const std::string name = host_.requestedProgram();
  if (name.empty()) return Flow::Next;
  enter(*called(name, Missing::Refused), CallProgram{}, evaluation, 0);
  return Flow::Moved;
}

void Interpreter::enter(Loaded& program, const CallProgram& call, Evaluation& caller, double remaining) {
  if (levels_ >= options_.programDepth) {
    refuse(Refusal::NestingDepth, fmt::format("more than {} programs call each other", options_.programDepth),
           "look for a program that calls itself");
  }
  BlockPosition first = program.program->begin();
  std::uint64_t last = noSection;
  if (call.from.length > 0) std::tie(first, last) = sectionOf(*program.program, call, caller);
  host_.enter(*program.program, &call, &caller);
  push({.kind = FrameKind::Program, .caller = current_, .remaining = remaining, .last = last});
  frames_.back().sections = sections_ - 1;
  sections_ = 0;
  ++levels_;
  current_ = &program;
  block_ = nullptr;
  position_ = first;
}

std::pair<BlockPosition, std::uint64_t> Interpreter::sectionOf(Program& program, const CallProgram& call,
                                                               Evaluation& caller) const {
  const auto labelled = [&](TextRef label, BlockPosition from, JumpDirection direction) {
    const auto found = program.findLabel(caller.at(label), from, direction);
    if (found) return *found;
    refuse(Refusal::MissingLabel,
           fmt::format("the program {} has no section from {} to {}: the label {} is missing", program.name(),
                       caller.at(call.from), caller.at(call.to), caller.at(label)),
           "check how the labels are written, and their order");
  };
  const BlockPosition first = labelled(call.from, program.begin(), JumpDirection::Any);
  if (caller.at(call.from) == caller.at(call.to)) return {first, first.offset};
  return {first, labelled(call.to, first, JumpDirection::Forward).offset};
}

void Interpreter::setModalCall(const CallProgram& call, Evaluation& evaluation) {
  if (call.name.length == 0) {
    modal_.reset();
    host_.modalCall(false);
    return;
  }
  auto modal = std::make_unique<ModalCall>();
  Block& kept = modal->block;
  CallProgram copy = call;
  copy.modal = false;
  copy.times = {};
  copy.name = kept.add(evaluation.at(call.name));
  copy.arguments.first = 0;
  for (Word word : evaluation.words(call.arguments)) {
    if (word.value.present()) {
      const Value value = evaluation.value(word.value);
      if (const auto* text = std::get_if<std::string>(&value)) {
        Node node;
        node.operation = Operation::Text;
        node.text = kept.add(*text);
        kept.nodes.push_back(node);
        word.value = {0, static_cast<std::int32_t>(kept.nodes.size() - 1)};
      } else {
        word.value = Operand::of(std::get<double>(value));
      }
    }
    kept.words.push_back(word);
  }
  kept.source = kept.add(evaluation.at(evaluation.block().source));
  kept.instructions.emplace_back(copy);
  modal_ = std::move(modal);
  host_.modalCall(true);
}

Interpreter::Flow Interpreter::callModally() {
  Block& block = modal_->block;
  block.position = block_->block.position;
  Evaluation evaluation(*current_->program, block, host_);
  const Instruction& instruction = block.instructions.front();
  const auto& call = std::get<CallProgram>(instruction);
  Loaded* program = called(block.at(call.name), Missing::Fine);
  if (program == nullptr) {
    host_.execute(instruction, evaluation);
    return Flow::Next;
  }
  enter(*program, call, evaluation, 0);
  modal_->level = levels_;
  return Flow::Moved;
}

/// Leaves the current program. Its caller goes on, at the call; the main program stays the current one.
Interpreter::Frame Interpreter::popProgram() {
  while (frames_.back().kind != FrameKind::Program)
    pop();
  const Frame frame = pop();
  Loaded* left = current_;
  if (frame.caller != nullptr) {
    sections_ = frame.sections;
    --levels_;
    if (modal_ && modal_->level > levels_) modal_->level = 0;
    current_ = frame.caller;
    position_ = frame.call;
    block_ = nullptr;
  }
  host_.leave(*left->program);
  return frame;
}

namespace {

bool isPartOfName(char c) { return isLetter(c) || isDigit(c) || c == '_'; }

/// True if `text` stands in `line` before its comment, not as a part of a longer name. Small letters count as
/// capital ones; `text` has capital ones.
bool standsIn(std::string_view line, std::string_view text) {
  std::string capitals = upperCase(line);
  bool inText = false;
  for (std::size_t i = 0; i < capitals.size(); ++i) {
    if (capitals[i] == '"') inText = !inText;
    if (capitals[i] == ';' && !inText) capitals.resize(i);
  }
  for (std::size_t at = capitals.find(text); at != std::string::npos; at = capitals.find(text, at + 1)) {
    const std::size_t end = at + text.size();
    const bool begins = at == 0 || !isPartOfName(capitals[at - 1]) || !isPartOfName(text.front());
    const bool ends = end == capitals.size() || !isPartOfName(capitals[end]) || !isPartOfName(text.back());
    if (begins && ends) return true;
  }
  return false;
}

/// The next block after `from` with this text in it; if there is none, the first of the program.
std::optional<BlockPosition> findText(Program& program, BlockPosition from, std::string text) {
  text = upperCase(text);
  std::optional<BlockPosition> first;
  Block block;
  Diagnostics mistakes;
  for (BlockPosition at = program.begin(); program.parse(at, block, mistakes); at = block.next) {
    if ((first && at.offset <= from.offset) || !standsIn(block.at(block.source), text)) continue;
    if (at.offset > from.offset) return at;
    if (at.offset != from.offset) first = at;
  }
  return first;
}

}  // namespace

Interpreter::Flow Interpreter::returnFrom(const Return& order, Evaluation& evaluation) {
  if (!order.target.present() && !order.levels.present()) return leaveProgram();
  std::string target = order.target.present() ? evaluation.text(order.target) : std::string();
  while (target.ends_with(' ') || target.ends_with(':'))
    target.pop_back();
  const bool behind = order.behind.present() && evaluation.truth(order.behind);
  const double levels = evaluation.numberOr(order.levels, 1);
  if (!(levels >= 1 && levels < levels_) || levels != std::floor(levels)) {
    refuse(Refusal::NestingDepth,
           fmt::format("RET cannot leave {} program levels: {} lie above the main program", levels, levels_ - 1),
           "write how many program levels to leave, 1 or more");
  }
  for (double left = 1; left < levels; ++left)
    popProgram();
  if (target.empty()) return leaveProgram();
  const Frame frame = popProgram();
  auto found = current_->program->findLabel(target, frame.call, JumpDirection::ForwardThenBackward);
  if (!found) found = findText(*current_->program, frame.call, target);
  if (!found) {
    refuse(Refusal::MissingLabel,
           fmt::format("there is no label, no block number and no text {} in {}, to which RET returns", target,
                       current_->program->name()),
           "check how the destination is written");
  }
  goTo(behind ? fetchAside(*found).block.next : *found);
  return Flow::Moved;
}

Interpreter::Flow Interpreter::leaveProgram() {
  Loaded* left = current_;
  const Frame frame = popProgram();
  if (frame.caller == nullptr) return Flow::Finished;
  const std::string again = host_.requestedProgram();
  if (frame.remaining < 1 && again.empty()) {
    resume(frame);
    return Flow::Moved;
  }
  // The arguments of the next pass are computed anew.
  block_ = &fetchAside(frame.call);
  instruction_ = frame.instruction;
  Evaluation evaluation(*current_->program, block_->block, host_);
  if (!again.empty()) {
    enter(*called(again, Missing::Refused), CallProgram{}, evaluation, frame.remaining);
    return Flow::Moved;
  }
  enter(*left, std::get<CallProgram>(block_->block.instructions[frame.instruction]), evaluation, frame.remaining - 1);
  return Flow::Moved;
}

}  // namespace probewright::execution
