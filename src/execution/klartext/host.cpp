#include "execution/klartext/host.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <type_traits>

#include "control/alarm.hpp"
#include "control/control_kind.hpp"
#include "language/klartext/control_blocks.hpp"
#include "language/word_column.hpp"

namespace probewright::execution::klartext {

namespace {

constexpr std::size_t localCount = 500;

}  // namespace

KlartextHost::KlartextHost(control::heidenhain::Control& control, HostOptions options)
    : control_(control),
      run_(control, std::move(options)),
      parameters_(run_),
      spindle_(run_),
      guidance_(run_),
      tools_(run_, guidance_, spindle_),
      motion_(run_, guidance_, tools_),
      tilting_(run_, motion_),
      coordinateChanges_(run_, tilting_),
      cycles_(run_, motion_, guidance_, parameters_),
      machineFunctions_(run_, motion_, guidance_, spindle_, cycles_),
      systemData_(run_, parameters_, tools_, spindle_, motion_, cycles_),
      protocol_(run_, parameters_),
      tables_(run_, parameters_, tools_) {}

void KlartextHost::execute(const Instruction& instruction, Evaluation& evaluation) {
  try {
    refuseWhatIsLacked(instruction, evaluation);
    std::visit(
        [&](const auto& each) {
          if constexpr (isFlow<std::remove_cvref_t<decltype(each)>>) {
            throw std::logic_error("flow is the interpreter's");
          } else {
            carryOut(each, evaluation);
          }
        },
        instruction);
  } catch (...) {
    motion_.discard();
    throw;
  }
}

/// A called program is not checked before the run: its blocks are refused where they stand.
void KlartextHost::refuseWhatIsLacked(const Instruction& instruction, Evaluation& evaluation) const {
  const auto lacked = language::klartext::lackedBlock(control_.kind(), evaluation.block(), instruction);
  if (!lacked) return;
  throw control::Alarm("Block not permitted",
                       fmt::format("the {} does not have {}", control::name(control_.kind()), lacked->name),
                       std::string(lacked->advice));
}

void KlartextHost::carryOut(const Move& move, Evaluation& evaluation) {
  motion_.carryOut(move, evaluation);
  const bool prepares =
      move.kind == MoveKind::SetCentre || move.kind == MoveKind::Rounding || move.kind == MoveKind::Chamfer;
  if (!prepares) cycles_.afterMove(move, evaluation);
}

void KlartextHost::carryOut(const ToolCall& call, Evaluation& evaluation) {
  motion_.settle();
  tools_.callTool(call, evaluation);
  if (call.feed.present()) motion_.takeFeedOfTool();
}

void KlartextHost::carryOut(const Modal& modal, Evaluation& evaluation) {
  motion_.flush();
  guidance_.switchBy(modal, evaluation);
}

void KlartextHost::carryOut(const MachineFunction& function, Evaluation& evaluation) {
  machineFunctions_.carryOut(function, evaluation);
}

void KlartextHost::carryOut(const Transform& transform, Evaluation& evaluation) {
  motion_.settle();
  coordinateChanges_.carryOut(transform, evaluation);
}

void KlartextHost::carryOut(const CycleCall& call, Evaluation& evaluation) {
  motion_.settle();
  cycles_.carryOut(call, evaluation);
}

void KlartextHost::carryOut(const Stop& stop, Evaluation&) {
  motion_.flush();
  if (!stop.optional && !run_.scans) control_.panel.stop("Program stop", control_.channel.seconds());
}

bool KlartextHost::beginBlock(const Program& program, const Block& block) {
  motion_.modes.untiltedPositions = motion_.modes.ignoreProbe = false;
  SourcePlace& place = control_.panel.place;
  place.line = block.position.line;
  place.column = columnOfFirstWord(block.at(block.source));
  if (run_.levels.empty() || run_.levels.back().file != place.file) place.file = program.file();
  if (run_.scans && run_.levels.size() == 1) endScanAt(block);
  // The end of a program has no instruction for the host, but motion that waits must come to its end.
  const bool ends = std::ranges::any_of(
      block.instructions, [](const Instruction& each) { return std::holds_alternative<EndProgram>(each); });
  if (ends && block.instructions.size() == 1) motion_.settle();
  if (ends) warnOfEarlyEnd(block);
  return true;
}

/// A line within a block means this block.
void KlartextHost::endScanAt(const Block& block) {
  const std::uint64_t wanted = run_.options.startLine;
  if (wanted < block.position.line || wanted >= block.next.line) return;
  if (motion_.holdsContour()) {
    throw control::Alarm(
        "Start block not permitted",
        "The start block stands within a contour with radius compensation, or at a rounding or a chamfer: where it "
        "begins depends on the blocks around it",
        "start at the block that approaches the contour, or behind the one that leaves it");
  }
  run_.scans = false;
  if (run_.options.scanEnds) run_.options.scanEnds();
}

/// Controls warn of M2 and M30 in called programs.
void KlartextHost::warnOfEarlyEnd(const Block& block) {
  const HeidenhainProgram* program = run_.levels.empty() ? nullptr : run_.levels.back().program;
  if (run_.levels.size() < 2 || program == nullptr || program->framePart(block) == FramePart::End) return;
  if (run_.firstTime("M30 of " + run_.levels.back().file)) {
    run_.warn("M2 or M30 in a called program ends only that program; the calling program continues");
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
  if (run_.levels.empty()) {
    control_.programPath = program.file();
    control_.startSeconds = control_.channel.seconds();
    control_.applyCoordinates();
  }
  if (level.program != nullptr) control_.unit = level.program->unit() == Unit::Inch ? 25.4 : 1;
  if (run_.levels.empty()) control_.mainUnit = control_.unit;
  run_.levels.push_back(std::move(level));
  tools_.publishTool();
}

void KlartextHost::leave(const Program&) {
  motion_.discard();
  if (run_.levels.empty()) return;
  control_.unit = run_.levels.back().outerUnit;
  run_.levels.pop_back();
  if (run_.levels.empty()) {
    control_.overrides = {};
    spindle_.standDown();
  } else {
    tools_.publishTool();
    cycles_.nextPatternPoint();
  }
}

}  // namespace probewright::execution::klartext
