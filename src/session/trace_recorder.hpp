#pragma once

#include <functional>
#include <map>
#include <string>

#include "control/channel.hpp"
#include "language/block.hpp"
#include "language/program.hpp"
#include "records/run_trace.hpp"

namespace probewright::session {

/// Keeps what a replay needs of a run, without letting it grow with a program of a million blocks: beyond `most` blocks
/// only one is kept for each span of time, the last that begins in it; the span doubles as often as it has to.
class TraceRecorder {
public:
  /// `state` tells tool and preset; coordinates come from the channel.
  using Describe = std::function<void(records::RunTrace::State& state)>;
  TraceRecorder(const control::Channel& channel, Describe describe, std::size_t most = 60'000);

  /// A block begins.
  void begin(const language::Program& program, const language::Block& block);
  /// The run is over: the last block took until now. What was recorded goes to the caller.
  records::RunTrace finish();

private:
  void add(records::RunTrace::Block block);
  void thinOut();
  std::uint32_t currentState();
  std::uint32_t fileOf(const language::Program& program);

  const control::Channel& channel_;
  Describe describe_;
  std::size_t most_;
  double span_ = 0;  ///< s
  int atOnce_ = 0;   ///< blocks since the clock went on
  const language::Program* program_ = nullptr;
  std::uint32_t file_ = 0;
  std::map<std::string, std::uint32_t> files_;
  records::RunTrace trace_;
};

}  // namespace probewright::session
