#include "session/trace_recorder.hpp"

#include <algorithm>
#include <utility>

namespace probewright::session {

using records::RunTrace;

namespace {

constexpr int mostAtOnce = 200;  ///< blocks at one instant, each with its state

}  // namespace

TraceRecorder::TraceRecorder(const control::Channel& channel, Describe describe, std::size_t most)
    : channel_(channel), describe_(std::move(describe)), most_(std::max<std::size_t>(most, 2)) {}

void TraceRecorder::begin(const language::Program& program, const language::Block& block) {
  const double now = channel_.seconds();
  std::vector<RunTrace::Block>& blocks = trace_.blocks;
  const auto line = static_cast<std::uint32_t>(block.position.line);
  const std::uint32_t file = fileOf(program);
  if (!blocks.empty() && blocks.back().seconds == now) {
    // A loop that only computes: which of its blocks comes last is enough.
    if (++atOnce_ > mostAtOnce) {
      blocks.back().file = file;
      blocks.back().line = line;
      return;
    }
  } else {
    atOnce_ = 0;
  }
  add({now, file, line, currentState(), channel_.position().vector(), channel_.axes()});
}

RunTrace TraceRecorder::finish() {
  if (!trace_.blocks.empty()) {
    RunTrace::Block last = trace_.blocks.back();
    last.seconds = channel_.seconds();
    last.state = currentState();
    last.position = channel_.position().vector();
    last.axes = channel_.axes();
    trace_.blocks.push_back(last);
  }
  return std::move(trace_);
}

void TraceRecorder::add(RunTrace::Block block) {
  std::vector<RunTrace::Block>& blocks = trace_.blocks;
  if (blocks.size() > 1 && block.seconds - blocks[blocks.size() - 2].seconds < span_) blocks.pop_back();
  blocks.push_back(std::move(block));
  if (blocks.size() >= most_) thinOut();
}

void TraceRecorder::thinOut() {
  constexpr double firstSpan = 1e-3;  // s
  std::vector<RunTrace::Block>& blocks = trace_.blocks;
  while (blocks.size() > most_ / 2) {
    span_ = std::max(firstSpan, 2 * span_);
    std::vector<RunTrace::Block> kept;
    for (RunTrace::Block& block : blocks) {
      if (kept.size() > 1 && block.seconds - kept[kept.size() - 2].seconds < span_) kept.pop_back();
      kept.push_back(std::move(block));
    }
    blocks = std::move(kept);
  }
}

std::uint32_t TraceRecorder::currentState() {
  RunTrace::State state;
  describe_(state);
  const machine::AxisPositions axes = channel_.axes();
  if (channel_.following() == control::Following::Kinematics) {
    state.programFrom = channel_.programFromTable(axes);
  } else {
    state.follows = RunTrace::State::Follows::LinearAxes;
    const Vector3 deviation = channel_.tipDeviation ? channel_.tipDeviation(axes) : Vector3::Zero();
    state.programFrom = channel_.frame().inverse() * translation(deviation - channel_.toolVector);
  }
  if (trace_.states.empty() || !(trace_.states.back() == state)) trace_.states.push_back(std::move(state));
  return static_cast<std::uint32_t>(trace_.states.size() - 1);
}

std::uint32_t TraceRecorder::fileOf(const language::Program& program) {
  if (&program == program_) return file_;
  program_ = &program;
  const auto [place, isNew] = files_.try_emplace(program.file(), static_cast<std::uint32_t>(trace_.files.size()));
  if (isNew) trace_.files.push_back(program.file());
  return file_ = place->second;
}

}  // namespace probewright::session
