#pragma once

#include <chrono>
#include <functional>
#include <stop_token>
#include <string>
#include <utility>

#include "base/diagnostic.hpp"
#include "linuxcnc/feel/feel_exchange.h"

/// The engine's end of the memory that it shares with LinuxCNC's HAL component probewright_feel.
namespace probewright::app {

/// The memory of one component, from its opening until this goes; the component is told then.
class SharedFeeling {
public:
  /// Opens the memory called `segment`, waiting `patience` at most for somebody to make it. A mistake: nobody did, it
  /// is of another version, somebody else answers there already.
  static Result<SharedFeeling> open(const std::string& segment, std::chrono::seconds patience,
                                    const std::stop_token& stop);
  SharedFeeling(SharedFeeling&& other) noexcept : memory_(std::exchange(other.memory_, nullptr)) {}
  SharedFeeling& operator=(SharedFeeling&&) = delete;
  ~SharedFeeling();

  const feel_exchange& memory() const { return *memory_; }
  /// From now on questions are answered: `answer` returns the bits of the answer to what the memory holds. Returns when
  /// the component leaves or dies, or a stop is asked for.
  void serve(const std::function<std::uint32_t(const feel_exchange&)>& answer, const std::stop_token& stop);

private:
  explicit SharedFeeling(feel_exchange* memory) : memory_(memory) {}
  feel_exchange* memory_;
};

}  // namespace probewright::app
