#pragma once

#include <stop_token>
#include <thread>

namespace probewright::app {

/// Ctrl-C as a stop token, while it lives. The second Ctrl-C ends the program as it would without this.
class Interruption {
public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  std::stop_token token() const { return source_.get_token(); }

private:
  std::stop_source source_;
  std::thread watcher_;  ///< a signal handler may not ask for a stop itself
};

}  // namespace probewright::app
