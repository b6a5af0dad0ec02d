#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace probewright::app {

/// How far a long computation is, on standard error: on a terminal in one line, else a line now and then.
class StudyProgress {
public:
  explicit StudyProgress(bool terminal) : terminal_(terminal) {}

  void tell(const std::string& phase, std::uint64_t done, std::uint64_t of);
  void clear() const;

private:
  using Clock = std::chrono::steady_clock;
  bool terminal_;
  std::string phase_;
  Clock::time_point begin_, next_;
  std::uint64_t doneAtBegin_ = 0;
};

}  // namespace probewright::app
