#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

/// Work that may crash, hang or eat all memory, done in a process of its own.
namespace probewright::simulation {

struct ChildLimits {
  double seconds = 600;                           ///< of the clock on the wall
  std::uint64_t bytes = std::uint64_t{8} << 30U;  ///< of memory beyond what its parent has
};

/// The child's side: tells the parent what it does. Any thread of the child may speak.
class ChildVoice {
public:
  explicit ChildVoice(int descriptor) : descriptor_(descriptor) {}
  /// One line; what is longer than 1000 bytes is cut, line ends become blanks.
  void say(std::string_view line) const;

private:
  int descriptor_;
};

/// How the child's work ended.
struct ChildEnd {
  enum class How {
    Finished,     ///< `result` is what the work returned
    Crashed,      ///< by `signal`, or with an exception (0)
    OutOfMemory,  ///< it wanted more than its limit
    OutOfTime,
    Ended,      ///< because the parent had enough
    NoProcess,  ///< none could be started, `result` says why
  };
  How how = How::Crashed;
  int signal = 0;
  std::string result;
};

/// Whether this process, a child, has come near the memory that it may have: what fails then fails for lack of it,
/// whatever a library says. Not known under an address sanitizer.
bool ranShortOfMemory();

/// Does `work` in a child process and waits for it. `heard` gets each line that the child says; `enough` is asked about
/// twenty times a second, told how many seconds of the processor the child has used, and ends the child by saying yes.
/// The child has a copy of everything that its parent has, but
/// of the threads only the one that calls; its standard output goes nowhere.
ChildEnd inChild(const std::function<std::string(const ChildVoice&)>& work, const ChildLimits& limits,
                 const std::function<void(std::string_view line)>& heard,
                 const std::function<bool(double processorSeconds)>& enough);

}  // namespace probewright::simulation
