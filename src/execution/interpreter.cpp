#include "execution/interpreter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "language/word_column.hpp"

namespace probewright::execution {

namespace {

/// The instructions of a block without the stop, return or end at its end.
std::uint32_t behindLastAction(const Block& block) {
  std::size_t behind = block.instructions.size();
  const auto ends = [](const Instruction& each) {
    return std::holds_alternative<Stop>(each) || std::holds_alternative<Return>(each) ||
           std::holds_alternative<EndProgram>(each);
  };
  while (behind > 0 && ends(block.instructions[behind - 1]))
    --behind;
  return static_cast<std::uint32_t>(behind);
}

/// What a message quotes of a block.
std::string_view firstLine(std::string_view text) {
  text = text.substr(0, text.find('\n'));
  while (text.ends_with(' ') || text.ends_with('\r') || text.ends_with('~'))
    text.remove_suffix(1);
  return text;
}

/// A block that cannot be read ends the run with its own messages.
struct Broken {
  Diagnostics mistakes;
};

}  // namespace

/// Sends each instruction where it is carried out.
struct Interpreter::Dispatch {
  Interpreter& self;
  const Instruction& instruction;
  Evaluation& evaluation;

  Flow operator()(const Assign& assign) const {
    const VariableRef& variable = evaluation.block().variables[assign.variable];
    self.host_.write(variable, self.host_.valueFor(variable, assign.value, evaluation), evaluation);
    return Flow::Next;
  }
  Flow operator()(const Jump& jump) const { return self.jump(jump, evaluation); }
  Flow operator()(const LabelMark& mark) const { return self.mark(mark); }
  Flow operator()(const CallLabel& call) const { return self.callLabel(call, evaluation); }
  Flow operator()(const RepeatSection& repeat) const { return self.repeatSection(repeat, evaluation); }
  Flow operator()(const CallProgram& call) const { return self.callProgram(call, instruction, evaluation); }
  Flow operator()(const Structured& statement) const { return self.structured(statement, evaluation); }
  Flow operator()(const Return& order) const { return self.returnFrom(order, evaluation); }
  Flow operator()(const EndProgram&) const { return self.leaveProgram(); }
  template <class Other>
  Flow operator()(const Other&) const {
    self.host_.execute(instruction, evaluation);
    return self.followRequest(evaluation);
  }
};

Interpreter::Interpreter(ProgramLibrary& library, Host& host, InterpreterOptions options)
    : library_(library), host_(host), options_(std::move(options)) {}

void Interpreter::clear() {
  programs_.clear();
  calls_.clear();
  frames_.clear();
  repeats_.clear();
  modal_.reset();
  host_.modalCall(false);
  cache_.clear();
  current_ = nullptr;
  block_ = nullptr;
  resumeAt_ = instruction_ = 0;
  sectionLast_ = noSection;
  sections_ = levels_ = 0;
  blocks_ = work_ = 0;
}

RunResult Interpreter::run(std::shared_ptr<Program> main) {
  clear();
  current_ = load(std::move(main));
  position_ = current_->program->begin();
  RunResult result;
  try {
    host_.enter(*current_->program, nullptr, nullptr);
    frames_.push_back({.kind = FrameKind::Program});
    levels_ = 1;
    result = runLoop();
  } catch (const control::Alarm& alarm) {
    result.end = RunEnd::Alarm;
    Diagnostic cause = here(Severity::Error, alarm.text(), alarm.advice(), alarm.code());
    if (alarm.place()) relocate(cause, *alarm.place());
    result.diagnostics = explain(std::move(cause));
  } catch (const control::Cancelled&) {
    result.end = RunEnd::Cancelled;
    result.diagnostics = explain(options_.stop.stop_requested()
                                     ? here(Severity::Note, "the run was interrupted at this block")
                                     : here(Severity::Note, "the program stopped here and was not continued"));
  } catch (const control::RecordFull&) {
    result.end = RunEnd::RecordLimit;
    result.diagnostics =
        explain(here(Severity::Error, "the run was stopped: its messages, results and files have become too much",
                     "look for an endless loop, or raise the limit with --record-limit"));
  } catch (Broken& broken) {
    result.end = RunEnd::BrokenProgram;
    result.diagnostics = std::move(broken.mistakes);
    const Diagnostics calls = explain({});
    result.diagnostics.insert(result.diagnostics.end(), calls.begin() + 1, calls.end());
  } catch (...) {
    leaveAll();
    throw;
  }
  leaveAll();
  result.blocks = blocks_;
  return result;
}

void Interpreter::leaveAll() {
  for (; !frames_.empty(); frames_.pop_back()) {
    if (frames_.back().kind != FrameKind::Program) continue;
    try {
      host_.leave(*current_->program);
    } catch (const control::Alarm&) {  // why the run ends is known already
    } catch (const control::Cancelled&) {
    } catch (const control::RecordFull&) {
    }
    current_ = frames_.back().caller;
  }
}

RunResult Interpreter::runLoop() {
  const bool cancellable = options_.stop.stop_possible();
  for (;;) {
    if (cancellable && options_.stop.stop_requested()) throw control::Cancelled();
    block_ = fetch();
    if (block_ == nullptr) {
      if (leaveProgram() == Flow::Finished) return {};
      continue;
    }
    const Block& block = block_->block;
    const std::uint32_t first = std::exchange(resumeAt_, 0);
    if (first == 0) {
      if (limitReached()) {
        const std::string_view further =
            work_ > 0 ? ", elements of arrays, pieces of arcs and uses of files included" : "";
        return {RunEnd::StepLimit,
                explain(here(Severity::Error,
                             fmt::format("the run was stopped after {} blocks{}", options_.stepLimit, further),
                             "look for an endless loop, or raise the limit with --step-limit")),
                blocks_};
      }
      ++blocks_;
      if (blocks_ % 4096 == 0 && options_.onProgress) options_.onProgress(blocks_);
      if (isSkipped(block) || !host_.beginBlock(*current_->program, block)) {
        advance(block.position.offset, block.next);
        continue;
      }
      if (options_.onBlock) options_.onBlock(*current_->program, block);
    }
    const Flow flow = carryOut(block, first);
    work_ += host_.takeWork();
    if (flow == Flow::Finished) return {};
    if (flow == Flow::Next) advance(block.position.offset, block.next);
  }
}

bool Interpreter::limitReached() const { return options_.stepLimit != 0 && blocks_ + work_ >= options_.stepLimit; }

bool Interpreter::isSkipped(const Block& block) const {
  return block.skippable && options_.skipLevels[std::min<std::size_t>(block.skipLevel, 9)];
}

Interpreter::Flow Interpreter::carryOut(const Block& block, std::uint32_t first) {
  Evaluation evaluation(*current_->program, block, host_);
  const auto count = static_cast<std::uint32_t>(block.instructions.size());
  const bool modally = modal_ != nullptr && modal_->level == 0 && host_.drivesModalCall(block);
  const std::uint32_t last = modally ? behindLastAction(block) : 0;
  for (std::uint32_t i = first; i < count; ++i) {
    instruction_ = i;
    const Instruction& instruction = block.instructions[i];
    Flow flow = std::visit(Dispatch{*this, instruction, evaluation}, instruction);
    if (flow == Flow::Next && modally && i + 1 == last) flow = callModally();
    if (flow != Flow::Next) return flow;
  }
  return Flow::Next;
}

// ---- blocks ----

bool Interpreter::parse(BlockPosition position, ParsedBlock& parsed) {
  parsed.targetOf = ParsedBlock::nothing;
  mistakes_.clear();
  if (!current_->program->parse(position, parsed.block, mistakes_)) return false;
  if (!mistakes_.empty() && hasErrors(mistakes_) && !isSkipped(parsed.block)) throw Broken{mistakes_};
  return true;
}

ParsedBlock* Interpreter::fetch() {
  if (position_.offset < current_->frontier) {
    const auto [parsed, found] = cache_.slot(current_->id, position_.offset, block_);
    return found || parse(position_, parsed) ? &parsed : nullptr;
  }
  if (!parse(position_, streamed_)) return nullptr;
  current_->frontier = streamed_.block.next.offset;
  return &streamed_;
}

ParsedBlock& Interpreter::fetchAside(BlockPosition position) {
  const auto [parsed, found] = cache_.slot(current_->id, position.offset, block_);
  if (!found && !parse(position, parsed)) {
    refuse(Refusal::Structure, fmt::format("the program has no block at line {}", position.line));
  }
  return parsed;
}

void Interpreter::advance(std::uint64_t offset, BlockPosition next) {
  position_ = next;
  if (offset == sectionLast_) nextPass();
}

void Interpreter::nextPass() {
  Frame& section = frames_.back();
  if (section.remaining >= 1) {
    section.remaining -= 1;
    position_ = section.first;
  } else if (section.kind == FrameKind::Program) {
    leaveProgram();
  } else {
    resume(pop());
  }
}

void Interpreter::goTo(BlockPosition position) {
  // A jump out of a section ends its repetition.
  while (frames_.back().kind == FrameKind::Section &&
         (position.offset < frames_.back().first.offset || position.offset > frames_.back().last)) {
    pop();
  }
  position_ = position;
}

void Interpreter::resume(const Frame& frame) {
  if (frame.more) {
    position_ = frame.call;
    resumeAt_ = frame.instruction + 1;
  } else {
    advance(frame.call.offset, frame.next);
  }
}

void Interpreter::push(Frame frame) {
  if (frame.kind != FrameKind::Program && sections_ >= options_.sectionDepth) {
    refuse(Refusal::NestingDepth, fmt::format("more than {} subprograms or sections are nested", options_.sectionDepth),
           "look for a subprogram that calls itself without an end");
  }
  const Block& block = block_->block;
  frame.call = block.position;
  frame.next = block.next;
  frame.instruction = instruction_;
  frame.more = instruction_ + 1 < block.instructions.size();
  frame.repeats = repeats_.size();
  frames_.push_back(frame);
  ++sections_;
  watchSection();
}

Interpreter::Frame Interpreter::pop() {
  const Frame frame = frames_.back();
  frames_.pop_back();
  repeats_.resize(std::min(repeats_.size(), frame.repeats), RepeatCount{});
  --sections_;
  watchSection();
  return frame;
}

void Interpreter::watchSection() { sectionLast_ = frames_.empty() ? noSection : frames_.back().last; }

// ---- messages ----

void Interpreter::refuse(Refusal refusal, std::string text, std::string advice) const {
  throw control::Alarm(host_.code(refusal), std::move(text), std::move(advice));
}

Diagnostic Interpreter::here(Severity severity, std::string message, std::string advice, std::string code) const {
  Diagnostic diagnostic{severity,           {current_->program->file(), position_.line, 0},
                        std::move(message), {},
                        std::move(advice),  std::move(code)};
  if (block_ != nullptr && block_->block.position.offset == position_.offset) {
    const std::string_view source = block_->block.at(block_->block.source);
    diagnostic.excerpt = firstLine(source);
    diagnostic.place.column = columnOfFirstWord(source);
  }
  return diagnostic;
}

void Interpreter::relocate(Diagnostic& diagnostic, const control::AlarmPlace& place) const {
  if (diagnostic.place.file == place.file && diagnostic.place.line == place.line) return;
  diagnostic.place = {place.file, place.line, 0};
  diagnostic.excerpt.clear();
  for (const auto& loaded : programs_) {
    if (loaded->program->file() != place.file) continue;
    Block block;
    Diagnostics ignored;
    if (loaded->program->parse({place.offset, place.line}, block, ignored)) {
      diagnostic.excerpt = firstLine(block.at(block.source));
      diagnostic.place.column = columnOfFirstWord(block.at(block.source));
    }
  }
}

Diagnostics Interpreter::explain(Diagnostic cause) const {
  Diagnostics diagnostics{std::move(cause)};
  const Loaded* program = current_;
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame) {
    if (frame->kind == FrameKind::Program) {
      if (frame->caller == nullptr) break;
      const std::string name = program->program->name();
      program = frame->caller;
      diagnostics.push_back({Severity::Note,
                             {program->program->file(), frame->call.line, 0},
                             fmt::format("program {} was called here", name),
                             {},
                             {},
                             {}});
    } else {
      diagnostics.push_back(
          {Severity::Note,
           {program->program->file(), frame->call.line, 0},
           frame->kind == FrameKind::Label ? "the subprogram was called here" : "the section is repeated from here",
           {},
           {},
           {}});
    }
  }
  return diagnostics;
}

}  // namespace probewright::execution
