#include "study_progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace probewright::app {

void StudyProgress::tell(const std::string& phase, std::uint64_t done, std::uint64_t of) {
  const auto now = Clock::now();
  if (phase != phase_) {
    phase_ = phase;
    begin_ = now;
    doneAtBegin_ = done;
    next_ = now + std::chrono::seconds(terminal_ ? 0 : 10);
    return;
  }
  if (now < next_) return;
  next_ = now + (terminal_ ? std::chrono::milliseconds(200) : std::chrono::seconds(10));
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  const double speed = static_cast<double>(done - doneAtBegin_) / std::max(seconds, 1e-3);
  const double left = speed > 0 ? static_cast<double>(of - std::min(done, of)) / speed : 0;
  const std::string text = fmt::format("{}: {} of at most {}, at most {:.0f} s left", phase, done, of, std::ceil(left));
  std::fputs((terminal_ ? "\r\033[K" + text + " " : text + "\n").c_str(), stderr);
}

void StudyProgress::clear() const {
  if (terminal_) std::fputs("\r\033[K", stderr);
}

}  // namespace probewright::app
