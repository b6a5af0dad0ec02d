#include "execution/klartext/host.hpp"

#include <algorithm>

#include "control/alarm.hpp"
#include "language/word_column.hpp"

namespace probewright::language::klartext {

using control::Alarm;

namespace {

constexpr std::size_t localCount = 500;

}  // namespace

KlartextHost::KlartextHost(control::heidenhain::Control& control, HostOptions options)
    : control_(control),
      options_(std::move(options)),
      contour_([this](const Element& element) { runElement(element, control_.coordinates.plane); },
               [this]() { return control_.channel.toolRadius; }) {}

void KlartextHost::execute(const Instruction& instruction, Evaluation& evaluation) {
  try {
    if (const auto* motion = std::get_if<Move>(&instruction)) {
      move(*motion, evaluation);
    } else if (const auto* function = std::get_if<MachineFunction>(&instruction)) {
      machineFunction(*function, evaluation);
    } else if (const auto* called = std::get_if<ToolCall>(&instruction)) {
      settle();
      callTool(*called, evaluation);
    } else if (const auto* change = std::get_if<Transform>(&instruction)) {
      settle();
      transform(*change, evaluation);
    } else if (const auto* measuring = std::get_if<CycleCall>(&instruction)) {
      settle();
      cycle(*measuring, evaluation);
    } else if (const auto* other = std::get_if<Command>(&instruction)) {
      command(*other, evaluation);
    } else if (const auto* modal = std::get_if<Modal>(&instruction)) {
      contour_.flush();
      guideTool(*modal, evaluation);
    } else if (std::holds_alternative<Stop>(instruction)) {
      contour_.flush();
      const bool optional = std::get<Stop>(instruction).optional;
      if (!optional) control_.panel.stop("Program stop", control_.channel.seconds());
    }
  } catch (...) {
    contour_.discard();
    throw;
  }
}

bool KlartextHost::beginBlock(const Program& program, const Block& block) {
  untiltedPositions_ = ignoreProbe_ = false;
  SourcePlace& place = control_.panel.place;
  place.line = block.position.line;
  place.column = columnOfFirstWord(block.at(block.source));
  if (levels_.empty() || levels_.back().file != place.file) place.file = program.file();
  // The end of a program has no instruction for the host, but motion that waits must come to its end.
  const bool ends = std::ranges::any_of(
      block.instructions, [](const Instruction& each) { return std::holds_alternative<EndProgram>(each); });
  if (ends && block.instructions.size() == 1) settle();
  if (ends) warnOfEarlyEnd(block);
  return true;
}

/// Controls warn of M2 and M30 in called programs.
void KlartextHost::warnOfEarlyEnd(const Block& block) {
  const HeidenhainProgram* program = levels_.empty() ? nullptr : levels_.back().program;
  if (levels_.size() < 2 || program == nullptr || program->framePart(block) == FramePart::End) return;
  if (leftOut_.insert("M30 of " + levels_.back().file).second) {
    warn("M2 or M30 in a called program ends only that program; the calling program continues");
  }
}

std::string KlartextHost::code(Refusal refusal) const {
  switch (refusal) {
    case Refusal::DivisionByZero:
      return "Division by zero";
    case Refusal::Domain:
      return "Argument out of range";
    case Refusal::Overflow:
      return "Arithmetic overflow";
    case Refusal::TypeMismatch:
      return "Wrong data type";
    case Refusal::MissingValue:
      return "Value missing";
    case Refusal::TooComplex:
      return "Formula too complex";
    case Refusal::MissingLabel:
      return "Label not found";
    case Refusal::MissingProgram:
      return "Program not found";
    case Refusal::NestingDepth:
      return "Nesting too deep";
    case Refusal::Structure:
      return "Program structure wrong";
  }
  return {};
}

void KlartextHost::enter(const Program& program, const CallProgram*, Evaluation*) {
  Level level;
  level.program = dynamic_cast<const HeidenhainProgram*>(&program);
  level.file = program.file();
  level.outerUnit = control_.unit;
  level.local.assign(localCount, std::nullopt);
  if (levels_.empty()) {
    control_.programPath = program.file();
    control_.startSeconds = control_.channel.seconds();
    control_.applyCoordinates();
  }
  if (level.program != nullptr) control_.unit = level.program->unit() == Unit::Inch ? 25.4 : 1;
  if (levels_.empty()) control_.mainUnit = control_.unit;
  levels_.push_back(std::move(level));
  publishTool();
}

void KlartextHost::leave(const Program&) {
  contour_.discard();
  if (levels_.empty()) return;
  control_.unit = levels_.back().outerUnit;
  levels_.pop_back();
  if (levels_.empty()) {
    control_.overrides = {};
    standDown();
  } else {
    publishTool();
    nextPatternPoint();
  }
}

void KlartextHost::settle() {
  contour_.flush();
  contour_.discard();
  side_ = Side::Off;
}

}  // namespace probewright::language::klartext
