#include <fmt/format.h>

#include <algorithm>

#include "execution/interpreter.hpp"

/// Where a program goes on: jumps, subprograms, repeated sections, structured statements.
namespace probewright::execution {

BlockPosition Interpreter::label(TextRef literal, const Operand& computed, JumpDirection direction,
                                 Evaluation& evaluation) {
  const bool same = !computed.present();
  if (same && block_->targetOf == instruction_) return block_->target;
  std::string text;
  if (!same) text = evaluation.text(computed);
  const std::string_view name = same ? evaluation.at(literal) : std::string_view(text);
  const auto found = current_->program->findLabel(name, block_->block.position, direction);
  if (!found) {
    const char* where = direction == JumpDirection::Forward    ? " after this block"
                        : direction == JumpDirection::Backward ? " before this block"
                                                               : " in this program";
    refuse(Refusal::MissingLabel, fmt::format("there is no label {}{}", name.empty() ? "\"\"" : name, where),
           "check how the label is written");
  }
  if (same) {
    block_->targetOf = instruction_;
    block_->target = *found;
  }
  return *found;
}

Interpreter::Flow Interpreter::jump(const Jump& jump, Evaluation& evaluation) {
  if (jump.condition.present() && !evaluation.truth(jump.condition)) return Flow::Next;
  if (jump.direction == JumpDirection::ProgramStart) {
    goTo(current_->program->begin());
    return Flow::Moved;
  }
  if (jump.ignoreMissing) {
    const std::string name =
        jump.labelValue.present() ? evaluation.text(jump.labelValue) : std::string(evaluation.at(jump.label));
    const auto target = current_->program->findLabel(name, block_->block.position, jump.direction);
    if (!target) return Flow::Next;
    goTo(*target);
    return Flow::Moved;
  }
  goTo(label(jump.label, jump.labelValue, jump.direction, evaluation));
  return Flow::Moved;
}

Interpreter::Flow Interpreter::mark(const LabelMark& mark) {
  if (!mark.end || frames_.back().kind != FrameKind::Label) return Flow::Next;
  resume(pop());
  return Flow::Moved;
}

Interpreter::Flow Interpreter::callLabel(const CallLabel& call, Evaluation& evaluation) {
  if (call.repeats.present()) return repeatPart(call, evaluation);
  const BlockPosition target = label(call.label, call.labelValue, JumpDirection::Any, evaluation);
  push({.kind = FrameKind::Label});
  goTo(target);
  return Flow::Moved;
}

Interpreter::Flow Interpreter::repeatPart(const CallLabel& call, Evaluation& evaluation) {
  const std::uint64_t offset = block_->block.position.offset;
  const auto ofThisCall = repeats_.begin() + static_cast<std::ptrdiff_t>(frames_.back().repeats);
  auto count = std::find_if(ofThisCall, repeats_.end(), [&](const RepeatCount& c) { return c.offset == offset; });
  if (count == repeats_.end()) {
    const double repeats = evaluation.number(call.repeats);
    if (repeats < 1) return Flow::Next;
    count = repeats_.insert(repeats_.end(), {offset, repeats});
  }
  if (count->remaining < 1) {
    repeats_.erase(count);
    return Flow::Next;
  }
  count->remaining -= 1;
  goTo(label(call.label, call.labelValue, JumpDirection::Any, evaluation));
  return Flow::Moved;
}

Interpreter::Flow Interpreter::repeatSection(const RepeatSection& repeat, Evaluation& evaluation) {
  const BlockPosition own = block_->block.position;
  const Frame& top = frames_.back();
  if (top.kind == FrameKind::Section && top.last == own.offset && top.call.offset == own.offset) {
    // The section reaches up to this block, so a pass of it is done.
    nextPass();
    return Flow::Moved;
  }
  const double times = evaluation.numberOr(repeat.times, 1);
  if (times < 1) return Flow::Next;
  const BlockPosition first = sectionStart(repeat, evaluation);
  push({.kind = FrameKind::Section,
        .remaining = times - 1,
        .first = first,
        .last = sectionEnd(repeat, first, evaluation)});
  goTo(first);
  return Flow::Moved;
}

BlockPosition Interpreter::sectionStart(const RepeatSection& repeat, Evaluation& evaluation) {
  const std::string_view name = evaluation.at(repeat.from);
  Program& program = *current_->program;
  const BlockPosition own = block_->block.position;
  if (const auto before = program.findLabel(name, own, JumpDirection::Backward)) return *before;
  if (const auto behind = program.findLabel(name, own, JumpDirection::Forward)) return *behind;
  refuse(Refusal::MissingLabel, fmt::format("there is no label {} in this program", name),
         "check how the label is written");
}

std::uint64_t Interpreter::sectionEnd(const RepeatSection& repeat, BlockPosition first, Evaluation& evaluation) {
  Program& program = *current_->program;
  const std::uint64_t own = block_->block.position.offset;
  const bool behind = first.offset > own;
  if (repeat.onlyBlock) return first.offset;
  const std::string_view name = repeat.to.length > 0 ? evaluation.at(repeat.to) : "ENDLABEL";
  if (name == evaluation.at(repeat.from)) return first.offset;
  const auto end = program.findLabel(name, first, JumpDirection::Forward);
  if (end && (behind || end->offset < own)) return end->offset;
  if (!behind && (end || name == "ENDLABEL")) return own;
  refuse(Refusal::MissingLabel,
         fmt::format("the section that begins with label {} has no end label {}", evaluation.at(repeat.from), name),
         "the end label must come after the first label");
}

// ---- structured statements ----

BlockPosition Interpreter::counterpart() {
  if (block_->targetOf == instruction_) return block_->target;
  const auto found = current_->program->counterpart(block_->block.position);
  if (!found) {
    refuse(Refusal::Structure, "this statement has no counterpart",
           "every IF, WHILE, FOR, LOOP and REPEAT needs its end, in the same program");
  }
  block_->targetOf = instruction_;
  block_->target = *found;
  return *found;
}

BlockPosition Interpreter::behindCounterpart() {
  if (block_->targetOf == instruction_) return block_->target;
  const BlockPosition behind = fetchAside(counterpart()).block.next;
  block_->target = behind;
  return behind;
}

Interpreter::Flow Interpreter::structured(const Structured& statement, Evaluation& evaluation) {
  switch (statement.kind) {
    case Structure::EndIf:
    case Structure::Loop:
    case Structure::Repeat:
      return Flow::Next;
    case Structure::If:
    case Structure::While:
      if (evaluation.truth(statement.condition)) return Flow::Next;
      goTo(behindCounterpart());
      return Flow::Moved;
    case Structure::For: {
      const double from = evaluation.number(statement.from);
      host_.write(evaluation.block().variables[statement.variable], from, evaluation);
      if (from <= evaluation.number(statement.to)) return Flow::Next;
      goTo(behindCounterpart());
      return Flow::Moved;
    }
    case Structure::Until:
      if (evaluation.truth(statement.condition)) return Flow::Next;
      [[fallthrough]];
    case Structure::Else:
    case Structure::EndWhile:
    case Structure::EndLoop:
      goTo(counterpart());
      return Flow::Moved;
    case Structure::EndFor:
      return endFor();
  }
  return Flow::Next;
}

Interpreter::Flow Interpreter::endFor() {
  const Block& head = fetchAside(counterpart()).block;
  const Structured* statement = nullptr;
  for (const Instruction& instruction : head.instructions) {
    const auto* found = std::get_if<Structured>(&instruction);
    if (found != nullptr && found->kind == Structure::For) statement = found;
  }
  if (statement == nullptr) refuse(Refusal::Structure, "this ENDFOR has no FOR");
  Evaluation evaluation(*current_->program, head, host_);
  const VariableRef& variable = head.variables[statement->variable];
  const Value value = host_.read(variable, evaluation);
  if (isText(value)) refuse(Refusal::TypeMismatch, "the variable of FOR has become a text");
  const double counted = std::get<double>(value) + 1;
  host_.write(variable, counted, evaluation);
  if (counted > evaluation.number(statement->to)) return Flow::Next;
  goTo(head.next);
  return Flow::Moved;
}

}  // namespace probewright::execution
